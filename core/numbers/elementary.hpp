// SPDX-License-Identifier: BSD-3-Clause
// Sine, cosine and exponential of the kernel's scalars.
//
// Own code because their bits must depend neither on the C library nor on the instruction set, and must
// be the same for a number and for a lane of a vector. Only + - * / and comparisons are used, in a fixed
// order; the build switches contraction to fused multiply-add off. Rounding is to nearest.
//
// A vector scalar R joins in with its own select, power_of_two, add_quarters and value_of.
//
// The exponential is that of fdlibm (Sun Microsystems 1993, free to copy with this notice): e_exp.c.
#pragma once

#include <cstdint>

#include "core/numbers/scalar.hpp"

namespace ents::ENTS_ISA {

inline constexpr double two_pi = 6.283185307179586476925286766559;

ENTS_INLINE double select(bool condition, double a, double b) { return condition ? a : b; }
template <class S> ENTS_INLINE S larger(S a, S b) { return select(a > b, a, b); }
template <class M, class S> ENTS_INLINE Dual<S> select(M condition, Dual<S> a, Dual<S> b) {
  return {select(condition, a.v, b.v), select(condition, a.d, b.d)};
}

// Nearest integer, ties to even; exact for |x| <= 2^51.
template <class R> ENTS_INLINE R nearest_integer(R x) {
  constexpr double shift = 6755399441055744.0; // 1.5 * 2^52: the spacing of doubles there is 1
  return (x + shift) - shift;
}

// Largest integer <= x; exact for |x| <= 2^51.
template <class R> ENTS_INLINE R round_down(R x) {
  const R n = nearest_integer(x);
  return n - select(n > x, R(1.0), R(0.0));
}

// a - b where b counts as a constant.
ENTS_INLINE double minus_value(double a, double b) { return a - b; }
template <class S> ENTS_INLINE Dual<S> minus_value(Dual<S> a, S b) { return {a.v - b, a.d}; }

// x within [low, high]; NaN stays NaN.
template <class S> ENTS_INLINE S clamp(S x, double low, double high) {
  const S above = select(value_of(x) < low, S(low), x);
  return select(value_of(x) > high, S(high), above);
}

// The same; NaN becomes `low`.
template <class R> ENTS_INLINE R clamp_not_nan(R x, double low, double high) {
  const R above = select(x > low, x, R(low));
  return select(x > high, R(high), above);
}

// 2^n for an integer -1022 <= n <= 1023. Any other n: some number.
ENTS_INLINE double power_of_two(double n) {
  // n + 1023 stands in the last bits of the sum; moved up they are the exponent field.
  const double biased = n + (4503599627370496.0 + 1023.0);
  return __builtin_bit_cast(double, __builtin_bit_cast(std::uint64_t, biased) << 52);
}

// (sine, cosine) of an angle -> those of the angle + quarters * pi/2, quarters an integer below 2^51.
ENTS_INLINE void add_quarters(double quarters, double& sine, double& cosine) {
  // The last bits of the sum are quarters modulo 4: odd ones swap, the second bit is a sign.
  const std::uint64_t n = __builtin_bit_cast(std::uint64_t, quarters + 6755399441055744.0);
  const std::uint64_t s = __builtin_bit_cast(std::uint64_t, sine);
  const std::uint64_t c = __builtin_bit_cast(std::uint64_t, cosine);
  const std::uint64_t swap = (s ^ c) & (0 - (n & 1));
  sine = __builtin_bit_cast(double, s ^ swap ^ ((n & 2) << 62));
  cosine = __builtin_bit_cast(double, c ^ swap ^ (((n + 1) & 2) << 62));
}

// Sine and cosine of 2 pi f, |f| <= 1/8. Polynomials in f^2 through the zeros of Chebyshev's: sine to 1.3e-17
// of 2 pi f, cosine to 1.2e-19, where arithmetic is exact. Summed in pairs, not one after the other: the
// time of a sine is that of the longest chain of sums.
template <class R> ENTS_INLINE void sin_cos_near_zero(R f, R& sine, R& cosine) {
  const R z = f * f, z2 = z * z, z4 = z2 * z2;
  const R s =
      ((-41.341702240399755 + z * 81.6052492760517) + z2 * (-76.70585973561397 + z * 42.05868917945876)) +
      z4 * (-15.094054064726203 + z * 3.786430011879243);
  sine = f * two_pi + (f * z * s + f * 2.4492935982947064e-16); // the rest of 2 pi
  const R c =
      ((19.739208802178716 + z * -64.93939402266824) + z2 * (85.45681720664378 + z * -60.24464135269435)) +
      z4 * ((26.426253274804587 + z * -7.903206845861561) + z2 * 1.6990328650055457);
  cosine = 1.0 - z * c;
}

// Sine and cosine of 2 pi (t + offset), |offset| <= 1. t is reduced before the offset is added, so that large
// counts of turns cost no accuracy of the offset; exact 0 and +-1 at quarter turns.
template <class R> ENTS_INLINE void sin_cos_turns(R t, double offset, R& sine, R& cosine) {
  const R r = (t - nearest_integer(t)) + offset;
  const R quarters = nearest_integer(4.0 * r);
  const R f = r - 0.25 * quarters; // exact, |f| <= 1/8
  sin_cos_near_zero(f, sine, cosine);
  add_quarters(quarters, sine, cosine);
}
template <class S> ENTS_INLINE void sin_cos_turns(Dual<S> t, double offset, Dual<S>& sine, Dual<S>& cosine) {
  sin_cos_turns(t.v, offset, sine.v, cosine.v);
  const S rate = two_pi * t.d;
  sine.d = cosine.v * rate;
  cosine.d = -sine.v * rate;
}

template <class S> ENTS_INLINE void sin_cos_turns(Dual<S> t, Dual<S> offset, Dual<S>& sine, Dual<S>& cosine) {
  sin_cos_turns(Dual<S>(t.v, t.d + offset.d), offset.v, sine, cosine);
}

// e^x. 0 below -708, before results leave the normal numbers, infinite above 709.78.
template <class R> ENTS_INLINE R exponential(R x) {
  const R bounded = clamp(x, -708.0, 709.79);
  const R k = nearest_integer(bounded * 1.44269504088896338700e+00);
  const R high = bounded - k * 6.93147180369123816490e-01; // exact: 33 bits of ln 2
  const R low = k * 1.90821492927058770002e-10;
  const R r = high - low;
  const R t = r * r;
  const R c = r - t * (1.66666666666666019037e-01 +
                       t * (-2.77777777770155933842e-03 +
                            t * (6.61375632143793436117e-05 +
                                 t * (-1.65339022054652515390e-06 + t * 4.13813679705723846039e-08))));
  const R y = 1.0 - ((low - (r * c) / (2.0 - c)) - high);
  const R scaled = (2.0 * y) * power_of_two(k - 1.0); // k reaches 1024
  return select(x < -708.0, R(0.0), scaled);
}
template <class S> ENTS_INLINE Dual<S> exponential(Dual<S> x) {
  const S y = exponential(x.v);
  return {y, y * x.d};
}

} // namespace ents::ENTS_ISA
