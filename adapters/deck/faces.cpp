// SPDX-License-Identifier: BSD-3-Clause
#include "faces.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <unordered_map>

namespace ents_deck {
namespace {

using Key = std::vector<int>; ///< sorted corners: equal for two faces with the same ones

Face face_at(const Mesh& mesh, int e, int f) {
  const Element& element = mesh.elements[static_cast<std::size_t>(e)];
  const Shape shape = mesh.shape(e);
  Face out{e, f, Shape::none, {}};
  if (mesh.kind(e) == Kind::shell) { // the element itself, or turned round
    out.shape = shape;
    out.nodes = element.nodes;
    if (f == 1) {
      const auto corners = static_cast<std::ptrdiff_t>(corner_count(shape));
      std::reverse(out.nodes.begin() + 1, out.nodes.begin() + corners);
      std::reverse(out.nodes.begin() + corners, out.nodes.end());
    }
    return out;
  }
  out.shape = face_shape(shape, f);
  for (const int local : face_nodes(shape, f))
    out.nodes.push_back(element.nodes[static_cast<std::size_t>(local)]);
  return out;
}

Key key_of(const Face& face) {
  Key key(face.nodes.begin(), face.nodes.begin() + corner_count(face.shape));
  std::sort(key.begin(), key.end());
  return key;
}

bool is_body(Kind kind) {
  return kind == Kind::solid || kind == Kind::plane_stress || kind == Kind::plane_strain ||
         kind == Kind::axisymmetric;
}

/// Where solids are, elements in the plane are no bodies: meshers mark boundaries with them.
int body_dimension(const Mesh& mesh) {
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (mesh.kind(static_cast<int>(e)) == Kind::solid) return 3;
  return 2;
}

/// Faces of bodies with all nodes, or with one, among `nodes`, those between two elements left out.
std::map<Key, Face> boundary_within(const Mesh& mesh, const std::vector<int>& nodes, bool all = true) {
  std::vector<char> wanted(mesh.nodes.size());
  for (const int i : nodes) wanted[static_cast<std::size_t>(i)] = 1;
  std::map<Key, Face> once;
  std::map<Key, int> count;
  const int dimension_of_body = body_dimension(mesh);
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    if (!is_body(mesh.kind(e)) || dimension(mesh.shape(e)) != dimension_of_body) continue;
    for (int f = 0; f < face_count(mesh.shape(e)); ++f) {
      Face face = face_at(mesh, e, f);
      const auto is_wanted = [&](int i) { return wanted[static_cast<std::size_t>(i)] != 0; };
      if (!(all ? std::all_of(face.nodes.begin(), face.nodes.end(), is_wanted)
                : std::any_of(face.nodes.begin(), face.nodes.end(), is_wanted)))
        continue;
      Key key = key_of(face);
      ++count[key];
      once.emplace(std::move(key), std::move(face));
    }
  }
  std::erase_if(once, [&](const auto& entry) { return count[entry.first] > 1; });
  return once;
}

std::vector<Face> in_order(std::map<Key, Face> faces) {
  std::vector<Face> out;
  for (auto& [key, face] : faces) out.push_back(std::move(face));
  std::sort(out.begin(), out.end(), [](const Face& a, const Face& b) {
    return std::pair(a.element, a.face) < std::pair(b.element, b.face);
  });
  return out;
}

std::vector<int> nodes_of(const std::vector<Face>& faces) {
  std::vector<int> out;
  for (const Face& face : faces) out.insert(out.end(), face.nodes.begin(), face.nodes.end());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<int> nodes_of_elements(const Mesh& mesh, const std::vector<int>& elements) {
  std::vector<int> out;
  for (const int e : elements) {
    const auto& nodes = mesh.elements[static_cast<std::size_t>(e)].nodes;
    out.insert(out.end(), nodes.begin(), nodes.end());
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// Faces of *SURFACE, TYPE=ELEMENT, each once, as host programs take one that is named again. A whole element (face
/// below 0) stands for its free faces.
std::vector<Face> faces_of_surface(const Mesh& mesh, const Surface& surface) {
  std::vector<Face> out;
  std::map<Key, Face> boundary;
  std::set<std::pair<int, int>> seen;
  const bool whole =
      std::any_of(surface.facets.begin(), surface.facets.end(), [](const Facet& f) { return f.face < 0; });
  if (whole) {
    std::vector<int> elements;
    for (const Facet& f : surface.facets) elements.push_back(f.element);
    boundary = boundary_within(mesh, nodes_of_elements(mesh, elements));
  }
  for (const Facet& f : surface.facets) {
    Face face = face_at(mesh, f.element, f.face < 0 ? -1 - f.face : f.face);
    if (!seen.emplace(face.element, face.face).second) continue;
    if (f.face >= 0 || mesh.kind(f.element) == Kind::shell || boundary.count(key_of(face)) != 0)
      out.push_back(std::move(face));
  }
  return out;
}

std::vector<Face> faces_of_boundary_elements(const Mesh& mesh, const std::vector<int>& elements,
                                             Place place) {
  const auto boundary = boundary_within(mesh, nodes_of_elements(mesh, elements));
  std::vector<Face> out;
  for (const int e : elements) {
    Face self{e, 0, mesh.shape(e), mesh.elements[static_cast<std::size_t>(e)].nodes};
    if (dimension(self.shape) != body_dimension(mesh) - 1)
      mesh.source.fail(place, "element " + mesh.element_label(e) +
                                  " of this set is no boundary element of a " +
                                  std::to_string(body_dimension(mesh)) +
                                  "D body; name a *SURFACE or a set of boundary elements");
    const auto found = boundary.find(key_of(self));
    if (found == boundary.end())
      mesh.source.fail(place, "boundary element " + mesh.element_label(e) + " (" +
                                  mesh.source.at(mesh.elements[static_cast<std::size_t>(e)].place) +
                                  ") is no free face of a body");
    out.push_back(found->second);
  }
  return out;
}

void check_orientation(const Mesh& mesh, const Face& face) {
  if (mesh.kind(face.element) == Kind::shell) return;
  const Element& element = mesh.elements[static_cast<std::size_t>(face.element)];
  Point middle{};
  const int corners = corner_count(mesh.shape(face.element));
  for (int i = 0; i < corners; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      middle[j] +=
          mesh.nodes[static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(i)])].x[j] / corners;
  if (dot(face_normal(mesh, face), minus(face_middle(mesh, face), middle)) > 0) return;
  mesh.source.fail(element.place, "element " + mesh.element_label(face.element) +
                                      " turns the wrong way, or has no size: its face S" +
                                      std::to_string(face.face + 1) + " looks into the element");
}

} // namespace

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Point& a) { return std::hypot(a[0], a[1], a[2]); }

Point face_normal(const Mesh& mesh, const Face& face) {
  const auto x = [&](std::size_t i) { return mesh.nodes[static_cast<std::size_t>(face.nodes[i])].x; };
  switch (corner_count(face.shape)) {
  case 2: {
    const Point t = minus(x(1), x(0));
    return {-t[1], t[0], 0};
  }
  case 3:
    return cross(minus(x(1), x(0)), minus(x(2), x(0)));
  default:
    return cross(minus(x(2), x(0)), minus(x(3), x(1)));
  }
}

Point face_middle(const Mesh& mesh, const Face& face) {
  Point out{};
  const int corners = corner_count(face.shape);
  for (int i = 0; i < corners; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      out[j] += mesh.nodes[static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(i)])].x[j] / corners;
  return out;
}

namespace {

/// A name that a surface of nodes and one of faces share means one surface.
void check_same_nodes(const Mesh& mesh, const std::string& name, const Surface& surface,
                      const std::vector<Face>& faces) {
  if (surface.nodes.empty()) return;
  const std::vector<int> list = nodes_of(faces);
  const std::set<int> of_faces(list.begin(), list.end()), own(surface.nodes.begin(), surface.nodes.end());
  std::vector<int> lone;
  std::set_symmetric_difference(of_faces.begin(), of_faces.end(), own.begin(), own.end(),
                                std::back_inserter(lone));
  if (!lone.empty())
    mesh.source.fail(surface.place, "two surfaces are called '" + name +
                                        "', one of nodes and one of faces; node " + mesh.node_label(lone[0]) +
                                        " belongs to one of them alone: give one another name");
}

} // namespace

Side side_of(const Mesh& mesh, const std::string& name, Place asked_at) {
  const std::string key = canonical(name);
  Side out{name, {}, {}, {}, asked_at};
  const auto surface = mesh.surfaces.find(key);
  const auto elements = mesh.element_sets.find(key);
  const auto nodes = mesh.node_sets.find(key);
  if (surface != mesh.surfaces.end()) {
    out.place = surface->second.place;
    if (surface->second.of_nodes) {
      out.nodes = surface->second.nodes;
      out.areas = surface->second.areas;
      out.faces = in_order(boundary_within(mesh, out.nodes));
    } else {
      out.faces = faces_of_surface(mesh, surface->second);
      check_same_nodes(mesh, name, surface->second, out.faces);
    }
  } else if (elements != mesh.element_sets.end()) {
    out.faces = faces_of_boundary_elements(mesh, elements->second, asked_at);
  } else if (nodes != mesh.node_sets.end()) {
    out.nodes = nodes->second;
    out.faces = in_order(boundary_within(mesh, out.nodes));
  } else {
    std::string known;
    for (const auto& [other, unused] : mesh.surfaces) known += (known.empty() ? "" : ", ") + other;
    mesh.source.fail(asked_at, "there is no surface or set '" + name + "'" +
                                   (known.empty() ? "" : "; the deck has the surfaces " + known));
  }
  for (const Face& face : out.faces) check_orientation(mesh, face);
  if (out.nodes.empty()) out.nodes = nodes_of(out.faces);
  if (out.nodes.empty())
    mesh.source.fail(
        out.place,
        "the surface '" + name +
            "' has neither faces nor nodes that are known here (analytical, COMBINE and CROP are not read)");
  out.areas.resize(out.nodes.size());
  return out;
}

std::vector<Face> free_faces_at(const Mesh& mesh, const std::vector<int>& nodes) {
  return in_order(boundary_within(mesh, nodes, false));
}

std::vector<Point> node_normals(const Mesh& mesh, const Side& side) {
  std::unordered_map<int, Point> sums;
  for (const Face& face : side.faces) {
    const Point n = face_normal(mesh, face);
    for (const int node : face.nodes)
      for (std::size_t j = 0; j < 3; ++j) sums[node][j] += n[j];
  }
  std::vector<Point> out;
  for (const int node : side.nodes) {
    Point n = sums[node];
    const double size = length(n);
    for (double& c : n) c = size > 0 ? c / size : 0;
    out.push_back(n);
  }
  return out;
}

} // namespace ents_deck
