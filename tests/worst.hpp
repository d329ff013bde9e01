// SPDX-License-Identifier: BSD-3-Clause
// The worst of many numbers. A NaN is the worst of all and stays; std::max and std::min pass it over.
#pragma once

#include <cmath>

namespace test {

inline void raise(double& worst, double value) {
  if (!(value <= worst) && !std::isnan(worst)) worst = value;
}
inline void lower(double& worst, double value) {
  if (!(value >= worst) && !std::isnan(worst)) worst = value;
}

} // namespace test
