// SPDX-License-Identifier: BSD-3-Clause
// Simulation: the equations at a configuration, what is prescribed and loaded, residual and tangent of
// bodies, springs and contact; and one step of their linear solution.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "advice.hpp"
#include "layer_body.hpp"
#include "simulation.hpp"
#include "stopwatch.hpp"

namespace host {

double Simulation::turned(const SupportSpec& support, std::size_t dof, const Configuration& at) const {
  const auto d = static_cast<std::size_t>(mesh_.dimension);
  const auto node = mesh_.node(static_cast<int>(dof / d));
  Eigen::Vector3d arm = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < d; ++i) arm[static_cast<Eigen::Index>(i)] = node[i] - support.about[i];
  for (std::size_t i = 0; i < support.turn.size(); ++i)
    turn[static_cast<Eigen::Index>(d == 2 ? 2 : i)] = support.turn[i];
  const double angle = turn.norm();
  if (angle == 0) return 0;
  const Eigen::AngleAxisd rotation(angle * support.path.at(at.load_factor), turn / angle);
  return (rotation * arm - arm)[static_cast<Eigen::Index>(dof % d)];
}

void Simulation::prescribe(Configuration& at) const {
  const double all_copies = at.force * scene_->symmetry_copies;
  // Nodes tied to a prescribed one have no equation either, and no value of their own.
  const auto follow = [&](std::size_t dof) {
    return half_space_.empty() ? 0 : half_space_[dof] * all_copies;
  };
  for (std::size_t dof = 0; dof < half_space_.size(); ++dof)
    if (dofs_->equation(dof) < 0) at.displacement[dof] = follow(dof);
  for (const Prescribed& support : prescribed_)
    at.displacement[support.dof] = support.value * support.path->at(at.load_factor) + follow(support.dof) +
                                   (support.turns != nullptr ? turned(*support.turns, support.dof, at) : 0);
}

std::vector<double> Simulation::loads(double load_factor) const {
  std::vector<double> sum(static_cast<std::size_t>(dofs_->dofs()), 0.0);
  for (const Load& load : loads_) {
    const double factor = load.path->at(load_factor);
    for (std::size_t dof = 0; dof < sum.size(); ++dof) sum[dof] += factor * load.force[dof];
  }
  return sum;
}

Eigen::VectorXd Simulation::residual_of_equations(const Evaluation& at) const {
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(equations());
  const auto dofs = static_cast<std::size_t>(dofs_->dofs());
  for (std::size_t i = 0; i < at.residual.size(); ++i) // gaps times area become forces
    if (const int row = equation(i); row >= 0)
      residual[row] += at.residual[i] * (i < dofs ? 1 : contact_->multiplier_scale(i - dofs));
  return residual;
}

double Simulation::relative_residual(const Evaluation& at) const {
  const Eigen::VectorXd residual = residual_of_equations(at);
  const double norm = residual.norm();
  // Bodies that nothing presses or loads: the forces present are rounding, as the residual is.
  if (const double rounding = rounding_of_forces(); std::max(norm, at.force_scale) <= rounding) return 0;
  // Where the surfaces overlap and no multiplier presses yet, these are the only forces. In equilibrium they
  // are zero.
  const double gaps = residual.tail(residual.size() - dofs_->size()).norm();
  const double scale = std::max(at.force_scale, gaps);
  return norm == 0 ? 0 : scale > 0 ? norm / scale : 1; // a body springs back from where it was let go
}

Simulation::Evaluation Simulation::evaluate(const Configuration& at, const std::vector<double>& direction,
                                            bool want_tangent) {
  Evaluation result;
  result.residual.assign(at.displacement.size() + at.multiplier.size(), 0.0);
  double squared_contact = 0;
  {
    const Stopwatch watch;
    // The tangent of a linear bulk is assembled once.
    const bool have = bulk_->linear() && !bulk_values_.empty();
    SparseSystem* system = want_tangent && !have ? system_.get() : nullptr;
    if (system != nullptr) system->set_zero();
    AddTangent add; // none
    if (system != nullptr)
      add = [system](const ElementTangent& of) { system->add(of.group, of.element, of.values); };
    double* energy = contact_ && contact_->pulls() ? &result.stored : nullptr;
    const bool ok = bulk_->assemble(at.displacement, direction, result.residual, add, energy);
    if (want_tangent && have) std::copy(bulk_values_.begin(), bulk_values_.end(), system_->values().begin());
    if (want_tangent && !have && bulk_->linear())
      bulk_values_.assign(system_->values().begin(), system_->values().end());
    timings_.bulk += watch.seconds();
    if (!ok) {
      bulk_values_.clear();
      result.reason = "an element was turned inside out";
      return result;
    }
  }
  if (layer_) {
    const Stopwatch watch;
    Eigen::VectorXd displacement(layer_->nodes());
    for (Eigen::Index node = 0; node < displacement.size(); ++node)
      displacement[node] = at.displacement[static_cast<std::size_t>(3 * node + 2)];
    const Eigen::VectorXd force = layer_->force(displacement);
    for (Eigen::Index node = 0; node < displacement.size(); ++node)
      result.residual[static_cast<std::size_t>(3 * node + 2)] += force[node];
    result.stored += 0.5 * force.dot(displacement);
    timings_.bulk += watch.seconds();
  }
  if (!springs_.empty()) {
    for (std::size_t dof = 0; dof < springs_.size(); ++dof) {
      result.residual[dof] +=
          springs_[dof] * (at.displacement[dof] + (direction.empty() ? 0 : direction[dof]));
      if (want_tangent) system_->add(bulk_stencils_.size(), dof, &springs_[dof]);
    }
  }
  if (contact_) {
    const Stopwatch watch;
    const CpuStopwatch cpu;
    auto report = ents_struct<ents_report>();
    RigidCoupling* coupling = contact_->master().translates() ? &result.coupling : nullptr;
    // A body that is moved takes the slave along, or leaves it behind.
    const bool follows = !direction.empty() && contact_->master().body_node >= 0;
    const std::int32_t status =
        contact_->assemble(at, result.residual, want_tangent || follows, coupling, squared_contact, report);
    if (follows && status == ENTS_OK) contact_->tangent().add_times(direction, result.residual);
    if (want_tangent && status == ENTS_OK) system_->add(contact_->tangent().matrix());
    timings_.contact += watch.seconds();
    timings_.contact_cpu += cpu.seconds();
    if (status != ENTS_OK) {
      result.reason = describe(contact_->master().model->library(), status, report);
      if (status == ENTS_DEEP_PENETRATION) result.advice = advice_if_deep(scene_->contact->model);
      result.step_factor = report.step_factor > 0 && report.step_factor < 1 ? report.step_factor : 0.5;
      return result;
    }
  }
  double squared_loads = 0, squared_reactions = 0;
  const std::vector<double> load = loads(at.load_factor);
  for (std::size_t dof = 0; dof < load.size(); ++dof) {
    result.residual[dof] -= load[dof];
    squared_loads += load[dof] * load[dof];
    if (dofs_->equation(dof) < 0) squared_reactions += result.residual[dof] * result.residual[dof];
  }
  result.force_scale = std::sqrt(std::max({squared_contact, squared_loads, squared_reactions}));
  if (contact_ && contact_->pulls()) add_energies(at, result);
  result.ok = true;
  return result;
}

bool Simulation::solve(const Evaluation& at, bool factorize, double motion_step, double force_error,
                       Increment& step) {
  const Stopwatch watch;
  bool ok = !factorize || solver_->factorize(system_->matrix());
  if (ok) {
    // Tied dofs add their residuals in one equation.
    Eigen::MatrixXd sides = Eigen::MatrixXd::Zero(equations(), force_controlled() ? 2 : 1);
    Eigen::VectorXd column = Eigen::VectorXd::Zero(equations()), row = column;
    for (std::size_t i = 0; i < at.residual.size(); ++i) {
      const int at_row = equation(i);
      if (at_row < 0) continue;
      sides(at_row, 0) -= at.residual[i];
      if (at.coupling.column.empty()) continue;
      column[at_row] += at.coupling.column[i];
      row[at_row] += at.coupling.row[i];
    }
    sides.col(0) -= motion_step * column;
    if (force_controlled()) sides.col(1) = -column;
    const Eigen::MatrixXd steps = solver_->solve(sides);
    step.unknowns = steps.col(0);
    step.motion = motion_step;
    if (force_controlled()) {
      // One more unknown, the motion, and one more equation, the force: eliminated by hand.
      const auto follow = steps.col(1);
      const double stiffness = at.coupling.diagonal + row.dot(follow);
      step.motion = (-force_error - row.dot(step.unknowns)) / stiffness;
      step.unknowns += step.motion * follow;
    }
    // A pivot may be small without being zero, and the step not finite.
    ok = std::isfinite(step.motion) && step.unknowns.allFinite();
  }
  timings_.solver += watch.seconds();
  return ok;
}

void Simulation::move(Configuration& at, const Increment& step, double share) const {
  at.motion += share * step.motion;
  const std::size_t dofs = at.displacement.size();
  for (std::size_t i = 0; i < dofs + at.multiplier.size(); ++i)
    if (const int row = equation(i); row >= 0)
      (i < dofs ? at.displacement[i] : at.multiplier[i - dofs]) += share * step.unknowns[row];
}

std::vector<double> Simulation::reactions() {
  Evaluation state = evaluate(now_, {}, false);
  if (!state.ok) throw JobError(state.reason);
  state.residual.resize(now_.displacement.size()); // multipliers have no reactions
  for (std::size_t dof = 0; dof < state.residual.size(); ++dof)
    if (dofs_->equation(dof) >= 0) state.residual[dof] = 0;
  return state.residual;
}

} // namespace host
