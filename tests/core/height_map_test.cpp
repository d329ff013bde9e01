// SPDX-License-Identifier: BSD-3-Clause
// Height maps: exact at the samples, C2 at every knot, period and edge, cubic within a cell, and of fourth
// order in the sample spacing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "height_maps.hpp"
#include "worst.hpp"

namespace height_map_test {
namespace {

using namespace height_maps;

TEST(HeightMap, IsExactAtItsSamples) {
  for (const MapBoundary boundary : boundaries)
    for (std::int64_t n = 1; n <= 20; ++n) {
      if (boundary == MapBoundary::clamped && n == 1) continue;
      const HeightMap map = random_map(1, boundary, 1, n);
      const Height height = Height::map(map);
      for (std::int64_t i = 0; i < n; ++i)
        EXPECT_NEAR(jet(height, map.origin[0] + static_cast<double>(i) * spacing(map, 0)).h,
                    map.values[static_cast<std::size_t>(i)], tolerance(map))
            << n << " samples, sample " << i;
    }
}

// rows along s_2, columns along s_1, row 0 at the origin
TEST(HeightMap, IsExactAtItsSamplesIn3D) {
  for (const MapBoundary boundary : boundaries)
    for (const auto [rows, columns] : {std::array{2, 5}, {4, 3}, {7, 2}, {6, 6}}) {
      const HeightMap map = random_map(2, boundary, rows, columns);
      const Height height = Height::map(map);
      for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
          const double s[2] = {map.origin[0] + i * spacing(map, 0), map.origin[1] + j * spacing(map, 1)};
          EXPECT_NEAR(evaluate_height(height.root(), s).h,
                      map.values[static_cast<std::size_t>(j * columns + i)], tolerance(map));
        }
    }
}

// A single periodic row is the same profile for every s_2.
TEST(HeightMap, OnePeriodicRowIsAProfile) {
  HeightMap map = random_map(2, MapBoundary::periodic, 1, 6);
  const Height height = Height::map(map);
  map.dimension = 1;
  const Height profile = Height::map(map);
  for (double s1 = -2.0; s1 < 3.0; s1 += 0.37)
    for (double s2 = -2.0; s2 < 3.0; s2 += 0.61) {
      const double s[2] = {s1, s2};
      const HeightJet<2, double> at = evaluate_height(height.root(), s);
      EXPECT_EQ(at.h, jet(profile, s1).h);
      EXPECT_EQ(at.h1[0], jet(profile, s1).h1[0]);
      EXPECT_EQ(at.h1[1], 0.0);
      EXPECT_EQ(at.h2[2], 0.0);
    }
}

// Rows of the system, with the coefficients beyond the ends, and of a clamped map the differences that its
// end condition makes zero: the fourth, of three samples the third, of two the second.
TEST(HeightMap, SolvesItsSystem) {
  constexpr std::int64_t before = 2, after = 3;
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (const MapBoundary boundary : boundaries)
    for (std::int64_t n = 1; n <= 30; ++n)
      for (const std::int64_t stride : {1, 3}) {
        if (boundary == MapBoundary::clamped && n == 1) continue;
        std::vector<double> f(static_cast<std::size_t>((before + n + after) * stride));
        for (double& x : f) x = value(generator);
        std::vector<double> c = f;
        solve_spline_coefficients(c.data() + before * stride, n, stride, boundary);
        extend_spline_coefficients(c.data() + before * stride, n, before, after, stride, boundary);
        const auto at = [&](const std::vector<double>& v, std::int64_t i) {
          return v[static_cast<std::size_t>((before + i) * stride)];
        };
        const double bound = largest_coefficient(boundary) * 16 * eps; // a handful of roundings
        for (std::int64_t i = 0; i < n; ++i)
          EXPECT_NEAR((at(c, i - 1) + 4.0 * at(c, i) + at(c, i + 1)) / 6.0, at(f, i), bound)
              << n << " samples";
        for (std::int64_t i = -before; i < n + after; ++i) {
          if (boundary == MapBoundary::periodic) {
            EXPECT_EQ(at(c, i), at(c, ((i % n) + n) % n)) << n << " samples";
          }
          if (boundary == MapBoundary::clamped && i < -1) {
            EXPECT_NEAR(at(c, i), at(f, 0), bound) << n << " samples";
          }
          if (boundary == MapBoundary::clamped && i > n) {
            EXPECT_NEAR(at(c, i), at(f, n - 1), bound) << n << " samples";
          }
          for (std::int64_t k = 1; k < stride; ++k) { // what lies between is not touched
            const std::size_t between = static_cast<std::size_t>((before + i) * stride + k);
            EXPECT_EQ(c[between], f[between]);
          }
        }
        if (boundary == MapBoundary::periodic) continue;
        const int order = static_cast<int>(std::min<std::int64_t>(n, 4));
        for (const std::int64_t first : {std::int64_t{-1}, n - order}) {
          std::vector<double> difference;
          for (std::int64_t i = first; i <= first + order; ++i) difference.push_back(at(c, i));
          for (; difference.size() > 1; difference.pop_back())
            for (std::size_t i = 0; i + 1 < difference.size(); ++i)
              difference[i] = difference[i + 1] - difference[i];
          EXPECT_NEAR(difference[0], 0.0, 16 * bound) << n << " samples"; // the sum of the binomials
        }
      }
}

// Between knots the map is a cubic: Taylor's formula with the third derivative is exact.
TEST(HeightMap, IsACubicInEveryCell) {
  for (const MapBoundary boundary : boundaries) {
    const HeightMap map = random_map(1, boundary, 1, 9);
    const Height height = Height::map(map);
    const double d = spacing(map, 0);
    for (int cell = -6; cell < 15; ++cell) {
      const double s = map.origin[0] + (cell + 0.125) * d, t = 0.75 * d;
      const HeightJet<1, double> a = jet(height, s), b = jet(height, s + t);
      const double h3 = third_derivative(height, s);
      EXPECT_EQ(h3, third_derivative(height, s + t));
      const double bound = 8 * tolerance(map); // 8 terms
      EXPECT_NEAR(b.h, a.h + t * (a.h1[0] + t / 2 * (a.h2[0] + t / 3 * h3)), bound);
      EXPECT_NEAR(b.h1[0] * d, (a.h1[0] + t * (a.h2[0] + t / 2 * h3)) * d, bound);
      EXPECT_NEAR(b.h2[0] * d * d, (a.h2[0] + t * h3) * d * d, bound);
    }
  }
}

// Knots, period ends and clamped ends: from both sides the same h, h', h''.
TEST(HeightMap, IsC2Everywhere) {
  for (const MapBoundary boundary : boundaries) {
    const HeightMap map = random_map(1, boundary, 1, 9);
    const Height height = Height::map(map);
    const double d = spacing(map, 0), step = 0x1p-40 * d;
    for (int knot = -5; knot < 15; ++knot) {
      const double s = map.origin[0] + knot * d;
      const HeightJet<1, double> left = jet(height, s - step), right = jet(height, s + step);
      // Over 2 steps each may change by its own derivative: at most |c| 8 / d^(order + 1).
      const double bound = 8 * tolerance(map) + 2 * 0x1p-40 * largest_coefficient(map) * 8;
      EXPECT_NEAR(left.h, right.h, bound) << "knot " << knot;
      EXPECT_NEAR(left.h1[0] * d, right.h1[0] * d, bound) << "knot " << knot;
      EXPECT_NEAR(left.h2[0] * d * d, right.h2[0] * d * d, bound) << "knot " << knot;
    }
  }
}

TEST(HeightMap, IsC2EverywhereIn3D) {
  for (const MapBoundary boundary : boundaries) {
    const HeightMap map = random_map(2, boundary, 5, 6);
    const Height height = Height::map(map);
    const double d[2] = {spacing(map, 0), spacing(map, 1)};
    for (int a = 0; a < 2; ++a)
      for (int knot = -5; knot < 11; ++knot)
        for (double other = -2.3; other < 8.0; other += 0.7) {
          double s[2];
          s[1 - a] = map.origin[1 - a] + other * d[1 - a];
          s[a] = map.origin[a] + (knot - 0x1p-40) * d[a];
          const HeightJet<2, double> left = evaluate_height(height.root(), s);
          s[a] = map.origin[a] + (knot + 0x1p-40) * d[a];
          const HeightJet<2, double> right = evaluate_height(height.root(), s);
          const double bound = 3 * (8 * tolerance(map) + 2 * 0x1p-40 * largest_coefficient(map) * 8);
          EXPECT_NEAR(left.h, right.h, bound);
          EXPECT_NEAR(left.h1[0] * d[0], right.h1[0] * d[0], bound);
          EXPECT_NEAR(left.h1[1] * d[1], right.h1[1] * d[1], bound);
          EXPECT_NEAR(left.h2[0] * d[0] * d[0], right.h2[0] * d[0] * d[0], bound);
          EXPECT_NEAR(left.h2[1] * d[0] * d[1], right.h2[1] * d[0] * d[1], bound);
          EXPECT_NEAR(left.h2[2] * d[1] * d[1], right.h2[2] * d[1] * d[1], bound);
        }
  }
}

TEST(HeightMap, ThirdDerivativeOnAKnotIsThatOfTheRightCell) {
  HeightMap map = random_map(1, MapBoundary::periodic, 1, 8);
  map.origin[0] = 0.0;
  map.size[0] = 8.0;
  for (const MapBoundary boundary : boundaries) {
    map.boundary = boundary;
    if (boundary == MapBoundary::clamped) map.size[0] = 7.0;
    const Height height = Height::map(map);
    for (int knot = -2; knot < 12; ++knot) {
      EXPECT_EQ(third_derivative(height, knot), third_derivative(height, knot + 0.5)) << knot;
      const bool clamped = boundary == MapBoundary::clamped;
      if (knot < 0 || knot >= 7 || (clamped && (knot == 1 || knot == 6)))
        continue; // no knots: ClampedMapHasNoKnotBesideItsEnds
      EXPECT_NE(third_derivative(height, knot), third_derivative(height, knot - 0.5)) << knot;
    }
  }
}

TEST(HeightMap, PeriodsAreEqualToTheBit) {
  HeightMap map = random_map(2, MapBoundary::periodic, 4, 8);
  map.origin[0] = map.origin[1] = 0.0;
  map.size[0] = 8.0;
  map.size[1] = 1.0;
  const Height height = Height::map(map);
  std::mt19937_64 generator(3);
  std::uniform_int_distribution<int> part(0, (1 << 20) - 1), whole(-1000, 1000);
  for (int i = 0; i < 10000; ++i) {
    const double s[2] = {8.0 * part(generator) * 0x1p-20, part(generator) * 0x1p-20};
    const double far[2] = {s[0] + 8.0 * whole(generator), s[1] + whole(generator)};
    const HeightJet<2, double> a = evaluate_height(height.root(), s), b = evaluate_height(height.root(), far);
    ASSERT_EQ(a.h, b.h);
    for (int k = 0; k < 2; ++k) ASSERT_EQ(a.h1[k], b.h1[k]);
    for (int k = 0; k < 3; ++k) ASSERT_EQ(a.h2[k], b.h2[k]);
  }
}

// Interpolation error of the cubic spline: h^4, h^3, h^2 (de Boor).
TEST(HeightMap, ConvergesWithFourthOrder) {
  const auto f = [](double s) { return std::sin(2 * pi * s) + 0.3 * std::cos(4 * pi * s); };
  const auto f1 = [](double s) { return 2 * pi * std::cos(2 * pi * s) - 1.2 * pi * std::sin(4 * pi * s); };
  const auto f2 = [](double s) {
    return -4 * pi * pi * std::sin(2 * pi * s) - 4.8 * pi * pi * std::cos(4 * pi * s);
  };
  double error[2][3] = {};
  for (int level = 0; level < 2; ++level) {
    const Height height = Height::map(sampled(MapBoundary::periodic, level == 0 ? 32 : 128, 0.0, 1.0, f));
    for (double s = 0.0; s < 1.0; s += 0.0007) {
      const HeightJet<1, double> at = jet(height, s);
      test::raise(error[level][0], std::fabs(at.h - f(s)));
      test::raise(error[level][1], std::fabs(at.h1[0] - f1(s)));
      test::raise(error[level][2], std::fabs(at.h2[0] - f2(s)));
    }
  }
  // 32 samples: (4 pi / 32)^2 = 0.15 is the relative size of the next term; over two halvings log2(1.15)/2 =
  // 0.1.
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(std::log2(error[0][k] / error[1][k]) / 2.0, 4.0 - k, 0.1) << k;
}

// Far outside double's sensible range, a periodic map still reads its own table only (run under ASan), and
// keeps its bound.
TEST(HeightMap, StaysInItsTableForAnyNumber) {
  for (const MapBoundary boundary : boundaries) {
    const Height height = Height::map(random_map(2, boundary, 3, 4));
    for (const double x :
         {1e15, 1e18, -1e18, 1e100, -1e308, 1e308, std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
      for (const double y : {0.0, x}) {
        const double s[2] = {x, y}, t[2] = {y, x};
        const double h[2] = {evaluate_height(height.root(), s).h, evaluate_height(height.root(), t).h};
        if (std::fabs(x) > 1e300 || std::isnan(x)) continue;
        for (const double one : h) EXPECT_LE(std::fabs(one), height.bound()) << x;
      }
  }
}

TEST(HeightMap, RefusesTooFewSamples) {
  EXPECT_THROW(Height::map(random_map(1, MapBoundary::clamped, 1, 1)), std::invalid_argument);
  EXPECT_THROW(Height::map(random_map(2, MapBoundary::clamped, 1, 5)), std::invalid_argument);
  EXPECT_THROW(Height::map(random_map(1, MapBoundary::periodic, 2, 5)), std::invalid_argument);
  EXPECT_THROW(Height::map(random_map(1, MapBoundary::periodic, 1, 0)), std::invalid_argument);
  HeightMap map = random_map(1, MapBoundary::periodic, 1, 5);
  map.values.pop_back();
  EXPECT_THROW(Height::map(map), std::invalid_argument);
}

} // namespace
} // namespace height_map_test
