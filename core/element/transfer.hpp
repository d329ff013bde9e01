// SPDX-License-Identifier: BSD-3-Clause
// The state of an element whose slave moves on to another segment: points of the master surface (projection,
// anchor) and tangential multipliers as the new segment sees them.
#pragma once

#include "core/element/element.hpp"
#include "core/projection/search.hpp"

namespace ents::ENTS_ISA {

// s(xi) of a segment and its gradient [t][a]
template <class B>
ENTS_INLINE void coordinates_at(const B& basis, const double* c, const double (&xi)[B::dim - 1],
                                double (&s)[B::dim - 1], double (&s1)[B::dim - 1][B::dim - 1]) {
  constexpr int T = B::dim - 1;
  Shape<double, T, B::nodes> N;
  basis.template shape<1>(xi, N);
  const int nodes = node_count(basis);
  for (int t = 0; t < T; ++t) {
    s[t] = 0.0;
    for (int a = 0; a < T; ++a) s1[t][a] = 0.0;
    for (int i = 0; i < nodes; ++i) {
      s[t] += N.n[i] * c[T * i + t];
      for (int a = 0; a < T; ++a) s1[t][a] += N.d1[a][i] * c[T * i + t];
    }
  }
}

// xi with s(xi) = wanted, by Newton's method from the middle; exact after one step for affine s.
template <class B>
ENTS_INLINE bool locate_coordinates(const B& basis, const double* c, const double (&wanted)[B::dim - 1],
                                    double (&xi)[B::dim - 1]) {
  constexpr int T = B::dim - 1;
  domain_centre(basis, xi);
  for (int iteration = 0; iteration < max_evaluations; ++iteration) {
    double s[T], s1[T][T], step[T];
    coordinates_at(basis, c, xi, s, s1);
    for (int t = 0; t < T; ++t) s[t] = wanted[t] - s[t];
    if constexpr (T == 1) {
      if (s1[0][0] == 0.0) return false;
      step[0] = s[0] / s1[0][0];
    } else {
      const double det = s1[0][0] * s1[1][1] - s1[0][1] * s1[1][0];
      if (det == 0.0) return false;
      step[0] = (s1[1][1] * s[0] - s1[0][1] * s[1]) / det;
      step[1] = (s1[0][0] * s[1] - s1[1][0] * s[0]) / det;
    }
    for (int a = 0; a < T; ++a) xi[a] += step[a];
    const double length = max_norm(step);
    if (!(length < 1e6)) return false;
    if (length < 1e-14 * (1.0 + max_norm(xi))) return true;
  }
  return max_norm(xi) < 1e6;
}

// Calls f(ahead) with what the new segment's coordinates may be ahead of the old one's, until it is true:
// zero, then what they are where both segments have a node in the same place: across the seam of a closed
// surface a full turn, say.
template <class B, class F>
ENTS_INLINE bool try_seams(const B& basis, const double* old_master, const double* old_c,
                           const double* new_master, const double* new_c, F&& f) {
  constexpr int D = B::dim, T = D - 1, most = 4;
  double tried[most][T] = {};
  if (f(tried[0])) return true;
  const int nodes = node_count(basis);
  int count = 1;
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j) {
      double apart_by = 0.0, far = 0.0;
      for (int k = 0; k < D; ++k) {
        apart_by += absolute(old_master[D * i + k] - new_master[D * j + k]);
        far += absolute(old_master[D * i + k]) + absolute(new_master[D * j + k]);
      }
      bool same = apart_by <= 1e-14 * far;
      for (int known = 0; known < count && same; ++known) {
        double apart = 0.0, size = 1.0;
        for (int t = 0; t < T; ++t) {
          apart += absolute(new_c[T * j + t] - old_c[T * i + t] - tried[known][t]);
          size += absolute(new_c[T * j + t]) + absolute(old_c[T * i + t]);
        }
        same = apart > 1e-9 * size;
      }
      if (!same || count == most) continue;
      for (int t = 0; t < T; ++t) tried[count][t] = new_c[T * j + t] - old_c[T * i + t];
      if (f(tried[count++])) return true;
    }
  return false;
}

// Where a segment without its height is, seen from the slave.
template <class B, bool H> ENTS_INLINE Vec<double, B::dim> base_of(const Surface<B, H, double>& s) {
  if constexpr (H)
    return s.d + s.height.h * s.n;
  else
    return s.d;
}

// Is xi of the new segment the place that old_xi was on the old one? Beyond its border a segment goes on in
// its own way, and coordinates with a seam between the segments, or the same ones on each, lead elsewhere:
// what counts is how far beyond the borders both are.
template <class B, bool H>
ENTS_INLINE bool is_there(const Geometry<B>& g, const Surface<B, H, double>& old,
                          const double (&old_xi)[B::dim - 1], const double (&xi)[B::dim - 1],
                          Projection<B, H>& p) {
  if (!evaluate_surface<1>(g, xi, p.N, p.s)) return false;
  // `old` is seen from the old segment's first node, the slave of g is rho_e of it
  Vec<double, B::dim> miss = base_of(p.s);
  if constexpr (H) add_scaled(miss, -old.height.h, old.n);
  double size = 0.0, beyond = 0.0;
  for (int a = 0; a < B::dim - 1; ++a) {
    const double before = square_root(dot(old.a[a], old.a[a])), now = square_root(dot(p.s.a[a], p.s.a[a]));
    size = before + now > size ? before + now : size;
    const double length = beyond_segment(g.basis, old_xi) * before + beyond_segment(g.basis, xi) * now;
    beyond = length > beyond ? length : beyond;
  }
  // farther beyond than two segments nobody knows what it goes on as
  const double most = 0.5 * (beyond < 2.0 * size ? beyond : 2.0 * size) + 1e-6 * size;
  return dot(miss, miss) <= most * most;
}

// The closest place of the segment, or of what it goes on as beyond its border: a search of the segment, and
// what is near the projection on the segment without its height.
template <class B, bool H>
ENTS_INLINE bool closest_place(const Plan& plan, const Geometry<B>& g, Projection<B, H>& p) {
  Target t{};
  t.kind = ProjectionKind::normal;
  const bool found = search<B, H>(g, t, plan, p).found == Found::yes;
  Projection<B, false> base;
  domain_centre(g.basis, base.xi);
  if (project(g, t, base) != Found::yes) return found;
  Projection<B, H> near;
  for (int a = 0; a < B::dim - 1; ++a) near.xi[a] = base.xi[a];
  if (project(g, t, near) != Found::yes || !is_minimum(near.f2, near.metric)) return found;
  if (!found || dot(near.s.d, near.s.d) < dot(p.s.d, p.s.d)) p = near;
  return true;
}

template <class B, bool H>
Status transfer_state(const Plan& plan, const double* old_master, const double* old_coordinates,
                      const double* new_master, const double* new_coordinates, const double* state,
                      double* moved) {
  constexpr int D = B::dim, T = D - 1;
  const StateLayout& layout = plan.state;
  const B basis = basis_of<B>(plan.basis);
  const int nodes = node_count(basis);
  if (!all_finite(old_master, D * nodes) || !all_finite(new_master, D * nodes) ||
      (old_coordinates && !all_finite(old_coordinates, T * nodes)) ||
      (new_coordinates && !all_finite(new_coordinates, T * nodes)))
    return Status::non_finite;
  if (!is_state(layout, state)) return Status::bad_state;
  double end[largest_state];
  for (int i = 0; i < layout.size; ++i) end[i] = state[i];
  const bool seen = state[StateLayout::history_at] != static_cast<double>(History::none),
             touches = state[StateLayout::history_at] > static_cast<double>(History::open);
  const int points[3] = {StateLayout::xi_at, layout.anchor_at,
                         layout.wear_at < 0 ? -1 : layout.wear_at + StateLayout::worn_anchor};
  Projection<B, H> from, to;
  for (int which = 0; seen && which < 3; ++which) {
    if (points[which] < 0) continue;
    if (which > 0 && !touches) { // an open slave has no anchor
      if (points[which] != layout.clearance_at)
        for (int a = 0; a < T; ++a) end[points[which] + a] = end[StateLayout::xi_at + a];
      continue;
    }
    const double* old_xi = state + points[which];
    double xi[T];
    Geometry<B> g(basis);
    g.set(old_master, old_master);
    g.surface_coordinates = old_coordinates ? old_coordinates : plan.surface_coordinates;
    g.height = plan.height;
    for (int a = 0; a < T; ++a) from.xi[a] = old_xi[a];
    if (!evaluate_surface<1>(g, from.xi, from.N, from.s)) return Status::degenerate_segment;
    double point[D], s[T], s1[T][T];
    for (int c = 0; c < D; ++c) point[c] = old_master[c] - from.s.d[c];
    g.set(point, new_master);
    g.surface_coordinates = new_coordinates ? new_coordinates : plan.surface_coordinates;
    bool located = old_coordinates && new_coordinates;
    if (located) {
      coordinates_at(basis, old_coordinates, from.xi, s, s1);
      // Of several places the one that is least beyond the border; the first one where that is hardly so.
      double least = 0.0;
      located = false;
      const auto try_at = [&](const double(&ahead)[T]) {
        double wanted[T], there[T];
        for (int t = 0; t < T; ++t) wanted[t] = s[t] + ahead[t];
        if (!locate_coordinates(basis, new_coordinates, wanted, there) ||
            !is_there<B, H>(g, from.s, from.xi, there, to))
          return false;
        const double beyond = beyond_segment(basis, there);
        if (!located || beyond < least) {
          for (int a = 0; a < T; ++a) xi[a] = there[a];
          least = beyond;
        }
        located = true;
        return least < 2.0;
      };
      try_seams(basis, old_master, old_coordinates, new_master, new_coordinates, try_at);
    }
    if (!located) {
      const bool found = closest_place(plan, g, to);
      if (!found && which > 0) return Status::no_projection;
      // Where the next projection starts is no history: a slave that went far may start from the middle.
      if (!found) {
        domain_centre(basis, to.xi);
        if (!touches) end[StateLayout::history_at] = static_cast<double>(History::none);
      }
      for (int a = 0; a < T; ++a) xi[a] = to.xi[a];
    }
    for (int a = 0; a < T; ++a) end[points[which] + a] = xi[a];
    if (which == 1 && layout.multiplier_at >= 0) {
      // the multiplier's spatial vector, lowered with the new tangents
      g.set(new_master, new_master);
      g.surface_coordinates = new_coordinates ? new_coordinates : plan.surface_coordinates;
      Vec<double, D> normal;
      if (!evaluate_surface<1>(g, xi, to.N, to.s) || !enriched_normal(from.s, normal))
        return Status::degenerate_segment;
      double metric[symmetric_size<T>], inverse[symmetric_size<T>], raised[T];
      for (int k = 0; k < symmetric_size<T>; ++k) metric[k] = dot(from.s.e[k / 2], from.s.e[(k + 1) / 2]);
      const double det = determinant(metric);
      if (!(det > 0.0)) return Status::degenerate_segment;
      invert(metric, det, inverse);
      const double* covariant = state + layout.multiplier_at + 1;
      for (int a = 0; a < T; ++a) {
        raised[a] = inverse[symmetric_index(a, 0)] * covariant[0];
        if constexpr (T == 2) raised[a] += inverse[symmetric_index(a, 1)] * covariant[1];
      }
      Vec<double, D> traction = Vec<double, D>::zero();
      for (int a = 0; a < T; ++a) add_scaled(traction, raised[a], from.s.e[a]);
      for (int a = 0; a < T; ++a) end[layout.multiplier_at + 1 + a] = dot(traction, to.s.e[a]);
    }
  }
  double size = 0.0;
  for (int i = 0; i < layout.size; ++i) size += absolute(end[i]);
  if (!(size < 1e300)) return Status::out_of_range;
  for (int i = 0; i < layout.size; ++i) moved[i] = end[i];
  return Status::ok;
}

} // namespace ents::ENTS_ISA
