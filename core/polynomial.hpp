// SPDX-License-Identifier: BSD-3-Clause
// Polynomials of natural coordinates with vectors as coefficients, and their derivatives up to the third.
#pragma once

#include "core/surface.hpp"

namespace ents::ENTS_ISA {

// a + x b
template <class V, class S> ENTS_INLINE V raised(V a, const S& x, const V& b) {
  add_scaled(a, x, b);
  return a;
}
// p_0 + p_1 x + ... of vectors, and its derivatives
template <int Degree> struct Polynomial;
template <> struct Polynomial<2> {
  template <class V, class S> static ENTS_INLINE V value(const V (&p)[3], const S& x) { return raised(p[0], x, raised(p[1], x, p[2])); }
  template <class V, class S> static ENTS_INLINE V first(const V (&p)[3], const S& x) { return raised(p[1], 2.0 * x, p[2]); }
  template <class V, class S> static ENTS_INLINE V second(const V (&p)[3], const S&) { return p[2] + p[2]; }
};
template <> struct Polynomial<3> {
  template <class V, class S> static ENTS_INLINE V value(const V (&p)[4], const S& x) {
    return raised(p[0], x, raised(p[1], x, raised(p[2], x, p[3])));
  }
  template <class V, class S> static ENTS_INLINE V first(const V (&p)[4], const S& x) {
    return raised(p[1], 2.0 * x, raised(p[2], 1.5 * x, p[3]));
  }
  template <class V, class S> static ENTS_INLINE V second(const V (&p)[4], const S& x) { return raised(p[2] + p[2], 6.0 * x, p[3]); }
  template <class V, class S> static ENTS_INLINE V third(const V (&p)[4], const S&) { return S(6.0) * p[3]; }
};

// rho - x_s = sum c_ji xi_1^i xi_2^j
template <class F, class S> struct TensorPolynomial {
  static constexpr int count = F::count, terms = F::degree + 1;
  using V = Vec<S, 3>;
  using P = Polynomial<F::degree>;
  V c[terms][terms];

  // y[j][i]: node of the i-th function of xi_1 and the j-th of xi_2
  ENTS_INLINE void contract(const V (&y)[count][count]) {
    V along[count][terms];
    for (int j = 0; j < count; ++j) F::template powers<S>(y[j], along[j]);
    for (int i = 0; i < terms; ++i) {
      V column[count], powers[terms];
      for (int j = 0; j < count; ++j) column[j] = along[j][i];
      F::template powers<S>(column, powers);
      for (int j = 0; j < terms; ++j) c[j][i] = powers[j];
    }
  }

  template <int Order, class B, bool H> ENTS_INLINE void evaluate(const S (&xi)[2], Surface<B, H, S>& s) const {
    const S &x = xi[0], &y = xi[1];
    V at[terms], by_1[terms], by_11[terms]; // at xi_1: factors of the powers of xi_2
    for (int j = 0; j < terms; ++j) {
      at[j] = P::value(c[j], x);
      by_1[j] = P::first(c[j], x);
      by_11[j] = P::second(c[j], x);
    }
    s.d = -P::value(at, y);
    s.a[0] = P::value(by_1, y);
    s.a[1] = P::first(at, y);
    s.a2[0] = P::value(by_11, y);
    s.a2[1] = P::first(by_1, y);
    s.a2[2] = P::second(at, y);
    if constexpr (Order > 2) set_thirds(xi, at, by_1, by_11, s.a3);
  }
  ENTS_INLINE void thirds(const S (&xi)[2], V (&a3)[4]) const {
    V at[terms], by_1[terms], by_11[terms];
    for (int j = 0; j < terms; ++j) {
      if constexpr (F::degree > 2) at[j] = P::value(c[j], xi[0]);
      by_1[j] = P::first(c[j], xi[0]);
      by_11[j] = P::second(c[j], xi[0]);
    }
    set_thirds(xi, at, by_1, by_11, a3);
  }
  ENTS_INLINE void third_rates(const S (&xi)[2], const S (&y)[2], V (&rate)[4]) const {
    V by_11[terms];
    for (int j = 0; j < terms; ++j) by_11[j] = P::second(c[j], xi[0]);
    const V by_1122 = P::second(by_11, xi[1]);
    rate[1] = y[1] * by_1122;
    rate[2] = y[0] * by_1122;
    if constexpr (F::degree > 2) {
      V by_1[terms], by_111[terms];
      for (int j = 0; j < terms; ++j) {
        by_1[j] = P::first(c[j], xi[0]);
        by_111[j] = P::third(c[j], xi[0]);
      }
      const V by_1112 = P::first(by_111, xi[1]), by_1222 = P::third(by_1, xi[1]);
      rate[0] = y[1] * by_1112;
      rate[3] = y[0] * by_1222;
      add_scaled(rate[1], y[0], by_1112);
      add_scaled(rate[2], y[1], by_1222);
    } else {
      rate[0] = rate[3] = V::zero();
    }
  }

private:
  ENTS_INLINE void set_thirds(const S (&xi)[2], const V (&at)[terms], const V (&by_1)[terms], const V (&by_11)[terms], V (&a3)[4]) const {
    a3[1] = P::first(by_11, xi[1]);
    a3[2] = P::second(by_1, xi[1]);
    if constexpr (F::degree > 2) {
      V by_111[terms];
      for (int j = 0; j < terms; ++j) by_111[j] = P::third(c[j], xi[0]);
      a3[0] = P::value(by_111, xi[1]);
      a3[3] = P::third(at, xi[1]);
    } else {
      a3[0] = a3[3] = V::zero();
    }
  }
};

// rho - x_s = sum c_kj xi_1^j xi_2^k, j + k <= 4, of a quartic Bezier triangle
template <class S> struct TrianglePolynomial {
  static constexpr int degree = 4;
  using V = Vec<S, 3>;
  V c[degree + 1][degree + 1];

  // With differences D_1, D_2 of neighbours along xi_1, xi_2: c_kj = 4! / (j! k! (4 - j - k)!) D_1^j D_2^k b
  ENTS_INLINE void contract(const V (&points)[Bezier15::nodes]) {
    for (int n = 0; n < Bezier15::nodes; ++n) c[Bezier15::power[n][2]][Bezier15::power[n][1]] = points[n];
    for (int order = 1; order <= degree; ++order)
      for (int k = 0; k <= degree - order; ++k)
        for (int j = degree - k; j >= order; --j) c[k][j] = c[k][j] - c[k][j - 1];
    for (int order = 1; order <= degree; ++order)
      for (int j = 0; j <= degree - order; ++j)
        for (int k = degree - j; k >= order; --k) c[k][j] = c[k][j] - c[k - 1][j];
    constexpr double factorial[degree + 1] = {1.0, 1.0, 2.0, 6.0, 24.0};
    for (int k = 0; k <= degree; ++k)
      for (int j = 0; j <= degree - k; ++j)
        if (j + k > 0) c[k][j] = S(24.0 / (factorial[j] * factorial[k] * factorial[degree - j - k])) * c[k][j];
  }

  template <int Order, class B, bool H> ENTS_INLINE void evaluate(const S (&xi)[2], Surface<B, H, S>& s) const {
    V d[Order + 1][Order + 1]; // [by xi_1][by xi_2]
    differentiate<Order>(xi, d);
    s.d = -d[0][0];
    s.a[0] = d[1][0];
    s.a[1] = d[0][1];
    s.a2[0] = d[2][0] + d[2][0];
    s.a2[1] = d[1][1];
    s.a2[2] = d[0][2] + d[0][2];
    if constexpr (Order > 2) set_thirds(d, s.a3);
  }
  ENTS_INLINE void thirds(const S (&xi)[2], V (&a3)[4]) const {
    V d[4][4];
    differentiate<3>(xi, d);
    set_thirds(d, a3);
  }
  ENTS_INLINE void third_rates(const S (&)[2], const S (&y)[2], V (&rate)[4]) const {
    constexpr double factor[degree + 1] = {24.0, 6.0, 4.0, 6.0, 24.0};
    for (int k = 0; k < 4; ++k) {
      rate[k] = (y[0] * factor[k]) * c[k][degree - k];
      add_scaled(rate[k], y[1] * factor[k + 1], c[k + 1][degree - k - 1]);
    }
  }

private:
  // d[m]: the m-th derivative of p_0 + p_1 x + ... over m!, m <= Most and Degree
  template <int Degree, int Most> static ENTS_INLINE void horner(const V* p, const S& x, V (&d)[Most + 1]) {
    d[0] = p[Degree];
    for (int i = Degree - 1; i >= 0; --i) {
      for (int m = Most < Degree - i ? Most : Degree - i; m > 0; --m) d[m] = m == Degree - i ? d[m - 1] : raised(d[m - 1], x, d[m]);
      d[0] = raised(p[i], x, d[0]);
    }
  }
  // the same of both, together up to Order
  template <int Order> ENTS_INLINE void differentiate(const S (&xi)[2], V (&d)[Order + 1][Order + 1]) const {
    V at[Order + 1][degree + 1]; // at xi_1, [by xi_1]: factors of the powers of xi_2
    unroll<degree + 1>([&](auto k) ENTS_LAMBDA_INLINE {
      constexpr int left = degree - k.value, most = left < Order ? left : Order;
      V of_row[most + 1];
      horner<left, most>(c[k], xi[0], of_row);
      for (int m = 0; m <= most; ++m) at[m][k] = of_row[m];
    });
    unroll<Order + 1>([&](auto m) ENTS_LAMBDA_INLINE {
      V of_column[Order - m.value + 1];
      horner<degree - m.value, Order - m.value>(at[m], xi[1], of_column);
      for (int n = 0; n <= Order - m.value; ++n) d[m][n] = of_column[n];
    });
  }
  static ENTS_INLINE void set_thirds(const V (&d)[4][4], V (&a3)[4]) {
    a3[0] = S(6.0) * d[3][0];
    a3[1] = d[2][1] + d[2][1];
    a3[2] = d[1][2] + d[1][2];
    a3[3] = S(6.0) * d[0][3];
  }
};

} // namespace ents::ENTS_ISA
