// SPDX-License-Identifier: BSD-3-Clause
// The body of an Abaqus or CalculiX deck, which ents-deck's reader reads.
#include <algorithm>
#include <set>

#include "deck/faces.hpp"
#include "keys.hpp"

namespace host {
namespace {

using ents_deck::cross;
using ents_deck::dot;
using ents_deck::minus;
using ents_deck::Shape;
using DeckMesh = ents_deck::Mesh;

/// Where there are solids, elements in the plane mark boundaries.
int body_dimension(const DeckMesh& deck) {
  for (std::size_t e = 0; e < deck.elements.size(); ++e)
    if (deck.kind(static_cast<int>(e)) == ents_deck::Kind::solid) return 3;
  return 2;
}

/// Elements of the body, of a set of it if a name is given.
std::vector<int> body_of(const DeckMesh& deck, const std::string& element_set) {
  std::vector<int> candidates(deck.elements.size());
  for (std::size_t e = 0; e < candidates.size(); ++e) candidates[e] = static_cast<int>(e);
  if (!element_set.empty()) {
    const auto set = deck.element_sets.find(ents_deck::canonical(element_set));
    if (set == deck.element_sets.end())
      throw InputError(deck.source.files[0].name + ": there is no set of elements '" + element_set + "'");
    candidates = set->second;
  }
  std::erase_if(candidates, [&, d = body_dimension(deck)](int e) { return dimension(deck.shape(e)) != d; });
  return candidates;
}

/// The bulk element of a deck's element. A wedge is a brick of which two edges are points.
ElementType type_of(const DeckMesh& deck, int e, std::vector<int>& nodes) {
  nodes = deck.elements[static_cast<std::size_t>(e)].nodes;
  if (deck.shape(e) == Shape::wedge6) {
    nodes = {nodes[0], nodes[1], nodes[2], nodes[2], nodes[3], nodes[4], nodes[5], nodes[5]};
    return ElementType::hex8;
  }
  const auto found = std::find_if(element_types.begin(), element_types.end(),
                                  [&](const ElementTraits& type) { return type.shape == deck.shape(e); });
  if (found == element_types.end())
    deck.source.fail(deck.elements[static_cast<std::size_t>(e)].place,
                     "element " + deck.element_label(e) + " is of second order; take linear elements");
  return static_cast<ElementType>(found - element_types.begin());
}

/// Does the first corner see the others as the element's shape says?
void check_orientation(const DeckMesh& deck, int e) {
  const std::vector<int>& nodes = deck.elements[static_cast<std::size_t>(e)].nodes;
  const auto edge = [&](std::size_t to) {
    return minus(deck.nodes[static_cast<std::size_t>(nodes[to])].x,
                 deck.nodes[static_cast<std::size_t>(nodes[0])].x);
  };
  const Shape shape = deck.shape(e);
  const std::size_t second = shape == Shape::quad4 || shape == Shape::hex8 ? 3 : 2;
  const ents_deck::Point up = dimension(shape) == 2  ? ents_deck::Point{0, 0, 1}
                              : shape == Shape::hex8 ? edge(4)
                                                     : edge(3);
  if (dot(cross(edge(1), edge(second)), up) > 0) return;
  deck.source.fail(deck.elements[static_cast<std::size_t>(e)].place,
                   "element " + deck.element_label(e) +
                       " turns the wrong way, or has no size: its nodes must run " +
                       (dimension(shape) == 2 ? "counterclockwise"
                                              : "counterclockwise on the first face seen from inside") +
                       " (Gmsh: ReverseMesh)");
}

/// Nodes of a set or surface of this name.
std::vector<int> nodes_of_name(const DeckMesh& deck, const std::string& key) {
  if (const auto set = deck.node_sets.find(key); set != deck.node_sets.end()) return set->second;
  if (const auto set = deck.element_sets.find(key);
      set != deck.element_sets.end() && !deck.surfaces.count(key)) {
    std::set<int> nodes;
    for (const int e : set->second) {
      const std::vector<int>& all = deck.elements[static_cast<std::size_t>(e)].nodes;
      nodes.insert(all.begin(), all.end());
    }
    return {nodes.begin(), nodes.end()};
  }
  return side_of(deck, key, {}).nodes;
}

/// Faces of a set or surface of this name, if it is a part of the boundary; nodes as `number` counts them.
std::vector<Face> faces_of_name(const DeckMesh& deck, const std::string& key,
                                const std::vector<int>& number) {
  std::vector<Face> faces;
  try {
    for (const ents_deck::Face& face : side_of(deck, key, {}).faces) {
      Face mine;
      mine.count = static_cast<int>(face.nodes.size());
      if (mine.count > 4) continue;
      for (std::size_t a = 0; a < face.nodes.size(); ++a)
        mine.nodes[a] = number[static_cast<std::size_t>(face.nodes[a])];
      if (std::find(mine.nodes.begin(), mine.nodes.begin() + mine.count, -1) ==
          mine.nodes.begin() + mine.count)
        faces.push_back(mine);
    }
  } catch (const ents_deck::Error&) {
    return {}; // it has nodes, but no faces
  }
  return faces;
}

void add_body(Mesh& mesh, const std::string& name, const DeckMesh& deck, const std::string& element_set,
              int part) {
  if (body_dimension(deck) != mesh.dimension)
    throw InputError(deck.source.files[0].name + ": the body has dimension " +
                     std::to_string(body_dimension(deck)) + ", the scene " + std::to_string(mesh.dimension));
  // A mesher leaves nodes behind that no element of the body uses; they must not become unknowns.
  std::vector<int> number(deck.nodes.size(), -1), nodes;
  std::map<ElementType, ElementGroup> groups;
  std::vector<int>& all = mesh.node_sets[name];
  for (const int e : body_of(deck, element_set)) {
    const ElementType type = type_of(deck, e, nodes);
    check_orientation(deck, e);
    ElementGroup& group = groups[type];
    group.type = type, group.part = part;
    for (const int node : nodes) {
      int& own = number[static_cast<std::size_t>(node)];
      if (own < 0) {
        own = mesh.node_count();
        all.push_back(own);
        const ents_deck::Point& x = deck.nodes[static_cast<std::size_t>(node)].x;
        mesh.coordinates.insert(mesh.coordinates.end(), x.begin(), x.begin() + mesh.dimension);
      }
      group.nodes.push_back(own);
    }
  }
  for (auto& [type, group] : groups) mesh.groups.push_back(std::move(group));
  std::set<std::string> names;
  for (const auto& [key, value] : deck.node_sets) names.insert(key);
  for (const auto& [key, value] : deck.element_sets) names.insert(key);
  for (const auto& [key, value] : deck.surfaces) names.insert(key);
  for (const std::string& key : names) {
    std::vector<int>& own = mesh.node_sets[name + "." + key];
    for (const int node : nodes_of_name(deck, key))
      if (number[static_cast<std::size_t>(node)] >= 0) own.push_back(number[static_cast<std::size_t>(node)]);
    if (std::vector<Face> faces = faces_of_name(deck, key, number); !faces.empty())
      mesh.face_sets[name + "." + key] = std::move(faces);
  }
}

} // namespace

void add_deck(Mesh& mesh, const std::string& name, const std::filesystem::path& file,
              const std::string& element_set, int part) {
  try {
    add_body(mesh, name, ents_deck::read_mesh(ents_deck::read_source(file)), element_set, part);
  } catch (const ents_deck::Error& error) {
    throw InputError(error.what());
  }
}

void add_part(Mesh& mesh, const Part& part, int index) {
  if (!part.lines.empty()) return add_block(mesh, part.name, part.type, part.lines, index);
  try {
    add_deck(mesh, part.name, part.deck, part.element_set, index);
  } catch (const InputError& error) { // names the deck, and not who asked for it
    throw InputError(part.deck_where + ": " + error.what());
  }
}

} // namespace host
