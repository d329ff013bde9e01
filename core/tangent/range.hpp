// SPDX-License-Identifier: BSD-3-Clause
// Bounds within which sums of products do not leave the range of numbers.
#pragma once

#include "core/tangent/dof_rows.hpp"

namespace ents::ENTS_ISA {

// Results made of ingredients below this stay far inside the range of double precision.
inline constexpr double largest_ingredient = 1e60;
// A bound of results that leaves room for a few terms more.
inline constexpr double largest_result = 1e300;

template <int N> ENTS_INLINE double sum_of_absolutes(const double (&v)[N], int count = N) {
  double s = 0.0;
  for (int i = 0; i < count; ++i) s += absolute(v[i]);
  return s;
}
template <int N> ENTS_INLINE double sum_of_absolutes(const DofRow<N>& v, int) {
  return sum_of_absolutes(v.column);
}

} // namespace ents::ENTS_ISA
