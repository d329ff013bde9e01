// SPDX-License-Identifier: BSD-3-Clause
// Height functions: values against their definitions, derivatives up to the third by Taylor remainders that
// fall at their order, and equal bits in every lane.
#include "core/height/height.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/height/height_map.hpp"
#include "core/height/height_tree.hpp"
#include "random_heights.hpp"
#include "worst.hpp"

namespace height_test {
namespace {

using namespace ents;
using namespace ents::ENTS_ISA;
using test::list;
using test::Random;
using test::random_map;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double pi = 3.14159265358979323846;

// A height, and its value written down from the definition with the C library.
struct Case {
  std::string name;
  Height height;
  std::function<double(const double*)> value;
};

double gaussian_value(double amplitude, double c1, double c2, double width, double s1, double s2) {
  return amplitude * std::exp(-((s1 - c1) * (s1 - c1) + (s2 - c2) * (s2 - c2)) / (2 * width * width));
}

// Amplitudes, lengths and coefficients of order 1, so that all derivatives are.
std::vector<Case> smooth_cases_1() {
  const auto sine = [](const double* s) { return 0.8 * std::sin(2 * pi * 0.3 * s[0] + 0.7); };
  const auto gaussian = [](const double* s) { return gaussian_value(-1.1, 0.2, 0, 0.9, s[0], 0); };
  std::vector<Case> cases;
  cases.push_back({"none", Height(1), [](const double*) { return 0.0; }});
  cases.push_back({"constant", Height::constant(1, -0.4), [](const double*) { return -0.4; }});
  cases.push_back({"sine", Height::sine(0.8, {0.3}, 0.7), sine});
  cases.push_back({"polynomial", Height::polynomial({0.1, -0.2, 0.3, 0.4, -0.5, 0.1}), [](const double* s) {
                     const double x = s[0];
                     return 0.1 - 0.2 * x + 0.3 * x * x + 0.4 * x * x * x - 0.5 * std::pow(x, 4) +
                            0.1 * std::pow(x, 5);
                   }});
  cases.push_back({"gaussian", Height::gaussian(-1.1, {0.2}, 0.9), gaussian});
  cases.push_back({"sum",
                   Height::sum(list(Height::sine(0.8, {0.3}, 0.7), Height::gaussian(-1.1, {0.2}, 0.9))),
                   [=](const double* s) { return sine(s) + gaussian(s); }});
  cases.push_back({"product",
                   Height::product(list(Height::sine(0.8, {0.3}, 0.7), Height::gaussian(-1.1, {0.2}, 0.9))),
                   [=](const double* s) { return sine(s) * gaussian(s); }});
  return cases;
}

std::vector<Case> smooth_cases_2() {
  const auto sine = [](const double* s) { return 0.8 * std::sin(2 * pi * (0.3 * s[0] - 0.2 * s[1]) + 0.7); };
  const auto gaussian = [](const double* s) { return gaussian_value(-1.1, 0.2, -0.3, 0.9, s[0], s[1]); };
  const auto polynomial = [](const double* s) {
    const double x = s[0], y = s[1];
    return 0.1 - 0.2 * y + 0.3 * y * y + x * (0.4 + 0.5 * y) +
           x * x * (-0.6 + 0.7 * y - 0.8 * y * y + 0.9 * y * y * y) + 0.2 * x * x * x;
  };
  const auto make_polynomial = [] {
    return Height::bivariate_polynomial({{0.1, -0.2, 0.3}, {0.4, 0.5}, {-0.6, 0.7, -0.8, 0.9}, {0.2}});
  };
  std::vector<Case> cases;
  cases.push_back({"none", Height(2), [](const double*) { return 0.0; }});
  cases.push_back({"constant", Height::constant(2, -0.4), [](const double*) { return -0.4; }});
  cases.push_back({"sine", Height::sine(0.8, {0.3, -0.2}, 0.7), sine});
  cases.push_back({"polynomial", make_polynomial(), polynomial});
  cases.push_back({"gaussian", Height::gaussian(-1.1, {0.2, -0.3}, 0.9), gaussian});
  cases.push_back(
      {"sum of product and product",
       Height::sum(list(Height::product(list(make_polynomial(), Height::sine(0.8, {0.3, -0.2}, 0.7))),
                        Height::product(list(Height::gaussian(-1.1, {0.2, -0.3}, 0.9), make_polynomial())))),
       [=](const double* s) { return polynomial(s) * sine(s) + gaussian(s) * polynomial(s); }});
  return cases;
}

template <int T> void expect_definition(const std::vector<Case>& cases) {
  Random random;
  for (const Case& c : cases)
    for (int i = 0; i < 1000; ++i) {
      double s[T];
      for (double& x : s) x = random(-1.5, 1.5);
      // A dozen roundings of terms below 20 (the polynomials at |s| = 1.5), in each of the two evaluations.
      EXPECT_NEAR((evaluate_height<T, double>(c.height.root(), s).h), c.value(s), 2 * 12 * 20 * eps)
          << c.name;
    }
}

TEST(Height, ValuesFollowTheDefinitionIn2D) { expect_definition<1>(smooth_cases_1()); }
TEST(Height, ValuesFollowTheDefinitionIn3D) { expect_definition<2>(smooth_cases_2()); }

constexpr int pair_index(int a, int b) { return a + b; } // 11, 12, 22

// h at s + t direction: value, gradient and Hessian, and what the derivatives at s predict for them.
template <int T> struct Remainder { double value = 0.0, gradient = 0.0, hessian = 0.0; };

template <int T>
Remainder<T> taylor_remainder(const HeightNode& root, const double (&s)[T], const double (&direction)[T],
                              double t) {
  Dual<double> dual[T];
  double moved[T];
  for (int a = 0; a < T; ++a) {
    dual[a] = {s[a], direction[a]};
    moved[a] = s[a] + t * direction[a];
  }
  const HeightJet<T, double> at = evaluate_height(root, s), there = evaluate_height(root, moved);
  const HeightJet<T, Dual<double>> rate = evaluate_height(root, dual);

  Remainder<T> r;
  double d1 = 0.0, d2 = 0.0, d3 = 0.0; // derivatives of h along the direction
  for (int a = 0; a < T; ++a) {
    d1 += at.h1[a] * direction[a];
    double predicted = at.h1[a];
    for (int b = 0; b < T; ++b) {
      const int k = pair_index(a, b);
      d2 += direction[a] * at.h2[k] * direction[b];
      d3 += direction[a] * rate.h2[k].d * direction[b];
      predicted += t * at.h2[k] * direction[b] + t * t / 2 * rate.h2[k].d * direction[b];
      test::raise(r.hessian, std::fabs(there.h2[k] - at.h2[k] - t * rate.h2[k].d));
    }
    test::raise(r.gradient, std::fabs(there.h1[a] - predicted));
  }
  r.value = std::fabs(there.h - (at.h + t * d1 + t * t / 2 * d2 + t * t * t / 6 * d3));
  return r;
}

// The remainders fall like t^4, t^3, t^2: measured between t = 2^-3 and t = 2^-6, in the mean over many
// points (single points lie near zeros of the next derivative).
template <int T> void expect_taylor(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    Remainder<T> sum[2];
    Random random(7);
    for (int i = 0; i < 500; ++i) {
      double s[T], direction[T];
      for (double& x : s) x = random(-1.0, 1.0);
      for (double& x : direction) x = random(-1.0, 1.0);
      for (int level = 0; level < 2; ++level) {
        const Remainder<T> r = taylor_remainder(c.height.root(), s, direction, level == 0 ? 0x1p-3 : 0x1p-6);
        sum[level].value += r.value;
        sum[level].gradient += r.gradient;
        sum[level].hessian += r.hessian;
      }
    }
    const auto expect_order = [&](double coarse, double fine, double order, const char* what) {
      // 500 points with a dozen roundings of terms below 20; then there is no slope to see (constants).
      if (coarse < 500 * 12 * 20 * eps) return;
      // The next term of the series is at most t = 1/8 of the leading one, times a ratio of derivatives of
      // 2 pi wave_vector ~ 2 or degree ~ 4: it can bend the slope by log2(1 + 4/8)/3 = 0.2.
      EXPECT_NEAR(std::log2(coarse / fine) / 3.0, order, 0.2) << c.name << ", " << what;
    };
    expect_order(sum[0].value, sum[1].value, 4.0, "h");
    expect_order(sum[0].gradient, sum[1].gradient, 3.0, "gradient");
    expect_order(sum[0].hessian, sum[1].hessian, 2.0, "Hessian");
  }
}

TEST(Height, DerivativesFollowTaylorIn2D) { expect_taylor<1>(smooth_cases_1()); }
TEST(Height, DerivativesFollowTaylorIn3D) { expect_taylor<2>(smooth_cases_2()); }

template <int T> void expect_dual_parts(const std::vector<Case>& cases) {
  Random random(3);
  for (const Case& c : cases)
    for (int i = 0; i < 200; ++i) {
      double s[T];
      Dual<double> dual[T];
      for (int a = 0; a < T; ++a) {
        s[a] = random(-1.0, 1.0);
        dual[a] = {s[a], random(-1.0, 1.0)};
      }
      const HeightJet<T, double> plain = evaluate_height(c.height.root(), s);
      const HeightJet<T, Dual<double>> jet = evaluate_height(c.height.root(), dual);
      EXPECT_EQ(jet.h.v, plain.h) << c.name;
      double h_d = 0.0;
      for (int a = 0; a < T; ++a) {
        EXPECT_EQ(jet.h1[a].v, plain.h1[a]) << c.name;
        h_d += plain.h1[a] * dual[a].d;
        double h1_d = 0.0;
        for (int b = 0; b < T; ++b) h1_d += plain.h2[pair_index(a, b)] * dual[b].d;
        // As in expect_definition; second derivatives reach (2 pi 0.3)^2 = 4 times the value, 20 for the
        // polynomial.
        EXPECT_NEAR(jet.h1[a].d, h1_d, 2 * 12 * 144 * eps) << c.name;
      }
      EXPECT_NEAR(jet.h.d, h_d, 2 * 12 * 144 * eps) << c.name;
      for (int k = 0; k < T * (T + 1) / 2; ++k) EXPECT_EQ(jet.h2[k].v, plain.h2[k]) << c.name;
    }
}

// Spacings of 1/2 and samples of order 1: second derivatives of a map reach 9 * 4 / (1/2)^2 = 144, those of
// the profile 4 / (0.3)^2.
std::vector<Case> with_maps(std::vector<Case> cases, std::int32_t dimension) {
  Random random(9);
  std::vector<double> coefficients;
  for (int i = 0; i < 7; ++i) coefficients.push_back(random(-1.0, 1.0));
  cases.push_back(
      {"profile",
       Height::profile(coefficients, dimension == 1 ? std::vector{0.4} : std::vector{-0.3, 0.4}, 0.7),
       {}});
  for (const MapBoundary boundary : {MapBoundary::periodic, MapBoundary::clamped})
    cases.push_back({"map", Height::map(random_map(dimension, boundary, random)), {}});
  return cases;
}

TEST(Height, DualNumbersAgreeWithTheDerivativesIn2D) { expect_dual_parts<1>(with_maps(smooth_cases_1(), 1)); }
TEST(Height, DualNumbersAgreeWithTheDerivativesIn3D) { expect_dual_parts<2>(with_maps(smooth_cases_2(), 2)); }

#if defined(ENTS_HAS_LANES)
template <int T> void expect_equal_lanes(const std::vector<Case>& cases) {
  constexpr int W = 2;
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  Random random(5);
  for (const Case& c : cases)
    for (int i = 0; i < 1000; ++i) {
      Lanes<W> s[T];
      for (Lanes<W>& x : s)
        for (int k = 0; k < W; ++k) x.v[k] = random(-6.0, 6.0);
      const HeightJet<T, Lanes<W>> jet = evaluate_height(c.height.root(), s);
      for (int k = 0; k < W; ++k) {
        double one[T];
        for (int a = 0; a < T; ++a) one[a] = lane(s[a], k);
        const HeightJet<T, double> plain = evaluate_height(c.height.root(), one);
        ASSERT_EQ(bits(lane(jet.h, k)), bits(plain.h)) << c.name;
        for (int a = 0; a < T; ++a) ASSERT_EQ(bits(lane(jet.h1[a], k)), bits(plain.h1[a])) << c.name;
        for (int m = 0; m < T * (T + 1) / 2; ++m)
          ASSERT_EQ(bits(lane(jet.h2[m], k)), bits(plain.h2[m])) << c.name;
      }
    }
}

TEST(Height, EveryLaneHasTheBitsOfThePlainNumber) {
  expect_equal_lanes<1>(with_maps(smooth_cases_1(), 1));
  expect_equal_lanes<2>(with_maps(smooth_cases_2(), 2));
}
#endif

TEST(Height, SineKeepsItsShapeOverABillionWaves) {
  const Height near = Height::sine(1.0, {1.0}, 0.3), far = Height::sine(1.0, {1e9}, 0.3);
  for (int i = 0; i <= 64; ++i) {
    const double part = i / 64.0;
    const double s_near[1] = {part}, s_far[1] = {(1e9 - 1.0 + part) / 1e9 + 0.0};
    // s has a relative rounding of eps/2, so the argument 1e9 s one of 1e9 eps turns.
    EXPECT_NEAR((evaluate_height<1, double>(far.root(), s_far).h),
                (evaluate_height<1, double>(near.root(), s_near).h), 2 * pi * 1e9 * eps);
    // Whole counts are exact: no error at all.
    const double whole[1] = {static_cast<double>(i) / 64.0 * 64.0};
    const double zero[1] = {0.0};
    EXPECT_EQ((evaluate_height<1, double>(far.root(), whole).h),
              (evaluate_height<1, double>(far.root(), zero).h));
  }
}

TEST(Height, SineTakesAnyPhase) {
  const double s[1] = {0.3};
  for (const double phase : {-3.0, 7.0, 100.0, -1e6}) // in turns it has one more rounding
    EXPECT_NEAR((evaluate_height<1, double>(Height::sine(1.0, {1.0}, phase).root(), s).h),
                std::sin(2 * pi * 0.3 + phase), (std::fabs(phase) + 8) * eps);
}

TEST(Height, GaussianIsZeroFarAway) {
  const Height height = Height::gaussian(1.0, {0.0, 0.0}, 1.0);
  for (const double x : {41.0, -1e5, 1e154, 1e308, -1e308}) {
    const double s[2] = {x, 0.5};
    const HeightJet<2, double> jet = evaluate_height(height.root(), s);
    EXPECT_EQ(jet.h, 0.0);
    for (const double d : jet.h1) EXPECT_EQ(d, 0.0);
    for (const double d : jet.h2) EXPECT_EQ(d, 0.0);
  }
}

TEST(Height, NaNIsNeverHidden) {
  Random random(2);
  std::vector<Height> heights;
  heights.push_back(Height::sine(1.0, {1.0, 2.0}, 0.0));
  heights.push_back(Height::bivariate_polynomial({{0.0, 1.0}, {1.0}}));
  heights.push_back(Height::gaussian(1.0, {0.0, 0.0}, 1.0));
  heights.push_back(Height::map(random_map(2, MapBoundary::periodic, random)));
  heights.push_back(Height::map(random_map(2, MapBoundary::clamped, random)));
  heights.push_back(Height::profile({0.0, 1.0, 0.5}, {0.5, 2.0}, 0.0));
  for (const Height& height : heights)
    for (int a = 0; a < 2; ++a) {
      double s[2] = {0.25, 0.75};
      s[a] = std::numeric_limits<double>::quiet_NaN();
      EXPECT_TRUE(std::isnan(evaluate_height(height.root(), s).h));
    }
}

} // namespace
} // namespace height_test
