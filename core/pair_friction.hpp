// SPDX-License-Identifier: BSD-3-Clause
// Coulomb friction of ordinary elements (the law: friction.hpp), one element or one per lane.
//
//   R = A W' dg + t_a dxi^a,   dxi^a = M^ab f_b,  M = F_,xixi^-1
//   K = A W'/g D2F* [+ law] + dxi^a dt_a + t_a D2xi^a
// with, y = - M t and ' the derivative along y (xi_hessian.hpp),
//   t_a D2xi^a = F_uu' - dxi^a f'_a - f'_a dxi^a + F'_ab dxi^a dxi^b .
// All but the last expansion to dofs happens in the reduced space of forms.hpp.
#pragma once

#include "core/pair.hpp"
#include "core/pair_drift.hpp"

namespace ents::ENTS_ISA {

template <class B, bool H, class S> struct PairFriction {
  static constexpr int D = B::dim, T = D - 1;
  Truth<S> active, slip, at_shear_limit;
  S moved[T];           // xi - xi_0; 0 where there is no friction
  S force[T];           // t_a
  S scale;              // eps_t A
  S norm;               // |t| of the trial
  S limit, by_pressure; // L, dL / d(p A)
  S direction[T], raised[T];

  // history: 1 where the element was in contact
  ENTS_INLINE void evaluate(const Plan& plan, Pair<B, H, S>& pair, const S (&anchor)[T], const S& history) {
    const ContactLaw& law = plan.law;
    const auto& metric = pair.projector.metric;
    active = both(pair.contact, history > 0.0);
    scale = law.friction_stiffness * pair.area;
    S lowered[T], far = scale / comfortable;
    for (int a = 0; a < T; ++a) {
      moved[a] = select(active, pair.xi[a] - anchor[a], S(0.0));
      far = far + 1e-6 * absolute(moved[a]);
    }
    pair.ordinary = both(pair.ordinary, far < 1.0);
    for (int a = 0; a < T; ++a) {
      lowered[a] = metric[symmetric_index(a, 0)] * moved[0];
      if constexpr (T == 2) lowered[a] = lowered[a] + metric[symmetric_index(a, 1)] * moved[1];
    }
    S norm2 = moved[0] * lowered[0];
    if constexpr (T == 2) norm2 = norm2 + moved[1] * lowered[1];
    norm = scale * square_root(norm2);
    const S pressure = -(pair.area * pair.per_gap * pair.gap);
    limit = law.friction_coefficient * pressure;
    by_pressure = S(law.friction_coefficient);
    at_shear_limit = limit < limit; // none
    if (law.shear_limit > 0.0) {
      const S most = law.shear_limit * pair.area;
      at_shear_limit = most < limit;
      limit = select(at_shear_limit, most, limit);
      by_pressure = select(at_shear_limit, S(0.0), by_pressure);
    }
    slip = both(active, norm > limit);
    if (law.friction == FrictionKind::rough) slip = limit < limit;
    at_shear_limit = both(at_shear_limit, slip);
    const S q = scale / select(slip, norm, S(1.0));
    for (int a = 0; a < T; ++a) {
      direction[a] = q * lowered[a];
      raised[a] = q * moved[a];
      force[a] = select(slip, limit * direction[a], scale * lowered[a]);
    }
  }
};

// R = A W' dg + t_a dxi^a
template <bool Rigid, class B, bool H, class S>
ENTS_INLINE void friction_residual(const Pair<B, H, S>& pair, const PairFriction<B, H, S>& friction, S (&out)[dof_count<B, Rigid>]) {
  constexpr int T = B::dim - 1;
  const auto& p = pair.projector;
  Form<B, S> force, f[T];
  form_of_p<B, H>(p.s, (pair.area * pair.per_gap) * pair.gap_vector, force);
  if constexpr (!H)
    for (auto& v : force.a) v = Vec<S, B::dim>::zero();
  for (auto& v : force.a2) v = Vec<S, B::dim>::zero();
  forms_of_f(p.s, f);
  S inverse[symmetric_size<T>];
  invert(p.f2, determinant(p.f2), inverse);
  for (int b = 0; b < T; ++b) {
    S raised = inverse[symmetric_index(0, b)] * friction.force[0];
    if constexpr (T == 2) raised = raised + inverse[symmetric_index(1, b)] * friction.force[1];
    add_form<parts_of_f<B, H>>(force, raised, f[b]);
  }
  expand_to_dofs<B, Rigid, parts_of_f<B, H>>(force, p.N, out);
}

// K = (s r^T + r s^T) I + sum_a (w_a Z_a^T + Z_a w_a^T + w1_a z_a^T + z_a w1_a^T) + sum_a (x_a Y_a^T + Y_a x_a^T + x_a dt_a^T) [ + g g^T ]
//   x_a = dxi^a = M^ab f_b,  Y_a = - f'_a + (F'_ab - (A W'/g) F_,ab) x_b / 2
// The derivative along y of a form's expansion is the expansion of another form, for delta X' = - y^k delta a_k and
// delta a_k' = y^l delta a_kl; only third derivatives of the basis ask for an expansion of their own.
template <class B, bool H, bool Rigid, class S> struct PairFrictionTangent {
  static constexpr int D = B::dim, T = D - 1, N = dof_count<B, Rigid>, M = N / D, K = symmetric_size<T>;
  static constexpr bool turns = H && !Rigid;          // w, Z: dofs of the master
  static constexpr bool bends = turns && !is_flat<B>; // does w change along y?
  static constexpr bool symmetric = H && !is_flat<B>, has_rest = symmetric; // but for that rest, x_a P_a^T
  static constexpr int products = T * (2 + (turns ? 2 : 0) + (bends ? 2 : 0) + (has_rest ? 1 : 0)); // that an entry is the sum of
  S weights[2][M]; // s, r
  DofArray<S, N> x[T], Y[T];
  DofArray<S, N> P[T]; // dt_a; Y_a + dt_a if not `symmetric`
  DofArray<S, N> w[turns ? T : 1], Z[turns ? T : 1], w1[bends ? T : 1], z[bends ? T : 1];
  DofArray<S, N> g;
  bool curved_law;

  ENTS_INLINE void evaluate(const Plan& plan, const Pair<B, H, S>& pair, const PairFriction<B, H, S>& friction) {
    const auto& p = pair.projector;
    const S stiffness = pair.area * pair.per_gap;
    S inverse[K], y[T];
    invert(p.f2, determinant(p.f2), inverse);
    for (int a = 0; a < T; ++a) {
      S sum = inverse[symmetric_index(a, 0)] * friction.force[0];
      if constexpr (T == 2) sum = sum + inverse[symmetric_index(a, 1)] * friction.force[1];
      y[a] = -sum;
    }
    in_part([&]() ENTS_LAMBDA_INLINE {
      const Drift drift(p, pair.xi, y);
      set_weights(stiffness, drift);
      in_part([&]() ENTS_LAMBDA_INLINE { set_projection_terms(plan, pair, friction, inverse, drift); });
      if constexpr (turns) in_part([&]() ENTS_LAMBDA_INLINE { set_height_terms(stiffness, drift); });
    });
    curved_law = plan.law.twice_exponent > 2;
    if (curved_law) {
      Form<B, S> gf;
      form_of_p<B, H>(p.s, (square_root(stiffness) * square_root(0.5 * plan.law.twice_exponent - 1.0)) * pair.normal, gf);
      expand_to_dofs<B, Rigid, parts_of_p<H>>(gf, p.N, g);
    } else {
      for_each_dof(g, []() ENTS_LAMBDA_INLINE { return S(0.0); });
    }
  }

  // Each lane's to one[lane]
  template <class One, int W>
    requires(!turns)
  ENTS_INLINE void hand_out_lanes(One (&one)[W]) const {
    hand_out_tangent(
        *this, one, [](auto& t) ENTS_LAMBDA_INLINE -> auto& { return t.x; }, [](auto& t) ENTS_LAMBDA_INLINE -> auto& { return t.Y; },
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
  using Drift = PairDrift<B, H, S>;
  static constexpr int parts = parts_of_f<B, H>, parts_of_rate = is_flat<B> ? parts : parts | on_curvatures;
  static constexpr bool by_third = H && !Rigid && Drift::bend_changes; // do forms of second derivatives change?

  // With a height, in parts that compilers digest.
  template <class Part> static ENTS_INLINE void in_part(Part&& part) {
    if constexpr (H) apart(part);
    else part();
  }
  template <class Part> static ENTS_NOINLINE void apart(Part&& part) { part(); }

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

  // d2: y^c N_,abc
  static ENTS_INLINE void set_shape_rates(const S (&xi)[T], const S (&y)[T], Shape<S, T, B::nodes>& of) {
    B::template shape<3>(xi, of);
    unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (B::second[k])
        for (int i = 0; i < B::nodes; ++i) {
          if constexpr (T == 1) of.d2[k][i] = y[0] * of.d3[0][i];
          else if constexpr (!B::third[k]) of.d2[k][i] = y[1] * of.d3[k + 1][i];
          else if constexpr (!B::third[k + 1]) of.d2[k][i] = y[0] * of.d3[k][i];
          else of.d2[k][i] = y[0] * of.d3[k][i] + y[1] * of.d3[k + 1][i];
        }
    });
  }
  // - value of the part on second derivatives, whose expansion changes by third ones
  static ENTS_INLINE void subtract_third(const Form<B, S>& value, const Shape<S, T, B::nodes>& rates, DofArray<S, N>& from) {
    DofArray<S, N> of;
    expand_to_dofs<B, Rigid, on_curvatures>(value, rates, of);
    for_each_dof(from, [](auto u, auto v) ENTS_LAMBDA_INLINE { return u - v; }, from, of);
  }

  ENTS_INLINE void set_projection_terms(const Plan& plan, const Pair<B, H, S>& pair, const PairFriction<B, H, S>& friction,
                                        const S (&inverse)[K], const Drift& drift) {
    const auto& p = pair.projector;
    const S stiffness = pair.area * pair.per_gap;
    Form<B, Dual<S>> f[T];
    forms_of_f(drift.s, f);
    Form<B, S> value[T], xf[T];
    for (int a = 0; a < T; ++a) value_of_form<parts>(f[a], value[a]);
    for (int a = 0; a < T; ++a) {
      set_form<parts>(xf[a], inverse[symmetric_index(a, 0)], value[0]);
      if constexpr (T == 2) add_form<parts>(xf[a], inverse[symmetric_index(a, 1)], value[1]);
      expand_to_dofs<B, Rigid, parts>(xf[a], p.N, x[a]);
    }
    const ChangeOfForce change(plan, pair, friction);
    Shape<S, T, B::nodes> shape_rates;
    if constexpr (by_third) set_shape_rates(pair.xi, drift.y, shape_rates);
    for (int a = 0; a < T; ++a) {
      Form<B, S> rate, Yf, Pf;
      set_form_rate<parts>(f[a], drift.y, rate);
      set_form<parts_of_rate>(Yf, S(-1.0), rate);
      if constexpr (!symmetric) set_form<parts_of_rate>(Pf, S(-1.0), rate);
      for (int c = 0; c < T; ++c) {
        const int k = symmetric_index(a, c);
        const S half = 0.5 * (drift.f2[k] - stiffness * p.f2[k]);
        add_form<parts>(Yf, half, xf[c]);
        if constexpr (!symmetric) add_form<parts>(Pf, half + change.by_xi[a][c], xf[c]);
        else if (c == 0) set_form<parts>(Pf, change.by_xi[a][c], xf[c]);
        else add_form<parts>(Pf, change.by_xi[a][c], xf[c]);
      }
      change.add_to(a, p.s, Pf);
      expand_to_dofs<B, Rigid, parts_of_rate>(Yf, p.N, Y[a]);
      expand_to_dofs<B, Rigid, symmetric ? parts : parts_of_rate>(Pf, p.N, P[a]);
      if constexpr (by_third) subtract_third(value[a], shape_rates, Y[a]);
    }
  }

  // dt_a = by_xi[a][c] x_c + sum_b towards[a][b] . D(rho_e,b) + n_a dL, where D is at fixed xi, w = moved, n_a = direction and
  //   stick  t_a = scale A_ab w^b
  //   slip   t_a = L n_a,  dn_a = (D(A_ab w^b) - n_a m^b w^c D(A_bc) / 2) / |w|,  m = w / |w|
  struct ChangeOfForce {
    S by_xi[T][T], slips[T];
    Vec<S, D> towards[T][T];
    Form<B, S> limit; // dL

    ENTS_INLINE ChangeOfForce(const Plan& plan, const Pair<B, H, S>& pair, const PairFriction<B, H, S>& friction) {
      const auto& surface = pair.projector.s;
      const auto& w = friction.moved;
      const S none(0.0);
      const S ratio = select(friction.slip, friction.scale * (friction.limit / select(friction.slip, friction.norm, S(1.0))),
                             select(friction.active, friction.scale, none));
      S m[T];
      for (int a = 0; a < T; ++a) {
        slips[a] = select(friction.slip, friction.direction[a], none);
        m[a] = select(friction.slip, friction.raised[a], none);
      }
      // (A_ab w^b)_,c at fixed w and |w|_,c, with W = w^b rho_e,b
      Vec<S, D> W = w[0] * surface.e[0];
      if constexpr (T == 2) add_scaled(W, w[1], surface.e[1]);
      S along[T];
      for (int c = 0; c < T; ++c) {
        Vec<S, D> bend = w[0] * surface.e2[symmetric_index(0, c)];
        if constexpr (T == 2) add_scaled(bend, w[1], surface.e2[symmetric_index(1, c)]);
        for (int a = 0; a < T; ++a)
          by_xi[a][c] = dot(surface.e[a], bend) + dot(W, surface.e2[symmetric_index(a, c)]) + pair.projector.metric[symmetric_index(a, c)];
        along[c] = slips[c] + m[0] * dot(surface.e[0], bend);
        if constexpr (T == 2) along[c] = along[c] + m[1] * dot(surface.e[1], bend);
      }
      for (int a = 0; a < T; ++a) {
        for (int c = 0; c < T; ++c) by_xi[a][c] = ratio * (by_xi[a][c] - slips[a] * along[c]);
        for (int b = 0; b < T; ++b) {
          towards[a][b] = (ratio * w[b]) * surface.e[a];
          add_scaled(towards[a][b], -(ratio * slips[a] * m[b]), W);
        }
        towards[a][a] = towards[a][a] + ratio * W;
      }
      const S exponent = S(0.5 * plan.law.twice_exponent); // W'' = m W'/g
      form_of_p<B, H>(surface, (-friction.by_pressure * (exponent * pair.area * pair.per_gap)) * pair.normal, limit);
    }

    ENTS_INLINE void add_to(int a, const Surface<B, H, S>& surface, Form<B, S>& f) const {
      unroll<T>([&](auto b) ENTS_LAMBDA_INLINE { add_slope<b.value>(surface, towards[a][b], f); });
      add_form<parts_of_p<H>>(f, slips[a], limit);
    }
    template <int I> static ENTS_INLINE void add_slope(const Surface<B, H, S>& surface, const Vec<S, D>& c, Form<B, S>& f) {
      if constexpr (!H) {
        f.a[I] = f.a[I] + c;
      } else {
        Form<B, S> of;
        form_of_slope<I, B, H>(surface, c, of);
        for (int k = 0; k < T; ++k) f.a[k] = f.a[k] + of.a[k];
        if constexpr (!is_flat<B>)
          unroll<T>([&](auto k) ENTS_LAMBDA_INLINE {
            constexpr int at = symmetric_index(k, I);
            if constexpr (B::second[at]) f.a2[at] = f.a2[at] + of.a2[at];
          });
      }
    }
  };

  // Z_a = z'_a + (A W'/g) z_a, and w'_a
  ENTS_INLINE void set_height_terms(const S& stiffness, const Drift& drift) {
    constexpr int of_z = on_position | on_tangents, of_rate = is_flat<B> ? of_z : of_z | on_curvatures;
    const auto& p = drift.p;
    Form<B, Dual<S>> moving_z[T];
    forms_of_z<B>(drift.s, moving_z);
    for (int a = 0; a < T; ++a) {
      Form<B, S> value, sum;
      value_of_form<of_z>(moving_z[a], value);
      set_form_rate<of_z>(moving_z[a], drift.y, sum);
      add_form<of_z>(sum, stiffness, value);
      expand_to_dofs<B, Rigid, of_rate>(sum, p.N, Z[a]);
      expand_to_nodes<B>(p.N.d1[a], p.s.n, w[a]);
      if constexpr (bends) {
        expand_to_dofs<B, Rigid, of_z>(value, p.N, z[a]);
        S change[B::nodes]; // y^b N_,ab
        for (int i = 0; i < B::nodes; ++i)
          if constexpr (T == 1) change[i] = drift.y[0] * p.N.d2[0][i];
          else if constexpr (!B::second[0]) change[i] = drift.y[1 - a] * p.N.d2[1][i];
          else change[i] = drift.y[0] * p.N.d2[a][i] + drift.y[1] * p.N.d2[a + 1][i];
        DofArray<S, N> now, turned;
        expand_to_nodes<B>(change, p.s.n, now);
        expand_to_nodes<B>(p.N.d1[a], derivative_of(drift.s.n), turned);
        for_each_dof(w1[a], [](auto u, auto v) ENTS_LAMBDA_INLINE { return u + v; }, now, turned);
      }
    }
  }
};

} // namespace ents::ENTS_ISA
