// SPDX-License-Identifier: BSD-3-Clause
// Contact: positions and the choice of segments.
#include "contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "output/table.hpp"

namespace host {
namespace {

/// A stiffness of the model's contact law; 1 where the law has none.
double stiffness_of(const Json& model, const char* law) {
  const Json found = find_json(model, ("/contact/" + std::string(law) + "/stiffness").c_str());
  return found.is_number() ? found.get<double>() : 1;
}

} // namespace

Contact::Contact(Master master, const ContactSpec& spec, const Mesh& mesh, const DofMap& dof_map,
                 SlavePoints points, CutSpec cut_spec, double thickness)
    : master_(std::move(master)), frame_(master_), mesh_(&mesh), dofs_(&dof_map), cut_(std::move(cut_spec)),
      points_(std::move(points)), thickness_(thickness), detector_(*master_.model) {
  const ents_layout& layout = master_.model->layout();
  d_ = static_cast<std::size_t>(layout.dimension);
  m_ = static_cast<std::size_t>(layout.nodes);
  parameters_ = static_cast<std::size_t>(layout.parameters);
  multipliers_ = static_cast<std::size_t>(layout.multipliers);
  state_size_ = static_cast<std::size_t>(layout.state_size);
  normal_stiffness_ = stiffness_of(spec.model, "normal");
  tangential_stiffness_ = stiffness_of(spec.model, "friction");
  const Json normal = find_json(spec.model, "/contact/normal/type");
  for (const char* law : {"dugdale", "separation", "lennard_jones", "cohesive"})
    pulls_ = pulls_ || normal == law;
  sliding_ = parameter_of(find_json(spec.model, "/contact/wear/sliding"));
  if (cut_.per_direction > 0) {
    cut_at_.displacement.assign(dofs(), 0.0);
    master_begin_ = master_points(cut_at_.displacement);
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
  const bool own = !points_.scales.empty(), scaled = spec.law_scale || own;
  const bool varies = turns || !wear_factor_.points.empty() || master_.profile || scaled;
  if (scaled) slave_numbers_ = 4;
  for (std::size_t k = 0; k < points_.size() && varies; ++k) {
    const auto place = points_.place(k, mesh);
    for (const double value : {own ? points_.offsets[k] : 0.0, 1.0, turns ? std::abs(place[0]) : 1.0})
      slave_values_.push_back(value);
    if (scaled) slave_values_.push_back(own ? points_.scales[k] : spec.law_scale(place[0], place[1]));
  }
  read_both_sides(spec);
  unknowns_ = {master_, points_, dofs()};
  master_begin_ = master_points(std::vector<double>(dofs(), 0.0));
  refuse_self_contact(spec);
  // Without the height both sides of a sheet are equally far from every slave.
  has_two_sides_ = has_two_sides(spec);
  if (!has_two_sides_ && master_.base) base_detector_ = std::make_unique<Detector>(*master_.base);
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

void Contact::refuse_self_contact(const ContactSpec& spec) const {
  if (master_.rigid || has_both_sides(spec)) return;
  const std::set<std::int64_t> of_master =
      master_.net ? master_.net->nodes_of_mesh()
                  : std::set<std::int64_t>(master_.connectivity.begin(), master_.connectivity.end());
  for (const int node : points_.nodes)
    if (of_master.count(node) != 0)
      throw InputError(spec.slave_where +
                       ": slave and master faces share nodes, and a node would find its own "
                       "segments; give the same set as slave and as master, for contact of a surface with "
                       "itself, or two sets that do not meet");
}

bool Contact::has_two_sides(const ContactSpec& spec) const {
  std::map<std::vector<std::int64_t>, std::vector<std::size_t>> of_nodes;
  for (std::size_t s = 0; s < master_.segments(); ++s) {
    std::vector<std::int64_t> nodes(master_.connectivity.begin() + stride(s * m_),
                                    master_.connectivity.begin() + stride((s + 1) * m_));
    std::sort(nodes.begin(), nodes.end());
    of_nodes[std::move(nodes)].push_back(s);
  }
  std::vector<double> nodes(m_ * d_), coordinates;
  const auto sample = [&](std::size_t s, const std::vector<double>& xi) {
    gather(stride(s), nodes);
    const std::size_t size = m_ * parameters_;
    if (!master_.surface_coordinates.empty())
      coordinates.assign(master_.surface_coordinates.begin() + stride(s * size),
                         master_.surface_coordinates.begin() + stride((s + 1) * size));
    return sample_surface(*master_.model, nodes, coordinates, xi);
  };
  const std::vector<double> centre(parameters_, master_.triangles ? 1. / 3 : 0.),
      xi = even_grid(static_cast<int>(parameters_), 4, master_.triangles);
  bool two_sides = false;
  for (const auto& [key, segments] : of_nodes)
    for (std::size_t i = 1; i < segments.size(); ++i) {
      // The segments of a smoothed ring of four have the same nodes, too, and lie side by side.
      const std::vector<double> first = sample(segments[0], centre).base_point,
                                other = sample(segments[i], centre).base_point;
      double apart = 0, size = 0;
      for (std::size_t c = 0; c < d_; ++c) {
        apart = std::max(apart, std::abs(first[c] - other[c]));
        for (std::size_t a = 0; a < m_; ++a) size = std::max(size, std::abs(nodes[a * d_ + c] - nodes[c]));
      }
      if (apart > 1e-9 * size) continue;
      two_sides = true;
      for (const double height : sample(segments[i], xi).height)
        if (!(height > 0))
          throw InputError(spec.model_where +
                           ": two segments of the master have the same nodes, a sheet without "
                           "thickness, and on which side of it a slave is cannot be told; give "
                           "it a \"height\" above 0: half its thickness");
    }
  return two_sides;
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

bool Contact::has_history() const { return (master_.model->layout().needs & ENTS_NEEDS_HISTORY) != 0; }

double Contact::multiplier_scale(std::size_t index) const {
  return index % multipliers_ == 0 ? normal_stiffness_ : tangential_stiffness_;
}

void Contact::place(const Configuration& at) {
  bind(at);
  slave_positions_ = slave_points(at);
  multiplier_values_ = at.multiplier;
  if (master_.rigid) return;
  master_positions_ = master_points(at.displacement);
}

std::vector<double> Contact::nodes_at(const std::vector<double>& displacement) const {
  std::vector<double> nodes = mesh_->coordinates;
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] += displacement[i];
  return nodes;
}

std::vector<double> Contact::positions(const std::vector<double>& displacement) const {
  std::vector<double> positions(points_.size() * d_);
  if (points_.heights.empty()) {
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const std::array<double, 3> place = points_.place(k, *mesh_),
                                  moved = points_.combine(k, displacement, d_);
      for (std::size_t i = 0; i < d_; ++i) positions[k * d_ + i] = place[i] + moved[i];
    }
    return positions;
  }
  std::vector<std::int64_t> begin, nodes;
  const ents_combination points = points_.combination(begin, nodes);
  const std::vector<double> at = nodes_at(displacement);
  const ents::Library& library = master_.model->library();
  auto report = ents_struct<ents_report>();
  const std::int32_t status = library.combine(&points, static_cast<std::int32_t>(d_), stride(at.size() / d_),
                                              at.data(), positions.data(), &report);
  if (status != ENTS_OK) throw JobError("slave_height: " + describe(library, status, report));
  return positions;
}

std::vector<double> Contact::slave_points(const Configuration& at) {
  std::vector<double> positions = this->positions(at.displacement);
  frame_.see(at, positions);
  return positions;
}

std::vector<double> Contact::master_points(const std::vector<double>& displacement) const {
  if (master_.rigid) return master_.positions;
  std::vector<double> nodes = nodes_at(displacement);
  if (!master_.net) return nodes;
  master_.net->check_held(displacement);
  return master_.net->positions(nodes);
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
  std::vector<double> slaves, normals;
  Projections at;
  for (const std::size_t k : gone) {
    const auto add = [&](const std::vector<double>& from, std::vector<double>& to) {
      if (!from.empty()) to.insert(to.end(), from.data() + k * d_, from.data() + (k + 1) * d_);
    };
    add(slave_positions_, slaves), add(slave_normals_, normals);
    at.segment.push_back(begin_at_.segment[k]);
    at.xi.insert(at.xi.end(), begin_at_.xi.data() + k * parameters_,
                 begin_at_.xi.data() + (k + 1) * parameters_);
  }
  Lost lost = detector_.find(where, slaves, normals, left_out_.of(gone), at);
  if (lost.slave >= 0) lost.slave = static_cast<std::int64_t>(gone[static_cast<std::size_t>(lost.slave)]);
  return lost;
}

bool Contact::choose(const Configuration& at, bool only_lost, ents_report& report) {
  const std::vector<std::int64_t> before = at_.segment;
  report.status = ENTS_OK;
  place(at);
  slave_normals_ = slave_normals(at);
  const ents_master_mesh where = mesh();
  const bool moved = !master_.rigid || !detector_.is_placed() || surface_changed_;
  surface_changed_ = false;
  if (moved) detector_.move(where);
  if (moved && base_detector_) base_detector_->move(where);
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (closed_[k] == 0 || (!only_lost && !master_.covers(at_.xi.data() + k * parameters_)))
      at_.segment[k] = -1;
  if (one_surface_)
    left_out_.slave_begin = slave_begin_.data(), left_out_.positions_begin = master_begin_.data();
  if (base_detector_) {
    // A search on a rough surface takes long, and finds points that are closer somewhere else, or two that
    // are equally close. The one straight ahead of the node is near its projection on the segment without the
    // height.
    Projections straight = at_;
    base_detector_->find(where, slave_positions_, slave_normals_, left_out_, straight);
    // A body may have turned on by several segments: a closed node is straight ahead of another one now.
    const bool may_jump = frame_.turns();
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (at_.segment[k] < 0 ||
          (may_jump && straight.segment[k] >= 0 && straight.segment[k] != at_.segment[k])) {
        at_.segment[k] = straight.segment[k];
        std::copy_n(straight.xi.data() + k * parameters_, parameters_, at_.xi.data() + k * parameters_);
      }
  }
  Lost lost = detector_.find(where, slave_positions_, slave_normals_, left_out_, at_);
  if (lost.slave < 0) lost = find_lost_since_begin(where);
  lost_.clear();
  lost_behind_edge_ = lost.behind_edge;
  if (lost.slave >= 0) {
    const std::vector<double> places = positions(at.displacement);
    std::string text;
    for (std::size_t i = 0; i < d_; ++i)
      text += (i > 0 ? ", " : "") + format_number(places[static_cast<std::size_t>(lost.slave) * d_ + i], 6);
    lost_ = "the slave node at (" + text + ") " +
            (lost.crossed       ? "passes through the surface within the increment"
             : lost.behind_edge ? "lies behind a concave edge between two segments and projects on neither"
                                : "was in contact and lies beside all segments of the master now");
  }
  if (at_.segment != before) move_history(report);
  return at_.segment != pattern_segment_;
}

void Contact::read_profile() {
  if (!master_.profile) return;
  std::map<std::int64_t, std::vector<std::size_t>> points; // of each segment
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (at_.segment[k] < 0)
      throw JobError("\"enrichment\": \"gap_only\": the slave point near node " +
                     std::to_string(points_.nodes[k * points_.nodes_per_point]) +
                     " is over no segment of the master at the beginning; let the master reach farther");
    points[at_.segment[k]].push_back(k);
  }
  std::vector<double> nodes(m_ * d_);
  for (const auto& [segment, found] : points) {
    gather(segment, nodes);
    const std::size_t size = m_ * parameters_, first = static_cast<std::size_t>(segment) * size;
    std::vector<double> coordinates, xi;
    if (!master_.surface_coordinates.empty())
      coordinates.assign(master_.surface_coordinates.data() + first,
                         master_.surface_coordinates.data() + first + size);
    for (const std::size_t k : found)
      xi.insert(xi.end(), at_.xi.data() + k * parameters_, at_.xi.data() + (k + 1) * parameters_);
    const SurfaceSample sample = sample_surface(*master_.profile, nodes, coordinates, xi);
    for (std::size_t i = 0; i < found.size(); ++i)
      slave_values_[slave_numbers_ * found[i]] = -sample.height[i];
  }
}

double Contact::largest_arm() const {
  double largest = slave_values_.empty() ? 1 : 0;
  for (std::size_t i = 2; i < slave_values_.size(); i += slave_numbers_)
    largest = std::max(largest, slave_values_[i]);
  return largest;
}

ents_input Contact::input(const ents_master_mesh& where) const {
  auto in = ents_struct<ents_input>();
  in.slave = slave_positions_.data(), in.slave_stride = stride(d_);
  in.mesh = &where;
  in.segment = at_.segment.data(), in.segment_stride = 1;
  in.start = at_.xi.data(), in.start_stride = stride(parameters_);
  in.area = points_.areas.data(), in.area_stride = 1;
  in.time_increment = time_increment_;
  if (state_size_ > 0) in.state_begin = state_in_.data(), in.state_begin_stride = stride(state_size_);
  if (multipliers_ > 0)
    in.multiplier = multiplier_values_.data(), in.multiplier_stride = stride(multipliers_);
  if (!slave_values_.empty())
    in.slave_values = slave_values_.data(), in.slave_values_stride = stride(slave_numbers_);
  return in;
}

} // namespace host
