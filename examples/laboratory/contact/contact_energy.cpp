// SPDX-License-Identifier: BSD-3-Clause
#include "contact_energy.hpp"

#include <cmath>

namespace host {

ElementEnergies::ElementEnergies(std::size_t elements, ents_output& out) : of_(3 * elements) {
  if (elements == 0) return;
  out.wanted |= ENTS_ENERGY | ENTS_FRICTION_ENERGY | ENTS_DISSIPATION;
  out.energy = of_.data(), out.energy_stride = 3;
  out.friction_energy = of_.data() + 1, out.friction_energy_stride = 3;
  out.dissipation = of_.data() + 2, out.dissipation_stride = 3;
}

ContactEnergy ElementEnergies::sum() const {
  ContactEnergy energy;
  for (std::size_t i = 0; i < of_.size(); ++i) {
    (i % 3 == 2 ? energy.dissipated : energy.stored) += of_[i];
    energy.size += std::abs(of_[i]);
  }
  return energy;
}

} // namespace host
