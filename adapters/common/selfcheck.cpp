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
               const double* tangent, char* text, std::size_t size) {
  constexpr double steps[3] = {1e-4, 1e-5, 1e-6};
  const int dofs = layout.dofs, of_nodes = dofs - layout.multipliers,
            all_nodes = layout.dimension * (layout.nodes + 1);
  const double length = segment_length(layout, unknowns + layout.dimension);
  double largest = 0, errors[3] = {};
  for (int i = 0; i < dofs * dofs; ++i) largest = std::max(largest, std::abs(tangent[i]));

  double residual[2][largest_dofs];
  ents_output output{};
  output.struct_size = sizeof output;
  output.wanted = ENTS_RESIDUAL;
  for (int s = 0; s < 3; ++s)
    for (int column = 0; column < dofs; ++column) {
      double& unknown = unknowns[column < of_nodes ? column : all_nodes + column - of_nodes];
      const double there = unknown;
      const double step = steps[s] * (column < of_nodes ? length : std::max(1.0, std::abs(there)));
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
        errors[s] = std::max(errors[s], std::abs(tangent[row + dofs * column] - slope) / largest);
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
