// SPDX-License-Identifier: BSD-3-Clause
// Self-contact: the thickness of the body below each slave.
#include "core/search/thickness.hpp"

#include "abi/call/detection_call.hpp"
#include "abi/call/guard.hpp"

namespace ents {

namespace {

// What is nearer than this part of the reach touches in the first configuration.
constexpr double touches = 1e-4;

std::int32_t find_thickness(const DetectionCall& call, std::int64_t first, std::int64_t count,
                            double* thickness, ents_report* report) {
  const Plan& plan = call.model->plan;
  if (plan.projection != ProjectionKind::normal)
    return report_status(report, ENTS_BAD_VALUE, -1,
                         "model: self-contact needs the normal projection; leave out the key \"projection\"");
  if (count > 0 && (!thickness || !call.left_out.normal))
    return report_message(report, ENTS_NULL_ARGUMENT, -1, "%s is null",
                          thickness ? "detection.slave_normal" : "argument 'thickness'");
  for (std::int64_t i = first; i < first + count; ++i) {
    const double* slave = call.io->slave + i * plan.dimension;
    if (first_non_finite(slave, plan.dimension) >= 0)
      return report_message(report, ENTS_NON_FINITE, i, "detection.slave of node %lld is NaN or infinite",
                            static_cast<long long>(i));
    LeftOut left_out;
    if (const std::int32_t status = call.read_left_out(i, left_out, report); status != ENTS_OK) return status;
    left_out.facing = faces_other_side;
    if (!(thickness[i] >= 0.0) || !(thickness[i] < 1e100))
      return report_message(report, ENTS_BAD_VALUE, i,
                            "thickness of node %lld is %g; the one of before, or 0, is needed",
                            static_cast<long long>(i), thickness[i]);
    const double nearest = thickness[i] > 0.0 ? 0.5 * thickness[i] : touches * call.io->reach;
    if (const Status status = thickness_below(plan, call.mesh, call.tree, slave, left_out, nearest,
                                              2.0 * call.io->reach, thickness[i]);
        status != Status::ok)
      return report_status(report, static_cast<std::int32_t>(status), i, "at the search of the far side");
  }
  return report_ok(report);
}

} // namespace

} // namespace ents

extern "C" int32_t ents_thickness(const ents_model* model, const ents_master_mesh* mesh, const double* tree,
                                  int64_t size, int64_t first, int64_t count, const ents_detection* detection,
                                  double* thickness, ents_report* report) {
  return ents::entry_point(report, [&] {
    const ents::FloatingPointGuard guard;
    ents::DetectionCall call;
    const std::int32_t status = call.open(model, mesh, tree, size, first, count, detection, report);
    return status == ENTS_OK ? ents::find_thickness(call, first, count, thickness, report) : status;
  });
}
