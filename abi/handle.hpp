// SPDX-License-Identifier: BSD-3-Clause
// The model behind the handle.
#pragma once

#include "abi/door.hpp"
#include "core/plan.hpp"

struct ents_model {
  static constexpr std::uint64_t live = 0x656e74736d6f646c;  // "entsmodl"
  static constexpr std::uint64_t dead = 0x646561646d6f646c;
  std::uint64_t magic;
  ents::Plan plan;    // points into `model`
  ents::Model model;
};

namespace ents {

// A usable handle? Best effort for freed ones: their memory may be reused.
inline std::int32_t check_handle(const ents_model* model, ents_report* report) noexcept {
  if (!model) return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'model' is null");
  if (model->magic != ents_model::live)
    return report_status(report, ENTS_BAD_HANDLE, -1,
                         "argument 'model' is not a live handle of this library (already destroyed?)");
  return ENTS_OK;
}

}  // namespace ents
