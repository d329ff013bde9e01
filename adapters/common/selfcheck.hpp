// SPDX-License-Identifier: BSD-3-Clause
// Is K the slope of R? Finite differences in the user's own host, with the user's own model.
#pragma once

#include <cstddef>

#include <ents.h>

namespace ents_adapter {

/// @param unknowns  positions of slave and master nodes, then multipliers: where `input` points. Changed and
/// restored
/// @param tangent   [dofs][dofs] to be tested
/// @param text      [size] out: the errors at three steps, and the verdict
/// @return the verdict: |K - dR/du| falls below 1e-5 of |K|
bool selfcheck(const ents_model* model, const ents_layout& layout, const ents_input& input, double* unknowns,
               const double* tangent, char* text, std::size_t size);

} // namespace ents_adapter
