// SPDX-License-Identifier: BSD-3-Clause
// Bounds of expressions and of their derivatives: the steps of a program with intervals instead of numbers.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/height/expression_steps.hpp"

namespace ents::ENTS_ISA {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// All numbers from low to high. Every result is made wider by more than the rounding of numbers in the same
// place.
struct Interval {
  double low, high;
  Interval() = default;
  Interval(double value) : low(value), high(value) {}
  Interval(double l, double h) : low(l), high(h) {}
};
const Interval anything{-infinity, infinity};

Interval outward(double low, double high) {
  if (!(low <= high)) return anything; // NaN
  constexpr double wider = 1e-15, least = 1e-307, largest = std::numeric_limits<double>::max();
  if (low < 0.0)
    low -= wider * -low + least;
  else if (low > 0.0)
    low = std::fmin(low, largest) * (1.0 - wider) - least;
  if (high > 0.0)
    high += wider * high + least;
  else if (high < 0.0)
    high = std::fmax(high, -largest) * (1.0 - wider) + least;
  return {low, high};
}
bool holds_zero(Interval a) { return a.low <= 0.0 && a.high >= 0.0; }
double product(double a, double b) { return a == 0.0 || b == 0.0 ? 0.0 : a * b; } // 0 times any number is 0

Interval operator+(Interval a, Interval b) { return outward(a.low + b.low, a.high + b.high); }
Interval operator-(Interval a, Interval b) { return outward(a.low - b.high, a.high - b.low); }
Interval operator-(Interval a) { return {-a.high, -a.low}; }
Interval operator*(Interval a, Interval b) {
  const double p[4] = {product(a.low, b.low), product(a.low, b.high), product(a.high, b.low),
                       product(a.high, b.high)};
  return outward(*std::min_element(p, p + 4), *std::max_element(p, p + 4));
}

Interval whole_power(Interval x, int n) {
  if (n < 0 && holds_zero(x)) {
    const double most = std::fmax(-x.low, x.high);
    return n % 2 == 0 && most > 0.0 ? outward(unchecked_ratio(1.0, ENTS_ISA::whole_power(most, -n)), infinity)
                                    : anything;
  }
  if (n < 0) {
    const Interval inverse = outward(1.0 / x.high, 1.0 / x.low);
    return n == -1 ? inverse : whole_power(inverse, -n);
  }
  if (n == 0) return 1.0;
  const double slack = 1.0 + 4e-16 * n; // products of rounded powers
  const double low = ENTS_ISA::whole_power(x.low, n), high = ENTS_ISA::whole_power(x.high, n);
  if (n % 2 != 0)
    return outward(low < 0.0 ? low * slack : low / slack, high < 0.0 ? high / slack : high * slack);
  const double least = std::fmin(low, high), most = std::fmax(low, high);
  return outward(holds_zero(x) ? 0.0 : least / slack, most * slack);
}
Interval square(Interval x) { return whole_power(x, 2); }

Interval positive_part(Interval x) { return {std::fmax(x.low, 0.0), std::fmax(x.high, 0.0)}; }

Interval square_root(Interval x) {
  return x.low < 0.0 ? anything : outward(std::sqrt(x.low), std::sqrt(x.high));
}
Interval exponential(Interval x) {
  return outward(ENTS_ISA::exponential(x.low), ENTS_ISA::exponential(x.high));
}
Interval logarithm(Interval x) {
  return x.low < 0.0 ? anything : outward(ENTS_ISA::logarithm(x.low), ENTS_ISA::logarithm(x.high));
}

// Is there a whole n with low <= first + n period <= high? Rather yes than no.
bool holds_one_of(Interval x, double first, double period) {
  const double a = (x.low - first) / period, b = (x.high - first) / period, slack = 1e-9;
  return std::floor(b + slack) >= std::ceil(a - slack);
}
constexpr double largest_angle = 1e5; // beyond it, any
bool is_any_angle(Interval x) {
  return !(x.low > -largest_angle && x.high < largest_angle && x.high - x.low < two_pi);
}

void sine_cosine(Interval x, Interval& sine, Interval& cosine) {
  sine = cosine = {-1.0, 1.0};
  if (is_any_angle(x)) return;
  double s[2], c[2];
  ENTS_ISA::sine_cosine(x.low, s[0], c[0]);
  ENTS_ISA::sine_cosine(x.high, s[1], c[1]);
  const auto between = [&](const double(&f)[2], double peak) {
    constexpr double pi = 0.5 * two_pi;
    const Interval ends = outward(std::fmin(f[0], f[1]), std::fmax(f[0], f[1]));
    return Interval(holds_one_of(x, peak - pi, two_pi) ? -1.0 : ends.low,
                    holds_one_of(x, peak, two_pi) ? 1.0 : ends.high);
  };
  sine = between(s, half_pi);
  cosine = between(c, 0.0);
}

Interval tangent(Interval x) {
  if (is_any_angle(x) || holds_one_of(x, half_pi, 2.0 * half_pi)) return anything;
  double s[2], c[2];
  ENTS_ISA::sine_cosine(x.low, s[0], c[0]);
  ENTS_ISA::sine_cosine(x.high, s[1], c[1]);
  return outward(unchecked_ratio(s[0], c[0]), unchecked_ratio(s[1], c[1]));
}

void hyperbolic_sine_cosine(Interval x, Interval& sine, Interval& cosine) {
  double s[2], c[2];
  ENTS_ISA::hyperbolic_sine_cosine(x.low, s[0], c[0]);
  ENTS_ISA::hyperbolic_sine_cosine(x.high, s[1], c[1]);
  sine = outward(s[0], s[1]);
  cosine = outward(holds_zero(x) ? 1.0 : std::fmin(c[0], c[1]), std::fmax(c[0], c[1]));
}
Interval hyperbolic_tangent(Interval x) {
  return outward(ENTS_ISA::hyperbolic_tangent(x.low), ENTS_ISA::hyperbolic_tangent(x.high));
}
Interval arctangent(Interval x) { return outward(ENTS_ISA::arctangent(x.low), ENTS_ISA::arctangent(x.high)); }
bool beyond_one(Interval x) { return x.low < -1.0 || x.high > 1.0; }
Interval arcsine(Interval x) {
  return beyond_one(x) ? anything : outward(ENTS_ISA::arcsine(x.low), ENTS_ISA::arcsine(x.high));
}
Interval arccosine(Interval x) {
  return beyond_one(x) ? anything : outward(ENTS_ISA::arccosine(x.high), ENTS_ISA::arccosine(x.low));
}

double largest(Interval a) { return std::fmax(std::fabs(a.low), std::fabs(a.high)); }
double or_no_range(double bound) {
  return std::fmin(std::fmax(bound, -ExternalHeight::no_range), ExternalHeight::no_range);
}

} // namespace

} // namespace ents::ENTS_ISA

namespace ents {

void expression_ranges(const ExternalHeight& height, const double* low, const double* high, double* least,
                       double* most) {
  using namespace ENTS_ISA;
  const Expression& expression = *static_cast<const Expression*>(height.data);
  Interval s[2], slots[Expression::most_slots][Expression::coefficients], out[Expression::coefficients];
  for (int a = 0; a < expression.dimension; ++a) s[a] = {low[a], high[a]};
  run_expression<3>(expression, height.values, s, slots, [](const ExpressionStep&) {});
  derivatives_of<3>(expression, expression.steps.back().shape, slots[expression.result], out);
  const int numbers = expression.dimension == 1 ? 4 : 10;
  for (int i = 0; i < numbers; ++i) least[i] = or_no_range(out[i].low), most[i] = or_no_range(out[i].high);
}

void analyse_expression(const Expression& expression, const double* values, double& bound,
                        double (&feature_length)[2]) {
  using namespace ENTS_ISA;
  using Operation = ExpressionOperation;
  const Interval s[2] = {anything, anything};
  Interval slots[Expression::most_slots][Expression::coefficients];
  double rate[Expression::most_slots][2] = {}; // 1 / length; frequencies of factors add
  // of a function whose own scale is 1, times `scale`
  const auto of_argument = [&](const ExpressionStep& step, int a, double scale) {
    if ((step.shape >> a & 1) == 0) return 0.0;
    Interval wide[10];
    widen<3>(step.shape_a, slots[step.a], wide);
    const double slope = largest(wide[1 + a]), bend = std::sqrt(2.0 * largest(wide[a == 0 ? 3 : 5])),
                 third = std::cbrt(6.0 * largest(wide[a == 0 ? 6 : 9]));
    const double fastest = slope < infinity ? slope : bend < infinity ? bend : third < infinity ? third : 0.0;
    return scale * fastest;
  };
  run_expression<3>(expression, values, s, slots, [&](const ExpressionStep& step) {
    for (int a = 0; a < 2; ++a) {
      switch (step.operation) {
      case Operation::number:
      case Operation::affine:
        rate[step.to][a] = 0.0;
        break;
      case Operation::add:
      case Operation::subtract:
        rate[step.to][a] = std::fmax(rate[step.a][a], rate[step.b][a]);
        break;
      case Operation::multiply:
        rate[step.to][a] = rate[step.a][a] + rate[step.b][a];
        break;
      case Operation::negate:
      case Operation::offset:
      case Operation::scale:
        rate[step.to][a] = rate[step.a][a];
        break;
      case Operation::power:
        rate[step.to][a] =
            step.n > 0 ? step.n * rate[step.a][a] : rate[step.a][a] + of_argument(step, a, 1.0);
        break;
      case Operation::sine:
      case Operation::cosine:
        rate[step.to][a] = rate[step.a][a] + of_argument(step, a, 1.0 / half_pi);
        break;
      default:
        rate[step.to][a] = rate[step.a][a] + of_argument(step, a, 1.0);
      }
    }
  });
  bound = largest(slots[expression.result][0]);
  if (!(bound < ExternalHeight::no_range)) bound = Height::unbounded;
  for (int a = 0; a < 2; ++a)
    if (!(feature_length[a] < infinity)) feature_length[a] = unchecked_ratio(1.0, rate[expression.result][a]);
}

} // namespace ents
