// SPDX-License-Identifier: BSD-3-Clause
#include "contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "segment_search.hpp"

namespace host {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::int64_t stride(std::size_t value) { return static_cast<std::int64_t>(value); }

} // namespace

Contact::Contact(Master master, const Mesh& mesh, const DofMap& dofs, const std::vector<Face>& slave_faces,
                 double thickness, bool axisymmetric)
    : master_(std::move(master)), mesh_(&mesh), dofs_(&dofs) {
  const ents_layout& layout = master_.model->layout();
  d_ = static_cast<std::size_t>(layout.dimension);
  m_ = static_cast<std::size_t>(layout.nodes);
  parameters_ = static_cast<std::size_t>(layout.parameters);
  element_dofs_ = static_cast<std::size_t>(layout.dofs);
  state_size_ = static_cast<std::size_t>(layout.state_size);

  const std::vector<int> nodes = nodes_of(slave_faces);
  const std::vector<double> areas = tributary_areas(mesh, slave_faces, nodes, thickness, axisymmetric);
  // Tied nodes are one node: it carries the areas of all.
  std::map<int, double> merged;
  for (std::size_t i = 0; i < nodes.size(); ++i) merged[dofs.representative(nodes[i])] += areas[i];
  for (const auto& [node, area] : merged) {
    slaves_.push_back(node);
    areas_.push_back(area);
  }
  segment_.assign(slaves_.size(), -1);
  segment_begin_ = closed_on_ = segment_;
  state_begin_.assign(slaves_.size() * state_size_, 0.0);
  state_end_ = state_begin_;
  last_xi_.assign(slaves_.size() * parameters_, not_a_number);
}

double Contact::total_area() const { return std::accumulate(areas_.begin(), areas_.end(), 0.0); }

void Contact::gather_master(std::size_t segment, const std::vector<double>& displacement, double motion,
                            double* positions) const {
  for (std::size_t a = 0; a < m_; ++a)
    for (std::size_t i = 0; i < d_; ++i) {
      if (master_.rigid) {
        positions[a * d_ + i] =
            master_.positions[(segment * m_ + a) * d_ + i] + motion * master_.direction[i];
      } else {
        const std::size_t dof = static_cast<std::size_t>(master_.nodes[segment * m_ + a]) * d_ + i;
        positions[a * d_ + i] = mesh_->coordinates[dof] + displacement[dof];
      }
    }
}

bool Contact::choose(const std::vector<double>& displacement, double motion) {
  const std::vector<int> before = segment_;
  if (master_.segments == 1) {
    std::fill(segment_.begin(), segment_.end(), 0);
  } else {
    using Point = SegmentSearch::Point;
    std::vector<double> masters(master_.segments * m_ * d_);
    std::vector<Point> corners(master_.segments * m_, Point::Zero());
    for (std::size_t s = 0; s < master_.segments; ++s)
      gather_master(s, displacement, motion, masters.data() + s * m_ * d_);
    for (std::size_t c = 0; c < corners.size(); ++c)
      for (std::size_t i = 0; i < d_; ++i) corners[c][static_cast<Eigen::Index>(i)] = masters[c * d_ + i];
    const SegmentSearch search(corners, m_);

    // All candidates of all slave nodes in one call.
    std::vector<std::size_t> owner;
    std::vector<int> candidate;
    std::vector<double> slave, master;
    for (std::size_t k = 0; k < slaves_.size(); ++k) {
      Point position = Point::Zero();
      for (std::size_t i = 0; i < d_; ++i) {
        const std::size_t dof = static_cast<std::size_t>(slaves_[k]) * d_ + i;
        position[static_cast<Eigen::Index>(i)] = mesh_->coordinates[dof] + displacement[dof];
      }
      for (const int s : search.near(position)) {
        owner.push_back(k);
        candidate.push_back(s);
        slave.insert(slave.end(), position.data(), position.data() + d_);
        const auto first = masters.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(s) * m_ * d_);
        master.insert(master.end(), first, first + static_cast<std::ptrdiff_t>(m_ * d_));
      }
    }
    std::vector<double> xi(owner.size() * parameters_), gap(owner.size());
    std::vector<std::int32_t> status(owner.size(), 0);
    const std::vector<double> centre(parameters_, master_.triangles ? 1. / 3 : 0.);
    auto in = ents_struct<ents_input>();
    in.slave = slave.data(), in.slave_stride = stride(d_);
    in.master = master.data(), in.master_stride = stride(m_ * d_);
    in.start = centre.data();
    auto out = ents_struct<ents_output>();
    out.wanted = ENTS_XI | ENTS_GAP;
    out.xi = xi.data(), out.xi_stride = stride(parameters_);
    out.gap = gap.data(), out.gap_stride = 1;
    out.status = status.data(), out.status_stride = 1;
    auto report = ents_struct<ents_report>();
    const EntsLibrary& library = master_.model->library();
    const std::int32_t result =
        library.evaluate(master_.model->get(), 0, stride(owner.size()), &in, &out, &report);
    if (result < 0) throw JobError("contact search: " + describe(library, result, report));

    std::fill(segment_.begin(), segment_.end(), -1);
    std::vector<double> best_excess(slaves_.size(), INFINITY), best_gap(slaves_.size(), INFINITY);
    for (std::size_t c = 0; c < owner.size(); ++c) {
      if (status[c] != ENTS_OK) continue;
      const std::size_t k = owner[c];
      const double excess = master_.excess(xi.data() + c * parameters_), distance = std::abs(gap[c]);
      if (excess > best_excess[k] || (excess == best_excess[k] && distance >= best_gap[k])) continue;
      best_excess[k] = excess, best_gap[k] = distance;
      segment_[k] = candidate[c];
    }
  }
  if (segment_ == before) return false;

  active_.clear();
  active_areas_.clear();
  for (std::size_t k = 0; k < slaves_.size(); ++k) {
    if (segment_[k] != before[k])
      std::fill_n(last_xi_.begin() + static_cast<std::ptrdiff_t>(k * parameters_), parameters_, not_a_number);
    if (segment_[k] < 0) continue;
    active_.push_back(k);
    active_areas_.push_back(areas_[k]);
  }
  state_in_.assign(active_.size() * state_size_, 0.0);
  state_out_ = state_in_;
  auto report = ents_struct<ents_report>();
  const EntsLibrary& library = master_.model->library();
  if (state_size_ > 0) {
    const std::int32_t status = library.state_init(master_.model->get(), stride(active_.size()),
                                                   state_in_.data(), stride(state_size_), &report);
    if (status != ENTS_OK) throw JobError("contact state: " + describe(library, status, report));
  }
  for (std::size_t e = 0; e < active_.size(); ++e)
    if (segment_[active_[e]] == segment_begin_[active_[e]]) // the history of another segment is none
      std::copy_n(state_begin_.begin() + static_cast<std::ptrdiff_t>(active_[e] * state_size_), state_size_,
                  state_in_.begin() + static_cast<std::ptrdiff_t>(e * state_size_));
  return true;
}

StencilGroup Contact::stencil() const {
  StencilGroup group;
  group.dofs = static_cast<int>(element_dofs_);
  if (master_.rigid) { // one element per slave node, whether it has a segment or not
    for (const int node : slaves_)
      for (std::size_t i = 0; i < d_; ++i) group.equations.push_back(dofs_->equation(node, static_cast<int>(i)));
    return group;
  }
  for (const std::size_t k : active_) {
    for (std::size_t i = 0; i < d_; ++i)
      group.equations.push_back(dofs_->equation(slaves_[k], static_cast<int>(i)));
    for (std::size_t a = 0; a < m_; ++a)
      for (std::size_t i = 0; i < d_; ++i)
        group.equations.push_back(dofs_->equation(
            master_.nodes[static_cast<std::size_t>(segment_[k]) * m_ + a], static_cast<int>(i)));
  }
  return group;
}

void Contact::gather(const std::vector<double>& displacement, double motion) {
  slave_positions_.resize(active_.size() * d_);
  master_positions_.resize((master_.segments == 1 ? 1 : active_.size()) * m_ * d_);
  bool all_known = true;
  for (std::size_t e = 0; e < active_.size(); ++e) {
    const std::size_t k = active_[e];
    for (std::size_t i = 0; i < d_; ++i) {
      const std::size_t dof = static_cast<std::size_t>(slaves_[k]) * d_ + i;
      slave_positions_[e * d_ + i] = mesh_->coordinates[dof] + displacement[dof];
    }
    if (master_.segments > 1)
      gather_master(static_cast<std::size_t>(segment_[k]), displacement, motion,
                    master_positions_.data() + e * m_ * d_);
    all_known = all_known && !std::isnan(last_xi_[k * parameters_]);
  }
  if (master_.segments == 1) gather_master(0, displacement, motion, master_positions_.data());
  start_.clear();
  if (!all_known && !start_from_base()) return; // the library searches the whole segment
  for (const std::size_t k : active_)
    start_.insert(start_.end(), last_xi_.begin() + static_cast<std::ptrdiff_t>(k * parameters_),
                  last_xi_.begin() + static_cast<std::ptrdiff_t>((k + 1) * parameters_));
}

bool Contact::start_from_base() {
  if (!master_.base || active_.empty()) return false;
  std::vector<double> xi(active_.size() * parameters_);
  ents_input in = input();
  in.start = nullptr, in.state_begin = nullptr;
  auto out = ents_struct<ents_output>();
  out.wanted = ENTS_XI;
  out.xi = xi.data(), out.xi_stride = stride(parameters_);
  auto report = ents_struct<ents_report>();
  if (master_.base->library().evaluate(master_.base->get(), 0, stride(active_.size()), &in, &out, &report) != ENTS_OK)
    return false;
  for (std::size_t e = 0; e < active_.size(); ++e) {
    double* last = last_xi_.data() + active_[e] * parameters_;
    if (std::isnan(*last)) std::copy_n(xi.begin() + static_cast<std::ptrdiff_t>(e * parameters_), parameters_, last);
  }
  return true;
}

ents_input Contact::input() const {
  auto in = ents_struct<ents_input>();
  in.slave = slave_positions_.data(), in.slave_stride = stride(d_);
  in.master = master_positions_.data();
  in.master_stride = master_.segments == 1 ? 0 : stride(m_ * d_);
  in.area = active_areas_.data(), in.area_stride = 1;
  if (!start_.empty()) in.start = start_.data(), in.start_stride = stride(parameters_);
  if (state_size_ > 0) in.state_begin = state_in_.data(), in.state_begin_stride = stride(state_size_);
  return in;
}

std::int32_t Contact::assemble(const std::vector<double>& displacement, double motion,
                               std::vector<double>& residual, SparseSystem* system, std::size_t group,
                               RigidCoupling* coupling, double& squared_force, ents_report& report) {
  gather(displacement, motion);
  const std::size_t n = element_dofs_;
  std::vector<double> force(active_.size() * n), tangent, xi(active_.size() * parameters_);
  std::vector<std::int32_t> flags(active_.size());
  const ents_input in = input();
  auto out = ents_struct<ents_output>();
  out.wanted = ENTS_RESIDUAL | ENTS_XI | ENTS_FLAGS;
  out.flags = flags.data(), out.flags_stride = 1;
  out.residual = force.data(), out.residual_stride = stride(n);
  out.xi = xi.data(), out.xi_stride = stride(parameters_);
  if (state_size_ > 0) {
    out.wanted |= ENTS_STATE;
    out.state_end = state_out_.data(), out.state_end_stride = stride(state_size_);
  }
  if (system != nullptr || coupling != nullptr) {
    tangent.resize(active_.size() * n * n);
    out.wanted |= ENTS_TANGENT;
    out.tangent = tangent.data(), out.tangent_stride = stride(n * n);
    out.tangent_leading_dimension = stride(n);
  }
  const EntsLibrary& library = master_.model->library();
  const std::int32_t status =
      library.evaluate(master_.model->get(), 0, stride(active_.size()), &in, &out, &report);
  if (status < 0) throw JobError("contact: " + describe(library, status, report));
  if (status != ENTS_OK) return status;

  squared_force = 0;
  std::vector<int> closed_on(slaves_.size(), -1);
  for (std::size_t e = 0; e < active_.size(); ++e)
    if ((flags[e] & ENTS_FLAG_CONTACT) != 0) closed_on[active_[e]] = segment_[active_[e]];
  status_changes_ = 0;
  for (std::size_t k = 0; k < slaves_.size(); ++k) status_changes_ += closed_on[k] != closed_on_[k];
  closed_on_ = std::move(closed_on);
  if (coupling != nullptr) {
    coupling->force = coupling->diagonal = 0;
    coupling->column.assign(residual.size(), 0.0);
    coupling->row.assign(residual.size(), 0.0);
  }
  for (std::size_t e = 0; e < active_.size(); ++e) {
    const std::size_t k = active_[e];
    std::copy_n(xi.begin() + static_cast<std::ptrdiff_t>(e * parameters_), parameters_,
                last_xi_.begin() + static_cast<std::ptrdiff_t>(k * parameters_));
    const double* R = force.data() + e * n;
    for (std::size_t a = 0; a < n; ++a) {
      const int node = a < d_ ? slaves_[k]
                              : master_.nodes[static_cast<std::size_t>(segment_[k]) * m_ + a / d_ - 1];
      residual[static_cast<std::size_t>(node) * d_ + a % d_] += R[a];
    }
    for (std::size_t i = 0; i < d_; ++i) squared_force += R[i] * R[i];
    if (system != nullptr) system->add(group, master_.rigid ? k : e, tangent.data() + e * n * n);
    if (coupling == nullptr) continue;
    const double* K = tangent.data() + e * n * n;
    const std::size_t first = static_cast<std::size_t>(slaves_[k]) * d_;
    for (std::size_t i = 0; i < d_; ++i) {
      coupling->force -= R[i] * master_.direction[i];
      for (std::size_t j = 0; j < d_; ++j) {
        coupling->column[first + i] -= K[j * n + i] * master_.direction[j];
        coupling->row[first + j] -= master_.direction[i] * K[j * n + i];
        coupling->diagonal += master_.direction[i] * K[j * n + i] * master_.direction[j];
      }
    }
  }
  return ENTS_OK;
}

void Contact::accept() {
  std::fill(segment_begin_.begin(), segment_begin_.end(), -1);
  for (std::size_t e = 0; e < active_.size(); ++e) {
    segment_begin_[active_[e]] = segment_[active_[e]];
    std::copy_n(state_out_.begin() + static_cast<std::ptrdiff_t>(e * state_size_), state_size_,
                state_begin_.begin() + static_cast<std::ptrdiff_t>(active_[e] * state_size_));
  }
  state_in_ = state_out_;
}

ContactFields Contact::fields(const std::vector<double>& displacement, double motion) {
  gather(displacement, motion);
  const std::size_t count = active_.size();
  std::vector<double> gap(count), normal_gap(count), pressure(count), normal(count * d_), point(count * d_);
  std::vector<std::int32_t> flags(count), status(count);
  const ents_input in = input();
  auto out = ents_struct<ents_output>();
  out.wanted = ENTS_GAP | ENTS_NORMAL_GAP | ENTS_PRESSURE | ENTS_NORMAL | ENTS_POINT | ENTS_FLAGS;
  out.gap = gap.data(), out.gap_stride = 1;
  out.normal_gap = normal_gap.data(), out.normal_gap_stride = 1;
  out.pressure = pressure.data(), out.pressure_stride = 1;
  out.normal = normal.data(), out.normal_stride = stride(d_);
  out.point = point.data(), out.point_stride = stride(d_);
  out.flags = flags.data(), out.flags_stride = 1;
  out.status = status.data(), out.status_stride = 1;
  auto report = ents_struct<ents_report>();
  const EntsLibrary& library = master_.model->library();
  const std::int32_t result =
      library.evaluate(master_.model->get(), 0, stride(count), &in, &out, &report);
  if (result < 0) throw JobError("contact: " + describe(library, result, report));

  ContactFields fields;
  fields.gap.assign(slaves_.size(), not_a_number);
  fields.normal_gap = fields.gap;
  fields.pressure.assign(slaves_.size(), 0.0);
  fields.normal.assign(slaves_.size() * d_, 0.0);
  fields.point.assign(slaves_.size() * d_, not_a_number);
  fields.closed.assign(slaves_.size(), 0);
  for (std::size_t e = 0; e < count; ++e) {
    if (status[e] != ENTS_OK || (flags[e] & ENTS_FLAG_OUTSIDE) != 0) continue;
    const std::size_t k = active_[e];
    fields.gap[k] = gap[e];
    fields.normal_gap[k] = normal_gap[e];
    fields.pressure[k] = pressure[e];
    fields.closed[k] = (flags[e] & ENTS_FLAG_CONTACT) != 0;
    std::copy_n(normal.begin() + static_cast<std::ptrdiff_t>(e * d_), d_,
                fields.normal.begin() + static_cast<std::ptrdiff_t>(k * d_));
    std::copy_n(point.begin() + static_cast<std::ptrdiff_t>(e * d_), d_,
                fields.point.begin() + static_cast<std::ptrdiff_t>(k * d_));
  }
  return fields;
}

} // namespace host
