// SPDX-License-Identifier: BSD-3-Clause
#include "mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Geometry>

#include "error.hpp"
#include "inp.hpp"

namespace host {

void add_deck(Mesh& mesh, const std::string& name, const std::filesystem::path& file,
              const std::string& element_set, int part) {
  try {
    const inp::Deck deck = inp::read(file);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const std::vector<int> body = inp::body(deck, element_set);
    if (inp::dimension(deck) != mesh.dimension)
      throw InputError(file.string() + ": the body has dimension " + std::to_string(inp::dimension(deck)) +
                       ", the scene " + std::to_string(mesh.dimension));
    // A mesher leaves nodes behind that no element of the body uses; they must not become unknowns.
    std::vector<int> number(deck.coordinates.size(), -1);
    std::map<ElementType, ElementGroup> groups;
    std::vector<int> all;
    for (const int index : body) {
      const inp::Element& element = deck.elements[static_cast<std::size_t>(index)];
      static const std::map<inp::Shape, ElementType> types{{inp::Shape::tri3, ElementType::tri3},
                                                           {inp::Shape::quad4, ElementType::quad4},
                                                           {inp::Shape::tet4, ElementType::tet4},
                                                           {inp::Shape::hex8, ElementType::hex8},
                                                           {inp::Shape::wedge6, ElementType::hex8}};
      // A wedge is a brick of which two edges are points.
      constexpr std::array<std::size_t, 8> of_wedge{0, 1, 2, 2, 3, 4, 5, 5};
      const ElementType type = types.at(element.shape);
      ElementGroup& group = groups[type];
      group.type = type;
      group.part = part;
      for (int a = 0; a < node_count(type); ++a) {
        const auto corner = static_cast<std::size_t>(a);
        const auto node = static_cast<std::size_t>(
            element.nodes[element.shape == inp::Shape::wedge6 ? of_wedge[corner] : corner]);
        if (number[node] < 0) {
          number[node] = mesh.node_count();
          all.push_back(number[node]);
          for (std::size_t i = 0; i < d; ++i) mesh.coordinates.push_back(deck.coordinates[node][i]);
        }
        group.nodes.push_back(number[node]);
      }
    }
    for (auto& [type, group] : groups) mesh.groups.push_back(std::move(group));
    mesh.node_sets[name] = std::move(all);

    std::set<std::string> names;
    for (const auto& [key, value] : deck.node_sets) names.insert(key);
    for (const auto& [key, value] : deck.element_sets) names.insert(key);
    for (const auto& [key, value] : deck.surfaces) names.insert(key);
    for (const std::string& key : names) {
      std::vector<int>& nodes = mesh.node_sets[name + "." + key];
      for (const int node : inp::nodes_of(deck, key))
        if (number[static_cast<std::size_t>(node)] >= 0)
          nodes.push_back(number[static_cast<std::size_t>(node)]);
      std::vector<Face> faces;
      try {
        for (const inp::Face& face : inp::faces_of(deck, key)) {
          Face mine;
          mine.count = face.count;
          for (int a = 0; a < face.count; ++a)
            mine.nodes[static_cast<std::size_t>(a)] =
                number[static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(a)])];
          if (std::none_of(mine.nodes.begin(), mine.nodes.begin() + face.count, [](int n) { return n < 0; }))
            faces.push_back(mine);
        }
      } catch (const inp::Error&) {
        continue; // a set that is no part of the boundary has nodes, but no faces
      }
      if (!faces.empty()) mesh.face_sets[name + "." + key] = std::move(faces);
    }
  } catch (const inp::Error& error) {
    throw InputError(error.what());
  }
}

std::vector<int> nodes_of(const std::vector<Face>& faces) {
  std::set<int> nodes;
  for (const Face& face : faces) nodes.insert(face.nodes.begin(), face.nodes.begin() + face.count);
  return {nodes.begin(), nodes.end()};
}

std::vector<std::int64_t> connectivity_of(const std::vector<Face>& faces, std::size_t count) {
  std::vector<std::int64_t> out;
  for (const Face& face : faces)
    for (int a = 0; a < static_cast<int>(count); ++a)
      out.push_back(face.nodes[static_cast<std::size_t>(std::min(a, face.count - 1))]);
  return out;
}

std::vector<double> tributary_areas(const Mesh& mesh, const std::vector<Face>& faces,
                                    const std::vector<int>& nodes, double thickness, bool axisymmetric) {
  std::map<int, std::size_t> position;
  for (std::size_t i = 0; i < nodes.size(); ++i) position[nodes[i]] = i;
  std::vector<double> areas(nodes.size(), 0.0);
  const auto add = [&](int node, double area) { areas[position.at(node)] += area; };
  const double g = 1 / std::sqrt(3.);
  for (const Face& face : faces) {
    std::array<Eigen::Vector3d, 4> x;
    for (std::size_t a = 0; a < static_cast<std::size_t>(face.count); ++a) {
      const auto place = mesh.node(face.nodes[a]);
      x[a] = {place[0], place[1], mesh.dimension == 3 ? place[2] : 0};
    }
    if (face.count == 2) {
      const double length = (x[1] - x[0]).norm();
      for (const double xi : {-g, g}) { // two points: exact for N r, a quadratic
        const double radius = 0.5 * ((1 - xi) * x[0][0] + (1 + xi) * x[1][0]);
        const double weight = 0.5 * length * (axisymmetric ? 2 * std::numbers::pi * radius : thickness);
        add(face.nodes[0], weight * 0.5 * (1 - xi));
        add(face.nodes[1], weight * 0.5 * (1 + xi));
      }
    } else if (face.count == 3) {
      const double area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm();
      for (std::size_t a = 0; a < 3; ++a) add(face.nodes[a], area / 3);
    } else {
      for (const double xi : {-g, g})
        for (const double eta : {-g, g}) {
          const auto point = detail::multilinear<4, 2>({xi, eta, 0}, 1);
          Eigen::Vector3d first = Eigen::Vector3d::Zero(), second = Eigen::Vector3d::Zero();
          for (int a = 0; a < 4; ++a) {
            first += point.derivatives(a, 0) * x[static_cast<std::size_t>(a)];
            second += point.derivatives(a, 1) * x[static_cast<std::size_t>(a)];
          }
          const double weight = first.cross(second).norm();
          for (int a = 0; a < 4; ++a) add(face.nodes[static_cast<std::size_t>(a)], weight * point.values[a]);
        }
    }
  }
  return areas;
}

} // namespace host
