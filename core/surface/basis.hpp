// SPDX-License-Identifier: BSD-3-Clause
// Segment bases: rho(xi) = sum_i N_i(xi) x_i, linear in the nodes for every basis. Smoothed surfaces
// (Catmull-Rom = Overhauser, uniform cubic B-spline) are just more bases.
//
// A basis B says
//   B::dim, B::nodes      d and the number m of master nodes; T = d - 1 convective coordinates
//   B::second[k]          is the second derivative 11 | 11, 12, 22 not identically zero?
//   B::third[k]           the same for the third derivatives 111 | 111, 112, 122, 222
//   B::degree             of its polynomials: per direction or, of a triangle, in all
//   B::simplex            domain xi >= 0, sum xi <= 1 instead of -1 .. 1 per direction
//   B::shape<Order>(xi, s)   N and its derivatives up to Order (at most 3), to a Shape of so many nodes or
//                            more
// What is not computed (order, identically zero) must not be read.
#pragma once

#include "core/numbers/vec.hpp"

namespace ents::ENTS_ISA {

template <class S, int T, int M> struct Shape {
  S n[M];
  S d1[T][M];
  S d2[symmetric_size<T>][M];
  S d3[T == 1 ? 1 : 4][M];
};

// One-dimensional families: values and derivatives [order][function] at x in -1 .. 1; powers: sum_i f_i v_i
// as factors of 1, x, x^2 ..., for vectors v.
struct Linear1D {
  static constexpr int count = 2, degree = 1;
  template <int Order, class S> static ENTS_INLINE void eval(S x, S (&f)[4][count]) {
    f[0][0] = 0.5 * (1.0 - x);
    f[0][1] = 0.5 * (1.0 + x);
    f[1][0] = S(-0.5);
    f[1][1] = S(0.5);
  }
};
struct Quadratic1D { // ends, then middle
  static constexpr int count = 3, degree = 2;
  template <int Order, class S> static ENTS_INLINE void eval(S x, S (&f)[4][count]) {
    f[0][0] = 0.5 * x * (x - 1.0);
    f[0][1] = 0.5 * x * (x + 1.0);
    f[0][2] = (1.0 - x) * (1.0 + x);
    f[1][0] = x - 0.5;
    f[1][1] = x + 0.5;
    f[1][2] = -2.0 * x;
    f[2][0] = S(1.0);
    f[2][1] = S(1.0);
    f[2][2] = S(-2.0);
  }
  template <class S, class V> static ENTS_INLINE void powers(const V* v, V* p) {
    p[0] = v[2];
    p[1] = S(0.5) * (v[1] - v[0]);
    p[2] = S(0.5) * (v[1] + v[0]) - v[2];
  }
};
// Cubics in t = (x + 1) / 2 on the middle one of three spans of four nodes.
template <class Coefficients> struct Cubic1D {
  static constexpr int count = 4, degree = 3;
  template <int Order, class S> static ENTS_INLINE void eval(S x, S (&f)[4][count]) {
    const S t = 0.5 * (x + 1.0);
    for (int i = 0; i < 4; ++i) {
      constexpr double scale = Coefficients::scale;
      const double c0 = scale * Coefficients::c[i][0], c1 = scale * Coefficients::c[i][1],
                   c2 = scale * Coefficients::c[i][2], c3 = scale * Coefficients::c[i][3];
      f[0][i] = c0 + t * (c1 + t * (c2 + t * c3));
      f[1][i] = 0.5 * (c1 + t * (2.0 * c2 + t * (3.0 * c3)));
      f[2][i] = 0.25 * (2.0 * c2 + t * (6.0 * c3));
      if constexpr (Order > 2) f[3][i] = S(0.125 * 6.0 * c3);
    }
  }
  // of function i, times x^k: t^l = (1 + x)^l / 2^l
  static constexpr double power(int i, int k) {
    constexpr double binomial[4][4] = {{1, 1, 1, 1}, {0, 1, 2, 3}, {0, 0, 1, 3}, {0, 0, 0, 1}};
    double sum = 0.0;
    for (int l = 3; l >= k; --l) sum = 0.5 * sum + Coefficients::c[i][l] * binomial[k][l];
    for (int l = 0; l < k; ++l) sum *= 0.5;
    return Coefficients::scale * sum;
  }
  template <class S, class V> static ENTS_INLINE void powers(const V* v, V* p) {
    unroll<4>([&](auto k) ENTS_LAMBDA_INLINE {
      p[k] = S(power(0, k)) * v[0];
      unroll<3>([&](auto i) ENTS_LAMBDA_INLINE {
        if constexpr (power(i + 1, k) != 0.0) add_scaled(p[k], S(power(i + 1, k)), v[i + 1]);
      });
    });
  }
};
// Overhauser 1968; Catmull & Rom 1974, tension 1/2: interpolating, C1
struct CatmullRomCoefficients {
  static constexpr double scale = 0.5;
  static constexpr double c[4][4] = {{0, -1, 2, -1}, {2, 0, -5, 3}, {0, 1, 4, -3}, {0, 0, -1, 1}};
};
// uniform cubic B-spline: approximating, C2
struct BSplineCoefficients {
  static constexpr double scale = 1.0 / 6.0;
  static constexpr double c[4][4] = {{1, -3, 3, -1}, {4, 0, -6, 3}, {1, 3, 3, -3}, {0, 0, 0, 1}};
};
using CatmullRom1D = Cubic1D<CatmullRomCoefficients>;
using BSpline1D = Cubic1D<BSplineCoefficients>;

template <class F> struct LineBasis {
  static constexpr int dim = 2, nodes = F::count, degree = F::degree;
  static constexpr bool simplex = false;
  static constexpr bool second[1] = {F::degree >= 2};
  static constexpr bool third[1] = {F::degree >= 3};
  template <int Order, class S, class Out> static ENTS_INLINE void shape(const S (&xi)[1], Out& s) {
    S f[4][nodes];
    F::template eval<Order>(xi[0], f);
    for (int i = 0; i < nodes; ++i) {
      s.n[i] = f[0][i];
      if constexpr (Order > 0) s.d1[0][i] = f[1][i];
      if constexpr (Order > 1 && second[0]) s.d2[0][i] = f[2][i];
      if constexpr (Order > 2 && third[0]) s.d3[0][i] = f[3][i];
    }
  }
};

// N_i(xi) = F_(Numbering::i[i])(xi_1) F_(Numbering::j[i])(xi_2)
template <class F, class Numbering> struct TensorBasis {
  static constexpr int dim = 3, nodes = F::count * F::count, degree = F::degree;
  static constexpr bool simplex = false;
  static constexpr bool second[3] = {F::degree >= 2, true, F::degree >= 2};
  static constexpr bool third[4] = {F::degree >= 3, F::degree >= 2, F::degree >= 2, F::degree >= 3};
  template <int Order, class S, class Out> static ENTS_INLINE void shape(const S (&xi)[2], Out& s) {
    S f[4][F::count], g[4][F::count];
    F::template eval<Order>(xi[0], f);
    F::template eval<Order>(xi[1], g);
    for (int k = 0; k < nodes; ++k) {
      const int i = Numbering::i[k], j = Numbering::j[k];
      s.n[k] = f[0][i] * g[0][j];
      if constexpr (Order > 0) {
        s.d1[0][k] = f[1][i] * g[0][j];
        s.d1[1][k] = f[0][i] * g[1][j];
      }
      if constexpr (Order > 1) {
        if constexpr (second[0]) s.d2[0][k] = f[2][i] * g[0][j];
        s.d2[1][k] = f[1][i] * g[1][j];
        if constexpr (second[2]) s.d2[2][k] = f[0][i] * g[2][j];
      }
      if constexpr (Order > 2) {
        if constexpr (third[0]) s.d3[0][k] = f[3][i] * g[0][j];
        if constexpr (third[1]) s.d3[1][k] = f[2][i] * g[1][j];
        if constexpr (third[2]) s.d3[2][k] = f[1][i] * g[2][j];
        if constexpr (third[3]) s.d3[3][k] = f[0][i] * g[3][j];
      }
    }
  }
};
struct Corners { // (-1,-1) (1,-1) (1,1) (-1,1)
  static constexpr int i[4] = {0, 1, 1, 0}, j[4] = {0, 0, 1, 1};
};
struct CornersMidsidesCentre { // corners, mid-sides 12 23 34 41, centre
  static constexpr int i[9] = {0, 1, 1, 0, 2, 1, 2, 0, 2}, j[9] = {0, 0, 1, 1, 0, 2, 1, 2, 2};
};
struct RowByRow { // index 4 j + i, i along the first direction
  static constexpr int i[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
  static constexpr int j[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
};

using Line2 = LineBasis<Linear1D>;
using Line3 = LineBasis<Quadratic1D>;
using CatmullRom4 = LineBasis<CatmullRom1D>;
using BSpline4 = LineBasis<BSpline1D>;
using Quad4 = TensorBasis<Linear1D, Corners>;
using Quad9 = TensorBasis<Quadratic1D, CornersMidsidesCentre>;
using CatmullRom16 = TensorBasis<CatmullRom1D, RowByRow>;
using BSpline16 = TensorBasis<BSpline1D, RowByRow>;

// Serendipity quad8 = quad9 whose centre node is -1/4 of the corners + 1/2 of the mid-sides.
struct Quad8 {
  static constexpr int dim = 3, nodes = 8, degree = 2;
  static constexpr bool simplex = false;
  static constexpr bool second[3] = {true, true, true};
  static constexpr bool third[4] = {false, true, true, false};
  template <int Order, class S, class Out> static ENTS_INLINE void shape(const S (&xi)[2], Out& s) {
    Shape<S, 2, 9> q;
    Quad9::shape<Order>(xi, q);
    const auto condense = [](const S(&from)[9], auto& to) ENTS_LAMBDA_INLINE {
      for (int k = 0; k < 8; ++k) to[k] = from[k] + (k < 4 ? -0.25 : 0.5) * from[8];
    };
    condense(q.n, s.n);
    if constexpr (Order > 0) unroll<2>([&](auto a) ENTS_LAMBDA_INLINE { condense(q.d1[a], s.d1[a]); });
    if constexpr (Order > 1) unroll<3>([&](auto a) ENTS_LAMBDA_INLINE { condense(q.d2[a], s.d2[a]); });
    if constexpr (Order > 2) {
      condense(q.d3[1], s.d3[1]);
      condense(q.d3[2], s.d3[2]);
    }
  }
};

struct Tri3 {
  static constexpr int dim = 3, nodes = 3, degree = 1;
  static constexpr bool simplex = true;
  static constexpr bool second[3] = {false, false, false};
  static constexpr bool third[4] = {false, false, false, false};
  template <int Order, class S, class Out> static ENTS_INLINE void shape(const S (&xi)[2], Out& s) {
    s.n[0] = 1.0 - xi[0] - xi[1];
    s.n[1] = xi[0];
    s.n[2] = xi[1];
    if constexpr (Order > 0) {
      const double d[2][3] = {{-1, 1, 0}, {-1, 0, 1}};
      for (int a = 0; a < 2; ++a)
        for (int k = 0; k < 3; ++k) s.d1[a][k] = S(d[a][k]);
    }
  }
};

struct Tri6 { // corners, mid-sides 12 23 31
  static constexpr int dim = 3, nodes = 6, degree = 2;
  static constexpr bool simplex = true;
  static constexpr bool second[3] = {true, true, true};
  static constexpr bool third[4] = {false, false, false, false};
  template <int Order, class S, class Out> static ENTS_INLINE void shape(const S (&xi)[2], Out& s) {
    const S x = xi[0], y = xi[1], z = 1.0 - x - y;
    s.n[0] = z * (2.0 * z - 1.0);
    s.n[1] = x * (2.0 * x - 1.0);
    s.n[2] = y * (2.0 * y - 1.0);
    s.n[3] = 4.0 * z * x;
    s.n[4] = 4.0 * x * y;
    s.n[5] = 4.0 * y * z;
    if constexpr (Order > 0) {
      const S corner = 1.0 - 4.0 * z;
      const S d1[6] = {corner, 4.0 * x - 1.0, S(0.0), 4.0 * (z - x), 4.0 * y, -4.0 * y};
      const S d2[6] = {corner, S(0.0), 4.0 * y - 1.0, -4.0 * x, 4.0 * x, 4.0 * (z - y)};
      for (int k = 0; k < 6; ++k) s.d1[0][k] = d1[k], s.d1[1][k] = d2[k];
    }
    if constexpr (Order > 1) {
      const double d[3][6] = {{4, 4, 0, -8, 0, 0}, {4, 0, 0, -4, 4, -4}, {4, 0, 4, 0, 0, -8}};
      for (int a = 0; a < 3; ++a)
        for (int k = 0; k < 6; ++k) s.d2[a][k] = S(d[a][k]);
    }
  }
};

// Quartic Bezier triangle: the control points b_ijk of sum 24 / (i! j! k!) z^i x^j y^k b_ijk, z = 1 - x - y.
// Corners, then the three on each edge 12 23 31 in its direction, then the inner ones, each next to its
// corner. It has every regular patch of Loop's subdivision surface.
struct Bezier15 {
  static constexpr int dim = 3, nodes = 15, degree = 4;
  static constexpr bool simplex = true;
  static constexpr bool second[3] = {true, true, true};
  static constexpr bool third[4] = {true, true, true, true};
  static constexpr int power[nodes][3] = {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {3, 1, 0}, {2, 2, 0},
                                          {1, 3, 0}, {0, 3, 1}, {0, 2, 2}, {0, 1, 3}, {1, 0, 3},
                                          {2, 0, 2}, {3, 0, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}};

  // Derivatives of Bernstein polynomials are differences of those of lower degree: by x, lower j less lower
  // i.
  template <int Order, class S, class Out> static ENTS_INLINE void shape(const S (&xi)[2], Out& s) {
    const S of[3] = {1.0 - xi[0] - xi[1], xi[0], xi[1]};
    S p[3][5];
    for (int v = 0; v < 3; ++v) {
      p[v][0] = S(1.0);
      for (int e = 1; e < 5; ++e) p[v][e] = p[v][e - 1] * of[v];
    }
    constexpr double factorial[5] = {1.0, 1.0, 2.0, 6.0, 24.0};
    for (int n = 0; n < nodes; ++n) {
      // 4! times Bernstein's polynomial of lower degree, over that degree's factorial
      const auto b = [&](int less_i, int less_j, int less_k) ENTS_LAMBDA_INLINE {
        const int i = power[n][0] - less_i, j = power[n][1] - less_j, k = power[n][2] - less_k;
        if (i < 0 || j < 0 || k < 0) return S(0.0);
        return 24.0 / (factorial[i] * factorial[j] * factorial[k]) * (p[0][i] * (p[1][j] * p[2][k]));
      };
      s.n[n] = b(0, 0, 0);
      if constexpr (Order > 0) {
        s.d1[0][n] = b(0, 1, 0) - b(1, 0, 0);
        s.d1[1][n] = b(0, 0, 1) - b(1, 0, 0);
      }
      if constexpr (Order > 1) {
        s.d2[0][n] = b(0, 2, 0) - 2.0 * b(1, 1, 0) + b(2, 0, 0);
        s.d2[1][n] = b(0, 1, 1) - b(1, 1, 0) - b(1, 0, 1) + b(2, 0, 0);
        s.d2[2][n] = b(0, 0, 2) - 2.0 * b(1, 0, 1) + b(2, 0, 0);
      }
      if constexpr (Order > 2) {
        s.d3[0][n] = b(0, 3, 0) - 3.0 * b(1, 2, 0) + 3.0 * b(2, 1, 0) - b(3, 0, 0);
        s.d3[1][n] = b(0, 2, 1) - b(1, 2, 0) - 2.0 * b(1, 1, 1) + 2.0 * b(2, 1, 0) + b(2, 0, 1) - b(3, 0, 0);
        s.d3[2][n] = b(0, 1, 2) - b(1, 0, 2) - 2.0 * b(1, 1, 1) + 2.0 * b(2, 0, 1) + b(2, 1, 0) - b(3, 0, 0);
        s.d3[3][n] = b(0, 0, 3) - 3.0 * b(1, 0, 2) + 3.0 * b(2, 0, 1) - b(3, 0, 0);
      }
    }
  }
};

// Does the basis bend at all? Flat segments (line2, tri3) have a constant normal.
template <class B>
inline constexpr bool is_flat = [] {
  for (bool k : B::second)
    if (k) return false;
  return true;
}();

} // namespace ents::ENTS_ISA
