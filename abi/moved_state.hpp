// SPDX-License-Identifier: BSD-3-Clause
// An element whose state is in contact on another segment than the element, with the state moved to the
// element's.
#pragma once

#include "abi/element_call.hpp"

namespace ents {

class MovedState {
public:
  // call: outlives this
  explicit MovedState(const ElementCall& call) : call_(call) {}
  MovedState(const MovedState&) = delete;

  // Does element e, which has a segment, need this?
  static bool is_needed(const ElementCall& call, std::int64_t e);
  // Afterwards `call()` evaluates element e, and no other. Both segments as they are in positions_begin. The
  // report is written where the status is not ENTS_OK.
  std::int32_t move(std::int64_t e, const double* positions_begin, ents_report* report);
  const ElementCall& call() const { return call_; }

private:
  static constexpr int most = 16; // numbers of a state
  ElementCall call_;
  ents_input in_;
  double state_[most];
};

} // namespace ents
