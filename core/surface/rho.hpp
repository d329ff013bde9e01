// SPDX-License-Identifier: BSD-3-Clause
// The master nodes of an ordinary element and the segment rho through them, contracted once to a polynomial
// of xi: what a projection evaluates again and again are its coefficients, fewer than nodes times shape
// functions.
//
//   quad4                     bilinear; a_1 x a_2 is linear in xi
//   line3, tri6, quad8, quad9 quadratic in each direction (tri6: in all)
//   smoothed                  cubic in each direction; Bezier triangles: of degree four
// All but quad4 are counted (counted_basis.hpp): the contraction and the derivatives are chosen by a switch.
#pragma once

#include "core/height/height_rate.hpp"
#include "core/height/moving_height.hpp"
#include "core/numbers/polynomial.hpp"
#include "core/surface/surface.hpp"

namespace ents::ENTS_ISA {

// Positions are relative to the slave node.
template <class Basis, class Scalar> struct ElementNodes {
  static constexpr int T = Basis::dim - 1;
  [[no_unique_address]] Basis basis;
  Vec<Scalar, Basis::dim> y[Basis::nodes];
  Scalar coordinates[(Basis::dim - 1) * Basis::nodes];
  bool has_coordinates;     // else s = xi
  const HeightNode* height; // enriched
  // Of dual numbers, whose derivatives are those by a parameter: 1 + its index (parameter_rates.hpp)
  std::int32_t parameter = 0;

  ENTS_INLINE explicit ElementNodes(const Basis& of) : basis(of) {}

  // `sine` moves there
  template <int Order>
  ENTS_INLINE void evaluate_height(const Scalar (&xi)[T], const Shape<Scalar, T, Basis::nodes>& N,
                                   SineAt<Scalar>& sine, HeightJet<T, Scalar>& h) const {
    const auto height_at = [&](const Scalar(&s)[T]) ENTS_LAMBDA_INLINE {
      if constexpr (std::is_same_v<Scalar, Dual<double>>)
        return height_with_rate(*height, parameter, s);
      else
        return move_height<is_flat<Basis>>(sine, *height, s);
    };
    if (has_coordinates) {
      evaluate_height_by_xi<Order>(basis, height_at, coordinates, xi, N, h);
    } else { // number by number: as a whole it would go through memory
      const HeightJet<T, Scalar> jet = height_at(xi);
      h.h = jet.h;
      for (int a = 0; a < T; ++a) h.h1[a] = jet.h1[a];
      for (int k = 0; k < symmetric_size<T>; ++k) h.h2[k] = jet.h2[k];
    }
  }
  // `at`, in `d` its derivative along a direction
  ENTS_INLINE void height_along(const Scalar (&xi)[T], const Scalar (&direction)[T],
                                const HeightJet<T, Scalar>& at, HeightJet<T, Dual<Scalar>>& h) const {
    if (!has_coordinates) {
      h = jet_along(*height, xi, direction, at);
      return;
    }
    Dual<Scalar> moving[T];
    for (int a = 0; a < T; ++a) moving[a] = Dual<Scalar>(xi[a], direction[a]);
    Shape<Dual<Scalar>, T, Basis::nodes> N;
    basis.template shape<2>(moving, N);
    const auto height_at = [&](const Dual<Scalar>(&s)[T])
                               ENTS_LAMBDA_INLINE { return ents::ENTS_ISA::evaluate_height(*height, s); };
    evaluate_height_by_xi<2>(basis, height_at, coordinates, moving, N, h);
  }
};

// m = normal_of_tangents(a) and its derivatives
template <class Scalar, int D> struct AreaVector { Vec<Scalar, D> m, m1[D - 1], m2[symmetric_size<D - 1>]; };

// of a segment that bends in any way
template <class Basis, class Scalar> struct BentArea {
  static constexpr int D = Basis::dim, T = D - 1;
  static constexpr bool linear_area = false; // m_,ab = 0?
  template <bool Enriched>
  static ENTS_INLINE void area_vector(const Basis& basis, const Surface<Basis, Enriched, Scalar>& s,
                                      AreaVector<Scalar, D>& v) {
    v.m = normal_of_tangents(s.a);
    if constexpr (T == 1) {
      v.m1[0] = normal_of_tangents(s.a2);
      const Vec<Scalar, D> third[1] = {s.a3[0]};
      v.m2[0] = normal_of_tangents(third);
    } else {
      v.m1[0] = cross(s.a2[0], s.a[1]) + cross(s.a[0], s.a2[1]);
      v.m1[1] = cross(s.a2[1], s.a[1]) + cross(s.a[0], s.a2[2]);
      v.m2[0] = Scalar(2.0) * cross(s.a2[0], s.a2[1]);
      v.m2[1] = cross(s.a2[0], s.a2[2]);
      v.m2[2] = Scalar(2.0) * cross(s.a2[1], s.a2[2]);
      unroll<3>([&](auto k) ENTS_LAMBDA_INLINE {
        if (has_third(basis, k)) v.m2[k] = v.m2[k] + cross(s.a3[k], s.a[1]);
        if (has_third(basis, k + 1)) v.m2[k] = v.m2[k] + cross(s.a[0], s.a3[k + 1]);
      });
    }
  }
};

// c_kj of nodes y[j][i]: of the i-th function of xi_1 and the j-th of xi_2
template <class F, class Scalar, int W>
ENTS_INLINE void tensor_powers(const Vec<Scalar, 3> (&y)[F::count][F::count], Vec<Scalar, 3> (&c)[W][W]) {
  constexpr int N = F::count, M = F::degree + 1;
  Vec<Scalar, 3> along[N][M];
  for (int j = 0; j < N; ++j) F::template powers<Scalar>(y[j], along[j]);
  for (int i = 0; i < M; ++i) {
    Vec<Scalar, 3> column[N], powers[M];
    for (int j = 0; j < N; ++j) column[j] = along[j][i];
    F::template powers<Scalar>(column, powers);
    for (int k = 0; k < M; ++k) c[k][i] = powers[k];
  }
}

// Powers of a basis: the factors c of the powers of natural coordinates, of nodes y.
template <class Basis> struct PowersOf;

template <class F> struct PowersOf<LineBasis<F>> {
  template <class Scalar> static ENTS_INLINE void set(const Vec<Scalar, 2>* y, Vec<Scalar, 2>* c) {
    F::template powers<Scalar>(y, c);
  }
};
template <class F, class Numbering> struct PowersOf<TensorBasis<F, Numbering>> {
  template <class Scalar, int W>
  static ENTS_INLINE void set(const Vec<Scalar, 3>* nodes, Vec<Scalar, 3> (&c)[W][W]) {
    Vec<Scalar, 3> y[F::count][F::count];
    for (int k = 0; k < F::count * F::count; ++k) y[Numbering::j[k]][Numbering::i[k]] = nodes[k];
    tensor_powers<F>(y, c);
  }
};
// a quad9 whose centre node follows from the others
template <> struct PowersOf<Quad8> {
  template <class Scalar, int W>
  static ENTS_INLINE void set(const Vec<Scalar, 3>* nodes, Vec<Scalar, 3> (&c)[W][W]) {
    using N = CornersMidsidesCentre;
    Vec<Scalar, 3> y[3][3], corners = nodes[0], sides = nodes[4];
    for (int k = 0; k < 8; ++k) y[N::j[k]][N::i[k]] = nodes[k];
    for (int k = 1; k < 4; ++k) {
      corners = corners + nodes[k];
      sides = sides + nodes[k + 4];
    }
    y[2][2] = Scalar(0.5) * sides - Scalar(0.25) * corners;
    tensor_powers<Quadratic1D>(y, c);
  }
};
template <> struct PowersOf<Tri6> {
  template <class Scalar, int W>
  static ENTS_INLINE void set(const Vec<Scalar, 3>* y, Vec<Scalar, 3> (&c)[W][W]) {
    const Scalar two(2.0), four(4.0);
    c[0][0] = y[0];
    c[0][1] = four * (y[3] - y[0]) - (y[1] - y[0]);
    c[1][0] = four * (y[5] - y[0]) - (y[2] - y[0]);
    c[0][2] = two * ((y[0] - y[3]) + (y[1] - y[3]));
    c[2][0] = two * ((y[0] - y[5]) + (y[2] - y[5]));
    c[1][1] = four * ((y[0] - y[3]) + (y[4] - y[5]));
  }
};
// With differences D_1, D_2 of neighbouring points along xi_1, xi_2: c_kj = 4! / (j! k! (4 - j - k)!) D_1^j
// D_2^k b
template <> struct PowersOf<Bezier15> {
  template <class Scalar, int W>
  static ENTS_INLINE void set(const Vec<Scalar, 3>* y, Vec<Scalar, 3> (&c)[W][W]) {
    for (int n = 0; n < Bezier15::nodes; ++n) c[Bezier15::power[n][2]][Bezier15::power[n][1]] = y[n];
    for (int order = 1; order <= 4; ++order)
      for (int k = 0; k <= 4 - order; ++k)
        for (int j = 4 - k; j >= order; --j) c[k][j] = c[k][j] - c[k][j - 1];
    for (int order = 1; order <= 4; ++order)
      for (int j = 0; j <= 4 - order; ++j)
        for (int k = 4 - j; k >= order; --k) c[k][j] = c[k][j] - c[k - 1][j];
    constexpr double factorial[5] = {1.0, 1.0, 2.0, 6.0, 24.0};
    for (int k = 0; k <= 4; ++k)
      for (int j = k == 0; j <= 4 - k; ++j)
        c[k][j] = Scalar(24.0 / (factorial[j] * factorial[k] * factorial[4 - j - k])) * c[k][j];
  }
};

// rho - x_s and its derivatives. Every basis has
//   evaluate<Order>   s.d = x_s - rho, tangents, curvatures; Order 3: third derivatives, too; N where the
//                     height needs it
//   thirds            rho_,abc
//   third_rates       how they change along y, y^d rho_,abcd
template <class Basis, class Scalar> struct Rho;

template <class Scalar> struct Rho<CountedBasis<2>, Scalar> : BentArea<CountedBasis<2>, Scalar> {
  using Basis = CountedBasis<2>;
  using V = Vec<Scalar, 2>;
  V c[4];
  bool cubic; // else quadratic
  ENTS_INLINE explicit Rho(const ElementNodes<Basis, Scalar>& nodes) : cubic(nodes.basis.degree == 3) {
    c[3] = V::zero();
    with_basis<2>(nodes.basis.which, [&](auto basis) ENTS_LAMBDA_INLINE {
      PowersOf<decltype(basis)>::template set<Scalar>(nodes.y, c);
    });
  }

  template <int Order, bool Enriched>
  ENTS_INLINE void evaluate(const ElementNodes<Basis, Scalar>& nodes, const Scalar (&xi)[1],
                            Shape<Scalar, 1, Basis::nodes>& N, Surface<Basis, Enriched, Scalar>& s) const {
    if (Enriched && nodes.has_coordinates) nodes.basis.template shape<2>(xi, N);
    V d[4];
    if (cubic)
      divide_by_powers<3, 3>(c, xi[0], d);
    else
      divide_by_powers<2, 3>(c, xi[0], d);
    s.d = -d[0];
    s.a[0] = d[1];
    s.a2[0] = d[2] + d[2];
    if constexpr (Order > 2) s.a3[0] = cubic ? Scalar(6.0) * d[3] : V::zero();
  }
  ENTS_INLINE void thirds(const Basis&, const Scalar (&)[1], V (&a3)[1]) const { a3[0] = Scalar(6.0) * c[3]; }
  ENTS_INLINE void third_rates(const Basis&, const Scalar (&)[1], const Scalar (&)[1], V (&rate)[1]) const {
    rate[0] = V::zero();
  }
};

template <class Scalar> struct Rho<CountedBasis<3>, Scalar> : BentArea<CountedBasis<3>, Scalar> {
  using Basis = CountedBasis<3>;
  using V = Vec<Scalar, 3>;
  V c[5][5];
  ENTS_INLINE explicit Rho(const ElementNodes<Basis, Scalar>& nodes) { set(nodes); }

  template <int Order, bool Enriched>
  ENTS_INLINE void evaluate(const ElementNodes<Basis, Scalar>& nodes, const Scalar (&xi)[2],
                            Shape<Scalar, 2, Basis::nodes>& N, Surface<Basis, Enriched, Scalar>& s) const {
    if (Enriched && nodes.has_coordinates) nodes.basis.template shape<2>(xi, N);
    SurfaceDerivatives<Scalar, Order> d;
    differentiate(nodes.basis, xi, d);
    s.d = -d.of[0][0];
    s.a[0] = d.of[1][0];
    s.a[1] = d.of[0][1];
    s.a2[0] = d.of[2][0] + d.of[2][0];
    s.a2[1] = d.of[1][1];
    s.a2[2] = d.of[0][2] + d.of[0][2];
    if constexpr (Order > 2) set_thirds(nodes.basis, d, s.a3);
  }
  ENTS_INLINE void thirds(const Basis& basis, const Scalar (&xi)[2], V (&a3)[4]) const {
    SurfaceDerivatives<Scalar, 3> d;
    differentiate(basis, xi, d);
    set_thirds(basis, d, a3);
  }
  ENTS_INLINE void third_rates(const Basis& basis, const Scalar (&xi)[2], const Scalar (&y)[2],
                               V (&rate)[4]) const {
    with_basis<3>(basis.which, [&](auto type) ENTS_LAMBDA_INLINE {
      third_rates_of<SurfacePolynomial<decltype(type)::degree, decltype(type)::simplex, Scalar>>(xi, y, rate);
    });
  }

private:
  ENTS_NOINLINE void set(const ElementNodes<Basis, Scalar>& nodes) {
    with_basis<3>(nodes.basis.which, [&](auto basis) ENTS_LAMBDA_INLINE {
      PowersOf<decltype(basis)>::template set<Scalar>(nodes.y, c);
    });
  }
  template <int Order>
  ENTS_INLINE void differentiate(const Basis& basis, const Scalar (&xi)[2],
                                 SurfaceDerivatives<Scalar, Order>& d) const {
    with_basis<3>(basis.which, [&](auto type) ENTS_LAMBDA_INLINE {
      derivatives_of<SurfacePolynomial<decltype(type)::degree, decltype(type)::simplex, Scalar>>(xi, d);
    });
  }
  // Out of line: bases of the same degree have the same code.
  template <class Powers, int Order>
  ENTS_NOINLINE void derivatives_of(const Scalar (&xi)[2], SurfaceDerivatives<Scalar, Order>& d) const {
    Powers::differentiate(c, xi, d);
  }
  template <class Powers>
  ENTS_NOINLINE void third_rates_of(const Scalar (&xi)[2], const Scalar (&y)[2], V (&rate)[4]) const {
    SurfaceDerivatives<Scalar, 4> d;
    Powers::differentiate(c, xi, d);
    const V fourth[5] = {Scalar(24.0) * d.of[4][0], Scalar(6.0) * d.of[3][1], Scalar(4.0) * d.of[2][2],
                         Scalar(6.0) * d.of[1][3], Scalar(24.0) * d.of[0][4]};
    unroll<4>([&](auto k) ENTS_LAMBDA_INLINE {
      constexpr bool by_1 = Powers::has(4 - k.value, k), by_2 = Powers::has(3 - k.value, k + 1);
      rate[k] = by_1 ? y[0] * fourth[k] : by_2 ? y[1] * fourth[k + 1] : V::zero();
      if constexpr (by_1 && by_2) add_scaled(rate[k], y[1], fourth[k + 1]);
    });
  }
  static ENTS_INLINE void set_thirds(const Basis& basis, const SurfaceDerivatives<Scalar, 3>& d, V (&a3)[4]) {
    constexpr double factor[4] = {6.0, 2.0, 2.0, 6.0};
    for (int k = 0; k < 4; ++k) a3[k] = has_third(basis, k) ? Scalar(factor[k]) * d.of[3 - k][k] : V::zero();
  }
};

template <class Scalar> struct Rho<Quad4, Scalar> {
  static constexpr bool linear_area = true;
  Vec<Scalar, 3> c, c1, c2, c12; // rho - x_s = c + c1 xi_1 + c2 xi_2 + c12 xi_1 xi_2
  ENTS_INLINE explicit Rho(const ElementNodes<Quad4, Scalar>& nodes) {
    const auto& y = nodes.y;
    const Vec<Scalar, 3> sum_1 = y[0] + y[1], sum_2 = y[3] + y[2], difference_1 = y[1] - y[0],
                         difference_2 = y[2] - y[3];
    const Scalar quarter(0.25);
    c = quarter * (sum_1 + sum_2);
    c1 = quarter * (difference_1 + difference_2);
    c2 = quarter * (sum_2 - sum_1);
    c12 = quarter * (difference_2 - difference_1);
  }
  template <int Order, bool Enriched>
  ENTS_INLINE void evaluate(const ElementNodes<Quad4, Scalar>& nodes, const Scalar (&xi)[2],
                            Shape<Scalar, 2, 4>& N, Surface<Quad4, Enriched, Scalar>& s) const {
    if (Enriched && nodes.has_coordinates) Quad4::shape<2>(xi, N);
    s.a[0] = c1;
    s.a[1] = c2;
    add_scaled(s.a[0], xi[1], c12);
    add_scaled(s.a[1], xi[0], c12);
    s.d = -c;
    add_scaled(s.d, -xi[0], c1);
    add_scaled(s.d, -xi[1], s.a[1]);
    s.a2[0] = s.a2[2] = Vec<Scalar, 3>::zero();
    s.a2[1] = c12;
  }
  template <bool Enriched>
  ENTS_INLINE void area_vector(const Quad4&, const Surface<Quad4, Enriched, Scalar>& s,
                               AreaVector<Scalar, 3>& v) const {
    v.m = cross(s.a[0], s.a[1]);
    v.m1[0] = cross(c1, c12); // + xi_2 c12 x c12
    v.m1[1] = cross(c12, c2);
  }
};

} // namespace ents::ENTS_ISA
