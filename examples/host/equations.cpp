// SPDX-License-Identifier: BSD-3-Clause
#include "equations.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace host {

Equations::Equations(const Scene& scene) : scene_(&scene) {
  build_mesh();
  hold_and_load();
  if (scene.contact) contact_ = std::make_unique<Contact>(scene, mesh_);
  const bool symmetric = !heat_ && (!contact_ || contact_->symmetric());
  system_ = std::make_unique<SparseSystem>(dofs_->size(), symmetric);
  solver_ = LinearSolver::create(symmetric);
  stencils_ = bulk_->stencils(*dofs_);
  if (heat_) heat_stencils_ = heat_->stencils(*dofs_);
  if (contact_) return; // `search` builds the pattern
  system_->build(groups());
  solver_->analyze(system_->matrix());
}

std::vector<const StencilGroup*> Equations::groups() const {
  std::vector<const StencilGroup*> all;
  for (const auto* stencils : {&stencils_, &heat_stencils_})
    for (const StencilGroup& group : *stencils) all.push_back(&group);
  return all;
}

void Equations::build_mesh() {
  mesh_.dimension = scene_->dimension;
  std::vector<ElementSetup> setups;
  for (const Part& part : scene_->parts) {
    const int index = static_cast<int>(setups.size());
    add_part(mesh_, part, index);
    setups.push_back(part.setup);
  }
  bulk_ = std::make_unique<Bulk>(mesh_, setups);
  if (scene_->heat) heat_ = std::make_unique<Heat>(mesh_, setups);
}

void Equations::hold_and_load() {
  const auto d = static_cast<std::size_t>(mesh_.dimension);
  dofs_ = std::make_unique<DofMap>(mesh_.node_count(), mesh_.dimension, scene_->heat);
  for (const Support& support : scene_->supports)
    for (const int node : named(mesh_.node_sets, support.nodes, support.where + "/nodes", "nodes")) {
      if (support.temperature) {
        dofs_->prescribe_scalar(node);
        prescribed_.push_back(
            {dofs_->scalar(node), *support.temperature - scene_->temperature, &support.path});
      }
      for (std::size_t i = 0; i < d; ++i)
        if (support.displacement[i]) {
          dofs_->prescribe(node, static_cast<int>(i));
          prescribed_.push_back(
              {static_cast<std::size_t>(node) * d + i, *support.displacement[i], &support.path});
        }
    }
  dofs_->number();
  if (prescribed_.empty())
    throw InputError(scene_->file.string() + ": /supports: nothing holds the bodies; give supports");
  const ElementSetup& setup = scene_->parts.front().setup;
  for (const Traction& traction : scene_->tractions) {
    const std::string where = traction.where + "/faces";
    const std::vector<double> areas =
        node_areas(mesh_, named(mesh_.face_sets, traction.faces, where, "faces"), setup, where);
    Load& load =
        loads_.emplace_back(Load{std::vector<double>(mesh_.coordinates.size(), 0.0), &traction.path});
    for (std::size_t dof = 0; dof < load.force.size(); ++dof)
      load.force[dof] = areas[dof / d] * traction.value[dof % d];
  }
}

double Equations::slave_area() const {
  return contact_ ? std::accumulate(contact_->areas().begin(), contact_->areas().end(), 0.) : 0;
}

void Equations::prescribe(Configuration& at) const {
  for (const Prescribed& support : prescribed_)
    at.displacement[support.dof] = support.value * support.path->at(at.load_factor);
}

Outcome Equations::search(const Configuration& at) {
  if (!contact_) return {};
  bool changed = false;
  const Outcome found = contact_->search(at, changed);
  if (!found.ok || !changed) return found;
  contact_->build_pattern();
  MatrixPart part{&contact_->tangent(), {}}; // its rows are dofs of the mesh
  for (std::size_t dof = 0; dof < at.displacement.size(); ++dof)
    part.equations.push_back(dofs_->equation(dof));
  system_->build(groups(), part);
  solver_->analyze(system_->matrix());
  return found;
}

Equations::State Equations::evaluate(const Configuration& at, const std::vector<double>& jump) {
  State state;
  state.residual.assign(at.displacement.size(), 0.0);
  system_->set_zero();
  if (!bulk_->assemble(at.displacement, jump, state.residual, system_.get())) {
    state.outcome = {false, "an element is turned inside out", 0.5};
    return state;
  }
  // Where all is equally warm nothing flows but rounding: the scale is at least this part of what cancels.
  constexpr double least = 1e-4;
  const double warmth =
      heat_ ? heat_->assemble(at.displacement, jump, state.residual, *system_, stencils_.size()) : 0;
  double squared_contact = 0, squared_loads = 0, squared_reactions = 0, squared_power = 0;
  if (contact_) {
    state.outcome = contact_->assemble(at, state.residual, squared_contact);
    if (!state.outcome.ok) return state;
    const SparseMatrix& tangent = contact_->tangent();
    system_->add(tangent);
    if (!jump.empty()) {
      const Eigen::Map<const Eigen::VectorXd> step(jump.data(), static_cast<Eigen::Index>(jump.size()));
      Eigen::Map<Eigen::VectorXd>(state.residual.data(), step.size()) +=
          tangent.transpose() * step; // rows are its columns
    }
    if (contact_->rigid()) state.coupling = contact_->coupling();
  }
  for (const Load& load : loads_) {
    const double factor = load.path->at(at.load_factor);
    for (std::size_t dof = 0; dof < load.force.size(); ++dof) {
      const double force = factor * load.force[dof];
      state.residual[dof] -= force;
      squared_loads += force * force;
    }
  }
  for (std::size_t dof = 0; dof < state.residual.size(); ++dof)
    if (dofs_->equation(dof) < 0)
      (dof < mesh_.coordinates.size() ? squared_reactions : squared_power) +=
          state.residual[dof] * state.residual[dof];
  state.size = std::sqrt(std::max({squared_contact, squared_loads, squared_reactions}));
  state.power = std::max(std::sqrt(squared_power), least * warmth);
  return state;
}

double Equations::relative_residual(const State& state, const Configuration& at) const {
  double squared = 0, squared_power = 0;
  for (std::size_t dof = 0; dof < state.residual.size(); ++dof)
    if (dofs_->equation(dof) >= 0)
      (dof < mesh_.coordinates.size() ? squared : squared_power) += state.residual[dof] * state.residual[dof];
  double relative = squared > 0 ? std::sqrt(squared) / state.size : 0;
  if (squared_power > 0) relative = std::max(relative, std::sqrt(squared_power) / state.power);
  if (scene_->by_force()) relative = std::max(relative, std::abs(state.coupling.force - at.force) / at.force);
  return relative;
}

bool Equations::solve(const State& state, double motion_step, Configuration& at) {
  if (!solver_->factorize(system_->matrix())) return false;
  const bool by_force = scene_->by_force();
  Eigen::MatrixXd sides = Eigen::MatrixXd::Zero(dofs_->size(), by_force ? 2 : 1);
  Eigen::VectorXd column = Eigen::VectorXd::Zero(dofs_->size()), row = column;
  for (std::size_t dof = 0; dof < state.residual.size(); ++dof) {
    const int equation = dofs_->equation(dof);
    if (equation < 0) continue;
    sides(equation, 0) = -state.residual[dof];
    if (!state.coupling.column.empty())
      column[equation] = state.coupling.column[dof], row[equation] = state.coupling.row[dof];
  }
  sides.col(0) -= motion_step * column;
  if (by_force) sides.col(1) = -column;
  const Eigen::MatrixXd solution = solver_->solve(sides);
  Eigen::VectorXd step = solution.col(0);
  if (by_force) {
    // One more unknown, the motion, and one more equation, the force: eliminated by hand.
    const double stiffness = state.coupling.diagonal + row.dot(solution.col(1));
    motion_step = (at.force - state.coupling.force - row.dot(step)) / stiffness;
    step += motion_step * solution.col(1);
  }
  if (!std::isfinite(motion_step) || !step.allFinite()) return false;
  at.motion += motion_step;
  for (std::size_t dof = 0; dof < at.displacement.size(); ++dof)
    if (const int equation = dofs_->equation(dof); equation >= 0) at.displacement[dof] += step[equation];
  return true;
}

} // namespace host
