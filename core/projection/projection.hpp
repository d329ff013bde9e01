// SPDX-License-Identifier: BSD-3-Clause
// Projection of the slave node on the enriched surface, from a start value.
//   normal: (x_s - rho_e) . rho_e,a = 0, the minimum of F = |x_s - rho_e|^2 / 2
//   shadow: x_s - rho_e = g e, the point of the surface on the ray through the slave
// Newton's method on the exact equations, made safe by a bound on the step and by backtracking on F
// (normal) or on the distance from the ray (shadow).
#pragma once

#include "core/model/model.hpp"
#include "core/numbers/lanes.hpp"
#include "core/surface/surface.hpp"

namespace ents::ENTS_ISA {

enum class Found { yes, not_converged, escaped, degenerate, grazing };

// The surface at the projection, ready for the variations.
template <class B, bool H> struct Projection {
  static constexpr int D = B::dim, T = D - 1, K = symmetric_size<T>;
  double xi[T];
  Shape<double, T, B::nodes> N;
  Surface<B, H, double> s;
  double metric[K]; // A_e = rho_e,a . rho_e,b   (normal)
  double f2[K];     // F_,xixi = A_e - d . rho_e,ab (normal)
  int evaluations;
};

// What a projection needs to know of its model.
struct Target {
  ProjectionKind kind;
  double ray[3];           // unit ray direction e of this element (shadow)
  double inverse_distance; // 1 / distance of the emitter; 0 for a fixed direction
};

inline constexpr int max_evaluations = 30;
inline constexpr double max_step = 0.5;    // natural coordinates
inline constexpr double far_outside = 4.0; // |xi| beyond which the iteration has left the segment for good

template <int T> ENTS_INLINE double max_norm(const double (&v)[T]) {
  double m = v[0] < 0 ? -v[0] : v[0];
  if constexpr (T == 2) {
    const double w = v[1] < 0 ? -v[1] : v[1];
    m = m > w ? m : w;
  }
  return m;
}

// Solve the symmetric system m x = r. False if m is singular.
ENTS_INLINE bool solve(const double (&m)[1], const double (&r)[1], double (&x)[1]) {
  if (m[0] == 0.0) return false;
  x[0] = r[0] / m[0];
  return true;
}
ENTS_INLINE bool solve(const double (&m)[3], const double (&r)[2], double (&x)[2]) {
  const double det = determinant(m);
  if (det == 0.0) return false;
  const double q = 1.0 / det;
  x[0] = (m[2] * r[0] - m[1] * r[1]) * q;
  x[1] = (m[0] * r[1] - m[1] * r[0]) * q;
  return true;
}

// A minimum of the distance: F_,xixi is positive definite, with some distance from singular.
template <int K> ENTS_INLINE bool is_minimum(const double (&f2)[K], const double (&metric)[K]) {
  return f2[0] > 1e-8 * metric[0] && determinant(f2) > 1e-8 * determinant(metric);
}

// Smallest eigenvalue of f2 with respect to the metric.
ENTS_INLINE double smallest_eigenvalue(const double (&f2)[1], const double (&metric)[1]) {
  return f2[0] / metric[0];
}
ENTS_INLINE double smallest_eigenvalue(const double (&f2)[3], const double (&metric)[3]) {
  const double det = determinant(metric);
  const double half = 0.5 * (metric[2] * f2[0] - 2.0 * metric[1] * f2[1] + metric[0] * f2[2]) / det;
  const double square = half * half - determinant(f2) / det;
  return half - (square > 0.0 ? square_root(square) : 0.0);
}

// Newton step of the normal projection; merit = F. False where rho_e has no area (a fold of the enriched
// surface).
template <class B, bool H>
ENTS_INLINE bool normal_step(Projection<B, H>& p, double (&step)[B::dim - 1], double& merit) {
  constexpr int T = B::dim - 1, K = symmetric_size<T>;
  double r[T];
  for (int a = 0; a < T; ++a) r[a] = dot(p.s.e[a], p.s.d);
  for (int k = 0; k < K; ++k) {
    p.metric[k] = dot(p.s.e[k / 2], p.s.e[(k + 1) / 2]);
    p.f2[k] = p.metric[k] - dot(p.s.d, p.s.e2[k]);
  }
  merit = 0.5 * dot(p.s.d, p.s.d);
  if (is_minimum(p.f2, p.metric)) return solve(p.f2, r, step);
  if (!(determinant(p.metric) > 0.0)) return false;
  // beyond a centre of curvature: shifted so that the smallest eigenvalue (1 - distance / radius) counts
  // with its absolute value; the step descends and is as long as the curvature allows
  double shifted[K];
  const double smallest = smallest_eigenvalue(p.f2, p.metric), size = absolute(smallest);
  for (int k = 0; k < K; ++k) shifted[k] = p.f2[k] + ((size > 0.1 ? size : 0.1) - smallest) * p.metric[k];
  return solve(shifted, r, step);
}

// Covectors of the frame (rho_e,1 .. rho_e,T, e): onto[a] . rho_e,b = delta_ab, onto[a] . e = 0;
// gap . rho_e,a = 0, gap . e = 1. False if the ray lies in the tangent plane.
template <class S, int D>
ENTS_INLINE Truth<S> ray_frame(const Vec<S, D> (&e)[D - 1], const Vec<S, D>& ray, Vec<S, D> (&onto)[D - 1],
                               Vec<S, D>& gap) {
  const Vec<S, D> m = normal_of_tangents(e);
  const S det = dot(m, ray), q = unchecked_inverse(det);
  if constexpr (D == 2) {
    onto[0] = q * Vec<S, 2>{{ray[1], -ray[0]}};
  } else {
    onto[0] = q * cross(e[1], ray);
    onto[1] = q * cross(ray, e[0]);
  }
  gap = q * m;
  return det * det > 1e-20 * dot(m, m);
}

template <int D> ENTS_INLINE Vec<double, D> ray_of(const Target& t) {
  Vec<double, D> e;
  for (int k = 0; k < D; ++k) e[k] = t.ray[k];
  return e;
}

// Newton step of the shadow projection; merit = half the squared distance from the ray.
template <class B, bool H>
ENTS_INLINE bool shadow_step(Projection<B, H>& p, const Target& t, double (&step)[B::dim - 1],
                             double& merit) {
  constexpr int D = B::dim, T = D - 1;
  const Vec<double, D> ray = ray_of<D>(t);
  Vec<double, D> onto[T], gap;
  if (!ray_frame(p.s.e, ray, onto, gap)) return false;
  for (int a = 0; a < T; ++a) step[a] = dot(onto[a], p.s.d);
  Vec<double, D> off = p.s.d;
  add_scaled(off, -dot(p.s.d, ray), ray);
  merit = 0.5 * dot(off, off);
  return true;
}

// Next to a corner where two nodes are one, a natural coordinate is known to rounding over the length of its
// tangent only: there a step that moves the point by rounding of the segment's size is the last one.
template <class B, bool H>
ENTS_INLINE bool is_rounding(const Projection<B, H>& p, const double (&step)[B::dim - 1]) {
  if constexpr (B::dim == 2)
    return false;
  else {
    const double first = dot(p.s.a[0], p.s.a[0]), second = dot(p.s.a[1], p.s.a[1]);
    const bool near_corner = first < 1e-4 * second || second < 1e-4 * first;
    return near_corner && step[0] * step[0] * first + step[1] * step[1] * second < 1e-28 * (first + second);
  }
}

// From p.xi to the projection near it. On success p holds the surface at the projection; after `escaped`,
// at the last point on the way out.
template <class B, bool H>
ENTS_NOINLINE Found project(const Geometry<B>& g, const Target& t, Projection<B, H>& p) {
  constexpr int T = B::dim - 1;
  const bool normal = t.kind == ProjectionKind::normal;
  double xi[T], step[T] = {}, previous_merit = 0.0, previous_length = 0.0;
  for (int a = 0; a < T; ++a) xi[a] = p.xi[a];
  bool last = false;
  Found obstacle = Found::not_converged; // what the iteration met last
  for (p.evaluations = 1; p.evaluations <= max_evaluations; ++p.evaluations) {
    const bool first = p.evaluations == 1;
    double next[T], merit = 0.0;
    bool ok = normal ? evaluate_surface<2>(g, xi, p.N, p.s) : evaluate_surface<1>(g, xi, p.N, p.s);
    if (ok && normal) ok = normal_step(p, next, merit);
    if (!ok) {
      obstacle = Found::degenerate;
    } else if (!normal && !shadow_step(p, t, next, merit)) {
      obstacle = Found::grazing;
      ok = false;
    }
    if (!ok && (first || last)) return obstacle;
    if (last) {
      for (int a = 0; a < T; ++a) p.xi[a] = xi[a];
      return Found::yes;
    }
    // rounding keeps the merit from falling below (eps size)^2
    double floor = 1e-26 * dot(p.s.a[0], p.s.a[0]);
    if constexpr (T == 2) floor += 1e-26 * dot(p.s.a[1], p.s.a[1]);
    if (ok && (first || merit <= previous_merit * (1.0 + 1e-12) + floor)) {
      for (int a = 0; a < T; ++a) {
        p.xi[a] = xi[a];
        step[a] = next[a];
      }
      obstacle = Found::not_converged;
      const double length = max_norm(step);
      if (!(length < 1e30)) return Found::not_converged;
      if (length <= 1e-15) return Found::yes;
      // Quadratic convergence: the error after this step is about (l / l_before^2) l^2; ten times that below
      // rounding makes this the last step. A flat plain segment is solved by its first step.
      constexpr bool linear = is_flat<B> && !H;
      if (linear || length <= 1e-13 || is_rounding(p, step) ||
          (length < 1e-4 && 10.0 * length * length * length <= 1e-16 * previous_length * previous_length))
        last = true;
      else if (length > max_step)
        for (int a = 0; a < T; ++a) step[a] *= max_step / length;
      previous_length = length;
      previous_merit = merit;
    } else { // back to the last good point, with half the step
      for (int a = 0; a < T; ++a) step[a] *= 0.5;
      previous_length = 0.0;
      if (max_norm(step) < 1e-14) return obstacle;
    }
    for (int a = 0; a < T; ++a) xi[a] = p.xi[a] + step[a];
    if (!last && max_norm(xi) > far_outside) return Found::escaped;
  }
  return obstacle;
}

// Natural coordinates by which xi lies beyond the edges of the segment; 0 on it.
template <class B> ENTS_INLINE double beyond_segment(const B& basis, const double (&xi)[B::dim - 1]) {
  double most = 0.0;
  if (is_simplex(basis)) {
    const double last = xi[B::dim - 2];
    for (const double x : {-xi[0], -last, xi[0] + last - 1.0}) most = x > most ? x : most;
  } else {
    const double x = max_norm(xi) - 1.0;
    most = x > 0.0 ? x : 0.0;
  }
  return most;
}

// Is xi on the segment? The border keeps a node on a common edge from falling between two segments.
template <class B>
ENTS_INLINE bool on_segment(const B& basis, const double (&xi)[B::dim - 1], double border) {
  return beyond_segment(basis, xi) <= border;
}

} // namespace ents::ENTS_ISA
