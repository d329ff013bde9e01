// SPDX-License-Identifier: BSD-3-Clause
// ents_parameter_derivatives: of gap, energy and residual by the named parameters of a model.
#include <algorithm>

#include "abi/call/element_call.hpp"
#include "abi/call/guard.hpp"

namespace ents {

namespace {

LawRates rates_of(const LawBinding& binding, std::int32_t parameter) {
  const auto rate = [parameter](std::uint8_t index) { return index == parameter ? 1.0 : 0.0; };
  return {rate(binding.normal), rate(binding.friction), rate(binding.wear), rate(binding.sliding),
          rate(binding.offset)};
}

// One element: by every parameter.
std::int32_t differentiate(const ElementCall& call, std::int64_t e, const ents_derivatives& to,
                           ents_report* report) {
  Plan plan = *call.plan;
  const ents_model& model = *call.model;
  const auto parameters = static_cast<std::int32_t>(model.model.parameters.size());
  const std::int64_t row = e * parameters, n = plan.dofs;
  for (std::int32_t i = 0; i < parameters; ++i) {
    if (to.gap) to.gap[row + i] = 0.0;
    if (to.energy) to.energy[row + i] = 0.0;
    if (to.residual) std::fill_n(to.residual + (row + i) * n, n, 0.0);
  }
  SegmentNodes nodes;
  if (call.in->mesh) {
    const std::int64_t s = call.segment(e);
    if (s < 0) return ENTS_OK; // open
    if (s >= call.mesh.segments) return call.refuse_segment(e, report);
    if (const Status outcome = gather(plan, call.mesh, s, nodes); outcome != Status::ok)
      return explain_segment(plan, call.mesh, outcome, s, report);
    if (!call.state_follows(e)) return call.explain(ENTS_BAD_STATE, e, report);
  }
  const ElementInput element = call.element(e, nodes);
  double xi[2];
  std::int32_t flags = 0;
  ElementOutput look{};
  const bool has_law = plan.law.normal != NormalKind::none;
  double pressure;
  look.wanted = want::xi | want::flags | (has_law ? std::int32_t{want::pressure} : 0);
  look.xi = xi, look.flags = &flags, look.pressure = &pressure;
  bool open;
  if (const Status outcome = call.evaluate_one(element, look, true, open); outcome != Status::ok)
    return call.explain(static_cast<std::int32_t>(outcome), e, report);
  if ((flags & flag::outside) != 0) return ENTS_OK;
  double residual[3 * 17];
  for (std::int32_t i = 0; i < parameters; ++i) {
    plan.law.rates = rates_of(model.model.law_binding, i + 1);
    ParameterRates rates{};
    rates.residual = has_law ? residual : nullptr;
    if (const Status outcome = plan.by_parameter(plan, element, xi, i + 1, rates); outcome != Status::ok)
      return call.explain(static_cast<std::int32_t>(outcome), e, report);
    if (to.gap) to.gap[row + i] = rates.gap;
    if (to.energy) to.energy[row + i] = rates.energy;
    if (to.residual && has_law) std::copy_n(residual, n, to.residual + (row + i) * n);
    for (std::int64_t k = 0; to.product && has_law && k < n; ++k)
      to.product[i] += to.adjoint[e * n + k] * residual[k];
  }
  return ENTS_OK;
}

} // namespace

} // namespace ents

extern "C" int32_t ents_parameter_derivatives(const ents_model* model, int64_t first, int64_t count,
                                              const ents_input* input, const ents_derivatives* derivatives,
                                              ents_report* report) {
  return ents::entry_point(report, [&] {
    std::int32_t status = ents::check_handle(model, report);
    if (status != ENTS_OK) return status;
    ents_derivatives copy;
    const ents_derivatives* to = ents::known_struct(derivatives, copy, "derivatives", status, report);
    if (!to || (status = ents::check_reserved(to->reserved, "derivatives", report)) != ENTS_OK) return status;
    if (model->plan.multipliers > 0 || !model->model.patch.empty())
      return ents::report_message(report, ENTS_BAD_VALUE, -1,
                                  "the model has %s: their derivatives by parameters are not available",
                                  model->plan.multipliers > 0 ? "multiplier dofs" : "a \"patch\"");
    if (model->plan.law.flattening.parameter != 0)
      return ents::report_status(report, ENTS_BAD_VALUE, -1,
                                 "the model has \"flattening\": derivatives by parameters are not available");
    if (model->plan.heat)
      return ents::report_status(report, ENTS_BAD_VALUE, -1,
                                 "the model has \"heat\": derivatives by parameters are not available");
    if (to->product && !to->adjoint)
      return ents::report_status(report, ENTS_NULL_ARGUMENT, -1,
                                 "derivatives.product is given without derivatives.adjoint");
    if ((to->residual || to->product) && model->plan.law.normal == ents::NormalKind::none)
      return ents::refuse_without_contact("derivatives asks for a residual", report);
    const ents::FloatingPointGuard guard;
    ents_output none{};
    none.struct_size = sizeof none;
    ents::ElementCall call;
    if ((status = call.open(model, first, count, input, &none, report)) != ENTS_OK) return status;
    ents::report_ok(report);
    std::int32_t result = ENTS_OK;
    for (std::int64_t e = first; e < first + count; ++e)
      if (const std::int32_t outcome = ents::differentiate(call, e, *to, report); outcome < 0)
        return outcome;
      else if (outcome > 0 && result == ENTS_OK)
        result = outcome;
    return result;
  });
}
