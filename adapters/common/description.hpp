// SPDX-License-Identifier: BSD-3-Clause
// What a host says of one contact element: properties, sizes, its line in the table.
#pragma once

#include <string>

#include "element.hpp"
#include "limits.hpp"
#include "model_cache.hpp"

namespace ents_adapter {

/// What the library needs to know of one element.
struct Arguments {
  const LoadedModel* model = nullptr;
  const ElementRow* row = nullptr; ///< of the table, if it has one for this element
  double area = 0;
  double slave_values[4] = {0, 1, 1, 1}; ///< offset, factors of wear, scale of a table
  bool has_offset = false;
  int options = 0;
  int slave_nodes = 1; ///< of the face that a slave point lies in; 1: the slave is a node
  double weights[largest_slave_nodes] = {1};
  const double* surface_coordinates = nullptr; ///< null: the model's own, else s = xi
  double own_coordinates[2 * largest_body_nodes];
  bool body = false;      ///< the master is a rigid body with a reference node, see body.hpp
  bool turn_node = false; ///< whose turns are displacements of a node of their own
};

/// @return what is wrong with the element's description; "" if nothing
std::string read(const Element& e, Arguments& arguments);

/// A slave that was in contact at the begin of the increment and is now beyond the border of its segments,
/// below the surface that goes on there: the contact would be lost without a word. (Above it, it has lifted
/// off.)
bool has_left(const Arguments& arguments, const ents_input& input, int32_t flags, double gap);

/// An open slave beside its patch, below the surface as it goes on there, no deeper than the patch is wide.
bool lies_beside(const Arguments& arguments, int32_t flags, double gap, const double* master);

} // namespace ents_adapter
