// SPDX-License-Identifier: BSD-3-Clause
// Tangents and residuals that no cache holds. An element per lane, they would be written to memory a piece
// here and a piece there; so they are written block by block to a place that a cache does hold, and copied
// from there. While one block is computed the one before is copied, a few cache lines at a time, so that the
// latency of streaming stores is hidden.
#pragma once

#include <algorithm>

#include "abi/call/element_block.hpp"
#include "core/element/make_plan.hpp"
#include "core/numbers/streaming.hpp"

namespace ents {

class StagedResults {
public:
  // `known`: results of the block kernel
  StagedResults(const Plan& plan, const ents_output& out, std::int32_t known) noexcept
      : dofs_(plan.dofs), entries_(std::int64_t{plan.dofs} * plan.dofs), out_(out),
        residuals_too_((known & want::residual) != 0 && out.residual_stride == plan.dofs) {}
  StagedResults(const StagedResults&) = delete;
  ~StagedResults() {
    copy_last();
    portable::stream_fence();
  }

  // Is a call of `count` elements so long, its results such that they are staged?
  static bool pays(const ents_model& model, const ents_output& out, std::int32_t known,
                   std::int64_t count) noexcept {
    const std::int64_t entries = std::int64_t{model.plan.dofs} * model.plan.dofs;
    return (known & want::tangent) != 0 && block_size(model.plan) * entries <= room &&
           count > beyond_caches / entries && leading_dimension(model, out) == model.plan.dofs;
  }
  // Elements at a time: whole registers, few.
  static std::int64_t block_size(const Plan& plan) noexcept {
    return std::clamp<std::int64_t>(nearest / (std::int64_t{plan.dofs} * plan.dofs) & ~std::int64_t{7}, 8,
                                    ElementBlock::most);
  }

  // The kernel shall write its next block here, and copy the last one meanwhile.
  void redirect(ElementBlock& block) noexcept {
    begin_at_first(block);
    block.tangent = tangents_[turn_], block.tangent_stride = entries_;
    if (residuals_too_) block.residual = residuals_, block.residual_stride = dofs_;
    block.last = last_.count > 0 ? &last_ : nullptr;
  }

  // The block is there: `size` elements from `first` on, those with a bit in `done`.
  void keep(std::int64_t first, std::int64_t size, std::uint64_t done) noexcept {
    copy_last();
    double* const tangents = tangents_[turn_];
    double* const residual = residuals_too_ ? at(out_.residual, dofs_, first) : nullptr;
    if (out_.tangent_stride == entries_ && done == ~std::uint64_t{0} >> (ElementBlock::most - size)) {
      last_ = {tangents, size * entries_, at(out_.tangent, entries_, first)};
      turn_ = 1 - turn_;
      if (residual) stream_copy_(residuals_, size * dofs_, residual);
      return;
    }
    for (std::int64_t k = 0; k < size; ++k) {
      if ((done >> k & 1) == 0) continue;
      std::copy_n(tangents + k * entries_, entries_, at(out_.tangent, out_.tangent_stride, first + k));
      if (residual) std::copy_n(residuals_ + k * dofs_, dofs_, residual + k * dofs_);
    }
  }

private:
  // numbers: in the first cache, in all caches, in tangents of a block, in its residuals
  static constexpr std::int64_t nearest = 2304, beyond_caches = std::int64_t{1} << 19, room = 7200,
                                narrow = 6 * ElementBlock::most;

  void copy_last() noexcept {
    if (last_.count > 0) stream_copy_(last_.from, last_.count, last_.to);
    last_.count = 0;
  }

  std::int64_t dofs_, entries_;
  const ents_output& out_;
  bool residuals_too_;
  int turn_ = 0;
  DeferredCopy last_{};
  decltype(BlockKernels::stream_copy) stream_copy_ = best_block_kernels().stream_copy;
  alignas(64) double tangents_[2][room], residuals_[narrow];
};

} // namespace ents
