// SPDX-License-Identifier: BSD-3-Clause
// The points of the slave that get a contact element each: its nodes, or points inside of its faces.
#pragma once

#include <string>
#include <vector>

#include "contact_pair.hpp"
#include "faces.hpp"

namespace ents_deck {

struct SlavePoint {
  std::vector<int> nodes; ///< indices into Mesh::nodes
  std::vector<double> weights;
  double area = 0;     ///< [A], as the program takes forces; in 2D length times thickness
  Point x{}, normal{}; ///< normal of the slave; zero: none
};

/// Nodes of the slave with tributary areas. Nodes without faces: what the deck's data lines say, else what
/// the program itself takes.
std::vector<SlavePoint> slave_nodes(const Mesh& mesh, const Side& slave, const Side& master, Program program,
                                    std::vector<std::string>& remarks);

/// Points of the library (ents_sampling_points) inside of the slave's faces.
/// @param counts  [faces], 1 or more: points of a line; their square in a face
std::vector<SlavePoint> points_in_faces(const Mesh& mesh, const Side& slave, const std::vector<int>& counts,
                                        Program program);

/// "17", or "the point of face S2 of element 4".
std::string label_of(const Mesh& mesh, const SlavePoint& point);

} // namespace ents_deck
