// SPDX-License-Identifier: BSD-3-Clause
// Self-contact: how thick is the body below a point of its surface (theory.md, section 9.6)? A point of a thin
// body is behind the body's far side, as one that has penetrated another part of the surface is behind that.
#pragma once

#include "core/search/detection.hpp"

namespace ents {

// The distance of a slave from the nearest point of the surface that it is behind, and that lies below the
// tangent plane of its own surface; segments that are left out do not count. `limit` if there is none within it.
//   left_out  with a normal
//   nearest   nearer points are contact, no far side
// For normal projections. ok, or what detect() says.
Status thickness_below(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave,
                       const LeftOut& left_out, double nearest, double limit, double& out);

} // namespace ents
