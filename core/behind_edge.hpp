// SPDX-License-Identifier: BSD-3-Clause
// A slave that is ahead of no segment: is it outside the surface, or has it gone through a concave edge?
//
// Behind the edge of a groove of flat segments is a wedge that belongs to neither: the closest point of the surface is on
// the edge, and the slave on the inner side of it. Beside a free edge, and ahead of a ridge, it is open.
#pragma once

#include "core/detection.hpp"

namespace ents {

// Normal projection, with a tree of the surface. Edges farther than `reach` are none.
bool is_behind_edge(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave, double reach);

} // namespace ents
