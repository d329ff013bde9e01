// SPDX-License-Identifier: BSD-3-Clause
// ents_evaluate: arguments checked once, then one kernel call per element.
#include <algorithm>
#include <bit>
#include <cmath>

#include "abi/element_block.hpp"
#include "abi/guard.hpp"
#include "core/pair_kernels.hpp"
#include "core/past_caches.hpp"

namespace ents {

namespace {

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
static_assert(want::xi == ENTS_XI && want::gap == ENTS_GAP && want::normal_gap == ENTS_NORMAL_GAP);
static_assert(want::normal == ENTS_NORMAL && want::point == ENTS_POINT);
static_assert(want::gap_gradient == ENTS_GAP_GRADIENT && want::gap_hessian == ENTS_GAP_HESSIAN);
static_assert(want::xi_gradient == ENTS_XI_GRADIENT && want::xi_hessian == ENTS_XI_HESSIAN);
static_assert(want::energy == ENTS_ENERGY && want::pressure == ENTS_PRESSURE);
static_assert(want::residual == ENTS_RESIDUAL && want::tangent == ENTS_TANGENT && want::state == ENTS_STATE);
static_assert(want::flags == ENTS_FLAGS && want::iterations == ENTS_ITERATIONS);
static_assert(want::traction == ENTS_TRACTION && want::slip == ENTS_SLIP && want::age == ENTS_AGE);
static_assert(flag::contact == ENTS_FLAG_CONTACT && flag::outside == ENTS_FLAG_OUTSIDE);
static_assert(flag::far_side == ENTS_FLAG_FAR_SIDE && flag::searched == ENTS_FLAG_SEARCHED);
static_assert(flag::stick == ENTS_FLAG_STICK && flag::slip == ENTS_FLAG_SLIP);
static_assert(flag::shear_limit == ENTS_FLAG_SHEAR_LIMIT && flag::changed == ENTS_FLAG_CHANGED);

// An array of an input or output struct, as the checks and messages need it.
struct Array {
  const char* name;
  const void* data;
  std::int64_t stride;
  std::int64_t size; // of one element
};

std::int64_t leading_dimension(const ents_model& model, const ents_output& out) noexcept {
  return out.tangent_leading_dimension == 0 ? model.sizes.dofs : out.tangent_leading_dimension;
}

Array output_array(const ents_model& model, const ents_output& out, int bit) noexcept {
  const Plan& plan = model.plan;
  const std::int64_t d = plan.dimension, t = plan.parameters, all = model.sizes.dofs, n = all - plan.multipliers;
  switch (1 << bit) {
  case ENTS_XI:
    return {"xi", out.xi, out.xi_stride, t};
  case ENTS_GAP:
    return {"gap", out.gap, out.gap_stride, 1};
  case ENTS_NORMAL_GAP:
    return {"normal_gap", out.normal_gap, out.normal_gap_stride, 1};
  case ENTS_NORMAL:
    return {"normal", out.normal, out.normal_stride, d};
  case ENTS_POINT:
    return {"point", out.point, out.point_stride, d};
  case ENTS_GAP_GRADIENT:
    return {"gap_gradient", out.gap_gradient, out.gap_gradient_stride, n};
  case ENTS_GAP_HESSIAN:
    return {"gap_hessian", out.gap_hessian, out.gap_hessian_stride, n * n};
  case ENTS_XI_GRADIENT:
    return {"xi_gradient", out.xi_gradient, out.xi_gradient_stride, t * n};
  case ENTS_XI_HESSIAN:
    return {"xi_hessian", out.xi_hessian, out.xi_hessian_stride, t * n * n};
  case ENTS_ENERGY:
    return {"energy", out.energy, out.energy_stride, 1};
  case ENTS_PRESSURE:
    return {"pressure", out.pressure, out.pressure_stride, 1};
  case ENTS_RESIDUAL:
    return {"residual", out.residual, out.residual_stride, all};
  case ENTS_TANGENT:
    return {"tangent", out.tangent, out.tangent_stride, (all - 1) * leading_dimension(model, out) + all};
  case ENTS_STATE:
    return {"state_end", out.state_end, out.state_end_stride, model.sizes.state};
  case ENTS_FLAGS:
    return {"flags", out.flags, out.flags_stride, 1};
  case ENTS_ITERATIONS:
    return {"iterations", out.iterations, out.iterations_stride, 1};
  case ENTS_TRACTION:
    return {"traction", out.traction, out.traction_stride, d};
  case ENTS_SLIP:
    return {"slip", out.slip, out.slip_stride, 1};
  default:
    return {"age", out.age, out.age_stride, 1};
  }
}

// The distance of elements of an array that has elements 0 .. last; 0 is `smallest` where elements may share values.
std::int32_t check_stride(const char* group, const Array& a, std::int64_t smallest, std::int64_t last,
                          ents_report* report) {
  if (a.stride < smallest)
    return report_message(report, ENTS_BAD_COUNT, -1, "%s.%s_stride is %lld; %sat least %lld is needed", group,
                          a.name, static_cast<long long>(a.stride), group[0] == 'i' ? "0 (shared) or " : "",
                          static_cast<long long>(smallest));
  const auto width = [](std::int64_t n) { return std::bit_width(static_cast<std::uint64_t>(n)); };
  if (width(a.stride) + width(last) > most_bits)
    return report_message(report, ENTS_BAD_COUNT, -1, "%s.%s_stride is %lld; element %lld would lie beyond any memory",
                          group, a.name, static_cast<long long>(a.stride), static_cast<long long>(last));
  return ENTS_OK;
}

std::int32_t check_output(const ents_model& model, std::int64_t first, std::int64_t count,
                          const ents_output& out, ents_report* report) {
  if ((out.wanted & ~want::all) != 0)
    return report_message(report, ENTS_BAD_MASK, -1, "output.wanted has unknown bits (0x%x)",
                          static_cast<unsigned>(out.wanted & ~want::all));
  if ((out.wanted & want::needs_law) != 0 && model.model.law.normal == NormalKind::none)
    return report_status(
        report, ENTS_BAD_MASK, -1,
        "output.wanted asks for energy, pressure, residual or tangent, but the model has no "
        "\"contact\": add {\"contact\": {\"normal\": {\"type\": \"penalty\", \"stiffness\": ...}}}");
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

constexpr int input_arrays = 7;
Array input_array(const ents_model& model, const ents_input& in, int index) noexcept {
  const Plan& plan = model.plan;
  const std::int64_t d = plan.dimension, t = plan.parameters, m = model.sizes.nodes;
  switch (index) {
  case 0:
    return {"slave", in.slave, in.slave_stride, d};
  case 1:
    return {"master", in.master, in.master_stride, m * d};
  case 2:
    return {"surface_coordinates", in.surface_coordinates, in.surface_coordinates_stride, m * t};
  case 3:
    return {"start", in.start, in.start_stride, t};
  case 4:
    return {"area", in.area, in.area_stride, 1};
  case 5:
    return {"state_begin", in.state_begin, in.state_begin_stride, model.sizes.state};
  default:
    return {"multiplier", in.multiplier, in.multiplier_stride, plan.multipliers};
  }
}

std::int32_t check_input(const ents_model& model, std::int64_t first, std::int64_t count, const ents_input& in,
                         ents_report* report) {
  constexpr std::int64_t most = std::int64_t{1} << 50;
  if (first < 0 || count < 0 || first > most - count)
    return report_message(report, ENTS_BAD_COUNT, -1,
                          "first = %lld, count = %lld: both must be >= 0 and end before element 2^50",
                          static_cast<long long>(first), static_cast<long long>(count));
  if (const std::int32_t status = check_reserved(in.reserved, "input", report); status != ENTS_OK) return status;
  if (count == 0) return ENTS_OK;
  if (!in.slave) return report_status(report, ENTS_NULL_ARGUMENT, -1, "input.slave is null");
  if (in.mesh && !in.segment) return report_status(report, ENTS_NULL_ARGUMENT, -1, "input.segment is null, but input.mesh is not");
  if (in.mesh && (in.master || in.surface_coordinates))
    return report_message(report, ENTS_BAD_VALUE, -1, "input.%s and input.mesh are both given; one must be null",
                          in.master ? "master" : "surface_coordinates");
  if (!in.mesh && !in.master)
    return report_status(report, ENTS_NULL_ARGUMENT, -1, "input.master is null (and input.mesh, too)");
  if (in.mesh && !model.model.patch.empty())
    return report_status(report, ENTS_BAD_VALUE, -1,
                         "input.mesh is given, but the model has a \"patch\": its elements bring their own nodes in input.master");
  if (model.plan.multipliers > 0 && !in.multiplier)
    return report_message(report, ENTS_NULL_ARGUMENT, -1, "input.multiplier is null, but the model has %d multiplier dofs",
                          model.plan.multipliers);
  const std::int64_t last = first + count - 1;
  if (in.mesh && last > 0 && in.segment_stride != 0)
    if (const std::int32_t status = check_stride("input", {"segment", in.segment, in.segment_stride, 1}, 1, last, report);
        status != ENTS_OK)
      return status;
  if (last > 0)
    for (int i = 0; i < input_arrays; ++i) {
      const Array a = input_array(model, in, i);
      if (!a.data || a.stride == 0) continue;
      if (const std::int32_t status = check_stride("input", a, a.size, last, report); status != ENTS_OK)
        return status;
    }
  return ENTS_OK;
}

// Name the entry a kernel refused.
std::int32_t explain(const ents_model& model, std::int32_t status, std::int64_t element, const ents_input& in,
                     ents_report* report) {
  const long long e = element;
  if (status == ENTS_NON_FINITE)
    for (int i = 0; i < input_arrays; ++i) {
      const Array a = input_array(model, in, i);
      const double* v = at(static_cast<const double*>(a.data), a.stride, element);
      const std::int64_t k = first_non_finite(v, a.size);
      if (k >= 0)
        return report_message(report, status, element, "input.%s[%lld] of element %lld is %s", a.name,
                              static_cast<long long>(k), e, std::isnan(v[k]) ? "NaN" : "infinite");
    }
  if (status == ENTS_BAD_VALUE)
    return report_message(report, status, element, "input.area of element %lld is negative", e);
  if (status == ENTS_BAD_STATE)
    return report_message(
        report, status, element,
        "input.state_begin of element %lld is not a state of this model and version; fill it with "
        "ents_state_init",
        e);
  return report_message(report, status, element, "element %lld: %s", e, ents_status_text(status));
}

} // namespace

std::int32_t ElementCall::open(const ents_model* handle, std::int64_t first, std::int64_t count, const ents_input* input,
                               const ents_output* output, ents_report* report) {
  std::int32_t status = check_handle(handle, report);
  if (status != ENTS_OK) return status;
  model = handle, plan = &handle->plan;
  in = known_struct(input, input_copy, "input", status, report);
  if (!in) return status;
  out = known_struct(output, output_copy, "output", status, report);
  if (!out) return status;
  if ((status = check_input(*handle, first, count, *in, report)) != ENTS_OK) return status;
  if ((status = check_output(*handle, first, count, *out, report)) != ENTS_OK) return status;
  return in->mesh ? check_mesh(in->mesh, "input.mesh", mesh, report) : ENTS_OK;
}

std::int32_t ElementCall::refuse_segment(std::int64_t e, ents_report* report) const {
  return report_message(report, ENTS_BAD_VALUE, e, "input.segment of element %lld is %lld; 0 .. %lld",
                        static_cast<long long>(e), static_cast<long long>(segment(e)),
                        static_cast<long long>(mesh.segments - 1));
}

std::int32_t ElementCall::evaluate(std::int64_t e, const Wanted& also, ents_report* report) const {
  SegmentNodes nodes;
  if (in->mesh) {
    const std::int64_t s = segment(e);
    const bool known = s >= 0 && s < mesh.segments;
    if (const Status outcome = known ? gather(*plan, mesh, s, nodes) : Status::bad_value; outcome != Status::ok) {
      if (out->status) *at(out->status, out->status_stride, e) = static_cast<std::int32_t>(outcome);
      return known ? explain_segment(*plan, mesh, outcome, s, report) : refuse_segment(e, report);
    }
  }
  const ElementInput element = {at(in->slave, in->slave_stride, e),
                                in->mesh ? nodes.positions : at(in->master, in->master_stride, e),
                                in->mesh ? nodes.surface_coordinates
                                        : at(in->surface_coordinates, in->surface_coordinates_stride, e),
                                at(in->start, in->start_stride, e),
                                at(in->area, in->area_stride, e),
                                at(in->state_begin, in->state_begin_stride, e),
                                at(in->multiplier, in->multiplier_stride, e)};
  const ElementOutput results = {out->wanted | also.wanted,
                                 at(out->xi, out->xi_stride, e),
                                 at(out->gap, out->gap_stride, e),
                                 at(out->normal_gap, out->normal_gap_stride, e),
                                 at(out->normal, out->normal_stride, e),
                                 at(out->point, out->point_stride, e),
                                 at(out->gap_gradient, out->gap_gradient_stride, e),
                                 at(out->gap_hessian, out->gap_hessian_stride, e),
                                 at(out->xi_gradient, out->xi_gradient_stride, e),
                                 at(out->xi_hessian, out->xi_hessian_stride, e),
                                 at(out->energy, out->energy_stride, e),
                                 at(out->pressure, out->pressure_stride, e),
                                 also.residual ? also.residual : at(out->residual, out->residual_stride, e),
                                 also.tangent ? also.tangent : at(out->tangent, out->tangent_stride, e),
                                 at(out->state_end, out->state_end_stride, e),
                                 also.tangent ? plan->dofs : leading_dimension(*model, *out),
                                 also.flags ? also.flags : at(out->flags, out->flags_stride, e),
                                 at(out->iterations, out->iterations_stride, e),
                                 at(out->traction, out->traction_stride, e),
                                 at(out->slip, out->slip_stride, e),
                                 at(out->age, out->age_stride, e)};
  const Status done = model->model.patch.empty() ? plan->element(*plan, element, results) : evaluate_patch(*plan, model->model, element, results);
  const std::int32_t outcome = static_cast<std::int32_t>(done);
  if (out->status) *at(out->status, out->status_stride, e) = outcome;
  return outcome;
}

bool ElementCall::gather_block(std::int64_t first, std::int64_t count, BlockNodes& nodes, PairBlock& block) const {
  const std::int64_t size = std::int64_t{plan->nodes} * plan->parameters;
  bool has_coordinates = false;
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t s = segment(first + k);
    SegmentNodes of_segment;
    if (s < 0 || s >= mesh.segments || gather(*plan, mesh, s, of_segment) != Status::ok) return false;
    std::copy_n(of_segment.positions, plan->nodes * plan->dimension, nodes.positions[k]);
    if (of_segment.surface_coordinates) std::copy_n(of_segment.surface_coordinates, size, nodes.surface_coordinates[k]);
    has_coordinates = of_segment.surface_coordinates != nullptr;
  }
  begin_at_first(block);
  block.master = nodes.positions[0];
  block.master_stride = std::extent_v<decltype(nodes.positions), 1>;
  block.surface_coordinates = has_coordinates ? nodes.surface_coordinates[0] : nullptr;
  block.surface_coordinates_stride = std::extent_v<decltype(nodes.surface_coordinates), 1>;
  return true;
}

std::int32_t ElementCall::evaluate_range(std::int64_t first, std::int64_t count, ents_report* report) const {
  // Some results may be the element kernel's alone: then it does all of the element, but for what the block kernel writes otherwise.
  const std::int32_t known = pair_results(*model, out->wanted);
  const bool mixed = known == 0 || known != out->wanted;
  // Tangents that no cache holds are written block by block into one that does, and copied from there: an element per lane, they would
  // be written a piece here and a piece there.
  constexpr std::int64_t room = 8192, nearest = 2304, beyond_caches = std::int64_t{1} << 19; // numbers: here, in the first cache, in all
  const std::int64_t entries = std::int64_t{plan->dofs} * plan->dofs;
  alignas(64) double tangents[room];
  // whole registers; few, so that computing the next ones overlaps with what the memory still has to take of these
  const std::int64_t staged = std::max<std::int64_t>(8, nearest / entries & ~std::int64_t{7});
  const bool copies = !mixed && (known & want::tangent) != 0 && staged * entries <= room && count > beyond_caches / entries &&
                      leading_dimension(*model, *out) == plan->dofs;
  const std::int64_t most = mixed ? 1 : std::min<std::int64_t>(in->mesh ? BlockNodes::most : PairBlock::most, copies ? staged : count);
  BlockNodes nodes;
  const auto copy_past_caches = best_pair_kernels().copy_past_caches;
  struct Finish {
    bool copies;
    ~Finish() {
      if (copies) portable::finish_past_caches();
    }
  } const finish{copies};
  std::int32_t result = ENTS_OK;
  PairBlock block = pair_block(*model, *in, *out, first);
  for (std::int64_t size; count > 0; first += size, count -= size, block.first += size) {
    size = std::min(count, most);
    std::uint64_t done = 0;
    PairBlock here = block;
    if (copies) {
      begin_at_first(here);
      here.tangent = tangents, here.tangent_stride = entries;
    }
    if (!mixed && (!in->mesh || gather_block(first, size, nodes, here))) done = plan->pairs(*plan, here, static_cast<std::int32_t>(size));
    const bool whole = copies && out->tangent_stride == entries && done == ~std::uint64_t{0} >> (64 - size);
    if (whole) copy_past_caches(tangents, size * entries, at(out->tangent, entries, first));
    for (std::int64_t k = 0; k < size; ++k) {
      if ((done >> k & 1) != 0) {
        if (copies && !whole) std::copy_n(tangents + k * entries, entries, at(out->tangent, out->tangent_stride, first + k));
        if (out->status) *at(out->status, out->status_stride, first + k) = ENTS_OK;
        continue;
      }
      const std::int32_t outcome = evaluate(first + k, {}, report);
      if (const std::int32_t end = settle(outcome, first + k, result, report); end < 0) return end;
      if (mixed && known != 0 && outcome == ENTS_OK && (!in->mesh || gather_block(first, size, nodes, here))) plan->pairs(*plan, here, 1);
    }
  }
  return result;
}

std::int32_t ElementCall::evaluate_call(const ents_model* model, std::int64_t first, std::int64_t count, const ents_input* input,
                                        const ents_output* output, ents_report* report) {
  ElementCall call;
  if (const std::int32_t status = call.open(model, first, count, input, output, report); status != ENTS_OK) return status;
  report_ok(report);
  return call.evaluate_range(first, count, report);
}

void ElementCall::write_open(std::int64_t e) const {
  for (std::uint32_t bits = static_cast<std::uint32_t>(out->wanted); bits != 0; bits &= bits - 1) {
    const int bit = std::countr_zero(bits);
    const Array a = output_array(*model, *out, bit);
    if (bit >= std::countr_zero(std::uint32_t{ENTS_FLAGS}) && (1 << bit) <= ENTS_ITERATIONS)
      *at(static_cast<std::int32_t*>(const_cast<void*>(a.data)), a.stride, e) = (1 << bit) == ENTS_FLAGS ? ENTS_FLAG_OUTSIDE : 0;
    else
      std::fill_n(at(static_cast<double*>(const_cast<void*>(a.data)), a.stride, e), a.size, 0.0);
  }
  if ((out->wanted & ENTS_STATE) != 0) at(out->state_end, out->state_end_stride, e)[StateLayout::tag_at] = plan->state.tag;
  if (out->status) *at(out->status, out->status_stride, e) = ENTS_OK;
}

std::int32_t ElementCall::explain(std::int32_t status, std::int64_t e, ents_report* report) const {
  return ents::explain(*model, status, e, *in, report);
}

} // namespace ents


extern "C" {

int32_t ents_evaluate(const ents_model* model, int64_t first, int64_t count, const ents_input* input,
                      const ents_output* output, ents_report* report) {
  return ents::at_the_door(report, [&] {
    const ents::FloatingPointGuard guard;
    if (ents::evaluate_plain_call(model, first, count, input, output, report)) return ents::report_ok(report);
    return ents::ElementCall::evaluate_call(model, first, count, input, output, report);
  });
}

int32_t ents_surface_evaluate(const ents_model* model, int64_t count, const ents_surface* surface,
                              ents_report* report) {
  return ents::at_the_door(report, [&] {
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
        return ents::explain_non_finite(plan, "surface.", s->master, s->surface_coordinates, s->xi + plan.parameters * i, i, report);
      if (status != ENTS_OK)
        return ents::report_message(report, status, i, "point %lld: %s", static_cast<long long>(i),
                                    ents_status_text(status));
    }
    return ents::report_ok(report);
  });
}

} // extern "C"
