// SPDX-License-Identifier: BSD-3-Clause
// Projection without a start value, found by branch and bound: boxes of the segment are halved until each is
// proved to hold no projection better than the best one found, or to hold exactly one, which Newton's method
// then finds.
//   normal: the closest of the projections on the segment.
//   shadow: the lit point, the one nearest to the light along the ray.
// Bounds come from the control nets of the segment (net.hpp) and, for what the height adds, from the kernel's
// own formulae evaluated with balls (ball.hpp). A box is dropped when
//   - all of it is farther from the slave (normal) or from the ray (shadow) than any candidate may be,
//   - the equations of the projection have no root in it (Krawczyk 1969; Moore, Kearfott, Cloud, Introduction
//     to Interval Analysis, 2009, section 8.2), or only roots that are no minimum,
//   - those equations have one root at most and Newton's method has found it.
// What is left when the budget is spent makes the result `ambiguous`: the best that is known, but not
// certain.
#pragma once

#include "core/projection/collapsed_corner.hpp"
#include "core/projection/net.hpp"
#include "core/projection/search.hpp"

namespace ents::ENTS_ISA {

// Rank of a projection; smaller is better.
template <class B, bool H> ENTS_INLINE double rank(const Target& t, const Projection<B, H>& p) {
  if (t.kind == ProjectionKind::normal) return square_root(dot(p.s.d, p.s.d));
  return dot(p.s.d, ray_of<B::dim>(t));
}

inline constexpr double smallest_box = 1e-9; // half-width in natural coordinates
inline constexpr double tie_size = 1e-9;     // of the segment's size

template <int T> struct Box { double c[T], w[T]; };

// Of a flat segment without a height no box is judged.
struct NoRange {
  template <class Geometry> ENTS_INLINE NoRange(const Geometry&, double) {}
};
template <class B, bool H>
using JudgedRange = std::conditional_t<is_flat<B> && !H, NoRange, SurfaceRange<2, B, H>>;

// The best projection so far.
template <class B, bool H> struct Candidates {
  static constexpr int T = B::dim - 1;
  const Geometry<B>& g;
  const JudgedRange<B, H>& range;
  const Target& t;
  Projection<B, H>& best;
  const Plan& plan;
  double wanted; // rank below which a projection matters
  Search result{Found::not_converged, false};
  double best_rank = no_bound, tie = 0.0;
  bool inside = false;
  int evaluations = 0;
  bool no_normal = false;  // somewhere in the last box
  bool degenerate = false; // a box, or what is left of one, without a normal

  // Newton's method from xi, whose result is kept in `p`.
  ENTS_NOINLINE bool attempt(const double (&xi)[T], Projection<B, H>& p) {
    for (int a = 0; a < T; ++a) p.xi[a] = xi[a];
    const Found found = project(g, t, p);
    evaluations += p.evaluations;
    if (found != Found::yes) {
      if (result.found == Found::yes || result.found == Found::escaped) return false;
      result.found = found;
      if (found == Found::escaped) best = p;
      return false;
    }
    if (t.kind == ProjectionKind::normal && !is_minimum(p.f2, p.metric)) return false;
    const bool now_inside = on_segment(g.basis, p.xi, plan.border);
    double r = rank(t, p);
    if (now_inside) r += beyond_segment(g.basis, p.xi) * square_root(dot(p.s.a[0], p.s.a[0]));
    tie = tie_size * square_root(dot(p.s.a[0], p.s.a[0]));
    if (r > wanted) return true;
    if (result.found != Found::yes || (now_inside && !inside) ||
        (now_inside == inside && r < best_rank - tie)) {
      best = p;
      best_rank = r;
      inside = now_inside;
      result = {Found::yes, false};
    } else if (now_inside == inside && r < best_rank + tie) {
      // a place has many natural coordinates where two nodes of a segment are one
      const Vec<double, B::dim> apart = p.s.d - best.s.d;
      const double same = 1e3 * tie;
      if (dot(apart, apart) > same * same)
        result.ambiguous = true;
      else if (r < best_rank)
        best_rank = r, best = p;
    }
    return true;
  }

  // As close to a corner where two nodes are one as natural coordinates make sense the surface is taken as it
  // is there: the projection is known to that part of the segment's size.
  ENTS_NOINLINE bool attempt_next_to_corner(const double (&xi)[T], Projection<B, H>& p) {
    for (int a = 0; a < T; ++a) p.xi[a] = xi[a];
    ++evaluations;
    double step[T], merit;
    if (t.kind != ProjectionKind::normal || !evaluate_surface<2>(g, p.xi, p.N, p.s)) return false;
    normal_step(p, step, merit);
    p.f2[1] = p.metric[1]; // the other part is rounding of a tangent that is nearly zero
    if (!is_minimum(p.f2, p.metric)) return false;
    double off2 = 0.0, size2 = 0.0;
    for (int a = 0; a < T; ++a) {
      const double along = dot(p.s.e[a], p.s.d), length2 = dot(p.s.e[a], p.s.e[a]);
      off2 += along * along / length2;
      size2 = greater(size2, length2);
    }
    const double most = 10.0 * next_to_collapsed_edge<H>;
    if (!(off2 < most * most * size2) || !on_segment(g.basis, p.xi, plan.border)) return false;
    const double r = rank(t, p);
    tie = tie_size * square_root(size2);
    if (r > wanted) return true;
    p.evaluations = 1;
    best = p;
    best_rank = r, inside = true;
    result = {Found::yes, false};
    return true;
  }

  // Nothing with a rank above this matters.
  double limit() const { return inside ? lesser(best_rank + tie, wanted) : wanted; }
};

// Largest change of u . rho_e between the centre and any point of the box, to first and to second order.
template <class B, bool H>
ENTS_INLINE double largest_change(const Surface<B, H, Ball>& s, const Vec<double, B::dim>& u,
                                  const double (&w)[B::dim - 1]) {
  constexpr int T = B::dim - 1;
  double first = 0.0, second = 0.0;
  for (int a = 0; a < T; ++a) {
    const Ball slope = dot(u, s.e[a]);
    first += w[a] * magnitude(slope);
    second += w[a] * absolute(slope.v);
    for (int b = 0; b < T; ++b) second += 0.5 * w[a] * w[b] * magnitude(dot(u, s.e2[symmetric_index(a, b)]));
  }
  return lesser(first, second);
}

// Search of the triangle that a quad4 with the collapsed edge e is, whose nodes are e, e + 2 and e + 3, and
// natural coordinates of the quad4. False: heights that are not the same everywhere are given in natural
// coordinates, or in surface coordinates that differ in the two nodes: then they are not those of a triangle.
template <bool H>
ENTS_NOINLINE bool search_collapsed(const Geometry<Quad4>& g, const Target& t, const Plan& plan, double limit,
                                    int budget, int e, Search& result, double (&xi)[2], int& evaluations) {
  const int nodes[3] = {e, (e + 2) % 4, (e + 3) % 4};
  Geometry<Tri3> triangle{Tri3()};
  double coordinates[6];
  for (int i = 0; i < 3; ++i) triangle.y[i] = g.y[nodes[i]];
  triangle.surface_coordinates = nullptr, triangle.height = g.height,
  triangle.smallest_area2 = g.smallest_area2;
  if constexpr (H)
    if (g.height->kind != HeightKind::constant) {
      const double* s = g.surface_coordinates;
      if (!s || s[2 * e] != s[2 * ((e + 1) % 4)] || s[2 * e + 1] != s[2 * ((e + 1) % 4) + 1]) return false;
      for (int i = 0; i < 6; ++i) coordinates[i] = s[2 * nodes[i / 2] + i % 2];
      triangle.surface_coordinates = coordinates;
    }
  Projection<Tri3, H> p;
  result = search<Tri3, H>(triangle, t, plan, p, limit, budget);
  evaluations = p.evaluations;
  if (result.found != Found::yes) return true;
  const double off = p.xi[0] + p.xi[1]; // 0 in the corner, 1 on the side across
  const bool in_corner = off < 0.5 * next_to_collapsed_edge<H> && off > -0.5 * next_to_collapsed_edge<H>;
  const double beside = in_corner ? 0.0 : 1.0;
  const double along = off > 0.0 ? clamp(p.xi[1] / off, -beside, 1.0 + beside) : 0.5;
  const auto [normal, sign] = across_edge(e);
  const auto coordinate = [&, normal = normal](int node) {
    return 2.0 * (normal == 1 ? Corners::i[node] : Corners::j[node]) - 1.0;
  };
  xi[1 - normal] = coordinate(nodes[1]) + (coordinate(nodes[2]) - coordinate(nodes[1])) * along;
  xi[normal] = sign * (in_corner ? 1.0 - next_to_collapsed_edge<H> : 1.0 - 2.0 * off);
  return true;
}

enum class Verdict { drop, halve };

// What the box may hold. `longest`: the direction to halve; `sign`: on which side to look first.
template <class B, bool H>
ENTS_NOINLINE Verdict judge(const Box<B::dim - 1>& box, Candidates<B, H>& all, Projection<B, H>& p,
                            int& longest, double (&towards)[B::dim - 1]) {
  constexpr int D = B::dim, T = D - 1;
  const Geometry<B>& g = all.g;
  const Target& t = all.t;
  const bool normal = t.kind == ProjectionKind::normal;
  for (double& x : towards) x = 1.0;
  longest = T == 2 && box.w[T - 1] > box.w[0];
  Ball xi[T];
  for (int a = 0; a < T; ++a) xi[a] = {box.c[a], box.w[a]};
  Surface<B, H, Ball> s;
  ++all.evaluations;
  all.no_normal = !all.range(xi, s);
  if (all.no_normal) {
    const Vec<Ball, D> m = normal_of_tangents(s.a);
    const Ball area2 = dot(m, m);
    if (area2.v + area2.r <= g.smallest_area2) { // nowhere in the box
      all.degenerate = true;
      return Verdict::drop;
    }
    // no normal somewhere in the box: the height is anywhere within its bound
    if (H)
      return normal && least_length(s.d) - all.plan.height_bound > all.limit() ? Verdict::drop
                                                                               : Verdict::halve;
  }
  for (int a = 0; a < T; ++a) narrow_by(s.e[a], xi, [&](int b) { return &s.e2[symmetric_index(a, b)]; });
  Vec<double, D> d, e[T];
  for (int k = 0; k < D; ++k) {
    d[k] = s.d[k].v;
    for (int a = 0; a < T; ++a) e[a][k] = s.e[a][k].v;
  }
  if constexpr (T == 2)
    longest = box.w[1] * box.w[1] * dot(e[1], e[1]) > box.w[0] * box.w[0] * dot(e[0], e[0]);

  // distance from the slave, or from the ray
  Vec<double, D> off = d, ray = Vec<double, D>::zero();
  Vec<Ball, D> range = s.d; // of `off`, and along the ray
  Ball along = 0.0;
  if (!normal) {
    ray = ray_of<D>(t);
    add_scaled(off, -dot(d, ray), ray);
    along = dot(ray, s.d);
    for (int k = 0; k < D; ++k) range[k] = s.d[k] - along * ray[k];
    along.r = lesser(along.r, largest_change(s, ray, box.w));
  }
  for (int a = 0; a < T;
       ++a) { // a large box has many slopes of its height: its mean one is that of the segment
    towards[a] = 0.0;
    for (int k = 0; k < D; ++k) towards[a] += off[k] * s.a[a][k].v;
  }
  if (all.inside &&
      !all.no_normal) { // all of it is the place that was found, as next to a corner where two nodes are one
    double away2 = 0.0;
    const double same = 100.0 * all.tie;
    for (int k = 0; k < D; ++k) {
      const double away = absolute(s.d[k].v - all.best.s.d[k]) + s.d[k].r;
      away2 += away * away;
    }
    if (away2 < same * same) return Verdict::drop;
  }
  const double distance = square_root(dot(off, off));
  double far = least_length(range);
  if (distance > 0.0) far = greater(far, distance - largest_change(s, (1.0 / distance) * off, box.w));
  if (far > (normal ? all.limit() : all.tie)) return Verdict::drop;
  if (!normal && along.v - along.r > all.limit()) return Verdict::drop;

  // the equations of the projection, J step = r, scaled so that J = 1 at the centre
  double step[T];
  Ball J[T][T];
  bool minimum = true;
  if (normal) {
    Ball f2[symmetric_size<T>];
    double centre[symmetric_size<T>], metric[symmetric_size<T>];
    for (int k = 0; k < symmetric_size<T>; ++k) {
      const int a = k / 2, b = (k + 1) / 2;
      f2[k] = dot(s.e[a], s.e[b]) - dot(s.d, s.e2[k]);
      centre[k] = f2[k].v;
      metric[k] = dot(e[a], e[b]);
    }
    double r[T];
    for (int a = 0; a < T; ++a) {
      r[a] = dot(e[a], d);
      double change = 0.0;
      for (int b = 0; b < T; ++b) change += magnitude(f2[symmetric_index(a, b)]) * box.w[b];
      if (absolute(r[a]) > change) return Verdict::drop;
    }
    if (f2[0].v + f2[0].r < 0.0 ||
        (T == 2 && f2[symmetric_size<T> - 1].v + f2[symmetric_size<T> - 1].r < 0.0))
      return Verdict::drop;
    const double det = determinant(centre);
    if (!(absolute(det) > 1e-12 * determinant(metric))) return Verdict::halve;
    minimum = is_minimum(centre, metric);
    if (!solve(centre, r, step)) return Verdict::halve;
    double inverse[symmetric_size<T>];
    invert(centre, det, inverse);
    for (int a = 0; a < T; ++a)
      for (int b = 0; b < T; ++b) {
        J[a][b] = inverse[symmetric_index(a, 0)] * f2[symmetric_index(0, b)];
        if constexpr (T == 2) J[a][b] = J[a][b] + inverse[symmetric_index(a, 1)] * f2[symmetric_index(1, b)];
      }
  } else {
    Vec<double, D> onto[T], unused;
    if (!ray_frame(e, ray, onto, unused)) return Verdict::halve;
    for (int a = 0; a < T; ++a) {
      step[a] = dot(onto[a], d);
      for (int b = 0; b < T; ++b) J[a][b] = dot(onto[a], s.e[b]);
    }
  }
  bool unique = true;
  for (int a = 0; a < T; ++a) {
    double spread = 0.0, departure = 0.0;
    for (int b = 0; b < T; ++b) {
      spread += J[a][b].r * box.w[b];
      departure += J[a][b].r;
    }
    if (absolute(step[a]) - spread > box.w[a]) return Verdict::drop;
    unique = unique && departure < 1.0;
  }
  if (!unique) return Verdict::halve;
  if (!minimum) return Verdict::drop;
  double start[T];
  for (int a = 0; a < T; ++a) start[a] = box.c[a] + step[a];
  if (!all.attempt(start, p)) return Verdict::halve;
  for (int a = 0; a < T; ++a)
    if (absolute(p.xi[a] - box.c[a]) > box.w[a] * (1.0 + 1e-9)) return Verdict::halve;
  return Verdict::drop;
}

template <class B, bool H>
Search search(const Geometry<B>& g, const Target& t, const Plan& plan, Projection<B, H>& best, double limit,
              int budget) {
  constexpr int T = B::dim - 1;
  const JudgedRange<B, H> range(g, plan.border);
  Candidates<B, H> all{g, range, t, best, plan, limit};
  Projection<B, H> p;
  Box<T> box;
  domain_centre(g.basis, box.c);
  if constexpr (H) { // the point of the plain segment is a good start on the enriched one
    Projection<B, false> plain;
    for (int a = 0; a < T; ++a) plain.xi[a] = box.c[a];
    if (project(g, t, plain) == Found::yes && on_segment(g.basis, plain.xi, plan.border))
      all.attempt(plain.xi, p);
    all.evaluations += plain.evaluations;
  }
  const int collapsed = collapsed_edge(g);
  if constexpr (std::is_same_v<B, Quad4>)
    if (Search found; collapsed >= 0 && t.kind == ProjectionKind::normal) {
      double xi[T];
      int evaluations = 0;
      if (search_collapsed<H>(g, t, plan, limit, budget, collapsed, found, xi, evaluations) &&
          found.found == Found::yes) {
        all.evaluations += evaluations;
        all.inside = false, all.result = {Found::not_converged, false};
        if (!all.attempt(xi, p) || !all.inside) all.attempt_next_to_corner(xi, p);
        if (all.result.found == Found::yes) {
          all.result.ambiguous = found.ambiguous;
          best.evaluations = all.evaluations;
          return all.result;
        }
      }
    }
  const double rim = plan.border; // as on_segment()
  const bool simplex = is_simplex(g.basis);
  for (int a = 0; a < T; ++a) {
    box.c[a] = simplex ? 0.5 : 0.0;
    box.w[a] = (simplex ? 0.5 : 1.0) + rim;
  }
  // Most plain neighbours of the segment that has the projection are excluded as a whole.
  if constexpr (!H && !is_flat<B>)
    if (int half; collapsed < 0 && limit < no_limit) {
      double towards[T];
      if (judge(box, all, p, half, towards) == Verdict::drop) {
        best.evaluations = all.evaluations;
        return all.result;
      }
    }
  double centre[T];
  domain_centre(g.basis, centre);
  if (!all.inside) all.attempt(centre, p);
  if constexpr (!is_flat<B> || H) {
    if (collapsed >= 0) { // short of the collapsed edge, where there is no normal
      constexpr double left_out = 100.0 * next_to_collapsed_edge<false>;
      const int normal = collapsed % 2 == 0;
      box.c[normal] = (collapsed == 1 || collapsed == 2 ? -0.5 : 0.5) * (rim + left_out);
      box.w[normal] = 1.0 + 0.5 * (rim - left_out);
    }
    constexpr int most_waiting = 128; // halvings of both directions down to the smallest box
    Box<T> waiting[most_waiting];
    waiting[0] = box;
    int count = 1;
    bool certain = true;
    while (count > 0) {
      box = waiting[--count];
      if (simplex && box.c[0] - box.w[0] + box.c[T - 1] - box.w[T - 1] > 1.0 + rim) continue;
      if (all.evaluations > budget) {
        certain = false;
        break;
      }
      int a;
      double towards[T];
      if (judge(box, all, p, a, towards) == Verdict::drop) continue;
      if (box.w[a] < smallest_box || count + 2 > most_waiting) {
        certain = false;
        all.degenerate = all.degenerate || all.no_normal;
        continue;
      }
      box.w[a] *= 0.5;
      Box<T> upper = box;
      box.c[a] -= box.w[a];
      upper.c[a] += box.w[a];
      waiting[count++] = towards[a] > 0.0 ? box : upper;
      waiting[count++] = towards[a] > 0.0 ? upper : box;
    }
    if (!certain) all.result.ambiguous = true;
    if (all.degenerate && all.result.found == Found::not_converged) all.result.found = Found::degenerate;
  }
  best.evaluations = all.evaluations;
  return all.result;
}

} // namespace ents::ENTS_ISA
