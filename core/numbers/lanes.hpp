// SPDX-License-Identifier: BSD-3-Clause
// A kernel scalar that is one number of each of W elements: lane k of every operation does for element k what
// the same operation does for a double. There is no fused multiply-add and no other reordering, so that a
// lane's bits are those of the double.
//
// Made of the compiler's vectors (GCC), which it maps to whatever registers the instruction set has.
#pragma once

#include <cstdint>

#include "core/numbers/elementary.hpp"
#include "core/numbers/scalar.hpp"
#include "core/numbers/vec.hpp"

// (Intrinsics of eight lanes with a mask of all of them: GCC 12 warns falsely of those without.)
#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace ents::ENTS_ISA {

// One truth of each element; for a double, of one: bool.
ENTS_INLINE bool both(bool a, bool b) { return a & b; }
ENTS_INLINE bool either(bool a, bool b) { return a | b; }
ENTS_INLINE bool without(bool a, bool b) { return a & !b; }
ENTS_INLINE bool any(bool a) { return a; }
ENTS_INLINE bool every(bool a) { return a; }
ENTS_INLINE std::uint32_t bits_of(bool a) { return a; }

template <class S> using Truth = decltype(S(0.0) < S(0.0));

// a / x, 1 / x where x may be zero: the caller divides before it knows, and then does not use the result.
// (Sanitizers do not report it.)
#if defined(__SANITIZE_ADDRESS__)
__attribute__((no_sanitize("float-divide-by-zero"))) inline double unchecked_ratio(double a, double x) {
  return a / x;
}
#else
ENTS_INLINE double unchecked_ratio(double a, double x) { return a / x; }
#endif
template <class S> ENTS_INLINE S unchecked_ratio(S a, S x) { return a / x; }
template <class S> ENTS_INLINE S unchecked_inverse(S x) { return unchecked_ratio(S(1.0), x); }
template <class S> ENTS_INLINE Dual<S> unchecked_inverse(Dual<S> x) { return 1.0 / x; }

ENTS_INLINE double lane(double x, int) { return x; }

template <int W> struct Lanes; // where the compiler has them

#if !defined(__GNUC__) || defined(__clang__)
#define ENTS_REGISTER_WIDTH 1
#elif defined(__AVX512F__)
#define ENTS_REGISTER_WIDTH 8
#elif defined(__AVX__)
#define ENTS_REGISTER_WIDTH 4
#elif (defined(__SSE2__) && !defined(ENTS_PORTABLE_IS_SCALAR)) || !defined(__x86_64__)
#define ENTS_REGISTER_WIDTH 2
#else
#define ENTS_REGISTER_WIDTH 1
#endif
inline constexpr int register_width = ENTS_REGISTER_WIDTH; // of the widest

// Numbers that a scalar stands for.
template <class S> inline constexpr int width_of = 1;
template <int W> inline constexpr int width_of<Lanes<W>> = W;

#if defined(__GNUC__) && !defined(__clang__)
#define ENTS_HAS_LANES 1

// halves: two half registers that lie apart in memory, as one; of each `count` numbers are read, the others
// are 0. Reading does what an exchange between registers would. pairs: two numbers of each row.
template <int W> struct VectorOf;
template <> struct VectorOf<2> {
  typedef double Numbers __attribute__((vector_size(16)));
  typedef long long Integers __attribute__((vector_size(16)));
  static ENTS_INLINE Numbers all(double x) { return Numbers{x, x}; }
  template <int count = 1> static ENTS_INLINE Numbers halves(const double* low, const double* high) {
    return Numbers{*low, *high};
  }
};
#if defined(__AVX__)
template <> struct VectorOf<4> {
  typedef double Numbers __attribute__((vector_size(32)));
  typedef long long Integers __attribute__((vector_size(32)));
  static ENTS_INLINE Numbers all(double x) { return Numbers{x, x, x, x}; }
  template <int count = 2> static ENTS_INLINE Numbers halves(const double* low, const double* high) {
    if constexpr (count == 1)
      return Numbers{*low, 0.0, *high, 0.0};
    else
      return (Numbers)_mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(low)), _mm_loadu_pd(high), 1);
  }
};
#endif
#if defined(__AVX512F__)
template <> struct VectorOf<8> {
  typedef double Numbers __attribute__((vector_size(64)));
  typedef long long Integers __attribute__((vector_size(64)));
  static ENTS_INLINE Numbers all(double x) { return Numbers{x, x, x, x, x, x, x, x}; }
  template <int count = 4> static ENTS_INLINE Numbers halves(const double* low, const double* high) {
    return (Numbers)_mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(half<count>(low)),
                                             half<count>(high), 1);
  }
  static ENTS_INLINE Numbers pairs(const double* a, const double* b, const double* c, const double* d) {
    const __m512d low =
        _mm512_maskz_insertf64x2(0xff, _mm512_castpd128_pd512(_mm_loadu_pd(a)), _mm_loadu_pd(b), 1);
    return (Numbers)_mm512_maskz_insertf64x2(0xff, _mm512_maskz_insertf64x2(0xff, low, _mm_loadu_pd(c), 2),
                                             _mm_loadu_pd(d), 3);
  }

private:
  template <int count> static ENTS_INLINE __m256d half(const double* from) {
    if constexpr (count == 4)
      return _mm256_loadu_pd(from);
    else
      return _mm256_maskload_pd(from, _mm256_setr_epi64x(-1, count > 1 ? -1 : 0, count > 2 ? -1 : 0, 0));
  }
};
#endif

#if defined(__AVX512DQ__)
#define ENTS_HAS_MASKS 1
#endif
template <int W> struct LaneTruth {
  typename VectorOf<W>::Integers v; // -1 or 0
};
#if defined(ENTS_HAS_MASKS)
template <> struct LaneTruth<8> {
  __mmask8 v; // a bit of each lane
};
#endif
template <int W> inline constexpr bool has_masks = sizeof(LaneTruth<W>) == 1;

// a < b, or a <= b
template <int W, bool OrEqual>
ENTS_INLINE LaneTruth<W> is_less(typename VectorOf<W>::Numbers a, typename VectorOf<W>::Numbers b) {
  // clang-format off
#if defined(ENTS_HAS_MASKS)
  if constexpr (has_masks<W>)
    return {_mm512_cmp_pd_mask((__m512d)a, (__m512d)b, OrEqual ? _CMP_LE_OS : _CMP_LT_OS)};
  else
#endif
  if constexpr (OrEqual)
    return {a <= b};
  else
    return {a < b};
  // clang-format on
}
template <int W>
ENTS_INLINE typename VectorOf<W>::Numbers chosen(LaneTruth<W> c, typename VectorOf<W>::Numbers a,
                                                 typename VectorOf<W>::Numbers b) {
#if defined(ENTS_HAS_MASKS)
  if constexpr (has_masks<W>)
    return (typename VectorOf<W>::Numbers)_mm512_mask_blend_pd(c.v, (__m512d)b, (__m512d)a);
  else
#endif
    return c.v ? a : b;
}
template <int W> ENTS_INLINE LaneTruth<W> both(LaneTruth<W> a, LaneTruth<W> b) {
  return {static_cast<decltype(a.v)>(a.v & b.v)};
}
template <int W> ENTS_INLINE LaneTruth<W> either(LaneTruth<W> a, LaneTruth<W> b) {
  return {static_cast<decltype(a.v)>(a.v | b.v)};
}
template <int W> ENTS_INLINE LaneTruth<W> without(LaneTruth<W> a, LaneTruth<W> b) {
  return {static_cast<decltype(a.v)>(a.v & ~b.v)};
}
template <int W> ENTS_INLINE std::uint32_t bits_of(LaneTruth<W> a) {
  if constexpr (has_masks<W>) {
    return a.v;
  } else {
#if defined(__AVX__)
    if constexpr (W == 4)
      return static_cast<std::uint32_t>(__builtin_ia32_movmskpd256((typename VectorOf<W>::Numbers)a.v));
#endif
    std::uint32_t bits = 0;
    for (int k = 0; k < W; ++k) bits |= (a.v[k] != 0 ? 1u : 0u) << k;
    return bits;
  }
}
template <int W> ENTS_INLINE bool any(LaneTruth<W> a) { return bits_of(a) != 0; }
template <int W> ENTS_INLINE bool every(LaneTruth<W> a) { return bits_of(a) == (1u << W) - 1; }

template <int W> struct Lanes {
  using Numbers = typename VectorOf<W>::Numbers;
  Numbers v;
  Lanes() = default;
  // (Written: structs of lanes are then copied register by register. GCC would take 16 bytes at a time, and
  // who reads a register of them would wait for the stores.)
  ENTS_INLINE Lanes(const Lanes& x) : v(x.v) {}
  ENTS_INLINE Lanes& operator=(const Lanes& x) {
    v = x.v;
    return *this;
  }
  ENTS_INLINE Lanes(double x) : v(VectorOf<W>::all(x)) {}
  ENTS_INLINE Lanes(Numbers x, int) : v(x) {}

  friend ENTS_INLINE Lanes operator+(Lanes a, Lanes b) { return Lanes(a.v + b.v, 0); }
  friend ENTS_INLINE Lanes operator-(Lanes a, Lanes b) { return Lanes(a.v - b.v, 0); }
  friend ENTS_INLINE Lanes operator*(Lanes a, Lanes b) { return Lanes(a.v * b.v, 0); }
  friend ENTS_INLINE Lanes operator/(Lanes a, Lanes b) { return Lanes(a.v / b.v, 0); }
  friend ENTS_INLINE Lanes operator-(Lanes a) { return Lanes(-a.v, 0); }
  friend ENTS_INLINE LaneTruth<W> operator<(Lanes a, Lanes b) { return is_less<W, false>(a.v, b.v); }
  friend ENTS_INLINE LaneTruth<W> operator>(Lanes a, Lanes b) { return is_less<W, false>(b.v, a.v); }
  friend ENTS_INLINE LaneTruth<W> operator<=(Lanes a, Lanes b) { return is_less<W, true>(a.v, b.v); }
  friend ENTS_INLINE LaneTruth<W> operator>=(Lanes a, Lanes b) { return is_less<W, true>(b.v, a.v); }
};

template <int W> ENTS_INLINE Lanes<W> value_of(Lanes<W> a) { return a; }
template <int W> ENTS_INLINE Lanes<W> minus_value(Lanes<W> a, Lanes<W> b) { return a - b; }
template <int W> ENTS_INLINE Lanes<W> select(LaneTruth<W> c, Lanes<W> a, Lanes<W> b) {
  return Lanes<W>(chosen(c, a.v, b.v), 0);
}
template <int W> ENTS_INLINE double lane(const Lanes<W>& x, int k) { return x.v[k]; }
// One instruction, whether or not the compiler is told that roots do not set errno.
template <int W> ENTS_INLINE Lanes<W> square_root(Lanes<W> a) {
#if defined(__AVX512F__)
  if constexpr (W == 8)
    return Lanes<W>((typename Lanes<W>::Numbers)_mm512_maskz_sqrt_pd(0xff, (__m512d)a.v), 0);
#endif
#if defined(__AVX__)
  if constexpr (W == 4) return Lanes<W>((typename Lanes<W>::Numbers)_mm256_sqrt_pd((__m256d)a.v), 0);
#endif
  Lanes<W> r;
  for (int k = 0; k < W; ++k) r.v[k] = __builtin_sqrt(a.v[k]);
  return r;
}
template <int W> ENTS_INLINE Lanes<W> absolute(Lanes<W> a) {
  using I = typename VectorOf<W>::Integers;
  return Lanes<W>((typename Lanes<W>::Numbers)((I)a.v & ~(I)Lanes<W>(-0.0).v), 0);
}

template <int W> ENTS_INLINE Lanes<W> power_of_two(Lanes<W> n) {
  using I = typename VectorOf<W>::Integers;
  const Lanes<W> biased = n + (4503599627370496.0 + 1023.0);
  return Lanes<W>((typename Lanes<W>::Numbers)(((I)biased.v) << 52), 0);
}
template <int W> ENTS_INLINE void add_quarters(Lanes<W> quarters, Lanes<W>& sine, Lanes<W>& cosine) {
  using I = typename VectorOf<W>::Integers;
  using V = typename Lanes<W>::Numbers;
  const I n = (I)(quarters + 6755399441055744.0).v;
  const I s = (I)sine.v, c = (I)cosine.v;
  const I swap = (s ^ c) & -(n & 1);
  sine = Lanes<W>((V)(s ^ swap ^ ((n & 2) << 62)), 0);
  cosine = Lanes<W>((V)(c ^ swap ^ (((n + 1) & 2) << 62)), 0);
}

// Two scalars side by side: operations of the one run while the other waits for its own.
template <class T> struct TwiceTruth { T low, high; };
template <class T> ENTS_INLINE TwiceTruth<T> both(TwiceTruth<T> a, TwiceTruth<T> b) {
  return {both(a.low, b.low), both(a.high, b.high)};
}
template <class T> ENTS_INLINE TwiceTruth<T> either(TwiceTruth<T> a, TwiceTruth<T> b) {
  return {either(a.low, b.low), either(a.high, b.high)};
}
template <class T> ENTS_INLINE TwiceTruth<T> without(TwiceTruth<T> a, TwiceTruth<T> b) {
  return {without(a.low, b.low), without(a.high, b.high)};
}
template <class T> ENTS_INLINE bool any(TwiceTruth<T> a) { return any(either(a.low, a.high)); }
template <class T> ENTS_INLINE bool every(TwiceTruth<T> a) { return every(both(a.low, a.high)); }

template <class S> struct Twice {
  S low, high;
  Twice() = default;
  ENTS_INLINE Twice(double x) : low(x), high(x) {}
  ENTS_INLINE Twice(S a, S b) : low(a), high(b) {}

  friend ENTS_INLINE Twice operator+(Twice a, Twice b) { return {a.low + b.low, a.high + b.high}; }
  friend ENTS_INLINE Twice operator-(Twice a, Twice b) { return {a.low - b.low, a.high - b.high}; }
  friend ENTS_INLINE Twice operator*(Twice a, Twice b) { return {a.low * b.low, a.high * b.high}; }
  friend ENTS_INLINE Twice operator/(Twice a, Twice b) { return {a.low / b.low, a.high / b.high}; }
  friend ENTS_INLINE Twice operator-(Twice a) { return {-a.low, -a.high}; }
  friend ENTS_INLINE TwiceTruth<Truth<S>> operator<(Twice a, Twice b) {
    return {a.low < b.low, a.high < b.high};
  }
  friend ENTS_INLINE TwiceTruth<Truth<S>> operator>(Twice a, Twice b) {
    return {a.low > b.low, a.high > b.high};
  }
  friend ENTS_INLINE TwiceTruth<Truth<S>> operator<=(Twice a, Twice b) {
    return {a.low <= b.low, a.high <= b.high};
  }
  friend ENTS_INLINE TwiceTruth<Truth<S>> operator>=(Twice a, Twice b) {
    return {a.low >= b.low, a.high >= b.high};
  }
};
template <class S> ENTS_INLINE Twice<S> value_of(Twice<S> a) { return a; }
template <class S> ENTS_INLINE Twice<S> minus_value(Twice<S> a, Twice<S> b) { return a - b; }
template <class S> ENTS_INLINE Twice<S> select(TwiceTruth<Truth<S>> c, Twice<S> a, Twice<S> b) {
  return {select(c.low, a.low, b.low), select(c.high, a.high, b.high)};
}
template <class S> ENTS_INLINE Twice<S> square_root(Twice<S> a) {
  return {square_root(a.low), square_root(a.high)};
}
template <class S> ENTS_INLINE Twice<S> absolute(Twice<S> a) { return {absolute(a.low), absolute(a.high)}; }
template <class S> ENTS_INLINE Twice<S> power_of_two(Twice<S> n) {
  return {power_of_two(n.low), power_of_two(n.high)};
}
template <class S> ENTS_INLINE void add_quarters(Twice<S> quarters, Twice<S>& sine, Twice<S>& cosine) {
  add_quarters(quarters.low, sine.low, cosine.low);
  add_quarters(quarters.high, sine.high, cosine.high);
}

// What a plain number is to Dual<double>, lanes are to Dual<Lanes>.
template <int W> ENTS_INLINE Dual<Lanes<W>> operator*(Dual<Lanes<W>> a, Lanes<W> b) {
  return {a.v * b, a.d * b};
}
template <int W> ENTS_INLINE Dual<Lanes<W>> operator*(Lanes<W> a, Dual<Lanes<W>> b) {
  return {a * b.v, a * b.d};
}
template <int W> ENTS_INLINE Dual<Lanes<W>> operator+(Dual<Lanes<W>> a, Lanes<W> b) { return {a.v + b, a.d}; }
template <int W> ENTS_INLINE Dual<Lanes<W>> operator+(Lanes<W> a, Dual<Lanes<W>> b) { return {a + b.v, b.d}; }

// Count registers, numbers that are `Distance`, then half of it, .. apart exchanged: squares of 2 Distance
// numbers in them are transposed.
template <int W, int Distance, int Count>
ENTS_INLINE void transpose(typename VectorOf<W>::Numbers (&r)[Count]) {
  if constexpr (Distance > 0) {
    using V = typename VectorOf<W>::Numbers;
    using I = typename VectorOf<W>::Integers;
    I low, high;
    for (int k = 0; k < W; ++k) {
      low[k] = k & Distance ? W + k - Distance : k;
      high[k] = k & Distance ? W + k : k + Distance;
    }
    unroll<Count>([&](auto i) ENTS_LAMBDA_INLINE {
      if constexpr ((i.value & Distance) == 0) {
        const V a = r[i], b = r[i + Distance];
        r[i] = __builtin_shuffle(a, b, low);
        r[i + Distance] = __builtin_shuffle(a, b, high);
      }
    });
    transpose<W, Distance / 2>(r);
  }
}
// W rows of Count numbers, W or half of it, as columns; the k-th row lies at row(k). Of a row no more than
// Read numbers are read.
template <int W, int Count, int Read = Count, class Row>
ENTS_INLINE void read_transposed(Row&& row, typename VectorOf<W>::Numbers (&r)[Count]) {
  constexpr int half = W / 2;
  unroll<half>([&](auto k) ENTS_LAMBDA_INLINE {
    const double *a = row(k), *b = row(k + half);
    unroll<Count / half>([&](auto part) ENTS_LAMBDA_INLINE {
      constexpr int left = Read - part.value * half, count = left < half ? left : half;
      r[k + part * half] = VectorOf<W>::template halves<count>(a + part * half, b + part * half);
    });
  });
  transpose<W, half / 2>(r);
}
#endif

} // namespace ents::ENTS_ISA
