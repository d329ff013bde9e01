// SPDX-License-Identifier: BSD-3-Clause
// One call of the caller's elements: arguments checked once, then one kernel call per element.
#pragma once

#include "abi/call/mesh.hpp"
#include "core/element/segment.hpp"
#include "core/search/patch.hpp"

namespace ents {

// Of heat and of friction that depends on the slip rate
inline bool is_time_increment(double time) { return time > 0.0 && time < 1e100; }

template <class T> T* at(T* data, std::int64_t stride, std::int64_t element) noexcept {
  return data ? data + stride * element : nullptr;
}

inline std::int64_t leading_dimension(const ents_model& model, const ents_output& out) noexcept {
  return out.tangent_leading_dimension == 0 ? model.sizes.dofs : out.tangent_leading_dimension;
}

// Elements first .. first + count - 1 of two arrays, `size` numbers each: is there a place that both have?
// Elements of one stride may lie between each other.
inline bool arrays_overlap(const double* a, std::int64_t a_stride, const double* b, std::int64_t b_stride,
                           std::int64_t size, std::int64_t first, std::int64_t count) noexcept {
  constexpr std::uintptr_t bytes = sizeof(double);
  const auto begin = [first](const double* data, std::int64_t stride) {
    return reinterpret_cast<std::uintptr_t>(data) + static_cast<std::uintptr_t>(stride * first) * bytes;
  };
  const auto extent = [&](std::int64_t stride) {
    return static_cast<std::uintptr_t>(stride * (count - 1) + size) * bytes;
  };
  const std::uintptr_t from = begin(a, a_stride), to = begin(b, b_stride);
  if (from >= to + extent(b_stride) || to >= from + extent(a_stride)) return false;
  if (count == 1 || a_stride != b_stride || a_stride <= 0) return true;
  const std::uintptr_t period = static_cast<std::uintptr_t>(a_stride) * bytes,
                       room = static_cast<std::uintptr_t>(size) * bytes;
  const std::uintptr_t apart = (from < to ? to - from : from - to) % period;
  return apart < room || apart > period - room;
}

// Do the states at the end of elements first .. lie on those at the begin? An element may be evaluated twice:
// they must not.
inline bool states_overlap(const ents_model& model, const ents_input& in, const ents_output& out,
                           std::int64_t first, std::int64_t count) noexcept {
  return (out.wanted & ENTS_STATE) != 0 && in.state_begin && out.state_end && count > 0 &&
         arrays_overlap(in.state_begin, in.state_begin_stride, out.state_end, out.state_end_stride,
                        model.sizes.state, first, count);
}

// Does xi take the place of the start, so that an element that is evaluated twice would start from its own
// result?
inline bool writes_start(const ents_model& model, const ents_input& in, const ents_output& out,
                         std::int64_t first, std::int64_t count) noexcept {
  return (out.wanted & ENTS_XI) != 0 && in.start && out.xi && count > 0 &&
         arrays_overlap(in.start, in.start_stride, out.xi, out.xi_stride, model.plan.parameters, first,
                        count);
}

// "`asks`, but the model has no contact"
std::int32_t refuse_without_contact(const char* asks, ents_report* report);

class StagedResults;
struct PlainCall;

struct ElementCall {
  const ents_model* model;
  const Plan* plan; // of one segment
  const ents_input* in;
  const ents_output* out;
  MasterMesh mesh;            // if the input has one
  bool start_first = false;   // input.start comes before the history's xi
  bool keeps_history = false; // of a place on the master: the anchor of friction, of wear

  // What an assembly wants of an element, beside what the caller does; each or null.
  struct Wanted {
    std::int32_t wanted;
    double *residual, *tangent; // [dofs], [dofs][dofs]
    std::int32_t* flags;
  };

  std::int32_t open(const ents_model* model, std::int64_t first, std::int64_t count, const ents_input* input,
                    const ents_output* output, ents_report* report);

  // Is the history of an element that of its segment? Only what friction keeps depends on it.
  bool state_follows(std::int64_t e) const {
    if (!in->state_begin || !model->model.patch.empty()) return true;
    const double* state = at(in->state_begin, in->state_begin_stride, e);
    const double number = state[plan->state.size];
    if (!is_segment_number(number)) return false;
    return !keeps_history || !in->mesh || number == 0.0 || number == static_cast<double>(segment(e) + 1) ||
           !(state[StateLayout::history_at] >= 1.0);
  }
  // A sound state of an open element?
  bool was_open(std::int64_t e) const {
    const double* state = at(in->state_begin, in->state_begin_stride, e);
    return is_segment_number(state[plan->state.size]) && is_state(plan->state, state) &&
           state[StateLayout::history_at] == static_cast<double>(History::open);
  }
  // Its state at the end knows the segment.
  void mark_state(std::int64_t e) const {
    if ((out->wanted & ENTS_STATE) == 0 || !model->model.patch.empty()) return;
    at(out->state_end, out->state_end_stride, e)[plan->state.size] =
        in->mesh ? static_cast<double>(segment(e) + 1) : 0.0;
  }

  std::int64_t segment(std::int64_t e) const { return *at(in->segment, in->segment_stride, e); }
  std::int32_t refuse_segment(std::int64_t e, ents_report* report) const;

  // A model with heat needs temperatures, and where friction heats the time of the increment.
  std::int32_t check_temperatures(ents_report* report) const;
  // A coefficient of friction that depends on the slip rate needs the time of the increment.
  std::int32_t check_time(ents_report* report) const;

  // nodes: of its segment, if the input has a mesh
  ElementInput element(std::int64_t e, const SegmentNodes& nodes) const;
  // hard: the block kernel has left it
  Status evaluate_one(const ElementInput& element, const ElementOutput& results, bool hard,
                      bool& open) const {
    open = false;
    if (!model->model.patch.empty()) return evaluate_patch(*plan, model->model, element, results, open);
    return hard ? plan->element(*plan, element, results) : evaluate_segment(*plan, element, results);
  }

  // An element without a segment is open: zeros, a fresh state, ENTS_FLAG_OUTSIDE; its multipliers are held
  // at zero as those of any open element. Of `also` the residual and the tangent, and of these the rows and
  // columns of the multipliers alone.
  std::int32_t evaluate_open(std::int64_t e, const Wanted& also) const;

  // Status of the element, not yet explained in the report unless its segment is at fault.
  std::int32_t evaluate(std::int64_t e, const Wanted& also, ents_report* report, bool hard = false) const;

  // All elements of a range: ordinary ones in blocks, the others one by one. `result` is settled with them;
  // negative: the call ends.
  std::int32_t evaluate_range(std::int64_t first, std::int64_t count, std::int32_t& result,
                              ents_report* report) const;

  // Both, for any call; apart, so that the way of plain calls stays short.
  ENTS_NOINLINE static std::int32_t evaluate_call(const ents_model* model, std::int64_t first,
                                                  std::int64_t count, const ents_input* input,
                                                  const ents_output* output, const PlainCall& before,
                                                  ents_report* report);

  // Nodes of the segments of a block, side by side. False if a segment is bad.
  struct BlockNodes {
    static constexpr std::int64_t most = 16;
    double positions[most][16 * 3], surface_coordinates[most][16 * 2], temperatures[most][16];
  };
  bool gather_block(std::int64_t first, std::int64_t count, BlockNodes& nodes, ElementBlock& block) const;

  // Name the entry that a kernel refused, or how deep the slave is.
  std::int32_t explain(std::int32_t status, std::int64_t e, ents_report* report) const;

  // The status of the call from that of an element: a negative one ends the call; of those > 0 the first is
  // reported.
  std::int32_t settle(std::int32_t outcome, std::int64_t e, std::int32_t& result, ents_report* report) const {
    if (outcome < 0) return report && report->status == outcome ? outcome : explain(outcome, e, report);
    if (outcome > 0 && result == ENTS_OK) result = explain(outcome, e, report);
    return ENTS_OK;
  }

private:
  // staged: where results go that no cache holds, or null
  std::int32_t evaluate_blocks(std::int64_t first, std::int64_t count, StagedResults* staged,
                               std::int32_t& result, ents_report* report) const;
  // apart: these results lie on the stack
  ENTS_NOINLINE std::int32_t evaluate_staged(std::int64_t first, std::int64_t count, std::int32_t& result,
                                             ents_report* report) const;
  std::int32_t check_open(std::int64_t e) const;
  void write_open(std::int64_t e) const;
  void hold_multipliers(std::int64_t e, double* residual, double* tangent, std::int64_t leading) const;
  std::int32_t explain_penetration(std::int64_t e, ents_report* report) const;
  std::int32_t explain_ray(std::int64_t e, ents_report* report) const;

  ents_input input_copy; // of an older caller's
  ents_output output_copy;
};

} // namespace ents
