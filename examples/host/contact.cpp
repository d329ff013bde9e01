// SPDX-License-Identifier: BSD-3-Clause
// Contact: geometry, choice of segments, equations and assembly.
#include "contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace host {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::int64_t stride(std::size_t value) { return static_cast<std::int64_t>(value); }

std::ptrdiff_t offset(std::size_t value) { return static_cast<std::ptrdiff_t>(value); }

/// A stiffness of the model's contact law; 1 where the law has none.
double stiffness_of(const Json& model, const char* law) {
  const Json::json_pointer path("/contact/" + std::string(law) + "/stiffness");
  return model.contains(path) && model.at(path).is_number() ? model.at(path).get<double>() : 1;
}

} // namespace

Contact::Contact(Master master, const ContactSpec& spec, const Mesh& mesh, const DofMap& dofs, SlavePoints points)
    : master_(std::move(master)), mesh_(&mesh), dofs_(&dofs), points_(std::move(points)) {
  const ents_layout& layout = master_.model->layout();
  d_ = static_cast<std::size_t>(layout.dimension);
  m_ = static_cast<std::size_t>(layout.nodes);
  parameters_ = static_cast<std::size_t>(layout.parameters);
  element_dofs_ = static_cast<std::size_t>(layout.dofs);
  multipliers_ = static_cast<std::size_t>(layout.multipliers);
  node_dofs_ = element_dofs_ - multipliers_;
  state_size_ = static_cast<std::size_t>(layout.state_size);
  normal_stiffness_ = stiffness_of(spec.model, "normal");
  tangential_stiffness_ = stiffness_of(spec.model, "friction");

  for (std::size_t i = 0; i < d_; ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const int node : points_.nodes) {
      low = std::min(low, mesh.node(node)[i]);
      high = std::max(high, mesh.node(node)[i]);
    }
    size_ = std::hypot(size_, high - low);
  }
  segment_.assign(points_.size(), -1);
  segment_begin_ = found_ = segment_;
  state_begin_.assign(points_.size() * state_size_, 0.0);
  last_xi_.assign(points_.size() * parameters_, not_a_number);
  xi_begin_ = last_xi_;
  accepted_.pressure.assign(points_.size(), 0.0);
  accepted_.traction.assign(points_.size() * d_, 0.0);
}

double Contact::total_area() const { return std::accumulate(points_.areas.begin(), points_.areas.end(), 0.0); }

bool Contact::has_history() const {
  const ents_layout& layout = master_.model->layout();
  return layout.friction != 0 || layout.augmentable != 0;
}

double Contact::multiplier_scale(std::size_t index) const {
  return index % multipliers_ == 0 ? normal_stiffness_ : tangential_stiffness_;
}

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

std::array<double, 3> Contact::position_of(std::size_t k, const std::vector<double>& displacement) const {
  std::array<double, 3> position = points_.place(k, *mesh_);
  const std::array<double, 3> moved = points_.combine(k, displacement, d_);
  for (std::size_t i = 0; i < d_; ++i) position[i] += moved[i];
  return position;
}

void Contact::build_grid(const std::vector<double>& displacement) {
  using Point = SegmentSearch::Point;
  grid_masters_.resize(master_.segments * m_ * d_);
  std::vector<Point> corners(master_.segments * m_, Point::Zero());
  for (std::size_t s = 0; s < master_.segments; ++s) gather_master(s, displacement, 0., grid_masters_.data() + s * m_ * d_);
  for (std::size_t c = 0; c < corners.size(); ++c)
    for (std::size_t i = 0; i < d_; ++i) corners[c][static_cast<Eigen::Index>(i)] = grid_masters_[c * d_ + i];
  grid_ = std::make_unique<SegmentSearch>(corners, m_);
}

void Contact::search(const Configuration& at, bool only_lost) {
  if (master_.segments == 1) {
    std::fill(segment_.begin(), segment_.end(), 0);
    return;
  }
  using Point = SegmentSearch::Point;
  if (!grid_ || !master_.rigid) build_grid(at.displacement);

  // All candidates of all slave nodes in one call.
  std::vector<std::size_t> owner;
  std::vector<int> candidate;
  std::vector<double> slave, master, coordinates;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    Point position = Point::Zero();
    const std::array<double, 3> now = position_of(k, at.displacement);
    for (std::size_t i = 0; i < d_; ++i)
      position[static_cast<Eigen::Index>(i)] = now[i] - (master_.rigid ? at.motion * master_.direction[i] : 0.);
    for (const int s : grid_->near(position)) {
      owner.push_back(k);
      candidate.push_back(s);
      slave.insert(slave.end(), position.data(), position.data() + d_);
      const auto first = grid_masters_.begin() + offset(static_cast<std::size_t>(s) * m_ * d_);
      master.insert(master.end(), first, first + offset(m_ * d_));
      if (master_.surface_coordinates.empty()) continue;
      const auto second =
          master_.surface_coordinates.begin() + offset(static_cast<std::size_t>(s) * m_ * parameters_);
      coordinates.insert(coordinates.end(), second, second + offset(m_ * parameters_));
    }
  }
  std::vector<double> xi(owner.size() * parameters_), gap(owner.size());
  std::vector<std::int32_t> status(owner.size(), 0);
  const std::vector<double> centre(parameters_, master_.triangles ? 1. / 3 : 0.);
  auto in = ents_struct<ents_input>();
  in.slave = slave.data(), in.slave_stride = stride(d_);
  in.master = master.data(), in.master_stride = stride(m_ * d_);
  in.start = centre.data();
  const std::vector<double> no_multipliers(multipliers_ + 1, 0.0); // for gap and xi any values do
  in.multiplier = no_multipliers.data();
  if (!coordinates.empty()) {
    in.surface_coordinates = coordinates.data();
    in.surface_coordinates_stride = stride(m_ * parameters_);
  }
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

  const std::vector<int> before = segment_;
  std::fill(segment_.begin(), segment_.end(), -1);
  constexpr double same = 1e-9;
  std::vector<double> best_excess(points_.size(), INFINITY), best_gap = best_excess, own_gap = best_excess;
  for (std::size_t c = 0; c < owner.size(); ++c) {
    if (status[c] != ENTS_OK) continue;
    const std::size_t k = owner[c];
    const double excess = master_.excess(xi.data() + c * parameters_), distance = std::abs(gap[c]);
    if (candidate[c] == before[k] &&
        (only_lost ? master_.excess_over_margin(xi.data() + c * parameters_) : excess) <= same)
      own_gap[k] = distance;
    if (excess > best_excess[k] || (excess == best_excess[k] && distance >= best_gap[k])) continue;
    best_excess[k] = excess, best_gap[k] = distance;
    segment_[k] = candidate[c];
  }
  // A node on the common border of two segments stays where it is.
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (only_lost ? own_gap[k] < INFINITY : own_gap[k] <= best_gap[k] * (1 + same)) segment_[k] = before[k];
}

void Contact::list_active() {
  active_.clear();
  active_areas_.clear();
  active_coordinates_.clear();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (segment_[k] < 0) continue;
    active_.push_back(k);
    active_areas_.push_back(points_.areas[k]);
    if (master_.surface_coordinates.empty()) continue;
    const auto first = master_.surface_coordinates.begin() +
                       offset(static_cast<std::size_t>(segment_[k]) * m_ * parameters_);
    active_coordinates_.insert(active_coordinates_.end(), first, first + offset(m_ * parameters_));
  }
}

bool Contact::choose(const Configuration& at, bool only_lost, ents_report& report) {
  const std::vector<int> before = segment_;
  report.status = ENTS_OK;
  search(at, only_lost);
  if (segment_ == before) return segment_ != stencil_segment_;
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (segment_[k] != before[k])
      std::fill_n(last_xi_.begin() + offset(k * parameters_), parameters_, not_a_number);
  list_active();
  move_history(report);
  return segment_ != stencil_segment_;
}

StencilGroup Contact::stencil() {
  stencil_segment_ = segment_;
  StencilGroup group;
  group.dofs = static_cast<int>(expanded_dofs());
  const auto add_node = [&](int node) {
    for (std::size_t i = 0; i < d_; ++i) group.equations.push_back(dofs_->equation(node, static_cast<int>(i)));
  };
  const auto add = [&](std::size_t k) {
    for (std::size_t a = 0; a < points_.nodes_per_point; ++a) add_node(points_.nodes[k * points_.nodes_per_point + a]);
    for (std::size_t a = 0; !master_.rigid && a < m_; ++a)
      add_node(master_.nodes[static_cast<std::size_t>(segment_[k]) * m_ + a]);
    for (std::size_t j = 0; j < multipliers_; ++j)
      group.equations.push_back(dofs_->size() + static_cast<int>(k * multipliers_ + j));
  };
  if (master_.rigid) // one element per slave point, whether it has a segment or not
    for (std::size_t k = 0; k < points_.size(); ++k) add(k);
  else
    for (const std::size_t k : active_) add(k);
  return group;
}

StencilGroup Contact::idle_stencil() const {
  StencilGroup group;
  group.dofs = 1;
  for (std::size_t j = 0; j < multiplier_count(); ++j) group.equations.push_back(dofs_->size() + static_cast<int>(j));
  return group;
}

std::size_t Contact::unknown(std::size_t element, std::size_t local) const {
  const std::size_t k = active_[element], q = points_.nodes_per_point, node_dofs = expanded_dofs() - multipliers_;
  if (local >= node_dofs)
    return static_cast<std::size_t>(dofs_->dofs()) + k * multipliers_ + (local - node_dofs);
  const std::size_t a = local / d_;
  const int node = a < q ? points_.nodes[k * q + a] : master_.nodes[static_cast<std::size_t>(segment_[k]) * m_ + a - q];
  return static_cast<std::size_t>(node) * d_ + local % d_;
}

void Contact::expand(std::size_t k, const double* residual, const double* tangent, Expanded& out) const {
  const std::size_t n = element_dofs_, q = points_.nodes_per_point, all = expanded_dofs();
  // Which dof of the element each dof of the nodes is, and with what weight.
  const auto local = [&](std::size_t a) { return a < q * d_ ? a % d_ : a - (q - 1) * d_; };
  const auto weight = [&](std::size_t a) { return a < q * d_ ? points_.weights[k * q + a / d_] : 1.; };
  out.residual.resize(all);
  for (std::size_t a = 0; a < all; ++a) out.residual[a] = weight(a) * residual[local(a)];
  if (tangent == nullptr) return;
  out.tangent.resize(all * all);
  for (std::size_t b = 0; b < all; ++b)
    for (std::size_t a = 0; a < all; ++a)
      out.tangent[b * all + a] = weight(a) * weight(b) * tangent[local(b) * n + local(a)];
}

void Contact::gather(const Configuration& at) {
  slave_positions_.resize(active_.size() * d_);
  master_positions_.resize((master_.segments == 1 ? 1 : active_.size()) * m_ * d_);
  active_multipliers_.resize(active_.size() * multipliers_);
  bool all_known = true;
  for (std::size_t e = 0; e < active_.size(); ++e) {
    const std::size_t k = active_[e];
    const std::array<double, 3> now = position_of(k, at.displacement);
    std::copy_n(now.begin(), d_, slave_positions_.begin() + offset(e * d_));
    for (std::size_t j = 0; j < multipliers_; ++j)
      active_multipliers_[e * multipliers_ + j] = at.multiplier[k * multipliers_ + j];
    if (master_.segments > 1)
      gather_master(static_cast<std::size_t>(segment_[k]), at.displacement, at.motion,
                    master_positions_.data() + e * m_ * d_);
    all_known = all_known && !std::isnan(last_xi_[k * parameters_]);
  }
  if (master_.segments == 1) gather_master(0, at.displacement, at.motion, master_positions_.data());
  // Until the projection of every node is known the library searches the whole segment.
  start_.clear();
  if (!all_known && !start_from_base()) return; // the library searches the whole segment
  for (const std::size_t k : active_)
    start_.insert(start_.end(), last_xi_.begin() + offset(k * parameters_),
                  last_xi_.begin() + offset((k + 1) * parameters_));
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
    if (std::isnan(*last)) std::copy_n(xi.begin() + offset(e * parameters_), parameters_, last);
  }
  return true;
}

ents_input Contact::input() const {
  auto in = ents_struct<ents_input>();
  in.slave = slave_positions_.data(), in.slave_stride = stride(d_);
  in.master = master_positions_.data();
  in.master_stride = master_.segments == 1 ? 0 : stride(m_ * d_);
  if (!active_coordinates_.empty()) {
    in.surface_coordinates = active_coordinates_.data();
    in.surface_coordinates_stride = stride(m_ * parameters_);
  }
  in.area = active_areas_.data(), in.area_stride = 1;
  if (!start_.empty()) in.start = start_.data(), in.start_stride = stride(parameters_);
  if (state_size_ > 0) in.state_begin = state_in_.data(), in.state_begin_stride = stride(state_size_);
  if (multipliers_ > 0)
    in.multiplier = active_multipliers_.data(), in.multiplier_stride = stride(multipliers_);
  return in;
}

std::int32_t Contact::assemble(const Configuration& at, std::vector<double>& residual, SparseSystem* system,
                               std::size_t group, RigidCoupling* coupling, double& squared_force,
                               ents_report& report) {
  gather(at);
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
  std::vector<std::int32_t> each(active_.size());
  out.status = each.data(), out.status_stride = 1;
  const EntsLibrary& library = master_.model->library();
  std::int32_t status = library.evaluate(master_.model->get(), 0, stride(active_.size()), &in, &out, &report);
  if (status < 0) throw JobError("contact: " + describe(library, status, report));
  if (status != ENTS_OK) status = without_far(each, in, report);
  if (status != ENTS_OK) return status;

  squared_force = 0;
  std::vector<int> found(points_.size(), -1);
  for (std::size_t e = 0; e < active_.size(); ++e)
    if ((flags[e] & ENTS_FLAG_CONTACT) != 0)
      found[active_[e]] = 2 * segment_[active_[e]] + ((flags[e] & ENTS_FLAG_SLIP) != 0 ? 1 : 0);
  status_changes_ = switches_ = moves_ = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    status_changes_ += found[k] != found_[k];
    switches_ += (found[k] < 0) != (found_[k] < 0);
    moves_ += found[k] >= 0 && found_[k] >= 0 && found[k] / 2 != found_[k] / 2;
  }
  found_ = std::move(found);
  if (coupling != nullptr) {
    coupling->force = coupling->diagonal = 0;
    coupling->column.assign(residual.size(), 0.0);
    coupling->row.assign(residual.size(), 0.0);
  }
  Expanded nodal;
  for (std::size_t e = 0; e < active_.size(); ++e) {
    const std::size_t k = active_[e];
    if (each[e] != ENTS_OK) continue; // far: open
    std::copy_n(xi.begin() + offset(e * parameters_), parameters_, last_xi_.begin() + offset(k * parameters_));
    const double *R = force.data() + e * n, *K = tangent.empty() ? nullptr : tangent.data() + e * n * n;
    expand(k, R, K, nodal);
    const std::size_t all = nodal.residual.size();
    for (std::size_t a = 0; a < all; ++a) residual[unknown(e, a)] += nodal.residual[a];
    for (std::size_t i = 0; i < d_; ++i) squared_force += R[i] * R[i];
    if (system != nullptr) system->add(group, master_.rigid ? k : e, nodal.tangent.data());
    if (coupling == nullptr) continue;
    // Only the relative position of slave and master counts: moving the master is moving the slave point back.
    for (std::size_t i = 0; i < d_; ++i) {
      const double direction = master_.direction[i];
      coupling->force -= R[i] * direction;
      for (std::size_t j = 0; j < d_; ++j) coupling->diagonal += direction * K[j * n + i] * master_.direction[j];
      for (std::size_t a = 0; a < all; ++a) { // the weights of a point's nodes add to one
        double column = 0, row = 0;
        for (std::size_t b = 0; b < points_.nodes_per_point; ++b) {
          column += nodal.tangent[(b * d_ + i) * all + a];
          row += nodal.tangent[a * all + b * d_ + i];
        }
        coupling->column[unknown(e, a)] -= column * direction;
        coupling->row[unknown(e, a)] -= direction * row;
      }
    }
  }
  if (multipliers_ == 0) return ENTS_OK;
  std::vector<char> idle(points_.size(), 1);
  for (std::size_t e = 0; e < active_.size(); ++e) idle[active_[e]] = each[e] != ENTS_OK;
  for (std::size_t k = 0; k < points_.size(); ++k)
    for (std::size_t j = 0; idle[k] != 0 && j < multipliers_; ++j) { // lambda = 0, scaled like the others
      const std::size_t index = k * multipliers_ + j;
      const double slope = -points_.areas[k] / multiplier_scale(index);
      residual[static_cast<std::size_t>(dofs_->dofs()) + index] += slope * at.multiplier[index];
      if (system != nullptr) system->add(group + 1, index, &slope);
    }
  return ENTS_OK;
}

} // namespace host
