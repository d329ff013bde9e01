// SPDX-License-Identifier: BSD-3-Clause
// ents_wear_collect: what the master surface has lost goes from the states of the slave points into a field.
#include <cmath>

#include "abi/call/element_call.hpp"
#include "abi/call/field_call.hpp"
#include "abi/call/guard.hpp"

namespace ents {

namespace {

struct Collection {
  ElementCall call;
  double thickness;
  double* state;
  std::int64_t stride;
  const MapHeight& map;
  const FieldLayout& layout;
  std::span<double> block;

  // Checks element e, and adds what it has lost to the field unless `looks`. volume: what the field gets
  std::int32_t collect(std::int64_t e, bool looks, double& volume, ents_report* report) {
    const Plan& plan = *call.plan;
    double* own = state + e * stride;
    volume = 0.0;
    if (!is_state(plan.state, own) || !is_segment_number(own[plan.state.size]) ||
        (call.in->mesh && call.segment(e) >= 0 && !call.state_follows(e)))
      return call.explain(ENTS_BAD_STATE, e, report);
    double& lost = own[plan.state.wear_at + StateLayout::worn_master];
    const double area = call.in->area ? *at(call.in->area, call.in->area_stride, e) : 1.0;
    if (lost == 0.0 || area == 0.0) return ENTS_OK;
    SegmentNodes nodes;
    if (call.in->mesh) {
      const std::int64_t s = call.segment(e);
      if (s < 0 || s >= call.mesh.segments) return call.refuse_segment(e, report);
      if (const Status outcome = gather(plan, call.mesh, s, nodes); outcome != Status::ok)
        return explain_segment(plan, call.mesh, outcome, s, report);
    }
    const ElementInput element = call.element(e, nodes);
    double s[2], area_per_s, width = 1.0;
    const double* xi = own + StateLayout::xi_at;
    const Status outcome =
        plan.coordinates(plan, element.master, element.surface_coordinates, xi, s, area_per_s);
    if (outcome != Status::ok) return call.explain(static_cast<std::int32_t>(outcome), e, report);
    if (plan.dimension == 2) width = thickness > 0.0 ? thickness : turn(plan, element, xi);
    const double amount = lost * area;
    if (!(std::fabs(amount) < 1e100 && area_per_s * width > 1e-100))
      return call.explain(ENTS_OUT_OF_RANGE, e, report);
    volume = amount;
    if (looks) return ENTS_OK;
    add_to_field(map, layout, plan.parameters, s, -amount / (area_per_s * width), block);
    lost = 0.0;
    return ENTS_OK;
  }

private:
  // 2 pi r of the point, the second axis is that of the body
  static double turn(const Plan& plan, const ElementInput& element, const double* xi) {
    double point[3] = {};
    const SurfacePoint to = {nullptr, nullptr, nullptr, point, nullptr, nullptr, nullptr};
    if (plan.base->surface(*plan.base, element.master, element.surface_coordinates, xi, to) != Status::ok)
      return 0.0;
    return 2.0 * 3.14159265358979323846 * std::fabs(point[0]);
  }
};

std::int32_t collect_wear(const ents_model& model, std::int64_t first, std::int64_t count,
                          const ents_input* input, double thickness, double* state, std::int64_t stride,
                          const char* name, double* block, std::int64_t size, double* volume,
                          ents_report* report) {
  if (model.plan.state.wear_at < 0)
    return report_status(report, ENTS_BAD_VALUE, -1,
                         "the model has no wear; write \"wear\" into its \"contact\"");
  if (!model.model.patch.empty())
    return report_status(
        report, ENTS_BAD_VALUE, -1,
        "the elements of this model are patches: their wear is not collected into a field; let the slave "
        "side lose all of it (\"slave\": 1)");
  FieldLayout layout;
  std::int32_t index = 0;
  std::int32_t status = check_field(model, name, block, size, layout, index, report);
  if (status != ENTS_OK) return status;
  const std::span<double> field{block, static_cast<std::size_t>(layout.size)};
  if (!is_field(layout, field)) return refuse_block(name, report);
  if (model.plan.dimension == 2 && !(thickness >= 0.0 && thickness < 1e100))
    return report_message(report, ENTS_BAD_VALUE, -1,
                          "thickness = %g; it is > 0, or 0 for axisymmetric bodies", thickness);
  if (count > 0 && !state) return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'state' is null");
  ents_input copy;
  const ents_input* in = known_struct(input, copy, "input", status, report);
  if (!in) return status;
  if (in->state_begin)
    return report_status(report, ENTS_BAD_VALUE, -1,
                         "input.state_begin is not null; the states are argument 'state'");
  ents_input with_state = *in;
  with_state.struct_size = static_cast<std::int32_t>(sizeof with_state);
  with_state.state_begin = state, with_state.state_begin_stride = stride;
  if (first + count > 1 && stride < model.sizes.state)
    return report_message(report, ENTS_BAD_COUNT, -1, "state_stride = %lld; at least %d is needed",
                          static_cast<long long>(stride), model.sizes.state);
  ents_output none{};
  none.struct_size = sizeof none;
  Collection collection{{},     thickness, state, stride, find_field(model.model.height, index)->map,
                        layout, field};
  if ((status = collection.call.open(&model, first, count, &with_state, &none, report)) != ENTS_OK)
    return status;
  double sum = 0.0, own = 0.0;
  for (const bool looks : {true, false})
    for (std::int64_t e = first; e < first + count; ++e) {
      if ((status = collection.collect(e, looks, own, report)) != ENTS_OK) return status;
      if (!looks) sum += own;
    }
  block[field_header::changes] += 1.0;
  if (volume) *volume = sum;
  return report_ok(report);
}

} // namespace

} // namespace ents

extern "C" int32_t ents_wear_collect(const ents_model* model, int64_t first, int64_t count,
                                     const ents_input* input, double thickness, double* state,
                                     int64_t state_stride, const char* name, double* block, int64_t size,
                                     double* volume, ents_report* report) {
  return ents::entry_point(report, [&] {
    if (const std::int32_t status = ents::check_any_handle(model, report); status != ENTS_OK) return status;
    const ents::FloatingPointGuard guard;
    return ents::collect_wear(*model, first, count, input, thickness, state, state_stride, name, block, size,
                              volume, report);
  });
}
