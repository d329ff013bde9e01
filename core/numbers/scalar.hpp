// SPDX-License-Identifier: BSD-3-Clause
// The scalars of the kernel. Every formula in core is a template on its scalar S:
//   double         values, residual, frictionless tangent
//   Dual<double>   the same formula and, in `d`, its derivative along one direction in xi
// Nothing here or in the kernel may branch on a value of type S except through value_of().
#pragma once

#include <cmath>

#ifdef __FAST_MATH__
#error "ents must not be compiled with -ffast-math: NaN checks and bit equality would be lost"
#endif

// Kernels may be compiled several times for different instruction sets; each compilation lives in a
// namespace of its own so that the linker never mixes their inline functions.
#ifndef ENTS_ISA
#define ENTS_ISA portable
#endif

// What never comes here
#if defined(_MSC_VER) && !defined(__clang__)
#define ENTS_UNREACHABLE __assume(0)
#else
#define ENTS_UNREACHABLE __builtin_unreachable()
#endif

// Before a loop that stays one, however few its turns
#if defined(__clang__)
#define ENTS_ROLLED _Pragma("clang loop unroll(disable)")
#elif defined(__GNUC__)
#define ENTS_ROLLED _Pragma("GCC unroll 1")
#else
#define ENTS_ROLLED
#endif

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(ENTS_SMALL_CODE)
#define ENTS_INLINE inline // instrumented code inlined by force would take minutes to compile
#define ENTS_LAMBDA_INLINE
#define ENTS_NOINLINE
#elif defined(__GNUC__)
#define ENTS_INLINE inline __attribute__((always_inline))
#define ENTS_LAMBDA_INLINE __attribute__((always_inline))
#define ENTS_NOINLINE __attribute__((noinline))
#elif defined(_MSC_VER)
#define ENTS_INLINE __forceinline
#define ENTS_LAMBDA_INLINE
#define ENTS_NOINLINE __declspec(noinline)
#else
#define ENTS_INLINE inline
#define ENTS_LAMBDA_INLINE
#define ENTS_NOINLINE
#endif

namespace ents::ENTS_ISA {

// Lengths, heights and stiffnesses below this, and lengths above its inverse, keep every product in range.
inline constexpr double safe_magnitude = 1e30;

// First-order dual number: v + eps d, eps^2 = 0.
template <class S> struct Dual {
  S v;
  S d;
  Dual() = default;
  constexpr Dual(S value) : v(value), d(S(0)) {}
  constexpr Dual(S value, S derivative) : v(value), d(derivative) {}
};

template <class S> ENTS_INLINE Dual<S> operator+(Dual<S> a, Dual<S> b) { return {a.v + b.v, a.d + b.d}; }
template <class S> ENTS_INLINE Dual<S> operator-(Dual<S> a, Dual<S> b) { return {a.v - b.v, a.d - b.d}; }
template <class S> ENTS_INLINE Dual<S> operator-(Dual<S> a) { return {-a.v, -a.d}; }
template <class S> ENTS_INLINE Dual<S> operator*(Dual<S> a, Dual<S> b) {
  return {a.v * b.v, a.v * b.d + a.d * b.v};
}
template <class S> ENTS_INLINE Dual<S> operator/(Dual<S> a, Dual<S> b) {
  const S q = a.v / b.v;
  return {q, (a.d - q * b.d) / b.v};
}
template <class S> ENTS_INLINE Dual<S> operator+(Dual<S> a, double b) { return {a.v + b, a.d}; }
template <class S> ENTS_INLINE Dual<S> operator+(double a, Dual<S> b) { return {a + b.v, b.d}; }
template <class S> ENTS_INLINE Dual<S> operator-(Dual<S> a, double b) { return {a.v - b, a.d}; }
template <class S> ENTS_INLINE Dual<S> operator-(double a, Dual<S> b) { return {a - b.v, -b.d}; }
template <class S> ENTS_INLINE Dual<S> operator*(Dual<S> a, double b) { return {a.v * b, a.d * b}; }
template <class S> ENTS_INLINE Dual<S> operator*(double a, Dual<S> b) { return {a * b.v, a * b.d}; }
template <class S> ENTS_INLINE Dual<S> operator/(Dual<S> a, double b) { return {a.v / b, a.d / b}; }
template <class S> ENTS_INLINE Dual<S> operator/(double a, Dual<S> b) { return Dual<S>(S(a)) / b; }
template <class S> ENTS_INLINE Dual<S>& operator+=(Dual<S>& a, Dual<S> b) { return a = a + b; }
template <class S> ENTS_INLINE Dual<S>& operator-=(Dual<S>& a, Dual<S> b) { return a = a - b; }
template <class S> ENTS_INLINE Dual<S>& operator*=(Dual<S>& a, Dual<S> b) { return a = a * b; }

// By value
template <class S> ENTS_INLINE auto operator<(Dual<S> a, Dual<S> b) { return a.v < b.v; }
template <class S> ENTS_INLINE auto operator>(Dual<S> a, Dual<S> b) { return a.v > b.v; }
template <class S> ENTS_INLINE auto operator<=(Dual<S> a, Dual<S> b) { return a.v <= b.v; }
template <class S> ENTS_INLINE auto operator>=(Dual<S> a, Dual<S> b) { return a.v >= b.v; }
template <class S> ENTS_INLINE auto operator<(Dual<S> a, double b) { return a.v < b; }
template <class S> ENTS_INLINE auto operator>(Dual<S> a, double b) { return a.v > b; }
template <class S> ENTS_INLINE auto operator<=(Dual<S> a, double b) { return a.v <= b; }
template <class S> ENTS_INLINE auto operator>=(Dual<S> a, double b) { return a.v >= b; }

#if defined(__GNUC__)
ENTS_INLINE double absolute(double a) { return __builtin_fabs(a); }
ENTS_INLINE double square_root(double a) { return __builtin_sqrt(a); }
#else
ENTS_INLINE double absolute(double a) { return std::fabs(a); }
ENTS_INLINE double square_root(double a) { return std::sqrt(a); }
#endif

template <class S> ENTS_INLINE Dual<S> square_root(Dual<S> a) {
  const S r = square_root(a.v);
  return {r, a.d / (2.0 * r)};
}
// Of zero: a derivative of zero, which nothing uses
ENTS_INLINE Dual<double> square_root(Dual<double> a) {
  const double r = square_root(a.v);
  return {r, r > 0.0 ? a.d / (2.0 * r) : 0.0};
}
ENTS_INLINE Dual<double> absolute(Dual<double> a) { return a.v < 0.0 ? -a : a; }

// The part of a scalar that decides branches.
ENTS_INLINE double value_of(double a) { return a; }
template <class S> ENTS_INLINE S value_of(Dual<S> a) { return a.v; }

// Does the scalar stand for a range of values (ball.hpp)?
template <class S> inline constexpr bool is_range = false;

// The derivative part; 0 for a plain number.
ENTS_INLINE double derivative_of(double) { return 0.0; }
template <class S> ENTS_INLINE S derivative_of(Dual<S> a) { return a.d; }

} // namespace ents::ENTS_ISA
