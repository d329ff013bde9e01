// SPDX-License-Identifier: BSD-3-Clause
// Accuracy of sine, cosine and exponential against the C library's long double, exact values, and equal bits
// in every lane of a vector scalar.
#include "core/numbers/elementary.hpp"
#include "core/numbers/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "worst.hpp"

namespace elementary_test {
namespace {

using namespace ents::ENTS_ISA;

static_assert(LDBL_MANT_DIG >= 64, "the oracle needs 11 bits more than a double");
constexpr long double pi = 3.14159265358979323846264338327950288L;
constexpr int points = 1000000;

// Error in units of the last place of the exact value.
double ulps(double value, long double exact) {
  int exponent = 0;
  std::frexp(exact, &exponent);
  return static_cast<double>(std::fabs(value - exact) / std::ldexp(1.0L, exponent - 53));
}

// sin(2 pi t) with the reduction done in turns, where it is exact.
long double sine_of_turns(long double t) {
  const long double halves = std::nearbyint(2 * t);
  const long double sine = std::sin(2 * pi * (t - halves / 2));
  return std::fmod(halves, 2) == 0 ? sine : -sine;
}

class Random {
public:
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }

private:
  std::mt19937_64 generator_{20120601};
};

// f * 2 pi is rounded once (at most 1 ulp of the result, whose binade may be one lower) and the polynomials
// add less than 1: 2.
constexpr double bound_turns = 2.0;
constexpr double bound_fdlibm = 1.0; // of exp

TEST(Elementary, SineAndCosineOfTurnsAreWithinTwoUlps) {
  Random random;
  double worst = 0.0;
  for (int i = 0; i < points; ++i) {
    const double range = std::array{0.5, 1.0, 1e3, 1e9}[static_cast<std::size_t>(i % 4)];
    const double t = random(-range, range);
    double sine, cosine;
    sin_cos_turns(t, 0.0, sine, cosine);
    test::raise(worst, ulps(sine, sine_of_turns(t)));
    test::raise(worst, ulps(cosine, sine_of_turns(t + 0.25L)));
  }
  RecordProperty("worst_ulp", std::to_string(worst));
  EXPECT_LE(worst, bound_turns);
}

TEST(Elementary, ExponentialIsWithinOneUlp) {
  Random random;
  double worst = 0.0;
  for (int i = 0; i < points; ++i) {
    const double x = i % 3 == 0 ? random(-1.0, 1.0) : i % 3 == 1 ? random(-708.0, 0.0) : random(0.0, 709.7);
    test::raise(worst, ulps(exponential(x), std::exp(static_cast<long double>(x))));
  }
  RecordProperty("worst_ulp", std::to_string(worst));
  EXPECT_LE(worst, bound_fdlibm);
}

TEST(Elementary, QuarterTurnsAreExact) {
  for (const double whole : {0.0, 1.0, -1.0, 7.0, -12.0, 1e9, -1e9, 1e15}) {
    const double expected[4][2] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};
    for (int quarter = 0; quarter < 4; ++quarter) {
      double sine, cosine;
      sin_cos_turns(whole + 0.25 * quarter, 0.0, sine, cosine);
      EXPECT_EQ(sine, expected[quarter][0]) << whole << " + " << quarter << "/4";
      EXPECT_EQ(cosine, expected[quarter][1]) << whole << " + " << quarter << "/4";
    }
  }
  // Beyond 2^53 every number is a whole count of turns.
  for (const double t : {1e16, -3e17, 1e300}) {
    double sine, cosine;
    sin_cos_turns(t, 0.0, sine, cosine);
    EXPECT_EQ(sine, 0.0);
    EXPECT_EQ(cosine, 1.0);
  }
}

TEST(Elementary, WholeTurnsChangeNoBit) {
  Random random;
  for (int i = 0; i < 10000; ++i) {
    const double t = std::ldexp(std::floor(random(-1.0, 1.0) * 0x1p20), -21); // t + n is exact
    const double n = std::floor(random(-1e9, 1e9)), offset = random(-0.5, 0.5);
    double s, c, s_far, c_far;
    sin_cos_turns(t, offset, s, c);
    sin_cos_turns(t + n, offset, s_far, c_far);
    ASSERT_EQ(s, s_far) << t << " + " << n;
    ASSERT_EQ(c, c_far) << t << " + " << n;
  }
}

TEST(Elementary, ExponentialAtItsEnds) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(exponential(0.0), 1.0);
  EXPECT_EQ(exponential(-0.0), 1.0);
  EXPECT_EQ(exponential(-708.5), 0.0);
  EXPECT_EQ(exponential(-1e308), 0.0);
  EXPECT_EQ(exponential(-infinity), 0.0);
  EXPECT_GE(exponential(-708.0), std::numeric_limits<double>::min());
  EXPECT_TRUE(std::isfinite(exponential(709.78)));
  EXPECT_EQ(exponential(709.79), infinity);
  EXPECT_EQ(exponential(infinity), infinity);
  EXPECT_TRUE(std::isnan(exponential(std::nan(""))));
}

TEST(Elementary, NaNStaysNaN) {
  double sine, cosine;
  sin_cos_turns(std::nan(""), 0.25, sine, cosine);
  EXPECT_TRUE(std::isnan(sine) && std::isnan(cosine));
  EXPECT_TRUE(std::isnan(clamp(std::nan(""), -1.0, 1.0)));
  EXPECT_EQ(clamp_not_nan(std::nan(""), -1.0, 1.0), -1.0);
}

TEST(Elementary, RoundingToIntegers) {
  for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.5, -0.25, -0.5, -1.0, -1.5, 1e9 + 0.5, -1e9 - 0.75,
                         0x1p50 - 0.25}) {
    EXPECT_EQ(nearest_integer(x), std::nearbyint(x)) << x;
    EXPECT_EQ(round_down(x), std::floor(x)) << x;
  }
  for (int n = -1022; n <= 1023; ++n) EXPECT_EQ(power_of_two(double(n)), std::ldexp(1.0, n));
}

TEST(Elementary, DualNumbersCarryTheDerivative) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const Dual<double> x{random(-3.0, 3.0), random(-2.0, 2.0)};
    Dual<double> sine, cosine;
    sin_cos_turns(x, 0.125, sine, cosine);
    EXPECT_EQ(sine.d, cosine.v * (two_pi * x.d));
    EXPECT_EQ(cosine.d, -sine.v * (two_pi * x.d));
    const Dual<double> e = exponential(x);
    EXPECT_EQ(e.v, exponential(x.v));
    EXPECT_EQ(e.d, e.v * x.d);
  }
}

#if defined(ENTS_HAS_LANES)
TEST(Elementary, EveryLaneHasTheBitsOfThePlainNumber) {
  constexpr int W = 2;
  Random random;
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  for (int i = 0; i < 100000; ++i) {
    const double offset = random(-0.5, 0.5);
    Lanes<W> x;
    for (int k = 0; k < W; ++k)
      x.v[k] = random(-1.0, 1.0) * std::array{1.0, 30.0, 700.0, 1e6}[std::size_t(i + k) % 4];
    Lanes<W> s_turns, c_turns;
    sin_cos_turns(x, offset, s_turns, c_turns);
    const Lanes<W> e = exponential(x);
    for (int k = 0; k < W; ++k) {
      double sine, cosine;
      sin_cos_turns(lane(x, k), offset, sine, cosine);
      ASSERT_EQ(bits(sine), bits(lane(s_turns, k)));
      ASSERT_EQ(bits(cosine), bits(lane(c_turns, k)));
      ASSERT_EQ(bits(exponential(lane(x, k))), bits(lane(e, k)));
    }
  }
}
#endif

} // namespace
} // namespace elementary_test
