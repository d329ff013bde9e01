// SPDX-License-Identifier: BSD-3-Clause
#include "core/quad_mesh.hpp"

#include <algorithm>
#include <tuple>

namespace ents {

Refusal QuadMesh::build(Ends ends, std::int64_t facets, const std::int64_t* connectivity,
                        std::int64_t nodes) {
  facets_ = facets, nodes_ = nodes;
  corners_.assign(connectivity, connectivity + 4 * facets);
  for (std::int64_t f = 0; f < facets; ++f)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < a; ++b)
        if (node(f, a) == node(f, b)) return {Refusal::repeated_node, f, -1, node(f, a)};
  Refusal refusal = pair();
  if (refusal.reason == Refusal::none) refusal = extend(ends);
  if (refusal.reason == Refusal::none) refusal = pair();
  incident_.assign(index(nodes_) + laid_around_.size(), 0);
  for (const std::int64_t corner : corners_) ++incident_[index(corner)];
  return refusal;
}

// Finds the two half-edges of every edge.
Refusal QuadMesh::pair() {
  struct Edge {
    std::int64_t low, high, half;
  };
  std::vector<Edge> edges;
  edges.reserve(corners_.size());
  for (std::int64_t h = 0; h < static_cast<std::int64_t>(corners_.size()); ++h)
    edges.push_back({std::min(start(h), end(h)), std::max(start(h), end(h)), h});
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.half) < std::tie(b.low, b.high, b.half);
  });
  twin_.assign(corners_.size(), -1);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t last = i + 1;
    while (last < edges.size() && edges[last].low == edges[i].low && edges[last].high == edges[i].high)
      ++last;
    const std::int64_t a = edges[i].half;
    if (last - i > 1) {
      const std::int64_t b = edges[i + 1].half;
      if (last - i > 2) return {Refusal::branch, edges[i + 2].half / 4, a / 4, edges[i].low, edges[i].high};
      if (start(a) == start(b)) return {Refusal::opposed, b / 4, a / 4, edges[i].low, edges[i].high};
      twin_[index(a)] = b, twin_[index(b)] = a;
    }
    i = last;
  }
  return {};
}

std::int64_t QuadMesh::lay(Terms terms) {
  collect(terms);
  laid_around_.push_back(std::move(terms));
  return nodes_ + static_cast<std::int64_t>(laid_around_.size()) - 1;
}

// One facet beyond every edge of the border, one more beyond every corner (a node of one facet only). A node
// x_0 of the border with inner neighbours has 2 x_0 - (their mean) beyond it; a corner x_00 has 2 x_00 -
// x_10, 2 x_00 - x_01 and, the same in both directions, 4 x_00 - 2 x_10 - 2 x_01 + x_11.
Refusal QuadMesh::extend(Ends ends) {
  std::vector<std::int64_t> in(index(nodes_), -1), out(index(nodes_), -1); // half-edges of the border
  std::vector<std::int64_t> border;
  for (std::int64_t h = 0; h < 4 * facets_; ++h) {
    if (twin_[index(h)] >= 0) continue;
    border.push_back(h);
    std::int64_t& leaving = out[index(start(h))];
    if (leaving >= 0) return {Refusal::touching, h / 4, leaving / 4, start(h)};
    leaving = h;
    in[index(end(h))] = h;
  }
  const bool straight = ends == Ends::straight;
  std::vector<std::int64_t> beyond_in(index(nodes_), -1), beyond_out(index(nodes_), -1);
  for (const std::int64_t h : border) {
    const std::int64_t v = start(h), arriving = in[index(v)];
    if (arriving / 4 == h / 4) {
      const std::int64_t p = end(h), q = start(arriving), r = end(next(h));
      const std::int64_t before = lay(straight ? Terms{{v, 2.0}, {p, -1.0}} : Terms{{v, 1.0}});
      const std::int64_t after = lay(straight ? Terms{{v, 2.0}, {q, -1.0}} : Terms{{v, 1.0}});
      const std::int64_t corner =
          lay(straight ? Terms{{v, 4.0}, {p, -2.0}, {q, -2.0}, {r, 1.0}} : Terms{{v, 1.0}});
      beyond_in[index(v)] = before, beyond_out[index(v)] = after;
      corners_.insert(corners_.end(), {v, before, corner, after});
    } else {
      Terms terms = {{v, straight ? 2.0 : 1.0}};
      if (straight) {
        std::int64_t edge = previous(h);
        std::size_t inner = 0;
        for (; twin_[index(edge)] >= 0; edge = previous(twin_[index(edge)])) {
          terms.push_back({start(edge), 0.0});
          ++inner;
        }
        for (std::size_t i = 1; i < terms.size(); ++i) terms[i].weight = -1.0 / static_cast<double>(inner);
      }
      beyond_in[index(v)] = beyond_out[index(v)] = lay(std::move(terms));
    }
  }
  for (const std::int64_t h : border)
    corners_.insert(corners_.end(),
                    {end(h), start(h), beyond_out[index(start(h))], beyond_in[index(end(h))]});
  return {};
}

void QuadMesh::ring(std::int64_t facet, int corner, Ring& out) const {
  out.edge.clear(), out.face.clear();
  const std::int64_t first = 4 * facet + corner;
  std::int64_t h = first;
  do {
    out.edge.push_back(end(h));
    out.face.push_back(end(next(h)));
    h = twin_[index(previous(h))];
  } while (h >= 0 && h != first);
}

} // namespace ents
