// SPDX-License-Identifier: BSD-3-Clause
// Contact: energies of laws that pull, and a tangent that descends them.
#include <cmath>

#include "contact.hpp"

namespace host {

void Contact::ask_for_energy(ents_output& out, std::vector<double>& energies) const {
  energies.assign(3 * slaves().size(), 0.0);
  out.wanted |= ENTS_ENERGY | ENTS_FRICTION_ENERGY | ENTS_DISSIPATION;
  out.energy = energies.data(), out.energy_stride = 3;
  out.friction_energy = energies.data() + 1, out.friction_energy_stride = 3;
  out.dissipation = energies.data() + 2, out.dissipation_stride = 3;
}

void Contact::add_up(const std::vector<double>& energies) {
  energy_ = {};
  for (std::size_t i = 0; i < energies.size(); ++i) {
    (i % 3 == 2 ? energy_.dissipated : energy_.stored) += energies[i];
    energy_.size += std::abs(energies[i]);
  }
}

SparseMatrix Contact::make_definite(bool every_row, RigidCoupling* coupling) {
  SparseMatrix added = tangent_;
  for (Eigen::Index i = 0; i < tangent_.nonZeros(); ++i) added.valuePtr()[i] = 0;
  for (int row = 0; row < tangent_.outerSize(); ++row) {
    int diagonal = -1;
    double others = 0;
    for (int at = tangent_.outerIndexPtr()[row]; at < tangent_.outerIndexPtr()[row + 1]; ++at)
      if (tangent_.innerIndexPtr()[at] == row)
        diagonal = at;
      else
        others += std::abs(tangent_.valuePtr()[at]);
    if (diagonal < 0) continue;
    double& value = tangent_.valuePtr()[diagonal];
    if (value >= others || (value >= 0 && !every_row)) continue;
    added.valuePtr()[diagonal] = others - value;
    value = others;
  }
  if (coupling != nullptr && !coupling->column.empty()) couple(*coupling);
  return added;
}

} // namespace host
