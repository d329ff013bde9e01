// SPDX-License-Identifier: BSD-3-Clause
// Control points of a smoothed master: linear combinations of nodes of the mesh and of their mirror images.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "ents_library.hpp"

namespace host {

class ControlNet {
public:
  /// A node seen in one or more planes of symmetry: x' = sign x + offset, component by component.
  struct Image {
    int node = 0;
    std::array<double, 3> sign{1, 1, 1}, offset{};
  };

  int dimension = 2;
  std::int64_t mesh_nodes = 0;
  std::vector<Image> images; ///< they are numbered after the nodes of the mesh
  /// The points: combinations of nodes and images, see ents_combination.
  std::vector<std::int64_t> begin, nodes;
  std::vector<double> weights;
  /// Of nodes on a plane of symmetry: the component that has to stay zero.
  std::vector<std::size_t> held;

  std::int64_t points() const { return static_cast<std::int64_t>(begin.size()) - 1; }
  std::int64_t all_nodes() const { return mesh_nodes + static_cast<std::int64_t>(images.size()); }
  ents_combination combination() const;
  /// Number in the mesh of a node or of what an image shows.
  std::int64_t origin(std::int64_t node) const {
    return node < mesh_nodes ? node : images[static_cast<std::size_t>(node - mesh_nodes)].node;
  }
  /// 1 or -1: how a component of an image moves with that of its node.
  double sign(std::int64_t node, std::size_t component) const {
    return node < mesh_nodes ? 1 : images[static_cast<std::size_t>(node - mesh_nodes)].sign[component];
  }
  /// The nodes and images that some points are made of, each once.
  /// @param of  [count] points
  std::vector<std::int64_t> nodes_of(const std::int64_t* of, std::size_t count) const;
  /// Nodes of the mesh that the points depend on.
  std::set<std::int64_t> nodes_of_mesh() const;
  /// Positions of the points [points][d].
  /// @param of_nodes  [mesh nodes][d]
  std::vector<double> positions(const std::vector<double>& of_nodes) const;
  /// @throws JobError if a node has left its plane of symmetry
  void check_held(const std::vector<double>& displacement) const;
};

} // namespace host
