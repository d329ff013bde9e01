// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/heated_element.hpp"

#include <algorithm>

#include "core/element/block.hpp"
#include "core/element/segment.hpp"
#include "core/numbers/scalar.hpp"

namespace ents {

namespace {

constexpr int most_nodes = 1 + HeatIngredients::most_nodes, most_dofs = HeatIngredients::most_dofs;

// The plan of the mechanics alone
Plan mechanics_of(const Plan& plan) {
  Plan mechanics = plan;
  mechanics.element = plan.unheated, mechanics.block = plan.unheated_block;
  mechanics.block_without_friction = plan.unheated_block_without_friction;
  mechanics.block_results = plan.unheated_block ? plan.block_results & ~want::heat : 0;
  mechanics.dofs = plan.dofs - temperatures_of(plan);
  mechanics.node_dofs = plan.dimension;
  mechanics.heat = nullptr;
  return mechanics;
}

// D: dimension of the space; Nodes: with a temperature, 0: any number
template <int D, int Nodes> class HeatedElement {
public:
  static constexpr int T = D - 1;
  HeatedElement(const Plan& plan, const ElementInput& in, const HeatIngredients& at)
      : plan_(plan), heat_(plan.law.heat), at_(at), n_(plan.dofs - temperatures_of(plan)),
        any_(plan.rigid ? 1 : 1 + plan.nodes) {
    if (at_.outside) return;
    h_ = conductance(heat_, at_.gap, at_.pressure, at_.contact);
    double master = 0.0;
    for (int i = 0; i < plan_.nodes; ++i) {
      master += at_.shape[i] * in.master_temperature[i];
      for (int a = 0; a < T; ++a) slope_[a] += at_.shape_slope[a][i] * in.master_temperature[i];
    }
    difference_ = in.slave_temperature[0] - master;
    flow_ = at_.area * h_.value * difference_;
    per_work_ = heat_.has_friction ? heat_.share / in.time_increment : 0.0;
    rub_ = per_work_ * at_.dissipation;
  }

  // Powers: what leaves the slave through the gap, what friction makes
  double flow() const { return flow_; }
  double rub() const { return rub_; }

  // mechanical: [n] and [n][n] of the mechanics, dofs of the nodes and multipliers. Whether their
  // numbers are in range is known; false: those of the heat are not.
  bool write_residual(const double* mechanical, double* to) const {
    double heat[most_nodes], sum = 0.0;
    for (int i = 0; i < nodes(); ++i) sum += heat[i] = at_.outside ? 0.0 : weight(i) * power_of(i);
    write_column(mechanical, heat, to);
    return 0.0 * sum == 0.0;
  }
  bool write_tangent(const double* mechanical, double* to, std::int64_t leading) const {
    if (at_.outside) { // nothing flows
      for (int j = 0; j < n_; ++j)
        write_column(mechanical + std::int64_t{j} * n_, none, to + place(j) * leading);
      for (int j = 0; j < nodes(); ++j) write_column(none, none, to + temperature(j) * leading);
      return true;
    }
    // of each node, so that no sum waits for another
    double weights[most_nodes], slopes[T][most_nodes], heat[most_nodes], sums[most_nodes] = {};
    for (int i = 0; i < nodes(); ++i) {
      weights[i] = weight(i);
      for (int a = 0; a < T; ++a) slopes[a][i] = i == 0 ? 0.0 : at_.shape_slope[a][i - 1];
    }
    const double power = power_of(1), conducts = at_.area * h_.value, to_master = 1.0 - heat_.slave,
                 of_gap = at_.area * difference_ * h_.by_gap,
                 of_pressure = at_.area * difference_ * h_.by_pressure;
    for (int j = 0; j < n_; ++j) {
      double along = 0.0, xi_by[T]; // dT_m by its place
      for (int a = 0; a < T; ++a) along += slope_[a] * (xi_by[a] = at_.xi_by[a][j]);
      const double flow = of_gap * at_.gap_by[j] + of_pressure * at_.pressure_by[j] - conducts * along,
                   rub = per_work_ * at_.dissipation_by[j];
      const double by_master = flow + to_master * rub; // of the power that enters it
      for (int i = 0; i < nodes(); ++i) {
        double entry = weights[i] * by_master;
        for (int a = 0; a < T; ++a) entry -= slopes[a][i] * xi_by[a] * power;
        heat[i] = entry;
      }
      heat[0] = flow - heat_.slave * rub;
      for (int i = 0; i < nodes(); ++i) sums[i] += heat[i];
      write_column(mechanical + std::int64_t{j} * n_, heat, to + place(j) * leading);
    }
    for (int j = 0; j < nodes(); ++j) {
      for (int i = 0; i < nodes(); ++i) sums[i] += heat[i] = conducts * weights[i] * weights[j];
      write_column(none, heat, to + temperature(j) * leading);
    }
    double sum = 0.0;
    for (int i = 0; i < nodes(); ++i) sum += sums[i];
    return 0.0 * sum == 0.0;
  }

private:
  int nodes() const { return Nodes > 0 ? Nodes : any_; }
  // 1 of the slave, - N_i of master node i - 1
  double weight(int node) const { return node == 0 ? 1.0 : -at_.shape[node - 1]; }
  // The power whose part weight(node) leaves the node
  double power_of(int node) const {
    return node == 0 ? flow_ - heat_.slave * rub_ : flow_ + (1.0 - heat_.slave) * rub_;
  }
  // Of a dof of the mechanics, of a node's temperature: its dof in the element
  int place(int j) const { return j < D * nodes() ? j + j / D : j + nodes(); }
  static int temperature(int node) { return (D + 1) * node + D; }
  // Numbers of the mechanics, and of each temperature
  void write_column(const double* mechanical, const double* heat, double* to) const {
    for (int i = 0; i < nodes(); ++i, mechanical += D, to += D + 1) {
      double of_node[D + 1]; // in registers
      for (int c = 0; c < D; ++c) of_node[c] = mechanical[c];
      of_node[D] = heat[i];
      for (int c = 0; c <= D; ++c) to[c] = of_node[c];
    }
    for (int i = D * nodes(); i < n_; ++i) *to++ = *mechanical++;
  }

  static constexpr double none[most_dofs] = {};
  const Plan& plan_;
  const Heat& heat_;
  const HeatIngredients& at_;
  const int n_, any_; // dofs of the mechanics; nodes
  Conductance h_;
  double difference_ = 0.0, slope_[2] = {}, flow_ = 0.0, rub_ = 0.0, per_work_ = 0.0;
};

// use(element) of the kind that the plan has
template <int D, class Use>
auto with_heated(const Plan& plan, const ElementInput& in, const HeatIngredients& at, Use&& use) {
  switch (plan.rigid ? 1 : 1 + plan.nodes) {
  case 1:
    return use(HeatedElement<D, 1>(plan, in, at));
  case D + 1:
    return use(HeatedElement<D, D + 1>(plan, in, at));
  case 5:
    return use(HeatedElement<D, 5>(plan, in, at));
  default:
    return use(HeatedElement<D, 0>(plan, in, at));
  }
}

// The results that are wanted, from those of the mechanics. False: they leave the range of numbers.
template <int D>
bool write(const Plan& plan, const ElementInput& in, const HeatIngredients& at, const double* residual,
           const double* tangent, const ElementOutput& out) {
  return with_heated<D>(plan, in, at, [&](const auto& element) {
    double r[most_dofs + most_nodes];
    const bool wants_r = (out.wanted & want::residual) != 0;
    if ((wants_r && !element.write_residual(residual, r)) ||
        ((out.wanted & want::tangent) != 0 &&
         !element.write_tangent(tangent, out.tangent, out.tangent_leading_dimension)))
      return false;
    if (wants_r) std::copy_n(r, plan.dofs, out.residual);
    if ((out.wanted & want::heat) != 0) out.heat[0] = element.flow(), out.heat[1] = element.rub();
    return true;
  });
}

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
  HeatIngredients at;
  at.outside = (flags & flag::outside) != 0;
  if (!at.outside)
    if (const Status status = plan.heat(mechanics, in, xi, at); status != Status::ok) return status;
  if (!write<D>(plan, in, at, residual, tangent, out)) return Status::out_of_range;
  if ((out.wanted & want::xi) != 0) std::copy_n(xi, plan.parameters, out.xi);
  if ((out.wanted & want::flags) != 0) *out.flags = flags;
  return Status::ok;
}

// As many elements at a time as fit into the nearest cache, in whole registers
constexpr std::int32_t most_together = 8, room = 4 * most_dofs * most_dofs;

template <int D>
std::uint64_t evaluate_block_in(const Plan& plan, const ElementBlock& block, std::int32_t count) {
  const Plan mechanics = mechanics_of(plan);
  const std::int32_t heated = want::residual | want::tangent | want::heat;
  ElementBlock own = block;
  own.wanted &= ~(want::heat | forces_only); // an open gap may conduct
  if ((block.wanted & heated) == 0) return evaluate_block(mechanics, own, count);
  const std::int32_t n = mechanics.dofs, together = std::clamp(room / (n * n), 1, most_together);
  double residual[most_together * most_dofs], tangent[room], xi[2 * most_together];
  HeatIngredients at[most_together];
  std::uint64_t done = 0;
  for (std::int32_t k = 0; k < count; k += together) {
    const std::int32_t size = std::min(together, count - k);
    ElementBlock here = block;
    here.first += k;
    begin_at_first(here);
    own = here;
    own.wanted = (here.wanted & ~(want::heat | forces_only)) | want::xi;
    own.residual = residual, own.residual_stride = n;
    own.tangent = tangent, own.tangent_stride = std::int64_t{n} * n, own.leading = n;
    if ((here.wanted & want::xi) == 0) own.xi = xi, own.xi_stride = plan.parameters;
    std::uint64_t fine = evaluate_block(mechanics, own, size);
    own.start = own.xi, own.start_stride = own.xi_stride, own.start_first = true;
    fine &= plan.heat_block(mechanics, own, size, at);
    ElementInput in{};
    in.time_increment = block.time_increment;
    ElementOutput out{};
    out.wanted = block.wanted & heated;
    out.tangent_leading_dimension = block.leading;
    for (std::int32_t i = 0; i < size; ++i) {
      if ((fine >> i & 1) == 0) continue;
      in.slave_temperature = here.slave_temperature + i * here.slave_temperature_stride;
      in.master_temperature = here.master_temperature + i * here.master_temperature_stride;
      if ((out.wanted & want::residual) != 0) out.residual = here.residual + i * here.residual_stride;
      if ((out.wanted & want::tangent) != 0) out.tangent = here.tangent + i * here.tangent_stride;
      if ((out.wanted & want::heat) != 0) out.heat = here.heat + i * here.heat_stride;
      if (all_finite(in.slave_temperature, 1) && all_finite(in.master_temperature, plan.nodes) &&
          write<D>(plan, in, at[i], residual + std::int64_t{i} * n, tangent + std::int64_t{i} * n * n, out))
        done |= std::uint64_t{1} << (k + i);
    }
  }
  return done;
}

} // namespace

Status evaluate_heated(const Plan& plan, const ElementInput& in, const ElementOutput& out) {
  return plan.dimension == 2 ? evaluate_in<2>(plan, in, out) : evaluate_in<3>(plan, in, out);
}

std::uint64_t evaluate_heated_block(const Plan& plan, const ElementBlock& block, std::int32_t count) {
  return plan.dimension == 2 ? evaluate_block_in<2>(plan, block, count)
                             : evaluate_block_in<3>(plan, block, count);
}

} // namespace ents
