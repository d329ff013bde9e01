// SPDX-License-Identifier: BSD-3-Clause
// Elements of one slave and several segments, for hosts whose elements have fixed nodes: sliding over all of
// them stays inside the element. The segment is chosen as ents_detect does; the state carries it from
// increment to increment.
#pragma once

#include <vector>

#include "core/model/plan.hpp"
#include "core/search/detection.hpp"

namespace ents {

inline constexpr std::int32_t most_patch_nodes = 64, most_patch_segments = 64;

// Segments of a patch over its own nodes; empty: the element is one segment.
struct Patch {
  std::int32_t nodes = 0;
  std::vector<std::int64_t> connectivity; // [segments][m]

  bool empty() const { return connectivity.empty(); }
};

// What the reader makes of a model's text.
struct PatchedModel : ModelSpec {
  Patch patch;
};

// Sizes of an element as its host sees it.
struct ElementSizes {
  std::int32_t nodes, dofs, state;
};
ElementSizes sizes_of(const Plan& plan, const Patch& patch);

// The last number of every state that a caller keeps, after those of the kernels: 1 + the segment that the slave was
// on, 0 where that is unknown.
inline bool is_segment_number(double number) { return 0.0 * number == 0.0; } // finite
inline std::int64_t segment_of_state(const Plan& plan, const double* state) {
  return static_cast<std::int64_t>(state[plan.state.size]) - 1;
}

// input and output have the sizes of `sizes_of`. Nothing is written unless ok. open: nothing is written, the
// element is one without a segment.
Status evaluate_patch(const Plan& plan, const PatchedModel& model, const ElementInput& in,
                      const ElementOutput& out, bool& open);

} // namespace ents
