// SPDX-License-Identifier: BSD-3-Clause
// Contact, in every iteration: search, forces and tangent; and what an increment leaves.
#include "contact.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace host {
namespace {

/// Current positions of a mesh's nodes.
std::vector<double> moved(const Mesh& mesh, const Configuration& at) {
  std::vector<double> positions = mesh.coordinates;
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] += at.displacement[i];
  return positions;
}

std::vector<double> combined(const ents::Combination& points, std::size_t d,
                             const std::vector<double>& nodes) {
  const ents_combination view = points.get();
  std::vector<double> out(static_cast<std::size_t>(view.points) * d);
  ents::require(ents::linked(), ents_combine, &view, static_cast<std::int32_t>(d), ssize_of(nodes.size() / d),
                nodes.data(), out.data());
  return out;
}

} // namespace

/// A rigid master that moves along a line stays where it is, and the slave points move back: mesh and tree never change.
std::vector<double> Contact::slave_positions(const Configuration& at) const {
  std::vector<double> positions = combined(slave_, d_, moved(*bodies_, at));
  for (std::size_t i = 0; rigid_ && i < positions.size(); ++i) positions[i] -= at.motion * direction_[i % d_];
  return positions;
}

std::vector<double> Contact::master_positions(const Configuration& at) const {
  if (rigid_) return fixed_;
  return smoothed_ ? combined(net_, d_, moved(*bodies_, at)) : moved(*bodies_, at);
}

ents_master_mesh Contact::mesh() const {
  auto mesh = ents::make<ents_master_mesh>();
  mesh.segments = ssize_of(segments()), mesh.connectivity = connectivity_.data();
  mesh.nodes = ssize_of(master_now_.size() / d_), mesh.positions = master_now_.data();
  mesh.temperature = heat_ ? master_temperatures_.data() : nullptr;
  mesh.surface_coordinates = surface_coordinates_.empty() ? nullptr : surface_coordinates_.data();
  return mesh;
}

void Contact::place(const Configuration& at) {
  slave_now_ = slave_positions(at);
  master_now_ = master_positions(at);
  if (heat_) warm(at);
  if (!rigid_ && tree_.size() > 0) tree_.refit(model_, mesh());
}

/// Temperatures of slave points and master: combinations of the nodes', as the positions are.
void Contact::warm(const Configuration& at) {
  std::vector<double> nodes(at.displacement.begin() +
                                static_cast<std::ptrdiff_t>(bodies_->coordinates.size()),
                            at.displacement.end());
  for (double& temperature : nodes) temperature += temperature_;
  slave_temperature_ = combined(slave_, 1, nodes);
  master_temperatures_ = rigid_      ? std::vector<double>(fixed_.size() / d_, master_temperature_)
                         : smoothed_ ? combined(net_, 1, nodes)
                                     : nodes;
}

void Contact::begin_increment(const Configuration& begin, double duration) {
  place(begin);
  duration_ = duration;
  slave_begin_ = slave_now_, master_begin_ = master_now_;
  segment_ = accepted_.segment, xi_ = accepted_.xi, flags_ = accepted_.flags;
}

void Contact::accept() {
  states_.accept();
  accepted_ = {segment_, xi_, flags_};
}

/// Segments of the last projections go in, those of this one come out.
ents_detection Contact::detection() {
  auto io = ents::make<ents_detection>();
  io.slave = slave_now_.data(), io.reach = reach_;
  io.segment = segment_.data(), io.xi = xi_.data();
  return io;
}

Outcome Contact::iterate(const ents_output& out, const ents_system* system) {
  const ents_master_mesh surface = mesh();
  const ents_detection io = detection();
  auto in = ents::make<ents_input>();
  in.area = areas_.data(), in.area_stride = 1;
  in.state_begin = states_.begin.data(), in.state_begin_stride = states_.size;
  in.positions_begin = master_begin_.data(), in.slave_begin = slave_begin_.data();
  in.time_increment = duration_;
  if (heat_) in.slave_temperature = slave_temperature_.data(), in.slave_temperature_stride = 1;
  return outcome(ents::call(ents_iterate, model_.get(), &surface, tree_.data(), tree_.size(), 0,
                            ssize_of(points()), &io, &in, &out, system));
}

Outcome Contact::outcome(const ents::Result& result) const {
  if (result.ok()) return {};
  const double factor = result.report.step_factor;
  return {false, ents::describe(ents::linked(), result.status, result.report), factor < 1 ? factor : 0.5};
}

Outcome Contact::search(const Configuration& at, bool& changed) {
  // An iterate that diverges comes to positions that the search refuses.
  if (std::any_of(at.displacement.begin(), at.displacement.end(),
                  [](double u) { return !(std::abs(u) < 1e50); }))
    return {false, "Newton's iteration diverges", 0.5};
  place(at);
  // A closed point is followed on its segment; an open one may have moved over another part of the surface.
  for (std::size_t k = 0; k < points(); ++k)
    if ((flags_[k] & ENTS_FLAG_CONTACT) == 0) segment_[k] = -1;
  const ents_master_mesh surface = mesh();
  const ents_detection io = detection();
  const Outcome found = outcome(ents::call(ents_detect, model_.get(), &surface, tree_.data(), tree_.size(), 0,
                                           ssize_of(points()), &io));
  changed = tangent_.rows() == 0 || (!rigid_ && segment_ != pattern_segment_);
  return found;
}

void Contact::build_pattern() {
  pattern_segment_ = segment_;
  const auto m = static_cast<std::size_t>(model_.layout().nodes);
  const auto own = static_cast<std::size_t>(model_.layout().node_dofs);
  std::vector<std::set<std::int64_t>> neighbours(rows_.size() / own); // nodes with a common slave point
  std::vector<std::int64_t> nodes;                                    // of a slave point and its segment
  const auto add_point = [&](const ents::Combination& all, std::size_t point) {
    nodes.insert(nodes.end(), all.nodes.begin() + all.begin[point], all.nodes.begin() + all.begin[point + 1]);
  };
  for (std::size_t k = 0; k < points(); ++k) {
    if (!rigid_ && segment_[k] < 0) continue;
    nodes.clear();
    add_point(slave_, k);
    for (std::size_t a = 0; !rigid_ && a < m; ++a) {
      const std::int64_t point = connectivity_[static_cast<std::size_t>(segment_[k]) * m + a];
      smoothed_ ? add_point(net_, static_cast<std::size_t>(point)) : nodes.push_back(point);
    }
    for (const std::int64_t node : nodes)
      neighbours[static_cast<std::size_t>(node)].insert(nodes.begin(), nodes.end());
  }
  std::vector<Eigen::Triplet<double, int>> zeros;
  for (std::size_t node = 0; node < neighbours.size(); ++node)
    for (const std::int64_t other : neighbours[node])
      for (std::size_t i = 0; i < own * own; ++i)
        zeros.emplace_back(rows_[node * own + i / own],
                           rows_[static_cast<std::size_t>(other) * own + i % own], 0.);
  const auto size = static_cast<Eigen::Index>(own_force_.size());
  tangent_.resize(size, size);
  tangent_.setFromTriplets(zeros.begin(), zeros.end());
}

Outcome Contact::assemble(const Configuration& at, std::vector<double>& residual, double& squared,
                          double& squared_power) {
  place(at);
  std::fill_n(tangent_.valuePtr(), tangent_.nonZeros(), 0.0);
  std::fill(own_force_.begin(), own_force_.end(), 0.0);
  const ents_combination slave = slave_.get(), net = smoothed_ ? net_.get() : ents::make<ents_combination>();
  auto system = ents::make<ents_system>();
  system.index_size = sizeof(int);
  system.slave = &slave, system.master = smoothed_ ? &net : nullptr;
  system.slave_nodes = system.master_nodes = bodies_->node_count();
  system.slave_equations = system.master_equations = rows_.data();
  system.rows = ssize_of(own_force_.size()), system.residual = own_force_.data();
  system.row_begin = tangent_.outerIndexPtr(), system.columns = tangent_.innerIndexPtr();
  system.values = tangent_.valuePtr();
  auto out = ents::make<ents_output>();
  out.wanted = ENTS_FLAGS | ENTS_STATE;
  out.flags = flags_.data(), out.flags_stride = 1;
  out.state_end = states_.end.data(), out.state_end_stride = states_.size;
  const Outcome found = iterate(out, &system);
  if (!found.ok) return found;
  for (const int node : slave_nodes_) {
    for (std::size_t i = 0; i < d_; ++i) {
      const double force = own_force_[static_cast<std::size_t>(node) * d_ + i];
      squared += force * force;
    }
    const double power = heat_ ? own_force_[bodies_->coordinates.size() + static_cast<std::size_t>(node)] : 0;
    squared_power += power * power;
  }
  for (std::size_t i = 0; i < residual.size(); ++i) residual[i] += own_force_[i];
  return found;
}

std::vector<double> Contact::force() const {
  std::vector<double> sum(d_, 0.0);
  for (const int node : slave_nodes_)
    for (std::size_t i = 0; i < d_; ++i) sum[i] += own_force_[static_cast<std::size_t>(node) * d_ + i];
  return sum;
}

// Moving the master by its direction is moving all slave points back.
Coupling Contact::coupling() const {
  Coupling c;
  c.column.assign(own_force_.size(), 0.0), c.row = c.column;
  if (!rigid_) return c;
  const auto along = [&](std::size_t dof) { // a temperature has no direction
    return dof < bodies_->coordinates.size() ? direction_[dof % d_] : 0.;
  };
  for (std::size_t i = 0; i < own_force_.size(); ++i) {
    c.force -= own_force_[i] * along(i);
    for (int at = tangent_.outerIndexPtr()[i]; at < tangent_.outerIndexPtr()[i + 1]; ++at) {
      const auto j = static_cast<std::size_t>(tangent_.innerIndexPtr()[at]);
      const double value = tangent_.valuePtr()[at];
      c.column[i] -= value * along(j);
      c.row[j] -= along(i) * value;
      c.diagonal += along(i) * value * along(j);
    }
  }
  return c;
}

ContactResults Contact::results(const Configuration& at) {
  place(at);
  ContactResults r;
  const std::size_t n = points();
  for (auto* vectors : {&r.normal, &r.traction}) vectors->assign(n * d_, 0.0);
  for (auto* scalars : {&r.gap, &r.pressure, &r.slip}) scalars->assign(n, 0.0);
  r.flags.assign(n, 0);
  auto out = ents::make<ents_output>();
  out.wanted = ENTS_GAP | ENTS_NORMAL | ENTS_PRESSURE | ENTS_FLAGS | ENTS_TRACTION | ENTS_SLIP;
  out.gap = r.gap.data(), out.pressure = r.pressure.data(), out.slip = r.slip.data(),
  out.flags = r.flags.data();
  out.gap_stride = out.pressure_stride = out.slip_stride = out.flags_stride = 1;
  out.normal = r.normal.data(), out.traction = r.traction.data();
  out.normal_stride = out.traction_stride = ssize_of(d_);
  if (heat_) {
    r.heat.assign(2 * n, 0.0); // through the gap, made by friction
    out.wanted |= ENTS_HEAT;
    out.heat = r.heat.data(), out.heat_stride = 2;
  }
  if (const Outcome found = iterate(out, nullptr); !found.ok) throw JobError(found.reason);
  for (std::size_t k = 0; k < n; ++k)
    if (segment_[k] < 0) r.gap[k] = std::nan(""); // nothing is opposite
  for (std::size_t k = 0; k < n && heat_; ++k)
    r.friction_heat += r.heat[2 * k + 1], r.heat[k] = r.heat[2 * k];
  r.heat.resize(heat_ ? n : 0);
  r.force = force();
  r.position = slave_now_;
  for (std::size_t i = 0; rigid_ && i < r.position.size(); ++i)
    r.position[i] += at.motion * direction_[i % d_];
  return r;
}

void Contact::sample_surface(const Configuration& at, int divisions, vtu::Grid& grid) {
  place(at);
  const auto m = static_cast<std::size_t>(model_.layout().nodes), n = static_cast<std::size_t>(divisions);
  const bool triangle = model_.layout().dimension == 3 && (m == 3 || m == 6 || m == 15);
  std::vector<double> xi;
  for (std::size_t j = 0; j <= (d_ == 2 ? 0 : n); ++j)
    for (std::size_t i = 0; i <= n; ++i) {
      const double a = 2. * static_cast<double>(i) / static_cast<double>(n) - 1;
      const double b = 2. * static_cast<double>(j) / static_cast<double>(n) - 1;
      xi.push_back(triangle ? 0.25 * (1 + a) * (1 - b) : a); // a triangle is a square with one side shrunk
      if (d_ == 3) xi.push_back(triangle ? 0.5 * (1 + b) : b);
    }
  const std::size_t count = xi.size() / (d_ - 1);
  std::vector<double> positions(m * d_), points(count * d_), heights(count);
  for (std::size_t s = 0; s < segments(); ++s) {
    for (std::size_t a = 0; a < m * d_; ++a)
      positions[a] = master_now_[static_cast<std::size_t>(connectivity_[s * m + a / d_]) * d_ + a % d_] +
                     (rigid_ ? at.motion * direction_[a % d_] : 0);
    auto surface = ents::make<ents_surface>();
    surface.master = positions.data(), surface.xi = xi.data();
    if (!surface_coordinates_.empty()) surface.surface_coordinates = &surface_coordinates_[s * m * (d_ - 1)];
    surface.point = points.data(), surface.height = heights.data();
    if (!outcome(ents::call(ents_surface_evaluate, model_.get(), ssize_of(count), &surface)).ok) continue;
    grid.add_surface(divisions + 1, d_ == 2 ? 1 : divisions + 1, points);
    grid.point_data[0].values.insert(grid.point_data[0].values.end(), heights.begin(), heights.end());
  }
}

} // namespace host
