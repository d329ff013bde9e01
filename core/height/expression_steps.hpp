// SPDX-License-Identifier: BSD-3-Clause
// Arithmetic of jets: polynomials in the distances x, y from a point, cut after order N. Coefficients in the
// order
//   both coordinates  1, x, y, xx, xy, yy, xxx, xxy, xyy, yyy
//   one               1, x, xx, xxx
//   none              1
// R: a number, numbers of several points, or an interval.
#pragma once

#include "core/height/expression.hpp"
#include "core/numbers/transcendental.hpp"

namespace ents::ENTS_ISA {

template <int N> constexpr int coefficients_of(ExpressionShape shape) {
  return shape == 0 ? 1 : shape < 3 ? N + 1 : (N + 1) * (N + 2) / 2;
}

template <class R> ENTS_INLINE R square(R x) { return x * x; }

// A jet of one coordinate as one of both.
template <int N, class R> ENTS_INLINE void widen(ExpressionShape shape, const R* a, R (&out)[10]) {
  if (shape == 3) {
    for (int i = 0; i < coefficients_of<N>(3); ++i) out[i] = a[i];
    return;
  }
  for (int i = 0; i < coefficients_of<N>(3); ++i) out[i] = R(0.0);
  out[0] = a[0];
  for (int d = 1; shape != 0 && d <= N; ++d) out[shape == 1 ? d * (d + 1) / 2 : d * (d + 3) / 2] = a[d];
}

template <int N, class R> ENTS_INLINE void multiply_both(const R* a, const R* b, R* out) {
  out[0] = a[0] * b[0];
  for (int i = 1; i < 3; ++i) out[i] = a[0] * b[i] + a[i] * b[0];
  out[3] = (a[0] * b[3] + a[3] * b[0]) + a[1] * b[1];
  out[4] = (a[0] * b[4] + a[4] * b[0]) + (a[1] * b[2] + a[2] * b[1]);
  out[5] = (a[0] * b[5] + a[5] * b[0]) + a[2] * b[2];
  if constexpr (N > 2) {
    out[6] = (a[0] * b[6] + a[6] * b[0]) + (a[1] * b[3] + a[3] * b[1]);
    out[7] = (a[0] * b[7] + a[7] * b[0]) + ((a[1] * b[4] + a[4] * b[1]) + (a[2] * b[3] + a[3] * b[2]));
    out[8] = (a[0] * b[8] + a[8] * b[0]) + ((a[1] * b[5] + a[5] * b[1]) + (a[2] * b[4] + a[4] * b[2]));
    out[9] = (a[0] * b[9] + a[9] * b[0]) + (a[2] * b[5] + a[5] * b[2]);
  }
}

template <int N, class R>
ENTS_INLINE void multiply_jets(const ExpressionStep& step, const R* a, const R* b, R* out) {
  if (step.shape_a == 0 || step.shape_b == 0) {
    const R factor = step.shape_a == 0 ? a[0] : b[0];
    const R* of = step.shape_a == 0 ? b : a;
    for (int i = coefficients_of<N>(step.shape); i-- > 0;) out[i] = factor * of[i];
  } else if (step.shape < 3) {
    out[0] = a[0] * b[0];
    out[1] = a[0] * b[1] + a[1] * b[0];
    out[2] = (a[0] * b[2] + a[2] * b[0]) + a[1] * b[1];
    if constexpr (N > 2) out[3] = (a[0] * b[3] + a[3] * b[0]) + (a[1] * b[2] + a[2] * b[1]);
  } else if (step.shape_a < 3 && step.shape_b < 3) { // of one coordinate each
    const R* first = step.shape_a == 1 ? a : b;
    const R* second = step.shape_a == 1 ? b : a;
    for (int d = 0; d <= N; ++d)
      for (int j = 0; j <= d; ++j) out[d * (d + 1) / 2 + j] = first[d - j] * second[j];
  } else if (step.shape_a == 3 && step.shape_b == 3) {
    multiply_both<N>(a, b, out);
  } else {
    R left[10], right[10];
    widen<N>(step.shape_a, a, left);
    widen<N>(step.shape_b, b, right);
    multiply_both<N>(left, right, out);
  }
}

template <int N, bool Minus, class R>
ENTS_INLINE void add_jets(const ExpressionStep& step, const R* a, const R* b, R* out) {
  const auto sum = [](const R& x, const R& y) ENTS_LAMBDA_INLINE { return Minus ? x - y : x + y; };
  if (step.shape_a == step.shape_b) {
    for (int i = 0; i < coefficients_of<N>(step.shape); ++i) out[i] = sum(a[i], b[i]);
  } else if (step.shape_b == 0) {
    out[0] = sum(a[0], b[0]);
    for (int i = 1; i < coefficients_of<N>(step.shape); ++i) out[i] = a[i];
  } else if (step.shape_a == 0) {
    out[0] = sum(a[0], b[0]);
    for (int i = 1; i < coefficients_of<N>(step.shape); ++i) out[i] = Minus ? -b[i] : b[i];
  } else {
    R left[10], right[10];
    widen<N>(step.shape_a, a, left);
    widen<N>(step.shape_b, b, right);
    for (int i = 0; i < coefficients_of<N>(3); ++i) out[i] = sum(left[i], right[i]);
  }
}

// f(a) from f, f', f'' / 2, f''' / 6 at a[0].
template <int N, class R>
ENTS_INLINE void compose(ExpressionShape shape, const R* a, const R (&f)[4], R* out) {
  if (shape == 0) {
    out[0] = f[0];
  } else if (shape < 3) {
    const R a1 = a[1], a2 = a[2], squared = square(a1);
    if constexpr (N > 2) out[3] = f[1] * a[3] + (f[2] * (2.0 * (a1 * a2)) + f[3] * (squared * a1));
    out[0] = f[0];
    out[1] = f[1] * a1;
    out[2] = f[1] * a2 + f[2] * squared;
  } else {
    const R x = a[1], y = a[2], q[3] = {square(x), 2.0 * (x * y), square(y)};
    if constexpr (N > 2) {
      const R cross[4] = {2.0 * (x * a[3]), 2.0 * (x * a[4] + y * a[3]), 2.0 * (x * a[5] + y * a[4]),
                          2.0 * (y * a[5])};
      const R cubed[4] = {x * q[0], y * q[0] + x * q[1], x * q[2] + y * q[1], y * q[2]};
      for (int i = 0; i < 4; ++i) out[6 + i] = f[1] * a[6 + i] + (f[2] * cross[i] + f[3] * cubed[i]);
    }
    for (int i = 0; i < 3; ++i) out[3 + i] = f[1] * a[3 + i] + f[2] * q[i];
    out[0] = f[0];
    out[1] = f[1] * x;
    out[2] = f[1] * y;
  }
}

// r (r - 1) .. / k!
ENTS_INLINE double binomial(double r, int k) {
  double b = 1.0;
  for (int i = 0; i < k; ++i) b = b * (r - i) / (i + 1);
  return b;
}

// f, f', f'' / 2, f''' / 6 at x.
template <class R> ENTS_INLINE void taylor(ExpressionOperation operation, int n, const R& x, R (&f)[4]) {
  using O = ExpressionOperation;
  R s, c;
  switch (operation) {
  case O::power:
    for (int k = 0; k < 4; ++k) f[k] = n >= 0 && k > n ? R(0.0) : binomial(n, k) * whole_power(x, n - k);
    return;
  case O::root:
    s = square_root(x);
    for (int k = 0; k < 4; ++k) f[k] = binomial(0.5 * n, k) * (s * whole_power(x, (n - 1) / 2 - k));
    return;
  case O::exponential:
    f[0] = f[1] = exponential(x);
    f[2] = 0.5 * f[0];
    f[3] = (1.0 / 6.0) * f[0];
    return;
  case O::logarithm:
    f[0] = logarithm(x);
    f[1] = whole_power(x, -1);
    f[2] = -0.5 * square(f[1]);
    f[3] = (1.0 / 3.0) * whole_power(f[1], 3);
    return;
  case O::sine:
    sine_cosine(x, s, c);
    f[0] = s, f[1] = c, f[2] = -0.5 * s, f[3] = (-1.0 / 6.0) * c;
    return;
  case O::cosine:
    sine_cosine(x, s, c);
    f[0] = c, f[1] = -s, f[2] = -0.5 * c, f[3] = (1.0 / 6.0) * s;
    return;
  case O::tangent:
    f[0] = tangent(x);
    s = square(f[0]);
    f[1] = 1.0 + s;
    f[2] = f[0] * f[1];
    f[3] = (1.0 / 3.0) * (f[1] * (1.0 + 3.0 * s));
    return;
  case O::hyperbolic_sine:
    hyperbolic_sine_cosine(x, s, c);
    f[0] = s, f[1] = c, f[2] = 0.5 * s, f[3] = (1.0 / 6.0) * c;
    return;
  case O::hyperbolic_cosine:
    hyperbolic_sine_cosine(x, s, c);
    f[0] = c, f[1] = s, f[2] = 0.5 * c, f[3] = (1.0 / 6.0) * s;
    return;
  case O::hyperbolic_tangent: // 1 - tanh^2 would lose its digits
    hyperbolic_sine_cosine(x, s, c);
    f[0] = hyperbolic_tangent(x);
    f[1] = whole_power(c, -2);
    f[2] = -(f[0] * f[1]);
    f[3] = (1.0 / 3.0) * (f[1] * (3.0 * square(f[0]) - 1.0));
    return;
  case O::arctangent:
    f[0] = arctangent(x);
    s = square(x);
    f[1] = whole_power(1.0 + s, -1);
    f[2] = -(x * square(f[1]));
    f[3] = (1.0 / 3.0) * ((3.0 * s - 1.0) * whole_power(f[1], 3));
    return;
  case O::bump: // n >= 3
    s = positive_part(1.0 - square(x)), c = whole_power(s, n - 2);
    f[0] = c * square(s);
    f[1] = (-2.0 * n) * (x * (c * s));
    f[2] = (2.0 * n * (n - 1)) * (square(x) * c) - static_cast<double>(n) * (c * s);
    f[3] = (2.0 * n * (n - 1)) * (x * c) -
           (4.0 / 3.0 * n * (n - 1) * (n - 2)) * (whole_power(x, 3) * whole_power(s, n - 3));
    return;
  default: // arcsine, arccosine
    f[0] = operation == O::arcsine ? arcsine(x) : arccosine(x);
    s = whole_power((1.0 - x) * (1.0 + x), -1); // 1 / (1 - x^2)
    f[1] = square_root(s);
    f[2] = 0.5 * (x * (s * f[1]));
    f[3] = (1.0 / 6.0) * ((1.0 + 2.0 * square(x)) * (square(s) * f[1]));
    if (operation == O::arccosine)
      for (int k = 1; k < 4; ++k) f[k] = -f[k];
    return;
  }
}

// s: [dimension]. A step writes to none of the slots that it reads. After every step, observe(step).
template <int N, class R, class Observe>
ENTS_INLINE void run_expression(const Expression& expression, const double* values, const R* s,
                                R (*slots)[Expression::coefficients], Observe&& observe) {
  using O = ExpressionOperation;
  for (const ExpressionStep& step : expression.steps) {
    R* to = slots[step.to];
    switch (step.operation) {
    case O::number:
      to[0] = R(values[step.a]);
      break;
    case O::affine: {
      const double* v = values + step.a;
      if (step.shape == 3) {
        to[0] = (v[1] * s[0] + v[2] * s[expression.dimension - 1]) + v[0];
        to[1] = R(v[1]);
        to[2] = R(v[2]);
      } else {
        const int a = step.shape - 1;
        to[0] = v[1 + a] * s[a] + v[0];
        to[1] = R(v[1 + a]);
      }
      for (int i = step.shape == 3 ? 3 : 2; i < coefficients_of<N>(step.shape); ++i) to[i] = R(0.0);
      break;
    }
    case O::add:
      add_jets<N, false>(step, slots[step.a], slots[step.b], to);
      break;
    case O::subtract:
      add_jets<N, true>(step, slots[step.a], slots[step.b], to);
      break;
    case O::multiply:
      multiply_jets<N>(step, slots[step.a], slots[step.b], to);
      break;
    case O::offset:
      to[0] = slots[step.a][0] + values[step.b];
      for (int i = 1; i < coefficients_of<N>(step.shape); ++i) to[i] = slots[step.a][i];
      break;
    case O::scale:
      for (int i = 0; i < coefficients_of<N>(step.shape); ++i) to[i] = values[step.b] * slots[step.a][i];
      break;
    case O::negate:
      for (int i = 0; i < coefficients_of<N>(step.shape); ++i) to[i] = -slots[step.a][i];
      break;
    default: {
      R f[4];
      taylor(step.operation, step.n, slots[step.a][0], f);
      compose<N>(step.shape, slots[step.a], f, to);
    }
    }
    observe(step);
  }
}

// The derivatives of the result, in the order of ExternalHeight.
template <int N, class R>
ENTS_INLINE void derivatives_of(const Expression& expression, ExpressionShape shape, const R* result,
                                R* out) {
  constexpr double factor[10] = {1.0, 1.0, 1.0, 2.0, 1.0, 2.0, 6.0, 2.0, 2.0, 6.0},
                   factor_1[4] = {1.0, 1.0, 2.0, 6.0};
  if (expression.dimension == 1) {
    for (int i = 0; i <= N; ++i) out[i] = i == 0 || shape != 0 ? factor_1[i] * result[i] : R(0.0);
    return;
  }
  R wide[10];
  widen<N>(shape, result, wide);
  for (int i = 0; i < coefficients_of<N>(3); ++i) out[i] = factor[i] * wide[i];
}

} // namespace ents::ENTS_ISA
