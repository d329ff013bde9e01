// SPDX-License-Identifier: BSD-3-Clause
// An element with a temperature per node beside the displacements (theory.md, section 7.5). Dofs: displacements and
// temperature of the slave, then of each master node (of none where the master is rigid), then multipliers.
#pragma once

#include "core/model/plan.hpp"

namespace ents {

// ElementKernel of a plan with heat. What it adds to the mechanics is computed only where the residual, the
// tangent or the heat is wanted.
Status evaluate_heated(const Plan& plan, const ElementInput& in, const ElementOutput& out);
// BlockKernel of one, over the block kernels of its mechanics
std::uint64_t evaluate_heated_block(const Plan& plan, const ElementBlock& block, std::int32_t count);

// Dofs that are temperatures
inline std::int32_t temperatures_of(const Plan& plan) {
  return plan.heat ? (plan.rigid ? 1 : 1 + plan.nodes) : 0;
}

} // namespace ents
