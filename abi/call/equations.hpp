// SPDX-License-Identifier: BSD-3-Clause
// The host's equations in compressed rows, to which elements are added.
#pragma once

#include <algorithm>

#include "abi/call/combination.hpp"
#include "abi/call/element_call.hpp"
#include "abi/call/rigid_body.hpp"

namespace ents {

class Equations {
public:
  static constexpr int max_nodes = 1 + 16, max_dofs = 4 * max_nodes + 3;

  Equations(const ElementCall& call, ents_report* report) : call_(call), plan_(*call.plan), report_(report) {}

  // Takes the host's struct, checked; elements first .. first + count - 1 are going to be added.
  std::int32_t open(const ents_system* caller, std::int64_t first, std::int64_t count);
  bool wants_residual() const { return system_->residual; }
  bool wants_tangent() const { return system_->values; }

  // Adds what is wanted. `symmetric`: K is, to the last bit.
  std::int32_t add(std::int64_t e, const double* residual, const double* tangent, bool symmetric) const;
  // Asks memory for the equations of an element that will be added soon.
  void fetch(std::int64_t e) const noexcept;

private:
  // Dofs of an element that stand side by side in the host: those of a node, or of the multipliers.
  struct Group {
    int dof; // first one in the element
    int size;
    const std::int64_t* equations; // [size]
    double weight;
    std::int32_t reflected = 0; // bits of the dofs that count with the opposite sign
    double weight_of(int i) const { return (reflected >> i & 1) != 0 ? -weight : weight; }
  };

  // The host's compressed rows.
  struct Pattern {
    const void *row_begin, *columns;
    std::int64_t rows;
    bool wide; // indices of 8 bytes
    std::int64_t entries = 0;

    std::int64_t begin(std::int64_t row) const {
      return wide ? static_cast<const std::int64_t*>(row_begin)[row]
                  : static_cast<const std::int32_t*>(row_begin)[row];
    }
    template <class Index> std::int64_t find(std::int64_t row, std::int64_t column) const {
      const std::int64_t from = begin(row), to = begin(row + 1);
      if (from < 0 || to < from || to > entries) return -1;
      const Index* all = static_cast<const Index*>(columns);
      const Index *first = all + from, *last = all + to;
      const Index* at = std::lower_bound(first, last, static_cast<Index>(column));
      return at != last && *at == column ? at - all : -1;
    }
    // Where (row, column) is; -1: nowhere.
    std::int64_t find(std::int64_t row, std::int64_t column) const {
      return wide ? find<std::int64_t>(row, column) : find<std::int32_t>(row, column);
    }
    std::int64_t column(std::int64_t at) const {
      return wide ? static_cast<const std::int64_t*>(columns)[at]
                  : static_cast<const std::int32_t*>(columns)[at];
    }
  };

  std::int32_t check_pattern();
  std::int32_t check_body();
  std::int64_t stamp(std::int64_t e) const noexcept;
  std::int32_t check_equations(const char* name, const std::int64_t* equations, std::int64_t nodes,
                               std::int64_t node) const;
  // Calls f(group) for the groups of one node of the element; what f returns ends it unless it is 0.
  template <class F> std::int32_t for_groups(std::int64_t e, int node, F&& f) const;
  std::int32_t add_residual(std::int64_t e, const double* residual) const;
  std::int32_t add_tangent(std::int64_t e, const double* tangent) const;
  // Tangent by the host's nodes, where many terms of the combinations name few of them; not `added`: there
  // are few terms.
  std::int32_t add_by_nodes(std::int64_t e, const double* tangent, bool& added) const;
  std::int32_t add_block(std::int64_t e, const Group& row, const Group& column, const double* tangent,
                         int leading, std::int64_t* place) const;
  std::int32_t add_with_body(std::int64_t e, const double* residual, const double* tangent) const;
  // Of a slave point with a height: `others` calls a function with every group that is not the slave's.
  template <class Others>
  std::int32_t add_raised(std::int64_t e, const double* residual, const double* tangent, int leading,
                          Others&& others) const;
  std::int32_t add_raised(std::int64_t e, const double* residual, const double* tangent) const;
  std::int32_t raise(std::int64_t e, RaisedPoint& point) const;
  const std::int64_t* known_places(std::int64_t e) const noexcept;
  template <int D>
  void add_known(std::int64_t e, const std::int64_t* places, const double* residual, const double* tangent,
                 bool symmetric) const noexcept;
  int nodes() const { return plan_.rigid ? 1 : 1 + plan_.nodes; } // with equations

  const ElementCall& call_;
  const Plan& plan_;
  ents_report* report_;
  ents_system copy_;
  const ents_system* system_;
  ents_combination slave_, master_;
  const ents_pose* pose_ = nullptr; // checked
  ents_pose pose_copy_;
  Pattern pattern_;
  bool large_; // more entries than caches hold
};

template <class F> std::int32_t Equations::for_groups(std::int64_t e, int node, F&& f) const {
  const int d = plan_.node_dofs;
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
      status = f(Group{d * node, d, equations + combination->nodes[j] * d, combination->weights[j],
                       combination->reflected ? combination->reflected[j] : 0});
    if (status != ENTS_OK) return status;
  }
  return ENTS_OK;
}

} // namespace ents
