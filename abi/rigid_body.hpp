// SPDX-License-Identifier: BSD-3-Clause
// A rigid master that moves and turns: poses, and the element of a slave point and the body's reference
// point.
#pragma once

#include "abi/entry_point.hpp"

namespace ents {

// Dofs of the reference point: displacement and spin.
constexpr int body_dofs(int dimension) { return dimension == 2 ? 3 : 6; }
inline constexpr int largest_body_element = 9;

// The caller's pose, or null with the report written.
const ents_pose* checked_pose(int dimension, const ents_pose* pose, ents_pose& copy, const char* name,
                              std::int32_t& status, ents_report* report);

// y: the slave in the body's frame; residual, tangent: of the rigid master there. out_tangent is written
// where there is a tangent, column-major.
void add_body(int dimension, const ents_pose& pose, const double* y, const double* residual,
              const double* tangent, double* out_residual, double* out_tangent);

} // namespace ents
