// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/segment.hpp"

#include <algorithm>

#include "core/element/block.hpp"

namespace ents {

Status evaluate_segment(const Plan& plan, const ElementInput& in, const ElementOutput& out) {
  if (!plan.block || out.wanted == 0) return plan.element(plan, in, out);
  double start[2]; // xi may take its place
  if (in.start) std::copy_n(in.start, plan.parameters, start);
  ElementBlock block = block_of(in, out, in.start ? start : nullptr, out.wanted & plan.block_results);
  ElementOutput rest = out;
  rest.wanted &= ~plan.block_results;
  if (rest.wanted != 0) block.one = &in, block.rest = &rest;
  return evaluate_block(plan, block, 1) != 0 ? Status::ok : plan.element(plan, in, out);
}

} // namespace ents
