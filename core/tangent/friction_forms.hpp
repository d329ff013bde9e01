// SPDX-License-Identifier: BSD-3-Clause
// The forms (forms.hpp) of which the tangent of Coulomb friction is the sum of products, with, y = - M t and
// ' the derivative along y (theory.md, section 3),
//   t_a D2xi^a = F_uu' - dxi^a f'_a - f'_a dxi^a + F'_ab dxi^a dxi^b .
//   x_a = dxi^a = M^ab f_b
//   Y_a = - f'_a + (F'_ab - (A W'/g) F_,ab) x_b / 2
//   Z_a = z'_a + (A W'/g) z_a
//   dt_a: ChangeOfForce
// The derivative along y of a form's expansion is the expansion of another form, for delta X' = - y^k delta
// a_k and delta a_k' = y^l delta a_kl; only third derivatives of the basis ask for an expansion of their own.
#pragma once

#include "core/law/friction_point.hpp"
#include "core/tangent/directional_derivative.hpp"
#include "core/tangent/frictionless_tangent.hpp"

namespace ents::ENTS_ISA {

template <class Basis, bool Enriched, bool Rigid, class Scalar> struct FrictionForms {
  static constexpr int D = Basis::dim, T = D - 1, N = dof_count<Basis, Rigid>, M = N / D,
                       K = symmetric_size<T>;
  static constexpr bool turns = Enriched && !Rigid;       // w, Z: dofs of the master
  static constexpr bool bends = turns && !is_flat<Basis>; // does w change along y?
  // of f and of its rate, of z and of its rate
  static constexpr int parts = parts_of_f<Basis, Enriched>,
                       parts_of_rate = is_flat<Basis> ? parts : parts | on_curvatures;
  static constexpr int parts_of_z = on_position | on_tangents,
                       parts_of_z_rate = is_flat<Basis> ? parts_of_z : parts_of_z | on_curvatures;
  using Derivative = DirectionalDerivative<Basis, Enriched, Scalar>;

  // M and y = - M t
  static ENTS_INLINE void set_direction(const ProjectedPoint<Basis, Enriched, Scalar>& point,
                                        const Scalar (&force)[T], Scalar (&inverse)[K], Scalar (&y)[T]) {
    const auto& f2 = point.projector.f2;
    invert(f2, determinant(f2), inverse);
    for (int a = 0; a < T; ++a) {
      Scalar sum = inverse[symmetric_index(a, 0)] * force[0];
      if constexpr (T == 2) sum = sum + inverse[symmetric_index(a, 1)] * force[1];
      y[a] = -sum;
    }
  }

  // With a height, not inlined: this shortens compilation.
  template <class Part> static ENTS_INLINE void in_part(Part&& part) {
    if constexpr (Enriched)
      apart(part);
    else
      part();
  }
  template <class Part> static ENTS_NOINLINE void apart(Part&& part) { part(); }

  // x_a; value: f
  static ENTS_INLINE void set_x(const Form<Basis, Dual<Scalar>> (&f)[T], const Scalar (&inverse)[K],
                                Form<Basis, Scalar> (&value)[T], Form<Basis, Scalar> (&x)[T]) {
    for (int a = 0; a < T; ++a) value_of_form<parts>(f[a], value[a]);
    for (int a = 0; a < T; ++a) {
      set_form<parts>(x[a], inverse[symmetric_index(a, 0)], value[0]);
      if constexpr (T == 2) add_form<parts>(x[a], inverse[symmetric_index(a, 1)], value[1]);
    }
  }

  // dt_a = by_xi[a][c] x_c + sum_b towards[a][b] . D(rho_e,b) + dt_a/dg dg, where D is at fixed xi, and w =
  // moved changes by share dxi. With u = stretch, n_a the direction of the trial t_a = scale (A_ab w^b +
  // multiplier) and m = u / |u|,
  //   stick  dt_a = scale D(A_ab w^b)
  //   slip   t_a = L n_a,  dn_a = (D(A_ab w^b) - n_a m^b (D(A_bc w^c) - D(A_bc) u^c / 2)) / |u|
  // A coefficient that depends on the slip rate has dL/d|t|: n_a times less is subtracted, `radial` of it.
  // Without a multiplier u = w, and what is subtracted becomes n_a (m_c dxi^c + m^b w^c D(A_bc) / 2).
  struct ChangeOfForce {
    Scalar by_xi[T][T];
    Vec<Scalar, D> towards[T][T];

    ENTS_INLINE ChangeOfForce(const ProjectedPoint<Basis, Enriched, Scalar>& point,
                              const Friction<Scalar, Basis::dim - 1>& friction, bool multipliers,
                              const Scalar* radial = nullptr) {
      const auto& surface = point.projector.s;
      const auto& metric = point.projector.metric;
      const auto& w = friction.moved;
      const Scalar none(0.0);
      const Scalar ratio =
          select(friction.slip,
                 friction.scale * (friction.limit / select(friction.slip, friction.norm, Scalar(1.0))),
                 select(friction.active, friction.scale, none));
      Scalar m[T], slips[T];
      for (int a = 0; a < T; ++a) {
        slips[a] = select(friction.slip, friction.direction[a], none);
        m[a] = select(friction.slip, friction.raised[a], none);
      }
      // (A_ab w^b)_,c at fixed w and |u|_,c, with W = w^b rho_e,b
      Vec<Scalar, D> W = w[0] * surface.e[0];
      if constexpr (T == 2) add_scaled(W, w[1], surface.e[1]);
      Scalar along[T];
      for (int c = 0; c < T; ++c) {
        along[c] = friction.share * slips[c];
        for (int a = 0; a < T; ++a) by_xi[a][c] = friction.share * metric[symmetric_index(a, c)];
        if constexpr (Enriched || !is_flat<Basis>) {
          Vec<Scalar, D> bend = w[0] * surface.e2[symmetric_index(0, c)];
          if constexpr (T == 2) add_scaled(bend, w[1], surface.e2[symmetric_index(1, c)]);
          for (int a = 0; a < T; ++a) {
            by_xi[a][c] = dot(surface.e[a], bend) + dot(W, surface.e2[symmetric_index(a, c)]) + by_xi[a][c];
            if (!multipliers) along[c] = along[c] + m[a] * dot(surface.e[a], bend);
          }
        }
      }
      if (radial)
        for (Scalar& n : slips) n = *radial * n;
      for (int a = 0; a < T; ++a)
        for (int b = 0; b < T; ++b) towards[a][b] = (ratio * w[b]) * surface.e[a];
      if (multipliers) {
        Scalar v[T]; // w - u / 2
        for (int a = 0; a < T; ++a) v[a] = w[a] - 0.5 * friction.stretch[a];
        Vec<Scalar, D> V = v[0] * surface.e[0], U = m[0] * surface.e[0];
        if constexpr (T == 2) add_scaled(V, v[1], surface.e[1]), add_scaled(U, m[1], surface.e[1]);
        if constexpr (Enriched || !is_flat<Basis>)
          for (int c = 0; c < T; ++c)
            for (int a = 0; a < T; ++a) {
              const auto& bend = surface.e2[symmetric_index(a, c)];
              along[c] = along[c] + (m[a] * dot(bend, V) + v[a] * dot(bend, U));
            }
        for (int a = 0; a < T; ++a)
          for (int b = 0; b < T; ++b) {
            add_scaled(towards[a][b], -(ratio * slips[a] * m[b]), V);
            add_scaled(towards[a][b], -(ratio * slips[a] * v[b]), U);
          }
      } else {
        for (int a = 0; a < T; ++a)
          for (int b = 0; b < T; ++b) add_scaled(towards[a][b], -(ratio * slips[a] * m[b]), W);
      }
      for (int a = 0; a < T; ++a) {
        for (int c = 0; c < T; ++c) by_xi[a][c] = ratio * (by_xi[a][c] - slips[a] * along[c]);
        towards[a][a] = towards[a][a] + ratio * W;
      }
    }

    // sum_b towards[a][b] . D(rho_e,b)
    ENTS_INLINE void add_to(int a, const Surface<Basis, Enriched, Scalar>& surface,
                            Form<Basis, Scalar>& f) const {
      unroll<T>([&](auto b) ENTS_LAMBDA_INLINE { add_slope<b.value>(surface, towards[a][b], f); });
    }
    template <int I>
    static ENTS_INLINE void add_slope(const Surface<Basis, Enriched, Scalar>& surface,
                                      const Vec<Scalar, D>& c, Form<Basis, Scalar>& f) {
      if constexpr (!Enriched) {
        f.a[I] = f.a[I] + c;
      } else {
        Form<Basis, Scalar> of;
        form_of_slope<I, Basis, Enriched>(surface, c, of);
        for (int k = 0; k < T; ++k) f.a[k] = f.a[k] + of.a[k];
        if constexpr (!is_flat<Basis>)
          unroll<T>([&](auto k) ENTS_LAMBDA_INLINE {
            constexpr int at = symmetric_index(k, I);
            if constexpr (Basis::second[at]) f.a2[at] = f.a2[at] + of.a2[at];
          });
      }
    }
  };

  // dt_a/dg of the penalty and the power law: by the gap itself, and by the pressure
  static ENTS_INLINE Scalar by_gap(int a, const Plan& plan,
                                   const ProjectedPoint<Basis, Enriched, Scalar>& point,
                                   const Friction<Scalar, Basis::dim - 1>& friction) {
    const Scalar exponent = Scalar(0.5 * plan.law.twice_exponent); // W'' = m W'/g
    return friction.by_gap[a] - friction.by_force[a] * (exponent * point.area * point.per_gap);
  }

  // (F'_ab - (A W'/g) F_,ab) / 2
  static ENTS_INLINE Scalar half_bend(int a, int b, const Derivative& derivative, const Scalar& stiffness) {
    const int k = symmetric_index(a, b);
    return 0.5 * (derivative.f2[k] - stiffness * derivative.p.f2[k]);
  }
  // Y_a but for what changes by third derivatives; rate: f'_a
  static ENTS_INLINE void set_Y(int a, const Derivative& derivative, const Scalar& stiffness,
                                const Form<Basis, Dual<Scalar>> (&f)[T], const Form<Basis, Scalar> (&x)[T],
                                Form<Basis, Scalar>& rate, Form<Basis, Scalar>& Y) {
    set_form_rate<parts>(f[a], derivative.y, rate);
    set_form<parts_of_rate>(Y, Scalar(-1.0), rate);
    for (int c = 0; c < T; ++c) add_form<parts>(Y, half_bend(a, c, derivative, stiffness), x[c]);
  }
  // dt_a or, if Joined, Y_a + dt_a; gap: dg
  template <bool Joined>
  static ENTS_INLINE void set_P(int a, const Derivative& derivative, const Scalar& stiffness,
                                const Form<Basis, Scalar>& rate, const Form<Basis, Scalar> (&x)[T],
                                const ChangeOfForce& change, const Scalar& by_gap,
                                const Form<Basis, Scalar>& gap, Form<Basis, Scalar>& P) {
    if constexpr (Joined) set_form<parts_of_rate>(P, Scalar(-1.0), rate);
    for (int c = 0; c < T; ++c) {
      if constexpr (Joined)
        add_form<parts>(P, half_bend(a, c, derivative, stiffness) + change.by_xi[a][c], x[c]);
      else if (c == 0)
        set_form<parts>(P, change.by_xi[a][c], x[c]);
      else
        add_form<parts>(P, change.by_xi[a][c], x[c]);
    }
    change.add_to(a, derivative.p.s, P);
    add_form<parts_of_p<Enriched>>(P, by_gap, gap);
  }

  static constexpr bool by_third =
      Enriched && !Rigid && Derivative::bend_changes; // may forms of second derivatives change?
  // d2: y^c N_,abc
  static ENTS_INLINE void set_shape_rates(const Basis& basis, const Scalar (&xi)[T], const Scalar (&y)[T],
                                          Shape<Scalar, T, Basis::nodes>& of) {
    basis.template shape<3>(xi, of);
    const int nodes = node_count(basis);
    unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (T == 1) {
        for (int i = 0; i < nodes; ++i) of.d2[k][i] = y[0] * of.d3[0][i];
      } else if (!has_third(basis, k)) {
        for (int i = 0; i < nodes; ++i) of.d2[k][i] = y[1] * of.d3[k + 1][i];
      } else if (!has_third(basis, k + 1)) {
        for (int i = 0; i < nodes; ++i) of.d2[k][i] = y[0] * of.d3[k][i];
      } else {
        for (int i = 0; i < nodes; ++i) of.d2[k][i] = y[0] * of.d3[k][i] + y[1] * of.d3[k + 1][i];
      }
    });
  }
  // - value of the part on second derivatives, whose expansion changes by third ones
  static ENTS_INLINE void subtract_third(const Basis& basis, const Form<Basis, Scalar>& value,
                                         const Shape<Scalar, T, Basis::nodes>& rates,
                                         DofArray<Basis, Rigid, Scalar>& from) {
    DofArray<Basis, Rigid, Scalar> of;
    expand_to_dofs<Rigid, on_curvatures>(basis, value, rates, of);
    for_each_dof(
        dofs_of<Rigid>(basis), from, [](auto u, auto v) ENTS_LAMBDA_INLINE { return u - v; }, from, of);
  }
  // y^b N_,ab
  static ENTS_INLINE void set_slope_rates(int a, const Basis& basis, const Shape<Scalar, T, Basis::nodes>& N,
                                          const Scalar (&y)[T], Scalar (&change)[Basis::nodes]) {
    const int nodes = node_count(basis);
    for (int i = 0; i < nodes; ++i)
      if constexpr (T == 1)
        change[i] = y[0] * N.d2[0][i];
      else if constexpr (!Basis::second[0])
        change[i] = y[1 - a] * N.d2[1][i];
      else
        change[i] = y[0] * N.d2[a][i] + y[1] * N.d2[a + 1][i];
  }
  // The rate of w_a
  static ENTS_INLINE void expand_turn_rate(int a, const Derivative& derivative,
                                           DofArray<Basis, false, Scalar>& w1) {
    const Basis& basis = derivative.p.nodes.basis;
    Scalar change[Basis::nodes];
    set_slope_rates(a, basis, derivative.p.N, derivative.y, change);
    DofArray<Basis, false, Scalar> now, turned;
    expand_to_nodes(basis, change, derivative.p.s.n, now);
    expand_to_nodes(basis, derivative.p.N.d1[a], derivative_of(derivative.s.n), turned);
    for_each_dof(
        dofs_of<false>(basis), w1, [](auto u, auto v) ENTS_LAMBDA_INLINE { return u + v; }, now, turned);
  }

  static ENTS_INLINE void set_Z(const Form<Basis, Dual<Scalar>>& moving_z, const Derivative& derivative,
                                const Scalar& stiffness, Form<Basis, Scalar>& z, Form<Basis, Scalar>& Z) {
    value_of_form<parts_of_z>(moving_z, z);
    set_form_rate<parts_of_z>(moving_z, derivative.y, Z);
    add_form<parts_of_z>(Z, stiffness, z);
  }
};

} // namespace ents::ENTS_ISA
