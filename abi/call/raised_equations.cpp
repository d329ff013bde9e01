// SPDX-License-Identifier: BSD-3-Clause
// Elements of slave points that have a height: forces and tangent on the nodes of their facets, which are no linear
// combinations of them (theory.md, section 11.4):
//   R_i = J_i^T R_s,  K_ij = J_i^T K_ss J_j + R_s . d2x / dx_i dx_j,  K_im = J_i^T K_sm,  K_mj = K_ms J_j
// with J_i = dx / dx_i, s the point, m every other dof.
#include <cmath>

#include "abi/call/equations.hpp"

namespace ents {

std::int32_t raise_point(const ents_combination& c, const char* name, std::int64_t point, int dimension,
                         const double* positions, RaisedPoint& raised, ents_report* report) noexcept {
  const std::int64_t first = c.begin[point], count = c.begin[point + 1] - first;
  const long long i = point;
  if (count < 2 || count > most_facet_nodes)
    return report_message(report, ENTS_BAD_VALUE, point,
                          "%s: point %lld has a height and %lld nodes; those of a facet are 2 .. %d", name, i,
                          static_cast<long long>(count), most_facet_nodes);
  switch (raised.set(dimension, count, c.nodes + first, c.weights + first, c.slopes + first * (dimension - 1),
                     c.heights[point], positions)) {
  case Status::ok:
    return ENTS_OK;
  case Status::degenerate_segment:
    return report_message(report, ENTS_DEGENERATE_SEGMENT, point,
                          "%s: the facet of point %lld has no normal to raise it along", name, i);
  default:
    return report_message(
        report, ENTS_NON_FINITE, point,
        "%s: the height of point %lld, a slope of its, or the position of a node of its facet is NaN "
        "or infinite",
        name, i);
  }
}

std::int32_t Equations::raise(std::int64_t e, RaisedPoint& point) const {
  std::int32_t status = check_combined_point(slave_, "system.slave", e, system_->slave_nodes, report_);
  if (status != ENTS_OK) return status;
  for (std::int64_t j = slave_.begin[e]; j < slave_.begin[e + 1]; ++j)
    if ((status = check_equations("slave_equations", system_->slave_equations, system_->slave_nodes,
                                  slave_.nodes[j])) != ENTS_OK)
      return status;
  const int d = plan_.dimension;
  if ((status = raise_point(slave_, "system.slave", e, d, system_->slave_positions, point, report_)) !=
      ENTS_OK)
    return status;
  if (system_->pose) return ENTS_OK; // input.slave is in the body's frame
  const double* slave = at(call_.in->slave, call_.in->slave_stride, e);
  double off = 0.0, size = 0.0;
  for (int c = 0; c < d; ++c) {
    const double shift = slave_.shifts ? slave_.shifts[e * d + c] : 0.0;
    off = std::fmax(off, std::fabs(point.place[c] + shift - slave[c]));
    size = std::fmax(size, std::fabs(slave[c]) + std::fabs(shift) + std::fabs(point.height));
  }
  if (off <= 1e-9 * size) return ENTS_OK;
  return report_message(
      report_, ENTS_BAD_VALUE, e,
      "input.slave of element %lld is %g away from where system.slave_positions and the height put it: "
      "make it of these positions by ents_combine",
      static_cast<long long>(e), off);
}

template <class Others>
std::int32_t Equations::add_raised(std::int64_t e, const double* residual, const double* tangent, int leading,
                                   Others&& others) const {
  RaisedPoint point;
  std::int32_t status = raise(e, point);
  if (status != ENTS_OK) return status;
  const int d = plan_.dimension, own = plan_.node_dofs, count = point.count;
  double J[most_facet_nodes][4][4] = {}; // of a temperature, too
  Group groups[most_facet_nodes];
  for (int i = 0; i < count; ++i) {
    double of_place[3][3];
    point.derivative(i, of_place);
    for (int a = 0; a < d; ++a) std::copy_n(of_place[a], d, J[i][a]);
    if (own > d) J[i][d][d] = point.weights[i];
    groups[i] = {0, own, system_->slave_equations + slave_.nodes[slave_.begin[e] + i] * own, 1.0};
  }
  if (system_->residual) {
    const auto add = [&](const Group& group, const double* r) {
      for (int i = 0; i < group.size; ++i)
        if (group.equations[i] >= 0)
          system_->residual[group.equations[i]] += group.weight_of(i) * r[group.dof + i];
    };
    for (int i = 0; i < count; ++i) {
      double r[4] = {};
      for (int b = 0; b < own; ++b)
        for (int a = 0; a < own; ++a) r[b] += J[i][a][b] * residual[a];
      add(groups[i], r);
    }
    status = others([&](const Group& group) -> std::int32_t { return add(group, residual), ENTS_OK; });
  }
  if (!system_->values || status != ENTS_OK) return status;

  double columns[4 * max_dofs], rows[4 * max_dofs],
      block[16]; // K_.s J_j [leading][own]; J_i^T K_s. [own][leading]
  for (int i = 0; i < count; ++i) {
    for (int c = 0; c < leading; ++c)
      for (int b = 0; b < own; ++b) {
        rows[b + own * c] = columns[c + leading * b] = 0.0;
        for (int a = 0; a < own; ++a) {
          rows[b + own * c] += J[i][a][b] * tangent[a + c * leading];
          columns[c + leading * b] += tangent[c + a * leading] * J[i][a][b];
        }
      }
    for (int j = 0; j < count; ++j) {
      double G[3][3] = {};
      point.second_derivative(i, j, residual, G);
      for (int c = 0; c < own; ++c)
        for (int b = 0; b < own; ++b) {
          double& entry = block[b + own * c] = b < d && c < d ? G[b][c] : 0.0;
          for (int a = 0; a < own; ++a) entry += rows[b + own * a] * J[j][a][c];
        }
      if ((status = add_block(e, groups[i], groups[j], block, own, nullptr)) != ENTS_OK) return status;
    }
    status = others([&](const Group& group) {
      const std::int32_t outcome = add_block(e, groups[i], group, rows, own, nullptr);
      return outcome == ENTS_OK ? add_block(e, group, groups[i], columns, leading, nullptr) : outcome;
    });
    if (status != ENTS_OK) return status;
  }
  return others([&](const Group& row) {
    return others([&](const Group& column) { return add_block(e, row, column, tangent, leading, nullptr); });
  });
}

std::int32_t Equations::add_raised(std::int64_t e, const double* residual, const double* tangent) const {
  const int d = plan_.dimension;
  if (system_->pose) {
    const int body = body_dofs(d);
    double r[largest_body_element], t[largest_body_element * largest_body_element];
    add_body(d, pose_->turn, at(call_.in->slave, call_.in->slave_stride, e), residual,
             system_->values ? tangent : nullptr, r, t);
    const Group of_body{d, body, system_->body_equations, 1.0};
    return add_raised(e, r, t, d + body, [&](auto&& f) -> std::int32_t { return f(of_body); });
  }
  const Group multipliers{
      plan_.dofs - plan_.multipliers, plan_.multipliers,
      plan_.multipliers > 0 ? system_->multiplier_equations + e * plan_.multipliers : nullptr, 1.0};
  return add_raised(e, residual, tangent, plan_.dofs, [&](auto&& f) -> std::int32_t {
    for (int node = 1; node < nodes(); ++node)
      if (const std::int32_t status = for_groups(e, node, f); status != ENTS_OK) return status;
    return plan_.multipliers > 0 ? f(multipliers) : ENTS_OK;
  });
}

} // namespace ents
