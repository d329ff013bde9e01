// SPDX-License-Identifier: BSD-3-Clause
#include "abi/call/equations.hpp"

#include <algorithm>
#include <type_traits>

namespace ents {

std::int32_t Equations::open(const ents_system* caller, std::int64_t first, std::int64_t count) {
  std::int32_t status = ENTS_OK;
  system_ = known_struct(caller, copy_, "system", status, report_);
  if (!system_) return status;
  const ents_system& s = *system_;
  if (call_.model->model.law.normal == NormalKind::none)
    return refuse_without_contact("argument 'system' asks for residual and tangent", report_);
  if ((call_.out->wanted & (ENTS_RESIDUAL | ENTS_TANGENT)) != 0)
    return report_status(report_, ENTS_BAD_MASK, -1,
                         "output.wanted asks for residual or tangent; ents_assemble adds them to the system");
  if (!call_.in->mesh) return report_status(report_, ENTS_NULL_ARGUMENT, -1, "input.mesh is null");
  if ((status = call_.check_time(report_)) != ENTS_OK) return status;
  if ((status = call_.check_temperatures(report_)) != ENTS_OK) return status;
  if (s.index_size != 4 && s.index_size != 8)
    return report_message(report_, ENTS_BAD_VALUE, -1, "system.index_size is %d; it must be 4 or 8",
                          s.index_size);
  const struct {
    const char* name;
    std::int64_t value;
  } counts[] = {{"rows", s.rows},
                {"slave_nodes", s.slave_nodes},
                {"master_nodes", s.master_nodes},
                {"places_size", s.places ? s.places_size : 0}};
  for (const auto& c : counts)
    if (c.value < 0 || c.value > std::int64_t{1} << 40)
      return report_message(report_, ENTS_BAD_COUNT, -1, "system.%s is %lld; it must be 0 .. 2^40", c.name,
                            static_cast<long long>(c.value));
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
  if (s.slave && slave_.heights && !s.slave_positions && count > 0)
    return report_status(
        report_, ENTS_NULL_ARGUMENT, -1,
        "system.slave_positions is null, but system.slave has heights: their normals turn with these nodes");
  if (s.master && master_.heights)
    return report_status(report_, ENTS_BAD_VALUE, -1,
                         "system.master has heights: the height of a master is its model's, \"height\"");
  if (s.master && master_.points < call_.mesh.nodes)
    return report_message(report_, ENTS_BAD_COUNT, -1,
                          "system.master has %lld points; the mesh has %lld nodes",
                          static_cast<long long>(master_.points), static_cast<long long>(call_.mesh.nodes));
  if (s.pose && (status = check_body()) != ENTS_OK) return status;
  for (std::int64_t e = first; plan_.multipliers > 0 && e < first + count; ++e)
    for (int a = 0; a < plan_.multipliers; ++a)
      if (const std::int64_t equation = s.multiplier_equations[e * plan_.multipliers + a]; equation >= s.rows)
        return report_message(report_, ENTS_BAD_VALUE, e,
                              "system.multiplier_equations of element %lld is %lld; there are %lld rows",
                              static_cast<long long>(e), static_cast<long long>(equation),
                              static_cast<long long>(s.rows));
  const std::int64_t places = std::int64_t{plan_.node_dofs} * nodes() * nodes() + 1;
  if (s.places && !s.slave && !s.master && s.places_size < places)
    return report_message(report_, ENTS_BAD_COUNT, -1, "system.places_size is %lld; at least %lld is needed",
                          static_cast<long long>(s.places_size), static_cast<long long>(places));
  if (!s.slave && s.slave_nodes < first + count)
    return report_message(report_, ENTS_BAD_COUNT, -1,
                          "system.slave_nodes is %lld; the elements end at %lld, and slave point i is node i",
                          static_cast<long long>(s.slave_nodes), static_cast<long long>(first + count));
  pattern_ = {s.row_begin, s.columns, s.rows, s.index_size == 8};
  if (s.values && count > 0 && (status = check_pattern()) != ENTS_OK) return status;
  constexpr std::int64_t cached = std::int64_t{1} << 18;
  large_ = s.values && count > 0 && pattern_.begin(s.rows) > cached;
  return ENTS_OK;
}

std::int32_t Equations::check_body() {
  const ents_system& s = *system_;
  if (plan_.heat)
    return report_status(
        report_, ENTS_BAD_VALUE, -1,
        "system.pose is given, but the model has \"heat\": a body that moves by a pose has no "
        "temperature; move the nodes of the mesh instead");
  if (nodes() != 1 || plan_.multipliers > 0)
    return report_message(report_, ENTS_BAD_VALUE, -1, "system.pose is given, but the model %s",
                          plan_.multipliers > 0
                              ? "has multipliers as unknowns; \"augmented\" keeps them in the state"
                              : "has a deformable master; write \"master\": \"rigid\"");
  if (!s.body_equations)
    return report_status(report_, ENTS_NULL_ARGUMENT, -1,
                         "system.body_equations is null, but system.pose is not");
  std::int32_t status = ENTS_OK;
  if (!(pose_ = checked_pose(plan_.dimension, s.pose, pose_copy_, "system.pose", status, report_)))
    return status;
  for (int i = 0; i < body_dofs(plan_.dimension); ++i)
    if (s.body_equations[i] >= s.rows)
      return report_message(report_, ENTS_BAD_VALUE, -1,
                            "system.body_equations[%d] is %lld; there are %lld rows", i,
                            static_cast<long long>(s.body_equations[i]), static_cast<long long>(s.rows));
  return ENTS_OK;
}

// Arrays counted from 1, or of the other index size, show at their ends.
std::int32_t Equations::check_pattern() {
  const std::int64_t begin = pattern_.begin(0), entries = pattern_.begin(pattern_.rows);
  if (begin != 0)
    return report_message(report_, ENTS_BAD_VALUE, -1,
                          "system.row_begin[0] is %lld; it must be 0: rows and columns are counted from 0 "
                          "(in Fortran pass row_begin - 1 and "
                          "columns - 1)",
                          static_cast<long long>(begin));
  if (entries < 0)
    return report_message(
        report_, ENTS_BAD_VALUE, -1,
        "system.row_begin[rows] is %lld; is system.index_size (%d bytes) that of the array?",
        static_cast<long long>(entries), pattern_.wide ? 8 : 4);
  if (entries > 0 && pattern_.column(entries - 1) >= pattern_.rows)
    return report_message(
        report_, ENTS_BAD_VALUE, -1,
        "the last of system.columns is %lld; there are %lld rows: rows and columns are counted from 0, and "
        "system.index_size (%d bytes) is that of both arrays",
        static_cast<long long>(pattern_.column(entries - 1)), static_cast<long long>(pattern_.rows),
        pattern_.wide ? 8 : 4);
  pattern_.entries = entries;
  for (std::int64_t row = 0; row < std::min<std::int64_t>(pattern_.rows, 4); ++row)
    if (pattern_.begin(row + 1) < pattern_.begin(row))
      return report_message(report_, ENTS_BAD_VALUE, -1,
                            "system.row_begin falls from %lld to %lld in row %lld; is system.index_size (%d "
                            "bytes) that of the array?",
                            static_cast<long long>(pattern_.begin(row)),
                            static_cast<long long>(pattern_.begin(row + 1)), static_cast<long long>(row),
                            pattern_.wide ? 8 : 4);
  return ENTS_OK;
}

std::int32_t Equations::check_equations(const char* name, const std::int64_t* equations, std::int64_t nodes,
                                        std::int64_t node) const {
  if (node < 0 || node >= nodes)
    return report_message(report_, ENTS_BAD_COUNT, -1, "system.%s covers %lld nodes; node %lld is needed",
                          name, static_cast<long long>(nodes), static_cast<long long>(node));
  for (int i = 0; i < plan_.node_dofs; ++i)
    if (equations[node * plan_.node_dofs + i] >= system_->rows)
      return report_message(
          report_, ENTS_BAD_VALUE, -1, "system.%s of node %lld is %lld; there are %lld rows", name,
          static_cast<long long>(node), static_cast<long long>(equations[node * plan_.node_dofs + i]),
          static_cast<long long>(system_->rows));
  return ENTS_OK;
}

std::int32_t Equations::add_residual(std::int64_t e, const double* residual) const {
  const auto add = [&](const Group& group) -> std::int32_t {
    for (int i = 0; i < group.size; ++i)
      if (group.equations[i] >= 0)
        system_->residual[group.equations[i]] += group.weight_of(i) * residual[group.dof + i];
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

std::int32_t Equations::add_block(std::int64_t e, const Group& row, const Group& column,
                                  const double* tangent, int leading, std::int64_t* place) const {
  const double weight = row.weight * column.weight;
  const auto sign = [&](int i, int j) {
    return ((row.reflected >> i ^ column.reflected >> j) & 1) != 0 ? -1.0 : 1.0;
  };
  const std::int64_t *rows = row.equations, *columns = column.equations;
  bool in_line = true; // the columns stand side by side in every row
  for (int j = 0; j < column.size; ++j) in_line = in_line && columns[j] == columns[0] + j && columns[j] >= 0;
  for (int i = 0; i < row.size; ++i) {
    if (rows[i] < 0) continue;
    const double* block = tangent + (row.dof + i) + static_cast<std::int64_t>(column.dof) * leading;
    std::int64_t known = place ? place[i] - 1 : -1;
    for (int j = 0; j < column.size; ++j) {
      if (columns[j] < 0) continue;
      std::int64_t at = known >= 0 ? known + j : -1;
      if (at < 0) {
        at = pattern_.find(rows[i], columns[j]);
        if (at < 0)
          return report_message(report_, ENTS_BAD_PATTERN, e,
                                "system.columns has no entry (%lld, %lld), which element %lld needs: the "
                                "pattern has to couple all dofs of the "
                                "slave node and of the master nodes of its segment",
                                static_cast<long long>(rows[i]), static_cast<long long>(columns[j]),
                                static_cast<long long>(e));
        if (in_line && j == 0 && at + column.size <= pattern_.begin(rows[i] + 1) &&
            pattern_.column(at + column.size - 1) == columns[column.size - 1]) {
          known = at;
          if (place) place[i] = at + 1;
        }
      }
      system_->values[at] += sign(i, j) * weight * block[static_cast<std::int64_t>(j) * leading];
    }
  }
  return ENTS_OK;
}

// Where an earlier call has found the entries of an element: a stamp of its equations and of the size of the
// pattern, negative once all of them are known; then for node a and node b, the begin of each row's d
// entries, counted from 1, or 0. Other equations, as after remeshing, have another stamp. Null: not all of
// them are known.
inline const std::int64_t* Equations::known_places(std::int64_t e) const noexcept {
  if (!system_->places || system_->slave || system_->master || plan_.multipliers > 0) return nullptr;
  const std::int64_t* places = system_->places + e * system_->places_size;
  return places[0] < 0 && call_.segment(e) >= 0 && places[0] == -stamp(e) ? places + 1 : nullptr;
}

// 0: of a node without equations
std::int64_t Equations::stamp(std::int64_t e) const noexcept {
  constexpr std::uint64_t factor = 0x9e3779b97f4a7c15u; // odd: its powers are not zero
  const int d = plan_.node_dofs, count = nodes();
  std::uint64_t sum = static_cast<std::uint64_t>(pattern_.entries) * factor, power = factor * factor;
  const std::int64_t* connectivity =
      count > 1 ? call_.mesh.connectivity + call_.segment(e) * plan_.nodes : nullptr;
  for (int a = 0; a < count; ++a) {
    const std::int64_t node = a == 0 ? e : connectivity[a - 1];
    if (node < 0 || node >= (a == 0 ? system_->slave_nodes : system_->master_nodes)) return 0;
    const std::int64_t* rows = (a == 0 ? system_->slave_equations : system_->master_equations) + node * d;
    for (int i = 0; i < d; ++i, power *= factor) sum += (static_cast<std::uint64_t>(rows[i]) + 2) * power;
  }
  return static_cast<std::int64_t>((sum ^ sum >> 29) >> 1 | 1);
}

// Known places mean that all equations of the element have been looked at, and none is left out.
template <int D>
void Equations::add_known(std::int64_t e, const std::int64_t* places, const double* residual,
                          const double* tangent, bool symmetric) const noexcept {
  const int count = nodes(), n = plan_.dofs;
  if (system_->residual) {
    const std::int64_t* connectivity =
        count > 1 ? call_.mesh.connectivity + call_.segment(e) * plan_.nodes : nullptr;
    for (int a = 0; a < count; ++a) {
      const std::int64_t* rows =
          a == 0 ? system_->slave_equations + e * D : system_->master_equations + connectivity[a - 1] * D;
      for (int i = 0; i < D; ++i) system_->residual[rows[i]] += residual[D * a + i];
    }
  }
  if (!system_->values) return;
  double* const values = system_->values - 1;
  // numbers of a row side by side where the element's symmetry lets its columns stand for them
  const std::int64_t along = symmetric ? 1 : n, across = symmetric ? n : 1;
  const auto add = [&](auto step) {
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < count; ++b, places += D)
        for (int i = 0; i < D; ++i) {
          double* const row = values + places[i];
          const double* const entries = tangent + (D * a + i) * across + D * b * along;
          double sum[D];
          for (int j = 0; j < D; ++j) sum[j] = row[j] + entries[j * step];
          for (int j = 0; j < D; ++j) row[j] = sum[j];
        }
  };
  if (symmetric)
    add(std::integral_constant<std::int64_t, 1>{});
  else
    add(std::int64_t{n});
}

void Equations::fetch([[maybe_unused]] std::int64_t e) const noexcept {
#if defined(__GNUC__)
  if (!large_) return;
  if (!system_->places || system_->slave || system_->master || system_->pose || plan_.multipliers > 0) return;
  const std::int64_t* places = system_->places + e * system_->places_size;
  if (*places++ >= 0) return;
  for (int i = 0, count = plan_.node_dofs * nodes() * nodes(); i < count; ++i) {
    __builtin_prefetch(system_->values + places[i], 1);
    asm volatile(""); // or a compiler takes the whole function for one without effect
  }
#endif
}

std::int32_t Equations::add_tangent(std::int64_t e, const double* tangent) const {
  const int d = plan_.node_dofs, count = nodes();
  const std::int64_t segment = call_.segment(e);
  std::int64_t* places = nullptr;
  if (system_->places && !system_->slave && !system_->master && segment >= 0) {
    places = system_->places + e * system_->places_size;
    if (const std::int64_t now = stamp(e); places[0] != now) { // those of other equations
      std::fill_n(places + 1, d * count * count, std::int64_t{0});
      places[0] = now;
    }
  }
  const Group multipliers{
      plan_.dofs - plan_.multipliers, plan_.multipliers,
      plan_.multipliers > 0 ? system_->multiplier_equations + e * plan_.multipliers : nullptr, 1.0};
  if (segment < 0) return add_block(e, multipliers, multipliers, tangent, plan_.dofs, nullptr);
  if ((system_->slave || system_->master) && plan_.multipliers == 0) {
    bool added = false;
    const std::int32_t status = add_by_nodes(e, tangent, added);
    if (added || status != ENTS_OK) return status;
  }
  for (int a = 0; a < count; ++a) {
    const std::int32_t status = for_groups(e, a, [&](const Group& row) -> std::int32_t {
      for (int b = 0; b < count; ++b) {
        const std::int32_t outcome = for_groups(e, b, [&](const Group& column) {
          return add_block(e, row, column, tangent, plan_.dofs,
                           places ? places + 1 + d * (count * a + b) : nullptr);
        });
        if (outcome != ENTS_OK) return outcome;
      }
      if (plan_.multipliers == 0) return ENTS_OK;
      const std::int32_t outcome = add_block(e, row, multipliers, tangent, plan_.dofs, nullptr);
      return outcome == ENTS_OK ? add_block(e, multipliers, row, tangent, plan_.dofs, nullptr) : outcome;
    });
    if (status != ENTS_OK) return status;
  }
  if (places && plan_.multipliers == 0 &&
      std::find(places + 1, places + 1 + d * count * count, 0) == places + 1 + d * count * count)
    places[0] = -places[0];
  return plan_.multipliers > 0 ? add_block(e, multipliers, multipliers, tangent, plan_.dofs, nullptr)
                               : ENTS_OK;
}

// Slave and body: the groups are those of the slave node, or of the nodes of the slave point, and the body's.
std::int32_t Equations::add_with_body(std::int64_t e, const double* residual, const double* tangent) const {
  const int d = plan_.dimension, body = body_dofs(d), n = d + body;
  double r[largest_body_element], t[largest_body_element * largest_body_element];
  add_body(d, pose_->turn, at(call_.in->slave, call_.in->slave_stride, e), residual,
           system_->values ? tangent : nullptr, r, t);
  const Group of_body{d, body, system_->body_equations, 1.0};
  const auto for_each = [&](auto&& f) {
    const std::int32_t status = for_groups(e, 0, f);
    return status == ENTS_OK ? f(of_body) : status;
  };
  std::int32_t status = ENTS_OK;
  if (system_->residual)
    status = for_each([&](const Group& group) -> std::int32_t {
      for (int i = 0; i < group.size; ++i)
        if (group.equations[i] >= 0) system_->residual[group.equations[i]] += group.weight * r[group.dof + i];
      return ENTS_OK;
    });
  if (!system_->values || status != ENTS_OK) return status;
  return for_each([&](const Group& row) {
    return for_each([&](const Group& column) { return add_block(e, row, column, t, n, nullptr); });
  });
}

std::int32_t Equations::add(std::int64_t e, const double* residual, const double* tangent,
                            bool symmetric) const {
  if (system_->slave && slave_.heights && call_.segment(e) >= 0) return add_raised(e, residual, tangent);
  if (system_->pose) return add_with_body(e, residual, tangent);
  if (const std::int64_t* places = known_places(e)) {
    if (plan_.node_dofs == 3)
      add_known<3>(e, places, residual, tangent, symmetric);
    else if (plan_.node_dofs == 2)
      add_known<2>(e, places, residual, tangent, symmetric);
    else
      add_known<4>(e, places, residual, tangent, symmetric);
    return ENTS_OK;
  }
  std::int32_t status = ENTS_OK;
  if (system_->residual) status = add_residual(e, residual);
  if (system_->values && status == ENTS_OK) status = add_tangent(e, tangent);
  return status;
}

} // namespace ents
