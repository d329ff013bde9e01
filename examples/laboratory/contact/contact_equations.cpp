// SPDX-License-Identifier: BSD-3-Clause
// Contact: the library's elements in the host's equations.
#include <algorithm>
#include <cmath>

#include "contact.hpp"

namespace host {

void Contact::build_tangent() {
  pattern_segment_ = at_.segment;
  StencilGroup elements, open; // an element without a segment: the multipliers alone
  const std::size_t q = sides_.points.nodes_per_point;
  // What each segment's points are made of: their nodes, or combinations of different numbers of nodes.
  const ControlNet* net = sides_.master.net.get();
  std::vector<std::vector<std::int64_t>> nodes_of(sides_.master.rigid ? 0 : sides_.master.segments());
  std::size_t most = 0;
  for (std::size_t s = 0; s < nodes_of.size(); ++s) {
    const std::int64_t* points = sides_.master.connectivity.data() + s * sides_.m;
    nodes_of[s] = net != nullptr ? net->nodes_of(points, sides_.m) : std::vector(points, points + sides_.m);
    most = std::max(most, nodes_of[s].size());
  }
  elements.dofs = static_cast<int>((q + most) * sides_.d + sides_.multipliers + unknowns_.of_body.size());
  open.dofs = static_cast<int>(sides_.multipliers);
  for (std::size_t k = 0; k < sides_.points.size(); ++k) {
    StencilGroup& group = sides_.master.rigid || at_.segment[k] >= 0 ? elements : open;
    const auto add_node = [&](std::int64_t node) {
      for (std::size_t i = 0; i < sides_.d; ++i)
        group.equations.push_back(
            node < 0 ? -1
                     : static_cast<int>(unknowns_.of_master[static_cast<std::size_t>(node) * sides_.d + i]));
    };
    for (std::size_t a = 0; a < q && &group == &elements; ++a) add_node(sides_.points.nodes[k * q + a]);
    if (!sides_.master.rigid && &group == &elements) {
      const std::vector<std::int64_t>& of = nodes_of[static_cast<std::size_t>(at_.segment[k])];
      for (std::size_t a = 0; a < most; ++a) add_node(a < of.size() ? of[a] : -1);
    }
    for (std::size_t j = 0; j < sides_.multipliers; ++j)
      group.equations.push_back(static_cast<int>(unknowns_.of_multipliers[k * sides_.multipliers + j]));
    for (const std::int64_t equation : unknowns_.of_body)
      group.equations.push_back(static_cast<int>(equation));
  }
  const StencilGroup* const groups[] = {&elements, &open};
  tangent_ = pattern_of(static_cast<int>(unknowns_.dofs.size()), false,
                        std::span(groups, sides_.multipliers > 0 ? 2 : 1));
  if (sides_.points.are_nodes() && net == nullptr)
    places_.assign(sides_.points.size() * (sides_.d * (sides_.m + 1) * (sides_.m + 1) + 1), 0);
}

std::int32_t Contact::add_elements(const ents_output& out, ents_system system, ents_report& report) {
  static constexpr std::int64_t none[6] = {-1, -1, -1, -1, -1, -1};
  if (sides_.frame.turns()) {
    system.pose = &sides_.frame.pose();
    if (system.body_equations == nullptr) system.body_equations = none;
  }
  const ents::Library& library = sides_.library();
  const ents_master_mesh where = sides_.mesh();
  const ents_input in = input(where);
  const std::int32_t status =
      library.assemble(sides_.master.model->get(), 0, sides_.count(), &in, &out, &system, &report);
  if (status < 0) throw JobError("contact: " + describe(library, status, report));
  return status;
}

std::int32_t Contact::assemble(const Configuration& at, std::vector<double>& residual, bool want_tangent,
                               RigidCoupling* coupling, double& squared_force, ents_report& report) {
  sides_.place(at);
  std::vector<std::int32_t> flags(sides_.points.size());
  std::vector<double> force(unknowns_.dofs.size());
  auto out = ents_struct<ents_output>();
  out.wanted = ENTS_FLAGS;
  out.flags = flags.data(), out.flags_stride = 1;
  if (sides_.state_size > 0) {
    out.wanted |= ENTS_STATE;
    out.state_end = states_.out.data(), out.state_end_stride = stride(sides_.state_size);
  }
  std::vector<double> energies;
  if (pulls_) ask_for_energy(out, energies);
  std::vector<double> nodes;
  if (!sides_.points.heights.empty()) {
    nodes = sides_.nodes_at(at.displacement);
    if (!sides_.frame.turns()) sides_.frame.see(at, nodes); // with a pose positions are in space
  }
  auto points = ents_struct<ents_combination>();
  auto system = ents_struct<ents_system>();
  system.index_size = sizeof(int);
  system.slave_nodes = sides_.points.are_nodes() ? sides_.count() : sides_.bodies->node_count();
  system.slave_equations = sides_.points.are_nodes() ? unknowns_.of_slaves.data() : unknowns_.of_dofs.data();
  if (sides_.points.are_nodes()) {
    if (!sides_.master.net)
      system.places = places_.data(), system.places_size = stride(places_.size() / sides_.points.size());
  } else {
    points = sides_.points.combination(point_begin_, point_nodes_);
    system.slave = &points;
    if (!nodes.empty()) system.slave_positions = nodes.data();
  }
  auto net = ents_struct<ents_combination>();
  sides_.set_master(system, net, unknowns_.of_master);
  system.multiplier_equations = unknowns_.of_multipliers.data();
  if (!unknowns_.of_body.empty()) system.body_equations = unknowns_.of_body.data();
  system.rows = stride(force.size());
  system.residual = force.data();
  if (want_tangent || coupling != nullptr) {
    std::fill_n(tangent_.valuePtr(), tangent_.nonZeros(), 0.0);
    system.row_begin = tangent_.outerIndexPtr(), system.columns = tangent_.innerIndexPtr();
    system.values = tangent_.valuePtr();
  }
  const std::int32_t status = add_elements(out, system, report);
  if (status != ENTS_OK) return status;
  changes_.count(flags, at_.segment);
  if (pulls_) add_up(energies);
  if (system.values != nullptr) turn_images(), sides_.frame.columns_of_turns(at, unknowns_.of_body, tangent_);
  squared_force = 0;
  for (std::size_t i = 0; i < unknowns_.slave_dofs; ++i) squared_force += force[i] * force[i];
  if (coupling != nullptr) {
    coupling->column.resize(residual.size()), coupling->row.resize(residual.size());
    coupling->force = 0;
    for (std::size_t i = 0; i < unknowns_.slave_dofs; ++i)
      coupling->force -= force[i] * sides_.master.direction[i % sides_.d];
    couple(*coupling);
  }
  for (std::size_t i = 0; i < force.size(); ++i) residual[unknowns_.dofs[i]] += unknowns_.signs[i] * force[i];
  return ENTS_OK;
}

void Contact::turn_images() {
  for (std::size_t i = 0; sides_.master.net && i < unknowns_.dofs.size(); ++i)
    for (int at = tangent_.outerIndexPtr()[i]; at < tangent_.outerIndexPtr()[i + 1]; ++at)
      tangent_.valuePtr()[at] *=
          unknowns_.signs[i] * unknowns_.signs[static_cast<std::size_t>(tangent_.innerIndexPtr()[at])];
}

void Contact::add_tangent_times(const std::vector<double>& direction, std::vector<double>& residual) const {
  for (std::size_t i = 0; i < unknowns_.dofs.size(); ++i)
    for (int at = tangent_.outerIndexPtr()[i]; at < tangent_.outerIndexPtr()[i + 1]; ++at)
      if (const std::size_t j = unknowns_.dofs[static_cast<std::size_t>(tangent_.innerIndexPtr()[at])];
          j < direction.size())
        residual[unknowns_.dofs[i]] += tangent_.valuePtr()[at] * direction[j];
}

std::vector<double> Contact::position_sizes(const Configuration& at) const {
  std::vector<double> sizes(unknowns_.dofs.size(), 0.0);
  for (std::size_t i = 0; i < unknowns_.dofs.size(); ++i)
    if (unknowns_.dofs[i] < sides_.mesh_dofs())
      sizes[i] = std::abs(sides_.bodies->coordinates[unknowns_.dofs[i]]);
  if (!sides_.master.translates()) return sizes;
  std::vector<double> of_master(sizes.size(), 0.0);
  for (std::size_t k = 0; k < sides_.points.size(); ++k)
    for (std::size_t a = 0; at_.segment[k] >= 0 && a < sides_.m; ++a) {
      const auto node = static_cast<std::size_t>(
          sides_.master.connectivity[static_cast<std::size_t>(at_.segment[k]) * sides_.m + a]);
      for (std::size_t j = 0; j < sides_.points.nodes_per_point * sides_.d; ++j)
        if (const std::int64_t i = unknowns_.of_slaves[k * sides_.points.nodes_per_point * sides_.d + j];
            i >= 0) {
          double& size = of_master[static_cast<std::size_t>(i)];
          size = std::max(size, std::abs(sides_.master.positions[node * sides_.d + j % sides_.d]));
        }
    }
  for (std::size_t i = 0; i < unknowns_.slave_dofs; ++i)
    sizes[i] += of_master[i] + std::abs(at.motion * sides_.master.direction[i % sides_.d]);
  return sizes;
}

// Only the relative position of slave and master counts: moving the master is moving all slave points back,
// and the weights of a point's nodes add to one.
void Contact::couple(RigidCoupling& coupling) const {
  coupling.diagonal = 0;
  std::fill(coupling.column.begin(), coupling.column.end(), 0.0);
  std::fill(coupling.row.begin(), coupling.row.end(), 0.0);
  std::vector<double> direction(unknowns_.dofs.size(), 0.0);
  for (std::size_t i = 0; i < unknowns_.slave_dofs; ++i) direction[i] = sides_.master.direction[i % sides_.d];
  for (std::size_t i = 0; i < direction.size(); ++i)
    for (int at = tangent_.outerIndexPtr()[i]; at < tangent_.outerIndexPtr()[i + 1]; ++at) {
      const auto j = static_cast<std::size_t>(tangent_.innerIndexPtr()[at]);
      const double value = tangent_.valuePtr()[at];
      coupling.column[unknowns_.dofs[i]] -= value * direction[j];
      coupling.row[unknowns_.dofs[j]] -= direction[i] * value;
      coupling.diagonal += direction[i] * value * direction[j];
    }
}

} // namespace host
