// SPDX-License-Identifier: BSD-3-Clause
// Smoothed quadrilaterals. Where four facets meet in each corner of a facet, its 16 control points are the
// nodes around it. Else its segment is a bicubic patch close to the Catmull-Clark surface, made as a Bezier
// patch and written as a B-spline:
//   "2008"  C. Loop and S. Schaefer, Approximating Catmull-Clark subdivision surfaces with bicubic patches,
//           ACM TOG 27(1), 2008: corners on the limit surface, points that belong to regular corners as those
//           of the B-spline, so that neighbours meet with one tangent along all edges with regular ends
//   "2009"  C. Loop, S. Schaefer, T. Ni and I. Castano, Approximating subdivision surfaces with Gregory
//           patches for hardware tessellation, ACM TOG 28(5), 2009: edge points of extraordinary corners in
//           the limit tangent plane, so that neighbours have one normal there, and the inner points that
//           continuity across an edge asks for. A bicubic patch has one such point where two edges ask: it
//           gets the mean. The jump of the normal that remains along these edges is a quarter of what the
//           points of 2008 leave.
#include "core/smoothing/patch_weights.hpp"

namespace ents {

namespace {

// The grid of 4 x 4 points of a patch: corner k of the inner 2 x 2 points (reach 1) or of the whole grid
// (reach 3), and steps to the next and the previous corner.
struct Grid {
  int i, j, next[2], previous[2];
  Grid(int corner, int first, int last) {
    static constexpr int turn[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    i = corner == 0 || corner == 3 ? first : last;
    j = corner < 2 ? first : last;
    for (int k = 0; k < 2; ++k) {
      next[k] = turn[corner][k];
      previous[k] = -turn[(corner + 3) % 4][k];
    }
  }
  std::size_t at(int n, int p) const {
    return static_cast<std::size_t>(4 * (j + n * next[1] + p * previous[1]) + i + n * next[0] +
                                    p * previous[0]);
  }
};

class Patch : public PatchWeights {
public:
  using PatchWeights::PatchWeights;

  // The corner, the points beside it on its two edges, and, of a regular corner, the inner one. 2008: an
  // inner point is (n x + 2 e_i + 2 e_(i+1) + f_i) / (n + 5), one on an edge is the mean of the two inner
  // ones beside it, the corner is the mean of the n around it.
  void add_corner(int corner, std::int64_t node, const Ring& ring) {
    const Grid grid(corner, 0, 3);
    const std::size_t n = ring.size();
    add_limit(grid.at(0, 0), node, ring);
    if (n == 4) {
      add_inner(grid.at(1, 1), node, ring, 0, 1.0);
      for (const std::size_t i : {0, 3}) add_inner(grid.at(1, 0), node, ring, i, 0.5);
      for (const std::size_t i : {0, 1}) add_inner(grid.at(0, 1), node, ring, i, 0.5);
    } else {
      add_tangent(grid.at(1, 0), node, ring, 0);
      add_tangent(grid.at(0, 1), node, ring, 1);
    }
  }

  // The inner point of an extraordinary corner, when all edges are there. With the points b_0 .. b_3 of an
  // edge and c = cos(2 pi / n), 2009 asks for b_1 + (2 c (b_2 - b_1) - c' (b_1 - b_0) + r) / 3, c' of the
  // other end. At a regular other end the second inner point is not free; there c (b_2 - b_1 + (b_3 - b_2) /
  // 2) leaves a smaller jump (measured).
  void add_inner_corner(int corner, const Ring (&rings)[4]) {
    const Grid grid(corner, 0, 3);
    const Ring& ring = rings[corner];
    const std::size_t point = grid.at(1, 1);
    add_across(point, ring, 0, 0.5 / 3.0);
    add_across(point, ring, 1, -0.5 / 3.0);
    for (const bool forward : {true, false}) {
      std::size_t b[4];
      for (int k = 0; k < 4; ++k) b[k] = forward ? grid.at(k, 0) : grid.at(0, k);
      const std::size_t other = rings[(corner + (forward ? 1 : 3)) % 4].size();
      const double c = cosine(2, ring.size()), end = other == 4 ? 0.0 : cosine(2, other);
      const double near = other == 4 ? c : 2.0 * c, far = other == 4 ? 0.5 * c : 0.0;
      for_each_node([&](double* w) {
        w[point] +=
            0.5 *
            (w[b[1]] +
             (near * (w[b[2]] - w[b[1]]) + far * (w[b[3]] - w[b[2]]) - end * (w[b[1]] - w[b[0]])) / 3.0);
      });
    }
  }

  // Uniform cubic B-spline to Bezier: b_0 = (p_0 + 4 p_1 + p_2) / 6, b_1 = (2 p_1 + p_2) / 3 and so on; this
  // is the inverse.
  void add_points(Smoothed& out) const {
    static constexpr int inverse[4][4] = {{6, -7, 2, 0}, {0, 2, -1, 0}, {0, -1, 2, 0}, {0, 2, -7, 6}};
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 4; ++i)
        out.segment_points.push_back(out.add_point(combine([&](const double* w) {
          double sum = 0.0;
          for (std::size_t b = 0; b < 4; ++b)
            for (std::size_t a = 0; a < 4; ++a) sum += inverse[i][a] * inverse[j][b] * w[4 * b + a];
          return sum;
        })));
  }

private:
  void add_limit(std::size_t point, std::int64_t node, const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      add_inner(point, node, ring, i, 1.0 / static_cast<double>(ring.size()));
  }

  // Limit point + 2/3 lambda q_i, q_i the limit tangent of 2009.
  void add_tangent(std::size_t point, std::int64_t node, const Ring& ring, std::size_t i) {
    add_limit(point, node, ring);
    const std::size_t n = ring.size();
    const double c1 = cosine(1, n), c2 = cosine(2, n), sigma = 1.0 / std::sqrt(4.0 + c1 * c1);
    const double lambda = (5.0 + c2 + c1 * std::sqrt(18.0 + 2.0 * c2)) / 16.0;
    const double scale = 2.0 * lambda / (3.0 * static_cast<double>(n));
    for (std::size_t j = 0; j < n; ++j) {
      add(point, ring.edge[(i + j) % n], scale * (1.0 + sigma * c1) * cosine(2 * j, n));
      add(point, ring.face[(i + j) % n], scale * sigma * cosine(2 * j + 1, n));
    }
  }

  // r = (e_(i+1) - e_(i-1)) / 3 + (f_i - f_(i-1)) / 6, across edge i.
  void add_across(std::size_t point, const Ring& ring, std::size_t i, double part) {
    const std::size_t n = ring.size(), before = (i + n - 1) % n;
    add(point, ring.edge[(i + 1) % n], part / 3.0);
    add(point, ring.edge[before], -part / 3.0);
    add(point, ring.face[i], part / 6.0);
    add(point, ring.face[before], -part / 6.0);
  }

  void add_inner(std::size_t point, std::int64_t node, const Ring& ring, std::size_t i, double part) {
    const double n = static_cast<double>(ring.size()), weight = part / (n + 5.0);
    add(point, node, weight * n);
    add(point, ring.edge[i], weight * 2.0);
    add(point, ring.edge[(i + 1) % ring.size()], weight * 2.0);
    add(point, ring.face[i], weight);
  }
};

} // namespace

Refusal smooth_quads(Ends ends, bool regular, std::int64_t facets, const std::int64_t* connectivity,
                     std::int64_t nodes, Smoothed& out) {
  FacetMesh mesh(4);
  if (const Refusal refusal = mesh.build(ends, facets, connectivity, nodes); refusal.reason != Refusal::none)
    return refusal;
  const bool quasi = is_quasi(ends);
  QuadControls controls;
  if (quasi)
    if (const Refusal refusal = controls.build(mesh); refusal.reason != Refusal::none) return refusal;
  out.add_nodes(nodes);
  std::vector<std::int64_t> number(static_cast<std::size_t>(mesh.all_nodes()), -1);
  if (!quasi)
    for (const Terms& terms : mesh.laid_around()) out.add_point(terms);
  const auto control_point = [&](std::int64_t node) {
    if (!quasi) return node;
    std::int64_t& point = number[static_cast<std::size_t>(node)];
    if (point < 0) point = out.add_point(controls.of(node));
    return point;
  };
  Patch patch(mesh, quasi ? &controls : nullptr);
  Ring rings[4];
  for (std::int64_t f = 0; f < facets; ++f) {
    bool four = true;
    for (int corner = 0; corner < 4; ++corner) {
      Ring& ring = rings[corner];
      if (const Refusal refusal = mesh.ring(f, corner, ring); refusal.reason != Refusal::none) return refusal;
      const std::size_t valence = ring.size();
      if (regular && valence != 4) return {Refusal::irregular, f, -1, mesh.node(f, corner)};
      four = four && valence == 4;
    }
    if (four) {
      std::int64_t points[16];
      for (int corner = 0; corner < 4; ++corner) {
        const Ring& ring = rings[corner];
        const Grid grid(corner, 1, 2);
        points[grid.at(0, 0)] = control_point(mesh.node(f, corner));
        points[grid.at(-1, 0)] = control_point(ring.edge[2]);
        points[grid.at(-1, -1)] = control_point(ring.face[2]);
        points[grid.at(0, -1)] = control_point(ring.edge[3]);
      }
      out.segment_points.insert(out.segment_points.end(), points, points + 16);
    } else {
      patch.clear();
      for (int corner = 0; corner < 4; ++corner)
        patch.add_corner(corner, mesh.node(f, corner), rings[corner]);
      for (int corner = 0; corner < 4; ++corner)
        if (rings[corner].size() != 4) patch.add_inner_corner(corner, rings);
      patch.add_points(out);
    }
  }
  return {};
}

} // namespace ents
