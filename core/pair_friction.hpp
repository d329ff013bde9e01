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
  for (auto& v : force.a2.of) v = Vec<S, B::dim>::zero();
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

} // namespace ents::ENTS_ISA
