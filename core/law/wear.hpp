// SPDX-License-Identifier: BSD-3-Clause
// Archard's wear within an increment (Archard, J. Appl. Phys. 24, 1953): a surface that slides by ds under
// the pressure p loses the depth dw = k p ds. It is part of the element's gap (theory.md, section 7):
//
//   w = w_n + k ds ((1 - q) p_n + q p),   p = - W'(g + w)        q: Wear::implicit
//
// which for every law is one equation for p with one root, since W' does not fall: a compliance q k ds in
// series with that of the law. No new unknown; stable for every ds if q = 1.
//
//   ds^2 = D^a A_ab D^b + b^2,  D = s (xi - xi_n)
//     xi_n: projection at the begin of the increment, s: the part that is slip (theory.md, section 5.10), b: Wear::sliding
//   delta W' = W''/(1 + q k ds W'') (delta g + k ((1 - q) p_n + q p) delta ds)
//   delta ds = m . ((s rho_e,c + D^b rho_e,bc) delta xi^c + D^b delta rho_e,b
//                   - s' (xi - xi_n)^a rho_e,a delta g),   m = D^a rho_e,a / ds,  s' = ds/dz
//
// All of the slip counts, its elastic part with friction included.
#pragma once

#include "core/law/worn_depth.hpp"

namespace ents::ENTS_ISA {

// ds, and what its variation needs
template <class S, int D>
void set_slid(const ContactLaw& law, const WornState<S, D - 1>& begin, const S (&xi)[D - 1],
              const Vec<S, D> (&tangents)[D - 1], const SlipShare<S>& slipping, WearOfIncrement<S, D>& to) {
  S whole[D - 1];
  for (int a = 0; a < D - 1; ++a) {
    whole[a] = select(begin.seen > 0.0, xi[a] - begin.anchor[a], S(0.0));
    to.moved[a] = slipping.share * whole[a];
  }
  Vec<S, D> way = to.moved[0] * tangents[0];
  if constexpr (D == 3) add_scaled(way, to.moved[1], tangents[1]);
  const S beside = begin.sliding_factor * law_number<S>(law.wear.sliding, law.rates.sliding);
  const S squared = dot(way, way) + beside * beside;
  to.slid = square_root(squared);
  const Truth<S> moves = to.slid > 0.0;
  to.m = (1.0 / select(moves, to.slid, S(1.0))) * way;
  to.by_gap = S(0.0);
  for (int a = 0; a < D - 1; ++a) to.by_gap = to.by_gap - slipping.rate * (whole[a] * dot(to.m, tangents[a]));
}

inline constexpr int most_wear_steps = 200;

// p with p + W'(known + share p) = 0, between 0 and -W'(known): this is a concave, increasing function of p,
// so that Newton's method from below and the chord rule from above close in on the root. The lanes that have
// no contact have 0. found: false where the steps were too few.
template <class S>
ENTS_INLINE S worn_pressure(const ContactLaw& law, const S& known, const S& share, const S& multiplier,
                            Truth<S>& found) {
  const NormalForce<S> start = normal_force(law, known, multiplier);
  const S most = -start.force;
  found = most <= most;
  if (is_linear(law)) return most / (1.0 + share * start.stiffness);
  S low = S(0.0), high = most, miss_low = -most;
  const NormalForce<S> end = normal_force(law, known + share * high, multiplier);
  S miss_high = high + end.force;
  Truth<S> active = both(high > 0.0, miss_high > 0.0);
  low = select(active, low, high);
  for (int step = 0; step < most_wear_steps && any(active); ++step) {
    const NormalForce<S> at_low = normal_force(law, known + share * low, multiplier);
    miss_low = low + at_low.force;
    const S newton = low - miss_low / (1.0 + share * at_low.stiffness);
    const S slope = select(active, miss_high - miss_low, S(1.0));
    const S chord = high - miss_high * ((high - low) / slope);
    const S next_low = select(newton > low, newton, low), next_high = select(chord < high, chord, high);
    const S end_miss = next_high + normal_force(law, known + share * next_high, multiplier).force;
    const Truth<S> met =
        either(end_miss <= 0.0, next_high - next_low <= 4e-16 * next_high); // but for rounding
    const Truth<S> moves = either(next_low > low, next_high < high);
    low = select(active, select(met, next_high, next_low), low);
    high = select(active, next_high, high);
    miss_high = select(active, end_miss, miss_high);
    active = both(without(active, met), moves);
  }
  found = without(found, active);
  return select(start.contact, low, S(0.0));
}

// The force of the law with wear; `to` has ds, and gets the rest. found: see worn_pressure()
template <class S, int D>
NormalForce<S> worn_force(const ContactLaw& law, const S& gap, const S& multiplier,
                          const WornState<S, D - 1>& begin, WearOfIncrement<S, D>& to, Truth<S>& found) {
  const Wear& wear = law.wear;
  const S coefficient = begin.factor * law_number<S>(wear.coefficient, law.rates.wear);
  const S rate = coefficient * to.slid, share = wear.implicit * rate;
  const S explicit_part = (1.0 - wear.implicit) * begin.pressure;
  const S known = (gap + begin.depth) + rate * explicit_part;
  const S p = worn_pressure(law, known, share, multiplier, found);
  NormalForce<S> f = normal_force(law, known + share * p, multiplier);
  const S mean = explicit_part + wear.implicit * p;
  f.force = select(f.contact, -p, f.force);
  f.stiffness = f.stiffness / (1.0 + share * f.stiffness);
  to.by_slid = f.stiffness * (coefficient * mean);
  f.stiffness = f.stiffness + to.by_slid * to.by_gap;
  to.lost = rate * mean;
  return f;
}

} // namespace ents::ENTS_ISA
