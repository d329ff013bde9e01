// SPDX-License-Identifier: BSD-3-Clause
// Projection without a start value: sample the segment finely enough for the height's features, start
// Newton's method from the promising samples, keep the best.
//   normal: the closest point.   shadow: the lit point, that is the one nearest to the light along the ray.
// A closer point than the one above the plain projection cannot be farther than that one is, so that only
// a window around it needs samples.
#pragma once

#include "core/plan.hpp"
#include "core/projection.hpp"

namespace ents::ENTS_ISA {

struct Search {
  Found found;
  bool ambiguous;  // a second point is as good within 1e-9 of the segment's size
};

template <class B> ENTS_INLINE void domain_centre(double (&xi)[B::dim - 1]) {
  for (double& x : xi) x = B::simplex ? 1.0 / 3.0 : 0.0;
}

// Half the variation of s across the segment per unit of xi, per surface coordinate.
template <class B> ENTS_INLINE double feature_in_xi(const Geometry<B>& g, const Plan& plan) {
  constexpr int T = B::dim - 1;
  double feature = 1.0;
  for (int t = 0; t < T; ++t) {
    double rate = 1.0;
    if (g.surface_coordinates) {
      double low = g.surface_coordinates[t], high = low;
      for (int i = 1; i < B::nodes; ++i) {
        const double s = g.surface_coordinates[T * i + t];
        low = s < low ? s : low;
        high = s > high ? s : high;
      }
      rate = (B::simplex ? 1.0 : 0.5) * (high - low);
    }
    if (rate * feature > plan.feature_length[t]) feature = plan.feature_length[t] / rate;
  }
  return feature;
}

// Smaller is better: squared distance from the slave (normal) or from the ray (shadow).
template <class B, bool H>
ENTS_INLINE double sample(const Geometry<B>& g, const Target& t, const double (&xi)[B::dim - 1], Projection<B, H>& p) {
  if (!evaluate_surface<1>(g, xi, p.N, p.s)) return 1e300;
  Vec<double, B::dim> off = p.s.d;
  if (t.kind != ProjectionKind::normal) {
    const Vec<double, B::dim> ray = ray_of<B::dim>(t);
    add_scaled(off, -dot(off, ray), ray);
  }
  return dot(off, off);
}

// Rank of a converged projection; smaller is better.
template <class B, bool H> ENTS_INLINE double rank(const Target& t, const Projection<B, H>& p) {
  if (t.kind == ProjectionKind::normal) return square_root(dot(p.s.d, p.s.d));
  return dot(p.s.d, ray_of<B::dim>(t));
}

// Regular samples in a window; Newton from the best local minima among them.
template <class B, bool H>
ENTS_NOINLINE Search search_window(const Geometry<B>& g, const Target& t, const double (&low)[B::dim - 1],
                     const double (&high)[B::dim - 1], const int (&count)[B::dim - 1], Projection<B, H>& best) {
  constexpr int T = B::dim - 1, max_samples = 1024, max_candidates = 8;
  double value[max_samples];
  const int rows = T == 2 ? count[T - 1] : 1;
  const auto place = [&](int i, int j, double(&xi)[T]) {
    xi[0] = low[0] + (high[0] - low[0]) * (i / (count[0] - 1.0));
    if constexpr (T == 2) {
      xi[1] = low[1] + (high[1] - low[1]) * (j / (count[1] - 1.0));
      if (B::simplex && xi[0] + xi[1] > 1.0) {
        const double excess = 0.5 * (xi[0] + xi[1] - 1.0);
        xi[0] -= excess;
        xi[1] -= excess;
      }
    }
  };
  Projection<B, H> p;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < count[0]; ++i) {
      double xi[T];
      place(i, j, xi);
      value[j * count[0] + i] = sample(g, t, xi, p);
    }
  int candidate[max_candidates], candidates = 0;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < count[0]; ++i) {
      const double v = value[j * count[0] + i];
      bool lowest = v < 1e300;
      for (int b = -1; b <= 1 && lowest; ++b)
        for (int a = -1; a <= 1; ++a) {
          const int ii = i + a, jj = j + b;
          if (ii < 0 || jj < 0 || ii >= count[0] || jj >= rows) continue;
          if (value[jj * count[0] + ii] < v) lowest = false;
        }
      if (!lowest) continue;
      int slot = candidates;  // sorted by value, earlier samples first among equals
      while (slot > 0 && value[candidate[slot - 1]] > v) --slot;
      if (slot >= max_candidates) continue;
      candidates += candidates < max_candidates;
      for (int k = candidates - 1; k > slot; --k) candidate[k] = candidate[k - 1];
      candidate[slot] = j * count[0] + i;
    }
  Search result{candidates > 0 ? Found::not_converged : Found::degenerate, false};
  double best_rank = 0.0;
  int evaluations = rows * count[0];
  bool outside = false, best_inside = false;
  for (int k = 0; k < candidates; ++k) {
    place(candidate[k] % count[0], candidate[k] / count[0], p.xi);
    const Found found = project(g, t, p);
    evaluations += p.evaluations;
    if (found == Found::escaped && result.found != Found::yes) {
      outside = true;
      best = p;
    }
    if (found != Found::yes) {
      if (result.found != Found::yes && found != Found::escaped) result.found = found;
      continue;
    }
    const double r = rank(t, p);
    const bool inside = on_segment<B>(p.xi);
    const double tie = 1e-9 * square_root(dot(p.s.a[0], p.s.a[0]));
    if (result.found != Found::yes || (inside && !best_inside) || (inside == best_inside && r < best_rank - tie)) {
      best = p;
      best_rank = r;
      best_inside = inside;
      result = {Found::yes, false};
    } else if (inside == best_inside && r < best_rank + tie) {
      double apart[T];
      for (int a = 0; a < T; ++a) apart[a] = p.xi[a] - best.xi[a];
      if (max_norm(apart) > 1e-6) result.ambiguous = true;
    }
  }
  if (result.found != Found::yes && outside) result.found = Found::escaped;
  best.evaluations = evaluations;
  return result;
}

// The whole segment.
template <class B, bool H>
ENTS_NOINLINE Search search(const Geometry<B>& g, const Target& t, const Plan& plan, Projection<B, H>& p) {
  constexpr int T = B::dim - 1;
  double low[T], high[T];
  int count[T];
  for (int a = 0; a < T; ++a) low[a] = B::simplex ? 0.0 : -1.0, high[a] = 1.0;
  if constexpr (!H) {
    if constexpr (is_flat<B>) {
      domain_centre<B>(p.xi);
      return {project(g, t, p), false};
    }
    for (int a = 0; a < T; ++a) count[a] = 5;
    return search_window(g, t, low, high, count, p);
  } else {
    const double feature = feature_in_xi(g, plan);
    constexpr int most = T == 1 ? 512 : 32;
    // the whole segment if it is cheap, else a window around the projection on the plain segment
    const double per_feature = 2.0;
    if (per_feature * (high[0] - low[0]) / feature + 2.0 > most) {
      Projection<B, false> plain;
      const Found found = search<B, false>(g, t, plan, plain).found;
      double above2 = 1e300, centre[T];
      if (found == Found::yes) {
        for (int a = 0; a < T; ++a) {
          centre[a] = plain.xi[a] < low[a] ? low[a] : (plain.xi[a] > high[a] ? high[a] : plain.xi[a]);
        }
        above2 = sample(g, t, centre, p);
      }
      if (above2 < 1e300) {
        const double above = square_root(above2);
        // distance along the surface per unit of xi, from the shorter tangent and their angle
        double shortest = dot(p.s.a[0], p.s.a[0]);
        if constexpr (T == 2) {
          const double other = dot(p.s.a[1], p.s.a[1]);
          shortest = p.s.area * p.s.area / (shortest > other ? shortest : other);
        }
        double reach = above;
        if (t.kind != ProjectionKind::normal) {  // along the ray the surface may be as far as its height bound
          const double tilt = absolute_dot(plain.s.n, ray_of<B::dim>(t));
          reach = above + plan.height_bound * square_root(1.0 / (tilt * tilt + 1e-12) - 1.0 + 1e-12) + 1e-12;
        }
        const double half = 1.5 * reach / square_root(shortest) + 2.0 * feature;
        for (int a = 0; a < T; ++a) {
          low[a] = centre[a] - half > low[a] ? centre[a] - half : low[a];
          high[a] = centre[a] + half < high[a] ? centre[a] + half : high[a];
        }
      }
    }
    for (int a = 0; a < T; ++a) {
      const double wish = per_feature * (high[a] - low[a]) / feature + 2.0;
      count[a] = wish < most ? (wish < 5.0 ? 5 : static_cast<int>(wish)) : most;
    }
    return search_window(g, t, low, high, count, p);
  }
}

}  // namespace ents::ENTS_ISA
