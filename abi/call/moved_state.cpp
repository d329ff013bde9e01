// SPDX-License-Identifier: BSD-3-Clause
#include "abi/call/moved_state.hpp"

#include <algorithm>

namespace ents {

bool MovedState::moves(const ElementCall& call, std::int64_t e) {
  return call.in->state_begin && !call.state_follows(e) &&
         is_segment_number(at(call.in->state_begin, call.in->state_begin_stride, e)[call.plan->state.size]);
}
bool MovedState::begins(const ElementCall& call, std::int64_t e) {
  if (!call.in->slave_begin || !call.in->state_begin) return false;
  if (!call.keeps_history && !call.plan->law.bonds) return false;
  const double* state = at(call.in->state_begin, call.in->state_begin_stride, e);
  return is_state(call.plan->state, state) && is_segment_number(state[call.plan->state.size]) &&
         (state[StateLayout::history_at] == static_cast<double>(History::none) ||
          (state[StateLayout::history_at] == static_cast<double>(History::open) && !call.state_follows(e)));
}

std::int32_t MovedState::gather_nodes(std::int64_t e, std::int64_t segment, const double* positions_begin,
                                      SegmentNodes& nodes, ents_report* report) const {
  MasterMesh mesh = call_.mesh;
  if (positions_begin) mesh.positions = positions_begin;
  const Status outcome = gather(*call_.plan, mesh, segment, nodes);
  if (outcome == Status::non_finite && positions_begin)
    return report_message(report, ENTS_NON_FINITE, e,
                          "input.positions_begin of the nodes of segment %lld (element %lld), or their "
                          "surface coordinates, are NaN or infinite",
                          static_cast<long long>(segment), static_cast<long long>(e));
  return outcome == Status::ok ? ENTS_OK : explain_segment(*call_.plan, mesh, outcome, segment, report);
}

// Of the evaluation at the begin only where the element was and whether it was in contact is kept: it is no
// increment.
std::int32_t MovedState::begin(std::int64_t e, const SegmentNodes& nodes, ents_report* report) {
  const Plan& plan = *call_.plan;
  const StateLayout& layout = plan.state;
  ElementInput element = call_.element(e, nodes);
  element.slave = at(call_.in->slave_begin, std::int64_t{plan.dimension}, e);
  if (const std::int64_t k = first_non_finite(element.slave, plan.dimension); k >= 0)
    return report_message(report, ENTS_NON_FINITE, e,
                          "input.slave_begin[%lld] of element %lld is NaN or infinite",
                          static_cast<long long>(k), static_cast<long long>(e));
  std::copy_n(element.state_begin, layout.size, state_);
  state_[StateLayout::history_at] = static_cast<double>(History::none);
  element.state_begin = state_;
  double there[largest_state] = {};
  ElementOutput results{};
  results.wanted = want::state;
  results.state_end = there;
  if (evaluate_segment(plan, element, results) != Status::ok) return ENTS_OK; // not known
  const auto take = [&](std::int32_t first, std::int32_t count) {
    if (first >= 0) std::copy_n(there + first, count, state_ + first);
  };
  take(StateLayout::history_at, 1);
  take(StateLayout::xi_at, plan.parameters);
  take(layout.anchor_at, plan.parameters);
  take(layout.bond_at, 1);
  if (layout.wear_at >= 0) {
    take(layout.wear_at + StateLayout::worn_pressure, 1);
    take(layout.wear_at + StateLayout::worn_anchor, plan.parameters);
  }
  return ENTS_OK;
}

std::int32_t MovedState::move(std::int64_t e, const double* positions_begin, ents_report* report) {
  const Plan& plan = *call_.plan;
  const double* state = at(call_.in->state_begin, call_.in->state_begin_stride, e);
  const double number = state[plan.state.size];
  const long long element = e, to = call_.segment(e);
  SegmentNodes before, now;
  if (const std::int32_t status = gather_nodes(e, to, positions_begin, now, report); status != ENTS_OK)
    return status;
  in_ = *call_.in;
  in_.state_begin = state_, in_.state_begin_stride = 0;
  state_[plan.state.size] = 0.0; // of any segment
  const MasterMesh& mesh = call_.mesh;
  if (begins(call_, e)) {
    // An open element that was above another segment: from there, if that place is found on the present one.
    SegmentNodes there;
    if (state[StateLayout::history_at] == static_cast<double>(History::open) && number >= 1.0 &&
        number <= static_cast<double>(mesh.segments) &&
        gather_nodes(e, static_cast<std::int64_t>(number) - 1, positions_begin, there, nullptr) == ENTS_OK &&
        plan.transfer(plan, there.positions, there.surface_coordinates, now.positions,
                      now.surface_coordinates, state, state_) == Status::ok &&
        state_[StateLayout::history_at] == static_cast<double>(History::open)) {
      call_.in = &in_;
      state_[plan.state.size] = 0.0;
      return ENTS_OK;
    }
    state_[plan.state.size] = 0.0;
    const std::int32_t status = begin(e, now, report);
    call_.in = &in_;
    return status;
  }
  if (!(number >= 1.0 && number <= static_cast<double>(mesh.segments)))
    return report_message(report, ENTS_BAD_STATE, e,
                          "input.state_begin of element %lld was made on segment %g; the mesh has segments 0 "
                          ".. %lld: start other meshes with ents_state_init",
                          element, number - 1.0, static_cast<long long>(mesh.segments) - 1);
  const std::int64_t from = static_cast<std::int64_t>(number) - 1;
  if (const std::int32_t status = gather_nodes(e, from, positions_begin, before, report); status != ENTS_OK)
    return status;
  const Status outcome = plan.transfer(plan, before.positions, before.surface_coordinates, now.positions,
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
  call_.in = &in_;
  return ENTS_OK;
}

} // namespace ents
