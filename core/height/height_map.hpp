// SPDX-License-Identifier: BSD-3-Clause
// Height map: the cubic (one surface coordinate) or bicubic (two) uniform B-spline through regular samples.
//
//   h(s) = sum_ij c_ij B(u_1 - i) B(u_2 - j),   u_a = (s_a - origin_a) / spacing_a,   h(s_ij) = values_ij
//
// with B the centred cubic B-spline; h is C2 everywhere, its third derivatives are constant per cell.
//
//   periodic   n samples cover [origin, origin + size): spacing = size / n, sample n would be sample 0 again.
//   clamped    n >= 2 samples cover [origin, origin + size]: spacing = size / (n - 1). At the samples beside
//              the ends the third derivative is continuous as well ("not-a-knot"): the map is exact for
//              cubics, of 3 samples for parabolas, of 2 for lines. Outside, h continues C2 and reaches the
//              value of the edge sample three spacings from it; from there on it is constant. In the first
//              spacing outside it may exceed the range of the samples, the more the rougher they are.
// Source of the interpolation: C. de Boor, A Practical Guide to Splines, 1978; M. Unser, Splines: a perfect
// fit for signal and image processing, IEEE Signal Processing Magazine 16 (1999) 22-38.
#pragma once

#include <cstddef>
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

inline std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); } // of a container

// Solves (c_i-1 + 4 c_i + c_i+1) / 6 = f_i in place for `count` numbers that lie `stride` apart. Clamped: at
// least 2, with c_1 = (8 f_1 - f_0 - f_2) / 6 and the same at the other end (not-a-knot).
void solve_spline_coefficients(double* values, std::int64_t count, std::int64_t stride, MapBoundary boundary);

// Writes the `before` coefficients before c[0] and the `after` ones behind c[count - 1], which lie `stride`
// apart. Clamped: c_-1 = 6 f_0 - 4 c_0 - c_1, then f_0, and the same at the other end.
void extend_spline_coefficients(double* c, std::int64_t count, std::int64_t before, std::int64_t after,
                                std::int64_t stride, MapBoundary boundary);

// A table of coefficients has those beside the samples, too: of the cells from three spacings before them to
// two behind the last (clamped), or to what rounding may make of 0 and n (periodic).
inline constexpr std::int64_t spline_padding_before = 4, spline_padding_after = 5;
inline constexpr double spline_cells_outside = 3.0;
constexpr std::int64_t spline_row_length(std::int64_t columns) {
  return spline_padding_before + columns + spline_padding_after;
}
// Place of sample (0, 0)
constexpr std::int64_t first_spline_coefficient(std::int32_t dimension, std::int64_t columns) {
  return (dimension == 2 ? spline_padding_before * spline_row_length(columns) : 0) + spline_padding_before;
}
// The table with the map's values amid coefficients that are still to be computed (zero)
std::vector<double> padded_coefficients(const HeightMap& map);
// The table of the spline through the map's values
std::vector<double> spline_coefficients(const HeightMap& map);

} // namespace ents
