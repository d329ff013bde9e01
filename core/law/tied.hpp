// SPDX-License-Identifier: BSD-3-Clause
// Laws of surfaces that hold each other (theory.md, section 4.6). A bond forms where the gap is at most `range`, a
// number of the law, and the state of the element knows it by one number: 0 without a bond, else the largest
// gap so far (cohesive), or `range` (tied).
//   tied      p = - K g, whatever g
//   cohesive  bilinear: t = K g up to the strength s, at d_0 = s / K; from there on a straight line to 0 at
//             d_f = 2 G / s. Behind the largest gap k so far the traction falls on a straight line to 0:
//             t = s (d_f - k) / ((d_f - d_0) k) g. Damage does not heal, and does not touch the pressure.
#pragma once

#include "core/law/normal_law.hpp"

namespace ents::ENTS_ISA {

struct Tied : NormalLaw {
  static constexpr char type[] = "tied",
                        formula[] = "Pressure -stiffness g for every gap g, tension too, once the gap was at "
                                    "most range. Not with wear.";
  static constexpr LawNumber table[] = {
      {"stiffness", "[F/L^3].", LawNumber::positive, true},
      {"range", "A bond forms where the gap is at most this [L]; above the rounding of the mesh."}};
  static constexpr bool wears = false, pulls = true, bonds = true;

  template <class S> static ENTS_INLINE S touching_gap(const ContactLaw& law, const S&, const S&) {
    return S(law.number[1]);
  }
  template <class S> static ENTS_INLINE S next_bond(const ContactLaw& law, const S& gap, const S& bond) {
    return select(either(bond > 0.0, gap <= law.number[1]), S(law.number[1]), S(0.0));
  }
  template <class S>
  static ENTS_INLINE NormalForce<S> force(const ContactLaw& law, const NormalPlace<S>& at) {
    const S stiffness = law_number<S>(law.number[0], law.rates.normal);
    return {stiffness * at.gap, stiffness, 0.5 * stiffness * at.gap * at.gap,
            either(at.bond > 0.0, at.gap <= law.number[1])};
  }
};

struct Cohesive : NormalLaw {
  static constexpr char type[] = "cohesive",
                        formula[] =
                            "Bilinear traction and separation: tension stiffness g up to strength, then a "
                            "straight line that encloses energy. The largest gap is in the state, and damage "
                            "does not heal; pressure is stiffness (-g) always. Not with wear.";
  static constexpr LawNumber table[] = {
      {"stiffness", "[F/L^3], more than strength^2/(2 energy).", LawNumber::positive, true},
      {"strength", "Largest tension [F/L^2]."},
      {"energy", "Of a unit of area that opens [F/L]."},
      {"range",
       "A bond forms where the gap is at most this [L], at most strength/stiffness; above the rounding "
       "of the mesh."}};
  static constexpr bool wears = false, pulls = true, bonds = true, is_damaged = true;

  static const char* mistake(const ContactLaw& law) {
    const double* n = law.number;
    if (!(2.0 * n[0] * n[2] > n[1] * n[1]))
      return "has a stiffness with which the bond would take more than its energy up to the strength; write "
             "a "
             "stiffness above strength^2 / (2 energy)";
    if (!(n[0] * n[3] <= n[1]))
      return "has a range in which a new bond would begin beyond its strength; write a range of at most "
             "strength / stiffness";
    return nullptr;
  }
  // d_0, d_f; a stiffness that is a parameter may move the first beyond the second
  template <class S> static ENTS_INLINE S first_opening(const ContactLaw& law) {
    return law.number[1] / law_number<S>(law.number[0], law.rates.normal);
  }
  static ENTS_INLINE double last_opening(const ContactLaw& law) {
    return 2.0 * law.number[2] / law.number[1];
  }

  // Of a bond that broke, 0
  template <class S> static ENTS_INLINE S touching_gap(const ContactLaw& law, const S&, const S& bond) {
    return select(bond > 0.0, S(0.0), S(law.number[3]));
  }
  template <class S> static ENTS_INLINE S next_bond(const ContactLaw& law, const S& gap, const S& bond) {
    const S first = first_opening<S>(law), last(last_opening(law));
    const S most = larger(larger(bond, first), gap);
    return select(either(bond > 0.0, gap <= law.number[3]), select(most > last, last, most), S(0.0));
  }
  // What damage takes while the largest gap grows from one to the other
  static double dissipation(const ContactLaw& law, double from, double to) {
    const double first = first_opening<double>(law), last = last_opening(law);
    const auto taken = [&](double bond) {
      if (!(bond > first)) return 0.0;
      return bond < last ? law.number[2] * (bond - first) / (last - first) : law.number[2];
    };
    return taken(to) - taken(from);
  }

  template <class S>
  static ENTS_INLINE NormalForce<S> force(const ContactLaw& law, const NormalPlace<S>& at) {
    const S whole = law_number<S>(law.number[0], law.rates.normal), first = first_opening<S>(law);
    const S last(last_opening(law)), &g = at.gap, none(0.0);
    const Truth<S> bonded = either(at.bond > 0.0, g <= law.number[3]), presses = g <= 0.0;
    const S before = larger(at.bond, first), opening = larger(before, g);
    const Truth<S> holds = both(bonded, opening < last), tears = both(holds, g > before);
    const S down = law.number[1] / (last - first);
    const S secant = select(holds, down * (last - opening) / opening, none);
    const S stiffness = select(presses, whole, secant);
    return {stiffness * g, select(tears, -down, stiffness), 0.5 * stiffness * g * g, either(presses, holds)};
  }
};

} // namespace ents::ENTS_ISA
