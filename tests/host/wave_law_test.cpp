// SPDX-License-Identifier: BSD-3-Clause
// The law of short waves: closed forms of one wave, the laws of places and their springs, and what is kept.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "place_laws.hpp"
#include "wave_law.hpp"

namespace host::wave_law_test {
namespace {

using std::numbers::pi;

/// Waves of several lengths, whose places differ.
Eigen::ArrayXXd waves(Eigen::Index n) {
  Eigen::ArrayXXd z(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i) {
      const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(n),
                   y = (static_cast<double>(j) + 0.5) / static_cast<double>(n);
      z(i, j) = 0.01 * (std::cos(8 * pi * x) * std::cos(7 * pi * y) +
                        0.6 * std::cos(13 * pi * x) * std::cos(10 * pi * y) +
                        0.5 * std::cos(5 * pi * x) * std::cos(12 * pi * y));
    }
  return z - z.mean();
}

/// A folder of what is kept, for this test alone.
class Cache : public testing::Test {
protected:
  Cache() : folder_(std::filesystem::path(testing::TempDir()) / "ents_wave_law_test") {
    std::filesystem::remove_all(folder_);
    setenv("ENTS_CACHE", folder_.c_str(), 1);
  }
  ~Cache() override {
    unsetenv("ENTS_CACHE");
    std::filesystem::remove_all(folder_);
  }
  std::filesystem::path folder_;
};

// A double sine is in full contact from p* = E* k A / 2 on, k = sqrt(2) 2 pi / lambda: the amplitude of the
// pressure of cos(2 pi x / lambda) cos(2 pi y / lambda), whose compliance is 2 / (E* k).
TEST(WaveLaw, ADoubleSineIsOpenBelowThePressureOfFullContact) {
  constexpr Eigen::Index n = 32;
  constexpr double amplitude = 0.01, modulus = 1000;
  Eigen::ArrayXXd z(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i)
      z(i, j) = amplitude * std::cos(2 * pi * (static_cast<double>(i) + 0.5) / n) *
                std::cos(2 * pi * (static_cast<double>(j) + 0.5) / n);
  const double full = modulus * std::sqrt(2) * pi * amplitude;
  const WaveLaw law = press_waves(z, unit_half_space(n, n, 1, 1, Grid::periodic), modulus);
  ASSERT_GT(law.size(), 8u);
  // Levels whose gap is that of full contact are left out. One pressure is 1.63 times the next; the highest one is not
  // more than two of these steps below full contact.
  EXPECT_LT(law.front().pressure, full);
  EXPECT_GT(law.front().pressure, full / (1.63 * 1.63));
  for (std::size_t k = 0; k < law.size(); ++k) {
    EXPECT_LT(law[k].share, 1);
    EXPECT_NEAR(static_cast<double>(law[k].pressed.mean()), law[k].pressure, 1e-6 * law[k].pressure);
    if (k == 0) continue;
    EXPECT_GT(law[k].gap, law[k - 1].gap);
    EXPECT_LE(law[k].share, law[k - 1].share); // whole cells
  }
  // Without load, the gap to the highest place is the amplitude.
  EXPECT_GT(law.back().gap, 0.8 * amplitude);
  EXPECT_LT(law.back().gap, amplitude);
}

// Every place at its own gap of a level has its own pressure of that level: their mean is that of the level,
// and what the springs carry is what the curve says.
TEST(WaveLaw, LawsOfPlacesAddUpToTheirLevel) {
  constexpr Eigen::Index n = 48;
  constexpr int places = 12;
  constexpr double modulus = 1000;
  const ElasticLayer cells = unit_half_space(n, n, 1, 1, Grid::cells);
  const WaveLaw law = press_waves(waves(n), cells, modulus);
  const double h = 1. / places;
  const PlaceLaws own(law, cells, {2, 3}, modulus, h, h);
  for (const std::size_t level : {std::size_t{2}, law.size() / 2}) {
    double area = 0, least = 1e300, most = 0;
    for (int j = 0; j < places; ++j)
      for (int i = 0; i < places; ++i) {
        const double x = 2 + (i + 0.5) * h, y = 3 + (j + 0.5) * h;
        double p = 0; // of the box, from the cells
        for (Eigen::Index b = 0; b < n / places; ++b)
          for (Eigen::Index a = 0; a < n / places; ++a)
            p += static_cast<double>(law[level].pressed(i * n / places + a, j * n / places + b));
        p /= static_cast<double>((n / places) * (n / places));
        least = std::min(least, p), most = std::max(most, p);
        area += own.share(x, y, p);
      }
    EXPECT_NEAR(area / (places * places), law[level].share, 0.01 * law[level].share) << level;
    EXPECT_LT(least, 0.7 * most); // or places would not differ
  }
}

TEST(WaveLaw, SpringsAreTheCurve) {
  constexpr Eigen::Index n = 48;
  const ElasticLayer cells = unit_half_space(n, n, 1, 1, Grid::cells);
  const PlaceLaws own(press_waves(waves(n), cells, 1000), cells, {0, 0}, 1000, 0.1, 0.1);
  Mesh mesh;
  mesh.dimension = 3;
  mesh.coordinates = {0.3, 0.4, 0, 0.55, 0.6, 0};
  SlavePoints points;
  points.nodes = {0, 1}, points.weights = {1, 1}, points.areas = {0.01, 0.02};
  const SlavePoints springs = own.springs(points, mesh);
  const Json normal = own.contact().at("normal");
  const double stiffness = (normal.at("pressure")[0].get<double>() - normal.at("pressure")[1].get<double>()) /
                           (normal.at("gap")[1].get<double>() - normal.at("gap")[0].get<double>());
  ASSERT_EQ(springs.places.size(), 3u);
  for (std::size_t k = 0; k < 2; ++k) {
    const PlaceCurve curve = own.curve(mesh.coordinates[3 * k], mesh.coordinates[3 * k + 1]);
    ASSERT_GT(curve.gap.size(), 2u);
    double area = 0;
    for (std::size_t i = springs.places[k]; i < springs.places[k + 1]; ++i) area += springs.areas[i];
    EXPECT_NEAR(area, points.areas[k], 1e-12);
    for (std::size_t c = 0; c < curve.gap.size(); ++c) {
      double pressure = 0, bend = 0; // the springs begin with a bend that is a quarter of p at gap 0 high
      for (std::size_t i = springs.places[k]; i < springs.places[k + 1]; ++i) {
        const double closed = -springs.offsets[i] - curve.gap[c], part = springs.areas[i] / area * stiffness;
        pressure += part * std::max(0., closed);
        if (std::abs(closed) < springs.scales[i]) bend += part * springs.scales[i] / 4;
      }
      EXPECT_NEAR(pressure, curve.pressure[c], 1e-9 * curve.pressure.back()) << k << ", " << c;
      EXPECT_LT(bend, 0.1 * curve.pressure.back());
      if (c > 1) {
        EXPECT_GE((curve.pressure[c] - curve.pressure[c - 1]) / (curve.gap[c - 1] - curve.gap[c]),
                  (curve.pressure[c - 1] - curve.pressure[c - 2]) / (curve.gap[c - 2] - curve.gap[c - 1]) *
                      (1 - 1e-9));
      }
    }
  }
}

TEST_F(Cache, TheSameWavesAreComputedOnce) {
  constexpr Eigen::Index n = 16;
  const ElasticLayer cells = unit_half_space(n, n, 1, 1, Grid::cells);
  const Eigen::ArrayXXd z = waves(n);
  bool kept = true;
  int told = 0;
  const auto count = [&](int, int) { ++told; };
  const WaveLaw first = kept_wave_law(z, cells, 1000, count, &kept);
  EXPECT_FALSE(kept);
  EXPECT_GT(told, 0);
  told = 0;
  const WaveLaw again = kept_wave_law(z, cells, 2000, count, &kept); // of another modulus
  EXPECT_TRUE(kept);
  EXPECT_EQ(told, 0);
  ASSERT_EQ(again.size(), first.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(again[k].gap, first[k].gap);
    EXPECT_DOUBLE_EQ(again[k].pressure, 2 * first[k].pressure);
    EXPECT_EQ(again[k].share, first[k].share);
  }
  kept_wave_law(1.001 * z, cells, 1000, {}, &kept);
  EXPECT_FALSE(kept); // other waves
  // A byte of every file is damaged.
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(40);
    file.put('\x7f');
  }
  const WaveLaw repaired = kept_wave_law(z, cells, 1000, {}, &kept);
  EXPECT_FALSE(kept);
  EXPECT_EQ(repaired[3].gap, first[3].gap);
}

} // namespace
} // namespace host::wave_law_test
