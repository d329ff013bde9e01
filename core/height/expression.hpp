// SPDX-License-Identifier: BSD-3-Clause
// A height given by an expression of the surface coordinates: a short program, made once, that is run for
// many points at a time.
//
// Every quantity of the program is a polynomial in the distances from the point, cut after the third order (a
// jet); the rules of calculus are those of arithmetic with such polynomials. What depends on one coordinate
// alone, or on none, has fewer coefficients. The same steps with intervals instead of numbers
// (expression_range.cpp) give the bounds that a search needs.
#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "core/height/height_tree.hpp"

namespace ents {

enum class ExpressionOperation : std::uint8_t {
  number,   // values[a]
  affine,   // values[a] + values[a + 1] s_1 + values[a + 2] s_2
  add,      // a + b
  subtract, // a - b
  multiply, // a b
  offset,   // a + values[b]
  scale,    // a values[b]
  negate,   // -a
  power,    // a^n
  root,     // a^(n/2), n odd
  exponential,
  logarithm,
  sine,
  cosine,
  tangent,
  hyperbolic_sine,
  hyperbolic_cosine,
  hyperbolic_tangent,
  arctangent,
  arcsine,
  arccosine,
  bump // (1 - a^2)^n within -1 .. 1, 0 beyond: n - 1 times continuously differentiable
};

// Surface coordinates that a quantity depends on, as bits: first, second.
using ExpressionShape = std::uint8_t;

struct ExpressionStep {
  ExpressionOperation operation;
  ExpressionShape shape, shape_a, shape_b; // of the result and of the operands
  std::int16_t to, a, b; // slots; of numbers: a, of offset and scale: b index into the values
  std::int16_t n;
};

struct Expression {
  static constexpr int most_steps = 512;
  static constexpr int most_slots = 32;
  static constexpr int coefficients = ExternalHeight::most_numbers;

  std::int32_t dimension = 1;
  std::int32_t result = 0; // slot
  std::vector<ExpressionStep> steps;
  std::vector<Expression> rates; // by each parameter; over the same values
};

// Makes a program. Quantities are numbered in the order in which they appear; equal ones get one number. What
// is known is computed at once, and what depends on the coordinates linearly becomes one step.
class ExpressionBuilder {
public:
  using Operation = ExpressionOperation;

  // Parameters are values that copies of a height may replace; values: what they are in this one.
  ExpressionBuilder(std::int32_t dimension, std::vector<double> parameter_values);

  int number(double value);
  int parameter(int index);
  int coordinate(int a); // 0, 1
  int add(int a, int b);
  int subtract(int a, int b);
  int multiply(int a, int b);
  int divide(int a, int b) { return multiply(a, power(b, -1)); }
  int negate(int a);
  int power(int a, int n);              // |n| <= most_power
  int root(int a, int n);               // a^(n/2), n odd, |n| <= most_power
  int apply(Operation function, int a); // of one operand, without n
  int bump(int a, int n);
  int derivative(int a, int parameter); // by a parameter
  static constexpr int most_power = 1000;

  // Is the quantity known? Then `value` is what it is.
  bool is_number(int a, double& value) const;
  // Are all known quantities finite?
  bool finite() const;
  // Number of quantities so far; those of a height are no more.
  int size() const { return static_cast<int>(nodes_.size()); }

  // The height. A height of more than most_steps steps, or one that needs more than most_slots at a time, is
  // refused: `too_long` is then how many it has, `what` of what. feature_length: infinite entries are
  // estimated.
  struct TooLong {
    int number = 0, most = 0;
    std::string_view what;
  };
  bool finish(int result, const double (&feature_length)[2], Height& height, TooLong& too_long);

private:
  struct Node {
    Operation operation;
    ExpressionShape shape;
    int a, b, n; // numbers: a >= 0 is the number of a parameter
    double value[3];
    bool operator==(const Node& other) const;
  };
  int insert(const Node& node);
  int function(Operation operation, int a, int n); // of one operand
  bool compile(int result, std::vector<double>& values, Expression& expression, TooLong& too_long) const;
  int new_derivative(int a, int parameter);
  bool is_linear(int a) const; // a sum of coordinates with factors

  std::int32_t dimension_;
  std::vector<double> parameters_;
  std::vector<Node> nodes_;
  std::map<std::pair<int, int>, int> derivatives_;
};

// For each surface coordinate, estimates the length over which the height is close to a cubic
// (Height::feature_length) from the ranges of the derivatives of all quantities over the whole plane: a
// quarter of a wavelength of a sine, the distance over which the argument of another function changes by one.
// And a bound of the height itself.
void analyse_expression(const Expression& expression, const double* values, double& bound,
                        double (&feature_length)[2]);

void expression_rates(const ExternalHeight& height, std::int32_t parameter, const double* s, double* jet);
void expression_ranges(const ExternalHeight& height, const double* low, const double* high, double* least,
                       double* most);

// The evaluation exists once per instruction set; its bits are the same.
namespace ENTS_ISA {
void expression_jets(const ExternalHeight& height, std::int32_t order, std::int32_t count, const double* s,
                     double* jet);
}

} // namespace ents
