// SPDX-License-Identifier: BSD-3-Clause
// The mesh of a deck: nodes, elements, sets and surfaces, flat or from *PART, *INSTANCE and *ASSEMBLY.
// Everything else (materials, steps ...) stays in Mesh::source as statements. What would change the mesh and
// is not understood here (*NGEN, *SYSTEM ...) is an error. Abaqus Keywords Guide; CalculiX CrunchiX manual,
// chapter 7.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "element_types.hpp"
#include "source.hpp"

namespace ents_deck {

using Point = std::array<double, 3>;

inline constexpr int no_instance = -1;

struct Node {
  std::int64_t id = 0; ///< as in the deck
  int instance = no_instance;
  Point x{}; ///< [L] in the assembly; missing coordinates are 0
  Place place;
};

struct Element {
  std::int64_t id = 0;
  int instance = no_instance;
  int type = 0;           ///< index into Mesh::types
  std::vector<int> nodes; ///< indices into Mesh::nodes; empty where the shape is Shape::none
  Place place;
};

/// Face of an element; `face` counts from 0: Abaqus S1 is 0. Shells: 0 is SPOS, 1 is SNEG, then the edges.
struct Facet {
  int element = 0, face = 0;
};

struct Surface {
  bool of_nodes = false; ///< TYPE=NODE alone; ccx takes a surface of nodes and one of faces with one name
  std::vector<Facet> facets;
  std::vector<int> nodes;
  std::vector<double> areas; ///< of nodes, as the data lines give them; 0: not given
  Place place;
};

struct Instance {
  std::string name, part; ///< as written
  Place place;
  Point translation{};
  std::array<double, 7> rotation{}; ///< two points of the axis, angle in degrees
};

/// Sets and surfaces are named in upper case, those of an instance "INSTANCE.NAME". Members are indices
/// without repetition, in the order of the deck.
struct Mesh {
  Source source;
  std::vector<Type> types;
  std::vector<Instance> instances;
  std::vector<Node> nodes;
  std::vector<Element> elements;
  std::map<std::string, std::vector<int>> node_sets, element_sets;
  std::map<std::string, Surface> surfaces;

  Shape shape(int element) const;
  Kind kind(int element) const;
  /// How the deck calls a node where all instances are known: "17", or "Part-1-1.17".
  std::string node_label(int node) const;
  std::string element_label(int element) const;
  bool has_parts() const { return !instances.empty(); }
};

/// Names that a set may have in all, before a deck whose sets contain each other is refused.
inline constexpr std::size_t largest_set_total = std::size_t{1} << 28;

/// @throws Error
Mesh read_mesh(Source source);

} // namespace ents_deck
