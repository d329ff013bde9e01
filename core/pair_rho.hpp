// SPDX-License-Identifier: BSD-3-Clause
// The master nodes of an ordinary element and the segment rho through them, contracted once to a polynomial of xi: what a projection
// evaluates again and again are its coefficients, fewer than nodes times shape functions.
//
//   quad4                     bilinear; a_1 x a_2 is linear in xi
//   line3, tri6, quad8, quad9 quadratic in each direction (tri6: in all)
//   smoothed                  cubic in each direction
//   Bezier triangles          by shape functions
#pragma once

#include "core/lanes.hpp"
#include "core/surface.hpp"

namespace ents::ENTS_ISA {

// Positions are relative to the slave node.
template <class B, class S> struct PairNodes {
  static constexpr int T = B::dim - 1;
  Vec<S, B::dim> y[B::nodes];
  S coordinates[(B::dim - 1) * B::nodes];
  bool has_coordinates;     // else s = xi
  const HeightNode* height; // enriched

  template <int Order>
  ENTS_INLINE void evaluate_height(const S (&xi)[T], const Shape<S, T, B::nodes>& N, HeightJet<T, S>& h) const {
    if (has_coordinates) {
      evaluate_height_by_xi<B, Order>(*height, coordinates, xi, N, h);
    } else { // number by number: as a whole it would go through memory
      const HeightJet<T, S> jet = evaluate_height_here(*height, xi);
      h.h = jet.h;
      for (int a = 0; a < T; ++a) h.h1[a] = jet.h1[a];
      for (int k = 0; k < symmetric_size<T>; ++k) h.h2[k] = jet.h2[k];
    }
  }
  // `at`, in `d` its derivative along a direction
  ENTS_INLINE void height_along(const S (&xi)[T], const S (&direction)[T], const HeightJet<T, S>& at, HeightJet<T, Dual<S>>& h) const {
    if (!has_coordinates) {
      h = jet_along(*height, xi, direction, at);
      return;
    }
    Dual<S> moving[T];
    for (int a = 0; a < T; ++a) moving[a] = Dual<S>(xi[a], direction[a]);
    Shape<Dual<S>, T, B::nodes> N;
    B::template shape<2>(moving, N);
    evaluate_height_by_xi<B, 2>(*height, coordinates, moving, N, h);
  }
};

template <class S, int D, int M> ENTS_INLINE Vec<S, D> weighted_sum(const S (&w)[M], const Vec<S, D> (&y)[M]) {
  Vec<S, D> v = w[0] * y[0];
  for (int i = 1; i < M; ++i) add_scaled(v, w[i], y[i]);
  return v;
}

// m = normal_of_tangents(a) and its derivatives
template <class S, int D> struct AreaVector {
  Vec<S, D> m, m1[D - 1], m2[symmetric_size<D - 1>];
};

// of a segment that bends in any way
template <class B, class S> struct BentArea {
  static constexpr int D = B::dim, T = D - 1;
  static constexpr bool linear_area = false; // m_,ab = 0?
  template <bool H> static ENTS_INLINE void area_vector(const Surface<B, H, S>& s, AreaVector<S, D>& v) {
    v.m = normal_of_tangents(s.a);
    if constexpr (T == 1) {
      v.m1[0] = normal_of_tangents(s.a2);
      const Vec<S, D> third[1] = {s.a3[0]};
      v.m2[0] = normal_of_tangents(third);
    } else {
      v.m1[0] = cross(s.a2[0], s.a[1]) + cross(s.a[0], s.a2[1]);
      v.m1[1] = cross(s.a2[1], s.a[1]) + cross(s.a[0], s.a2[2]);
      v.m2[0] = S(2.0) * cross(s.a2[0], s.a2[1]);
      v.m2[1] = cross(s.a2[0], s.a2[2]);
      v.m2[2] = S(2.0) * cross(s.a2[1], s.a2[2]);
      unroll<3>([&](auto k) ENTS_LAMBDA_INLINE {
        if constexpr (B::third[k]) v.m2[k] = v.m2[k] + cross(s.a3[k], s.a[1]);
        if constexpr (B::third[k + 1]) v.m2[k] = v.m2[k] + cross(s.a[0], s.a3[k + 1]);
      });
    }
  }
};

// rho - x_s and its derivatives; thirds: rho_,abc; third_rates: how they change along y, y^d rho_,abcd
template <class B, class S> struct Rho : BentArea<B, S> {
  static constexpr int D = B::dim, T = D - 1, K = symmetric_size<T>;
  ENTS_INLINE explicit Rho(const PairNodes<B, S>&) {}

  // s.d = x_s - rho, tangents, curvatures; Order 3: third derivatives, too
  template <int Order, bool H>
  ENTS_INLINE void evaluate(const PairNodes<B, S>& nodes, const S (&xi)[T], Shape<S, T, B::nodes>& N, Surface<B, H, S>& s) const {
    B::template shape<Order>(xi, N);
    s.d = -weighted_sum(N.n, nodes.y);
    for (int a = 0; a < T; ++a) s.a[a] = weighted_sum(N.d1[a], nodes.y);
    unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (B::second[k]) s.a2[k] = weighted_sum(N.d2[k], nodes.y);
      else s.a2[k] = Vec<S, D>::zero();
    });
    if constexpr (Order > 2)
      unroll<T == 1 ? 1 : 4>([&](auto k) ENTS_LAMBDA_INLINE {
        if constexpr (B::third[k]) s.a3[k] = weighted_sum(N.d3[k], nodes.y);
        else s.a3[k] = Vec<S, D>::zero();
      });
  }
  ENTS_INLINE void thirds(const PairNodes<B, S>& nodes, const S (&xi)[T], Vec<S, D> (&a3)[T == 1 ? 1 : 4]) const {
    Shape<S, T, B::nodes> N;
    B::template shape<3>(xi, N);
    for (int k = 0; k < (T == 1 ? 1 : 4); ++k) a3[k] = weighted_sum(N.d3[k], nodes.y);
  }
  ENTS_INLINE void third_rates(const PairNodes<B, S>& nodes, const S (&xi)[T], const S (&y)[T], Vec<S, D> (&rate)[T == 1 ? 1 : 4]) const {
    Dual<S> moving[T];
    for (int a = 0; a < T; ++a) moving[a] = Dual<S>(xi[a], y[a]);
    Shape<Dual<S>, T, B::nodes> N;
    B::template shape<3>(moving, N);
    for (int k = 0; k < (T == 1 ? 1 : 4); ++k) {
      S change[B::nodes];
      for (int i = 0; i < B::nodes; ++i) change[i] = N.d3[k][i].d;
      rate[k] = weighted_sum(change, nodes.y);
    }
  }
};

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

template <class F, class S>
  requires(F::degree > 1)
struct Rho<LineBasis<F>, S> : BentArea<LineBasis<F>, S> {
  using B = LineBasis<F>;
  using V = Vec<S, 2>;
  using P = Polynomial<F::degree>;
  V c[F::degree + 1]; // rho - x_s = sum c_i xi^i
  ENTS_INLINE explicit Rho(const PairNodes<B, S>& nodes) { F::template powers<S>(nodes.y, c); }

  template <int Order, bool H>
  ENTS_INLINE void evaluate(const PairNodes<B, S>& nodes, const S (&xi)[1], Shape<S, 1, B::nodes>& N, Surface<B, H, S>& s) const {
    if (H && nodes.has_coordinates) B::template shape<2>(xi, N);
    s.d = -P::value(c, xi[0]);
    s.a[0] = P::first(c, xi[0]);
    s.a2[0] = P::second(c, xi[0]);
    if constexpr (Order > 2 && F::degree > 2) s.a3[0] = P::third(c, xi[0]);
    else if constexpr (Order > 2) s.a3[0] = V::zero();
  }
  ENTS_INLINE void thirds(const PairNodes<B, S>&, const S (&xi)[1], V (&a3)[1]) const { a3[0] = P::third(c, xi[0]); }
  ENTS_INLINE void third_rates(const PairNodes<B, S>&, const S (&)[1], const S (&)[1], V (&rate)[1]) const { rate[0] = V::zero(); }
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

// of a basis that is one, or becomes one with a node more
template <class B, class F, class S> struct TensorRho : BentArea<B, S> {
  using V = Vec<S, 3>;
  TensorPolynomial<F, S> p;

  template <int Order, bool H>
  ENTS_INLINE void evaluate(const PairNodes<B, S>& nodes, const S (&xi)[2], Shape<S, 2, B::nodes>& N, Surface<B, H, S>& s) const {
    if (H && nodes.has_coordinates) B::template shape<2>(xi, N);
    p.template evaluate<Order>(xi, s);
  }
  ENTS_INLINE void thirds(const PairNodes<B, S>&, const S (&xi)[2], V (&a3)[4]) const { p.thirds(xi, a3); }
  ENTS_INLINE void third_rates(const PairNodes<B, S>&, const S (&xi)[2], const S (&y)[2], V (&rate)[4]) const { p.third_rates(xi, y, rate); }
};

template <class F, class Numbering, class S>
  requires(F::degree > 1)
struct Rho<TensorBasis<F, Numbering>, S> : TensorRho<TensorBasis<F, Numbering>, F, S> {
  using B = TensorBasis<F, Numbering>;
  ENTS_INLINE explicit Rho(const PairNodes<B, S>& nodes) {
    Vec<S, 3> y[F::count][F::count];
    for (int k = 0; k < B::nodes; ++k) y[Numbering::j[k]][Numbering::i[k]] = nodes.y[k];
    this->p.contract(y);
  }
};

template <class S> struct Rho<Quad8, S> : TensorRho<Quad8, Quadratic1D, S> {
  ENTS_INLINE explicit Rho(const PairNodes<Quad8, S>& nodes) {
    using N = CornersMidsidesCentre;
    Vec<S, 3> y[3][3], corners = nodes.y[0], sides = nodes.y[4];
    for (int k = 0; k < 8; ++k) y[N::j[k]][N::i[k]] = nodes.y[k];
    for (int k = 1; k < 4; ++k) {
      corners = corners + nodes.y[k];
      sides = sides + nodes.y[k + 4];
    }
    y[2][2] = S(0.5) * sides - S(0.25) * corners;
    this->p.contract(y);
  }
};

template <class S> struct Rho<Tri6, S> : BentArea<Tri6, S> {
  using V = Vec<S, 3>;
  V c, c1, c2, c11, c12, c22; // rho - x_s = c + c1 xi_1 + c2 xi_2 + c11 xi_1^2 / 2 + c12 xi_1 xi_2 + c22 xi_2^2 / 2
  ENTS_INLINE explicit Rho(const PairNodes<Tri6, S>& nodes) {
    const auto& y = nodes.y;
    const S four(4.0);
    c = y[0];
    c1 = four * (y[3] - y[0]) - (y[1] - y[0]);
    c2 = four * (y[5] - y[0]) - (y[2] - y[0]);
    c11 = four * ((y[0] - y[3]) + (y[1] - y[3]));
    c22 = four * ((y[0] - y[5]) + (y[2] - y[5]));
    c12 = four * ((y[0] - y[3]) + (y[4] - y[5]));
  }
  template <int Order, bool H>
  ENTS_INLINE void evaluate(const PairNodes<Tri6, S>& nodes, const S (&xi)[2], Shape<S, 2, 6>& N, Surface<Tri6, H, S>& s) const {
    if (H && nodes.has_coordinates) Tri6::shape<2>(xi, N);
    const S &x = xi[0], &y = xi[1];
    const V by_2 = raised(c2, x, c12);                // at xi_2 = 0
    const V middle = raised(c1, 0.5 * x, c11);        // (rho - c) / xi_1 at xi_2 = 0
    s.a[0] = raised(raised(c1, x, c11), y, c12);
    s.a[1] = raised(by_2, y, c22);
    s.d = -raised(raised(c, x, middle), y, raised(by_2, 0.5 * y, c22));
    s.a2[0] = c11, s.a2[1] = c12, s.a2[2] = c22;
    if constexpr (Order > 2)
      for (V& third : s.a3) third = V::zero();
  }
};

template <class S> struct Rho<Quad4, S> {
  static constexpr bool linear_area = true;
  Vec<S, 3> c, c1, c2, c12; // rho - x_s = c + c1 xi_1 + c2 xi_2 + c12 xi_1 xi_2
  ENTS_INLINE explicit Rho(const PairNodes<Quad4, S>& nodes) {
    const auto& y = nodes.y;
    const Vec<S, 3> sum_1 = y[0] + y[1], sum_2 = y[3] + y[2], difference_1 = y[1] - y[0], difference_2 = y[2] - y[3];
    const S quarter(0.25);
    c = quarter * (sum_1 + sum_2);
    c1 = quarter * (difference_1 + difference_2);
    c2 = quarter * (sum_2 - sum_1);
    c12 = quarter * (difference_2 - difference_1);
  }
  template <int Order, bool H>
  ENTS_INLINE void evaluate(const PairNodes<Quad4, S>& nodes, const S (&xi)[2], Shape<S, 2, 4>& N, Surface<Quad4, H, S>& s) const {
    if (H && nodes.has_coordinates) Quad4::shape<2>(xi, N);
    s.a[0] = c1;
    s.a[1] = c2;
    add_scaled(s.a[0], xi[1], c12);
    add_scaled(s.a[1], xi[0], c12);
    s.d = -c;
    add_scaled(s.d, -xi[0], c1);
    add_scaled(s.d, -xi[1], s.a[1]);
    s.a2[0] = s.a2[2] = Vec<S, 3>::zero();
    s.a2[1] = c12;
  }
  template <bool H> ENTS_INLINE void area_vector(const Surface<Quad4, H, S>& s, AreaVector<S, 3>& v) const {
    v.m = cross(s.a[0], s.a[1]);
    v.m1[0] = cross(c1, c12); // + xi_2 c12 x c12
    v.m1[1] = cross(c12, c2);
  }
};

} // namespace ents::ENTS_ISA
