// SPDX-License-Identifier: BSD-3-Clause
// A block whose upper side is a cylinder.
#pragma once

#include "mesh.hpp"

namespace host {

/// The upper side of a block, that of its last axis, is a cylinder: highest at 0, where the block ends, and
/// lower by radius - sqrt(radius^2 - x^2) beside it. The nodes below follow in proportion to their height.
struct Crown {
  double radius = 0; ///< 0: none
  int axis = 0;      ///< x, across the cylinder
};

/// Lower the nodes of the block that was added last, of these grid lines.
void round_block(Mesh& mesh, const std::vector<GridLines>& lines, const Crown& crown);

} // namespace host
