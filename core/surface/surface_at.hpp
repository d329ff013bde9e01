// SPDX-License-Identifier: BSD-3-Clause
// The enriched segment as the Newton iteration of its projection sees it: what does not depend on xi is
// contracted once, and what the basis does not have is not computed.
//
//   flat (line2, tri3)   n and A are constant: the iteration knows xi, h and the distance from the plane only
//   others               rho as a polynomial of xi (rho.hpp)
//
// n_,a and n_,ab follow from m = a_1 x a_2 (2D: the tangent turned by 90 degrees), n = m / |m|:
//   |m| n_,a  = m_,a - n (n . m_,a)
//   |m| n_,ab = m_,ab - n_,a (n . m_,b) - n_,b (n . m_,a) - n (n_,a . m_,b + n . m_,ab)
#pragma once

#include "core/surface/rho.hpp"

namespace ents::ENTS_ISA {

// a^a
template <class Basis, bool Enriched, class Scalar>
ENTS_INLINE void set_dual_tangents(Surface<Basis, Enriched, Scalar>& s) {
  constexpr int T = Basis::dim - 1;
  for (int a = 0; a < T; ++a) {
    s.dual[a] = s.dual_metric[symmetric_index(a, 0)] * s.a[0];
    if constexpr (T == 2) add_scaled(s.dual[a], s.dual_metric[symmetric_index(a, 1)], s.a[1]);
  }
}

// What Newton's method needs at xi: F = d . d / 2, r_a = rho_e,a . d, F_,xixi and A_e.
template <class Basis, bool Enriched, class Scalar> struct SurfaceAt {
  static constexpr int D = Basis::dim, T = D - 1, K = symmetric_size<T>;
  static constexpr bool closed_form = false;
  static constexpr double rounding =
      1e-26; // of twice_merit, relative to the square of the distance of a node
  const ElementNodes<Basis, Scalar>& nodes;
  Rho<Basis, Scalar> rho;
  Shape<Scalar, T, Basis::nodes> N;
  Surface<Basis, Enriched, Scalar> s;
  SineAt<Scalar> sine;
  Scalar r[T], metric[K], f2[K], twice_merit;
  Scalar inverse_area2; // enriched

  ENTS_INLINE explicit SurfaceAt(const ElementNodes<Basis, Scalar>& p) : nodes(p), rho(p) {}

  ENTS_INLINE void evaluate(const Scalar (&xi)[T]) {
    rho.template evaluate<Enriched ? 3 : 2>(nodes, xi, N, s);
    if constexpr (Enriched) {
      AreaVector<Scalar, D> v;
      rho.area_vector(nodes.basis, s, v);
      nodes.template evaluate_height<2>(xi, N, sine, s.height);
      const Scalar area2 = dot(v.m, v.m);
      s.area = square_root(area2);
      inverse_area2 = unchecked_inverse(area2);
      const Scalar q = s.area * inverse_area2;
      s.n = q * v.m;
      Scalar along[T];
      for (int a = 0; a < T; ++a) {
        along[a] = q * dot(v.m, v.m1[a]);
        s.n1[a] = v.m1[a];
        add_scaled(s.n1[a], -along[a], s.n);
        s.n1[a] = q * s.n1[a];
      }
      const auto& h = s.height;
      add_scaled(s.d, -h.h, s.n);
      for (int a = 0; a < T; ++a) {
        s.e[a] = s.a[a];
        add_scaled(s.e[a], h.h1[a], s.n);
        add_scaled(s.e[a], h.h, s.n1[a]);
      }
      const Scalar hq = h.h * q;
      unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
        constexpr int a = k / 2, b = (k + 1) / 2;
        Scalar turned = dot(s.n1[a], v.m1[b]);
        if constexpr (!Rho<Basis, Scalar>::linear_area) turned = turned + dot(s.n, v.m2[k]);
        s.e2[k] = (h.h2[k] - hq * turned) * s.n;
        if constexpr (Basis::second[k]) s.e2[k] = s.e2[k] + s.a2[k];
        if constexpr (!Rho<Basis, Scalar>::linear_area) add_scaled(s.e2[k], hq, v.m2[k]);
        if constexpr (a == b) {
          add_scaled(s.e2[k], 2.0 * (h.h1[a] - hq * along[a]), s.n1[a]);
        } else {
          add_scaled(s.e2[k], h.h1[a] - hq * along[a], s.n1[b]);
          add_scaled(s.e2[k], h.h1[b] - hq * along[b], s.n1[a]);
        }
      });
    } else {
      for (int a = 0; a < T; ++a) s.e[a] = s.a[a];
      for (int k = 0; k < K; ++k) s.e2[k] = s.a2[k];
    }
    for (int a = 0; a < T; ++a) r[a] = dot(s.e[a], s.d);
    unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
      metric[k] = dot(s.e[k / 2], s.e[(k + 1) / 2]);
      f2[k] = metric[k];
      if constexpr (Enriched || Basis::second[k]) f2[k] = f2[k] - dot(s.d, s.e2[k]);
    });
    twice_merit = dot(s.d, s.d);
  }

  // The rest of the surface, for the variations; N comes when they are asked for. Returns |a|^2 or |a_1 x
  // a_2|^2.
  ENTS_INLINE Scalar finish(const Scalar (&)[T]) {
    if constexpr (Enriched) {
      Scalar base[K];
      for (int k = 0; k < K; ++k) base[k] = dot(s.a[k / 2], s.a[(k + 1) / 2]);
      invert_with(base, inverse_area2, s.dual_metric);
      set_dual_tangents(s);
      return s.area * s.area;
    } else {
      const Vec<Scalar, D> m = normal_of_tangents(s.a);
      return dot(m, m);
    }
  }
};

// Flat segments. With xi_0 the projection on the plane and zeta the distance from it,
//   F = (xi_0 - xi) A (xi_0 - xi) / 2 + (zeta - h)^2 / 2 .
template <class Basis, bool Enriched, class Scalar>
requires(is_flat<Basis>) struct SurfaceAt<Basis, Enriched, Scalar> {
  static constexpr int D = Basis::dim, T = D - 1, K = symmetric_size<T>;
  static constexpr bool closed_form = !Enriched;
  static constexpr double rounding = 1e-26;
  const ElementNodes<Basis, Scalar>& nodes;
  Shape<Scalar, T, Basis::nodes> N;
  Surface<Basis, Enriched, Scalar> s;
  SineAt<Scalar> sine;
  Vec<Scalar, D> offset; // x_s - rho at xi = 0
  Scalar base[K], area2, foot[T], zeta;
  Scalar r[T], metric[K], f2[K], twice_merit;

  ENTS_INLINE explicit SurfaceAt(const ElementNodes<Basis, Scalar>& p) : nodes(p) {
    if constexpr (T == 1) {
      offset = Scalar(-0.5) * (p.y[0] + p.y[1]);
      s.a[0] = Scalar(0.5) * (p.y[1] - p.y[0]);
    } else {
      offset = -p.y[0];
      for (int a = 0; a < T; ++a) s.a[a] = p.y[a + 1] - p.y[0];
    }
    for (int k = 0; k < K; ++k) {
      base[k] = dot(s.a[k / 2], s.a[(k + 1) / 2]);
      s.a2[k] = Vec<Scalar, D>::zero();
    }
    const Vec<Scalar, D> m = normal_of_tangents(s.a);
    area2 = dot(m, m);
    const Scalar inverse_area2 = unchecked_inverse(area2);
    invert_with(base, inverse_area2, s.dual_metric);
    if constexpr (Enriched) {
      s.area = square_root(area2);
      s.n = (s.area * inverse_area2) * m;
      zeta = dot(s.n, offset);
    }
    Scalar along[T];
    for (int a = 0; a < T; ++a) along[a] = dot(s.a[a], offset);
    for (int a = 0; a < T; ++a) {
      foot[a] = s.dual_metric[symmetric_index(a, 0)] * along[0];
      if constexpr (T == 2) foot[a] = foot[a] + s.dual_metric[symmetric_index(a, 1)] * along[1];
    }
    if constexpr (Enriched) set_dual_tangents(s);
  }

  ENTS_INLINE void evaluate(const Scalar (&xi)[T]) {
    Scalar off[T], lowered[T];
    for (int a = 0; a < T; ++a) off[a] = foot[a] - xi[a];
    for (int a = 0; a < T; ++a) {
      lowered[a] = base[symmetric_index(a, 0)] * off[0];
      if constexpr (T == 2) lowered[a] = lowered[a] + base[symmetric_index(a, 1)] * off[1];
    }
    if (nodes.has_coordinates) nodes.basis.template shape<2>(xi, N);
    nodes.template evaluate_height<2>(xi, N, sine, s.height);
    const auto& h = s.height;
    const Scalar above = zeta - h.h;
    for (int a = 0; a < T; ++a) r[a] = lowered[a] + h.h1[a] * above;
    for (int k = 0; k < K; ++k) {
      metric[k] = base[k] + h.h1[k / 2] * h.h1[(k + 1) / 2];
      f2[k] = metric[k] - above * h.h2[k];
    }
    twice_merit = above * above;
    for (int a = 0; a < T; ++a) twice_merit = twice_merit + lowered[a] * off[a];
  }

  ENTS_INLINE Scalar finish(const Scalar (&xi)[T]) {
    s.d = offset;
    for (int a = 0; a < T; ++a) {
      add_scaled(s.d, -xi[a], s.a[a]);
      s.e[a] = s.a[a];
    }
    if constexpr (Enriched) {
      add_scaled(s.d, -s.height.h, s.n);
      for (int a = 0; a < T; ++a) add_scaled(s.e[a], s.height.h1[a], s.n);
      for (int k = 0; k < K; ++k) s.e2[k] = s.height.h2[k] * s.n;
    } else {
      for (int k = 0; k < K; ++k) {
        metric[k] = f2[k] = base[k];
        s.e2[k] = Vec<Scalar, D>::zero();
      }
    }
    return area2;
  }
};

// What Newton's method needs of a quad4, without vectors. With c, c_1, c_2, c_12 of rho - x_s, D = x_s - rho,
// m = a_1 x a_2 and w = n . D = P / |m|,
//   F = (D . D - 2 h w + h^2) / 2 ,
// D . D, m . m and P = m . D are polynomials: products of c .. c_12 are taken once. (In P all of c_12 . m but
// a triple product vanishes.) `metric` is that of rho.
template <bool Enriched, class Scalar> struct QuadDescent {
  static constexpr double rounding = 1e-13; // twice_merit is a difference of squares of the distance
  const ElementNodes<Quad4, Scalar>& nodes;
  SineAt<Scalar>& sine;
  Scalar g00, g01, g02, g0x, g11, g12, g1x, g22, g2x, gxx; // c_i . c_j; x: 12
  Scalar p0, p1, p2, px, m00, m01, m02, m11, m12, m22;     // enriched: of P, of m . m
  Scalar r[2], metric[3], f2[3], twice_merit;

  ENTS_INLINE explicit QuadDescent(SurfaceAt<Quad4, Enriched, Scalar>& p) : nodes(p.nodes), sine(p.sine) {
    const auto& [c, c1, c2, c12] = p.rho;
    g00 = dot(c, c), g01 = dot(c, c1), g02 = dot(c, c2), g0x = dot(c, c12);
    g11 = dot(c1, c1), g12 = dot(c1, c2), g1x = dot(c1, c12), g22 = dot(c2, c2), g2x = dot(c2, c12),
    gxx = dot(c12, c12);
    if constexpr (Enriched) {
      const Vec<Scalar, 3> m = cross(c1, c2), m1 = cross(c1, c12), m2 = cross(c12, c2);
      p0 = dot(c, m), p1 = dot(c, m1), p2 = dot(c, m2), px = dot(c12, m);
      m00 = dot(m, m), m01 = dot(m, m1), m02 = dot(m, m2), m11 = dot(m1, m1), m12 = dot(m1, m2),
      m22 = dot(m2, m2);
    }
  }

  ENTS_INLINE void evaluate(const Scalar (&xi)[2]) {
    const Scalar x = xi[0], y = xi[1], xy = x * y;
    metric[0] = g11 + y * (2.0 * g1x + y * gxx);
    metric[2] = g22 + x * (2.0 * g2x + x * gxx);
    metric[1] = (g12 + x * g1x) + (y * g2x + xy * gxx);
    const Scalar bend = (g0x + x * g1x) + (y * g2x + xy * gxx);
    const Scalar towards_1 = (g01 + y * g0x) + y * (g12 + y * g2x),
                 towards_2 = (g02 + x * g0x) + x * (g12 + x * g1x); // F_,a at xi_a = 0
    const Scalar F1 = towards_1 + x * metric[0], F2 = towards_2 + y * metric[2];
    const Scalar at_y = g00 + y * (2.0 * g02 + y * g22); // D . D at xi_1 = 0
    twice_merit = at_y + x * (2.0 * towards_1 + x * metric[0]);
    f2[0] = metric[0], f2[1] = metric[1] + bend, f2[2] = metric[2];
    r[0] = -F1, r[1] = -F2;
    if constexpr (Enriched) {
      HeightJet<2, Scalar> h;
      Shape<Scalar, 2, 4> N;
      if (nodes.has_coordinates) Quad4::shape<2>(xi, N);
      nodes.template evaluate_height<2>(xi, N, sine, h);
      const Scalar half_1 = m01 + x * m11 + y * m12, half_2 = m02 + x * m12 + y * m22; // (m . m)_,a / 2
      const Scalar area2 = (m00 + x * m01 + y * m02) + x * half_1 + y * half_2;
      const Scalar q2 = unchecked_inverse(area2), q = square_root(area2) * q2; // neither waits for the other
      const Scalar P1 = y * px - p1, P2 = x * px - p2, P = (y * P2 - p0) - x * p1;
      const Scalar w = q * P, l1 = q2 * half_1, l2 = q2 * half_2;
      const Scalar u1 = q * P1, u2 = q * P2, w1 = u1 - w * l1, w2 = u2 - w * l2;
      const Scalar w11 = w * (3.0 * l1 * l1 - q2 * m11) - 2.0 * u1 * l1;
      const Scalar w22 = w * (3.0 * l2 * l2 - q2 * m22) - 2.0 * u2 * l2;
      const Scalar w12 = w * (3.0 * l1 * l2 - q2 * m12) + (q * px - (u1 * l2 + u2 * l1));
      const Scalar above = w - h.h;
      twice_merit = twice_merit - h.h * (above + w);
      r[0] = r[0] + (h.h1[0] * above + h.h * w1);
      r[1] = r[1] + (h.h1[1] * above + h.h * w2);
      f2[0] = f2[0] - (h.h2[0] * above + h.h1[0] * (2.0 * w1 - h.h1[0]) + h.h * w11);
      f2[1] = f2[1] - (h.h2[1] * above + (h.h1[0] * (w2 - h.h1[1]) + h.h1[1] * w1) + h.h * w12);
      f2[2] = f2[2] - (h.h2[2] * above + h.h1[1] * (2.0 * w2 - h.h1[1]) + h.h * w22);
    }
  }
};

// What Newton's method asks: the projector itself, or a shorter way to the same numbers
template <class Basis, bool Enriched, class Scalar> struct DescentOf {
  using type = SurfaceAt<Basis, Enriched, Scalar>&;
};
template <bool Enriched, class Scalar> struct DescentOf<Quad4, Enriched, Scalar> {
  using type = QuadDescent<Enriched, Scalar>;
};

} // namespace ents::ENTS_ISA
