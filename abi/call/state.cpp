// SPDX-License-Identifier: BSD-3-Clause
// State blocks: made, augmented, moved to another segment.
#include "abi/call/guard.hpp"
#include "abi/call/handle.hpp"

namespace {

using namespace ents;

std::int32_t check_blocks(const ents_model* model, std::int64_t count, const void* array, std::int64_t stride,
                          const char* name, ents_report* report) {
  if (const std::int32_t status = check_any_handle(model, report); status != ENTS_OK) return status;
  const std::int32_t size = model->sizes.state;
  constexpr std::int64_t most = std::int64_t{1} << most_bits;
  if (count < 0 || stride < size || (count > 1 && count > most / stride))
    return report_message(report, ENTS_BAD_COUNT, -1,
                          "count = %lld must be >= 0, the stride of '%s' (%lld) at least %d (state_size), "
                          "and their product less than "
                          "2^60",
                          static_cast<long long>(count), name, static_cast<long long>(stride), size);
  if (count > 0 && !array)
    return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null", name);
  return ENTS_OK;
}

} // namespace

extern "C" {

int32_t ents_state_init(const ents_model* model, int64_t count, double* state, int64_t stride,
                        ents_report* report) {
  return entry_point(report, [&] {
    if (const std::int32_t status = check_blocks(model, count, state, stride, "state", report);
        status != ENTS_OK)
      return status;
    const StateLayout& layout = model->plan.state;
    for (int64_t e = 0; e < count; ++e) {
      double* block = state + e * stride;
      for (std::int32_t i = 0; i < model->sizes.state; ++i) block[i] = 0.0;
      block[StateLayout::tag_at] = layout.tag;
    }
    return report_ok(report);
  });
}

int32_t ents_state_augment(const ents_model* model, int64_t count, double* state_begin, int64_t begin_stride,
                           const double* state_end, int64_t end_stride, ents_report* report) {
  return entry_point(report, [&] {
    std::int32_t status = check_blocks(model, count, state_begin, begin_stride, "state_begin", report);
    if (status == ENTS_OK) status = check_blocks(model, count, state_end, end_stride, "state_end", report);
    if (status != ENTS_OK) return status;
    const FloatingPointGuard guard; // a signalling NaN traps in a comparison, too
    const StateLayout& layout = model->plan.state;
    if (layout.multiplier_at < 0)
      return report_status(
          report, ENTS_BAD_STATE, -1,
          "this model keeps no multipliers in the state; use contact.normal.type \"augmented\"");
    for (int64_t e = 0; e < count; ++e)
      if (!is_state(layout, state_begin + e * begin_stride) ||
          !is_state(layout, state_end + e * end_stride) ||
          !is_segment_number(state_begin[e * begin_stride + layout.size]) ||
          !is_segment_number(state_end[e * end_stride + layout.size]))
        return report_message(report, ENTS_BAD_STATE, e,
                              "block %lld is not a state of this model and version",
                              static_cast<long long>(e));
    for (int64_t e = 0; e < count; ++e)
      for (std::int32_t i = layout.multiplier_at; i < layout.size; ++i)
        state_begin[e * begin_stride + i] = state_end[e * end_stride + i];
    return report_ok(report);
  });
}

int32_t ents_state_transfer(const ents_model* model, const double* old_master,
                            const double* old_surface_coordinates, const double* new_master,
                            const double* new_surface_coordinates, const double* state, double* moved,
                            ents_report* report) {
  return entry_point(report, [&] {
    if (const std::int32_t status = check_handle(model, report); status != ENTS_OK) return status;
    if (!model->model.patch.empty())
      return report_status(report, ENTS_BAD_STATE, -1,
                           "the elements of this model are patches: they move their states from segment to "
                           "segment themselves");
    const struct {
      const char* name;
      const void* pointer;
    } required[] = {
        {"old_master", old_master}, {"new_master", new_master}, {"state", state}, {"moved", moved}};
    for (const auto& r : required)
      if (!r.pointer) return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null", r.name);
    const FloatingPointGuard guard;
    const Plan& plan = model->plan;
    if (!is_segment_number(state[plan.state.size]))
      return report_status(report, ENTS_BAD_STATE, -1, ents_status_text(ENTS_BAD_STATE));
    const auto status = static_cast<std::int32_t>(plan.transfer(
        plan, old_master, old_surface_coordinates, new_master, new_surface_coordinates, state, moved));
    if (status == ENTS_OK) moved[plan.state.size] = 0.0; // of any segment: its number is not told
    if (status == ENTS_OK) return report_ok(report);
    return report_status(report, status, -1, ents_status_text(status));
  });
}

} // extern "C"
