// SPDX-License-Identifier: BSD-3-Clause
// Models by number: the one rule for all hosts. Property 1 of an element is a whole number k; its model is
// the file ents_k.json of the job's directory, and ents_k.txt beside it, if there, holds what differs from
// element to element.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <ents.h>

namespace ents_adapter {

inline constexpr int largest_model_number = 9999;

/// A line of ents_k.txt: "ELEMENT AREA [OFFSET] [W ...] [S ...]", # starts a comment. OFFSET is there if a
/// line "offsets" comes first, weights W if a line "slave_nodes n" with n > 1 does: the slave is then a point
/// of a face, the sum of W times the positions of the element's first n nodes.
struct ElementRow {
  std::int64_t element = 0;                ///< the host's number
  double area = 0;                         ///< [A] tributary area of the slave node, > 0
  double offset = 0;                       ///< [L] added to the gap; 0 without a line "offsets"
  std::vector<double> weights;             ///< [slave_nodes]; empty for 1
  std::vector<double> surface_coordinates; ///< [m][d-1] of the master nodes; or empty
};

struct LoadedModel {
  ents_model* model = nullptr; ///< null: `error` says why
  /// The same without its height; null if it has none. Where the state knows no projection yet, the one on
  /// this segment is the start: the point of a rough surface straight ahead of the node. Closer ones, if any,
  /// lie to the side.
  ents_model* base = nullptr;
  ents_layout layout{};
  bool symmetric_forces = false; ///< the block of forces by displacements always is; else as `layout` says
  std::string file;              ///< ents_k.json with its folder
  std::string error;
  std::vector<ElementRow> rows; ///< sorted by element
  int slave_nodes = 1;          ///< of each row
  bool offsets = false;         ///< in each row
  bool patch = false;           ///< the element has several segments
  std::vector<double> body;     ///< [m][d] master nodes about the reference node; empty: they are the host's

  /// @return null if there is no such line
  const ElementRow* row(std::int64_t element) const;
};

/// @return what is wrong with weights that shall make a point of nodes; "" if nothing
std::string wrong_weights(const double* weights, int count);

/// The model with this number. It is read at the first call, by one thread, and lives until the process ends;
/// a failure is remembered, too. Any number of threads.
/// @param number     1 .. largest_model_number
/// @param directory  the job's directory, "" or with a separator at its end; asked once per number
const LoadedModel& model_number(int number, std::string (*directory)());

} // namespace ents_adapter
