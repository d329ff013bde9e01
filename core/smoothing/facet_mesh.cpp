// SPDX-License-Identifier: BSD-3-Clause
#include "core/smoothing/facet_mesh.hpp"

#include <algorithm>
#include <tuple>

#include "core/smoothing/quasi_interpolation.hpp"

namespace ents {

Refusal FacetMesh::build(Ends ends, std::int64_t facets, const std::int64_t* connectivity,
                         std::int64_t nodes) {
  facets_ = facets, nodes_ = nodes;
  corners_.assign(connectivity, connectivity + m_ * facets);
  for (std::int64_t f = 0; f < facets; ++f)
    for (int a = 0; a < m_; ++a)
      for (int b = 0; b < a; ++b)
        if (node(f, a) == node(f, b)) return {Refusal::repeated_node, f, -1, node(f, a)};
  if (const Refusal refusal = pair(); refusal.reason != Refusal::none) return refusal;
  if (const Refusal refusal = find_border(); refusal.reason != Refusal::none) return refusal;
  count_incident();
  if (m_ == 4)
    extend_quads(ends);
  else
    extend_triangles();
  count_incident();
  return pair();
}

void FacetMesh::count_incident() {
  incident_.assign(index(all_nodes()), 0);
  for (const std::int64_t corner : corners_) ++incident_[index(corner)];
}

// Finds the two half-edges of every edge.
Refusal FacetMesh::pair() {
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
      if (last - i > 2) return {Refusal::branch, edges[i + 2].half / m_, a / m_, edges[i].low, edges[i].high};
      if (start(a) == start(b)) return {Refusal::opposed, b / m_, a / m_, edges[i].low, edges[i].high};
      twin_[index(a)] = b, twin_[index(b)] = a;
    }
    i = last;
  }
  return {};
}

std::int64_t FacetMesh::lay(Terms terms) {
  collect(terms);
  laid_around_.push_back(std::move(terms));
  return nodes_ + static_cast<std::int64_t>(laid_around_.size()) - 1;
}

Refusal FacetMesh::find_border() {
  in_.assign(index(nodes_), -1), out_.assign(index(nodes_), -1);
  for (std::int64_t h = 0; h < m_ * facets_; ++h) {
    if (twin_[index(h)] >= 0) continue;
    border_.push_back(h);
    std::int64_t& leaving = out_[index(start(h))];
    if (leaving >= 0) return {Refusal::touching, h / m_, leaving / m_, start(h)};
    leaving = h;
    in_[index(end(h))] = h;
  }
  return {};
}

// One facet beyond every edge of the border, one more beyond every corner (a node of one facet only).
// Straight ends: a node x_0 of the border with inner neighbours has 2 x_0 - (their mean) beyond it; a corner
// x_00 has 2 x_00 - x_10, 2 x_00 - x_01 and, the same in both directions, 4 x_00 - 2 x_10 - 2 x_01 + x_11.
void FacetMesh::extend_quads(Ends ends) {
  const std::size_t most = extrapolation_nodes(ends);
  beyond_in_.assign(index(nodes_), -1), beyond_out_.assign(index(nodes_), -1);
  for (const std::int64_t h : border_) {
    const std::int64_t v = start(h), arriving = in_[index(v)];
    if (arriving / 4 == h / 4) {
      beyond_in_[index(v)] = lay(beyond(ends, line_along_border(v, true, most)));
      beyond_out_[index(v)] = lay(beyond(ends, line_along_border(v, false, most)));
      lay_corner(ends, h);
    } else {
      std::vector<std::int64_t> inner;
      std::int64_t edge = previous(h), last = edge;
      for (; twin_[index(edge)] >= 0; edge = previous(twin_[index(edge)]))
        inner.push_back(start(last = edge));
      Terms terms = {{v, 2.0}};
      if (ends == Ends::repeated) {
        terms = {{v, 1.0}};
      } else if (is_quasi(ends) && inner.size() == 1) {
        terms = beyond(ends, line_inwards(twin_[index(last)], most));
      } else {
        for (const std::int64_t node : inner)
          terms.push_back({node, -1.0 / static_cast<double>(inner.size())});
      }
      beyond_in_[index(v)] = beyond_out_[index(v)] = lay(std::move(terms));
      if (is_quasi(ends)) control_beyond(beyond_in_[index(v)], v, inner, start(arriving), end(h));
    }
  }
  for (const std::int64_t h : border_)
    corners_.insert(corners_.end(),
                    {end(h), start(h), beyond_out_[index(start(h))], beyond_in_[index(end(h))]});
  if (!is_quasi(ends)) return;
  for (const std::int64_t h : border_)
    if (in_[index(start(h))] / 4 == h / 4) extrapolate_corner(ends, h);
}

// The corner where half-edge h of the border starts.
void FacetMesh::lay_corner(Ends ends, std::int64_t h) {
  const std::int64_t v = start(h), p = end(h), q = start(in_[index(v)]), r = end(next(h));
  Terms terms = {{v, 1.0}}; // of quasi-interpolation only until its neighbours are laid
  if (ends == Ends::straight) terms = {{v, 4.0}, {p, -2.0}, {q, -2.0}, {r, 1.0}};
  const std::int64_t corner = lay(std::move(terms));
  corners_.insert(corners_.end(), {v, beyond_in_[index(v)], corner, beyond_out_[index(v)]});
}

// `line`: x_0, x_1 ... inwards.
Terms FacetMesh::beyond(Ends ends, const std::vector<std::int64_t>& line) const {
  if (ends == Ends::repeated) return {{line[0], 1.0}};
  if (ends == Ends::straight) return {{line[0], 2.0}, {line[1], -1.0}};
  return extrapolated(line);
}

// One triangle beyond every edge of the border, with the third node of its facet reflected, and as many
// between two of them as a regular mesh has: beyond a node of two facets 2 x_0 less its inner neighbour,
// beyond one of one facet 2 x_0 less each of its neighbours.
void FacetMesh::extend_triangles() {
  std::vector<std::int64_t> beyond(corners_.size(), -1);
  for (const std::int64_t h : border_)
    beyond[index(h)] = lay({{start(h), 1.0}, {end(h), 1.0}, {end(next(h)), -1.0}});
  for (const std::int64_t h : border_) {
    const std::int64_t v = start(h), arriving = in_[index(v)], inner = previous(h); // inner: ends in v
    std::vector<std::int64_t> around = {beyond[index(arriving)]};
    const auto opposite = [&](std::int64_t node) { around.push_back(lay({{v, 2.0}, {node, -1.0}})); };
    if (inner == arriving) {
      opposite(end(h));
      opposite(start(arriving));
    } else if (previous(twin_[index(inner)]) == arriving) {
      opposite(start(inner));
    }
    around.push_back(beyond[index(h)]);
    for (std::size_t i = 0; i + 1 < around.size(); ++i)
      corners_.insert(corners_.end(), {v, around[i], around[i + 1]});
    corners_.insert(corners_.end(), {end(h), v, beyond[index(h)]});
  }
}

Refusal FacetMesh::ring(std::int64_t facet, int corner, Ring& out) const {
  out.edge.clear(), out.face.clear();
  const std::int64_t first = m_ * facet + corner;
  std::int64_t h = first;
  do {
    out.edge.push_back(end(h));
    out.face.push_back(end(next(h)));
    h = twin_[index(previous(h))];
  } while (h >= 0 && h != first);
  const auto size = static_cast<std::int64_t>(out.size());
  if (incident_[index(start(first))] != size) return {Refusal::touching, facet, -1, start(first)};
  if (size == 2) return {Refusal::folded, facet, -1, start(first)};
  return {};
}

} // namespace ents
