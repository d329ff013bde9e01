// SPDX-License-Identifier: BSD-3-Clause
// A block of elements by the kernel of its model.
#pragma once

#include "core/element/block_kernels.hpp"
#include "core/model/needs.hpp"
#include "core/tangent/symmetrised.hpp"

namespace ents {

// The same elements, inputs and wanted results made to begin with them: for a caller who puts arrays of his own in
// the place of some.
inline void begin_at_first(ElementBlock& b) {
  const std::int64_t elements = b.first;
  b.first = 0;
  const auto move = [elements](auto*& data, std::int64_t stride) {
    if (data) data += stride * elements;
  };
#define ENTS_MOVE(field, size) move(b.field, b.field##_stride);
  ENTS_INPUT_ARRAYS(ENTS_MOVE)
#undef ENTS_MOVE
#define ENTS_MOVE(bit, public_name, name, field, type, size)                                                 \
  if ((b.wanted & want::name) != 0) move(b.field, b.field##_stride);
  ENTS_BLOCK_RESULTS(ENTS_MOVE) ENTS_HEAT_RESULTS(ENTS_MOVE)
#undef ENTS_MOVE
}

// With a coefficient of friction of 0 the kernel with friction checks the states and writes stick and slip;
// then the kernel without friction writes the rest, which so has the bits of a model without friction.
inline std::uint64_t evaluate_without_friction(const Plan& plan, const ElementBlock& block,
                                               std::int32_t count) {
  constexpr std::int32_t of_history = want::state | want::flags | want::age | want::slip;
  ElementBlock history = block, forces = block;
  history.wanted &= of_history | forces_only, forces.wanted &= ~of_history;
  forces.rest = nullptr;
  std::uint64_t done = plan.block(plan, history, count);
  const std::uint64_t all = count == ElementBlock::most ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
  if (done == all) return plan.block_without_friction(plan, forces, count);
  for (std::int32_t k = 0; k < count; ++k) {
    forces.first = block.first + k;
    if ((done >> k & 1) != 0 && plan.block_without_friction(plan, forces, 1) == 0)
      done &= ~(std::uint64_t{1} << k);
  }
  return done;
}

// Elements block.first .. + count - 1. Bit k: element first + k is written; the others are left to the
// element kernel. The fast kernel does not know of symmetrised tangents, the others do.
inline std::uint64_t evaluate_block(const Plan& plan, const ElementBlock& block, std::int32_t count) {
  if (plan.block_without_friction && !plan.law.has_friction_force())
    return evaluate_without_friction(plan, block, count);
  const std::uint64_t done = plan.block(plan, block, count);
  if (plan.law.symmetrised && !plan.heat && plan.law.has_friction() && (block.wanted & want::tangent) != 0 &&
      has_fast_kernel(plan.law, plan.projection, plan.tangent))
    for (std::int32_t k = 0; k < count; ++k)
      if ((done >> k & 1) != 0)
        symmetrise(plan.dofs, block.tangent + (block.first + k) * block.tangent_stride, block.leading);
  return done;
}

} // namespace ents
