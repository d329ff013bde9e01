// SPDX-License-Identifier: BSD-3-Clause
// ents_assemble and ents_iterate: elements evaluated, their residuals and tangents added to the host's
// equations.
#include <algorithm>
#include <cstddef>
#include <optional>

#include "abi/call/detection_call.hpp"
#include "abi/call/element_block.hpp"
#include "abi/call/equations.hpp"
#include "abi/call/guard.hpp"
#include "abi/call/moved_state.hpp"
#include "core/element/block_kernels.hpp"
#include "core/model/needs.hpp"

namespace ents {

namespace {

class Assembly {
public:
  Assembly(const ElementCall& call, ents_report* report)
      : call_(call), plan_(*call.plan), equations_(call, report), report_(report) {}

  std::int32_t open(const ents_system* caller, std::int64_t first, std::int64_t count) {
    return equations_.open(caller, first, count);
  }
  // States in contact on another segment are moved there, in these positions; null: in those of the mesh.
  void move_states(const double* positions_begin) {
    moves_states_ = true, positions_begin_ = positions_begin;
  }
  std::int32_t add(std::int64_t first, std::int64_t count);

private:
  static constexpr int block_numbers = 8192; // of tangents, on the stack
  // call: as call_, but for the state of elements that move
  std::int32_t add(const ElementCall& call, std::int64_t e);
  std::uint64_t evaluate_block(const ElementCall& call, std::int64_t first, std::int64_t count,
                               double* residuals, double* tangents, std::int32_t* flags) const;
  bool moves(std::int64_t e) const {
    return moves_states_ && call_.segment(e) >= 0 && MovedState::is_needed(call_, e);
  }
  std::int32_t add_evaluated(std::int64_t e, std::int32_t flags, const double* residual,
                             const double* tangent) const;

  const ElementCall& call_;
  const Plan& plan_;
  Equations equations_;
  ents_report* report_;
  bool moves_states_ = false;
  const double* positions_begin_ = nullptr;
};

// A state that cannot move is the element's status. Of the recoverable ones the call reports the first.
std::int32_t move_state(MovedState& moved, const ElementCall& call, std::int64_t e,
                        const double* positions_begin) {
  const std::int32_t status = moved.move(e, positions_begin, nullptr);
  if (status != ENTS_OK && call.out->status) *at(call.out->status, call.out->status_stride, e) = status;
  return status;
}
std::int32_t settle_state(const ElementCall& call, std::int32_t outcome, std::int64_t e,
                          const double* positions_begin, std::int32_t& result, ents_report* report) {
  if (outcome > 0 && result != ENTS_OK) return ENTS_OK;
  MovedState again(call);
  again.move(e, positions_begin, report);
  if (outcome > 0) result = outcome;
  return outcome < 0 ? outcome : ENTS_OK;
}

std::int32_t Assembly::add(const ElementCall& call, std::int64_t e) {
  double residual[Equations::max_dofs], tangent[Equations::max_dofs * Equations::max_dofs];
  std::int32_t flags = 0;
  const std::int64_t segment = call_.segment(e);
  if (segment < -1) return call_.refuse_segment(e, report_);
  if (segment == -1) {
    const std::int32_t status = call_.evaluate_open(e, {0, residual, tangent, nullptr});
    if (status != ENTS_OK || plan_.multipliers == 0) return status;
  } else {
    const ElementCall::Wanted wanted = {ENTS_FLAGS | (equations_.wants_residual() ? ENTS_RESIDUAL : 0) |
                                            (equations_.wants_tangent() ? ENTS_TANGENT : 0),
                                        residual, tangent, &flags};
    const std::int32_t status = call.evaluate(e, wanted, report_);
    if ((call_.out->wanted & ENTS_FLAGS) != 0) *at(call_.out->flags, call_.out->flags_stride, e) = flags;
    if (status != ENTS_OK) return status;
    if ((flags & ENTS_FLAG_CONTACT) == 0 && plan_.multipliers == 0 && !plan_.heat)
      return ENTS_OK; // nothing but zeros
  }
  return equations_.add(e, residual, tangent, false);
}

std::int32_t Assembly::add_evaluated(std::int64_t e, std::int32_t flags, const double* residual,
                                     const double* tangent) const {
  if ((call_.out->wanted & ENTS_FLAGS) != 0) *at(call_.out->flags, call_.out->flags_stride, e) = flags;
  if (call_.out->status) *at(call_.out->status, call_.out->status_stride, e) = ENTS_OK;
  call_.mark_state(e);
  if ((flags & ENTS_FLAG_CONTACT) == 0 && !plan_.heat) return ENTS_OK; // an open gap may conduct
  const bool symmetric =
      !plan_.law.has_friction() && !plan_.heat && has_fast_kernel(plan_.law, plan_.projection, plan_.tangent);
  return equations_.add(e, residual, tangent, symmetric);
}

// Bit k: element first + k is evaluated.
std::uint64_t Assembly::evaluate_block(const ElementCall& call, std::int64_t first, std::int64_t count,
                                       double* residuals, double* tangents, std::int32_t* flags) const {
  const std::int32_t wanted =
      call.out->wanted | ENTS_FLAGS | ENTS_RESIDUAL | (equations_.wants_tangent() ? ENTS_TANGENT : 0);
  if (block_results_of(*call.model, wanted) != wanted || plan_.multipliers > 0)
    return 0; // open ones have equations, too
  for (std::int64_t k = 0; k < count; ++k)
    if (!call.state_follows(first + k)) return 0;
  ElementCall::BlockNodes nodes;
  ElementBlock block = element_block_of(*call.model, *call.in, *call.out, first);
  if (!call.gather_block(first, count, nodes, block)) return 0;
  block.start_first = call.start_first;
  block.wanted = wanted | (call.out->wanted == 0 ? forces_only : 0);
  block.residual = residuals, block.residual_stride = plan_.dofs;
  block.tangent = tangents, block.tangent_stride = std::int64_t{plan_.dofs} * plan_.dofs;
  block.leading = plan_.dofs;
  block.flags = flags, block.flags_stride = 1;
  return ents::evaluate_block(plan_, block, static_cast<std::int32_t>(count));
}

std::int32_t Assembly::add(std::int64_t first, std::int64_t count) {
  const std::int64_t fitting = block_numbers / (plan_.dofs * plan_.dofs),
                     registers = fitting & ~std::int64_t{7}; // whole ones
  const std::int64_t most =
      std::clamp<std::int64_t>(registers > 0 ? registers : fitting, 1, ElementCall::BlockNodes::most);
  double residuals[ElementCall::BlockNodes::most * Equations::max_dofs], tangents[block_numbers];
  std::int32_t flags[ElementCall::BlockNodes::most], result = ENTS_OK;
  const std::int64_t last = first + count;
  for (std::int64_t size; first < last; first += size) {
    std::optional<MovedState> moved; // of the first element, which is then alone
    if (moves(first)) {
      moved.emplace(call_);
      if (const std::int32_t outcome = move_state(*moved, call_, first, positions_begin_);
          outcome != ENTS_OK) {
        size = 1;
        if (settle_state(call_, outcome, first, positions_begin_, result, report_) < 0) return outcome;
        continue;
      }
      size = 1;
    } else {
      for (size = 0;
           size < std::min(last - first, most) && call_.segment(first + size) >= 0 && !moves(first + size);)
        ++size;
    }
    const ElementCall& call = moved ? moved->call() : call_;
    const std::uint64_t done = size == 0 ? 0 : evaluate_block(call, first, size, residuals, tangents, flags);
    size = std::max<std::int64_t>(size, 1); // without a segment
    for (std::int64_t k = 0; k < size; ++k) {
      const std::int64_t e = first + k;
      if (e + 1 < last) equations_.fetch(e + 1);
      const std::int32_t outcome = (done >> k & 1) == 0
                                       ? add(call, e)
                                       : add_evaluated(e, flags[k], residuals + k * plan_.dofs,
                                                       tangents + k * plan_.dofs * plan_.dofs);
      if (const std::int32_t end = call_.settle(outcome, e, result, report_); end < 0) return end;
    }
  }
  return result;
}

// Elements that a detection has found; results per element only.
std::int32_t evaluate_found(const ElementCall& call, const double* positions_begin, std::int64_t first,
                            std::int64_t count, ents_report* report) {
  report_ok(report);
  std::int32_t result = ENTS_OK;
  const auto kind = [&](std::int64_t e) { // 0: open, 1: as it is, 2: its state has to move
    return call.segment(e) < 0 ? 0 : MovedState::is_needed(call, e) ? 2 : 1;
  };
  for (std::int64_t end, last = first + count; first < last; first = end) { // runs of one kind
    const int of_run = kind(first);
    for (end = first + 1; end < last && kind(end) == of_run;) ++end;
    for (std::int64_t e = first; of_run == 2 && e < end; ++e) {
      MovedState moved(call);
      std::int32_t status = move_state(moved, call, e, positions_begin);
      status = status == ENTS_OK ? moved.call().evaluate_range(e, 1, result, report)
                                 : settle_state(call, status, e, positions_begin, result, report);
      if (status < 0) return status;
    }
    if (of_run == 2) continue;
    if (of_run == 1) {
      if (const std::int32_t status = call.evaluate_range(first, end - first, result, report); status < 0)
        return status;
      continue;
    }
    for (std::int64_t e = first; e < end; ++e)
      if (const std::int32_t status = call.settle(call.evaluate_open(e, {}), e, result, report); status < 0)
        return status;
  }
  return result;
}

constexpr ents_output no_results() {
  ents_output none{};
  none.struct_size = sizeof none;
  return none;
}

// The arrays that all elements share have to be named, and those that are left out: a stride that was
// forgotten is 0, too, and a state is null.
std::int32_t check_shared(const ents_model& model, const ents_input& caller, const ents_input& in,
                          std::int64_t end, ents_report* report) {
  if (caller.struct_size <
      static_cast<std::int32_t>(offsetof(ents_input, shared) + sizeof(ents_input::shared)))
    return ENTS_OK;
  const struct {
    const char *name, *bit;
    std::int64_t known;
    const void* data;
    std::int64_t stride;
  } arrays[] = {
      {"slave", "ENTS_SHARED_SLAVE", ENTS_SHARED_SLAVE, in.slave, in.slave_stride},
      {"segment", "ENTS_SHARED_SEGMENT", ENTS_SHARED_SEGMENT, in.segment, in.segment_stride},
      {"area", "ENTS_SHARED_AREA", ENTS_SHARED_AREA, in.area, in.area_stride},
      {"state_begin", "ENTS_SHARED_STATE", ENTS_SHARED_STATE, in.state_begin, in.state_begin_stride},
      {"multiplier", "ENTS_SHARED_MULTIPLIER", ENTS_SHARED_MULTIPLIER, in.multiplier, in.multiplier_stride},
      {"slave_values", "ENTS_SHARED_SLAVE_VALUES", ENTS_SHARED_SLAVE_VALUES, in.slave_values,
       in.slave_values_stride},
      {"slave_temperature", "ENTS_SHARED_TEMPERATURE", ENTS_SHARED_TEMPERATURE, in.slave_temperature,
       in.slave_temperature_stride}};
  std::int64_t known = ENTS_SHARED_NO_STATE;
  for (const auto& a : arrays) known |= a.known;
  if ((in.shared & ~known) != 0)
    return report_message(report, ENTS_BAD_MASK, -1, "input.shared has unknown bits (%lld)",
                          static_cast<long long>(in.shared));
  for (const auto& a : arrays)
    if (end > 1 && a.data && a.stride == 0 && (in.shared & a.known) == 0)
      return report_message(report, ENTS_BAD_COUNT, -1,
                            "input.%s_stride is 0: all elements would take the first one's. Set the distance "
                            "of two elements, or "
                            "%s in input.shared if they share it",
                            a.name, a.bit);
  if (has_history(model.plan) && !in.state_begin && (in.shared & ENTS_SHARED_NO_STATE) == 0)
    return report_status(
        report, ENTS_NULL_ARGUMENT, -1,
        "input.state_begin is null: the history of friction, wear or multipliers would begin anew "
        "in every call. Give blocks of ents_state_init, and what output.state_end has at the end of "
        "each increment, or set ENTS_SHARED_NO_STATE in input.shared");
  return ENTS_OK;
}

std::int32_t assemble(const ents_model* model, std::int64_t first, std::int64_t count,
                      const ents_input* input, const ents_output* output, const ents_system* system,
                      ents_report* report) {
  const FloatingPointGuard guard;
  const ents_output none = no_results();
  ElementCall call;
  std::int32_t status = call.open(model, first, count, input, output ? output : &none, report);
  if (status == ENTS_OK) status = check_shared(*model, *input, *call.in, first + count, report);
  if (status != ENTS_OK) return status;
  Assembly assembly(call, report);
  if ((status = assembly.open(system, first, count)) != ENTS_OK) return status;
  report_ok(report);
  return assembly.add(first, count);
}

// What ents_iterate takes of the caller's input: the rest comes from the detection.
std::int32_t check_rest(const ents_model& model, const ents_input& input, ents_report* report) {
  if (input.slave || input.master || input.mesh || input.segment || input.start || input.surface_coordinates)
    return report_status(
        report, ENTS_BAD_VALUE, -1,
        "input.slave, master, surface_coordinates, start, mesh and segment must be null: ents_iterate "
        "takes them from the detection");
  if (model.model.law.has_friction() && input.state_begin && !input.positions_begin && !model.plan.rigid)
    return report_status(
        report, ENTS_NULL_ARGUMENT, -1,
        "input.positions_begin is null: with friction, give the positions of the mesh at the "
        "begin of the increment, in which states move to other segments (mesh.positions if "
        "the master does not deform)");
  if (!model.model.patch.empty())
    return report_status(
        report, ENTS_BAD_VALUE, -1,
        "the elements of this model are patches: they choose their segments themselves; use ents_evaluate");
  return ENTS_OK;
}

// All that can be refused before the first slave is looked at is, and then nothing has been written.
std::int32_t iterate(const ents_model* model, const ents_master_mesh* mesh, const double* tree,
                     std::int64_t size, std::int64_t first, std::int64_t count,
                     const ents_detection* detection, const ents_input* input, const ents_output* output,
                     const ents_system* system, ents_report* report) {
  const FloatingPointGuard guard;
  ents_input copy{};
  std::int32_t status = ENTS_OK;
  const ents_input* rest = known_struct(input, copy, "input", status, report);
  if (rest) status = check_handle(model, report);
  if (status == ENTS_OK) status = check_rest(*model, *rest, report);
  if (status != ENTS_OK) return status;
  DetectionCall slaves;
  if ((status = slaves.open(model, mesh, tree, size, first, count, detection, report)) != ENTS_OK)
    return status;
  ents_input in = *rest;
  in.struct_size = sizeof in;
  in.mesh = mesh;
  in.slave = slaves.io->slave, in.slave_stride = model->plan.dimension;
  in.segment = slaves.io->segment, in.segment_stride = 1;
  in.start = slaves.io->xi, in.start_stride = model->plan.parameters;
  const ents_output none = no_results();
  ElementCall call;
  call.start_first = true;
  if ((status = call.open(model, first, count, &in, output || !system ? output : &none, report)) != ENTS_OK)
    return status;
  if ((status = check_shared(*model, *input, in, first + count, report)) != ENTS_OK) return status;
  Assembly assembly(call, report);
  if (system && (status = assembly.open(system, first, count)) != ENTS_OK) return status;
  assembly.move_states(in.positions_begin);
  slaves.state_begin = in.state_begin, slaves.state_begin_stride = in.state_begin_stride;
  slaves.needs_all = true;
  if (in.slave_begin) slaves.slave_begin = in.slave_begin, slaves.positions_begin = in.positions_begin;
  if ((status = slaves.detect_all(first, count, report)) != ENTS_OK) return status;
  return system ? assembly.add(first, count) : evaluate_found(call, in.positions_begin, first, count, report);
}

} // namespace

} // namespace ents

extern "C" {

int32_t ents_assemble(const ents_model* model, int64_t first, int64_t count, const ents_input* input,
                      const ents_output* output, const ents_system* system, ents_report* report) {
  return ents::entry_point(
      report, [&] { return ents::assemble(model, first, count, input, output, system, report); });
}

int32_t ents_iterate(const ents_model* model, const ents_master_mesh* mesh, const double* tree, int64_t size,
                     int64_t first, int64_t count, const ents_detection* detection, const ents_input* input,
                     const ents_output* output, const ents_system* system, ents_report* report) {
  return ents::entry_point(report, [&] {
    return ents::iterate(model, mesh, tree, size, first, count, detection, input, output, system, report);
  });
}

} // extern "C"
