// SPDX-License-Identifier: BSD-3-Clause
// One segment as part of a surface of many: its best projection, and a box around it.
#pragma once

#include "core/projection/border.hpp"
#include "core/projection/branch_and_bound.hpp"

namespace ents::ENTS_ISA {

template <class B, bool H>
bool project_on_segment(const Plan& plan, const double* slave, const double* master,
                        const double* surface_coordinates, const double* start, double limit, int budget,
                        SegmentProjection& out) {
  constexpr int D = B::dim, T = D - 1;
  out.ambiguous = false;
  Geometry<B> g(basis_of<B>(plan.basis));
  g.set(slave, master);
  g.surface_coordinates = surface_coordinates ? surface_coordinates : plan.surface_coordinates;
  g.height = plan.height;
  Target t;
  if (!set_target<D>(plan, slave, t)) return false;
  Projection<B, H> p;
  if (start) {
    for (int a = 0; a < T; ++a) p.xi[a] = clamp(start[a], -far_outside, far_outside);
    if (project(g, t, p) != Found::yes) return false;
    if (t.kind == ProjectionKind::normal && !is_minimum(p.f2, p.metric)) return false;
  } else {
    const Search s = search<B, H>(g, t, plan, p, limit, budget);
    out.ambiguous = s.ambiguous;
    if (s.found != Found::yes) return false;
  }
  if (!on_segment(g.basis, p.xi, plan.border)) return false;
  const double size = square_root(dot(p.s.a[0], p.s.a[0]));
  out.beyond = beyond_segment(g.basis, p.xi) * size;
  out.rank = rank(t, p) + out.beyond;
  out.tie = tie_size * size;
  if (is_in_collapsed_corner<B, H>(g, p.xi)) // beside that corner: another segment's may be exact
    out.beyond = greater(out.beyond,
                         next_to_collapsed_edge<H> * (size + square_root(dot(p.s.a[T - 1], p.s.a[T - 1]))));
  if (!(out.rank < limit)) return false;
  if (t.kind == ProjectionKind::normal) {
    const Vec<double, D> m = normal_of_tangents(p.s.e);
    const double length = square_root(dot(m, m));
    if (!(length > 0.0)) return false;
    out.gap = dot(p.s.d, m) / length;
  } else {
    out.gap = dot(p.s.d, ray_of<D>(t));
  }
  for (int a = 0; a < T; ++a) out.xi[a] = p.xi[a];
  for (int k = 0; k < D; ++k) out.point[k] = slave[k] - p.s.d[k];
  return true;
}

// A net is narrow where nodes lie beside the segment; the box of the nodes is, too, of triangles and where they are
// its corners.
template <class B> ENTS_INLINE bool has_net(const B& basis) { return is_counted<B> && !is_simplex(basis); }

// The half-sizes of a segment with its border are at most `hull_spread` times those of the box of its nodes:
// with c the centre of that box, rho - c = sum_i N_i (x_i - c), and sum_i |N_i| = 1 + 2 sum_i max(-N_i, 0). A box
// that lies across the long side of a triangle is halved some times: there N_i < 0 beside the segment.
template <class B>
double spread_in_box(const B& basis, double border, const double (&centre)[2], double half, int halvings) {
  constexpr int T = B::dim - 1;
  const double sum = centre[0] + centre[1], high = 1.0 + border;
  if (is_simplex(basis) && sum - 2.0 * half > high) return 1.0;
  double most = 1.0;
  if (is_simplex(basis) && halvings > 0 && sum + 2.0 * half > high) {
    for (const double x : {-0.5 * half, 0.5 * half})
      for (const double y : {-0.5 * half, 0.5 * half})
        most = greater(
            most, spread_in_box(basis, border, {centre[0] + x, centre[1] + y}, 0.5 * half, halvings - 1));
    return most;
  }
  Ball xi[T];
  for (int a = 0; a < T; ++a) xi[a] = {centre[a], half};
  Shape<Ball, T, B::nodes> N;
  basis.template shape<0>(xi, N);
  double negative = 0.0;
  for (int n = 0; n < node_count(basis); ++n) negative += greater(N.n[n].r - N.n[n].v, 0.0);
  return 1.0 + 2.0 * negative;
}
template <class B> double hull_spread(Basis which, double border) {
  constexpr int T = B::dim - 1, parts = T == 1 ? 64 : 16;
  const B basis = basis_of<B>(which);
  if (has_net(basis)) return 1.0;
  const double low = is_simplex(basis) ? -border : -1.0 - border, high = 1.0 + border;
  const double half = 0.5 * (high - low) / parts;
  double most = 1.0;
  for (int j = 0; j < (T == 1 ? 1 : parts); ++j)
    for (int i = 0; i < parts; ++i)
      most = greater(
          most, spread_in_box(basis, border, {low + (2 * i + 1) * half, low + (2 * j + 1) * half}, half, 3));
  return most;
}

// Between the coefficients of a net or, without one, between the values at the nodes.
template <int V, class B>
ENTS_INLINE void range_of_segment(const B& basis, const Plan& plan, const double* of, Ball (&out)[V]) {
  double least[V], most[V];
  for (int k = 0; k < V; ++k) least[k] = no_bound, most[k] = -no_bound;
  const auto take = [&](const double* values) {
    for (int k = 0; k < V; ++k) least[k] = lesser(least[k], values[k]), most[k] = greater(most[k], values[k]);
  };
  double spread = 1.0;
  if (!has_net(basis)) {
    for (int i = 0; i < node_count(basis); ++i) take(of + V * i);
    spread = plan.hull_spread;
  } else if constexpr (is_counted<B>) {
    const SegmentNet<B, V> net(basis, Domain<B>(basis, plan.border), of);
    for (int j = 0; j < net.count[1]; ++j)
      for (int i = 0; i < net.count[0]; ++i) take(net.c[j][i].c);
  }
  for (int k = 0; k < V; ++k) out[k] = {0.5 * (least[k] + most[k]), 0.5 * (most[k] - least[k]) * spread};
}

template <class B, bool H>
ENTS_NOINLINE void segment_box(const Plan& plan, const double* master, const double* surface_coordinates,
                               double* low, double* high) {
  constexpr int D = B::dim, T = D - 1;
  const B basis = basis_of<B>(plan.basis);
  const double* c = surface_coordinates ? surface_coordinates : plan.surface_coordinates;
  Ball x[D];
  range_of_segment(basis, plan, master, x);
  double size = 0.0;
  for (int k = 0; k < D; ++k) size += x[k].r;
  double margin = 1e-9 * size; // ties, and rays along an edge
  if constexpr (H) {
    double height = plan.height_bound;
    if (!(height < 0.1 * size)) {
      Ball s[T];
      if (c)
        range_of_segment(basis, plan, c, s);
      else
        for (Ball& xi : s)
          xi = is_simplex(basis) ? Ball(0.5, 0.5 + plan.border) : Ball(0.0, 1.0 + plan.border);
      height = lesser(height, magnitude(evaluate_height<T>(*plan.height, s).h)); // largest |h|
    }
    margin += height < no_bound ? height : no_bound;
  }
  for (int k = 0; k < D; ++k) {
    low[k] = x[k].v - x[k].r - margin;
    high[k] = x[k].v + x[k].r + margin;
  }
}

#define ENTS_SEARCH(B)                                                                                       \
  template Search search<B, false>(const Geometry<B>&, const Target&, const Plan&, Projection<B, false>&,    \
                                   double, int);                                                             \
  template Search search<B, true>(const Geometry<B>&, const Target&, const Plan&, Projection<B, true>&,      \
                                  double, int);                                                              \
  template bool project_on_segment<B, false>(const Plan&, const double*, const double*, const double*,       \
                                             const double*, double, int, SegmentProjection&);                \
  template bool project_on_segment<B, true>(const Plan&, const double*, const double*, const double*,        \
                                            const double*, double, int, SegmentProjection&);                 \
  template bool closest_border_point<B, false>(const Plan&, const double*, const double*, const double*,     \
                                               double, BorderPoint&);                                        \
  template bool closest_border_point<B, true>(const Plan&, const double*, const double*, const double*,      \
                                              double, BorderPoint&);                                         \
  template void segment_box<B, false>(const Plan&, const double*, const double*, double*, double*);          \
  template void segment_box<B, true>(const Plan&, const double*, const double*, double*, double*);           \
  template double hull_spread<B>(Basis, double);

} // namespace ents::ENTS_ISA
