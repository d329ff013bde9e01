// SPDX-License-Identifier: BSD-3-Clause
#include "core/height/expression.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/height/expression_steps.hpp"
#include "core/numbers/fingerprint.hpp"
#include "core/numbers/instruction_set.hpp"

namespace ents {

#ifdef ENTS_HAS_AVX2
namespace avx2 {
std::remove_pointer_t<ExternalHeight::Jets> expression_jets;
}
#endif
#ifdef ENTS_HAS_AVX512
namespace avx512 {
std::remove_pointer_t<ExternalHeight::Jets> expression_jets;
}
#endif

namespace {

using Operation = ExpressionOperation;

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

double value_of_function(Operation operation, int n, double x) {
  double f[4];
  portable::taylor(operation, n, x, f);
  return f[0];
}

} // namespace

bool ExpressionBuilder::Node::operator==(const Node& other) const {
  return operation == other.operation && a == other.a && b == other.b && n == other.n &&
         same_bits(value[0], other.value[0]) && same_bits(value[1], other.value[1]) &&
         same_bits(value[2], other.value[2]);
}

ExpressionBuilder::ExpressionBuilder(std::int32_t dimension, std::vector<double> parameter_values)
    : dimension_(dimension), parameters_(std::move(parameter_values)) {}

int ExpressionBuilder::insert(const Node& node) {
  const auto found = std::find(nodes_.begin(), nodes_.end(), node);
  if (found != nodes_.end()) return static_cast<int>(found - nodes_.begin());
  nodes_.push_back(node);
  return size() - 1;
}

int ExpressionBuilder::number(double value) {
  return insert({Operation::number, 0, -1, -1, 0, {value, 0.0, 0.0}});
}
int ExpressionBuilder::parameter(int index) { return insert({Operation::number, 0, index, -1, 0, {}}); }
int ExpressionBuilder::coordinate(int a) {
  return insert({Operation::affine,
                 static_cast<ExpressionShape>(1 << a),
                 -1,
                 -1,
                 0,
                 {0.0, a == 0 ? 1.0 : 0.0, a == 1 ? 1.0 : 0.0}});
}

bool ExpressionBuilder::is_number(int a, double& value) const {
  const Node& node = nodes_[static_cast<std::size_t>(a)];
  if (node.operation != Operation::number || node.a >= 0) return false;
  value = node.value[0];
  return true;
}

bool ExpressionBuilder::finite() const {
  return std::all_of(nodes_.begin(), nodes_.end(), [](const Node& node) {
    return std::all_of(node.value, node.value + 3, [](double v) { return std::isfinite(v); });
  });
}

// Without a constant: numbers that are added or multiplied later change no digit of what is small.
bool ExpressionBuilder::is_linear(int a) const {
  const Node& node = nodes_[static_cast<std::size_t>(a)];
  return node.operation == Operation::affine && node.value[0] == 0.0;
}

int ExpressionBuilder::add(int a, int b) {
  double x = 0.0, y = 0.0;
  const bool known_a = is_number(a, x), known_b = is_number(b, y);
  if (known_a && known_b) return number(x + y);
  if (known_a && !known_b) return add(b, a);
  if (known_b && y == 0.0) return a;
  Node node = nodes_[static_cast<std::size_t>(a)];
  if (is_linear(a) && known_b) {
    node.value[0] = y;
    return insert(node);
  }
  const Node& other = nodes_[static_cast<std::size_t>(b)];
  if (is_linear(a) && is_linear(b)) {
    for (int i = 1; i < 3; ++i) node.value[i] += other.value[i];
    node.shape =
        static_cast<ExpressionShape>((node.value[1] != 0.0 ? 1 : 0) | (node.value[2] != 0.0 ? 2 : 0));
    return node.shape == 0 ? number(0.0) : insert(node);
  }
  if (a > b) std::swap(a, b);
  return insert({Operation::add, static_cast<ExpressionShape>(node.shape | other.shape), a, b, 0, {}});
}

int ExpressionBuilder::subtract(int a, int b) {
  double x = 0.0, y = 0.0;
  const bool known_a = is_number(a, x), known_b = is_number(b, y);
  if (known_a && known_b) return number(x - y);
  if (known_b) return add(a, number(-y));
  if (is_linear(b) && (is_linear(a) || known_a)) return add(a, negate(b));
  if (known_a && x == 0.0) return negate(b);
  if (a == b) return number(0.0);
  const auto shape = nodes_[static_cast<std::size_t>(a)].shape | nodes_[static_cast<std::size_t>(b)].shape;
  return insert({Operation::subtract, static_cast<ExpressionShape>(shape), a, b, 0, {}});
}

int ExpressionBuilder::negate(int a) {
  Node node = nodes_[static_cast<std::size_t>(a)];
  if (double x = 0.0; is_number(a, x)) return number(-x);
  if (node.operation == Operation::negate) return node.a;
  if (node.operation == Operation::affine) {
    for (double& v : node.value) v = v == 0.0 ? 0.0 : -v;
    return insert(node);
  }
  return insert({Operation::negate, node.shape, a, -1, 0, {}});
}

int ExpressionBuilder::multiply(int a, int b) {
  double x = 0.0, y = 0.0;
  const bool known_a = is_number(a, x), known_b = is_number(b, y);
  if (known_a && known_b) return number(x * y);
  if (known_b) return multiply(b, a);
  Node node = nodes_[static_cast<std::size_t>(b)];
  if (known_a && x == 0.0) return number(0.0);
  if (known_a && x == 1.0) return b;
  if (known_a && x == -1.0) return negate(b);
  if (known_a && is_linear(b)) {
    for (int i = 1; i < 3; ++i) node.value[i] *= x;
    return insert(node);
  }
  if (a == b) return power(a, 2);
  const auto shape = nodes_[static_cast<std::size_t>(a)].shape | node.shape;
  if (!known_a && a > b) std::swap(a, b);
  return insert({Operation::multiply, static_cast<ExpressionShape>(shape), a, b, 0, {}});
}

int ExpressionBuilder::function(Operation operation, int a, int n) {
  if (double x = 0.0; is_number(a, x)) return number(value_of_function(operation, n, x));
  return insert({operation, nodes_[static_cast<std::size_t>(a)].shape, a, -1, n, {}});
}

int ExpressionBuilder::power(int a, int n) {
  if (n == 0) return number(1.0);
  return n == 1 ? a : function(Operation::power, a, n);
}
int ExpressionBuilder::root(int a, int n) { return function(Operation::root, a, n); }
int ExpressionBuilder::bump(int a, int n) { return function(Operation::bump, a, n); }
int ExpressionBuilder::apply(Operation operation, int a) { return function(operation, a, 0); }

int ExpressionBuilder::derivative(int a, int parameter) {
  if (const auto known = derivatives_.find({a, parameter}); known != derivatives_.end()) return known->second;
  return derivatives_[{a, parameter}] = new_derivative(a, parameter);
}

int ExpressionBuilder::new_derivative(int a, int parameter) {
  const Node node = nodes_[static_cast<std::size_t>(a)];
  const auto of = [&](int operand) { return derivative(operand, parameter); };
  const auto one_plus = [&](int b) { return add(b, number(1.0)); };
  int rate = 0; // of a function by its operand
  switch (node.operation) {
  case Operation::number:
    return number(node.a == parameter ? 1.0 : 0.0);
  case Operation::affine:
    return number(0.0);
  case Operation::add:
    return add(of(node.a), of(node.b));
  case Operation::subtract:
    return subtract(of(node.a), of(node.b));
  case Operation::multiply:
    return add(multiply(of(node.a), node.b), multiply(node.a, of(node.b)));
  case Operation::negate:
    return negate(of(node.a));
  case Operation::power:
    rate = multiply(number(node.n), power(node.a, node.n - 1));
    break;
  case Operation::root:
    rate = multiply(number(0.5 * node.n), root(node.a, node.n - 2));
    break;
  case Operation::exponential:
    rate = a;
    break;
  case Operation::logarithm:
    rate = power(node.a, -1);
    break;
  case Operation::sine:
    rate = apply(Operation::cosine, node.a);
    break;
  case Operation::cosine:
    rate = negate(apply(Operation::sine, node.a));
    break;
  case Operation::tangent:
    rate = one_plus(power(a, 2));
    break;
  case Operation::hyperbolic_sine:
    rate = apply(Operation::hyperbolic_cosine, node.a);
    break;
  case Operation::hyperbolic_cosine:
    rate = apply(Operation::hyperbolic_sine, node.a);
    break;
  case Operation::hyperbolic_tangent:
    rate = power(apply(Operation::hyperbolic_cosine, node.a), -2);
    break;
  case Operation::arctangent:
    rate = power(one_plus(power(node.a, 2)), -1);
    break;
  case Operation::arcsine:
  case Operation::arccosine:
    rate = root(one_plus(negate(power(node.a, 2))), -1);
    if (node.operation == Operation::arccosine) rate = negate(rate);
    break;
  case Operation::offset: // of programs alone
  case Operation::scale:
    break;
  case Operation::bump:
    rate = multiply(multiply(number(-2.0 * node.n), node.a), bump(node.a, node.n - 1));
    break;
  }
  return multiply(rate, of(node.a));
}

bool ExpressionBuilder::compile(int result, std::vector<double>& values, Expression& expression,
                                TooLong& too_long) const {
  // What the result needs: operands have smaller numbers than what they are part of. Numbers that are added
  // or multiplied need no step of their own.
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  const auto is = [&](int i, Operation operation) { return nodes_[at(i)].operation == operation; };
  const auto takes = [](const Node& node) {
    return node.operation != Operation::number && node.operation != Operation::affine;
  };
  const auto number_operand = [&](const Node& node) { // of a sum or product; -1: none
    if (node.operation != Operation::add && node.operation != Operation::multiply) return -1;
    return is(node.a, Operation::number) ? node.a : is(node.b, Operation::number) ? node.b : -1;
  };
  std::vector<int> last(nodes_.size(), -1); // that reads a quantity; -1: nothing does
  last[at(result)] = static_cast<int>(nodes_.size());
  for (int i = result; i >= 0; --i) {
    const Node& node = nodes_[at(i)];
    if (last[at(i)] < 0 || !takes(node)) continue;
    const int number = number_operand(node);
    for (const int operand : {node.a, node.b})
      if (operand >= 0 && operand != number) last[at(operand)] = std::max(last[at(operand)], i);
  }
  std::vector<int> value_at(nodes_.size(), -1); // places of numbers in the table
  const auto place_of = [&](int i) {
    const Node& node = nodes_[at(i)];
    if (node.operation == Operation::number && node.a >= 0) return node.a;
    if (value_at[at(i)] < 0) {
      value_at[at(i)] = static_cast<int>(values.size());
      values.insert(values.end(), node.value, node.value + (node.operation == Operation::affine ? 3 : 1));
    }
    return value_at[at(i)];
  };
  expression.dimension = dimension_;
  std::vector<int> slot(nodes_.size(), -1), reader_of_slot; // the last quantity that reads what is in a slot
  for (int i = 0; i <= result; ++i) {
    const Node& node = nodes_[at(i)];
    if (last[at(i)] < 0) continue;
    const auto free =
        std::find_if(reader_of_slot.begin(), reader_of_slot.end(), [&](int reader) { return reader < i; });
    slot[at(i)] = static_cast<int>(free - reader_of_slot.begin());
    if (slot[at(i)] == static_cast<int>(reader_of_slot.size())) reader_of_slot.push_back(0);
    reader_of_slot[at(slot[at(i)])] = last[at(i)];
    ExpressionStep step{node.operation,
                        node.shape,
                        0,
                        0,
                        static_cast<std::int16_t>(slot[at(i)]),
                        0,
                        0,
                        static_cast<std::int16_t>(node.n)};
    if (!takes(node)) {
      step.a = static_cast<std::int16_t>(place_of(i));
    } else if (const int number = number_operand(node); number >= 0) {
      const int other = number == node.a ? node.b : node.a;
      step.operation = node.operation == Operation::add ? Operation::offset : Operation::scale;
      step.a = static_cast<std::int16_t>(slot[at(other)]), step.shape_a = nodes_[at(other)].shape;
      step.b = static_cast<std::int16_t>(place_of(number));
    } else {
      step.a = static_cast<std::int16_t>(slot[at(node.a)]), step.shape_a = nodes_[at(node.a)].shape;
      if (node.b >= 0)
        step.b = static_cast<std::int16_t>(slot[at(node.b)]), step.shape_b = nodes_[at(node.b)].shape;
    }
    expression.steps.push_back(step);
    if (static_cast<int>(reader_of_slot.size()) > Expression::most_slots) {
      too_long = {static_cast<int>(reader_of_slot.size()), Expression::most_slots,
                  "intermediate results at a time"};
      return false;
    }
    if (static_cast<int>(expression.steps.size()) > Expression::most_steps) {
      too_long = {static_cast<int>(expression.steps.size()), Expression::most_steps, "steps"};
      return false;
    }
  }
  expression.result = slot[at(result)];
  return true;
}

namespace {

ExternalHeight::Jets best_expression_jets() {
  switch (best_instruction_set()) {
#ifdef ENTS_HAS_AVX512
  case InstructionSet::avx512:
    return avx512::expression_jets;
#endif
#ifdef ENTS_HAS_AVX2
  case InstructionSet::avx2:
    return avx2::expression_jets;
#endif
  default:
    return portable::expression_jets;
  }
}

} // namespace

bool ExpressionBuilder::finish(int result, const double (&feature_length)[2], Height& height,
                               TooLong& too_long) {
  auto expression = std::make_shared<Expression>();
  std::vector<double> values = parameters_;
  if (!compile(result, values, *expression, too_long)) return false;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    expression->rates.emplace_back();
    if (!compile(derivative(result, static_cast<int>(i)), values, expression->rates.back(), too_long))
      return false;
  }

  ExternalSource source;
  source.dimension = dimension_;
  for (int a = 0; a < 2; ++a) source.feature_length[a] = feature_length[a];
  analyse_expression(*expression, values.data(), source.bound, source.feature_length);
  Fingerprint print;
  for (const ExpressionStep& step : expression->steps)
    for (const int field : {static_cast<int>(step.operation), static_cast<int>(step.to),
                            static_cast<int>(step.a), static_cast<int>(step.b), static_cast<int>(step.n)})
      print.add(field);
  source.stamp = print.number();
  source.jets = best_expression_jets();
  source.ranges = expression_ranges;
  source.rates = parameters_.empty() ? nullptr : expression_rates;
  source.parameters = static_cast<std::int32_t>(parameters_.size());
  source.data = std::move(expression);
  source.values = std::move(values);
  source.continuity = Height::smooth;
  height = Height::external(std::move(source));
  return true;
}

void expression_rates(const ExternalHeight& height, std::int32_t parameter, const double* s, double* jet) {
  using namespace portable;
  const Expression& rate =
      static_cast<const Expression*>(height.data)->rates[static_cast<std::size_t>(parameter)];
  double slots[Expression::most_slots][Expression::coefficients];
  run_expression<2>(rate, height.values, s, slots, [](const ExpressionStep&) {});
  derivatives_of<2>(rate, rate.steps.back().shape, slots[rate.result], jet);
}

} // namespace ents
