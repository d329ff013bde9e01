// SPDX-License-Identifier: BSD-3-Clause
// Largest element: slave and 32 master nodes (a patch of segments may have so many) in 3D, 3 multipliers. Its
// tangent, on the stack of a host's thread, takes 83 kB.
#pragma once

namespace ents_adapter {

inline constexpr int largest_nodes = 1 + 32;
inline constexpr int largest_slave_nodes = 9; // of the face that a slave point lies in
inline constexpr int largest_multipliers = 3;
inline constexpr int largest_dofs = 3 * largest_nodes + largest_multipliers;
inline constexpr int largest_state = 64;

} // namespace ents_adapter
