// SPDX-License-Identifier: BSD-3-Clause
#include "contact_tangent.hpp"

#include <algorithm>
#include <cmath>

namespace host {

void ContactTangent::reset() { unknowns_ = {sides_->master, sides_->points, sides_->mesh_dofs()}; }

void ContactTangent::build(const std::vector<std::int64_t>& segments) {
  segments_ = segments;
  StencilGroup elements, open; // an element without a segment: the multipliers alone
  const std::size_t q = sides_->points.nodes_per_point;
  // What each segment's points are made of: their nodes, or combinations of different numbers of nodes.
  const ControlNet* net = sides_->master.net.get();
  std::vector<std::vector<std::int64_t>> nodes_of(sides_->master.rigid ? 0 : sides_->master.segments());
  std::size_t most = 0;
  for (std::size_t s = 0; s < nodes_of.size(); ++s) {
    const std::int64_t* points = sides_->master.connectivity.data() + s * sides_->m;
    nodes_of[s] = net != nullptr ? net->nodes_of(points, sides_->m) : std::vector(points, points + sides_->m);
    most = std::max(most, nodes_of[s].size());
  }
  elements.dofs = static_cast<int>((q + most) * sides_->d + sides_->multipliers + unknowns_.of_body.size());
  open.dofs = static_cast<int>(sides_->multipliers);
  for (std::size_t k = 0; k < sides_->points.size(); ++k) {
    StencilGroup& group = sides_->master.rigid || segments[k] >= 0 ? elements : open;
    const auto add_node = [&](std::int64_t node) {
      for (std::size_t i = 0; i < sides_->d; ++i)
        group.equations.push_back(
            node < 0 ? -1
                     : static_cast<int>(unknowns_.of_master[static_cast<std::size_t>(node) * sides_->d + i]));
    };
    for (std::size_t a = 0; a < q && &group == &elements; ++a) add_node(sides_->points.nodes[k * q + a]);
    if (!sides_->master.rigid && &group == &elements) {
      const std::vector<std::int64_t>& of = nodes_of[static_cast<std::size_t>(segments[k])];
      for (std::size_t a = 0; a < most; ++a) add_node(a < of.size() ? of[a] : -1);
    }
    for (std::size_t j = 0; j < sides_->multipliers; ++j)
      group.equations.push_back(static_cast<int>(unknowns_.of_multipliers[k * sides_->multipliers + j]));
    for (const std::int64_t equation : unknowns_.of_body)
      group.equations.push_back(static_cast<int>(equation));
  }
  const StencilGroup* const groups[] = {&elements, &open};
  matrix_ = pattern_of(static_cast<int>(unknowns_.dofs.size()), false,
                       std::span(groups, sides_->multipliers > 0 ? 2 : 1));
  if (sides_->points.are_nodes() && net == nullptr)
    places_.assign(sides_->points.size() * (sides_->d * (sides_->m + 1) * (sides_->m + 1) + 1), 0);
}

void ContactTangent::receive(ents_system& system) {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  system.row_begin = matrix_.outerIndexPtr(), system.columns = matrix_.innerIndexPtr();
  system.values = matrix_.valuePtr();
}

void ContactTangent::lend_places(ents_system& system) {
  if (sides_->points.are_nodes() && !sides_->master.net)
    system.places = places_.data(), system.places_size = stride(places_.size() / sides_->points.size());
}

void ContactTangent::turn(const Configuration& at) {
  turn_images();
  sides_->frame.columns_of_turns(at, unknowns_.of_body, matrix_);
}

void ContactTangent::turn_images() {
  for (std::size_t i = 0; sides_->master.net && i < unknowns_.dofs.size(); ++i)
    for (int at = matrix_.outerIndexPtr()[i]; at < matrix_.outerIndexPtr()[i + 1]; ++at)
      matrix_.valuePtr()[at] *=
          unknowns_.signs[i] * unknowns_.signs[static_cast<std::size_t>(matrix_.innerIndexPtr()[at])];
}

void ContactTangent::add_times(const std::vector<double>& direction, std::vector<double>& residual) const {
  for (std::size_t i = 0; i < unknowns_.dofs.size(); ++i)
    for (int at = matrix_.outerIndexPtr()[i]; at < matrix_.outerIndexPtr()[i + 1]; ++at)
      if (const std::size_t j = unknowns_.dofs[static_cast<std::size_t>(matrix_.innerIndexPtr()[at])];
          j < direction.size())
        residual[unknowns_.dofs[i]] += matrix_.valuePtr()[at] * direction[j];
}

SparseMatrix ContactTangent::make_definite(bool every_row, RigidCoupling* coupling) {
  SparseMatrix added = matrix_;
  for (Eigen::Index i = 0; i < matrix_.nonZeros(); ++i) added.valuePtr()[i] = 0;
  for (int row = 0; row < matrix_.outerSize(); ++row) {
    int diagonal = -1;
    double others = 0;
    for (int at = matrix_.outerIndexPtr()[row]; at < matrix_.outerIndexPtr()[row + 1]; ++at)
      if (matrix_.innerIndexPtr()[at] == row)
        diagonal = at;
      else
        others += std::abs(matrix_.valuePtr()[at]);
    if (diagonal < 0) continue;
    double& value = matrix_.valuePtr()[diagonal];
    if (value >= others || (value >= 0 && !every_row)) continue;
    added.valuePtr()[diagonal] = others - value;
    value = others;
  }
  if (coupling != nullptr && !coupling->column.empty()) couple(*coupling);
  return added;
}

// Only the relative position of slave and master counts: moving the master is moving all slave points back,
// and the weights of a point's nodes add to one.
void ContactTangent::couple(RigidCoupling& coupling) const {
  coupling.diagonal = 0;
  std::fill(coupling.column.begin(), coupling.column.end(), 0.0);
  std::fill(coupling.row.begin(), coupling.row.end(), 0.0);
  std::vector<double> direction(unknowns_.dofs.size(), 0.0);
  for (std::size_t i = 0; i < unknowns_.slave_dofs; ++i)
    direction[i] = sides_->master.direction[i % sides_->d];
  for (std::size_t i = 0; i < direction.size(); ++i)
    for (int at = matrix_.outerIndexPtr()[i]; at < matrix_.outerIndexPtr()[i + 1]; ++at) {
      const auto j = static_cast<std::size_t>(matrix_.innerIndexPtr()[at]);
      const double value = matrix_.valuePtr()[at];
      coupling.column[unknowns_.dofs[i]] -= value * direction[j];
      coupling.row[unknowns_.dofs[j]] -= direction[i] * value;
      coupling.diagonal += direction[i] * value * direction[j];
    }
}

} // namespace host
