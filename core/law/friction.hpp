// SPDX-License-Identifier: BSD-3-Clause
// Coulomb friction with return mapping on the enriched surface, one element or one per lane.
//
// The elastic slip is counted from an anchor xi_0, a point of the master surface kept in the state: a rigid
// motion of the element does not move it, and no vector has to be rotated. Covariant tangential force, per
// element, work-conjugate to delta xi^a:
//   trial  t_a = A (lambda_a + eps_t A_ab (xi^b - xi_0^b)),  A_ab = rho_e,a . rho_e,b
//          of an element that touches within the increment s (xi^b - xi_n^b) instead (theory.md, section 5.10)
//   stick  |t| = sqrt(t_a A^ab t_b) <= L,  L = min(mu p A, shear limit A)
//   slip   t_a = L m_a,  m_a = t_a / |t| of the trial
//
//   R = A W' dg + t_a dxi^a,   dxi^a = M^ab f_b,  M = F_,xixi^-1
//   K = A W'/g D2F* [+ law] + dxi^a dt_a + t_a D2xi^a
// with, y = - M t and ' the derivative along y (theory.md, section 3),
//   t_a D2xi^a = F_uu' - dxi^a f'_a - f'_a dxi^a + F'_ab dxi^a dxi^b .
// All but the last expansion to dofs happens in the reduced space of forms.hpp.
#pragma once

#include "core/law/friction_coefficient.hpp"
#include "core/law/friction_point.hpp"

namespace ents::ENTS_ISA {

template <class S, int T>
template <bool Varies>
ENTS_INLINE void Friction<S, T>::evaluate(const ContactLaw& law, const FrictionPlace<S, T>& at,
                                          const SlipBegin<S, T>& begin, const SlipShare<S>& slipping,
                                          const S& pressure_force, const S* multiplier) {
  const auto& metric = at.metric;
  active = both(at.contact, begin.known > 0.0);
  closes = both(active, slipping.touches > 0.5);
  share = slipping.share;
  scale = law.friction_stiffness * at.area;
  S lowered[T], far = scale / safe_magnitude;
  for (int a = 0; a < T; ++a) {
    moved[a] = select(active, share * (at.xi[a] - begin.from[a]), S(0.0));
    far = far + 1e-6 * absolute(moved[a]);
  }
  ordinary = far < 1.0;
  for (int a = 0; a < T; ++a) {
    stretch[a] = moved[a];
    lowered[a] = metric[symmetric_index(a, 0)] * moved[0];
    if constexpr (T == 2) lowered[a] = lowered[a] + metric[symmetric_index(a, 1)] * moved[1];
  }
  if (multiplier) add_multiplier(law, metric, multiplier, lowered);
  S norm2 = stretch[0] * lowered[0];
  if constexpr (T == 2) norm2 = norm2 + stretch[1] * lowered[1];
  norm = scale * square_root(norm2);
  if (!law.has_friction_force()) return slip_freely();
  by_pressure = law_number<S>(law.friction_coefficient, law.rates.friction);
  limit = by_pressure * pressure_force;
  if (law.may_not_press()) { // what pulls leaves no friction
    const Truth<S> presses = pressure_force > 0.0;
    limit = select(presses, limit, S(0.0));
    by_pressure = select(presses, by_pressure, S(0.0));
  }
  if constexpr (Varies) {
    by_norm = S(0.0), radial = S(1.0);
    if (law.coefficient_varies()) vary(law, at, begin, pressure_force);
  }
  at_shear_limit = limit < limit; // none
  if (law.shear_limit > 0.0) {
    const S most = law.shear_limit * at.area;
    at_shear_limit = most < limit;
    limit = select(at_shear_limit, most, limit);
    by_pressure = select(at_shear_limit, S(0.0), by_pressure);
    if constexpr (Varies) {
      by_norm = select(at_shear_limit, S(0.0), by_norm);
      radial = select(at_shear_limit, S(1.0), radial);
    }
  }
  // a negative area, which is refused later, has a negative limit, and no direction at norm 0
  slip = both(both(active, norm > limit), norm > 0.0);
  if (law.friction == FrictionKind::rough) slip = limit < limit;
  at_shear_limit = both(at_shear_limit, slip);
  const S q = scale / select(slip, norm, S(1.0));
  for (int a = 0; a < T; ++a) {
    direction[a] = q * lowered[a];
    raised[a] = q * stretch[a];
    force[a] = select(slip, limit * direction[a], scale * lowered[a]);
    by_gap[a] = S(0.0);
    by_force[a] = select(slip, direction[a] * by_pressure, S(0.0));
  }
  if (slipping.some) differentiate_share<Varies>(law, at, begin, slipping.rate);
}

template <class S, int T>
ENTS_INLINE void Friction<S, T>::vary(const ContactLaw& law, const FrictionPlace<S, T>& at,
                                      const SlipBegin<S, T>& begin, const S& pressure_force) {
  const Truth<S> presses = pressure_force > 0.0;
  const auto of =
      slip_limit_of(law, norm, select(presses, pressure_force, S(0.0)), at.area, scale, begin.time);
  limit = of.limit, by_norm = of.by_norm;
  by_pressure = select(presses, of.by_force, S(0.0));
  const Truth<S> some = limit > 0.0;
  radial = select(some, 1.0 - of.by_norm * (norm / select(some, limit, S(1.0))), S(1.0));
}

// A coefficient of 0: an element that was in contact slips, without a force.
template <class S, int T> ENTS_INLINE void Friction<S, T>::slip_freely() {
  slip = active;
  at_shear_limit = norm < norm;
  limit = by_pressure = by_norm = S(0.0);
  radial = S(1.0);
  for (int a = 0; a < T; ++a) direction[a] = raised[a] = force[a] = by_gap[a] = by_force[a] = S(0.0);
}

template <class S, int T>
ENTS_INLINE void Friction<S, T>::add_multiplier(const ContactLaw& law, const S (&metric)[K],
                                                const S* multiplier, S (&lowered)[T]) {
  S inverse[K], own[T];
  const double compliance = 1.0 / law.friction_stiffness;
  invert_with(metric, unchecked_inverse(determinant(metric)), inverse);
  for (int a = 0; a < T; ++a) own[a] = select(active, compliance * multiplier[a], S(0.0));
  for (int a = 0; a < T; ++a) {
    lowered[a] = lowered[a] + own[a];
    S raised_own = inverse[symmetric_index(a, 0)] * own[0];
    if constexpr (T == 2) raised_own = raised_own + inverse[symmetric_index(a, 1)] * own[1];
    stretch[a] = stretch[a] + select(active, raised_own, S(0.0));
  }
}

// t_a changes with the part of the increment that is slip; its direction only beside a multiplier.
template <class S, int T>
template <bool Varies>
ENTS_INLINE void Friction<S, T>::differentiate_share(const ContactLaw& law, const FrictionPlace<S, T>& at,
                                                     const SlipBegin<S, T>& begin, const S& rate) {
  const auto& metric = at.metric;
  S lowered[T], along = S(0.0);
  for (int a = 0; a < T; ++a) {
    lowered[a] = metric[symmetric_index(a, 0)] * (at.xi[0] - begin.from[0]);
    if constexpr (T == 2)
      lowered[a] = lowered[a] + metric[symmetric_index(a, 1)] * (at.xi[1] - begin.from[1]);
  }
  for (int a = 0; a < T; ++a) along = along + raised[a] * lowered[a];
  // The direction of an element that slips follows its multiplier, if it has one beside the trial.
  const S turns(law.multiplier_in_state() ? 1.0 : 0.0), none(0.0);
  const S q = select(slip, turns * (limit / select(slip, norm, S(1.0))), S(1.0)) * (scale * rate);
  for (int a = 0; a < T; ++a) {
    S change = q * (lowered[a] - select(slip, direction[a] * along, none));
    if constexpr (Varies)
      change = change + select(slip, direction[a] * (by_norm * (scale * (rate * along))), none);
    const S by_depth = select(closes, change, none);
    by_gap[a] = none - by_depth;
  }
}

template <class S, int T>
void evaluate_friction(const ContactLaw& law, const FrictionPlace<S, T>& at, const SlipBegin<S, T>& begin,
                       const SlipShare<S>& slipping, const S& pressure_force, const S* multiplier,
                       Friction<S, T>& to) {
  to.template evaluate<true>(law, at, begin, slipping, pressure_force, multiplier);
}

} // namespace ents::ENTS_ISA
