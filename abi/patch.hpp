// SPDX-License-Identifier: BSD-3-Clause
// Elements of one slave and several segments, for hosts whose elements have fixed nodes: sliding over all of
// them stays inside the element. The segment is chosen as ents_detect does; the state carries it from
// increment to increment.
#pragma once

#include <vector>

#include "core/detection.hpp"

namespace ents {

inline constexpr std::int32_t most_patch_nodes = 64, most_patch_segments = 64;

// Segments of a patch over its own nodes; empty: the element is one segment.
struct Patch {
  std::int32_t nodes = 0;
  std::vector<std::int64_t> connectivity; // [segments][m]

  bool empty() const { return connectivity.empty(); }
};

// What the reader makes of a model's text.
struct PatchedModel : Model {
  Patch patch;
};

// Sizes of an element as its host sees it.
struct ElementSizes {
  std::int32_t nodes, dofs, state;
};
ElementSizes sizes_of(const Plan& plan, const Patch& patch);

// input and output have the sizes of `sizes_of`. Nothing is written unless ok.
Status evaluate_patch(const Plan& plan, const PatchedModel& model, const ElementInput& in,
                      const ElementOutput& out);

} // namespace ents
