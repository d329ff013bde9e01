// SPDX-License-Identifier: BSD-3-Clause
// Elements of a call in blocks, for the kernels that take many at once.
#pragma once

#include "abi/call/element_call.hpp"
#include "core/element/block.hpp"

namespace ents {

// The arrays of a call from element `first` on.
ElementBlock element_block_of(const ents_model& model, const ents_input& in, const ents_output& out,
                              std::int64_t first) noexcept;

// A call with nothing to complain of, done without looking at the arguments one by one.
struct PlainCall {
  bool plain = false;     // false: nothing has been done, nothing is said of why
  std::uint64_t done = 0; // bit k: element first + k is evaluated; the others need care
};
PlainCall evaluate_plain_call(const ents_model* model, std::int64_t first, std::int64_t count,
                              const ents_input* in, const ents_output* out,
                              const ents_report* report) noexcept;

// Results that the block kernels write, if they know this model and its elements are single segments.
inline std::int32_t block_results_of(const ents_model& model, std::int32_t wanted) noexcept {
  return model.model.patch.empty() ? wanted & model.plan.block_results : 0;
}

} // namespace ents
