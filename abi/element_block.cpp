// SPDX-License-Identifier: BSD-3-Clause
#include "abi/element_block.hpp"

namespace ents {

namespace {

// Does anyone look at the other results' places?
bool only_forces(std::int32_t wanted) noexcept { return (wanted & ~(want::residual | want::tangent)) == 0; }

} // namespace

PairBlock pair_block(const ents_model& model, const ents_input& in, const ents_output& out,
                     std::int64_t first) noexcept {
  PairBlock b;
  b.slave = in.slave, b.slave_stride = in.slave_stride;
  b.master = in.master, b.master_stride = in.master_stride;
  b.surface_coordinates = in.surface_coordinates,
  b.surface_coordinates_stride = in.surface_coordinates_stride;
  b.start = in.start, b.start_stride = in.start_stride;
  b.area = in.area, b.area_stride = in.area_stride;
  b.state_begin = in.state_begin, b.state_begin_stride = in.state_begin_stride;
  b.multiplier = in.multiplier, b.multiplier_stride = in.multiplier_stride;
  b.slave_values = in.slave_values, b.slave_values_stride = in.slave_values_stride;
  b.first = first;
  b.wanted = pair_results(model, out.wanted);
  b.residual = out.residual, b.residual_stride = out.residual_stride;
  b.tangent = out.tangent, b.tangent_stride = out.tangent_stride;
  b.leading = leading_dimension(model, out);
  if (only_forces(b.wanted)) return b;
  b.xi = out.xi, b.xi_stride = out.xi_stride;
  b.gap = out.gap, b.gap_stride = out.gap_stride;
  b.normal_gap = out.normal_gap, b.normal_gap_stride = out.normal_gap_stride;
  b.normal = out.normal, b.normal_stride = out.normal_stride;
  b.point = out.point, b.point_stride = out.point_stride;
  b.traction = out.traction, b.traction_stride = out.traction_stride;
  b.energy = out.energy, b.energy_stride = out.energy_stride;
  b.pressure = out.pressure, b.pressure_stride = out.pressure_stride;
  b.state_end = out.state_end, b.state_end_stride = out.state_end_stride;
  b.slip = out.slip, b.slip_stride = out.slip_stride;
  b.age = out.age, b.age_stride = out.age_stride;
  b.flags = out.flags, b.flags_stride = out.flags_stride;
  b.iterations = out.iterations, b.iterations_stride = out.iterations_stride;
  return b;
}

void begin_at_first(PairBlock& b) noexcept {
  const std::int64_t elements = b.first;
  b.first = 0;
  const auto move = [elements](auto*& data, std::int64_t stride) {
    if (data) data += stride * elements;
  };
  move(b.slave, b.slave_stride);
  move(b.master, b.master_stride);
  move(b.surface_coordinates, b.surface_coordinates_stride);
  move(b.start, b.start_stride);
  move(b.area, b.area_stride);
  move(b.state_begin, b.state_begin_stride);
  move(b.multiplier, b.multiplier_stride);
  move(b.slave_values, b.slave_values_stride);
  move(b.residual, b.residual_stride);
  move(b.tangent, b.tangent_stride);
  if (only_forces(b.wanted)) return;
  move(b.xi, b.xi_stride);
  move(b.gap, b.gap_stride);
  move(b.normal_gap, b.normal_gap_stride);
  move(b.normal, b.normal_stride);
  move(b.point, b.point_stride);
  move(b.traction, b.traction_stride);
  move(b.energy, b.energy_stride);
  move(b.pressure, b.pressure_stride);
  move(b.state_end, b.state_end_stride);
  move(b.slip, b.slip_stride);
  move(b.age, b.age_stride);
  move(b.flags, b.flags_stride);
  move(b.iterations, b.iterations_stride);
}

namespace {

// All that ents_evaluate refuses is false here.
bool is_plain_call(const ents_model* model, std::int64_t first, std::int64_t count, const ents_input* in,
                   const ents_output* out, const ents_report* report) noexcept {
  constexpr std::int64_t most = std::int64_t{1} << 28;
  if (!model || model->magic != ents_model::live || !in || !out) return false;
  if (in->struct_size != static_cast<std::int32_t>(sizeof *in) ||
      out->struct_size != static_cast<std::int32_t>(sizeof *out))
    return false;
  if (report && report->struct_size != static_cast<std::int32_t>(sizeof *report)) return false;
  const Plan& plan = model->plan;
  const std::int32_t wanted = out->wanted;
  if (wanted == 0 || pair_results(*model, wanted) != wanted) return false;
  if (first < 0 || count < 1 || first > most || count > most) return false;
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
  const std::int64_t d = plan.dimension, t = plan.parameters, m = plan.nodes, n = plan.dofs;
  const std::int64_t leading = leading_dimension(*model, *out);
  if (!(shared(in->slave, in->slave_stride, d) && shared(in->master, in->master_stride, m * d) &&
        shared(in->surface_coordinates, in->surface_coordinates_stride, m * t) &&
        shared(in->start, in->start_stride, t) && shared(in->area, in->area_stride, 1) &&
        shared(in->state_begin, in->state_begin_stride, model->sizes.state) &&
        (!in->slave_values || (model->model.law.has_slave_values() &&
                               shared(in->slave_values, in->slave_values_stride, slave_value::count))) &&
        (plan.multipliers == 0 ||
         (in->multiplier && shared(in->multiplier, in->multiplier_stride, plan.multipliers))) &&
        own(want::residual, out->residual, out->residual_stride, n) && leading >= n && leading < most &&
        own(want::tangent, out->tangent, out->tangent_stride, (n - 1) * leading + n) &&
        (!out->status || one || (out->status_stride >= 1 && out->status_stride < most))))
    return false;
  if ((wanted & ~(want::residual | want::tangent)) == 0) return true;
  return own(want::xi, out->xi, out->xi_stride, t) && !writes_start(*model, *in, *out, first, count) &&
         own(want::gap, out->gap, out->gap_stride, 1) &&
         own(want::normal_gap, out->normal_gap, out->normal_gap_stride, 1) &&
         own(want::normal, out->normal, out->normal_stride, d) &&
         own(want::point, out->point, out->point_stride, d) &&
         own(want::traction, out->traction, out->traction_stride, d) &&
         own(want::energy, out->energy, out->energy_stride, 1) &&
         own(want::pressure, out->pressure, out->pressure_stride, 1) &&
         own(want::state, out->state_end, out->state_end_stride, model->sizes.state) &&
         !states_overlap(*model, *in, *out, first, count) &&
         own(want::slip, out->slip, out->slip_stride, 1) && own(want::age, out->age, out->age_stride, 1) &&
         own(want::flags, out->flags, out->flags_stride, 1) &&
         own(want::iterations, out->iterations, out->iterations_stride, 1);
}

} // namespace

PlainCall evaluate_plain_call(const ents_model* model, std::int64_t first, std::int64_t count,
                              const ents_input* in, const ents_output* out,
                              const ents_report* report) noexcept {
  if (count > PairBlock::most || !is_plain_call(model, first, count, in, out, report)) return {};
  if (in->state_begin)
    for (std::int64_t e = first; e < first + count; ++e)
      if (!is_segment_number(in->state_begin[e * in->state_begin_stride + model->plan.state.size])) return {};
  const PairBlock block = pair_block(*model, *in, *out, first);
  const std::uint64_t done = model->plan.pairs(model->plan, block, static_cast<std::int32_t>(count));
  for (std::int64_t k = 0; k < count; ++k) {
    if ((done >> k & 1) == 0) continue;
    if (out->status) out->status[(first + k) * out->status_stride] = ENTS_OK;
    if ((out->wanted & ENTS_STATE) != 0) // without a mesh nobody knows the segment
      out->state_end[(first + k) * out->state_end_stride + model->plan.state.size] = 0.0;
  }
  return {true, done};
}

} // namespace ents
