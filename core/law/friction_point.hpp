// SPDX-License-Identifier: BSD-3-Clause
// Friction of an element, or of one per lane: what the return mapping (friction.hpp) finds. Kernels of any law
// call it out of line, so that none is compiled again for it.
#pragma once

#include "core/law/touch.hpp"
#include "core/numbers/vec.hpp"

namespace ents::ENTS_ISA {

// What friction sees of an element's place: T surface coordinates, the metric A_ab there.
template <class S, int T> struct FrictionPlace {
  const S (&xi)[T];
  const S (&metric)[symmetric_size<T>];
  const S& area;
  Truth<S> contact;
};

// What slip dissipates in an increment: the force that is left, L, times how far the anchor moves
template <class S> ENTS_INLINE S slip_dissipation(const S& limit, const S& norm, const S& scale) {
  return limit * ((norm - limit) / scale);
}

template <class S, int T> struct Friction {
  static constexpr int K = symmetric_size<T>;
  Truth<S> active, slip, at_shear_limit;
  Truth<S> ordinary;    // false: numbers near the edge of their range
  Truth<S> closes;      // was it open at the begin of the increment?
  S share;              // s of touch.hpp
  S moved[T];           // s (xi - xi_0); 0 where there is no friction
  S stretch[T];         // A^ab t_b / (eps_t A) of the trial: that of the elastic slip, and of the multiplier
  S force[T];           // t_a
  S scale;              // eps_t A
  S norm;               // |t| of the trial
  S limit, by_pressure; // L, dL / d(p A)
  S by_norm, radial;    // of a coefficient that varies: dL / d|t|, 1 - |t| / L of it
  S direction[T], raised[T];
  S by_gap[T], by_force[T]; // dt_a / dg, dt_a / d(p A) at a fixed place

  // slipping: the part of the increment; pressure_force: p A; multiplier: lambda_a [F/L], or null; Varies: may the
  // coefficient?
  template <bool Varies = false>
  void evaluate(const ContactLaw& law, const FrictionPlace<S, T>& at, const SlipBegin<S, T>& begin,
                const SlipShare<S>& slipping, const S& pressure_force, const S* multiplier = nullptr);

  // No friction.
  ENTS_INLINE void set_none() {
    const S zero(0.0);
    active = slip = at_shear_limit = zero < zero;
    closes = active;
    ordinary = zero <= zero;
    share = S(1.0);
    for (int a = 0; a < T; ++a) {
      moved[a] = stretch[a] = force[a] = direction[a] = raised[a] = zero;
      by_gap[a] = by_force[a] = zero;
    }
    scale = norm = limit = by_pressure = by_norm = zero;
    radial = S(1.0);
  }

private:
  void vary(const ContactLaw& law, const FrictionPlace<S, T>& at, const SlipBegin<S, T>& begin,
            const S& pressure_force);
  void slip_freely();
  void add_multiplier(const ContactLaw& law, const S (&metric)[K], const S* multiplier, S (&lowered)[T]);
  template <bool Varies>
  void differentiate_share(const ContactLaw& law, const FrictionPlace<S, T>& at, const SlipBegin<S, T>& begin,
                           const S& rate);
};

// evaluate<true>() of laws.cpp
template <class S, int T>
void evaluate_friction(const ContactLaw& law, const FrictionPlace<S, T>& at, const SlipBegin<S, T>& begin,
                       const SlipShare<S>& slipping, const S& pressure_force, const S* multiplier,
                       Friction<S, T>& to);

// The same of one element: t_a times what of xi - xi_0 is slip; all of it is where a multiplier has the force.
template <class S, int T>
ENTS_INLINE S dissipation_of(const ContactLaw& law, const Friction<S, T>& friction) {
  S sum(0.0);
  if (!friction.active || !friction.slip) return sum;
  if (law.multiplier == Multiplier::none)
    return slip_dissipation(friction.limit, friction.norm, friction.scale);
  for (int a = 0; a < T; ++a) sum = sum + friction.force[a] * friction.moved[a];
  return sum;
}

} // namespace ents::ENTS_ISA
