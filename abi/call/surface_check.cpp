// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "abi/call/guard.hpp"
#include "abi/call/handle.hpp"
#include "abi/call/mesh.hpp"
#include "abi/call/undefined_height.hpp"
#include "core/admissibility/admissibility.hpp"
#include "core/admissibility/surface_admissibility.hpp"

namespace ents {

namespace {

#define ENTS_SAME_CONDITION(name, place) static_assert(int{ENTS_CHECK_##name} == int{condition::place});
ENTS_SAME_CONDITION(CONTINUITY, continuity)
ENTS_SAME_CONDITION(FOLD, fold)
ENTS_SAME_CONDITION(EDGE, edge)
ENTS_SAME_CONDITION(JUMP, jump)
ENTS_SAME_CONDITION(KINK, kink)
ENTS_SAME_CONDITION(WEDGE, wedge)
ENTS_SAME_CONDITION(PROJECTION, projection)
ENTS_SAME_CONDITION(SHADOW, shadow)
ENTS_SAME_CONDITION(OCCLUSION, occlusion)
ENTS_SAME_CONDITION(CROSSING, crossing)
#undef ENTS_SAME_CONDITION
static_assert(int{condition::count} <= int{ENTS_CHECK_COUNT_});

void tell(const Plan& plan, const MasterMesh& mesh, const Finding& finding, int which,
          ents_surface_admissibility& out) {
  if (finding.judged) out.judged |= std::int64_t{1} << which;
  if (finding.violated) out.violated |= std::int64_t{1} << which;
  out.value[which] = finding.value;
  out.bound[which] = finding.bound;
  if (finding.violated) out.missing[which] = std::fabs(finding.value - finding.bound);
  out.segment[which] = finding.segment;
  out.other[which] = finding.other;
  for (int a = 0; a < 2; ++a) out.xi[which][a] = finding.xi[a], out.other_xi[which][a] = finding.other_xi[a];
  SegmentNodes nodes;
  const SurfacePoint wanted = {out.point[which], nullptr, nullptr, nullptr, nullptr, nullptr, nullptr};
  if (finding.segment >= 0 && gather(plan, mesh, finding.segment, nodes) == Status::ok)
    plan.surface(plan, nodes.positions, nodes.surface_coordinates, finding.xi, wanted);
}

std::int32_t check(const ents_model* model, const ents_master_mesh* caller,
                   ents_surface_admissibility* result, ents_report* report) {
  std::int32_t status = check_handle(model, report);
  MasterMesh mesh;
  if (status == ENTS_OK) status = check_mesh(caller, "mesh", mesh, report);
  if (status != ENTS_OK) return status;
  ents_surface_admissibility copy;
  const ents_surface_admissibility* io = known_struct(result, copy, "result", status, report);
  if (!io) return status;
  if (io->samples != 0 && (io->samples < 2 || io->samples > most_samples))
    return report_message(report, ENTS_BAD_COUNT, -1, "result.samples is %d; 0 or 2 .. %d", io->samples,
                          most_samples);
  const FloatingPointGuard guard; // first of all: to compare with a NaN may trap
  if (!(io->reach >= 0.0) || !(io->reach < 1e100))
    return report_message(report, ENTS_BAD_VALUE, -1, "result.reach is %g; a length in 0 .. 1e100 is needed",
                          io->reach);
  if (!(io->kink >= 0.0) || !(io->kink <= std::numbers::pi))
    return report_message(report, ENTS_BAD_VALUE, -1, "result.kink is %g; an angle in 0 .. pi is needed",
                          io->kink);
  SurfaceAdmissibility a;
  std::int64_t segment = -1;
  const SurfaceLimits limits = {io->samples, io->reach, io->kink};
  const Status outcome = check_surface(model->model, model->plan, mesh, limits, a, segment);
  if (outcome != Status::ok) return explain_segment(model->plan, mesh, outcome, segment, report);

  if (!(a.height_min <= a.height_max)) { // nowhere on the samples
    const double middle[2] = {model->plan.simplex ? 1.0 / 3.0 : 0.0, model->plan.simplex ? 1.0 / 3.0 : 0.0};
    double s[2];
    SegmentNodes nodes;
    if (mesh.segments > 0 && gather(model->plan, mesh, 0, nodes) == Status::ok &&
        height_is_undefined(model->plan, nodes.positions, nodes.surface_coordinates, middle, s))
      return report_undefined_height(model->plan, "segment", 0, s, report);
  }

  ents_surface_admissibility out{};
  out.samples = a.samples;
  out.reach = io->reach, out.kink = io->kink, out.violations = io->violations;
  std::fill_n(out.segment, ENTS_CHECK_COUNT_, -1), std::fill_n(out.other, ENTS_CHECK_COUNT_, -1);
  for (int which = 0; which < condition::count; ++which)
    tell(model->plan, mesh, a.findings[which], which, out);
  out.height_min = a.height_min, out.height_max = a.height_max;
  if (io->violations) std::copy(a.violations.begin(), a.violations.end(), io->violations);
  copy_to_caller(out, result);
  return report_ok(report);
}

} // namespace

} // namespace ents

extern "C" int32_t ents_surface_check(const ents_model* model, const ents_master_mesh* mesh,
                                      ents_surface_admissibility* result, ents_report* report) {
  return ents::entry_point(report, [&] { return ents::check(model, mesh, result, report); });
}
