// SPDX-License-Identifier: BSD-3-Clause
// The finite element mesh with its named nodes and faces.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "shape.hpp"
#include "toolbox/error.hpp"

namespace host {

/// A face of a body (an edge in 2D); its normal points out of the body: tangent turned by +90 degrees in 2D,
/// rho_,1 x rho_,2 in 3D.
struct Face {
  int count = 0; ///< 2, 3 or 4 nodes
  std::array<int, 4> nodes{-1, -1, -1, -1};
};

/// Elements of one type and one material.
struct ElementGroup {
  ElementType type = ElementType::quad4;
  int part = 0;           ///< which part of the mesh they belong to
  std::vector<int> nodes; ///< [elements][nodes per element]

  std::size_t size() const { return nodes.size() / static_cast<std::size_t>(node_count(type)); }
  std::span<const int> element(std::size_t index) const {
    const auto n = static_cast<std::size_t>(node_count(type));
    return std::span(nodes).subspan(index * n, n);
  }
};

struct Mesh {
  int dimension = 2;
  std::vector<double> coordinates; ///< [nodes][dimension]
  std::vector<ElementGroup> groups;
  std::map<std::string, std::vector<int>> node_sets; ///< "part", "part.x_min", "part.SET"
  std::map<std::string, std::vector<Face>> face_sets;

  int node_count() const { return static_cast<int>(coordinates.size()) / dimension; }
  std::span<const double> node(int index) const {
    return std::span(coordinates)
        .subspan(static_cast<std::size_t>(index) * static_cast<std::size_t>(dimension),
                 static_cast<std::size_t>(dimension));
  }
};

/// One axis of a structured block: the ordered coordinates of its grid planes.
using GridLines = std::vector<double>;

/// Grid lines of one graded piece, without its first: `divisions` cells from `from` to `to`, each `growth`
/// times as long as the one before it (geometric progression).
void append_graded(GridLines& lines, double to, int divisions, double growth);

/// Add a block on a tensor grid: quad4 or tri3 (each cell cut along one diagonal) in 2D; hex8 or tet4 (six
/// per cell round one space diagonal: conforming) in 3D. Its sets are NAME (all nodes) and the sides
/// NAME.x_min, NAME.x_max, NAME.y_min ... as nodes and as faces.
void add_block(Mesh& mesh, const std::string& name, ElementType type, const std::vector<GridLines>& lines,
               int part);

/// Add the body of an Abaqus/CalculiX deck with its node sets and surfaces as NAME.SET.
/// @param element_set  of the deck; empty: the whole body
/// @throws InputError with the reader's message
void add_deck(Mesh& mesh, const std::string& name, const std::filesystem::path& file,
              const std::string& element_set, int part);

/// A set of the mesh: of `node_sets` or `face_sets`.
/// @param where  file and JSON path of the name
/// @param kind   "nodes" or "faces"
/// @throws InputError naming the sets that there are
template <class Sets>
const auto& named(const Sets& sets, const std::string& name, const std::string& where, const char* kind) {
  const auto found = sets.find(name);
  if (found != sets.end() && !found->second.empty()) return found->second;
  std::string names;
  for (const auto& [key, value] : sets) names += (names.empty() ? "" : ", ") + key;
  throw InputError(where + ": no " + kind + " \"" + name + "\"; there are: " + names);
}

/// [faces][count] nodes: with count 4 a triangle among quadrilaterals has its last node twice.
std::vector<std::int64_t> connectivity_of(const std::vector<Face>& faces, std::size_t count);

/// Nodes of the faces, ascending, each once.
std::vector<int> nodes_of(const std::vector<Face>& faces);

} // namespace host
