// SPDX-License-Identifier: BSD-3-Clause
// On which side of a surface of segments is a slave whose closest point is not a projection but a point of
// the segments' borders?
//
// Behind the edge of a groove of flat segments is a wedge that projects on neither flank: the slave has
// penetrated. Ahead of a ridge is one, too: there the slave is open. Beside a free border the surface ends.
#pragma once

#include "core/search/detection.hpp"

namespace ents {

struct NearestBorder {
  BorderPoint at;
  std::int64_t segment;
};

enum class BorderSide {
  ahead,
  behind,
  beside_ahead,
  beside_behind
}; // beside_...: of a free border, continued by its tangent plane

// Segments that are left out do not count: their neighbours end there.

// The point of the borders of all segments that is closest to the slave. False: none is closer than `limit`.
bool nearest_border(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave,
                    const LeftOut& left_out, double limit, NearestBorder& out);

// crack: by how much the enriched segments that meet there are apart (0 where they meet).
BorderSide side_of_border(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave,
                          const LeftOut& left_out, const NearestBorder& nearest, double& crack);

} // namespace ents
