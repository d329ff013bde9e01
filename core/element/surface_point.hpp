// SPDX-License-Identifier: BSD-3-Clause
// A point of the surface itself, for pictures and for the admissibility checks.
#pragma once

#include "core/element/element.hpp"
#include "core/projection/collapsed_corner.hpp"

namespace ents::ENTS_ISA {

// Largest |principal curvature| from the two fundamental forms.
ENTS_INLINE double largest_curvature(const double (&metric)[1], const double (&form)[1]) {
  return absolute(form[0] / metric[0]);
}
ENTS_INLINE double largest_curvature(const double (&metric)[3], const double (&form)[3]) {
  const double det = determinant(metric);
  const double mean = 0.5 * (form[0] * metric[2] - 2.0 * form[1] * metric[1] + form[2] * metric[0]) / det;
  const double square = mean * mean - determinant(form) / det;
  return absolute(mean) + (square > 0.0 ? square_root(square) : 0.0);
}

template <class B, bool H>
Status evaluate_surface_point(const Plan& plan, const double* master, const double* surface_coordinates,
                              const double* xi, const SurfacePoint& out) {
  constexpr int D = B::dim, T = D - 1, K = symmetric_size<T>;
  Geometry<B> g(basis_of<B>(plan.basis));
  const int nodes = node_count(g.basis);
  if (!all_finite(master, D * nodes) || !all_finite(xi, T) ||
      (surface_coordinates && !all_finite(surface_coordinates, T * nodes)))
    return Status::non_finite;
  g.set(master, master); // seen from the first node
  g.surface_coordinates = surface_coordinates ? surface_coordinates : plan.surface_coordinates;
  g.height = plan.height;
  double at[T];
  for (int a = 0; a < T; ++a) at[a] = xi[a];
  if (!out.curvature && !out.base_curvature && is_in_collapsed_corner<B, H>(g, at)) { // beside it
    const AcrossEdge across = across_edge(collapsed_edge(g));
    at[across.direction] = across.value * (1.0 - next_to_collapsed_edge<H>);
  }
  Projection<B, H> p;
  Vec<double, D> normal;
  if (!evaluate_surface<2>(g, at, p.N, p.s) || !enriched_normal(p.s, normal))
    return Status::degenerate_segment;
  double h = 0.0;
  if constexpr (H) h = p.s.height.h;
  double zero = 0.0 * h;
  for (int c = 0; c < D; ++c) zero += 0.0 * p.s.d[c] + 0.0 * normal[c];
  if (zero != 0.0) return Status::out_of_range; // NaN, too
  for (int c = 0; c < D; ++c) {
    const double point = master[c] - p.s.d[c];
    if (out.point) out.point[c] = point;
    if (out.normal) out.normal[c] = normal[c];
    if (out.base_point) out.base_point[c] = point - h * p.s.n[c];
    if (out.base_normal) out.base_normal[c] = p.s.n[c];
  }
  if (out.height) *out.height = h;
  if (out.curvature) {
    double metric[K], form[K];
    for (int k = 0; k < K; ++k) {
      metric[k] = dot(p.s.e[k / 2], p.s.e[(k + 1) / 2]);
      form[k] = dot(normal, p.s.e2[k]);
    }
    *out.curvature = largest_curvature(metric, form);
  }
  if (out.base_curvature) {
    double metric[K], form[K] = {};
    unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
      metric[k] = dot(p.s.a[k / 2], p.s.a[(k + 1) / 2]);
      if constexpr (B::second[k]) form[k] = dot(p.s.n, p.s.a2[k]);
    });
    *out.base_curvature = largest_curvature(metric, form);
  }
  return Status::ok;
}

} // namespace ents::ENTS_ISA
