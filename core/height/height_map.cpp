// SPDX-License-Identifier: BSD-3-Clause
#include "core/height/height_map.hpp"

#include <algorithm>

namespace ents {

namespace {

// Thomas algorithm for the matrix with 4 on the diagonal (`end` at both ends) and 1 beside it.
// Diagonally dominant, so no pivoting. `factor` is scratch of `count` numbers.
void solve_tridiagonal(double* x, std::int64_t count, std::int64_t stride, double end,
                       std::vector<double>& factor) {
  factor[0] = 1.0 / end;
  x[0] *= factor[0];
  for (std::int64_t i = 1; i < count; ++i) {
    const double pivot = (i + 1 == count ? end : 4.0) - factor[static_cast<std::size_t>(i - 1)];
    factor[static_cast<std::size_t>(i)] = 1.0 / pivot;
    x[i * stride] = (x[i * stride] - x[(i - 1) * stride]) / pivot;
  }
  for (std::int64_t i = count - 1; i-- > 0;)
    x[i * stride] -= factor[static_cast<std::size_t>(i)] * x[(i + 1) * stride];
}

// Not-a-knot at both ends. A cubic's second difference of coefficients is linear: at sample 1 it is that of
// the samples.
void solve_not_a_knot(double* c, std::int64_t count, std::int64_t stride) {
  if (count == 2) return; // a line, as it stands
  const auto at = [&](std::int64_t i) -> double& { return c[i * stride]; };
  const std::int64_t last = count - 1;
  const double first_sample = at(0), last_sample = at(last), next_sample = at(1),
               previous_sample = at(last - 1);
  const double second = (8.0 * next_sample - first_sample - at(2)) / 6.0;
  const double second_last = (8.0 * previous_sample - at(last - 2) - last_sample) / 6.0;
  if (count == 3) { // a parabola: one second difference
    const double below = second - next_sample;
    for (const std::int64_t i : {0, 1, 2}) at(i) += below;
    return;
  }
  if (count > 4) {
    for (std::int64_t i = 2; i < last - 1; ++i) at(i) *= 6.0;
    at(2) -= second;
    at(last - 2) -= second_last;
    std::vector<double> factor(static_cast<std::size_t>(count - 4));
    solve_tridiagonal(c + 2 * stride, count - 4, stride, 4.0, factor);
  }
  at(1) = second;
  at(last - 1) = second_last;
  at(0) = 6.0 * next_sample - 4.0 * at(1) - at(2);
  at(last) = 6.0 * previous_sample - 4.0 * at(last - 1) - at(last - 2);
}

// The coefficient before c[0], where the differences of all that follow are those of a cubic (of fewer
// coefficients: a parabola, a line).
double extrapolated(const double* c, std::int64_t count, std::int64_t stride) {
  if (count == 2) return 2.0 * c[0] - c[stride];
  if (count == 3) return 3.0 * (c[0] - c[stride]) + c[2 * stride];
  return 4.0 * (c[0] + c[2 * stride]) - 6.0 * c[stride] - c[3 * stride];
}

// One end of a clamped map: the coefficient next to c[0] against `stride`, then the sample of c[0] again and
// again.
void extend_end(double* c, std::int64_t count, std::int64_t stride, std::int64_t beyond) {
  if (beyond < 1) return;
  c[-stride] = extrapolated(c, count, stride);
  const double sample = (c[-stride] + 4.0 * c[0] + c[stride]) / 6.0;
  for (std::int64_t i = 2; i <= beyond; ++i) c[-i * stride] = sample;
}

} // namespace

void solve_spline_coefficients(double* values, std::int64_t count, std::int64_t stride,
                               MapBoundary boundary) {
  if (boundary == MapBoundary::clamped) return solve_not_a_knot(values, count, stride);
  if (count == 1) return; // both neighbours are the coefficient itself
  std::vector<double> factor(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) values[i * stride] *= 6.0;

  if (count == 2) { // both neighbours of one are the other: 4 c_0 + 2 c_1
    const double a = values[0], b = values[stride];
    values[0] = (4.0 * a - 2.0 * b) / 12.0;
    values[stride] = (4.0 * b - 2.0 * a) / 12.0;
    return;
  }
  // The cyclic matrix is the tridiagonal one with 3 at both ends plus v v^T, v = (1, 0 .. 0, 1):
  // Sherman-Morrison.
  solve_tridiagonal(values, count, stride, 3.0, factor);
  std::vector<double> z(static_cast<std::size_t>(count), 0.0);
  z.front() = z.back() = 1.0;
  solve_tridiagonal(z.data(), count, 1, 3.0, factor);
  const double weight = (values[0] + values[(count - 1) * stride]) / (1.0 + z.front() + z.back());
  for (std::int64_t i = 0; i < count; ++i) values[i * stride] -= weight * z[static_cast<std::size_t>(i)];
}

void extend_spline_coefficients(double* c, std::int64_t count, std::int64_t before, std::int64_t after,
                                std::int64_t stride, MapBoundary boundary) {
  if (boundary == MapBoundary::clamped) {
    extend_end(c, count, stride, before);
    extend_end(c + (count - 1) * stride, count, -stride, after);
    return;
  }
  for (std::int64_t i = -before; i < 0; ++i) c[i * stride] = c[((i % count + count) % count) * stride];
  for (std::int64_t i = count; i < count + after; ++i) c[i * stride] = c[i % count * stride];
}

std::vector<double> padded_coefficients(const HeightMap& map) {
  const std::int64_t stride = spline_row_length(map.columns);
  const std::int64_t rows = map.dimension == 2 ? spline_row_length(map.rows) : 1;
  std::vector<double> table(static_cast<std::size_t>(rows * stride), 0.0);
  double* first = table.data() + first_spline_coefficient(map.dimension, map.columns);
  for (std::int64_t j = 0; j < map.rows; ++j)
    std::copy_n(map.values.data() + j * map.columns, map.columns, first + j * stride);
  return table;
}

// Rows, then the columns of all that is known of the rows.
std::vector<double> spline_coefficients(const HeightMap& map) {
  std::vector<double> table = padded_coefficients(map);
  const std::int64_t stride = spline_row_length(map.columns);
  double* first = table.data() + first_spline_coefficient(map.dimension, map.columns);
  const auto interpolate = [&](double* line, std::int64_t samples, std::int64_t apart) {
    solve_spline_coefficients(line, samples, apart, map.boundary);
    extend_spline_coefficients(line, samples, spline_padding_before, spline_padding_after, apart,
                               map.boundary);
  };
  for (std::int64_t j = 0; j < map.rows; ++j) interpolate(first + j * stride, map.columns, 1);
  if (map.dimension == 2)
    for (std::int64_t i = -spline_padding_before; i < map.columns + spline_padding_after; ++i)
      interpolate(first + i, map.rows, stride);
  return table;
}

} // namespace ents
