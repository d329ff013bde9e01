// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "abi/call/guard.hpp"
#include "abi/call/handle.hpp"
#include "abi/call/undefined_height.hpp"
#include "core/admissibility/admissibility.hpp"

namespace ents {

std::int64_t first_non_finite(const double* values, std::int64_t size) noexcept {
  for (std::int64_t k = 0; values && k < size; ++k)
    if (!std::isfinite(values[k])) return k;
  return -1;
}

std::int32_t explain_non_finite(const Plan& plan, const char* prefix, const double* master,
                                const double* surface_coordinates, const double* xi, std::int64_t point,
                                ents_report* report) noexcept {
  const struct {
    const char* name;
    const double* values;
    std::int64_t size;
  } arrays[] = {{"master", master, std::int64_t{plan.nodes} * plan.dimension},
                {"surface_coordinates", surface_coordinates, std::int64_t{plan.nodes} * plan.parameters},
                {"xi", xi, plan.parameters}};
  for (const auto& array : arrays)
    if (const std::int64_t k = first_non_finite(array.values, array.size); k >= 0)
      return report_message(report, ENTS_NON_FINITE, point, "%s%s[%lld] is %s", prefix, array.name,
                            static_cast<long long>(k + (array.values == xi ? plan.parameters * point : 0)),
                            std::isnan(array.values[k]) ? "NaN" : "infinite");
  return report_status(report, ENTS_NON_FINITE, point, ents_status_text(ENTS_NON_FINITE));
}

} // namespace ents

namespace {

void set(double& value, double (&xi)[2], const ents::Worst& worst) {
  value = worst.value;
  xi[0] = worst.xi[0];
  xi[1] = worst.xi[1];
}

} // namespace

extern "C" int32_t ents_model_check(const ents_model* model, const double* master,
                                    const double* surface_coordinates, ents_admissibility* result,
                                    ents_report* report) {
  return ents::entry_point(report, [&] {
    std::int32_t status = ents::check_handle(model, report);
    if (status != ENTS_OK) return status;
    if (!master) return ents::report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'master' is null");
    ents_admissibility copy;
    const ents_admissibility* known = ents::known_struct(result, copy, "result", status, report);
    if (!known) return status;
    if (known->samples != 0 && (known->samples < 2 || known->samples > ents::most_samples))
      return ents::report_message(report, ENTS_BAD_COUNT, -1, "result.samples is %d; 0 or 2 .. %d",
                                  known->samples, ents::most_samples);
    if ((status = ents::check_reserved(known->reserved, "result", report)) != ENTS_OK) return status;
    const ents::FloatingPointGuard guard;
    ents::Admissibility a;
    status = static_cast<std::int32_t>(
        ents::check_admissibility(model->model, model->plan, master, surface_coordinates, known->samples, a));
    if (status == ENTS_NON_FINITE)
      return ents::explain_non_finite(model->plan, "", master, surface_coordinates, nullptr, -1, report);
    if (status != ENTS_OK)
      return ents::report_message(report, status, -1, "the segment itself: %s", ents_status_text(status));
    const double middle[2] = {model->plan.simplex ? 1.0 / 3.0 : 0.0, model->plan.simplex ? 1.0 / 3.0 : 0.0};
    double s[2];
    if (!(a.height_min <= a.height_max) && // nowhere on the samples
        ents::height_is_undefined(model->plan, master, surface_coordinates, middle, s))
      return ents::report_undefined_height(model->plan, "segment", 0, s, report);
    ents_admissibility out = *known;
    out.samples = a.samples;
    out.continuity = a.continuity;
    set(out.fold, out.fold_xi, a.fold);
    set(out.edge_height, out.edge_height_xi, a.edge_height);
    set(out.reach, out.reach_xi, a.reach);
    set(out.shadow, out.shadow_xi, a.shadow);
    out.height_min = a.height_min;
    out.height_max = a.height_max;
    ents::copy_to_caller(out, result);
    return ents::report_ok(report);
  });
}
