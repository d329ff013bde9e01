// SPDX-License-Identifier: BSD-3-Clause
// Height maps for tests, and how exact they are.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>

#include "core/height/height_map.hpp"
#include "core/height/height_tree.hpp"

namespace height_maps {

using namespace ents;
using namespace ents::ENTS_ISA;

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr double pi = 3.14159265358979323846;
inline constexpr std::array boundaries = {MapBoundary::periodic, MapBoundary::clamped};

inline double spacing(const HeightMap& map, int a) {
  const double n = static_cast<double>(a == 0 ? map.columns : map.rows);
  return map.size[a] / (map.boundary == MapBoundary::periodic ? n : n - 1.0);
}

inline HeightMap random_map(std::int32_t dimension, MapBoundary boundary, std::int64_t rows,
                            std::int64_t columns) {
  HeightMap map;
  map.dimension = dimension;
  map.boundary = boundary;
  map.rows = rows;
  map.columns = columns;
  map.origin[0] = 0.375;
  map.origin[1] = -1.5;
  map.size[0] = 2.5;
  map.size[1] = 1.75;
  std::mt19937_64 generator(static_cast<std::uint64_t>(17 * rows + columns));
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (std::int64_t k = 0; k < rows * columns; ++k) map.values.push_back(value(generator));
  return map;
}

inline HeightMap sampled(MapBoundary boundary, std::int64_t n, double origin, double size,
                         const std::function<double(double)>& f) {
  HeightMap map;
  map.boundary = boundary;
  map.rows = 1;
  map.columns = n;
  map.origin[0] = origin;
  map.size[0] = size;
  for (std::int64_t i = 0; i < n; ++i)
    map.values.push_back(f(origin + static_cast<double>(i) * spacing(map, 0)));
  return map;
}

inline HeightJet<1, double> jet(const Height& height, double s) {
  const double at[1] = {s};
  return evaluate_height(height.root(), at);
}

inline double third_derivative(const Height& height, double s) {
  const Dual<double> at[1] = {{s, 1.0}};
  return evaluate_height(height.root(), at).h2[0].d;
}

// Coefficients for samples within +- 1. Periodic: 3, since the matrix is (4 +- 2)/6. Clamped: 3 inside of the
// ends, 10/6 beside them; c_0 = (2/3)(f_0 + f_1 + f_2) - c_2 <= 5, c_-1 = 6 f_0 - 4 c_0 - c_1 <= 28. In two
// directions their product.
inline double largest_coefficient(MapBoundary boundary) {
  return boundary == MapBoundary::periodic ? 3.0 : 28.0;
}
inline double largest_coefficient(const HeightMap& map) {
  const double one = largest_coefficient(map.boundary);
  return map.dimension == 2 ? one * one : one;
}

// A handful of roundings of each coefficient; s is rounded to eps |s| < 3 eps and the slope below 2 max|c| /
// spacing.
inline double tolerance(const HeightMap& map) {
  double closest = spacing(map, 0);
  if (map.dimension == 2) closest = std::min(closest, spacing(map, 1));
  return largest_coefficient(map) * (16.0 + 2.0 * 3.0 / closest) * eps;
}

} // namespace height_maps
