// SPDX-License-Identifier: BSD-3-Clause
// A sine along an iteration: moved from point to point it stays the sine, and every lane moves as the number
// alone.
#include "core/height/moving_height.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "worst.hpp"

namespace moving_sine_test {
namespace {

using namespace ents;
using namespace ents::ENTS_ISA;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr Sine<double> sine = {0.75, {1.0, 0.0}, 0.0625};

// As an iteration goes: from a first point by steps that are far, next to it, at the border of both, tiny,
// none.
double step(std::mt19937_64& generator, int i) {
  constexpr double sizes[] = {0.4, 1e-2, reuse_radius_turns, 1e-5, 1e-9, 1e-14, 0.0};
  std::uniform_real_distribution<double> part(0.98, 1.02);
  const double size = sizes[(generator() + static_cast<std::uint64_t>(i)) % 7] * part(generator);
  return generator() % 2 ? size : -size;
}

TEST(MovedSine, IsTheSine) {
  std::mt19937_64 generator(1);
  double h_error = 0.0, slope_error = 0.0; // in units of the amplitude's last place
  for (int walk = 0; walk < 20000; ++walk) {
    SineAt<double> at;
    double turns = std::uniform_real_distribution<double>(-2.0, 2.0)(generator);
    for (int i = 0; i < 8; ++i) { // most_projection_steps
      move_sine(at, sine, turns);
      double s, c;
      sin_cos_turns(turns, sine.phase, s, c);
      test::raise(h_error, std::fabs(at.h - sine.amplitude * s) / (sine.amplitude * eps));
      test::raise(slope_error, std::fabs(at.slope - sine.amplitude * c) / (sine.amplitude * eps));
      turns += step(generator, i);
    }
  }
  EXPECT_LT(h_error, 6.0);
  EXPECT_LT(slope_error, 6.0);
}

TEST(MovedSine, WhoDoesNotMoveKeepsItsBits) {
  for (const double turns : {0.0, 0.1, -0.0625, 0.5, 17.3}) {
    SineAt<double> at;
    move_sine(at, sine, turns);
    const SineAt<double> before = at;
    move_sine(at, sine, turns);
    EXPECT_EQ(at.h, before.h) << turns;
    EXPECT_EQ(at.slope, before.slope) << turns;
  }
}

TEST(MovedSine, IsNoNumberWhereItsPlaceIsNone) {
  SineAt<double> at;
  for (const double turns : {0.3, std::nan("")}) move_sine(at, sine, turns);
  EXPECT_TRUE(std::isnan(at.h) && std::isnan(at.slope));
}

#if defined(ENTS_HAS_LANES)
TEST(MovedSine, EveryLaneMovesAsTheNumberAlone) {
  constexpr int W = 2;
  std::mt19937_64 generator(2);
  int mixed = 0; // one lane next to where it was, the other not
  for (int walk = 0; walk < 2000; ++walk) {
    SineAt<Lanes<W>> together;
    SineAt<double> alone[W];
    double turns[W] = {0.3, -1.7};
    for (int i = 0; i < 8; ++i) {
      Lanes<W> all;
      for (int k = 0; k < W; ++k) {
        all.v[k] = turns[k];
        move_sine(alone[k], sine, turns[k]);
      }
      move_sine(together, sine, all);
      for (int k = 0; k < W; ++k) {
        const double h = lane(together.h, k), slope = lane(together.slope, k);
        ASSERT_EQ(std::memcmp(&h, &alone[k].h, sizeof h), 0) << turns[k];
        ASSERT_EQ(std::memcmp(&slope, &alone[k].slope, sizeof slope), 0) << turns[k];
      }
      double steps[W];
      for (int k = 0; k < W; ++k) turns[k] += steps[k] = step(generator, i + k);
      mixed += (std::fabs(steps[0]) < reuse_radius_turns) != (std::fabs(steps[1]) < reuse_radius_turns);
    }
  }
  EXPECT_GT(mixed, 1000);
}
#endif

} // namespace
} // namespace moving_sine_test
