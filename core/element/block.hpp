// SPDX-License-Identifier: BSD-3-Clause
// A block of elements by the kernel of its model.
#pragma once

#include "core/model/needs.hpp"
#include "core/tangent/symmetrised.hpp"

namespace ents {

// Elements block.first .. + count - 1. Bit k: element first + k is written; the others are left to the
// element kernel. The fast kernel does not know of symmetrised tangents, the others do.
inline std::uint64_t evaluate_block(const Plan& plan, const PairBlock& block, std::int32_t count) {
  const std::uint64_t done = plan.pairs(plan, block, count);
  if (plan.law.symmetrised && plan.law.has_friction() && (block.wanted & want::tangent) != 0 &&
      has_fast_kernel(plan.law, plan.projection, plan.tangent))
    for (std::int32_t k = 0; k < count; ++k)
      if ((done >> k & 1) != 0)
        symmetrise(plan.dofs, block.tangent + (block.first + k) * block.tangent_stride, block.leading);
  return done;
}

} // namespace ents
