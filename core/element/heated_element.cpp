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

// D: dimension of the space
template <int D> class HeatedElement {
public:
  static constexpr int T = D - 1;
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
      for (int a = 0; a < T; ++a) slope_[a] += at_.shape_slope[a][i] * in_.master_temperature[i];
    }
    weight_[0] = 1.0;
    for (int i = 1; i < nodes_; ++i) weight_[i] = -at_.shape[i - 1];
    difference_ = in_.slave_temperature[0] - master;
    flow_ = at_.area * h_.value * difference_;
    per_work_ = heat_.has_friction ? heat_.share / in_.time_increment : 0.0;
    rub_ = per_work_ * at_.dissipation;
    return Status::ok;
  }

  // Powers: what leaves the slave through the gap, what friction makes
  double flow() const { return flow_; }
  double rub() const { return rub_; }

  // mechanical: [n] and [n][n] of the mechanics, dofs of the nodes and multipliers. Whether their numbers are in
  // range is known; false: those of the heat are not.
  bool write_residual(const double* mechanical, double* to) const {
    spread(mechanical, to);
    double sum = 0.0;
    for (int i = 0; i < nodes_; ++i) sum += to[temperature(i)] = weight_[i] * power_of(i);
    return 0.0 * sum == 0.0;
  }
  bool write_tangent(const double* mechanical, double* to, std::int64_t leading) const {
    const double conducts = at_.area * h_.value;
    double sum = 0.0, by_slave[most_dofs],
           by_master[most_dofs]; // of the power that leaves the slave, that enters the master
    set_variations(by_slave, by_master);
    double* column = to;
    for (int j = 0, left = D; j < n_; ++j, column += leading) {
      if (j < displacements() && left-- == 0) column += leading, left = D - 1; // past a temperature
      if (j == displacements()) column = to + (j + nodes_) * leading;
      spread(mechanical + std::int64_t{j} * n_, column);
      sum += column[temperature(0)] = by_slave[j];
      for (int i = 1; i < nodes_; ++i) {
        double entry = weight_[i] * by_master[j];
        for (int a = 0; a < T; ++a) entry -= at_.shape_slope[a][i - 1] * at_.xi_by[a][j] * power_of(1);
        sum += column[temperature(i)] = entry;
      }
    }
    for (int j = 0; j < nodes_; ++j) {
      column = to + temperature(j) * leading;
      std::fill_n(column, plan_.dofs, 0.0);
      for (int i = 0; i < nodes_; ++i) sum += column[temperature(i)] = conducts * weight_[i] * weight_[j];
    }
    return 0.0 * sum == 0.0;
  }
  // Nothing flows
  void write_cold(const double* residual, const double* tangent, double* r, double* k,
                  std::int64_t leading) const {
    double column[most_dofs + most_nodes] = {};
    if (r) std::fill_n(r, plan_.dofs, 0.0), spread(residual, r);
    for (int j = 0, at = 0; k && j < plan_.dofs; ++j) {
      const bool warm = j < displacements() + nodes_ && j % (D + 1) == D;
      std::fill_n(column, plan_.dofs, 0.0);
      if (!warm) spread(tangent + std::int64_t{n_} * at++, column);
      std::copy_n(column, plan_.dofs, k + j * leading);
    }
  }
  bool flows() const { return flows_; }

private:
  int displacements() const { return D * nodes_; }
  int temperature(int node) const { return (D + 1) * node + D; }
  // Numbers of the mechanics to their places in the element
  void spread(const double* mechanical, double* to) const {
    for (int i = 0; i < nodes_; ++i, mechanical += D, to += D + 1)
      for (int c = 0; c < D; ++c) to[c] = mechanical[c];
    for (int i = displacements(); i < n_; ++i) *to++ = *mechanical++;
  }
  // The power whose part weight_[node] leaves the node
  double power_of(int node) const {
    return node == 0 ? flow_ - heat_.slave * rub_ : flow_ + (1.0 - heat_.slave) * rub_;
  }
  void set_variations(double* by_slave, double* by_master) const {
    const double of_gap = at_.area * difference_ * h_.by_gap,
                 of_pressure = at_.area * difference_ * h_.by_pressure;
    for (int j = 0; j < n_; ++j) {
      double along = 0.0; // dT_m by its place
      for (int a = 0; a < T; ++a) along += slope_[a] * at_.xi_by[a][j];
      const double flow =
          of_gap * at_.gap_by[j] + of_pressure * at_.pressure_by[j] - at_.area * h_.value * along;
      const double rub = per_work_ * at_.dissipation_by[j];
      by_slave[j] = flow - heat_.slave * rub, by_master[j] = flow + (1.0 - heat_.slave) * rub;
    }
  }

  const Plan &plan_, &mechanics_;
  const ElementInput& in_;
  const Heat& heat_;
  const int nodes_, n_; // with a temperature; dofs of the mechanics
  bool flows_ = false;
  Conductance h_;
  double weight_[most_nodes]; // 1 of the slave, - N_i of master node i - 1
  double difference_ = 0.0, slope_[2] = {}, flow_ = 0.0, rub_ = 0.0, per_work_ = 0.0;
  HeatIngredients at_;
};

bool all_finite(const double* numbers, std::int64_t count) {
  double zero = 0.0;
  for (std::int64_t i = 0; i < count; ++i) zero += 0.0 * numbers[i];
  return zero == 0.0; // NaN, too
}

template <int D> Status evaluate_in(const Plan& plan, const ElementInput& in, const ElementOutput& out) {
  const Plan mechanics = mechanics_of(plan);
  const std::int32_t heated = want::residual | want::tangent | want::heat;
  ElementOutput own = out;
  own.wanted &= ~want::heat;
  if ((out.wanted & heated) == 0) return evaluate_segment(mechanics, in, own);
  if (!all_finite(in.slave_temperature, 1) || !all_finite(in.master_temperature, plan.nodes))
    return Status::non_finite;

  const int n = mechanics.dofs;
  double residual[most_dofs], tangent[most_dofs * most_dofs], xi[2];
  std::int32_t flags = 0;
  own.wanted |= want::xi | want::flags;
  own.residual = residual, own.tangent = tangent, own.tangent_leading_dimension = n;
  own.xi = xi, own.flags = &flags;
  if (const Status status = evaluate_segment(mechanics, in, own); status != Status::ok) return status;
  HeatedElement<D> element(plan, mechanics, in);
  if (const Status status = element.evaluate(xi, (flags & flag::outside) != 0); status != Status::ok)
    return status;
  double r[most_dofs + most_nodes];
  const bool wants_r = (out.wanted & want::residual) != 0, wants_k = (out.wanted & want::tangent) != 0;
  const std::int64_t leading = out.tangent_leading_dimension;
  if (!element.flows())
    element.write_cold(residual, tangent, wants_r ? r : nullptr, wants_k ? out.tangent : nullptr, leading);
  else if ((wants_r && !element.write_residual(residual, r)) ||
           (wants_k && !element.write_tangent(tangent, out.tangent, leading)))
    return Status::out_of_range;
  if (wants_r) std::copy_n(r, plan.dofs, out.residual);
  if ((out.wanted & want::xi) != 0) std::copy_n(xi, plan.parameters, out.xi);
  if ((out.wanted & want::flags) != 0) *out.flags = flags;
  if ((out.wanted & want::heat) != 0) out.heat[0] = element.flow(), out.heat[1] = element.rub();
  return Status::ok;
}

} // namespace

Status evaluate_heated(const Plan& plan, const ElementInput& in, const ElementOutput& out) {
  return plan.dimension == 2 ? evaluate_in<2>(plan, in, out) : evaluate_in<3>(plan, in, out);
}

} // namespace ents
