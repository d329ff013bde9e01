// SPDX-License-Identifier: BSD-3-Clause
// The point of a segment's border (its end points in the plane, its edges in space) that is closest to a
// point, found by branch and bound along each edge with the bounds of net.hpp.
#pragma once

#include "core/projection/branch_and_bound.hpp"

namespace ents::ENTS_ISA {

// An edge in natural coordinates: xi = middle + along w, -1 <= w <= 1.
struct Edge {
  double middle[2], along[2];
};
template <class B> ENTS_INLINE constexpr int edge_count(const B& basis) {
  return B::dim == 2 ? 2 : is_simplex(basis) ? 3 : 4;
}
template <class B> ENTS_INLINE Edge edge_of_segment(const B& basis, int e) {
  if (is_simplex(basis)) {
    if (e == 2) return {{0.5, 0.5}, {-0.5, 0.5}};
    return e == 0 ? Edge{{0.5, 0.0}, {0.5, 0.0}} : Edge{{0.0, 0.5}, {0.0, 0.5}};
  }
  const double side = e < 2 ? -1.0 : 1.0;
  return e % 2 == 0 ? Edge{{0.0, side}, {1.0, 0.0}} : Edge{{side, 0.0}, {0.0, 1.0}};
}

// Edges that are straight, without the height.
template <class B> inline constexpr bool straight_edges = is_flat<B> || std::is_same_v<B, Quad4>;

// The best point of the border so far.
template <class B, bool H> struct ClosestOnBorder {
  static constexpr int D = B::dim, T = D - 1;
  const Geometry<B>& g;
  double height_bound, limit; // points farther than `limit` do not matter
  Edge edge{};
  int best_edge = -1; // -1: none within the limit
  double best_w = 0.0;

  ENTS_INLINE double distance(double w) const {
    double xi[T];
    for (int a = 0; a < T; ++a) xi[a] = edge.middle[a] + edge.along[a] * w;
    Shape<double, T, B::nodes> N;
    Surface<B, H, double> s;
    if (!evaluate_surface<1>(g, xi, N, s) && H) return no_bound;
    return square_root(dot(s.d, s.d));
  }
  ENTS_INLINE void consider(int e, double w, double at) {
    if (at < limit) limit = at, best_edge = e, best_w = w;
  }

  // Does a part of the edge come closer than the limit? Its centre is considered.
  ENTS_NOINLINE bool may_be_closer(const SurfaceRange<1, B, H>& range, int e, double centre, double half) {
    Ball xi[T];
    for (int a = 0; a < T; ++a)
      xi[a] = {edge.middle[a] + edge.along[a] * centre, absolute(edge.along[a]) * half};
    Surface<B, H, Ball> s;
    const bool normal = range(xi, s);
    if (!normal && H) {               // the height is anywhere within its bound
      constexpr double narrow = 1e-3; // without a surface at its centre: an edge that is crushed has none
      const double at = distance(centre);
      consider(e, centre, at);
      return (at < no_bound || half > narrow) && least_length(s.d) - height_bound < limit;
    }
    Vec<double, D> d;
    for (int k = 0; k < D; ++k) d[k] = s.d[k].v;
    const double at = square_root(dot(d, d));
    consider(e, centre, at);
    double least = least_length(s.d);
    if (at > 0.0) {
      Ball slope = 0.0;
      for (int a = 0; a < T; ++a) slope = slope + edge.along[a] * dot((1.0 / at) * d, s.e[a]);
      least = greater(least, at - half * magnitude(slope));
    }
    return least < limit;
  }

  // Of a line: how far one of its ends is, without the height.
  ENTS_INLINE double distance_to_end(int e) const {
    if constexpr (straight_edges<B>) {
      return square_root(dot(g.y[e], g.y[e]));
    } else {
      double xi[T] = {edge.middle[0]};
      Shape<double, T, B::nodes> N;
      g.basis.template shape<0>(xi, N);
      const Vec<double, D> end = combine(N.n, g);
      return square_root(dot(end, end));
    }
  }

  // The point of the chord between the edge's ends, without the height, that is closest: how far it is, and
  // its w.
  ENTS_INLINE double distance_to_chord(int e, double& w) const {
    Vec<double, D> a, ab;
    if constexpr (straight_edges<B>) { // whose ends are nodes
      constexpr int ends[4][2] = {{0, 1}, {0, B::nodes - 1}, {B::simplex ? 1 : 3, 2}, {1, 2}};
      a = g.y[ends[e][0]], ab = g.y[ends[e][1]] - a;
    } else {
      double from[T], to[T];
      for (int k = 0; k < T; ++k)
        from[k] = edge.middle[k] - edge.along[k], to[k] = edge.middle[k] + edge.along[k];
      Shape<double, T, B::nodes> N;
      g.basis.template shape<0>(from, N);
      a = combine(N.n, g);
      g.basis.template shape<0>(to, N);
      ab = combine(N.n, g) - a;
    }
    const double length2 = dot(ab, ab);
    const double t = length2 > 0.0 ? clamp(-dot(a, ab) / length2, 0.0, 1.0) : 0.0;
    add_scaled(a, t, ab);
    w = 2.0 * t - 1.0;
    return square_root(dot(a, a));
  }

  // How far the edge departs from its chord, without the height: half of the largest |rho_,ww|, a polynomial
  // of degree two at most, which is bounded by its Bernstein coefficients.
  ENTS_INLINE double sag() const {
    Vec<double, D> bend[3];
    for (int i = 0; i < 3; ++i) {
      double xi[T];
      for (int a = 0; a < T; ++a) xi[a] = edge.middle[a] + edge.along[a] * (i - 1);
      Shape<double, T, B::nodes> N;
      g.basis.template shape<2>(xi, N);
      bend[i] = Vec<double, D>::zero();
      unroll<symmetric_size<T>>([&](auto k) ENTS_LAMBDA_INLINE {
        constexpr int a = k / 2, b = (k + 1) / 2;
        if constexpr (B::second[k])
          add_scaled(bend[i], (a == b ? 1.0 : 2.0) * edge.along[a] * edge.along[b], combine(N.d2[k], g));
      });
    }
    const Vec<double, D> inner = 2.0 * bend[1] - 0.5 * (bend[0] + bend[2]);
    return 0.5 *
           square_root(greater(greater(dot(bend[0], bend[0]), dot(bend[2], bend[2])), dot(inner, inner)));
  }

  ENTS_NOINLINE void search_edge(int e) {
    const SurfaceRange<1, B, H> range(g, 0.0);
    constexpr double smallest = 1e-6; // half-width: the distance is then known to the square of it
    struct Part {
      double centre, half;
    };
    Part waiting[64];
    waiting[0] = {0.0, 1.0};
    int count = 1;
    while (count > 0) {
      const Part now = waiting[--count];
      if (!may_be_closer(range, e, now.centre, now.half) || now.half < smallest) continue;
      const double half = 0.5 * now.half;
      waiting[count++] = {now.centre - half, half};
      waiting[count++] = {now.centre + half, half};
    }
    for (const double end : {-1.0, 1.0}) consider(e, end, distance(end));
    if (best_edge != e) return;
    // the golden section round the best part
    constexpr double golden = 0.6180339887498949;
    double low = greater(best_w - 4.0 * smallest, -1.0), high = lesser(best_w + 4.0 * smallest, 1.0);
    for (int i = 0; i < 30; ++i) {
      const double left = high - golden * (high - low), right = low + golden * (high - low);
      const double at_left = distance(left), at_right = distance(right);
      consider(e, left, at_left), consider(e, right, at_right);
      (at_left < at_right ? high : low) = at_left < at_right ? right : left;
    }
  }
};

template <class B, bool H>
bool closest_border_point(const Plan& plan, const double* from, const double* master,
                          const double* surface_coordinates, double limit, BorderPoint& out) {
  constexpr int T = B::dim - 1;
  Geometry<B> g(basis_of<B>(plan.basis));
  g.set(from, master);
  g.surface_coordinates = surface_coordinates ? surface_coordinates : plan.surface_coordinates;
  g.height = plan.height;
  ClosestOnBorder<B, H> closest{g, plan.height_bound, limit};
  for (int e = 0; e < edge_count(g.basis); ++e) {
    if constexpr (T == 1) {
      closest.edge = {{2.0 * e - 1.0, 0.0}, {0.0, 0.0}};
      const double base = closest.distance_to_end(e);
      if constexpr (!H)
        closest.consider(e, 0.0, base);
      else if (base - plan.height_bound < closest.limit)
        closest.consider(e, 0.0, closest.distance(0.0));
    } else {
      closest.edge = edge_of_segment(g.basis, e);
      double w, chord = closest.distance_to_chord(e, w);
      if constexpr (straight_edges<B> && !H) {
        closest.consider(e, w, chord);
      } else { // most are too far, whatever their course
        if constexpr (H) chord -= plan.height_bound;
        if constexpr (!straight_edges<B>)
          if (!(chord < closest.limit)) chord -= closest.sag();
        if (chord < closest.limit) closest.search_edge(e);
      }
    }
  }
  const int e = closest.best_edge;
  if (e < 0) return false;
  constexpr double at_end = 1.0 - 1e-6;
  out.distance = closest.limit;
  out.corner = T == 2 && absolute(closest.best_w) > at_end;
  Edge edge = {{2.0 * e - 1.0, 0.0}, {0.0, 0.0}};
  if constexpr (T == 2) edge = edge_of_segment(g.basis, e);
  const double w = !out.corner ? closest.best_w : closest.best_w < 0.0 ? -1.0 : 1.0;
  for (int a = 0; a < 2; ++a) out.xi[a] = edge.middle[a] + edge.along[a] * w;
  return true;
}

} // namespace ents::ENTS_ISA
