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

// K = (s r^T + r s^T) I + sum_a (w_a Z_a^T + Z_a w_a^T + w1_a z_a^T + z_a w1_a^T) + sum_a (x_a P_a^T + Y_a x_a^T) [ + g g^T ]
// x_a = dxi^a
template <class B, bool H, bool Rigid, class S> struct PairFrictionTangent {
  static constexpr int D = B::dim, T = D - 1, N = dof_count<B, Rigid>, M = N / D, K = symmetric_size<T>;
  static constexpr bool turns = H && !Rigid;               // w, Z: dofs of the master
  static constexpr bool bends = turns && !is_flat<B>; // does w change along y?
  static constexpr bool symmetric = false;
  S weights[2][M]; // s, r
  DofArray<S, N> x[T], Y[T], P[T];
  DofArray<S, N> w[turns ? T : 1], Z[turns ? T : 1], w1[bends ? T : 1], z[bends ? T : 1];
  DofArray<S, N> g;
  bool curved_law;

  ENTS_INLINE void evaluate(const Plan& plan, const Pair<B, H, S>& pair, const PairFriction<B, H, S>& friction) {
    constexpr int parts = parts_of_f<B, H>;
    const auto& p = pair.projector;
    const S stiffness = pair.area * pair.per_gap;
    Form<B, S> f[T], xf[T];
    forms_of_f(p.s, f);
    S inverse[K];
    invert(p.f2, determinant(p.f2), inverse);
    for (int a = 0; a < T; ++a) {
      xf[a] = zero_form<B, S>();
      for (int b = 0; b < T; ++b) add_form<parts>(xf[a], inverse[symmetric_index(a, b)], f[b]);
      expand_to_dofs<B, Rigid, parts>(xf[a], p.N, x[a]);
    }

    // along y = - M t
    using U = Dual<S>;
    U xi[T];
    for (int a = 0; a < T; ++a) {
      S y = inverse[symmetric_index(a, 0)] * friction.force[0];
      if constexpr (T == 2) y = y + inverse[symmetric_index(a, 1)] * friction.force[1];
      xi[a] = U(pair.xi[a], -y);
    }
    PairNodes<B, U> nodes;
    for (int i = 0; i < B::nodes; ++i) set_constant(nodes.y[i], pair.nodes.y[i]);
    nodes.has_coordinates = pair.nodes.has_coordinates;
    if (nodes.has_coordinates)
      for (int i = 0; i < T * B::nodes; ++i) nodes.coordinates[i] = U(pair.nodes.coordinates[i]);
    nodes.height = pair.nodes.height;
    PairProjector<B, H, U> moving(nodes);
    in_part([&] ENTS_LAMBDA_INLINE { move(xi, moving); });
    Shape<S, T, B::nodes> N1;
    for (int i = 0; i < B::nodes; ++i) {
      N1.n[i] = moving.N.n[i].d;
      for (int a = 0; a < T; ++a) N1.d1[a][i] = moving.N.d1[a][i].d;
      unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
        if constexpr (B::second[k]) N1.d2[k][i] = moving.N.d2[k][i].d;
      });
    }

    set_weights(stiffness, p.N, N1);
    in_part([&] ENTS_LAMBDA_INLINE { set_projection_terms(stiffness, p.N, N1, moving, f, xf); });
    if constexpr (turns) in_part([&] ENTS_LAMBDA_INLINE { set_height_terms(stiffness, p, N1, moving); });
    in_part([&] ENTS_LAMBDA_INLINE { add_change_of_force(plan, pair, friction, xf); });

    curved_law = plan.law.twice_exponent > 2;
    if (curved_law) {
      Form<B, S> gf;
      form_of_p<B, H>(p.s, (square_root(stiffness) * square_root(0.5 * plan.law.twice_exponent - 1.0)) * pair.normal, gf);
      expand_to_dofs<B, Rigid, parts_of_p<H>>(gf, p.N, g);
    } else {
      for_each_dof(g, [] ENTS_LAMBDA_INLINE { return S(0.0); });
    }
  }

  // k + all but the weights; row(array) is the array's entry of the row
  template <class R, class Row> ENTS_INLINE R add_products(R k, Row&& row, int j) const {
    for (int a = 0; a < T; ++a) {
      if constexpr (turns) k = k + (row(w[a]) * R(Z[a][j]) + row(Z[a]) * R(w[a][j]));
      if constexpr (bends) k = k + (row(w1[a]) * R(z[a][j]) + row(z[a]) * R(w1[a][j]));
      k = k + (row(x[a]) * R(P[a][j]) + row(Y[a]) * R(x[a][j]));
    }
    if (curved_law) k = k + row(g) * R(g[j]);
    return k;
  }

private:
  // With a height, in parts that compilers digest.
  template <class Part> static ENTS_INLINE void in_part(Part&& part) {
    if constexpr (H) apart(part);
    else part();
  }
  template <class Part> static ENTS_NOINLINE void apart(Part&& part) { part(); }

  static ENTS_INLINE void move(const Dual<S> (&xi)[T], PairProjector<B, H, Dual<S>>& moving) {
    if constexpr (!PairProjector<B, H, Dual<S>>::closed_form) moving.evaluate(xi);
    moving.finish(xi);
  }

  // Y_a = - f'_a + F'_ab x_b / 2 - (A W'/g) f_a / 2
  ENTS_INLINE void set_projection_terms(const S& stiffness, const Shape<S, T, B::nodes>& N0, const Shape<S, T, B::nodes>& N1,
                                          const PairProjector<B, H, Dual<S>>& moving, const Form<B, S> (&f)[T], const Form<B, S> (&xf)[T]) {
    constexpr int parts = parts_of_f<B, H>;
    using U = Dual<S>;
    Form<B, U> moving_f[T];
    forms_of_f(moving.s, moving_f);
    for (int a = 0; a < T; ++a) {
      Form<B, S> rate, value;
      split<parts>(moving_f[a], value, rate);
      Form<B, S> sum = zero_form<B, S>();
      add_form<parts>(sum, S(-1.0), rate);
      add_form<parts>(sum, -0.5 * stiffness, f[a]);
      for (int b = 0; b < T; ++b) add_form<parts>(sum, 0.5 * moving.f2[symmetric_index(a, b)].d, xf[b]);
      DofArray<S, N> now, turned; // the slave's shape function does not change
      expand_to_dofs<B, Rigid, parts>(sum, N0, now);
      expand_to_dofs<B, Rigid, parts, false>(value, N1, turned);
      for_each_dof(Y[a], [](auto u, auto v) ENTS_LAMBDA_INLINE { return u - v; }, now, turned);
    }
  }

  ENTS_INLINE void set_height_terms(const S& stiffness, const PairProjector<B, H, S>& p, const Shape<S, T, B::nodes>& N1,
                                      const PairProjector<B, H, Dual<S>>& moving) {
    using U = Dual<S>;
    const Vec<S, D> turn = derivative_of(moving.s.n);
    Form<B, U> moving_z[T];
    forms_of_z<B>(moving.s, moving_z);
    for (int a = 0; a < T; ++a) {
      Form<B, S> rate, value;
      split<on_position | on_tangents>(moving_z[a], value, rate);
      Form<B, S> sum = rate;
      add_form<on_position | on_tangents>(sum, stiffness, value);
      const auto add = [](auto u, auto v) ENTS_LAMBDA_INLINE { return u + v; };
      DofArray<S, N> now, turned;
      expand_to_dofs<B, Rigid, on_position | on_tangents>(sum, p.N, now);
      expand_to_dofs<B, Rigid, on_position | on_tangents, false>(value, N1, turned);
      for_each_dof(Z[a], add, now, turned);
      expand_to_nodes<B>(p.N.d1[a], p.s.n, w[a]);
      if constexpr (bends) {
        expand_to_dofs<B, Rigid, on_position | on_tangents>(value, p.N, z[a]);
        expand_to_nodes<B>(N1.d1[a], p.s.n, now);
        expand_to_nodes<B>(p.N.d1[a], turn, turned);
        for_each_dof(w1[a], add, now, turned);
      }
    }
  }

  // (A W'/g) s s^T + s s1^T + s1 s^T = s r^T + r s^T with r = s1 + (A W'/g) s / 2
  ENTS_INLINE void set_weights(const S& stiffness, const Shape<S, T, B::nodes>& N0, const Shape<S, T, B::nodes>& N1) {
    const S half = 0.5 * stiffness;
    weights[0][0] = S(1.0);
    weights[1][0] = half;
    if constexpr (!Rigid)
      for (int i = 0; i < B::nodes; ++i) {
        weights[0][i + 1] = -N0.n[i];
        weights[1][i + 1] = -N1.n[i] - half * N0.n[i];
      }
  }

  // P_a = Y_a + dt_a
  ENTS_INLINE void add_change_of_force(const Plan& plan, const Pair<B, H, S>& pair, const PairFriction<B, H, S>& friction,
                                       const Form<B, S> (&xf)[T]) {
    constexpr int parts = parts_of_f<B, H>, slope = parts_of_slope<B, H>;
    const auto& p = pair.projector;
    const auto& surface = p.s;
    // scale (dA_ab w^b + A_ab x_b), w = moved
    Form<B, S> dt[T];
    Vec<S, D> W = friction.moved[0] * surface.e[0];
    if constexpr (T == 2) add_scaled(W, friction.moved[1], surface.e[1]);
    const S scale = select(friction.active, friction.scale, S(0.0));
    unroll<T>([&](auto a) ENTS_LAMBDA_INLINE {
      dt[a] = zero_form<B, S>();
      Form<B, S> of;
      unroll<T>([&](auto b) ENTS_LAMBDA_INLINE {
        form_of_slope<b.value, B, H>(surface, (scale * friction.moved[b]) * surface.e[a], of);
        add_form<slope>(dt[a], S(1.0), of);
      });
      form_of_slope<a.value, B, H>(surface, scale * W, of);
      add_form<slope>(dt[a], S(1.0), of);
      for (int c = 0; c < T; ++c) {
        Vec<S, D> bend = friction.moved[0] * surface.e2[symmetric_index(0, c)];
        if constexpr (T == 2) add_scaled(bend, friction.moved[1], surface.e2[symmetric_index(1, c)]);
        const S rate = dot(surface.e[a], bend) + dot(W, surface.e2[symmetric_index(a, c)]) + p.metric[symmetric_index(a, c)];
        add_form<parts>(dt[a], scale * rate, xf[c]);
      }
    });
    if (any(friction.slip)) {
      // dt_a <- m_a dL + ratio (dt_a - m_a d|t|),  d|t| = m^a dt_a - |t| W . m^b D(rho_e,b), W = m^b rho_e,b
      Vec<S, D> M1 = friction.raised[0] * surface.e[0];
      if constexpr (T == 2) add_scaled(M1, friction.raised[1], surface.e[1]);
      Form<B, S> norm = zero_form<B, S>();
      for (int a = 0; a < T; ++a) add_form<parts>(norm, friction.raised[a], dt[a]);
      unroll<T>([&](auto b) ENTS_LAMBDA_INLINE {
        Form<B, S> of;
        form_of_slope<b.value, B, H>(surface, (-friction.norm * friction.raised[b]) * M1, of);
        add_form<slope>(norm, S(1.0), of);
      });
      for (int c = 0; c < T; ++c) {
        Vec<S, D> bend = friction.raised[0] * surface.e2[symmetric_index(0, c)];
        if constexpr (T == 2) add_scaled(bend, friction.raised[1], surface.e2[symmetric_index(1, c)]);
        add_form<parts>(norm, -friction.norm * dot(M1, bend), xf[c]);
      }
      Form<B, S> gap;
      const S m = S(0.5 * plan.law.twice_exponent); // W'' = m W'/g
      form_of_p<B, H>(surface, (-friction.by_pressure * (m * pair.area * pair.per_gap)) * pair.normal, gap);
      if constexpr (!H)
        for (auto& v : gap.a) v = Vec<S, D>::zero();
      for (auto& v : gap.a2) v = Vec<S, D>::zero();
      const S ratio = friction.limit / select(friction.slip, friction.norm, S(1.0));
      for (int a = 0; a < T; ++a) {
        Form<B, S> now = zero_form<B, S>();
        add_form<parts>(now, ratio, dt[a]);
        add_form<parts>(now, -(ratio * friction.direction[a]), norm);
        add_form<parts>(now, friction.direction[a], gap);
        select_form<parts>(friction.slip, now, dt[a]);
      }
    }
    for (int a = 0; a < T; ++a) {
      DofArray<S, N> change;
      expand_to_dofs<B, Rigid, parts>(dt[a], p.N, change);
      for_each_dof(P[a], [](auto u, auto v) ENTS_LAMBDA_INLINE { return u + v; }, Y[a], change);
    }
  }
};

} // namespace ents::ENTS_ISA
