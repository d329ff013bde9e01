// SPDX-License-Identifier: BSD-3-Clause
// Simulation: energies, and steps that descend them (theory.md, section 4.9). Surfaces whose law pulls jump together or
// apart where no equilibrium nearby is stable.
#include <algorithm>
#include <cmath>

#include "simulation.hpp"

namespace host {
namespace {

/// Of the work of an increment: single nodes that jump, and the trapezoidal rule, lose less.
constexpr double least_of_jumps = 0.1;

} // namespace

void Simulation::add_energies(const Configuration& at, Evaluation& result) const {
  const ContactEnergy& contact = contact_->energy();
  for (std::size_t dof = 0; dof < springs_.size(); ++dof)
    result.stored += 0.5 * springs_[dof] * at.displacement[dof] * at.displacement[dof];
  result.potential_size = result.stored + contact.size;
  result.stored += contact.stored, result.dissipated = contact.dissipated;
  const std::vector<double> load = loads(at.load_factor);
  double given = force_controlled() ? at.force * at.motion : 0;
  for (std::size_t dof = 0; dof < load.size(); ++dof) given += load[dof] * at.displacement[dof];
  result.potential = result.stored + result.dissipated - given;
  result.potential_size += std::abs(given);
}

double Simulation::slope(const Evaluation& at, double force_error, const Increment& step) const {
  return residual_of_equations(at).dot(step.unknowns) + force_error * step.motion;
}

bool Simulation::solve_downhill(Evaluation& at, double force_error, Increment& step, bool& left_out) {
  left_out = false;
  for (const bool every_row : {false, true}) {
    if (solve(at, true, 0, force_error, step) && !solver_->indefinite() && slope(at, force_error, step) < 0)
      return true;
    left_out = true;
    system_->add(contact_->tangent().make_definite(every_row, force_controlled() ? &at.coupling : nullptr));
  }
  return solve(at, true, 0, force_error, step) && slope(at, force_error, step) < 0;
}

std::optional<EnergyBalance> Simulation::balance(const Evaluation& end, const Configuration& to) const {
  if (!last_ || !scene_->history.empty()) return {};
  EnergyBalance energy;
  const auto add = [&](double first, double last, double moved) {
    energy.work += 0.5 * (first + last) * moved;
    energy.uncertainty += 0.5 * std::abs((last - first) * moved);
  };
  add(last_->coupling.force, end.coupling.force, to.motion - now_.motion);
  const std::vector<double> from_load = loads(now_.load_factor), to_load = loads(to.load_factor);
  for (std::size_t dof = 0; dof < from_load.size(); ++dof) {
    const bool held = dofs_->equation(dof) < 0;
    add(from_load[dof] + (held ? last_->residual[dof] : 0), to_load[dof] + (held ? end.residual[dof] : 0),
        to.displacement[dof] - now_.displacement[dof]);
  }
  energy.stored = end.stored - last_->stored, energy.dissipated = end.dissipated;
  const double rounding =
      1e-12 * std::max(end.potential_size, last_->potential_size) + rounding_of_forces() * contact_->size();
  const double explained = energy.uncertainty + least_of_jumps * std::abs(energy.work) + rounding;
  energy.jumped = energy.lost() > explained, energy.gained = -energy.lost() > explained;
  for (double* value : {&energy.work, &energy.stored, &energy.dissipated, &energy.uncertainty})
    *value *= scene_->symmetry_copies;
  return energy;
}

} // namespace host
