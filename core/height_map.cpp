// SPDX-License-Identifier: BSD-3-Clause
#include "core/height_map.hpp"

namespace ents {

namespace {

// Thomas algorithm for the matrix with 4 on the diagonal (`first`, `last` at its ends) and 1 beside it.
// Diagonally dominant, so no pivoting. `factor` is scratch of `count` numbers.
void solve_tridiagonal(double* x, std::int64_t count, std::int64_t stride, double first, double last,
                       std::vector<double>& factor) {
  factor[0] = 1.0 / (count == 1 ? last : first);
  x[0] *= factor[0];
  for (std::int64_t i = 1; i < count; ++i) {
    const double pivot = (i + 1 == count ? last : 4.0) - factor[static_cast<std::size_t>(i - 1)];
    factor[static_cast<std::size_t>(i)] = 1.0 / pivot;
    x[i * stride] = (x[i * stride] - x[(i - 1) * stride]) / pivot;
  }
  for (std::int64_t i = count - 1; i-- > 0;)
    x[i * stride] -= factor[static_cast<std::size_t>(i)] * x[(i + 1) * stride];
}

} // namespace

void solve_spline_coefficients(double* values, std::int64_t count, std::int64_t stride,
                               MapBoundary boundary) {
  if (count == 1) return; // both neighbours are the coefficient itself
  std::vector<double> factor(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) values[i * stride] *= 6.0;

  if (boundary == MapBoundary::clamped) { // 4 c_0 + c_-1 = 5 c_0
    solve_tridiagonal(values, count, stride, 5.0, 5.0, factor);
    return;
  }
  if (count == 2) { // both neighbours of one are the other: 4 c_0 + 2 c_1
    const double a = values[0], b = values[stride];
    values[0] = (4.0 * a - 2.0 * b) / 12.0;
    values[stride] = (4.0 * b - 2.0 * a) / 12.0;
    return;
  }
  // The cyclic matrix is the tridiagonal one with 3 at both ends plus v v^T, v = (1, 0 .. 0, 1):
  // Sherman-Morrison.
  solve_tridiagonal(values, count, stride, 3.0, 3.0, factor);
  std::vector<double> z(static_cast<std::size_t>(count), 0.0);
  z.front() = z.back() = 1.0;
  solve_tridiagonal(z.data(), count, 1, 3.0, 3.0, factor);
  const double weight = (values[0] + values[(count - 1) * stride]) / (1.0 + z.front() + z.back());
  for (std::int64_t i = 0; i < count; ++i) values[i * stride] -= weight * z[static_cast<std::size_t>(i)];
}

} // namespace ents
