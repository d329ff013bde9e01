// SPDX-License-Identifier: BSD-3-Clause
#include "core/admissibility/facets.hpp"

#include <algorithm>
#include <cmath>

namespace ents {

void Facets::xi_of(int i, int j, double (&xi)[2]) const {
  const double u = i / (n - 1.0), v = j / (n - 1.0);
  xi[0] = simplex_ ? u : 2.0 * u - 1.0;
  xi[1] = simplex_ ? v : surface_ ? 2.0 * v - 1.0 : 0.0;
}

int Facets::pieces(const Cell& c, Piece (&out)[2]) const {
  const auto known_at = [&](int i, int j) {
    return known[static_cast<std::size_t>(sample(c.segment, i, j))] != 0;
  };
  int count = 0;
  const int i = c.i, j = c.j;
  if (!surface_) {
    if (known_at(i, 0) && known_at(i + 1, 0)) out[count++] = {{{i, 0}, {i + 1, 0}, {0, 0}}};
    return count;
  }
  if (simplex_ && i + j > n - 2) return 0;
  if (!known_at(i + 1, j) || !known_at(i, j + 1)) return 0;
  if (known_at(i, j)) out[count++] = {{{i, j}, {i + 1, j}, {i, j + 1}}};
  if ((!simplex_ || i + j < n - 2) && known_at(i + 1, j + 1))
    out[count++] = {{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
  return count;
}

Facets::Facets(const SurfaceChecker& c, int wanted)
    : surface_(c.plan.parameters == 2), simplex_(c.plan.simplex) {
  const std::int64_t segments = c.mesh.segments;
  const double each = 262144.0 / static_cast<double>(std::max<std::int64_t>(segments, 1));
  n = std::clamp(static_cast<int>(surface_ ? std::sqrt(each) : each), 2, std::max(wanted, 2));
  per_segment = !surface_ ? n : simplex_ ? std::int64_t{n} * (n + 1) / 2 : std::int64_t{n} * n;
  const auto all = static_cast<std::size_t>(segments * per_segment);
  points.assign(all, Eigen::Vector3d::Zero()), normals.assign(all, Eigen::Vector3d::Zero()),
      known.assign(all, 0);
  for (std::int64_t s = 0; s < segments; ++s) {
    SegmentNodes nodes;
    if (gather(c.plan, c.mesh, s, nodes) != Status::ok) continue;
    for (int j = 0; j < (surface_ ? n : 1); ++j)
      for (int i = 0; i < (simplex_ ? n - j : n); ++i) {
        double xi[2];
        xi_of(i, j, xi);
        Place place;
        if (!place_at(c.plan, nodes, xi, place)) continue;
        const auto k = static_cast<std::size_t>(sample(s, i, j));
        points[k] = place.rho_e, normals[k] = place.n_e, known[k] = 1;
      }
  }
  std::vector<std::int64_t> cells;
  std::vector<Tree::Volume> boxes;
  const std::int64_t cells_each = surface_ ? std::int64_t{n - 1} * (n - 1) : n - 1;
  for (std::int64_t index = 0; index < segments * cells_each; ++index) {
    Piece out[2];
    const Cell where = cell(index);
    const int count = pieces(where, out);
    Tree::Volume box;
    for (int p = 0; p < count; ++p)
      for (int k = 0; k < corners(); ++k) box.extend(point(where, out[p].corner[k]));
    if (count > 0) cells.push_back(index), boxes.push_back(box);
  }
  tree.init(cells.begin(), cells.end(), boxes.begin(), boxes.end());
}

} // namespace ents
