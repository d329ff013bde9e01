// SPDX-License-Identifier: BSD-3-Clause
#include "slave_points.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
#include <unordered_map>

#include <ents.h>

namespace ents_deck {
namespace {

/// Thickness of plane elements: of the *SOLID SECTION whose set has the element; 1 if it says none.
double thickness_of(const Mesh& mesh, int element) {
  for (const Statement& s : mesh.source.list) {
    if (s.keyword != "SOLID SECTION" || s.lines.empty()) continue;
    const int instance = mesh.elements[static_cast<std::size_t>(element)].instance;
    const std::string owner = instance == no_instance
                                  ? ""
                                  : canonical(mesh.instances[static_cast<std::size_t>(instance)].name) + ".";
    const auto set = mesh.element_sets.find(owner + canonical(s.value("ELSET")));
    if (set == mesh.element_sets.end() ||
        std::find(set->second.begin(), set->second.end(), element) == set->second.end())
      continue;
    double value = 0;
    const auto fields = fields_of(s.lines[0].text);
    if (!fields[0].empty() && parse(fields[0], value) && value > 0) return value;
  }
  return 1;
}

/// ccx makes a wedge of 2 degrees of an axisymmetric element; forces in its nodes are those of the wedge.
constexpr double ccx_wedge = 2.0 / 360;

/// ccx's shares of a face's area (tiefaccont.f). Those of quadratic faces are near the forces of a uniform
/// pressure, with corners that do not pull: the library's, in proportion to the integral of N^2, are not.
double ccx_share(Shape shape, std::size_t node) {
  switch (shape) {
  case Shape::tri3:
    return 1.0 / 3;
  case Shape::quad4:
    return 1.0 / 4;
  case Shape::tri6:
    return node < 3 ? 1.0 / 999 : 332.0 / 999;
  case Shape::quad8:
    return node < 4 ? 1.0 / 100 : 24.0 / 100;
  case Shape::line3:
    return node < 2 ? 1.0 / 6 : 4.0 / 6;
  default:
    return 1.0 / 2;
  }
}

bool is_quadratic(Shape shape) { return shape == Shape::tri6 || shape == Shape::quad8; }

/// Faces that are alike for the library: of one shape, with one area of a length.
struct Group {
  std::vector<int64_t> connectivity; ///< indices into the nodes of the slave
  std::vector<const Face*> faces;
  double thickness = 0; ///< as ents_tributary_areas takes it
  double share = 1;     ///< of its areas that the program takes
};

struct Groups {
  std::map<std::tuple<Shape, double, int>, Group>
      all;                                ///< by shape, thickness (below zero: axisymmetric), points
  std::unordered_map<int, int64_t> index; ///< of Mesh::nodes
  std::vector<double> positions;          ///< [nodes][d]
  std::size_t dimension = 3;
};

/// @param counts  points per direction of each face; empty: no matter
Groups groups_of(const Mesh& mesh, const Side& slave, const std::vector<int>& counts, Program program) {
  Groups out;
  out.dimension = !slave.faces.empty() && corner_count(slave.faces[0].shape) == 2 ? 2 : 3;
  for (std::size_t i = 0; i < slave.nodes.size(); ++i) {
    out.index.emplace(slave.nodes[i], static_cast<int64_t>(i));
    const Point& x = mesh.nodes[static_cast<std::size_t>(slave.nodes[i])].x;
    out.positions.insert(out.positions.end(), x.begin(),
                         x.begin() + static_cast<std::ptrdiff_t>(out.dimension));
  }
  for (std::size_t f = 0; f < slave.faces.size(); ++f) {
    const Face& face = slave.faces[f];
    const Kind kind = mesh.kind(face.element);
    const double width = kind == Kind::solid          ? 0
                         : kind == Kind::axisymmetric ? -1
                                                      : thickness_of(mesh, face.element);
    Group& group = out.all[{face.shape, width, counts.empty() ? 0 : counts[f]}];
    group.thickness = std::max(width, 0.0);
    group.share = kind == Kind::axisymmetric && program == Program::calculix ? ccx_wedge : 1;
    group.faces.push_back(&face);
    for (const int node : face.nodes) group.connectivity.push_back(out.index.at(node));
  }
  return out;
}

double flat_area(const Mesh& mesh, const Face& face) {
  const double whole = length(face_normal(mesh, face));
  return corner_count(face.shape) == 2 ? whole : whole / 2;
}

/// Areas of nodes on their own: what the deck's data lines say, else what the program takes.
void without_faces(const Mesh& mesh, const Side& slave, const Side& master, Program program,
                   std::vector<double>& areas, std::vector<std::string>& remarks) {
  std::vector<int> lonely;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (slave.areas[i] > 0 && program == Program::abaqus) areas[i] = slave.areas[i];
    if (!(areas[i] > 0)) lonely.push_back(slave.nodes[i]);
  }
  if (lonely.empty()) return;
  std::unordered_map<int, double> found;
  double of_master = 0;
  if (program == Program::calculix) {
    for (const Face& face : free_faces_at(mesh, lonely))
      for (std::size_t i = 0; i < face.nodes.size(); ++i)
        found[face.nodes[i]] += ccx_share(face.shape, i) * flat_area(mesh, face);
    for (const Face& face : master.faces)
      of_master += flat_area(mesh, face) / static_cast<double>(master.faces.size());
  }
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (areas[i] > 0) continue;
    const auto own = found.find(slave.nodes[i]);
    areas[i] = own != found.end() ? own->second : program == Program::abaqus ? 1 : of_master;
  }
  remarks.push_back(std::to_string(lonely.size()) + " slave nodes without faces of their own have the area " +
                    (program == Program::abaqus
                         ? "1, Abaqus's own default"
                         : "that ccx itself takes: shares of all free faces around them"));
}

} // namespace

std::vector<SlavePoint> slave_nodes(const Mesh& mesh, const Side& slave, const Side& master, Program program,
                                    std::vector<std::string>& remarks) {
  const Groups groups = groups_of(mesh, slave, {}, program);
  std::vector<double> areas(slave.nodes.size());
  for (const auto& [key, group] : groups.all) {
    const Shape shape = std::get<Shape>(key);
    if (is_quadratic(shape) && program == Program::calculix) {
      for (const Face* face : group.faces)
        for (std::size_t i = 0; i < face->nodes.size(); ++i)
          areas[static_cast<std::size_t>(groups.index.at(face->nodes[i]))] +=
              ccx_share(face->shape, i) * flat_area(mesh, *face);
      continue;
    }
    std::vector<double> part(areas.size());
    ents_report report{};
    report.struct_size = sizeof report;
    if (ents_tributary_areas(segment_name(shape), static_cast<int64_t>(group.faces.size()),
                             group.connectivity.data(), static_cast<int64_t>(areas.size()),
                             groups.positions.data(), group.thickness, part.data(), &report) != ENTS_OK)
      mesh.source.fail(slave.place, "areas of '" + slave.name + "': " + report.message);
    for (std::size_t i = 0; i < areas.size(); ++i) areas[i] += group.share * part[i];
  }
  without_faces(mesh, slave, master, program, areas, remarks);
  const std::vector<Point> normals = node_normals(mesh, slave);
  std::vector<SlavePoint> out;
  for (std::size_t i = 0; i < areas.size(); ++i)
    out.push_back({{slave.nodes[i]},
                   {1.0},
                   areas[i],
                   mesh.nodes[static_cast<std::size_t>(slave.nodes[i])].x,
                   normals[i]});
  return out;
}

std::vector<SlavePoint> points_in_faces(const Mesh& mesh, const Side& slave, const std::vector<int>& counts,
                                        Program program) {
  const Groups groups = groups_of(mesh, slave, counts, program);
  std::vector<SlavePoint> out;
  for (const auto& [key, group] : groups.all) {
    const Shape shape = std::get<Shape>(key);
    const int per_direction = std::get<int>(key);
    const std::size_t m = static_cast<std::size_t>(node_count(shape));
    const std::size_t per_face = corner_count(shape) == 2
                                     ? static_cast<std::size_t>(per_direction)
                                     : static_cast<std::size_t>(per_direction * per_direction);
    const std::size_t count = per_face * group.faces.size();
    std::vector<int64_t> begin(count + 1), nodes(count * m);
    std::vector<double> weights(count * m), areas(count);
    ents_report report{};
    report.struct_size = sizeof report;
    if (ents_sampling_points(segment_name(shape), per_direction, static_cast<int64_t>(group.faces.size()),
                             group.connectivity.data(), static_cast<int64_t>(slave.nodes.size()),
                             groups.positions.data(), group.thickness, begin.data(), nodes.data(),
                             weights.data(), areas.data(), &report) != ENTS_OK)
      mesh.source.fail(slave.place, "points of '" + slave.name + "': " + report.message);
    for (std::size_t i = 0; i < count; ++i) {
      SlavePoint point;
      const Face& face = *group.faces[i / per_face];
      point.normal = face_normal(mesh, face);
      const double size = length(point.normal);
      for (double& c : point.normal) c /= size;
      point.area = group.share * areas[i];
      for (auto k = static_cast<std::size_t>(begin[i]); k < static_cast<std::size_t>(begin[i + 1]); ++k) {
        point.nodes.push_back(slave.nodes[static_cast<std::size_t>(nodes[k])]);
        point.weights.push_back(weights[k]);
        for (std::size_t j = 0; j < 3; ++j)
          point.x[j] += weights[k] * mesh.nodes[static_cast<std::size_t>(point.nodes.back())].x[j];
      }
      out.push_back(std::move(point));
    }
  }
  return out;
}

std::string label_of(const Mesh& mesh, const SlavePoint& point) {
  if (point.nodes.size() == 1) return "slave node " + mesh.node_label(point.nodes[0]);
  std::string out = "the slave's point between nodes";
  for (const int node : point.nodes) out += ' ' + mesh.node_label(node);
  return out;
}

} // namespace ents_deck
