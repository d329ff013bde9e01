// SPDX-License-Identifier: BSD-3-Clause
#include "abi/guard.hpp"
#include "abi/handle.hpp"
#include "core/admissibility.hpp"

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
  return ents::at_the_door(report, [&] {
    std::int32_t status = ents::check_handle(model, report);
    if (status != ENTS_OK) return status;
    if (!master) return ents::report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'master' is null");
    ents_admissibility copy;
    const ents_admissibility* known = ents::known_struct(result, copy, "result", status, report);
    if (!known) return status;
    if (known->samples != 0 && (known->samples < 2 || known->samples > ents::most_samples))
      return ents::report_message(report, ENTS_BAD_COUNT, -1, "result.samples is %d; 0 or 2 .. %d",
                                  known->samples, ents::most_samples);
    const ents::FloatingPointGuard guard;
    ents::Admissibility a;
    status = static_cast<std::int32_t>(
        ents::check_admissibility(model->model, model->plan, master, surface_coordinates, known->samples, a));
    if (status != ENTS_OK)
      return ents::report_message(report, status, -1, "the segment itself: %s", ents_status_text(status));
    ents_admissibility out = *known;
    out.samples = a.samples;
    out.continuity = a.continuity;
    set(out.fold, out.fold_xi, a.fold);
    set(out.edge_height, out.edge_height_xi, a.edge_height);
    set(out.reach, out.reach_xi, a.reach);
    set(out.shadow, out.shadow_xi, a.shadow);
    out.height_min = a.height_min;
    out.height_max = a.height_max;
    ents::give_back(out, result);
    return ents::report_ok(report);
  });
}
