// SPDX-License-Identifier: BSD-3-Clause
#include "element_types.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace ents_deck {
namespace {

using Nodes = std::vector<int>;

/// Corners of faces as in the Abaqus Elements Guide, turned so that normals point out; nodes in the middle of
/// edges with the corners that they lie between.
struct Description {
  Shape shape, linear; ///< `linear`: the shape with the same corners and no middles
  int dimension, corners, vtk;
  std::vector<Nodes> faces;              ///< corners
  std::vector<std::array<int, 2>> edges; ///< edges[i] has the node corners + i
};

const std::vector<Nodes> tri_edges{{1, 0}, {2, 1}, {0, 2}}, quad_edges{{1, 0}, {2, 1}, {3, 2}, {0, 3}},
    tet_faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
    wedge_faces{{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
    hex_faces{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

const std::vector<Description> descriptions{
    {Shape::none, Shape::none, 0, 0, 0, {}, {}},
    {Shape::line2, Shape::line2, 1, 2, 3, {}, {}},
    {Shape::line3, Shape::line2, 1, 2, 21, {}, {{0, 1}}},
    {Shape::tri3, Shape::tri3, 2, 3, 5, tri_edges, {}},
    {Shape::tri6, Shape::tri3, 2, 3, 22, tri_edges, {{0, 1}, {1, 2}, {2, 0}}},
    {Shape::quad4, Shape::quad4, 2, 4, 9, quad_edges, {}},
    {Shape::quad8, Shape::quad4, 2, 4, 23, quad_edges, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
    {Shape::tet4, Shape::tet4, 3, 4, 10, tet_faces, {}},
    {Shape::tet10, Shape::tet4, 3, 4, 24, tet_faces, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}},
    {Shape::wedge6, Shape::wedge6, 3, 6, 13, wedge_faces, {}},
    {Shape::wedge15,
     Shape::wedge6,
     3,
     6,
     26,
     wedge_faces,
     {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}},
    {Shape::hex8, Shape::hex8, 3, 8, 12, hex_faces, {}},
    {Shape::hex20,
     Shape::hex8,
     3,
     8,
     25,
     hex_faces,
     {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}},
};

const Description& description(Shape shape) { return descriptions[static_cast<std::size_t>(shape)]; }

/// Faces with the middles of their sides, for all shapes.
std::vector<std::vector<Nodes>> complete_faces() {
  std::vector<std::vector<Nodes>> out;
  for (const Description& d : descriptions) {
    auto& faces = out.emplace_back(d.faces);
    if (d.edges.empty()) continue;
    for (Nodes& face : faces) {
      const std::size_t corners = face.size(), sides = corners == 2 ? 1 : corners;
      for (std::size_t i = 0; i < sides; ++i) {
        const int a = face[i], b = face[(i + 1) % corners];
        const auto edge = std::find_if(d.edges.begin(), d.edges.end(), [&](const auto& e) {
          return (e[0] == a && e[1] == b) || (e[0] == b && e[1] == a);
        });
        face.push_back(d.corners + static_cast<int>(edge - d.edges.begin()));
      }
    }
  }
  return out;
}

struct Family {
  std::string_view prefix;
  Kind kind;
  std::vector<std::pair<int, Shape>> shapes; ///< number in the name, shape
};

const std::vector<std::pair<int, Shape>> flat{
    {3, Shape::tri3}, {4, Shape::quad4}, {6, Shape::tri6}, {8, Shape::quad8}};
const std::vector<Family> families{
    // A longer prefix comes before a shorter one that it begins with.
    {"C3D",
     Kind::solid,
     {{4, Shape::tet4},
      {6, Shape::wedge6},
      {8, Shape::hex8},
      {10, Shape::tet10},
      {15, Shape::wedge15},
      {20, Shape::hex20}}},
    {"CPEG", Kind::plane_strain, flat},
    {"CPE", Kind::plane_strain, flat},
    {"CPS", Kind::plane_stress, flat},
    {"CAX", Kind::axisymmetric, flat},
    {"SFM3D", Kind::shell, flat},
    {"STRI", Kind::shell, {{3, Shape::tri3}, {65, Shape::tri6}}},
    {"SC", Kind::solid, {{6, Shape::wedge6}, {8, Shape::hex8}}},
    {"S", Kind::shell, flat},
    {"M3D", Kind::shell, flat},
    {"R3D", Kind::shell, flat},
    {"T2D", Kind::line, {{2, Shape::line2}}},
    {"T3D", Kind::line, {{2, Shape::line2}, {3, Shape::line3}}},
    {"B",
     Kind::line,
     {{21, Shape::line2},
      {22, Shape::line3},
      {23, Shape::line2},
      {31, Shape::line2},
      {32, Shape::line3},
      {33, Shape::line2}}},
};

} // namespace

Type type_of(std::string_view name) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  for (const Family& family : families) {
    if (!name.starts_with(family.prefix)) continue;
    std::size_t at = family.prefix.size();
    int number = 0;
    for (; at < name.size() && digit(name[at]) && number < 1000; ++at)
      number = 10 * number + (name[at] - '0');
    for (const auto& [wanted, shape] : family.shapes)
      if (number == wanted) return {std::string(name), shape, family.kind};
  }
  return {std::string(name), Shape::none, Kind::other};
}

int node_count(Shape shape) {
  return description(shape).corners + static_cast<int>(description(shape).edges.size());
}
int corner_count(Shape shape) { return description(shape).corners; }
int dimension(Shape shape) { return description(shape).dimension; }
int face_count(Shape shape) { return static_cast<int>(description(shape).faces.size()); }
int vtk_type(Shape shape) { return description(shape).vtk; }

std::span<const int> face_nodes(Shape shape, int face) {
  static const auto faces = complete_faces();
  return faces[static_cast<std::size_t>(shape)][static_cast<std::size_t>(face)];
}

Shape face_shape(Shape shape, int face) {
  switch (face_nodes(shape, face).size()) {
  case 2:
    return Shape::line2;
  case 3:
    return description(shape).dimension == 2 ? Shape::line3 : Shape::tri3;
  case 4:
    return Shape::quad4;
  case 6:
    return Shape::tri6;
  default:
    return Shape::quad8;
  }
}

const char* segment_name(Shape shape) {
  switch (shape) {
  case Shape::line2:
    return "line2";
  case Shape::line3:
    return "line3";
  case Shape::tri3:
    return "tri3";
  case Shape::tri6:
    return "tri6";
  case Shape::quad4:
    return "quad4";
  case Shape::quad8:
    return "quad8";
  default:
    return "";
  }
}

} // namespace ents_deck
