// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/heated_element.hpp"

#include <algorithm>

#include "core/element/segment.hpp"
#include "core/numbers/scalar.hpp"

namespace ents {

namespace {

constexpr int most_nodes = 1 + HeatIngredients::most_nodes, most_dofs = HeatIngredients::most_dofs;

// The plan of the mechanics alone
Plan mechanics_of(const Plan& plan) {
  Plan mechanics = plan;
  mechanics.element = plan.unheated, mechanics.block = plan.unheated_block;
  mechanics.block_results = plan.unheated_block ? std::int32_t{want::block} : 0;
  mechanics.dofs = plan.dofs - temperatures_of(plan);
  mechanics.node_dofs = plan.dimension;
  mechanics.heat = nullptr;
  return mechanics;
}

class HeatedElement {
public:
  HeatedElement(const Plan& plan, const Plan& mechanics, const ElementInput& in)
      : plan_(plan), mechanics_(mechanics), in_(in), heat_(plan.law.heat),
        nodes_(plan.rigid ? 1 : 1 + plan.nodes), n_(mechanics.dofs) {}

  // The power that flows and its variations, at the projection xi
  Status evaluate(const double* xi, bool outside) {
    rub_ = flow_ = 0.0;
    h_ = {};
    if (outside) return Status::ok;
    if (const Status status = plan_.heat(mechanics_, in_, xi, at_); status != Status::ok) return status;
    flows_ = !at_.outside;
    if (!flows_) return Status::ok;
    h_ = conductance(heat_, at_.gap, at_.pressure, at_.contact);
    double master = 0.0;
    for (int i = 0; i < plan_.nodes; ++i) {
      master += at_.shape[i] * in_.master_temperature[i];
      for (int a = 0; a < plan_.parameters; ++a)
        slope_[a] += at_.shape_slope[a][i] * in_.master_temperature[i];
    }
    difference_ = in_.slave_temperature[0] - master;
    flow_ = at_.area * h_.value * difference_;
    per_work_ = heat_.has_friction ? heat_.share / in_.time_increment : 0.0;
    rub_ = per_work_ * at_.dissipation;
    return Status::ok;
  }

  // Powers: what leaves the slave through the gap, what friction makes
  double flow() const { return flow_; }
  double rub() const { return rub_; }

  // mechanical: [n] and [n][n] of the mechanics, dofs of the nodes and multipliers
  void write_residual(const double* mechanical, double* to) const {
    for (int i = 0; i < n_; ++i) to[place(i)] = mechanical[i];
    for (int i = 0; i < nodes_; ++i) to[temperature(i)] = weight(i) * power_of(i);
  }
  void write_tangent(const double* mechanical, double* to, std::int64_t leading) const {
    double flow_by[most_dofs], rub_by[most_dofs];
    for (int j = 0; j < n_ && flows_; ++j) {
      double along = 0.0; // dT_m by its place
      for (int a = 0; a < plan_.parameters; ++a) along += slope_[a] * at_.xi_by[a][j];
      flow_by[j] =
          at_.area * (difference_ * (h_.by_gap * at_.gap_by[j] + h_.by_pressure * at_.pressure_by[j]) -
                      h_.value * along);
      rub_by[j] = per_work_ * at_.dissipation_by[j];
    }
    for (int j = 0; j < n_; ++j) {
      double* const column = to + place(j) * leading;
      for (int i = 0; i < n_; ++i) column[place(i)] = mechanical[j * n_ + i];
      for (int i = 0; i < nodes_; ++i) {
        double& entry = column[temperature(i)];
        entry = 0.0;
        if (!flows_) continue;
        entry = weight(i) * (i == 0 ? flow_by[j] - heat_.slave * rub_by[j]
                                    : flow_by[j] + (1.0 - heat_.slave) * rub_by[j]);
        for (int a = 0; a < plan_.parameters && i > 0; ++a)
          entry -= at_.shape_slope[a][i - 1] * at_.xi_by[a][j] * power_of(i);
      }
    }
    const double conducts = flows_ ? at_.area * h_.value : 0.0;
    for (int j = 0; j < nodes_; ++j) {
      double* const column = to + temperature(j) * leading;
      for (int i = 0; i < n_; ++i) column[place(i)] = 0.0;
      for (int i = 0; i < nodes_; ++i)
        column[temperature(i)] = flows_ ? conducts * weight(i) * weight(j) : 0.0;
    }
  }

private:
  // Where a dof of the mechanics, and the temperature of a node, are in the element
  int place(int dof) const {
    const int d = plan_.dimension, displacements = d * nodes_;
    return dof < displacements ? dof / d * (d + 1) + dof % d : dof + nodes_;
  }
  int temperature(int node) const { return (plan_.dimension + 1) * node + plan_.dimension; }
  // 1 of the slave, - N_i of master node i - 1
  double weight(int node) const { return !flows_ ? 0.0 : node == 0 ? 1.0 : -at_.shape[node - 1]; }
  // The power whose part weight(node) leaves the node
  double power_of(int node) const {
    return node == 0 ? flow_ - heat_.slave * rub_ : flow_ + (1.0 - heat_.slave) * rub_;
  }

  const Plan &plan_, &mechanics_;
  const ElementInput& in_;
  const Heat& heat_;
  const int nodes_, n_; // with a temperature; dofs of the mechanics
  bool flows_ = false;
  Conductance h_;
  double difference_ = 0.0, slope_[2] = {}, flow_ = 0.0, rub_ = 0.0, per_work_ = 0.0;
  HeatIngredients at_;
};

bool all_finite(const double* numbers, std::int64_t count) {
  double zero = 0.0;
  for (std::int64_t i = 0; i < count; ++i) zero += 0.0 * numbers[i];
  return zero == 0.0; // NaN, too
}

} // namespace

Status evaluate_heated(const Plan& plan, const ElementInput& in, const ElementOutput& out) {
  const Plan mechanics = mechanics_of(plan);
  const std::int32_t heated = want::residual | want::tangent | want::heat;
  ElementOutput own = out;
  own.wanted &= ~want::heat;
  if ((out.wanted & heated) == 0) return evaluate_segment(mechanics, in, own);
  if (!all_finite(in.slave_temperature, 1) || !all_finite(in.master_temperature, plan.nodes))
    return Status::non_finite;

  const int n = mechanics.dofs, all = plan.dofs;
  double residual[most_dofs], tangent[most_dofs * most_dofs], xi[2];
  std::int32_t flags = 0;
  own.wanted |= want::xi | want::flags;
  own.residual = residual, own.tangent = tangent, own.tangent_leading_dimension = n;
  own.xi = xi, own.flags = &flags;
  if (const Status status = evaluate_segment(mechanics, in, own); status != Status::ok) return status;
  HeatedElement element(plan, mechanics, in);
  if (const Status status = element.evaluate(xi, (flags & flag::outside) != 0); status != Status::ok)
    return status;
  double r[most_dofs + most_nodes];
  if ((out.wanted & want::residual) != 0) {
    element.write_residual(residual, r);
    if (!all_finite(r, all)) return Status::out_of_range;
  }
  if ((out.wanted & want::tangent) != 0) {
    const std::int64_t leading = out.tangent_leading_dimension;
    element.write_tangent(tangent, out.tangent, leading);
    for (int j = 0; j < all; ++j)
      if (!all_finite(out.tangent + j * leading, all)) return Status::out_of_range;
  }
  if ((out.wanted & want::residual) != 0) std::copy_n(r, all, out.residual);
  if ((out.wanted & want::xi) != 0) std::copy_n(xi, plan.parameters, out.xi);
  if ((out.wanted & want::flags) != 0) *out.flags = flags;
  if ((out.wanted & want::heat) != 0) out.heat[0] = element.flow(), out.heat[1] = element.rub();
  return Status::ok;
}

} // namespace ents
