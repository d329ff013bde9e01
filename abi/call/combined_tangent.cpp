// SPDX-License-Identifier: BSD-3-Clause
// Tangent over points that share their nodes. A control point of quasi-interpolation has 9 nodes in 3D, the
// 16 of a segment have 36: 37^2 blocks are added to the host's rows instead of (16 x 9 + 1)^2.
#include "abi/call/equations.hpp"

namespace ents {

std::int32_t Equations::add_by_nodes(std::int64_t e, const double* tangent, bool& added) const {
  constexpr int most = 48; // more: one by one
  const int d = plan_.node_dofs, count = nodes(), leading = plan_.dofs;
  const std::int64_t* equations[most];
  double weights[max_nodes][most][4];
  int found = 0, terms = 0;
  bool fits = true;
  for (int a = 0; a < count; ++a) {
    const std::int32_t status = for_groups(e, a, [&](const Group& group) -> std::int32_t {
      ++terms;
      int n = 0;
      while (n < found && equations[n] != group.equations) ++n;
      if (n == most) {
        fits = false;
        return ENTS_OK;
      }
      if (n == found) {
        equations[found++] = group.equations;
        for (int b = 0; b < count; ++b) std::fill_n(weights[b][n], 4, 0.0);
      }
      for (int i = 0; i < d; ++i) weights[a][n][i] += group.weight_of(i);
      return ENTS_OK;
    });
    if (status != ENTS_OK) return status;
  }
  added = fits && terms > 2 * count;
  if (!added) return ENTS_OK;
  for (int n = 0; n < found; ++n) {
    double column[4][max_dofs]; // of the element's dofs, by the dofs of node n
    for (int j = 0; j < d; ++j) {
      std::fill_n(column[j], leading, 0.0);
      for (int a = 0; a < count; ++a)
        if (const double w = weights[a][n][j]; w != 0.0)
          for (int i = 0; i < leading; ++i) column[j][i] += w * tangent[(d * a + j) * leading + i];
    }
    for (int m = 0; m < found; ++m) {
      double block[16] = {};
      for (int a = 0; a < count; ++a)
        for (int i = 0; i < d; ++i)
          for (int j = 0; j < d; ++j) block[d * j + i] += weights[a][m][i] * column[j][d * a + i];
      const std::int32_t status =
          add_block(e, {0, d, equations[m], 1.0}, {0, d, equations[n], 1.0}, block, d, nullptr);
      if (status != ENTS_OK) return status;
    }
  }
  return ENTS_OK;
}

} // namespace ents
