// SPDX-License-Identifier: BSD-3-Clause
// ents_evaluate: one kernel call per element, or per block of ordinary ones.
#include <algorithm>
#include <bit>
#include <cmath>

#include "abi/call/element_block.hpp"
#include "abi/call/guard.hpp"
#include "abi/call/staged_results.hpp"
#include "abi/call/undefined_height.hpp"

namespace ents {

static_assert(static_cast<int>(Status::no_projection) == ENTS_NO_PROJECTION);
static_assert(static_cast<int>(Status::singular_projection) == ENTS_SINGULAR_PROJECTION);
static_assert(static_cast<int>(Status::ambiguous_projection) == ENTS_AMBIGUOUS_PROJECTION);
static_assert(static_cast<int>(Status::degenerate_segment) == ENTS_DEGENERATE_SEGMENT);
static_assert(static_cast<int>(Status::grazing_ray) == ENTS_GRAZING_RAY);
static_assert(static_cast<int>(Status::deep_penetration) == ENTS_DEEP_PENETRATION);
static_assert(static_cast<int>(Status::out_of_range) == ENTS_OUT_OF_RANGE);
static_assert(static_cast<int>(Status::non_finite) == ENTS_NON_FINITE);
static_assert(static_cast<int>(Status::bad_value) == ENTS_BAD_VALUE);
static_assert(static_cast<int>(Status::bad_state) == ENTS_BAD_STATE);
#define ENTS_SAME(bit, public_name, name, field, type, size) static_assert(want::name == public_name);
ENTS_RESULTS(ENTS_SAME)
#undef ENTS_SAME
static_assert(flag::contact == ENTS_FLAG_CONTACT && flag::outside == ENTS_FLAG_OUTSIDE);
static_assert(flag::far_side == ENTS_FLAG_FAR_SIDE && flag::searched == ENTS_FLAG_SEARCHED);
static_assert(flag::stick == ENTS_FLAG_STICK && flag::slip == ENTS_FLAG_SLIP);
static_assert(flag::shear_limit == ENTS_FLAG_SHEAR_LIMIT && flag::changed == ENTS_FLAG_CHANGED);
static_assert(flag::no_begin == ENTS_FLAG_NO_BEGIN);

std::int32_t ElementCall::evaluate(std::int64_t e, const Wanted& also, ents_report* report, bool hard) const {
  SegmentNodes nodes;
  if (in->mesh) {
    const std::int64_t s = segment(e);
    const bool known = s >= 0 && s < mesh.segments;
    if (const Status outcome = known ? gather(*plan, mesh, s, nodes) : Status::bad_value;
        outcome != Status::ok) {
      if (out->status) *at(out->status, out->status_stride, e) = static_cast<std::int32_t>(outcome);
      return known ? explain_segment(*plan, mesh, outcome, s, report) : refuse_segment(e, report);
    }
  }
  ElementOutput results;
  results.wanted = out->wanted | also.wanted;
#define ENTS_ARRAY(bit, public_name, name, field, type, size)                                                \
  results.field = at(out->field, out->field##_stride, e);
  ENTS_RESULTS(ENTS_ARRAY)
#undef ENTS_ARRAY
  results.tangent_leading_dimension = leading_dimension(*model, *out);
  if (also.residual) results.residual = also.residual;
  if (also.tangent) results.tangent = also.tangent, results.tangent_leading_dimension = plan->dofs;
  if (also.flags) results.flags = also.flags;
  bool follows = state_follows(e);
  ElementInput input = element(e, nodes);
  double temperatures[HeatIngredients::most_nodes];
  if (in->mesh && mesh.temperature) {
    const std::int64_t* of_segment = mesh.connectivity + segment(e) * plan->nodes;
    for (int i = 0; i < plan->nodes; ++i) temperatures[i] = mesh.temperature[of_segment[i]];
    input.master_temperature = temperatures;
  }
  double without_path[largest_state];
  if (!follows && was_open(e)) { // on another segment: where it was from here is not known
    std::copy_n(input.state_begin, plan->state.size, without_path);
    without_path[StateLayout::history_at] = static_cast<double>(History::none);
    input.state_begin = without_path;
    follows = true;
  }
  bool open;
  ElementOutput nothing = results;
  nothing.wanted = 0;
  std::int32_t outcome =
      static_cast<std::int32_t>(evaluate_one(input, follows ? results : nothing, hard, open));
  if (double s[2]; (outcome == ENTS_DEGENERATE_SEGMENT || outcome == ENTS_OUT_OF_RANGE) &&
                   model->model.patch.empty() && height_is_undefined(*plan, input, s))
    outcome = ENTS_NO_PROJECTION;
  if (open && outcome == ENTS_OK) return evaluate_open(e, also);
  if (!follows && outcome >= 0) outcome = ENTS_BAD_STATE;
  if (outcome == ENTS_OK) mark_state(e);
  if (out->status) *at(out->status, out->status_stride, e) = outcome;
  return outcome;
}

bool ElementCall::gather_block(std::int64_t first, std::int64_t count, BlockNodes& nodes,
                               ElementBlock& block) const {
  const std::int64_t size = std::int64_t{plan->nodes} * plan->parameters;
  bool has_coordinates = false;
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t s = segment(first + k);
    SegmentNodes of_segment;
    if (s < 0 || s >= mesh.segments || gather(*plan, mesh, s, of_segment) != Status::ok) return false;
    std::copy_n(of_segment.positions, plan->nodes * plan->dimension, nodes.positions[k]);
    if (of_segment.surface_coordinates)
      std::copy_n(of_segment.surface_coordinates, size, nodes.surface_coordinates[k]);
    has_coordinates = of_segment.surface_coordinates != nullptr;
    for (std::int32_t i = 0; plan->heat && i < plan->nodes; ++i)
      nodes.temperatures[k][i] = mesh.temperature[mesh.connectivity[s * plan->nodes + i]];
  }
  begin_at_first(block);
  block.master = nodes.positions[0];
  block.master_stride = std::extent_v<decltype(nodes.positions), 1>;
  block.surface_coordinates = has_coordinates ? nodes.surface_coordinates[0] : nullptr;
  block.surface_coordinates_stride = std::extent_v<decltype(nodes.surface_coordinates), 1>;
  if (plan->heat) block.master_temperature = nodes.temperatures[0];
  block.master_temperature_stride = std::extent_v<decltype(nodes.temperatures), 1>;
  return true;
}

std::int32_t ElementCall::evaluate_range(std::int64_t first, std::int64_t count, std::int32_t& result,
                                         ents_report* report) const {
  const std::int32_t known = block_results_of(*model, out->wanted);
  if (known != out->wanted || !StagedResults::pays(*model, *out, known, count))
    return evaluate_blocks(first, count, nullptr, result, report);
  return evaluate_staged(first, count, result, report);
}

std::int32_t ElementCall::evaluate_staged(std::int64_t first, std::int64_t count, std::int32_t& result,
                                          ents_report* report) const {
  StagedResults staged(*plan, *out, out->wanted);
  return evaluate_blocks(first, count, &staged, result, report);
}

std::int32_t ElementCall::evaluate_blocks(std::int64_t first, std::int64_t count, StagedResults* staged,
                                          std::int32_t& result, ents_report* report) const {
  // Where some results are the element kernel's alone it goes element by element.
  const bool in_blocks = out->wanted != 0 && block_results_of(*model, out->wanted) == out->wanted;
  const std::int64_t most = in_blocks
                                ? std::min<std::int64_t>(in->mesh ? BlockNodes::most : ElementBlock::most,
                                                         staged ? StagedResults::block_size(*plan) : count)
                                : 1;
  BlockNodes nodes;
  ElementBlock block = element_block_of(*model, *in, *out, first);
  block.start_first = start_first;
  for (std::int64_t size; count > 0; first += size, count -= size, block.first += size) {
    size = std::min(count, most);
    std::uint64_t done = 0;
    ElementBlock here = block;
    bool follow = true;
    for (std::int64_t k = 0; k < size && in->state_begin; ++k) follow = follow && state_follows(first + k);
    if (staged) staged->redirect(here);
    const bool tried = in_blocks && follow && (!in->mesh || gather_block(first, size, nodes, here));
    if (tried) done = evaluate_block(*plan, here, static_cast<std::int32_t>(size));
    if (staged) staged->keep(first, size, done);
    for (std::int64_t k = 0; k < size; ++k) {
      if ((done >> k & 1) != 0) {
        mark_state(first + k);
        if (out->status) *at(out->status, out->status_stride, first + k) = ENTS_OK;
        continue;
      }
      const std::int32_t outcome = evaluate(first + k, {}, report, tried);
      if (const std::int32_t end = settle(outcome, first + k, result, report); end < 0) return end;
    }
  }
  return result;
}

std::int32_t ElementCall::evaluate_call(const ents_model* model, std::int64_t first, std::int64_t count,
                                        const ents_input* input, const ents_output* output,
                                        const PlainCall& before, ents_report* report) {
  ElementCall call;
  if (const std::int32_t status = call.open(model, first, count, input, output, report); status != ENTS_OK)
    return status;
  report_ok(report);
  std::int32_t result = ENTS_OK;
  if (!before.plain) {
    const std::int32_t end = call.evaluate_range(first, count, result, report);
    return end < 0 ? end : result;
  }
  for (std::int64_t k = 0; k < count; ++k) {
    if ((before.done >> k & 1) != 0) continue;
    const std::int32_t outcome = call.evaluate(first + k, {}, report, true);
    if (const std::int32_t end = call.settle(outcome, first + k, result, report); end < 0) return end;
  }
  return result;
}

} // namespace ents

extern "C" {

int32_t ents_evaluate(const ents_model* model, int64_t first, int64_t count, const ents_input* input,
                      const ents_output* output, ents_report* report) {
  return ents::entry_point(report, [&] {
    const ents::FloatingPointGuard guard;
    const ents::PlainCall call = ents::evaluate_plain_call(model, first, count, input, output, report);
    if (call.plain && call.done == ~std::uint64_t{0} >> (ents::ElementBlock::most - count))
      return ents::report_ok(report);
    return ents::ElementCall::evaluate_call(model, first, count, input, output, call, report);
  });
}

int32_t ents_surface_evaluate(const ents_model* model, int64_t count, const ents_surface* surface,
                              ents_report* report) {
  return ents::entry_point(report, [&] {
    std::int32_t status = ents::check_handle(model, report);
    if (status != ENTS_OK) return status;
    ents_surface copy;
    const ents_surface* s = ents::known_struct(surface, copy, "surface", status, report);
    if (!s) return status;
    if (count < 0 || count > std::int64_t{1} << 50)
      return ents::report_message(report, ENTS_BAD_COUNT, -1, "count = %lld must be 0 .. 2^50",
                                  static_cast<long long>(count));
    if ((status = ents::check_reserved(s->reserved, "surface", report)) != ENTS_OK) return status;
    if (count > 0 && (!s->master || !s->xi))
      return ents::report_message(report, ENTS_NULL_ARGUMENT, -1, "surface.%s is null",
                                  s->master ? "xi" : "master");
    const ents::FloatingPointGuard guard;
    const ents::Plan& plan = model->plan;
    const std::int64_t d = plan.dimension;
    for (int64_t i = 0; i < count; ++i) {
      const ents::SurfacePoint point = {ents::at(s->point, d, i),
                                        ents::at(s->normal, d, i),
                                        ents::at(s->height, 1, i),
                                        ents::at(s->base_point, d, i),
                                        ents::at(s->base_normal, d, i),
                                        nullptr,
                                        nullptr};
      status = static_cast<std::int32_t>(
          plan.surface(plan, s->master, s->surface_coordinates, s->xi + plan.parameters * i, point));
      if (status == ENTS_NON_FINITE)
        return ents::explain_non_finite(plan, "surface.", s->master, s->surface_coordinates,
                                        s->xi + plan.parameters * i, i, report);
      double place[2];
      if ((status == ENTS_DEGENERATE_SEGMENT || status == ENTS_OUT_OF_RANGE) &&
          ents::height_is_undefined(plan, s->master, s->surface_coordinates, s->xi + plan.parameters * i,
                                    place))
        return ents::report_undefined_height(plan, "point", i, place, report);
      if (status != ENTS_OK)
        return ents::report_message(report, status, i, "point %lld: %s", static_cast<long long>(i),
                                    ents_status_text(status));
    }
    return ents::report_ok(report);
  });
}

} // extern "C"
