// SPDX-License-Identifier: BSD-3-Clause
// Heights written as expressions: the built-in heights again, ranges that enclose what they should, equal
// bits for any number of points a call, and what is said of wrong texts.
#include "abi/read/expression_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "abi/read/model_error.hpp"
#include "core/height/expression_steps.hpp"
#include "core/projection/ball.hpp"

namespace expression_test {
namespace {

using namespace ents;
using namespace ents::ENTS_ISA;

constexpr double infinity = std::numeric_limits<double>::infinity();

Height expression(const std::string& text, int dimension, std::vector<NamedNumber> constants = {},
                  std::vector<NamedNumber> parameters = {}) {
  const double estimated[2] = {infinity, infinity};
  return read_expression(text, "h", {dimension, std::move(constants), std::move(parameters)}, estimated);
}

// Height's numbers up to the third derivatives, by dual numbers along both coordinates
std::vector<double> all_numbers(const Height& height, const double* at) {
  if (height.dimension() == 1) {
    const Dual<double> s[1] = {{at[0], 1.0}};
    const HeightJet<1, Dual<double>> j = evaluate_height(height.root(), s);
    return {j.h.v, j.h1[0].v, j.h2[0].v, j.h2[0].d};
  }
  const Dual<double> s[2] = {{at[0], 1.0}, {at[1], 0.0}}, t[2] = {{at[0], 0.0}, {at[1], 1.0}};
  const HeightJet<2, Dual<double>> j = evaluate_height(height.root(), s),
                                   k = evaluate_height(height.root(), t);
  return {j.h.v,     j.h1[0].v, j.h1[1].v, j.h2[0].v, j.h2[1].v,
          j.h2[2].v, j.h2[0].d, j.h2[1].d, j.h2[2].d, k.h2[2].d};
}

TEST(Expression, IsTheBuiltInHeight) {
  double largest = 0.0;
  struct Pair {
    Height built_in, written;
  };
  const auto parts = [](Height a, Height b) {
    std::vector<Height> list;
    list.push_back(std::move(a));
    list.push_back(std::move(b));
    return list;
  };
  const std::string sine = "0.8*sin(2*pi*(0.3*u - 0.2*v) + 0.7)",
                    gaussian = "-1.1*exp(-((u - 0.2)^2 + (v + 0.3)^2)/(2*0.9^2))";
  const std::string polynomial =
      "0.1 - 0.2*v + 0.3*v^2 + u*(0.4 + 0.5*v) + u^2*(-0.6 + 0.7*v - 0.8*v^2 + 0.9*v^3) + 0.2*u^3";
  const auto make_sine = [] { return Height::sine(0.8, {0.3, -0.2}, 0.7); };
  const auto make_gaussian = [] { return Height::gaussian(-1.1, {0.2, -0.3}, 0.9); };
  const auto make_polynomial = [] {
    return Height::bivariate_polynomial({{0.1, -0.2, 0.3}, {0.4, 0.5}, {-0.6, 0.7, -0.8, 0.9}, {0.2}});
  };
  std::vector<Pair> pairs;
  pairs.push_back(
      {Height::sine(0.8, {0.3}, 0.7), expression("a*sin(2*pi*k*u + 0.7)", 1, {{"a", 0.8}, {"k", 0.3}})});
  pairs.push_back({Height::polynomial({0.1, -0.2, 0.3, 0.4, -0.5, 0.1}),
                   expression("0.1-0.2*u+0.3*u^2+0.4*u^3-0.5*u^4+0.1*u^5", 1)});
  pairs.push_back({Height::gaussian(-1.1, {0.2}, 0.9), expression("-1.1*exp(-((u-0.2)/0.9)^2/2)", 1)});
  pairs.push_back({Height::constant(1, -0.4), expression("-0.4", 1)});
  pairs.push_back({make_sine(), expression(sine, 2)});
  pairs.push_back({make_gaussian(), expression(gaussian, 2)});
  pairs.push_back({make_polynomial(), expression(polynomial, 2)});
  pairs.push_back({Height::sum(parts(make_sine(), make_gaussian())), expression(sine + " + " + gaussian, 2)});
  pairs.push_back({Height::product(parts(make_sine(), make_polynomial())),
                   expression(sine + "*(" + polynomial + ")", 2)});
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (const Pair& pair : pairs) {
    const std::size_t numbers = pair.built_in.dimension() == 1 ? 4 : 10;
    std::vector<double> worst(numbers, 0.0), size(numbers, 0.0);
    for (int n = 0; n < 2000; ++n) {
      const double s[2] = {place(random), place(random)};
      const std::vector<double> a = all_numbers(pair.built_in, s), b = all_numbers(pair.written, s);
      for (std::size_t i = 0; i < numbers; ++i) {
        worst[i] = std::max(worst[i], std::fabs(a[i] - b[i]));
        size[i] = std::max(size[i], std::fabs(a[i]));
      }
    }
    for (std::size_t i = 0; i < numbers; ++i) {
      EXPECT_LE(worst[i], 1e-13 * size[i]) << "number " << i << " of pair " << &pair - pairs.data();
      if (worst[i] > 0.0) largest = std::max(largest, worst[i] / size[i]);
    }
    EXPECT_EQ(pair.written.continuity(), Height::smooth);
  }
  std::printf("%zu heights, largest relative difference %.2g\n", pairs.size(), largest);
}

// Expressions that use every function, and coordinates in every combination
const char* const texts[] = {
    "0.01*sin(2*pi*u)",
    "sin(3*u + 4*v)*cos(u - v)",
    "exp(-u^2)*tanh(3*v)",
    "1/(1 + u^2 + v^2)",
    "sqrt(1 + u^2 + 0.5*v)",
    "(2 + u)^1.5*(3 + v)^0.3",
    "log(3 + u + v)*atan(2*u*v)",
    "asin(0.4*u)*acos(0.3*v)",
    "sinh(u)*cosh(v) - tan(0.5*u)",
    "u^5 - 3*u^2*v + v^3 - u/(4 + v)",
    "(u - v)^-2 + (u + v + 5)^-3",
    "e^(u*v) + pi*v",
    "((u + 3)^-0.5 + (v^2 + 1)^2.5)*cos(cos(u))",
    "sin(u)*sin(u) + sin(u)*v",
    "v",
    "sin(v)/(2 + cos(v))",
    "bump(u/1.2)*bump(v - 0.5) + u",
};

TEST(Expression, HasTheSameBitsForAnyNumberOfPoints) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (const char* text : texts) {
    const Height height = expression(text, 2);
    const ExternalHeight& external = height.root().external;
    for (int n = 0; n < 50; ++n) {
      double s[2][8], alone[10][8];
      for (int k = 0; k < 8; ++k) {
        double jet[10];
        const double at[2] = {s[0][k] = place(random), s[1][k] = place(random)};
        external.jets(external, 3, 1, at, jet);
        for (int i = 0; i < 10; ++i) alone[i][k] = jet[i];
        double slots[Expression::most_slots][Expression::coefficients]; // the portable instruction set
        const Expression& program = *static_cast<const Expression*>(external.data);
        run_expression<3>(program, external.values, at, slots, [](const ExpressionStep&) {});
        derivatives_of<3>(program, program.steps.back().shape, slots[program.result], jet);
        for (int i = 0; i < 10; ++i)
          ASSERT_EQ(std::bit_cast<std::uint64_t>(jet[i]), std::bit_cast<std::uint64_t>(alone[i][k])) << text;
      }
      for (int count = 1; count <= 8; ++count)
        for (const int order : {2, 3}) {
          const int numbers = order == 2 ? 6 : 10;
          double at[16], jet[80];
          for (int a = 0; a < 2; ++a)
            for (int k = 0; k < count; ++k) at[a * count + k] = s[a][k];
          external.jets(external, order, count, at, jet);
          for (int i = 0; i < numbers; ++i)
            for (int k = 0; k < count; ++k)
              ASSERT_TRUE(std::bit_cast<std::uint64_t>(jet[i * count + k]) ==
                              std::bit_cast<std::uint64_t>(alone[i][k]) ||
                          (std::isnan(jet[i * count + k]) && std::isnan(alone[i][k])))
                  << text << " number " << i << " of " << count << " points, order " << order;
        }
    }
  }
}

// What `ranges` promises, and the ball that a search makes of it
TEST(Expression, RangesEncloseDenseSamples) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-1.5, 1.5), size(-5.0, 0.0);
  double narrowest = 1.0; // largest change of h in the box over the width of its range
  for (const char* text : texts) {
    const Height height = expression(text, 2);
    const ExternalHeight& external = height.root().external;
    for (int n = 0; n < 60; ++n) {
      const double centre[2] = {place(random), place(random)},
                   half[2] = {std::pow(10.0, size(random)), std::pow(10.0, size(random))};
      const double low[2] = {centre[0] - half[0], centre[1] - half[1]},
                   high[2] = {centre[0] + half[0], centre[1] + half[1]};
      double least[10], most[10];
      external.ranges(external, low, high, least, most);
      const Ball box[2] = {{centre[0], half[0]}, {centre[1], half[1]}};
      const HeightJet<2, Ball> ball = evaluate_height(height.root(), box);
      const Ball balls[6] = {ball.h, ball.h1[0], ball.h1[1], ball.h2[0], ball.h2[1], ball.h2[2]};
      double smallest = infinity, largest = -infinity;
      constexpr int grid = 20;
      for (int i = 0; i <= grid; ++i)
        for (int j = 0; j <= grid; ++j) {
          const double s[2] = {std::clamp(low[0] + i * (high[0] - low[0]) / grid, low[0], high[0]),
                               std::clamp(low[1] + j * (high[1] - low[1]) / grid, low[1], high[1])};
          double jet[10];
          external.jets(external, 3, 1, s, jet);
          for (int k = 0; k < 10; ++k)
            ASSERT_TRUE(std::isnan(jet[k]) || (least[k] <= jet[k] && jet[k] <= most[k]))
                << text << " number " << k << " at " << s[0] << ", " << s[1];
          for (int k = 0; k < 6; ++k) { // radii hold up to rounding
            const double rounding = 1e-12 * (std::fabs(jet[k]) + std::fabs(balls[k].v));
            ASSERT_TRUE(std::isnan(jet[k]) || std::fabs(jet[k] - balls[k].v) <= balls[k].r + rounding)
                << text << " ball " << k;
          }
          smallest = std::fmin(smallest, jet[0]), largest = std::fmax(largest, jet[0]);
        }
      // small boxes: the range is nearly what h takes there
      if (half[0] < 1e-3 && half[1] < 1e-3 && ball.h.r < 1.0)
        narrowest = std::min(narrowest, (largest - smallest + 1e-9) / (2.0 * ball.h.r + 1e-9));
    }
  }
  EXPECT_GT(narrowest, 0.3);
}

TEST(Expression, BoundsAndLengthsAreFound) {
  const auto look = [](const char* text, double bound, double length_1, double length_2) {
    const Height height = expression(text, 2);
    EXPECT_TRUE(height.bound() == bound || std::fabs(height.bound() - bound) < 1e-12 * bound)
        << text << ": " << height.bound();
    EXPECT_TRUE(height.feature_length(0) == length_1 ||
                std::fabs(height.feature_length(0) - length_1) < 1e-6 * length_1)
        << text << ": " << height.feature_length(0);
    EXPECT_TRUE(height.feature_length(1) == length_2 ||
                std::fabs(height.feature_length(1) - length_2) < 1e-6 * length_2)
        << text << ": " << height.feature_length(1);
  };
  look("0.01*sin(2*pi*u)", 0.01, 0.25, infinity);
  look("0.01*sin(2*pi*u)*cos(4*pi*u + v)", 0.01, 1.0 / (4.0 + 8.0), 0.5 * 3.14159265358979324);
  look("0.1*exp(-(u^2 + v^2)/(2*0.1^2))", 0.1, 0.1, 0.1);
  look("1/(1 + u^2)", 1.0, std::sqrt(0.5), infinity);
  look("u*v", infinity, infinity, infinity);
  look("0.2*tanh(5*v)", 0.2, infinity, 0.2);
  look("u*exp(-u^2)", infinity, std::sqrt(0.5),
       infinity); // intervals do not see that the factors are one number's
  look("sin(100*u) + 0.5*cos(v)", 1.5, 0.01 * 0.5 * 3.14159265358979324, 0.5 * 3.14159265358979324);
}

TEST(Expression, IsNoNumberWhereItIsNotDefined) {
  for (const auto& [text, u] : {std::pair("1/u", 0.0),
                                {"log(u)", -1.0},
                                {"sqrt(u)", -1.0},
                                {"asin(u)", 1.5},
                                {"u^0.3", -0.5},
                                {"(u-1)^-2", 1.0}}) {
    const Height height = expression(text, 1);
    double jet[4];
    height.root().external.jets(height.root().external, 3, 1, &u, jet);
    EXPECT_FALSE(std::isfinite(jet[0]) && std::isfinite(jet[1])) << text;
    const Ball box[1] = {{u, 0.25}};
    const HeightJet<1, Ball> ball = evaluate_height(height.root(), box);
    EXPECT_GE(ball.h.r, no_bound) << text << ": a search would take it for a height";
  }
}

TEST(Expression, ParametersAreReadFromTheValuesOfTheNode) {
  const Height height = expression("t*sin(w*u) + t^2", 1, {}, {{"t", 0.5}, {"w", 3.0}});
  HeightNode copy = height.root();
  const std::vector<double> table(height.root().external.values, height.root().external.values + 3);
  EXPECT_EQ(table[0], 0.5);
  EXPECT_EQ(table[1], 3.0);
  const double other[] = {0.25, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  std::vector<double> values(other, other + 8);
  for (std::size_t i = 2; i < 5; ++i) values[i] = height.root().external.values[i];
  copy.external.values = values.data();
  const double s[1] = {0.3};
  EXPECT_NEAR((evaluate_height<1, double>(height.root(), s).h), 0.5 * std::sin(0.9) + 0.25, 1e-15);
  EXPECT_NEAR((evaluate_height<1, double>(copy, s).h), 0.25 * std::sin(0.6) + 0.0625, 1e-15);
}

// By central differences of two steps, extrapolated; three numbers of each: h, h_1, h_11
TEST(Expression, DerivativesByParametersAreThoseOfDifferences) {
  for (const char* text :
       {"t*sin(w*u) + t^2", "exp(-t*u)/(1 + w^2*u^2)", "sqrt(w + u*t)*cos(t*w)", "(t + u^2)^w",
        "tanh(w*u - t)*atan(t*u) + asin(0.3*t*u)", "log(w + sinh(t*u)^2)*cosh(w)*tan(0.2*t*u)",
        "bump(t*u + 0.1*w)*acos(0.2*w)", "(t - w*u)^3/(w + t)^0.5", "u"}) {
    const Height height = expression(text, 1, {}, {{"t", 0.6}, {"w", 1.3}});
    const ExternalHeight& external = height.root().external;
    ASSERT_EQ(external.parameter_count, 2) << text;
    for (const double s : {-0.7, 0.25, 0.9})
      for (int p = 0; p < 2; ++p) {
        double rate[3], difference[2][3];
        external.rates(external, p, &s, rate);
        for (const int half : {0, 1}) {
          const double step = half ? 5e-4 : 1e-3;
          double jet[2][4];
          for (const int side : {0, 1}) {
            std::vector<double> values(external.values, external.values + external.value_count);
            values[static_cast<std::size_t>(p)] += side ? step : -step;
            ExternalHeight moved = external;
            moved.values = values.data();
            moved.jets(moved, 2, 1, &s, jet[side]);
          }
          for (int i = 0; i < 3; ++i) difference[half][i] = (jet[1][i] - jet[0][i]) / (2.0 * step);
        }
        for (int i = 0; i < 3; ++i) {
          const double best =
              (4.0 * difference[1][i] - difference[0][i]) / 3.0; // error: step^4, rounding / step
          EXPECT_NEAR(rate[i], best, 1e-9 * (1.0 + std::fabs(best)))
              << text << " number " << i << " by parameter " << p << " at " << s;
        }
      }
  }
}

TEST(Expression, WrongTextsAreRefusedWithTheColumn) {
  const std::string operand = "expected a number, a name, a function, \"-\" or \"(\"";
  const std::pair<std::string, std::string> cases[] = {
      {"", "column 1: " + operand},
      {"u + ", "column 5: " + operand},
      {"(u", "column 3: expected an operator (+ - * / ^) or \")\""},
      {"u)", "column 2: expected an operator (+ - * / ^) or the end"},
      {"2u", "column 2: expected an operator (+ - * / ^) or the end"},
      {"sin()", "column 5: " + operand},
      {"sin u", "column 1: \"sin\" is a function: write its argument in parentheses"},
      {"1 + abs(u)", "column 5: \"abs\" has a kink; write sqrt(x^2 + d^2)"},
      {"max(u, v)", "column 1: \"max\" has a kink"},
      {"floor(u)", "column 1: \"floor\" has jumps"},
      {"pow(u, 2)", "column 1: \"pow\" is written a^b"},
      {"sinn(u)", "did you mean \"sin\"?"},
      {"amplitud*u", "column 1: \"amplitud\" is no surface coordinate, constant or parameter of this height; "
                     "did you mean \"amplitude\"?"},
      {"1e200*u", "column 1: the number \"1e200\" is above 1e100"},
      {"u/0", "has a part that is constant and no finite number"},
      {"u $ v", "column 3: expected an operator"},
      {std::string(51, '(') + "u" + std::string(51, ')'), "column 51: more than 50 parentheses"},
      {std::string(60, '-') + "u", "more than 50 parentheses or signs"},
      {std::string(4001, ' '), "has 4001 characters; at most 4000 are possible"},
  };
  for (const auto& [text, message] : cases) {
    try {
      expression(text, 2, {{"amplitude", 1.0}});
      ADD_FAILURE() << text << " was taken";
    } catch (const ModelError& error) {
      EXPECT_EQ(error.status, ENTS_BAD_VALUE);
      EXPECT_TRUE(error.message.starts_with("h: ") && error.message.find(message) != std::string::npos)
          << text << "\n"
          << error.message;
    }
  }
  EXPECT_THROW(expression("v", 1), ModelError);
  std::string steps = "0";
  for (int i = 1; i < 260; ++i) steps += "+sin(" + std::to_string(i) + "*u)";
  try {
    expression(steps, 1);
    ADD_FAILURE() << "too many steps";
  } catch (const ModelError& error) {
    EXPECT_NE(error.message.find("needs 513 steps or more, not at most 512"), std::string::npos)
        << error.message;
  }
}

TEST(Expression, PrecedenceIsThatOfMathematics) {
  const double s[2] = {0.3, 0.2};
  for (const auto& [text, value] : {std::pair("-u^2", -0.09),
                                    {"2^3^2*u", 512 * 0.3},
                                    {"2^-u", std::pow(2.0, -0.3)},
                                    {"u - v - u", -0.2},
                                    {"6/2*u", 0.9},
                                    {"u*-v", -0.06},
                                    {"- -u", 0.3},
                                    {" u  +v ", 0.5},
                                    {"1.5e1*u", 4.5},
                                    {".5*u", 0.15},
                                    {"2.*u", 0.6},
                                    {"e*u", std::exp(1.0) * 0.3},
                                    {"(-2)^3*u", -2.4},
                                    {"sqrt(4)*u", 0.6}}) {
    const Height height = expression(text, 2);
    EXPECT_NEAR((evaluate_height<2, double>(height.root(), s).h), value, 1e-15 * (1.0 + std::fabs(value)))
        << text;
  }
}

} // namespace
} // namespace expression_test
