// SPDX-License-Identifier: BSD-3-Clause
// Height maps that end: constant outside, cubic up to their ends.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "height_maps.hpp"
#include "worst.hpp"

namespace clamped_map_test {
namespace {

using namespace height_maps;

TEST(ClampedMap, IsItsEdgeSampleThreeSpacingsOutside) {
  HeightMap map = random_map(1, MapBoundary::clamped, 1, 6);
  map.origin[0] = 0.0;
  map.size[0] = 5.0;
  const Height height = Height::map(map);
  for (const double inner : {-3.0, 8.0})
    for (const double out : {0.0, 0.25, 1.0, 7.0, 1e9, 1e300}) {
      const HeightJet<1, double> beyond = jet(height, inner + std::copysign(out, inner));
      EXPECT_NEAR(beyond.h, inner < 0.0 ? map.values.front() : map.values.back(), tolerance(map));
      EXPECT_EQ(beyond.h, jet(height, inner).h);
      EXPECT_EQ(beyond.h1[0], 0.0);
      EXPECT_EQ(beyond.h2[0], 0.0);
    }
  EXPECT_NE(jet(height, -2.5).h, jet(height, -3.0).h);
  EXPECT_NE(jet(height, 7.5).h, jet(height, 8.0).h);
}

// The end condition of a clamped map is exact for cubics, of three samples for parabolas and of two for
// lines: with their derivatives, up to and including its ends. Random cubics with coefficients in units of
// the spacing, measured from the middle.
TEST(ClampedMap, ReproducesCubics) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> coefficient(-1.0, 1.0);
  for (std::int64_t n = 2; n <= 40; ++n)
    for (int trial = 0; trial < 50; ++trial) {
      double c[4];
      for (int k = 0; k < 4; ++k) c[k] = k < n ? coefficient(generator) : 0.0;
      const double size = 2.0, d = size / static_cast<double>(n - 1);
      const auto at = [&](double s) { return (s - 0.5 * size) / d; };
      const auto f = [&](double s) { return c[0] + at(s) * (c[1] + at(s) * (c[2] + at(s) * c[3])); };
      const Height height = Height::map(sampled(MapBoundary::clamped, n, 0.0, size, f));
      const double half =
          0.5 * static_cast<double>(n - 1); // |f| <= 4 half^3, slopes in spacings 4 half^3 as well
      const double bound =
          largest_coefficient(MapBoundary::clamped) * 24 * eps * 4 * std::max(1.0, half * half * half);
      for (int i = 0; i <= 20; ++i) {
        const double s = size * i / 20.0, u = at(s);
        const HeightJet<1, double> got = jet(height, s);
        EXPECT_NEAR(got.h, f(s), bound) << n << " samples, s = " << s;
        EXPECT_NEAR(got.h1[0] * d, c[1] + u * (2 * c[2] + u * 3 * c[3]), bound) << n << " samples, s = " << s;
        EXPECT_NEAR(got.h2[0] * d * d, 2 * c[2] + 6 * u * c[3], 4 * bound) << n << " samples, s = " << s;
        if (i == 20) continue; // the third derivative there is that of the cell outside
        EXPECT_NEAR(third_derivative(height, s) * d * d * d, 6 * c[3], 8 * bound)
            << n << " samples, s = " << s;
      }
    }
}

// Bicubics of two coordinates, as the products of their powers
TEST(ClampedMap, ReproducesCubicsIn3D) {
  std::mt19937_64 generator(12);
  std::uniform_real_distribution<double> coefficient(-1.0, 1.0);
  for (std::int64_t rows = 2; rows <= 9; ++rows)
    for (std::int64_t columns = 2; columns <= 9; ++columns) {
      HeightMap map = random_map(2, MapBoundary::clamped, rows, columns);
      double c[4][4];
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) c[i][j] = i < columns && j < rows ? coefficient(generator) : 0.0;
      // value, slopes and second derivatives of u^i v^j, in spacings from the first sample
      const auto exact = [&](double u, double v) {
        std::array<double, 6> sum{};
        const double pu[4] = {1, u, u * u, u * u * u}, pv[4] = {1, v, v * v, v * v * v};
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j) {
            const double du = i > 0 ? i * pu[i - 1] : 0, dv = j > 0 ? j * pv[j - 1] : 0;
            const double duu = i > 1 ? i * (i - 1) * pu[i - 2] : 0, dvv = j > 1 ? j * (j - 1) * pv[j - 2] : 0;
            const double term[6] = {pu[i] * pv[j], du * pv[j], pu[i] * dv, duu * pv[j], du * dv, pu[i] * dvv};
            for (std::size_t k = 0; k < 6; ++k) sum[k] += c[i][j] * term[k];
          }
        return sum;
      };
      double largest = 0.0;
      for (std::int64_t j = 0; j < rows; ++j)
        for (std::int64_t i = 0; i < columns; ++i) {
          const double value = exact(static_cast<double>(i), static_cast<double>(j))[0];
          map.values[static_cast<std::size_t>(j * columns + i)] = value;
          test::raise(largest, std::fabs(value));
        }
      const Height height = Height::map(map);
      const double d1 = spacing(map, 0), d2 = spacing(map, 1);
      const double bound =
          std::pow(largest_coefficient(MapBoundary::clamped), 2) * 48 * eps * std::max(1.0, largest);
      for (int j = 0; j <= 8; ++j)
        for (int i = 0; i <= 8; ++i) {
          const double s[2] = {map.origin[0] + map.size[0] * i / 8, map.origin[1] + map.size[1] * j / 8};
          const std::array<double, 6> want = exact((s[0] - map.origin[0]) / d1, (s[1] - map.origin[1]) / d2);
          const HeightJet<2, double> got = evaluate_height(height.root(), s);
          EXPECT_NEAR(got.h, want[0], bound);
          EXPECT_NEAR(got.h1[0] * d1, want[1], bound);
          EXPECT_NEAR(got.h1[1] * d2, want[2], bound);
          EXPECT_NEAR(got.h2[0] * d1 * d1, want[3], bound);
          EXPECT_NEAR(got.h2[1] * d1 * d2, want[4], bound);
          EXPECT_NEAR(got.h2[2] * d2 * d2, want[5], bound);
        }
    }
}

// Not-a-knot: the third derivative does not jump at the samples beside the ends.
TEST(ClampedMap, HasNoKnotBesideItsEnds) {
  for (std::int64_t n = 4; n <= 20; ++n) {
    const HeightMap map = random_map(1, MapBoundary::clamped, 1, n);
    const Height height = Height::map(map);
    const double d = spacing(map, 0), last = static_cast<double>(n - 1);
    const auto in_spacings = [&](double u) {
      return third_derivative(height, map.origin[0] + u * d) * d * d * d;
    };
    const double bound = 8 * largest_coefficient(MapBoundary::clamped) * 16 * eps;
    EXPECT_NEAR(in_spacings(0.5), in_spacings(1.5), bound) << n;
    EXPECT_NEAR(in_spacings(last - 0.5), in_spacings(last - 1.5), bound) << n;
  }
}

} // namespace
} // namespace clamped_map_test
