// SPDX-License-Identifier: BSD-3-Clause
// What holds the bodies before they touch: supports, springs, periodic sides.
#pragma once

#include <string>
#include <vector>

#include "dof_map.hpp"
#include "mesh.hpp"
#include "scene.hpp"

namespace host {

/// A body that nothing holds can move as a whole: its equations are singular until contact holds it.
/// @param springs  [dofs] stiffness against the ground, or empty
/// @return "part block can move along y" of the first body that can; empty: all are held
std::string what_can_move(const Mesh& mesh, const DofMap& dofs, const std::vector<double>& springs,
                          const Scene& scene);

} // namespace host
