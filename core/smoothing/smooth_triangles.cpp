// SPDX-License-Identifier: BSD-3-Clause
// Smoothed triangles: quartic Bezier patches near the limit surface of C. Loop, Smooth subdivision surfaces
// based on triangles, University of Utah, 1987. Where six facets meet in each corner of a facet, the patch is
// that surface (the quartic box spline, C2). Next to an extraordinary corner
//   corner and tangent plane   are those of the limit surface, so that neighbours have one point and one
//                              normal there;
//   the rest of the boundary   is that of the regular patch, one and the same for both neighbours;
//   the inner point            is the mean of what continuity across its two edges asks for near the corner;
//   a kink                     remains along these edges, and none along the others.
#include "core/smoothing/patch_weights.hpp"
#include "core/surface/basis.hpp"

namespace ents {

namespace {

using Bezier = ENTS_ISA::Bezier15;

// The point with the exponents i at a corner, j at the next, k at the one before it.
std::size_t at(int corner, int i, int j, int k) {
  const int exponents[3] = {i, j, k};
  for (std::size_t n = 0; n < Bezier::nodes; ++n) {
    bool same = true;
    for (int c = 0; c < 3; ++c) same = same && Bezier::power[n][(corner + c) % 3] == exponents[c];
    if (same) return n;
  }
  return 0;
}

struct Corner {
  int number;
  std::int64_t node;
  const Ring& ring;
  std::size_t n;
  std::int64_t neighbour(std::size_t i) const { return ring.edge[i % n]; }
};

// v + l sum (e_j - v), 1 / l = n + 3 / (8 beta), beta of Loop 1987.
void add_limit(PatchWeights& patch, std::size_t point, const Corner& c) {
  const double n = static_cast<double>(c.n), a = 0.375 + 0.25 * cosine(2, c.n);
  const double beta = (0.625 - a * a) / n, part = 1.0 / (n + 0.375 / beta);
  patch.add(point, c.node, 1.0 - n * part);
  for (std::size_t j = 0; j < c.n; ++j) patch.add(point, c.neighbour(j), part);
}

// sum f(2 pi k j / n) e_(i+j) / n times `scale`: cosines are the limit tangent along edge i, sines what lies
// across it.
void add_wave(PatchWeights& patch, std::size_t point, const Corner& c, std::size_t i,
              double (*f)(std::size_t, std::size_t), std::size_t k, double scale) {
  for (std::size_t j = 0; j < c.n; ++j)
    patch.add(point, c.neighbour(i + j), scale * f(2 * k * j, c.n) / static_cast<double>(c.n));
}

void add_corner(PatchWeights& patch, const Corner& c) {
  const int v = c.number;
  add_limit(patch, at(v, 4, 0, 0), c);
  for (const std::size_t i : {0, 1}) {
    const std::size_t point = i == 0 ? at(v, 3, 1, 0) : at(v, 3, 0, 1);
    add_limit(patch, point, c);
    add_wave(patch, point, c, i, cosine, 1, 0.5); // regular: (12 v + 4 e_0 + 3 e_1 + 3 e_5 + e_2 + e_4) / 24
  }
  const std::size_t middle = at(v, 2, 2, 0);
  patch.add(middle, c.node, 1.0 / 3.0);
  patch.add(middle, c.neighbour(0), 1.0 / 3.0);
  patch.add(middle, c.neighbour(1), 1.0 / 6.0);
  patch.add(middle, c.neighbour(c.n - 1), 1.0 / 6.0);
  if (c.n != 6) return;
  const std::size_t inner = at(v, 2, 1, 1);
  patch.add(inner, c.node, 10.0 / 24.0);
  for (const std::size_t i : {0, 1}) patch.add(inner, c.neighbour(i), 6.0 / 24.0);
  for (const std::size_t i : {2, 5}) patch.add(inner, c.neighbour(i), 1.0 / 24.0);
}

// With the points b_k of an edge and the rows l_k, r_k beside it, l_k + r_k - 2 b_k are the coefficients of a
// cubic that shall be lambda(t) times the edge's derivative; lambda falls linearly from 2 cos(2 pi / n) here
// to 2 - 2 cos(2 pi / n') at the other end (both 1 in regular nodes). That gives the sum of the inner points
// l_1 + r_1 near this end; their difference follows the first two harmonics of the ring, as in a regular one.
void add_inner(PatchWeights& patch, const Corner& c, const std::size_t (&valence)[3]) {
  const int v = c.number;
  const std::size_t inner = at(v, 2, 1, 1);
  const double across = 2.0 * sine(2, c.n);
  for (const std::size_t i : {0, 1}) {
    const double side = i == 0 ? 0.25 : -0.25;
    add_wave(patch, inner, c, i, sine, 1, 0.5 * across * side);
    if (c.n > 4) add_wave(patch, inner, c, i, sine, 2, side / std::sqrt(3.0));
    const double here = 2.0 * cosine(2, c.n);
    const double there = 2.0 - 2.0 * cosine(2, valence[(v + (i == 0 ? 1 : 2)) % 3]);
    std::size_t b[3];
    for (int k = 0; k < 3; ++k) b[k] = i == 0 ? at(v, 4 - k, k, 0) : at(v, 4 - k, 0, k);
    patch.for_each_node([&](double* w) {
      w[inner] +=
          0.5 * w[b[1]] + 0.25 * (here * (w[b[2]] - w[b[1]]) + (there - here) / 3.0 * (w[b[1]] - w[b[0]]));
    });
  }
}

} // namespace

Refusal smooth_triangles(std::int64_t facets, const std::int64_t* connectivity, std::int64_t nodes,
                         Smoothed& out) {
  FacetMesh mesh(3);
  if (const Refusal refusal = mesh.build(Ends::straight, facets, connectivity, nodes);
      refusal.reason != Refusal::none)
    return refusal;
  out.add_nodes(nodes);
  PatchWeights patch(mesh);
  std::vector<std::int64_t> limit(static_cast<std::size_t>(nodes), -1); // the point of each node's corners
  Ring rings[3];
  for (std::int64_t f = 0; f < facets; ++f) {
    patch.clear();
    std::size_t valence[3];
    for (int k = 0; k < 3; ++k) {
      if (const Refusal refusal = mesh.ring(f, k, rings[k]); refusal.reason != Refusal::none) return refusal;
      valence[k] = rings[k].size();
      add_corner(patch, {k, mesh.node(f, k), rings[k], valence[k]});
    }
    for (int k = 0; k < 3; ++k)
      if (valence[k] != 6) add_inner(patch, {k, mesh.node(f, k), rings[k], valence[k]}, valence);
    for (std::size_t n = 0; n < Bezier::nodes; ++n) {
      const auto point = [&] { return out.add_point(patch.combine([&](const double* w) { return w[n]; })); };
      if (n >= 3) {
        out.segment_points.push_back(point());
        continue;
      }
      std::int64_t& corner = limit[static_cast<std::size_t>(mesh.node(f, static_cast<int>(n)))];
      if (corner < 0) corner = point();
      out.segment_points.push_back(corner);
    }
  }
  return {};
}

} // namespace ents
