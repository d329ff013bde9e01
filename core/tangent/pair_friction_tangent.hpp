// SPDX-License-Identifier: BSD-3-Clause
// The tangent of Coulomb friction (pair_friction_forms.hpp) from numbers of dofs:
//   K = (s r^T + r s^T) I + sum_a (w_a Z_a^T + Z_a w_a^T + w1_a z_a^T + z_a w1_a^T) + sum_a (x_a Y_a^T + Y_a
//   x_a^T + x_a dt_a^T) [ + g g^T ]
#pragma once

#include "core/tangent/pair_friction_forms.hpp"
#include "core/tangent/pair_write.hpp"

namespace ents::ENTS_ISA {

template <class B, bool H, bool Rigid, class S> struct PairFrictionTangent {
  using Forms = PairFrictionForms<B, H, Rigid, S>;
  static constexpr int D = B::dim, T = D - 1, N = Forms::N, M = Forms::M, K = Forms::K;
  static constexpr bool turns = Forms::turns, bends = Forms::bends;
  static constexpr bool symmetric = H && !is_flat<B>, has_rest = symmetric; // but for that rest, x_a P_a^T
  static constexpr bool one_by_one = !turns;
  static constexpr int products =
      T * (2 + (turns ? 2 : 0) + (bends ? 2 : 0) + (has_rest ? 1 : 0)); // that an entry is the sum of
  S weights[2][M];                                                      // s, r
  DofArray<S, N> x[T], Y[T];
  DofArray<S, N> P[T]; // dt_a; Y_a + dt_a if not `symmetric`
  DofArray<S, N> w[turns ? T : 1], Z[turns ? T : 1], w1[bends ? T : 1], z[bends ? T : 1];
  DofArray<S, N> g;
  bool curved_law;

  ENTS_INLINE void evaluate(const Plan& plan, const Pair<B, H, S>& pair,
                            const PairFriction<B, H, S>& friction) {
    const auto& p = pair.projector;
    const S stiffness = pair.area * pair.per_gap;
    S inverse[K], y[T];
    Forms::set_direction(pair, friction, inverse, y);
    Forms::in_part([&]() ENTS_LAMBDA_INLINE {
      const Drift drift(p, pair.xi, y);
      set_weights(stiffness, drift);
      Forms::in_part([&]()
                         ENTS_LAMBDA_INLINE { set_projection_terms(plan, pair, friction, inverse, drift); });
      if constexpr (turns) Forms::in_part([&]() ENTS_LAMBDA_INLINE { set_height_terms(stiffness, drift); });
    });
    curved_law = set_g<Rigid>(plan, pair, g);
  }

  // Each lane's to one[lane]
  template <class One, int W>
  requires(!turns) ENTS_INLINE void hand_out_lanes(One (&one)[W]) const {
    hand_out_tangent(
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
  using Drift = typename Forms::Drift;
  static constexpr int parts = Forms::parts, parts_of_rate = Forms::parts_of_rate;

  // (A W'/g) s s^T + s s1^T + s1 s^T = s r^T + r s^T with r = s1 + (A W'/g) s / 2
  ENTS_INLINE void set_weights(const S& stiffness, const Drift& drift) {
    const S half = 0.5 * stiffness;
    weights[0][0] = S(1.0);
    weights[1][0] = half;
    if constexpr (!Rigid)
      for (int i = 0; i < B::nodes; ++i) {
        S change = drift.y[0] * drift.p.N.d1[0][i];
        if constexpr (T == 2) change = change + drift.y[1] * drift.p.N.d1[1][i];
        weights[0][i + 1] = -drift.p.N.n[i];
        weights[1][i + 1] = -change - half * drift.p.N.n[i];
      }
  }

  ENTS_INLINE void set_projection_terms(const Plan& plan, const Pair<B, H, S>& pair,
                                        const PairFriction<B, H, S>& friction, const S (&inverse)[K],
                                        const Drift& drift) {
    const auto& p = pair.projector;
    Form<B, Dual<S>> f[T];
    forms_of_f(drift.s, f);
    Form<B, S> value[T], xf[T];
    Forms::set_x(f, inverse, value, xf);
    for (int a = 0; a < T; ++a) expand_to_dofs<B, Rigid, parts>(xf[a], p.N, x[a]);
    const typename Forms::ChangeOfForce change(pair, friction, false);
    Form<B, S> limit;
    Forms::form_of_limit(plan, pair, friction, limit);
    Shape<S, T, B::nodes> shape_rates;
    if constexpr (Forms::by_third) Forms::set_shape_rates(pair.xi, drift.y, shape_rates);
    for (int a = 0; a < T; ++a) {
      Form<B, S> Yf, Pf;
      Forms::template set_Y_and_P<!symmetric>(a, drift, pair.area * pair.per_gap, f, xf, change, limit, Yf,
                                              Pf);
      expand_to_dofs<B, Rigid, parts_of_rate>(Yf, p.N, Y[a]);
      expand_to_dofs<B, Rigid, symmetric ? parts : parts_of_rate>(Pf, p.N, P[a]);
      if constexpr (Forms::by_third) Forms::subtract_third(value[a], shape_rates, Y[a]);
    }
  }

  ENTS_INLINE void set_height_terms(const S& stiffness, const Drift& drift) {
    const auto& p = drift.p;
    Form<B, Dual<S>> moving_z[T];
    forms_of_z<B>(drift.s, moving_z);
    for (int a = 0; a < T; ++a) {
      Form<B, S> zf, Zf;
      Forms::set_Z(moving_z[a], drift, stiffness, zf, Zf);
      expand_to_dofs<B, Rigid, Forms::parts_of_z_rate>(Zf, p.N, Z[a]);
      expand_to_nodes<B>(p.N.d1[a], p.s.n, w[a]);
      if constexpr (bends) {
        expand_to_dofs<B, Rigid, Forms::parts_of_z>(zf, p.N, z[a]);
        Forms::expand_turn_rate(a, drift, w1[a]);
      }
    }
  }
};

} // namespace ents::ENTS_ISA
