// SPDX-License-Identifier: BSD-3-Clause
// Vectors of the physical space (d = 2 or 3) over a kernel scalar. Plain aggregates: they must stay in
// registers and be compiled for several instruction sets without sharing inline functions.
#pragma once

#include "core/numbers/scalar.hpp"

namespace ents::ENTS_ISA {

template <class S, int D> struct Vec {
  S c[D];
  ENTS_INLINE void set(int i, const S& x) { c[i] = x; }
  ENTS_INLINE S& operator[](int i) { return c[i]; }
  ENTS_INLINE const S& operator[](int i) const { return c[i]; }
  static ENTS_INLINE Vec zero() {
    Vec v;
    for (int i = 0; i < D; ++i) v.c[i] = S(0.0);
    return v;
  }
};

// The vector that begins at `from`
template <int D> ENTS_INLINE Vec<double, D> vec_at(const double* from) {
  Vec<double, D> a;
  for (int i = 0; i < D; ++i) a.set(i, from[i]);
  return a;
}
template <class S, int D> ENTS_INLINE Vec<S, D> value_of(const Vec<Dual<S>, D>& a) {
  Vec<S, D> v;
  for (int i = 0; i < D; ++i) v[i] = a[i].v;
  return v;
}
template <class S, int D> ENTS_INLINE Vec<S, D> derivative_of(const Vec<Dual<S>, D>& a) {
  Vec<S, D> d;
  for (int i = 0; i < D; ++i) d[i] = a[i].d;
  return d;
}
template <class S, int D>
ENTS_INLINE void set_dual(Vec<Dual<S>, D>& a, const Vec<S, D>& value, const Vec<S, D>& derivative) {
  for (int i = 0; i < D; ++i) a[i] = Dual<S>(value[i], derivative[i]);
}
template <class S, int D> ENTS_INLINE void set_constant(Vec<Dual<S>, D>& a, const Vec<S, D>& value) {
  set_dual(a, value, Vec<S, D>::zero());
}

template <class S, int D> ENTS_INLINE Vec<S, D> operator+(const Vec<S, D>& a, const Vec<S, D>& b) {
  Vec<S, D> v;
  for (int i = 0; i < D; ++i) v.c[i] = a.c[i] + b.c[i];
  return v;
}
template <class S, int D> ENTS_INLINE Vec<S, D> operator-(const Vec<S, D>& a, const Vec<S, D>& b) {
  Vec<S, D> v;
  for (int i = 0; i < D; ++i) v.c[i] = a.c[i] - b.c[i];
  return v;
}
template <class S, int D> ENTS_INLINE Vec<S, D> operator-(const Vec<S, D>& a) {
  Vec<S, D> v;
  for (int i = 0; i < D; ++i) v.c[i] = -a.c[i];
  return v;
}
template <class S, int D> ENTS_INLINE Vec<S, D> operator*(const S& s, const Vec<S, D>& a) {
  Vec<S, D> v;
  for (int i = 0; i < D; ++i) v.c[i] = s * a.c[i];
  return v;
}
// a += s b
template <class S, int D> ENTS_INLINE void add_scaled(Vec<S, D>& a, S s, const Vec<S, D>& b) {
  for (int i = 0; i < D; ++i) a.c[i] = a.c[i] + s * b.c[i];
}
template <class S, int D> ENTS_INLINE S dot(const Vec<S, D>& a, const Vec<S, D>& b) {
  S s = a.c[0] * b.c[0];
  for (int i = 1; i < D; ++i) s = s + a.c[i] * b.c[i];
  return s;
}
template <class S, int D> ENTS_INLINE void store(const Vec<S, D>& a, S* to) {
  for (int i = 0; i < D; ++i) to[i] = a[i];
}
template <class S> ENTS_INLINE Vec<S, 3> cross(const Vec<S, 3>& a, const Vec<S, 3>& b) {
  return {{a.c[1] * b.c[2] - a.c[2] * b.c[1], a.c[2] * b.c[0] - a.c[0] * b.c[2],
           a.c[0] * b.c[1] - a.c[1] * b.c[0]}};
}

#if defined(__AVX__) && defined(__GNUC__) && !defined(__clang__)
} // namespace ents::ENTS_ISA
#include "core/numbers/packed_vec.hpp"
namespace ents::ENTS_ISA {
#endif

// The vector m that points along the normal of a surface with the tangents a: the tangent turned by +90
// degrees in 2D, a_1 x a_2 in 3D.
template <class S> ENTS_INLINE Vec<S, 2> normal_of_tangents(const Vec<S, 2> (&a)[1]) {
  return {{-a[0].c[1], a[0].c[0]}};
}
template <class S> ENTS_INLINE Vec<S, 3> normal_of_tangents(const Vec<S, 3> (&a)[2]) {
  return cross(a[0], a[1]);
}

// Symmetric matrices of the parameter space (1 x 1 or 2 x 2) are stored as 11 | 11, 12, 22.
template <int T> inline constexpr int symmetric_size = T*(T + 1) / 2;
ENTS_INLINE constexpr int symmetric_index(int a, int b) { return a + b; } // T <= 2

template <class S> ENTS_INLINE S determinant(const S (&m)[1]) { return m[0]; }
template <class S> ENTS_INLINE S determinant(const S (&m)[3]) { return m[0] * m[2] - m[1] * m[1]; }

// inverse[] of a symmetric matrix, from the inverse of its determinant or from the determinant, which is not
// zero
template <class S> ENTS_INLINE void invert_with(const S (&)[1], const S& inverse_det, S (&inverse)[1]) {
  inverse[0] = inverse_det;
}
template <class S> ENTS_INLINE void invert_with(const S (&m)[3], const S& inverse_det, S (&inverse)[3]) {
  inverse[0] = m[2] * inverse_det;
  inverse[1] = -m[1] * inverse_det;
  inverse[2] = m[0] * inverse_det;
}
template <int K, class S> ENTS_INLINE void invert(const S (&m)[K], const S& det, S (&inverse)[K]) {
  invert_with(m, S(1.0 / det), inverse);
}

// Compile-time loop: f(Index<0>{}), f(Index<1>{}), ...
template <int I> struct Index {
  static constexpr int value = I;
  constexpr operator int() const { return I; }
};
template <int N, int I = 0, class F> ENTS_INLINE void unroll(F&& f) {
  if constexpr (I < N) {
    f(Index<I>{});
    unroll<N, I + 1>(f);
  }
}

} // namespace ents::ENTS_ISA
