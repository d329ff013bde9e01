// SPDX-License-Identifier: BSD-3-Clause
// Which segments each slave point needs: a host's element has fixed nodes, so it gets a patch of all master
// faces that the point may meet on its way.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "faces.hpp"
#include "slave_points.hpp"

namespace ents_deck {

/// Segments of an element as local numbers of its master nodes; equal for all elements with the same model.
using Topology = std::vector<std::vector<int>>;

struct Patch {
  int slave = 0;          ///< index of the slave point
  int face = 0;           ///< of the master, under the point in the undeformed mesh
  std::vector<int> nodes; ///< master nodes of the element, indices into Mesh::nodes
  std::vector<int> faces; ///< of the master, in the order of `topology`
  Topology topology;
  Shape shape = Shape::none; ///< of its segments; a triangle among quadrilaterals has its last node twice
};

struct PatchRequest {
  Point motion{};              ///< [L] range of prescribed motion per direction
  double any_direction = 0;    ///< [L] more, in whichever direction
  double least = 0;            ///< [L] the slide is at least this
  std::optional<double> slide; ///< [L] instead
  int largest = 0;             ///< nodes that an element may have, those of the slave included
  bool turn =
      true; ///< number the nodes of a segment from whichever corner gives fewer models; false where s = xi
};

struct Patches {
  std::vector<Patch> list;
  int narrow = 0;   ///< slave points whose patch is the faces along their straight way alone: all within the
                    ///< slide are too many
  int left_out = 0; ///< slave points beside the master, farther than they slide
  double slide = 0; ///< largest of all nodes, [L]
  double reserve = 0; ///< [L] smallest distance from a point's place to the border of its patch inside the
                      ///< surface; infinite: patches are the whole surface
  int widest = 0;     ///< most nodes of an element
};

/// @throws Error with the numbers where the faces within the slide of a node have more than `largest` nodes,
///         or cannot be segments of one shape
Patches patches_of(const Mesh& mesh, const std::vector<SlavePoint>& slave, const Side& master,
                   const PatchRequest& request);

} // namespace ents_deck
