// SPDX-License-Identifier: BSD-3-Clause
// A rigid master with a reference node. Its nodes are fixed in the frame of the body (lines "body" of
// ents_k.txt) and are none of the host's. The element's nodes are those of the slave, then either the
// reference node, whose last degrees of freedom are rotations, or the reference node and one whose
// displacements are the turns about the axes of space (in the plane: the first of them).
#pragma once

#include <string>

#include <ents.h>

#include "element.hpp"
#include "model_cache.hpp"

namespace ents_adapter {

/// Unknowns of a body: displacement and turns of its reference node.
inline constexpr int largest_body_dofs = 9; // with those of the slave point

/// Turns of a body
constexpr int turns_of(int dimension) { return dimension == 2 ? 1 : 3; }

/// History variables of a body, behind those of the model: in space its rotation at the begin of the
/// increment [3][3], and with a node for the turns what they were then [3]. In the plane the angle is the
/// host's.
constexpr int body_history(int dimension, bool turn_node) { return dimension == 2 ? 0 : turn_node ? 12 : 9; }

struct Body {
  ents_pose pose{};
  double turns[3] = {}; ///< with a node for the turns: its displacements; else not used
  double spin[3] = {};  ///< since the begin of the increment
};

/// Where the body is.
/// @param slave_nodes  before the reference node
/// @param state_size   history variables before those of the body
/// @param finite       out: false if the host's numbers are not
/// @return what is wrong with the history; "" if nothing
std::string place_body(const Element& e, int dimension, int slave_nodes, bool turn_node, int state_size,
                       Body& body, bool& finite);

/// The history of the body at the end of the increment.
void write_body(const Element& e, int dimension, bool turn_node, int state_size, const Body& body);

/// Columns of the tangent [n][n] that are for the spin become columns for the displacements of a node for the
/// turns, whose sum the host takes: multiplied by the tangent of the exponential map.
void turn_columns(const Body& body, double* tangent, int n);

} // namespace ents_adapter
