// SPDX-License-Identifier: BSD-3-Clause
// The judge: where must the node be? The path of equilibria that continuity demands, in many small steps on
// the judge's own geometry. Each step goes downhill in energy, by moves that are short against the waves, so
// that no valley is skipped.
#pragma once

#include <vector>

#include "chart/press.hpp"

namespace host::chart {

struct Truth {
  bool complete = false;     ///< an equilibrium was found at every step
  std::vector<Vec> position; ///< [steps + 1]
  std::vector<Pair> pair;    ///< [steps + 1]
};

/// Steps of the judge's path; nominal increments divide it.
inline constexpr int judge_steps = 512;

/// @param steps  of the way t = 0 .. 1
Truth true_path(const Press& press, int steps = judge_steps);

/// The gradient of the energy; what is left of it at an equilibrium is rounding.
Vec energy_gradient(const Press& press, const Vec& anchor, const Vec& x, const Pair& pair);

} // namespace host::chart
