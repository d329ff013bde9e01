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
  symmetric_ = !heat_ && (!contact_ || contact_->symmetric());
  solver_ = LinearSolver::create(symmetric_);
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
  if (scene_->heat) heat_ = std::make_unique<Heat>(mesh_, setups, scene_->temperature);
}

void Equations::hold_and_load() {
  const auto d = static_cast<std::size_t>(mesh_.dimension);
  const auto nodes = static_cast<std::size_t>(mesh_.node_count());
  equation_.assign(nodes * (d + (scene_->heat ? 1 : 0)), 0);
  const auto prescribe = [&](std::size_t dof, double value, const Path& path) {
    equation_[dof] = -1;
    prescribed_.push_back({dof, value, &path});
  };
  for (const Support& support : scene_->supports)
    for (const int node : named(mesh_.node_sets, support.nodes, support.where + "/nodes", "nodes")) {
      const auto n = static_cast<std::size_t>(node);
      if (support.temperature)
        prescribe(nodes * d + n, *support.temperature - scene_->temperature, support.path);
      for (std::size_t i = 0; i < d; ++i)
        if (support.displacement[i]) prescribe(n * d + i, *support.displacement[i], support.path);
    }
  for (int& equation : equation_)
    if (equation >= 0) equation = size_++;
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
  analyzed_ = false;
  return found;
}

/// Entries of the same place add up. A symmetric tangent has them below its diagonal, wherever the element has them.
void Equations::add_element(const ElementTangent& element) {
  const std::size_t n = element.dofs.size();
  for (std::size_t b = 0; b < n; ++b)
    for (std::size_t a = symmetric_ ? b : 0; a < n; ++a) {
      int row = equation_[element.dofs[a]], column = equation_[element.dofs[b]];
      if (row < 0 || column < 0) continue;
      if (symmetric_ && row < column) std::swap(row, column);
      entries_.emplace_back(row, column, element.values[b * n + a]);
    }
}

void Equations::add_contact(const SparseMatrix& tangent) { // rows of the pattern are its columns
  for (int i = 0; i < tangent.outerSize(); ++i)
    for (SparseMatrix::InnerIterator entry(tangent, i); entry; ++entry) {
      const int row = equation_[static_cast<std::size_t>(i)];
      const int column = equation_[static_cast<std::size_t>(entry.index())];
      if (row >= 0 && column >= 0 && !(symmetric_ && row < column))
        entries_.emplace_back(row, column, entry.value());
    }
}

Equations::State Equations::evaluate(const Configuration& at, const std::vector<double>& jump) {
  State state;
  state.residual.assign(at.displacement.size(), 0.0);
  entries_.clear();
  const AddTangent add = [this](const ElementTangent& element) { add_element(element); };
  if (!bulk_->assemble(at.displacement, jump, state.residual, add)) {
    state.outcome = {false, "an element is turned inside out", 0.5};
    return state;
  }
  // Where all is equally warm nothing flows but rounding: the scale is at least this part of what cancels.
  constexpr double least = 1e-4;
  const double warmth = heat_ ? heat_->assemble(at.displacement, jump, state.residual, add) : 0;
  double squared_contact = 0, squared_loads = 0, squared_reactions = 0, squared_power = 0;
  if (contact_) {
    state.outcome = contact_->assemble(at, state.residual, squared_contact, squared_power);
    if (!state.outcome.ok) return state;
    const SparseMatrix& tangent = contact_->tangent();
    add_contact(tangent);
    if (!jump.empty()) {
      const Eigen::Map<const Eigen::VectorXd> step(jump.data(), static_cast<Eigen::Index>(jump.size()));
      Eigen::Map<Eigen::VectorXd>(state.residual.data(), step.size()) +=
          tangent.transpose() * step; // rows are its columns
    }
    if (contact_->rigid()) state.coupling = contact_->coupling();
  }
  tangent_.resize(size_, size_);
  tangent_.setFromTriplets(entries_.begin(), entries_.end());
  for (const Load& load : loads_) {
    const double factor = load.path->at(at.load_factor);
    for (std::size_t dof = 0; dof < load.force.size(); ++dof) {
      const double force = factor * load.force[dof];
      state.residual[dof] -= force;
      squared_loads += force * force;
    }
  }
  for (std::size_t dof = 0; dof < state.residual.size(); ++dof)
    if (equation_[dof] < 0)
      (dof < mesh_.coordinates.size() ? squared_reactions : squared_power) +=
          state.residual[dof] * state.residual[dof];
  state.size = std::sqrt(std::max({squared_contact, squared_loads, squared_reactions}));
  state.power = std::max(std::sqrt(squared_power), least * warmth);
  return state;
}

double Equations::relative_residual(const State& state, const Configuration& at) const {
  double squared = 0, squared_power = 0;
  for (std::size_t dof = 0; dof < state.residual.size(); ++dof)
    if (equation_[dof] >= 0)
      (dof < mesh_.coordinates.size() ? squared : squared_power) += state.residual[dof] * state.residual[dof];
  double relative = squared > 0 ? std::sqrt(squared) / state.size : 0;
  if (squared_power > 0) relative = std::max(relative, std::sqrt(squared_power) / state.power);
  if (scene_->by_force()) relative = std::max(relative, std::abs(state.coupling.force - at.force) / at.force);
  return relative;
}

bool Equations::solve(const State& state, double motion_step, Configuration& at) {
  if (!analyzed_) solver_->analyze(tangent_);
  analyzed_ = true;
  if (!solver_->factorize(tangent_)) return false;
  const bool by_force = scene_->by_force();
  Eigen::MatrixXd sides = Eigen::MatrixXd::Zero(size_, by_force ? 2 : 1);
  Eigen::VectorXd column = Eigen::VectorXd::Zero(size_), row = column;
  for (std::size_t dof = 0; dof < state.residual.size(); ++dof) {
    const int equation = equation_[dof];
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
    if (const int equation = equation_[dof]; equation >= 0) at.displacement[dof] += step[equation];
  return true;
}

} // namespace host
