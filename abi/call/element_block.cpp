// SPDX-License-Identifier: BSD-3-Clause
#include "abi/call/element_block.hpp"

#include <cstddef>

namespace ents {

// Does anyone look at the places of other results?
static bool only_forces(std::int32_t wanted) noexcept { return (wanted & ~want::forces) == 0; }

ElementBlock element_block_of(const ents_model& model, const ents_input& in, const ents_output& out,
                              std::int64_t first) noexcept {
  ElementBlock b;
#define ENTS_COPY(field, size) b.field = in.field, b.field##_stride = in.field##_stride;
  ENTS_BLOCK_INPUT_ARRAYS(ENTS_COPY)
#undef ENTS_COPY
  b.first = first;
  if (model.plan.heat || model.plan.law.varying.by_rate())
    b.time_increment = in.time_increment; // an older struct has none
  if (model.plan.heat) {
    b.slave_temperature = in.slave_temperature, b.slave_temperature_stride = in.slave_temperature_stride;
    b.master_temperature = in.master_temperature, b.master_temperature_stride = in.master_temperature_stride;
    b.heat = out.heat, b.heat_stride = out.heat_stride;
  }
  b.wanted = block_results_of(model, out.wanted);
#define ENTS_COPY(bit, public_name, name, field, type, size)                                                 \
  b.field = out.field, b.field##_stride = out.field##_stride;
  ENTS_FORCE_RESULTS(ENTS_COPY)
  b.leading = leading_dimension(model, out);
  if (only_forces(b.wanted)) return b;
  ENTS_OTHER_RESULTS(ENTS_COPY)
#undef ENTS_COPY
  return b;
}

namespace {

// All that ents_evaluate refuses is false here.
bool is_plain_call(const ents_model* model, std::int64_t first, std::int64_t count, const ents_input* in,
                   const ents_output* out, const ents_report* report) noexcept {
  constexpr std::int64_t most = std::int64_t{1} << 28;
  if (!model || model->magic != ents_model::live || !in || !out) return false;
  // Older structs that have all that is read here: those before heat, whose elements are in no block
  const auto is_one_of = [](std::int32_t size, std::size_t whole, std::size_t before_heat) {
    return size == static_cast<std::int32_t>(whole) || size == static_cast<std::int32_t>(before_heat);
  };
  if (!is_one_of(in->struct_size, sizeof *in, offsetof(ents_input, slave_temperature)) ||
      !is_one_of(out->struct_size, sizeof *out,
                 only_forces(out->wanted) ? offsetof(ents_output, dissipation) : sizeof *out))
    return false;
  if (report && report->struct_size != static_cast<std::int32_t>(sizeof *report)) return false;
  const Plan& plan = model->plan;
  if (plan.heat) return false;
  if (plan.law.varying.by_rate() &&
      (in->struct_size != static_cast<std::int32_t>(sizeof *in) || !is_time_increment(in->time_increment)))
    return false;
  const std::int32_t wanted = out->wanted;
  if (wanted == 0 || block_results_of(*model, wanted) != wanted) return false;
  if (first < 0 || count < 1 || first > most || count > most) return false;
  if (in->struct_size == static_cast<std::int32_t>(sizeof *in) &&
      (in->slave_temperature || in->master_temperature))
    return false; // of a model without heat
  if (in->reserved != 0 || in->mesh || !in->slave || !in->master || !(in->start || in->state_begin))
    return false;
  const bool one = first + count == 1; // its strides are of no meaning
  const auto shared = [one](const void* data, std::int64_t stride, std::int64_t size) ENTS_LAMBDA_INLINE {
    return !data || one || stride == 0 || (stride >= size && stride < most);
  };
  const auto own = [wanted, one](std::int32_t bit, const void* data, std::int64_t stride, std::int64_t size)
                       ENTS_LAMBDA_INLINE {
                         return (wanted & bit) == 0 || (data && (one || (stride >= size && stride < most)));
                       };
  const std::int64_t d = plan.dimension, t = plan.parameters, m = plan.nodes, all = plan.dofs,
                     states = model->sizes.state, multipliers = plan.multipliers,
                     slave_values = in->slave_values ? model->model.law.slave_values() : 0,
                     leading = leading_dimension(*model, *out), tangent = (all - 1) * leading + all;
#define ENTS_CHECK(field, size) &&shared(in->field, in->field##_stride, size)
  if (!(leading >= all && leading < most ENTS_BLOCK_INPUT_ARRAYS(ENTS_CHECK))) return false;
#undef ENTS_CHECK
  if ((in->slave_values && !model->model.law.has_slave_values()) || (multipliers > 0 && !in->multiplier) ||
      (out->status && !one && (out->status_stride < 1 || out->status_stride >= most)))
    return false;
#define ENTS_CHECK(bit, public_name, name, field, type, size)                                                \
  &&own(want::name, out->field, out->field##_stride, size)
  if (!(true ENTS_FORCE_RESULTS(ENTS_CHECK))) return false;
  if (only_forces(wanted)) return true;
  return true ENTS_OTHER_RESULTS(ENTS_CHECK) && !writes_start(*model, *in, *out, first, count) &&
         !states_overlap(*model, *in, *out, first, count);
#undef ENTS_CHECK
}

} // namespace

PlainCall evaluate_plain_call(const ents_model* model, std::int64_t first, std::int64_t count,
                              const ents_input* in, const ents_output* out,
                              const ents_report* report) noexcept {
  if (count > ElementBlock::most || !is_plain_call(model, first, count, in, out, report)) return {};
  if (in->state_begin)
    for (std::int64_t e = first; e < first + count; ++e)
      if (!is_segment_number(in->state_begin[e * in->state_begin_stride + model->plan.state.size])) return {};
  const ElementBlock block = element_block_of(*model, *in, *out, first);
  const std::uint64_t done = evaluate_block(model->plan, block, static_cast<std::int32_t>(count));
  for (std::int64_t k = 0; k < count; ++k) {
    if ((done >> k & 1) == 0) continue;
    if (out->status) out->status[(first + k) * out->status_stride] = ENTS_OK;
    if ((out->wanted & ENTS_STATE) != 0) // without a mesh nobody knows the segment
      out->state_end[(first + k) * out->state_end_stride + model->plan.state.size] = 0.0;
  }
  return {true, done};
}

} // namespace ents
