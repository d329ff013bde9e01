// SPDX-License-Identifier: BSD-3-Clause
// Contact: the library's elements in the host's equations.
#include <algorithm>
#include <cmath>

#include "contact.hpp"

namespace host {

void Contact::build_tangent() {
  pattern_segment_ = at_.segment;
  StencilGroup elements, open; // an element without a segment: the multipliers alone
  const std::size_t q = points_.nodes_per_point;
  // What each segment's points are made of: their nodes, or combinations of different numbers of nodes.
  const ControlNet* net = master_.net.get();
  std::vector<std::vector<std::int64_t>> nodes_of(master_.rigid ? 0 : master_.segments());
  std::size_t most = 0;
  for (std::size_t s = 0; s < nodes_of.size(); ++s) {
    const std::int64_t* points = master_.connectivity.data() + s * m_;
    nodes_of[s] = net != nullptr ? net->nodes_of(points, m_) : std::vector(points, points + m_);
    most = std::max(most, nodes_of[s].size());
  }
  elements.dofs = static_cast<int>((q + most) * d_ + multipliers_ + unknowns_.of_body.size());
  open.dofs = static_cast<int>(multipliers_);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    StencilGroup& group = master_.rigid || at_.segment[k] >= 0 ? elements : open;
    const auto add_node = [&](std::int64_t node) {
      for (std::size_t i = 0; i < d_; ++i)
        group.equations.push_back(
            node < 0 ? -1 : static_cast<int>(unknowns_.of_master[static_cast<std::size_t>(node) * d_ + i]));
    };
    for (std::size_t a = 0; a < q && &group == &elements; ++a) add_node(points_.nodes[k * q + a]);
    if (!master_.rigid && &group == &elements) {
      const std::vector<std::int64_t>& of = nodes_of[static_cast<std::size_t>(at_.segment[k])];
      for (std::size_t a = 0; a < most; ++a) add_node(a < of.size() ? of[a] : -1);
    }
    for (std::size_t j = 0; j < multipliers_; ++j)
      group.equations.push_back(static_cast<int>(unknowns_.of_multipliers[k * multipliers_ + j]));
    for (const std::int64_t equation : unknowns_.of_body)
      group.equations.push_back(static_cast<int>(equation));
  }
  const StencilGroup* const groups[] = {&elements, &open};
  tangent_ =
      pattern_of(static_cast<int>(unknowns_.dofs.size()), false, std::span(groups, multipliers_ > 0 ? 2 : 1));
  if (points_.are_nodes() && net == nullptr)
    places_.assign(points_.size() * (d_ * (m_ + 1) * (m_ + 1) + 1), 0);
}

std::int32_t Contact::add_elements(const ents_output& out, ents_system system, ents_report& report) {
  static constexpr std::int64_t none[6] = {-1, -1, -1, -1, -1, -1};
  if (frame_.turns()) {
    system.pose = &frame_.pose();
    if (system.body_equations == nullptr) system.body_equations = none;
  }
  const ents::Library& library = master_.model->library();
  const ents_master_mesh where = mesh();
  const ents_input in = input(where);
  const std::int32_t status = library.assemble(master_.model->get(), 0, count(), &in, &out, &system, &report);
  if (status < 0) throw JobError("contact: " + describe(library, status, report));
  return status;
}

std::int32_t Contact::assemble(const Configuration& at, std::vector<double>& residual, bool want_tangent,
                               RigidCoupling* coupling, double& squared_force, ents_report& report) {
  place(at);
  std::vector<std::int32_t> flags(points_.size());
  std::vector<double> force(unknowns_.dofs.size());
  auto out = ents_struct<ents_output>();
  out.wanted = ENTS_FLAGS;
  out.flags = flags.data(), out.flags_stride = 1;
  if (state_size_ > 0) {
    out.wanted |= ENTS_STATE;
    out.state_end = state_out_.data(), out.state_end_stride = stride(state_size_);
  }
  std::vector<double> energies;
  if (pulls_) ask_for_energy(out, energies);
  std::vector<double> nodes;
  if (!points_.heights.empty()) {
    nodes = nodes_at(at.displacement);
    if (!frame_.turns()) frame_.see(at, nodes); // with a pose positions are in space
  }
  auto points = ents_struct<ents_combination>();
  auto system = ents_struct<ents_system>();
  system.index_size = sizeof(int);
  system.slave_nodes = points_.are_nodes() ? count() : mesh_->node_count();
  system.slave_equations = points_.are_nodes() ? unknowns_.of_slaves.data() : unknowns_.of_dofs.data();
  if (points_.are_nodes()) {
    if (!master_.net)
      system.places = places_.data(), system.places_size = stride(places_.size() / points_.size());
  } else {
    points = points_.combination(point_begin_, point_nodes_);
    system.slave = &points;
    if (!nodes.empty()) system.slave_positions = nodes.data();
  }
  auto net = ents_struct<ents_combination>();
  set_master(system, net, unknowns_.of_master);
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
  count_changes(flags);
  if (pulls_) add_up(energies);
  if (system.values != nullptr) turn_images(), frame_.columns_of_turns(at, unknowns_.of_body, tangent_);
  squared_force = 0;
  for (std::size_t i = 0; i < unknowns_.slave_dofs; ++i) squared_force += force[i] * force[i];
  if (coupling != nullptr) {
    coupling->column.resize(residual.size()), coupling->row.resize(residual.size());
    coupling->force = 0;
    for (std::size_t i = 0; i < unknowns_.slave_dofs; ++i)
      coupling->force -= force[i] * master_.direction[i % d_];
    couple(*coupling);
  }
  for (std::size_t i = 0; i < force.size(); ++i) residual[unknowns_.dofs[i]] += unknowns_.signs[i] * force[i];
  return ENTS_OK;
}

void Contact::set_master(ents_system& system, ents_combination& points,
                         const std::vector<std::int64_t>& equations) const {
  system.master_nodes = master_.net ? master_.net->all_nodes() : mesh_->node_count();
  system.master_equations = equations.data();
  if (!master_.net) return;
  points = master_.net->combination();
  system.master = &points;
}

void Contact::turn_images() {
  for (std::size_t i = 0; master_.net && i < unknowns_.dofs.size(); ++i)
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
    if (unknowns_.dofs[i] < dofs()) sizes[i] = std::abs(mesh_->coordinates[unknowns_.dofs[i]]);
  if (!master_.translates()) return sizes;
  std::vector<double> of_master(sizes.size(), 0.0);
  for (std::size_t k = 0; k < points_.size(); ++k)
    for (std::size_t a = 0; at_.segment[k] >= 0 && a < m_; ++a) {
      const auto node =
          static_cast<std::size_t>(master_.connectivity[static_cast<std::size_t>(at_.segment[k]) * m_ + a]);
      for (std::size_t j = 0; j < points_.nodes_per_point * d_; ++j)
        if (const std::int64_t i = unknowns_.of_slaves[k * points_.nodes_per_point * d_ + j]; i >= 0) {
          double& size = of_master[static_cast<std::size_t>(i)];
          size = std::max(size, std::abs(master_.positions[node * d_ + j % d_]));
        }
    }
  for (std::size_t i = 0; i < unknowns_.slave_dofs; ++i)
    sizes[i] += of_master[i] + std::abs(at.motion * master_.direction[i % d_]);
  return sizes;
}

void Contact::count_changes(const std::vector<std::int32_t>& flags) {
  status_changes_ = switches_ = moves_ = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    closed_[k] = (flags[k] & ENTS_FLAG_CONTACT) != 0;
    const std::int64_t now =
        closed_[k] == 0 ? -1 : 2 * at_.segment[k] + ((flags[k] & ENTS_FLAG_SLIP) != 0 ? 1 : 0);
    status_changes_ += now != found_[k];
    switches_ += (now < 0) != (found_[k] < 0);
    moves_ += now >= 0 && found_[k] >= 0 && now / 2 != found_[k] / 2;
    found_[k] = now;
  }
}

// Only the relative position of slave and master counts: moving the master is moving all slave points back,
// and the weights of a point's nodes add to one.
void Contact::couple(RigidCoupling& coupling) const {
  coupling.diagonal = 0;
  std::fill(coupling.column.begin(), coupling.column.end(), 0.0);
  std::fill(coupling.row.begin(), coupling.row.end(), 0.0);
  std::vector<double> direction(unknowns_.dofs.size(), 0.0);
  for (std::size_t i = 0; i < unknowns_.slave_dofs; ++i) direction[i] = master_.direction[i % d_];
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
