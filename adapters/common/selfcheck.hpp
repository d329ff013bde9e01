// SPDX-License-Identifier: BSD-3-Clause
// Is K the slope of R? Finite differences in the user's own host, with the user's own model.
#pragma once

#include <cstddef>

#include <ents.h>

namespace ents_adapter {

/// @param unknowns  positions of slave and master nodes, then multipliers: where `input` points. Changed and
///                  restored
/// @param temperatures  with heat: of slave and master nodes, as `unknowns`; else not looked at
/// @param tangent   [dofs][dofs] to be tested
/// @param text      [size] out: the errors at three steps, and the verdict
/// @return the verdict: |K - dR/du| falls below 1e-5 of |K|
bool selfcheck(const ents_model* model, const ents_layout& layout, const ents_input& input, double* unknowns,
               double* temperatures, const double* tangent, char* text, std::size_t size);

/// Why is there no contact? What a user needs to see that a segment is the wrong way round.
/// @param projected  the slave node has a projection on the segment; else `gap` and `normal` [3] are not
///                   looked at
/// @param text       [size] out
void say_open(bool projected, double gap, const double* normal, char* text, std::size_t size);

} // namespace ents_adapter
