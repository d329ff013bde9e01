// SPDX-License-Identifier: BSD-3-Clause
#include "slave_points.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "areas.hpp"
#include "scene.hpp"
#include "toolbox/error.hpp"

namespace host {

std::array<double, 3> SlavePoints::combine(std::size_t point, const std::vector<double>& field,
                                           std::size_t d) const {
  std::array<double, 3> sum{};
  for (std::size_t a = 0; a < nodes_per_point; ++a) {
    const std::size_t at = point * nodes_per_point + a;
    for (std::size_t i = 0; i < d; ++i)
      sum[i] += weights[at] * field[static_cast<std::size_t>(nodes[at]) * d + i];
  }
  return sum;
}

std::array<double, 3> SlavePoints::place(std::size_t point, const Mesh& mesh) const {
  return combine(point, mesh.coordinates, static_cast<std::size_t>(mesh.dimension));
}

ents_combination SlavePoints::combination(std::vector<std::int64_t>& begin,
                                          std::vector<std::int64_t>& of_nodes) const {
  begin.clear();
  for (std::size_t k = 0; k <= size(); ++k) begin.push_back(static_cast<std::int64_t>(k * nodes_per_point));
  of_nodes.assign(nodes.begin(), nodes.end());
  auto points = ents_struct<ents_combination>();
  points.points = static_cast<std::int64_t>(size());
  points.begin = begin.data(), points.nodes = of_nodes.data(), points.weights = weights.data();
  if (!heights.empty()) points.heights = heights.data(), points.slopes = slopes.data();
  return points;
}

SlaveSurface::SlaveSurface(const EntsLibrary& library, const ContactSpec& spec,
                           const std::filesystem::path& folder, const Mesh& mesh)
    : mesh_(&mesh), rule_(spec.slave_coordinates), where_(spec.slave_height_where),
      model_(library,
             Json{{"segment", mesh.dimension == 2 ? "line2" : "quad4"}, {"height", spec.slave_height}}.dump(),
             folder, where_) {}

std::vector<double> SlaveSurface::coordinates(const SlavePoints& points,
                                              const std::vector<std::int64_t>& nodes) const {
  return surface_coordinates(rule_, mesh_->dimension, mesh_->coordinates, nodes, points.nodes_per_point);
}

void SlaveSurface::raise(SlavePoints& points) const {
  points.heights.clear();
  std::vector<std::int64_t> begin, nodes;
  const ents_combination flat = points.combination(begin, nodes);
  const std::vector<double> places = coordinates(points, nodes);
  std::vector<double> heights(points.size()),
      slopes(nodes.size() * static_cast<std::size_t>(mesh_->dimension - 1));
  auto report = ents_struct<ents_report>();
  const std::int32_t status = model_.library().raise_points(
      model_.get(), &flat, places.empty() ? nullptr : places.data(), heights.data(), slopes.data(), &report);
  if (status != ENTS_OK) throw InputError(where_ + ": " + describe(model_.library(), status, report));
  points.heights = std::move(heights), points.slopes = std::move(slopes);
}

void SlaveSurface::take(const std::map<std::string, std::vector<double>>& fields) {
  model_.fields() = fields;
  model_.bind(model_.defaults());
}

void SlaveSurface::collect(const EntsModel& model, const SlavePoints& points, double thickness,
                           std::vector<double>& state) {
  auto& [name, block] = *model_.fields().begin();
  std::vector<std::int64_t> begin, nodes;
  const ents_combination flat = points.combination(begin, nodes);
  const std::vector<double> places = coordinates(points, nodes);
  auto report = ents_struct<ents_report>();
  const std::int32_t status = model.library().wear_collect_slave(
      model.get(), model_.get(), &flat, places.empty() ? nullptr : places.data(), mesh_->node_count(),
      mesh_->coordinates.data(), thickness, points.areas.data(), state.data(), model.layout().state_size,
      name.c_str(), block.data(), stride(block.size()), nullptr, &report);
  if (status != ENTS_OK) throw JobError("wear of the slave: " + describe(model.library(), status, report));
  model_.bind(model_.defaults());
}

SlavePoints slave_nodes(const Mesh& mesh, const DofMap& dofs, const std::vector<Face>& faces,
                        const SlaveGeometry& geometry) {
  const std::vector<int> nodes = nodes_of(faces);
  const std::vector<double> areas =
      tributary_areas(mesh, faces, nodes, geometry.thickness, geometry.axisymmetric);
  std::map<int, double> merged; // tied nodes are one node: it carries the areas of all
  for (std::size_t i = 0; i < nodes.size(); ++i) merged[dofs.representative(nodes[i])] += areas[i];
  SlavePoints points;
  for (const auto& [node, area] : merged) {
    points.nodes.push_back(node);
    points.weights.push_back(1);
    points.areas.push_back(area);
  }
  if (geometry.equal) {
    const double total = std::accumulate(points.areas.begin(), points.areas.end(), 0.);
    points.areas.assign(points.areas.size(), total / static_cast<double>(points.areas.size()));
  }
  return points;
}

std::size_t count_of_nodes(const std::vector<Face>& faces) {
  int count = 0;
  for (const Face& face : faces) count = std::max(count, face.count);
  return static_cast<std::size_t>(count);
}

SlavePoints sampling_points(const EntsLibrary& library, const Mesh& mesh, const std::vector<Face>& faces,
                            int per_direction, const SlaveGeometry& geometry, const std::string& where) {
  const std::size_t count = count_of_nodes(faces);
  const std::vector<std::int64_t> connectivity = connectivity_of(faces, count);
  const char* facet = mesh.dimension == 2 ? "line2" : (count == 3 ? "tri3" : "quad4");
  const auto n = static_cast<std::size_t>(per_direction), each = mesh.dimension == 2 ? n : n * n;
  SlavePoints points;
  points.nodes_per_point = count;
  std::vector<std::int64_t> begin(faces.size() * each + 1), nodes(faces.size() * each * count);
  points.weights.resize(nodes.size());
  points.areas.resize(faces.size() * each);
  auto report = ents_struct<ents_report>();
  const std::int32_t status = library.sampling_points(
      facet, per_direction, static_cast<std::int64_t>(faces.size()), connectivity.data(), mesh.node_count(),
      mesh.coordinates.data(), geometry.axisymmetric ? 0 : geometry.thickness, begin.data(), nodes.data(),
      points.weights.data(), points.areas.data(), &report);
  if (status != ENTS_OK) throw InputError(where + ": " + describe(library, status, report));
  points.nodes.assign(nodes.begin(), nodes.end());
  return points;
}

} // namespace host
