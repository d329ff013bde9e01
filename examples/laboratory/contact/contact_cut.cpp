// SPDX-License-Identifier: BSD-3-Clause
// Contact: the slave's faces. Which way they look, and slave points that are cut anew where an increment begins, and
// stay within it.
#include <Eigen/Dense>

#include "contact.hpp"

namespace host {

SegmentCorners Contact::segment_corners() const {
  SegmentCorners result;
  const std::vector<double> line{-1, 1}, triangle{0, 0, 1, 0, 0, 1}, square{-1, -1, 1, -1, 1, 1, -1, 1};
  const std::vector<double>& corners = d_ == 2 ? line : master_.triangles ? triangle : square;
  result.corners = corners.size() / parameters_;
  std::vector<double> nodes(m_ * d_), coordinates;
  for (std::size_t s = 0; s < master_.segments(); ++s) {
    gather(static_cast<std::int64_t>(s), nodes);
    if (!master_.surface_coordinates.empty()) {
      const auto first =
          master_.surface_coordinates.begin() + static_cast<std::ptrdiff_t>(s * m_ * parameters_);
      coordinates.assign(first, first + static_cast<std::ptrdiff_t>(m_ * parameters_));
    }
    const SurfaceSample sample = sample_surface(*master_.model, nodes, coordinates, corners);
    result.points.insert(result.points.end(), sample.point.begin(), sample.point.end());
    result.normals.insert(result.normals.end(), sample.normal.begin(), sample.normal.end());
  }
  return result;
}

std::vector<double> Contact::slave_normals(const Configuration& at) {
  if (has_two_sides_) return {}; // a sheet has slaves on both
  std::vector<double> positions = nodes_at(at.displacement), result;
  frame_.see(at, positions);
  const auto owner = [&](int node) { return static_cast<std::size_t>(dofs_->representative(node)); };
  std::vector<Eigen::Vector3d> of_nodes(positions.size() / d_, Eigen::Vector3d::Zero());
  for (const Face& face : cut_.faces) {
    const auto way = [&](std::size_t from, std::size_t to) {
      Eigen::Vector3d vector = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < d_; ++i)
        vector[static_cast<int>(i)] = positions[static_cast<std::size_t>(face.nodes[to]) * d_ + i] -
                                      positions[static_cast<std::size_t>(face.nodes[from]) * d_ + i];
      return vector;
    };
    const Eigen::Vector3d area = d_ == 2           ? Eigen::Vector3d::UnitZ().cross(way(0, 1))
                                 : face.count == 3 ? way(0, 1).cross(way(0, 2))
                                                   : way(0, 2).cross(way(1, 3));
    for (int a = 0; a < face.count; ++a) of_nodes[owner(face.nodes[static_cast<std::size_t>(a)])] += area;
  }
  for (std::size_t k = 0; k < points_.size(); ++k) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t a = k * points_.nodes_per_point; a < (k + 1) * points_.nodes_per_point; ++a)
      normal += points_.weights[a] * of_nodes[owner(points_.nodes[a])];
    result.insert(result.end(), normal.data(), normal.data() + d_);
  }
  return result;
}

SlavePoints Contact::cut(const Configuration& at) {
  bind(at);
  std::vector<double> positions = nodes_at(at.displacement);
  frame_.see(at, positions);
  SlavePoints points =
      cut_points(*mesh_, cut_.faces, positions, segment_corners(), cut_.per_direction, cut_.geometry);
  if (cut_.surface) cut_.surface->raise(points);
  return points;
}

bool Contact::cut_again(const Configuration& begin) {
  if (!cuts_again() || (begin.displacement == cut_at_.displacement && begin.motion == cut_at_.motion &&
                        begin.parameters == cut_at_.parameters))
    return false;
  cut_at_ = begin;
  master_begin_ = master_points(begin.displacement);
  points_ = cut(begin);
  unknowns_ = {master_, points_, dofs()};
  reset_points();
  begin_increment(begin);
  auto report = ents_struct<ents_report>();
  choose(begin, false, report);
  accepted_ = fields(begin);
  state_begin_ = state_in_; // those of elements without history
  begin_at_ = at_;
  begin_increment(begin);
  pattern_segment_.clear();
  return true;
}

} // namespace host
