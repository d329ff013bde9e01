// SPDX-License-Identifier: BSD-3-Clause
// Vectors of space in one register of four numbers, for the kernels that are compiled for AVX: the operations
// on each component are those of vec.hpp in the same order, so the bits are the same.
#pragma once

namespace ents::ENTS_ISA {

// One vector of space in one register; the fourth component is of no meaning.
template <> struct Vec<double, 3> {
  typedef double Numbers __attribute__((vector_size(32)));
  typedef long long Integers __attribute__((vector_size(32)));
  Numbers v;
  Vec() = default;
  ENTS_INLINE explicit Vec(Numbers x) : v(x) {}
  ENTS_INLINE Vec(double x, double y, double z) : v(Numbers{x, y, z, 0.0}) {}
  ENTS_INLINE void set(int i, double x) { v[i] = x; }
  ENTS_INLINE double& operator[](int i) { return reinterpret_cast<double*>(&v)[i]; }
  ENTS_INLINE const double& operator[](int i) const { return reinterpret_cast<const double*>(&v)[i]; }
  static ENTS_INLINE Vec zero() { return Vec(Numbers{0.0, 0.0, 0.0, 0.0}); }
};
template <> struct Vec<Dual<double>, 3> {
  Vec<double, 3> v, d;
  Vec() = default;
  ENTS_INLINE Vec(const Vec<double, 3>& value, const Vec<double, 3>& derivative) : v(value), d(derivative) {}
  ENTS_INLINE void set(int i, Dual<double> x) {
    v.set(i, x.v);
    d.set(i, x.d);
  }
  ENTS_INLINE const Dual<double> operator[](int i) const { return {v[i], d[i]}; }
  static ENTS_INLINE Vec zero() { return Vec(Vec<double, 3>::zero(), Vec<double, 3>::zero()); }
};

ENTS_INLINE Vec<double, 3> operator+(Vec<double, 3> a, const Vec<double, 3>& b) {
  return Vec<double, 3>(a.v + b.v);
}
ENTS_INLINE Vec<double, 3> operator-(Vec<double, 3> a, const Vec<double, 3>& b) {
  return Vec<double, 3>(a.v - b.v);
}
ENTS_INLINE Vec<double, 3> operator-(Vec<double, 3> a) { return Vec<double, 3>(-a.v); }
ENTS_INLINE Vec<double, 3> operator*(double s, Vec<double, 3> a) {
  return Vec<double, 3>(Vec<double, 3>::Numbers{s, s, s, s} * a.v);
}
ENTS_INLINE void add_scaled(Vec<double, 3>& a, double s, const Vec<double, 3>& b) {
  a.v = a.v + Vec<double, 3>::Numbers{s, s, s, s} * b.v;
}
ENTS_INLINE double dot(const Vec<double, 3>& a, const Vec<double, 3>& b) {
  const Vec<double, 3>::Numbers p = a.v * b.v;
  return p[0] + p[1] + p[2];
}
ENTS_INLINE Vec<double, 3> value_of(const Vec<Dual<double>, 3>& a) { return a.v; }
ENTS_INLINE Vec<double, 3> derivative_of(const Vec<Dual<double>, 3>& a) { return a.d; }
ENTS_INLINE void set_dual(Vec<Dual<double>, 3>& a, const Vec<double, 3>& value,
                          const Vec<double, 3>& derivative) {
  a.v = value;
  a.d = derivative;
}
ENTS_INLINE void store(const Vec<double, 3>& a, double* to) {
  typedef double Two __attribute__((vector_size(16)));
  const Two low = {a.v[0], a.v[1]};
  __builtin_memcpy(to, &low, sizeof low);
  to[2] = a.v[2];
}
// (a_2, a_3, a_1) and (a_3, a_1, a_2)
ENTS_INLINE Vec<double, 3> rolled(const Vec<double, 3>& a) {
  return Vec<double, 3>(__builtin_shuffle(a.v, Vec<double, 3>::Integers{1, 2, 0, 3}));
}
ENTS_INLINE Vec<double, 3> rolled_twice(const Vec<double, 3>& a) {
  return Vec<double, 3>(__builtin_shuffle(a.v, Vec<double, 3>::Integers{2, 0, 1, 3}));
}
ENTS_INLINE Vec<double, 3> cross(const Vec<double, 3>& a, const Vec<double, 3>& b) {
  return Vec<double, 3>(rolled(a).v * rolled_twice(b).v - rolled_twice(a).v * rolled(b).v);
}
template <> ENTS_INLINE Vec<double, 3> vec_at<3>(const double* from) {
  return Vec<double, 3>(__builtin_ia32_maskloadpd256(reinterpret_cast<const Vec<double, 3>::Numbers*>(from),
                                                     Vec<double, 3>::Integers{-1, -1, -1, 0}));
}

using DualVec = Vec<Dual<double>, 3>;
ENTS_INLINE DualVec operator+(const DualVec& a, const DualVec& b) { return {a.v + b.v, a.d + b.d}; }
ENTS_INLINE DualVec operator-(const DualVec& a, const DualVec& b) { return {a.v - b.v, a.d - b.d}; }
ENTS_INLINE DualVec operator-(const DualVec& a) { return {-a.v, -a.d}; }
ENTS_INLINE DualVec operator*(Dual<double> s, const DualVec& a) { return {s.v * a.v, s.v * a.d + s.d * a.v}; }
ENTS_INLINE void add_scaled(DualVec& a, Dual<double> s, const DualVec& b) { a = a + s * b; }
ENTS_INLINE Dual<double> dot(const DualVec& a, const DualVec& b) {
  const Vec<double, 3>::Numbers value = a.v.v * b.v.v, change = a.v.v * b.d.v + a.d.v * b.v.v;
  return {value[0] + value[1] + value[2], change[0] + change[1] + change[2]};
}
ENTS_INLINE DualVec cross(const DualVec& a, const DualVec& b) {
  const auto product = [](const DualVec& x, const DualVec& y) ENTS_LAMBDA_INLINE {
    return DualVec(Vec<double, 3>(x.v.v * y.v.v), Vec<double, 3>(x.v.v * y.d.v + x.d.v * y.v.v));
  };
  return product({rolled(a.v), rolled(a.d)}, {rolled_twice(b.v), rolled_twice(b.d)}) -
         product({rolled_twice(a.v), rolled_twice(a.d)}, {rolled(b.v), rolled(b.d)});
}

} // namespace ents::ENTS_ISA
