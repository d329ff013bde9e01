// SPDX-License-Identifier: BSD-3-Clause
// Further functions of the kernel's scalars, for expressions: as in elementary.hpp only + - * /, square roots
// and comparisons are used, in a fixed order, so that their bits depend neither on the C library nor on the
// instruction set. Errors are a few units in the last place. The coefficients of the polynomials interpolate
// the functions in the zeros of Chebyshev's polynomials.
//
// Every function is a template on R: double, or a vector scalar with its own select, split_binary and what
// elementary.hpp asks for.
#pragma once

#include "core/numbers/elementary.hpp"
#include "core/numbers/lanes.hpp"

namespace ents::ENTS_ISA {

inline constexpr double half_pi = 1.5707963267948966, half_pi_rest = 6.123233995736766e-17;
inline constexpr double ln_2 = 0.6931471805599453;

// x > 0, normal: x = mantissa 2^exponent, 1 <= mantissa < 2. Any other x: some numbers.
ENTS_INLINE void split_binary(double x, double& mantissa, double& exponent) {
  const std::uint64_t bits = __builtin_bit_cast(std::uint64_t, x);
  mantissa = __builtin_bit_cast(double, (bits & 0x000fffffffffffff) | 0x3ff0000000000000);
  // the exponent field as the last bits of 2^52 + field
  exponent =
      __builtin_bit_cast(double, (bits >> 52 & 0x7ff) | 0x4330000000000000) - (4503599627370496.0 + 1023.0);
}
#if defined(ENTS_HAS_LANES)
template <int W> ENTS_INLINE void split_binary(Lanes<W> x, Lanes<W>& mantissa, Lanes<W>& exponent) {
  using I = typename VectorOf<W>::Integers;
  using V = typename Lanes<W>::Numbers;
  const I bits = (I)x.v;
  mantissa = Lanes<W>((V)((bits & 0x000fffffffffffff) | 0x3ff0000000000000), 0);
  exponent = Lanes<W>((V)(((bits >> 52) & 0x7ff) | 0x4330000000000000), 0) - (4503599627370496.0 + 1023.0);
}
#endif

// sum c_i z^i
template <class R, int N> ENTS_INLINE R horner(const double (&c)[N], R z) {
  R sum(c[N - 1]);
  for (int i = N - 1; i-- > 0;) sum = sum * z + c[i];
  return sum;
}

// An angle in radians. Its quarter turns are taken off in three parts of pi / 2, of which the products with
// the first two are exact up to a million quarters; beyond, the error grows by 2^-86 per quarter.
template <class R> ENTS_INLINE void sine_cosine(R x, R& sine, R& cosine) {
  const R quarters = nearest_integer(x * 0.6366197723675814);
  const R r = ((x - quarters * 1.5707963267341256) - quarters * 6.077100506303966e-11) -
              quarters * 2.0222662487959506e-21;
  sin_cos_near_zero(r * 0.15915494309189535, sine, cosine);
  add_quarters(quarters, sine, cosine);
}

template <class R> ENTS_INLINE R tangent(R x) {
  R sine, cosine;
  sine_cosine(x, sine, cosine);
  return unchecked_ratio(sine, cosine);
}

// Natural logarithm; -infinity at 0, NaN below.
template <class R> ENTS_INLINE R logarithm(R x) {
  const auto small = x < 2.2250738585072014e-308;
  const R scaled = select(small, x * 18014398509481984.0, x); // 2^54
  R m, e;
  split_binary(scaled, m, e);
  const auto upper = m > 1.4142135623730951;
  m = select(upper, 0.5 * m, m);
  e = (e + select(upper, R(1.0), R(0.0))) - select(small, R(54.0), R(0.0));
  // m = 1 + f = (1 + q) / (1 - q); log m = 2 q + q z P(z) with z = q^2, written with 2 q = f - q f
  const R f = m - 1.0, q = f / (f + 2.0), z = q * q;
  constexpr double P[] = {0.6666666666666666,  0.4000000000000089,  0.28571428570795937, 0.2222222239345263,
                          0.18181795454526495, 0.15386249788196335, 0.1326850331278954,  0.13089445145293532};
  const R rest = e * 1.90821492927058770002e-10 - q * (f - z * horner(P, z));
  const R y = e * 6.93147180369123816490e-01 + (f + rest); // ln 2 in two parts, the first of 33 bits
  constexpr double infinity = __builtin_inf();
  const R finite = select(x < infinity, y, x); // infinity, and NaN
  const R positive = select(x > 0.0, finite, x * R(__builtin_nan("")));
  return select(both(x <= 0.0, x >= 0.0), R(-infinity), positive);
}

template <class R> ENTS_INLINE R arctangent(R x) {
  const R t = absolute(x);
  const auto large = t > 1.0;
  const R u = select(large, unchecked_ratio(R(1.0), t), t);
  const auto upper = u > 0.41421356237309503;
  const R w = select(upper, (u - 1.0) / (u + 1.0), u), z = w * w; // atan u = pi / 4 + atan w
  constexpr double P[] = {-0.3333333333333333,  0.19999999999999804,  -0.14285714285659729,
                          0.11111111105145725,  -0.09090908753017178, 0.07692296361048216,
                          -0.06666424634599323, 0.05878926110527962,  -0.052304330074819896,
                          0.04551496237491248,  -0.0345680680148832,  0.016282993238837796};
  const R series = w * (z * horner(P, z));
  const R first = select(upper, R(0.5 * half_pi), R(0.0)),
          last = select(upper, R(0.5 * half_pi_rest), R(0.0));
  const R angle = first + (w + (series + last));
  const R y = select(large, (half_pi - angle) + half_pi_rest, angle);
  return select(x < 0.0, -y, y);
}

// NaN beyond -1 .. 1
template <class R> ENTS_INLINE R arcsine(R x) {
  return arctangent(unchecked_ratio(x, square_root((1.0 - x) * (1.0 + x))));
}
template <class R> ENTS_INLINE R arccosine(R x) {
  return 2.0 * arctangent(unchecked_ratio(square_root(1.0 - x), square_root(1.0 + x)));
}

template <class R> ENTS_INLINE void hyperbolic_sine_cosine(R x, R& sine, R& cosine) {
  const R t = absolute(x), e = exponential(t), inverse = unchecked_ratio(R(1.0), e), z = x * x;
  constexpr double P[] = {0.16666666666666666,    0.008333333333333299,   0.00019841269841324198,
                          2.7557319191381816e-06, 2.5052117695907823e-08, 1.6057679623801635e-10,
                          7.746178593018927e-13};
  const R near = x + x * (z * horner(P, z)), far = 0.5 * (e - inverse);
  sine = select(t <= 1.0, near, select(x < 0.0, -far, far));
  cosine = 0.5 * (e + inverse);
}

template <class R> ENTS_INLINE R hyperbolic_tangent(R x) {
  R sine, cosine;
  hyperbolic_sine_cosine(x, sine, cosine);
  const R t = absolute(x), far = 1.0 - 2.0 / (exponential(2.0 * t) + 1.0);
  return select(t <= 1.0, sine / cosine, select(x < 0.0, -far, far));
}

// x where it is positive, else 0; NaN stays NaN.
template <class R> ENTS_INLINE R positive_part(R x) { return select(x < 0.0, R(0.0), x); }

// x^n by squares.
template <class R> ENTS_INLINE R whole_power(R x, int n) {
  R base = n < 0 ? unchecked_ratio(R(1.0), x) : x, y(1.0);
  bool empty = true;
  for (unsigned left = static_cast<unsigned>(n < 0 ? -n : n); left > 0; left >>= 1) {
    if (left & 1) y = empty ? base : y * base, empty = false;
    if (left > 1) base = base * base;
  }
  return y;
}

} // namespace ents::ENTS_ISA
