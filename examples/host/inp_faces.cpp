// SPDX-License-Identifier: BSD-3-Clause
// What a contact code asks of a deck: its body, and named parts of the body's boundary.
#include "inp.hpp"
#include "inp_statements.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace host::inp {
namespace {

using std::string;
using std::string_view;
using Point = std::array<double, 3>;

/// Local nodes of the faces S1, S2 ... (Abaqus Elements Guide), turned so that the normal points out of the
/// element.
struct Topology {
  int nodes, dimension, nodes_per_face;
  std::vector<std::array<int, 4>> faces; ///< -1: it has a node less
};

const Topology& topology(Shape shape) {
  static const std::array<Topology, 6> table{{
      {2, 1, 0, {}},
      {3, 2, 2, {{1, 0}, {2, 1}, {0, 2}}},
      {4, 2, 2, {{1, 0}, {2, 1}, {3, 2}, {0, 3}}},
      {4, 3, 3, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}},
      {8, 3, 4, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
      {6, 3, 4, {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
  }};
  return table[static_cast<std::size_t>(shape)];
}

const Element& element_at(const Deck& deck, int e) { return deck.elements[static_cast<std::size_t>(e)]; }

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double triple(const Point& a, const Point& b, const Point& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Area in the plane (signed), or the Jacobian determinant in the middle of the element times a positive
/// number.
double signed_size(const Deck& deck, const Element& element) {
  const auto x = [&](int i) {
    return deck.coordinates[static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(i)])];
  };
  const Point z{0, 0, 1};
  switch (element.shape) {
  case Shape::line2:
    return 1;
  case Shape::tri3:
    return triple(minus(x(1), x(0)), minus(x(2), x(0)), z);
  case Shape::quad4:
    return triple(minus(x(2), x(0)), minus(x(3), x(1)), z);
  case Shape::tet4:
    return triple(minus(x(1), x(0)), minus(x(2), x(0)), minus(x(3), x(0)));
  case Shape::wedge6: {
    Point up{};
    for (int i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) up[j] += x(3 + i)[j] - x(i)[j];
    return triple(minus(x(1), x(0)), minus(x(2), x(0)), up);
  }
  case Shape::hex8:
    break;
  }
  const auto across = [&](const std::array<int, 4>& from, const std::array<int, 4>& to) {
    Point sum{};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 3; ++j) sum[j] += x(to[i])[j] - x(from[i])[j];
    return sum;
  };
  return triple(across({0, 3, 7, 4}, {1, 2, 6, 5}), across({0, 1, 5, 4}, {3, 2, 6, 7}),
                across({0, 1, 2, 3}, {4, 5, 6, 7}));
}

Face face_at(const Deck& deck, Facet facet) {
  const Element& element = element_at(deck, facet.element);
  const Topology& shape = topology(element.shape);
  Face out{facet.element, shape.nodes_per_face, {}};
  const auto& local = shape.faces[static_cast<std::size_t>(facet.face)];
  if (local.back() < 0) --out.count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(out.count); ++i)
    out.nodes[i] = element.nodes[static_cast<std::size_t>(local[i])];
  return out;
}

/// Node numbers in order: equal for two faces or elements with the same nodes.
std::array<int, 4> sorted_nodes(std::span<const int> nodes) {
  std::array<int, 4> key{-1, -1, -1, -1};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    std::size_t at = i;
    for (; at > 0 && key[at - 1] > nodes[i]; --at) key[at] = key[at - 1];
    key[at] = nodes[i];
  }
  return key;
}

struct Keyed {
  std::array<int, 4> key;
  Face face;
};

/// Faces of the body with all nodes among `nodes`, sorted by key.
std::vector<Keyed> faces_within(const Deck& deck, const std::vector<int>& nodes) {
  std::vector<char> wanted(deck.coordinates.size());
  for (const int i : nodes) wanted[static_cast<std::size_t>(i)] = 1;
  std::vector<Keyed> out;
  for (const int e : body(deck))
    for (int f = 0; f < face_count(element_at(deck, e).shape); ++f) {
      const Face face = face_at(deck, {e, f});
      const std::span<const int> used(face.nodes.data(), static_cast<std::size_t>(face.count));
      if (std::all_of(used.begin(), used.end(),
                      [&](int i) { return wanted[static_cast<std::size_t>(i)] != 0; }))
        out.push_back({sorted_nodes(used), face});
    }
  std::stable_sort(out.begin(), out.end(), [](auto& a, auto& b) { return a.key < b.key; });
  return out;
}

std::vector<Face> boundary_within(const Deck& deck, const std::vector<int>& nodes) {
  const auto faces = faces_within(deck, nodes);
  std::vector<Face> out;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const bool inner = (i > 0 && faces[i - 1].key == faces[i].key) ||
                       (i + 1 < faces.size() && faces[i + 1].key == faces[i].key);
    if (!inner) out.push_back(faces[i].face);
  }
  return out;
}

std::vector<int> nodes_of_elements(const Deck& deck, const std::vector<int>& elements) {
  std::vector<int> out;
  std::vector<char> seen(deck.coordinates.size());
  for (const int e : elements)
    for (int i = 0; i < node_count(element_at(deck, e).shape); ++i) {
      const int node = element_at(deck, e).nodes[static_cast<std::size_t>(i)];
      if (std::exchange(seen[static_cast<std::size_t>(node)], char{1}) == 0) out.push_back(node);
    }
  return out;
}

/// How a mesher marks a boundary: elements of one dimension less on the faces of the body.
std::vector<Face> faces_of_boundary_elements(const Deck& deck, const std::vector<int>& elements) {
  const auto faces = faces_within(deck, nodes_of_elements(deck, elements));
  std::vector<Face> out;
  for (const int e : elements) {
    const Element& element = element_at(deck, e);
    const Place place{element.file, element.line};
    const string name = "element " + std::to_string(element.id);
    if (dimension(element.shape) != dimension(deck) - 1)
      fail(deck.files, place,
           name + " is no boundary element of a " + std::to_string(dimension(deck)) +
               "D body; name a *SURFACE, a node set, or a set of boundary elements");
    const Keyed wanted{
        sorted_nodes({element.nodes.data(), static_cast<std::size_t>(node_count(element.shape))}), {}};
    const auto [first, last] =
        std::equal_range(faces.begin(), faces.end(), wanted, [](auto& a, auto& b) { return a.key < b.key; });
    if (last - first != 1)
      fail(deck.files, place,
           name + (first == last ? " is no face of the body" : " lies between two elements of the body"));
    out.push_back(first->face);
  }
  return out;
}

std::vector<Face> faces_of_surface(const Deck& deck, const Surface& surface) {
  std::vector<Face> out;
  for (const Facet facet : surface.facets) {
    const Element& element = element_at(deck, facet.element);
    if (dimension(element.shape) != dimension(deck))
      fail(deck.files, {element.file, element.line},
           "element " + std::to_string(element.id) + " of the surface is no element of the body");
    out.push_back(face_at(deck, facet));
  }
  return out;
}

/// The entry of that name (in any case), or null.
template <class T> const T* found(const std::map<string, T>& sets, string_view name) {
  const auto entry = sets.find(canonical(name));
  return entry == sets.end() ? nullptr : &entry->second;
}

[[noreturn]] void fail_unknown(const Deck& deck, string_view name) {
  string text = deck.files[0] + ": no set or surface '" + string(name) + "'; the deck has";
  const auto list = [&](const string& what, const auto& sets) {
    for (const auto& [key, members] : sets) text += " " + what + " " + key + ",";
  };
  list("*NSET", deck.node_sets);
  list("*ELSET", deck.element_sets);
  list("*SURFACE", deck.surfaces);
  if (text.back() == ',')
    text.pop_back();
  else
    text += " none";
  throw Error(text);
}

} // namespace

int node_count(Shape shape) { return topology(shape).nodes; }
int face_count(Shape shape) { return static_cast<int>(topology(shape).faces.size()); }
int dimension(Shape shape) { return topology(shape).dimension; }

int dimension(const Deck& deck) {
  const bool solid =
      std::any_of(deck.elements.begin(), deck.elements.end(), [](auto& e) { return e.kind == Kind::solid; });
  return solid ? 3 : 2;
}

std::vector<int> body(const Deck& deck, string_view set) {
  std::vector<int> candidates(deck.elements.size()), out;
  std::iota(candidates.begin(), candidates.end(), 0);
  if (!set.empty()) {
    const auto* members = found(deck.element_sets, set);
    if (members == nullptr) fail_unknown(deck, set);
    candidates = *members;
  }
  const int wanted = dimension(deck);
  for (const int e : candidates) {
    const Element& element = element_at(deck, e);
    if (dimension(element.shape) != wanted) continue;
    if (!(signed_size(deck, element) > 0))
      fail(deck.files, {element.file, element.line},
           "element " + std::to_string(element.id) + " has zero or negative size: its nodes must run " +
               (wanted == 2 ? "counterclockwise" : "counterclockwise on the first face seen from inside") +
               " (Gmsh: ReverseMesh)");
    out.push_back(e);
  }
  return out;
}

std::vector<int> nodes_of(const Deck& deck, string_view name) {
  if (const auto* nodes = found(deck.node_sets, name)) return *nodes;
  if (const auto* surface = found(deck.surfaces, name)) {
    if (surface->of_nodes) return surface->nodes;
    std::vector<int> out;
    for (const Face& face : faces_of_surface(deck, *surface))
      out.insert(out.end(), face.nodes.begin(), face.nodes.begin() + face.count);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }
  const auto* elements = found(deck.element_sets, name);
  if (elements == nullptr) fail_unknown(deck, name);
  return nodes_of_elements(deck, *elements);
}

std::vector<Face> faces_of(const Deck& deck, string_view name) {
  const auto* surface = found(deck.surfaces, name);
  const auto* elements = found(deck.element_sets, name);
  const auto* nodes = found(deck.node_sets, name);
  std::vector<Face> out;
  if (surface != nullptr)
    out = surface->of_nodes ? boundary_within(deck, surface->nodes) : faces_of_surface(deck, *surface);
  else if (elements != nullptr)
    out = faces_of_boundary_elements(deck, *elements);
  else if (nodes != nullptr)
    out = boundary_within(deck, *nodes);
  else
    fail_unknown(deck, name);
  if (out.empty()) throw Error(deck.files[0] + ": '" + string(name) + "' holds no face of the body");
  return out;
}

} // namespace host::inp
