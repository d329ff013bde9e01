// SPDX-License-Identifier: BSD-3-Clause
// What to change when a step cannot be solved: how Newton's iteration failed says more than that it did.
#pragma once

#include <string>
#include <vector>

#include "toolbox/json_reader.hpp"

namespace host {

/// Where nothing better is known.
inline constexpr const char* smaller_steps = "take smaller steps, or see /solver/min_step";

/// One run of Newton's iteration.
struct IterationHistory {
  std::vector<double> residuals; ///< relative, after each iteration
  std::vector<int> switches; ///< slave nodes that opened or closed, at each iteration against the one before
  std::vector<int> moves;    ///< slave nodes that stayed closed and changed their segment
};

/// The residual stands still above the tolerance, or nodes open and close or change segments in turn. Empty:
/// it is neither.
/// @param model  of the contact, null if there is none
std::string advice_if_stuck(const IterationHistory& history, const Json& model);

/// Slave nodes went too deep (ENTS_DEEP_PENETRATION).
std::string advice_if_deep(const Json& model);

/// A slave node lies behind a concave edge between two segments (ENTS_FLAG_BEHIND_EDGE), or has left them
/// (ENTS_FLAG_LEFT).
std::string advice_if_lost(const Json& model, bool behind_edge);

} // namespace host
