// SPDX-License-Identifier: BSD-3-Clause
// Contact: positions, choice of segments, and the library's elements in the host's equations.
#include "contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "output/table.hpp"

namespace host {
namespace {

std::int64_t stride(std::size_t value) { return static_cast<std::int64_t>(value); }

/// A stiffness of the model's contact law; 1 where the law has none.
double stiffness_of(const Json& model, const char* law) {
  const Json found = find_json(model, ("/contact/" + std::string(law) + "/stiffness").c_str());
  return found.is_number() ? found.get<double>() : 1;
}

} // namespace

Contact::Contact(Master master, const ContactSpec& spec, const Mesh& mesh, const DofMap& dof_map,
                 SlavePoints points, CutSpec cut_spec, double thickness)
    : master_(std::move(master)), mesh_(&mesh), dofs_(&dof_map), cut_(std::move(cut_spec)),
      points_(std::move(points)), thickness_(thickness), detector_(*master_.model) {
  const ents_layout& layout = master_.model->layout();
  d_ = static_cast<std::size_t>(layout.dimension);
  m_ = static_cast<std::size_t>(layout.nodes);
  parameters_ = static_cast<std::size_t>(layout.parameters);
  multipliers_ = static_cast<std::size_t>(layout.multipliers);
  state_size_ = static_cast<std::size_t>(layout.state_size);
  normal_stiffness_ = stiffness_of(spec.model, "normal");
  tangential_stiffness_ = stiffness_of(spec.model, "friction");
  sliding_ = parameter_of(find_json(spec.model, "/contact/wear/sliding"));
  if (master_.base) base_detector_ = std::make_unique<Detector>(*master_.base);
  if (cut_.per_direction > 0) {
    cut_at_.displacement.assign(dofs(), 0.0);
    begin_ = cut_at_;
    points_ = cut(cut_at_);
  }

  for (std::size_t i = 0; i < d_; ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const int node : points_.nodes) {
      low = std::min(low, mesh.node(node)[i]);
      high = std::max(high, mesh.node(node)[i]);
    }
    size_ = std::hypot(size_, high - low);
  }
  wear_factor_ = spec.wear_factor;
  const bool turns = d_ == 2 && thickness_ == 0 && sliding_ < master_.model->parameters().size();
  for (std::size_t k = 0; k < points_.size() && (turns || !wear_factor_.points.empty()); ++k)
    for (const double value : {0.0, 1.0, turns ? std::abs(points_.place(k, mesh)[0]) : 1.0})
      slave_values_.push_back(value);
  number_unknowns();
  // Detection takes a rigid segment without a normal for one that no slave projects on; those of bodies have
  // elements behind them.
  std::vector<double> nodes(m_ * d_);
  const std::vector<double> centre(parameters_, master_.triangles ? 1. / 3 : 0.);
  for (std::size_t s = 0; master_.rigid && s < master_.segments(); ++s) {
    gather(stride(s), nodes);
    sample_surface(*master_.model, nodes, std::vector<double>(m_ * parameters_), centre);
  }

  reset_points();
}

void Contact::reset_points() {
  at_.segment.assign(points_.size(), -1);
  at_.xi.assign(points_.size() * parameters_, 0.0);
  begin_at_ = at_;
  found_ = at_.segment;
  state_begin_.assign(points_.size() * state_size_, 0.0);
  accepted_.pressure.assign(points_.size(), 0.0);
  accepted_.traction.assign(points_.size() * d_, 0.0);
}

void Contact::number_unknowns() {
  dof_equations_.assign(dofs(), -1);
  for (auto* list : {&body_equations_, &point_begin_, &slave_equations_}) list->clear();
  unknowns_.clear();
  const auto add_node = [&](std::int64_t node) {
    for (std::size_t dof = static_cast<std::size_t>(node) * d_, i = 0; i < d_; ++i, ++dof)
      if (dof_equations_[dof] < 0) {
        dof_equations_[dof] = stride(unknowns_.size());
        unknowns_.push_back(dof);
      }
  };
  point_nodes_.assign(points_.nodes.begin(), points_.nodes.end());
  for (const std::int64_t node : point_nodes_) add_node(node);
  slave_dofs_ = unknowns_.size();
  for (std::size_t i = 0; !master_.rigid && i < master_.connectivity.size(); ++i)
    add_node(master_.connectivity[i]);
  if (master_.body_node >= 0) {
    add_node(master_.body_node), add_node(master_.body_node + 1);
    for (std::size_t i = 0; i < (d_ == 2 ? 3 : 6); ++i)
      body_equations_.push_back(dof_equations_[static_cast<std::size_t>(master_.body_node) * d_ + i]);
  }
  multiplier_equations_.resize(multiplier_count());
  for (std::size_t j = 0; j < multiplier_count(); ++j) {
    multiplier_equations_[j] = stride(unknowns_.size());
    unknowns_.push_back(dofs() + j);
  }
  for (std::size_t k = 0; k <= points_.size(); ++k)
    point_begin_.push_back(stride(k * points_.nodes_per_point));
  for (const std::int64_t node : point_nodes_)
    for (std::size_t i = 0; i < d_; ++i)
      slave_equations_.push_back(dof_equations_[static_cast<std::size_t>(node) * d_ + i]);
}

std::size_t Contact::parameter_of(const Json& name) const {
  const std::vector<std::string>& names = master_.model->parameters();
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

void Contact::bind(const Configuration& at) {
  if (at.parameters.empty()) return;
  std::vector<double> values = at.parameters;
  if (sliding_ < values.size()) values[sliding_] -= begin_.parameters[sliding_];
  if (values == bound_) return;
  master_.model->bind(values);
  for (std::size_t p = 0; p < values.size(); ++p)
    if (bound_.empty() || (p != sliding_ && values[p] != bound_[p])) surface_changed_ = true;
  bound_ = values;
}

double Contact::total_area() const {
  return std::accumulate(points_.areas.begin(), points_.areas.end(), 0.0);
}

bool Contact::has_history() const {
  const ents_layout& layout = master_.model->layout();
  return layout.friction != 0 || layout.augmentable != 0 || layout.worn >= 0;
}

double Contact::multiplier_scale(std::size_t index) const {
  return index % multipliers_ == 0 ? normal_stiffness_ : tangential_stiffness_;
}

std::array<double, 3> Contact::position_of(std::size_t k, const std::vector<double>& displacement) const {
  std::array<double, 3> position = points_.place(k, *mesh_);
  const std::array<double, 3> moved = points_.combine(k, displacement, d_);
  for (std::size_t i = 0; i < d_; ++i) position[i] += moved[i];
  return position;
}

// The displacements of a body's second node are its turns, of which one may differ from zero: the rotation
// vector, and its changes are the spin.
ents_pose Contact::pose_at(const Configuration& at) const {
  const EntsLibrary& library = master_.model->library();
  auto pose = ents_struct<ents_pose>();
  auto report = ents_struct<ents_report>();
  const double* moved = at.displacement.data() + static_cast<std::size_t>(master_.body_node) * d_;
  std::array<double, 3> point = master_.reference;
  for (std::size_t i = 0; i < d_; ++i) point[i] += moved[i];
  const auto d = static_cast<std::int32_t>(d_);
  if (library.pose_init(d, &pose, &report) != ENTS_OK ||
      library.pose_move(d, point.data(), moved + d_, &pose, &report) != ENTS_OK)
    throw JobError("the rigid body: " + describe(library, report.status, report));
  return pose;
}

void Contact::place(const Configuration& at) {
  bind(at);
  slave_positions_.resize(points_.size() * d_);
  for (std::size_t k = 0; k < points_.size(); ++k)
    std::copy_n(position_of(k, at.displacement).begin(), d_, slave_positions_.data() + k * d_);
  see_from_master(at, slave_positions_);
  multiplier_values_ = at.multiplier;
  if (master_.rigid) return;
  master_positions_ = mesh_->coordinates;
  for (std::size_t i = 0; i < master_positions_.size(); ++i) master_positions_[i] += at.displacement[i];
}

ents_master_mesh Contact::mesh() const {
  auto mesh = ents_struct<ents_master_mesh>();
  const std::vector<double>& positions = master_.rigid ? master_.positions : master_positions_;
  mesh.segments = stride(master_.segments());
  mesh.connectivity = master_.connectivity.data();
  mesh.nodes = stride(positions.size() / d_);
  mesh.positions = positions.data();
  if (!master_.surface_coordinates.empty()) mesh.surface_coordinates = master_.surface_coordinates.data();
  return mesh;
}

Lost Contact::find_lost_since_begin(const ents_master_mesh& where) const {
  std::vector<std::size_t> gone;
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (at_.segment[k] < 0 && begin_at_.segment[k] >= 0 && accepted_.pressure[k] != 0) gone.push_back(k);
  if (gone.empty()) return {};
  std::vector<double> slaves;
  Projections at;
  for (const std::size_t k : gone) {
    slaves.insert(slaves.end(), slave_positions_.data() + k * d_, slave_positions_.data() + (k + 1) * d_);
    at.segment.push_back(begin_at_.segment[k]);
    at.xi.insert(at.xi.end(), begin_at_.xi.data() + k * parameters_,
                 begin_at_.xi.data() + (k + 1) * parameters_);
  }
  Lost lost = detector_.find(where, slaves, at);
  if (lost.slave >= 0) lost.slave = static_cast<std::int64_t>(gone[static_cast<std::size_t>(lost.slave)]);
  return lost;
}

bool Contact::choose(const Configuration& at, bool only_lost, ents_report& report) {
  const std::vector<std::int64_t> before = at_.segment;
  report.status = ENTS_OK;
  place(at);
  const ents_master_mesh where = mesh();
  const bool moved = !master_.rigid || !detector_.is_placed() || surface_changed_;
  surface_changed_ = false;
  if (moved) detector_.move(where);
  if (moved && base_detector_) base_detector_->move(where);
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (closed_[k] == 0 || (!only_lost && !master_.covers(at_.xi.data() + k * parameters_)))
      at_.segment[k] = -1;
  if (base_detector_) {
    // A search on a rough surface takes long, and finds points that are closer somewhere else, or two that
    // are equally close. The one straight ahead of the node is near its projection on the segment without the
    // height.
    Projections straight = at_;
    base_detector_->find(where, slave_positions_, straight);
    // A body may have turned on by several segments: a closed node is straight ahead of another one now.
    const bool may_jump = master_.body_node >= 0;
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (at_.segment[k] < 0 ||
          (may_jump && straight.segment[k] >= 0 && straight.segment[k] != at_.segment[k])) {
        at_.segment[k] = straight.segment[k];
        std::copy_n(straight.xi.data() + k * parameters_, parameters_, at_.xi.data() + k * parameters_);
      }
  }
  Lost lost = detector_.find(where, slave_positions_, at_);
  if (lost.slave < 0) lost = find_lost_since_begin(where);
  lost_.clear();
  lost_behind_edge_ = lost.behind_edge;
  if (lost.slave >= 0) {
    const std::array<double, 3> position = position_of(static_cast<std::size_t>(lost.slave), at.displacement);
    std::string text;
    for (std::size_t i = 0; i < d_; ++i) text += (i > 0 ? ", " : "") + format_number(position[i], 6);
    lost_ = "the slave node at (" + text + ") " +
            (lost.behind_edge ? "lies behind a concave edge between two segments and projects on neither"
                              : "was in contact and lies beside all segments of the master now");
  }
  if (at_.segment != before) move_history(report);
  return at_.segment != pattern_segment_;
}

void Contact::build_tangent() {
  pattern_segment_ = at_.segment;
  StencilGroup elements, open; // an element without a segment: the multipliers alone
  const std::size_t q = points_.nodes_per_point;
  elements.dofs =
      static_cast<int>((q + (master_.rigid ? 0 : m_)) * d_ + multipliers_ + body_equations_.size());
  open.dofs = static_cast<int>(multipliers_);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    StencilGroup& group = master_.rigid || at_.segment[k] >= 0 ? elements : open;
    const auto add_node = [&](std::int64_t node) {
      for (std::size_t i = 0; i < d_; ++i)
        group.equations.push_back(static_cast<int>(dof_equations_[static_cast<std::size_t>(node) * d_ + i]));
    };
    for (std::size_t a = 0; a < q && &group == &elements; ++a) add_node(point_nodes_[k * q + a]);
    for (std::size_t a = 0; !master_.rigid && a < m_ && &group == &elements; ++a)
      add_node(master_.connectivity[static_cast<std::size_t>(at_.segment[k]) * m_ + a]);
    for (std::size_t j = 0; j < multipliers_; ++j)
      group.equations.push_back(static_cast<int>(multiplier_equations_[k * multipliers_ + j]));
    for (const std::int64_t equation : body_equations_) group.equations.push_back(static_cast<int>(equation));
  }
  const StencilGroup* const groups[] = {&elements, &open};
  tangent_ =
      pattern_of(static_cast<int>(unknowns_.size()), false, std::span(groups, multipliers_ > 0 ? 2 : 1));
  if (points_.are_nodes()) places_.assign(points_.size() * (d_ * (m_ + 1) * (m_ + 1) + 1), 0);
}

double Contact::largest_arm() const {
  double largest = slave_values_.empty() ? 1 : 0;
  for (std::size_t i = 2; i < slave_values_.size(); i += 3) largest = std::max(largest, slave_values_[i]);
  return largest;
}

ents_input Contact::input(const ents_master_mesh& where) const {
  auto in = ents_struct<ents_input>();
  in.slave = slave_positions_.data(), in.slave_stride = stride(d_);
  in.mesh = &where;
  in.segment = at_.segment.data(), in.segment_stride = 1;
  in.start = at_.xi.data(), in.start_stride = stride(parameters_);
  in.area = points_.areas.data(), in.area_stride = 1;
  if (state_size_ > 0) in.state_begin = state_in_.data(), in.state_begin_stride = stride(state_size_);
  if (multipliers_ > 0)
    in.multiplier = multiplier_values_.data(), in.multiplier_stride = stride(multipliers_);
  if (!slave_values_.empty()) in.slave_values = slave_values_.data(), in.slave_values_stride = 3;
  return in;
}

std::int32_t Contact::add_elements(const ents_output& out, ents_system system, ents_report& report) {
  static constexpr std::int64_t none[6] = {-1, -1, -1, -1, -1, -1};
  if (master_.body_node >= 0) {
    system.pose = &pose_;
    if (system.body_equations == nullptr) system.body_equations = none;
  }
  const EntsLibrary& library = master_.model->library();
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
  std::vector<double> force(unknowns_.size());
  auto out = ents_struct<ents_output>();
  out.wanted = ENTS_FLAGS;
  out.flags = flags.data(), out.flags_stride = 1;
  if (state_size_ > 0) {
    out.wanted |= ENTS_STATE;
    out.state_end = state_out_.data(), out.state_end_stride = stride(state_size_);
  }
  auto points = ents_struct<ents_combination>();
  auto system = ents_struct<ents_system>();
  system.index_size = sizeof(int);
  system.slave_nodes = points_.are_nodes() ? count() : mesh_->node_count();
  system.slave_equations = points_.are_nodes() ? slave_equations_.data() : dof_equations_.data();
  if (points_.are_nodes()) {
    system.places = places_.data(), system.places_size = stride(places_.size() / points_.size());
  } else {
    points.points = count();
    points.begin = point_begin_.data(), points.nodes = point_nodes_.data(),
    points.weights = points_.weights.data();
    system.slave = &points;
  }
  system.master_nodes = mesh_->node_count(), system.master_equations = dof_equations_.data();
  system.multiplier_equations = multiplier_equations_.data();
  if (!body_equations_.empty()) system.body_equations = body_equations_.data();
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
  squared_force = 0;
  for (std::size_t i = 0; i < slave_dofs_; ++i) squared_force += force[i] * force[i];
  if (coupling != nullptr) {
    coupling->column.assign(residual.size(), 0.0);
    coupling->row.assign(residual.size(), 0.0);
    couple(force, *coupling);
  }
  for (std::size_t i = 0; i < force.size(); ++i) residual[unknowns_[i]] += force[i];
  return ENTS_OK;
}

void Contact::add_tangent_times(const std::vector<double>& direction, std::vector<double>& residual) const {
  for (std::size_t i = 0; i < unknowns_.size(); ++i)
    for (int at = tangent_.outerIndexPtr()[i]; at < tangent_.outerIndexPtr()[i + 1]; ++at)
      if (const std::size_t j = unknowns_[static_cast<std::size_t>(tangent_.innerIndexPtr()[at])];
          j < direction.size())
        residual[unknowns_[i]] += tangent_.valuePtr()[at] * direction[j];
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
void Contact::couple(const std::vector<double>& force, RigidCoupling& coupling) const {
  coupling.force = coupling.diagonal = 0;
  std::vector<double> direction(force.size(), 0.0);
  for (std::size_t i = 0; i < slave_dofs_; ++i) direction[i] = master_.direction[i % d_];
  for (std::size_t i = 0; i < force.size(); ++i) {
    coupling.force -= force[i] * direction[i];
    for (int at = tangent_.outerIndexPtr()[i]; at < tangent_.outerIndexPtr()[i + 1]; ++at) {
      const auto j = static_cast<std::size_t>(tangent_.innerIndexPtr()[at]);
      const double value = tangent_.valuePtr()[at];
      coupling.column[unknowns_[i]] -= value * direction[j];
      coupling.row[unknowns_[j]] -= direction[i] * value;
      coupling.diagonal += direction[i] * value * direction[j];
    }
  }
}

} // namespace host
