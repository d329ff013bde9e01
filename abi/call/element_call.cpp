// SPDX-License-Identifier: BSD-3-Clause
// What a call of elements checks of its arguments, once, and what it says of elements that were refused.
#include "abi/call/element_call.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "abi/call/undefined_height.hpp"
#include "core/law/open_multiplier.hpp"
#include "core/model/slave_values.hpp"

namespace ents {

std::int32_t refuse_without_contact(const char* asks, ents_report* report) {
  return report_message(report, ENTS_BAD_MASK, -1,
                        "%s, but the model has no \"contact\": add {\"contact\": {\"normal\": {\"type\": "
                        "\"penalty\", \"stiffness\": ...}}}",
                        asks);
}

namespace {

// An array of an input or output struct, as the checks and messages need it.
struct Array {
  const char* name;
  const void* data;
  std::int64_t stride;
  std::int64_t size; // of one element
};

Array output_array(const ents_model& model, const ents_output& out, int bit_number) noexcept {
  const Plan& plan = model.plan;
  const std::int64_t d = plan.dimension, t = plan.parameters, all = model.sizes.dofs,
                     n = d * (plan.rigid ? 1 : 1 + model.sizes.nodes), states = model.sizes.state,
                     tangent = (all - 1) * leading_dimension(model, out) + all;
  switch (bit_number) {
#define ENTS_CASE(bit, public_name, name, field, type, size)                                                 \
  case bit:                                                                                                  \
    return {#field, out.field, out.field##_stride, size};
    ENTS_RESULTS(ENTS_CASE)
#undef ENTS_CASE
  default:
    return {};
  }
}

// The distance of elements of an array that has elements 0 .. last; 0 is `smallest` where elements may share
// values.
std::int32_t check_stride(const char* group, const Array& a, std::int64_t smallest, std::int64_t last,
                          ents_report* report) {
  if (a.stride < smallest)
    return report_message(report, ENTS_BAD_COUNT, -1, "%s.%s_stride is %lld; %sat least %lld is needed",
                          group, a.name, static_cast<long long>(a.stride),
                          group[0] == 'i' ? "0 (shared) or " : "", static_cast<long long>(smallest));
  const auto width = [](std::int64_t n) { return std::bit_width(static_cast<std::uint64_t>(n)); };
  if (width(a.stride) + width(last) > most_bits)
    return report_message(report, ENTS_BAD_COUNT, -1,
                          "%s.%s_stride is %lld; element %lld would lie beyond any memory", group, a.name,
                          static_cast<long long>(a.stride), static_cast<long long>(last));
  return ENTS_OK;
}

std::int32_t check_output(const ents_model& model, std::int64_t first, std::int64_t count,
                          const ents_output& out, ents_report* report) {
  if ((out.wanted & ~want::all) != 0)
    return report_message(report, ENTS_BAD_MASK, -1, "output.wanted has unknown bits (0x%x)",
                          static_cast<unsigned>(out.wanted & ~want::all));
  if ((out.wanted & ENTS_HEAT) != 0 && !model.plan.heat)
    return report_status(report, ENTS_BAD_MASK, -1,
                         "output.wanted asks for the heat, but the model's \"contact\" has no \"heat\"");
  if ((out.wanted & want::needs_law) != 0 && model.model.law.normal == NormalKind::none)
    return refuse_without_contact("output.wanted asks for energy, pressure, residual or tangent", report);
  if (count == 0) return ENTS_OK;
  const std::int64_t last = first + count - 1;
  if (const std::int64_t leading = leading_dimension(model, out);
      (out.wanted & ENTS_TANGENT) != 0 && (leading < model.sizes.dofs || leading > INT32_MAX))
    return report_message(report, ENTS_BAD_COUNT, -1,
                          "output.tangent_leading_dimension is %lld; 0 or %d .. %d is needed",
                          static_cast<long long>(leading), model.sizes.dofs, INT32_MAX);
  for (std::uint32_t bits = static_cast<std::uint32_t>(out.wanted); bits != 0; bits &= bits - 1) {
    const Array a = output_array(model, out, std::countr_zero(bits));
    if (!a.data)
      return report_message(report, ENTS_NULL_ARGUMENT, -1,
                            "output.%s is null but its bit is set in output.wanted", a.name);
    if (last > 0)
      if (const std::int32_t status = check_stride("output", a, a.size, last, report); status != ENTS_OK)
        return status;
  }
  if (out.status && last > 0)
    return check_stride("output", {"status", out.status, out.status_stride, 1}, 1, last, report);
  return ENTS_OK;
}

// f(array) of each input
template <class F> void for_each_input(const ents_model& model, const ents_input& in, F&& f) {
  const Plan& plan = model.plan;
  const std::int64_t d = plan.dimension, t = plan.parameters, m = model.sizes.nodes,
                     states = model.sizes.state, multipliers = plan.multipliers,
                     slave_values = model.model.law.slave_values();
#define ENTS_ARRAY(field, size) f(Array{#field, in.field, in.field##_stride, size});
  ENTS_INPUT_ARRAYS(ENTS_ARRAY)
#undef ENTS_ARRAY
}

std::int32_t check_input(const ents_model& model, std::int64_t first, std::int64_t count,
                         const ents_input& in, ents_report* report) {
  constexpr std::int64_t most = std::int64_t{1} << 50;
  if (first < 0 || count < 0 || first > most - count)
    return report_message(report, ENTS_BAD_COUNT, -1,
                          "first = %lld, count = %lld: both must be >= 0 and end before element 2^50",
                          static_cast<long long>(first), static_cast<long long>(count));
  if (const std::int32_t status = check_reserved(in.reserved, "input", report); status != ENTS_OK)
    return status;
  if (count == 0) return ENTS_OK;
  if (!in.slave) return report_status(report, ENTS_NULL_ARGUMENT, -1, "input.slave is null");
  if (in.mesh && !in.segment)
    return report_status(report, ENTS_NULL_ARGUMENT, -1, "input.segment is null, but input.mesh is not");
  if (in.mesh && (in.master || in.surface_coordinates || in.master_temperature))
    return report_message(report, ENTS_BAD_VALUE, -1,
                          "input.%s and input.mesh are both given; one must be null",
                          in.master                ? "master"
                          : in.surface_coordinates ? "surface_coordinates"
                                                   : "master_temperature");
  if ((in.slave_temperature || in.master_temperature) && !model.plan.heat)
    return report_message(report, ENTS_BAD_VALUE, -1,
                          "input.%s_temperature is given, but the model's \"contact\" has no \"heat\"",
                          in.slave_temperature ? "slave" : "master");
  if (!in.mesh && !in.master)
    return report_status(report, ENTS_NULL_ARGUMENT, -1, "input.master is null (and input.mesh, too)");
  if (in.mesh && !model.model.patch.empty())
    return report_status(report, ENTS_BAD_VALUE, -1,
                         "input.mesh is given, but the model has a \"patch\": its elements bring their own "
                         "nodes in input.master");
  if (model.plan.multipliers > 0 && !in.multiplier)
    return report_message(report, ENTS_NULL_ARGUMENT, -1,
                          "input.multiplier is null, but the model has %d multiplier dofs",
                          model.plan.multipliers);
  if (in.slave_values && !model.model.law.has_slave_values())
    return report_status(
        report, ENTS_BAD_VALUE, -1,
        "input.slave_values is given, but the model's \"contact\" has neither \"offset\" nor "
        "\"wear\" nor a normal law \"table\", which would read it; write \"offset\": 0");
  const std::int64_t last = first + count - 1;
  if (in.mesh && last > 0 && in.segment_stride != 0)
    if (const std::int32_t status =
            check_stride("input", {"segment", in.segment, in.segment_stride, 1}, 1, last, report);
        status != ENTS_OK)
      return status;
  std::int32_t status = ENTS_OK;
  for_each_input(model, in, [&](const Array& a) {
    if (last > 0 && status == ENTS_OK && a.data && a.stride != 0)
      status = check_stride("input", a, a.size, last, report);
  });
  return status;
}

} // namespace

std::int32_t ElementCall::check_temperatures(ents_report* report) const {
  if (!plan->heat) return ENTS_OK;
  const bool of_mesh = in->mesh != nullptr;
  const struct {
    const char* name;
    const double* array;
  } arrays[] = {{"input.slave_temperature", in->slave_temperature},
                {of_mesh ? "input.mesh.temperature" : "input.master_temperature",
                 of_mesh ? mesh.temperature : in->master_temperature}};
  for (const auto& a : arrays)
    if (!a.array)
      return report_message(report, ENTS_NULL_ARGUMENT, -1,
                            "%s is null, but the model has \"heat\": give the temperatures", a.name);
  if (plan->law.heat.has_friction && !is_time_increment(in->time_increment))
    return report_message(report, ENTS_BAD_VALUE, -1,
                          "input.time_increment = %g; the heat of friction is a power: give the time of the "
                          "increment, > 0",
                          in->time_increment);
  return ENTS_OK;
}

std::int32_t ElementCall::check_time(ents_report* report) const {
  if (plan->law.varying.by_rate() && !is_time_increment(in->time_increment))
    return report_message(
        report, ENTS_BAD_VALUE, -1,
        "input.time_increment = %g; the coefficient of friction depends on the slip rate: give "
        "the time of the increment, > 0",
        in->time_increment);
  return ENTS_OK;
}

std::int32_t ElementCall::open(const ents_model* handle, std::int64_t first, std::int64_t count,
                               const ents_input* input, const ents_output* output, ents_report* report) {
  std::int32_t status = check_handle(handle, report);
  if (status != ENTS_OK) return status;
  model = handle, plan = &handle->plan;
  keeps_history = handle->model.law.has_friction() || handle->model.law.wear.on;
  in = known_struct(input, input_copy, "input", status, report);
  if (!in) return status;
  out = known_struct(output, output_copy, "output", status, report);
  if (!out) return status;
  if ((status = check_input(*handle, first, count, *in, report)) != ENTS_OK) return status;
  if ((status = check_output(*handle, first, count, *out, report)) != ENTS_OK) return status;
  if (states_overlap(*handle, *in, *out, first, count))
    return report_status(report, ENTS_BAD_VALUE, -1,
                         "output.state_end overlaps input.state_begin; give it an array of its own");
  const bool in_place = in->start == out->xi && (first + count <= 1 || in->start_stride == out->xi_stride);
  if (!in_place && writes_start(*handle, *in, *out, first, count))
    return report_status(
        report, ENTS_BAD_VALUE, -1,
        "output.xi overlaps input.start; give it an array of its own, or that one with its stride");
  if (in->mesh && (status = check_mesh(in->mesh, "input.mesh", mesh, report)) != ENTS_OK) return status;
  if ((out->wanted & (want::element | want::flags)) != 0 && count > 0 &&
      (status = check_time(report)) != ENTS_OK)
    return status;
  return (out->wanted & (ENTS_RESIDUAL | ENTS_TANGENT | ENTS_HEAT)) != 0 && count > 0
             ? check_temperatures(report)
             : ENTS_OK;
}

std::int32_t ElementCall::refuse_segment(std::int64_t e, ents_report* report) const {
  return report_message(report, ENTS_BAD_VALUE, e, "input.segment of element %lld is %lld; 0 .. %lld",
                        static_cast<long long>(e), static_cast<long long>(segment(e)),
                        static_cast<long long>(mesh.segments - 1));
}

void ElementCall::write_open(std::int64_t e) const {
  for (std::uint32_t bits = static_cast<std::uint32_t>(out->wanted); bits != 0; bits &= bits - 1) {
    const int bit = std::countr_zero(bits);
    const Array a = output_array(*model, *out, bit);
    if ((1 << bit) == ENTS_TANGENT) // the padding is the caller's
      for (std::int64_t j = 0; j < model->sizes.dofs; ++j)
        std::fill_n(at(out->tangent, out->tangent_stride, e) + j * leading_dimension(*model, *out),
                    model->sizes.dofs, 0.0);
    else if (bit >= std::countr_zero(std::uint32_t{ENTS_FLAGS}) && (1 << bit) <= ENTS_ITERATIONS)
      *at(static_cast<std::int32_t*>(const_cast<void*>(a.data)), a.stride, e) =
          (1 << bit) == ENTS_FLAGS ? ENTS_FLAG_OUTSIDE : 0;
    else
      std::fill_n(at(static_cast<double*>(const_cast<void*>(a.data)), a.stride, e), a.size, 0.0);
  }
  if ((out->wanted & ENTS_STATE) != 0) {
    double* state = at(out->state_end, out->state_end_stride, e);
    state[StateLayout::tag_at] = plan->state.tag;
    keep_worn_depths(plan->state, at(in->state_begin, in->state_begin_stride, e), state);
  }
}

// A slave without area has its equations, too.
void ElementCall::hold_multipliers(std::int64_t e, double* residual, double* tangent,
                                   std::int64_t leading) const {
  const double given = in->area ? *at(in->area, in->area_stride, e) : 1.0, area = given == 0.0 ? 1.0 : given;
  const double* lambda = at(in->multiplier, in->multiplier_stride, e);
  const std::int64_t size = plan->multipliers, first = model->sizes.dofs - size;
  for (std::int64_t a = 0; residual && a < size; ++a)
    residual[first + a] = ENTS_ISA::open_multiplier_residual(plan->law, static_cast<int>(a), area, lambda[a]);
  for (std::int64_t a = 0; tangent && a < size; ++a)
    for (std::int64_t b = 0; b < size; ++b)
      tangent[(first + b) * leading + first + a] =
          a == b ? ENTS_ISA::open_multiplier_tangent(plan->law, static_cast<int>(a), area) : 0.0;
  if ((out->wanted & ENTS_ENERGY) != 0)
    *at(out->energy, out->energy_stride, e) =
        area * ENTS_ISA::open_multiplier_energy(plan->law.number[0], lambda[0]);
}

// As the element kernel, but without `start`, which elements without a segment do not have.
std::int32_t ElementCall::check_open(std::int64_t e) const {
  const double *area = at(in->area, in->area_stride, e),
               *lambda = at(in->multiplier, in->multiplier_stride, e);
  if (first_non_finite(at(in->slave, in->slave_stride, e), plan->dimension) >= 0 ||
      first_non_finite(area, 1) >= 0 || first_non_finite(lambda, plan->multipliers) >= 0)
    return ENTS_NON_FINITE;
  if (area && *area < 0.0) return ENTS_BAD_VALUE;
  if (const Status status =
          ENTS_ISA::check_slave_values(plan->law, at(in->slave_values, in->slave_values_stride, e));
      status != Status::ok)
    return static_cast<std::int32_t>(status);
  if (in->state_begin &&
      !(is_state(plan->state, at(in->state_begin, in->state_begin_stride, e)) &&
        is_segment_number(at(in->state_begin, in->state_begin_stride, e)[plan->state.size])))
    return ENTS_BAD_STATE;
  constexpr double largest = 1e60; // products of a few such numbers stay in range
  double size = 0.0;
  for (int a = 0; a < plan->multipliers; ++a)
    size +=
        std::fabs(lambda[a]) * (1.0 + 1.0 / (a == 0 ? plan->law.number[0] : plan->law.friction_stiffness));
  return (area ? 1.0 + *area : 1.0) * size < largest ? ENTS_OK : ENTS_OUT_OF_RANGE;
}

std::int32_t ElementCall::evaluate_open(std::int64_t e, const Wanted& also) const {
  const std::int32_t outcome = check_open(e);
  if (out->status) *at(out->status, out->status_stride, e) = outcome;
  if (outcome != ENTS_OK) return outcome;
  write_open(e);
  if (plan->multipliers == 0) return ENTS_OK;
  const auto own = [&](std::int32_t bit, double* data, std::int64_t stride) {
    return (out->wanted & bit) != 0 ? at(data, stride, e) : nullptr;
  };
  hold_multipliers(e, also.residual ? also.residual : own(ENTS_RESIDUAL, out->residual, out->residual_stride),
                   also.tangent ? also.tangent : own(ENTS_TANGENT, out->tangent, out->tangent_stride),
                   also.tangent ? plan->dofs : leading_dimension(*model, *out));
  return ENTS_OK;
}

ElementInput ElementCall::element(std::int64_t e, const SegmentNodes& nodes) const {
  ElementInput element;
#define ENTS_ARRAY(field, size) element.field = at(in->field, in->field##_stride, e);
  ENTS_INPUT_ARRAYS(ENTS_ARRAY)
#undef ENTS_ARRAY
  if (in->mesh) element.master = nodes.positions, element.surface_coordinates = nodes.surface_coordinates;
  element.start_first = start_first;
  element.time_increment = in->time_increment;
  return element;
}

std::int32_t ElementCall::explain(std::int32_t status, std::int64_t e, ents_report* report) const {
  const long long number = e;
  if (status == ENTS_NON_FINITE) {
    std::int32_t reported = ENTS_OK;
    for_each_input(*model, *in, [&](const Array& a) {
      if (reported != ENTS_OK || (std::strcmp(a.name, "start") == 0 && in->mesh && segment(e) < 0)) return;
      const double* v = at(static_cast<const double*>(a.data), a.stride, e);
      if (const std::int64_t k = first_non_finite(v, a.size); k >= 0)
        reported = report_message(report, status, e, "input.%s[%lld] of element %lld is %s", a.name,
                                  static_cast<long long>(k), number, std::isnan(v[k]) ? "NaN" : "infinite");
    });
    if (reported != ENTS_OK) return reported;
  }
  if (status == ENTS_BAD_VALUE && in->area && *at(in->area, in->area_stride, e) < 0.0)
    return report_message(report, status, e, "input.area of element %lld is negative", number);
  if (status == ENTS_BAD_VALUE)
    return report_message(
        report, status, e,
        "input.slave_values of element %lld has a negative factor of the wear coefficient or of "
        "\"sliding\" (entries 1 and 2), or a scale of the table that is not positive (entry 3)",
        number);
  if (status == ENTS_BAD_STATE && in->state_begin && in->mesh &&
      is_state(plan->state, at(in->state_begin, in->state_begin_stride, e)) &&
      is_segment_number(at(in->state_begin, in->state_begin_stride, e)[plan->state.size]) &&
      !state_follows(e))
    return report_message(
        report, status, e,
        "input.state_begin of element %lld was made on segment %lld, the element is on segment %lld: move it "
        "with "
        "ents_state_transfer first, or friction forces are wrong",
        number, static_cast<long long>(at(in->state_begin, in->state_begin_stride, e)[plan->state.size]) - 1,
        static_cast<long long>(segment(e)));
  if (status == ENTS_BAD_STATE)
    return report_message(report, status, e,
                          "input.state_begin of element %lld is not a state of this segment type, law and "
                          "version; fill it with ents_state_init",
                          number);
  if (status == ENTS_DEEP_PENETRATION && report) return explain_penetration(e, report);
  if (status == ENTS_GRAZING_RAY && report) return explain_ray(e, report);
  if (status == ENTS_NO_PROJECTION && report && model->model.patch.empty()) {
    SegmentNodes nodes;
    double s[2];
    if (in->mesh) gather(*plan, mesh, segment(e), nodes);
    if (height_is_undefined(*plan, element(e, nodes), s))
      return report_undefined_height(*plan, "element", e, s, report);
  }
  if (status == ENTS_AMBIGUOUS_PROJECTION && plan->law.flattening.parameter != 0)
    return report_message(
        report, status, e,
        "element %lld: two points of the segment are equally close, or its height has several "
        "scales under its pressure: a hollow rises faster than the pressure on it. Take a larger "
        "\"pressure\" in \"flattening\", or a softer normal law",
        number);
  return report_message(report, status, e, "element %lld: %s", number, ents_status_text(status));
}

} // namespace ents
