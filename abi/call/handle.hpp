// SPDX-License-Identifier: BSD-3-Clause
// The model behind the handle.
#pragma once

#include <memory>
#include <vector>

#include "abi/call/entry_point.hpp"
#include "core/model/binding.hpp"
#include "core/model/plan.hpp"
#include "core/search/patch.hpp"

namespace ents {

// What a model and those bound to it (ents_model_bind) have in common.
struct SharedModel {
  PatchedModel model;
  Plan plan, base; // of one segment, with and without the height; they point into this struct
};

} // namespace ents

struct ents_model {
  static constexpr std::uint64_t live = 0x656e74736d6f646c;    // "entsmodl"
  static constexpr std::uint64_t unbound = 0x656e7473756e626e; // live, but its fields have no memory yet
  static constexpr std::uint64_t dead = 0x646561646d6f646c;
  std::uint64_t magic;
  ents::Plan plan; // of one segment
  std::shared_ptr<const ents::SharedModel> shared;
  const ents::PatchedModel& model; // its numbers are those of the text: those of `plan` count
  ents::ElementSizes sizes;        // of an element as the host sees it
  ents::BoundHeight height;        // of a bound model; else without nodes
};

namespace ents {

// Arrays end before this many doubles from their start: no index times a stride leaves the 64 bits of an
// address.
inline constexpr int most_bits = 60;

// A handle of any kind? Best effort for freed ones: their memory may be reused.
inline std::int32_t check_any_handle(const ents_model* model, ents_report* report) noexcept {
  if (!model) return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'model' is null");
  if (model->magic != ents_model::live && model->magic != ents_model::unbound)
    return report_status(report, ENTS_BAD_HANDLE, -1,
                         "argument 'model' is not a live handle of this library (already destroyed?)");
  return ENTS_OK;
}

// One that can be evaluated?
inline std::int32_t check_handle(const ents_model* model, ents_report* report) noexcept {
  if (const std::int32_t status = check_any_handle(model, report); status != ENTS_OK) return status;
  if (model->magic == ents_model::unbound)
    return report_message(
        report, ENTS_BAD_STATE, -1,
        "the height has a field, \"%s\", without memory: make it with ents_field_init, give it to "
        "ents_model_bind, and use the model bound to it",
        model->model.fields.front().c_str());
  return ENTS_OK;
}

// Index of the first NaN or infinity; -1 if there is none, or no array.
std::int64_t first_non_finite(const double* values, std::int64_t size) noexcept;

// Name the entry of a surface's arguments that is NaN or infinite; prefix: what stands before the argument's
// name.
std::int32_t explain_non_finite(const Plan& plan, const char* prefix, const double* master,
                                const double* surface_coordinates, const double* xi, std::int64_t point,
                                ents_report* report) noexcept;

} // namespace ents
