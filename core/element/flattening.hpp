// SPDX-License-Identifier: BSD-3-Clause
// Heights that give way to the pressure on them: a part of the height, s h, whose scale follows from the
// element's own pressure,
//   s = f(p(s)),   f(p) = least + (1 - least) exp(-p / pressure),
// one equation per element with its exact tangent. The forces are those of the flattened surface: its normal,
// and no work for the change of s.
#pragma once

#include "core/model/plan.hpp"

namespace ents {

// Nodes of a height that can be flattened.
inline constexpr std::int32_t most_flattened_nodes = 64;

// As ElementKernel. ambiguous_projection: the equation has more than one solution, or an unstable one (a
// hollow that rises as it flattens).
Status evaluate_flattened(const Plan& plan, const ElementInput& in, const ElementOutput& out);

} // namespace ents
