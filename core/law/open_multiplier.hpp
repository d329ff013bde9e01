// SPDX-License-Identifier: BSD-3-Clause
// Multipliers where there is no contact: those that are dofs have the equation lambda = 0, as
// R = -A / eps lambda.
#pragma once

#include "core/law/contact_law.hpp"

namespace ents::ENTS_ISA {

// W where there is no contact, of an area and of the normal multiplier; friction has none.
template <class S, class Stiffness>
ENTS_INLINE S open_multiplier_energy(const Stiffness& stiffness, const S& lambda) {
  return -(0.5 * lambda * lambda * (1.0 / stiffness));
}
// dof: 0 the normal one, then those of friction
ENTS_INLINE double open_multiplier_residual(const ContactLaw& law, int dof, double area, double lambda) {
  return dof == 0 ? -area / law.number[0] * lambda : (0.0 - area * lambda) / law.friction_stiffness;
}
ENTS_INLINE double open_multiplier_tangent(const ContactLaw& law, int dof, double area) {
  return dof == 0 ? -area / law.number[0] : 1.0 / law.friction_stiffness * -area;
}

} // namespace ents::ENTS_ISA
