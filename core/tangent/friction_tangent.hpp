// SPDX-License-Identifier: BSD-3-Clause
// The tangent of Coulomb friction (friction_forms.hpp) from numbers of dofs: second_xi.hpp, and
//   sum_a x_a dt_a^T [ + g g^T ]
#pragma once

#include "core/tangent/second_xi.hpp"

namespace ents::ENTS_ISA {

template <class Basis, bool Enriched, bool Rigid, class Scalar>
struct FrictionTangent : SecondXi<Basis, Enriched, Rigid, Scalar> {
  using Base = SecondXi<Basis, Enriched, Rigid, Scalar>;
  using Base::D, Base::T, Base::N, Base::K, Base::turns, Base::bends, Base::parts, Base::parts_of_rate;
  using Base::x, Base::Y, Base::w, Base::Z, Base::w1, Base::z;
  using typename Base::Derivative;
  using typename Base::Forms;
  static constexpr bool symmetric = Enriched && !is_flat<Basis>,
                        has_rest = symmetric; // but for that rest, x_a P_a^T
  static constexpr bool one_by_one = !turns;
  static constexpr int products =
      T * (2 + (turns ? 2 : 0) + (bends ? 2 : 0) + (has_rest ? 1 : 0)); // that an entry is the sum of
  DofArray<Basis, Rigid, Scalar> P[T];                                  // dt_a; Y_a + dt_a if not `symmetric`
  DofArray<Basis, Rigid, Scalar> g;
  bool curved_law;

  ENTS_INLINE void evaluate(const Plan& plan, const ProjectedPoint<Basis, Enriched, Scalar>& point,
                            const Friction<Scalar, Basis::dim - 1>& friction) {
    const auto& p = point.projector;
    this->basis = p.nodes.basis;
    const Scalar stiffness = point.area * point.per_gap;
    Scalar inverse[K], y[T];
    Forms::set_direction(point, friction.force, inverse, y);
    Forms::in_part([&]() ENTS_LAMBDA_INLINE {
      const Derivative derivative(p, point.xi, y);
      Base::set_weights(stiffness, derivative);
      Forms::in_part(
          [&]() ENTS_LAMBDA_INLINE { set_projection_terms(plan, point, friction, inverse, derivative); });
      if constexpr (turns)
        Forms::in_part([&]() ENTS_LAMBDA_INLINE {
          Base::set_height_terms(stiffness, derivative, [](int, Form<Basis, Scalar>&) ENTS_LAMBDA_INLINE {});
        });
    });
    curved_law = set_g<Rigid>(plan, point, g);
  }

  // Each lane's to one[lane]
  template <class One, int W>
  requires(!turns) ENTS_INLINE void scatter_lanes(One (&one)[W]) const {
    scatter_tangent(
        *this, one, [](auto& t) ENTS_LAMBDA_INLINE -> auto& { return t.x; },
        [](auto& t) ENTS_LAMBDA_INLINE -> auto& { return t.Y; },
        [](auto& t) ENTS_LAMBDA_INLINE -> auto& { return t.P; });
  }

  // k + all but the weights and g g^T; row(array) is the array's entry of the row
  template <class R, class Row> ENTS_INLINE R add_products(R k, Row&& row, int j) const {
    for (int a = 0; a < T; ++a) {
      if constexpr (turns) k = k + (row(w[a]) * R(Z[a][j]) + row(Z[a]) * R(w[a][j]));
      if constexpr (bends) k = k + (row(w1[a]) * R(z[a][j]) + row(z[a]) * R(w1[a][j]));
      k = k + (row(x[a]) * R((symmetric ? Y : P)[a][j]) + row(Y[a]) * R(x[a][j]));
    }
    return k;
  }
  // k + what is not symmetric
  template <class R, class Row> ENTS_INLINE R add_rest(R k, Row&& row, int j) const {
    if constexpr (symmetric)
      for (int a = 0; a < T; ++a) k = k + row(x[a]) * R(P[a][j]);
    return k;
  }

private:
  ENTS_INLINE void set_projection_terms(const Plan& plan,
                                        const ProjectedPoint<Basis, Enriched, Scalar>& point,
                                        const Friction<Scalar, Basis::dim - 1>& friction,
                                        const Scalar (&inverse)[K], const Derivative& derivative) {
    const Scalar stiffness = point.area * point.per_gap;
    const typename Forms::ChangeOfForce change(point, friction, false);
    Form<Basis, Scalar> gap;
    form_of_p<Basis, Enriched>(point.projector.s, point.normal, gap);
    Base::set_projection_terms(
        point, inverse, derivative, stiffness,
        [&](int a, const Form<Basis, Scalar>& rate, const Form<Basis, Scalar>(&xf)[T],
            const Form<Basis, Scalar>&) ENTS_LAMBDA_INLINE {
          Form<Basis, Scalar> Pf;
          Forms::template set_P<!symmetric>(a, derivative, stiffness, rate, xf, change,
                                            Forms::by_gap(a, plan, point, friction), gap, Pf);
          expand_to_dofs<Rigid, symmetric ? parts : parts_of_rate>(this->basis, Pf, point.projector.N, P[a]);
        });
  }
};

} // namespace ents::ENTS_ISA
