// SPDX-License-Identifier: BSD-3-Clause
// Height map: the cubic (one surface coordinate) or bicubic (two) uniform B-spline through regular samples.
//
//   h(s) = sum_ij c_ij B(u_1 - i) B(u_2 - j),   u_a = (s_a - origin_a) / spacing_a,   h(s_ij) = values_ij
//
// with B the centred cubic B-spline; h is C2 everywhere, its third derivatives are constant per cell.
//
//   periodic   n samples cover [origin, origin + size): spacing = size / n, sample n would be sample 0 again.
//   clamped    n >= 2 samples cover [origin, origin + size]: spacing = size / (n - 1). Outside, the
//   coefficients
//              repeat their edge value (c_-1 = c_0, c_n = c_n-1, ...): h is still C2 across the edge and
//              constant from one spacing outside on.
// Source of the interpolation: C. de Boor, A Practical Guide to Splines, 1978; M. Unser, Splines: a perfect
// fit for signal and image processing, IEEE Signal Processing Magazine 16 (1999) 22-38.
#pragma once

#include <cstdint>
#include <vector>

namespace ents {

enum class MapBoundary : std::int32_t { periodic, clamped };

struct HeightMap {
  std::int32_t dimension = 1; // 1: rows = 1
  std::int64_t rows = 0;      // samples along s_2
  std::int64_t columns = 0;   // samples along s_1
  std::vector<double> values; // [rows][columns], row 0 at s_2 = origin[1]
  double origin[2] = {0.0, 0.0};
  double size[2] = {1.0, 1.0};
  MapBoundary boundary = MapBoundary::periodic;
};

// Solves (c_i-1 + 4 c_i + c_i+1) / 6 = f_i in place for `count` numbers that lie `stride` apart.
void solve_spline_coefficients(double* values, std::int64_t count, std::int64_t stride, MapBoundary boundary);

} // namespace ents
