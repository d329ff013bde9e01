// SPDX-License-Identifier: BSD-3-Clause
// The normal law of a model at a gap, of any scalar: what kernels know of laws. Compiled apart from them, once
// per scalar and instruction set (laws.cpp), so that no kernel is compiled again for a law.
#pragma once

#include "core/law/contact_law.hpp"
#include "core/numbers/lanes.hpp"

namespace ents::ENTS_ISA {

// Per area: dW/dg (<= 0, but of a law that pulls), d2W/dg2, W, and whether the element is in contact.
template <class S> struct NormalForce {
  S force, stiffness, energy;
  Truth<S> contact;
};

// The largest tension of a law that adheres, and the gap where it is
template <class S> struct Strength { S most, gap; };

// multiplier: lambda of the augmented and the multiplier laws, a pressure; scale: of the slave node; bond: of
// the state
template <class S>
NormalForce<S> normal_force(const ContactLaw& law, const S& gap, const S& multiplier, const S& scale = S(1.0),
                            const S& bond = S(0.0));
// W'/g, where ContactLaw::has_slope
template <class S> S force_per_gap(const ContactLaw& law, const S& gap);
// The gap [L] from which on there is contact
template <class S> S touching_gap(const ContactLaw& law, const S& scale, const S& bond = S(0.0));
template <class S> Strength<S> strength(const ContactLaw& law, const S& scale);
// The number of the state at the end of an increment, from that of its begin and the gap at its end
template <class S> S next_bond(const ContactLaw& law, const S& gap, const S& bond);
// What damage has taken between them, of a unit of area
double bond_dissipation(const ContactLaw& law, double begin, double end);
// Is W'' constant in contact?
bool is_linear(const ContactLaw& law);

// The pressure that friction acts on, W' that of the law at this gap: what of it is compression or, with
// ContactLaw::rubs_adhering, p + strength() up to the gap of the largest tension. 0 beyond.
template <class S>
ENTS_INLINE S rubbing_pressure(const ContactLaw& law, const S& force, const S& gap, const S& scale) {
  if (!law.rubs_adhering) return larger(-force, S(0.0));
  const Strength<S> of = strength(law, scale);
  return select(gap < of.gap, larger(of.most - force, S(0.0)), S(0.0));
}

} // namespace ents::ENTS_ISA
