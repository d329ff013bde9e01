// SPDX-License-Identifier: BSD-3-Clause
// Largest element of the library: slave and 16 master nodes in 3D, 3 multipliers.
#pragma once

namespace ents_adapter {

inline constexpr int largest_nodes = 1 + 16;
inline constexpr int largest_multipliers = 3;
inline constexpr int largest_dofs = 3 * largest_nodes + largest_multipliers;
inline constexpr int largest_state = 64;

} // namespace ents_adapter
