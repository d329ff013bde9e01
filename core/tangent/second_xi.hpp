// SPDX-License-Identifier: BSD-3-Clause
// t_a D2xi^a of the normal projection (friction_forms.hpp) in numbers of dofs, and with it, where the
// law has a slope W'/g, the second variation of its force:
//   (s r^T + r s^T) I + sum_a (w_a Z_a^T + Z_a w_a^T + w1_a z_a^T + z_a w1_a^T + x_a Y_a^T + Y_a x_a^T)
#pragma once

#include "core/tangent/friction_forms.hpp"
#include "core/tangent/write_tangent.hpp"

namespace ents::ENTS_ISA {

template <class Basis, bool Enriched, bool Rigid, class Scalar> struct SecondXi {
  using Forms = FrictionForms<Basis, Enriched, Rigid, Scalar>;
  using Derivative = typename Forms::Derivative;
  static constexpr int D = Basis::dim, T = D - 1, N = Forms::N, M = Forms::M, K = Forms::K;
  static constexpr bool turns = Forms::turns, bends = Forms::bends;
  static constexpr int parts = Forms::parts, parts_of_rate = Forms::parts_of_rate;
  static constexpr bool counted = counts_dofs<Basis, Rigid>;
  using Array = DofArray<Basis, Rigid, Scalar>;
  [[no_unique_address]] Basis basis; // set by evaluate() of the tangent
  Scalar weights[2][M];              // s, r
  Array x[T], Y[T];
  Array w[turns ? T : 1], Z[turns ? T : 1], w1[bends ? T : 1], z[bends ? T : 1];

  // The slave, and nodes whose dofs there are
  ENTS_INLINE constexpr int places() const { return Rigid ? 1 : node_count(basis) + 1; }

  // (A W'/g) s s^T + s s1^T + s1 s^T = s r^T + r s^T with r = s1 + (A W'/g) s / 2
  ENTS_INLINE void set_weights(const Scalar& stiffness, const Derivative& derivative) {
    const Scalar half = 0.5 * stiffness;
    weights[0][0] = Scalar(1.0);
    weights[1][0] = half;
    if constexpr (!Rigid)
      for (int i = 0; i + 1 < places(); ++i) {
        Scalar change = derivative.y[0] * derivative.p.N.d1[0][i];
        if constexpr (T == 2) change = change + derivative.y[1] * derivative.p.N.d1[1][i];
        weights[0][i + 1] = -derivative.p.N.n[i];
        weights[1][i + 1] = -change - half * derivative.p.N.n[i];
      }
  }

  // x_a and Y_a; beside(a, f', x, Y) may add to the forms of Y_a.
  template <class Beside>
  ENTS_INLINE void set_projection_terms(const ProjectedPoint<Basis, Enriched, Scalar>& point,
                                        const Scalar (&inverse)[K], const Derivative& derivative,
                                        const Scalar& stiffness, Beside&& beside) {
    const auto& p = point.projector;
    Form<Basis, Dual<Scalar>> f[T];
    forms_of_f(derivative.s, f);
    Form<Basis, Scalar> value[T], xf[T];
    Forms::set_x(f, inverse, value, xf);
    for (int a = 0; a < T; ++a) expand_to_dofs<Rigid, parts>(basis, xf[a], p.N, x[a]);
    Shape<Scalar, T, Basis::nodes> shape_rates;
    if constexpr (Forms::by_third)
      if (has_thirds(basis)) Forms::set_shape_rates(basis, point.xi, derivative.y, shape_rates);
    for (int a = 0; a < T; ++a) {
      Form<Basis, Scalar> rate, Yf;
      Forms::set_Y(a, derivative, stiffness, f, xf, rate, Yf);
      beside(a, rate, xf, Yf);
      expand_to_dofs<Rigid, parts_of_rate>(basis, Yf, p.N, Y[a]);
      if constexpr (Forms::by_third)
        if (has_thirds(basis)) Forms::subtract_third(basis, value[a], shape_rates, Y[a]);
    }
  }

  // w_a, Z_a and their changes; beside(a, Z) may add to the form of Z_a.
  template <class Beside>
  ENTS_INLINE void set_height_terms(const Scalar& stiffness, const Derivative& derivative, Beside&& beside) {
    const auto& p = derivative.p;
    Form<Basis, Dual<Scalar>> moving_z[T];
    forms_of_z<Basis>(derivative.s, moving_z);
    unroll<T>([&](auto a) ENTS_LAMBDA_INLINE {
      Form<Basis, Scalar> zf, Zf;
      Forms::set_Z(moving_z[a], derivative, stiffness, zf, Zf);
      beside(a, Zf);
      expand_to_dofs<Rigid, Forms::parts_of_z_rate>(basis, Zf, p.N, Z[a]);
      expand_to_nodes(basis, p.N.d1[a], p.s.n, w[a]);
      if constexpr (bends) {
        expand_to_dofs<Rigid, Forms::parts_of_z>(basis, zf, p.N, z[a]);
        Forms::expand_turn_rate(a, derivative, w1[a]);
      }
    });
  }
};

} // namespace ents::ENTS_ISA
