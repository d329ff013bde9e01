// SPDX-License-Identifier: BSD-3-Clause
// A host that wants no wrong answer: Newton's method with ents_detect and ents_evaluate, and the rules that
// keep it on the branch it is on. What the rules are worth is seen by leaving them out.
#pragma once

#include <string>
#include <vector>

#include "chart/press.hpp"
#include "ents_library.hpp"

namespace host::chart {

/// The careful host has them all.
struct Rules {
  bool check = true;  ///< ask ents_model_check first
  bool reach = true;  ///< penetration_limit from its reach: farther inside a projection is not unique
  bool move = true;   ///< a node moves at most a quarter of the shortest wave and one segment
  bool anew = true;   ///< a node that is open is searched anew; only a closed one is followed
  bool behind = true; ///< no segment found: is the node really outside?
  bool flags = true;  ///< ENTS_FLAG_AMBIGUOUS, ENTS_FLAG_FAR_SIDE of a closed node: cut
  bool stable =
      true; ///< the exact tangent is positive; where contact softens it, half steps end where whole ones do
};
inline constexpr Rules careless{false, false, false, false, false, false, false};

enum class End {
  solved,
  fold,        ///< ents_model_check: |h| kappa >= 1
  edge,        ///< ents_model_check: h does not vanish at the edges
  self_shadow, ///< ents_model_check: n_e . e <= 0
  crossing,    ///< rho_e crosses itself (the host looks at its polygon)
  status,      ///< a recoverable status that no cut removes
  ambiguous,   ///< ENTS_FLAG_AMBIGUOUS or ENTS_FLAG_FAR_SIDE on a closed node
  behind,      ///< behind a corner between two segments
  jump,        ///< moves too far, however small the increment
  unstable,    ///< the tangent is not positive definite, or a step and its halves end apart
  diverged,    ///< Newton's iteration, in spite of all cuts
};
const char* word(End end);
bool is_flag(End end);

/// A converged increment at a nominal load.
struct Level {
  int increment = 0; ///< 1 .. Press::increments
  Vec position;
};

struct Outcome {
  End end = End::solved;
  std::int32_t status = 0; ///< End::status: which
  int iterations = 0;      ///< of Newton's method, with those of increments that were cut
  int cuts = 0;
  std::vector<Level> levels; ///< what was delivered
};

Outcome solve(const EntsLibrary& library, const Press& press, const Rules& rules = {});

} // namespace host::chart
