// SPDX-License-Identifier: BSD-3-Clause
// Contact: the library's elements in the host's equations.
#include <algorithm>
#include <cmath>

#include "contact.hpp"

namespace host {

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
  const ContactUnknowns& unknowns = tangent_.unknowns();
  std::vector<std::int32_t> flags(sides_.points.size());
  std::vector<double> force(unknowns.dofs.size());
  auto out = ents_struct<ents_output>();
  out.wanted = ENTS_FLAGS;
  out.flags = flags.data(), out.flags_stride = 1;
  if (sides_.state_size > 0) {
    out.wanted |= ENTS_STATE;
    out.state_end = states_.out.data(), out.state_end_stride = stride(sides_.state_size);
  }
  ElementEnergies energies(pulls_ ? slaves().size() : 0, out);
  std::vector<double> nodes;
  if (!sides_.points.heights.empty()) {
    nodes = sides_.nodes_at(at.displacement);
    if (!sides_.frame.turns()) sides_.frame.see(at, nodes); // with a pose positions are in space
  }
  auto points = ents_struct<ents_combination>();
  auto system = ents_struct<ents_system>();
  system.index_size = sizeof(int);
  system.slave_nodes = sides_.points.are_nodes() ? sides_.count() : sides_.bodies->node_count();
  system.slave_equations = sides_.points.are_nodes() ? unknowns.of_slaves.data() : unknowns.of_dofs.data();
  tangent_.lend_places(system);
  if (!sides_.points.are_nodes()) {
    points = sides_.points.combination(point_begin_, point_nodes_);
    system.slave = &points;
    if (!nodes.empty()) system.slave_positions = nodes.data();
  }
  auto net = ents_struct<ents_combination>();
  sides_.set_master(system, net, unknowns.of_master);
  system.multiplier_equations = unknowns.of_multipliers.data();
  if (!unknowns.of_body.empty()) system.body_equations = unknowns.of_body.data();
  system.rows = stride(force.size());
  system.residual = force.data();
  if (want_tangent || coupling != nullptr) tangent_.receive(system);
  const std::int32_t status = add_elements(out, system, report);
  if (status != ENTS_OK) return status;
  changes_.count(flags, at_.segment);
  energy_ = energies.sum();
  if (system.values != nullptr) tangent_.turn(at);
  squared_force = 0;
  for (std::size_t i = 0; i < unknowns.slave_dofs; ++i) squared_force += force[i] * force[i];
  if (coupling != nullptr) {
    coupling->column.resize(residual.size()), coupling->row.resize(residual.size());
    coupling->force = 0;
    for (std::size_t i = 0; i < unknowns.slave_dofs; ++i)
      coupling->force -= force[i] * sides_.master.direction[i % sides_.d];
    tangent_.couple(*coupling);
  }
  for (std::size_t i = 0; i < force.size(); ++i) residual[unknowns.dofs[i]] += unknowns.signs[i] * force[i];
  return ENTS_OK;
}

std::vector<double> Contact::position_sizes(const Configuration& at) const {
  const ContactUnknowns& unknowns = tangent_.unknowns();
  std::vector<double> sizes(unknowns.dofs.size(), 0.0);
  for (std::size_t i = 0; i < unknowns.dofs.size(); ++i)
    if (unknowns.dofs[i] < sides_.mesh_dofs())
      sizes[i] = std::abs(sides_.bodies->coordinates[unknowns.dofs[i]]);
  if (!sides_.master.translates()) return sizes;
  std::vector<double> of_master(sizes.size(), 0.0);
  for (std::size_t k = 0; k < sides_.points.size(); ++k)
    for (std::size_t a = 0; at_.segment[k] >= 0 && a < sides_.m; ++a) {
      const auto node = static_cast<std::size_t>(
          sides_.master.connectivity[static_cast<std::size_t>(at_.segment[k]) * sides_.m + a]);
      for (std::size_t j = 0; j < sides_.points.nodes_per_point * sides_.d; ++j)
        if (const std::int64_t i = unknowns.of_slaves[k * sides_.points.nodes_per_point * sides_.d + j];
            i >= 0) {
          double& size = of_master[static_cast<std::size_t>(i)];
          size = std::max(size, std::abs(sides_.master.positions[node * sides_.d + j % sides_.d]));
        }
    }
  for (std::size_t i = 0; i < unknowns.slave_dofs; ++i)
    sizes[i] += of_master[i] + std::abs(at.motion * sides_.master.direction[i % sides_.d]);
  return sizes;
}

} // namespace host
