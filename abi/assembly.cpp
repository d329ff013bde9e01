// SPDX-License-Identifier: BSD-3-Clause
// ents_assemble: elements evaluated, their residuals and tangents added to the host's equations.
#include <algorithm>
#include <cmath>

#include "abi/combination.hpp"
#include "abi/element_block.hpp"
#include "abi/guard.hpp"

namespace ents {

namespace {

constexpr int largest_dofs = 3 * (1 + 16) + 3;

// The host's compressed rows.
struct Pattern {
  const void *row_begin, *columns;
  std::int64_t rows;
  bool wide; // indices of 8 bytes

  std::int64_t begin(std::int64_t row) const {
    return wide ? static_cast<const std::int64_t*>(row_begin)[row]
                : static_cast<const std::int32_t*>(row_begin)[row];
  }
  template <class Index> std::int64_t find(std::int64_t row, std::int64_t column) const {
    const Index* all = static_cast<const Index*>(columns);
    const Index *first = all + begin(row), *last = all + begin(row + 1);
    const Index* at = std::lower_bound(first, last, static_cast<Index>(column));
    return at != last && *at == column ? at - all : -1;
  }
  // Where (row, column) is; -1: nowhere.
  std::int64_t find(std::int64_t row, std::int64_t column) const {
    return wide ? find<std::int64_t>(row, column) : find<std::int32_t>(row, column);
  }
  bool is_column(std::int64_t at, std::int64_t column) const {
    return (wide ? static_cast<const std::int64_t*>(columns)[at]
                 : static_cast<const std::int32_t*>(columns)[at]) == column;
  }
};

class Assembly {
public:
  Assembly(const ElementCall& call, ents_report* report) : call_(call), plan_(*call.plan), report_(report) {}

  std::int32_t open(const ents_system* caller, std::int64_t first, std::int64_t count);
  std::int32_t add(std::int64_t first, std::int64_t count);

private:
  // Dofs of an element that stand side by side in the host: those of a node, or of the multipliers.
  struct Group {
    int dof; // first one in the element
    int size;
    const std::int64_t* equations; // [size]
    double weight;
  };

  static constexpr int block_numbers = 8192; // of tangents, on the stack
  std::int32_t add(std::int64_t e);
  std::uint64_t evaluate_block(std::int64_t first, std::int64_t count, double* residuals, double* tangents, std::int32_t* flags) const;
  std::int32_t add_evaluated(std::int64_t e, std::int32_t flags, const double* residual, const double* tangent) const;
  std::int32_t add_element(std::int64_t e, const double* residual, const double* tangent) const;
  bool add_known(std::int64_t e, const double* tangent) const;
  std::int32_t check_equations(const char* name, const std::int64_t* equations, std::int64_t nodes,
                               std::int64_t node) const;
  // Calls f(group) for the groups of one node of the element; what f returns ends it unless it is 0.
  template <class F> std::int32_t for_groups(std::int64_t e, int node, F&& f) const;
  std::int32_t add_residual(std::int64_t e, const double* residual) const;
  std::int32_t add_tangent(std::int64_t e, const double* tangent) const;
  std::int32_t add_block(std::int64_t e, const Group& row, const Group& column, const double* tangent,
                         std::int64_t* place) const;
  std::int32_t open_element(std::int64_t e, double* residual, double* tangent) const;
  int nodes() const {
    return plan_.dofs == plan_.dimension + plan_.multipliers ? 1 : 1 + plan_.nodes;
  } // with equations

  const ElementCall& call_;
  const Plan& plan_;
  ents_report* report_;
  ents_system copy_;
  const ents_system* system_;
  ents_combination slave_, master_;
  Pattern pattern_;
};

std::int32_t Assembly::open(const ents_system* caller, std::int64_t first, std::int64_t count) {
  std::int32_t status = ENTS_OK;
  system_ = known_struct(caller, copy_, "system", status, report_);
  if (!system_) return status;
  const ents_system& s = *system_;
  if ((call_.out->wanted & (ENTS_RESIDUAL | ENTS_TANGENT)) != 0)
    return report_status(report_, ENTS_BAD_MASK, -1,
                         "output.wanted asks for residual or tangent; ents_assemble adds them to the system");
  if (!call_.in->mesh) return report_status(report_, ENTS_NULL_ARGUMENT, -1, "input.mesh is null");
  if (s.index_size != 4 && s.index_size != 8)
    return report_message(report_, ENTS_BAD_VALUE, -1, "system.index_size is %d; it must be 4 or 8",
                          s.index_size);
  if (s.rows < 0 || s.slave_nodes < 0 || s.master_nodes < 0)
    return report_message(report_, ENTS_BAD_COUNT, -1, "system.%s is negative",
                          s.rows < 0 ? "rows" : (s.slave_nodes < 0 ? "slave_nodes" : "master_nodes"));
  const bool rigid = nodes() == 1;
  const struct {
    const char* name;
    bool needed;
    const void* array;
  } arrays[] = {{"slave_equations", true, s.slave_equations},
                {"master_equations", !rigid, s.master_equations},
                {"multiplier_equations", plan_.multipliers > 0, s.multiplier_equations},
                {"row_begin", s.values != nullptr, s.row_begin},
                {"columns", s.values != nullptr, s.columns}};
  for (const auto& a : arrays)
    if (a.needed && !a.array && count > 0)
      return report_message(report_, ENTS_NULL_ARGUMENT, -1, "system.%s is null", a.name);
  if (s.slave && (status = check_combination(s.slave, "system.slave", slave_, report_)) != ENTS_OK)
    return status;
  if (s.master && (status = check_combination(s.master, "system.master", master_, report_)) != ENTS_OK)
    return status;
  if (s.slave && slave_.points < first + count)
    return report_message(report_, ENTS_BAD_COUNT, -1,
                          "system.slave has %lld points; the elements end at %lld",
                          static_cast<long long>(slave_.points), static_cast<long long>(first + count));
  if (s.master && master_.points < call_.mesh.nodes)
    return report_message(report_, ENTS_BAD_COUNT, -1,
                          "system.master has %lld points; the mesh has %lld nodes",
                          static_cast<long long>(master_.points), static_cast<long long>(call_.mesh.nodes));
  const std::int64_t places = std::int64_t{plan_.dimension} * nodes() * nodes() + 1;
  if (s.places && !s.slave && !s.master && s.places_size < places)
    return report_message(report_, ENTS_BAD_COUNT, -1, "system.places_size is %lld; at least %lld is needed",
                          static_cast<long long>(s.places_size), static_cast<long long>(places));
  pattern_ = {s.row_begin, s.columns, s.rows, s.index_size == 8};
  return ENTS_OK;
}

std::int32_t Assembly::check_equations(const char* name, const std::int64_t* equations, std::int64_t nodes,
                                       std::int64_t node) const {
  if (node < 0 || node >= nodes)
    return report_message(report_, ENTS_BAD_COUNT, -1, "system.%s covers %lld nodes; node %lld is needed",
                          name, static_cast<long long>(nodes), static_cast<long long>(node));
  for (int i = 0; i < plan_.dimension; ++i)
    if (equations[node * plan_.dimension + i] >= system_->rows)
      return report_message(
          report_, ENTS_BAD_VALUE, -1, "system.%s of node %lld is %lld; there are %lld rows", name,
          static_cast<long long>(node), static_cast<long long>(equations[node * plan_.dimension + i]),
          static_cast<long long>(system_->rows));
  return ENTS_OK;
}

template <class F> std::int32_t Assembly::for_groups(std::int64_t e, int node, F&& f) const {
  const int d = plan_.dimension;
  const bool is_slave = node == 0;
  const ents_combination* combination =
      is_slave ? (system_->slave ? &slave_ : nullptr) : (system_->master ? &master_ : nullptr);
  const std::int64_t point =
      is_slave ? e : call_.mesh.connectivity[call_.segment(e) * plan_.nodes + node - 1];
  const std::int64_t* equations = is_slave ? system_->slave_equations : system_->master_equations;
  const std::int64_t count = is_slave ? system_->slave_nodes : system_->master_nodes;
  const char* name = is_slave ? "slave_equations" : "master_equations";
  if (!combination) {
    if (const std::int32_t status = check_equations(name, equations, count, point); status != ENTS_OK)
      return status;
    return f(Group{d * node, d, equations + point * d, 1.0});
  }
  if (const std::int32_t status = check_combined_point(
          *combination, is_slave ? "system.slave" : "system.master", point, count, report_);
      status != ENTS_OK)
    return status;
  for (std::int64_t j = combination->begin[point]; j < combination->begin[point + 1]; ++j) {
    std::int32_t status = check_equations(name, equations, count, combination->nodes[j]);
    if (status == ENTS_OK)
      status = f(Group{d * node, d, equations + combination->nodes[j] * d, combination->weights[j]});
    if (status != ENTS_OK) return status;
  }
  return ENTS_OK;
}

std::int32_t Assembly::add_residual(std::int64_t e, const double* residual) const {
  const auto add = [&](const Group& group) -> std::int32_t {
    for (int i = 0; i < group.size; ++i)
      if (group.equations[i] >= 0)
        system_->residual[group.equations[i]] += group.weight * residual[group.dof + i];
    return ENTS_OK;
  };
  const bool has_segment = call_.segment(e) >= 0;
  for (int node = 0; has_segment && node < nodes(); ++node)
    if (const std::int32_t status = for_groups(e, node, add); status != ENTS_OK) return status;
  if (plan_.multipliers > 0)
    return add({plan_.dofs - plan_.multipliers, plan_.multipliers,
                system_->multiplier_equations + e * plan_.multipliers, 1.0});
  return ENTS_OK;
}

std::int32_t Assembly::add_block(std::int64_t e, const Group& row, const Group& column, const double* tangent,
                                 std::int64_t* place) const {
  const double weight = row.weight * column.weight;
  const std::int64_t *rows = row.equations, *columns = column.equations;
  bool in_line = true; // the columns stand side by side in every row
  for (int j = 0; j < column.size; ++j) in_line = in_line && columns[j] == columns[0] + j && columns[j] >= 0;
  for (int i = 0; i < row.size; ++i) {
    if (rows[i] < 0) continue;
    const double* block = tangent + (row.dof + i) + static_cast<std::int64_t>(column.dof) * plan_.dofs;
    std::int64_t known = place ? place[i] - 1 : -1;
    for (int j = 0; j < column.size; ++j) {
      if (columns[j] < 0) continue;
      std::int64_t at = known >= 0 ? known + j : -1;
      if (at < 0) {
        at = pattern_.find(rows[i], columns[j]);
        if (at < 0)
          return report_message(
              report_, ENTS_BAD_PATTERN, e, "the pattern has no entry (%lld, %lld), which element %lld needs",
              static_cast<long long>(rows[i]), static_cast<long long>(columns[j]), static_cast<long long>(e));
        if (in_line && j == 0 && at + column.size <= pattern_.begin(rows[i] + 1) &&
            pattern_.is_column(at + column.size - 1, columns[column.size - 1])) {
          known = at;
          if (place) place[i] = at + 1;
        }
      }
      system_->values[at] += weight * block[static_cast<std::int64_t>(j) * plan_.dofs];
    }
  }
  return ENTS_OK;
}

// Every entry where an earlier call has found its place. False, and nothing added: not all of them are known.
bool Assembly::add_known(std::int64_t e, const double* tangent) const {
  if (!system_->places || system_->slave || system_->master || plan_.multipliers > 0) return false;
  const int d = plan_.dimension, count = nodes(), n = plan_.dofs;
  const std::int64_t* places = system_->places + e * system_->places_size;
  if (places[0] != call_.segment(e) + 1) return false;
  ++places;
  bool known = true;
  for (int i = 0; i < d * count * count; ++i) known &= places[i] > 0;
  if (!known) return false;
  double* values = system_->values - 1;
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b)
      for (int i = 0; i < d; ++i) {
        double* row = values + places[d * (count * a + b) + i];
        const double* entries = tangent + (d * a + i) + d * b * n;
        row[0] += entries[0];
        row[1] += entries[n];
        if (d == 3) row[2] += entries[2 * n];
      }
  return true;
}

std::int32_t Assembly::add_tangent(std::int64_t e, const double* tangent) const {
  if (add_known(e, tangent)) return ENTS_OK;
  const int d = plan_.dimension, count = nodes();
  const std::int64_t segment = call_.segment(e);
  std::int64_t* places = nullptr;
  if (system_->places && !system_->slave && !system_->master && segment >= 0) {
    places = system_->places + e * system_->places_size;
    if (places[0] != segment + 1) { // those of another segment
      std::fill_n(places + 1, d * count * count, std::int64_t{0});
      places[0] = segment + 1;
    }
  }
  const Group multipliers{
      plan_.dofs - plan_.multipliers, plan_.multipliers,
      plan_.multipliers > 0 ? system_->multiplier_equations + e * plan_.multipliers : nullptr, 1.0};
  if (segment < 0) return add_block(e, multipliers, multipliers, tangent, nullptr);
  for (int a = 0; a < count; ++a) {
    const std::int32_t status = for_groups(e, a, [&](const Group& row) -> std::int32_t {
      for (int b = 0; b < count; ++b) {
        const std::int32_t outcome = for_groups(e, b, [&](const Group& column) {
          return add_block(e, row, column, tangent, places ? places + 1 + d * (count * a + b) : nullptr);
        });
        if (outcome != ENTS_OK) return outcome;
      }
      if (plan_.multipliers == 0) return ENTS_OK;
      const std::int32_t outcome = add_block(e, row, multipliers, tangent, nullptr);
      return outcome == ENTS_OK ? add_block(e, multipliers, row, tangent, nullptr) : outcome;
    });
    if (status != ENTS_OK) return status;
  }
  return plan_.multipliers > 0 ? add_block(e, multipliers, multipliers, tangent, nullptr) : ENTS_OK;
}

// An element without a segment: its multipliers are zero, scaled like those of elements that are open.
std::int32_t Assembly::open_element(std::int64_t e, double* residual, double* tangent) const {
  const ents_input& in = *call_.in;
  const double area = in.area ? *at(in.area, in.area_stride, e) : 1.0;
  const int nodes = plan_.dofs - plan_.multipliers;
  for (int a = 0; a < plan_.multipliers; ++a) {
    const double slope = -area / (a == 0 ? plan_.law.stiffness : plan_.law.friction_stiffness);
    residual[nodes + a] = slope * at(in.multiplier, in.multiplier_stride, e)[a];
    for (int b = 0; b < plan_.multipliers; ++b)
      tangent[(nodes + b) * plan_.dofs + nodes + a] = a == b ? slope : 0.0;
  }
  return ENTS_OK;
}

std::int32_t Assembly::add(std::int64_t e) {
  double residual[largest_dofs], tangent[largest_dofs * largest_dofs];
  std::int32_t flags = 0;
  const std::int64_t segment = call_.segment(e);
  if (segment < -1) return call_.refuse_segment(e, report_);
  if (segment == -1) {
    call_.write_open(e);
    if (plan_.multipliers == 0) return ENTS_OK;
    open_element(e, residual, tangent);
  } else {
    const ElementCall::Wanted wanted = {ENTS_FLAGS | (system_->residual ? ENTS_RESIDUAL : 0) |
                                            (system_->values ? ENTS_TANGENT : 0),
                                        residual, tangent, &flags};
    const std::int32_t status = call_.evaluate(e, wanted, report_);
    if ((call_.out->wanted & ENTS_FLAGS) != 0) *at(call_.out->flags, call_.out->flags_stride, e) = flags;
    if (status != ENTS_OK) return status;
    if ((flags & ENTS_FLAG_CONTACT) == 0 && plan_.multipliers == 0) return ENTS_OK; // nothing but zeros
  }
  return add_element(e, residual, tangent);
}

std::int32_t Assembly::add_evaluated(std::int64_t e, std::int32_t flags, const double* residual, const double* tangent) const {
  if ((call_.out->wanted & ENTS_FLAGS) != 0) *at(call_.out->flags, call_.out->flags_stride, e) = flags;
  if (call_.out->status) *at(call_.out->status, call_.out->status_stride, e) = ENTS_OK;
  return (flags & ENTS_FLAG_CONTACT) == 0 ? ENTS_OK : add_element(e, residual, tangent);
}

std::int32_t Assembly::add_element(std::int64_t e, const double* residual, const double* tangent) const {
  std::int32_t status = ENTS_OK;
  if (system_->residual) status = add_residual(e, residual);
  if (system_->values && status == ENTS_OK) status = add_tangent(e, tangent);
  return status;
}

// Bit k: element first + k is evaluated.
std::uint64_t Assembly::evaluate_block(std::int64_t first, std::int64_t count, double* residuals, double* tangents,
                                       std::int32_t* flags) const {
  const std::int32_t wanted = call_.out->wanted | ENTS_FLAGS | ENTS_RESIDUAL | (system_->values ? ENTS_TANGENT : 0);
  if (pair_results(*call_.model, wanted) != wanted) return 0;
  ElementCall::BlockNodes nodes;
  PairBlock block = pair_block(*call_.model, *call_.in, *call_.out, first);
  if (!call_.gather_block(first, count, nodes, block)) return 0;
  block.wanted = wanted;
  block.residual = residuals, block.residual_stride = plan_.dofs;
  block.tangent = tangents, block.tangent_stride = std::int64_t{plan_.dofs} * plan_.dofs;
  block.leading = plan_.dofs;
  block.flags = flags, block.flags_stride = 1;
  return plan_.pairs(plan_, block, static_cast<std::int32_t>(count));
}

std::int32_t Assembly::add(std::int64_t first, std::int64_t count) {
  const std::int64_t most =
      std::clamp<std::int64_t>(block_numbers / (plan_.dofs * plan_.dofs), 1, ElementCall::BlockNodes::most);
  double residuals[ElementCall::BlockNodes::most * largest_dofs], tangents[block_numbers];
  std::int32_t flags[ElementCall::BlockNodes::most], result = ENTS_OK;
  for (std::int64_t size; count > 0; first += size, count -= size) {
    for (size = 0; size < std::min(count, most) && call_.segment(first + size) >= 0;) ++size;
    const std::uint64_t done = size == 0 ? 0 : evaluate_block(first, size, residuals, tangents, flags);
    size = std::max<std::int64_t>(size, 1); // without a segment
    for (std::int64_t k = 0; k < size; ++k) {
      const std::int64_t e = first + k;
      const std::int32_t outcome =
          (done >> k & 1) == 0 ? add(e)
                               : add_evaluated(e, flags[k], residuals + k * plan_.dofs, tangents + k * plan_.dofs * plan_.dofs);
      if (const std::int32_t end = call_.settle(outcome, e, result, report_); end < 0) return end;
    }
  }
  return result;
}

std::int32_t assemble(const ents_model* model, std::int64_t first, std::int64_t count,
                      const ents_input* input, const ents_output* output, const ents_system* system,
                      ents_report* report) {
  const FloatingPointGuard guard;
  ents_output none{};
  none.struct_size = sizeof none;
  ElementCall call;
  std::int32_t status = call.open(model, first, count, input, output ? output : &none, report);
  if (status != ENTS_OK) return status;
  Assembly assembly(call, report);
  if ((status = assembly.open(system, first, count)) != ENTS_OK) return status;
  report_ok(report);
  return assembly.add(first, count);
}

// The elements that a detection has found; results per element only.
std::int32_t evaluate_found(const ents_model* model, std::int64_t first, std::int64_t count,
                            const ents_input* input, const ents_output* output, ents_report* report) {
  const FloatingPointGuard guard;
  ElementCall call;
  if (const std::int32_t status = call.open(model, first, count, input, output, report); status != ENTS_OK)
    return status;
  report_ok(report);
  std::int32_t result = ENTS_OK;
  for (std::int64_t end, last = first + count; first < last; first = end) { // runs of elements with a segment, and without
    const bool found = call.segment(first) >= 0;
    for (end = first + 1; end < last && (call.segment(end) >= 0) == found;) ++end;
    if (!found)
      for (std::int64_t e = first; e < end; ++e) call.write_open(e);
    else if (const std::int32_t status = call.evaluate_range(first, end - first, report); status < 0) return status;
    else if (status > 0 && result == ENTS_OK) result = status;
  }
  return result;
}

} // namespace

} // namespace ents

extern "C" {

int32_t ents_assemble(const ents_model* model, int64_t first, int64_t count, const ents_input* input,
                      const ents_output* output, const ents_system* system, ents_report* report) {
  return ents::at_the_door(
      report, [&] { return ents::assemble(model, first, count, input, output, system, report); });
}

int32_t ents_iterate(const ents_model* model, const ents_master_mesh* mesh, const double* tree, int64_t size,
                     int64_t first, int64_t count, const ents_detection* detection, const ents_input* input,
                     const ents_output* output, const ents_system* system, ents_report* report) {
  return ents::at_the_door(report, [&] {
    ents_input copy{};
    std::int32_t status = ENTS_OK;
    const ents_input* known = ents::known_struct(input, copy, "input", status, report);
    if (!known) return status;
    if (known->slave || known->master || known->mesh || known->segment || known->start ||
        known->surface_coordinates)
      return ents::report_status(
          report, ENTS_BAD_VALUE, -1,
          "input.slave, master, surface_coordinates, start, mesh and segment must be null: ents_iterate "
          "takes them from the detection");
    if ((status = ents_detect(model, mesh, tree, size, first, count, detection, report)) != ENTS_OK)
      return status;
    if (model->model.law.has_friction() && known->state_begin)
      return ents::report_status(
          report, ENTS_BAD_VALUE, -1,
          "input.state_begin with friction: use ents_detect, ents_state_transfer and ents_assemble");
    if (!detection->flags)
      return ents::report_status(report, ENTS_NULL_ARGUMENT, -1, "detection.flags is null; ents_iterate tells lost slaves by them");
    for (std::int64_t i = first; i < first + count; ++i)
        if ((detection->flags[i] & ENTS_FLAG_BEHIND_EDGE) != 0)
          return ents::report_message(report, ENTS_NO_PROJECTION, i,
                                      "slave %lld is behind an edge between segments and ahead of none",
                                      static_cast<long long>(i));
    ents_input in = *known;
    in.struct_size = sizeof in;
    in.mesh = mesh;
    in.slave = detection->slave, in.slave_stride = model->plan.dimension;
    in.segment = detection->segment, in.segment_stride = 1;
    in.start = detection->xi, in.start_stride = model->plan.parameters;
    if (system) return ents::assemble(model, first, count, &in, output, system, report);
    return ents::evaluate_found(model, first, count, &in, output, report);
  });
}

} // extern "C"
