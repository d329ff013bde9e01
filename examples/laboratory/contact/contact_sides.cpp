// SPDX-License-Identifier: BSD-3-Clause
#include "contact_sides.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

namespace host {

ContactSides::ContactSides(Master of_scene, const Mesh& mesh, const DofMap& dof_map, SlavePoints given,
                           CutSpec cut_spec, const Json& sliding)
    : master(std::move(of_scene)), frame(master), bodies(&mesh), dofs(&dof_map), cut(std::move(cut_spec)),
      points(std::move(given)), d(static_cast<std::size_t>(layout().dimension)),
      m(static_cast<std::size_t>(layout().nodes)), parameters(static_cast<std::size_t>(layout().parameters)),
      multipliers(static_cast<std::size_t>(layout().multipliers)),
      state_size(static_cast<std::size_t>(layout().state_size)) {
  const std::vector<std::string>& names = master.model->parameters();
  sliding_ = static_cast<std::size_t>(std::find(names.begin(), names.end(), sliding) - names.begin());
  Configuration undeformed;
  undeformed.displacement.assign(mesh_dofs(), 0.0);
  master_begin = master_points(undeformed.displacement);
  if (cut.per_direction > 0) cut_points_at(undeformed, true);
  for (std::size_t i = 0; i < d; ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const int node : points.nodes) {
      low = std::min(low, mesh.node(node)[i]);
      high = std::max(high, mesh.node(node)[i]);
    }
    size = std::hypot(size, high - low);
  }
}

void ContactSides::begin_increment(const Configuration& at, bool slaves) {
  begin = at;
  master_begin = master_points(at.displacement);
  if (slaves) slave_begin = slave_points(at);
}

void ContactSides::bind(const Configuration& at) {
  if (at.parameters.empty()) return;
  std::vector<double> values = at.parameters;
  if (sliding_ < values.size()) values[sliding_] -= begin.parameters[sliding_];
  if (values == bound_) return;
  master.model->bind(values);
  for (std::size_t p = 0; p < values.size(); ++p)
    if (bound_.empty() || (p != sliding_ && values[p] != bound_[p])) ++surface_changes_;
  bound_ = values;
}

void ContactSides::place(const Configuration& at) {
  bind(at);
  slave_now = slave_points(at);
  multiplier_now = at.multiplier;
  if (!master.rigid) master_now = master_points(at.displacement);
}

double ContactSides::slid() const {
  return slides() ? begin.parameters[sliding_] - master.model->defaults()[sliding_] : 0;
}

ents_master_mesh ContactSides::mesh() const {
  auto mesh = ents_struct<ents_master_mesh>();
  const std::vector<double>& positions = master.rigid ? master.positions : master_now;
  mesh.segments = stride(master.segments());
  mesh.connectivity = master.connectivity.data();
  mesh.nodes = stride(positions.size() / d);
  mesh.positions = positions.data();
  if (!master.surface_coordinates.empty()) mesh.surface_coordinates = master.surface_coordinates.data();
  return mesh;
}

void ContactSides::set_master(ents_system& system, ents_combination& net,
                              const std::vector<std::int64_t>& equations) const {
  system.master_nodes = master.net ? master.net->all_nodes() : bodies->node_count();
  system.master_equations = equations.data();
  if (!master.net) return;
  net = master.net->combination();
  system.master = &net;
}

void ContactSides::gather(std::int64_t segment, std::vector<double>& positions) const {
  for (std::size_t a = 0; a < m; ++a)
    for (std::size_t i = 0; i < d; ++i) {
      const auto at =
          static_cast<std::size_t>(master.connectivity[static_cast<std::size_t>(segment) * m + a]) * d + i;
      positions[a * d + i] = master_begin[at];
    }
}

const double* ContactSides::coordinates(std::int64_t segment) const {
  return master.surface_coordinates.empty()
             ? nullptr
             : master.surface_coordinates.data() + static_cast<std::size_t>(segment) * m * parameters;
}

SurfaceSample ContactSides::sample(const EntsModel& model, std::int64_t segment,
                                   const std::vector<double>& xi) const {
  std::vector<double> nodes(m * d), of_nodes;
  gather(segment, nodes);
  if (const double* first = coordinates(segment)) of_nodes.assign(first, first + m * parameters);
  return sample_surface(model, nodes, of_nodes, xi);
}

std::vector<double> ContactSides::nodes_at(const std::vector<double>& displacement) const {
  std::vector<double> nodes = bodies->coordinates;
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] += displacement[i];
  return nodes;
}

std::vector<double> ContactSides::positions(const std::vector<double>& displacement) const {
  std::vector<double> positions(points.size() * d);
  if (points.heights.empty()) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      const std::array<double, 3> place = points.place(k, *bodies),
                                  moved = points.combine(k, displacement, d);
      for (std::size_t i = 0; i < d; ++i) positions[k * d + i] = place[i] + moved[i];
    }
    return positions;
  }
  std::vector<std::int64_t> first, nodes;
  const ents_combination combination = points.combination(first, nodes);
  const std::vector<double> at = nodes_at(displacement);
  auto report = ents_struct<ents_report>();
  const std::int32_t status = library().combine(&combination, static_cast<std::int32_t>(d),
                                                stride(at.size() / d), at.data(), positions.data(), &report);
  if (status != ENTS_OK) throw JobError("slave_height: " + describe(library(), status, report));
  return positions;
}

std::vector<double> ContactSides::slave_points(const Configuration& at) {
  std::vector<double> seen = positions(at.displacement);
  frame.see(at, seen);
  return seen;
}

std::vector<double> ContactSides::master_points(const std::vector<double>& displacement) const {
  if (master.rigid) return master.positions;
  std::vector<double> nodes = nodes_at(displacement);
  if (!master.net) return nodes;
  master.net->check_held(displacement);
  return master.net->positions(nodes);
}

std::vector<double> ContactSides::slave_normals(const Configuration& at) {
  std::vector<double> positions = nodes_at(at.displacement), result;
  frame.see(at, positions);
  const auto owner = [&](int node) { return static_cast<std::size_t>(dofs->representative(node)); };
  std::vector<Eigen::Vector3d> of_nodes(positions.size() / d, Eigen::Vector3d::Zero());
  for (const Face& face : cut.faces) {
    const auto way = [&](std::size_t from, std::size_t to) {
      Eigen::Vector3d vector = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < d; ++i)
        vector[static_cast<int>(i)] = positions[static_cast<std::size_t>(face.nodes[to]) * d + i] -
                                      positions[static_cast<std::size_t>(face.nodes[from]) * d + i];
      return vector;
    };
    const Eigen::Vector3d area = d == 2            ? Eigen::Vector3d::UnitZ().cross(way(0, 1))
                                 : face.count == 3 ? way(0, 1).cross(way(0, 2))
                                                   : way(0, 2).cross(way(1, 3));
    for (int a = 0; a < face.count; ++a) of_nodes[owner(face.nodes[static_cast<std::size_t>(a)])] += area;
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t a = k * points.nodes_per_point; a < (k + 1) * points.nodes_per_point; ++a)
      normal += points.weights[a] * of_nodes[owner(points.nodes[a])];
    result.insert(result.end(), normal.data(), normal.data() + d);
  }
  return result;
}

SegmentCorners ContactSides::segment_corners() const {
  SegmentCorners result;
  const std::vector<double> line{-1, 1}, triangle{0, 0, 1, 0, 0, 1}, square{-1, -1, 1, -1, 1, 1, -1, 1};
  const std::vector<double>& corners = d == 2 ? line : master.triangles ? triangle : square;
  result.corners = corners.size() / parameters;
  for (std::size_t s = 0; s < master.segments(); ++s) {
    const SurfaceSample found = sample(*master.model, stride(s), corners);
    result.points.insert(result.points.end(), found.point.begin(), found.point.end());
    result.normals.insert(result.normals.end(), found.normal.begin(), found.normal.end());
  }
  return result;
}

bool ContactSides::cut_points_at(const Configuration& at, bool again) {
  if (!again && at.displacement == cut_at_.displacement && at.motion == cut_at_.motion &&
      at.parameters == cut_at_.parameters)
    return false;
  cut_at_ = at;
  master_begin = master_points(at.displacement);
  bind(at);
  std::vector<double> nodes = nodes_at(at.displacement);
  frame.see(at, nodes);
  points = cut_points(*bodies, cut.faces, nodes, segment_corners(), cut.per_direction, cut.geometry);
  if (cut.surface) cut.surface->raise(points);
  return true;
}

} // namespace host
