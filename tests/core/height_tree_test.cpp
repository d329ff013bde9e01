// SPDX-License-Identifier: BSD-3-Clause
// Trees of heights: their bounds, feature lengths and continuity, their depth; and the thread, a profile.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/height/height_tree.hpp"
#include "core/height/thread.hpp"
#include "random_heights.hpp"

namespace height_tree_test {
namespace {

using namespace ents;
using namespace ents::ENTS_ISA;
using test::list;
using test::Random;
using test::random_map;

constexpr double eps = std::numeric_limits<double>::epsilon();

// Straight lines through the corners, but for the rounding on either side of these; inside of the corners;
// the pitch line.
TEST(Thread, IsStraightBetweenItsRoundedCorners) {
  Random random(6);
  for (int i = 0; i < 200; ++i) {
    ThreadProfile p{};
    p.pitch = random(0.5, 4.0);
    p.rising = random(0.02, 1.3);
    p.falling = random(0.02, 1.3);
    p.crest = random(0.0, 0.3) * p.pitch;
    p.root = random(0.0, 0.3) * p.pitch;
    p.rounding = random(0.001, 0.25) * p.pitch;
    const std::vector<double> coefficients = thread_coefficients(p);
    const Height height = Height::profile(coefficients, {1.0 / p.pitch}, 0.0);

    const double slopes = std::tan(p.rising) + std::tan(p.falling),
                 depth = (p.pitch - p.crest - p.root) / slopes;
    const double fall = depth * std::tan(p.falling), rise = depth * std::tan(p.rising);
    const double corner[5] = {0.5 * p.crest, 0.5 * p.crest + fall, 0.5 * p.crest + fall + p.root,
                              p.pitch - 0.5 * p.crest, p.pitch + 0.5 * p.crest};
    const double ridge =
        0.5 * p.pitch - p.crest; // ridge on the pitch line: crest + (what both flanks run) = pitch / 2
    const double crest_height = ridge / slopes;
    const auto straight = [&](double x) {
      if (x < corner[0] || x > corner[3]) return crest_height;
      if (x < corner[1]) return crest_height - (x - corner[0]) / std::tan(p.falling);
      if (x < corner[2]) return crest_height - depth;
      return crest_height - (corner[3] - x) / std::tan(p.rising);
    };
    for (int k = 0; k < 400; ++k) {
      const double s[1] = {random(0.0, p.pitch)};
      const double h = evaluate_height(height.root(), s).h, lines = straight(s[0]);
      double nearest = p.pitch;
      for (const double c : corner) nearest = std::min(nearest, std::fabs(s[0] - c));
      nearest = std::min(nearest, std::fabs(s[0] + 0.5 * p.crest));
      const double rounding_error = 64 * eps * (depth + p.pitch / std::tan(std::min(p.rising, p.falling)));
      if (nearest >= p.rounding) {
        EXPECT_NEAR(h, lines, rounding_error);
      }
      EXPECT_LE(h, crest_height + rounding_error);
      EXPECT_GE(h, crest_height - depth - rounding_error);
      if (nearest < p.rounding && (s[0] < corner[0] + p.rounding || s[0] > corner[3] - p.rounding) &&
          p.root > 2 * p.rounding && fall > 2 * p.rounding && rise > 2 * p.rounding) {
        EXPECT_LE(h, lines + rounding_error) << "a crest loses material";
      }
    }
  }
}

TEST(HeightTree, KnowsBoundsFeaturesAndContinuity) {
  Random random(4);
  const Height sine = Height::sine(-2.0, {0.5, -4.0}, 0.0);
  EXPECT_EQ(sine.bound(), 2.0);
  EXPECT_EQ(sine.feature_length(0), 0.5);
  EXPECT_EQ(sine.feature_length(1), 0.0625);
  EXPECT_EQ(sine.continuity(), Height::smooth);
  EXPECT_EQ(Height::polynomial({3.0}).bound(), 3.0);
  EXPECT_EQ(Height::polynomial({3.0, 1.0}).bound(), Height::unbounded);
  EXPECT_EQ(Height::polynomial({3.0, 1.0}).feature_length(0), Height::unbounded);
  EXPECT_EQ(Height::gaussian(1.0, {0.0}, 0.25).feature_length(0), 0.25);

  const Height map = Height::map(random_map(2, MapBoundary::clamped, random));
  EXPECT_EQ(map.continuity(), 2);
  EXPECT_DOUBLE_EQ(map.feature_length(0), 3.5 / 6);
  EXPECT_DOUBLE_EQ(map.feature_length(1), 2.75 / 5);
  for (int i = 0; i < 10000; ++i) {
    const double s[2] = {random(-4.0, 4.0), random(-4.0, 4.0)};
    EXPECT_LE(std::fabs(evaluate_height(map.root(), s).h), map.bound() * (1 + 8 * eps));
  }

  const Height profile = Height::profile({1.0, -3.0, 0.5, 2.0}, {0.5, 0.0}, 0.1);
  EXPECT_EQ(profile.bound(), 3.0);
  EXPECT_EQ(profile.continuity(), 2);
  EXPECT_EQ(profile.feature_length(0), 0.5); // a quarter of a turn
  EXPECT_EQ(profile.feature_length(1), Height::unbounded);

  const Height product =
      Height::product(list(Height::sine(2.0, {1.0, 0.0}, 0.0), Height::gaussian(3.0, {0.0, 0.0}, 0.5)));
  EXPECT_EQ(product.bound(), 6.0);
  EXPECT_DOUBLE_EQ(product.feature_length(0), 1.0 / (1.0 / 0.25 + 1.0 / 0.5));
  EXPECT_DOUBLE_EQ(product.feature_length(1), 0.5);
  const Height sum = Height::sum(
      list(Height::sine(2.0, {1.0, 0.0}, 0.0), Height::map(random_map(2, MapBoundary::periodic, random))));
  EXPECT_EQ(sum.continuity(), 2);
  EXPECT_GT(sum.bound(), 2.0);
  EXPECT_EQ(Height::sum(list(Height::constant(1, 2.0), Height::constant(1, -3.0))).bound(), 5.0);
  EXPECT_EQ(sum.feature_length(0), 0.25);
  const Height nothing = Height::product(list(Height::constant(1, 0.0), Height::polynomial({0.0, 1.0})));
  EXPECT_EQ(nothing.bound(), 0.0);
  EXPECT_TRUE(Height(2).none());
  EXPECT_EQ(Height(2).bound(), 0.0);
}

// Every node has its own constant; the sum shows each is visited once and in its place.
TEST(HeightTree, NestsToItsLimitAndMovesWithItsOwner) {
  Height height = Height::constant(1, 1.0);
  double expected = 1.0;
  for (int level = 2; level <= max_height_depth; ++level) {
    std::vector<Height> parts = list(std::move(height), Height::polynomial({0.0, double(level)}));
    parts.push_back(Height::constant(1, 0.5));
    const bool sum = level % 2 == 0;
    height = sum ? Height::sum(std::move(parts)) : Height::product(std::move(parts));
    expected = sum ? expected + level * 2.0 + 0.5 : expected * (level * 2.0) * 0.5;
  }
  EXPECT_EQ(height.depth(), max_height_depth);
  const double s[1] = {2.0};
  EXPECT_EQ((evaluate_height<1, double>(height.root(), s).h), expected);
  std::vector<Height> elsewhere;
  elsewhere.push_back(std::move(height));
  elsewhere.emplace_back(2);
  EXPECT_EQ((evaluate_height<1, double>(elsewhere[0].root(), s).h), expected);

  std::vector<Height> too_deep;
  too_deep.push_back(std::move(elsewhere[0]));
  EXPECT_THROW(Height::sum(std::move(too_deep)), std::invalid_argument);
}

TEST(HeightTree, RefusesWhatMakesNoHeight) {
  EXPECT_THROW(Height(3), std::invalid_argument);
  EXPECT_THROW(Height::sine(1.0, {}, 0.0), std::invalid_argument);
  EXPECT_THROW(Height::gaussian(1.0, {0.0, 0.0, 0.0}, 1.0), std::invalid_argument);
  EXPECT_THROW(Height::polynomial(std::vector<double>{}), std::invalid_argument);
  EXPECT_THROW(Height::sum({}), std::invalid_argument);
  EXPECT_THROW(Height::product(list(Height(1), Height(2))), std::invalid_argument);
}

} // namespace
} // namespace height_tree_test
