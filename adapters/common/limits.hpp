// SPDX-License-Identifier: BSD-3-Clause
// Largest element: slave and 32 master nodes (a patch of segments may have so many) in 3D with a temperature
// each, 3 multipliers. Its tangent, on the stack of a host's thread, takes 146 kB.
#pragma once

namespace ents_adapter {

inline constexpr int largest_nodes = 1 + 32;
inline constexpr int largest_body_nodes = 64; // of a rigid body, which are none of the host's
inline constexpr int largest_slave_nodes = 9; // of the face that a slave point lies in
inline constexpr int largest_multipliers = 3;
inline constexpr int largest_dofs = 4 * largest_nodes + largest_multipliers;
inline constexpr int largest_state = 64;
inline constexpr int largest_history = largest_state + 12; // with that of a rigid body

} // namespace ents_adapter
