// SPDX-License-Identifier: BSD-3-Clause
// Maps and spectra without their short waves.
#include "core/height/low_pass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/height/roughness.hpp"

namespace ents::low_pass_test {
namespace {

constexpr double pi = std::numbers::pi;

// Waves along and across, some shorter than the cut-off: those are gone, the others are there to rounding.
TEST(LowPass, LeavesOutWhatIsShorter) {
  for (const MapBoundary boundary : {MapBoundary::periodic, MapBoundary::clamped})
    for (const std::int32_t dimension : {1, 2}) {
      const bool periodic = boundary == MapBoundary::periodic;
      HeightMap map, long_waves;
      map.dimension = dimension, map.boundary = boundary, map.size[0] = 3.0, map.size[1] = 2.0;
      map.columns = 31, map.rows = dimension == 2 ? 24 : 1;
      long_waves = map;
      struct Wave {
        int i, j; // half waves of the size; periodic: waves
        double phase, amplitude;
      };
      const double half = periodic ? 1.0 : 0.5;
      const auto shorter = [&](const Wave& w) {
        return std::hypot(half * w.i / 3.0, dimension == 2 ? half * w.j / 2.0 : 0.0) > 1.0 / 0.75;
      };
      const Wave waves[] = {{0, 0, 0, 0.3}, {2, 0, 0.4, 1}, {0, 1, 0.2, -2}, {4, 0, 0, 0.5}, {3, 1, 1, 0.7},
                            {5, 2, 0, 4},   {9, 0, 0.1, 3}, {0, 6, 0, 2},    {4, 2, 0.3, 1}, {8, 0, 0, 0.2}};
      int left_out = 0;
      for (std::int64_t row = 0; row < map.rows; ++row)
        for (std::int64_t column = 0; column < map.columns; ++column) {
          const double u = static_cast<double>(column) / static_cast<double>(periodic ? 31 : 30),
                       v = static_cast<double>(row) / static_cast<double>(periodic ? 24 : 23);
          double all = 0.0, kept = 0.0;
          for (const Wave& w : waves) {
            const double h = periodic ? std::cos(2 * pi * (w.i * u + w.j * v) + w.phase)
                                      : std::cos(pi * w.i * u) * std::cos(pi * w.j * v);
            all += w.amplitude * h;
            if (!shorter(w)) kept += w.amplitude * h;
            left_out += shorter(w);
          }
          map.values.push_back(all), long_waves.values.push_back(kept);
        }
      EXPECT_GT(left_out, 0);
      leave_out_short_waves(map, 0.75);
      for (std::size_t k = 0; k < map.values.size(); ++k)
        EXPECT_NEAR(map.values[k], long_waves.values[k], 3e-14) << periodic << dimension << " " << k;
      const std::vector<double> once = map.values;
      leave_out_short_waves(map, 0.75);
      for (std::size_t k = 0; k < once.size(); ++k) EXPECT_NEAR(map.values[k], once[k], 3e-14);
    }
}

TEST(LowPass, ACutOffBelowTheSpacingChangesNothing) {
  HeightMap map;
  map.dimension = 2, map.rows = 5, map.columns = 8, map.size[0] = map.size[1] = 1.0;
  std::mt19937 random(1);
  for (int k = 0; k < 40; ++k) map.values.push_back(std::uniform_real_distribution<double>(-1, 1)(random));
  for (const MapBoundary boundary : {MapBoundary::periodic, MapBoundary::clamped}) {
    HeightMap same = map;
    same.boundary = boundary;
    leave_out_short_waves(same, 1e-3);
    for (std::size_t k = 0; k < map.values.size(); ++k) EXPECT_NEAR(same.values[k], map.values[k], 1e-14);
  }
}

// Its own spectrum without the short waves, or its map without them: the same.
TEST(LowPass, OfRandomRoughness) {
  Roughness r;
  r.dimension = 2, r.seed = 4, r.rms = 0.02, r.hurst = 0.7;
  r.shortest = 0.1, r.roll_off = 0.5, r.longest = 1.0;
  r.size[0] = r.size[1] = 1.0, r.samples[0] = r.samples[1] = 64;
  HeightMap map = rough_map(r);
  leave_out_short_waves(map, 0.25);
  r.cut_off = 0.25;
  const HeightMap cut = rough_map(r);
  double squares = 0.0;
  for (std::size_t k = 0; k < cut.values.size(); ++k) {
    EXPECT_NEAR(map.values[k], cut.values[k], 1e-15) << k;
    squares += cut.values[k] * cut.values[k] / static_cast<double>(cut.values.size());
  }
  EXPECT_LT(squares, 0.99 * r.rms * r.rms);
}

} // namespace
} // namespace ents::low_pass_test
