// SPDX-License-Identifier: BSD-3-Clause
// State blocks: made, augmented, moved to another segment; and tributary areas.
#include <algorithm>
#include <cmath>
#include <vector>

#include "abi/guard.hpp"
#include "abi/handle.hpp"
#include "core/tributary.hpp"

namespace {

using namespace ents;

std::int32_t check_blocks(const ents_model* model, std::int64_t count, const void* array, std::int64_t stride,
                          const char* name, ents_report* report) {
  if (const std::int32_t status = check_handle(model, report); status != ENTS_OK) return status;
  const std::int32_t size = model->plan.state.size;
  constexpr std::int64_t most = std::int64_t{1} << most_bits;
  if (count < 0 || stride < size || (count > 1 && count > most / stride))
    return report_message(report, ENTS_BAD_COUNT, -1,
                          "count = %lld must be >= 0 and the stride of '%s' (%lld) at least %d, together less than any memory",
                          static_cast<long long>(count), name, static_cast<long long>(stride), size);
  if (count > 0 && !array) return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null", name);
  return ENTS_OK;
}

const BasisEntry* facet_named(const char* name) {
  for (const BasisEntry& entry : basis_table)
    if (std::strcmp(entry.name, name) == 0 && entry.basis != Basis::catmull_rom4 && entry.basis != Basis::bspline4 &&
        entry.basis != Basis::catmull_rom16 && entry.basis != Basis::bspline16)
      return &entry;
  return nullptr;
}

std::int32_t tributary_areas(const BasisEntry& facet, std::int64_t facets, const std::int64_t* connectivity,
                             std::int64_t nodes, const double* positions, double thickness, double* areas,
                             ents_report* report) {
  const std::int64_t entries = facets * facet.nodes;
  for (std::int64_t i = 0; i < entries; ++i)
    if (connectivity[i] < 0 || connectivity[i] >= nodes)
      return report_message(report, ENTS_BAD_VALUE, i / facet.nodes, "connectivity[%lld] = %lld is not a node (0 .. %lld)",
                            static_cast<long long>(i), static_cast<long long>(connectivity[i]),
                            static_cast<long long>(nodes - 1));
  const std::int64_t d = facet.parameters + 1;
  for (std::int64_t i = 0; i < nodes * d; ++i)
    if (!std::isfinite(positions[i]))
      return report_message(report, ENTS_NON_FINITE, -1, "positions[%lld] is not finite", static_cast<long long>(i));
  std::vector<double> sum(static_cast<std::size_t>(nodes), 0.0);
  std::int64_t at = 0;
  if (add_tributary_areas(facet.basis, facets, connectivity, positions, thickness, sum.data(), at) != Status::ok)
    return report_message(report, ENTS_DEGENERATE_SEGMENT, at, "facet %lld has no area", static_cast<long long>(at));
  std::copy(sum.begin(), sum.end(), areas);
  return report_ok(report);
}

}  // namespace

extern "C" {

int32_t ents_state_init(const ents_model* model, int64_t count, double* state, int64_t stride, ents_report* report) {
  return at_the_door(report, [&] {
    if (const std::int32_t status = check_blocks(model, count, state, stride, "state", report); status != ENTS_OK)
      return status;
    const StateLayout& layout = model->plan.state;
    for (int64_t e = 0; e < count; ++e) {
      double* block = state + e * stride;
      for (std::int32_t i = 0; i < layout.size; ++i) block[i] = 0.0;
      block[StateLayout::tag_at] = layout.tag;
    }
    return report_ok(report);
  });
}

int32_t ents_state_augment(const ents_model* model, int64_t count, double* state_begin, int64_t begin_stride,
                           const double* state_end, int64_t end_stride, ents_report* report) {
  return at_the_door(report, [&] {
    std::int32_t status = check_blocks(model, count, state_begin, begin_stride, "state_begin", report);
    if (status == ENTS_OK) status = check_blocks(model, count, state_end, end_stride, "state_end", report);
    if (status != ENTS_OK) return status;
    const FloatingPointGuard guard; // a signalling NaN traps in a comparison, too
    const StateLayout& layout = model->plan.state;
    if (layout.multiplier_at < 0)
      return report_status(report, ENTS_BAD_STATE, -1,
                           "this model keeps no multipliers in the state; use contact.normal.type \"augmented\"");
    for (int64_t e = 0; e < count; ++e)
      if (state_begin[e * begin_stride] != layout.tag || state_end[e * end_stride] != layout.tag)
        return report_message(report, ENTS_BAD_STATE, e, "block %lld is not a state of this model and version",
                              static_cast<long long>(e));
    for (int64_t e = 0; e < count; ++e)
      for (std::int32_t i = layout.multiplier_at; i < layout.size; ++i)
        state_begin[e * begin_stride + i] = state_end[e * end_stride + i];
    return report_ok(report);
  });
}

int32_t ents_state_transfer(const ents_model* model, const double* old_master, const double* old_surface_coordinates,
                            const double* new_master, const double* new_surface_coordinates, const double* state,
                            double* moved, ents_report* report) {
  return at_the_door(report, [&] {
    if (const std::int32_t status = check_handle(model, report); status != ENTS_OK) return status;
    const struct {
      const char* name;
      const void* pointer;
    } required[] = {{"old_master", old_master}, {"new_master", new_master}, {"state", state}, {"moved", moved}};
    for (const auto& r : required)
      if (!r.pointer) return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null", r.name);
    const FloatingPointGuard guard;
    const Plan& plan = model->plan;
    const auto status = static_cast<std::int32_t>(plan.transfer(plan, old_master, old_surface_coordinates, new_master,
                                                                new_surface_coordinates, state, moved));
    if (status == ENTS_OK) return report_ok(report);
    return report_status(report, status, -1, ents_status_text(status));
  });
}

int32_t ents_tributary_areas(const char* facet, int64_t facets, const int64_t* connectivity, int64_t nodes,
                             const double* positions, double thickness, double* areas, ents_report* report) {
  return at_the_door(report, [&] {
    if (!facet) return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'facet' is null");
    const BasisEntry* entry = facet_named(facet);
    if (!entry)
      return report_status(report, ENTS_BAD_VALUE, -1,
                           "argument 'facet' must be line2, line3, tri3, tri6, quad4, quad8 or quad9");
    if (facets < 0 || nodes < 0 || facets > INT64_MAX / 64 || nodes > INT64_MAX / 64)
      return report_message(report, ENTS_BAD_COUNT, -1, "facets = %lld, nodes = %lld: both must be >= 0",
                            static_cast<long long>(facets), static_cast<long long>(nodes));
    if ((facets > 0 && !connectivity) || (nodes > 0 && (!positions || !areas)))
      return report_status(report, ENTS_NULL_ARGUMENT, -1, "connectivity, positions or areas is null");
    const FloatingPointGuard guard;
    if (!std::isfinite(thickness) || thickness < 0.0)
      return report_status(report, ENTS_BAD_VALUE, -1, "argument 'thickness' must be >= 0");
    return tributary_areas(*entry, facets, connectivity, nodes, positions, thickness, areas, report);
  });
}

}  // extern "C"
