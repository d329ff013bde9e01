// SPDX-License-Identifier: BSD-3-Clause
// Structured blocks with graded grid lines, and faces.
#include "mesh.hpp"

#include <algorithm>
#include <set>

namespace host {
namespace {

/// Faces of the elements whose nodes all lie on one side.
std::vector<Face> faces_on(const ElementGroup& group, const std::vector<char>& on_side) {
  std::vector<Face> result;
  const ents_deck::Shape shape = traits(group.type).shape;
  for (std::size_t e = 0; e < group.size(); ++e)
    for (int f = 0; f < ents_deck::face_count(shape); ++f) {
      Face face;
      for (const int local : ents_deck::face_nodes(shape, f))
        face.nodes[static_cast<std::size_t>(face.count++)] =
            group.element(e)[static_cast<std::size_t>(local)];
      if (std::all_of(face.nodes.begin(), face.nodes.begin() + face.count,
                      [&](int node) { return on_side[static_cast<std::size_t>(node)] != 0; }))
        result.push_back(face);
    }
  return result;
}

} // namespace

void append_graded(GridLines& lines, double to, int divisions, double growth) {
  const double from = lines.back();
  // Cell sizes form a geometric progression whose sum is to - from.
  double sum = 0, size = 1;
  for (int i = 0; i < divisions; ++i, size *= growth) sum += size;
  double position = 0;
  size = 1;
  for (int i = 0; i + 1 < divisions; ++i, size *= growth) {
    position += size;
    lines.push_back(from + (to - from) * (position / sum));
  }
  lines.push_back(to);
}

void add_block(Mesh& mesh, const std::string& name, ElementType type, const std::vector<GridLines>& lines,
               int part) {
  const auto d = static_cast<std::size_t>(mesh.dimension);
  std::array<int, 3> points{1, 1, 1};
  for (std::size_t i = 0; i < d; ++i) points[i] = static_cast<int>(lines[i].size());
  const int first = mesh.node_count();
  const auto index = [&](int i, int j, int k) { return first + i + points[0] * (j + points[1] * k); };

  std::vector<int> all;
  std::array<std::vector<int>, 6> sides;
  for (int k = 0; k < points[2]; ++k)
    for (int j = 0; j < points[1]; ++j)
      for (int i = 0; i < points[0]; ++i) {
        const std::array<int, 3> position{i, j, k};
        for (std::size_t a = 0; a < d; ++a) {
          mesh.coordinates.push_back(lines[a][static_cast<std::size_t>(position[a])]);
          if (position[a] == 0) sides[2 * a].push_back(index(i, j, k));
          if (position[a] == points[a] - 1) sides[2 * a + 1].push_back(index(i, j, k));
        }
        all.push_back(index(i, j, k));
      }

  ElementGroup group;
  group.type = type;
  group.part = part;
  // Of each cell; tet4: Kuhn's six tetrahedra round the diagonal 0-6.
  static const std::map<ElementType, std::vector<std::size_t>> corners{
      {ElementType::tri3, {0, 1, 2, 0, 2, 3}},
      {ElementType::quad4, {0, 1, 2, 3}},
      {ElementType::tet4, {0, 1, 2, 6, 0, 2, 3, 6, 0, 3, 7, 6, 0, 7, 4, 6, 0, 4, 5, 6, 0, 5, 1, 6}},
      {ElementType::hex8, {0, 1, 2, 3, 4, 5, 6, 7}}};
  for (int k = 0; k < std::max(1, points[2] - 1); ++k)
    for (int j = 0; j + 1 < points[1]; ++j)
      for (int i = 0; i + 1 < points[0]; ++i) {
        const std::array<int, 8> c{
            index(i, j, k),     index(i + 1, j, k),     index(i + 1, j + 1, k),     index(i, j + 1, k),
            index(i, j, k + 1), index(i + 1, j, k + 1), index(i + 1, j + 1, k + 1), index(i, j + 1, k + 1)};
        for (const std::size_t corner : corners.at(type)) group.nodes.push_back(c[corner]);
      }

  static constexpr std::array<const char*, 6> side_names{"x_min", "x_max", "y_min",
                                                         "y_max", "z_min", "z_max"};
  std::vector<char> on_side(static_cast<std::size_t>(mesh.node_count()));
  for (std::size_t s = 0; s < 2 * d; ++s) {
    std::fill(on_side.begin(), on_side.end(), char{0});
    for (const int node : sides[s]) on_side[static_cast<std::size_t>(node)] = 1;
    mesh.face_sets[name + "." + side_names[s]] = faces_on(group, on_side);
    mesh.node_sets[name + "." + side_names[s]] = std::move(sides[s]);
  }
  mesh.node_sets[name] = std::move(all);
  mesh.groups.push_back(std::move(group));
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

} // namespace host
