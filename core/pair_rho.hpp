// SPDX-License-Identifier: BSD-3-Clause
// The master nodes of an ordinary element and the segment rho through them, contracted once to a polynomial of xi: what a projection
// evaluates again and again are its coefficients, fewer than nodes times shape functions.
//
//   quad4                     bilinear; a_1 x a_2 is linear in xi
//   line3, tri6, quad8, quad9 quadratic in each direction (tri6: in all)
//   smoothed                  cubic in each direction; Bezier triangles: of degree four
#pragma once

#include "core/lanes.hpp"
#include "core/polynomial.hpp"

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

// rho - x_s and its derivatives. Every basis has
//   evaluate<Order>   s.d = x_s - rho, tangents, curvatures; Order 3: third derivatives, too; N where the height needs it
//   thirds            rho_,abc
//   third_rates       how they change along y, y^d rho_,abcd
template <class B, class S> struct Rho;

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
  ENTS_INLINE void thirds(const S (&xi)[1], V (&a3)[1]) const { a3[0] = P::third(c, xi[0]); }
  ENTS_INLINE void third_rates(const S (&)[1], const S (&)[1], V (&rate)[1]) const { rate[0] = V::zero(); }
};

// by one of the polynomials of xi_1 and xi_2
template <class B, class P, class S> struct RhoInSpace : BentArea<B, S> {
  using V = Vec<S, 3>;
  P p;

  template <int Order, bool H>
  ENTS_INLINE void evaluate(const PairNodes<B, S>& nodes, const S (&xi)[2], Shape<S, 2, B::nodes>& N, Surface<B, H, S>& s) const {
    if (H && nodes.has_coordinates) B::template shape<2>(xi, N);
    p.template evaluate<Order>(xi, s);
  }
  ENTS_INLINE void thirds(const S (&xi)[2], V (&a3)[4]) const { p.thirds(xi, a3); }
  ENTS_INLINE void third_rates(const S (&xi)[2], const S (&y)[2], V (&rate)[4]) const { p.third_rates(xi, y, rate); }
};

template <class F, class Numbering, class S>
  requires(F::degree > 1)
struct Rho<TensorBasis<F, Numbering>, S> : RhoInSpace<TensorBasis<F, Numbering>, TensorPolynomial<F, S>, S> {
  using B = TensorBasis<F, Numbering>;
  ENTS_INLINE explicit Rho(const PairNodes<B, S>& nodes) {
    Vec<S, 3> y[F::count][F::count];
    for (int k = 0; k < B::nodes; ++k) y[Numbering::j[k]][Numbering::i[k]] = nodes.y[k];
    this->p.contract(y);
  }
};

template <class S> struct Rho<Bezier15, S> : RhoInSpace<Bezier15, TrianglePolynomial<S>, S> {
  ENTS_INLINE explicit Rho(const PairNodes<Bezier15, S>& nodes) { this->p.contract(nodes.y); }
};

// a quad9 whose centre node follows from the others
template <class S> struct Rho<Quad8, S> : RhoInSpace<Quad8, TensorPolynomial<Quadratic1D, S>, S> {
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
