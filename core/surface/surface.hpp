// SPDX-License-Identifier: BSD-3-Clause
// The enriched surface rho_e = rho + h n and its derivatives by xi, seen from the slave node.
//
// Everything follows from three identities of a surface with tangents a_1, a_2, dual tangents a^1, a^2
// and unit normal n (D stands for a variation by the dofs or for a derivative by xi):
//   D n  = - a^k (n . D a_k)                                            from n . a_k = 0
//   DD'n = - n (Dn . D'n) - a^k (Dn . D'a_k + D'n . Da_k + n . DD'a_k)  the same, once more
// theory.md, section 1, has them, and the same from the area vector a_1 x a_2.
#pragma once

#include "core/height/height.hpp"
#include "core/surface/counted_basis.hpp"

namespace ents::ENTS_ISA {

// At a fold, on a collapsed edge or where all nodes coincide rounding leaves tangents of about 1e-16 of the
// segment's size and of its distance, whose normal points anywhere. The smallest that still have a normal:
inline constexpr double degenerate_size = 1e-12;     // relative to the size of the segment
inline constexpr double degenerate_distance = 2e-15; // relative to its distance from the slave node

// One contact element's geometry. Positions are relative to the slave node: what matters (gap, tangents)
// is then computed from differences, whatever the distance to the host's origin.
template <class Basis> struct Geometry {
  static constexpr int D = Basis::dim, T = D - 1;
  [[no_unique_address]] Basis basis;
  Vec<double, D> y[Basis::nodes];    // x_i - x_s
  const double* surface_coordinates; // [nodes][T] or null: s = xi
  const HeightNode* height;          // null: plain segment
  double smallest_area2;             // of the tangents, squared: below it there is no normal

  ENTS_INLINE explicit Geometry(const Basis& of) : basis(of) {}
  ENTS_INLINE void set(const double* slave, const double* master) {
    const int nodes = node_count(basis);
    for (int i = 0; i < nodes; ++i)
      for (int k = 0; k < D; ++k) y[i][k] = master[D * i + k] - slave[k];
    double size2 = 0.0; // three nodes say how large a segment is
    for (int i = 1; i < (nodes < 3 ? nodes : 3); ++i) {
      const Vec<double, D> r = y[i] - y[0];
      size2 += dot(r, r);
    }
    const double rounding2 = degenerate_distance * degenerate_distance * dot(y[0], y[0]);
    const double smallest2 = degenerate_size * degenerate_size * size2 + rounding2;
    smallest_area2 = (T == 2 ? smallest2 * (size2 + rounding2) : smallest2) + 1e-200;
  }
};

// h and its derivatives by xi
template <class Scalar, int T> using HeightByXi = HeightJet<T, Scalar>;

// Surface at one xi, enriched or plain. Order 1: tangents; 2: curvatures, too.
template <class Basis, bool Enriched, class Scalar> struct Surface {
  static constexpr int D = Basis::dim, T = D - 1, K = symmetric_size<T>;
  using V = Vec<Scalar, D>;

  V a[T], a2[K], a3[T == 1 ? 1 : 4]; // rho_,a rho_,ab rho_,abc (only where the basis has them)
  V n;                               // unit normal of rho
  V dual[T];                         // a^k
  Scalar dual_metric[K];             // a^k . a^l
  Scalar area;                       // |a| or |a_1 x a_2|
  V n1[T];                           // n_,a (enriched, bent basis)
  HeightJet<T, Scalar> height;       // by xi (enriched)

  V d;     // x_s - rho_e
  V e[T];  // rho_e,a
  V e2[K]; // rho_e,ab
};

// The chain rule: of j, h and its derivatives by s, with s_,a and s_,ab
template <int Order, class Basis, int T, class Scalar>
ENTS_INLINE void height_by_xi(const HeightJet<T, Scalar>& j, const Scalar (&s1)[T][T],
                              const Scalar (&s2)[symmetric_size<T>][T], HeightJet<T, Scalar>& out) {
  out.h = j.h;
  for (int a = 0; a < T; ++a) {
    out.h1[a] = j.h1[0] * s1[a][0];
    if constexpr (T == 2) out.h1[a] = out.h1[a] + j.h1[1] * s1[a][1];
  }
  if constexpr (Order > 1)
    unroll<symmetric_size<T>>([&](auto k) ENTS_LAMBDA_INLINE {
      constexpr int a = k / 2, b = (k + 1) / 2; // 11, 12, 22
      Scalar v = j.h2[0] * (s1[a][0] * s1[b][0]);
      if constexpr (T == 2)
        v = v + j.h2[1] * (s1[a][0] * s1[b][1] + s1[a][1] * s1[b][0]) + j.h2[2] * (s1[a][1] * s1[b][1]);
      if constexpr (Basis::second[k])
        for (int t = 0; t < T; ++t) v = v + j.h1[t] * s2[k][t];
      out.h2[k] = v;
    });
}

// h(s(xi)). coordinates: [nodes][T], or null: s = xi; height(s): h and its derivatives by s
template <int Order, class Basis, class Height, class Scalar, class C>
ENTS_INLINE void evaluate_height_by_xi(const Basis& basis, Height&& height, const C* coordinates,
                                       const Scalar (&xi)[Basis::dim - 1],
                                       const Shape<Scalar, Basis::dim - 1, Basis::nodes>& N,
                                       HeightJet<Basis::dim - 1, Scalar>& out) {
  constexpr int T = Basis::dim - 1, K = symmetric_size<T>;
  const int nodes = node_count(basis);
  if (!coordinates) {
    out = height(xi);
    return;
  }
  Scalar s[T], s1[T][T], s2[K][T]; // s, s_,a, s_,ab
  const C* c = coordinates;
  C relative[is_range<Scalar> ? T * Basis::nodes : 1];
  if constexpr (is_range<Scalar>) { // sum N_i = 1: of differences, or the ranges of N_i would grow with the
                                    // distance from s = 0
    for (int i = 0; i < T * nodes; ++i) relative[i] = coordinates[i] - coordinates[i % T];
    c = relative;
  }
  for (int t = 0; t < T; ++t) {
    s[t] = N.n[0] * c[t];
    for (int i = 1; i < nodes; ++i) s[t] = s[t] + N.n[i] * c[T * i + t];
    for (int a = 0; a < T; ++a) {
      s1[a][t] = N.d1[a][0] * c[t];
      for (int i = 1; i < nodes; ++i) s1[a][t] = s1[a][t] + N.d1[a][i] * c[T * i + t];
    }
    if constexpr (Order > 1)
      unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
        if constexpr (Basis::second[k]) {
          s2[k][t] = N.d2[k][0] * c[t];
          for (int i = 1; i < nodes; ++i) s2[k][t] = s2[k][t] + N.d2[k][i] * c[T * i + t];
        }
      });
  }
  if constexpr (is_range<Scalar>)
    for (int t = 0; t < T; ++t) s[t] = s[t] + coordinates[t];
  height_by_xi<Order, Basis>(height(s), s1, s2, out);
}

// sum_i w_i y_i of the nodes
template <class Basis, class Scalar>
ENTS_INLINE Vec<Scalar, Basis::dim> combine(const Scalar (&w)[Basis::nodes], const Geometry<Basis>& g) {
  constexpr int D = Basis::dim;
  const int nodes = node_count(g.basis);
  Vec<Scalar, D> v;
  for (int k = 0; k < D; ++k) {
    v[k] = w[0] * g.y[0][k];
    for (int i = 1; i < nodes; ++i) v[k] = v[k] + w[i] * g.y[i][k];
  }
  return v;
}

// The curvature of rho_e needs one derivative more of rho than that of rho: n_,ab contains rho_,abc.
template <class Basis, bool Enriched> inline constexpr bool bent_below = Enriched && !is_flat<Basis>;

// The rest of the surface from rho_,a, rho_,ab, rho_,abc and d = x_s - rho. by_xi(height): h and its derivatives by xi
template <int Order, class Basis, bool Enriched, class Scalar, class Height>
ENTS_INLINE bool complete_surface(const Geometry<Basis>& g, Height&& by_xi,
                                  Surface<Basis, Enriched, Scalar>& s) {
  constexpr int D = Basis::dim, T = D - 1, K = symmetric_size<T>;
  constexpr bool bent = bent_below<Basis, Enriched>;
  const Vec<Scalar, D> m = normal_of_tangents(s.a);
  const Scalar area2 = dot(m, m);
  Scalar metric[K];
  if constexpr (Enriched) {
    metric[0] = dot(s.a[0], s.a[0]);
    if constexpr (T == 2) {
      metric[1] = dot(s.a[0], s.a[1]);
      metric[2] = dot(s.a[1], s.a[1]);
    }
  }
  if constexpr (!Enriched) {
    for (int a = 0; a < T; ++a) s.e[a] = s.a[a];
    unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (Order > 1 && Basis::second[k])
        s.e2[k] = s.a2[k];
      else
        s.e2[k] = Vec<Scalar, D>::zero();
    });
  }
  if (!(value_of(area2) > g.smallest_area2)) return false;
  s.area = square_root(area2);
  s.n = (1.0 / s.area) * m;

  if constexpr (Enriched) {
    invert(metric, area2, s.dual_metric);
    for (int a = 0; a < T; ++a) {
      s.dual[a] = s.dual_metric[symmetric_index(a, 0)] * s.a[0];
      if constexpr (T == 2) add_scaled(s.dual[a], s.dual_metric[symmetric_index(a, 1)], s.a[1]);
    }
    by_xi(s.height);
    const auto& h = s.height;
    add_scaled(s.d, -h.h, s.n);
    if constexpr (bent) {
      for (int a = 0; a < T; ++a) s.n1[a] = Vec<Scalar, D>::zero();
      unroll<T>([&](auto a) ENTS_LAMBDA_INLINE {
        unroll<T>([&](auto k) ENTS_LAMBDA_INLINE {
          if constexpr (Basis::second[symmetric_index(a, k)])
            add_scaled(s.n1[a], -dot(s.n, s.a2[symmetric_index(a, k)]), s.dual[k]);
        });
      });
    }
    for (int a = 0; a < T; ++a) {
      s.e[a] = s.a[a];
      add_scaled(s.e[a], h.h1[a], s.n);
      if constexpr (bent) add_scaled(s.e[a], h.h, s.n1[a]);
    }
    if constexpr (Order > 1)
      unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
        constexpr int a = k / 2, b = (k + 1) / 2;
        s.e2[k] = h.h2[k] * s.n;
        if constexpr (Basis::second[k]) s.e2[k] = s.e2[k] + s.a2[k];
        if constexpr (bent) {
          add_scaled(s.e2[k], h.h1[a], s.n1[b]);
          add_scaled(s.e2[k], h.h1[b], s.n1[a]);
          Vec<Scalar, D> n2 = -dot(s.n1[a], s.n1[b]) * s.n;
          unroll<T>([&](auto c) ENTS_LAMBDA_INLINE {
            Scalar t = Scalar(0.0);
            if constexpr (Basis::second[symmetric_index(b, c)])
              t = t + dot(s.n1[a], s.a2[symmetric_index(b, c)]);
            if constexpr (Basis::second[symmetric_index(a, c)])
              t = t + dot(s.n1[b], s.a2[symmetric_index(a, c)]);
            if constexpr (Basis::third[a + b + c])
              if (has_third(g.basis, a + b + c)) t = t + dot(s.n, s.a3[a + b + c]);
            add_scaled(n2, -t, s.dual[c]);
          });
          add_scaled(s.e2[k], h.h, n2);
        }
      });
  }
  return true;
}

// Evaluate the surface and the shape functions at xi. Returns false where rho has no normal; a plain surface
// is complete but for it.
template <int Order, class Basis, bool Enriched, class Scalar>
ENTS_INLINE bool evaluate_surface(const Geometry<Basis>& g, const Scalar (&xi)[Basis::dim - 1],
                                  Shape<Scalar, Basis::dim - 1, Basis::nodes>& N,
                                  Surface<Basis, Enriched, Scalar>& s) {
  constexpr int T = Basis::dim - 1, K = symmetric_size<T>;
  constexpr int basis_order = bent_below<Basis, Enriched> || is_range<Scalar> ? Order + 1 : Order;
  g.basis.template shape<basis_order>(xi, N);
  s.d = -combine(N.n, g);
  for (int a = 0; a < T; ++a) s.a[a] = combine(N.d1[a], g);
  if constexpr (basis_order > 1)
    unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (Basis::second[k]) s.a2[k] = combine(N.d2[k], g);
    });
  if constexpr (basis_order > 2)
    unroll<T == 1 ? 1 : 4>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (Basis::third[k])
        if (has_third(g.basis, k)) s.a3[k] = combine(N.d3[k], g);
    });
  if constexpr (is_range<Scalar>) narrow<basis_order>(g.basis, xi, s);
  const auto by_xi = [&](HeightJet<T, Scalar>& height) ENTS_LAMBDA_INLINE {
    const auto height_at = [&](const Scalar(&at)[T])
                               ENTS_LAMBDA_INLINE { return evaluate_height(*g.height, at); };
    evaluate_height_by_xi<Order>(g.basis, height_at, g.surface_coordinates, xi, N, height);
  };
  return complete_surface<Order>(g, by_xi, s);
}

// Unit normal and |area| of rho_e; false where rho_e has no tangent plane.
template <class Basis, bool Enriched, class Scalar>
ENTS_INLINE bool enriched_normal(const Surface<Basis, Enriched, Scalar>& s, Vec<Scalar, Basis::dim>& normal) {
  if constexpr (!Enriched) {
    normal = s.n;
  } else {
    const Vec<Scalar, Basis::dim> m = normal_of_tangents(s.e);
    const Scalar area2 = dot(m, m);
    const double base = value_of(s.area);
    if (!(value_of(area2) > degenerate_size * degenerate_size * base * base)) return false;
    normal = (1.0 / square_root(area2)) * m;
  }
  return true;
}

} // namespace ents::ENTS_ISA
