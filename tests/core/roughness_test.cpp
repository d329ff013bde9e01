// SPDX-License-Identifier: BSD-3-Clause
// Random roughness: the spectrum of its samples is the one asked for, by direct sums instead of the fast
// transform that made them.
#include "core/height/roughness.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>

#include "core/height/height_tree.hpp"
#include "worst.hpp"

namespace roughness_test {
namespace {

using namespace ents;

constexpr double pi = 3.14159265358979323846;

Roughness surface() {
  Roughness r;
  r.dimension = 2;
  r.seed = 7;
  r.rms = 0.02, r.hurst = 0.8;
  r.shortest = 0.25, r.roll_off = 0.5, r.longest = 1.5;
  r.size[0] = 2.0, r.size[1] = 1.5;
  r.samples[0] = 64, r.samples[1] = 32;
  return r;
}

Roughness profile() {
  Roughness r;
  r.seed = 3;
  r.rms = 0.01, r.hurst = 0.5;
  r.shortest = 0.02, r.roll_off = 0.2, r.longest = 1.0;
  r.size[0] = 1.0;
  r.samples[0] = 512;
  return r;
}

// Fourier coefficient (i, j) of the samples by its definition
std::complex<double> coefficient(const HeightMap& map, std::int64_t i, std::int64_t j) {
  std::complex<double> sum = 0.0;
  for (std::int64_t y = 0; y < map.rows; ++y)
    for (std::int64_t x = 0; x < map.columns; ++x) {
      const double turns = static_cast<double>(i * x % map.columns) / static_cast<double>(map.columns) +
                           static_cast<double>(j * y % map.rows) / static_cast<double>(map.rows);
      sum += map.values[static_cast<std::size_t>(y * map.columns + x)] * std::polar(1.0, -2.0 * pi * turns);
    }
  return sum / static_cast<double>(map.rows * map.columns);
}

TEST(Roughness, HasTheSpectrumThatIsAskedFor) {
  for (const Roughness& r : {surface(), profile()}) {
    const HeightMap map = rough_map(r);
    const std::int64_t half_1 = r.samples[0] / 2, half_2 = r.dimension == 2 ? r.samples[1] / 2 : 0;
    double total = 0.0, mean_square = 0.0, worst = 0.0, worst_phase = 0.0;
    for (std::int64_t j = -half_2; j <= half_2; ++j)
      for (std::int64_t i = -half_1; i <= half_1; ++i) total += relative_power(r, i, j);
    for (std::int64_t j = r.dimension == 2 ? -half_2 + 1 : 0; j < (r.dimension == 2 ? half_2 : 1); ++j)
      for (std::int64_t i = -half_1 + 1; i < half_1; ++i) {
        const double k = std::hypot(static_cast<double>(i) / r.size[0],
                                    r.dimension == 2 ? static_cast<double>(j) / r.size[1] : 0.0);
        double power = k < 1.0 / r.longest - 1e-9 || k > 1.0 / r.shortest + 1e-9 ? 0.0 : 1.0;
        if (k > 1.0 / r.roll_off) power *= std::pow(k * r.roll_off, -(2.0 * r.hurst + r.dimension));
        const std::complex<double> c = coefficient(map, i, j);
        test::raise(worst, std::fabs(std::abs(c) - r.rms * std::sqrt(power / total)));
        if (power > 0.0 && (j > 0 || (j == 0 && i > 0)))
          test::raise(worst_phase,
                      std::abs(c / std::abs(c) - std::polar(1.0, 2.0 * pi * random_phase(r.seed, i, j))));
      }
    for (const double h : map.values) mean_square += h * h / static_cast<double>(map.values.size());
    EXPECT_LT(worst, 1e-14 * r.rms); // 2048 terms, each with its rounding
    EXPECT_LT(worst_phase, 1e-10);   // waves of a hundredth of the largest
    EXPECT_NEAR(std::sqrt(mean_square), r.rms, 1e-14 * r.rms);
  }
}

// Slope and curvature of the spline through the samples against those of the waves. The shortest wave has x =
// 50 / 512 of a length per sample; the spline has its first alias, 1/x - 1 = 9.2 times as short, with (x / (1
// - x))^4 = 1.4e-4 of its amplitude: 1.2 % of its curvature, of the squares 1.4e-4. Longer waves are better.
TEST(Roughness, TheMapHasTheSlopeOfTheWaves) {
  const Roughness r = profile();
  const Height height = Height::map(rough_map(r));
  double total = 0.0, slope = 0.0, curvature = 0.0;
  for (std::int64_t i = -50; i <= 50; ++i) {
    const double power = relative_power(r, i, 0), k = 2.0 * pi * static_cast<double>(i);
    total += power, slope += power * k * k, curvature += power * k * k * k * k;
  }
  double found_slope = 0.0, found_curvature = 0.0;
  constexpr int points = 8192;
  for (int n = 0; n < points; ++n) {
    const double s[1] = {n / static_cast<double>(points)};
    const auto jet = portable::evaluate_height<1, double>(height.root(), s);
    found_slope += jet.h1[0] * jet.h1[0] / points, found_curvature += jet.h2[0] * jet.h2[0] / points;
  }
  EXPECT_NEAR(std::sqrt(found_slope), r.rms * std::sqrt(slope / total),
              1e-3 * r.rms * std::sqrt(slope / total));
  EXPECT_NEAR(std::sqrt(found_curvature), r.rms * std::sqrt(curvature / total),
              1e-3 * r.rms * std::sqrt(curvature / total));
}

// More samples show the same surface.
TEST(Roughness, WavesDoNotDependOnTheSamples) {
  Roughness r = surface();
  const HeightMap coarse = rough_map(r);
  r.samples[0] = 256, r.samples[1] = 64;
  const HeightMap fine = rough_map(r);
  for (std::int64_t j = 0; j < 32; ++j)
    for (std::int64_t i = 0; i < 64; ++i)
      EXPECT_NEAR(coarse.values[static_cast<std::size_t>(j * 64 + i)],
                  fine.values[static_cast<std::size_t>(2 * j * 256 + 4 * i)], 1e-15);
}

TEST(Roughness, HasTheSameBitsEverywhere) {
  const auto hash = [](const HeightMap& map) {
    std::uint64_t h = 0xcbf29ce484222325u;
    for (const double x : map.values)
      for (int shift = 0; shift < 64; shift += 8)
        h = (h ^ (std::bit_cast<std::uint64_t>(x) >> shift & 0xff)) * 0x100000001b3u;
    return h;
  };
  EXPECT_EQ(hash(rough_map(surface())), 16653505635632053180u);
  EXPECT_EQ(hash(rough_map(profile())), 2832254192093397030u);
  Roughness other = surface();
  other.seed = 8;
  EXPECT_NE(hash(rough_map(other)), hash(rough_map(surface())));
}

TEST(Roughness, IsEmptyWithoutWaves) {
  Roughness r = profile();
  r.longest = 0.0212, r.roll_off = 0.021, r.shortest = 0.0209; // between 1/48 and 1/47
  EXPECT_TRUE(rough_map(r).values.empty());
}

} // namespace
} // namespace roughness_test
