// SPDX-License-Identifier: BSD-3-Clause
// An element whose state belongs to another segment than the element, with the state moved to the element's;
// or that has no state, with that of the begin of the increment.
#pragma once

#include "abi/call/element_call.hpp"

namespace ents {

class MovedState {
public:
  // call: outlives this
  explicit MovedState(const ElementCall& call) : call_(call) {}
  MovedState(const MovedState&) = delete;

  // Does element e, which has a segment, need this?
  static bool is_needed(const ElementCall& call, std::int64_t e) { return moves(call, e) || begins(call, e); }
  // Afterwards `call()` evaluates element e, and no other. Both segments as they are in positions_begin. The
  // report is written where the status is not ENTS_OK.
  std::int32_t move(std::int64_t e, const double* positions_begin, ents_report* report);
  const ElementCall& call() const { return call_; }

private:
  static bool moves(const ElementCall& call, std::int64_t e);
  static bool begins(const ElementCall& call, std::int64_t e);
  std::int32_t gather_nodes(std::int64_t e, std::int64_t segment, const double* positions_begin,
                            SegmentNodes& nodes, ents_report* report) const;
  // The state of an open element on the segment that it is on now, in slave_begin.
  std::int32_t begin(std::int64_t e, const SegmentNodes& nodes, ents_report* report);

  static constexpr int most = 16; // numbers of a state
  ElementCall call_;
  ents_input in_;
  double state_[most];
};

} // namespace ents
