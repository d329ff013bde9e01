// SPDX-License-Identifier: BSD-3-Clause
// Laws with a multiplier lambda, a pressure:
//   augmented             W = (<p>^2 - lambda^2) / (2 eps), p = lambda - eps g; lambda in the state (Uzawa)
//   augmented_multiplier  the same with lambda as a dof (Alart and Curnier 1991, semi-smooth Newton)
//   multiplier            lambda as a dof, no augmentation; eps only decides the active set
// There is contact where lambda - eps g >= 0: bodies that touch are held before there is a multiplier, as with a
// penalty.
#pragma once

#include "core/law/normal_law.hpp"
#include "core/law/open_multiplier.hpp"

namespace ents::ENTS_ISA {

struct Augmented : NormalLaw {
  static constexpr char type[] = "augmented", formula[] = "Augmented Lagrangian, multipliers in the state "
                                                          "(Uzawa; ents_state_augment).";
  static constexpr LawNumber table[] = {{"stiffness", "[F/L^3].", LawNumber::positive, true}};
  static constexpr Multiplier multiplier = Multiplier::in_state;
  static bool is_linear(const ContactLaw&) { return true; }

  template <class S>
  static ENTS_INLINE NormalForce<S> force(const ContactLaw& law, const NormalPlace<S>& at) {
    const S eps = law_number<S>(law.number[0], law.rates.normal), p = at.multiplier - eps * at.gap;
    return {-p, eps, 0.5 * p * p * (1.0 / eps) + open_multiplier_energy(eps, at.multiplier), p >= 0.0};
  }
};

struct AugmentedMultiplier : Augmented {
  static constexpr char type[] = "augmented_multiplier",
                        formula[] = "Augmented Lagrangian, multipliers as dofs (Alart and Curnier 1991).";
  static constexpr Multiplier multiplier = Multiplier::is_dof;
};

struct PureMultiplier : NormalLaw {
  static constexpr char type[] = "multiplier", formula[] = "Lagrange multipliers as dofs; stiffness only "
                                                           "decides which elements are in contact.";
  static constexpr LawNumber table[] = {{"stiffness", "[F/L^3].", LawNumber::positive, true}};
  static constexpr Multiplier multiplier = Multiplier::is_dof;

  template <class S>
  static ENTS_INLINE NormalForce<S> force(const ContactLaw& law, const NormalPlace<S>& at) {
    const S eps = law_number<S>(law.number[0], law.rates.normal);
    return {-at.multiplier, S(0.0), -(at.multiplier * at.gap), at.multiplier - eps * at.gap >= 0.0};
  }
};

} // namespace ents::ENTS_ISA
