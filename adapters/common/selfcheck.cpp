// SPDX-License-Identifier: BSD-3-Clause
#include "selfcheck.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "limits.hpp"

namespace ents_adapter {
namespace {

/// Distance of the first two master nodes.
double segment_length(const ents_layout& layout, const double* master) {
  double squared = 0;
  for (int i = 0; i < layout.dimension; ++i)
    squared += (master[layout.dimension + i] - master[i]) * (master[layout.dimension + i] - master[i]);
  return std::sqrt(squared);
}

} // namespace

bool selfcheck(const ents_model* model, const ents_layout& layout, const ents_input& input, double* unknowns,
               double* temperatures, const double* tangent, char* text, std::size_t size) {
  constexpr double steps[3] = {1e-4, 1e-5, 1e-6};
  const int dofs = layout.dofs, of_nodes = dofs - layout.multipliers, d = layout.dimension,
            n = layout.node_dofs, all_nodes = d * (layout.nodes + 1);
  const auto is_temperature = [&](int i) { return i < of_nodes && i % n >= d; };
  const auto unknown_of = [&](int i) {
    return i >= of_nodes ? unknowns + all_nodes + i - of_nodes
           : i % n < d   ? unknowns + d * (i / n) + i % n
                         : temperatures + i / n;
  };
  const double length = segment_length(layout, unknowns + layout.dimension);
  double largest[2][2] = {}, errors[3] = {}; // forces and powers have units of their own
  const auto scale = [&](int row, int column) -> double& {
    return largest[is_temperature(row)][is_temperature(column)];
  };
  for (int i = 0; i < dofs * dofs; ++i)
    scale(i % dofs, i / dofs) = std::max(scale(i % dofs, i / dofs), std::abs(tangent[i]));

  double residual[2][largest_dofs];
  ents_output output{};
  output.struct_size = sizeof output;
  output.wanted = ENTS_RESIDUAL;
  for (int s = 0; s < 3; ++s)
    for (int column = 0; column < dofs; ++column) {
      double& unknown = *unknown_of(column);
      const double there = unknown;
      const bool is_place = column < of_nodes && !is_temperature(column);
      const double step = steps[s] * (is_place ? length : std::max(1.0, std::abs(there)));
      int32_t status = ENTS_OK;
      double ends[2];
      for (int side = 0; side < 2; ++side) {
        ends[side] = unknown = there + (side ? step : -step);
        output.residual = residual[side];
        status = std::max(status, std::abs(ents_evaluate(model, 0, 1, &input, &output, nullptr)));
      }
      unknown = there;
      if (status != ENTS_OK) {
        errors[s] = HUGE_VAL;
        break;
      }
      for (int row = 0; row < dofs; ++row) {
        const double slope = (residual[1][row] - residual[0][row]) / (ends[1] - ends[0]);
        if (const double error = std::abs(tangent[row + dofs * column] - slope); error > 0)
          errors[s] = std::max(errors[s], error / scale(row, column));
      }
    }
  const bool good = std::min({errors[0], errors[1], errors[2]}) <= 1e-5;
  std::snprintf(text, size,
                "selfcheck: |K - dR/du| / |K| = %.1e, %.1e, %.1e for steps of 1e-4, 1e-5, 1e-6 segments: %s",
                errors[0], errors[1], errors[2],
                good ? "K is the slope of R"
                     : "K is NOT the slope of R (an approximate or symmetrised \"tangent\" in the model, or "
                       "contact about to change?)");
  return good;
}

void say_open(bool projected, double gap, const double* normal, char* text, std::size_t size) {
  if (projected)
    std::snprintf(
        text, size,
        "selfcheck: open, gap %.3e, the segment's normal is (%.3f, %.3f, %.3f). If the bodies overlap "
        "here, the normal points into the master: turn the order of the segment's nodes round",
        gap, normal[0], normal[1], normal[2]);
  else
    std::snprintf(text, size, "selfcheck: open, the slave node is not ahead of this segment");
}

} // namespace ents_adapter
