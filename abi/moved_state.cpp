// SPDX-License-Identifier: BSD-3-Clause
#include "abi/moved_state.hpp"

namespace ents {

bool MovedState::is_needed(const ElementCall& call, std::int64_t e) {
  return call.in->state_begin && !call.state_follows(e) &&
         is_segment_number(at(call.in->state_begin, call.in->state_begin_stride, e)[call.plan->state.size]);
}

std::int32_t MovedState::move(std::int64_t e, const double* positions_begin, ents_report* report) {
  const Plan& plan = *call_.plan;
  const double* state = at(call_.in->state_begin, call_.in->state_begin_stride, e);
  const double number = state[plan.state.size];
  MasterMesh mesh = call_.mesh;
  const long long element = e, to = call_.segment(e);
  if (!(number >= 1.0 && number <= static_cast<double>(mesh.segments)))
    return report_message(report, ENTS_BAD_STATE, e,
                          "input.state_begin of element %lld was made on segment %g; the mesh has segments 0 "
                          ".. %lld: start other meshes with ents_state_init",
                          element, number - 1.0, static_cast<long long>(mesh.segments) - 1);
  if (positions_begin) mesh.positions = positions_begin;
  const std::int64_t from = static_cast<std::int64_t>(number) - 1;
  SegmentNodes before, now;
  std::int64_t bad = from;
  Status outcome = gather(plan, mesh, from, before);
  if (outcome == Status::ok) outcome = gather(plan, mesh, bad = to, now);
  if (outcome == Status::non_finite && positions_begin)
    return report_message(report, ENTS_NON_FINITE, e,
                          "input.positions_begin of the nodes of segment %lld (element %lld), or their "
                          "surface coordinates, are NaN or infinite",
                          static_cast<long long>(bad), element);
  if (outcome != Status::ok) return explain_segment(plan, mesh, outcome, bad, report);
  outcome = plan.transfer(plan, before.positions, before.surface_coordinates, now.positions,
                          now.surface_coordinates, state, state_);
  if (outcome == Status::bad_state)
    return report_message(report, ENTS_BAD_STATE, e,
                          "input.state_begin of element %lld is not a state of this segment type, law and "
                          "version; fill it with ents_state_init",
                          element);
  if (outcome != Status::ok)
    return report_message(
        report, static_cast<std::int32_t>(outcome), e,
        "element %lld: its state cannot move from segment %lld to segment %lld (%s); take a "
        "smaller step",
        element, static_cast<long long>(from), to, ents_status_text(static_cast<std::int32_t>(outcome)));
  state_[plan.state.size] = 0.0; // of any segment
  in_ = *call_.in;
  in_.state_begin = state_, in_.state_begin_stride = 0;
  call_.in = &in_;
  return ENTS_OK;
}

} // namespace ents
