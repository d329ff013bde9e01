// SPDX-License-Identifier: BSD-3-Clause
// The enriched segment as the Newton iteration of its projection sees it: what does not depend on xi is contracted once, and what
// the basis does not have is not computed.
//
//   flat (line2, tri3)   n and A are constant: the iteration knows xi, h and the distance from the plane only
//   quad4                rho and a_1 x a_2 are bilinear and linear in xi
//   others               shape functions
//
// n_,a and n_,ab follow from m = a_1 x a_2 (2D: the tangent turned by 90 degrees), n = m / |m|:
//   |m| n_,a  = m_,a - n (n . m_,a)
//   |m| n_,ab = m_,ab - n_,a (n . m_,b) - n_,b (n . m_,a) - n (n_,a . m_,b + n . m_,ab)
#pragma once

#include "core/lanes.hpp"
#include "core/surface.hpp"

namespace ents::ENTS_ISA {

// Positions are relative to the slave node.
template <class B, class S> struct PairNodes {
  static constexpr int T = B::dim - 1;
  Vec<S, B::dim> y[B::nodes];
  S coordinates[(B::dim - 1) * B::nodes];
  bool has_coordinates;     // else s = xi
  const HeightNode* height; // enriched

  template <int Order>
  ENTS_INLINE void evaluate_height(const S (&xi)[T], const Shape<S, T, B::nodes>& N, HeightJet<T, S>& h) const {
    if (has_coordinates) {
      evaluate_height_by_xi<B, Order>(*height, coordinates, xi, N, h);
    } else { // number by number: as a whole it would go through memory
      const HeightJet<T, S> jet = evaluate_height_here(*height, xi);
      h.h = jet.h;
      for (int a = 0; a < T; ++a) h.h1[a] = jet.h1[a];
      for (int k = 0; k < symmetric_size<T>; ++k) h.h2[k] = jet.h2[k];
    }
  }
  // `at`, in `d` its derivative along a direction
  ENTS_INLINE void height_along(const S (&xi)[T], const S (&direction)[T], const Shape<Dual<S>, T, B::nodes>& N, const HeightJet<T, S>& at,
                                HeightJet<T, Dual<S>>& h) const {
    if (!has_coordinates) {
      h = jet_along(*height, xi, direction, at);
      return;
    }
    Dual<S> moving[T];
    for (int a = 0; a < T; ++a) moving[a] = Dual<S>(xi[a], direction[a]);
    evaluate_height_by_xi<B, 2>(*height, coordinates, moving, N, h);
  }
};

template <class S, int D, int M> ENTS_INLINE Vec<S, D> weighted_sum(const S (&w)[M], const Vec<S, D> (&y)[M]) {
  Vec<S, D> v = w[0] * y[0];
  for (int i = 1; i < M; ++i) add_scaled(v, w[i], y[i]);
  return v;
}

// m = normal_of_tangents(a) and its derivatives
template <class S, int D> struct AreaVector {
  Vec<S, D> m, m1[D - 1], m2[symmetric_size<D - 1>];
};

// rho - x_s and its derivatives
template <class B, class S> struct Rho {
  static constexpr int D = B::dim, T = D - 1, K = symmetric_size<T>;
  static constexpr bool linear_area = false; // m_,ab = 0?
  ENTS_INLINE explicit Rho(const PairNodes<B, S>&) {}

  // s.d = x_s - rho, tangents, curvatures; Order 3: third derivatives, too
  template <int Order, bool H>
  ENTS_INLINE void evaluate(const PairNodes<B, S>& nodes, const S (&xi)[T], Shape<S, T, B::nodes>& N, Surface<B, H, S>& s) const {
    B::template shape<Order>(xi, N);
    s.d = -weighted_sum(N.n, nodes.y);
    for (int a = 0; a < T; ++a) s.a[a] = weighted_sum(N.d1[a], nodes.y);
    unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (B::second[k]) s.a2[k] = weighted_sum(N.d2[k], nodes.y);
      else s.a2[k] = Vec<S, D>::zero();
    });
    if constexpr (Order > 2)
      unroll<T == 1 ? 1 : 4>([&](auto k) ENTS_LAMBDA_INLINE {
        if constexpr (B::third[k]) s.a3[k] = weighted_sum(N.d3[k], nodes.y);
        else s.a3[k] = Vec<S, D>::zero();
      });
  }
  template <bool H> static ENTS_INLINE void area_vector(const Surface<B, H, S>& s, AreaVector<S, D>& v) {
    v.m = normal_of_tangents(s.a);
    if constexpr (T == 1) {
      v.m1[0] = normal_of_tangents(s.a2);
      const Vec<S, D> third[1] = {s.a3[0]};
      v.m2[0] = normal_of_tangents(third);
    } else {
      v.m1[0] = cross(s.a2[0], s.a[1]) + cross(s.a[0], s.a2[1]);
      v.m1[1] = cross(s.a2[1], s.a[1]) + cross(s.a[0], s.a2[2]);
      v.m2[0] = (cross(s.a3[0], s.a[1]) + cross(s.a[0], s.a3[1])) + S(2.0) * cross(s.a2[0], s.a2[1]);
      v.m2[1] = (cross(s.a3[1], s.a[1]) + cross(s.a[0], s.a3[2])) + cross(s.a2[0], s.a2[2]);
      v.m2[2] = (cross(s.a3[2], s.a[1]) + cross(s.a[0], s.a3[3])) + S(2.0) * cross(s.a2[1], s.a2[2]);
    }
  }
};

template <class S> struct Rho<Quad4, S> {
  static constexpr bool linear_area = true;
  Vec<S, 3> c, c1, c2, c12; // rho - x_s = c + c1 xi_1 + c2 xi_2 + c12 xi_1 xi_2
  ENTS_INLINE explicit Rho(const PairNodes<Quad4, S>& nodes) {
    const auto& y = nodes.y;
    const Vec<S, 3> sum_1 = y[0] + y[1], sum_2 = y[3] + y[2], difference_1 = y[1] - y[0], difference_2 = y[2] - y[3];
    const S quarter(0.25);
    c = quarter * (sum_1 + sum_2);
    c1 = quarter * (difference_1 + difference_2);
    c2 = quarter * (sum_2 - sum_1);
    c12 = quarter * (difference_2 - difference_1);
  }
  template <int Order, bool H>
  ENTS_INLINE void evaluate(const PairNodes<Quad4, S>& nodes, const S (&xi)[2], Shape<S, 2, 4>& N, Surface<Quad4, H, S>& s) const {
    if (H && nodes.has_coordinates) Quad4::shape<2>(xi, N);
    s.a[0] = c1;
    s.a[1] = c2;
    add_scaled(s.a[0], xi[1], c12);
    add_scaled(s.a[1], xi[0], c12);
    s.d = -c;
    add_scaled(s.d, -xi[0], c1);
    add_scaled(s.d, -xi[1], s.a[1]);
    s.a2[0] = s.a2[2] = Vec<S, 3>::zero();
    s.a2[1] = c12;
  }
  template <bool H> ENTS_INLINE void area_vector(const Surface<Quad4, H, S>& s, AreaVector<S, 3>& v) const {
    v.m = cross(s.a[0], s.a[1]);
    v.m1[0] = cross(c1, c12); // + xi_2 c12 x c12
    v.m1[1] = cross(c12, c2);
  }
};

// a^a
template <class B, bool H, class S> ENTS_INLINE void set_dual_tangents(Surface<B, H, S>& s) {
  constexpr int T = B::dim - 1;
  for (int a = 0; a < T; ++a) {
    s.dual[a] = s.dual_metric[symmetric_index(a, 0)] * s.a[0];
    if constexpr (T == 2) add_scaled(s.dual[a], s.dual_metric[symmetric_index(a, 1)], s.a[1]);
  }
}

// What Newton's method needs at xi: F = d . d / 2, r_a = rho_e,a . d, F_,xixi and A_e.
template <class B, bool H, class S> struct PairProjector {
  static constexpr int D = B::dim, T = D - 1, K = symmetric_size<T>;
  static constexpr bool closed_form = false;
  static constexpr double rounding = 1e-26; // of twice_merit, relative to the square of the distance of a node
  const PairNodes<B, S>& nodes;
  Rho<B, S> rho;
  Shape<S, T, B::nodes> N;
  Surface<B, H, S> s;
  S r[T], metric[K], f2[K], twice_merit;
  S inverse_area2; // enriched

  ENTS_INLINE explicit PairProjector(const PairNodes<B, S>& p) : nodes(p), rho(p) {}

  ENTS_INLINE void evaluate(const S (&xi)[T]) {
    rho.template evaluate<H ? 3 : 2>(nodes, xi, N, s);
    if constexpr (H) {
      AreaVector<S, D> v;
      rho.area_vector(s, v);
      nodes.template evaluate_height<2>(xi, N, s.height);
      const S area2 = dot(v.m, v.m);
      s.area = square_root(area2);
      inverse_area2 = unchecked_inverse(area2);
      const S q = s.area * inverse_area2;
      s.n = q * v.m;
      S along[T];
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
      const S hq = h.h * q;
      unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
        constexpr int a = k / 2, b = (k + 1) / 2;
        S turned = dot(s.n1[a], v.m1[b]);
        if constexpr (!Rho<B, S>::linear_area) turned = turned + dot(s.n, v.m2[k]);
        s.e2[k] = (h.h2[k] - hq * turned) * s.n;
        if constexpr (B::second[k]) s.e2[k] = s.e2[k] + s.a2[k];
        if constexpr (!Rho<B, S>::linear_area) add_scaled(s.e2[k], hq, v.m2[k]);
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
      if constexpr (H || B::second[k]) f2[k] = f2[k] - dot(s.d, s.e2[k]);
    });
    twice_merit = dot(s.d, s.d);
  }

  // The rest of the surface, for the variations. Returns |a|^2 or |a_1 x a_2|^2.
  ENTS_INLINE S finish(const S (&xi)[T]) {
    B::template shape<2>(xi, N);
    if constexpr (H) {
      S base[K];
      for (int k = 0; k < K; ++k) base[k] = dot(s.a[k / 2], s.a[(k + 1) / 2]);
      invert_with(base, inverse_area2, s.dual_metric);
      set_dual_tangents(s);
      return s.area * s.area;
    } else {
      const Vec<S, D> m = normal_of_tangents(s.a);
      return dot(m, m);
    }
  }
};

// Flat segments. With xi_0 the projection on the plane and zeta the distance from it,
//   F = (xi_0 - xi) A (xi_0 - xi) / 2 + (zeta - h)^2 / 2 .
template <class B, bool H, class S>
  requires(is_flat<B>)
struct PairProjector<B, H, S> {
  static constexpr int D = B::dim, T = D - 1, K = symmetric_size<T>;
  static constexpr bool closed_form = !H;
  static constexpr double rounding = 1e-26;
  const PairNodes<B, S>& nodes;
  Shape<S, T, B::nodes> N;
  Surface<B, H, S> s;
  Vec<S, D> offset; // x_s - rho at xi = 0
  S base[K], area2, foot[T], zeta;
  S r[T], metric[K], f2[K], twice_merit;

  ENTS_INLINE explicit PairProjector(const PairNodes<B, S>& p) : nodes(p) {
    if constexpr (T == 1) {
      offset = S(-0.5) * (p.y[0] + p.y[1]);
      s.a[0] = S(0.5) * (p.y[1] - p.y[0]);
    } else {
      offset = -p.y[0];
      for (int a = 0; a < T; ++a) s.a[a] = p.y[a + 1] - p.y[0];
    }
    for (int k = 0; k < K; ++k) {
      base[k] = dot(s.a[k / 2], s.a[(k + 1) / 2]);
      s.a2[k] = Vec<S, D>::zero();
    }
    const Vec<S, D> m = normal_of_tangents(s.a);
    area2 = dot(m, m);
    const S inverse_area2 = unchecked_inverse(area2);
    invert_with(base, inverse_area2, s.dual_metric);
    if constexpr (H) {
      s.area = square_root(area2);
      s.n = (s.area * inverse_area2) * m;
      zeta = dot(s.n, offset);
    }
    S along[T];
    for (int a = 0; a < T; ++a) along[a] = dot(s.a[a], offset);
    for (int a = 0; a < T; ++a) {
      foot[a] = s.dual_metric[symmetric_index(a, 0)] * along[0];
      if constexpr (T == 2) foot[a] = foot[a] + s.dual_metric[symmetric_index(a, 1)] * along[1];
    }
    if constexpr (H) set_dual_tangents(s);
  }

  ENTS_INLINE void evaluate(const S (&xi)[T]) {
    S off[T], lowered[T];
    for (int a = 0; a < T; ++a) off[a] = foot[a] - xi[a];
    for (int a = 0; a < T; ++a) {
      lowered[a] = base[symmetric_index(a, 0)] * off[0];
      if constexpr (T == 2) lowered[a] = lowered[a] + base[symmetric_index(a, 1)] * off[1];
    }
    if (nodes.has_coordinates) B::template shape<2>(xi, N);
    nodes.template evaluate_height<2>(xi, N, s.height);
    const auto& h = s.height;
    const S above = zeta - h.h;
    for (int a = 0; a < T; ++a) r[a] = lowered[a] + h.h1[a] * above;
    for (int k = 0; k < K; ++k) {
      metric[k] = base[k] + h.h1[k / 2] * h.h1[(k + 1) / 2];
      f2[k] = metric[k] - above * h.h2[k];
    }
    twice_merit = above * above;
    for (int a = 0; a < T; ++a) twice_merit = twice_merit + lowered[a] * off[a];
  }

  ENTS_INLINE S finish(const S (&xi)[T]) {
    B::template shape<2>(xi, N);
    s.d = offset;
    for (int a = 0; a < T; ++a) {
      add_scaled(s.d, -xi[a], s.a[a]);
      s.e[a] = s.a[a];
    }
    if constexpr (H) {
      add_scaled(s.d, -s.height.h, s.n);
      for (int a = 0; a < T; ++a) add_scaled(s.e[a], s.height.h1[a], s.n);
      for (int k = 0; k < K; ++k) s.e2[k] = s.height.h2[k] * s.n;
    } else {
      for (int k = 0; k < K; ++k) {
        metric[k] = f2[k] = base[k];
        s.e2[k] = Vec<S, D>::zero();
      }
    }
    return area2;
  }
};

// What Newton's method needs of a quad4, without vectors. With c, c_1, c_2, c_12 of rho - x_s, D = x_s - rho, m = a_1 x a_2 and w = n . D = P / |m|,
//   F = (D . D - 2 h w + h^2) / 2 ,
// D . D, m . m and P = m . D are polynomials: products of c .. c_12 are taken once. (In P all of c_12 . m but a triple product
// vanishes.) `metric` is that of rho.
template <bool H, class S> struct QuadDescent {
  static constexpr double rounding = 1e-13; // twice_merit is a difference of squares of the distance
  const PairNodes<Quad4, S>& nodes;
  S g00, g01, g02, g0x, g11, g12, g1x, g22, g2x, gxx; // c_i . c_j; x: 12
  S p0, p1, p2, px, m00, m01, m02, m11, m12, m22;     // enriched: of P, of m . m
  S r[2], metric[3], f2[3], twice_merit;

  ENTS_INLINE explicit QuadDescent(const PairProjector<Quad4, H, S>& p) : nodes(p.nodes) {
    const auto& [c, c1, c2, c12] = p.rho;
    g00 = dot(c, c), g01 = dot(c, c1), g02 = dot(c, c2), g0x = dot(c, c12);
    g11 = dot(c1, c1), g12 = dot(c1, c2), g1x = dot(c1, c12), g22 = dot(c2, c2), g2x = dot(c2, c12), gxx = dot(c12, c12);
    if constexpr (H) {
      const Vec<S, 3> m = cross(c1, c2), m1 = cross(c1, c12), m2 = cross(c12, c2);
      p0 = dot(c, m), p1 = dot(c, m1), p2 = dot(c, m2), px = dot(c12, m);
      m00 = dot(m, m), m01 = dot(m, m1), m02 = dot(m, m2), m11 = dot(m1, m1), m12 = dot(m1, m2), m22 = dot(m2, m2);
    }
  }

  ENTS_INLINE void evaluate(const S (&xi)[2]) {
    const S x = xi[0], y = xi[1], xy = x * y;
    metric[0] = g11 + y * (2.0 * g1x + y * gxx);
    metric[2] = g22 + x * (2.0 * g2x + x * gxx);
    metric[1] = (g12 + x * g1x) + (y * g2x + xy * gxx);
    const S bend = (g0x + x * g1x) + (y * g2x + xy * gxx);
    const S towards_1 = (g01 + y * g0x) + y * (g12 + y * g2x), towards_2 = (g02 + x * g0x) + x * (g12 + x * g1x); // F_,a at xi_a = 0
    const S F1 = towards_1 + x * metric[0], F2 = towards_2 + y * metric[2];
    const S at_y = g00 + y * (2.0 * g02 + y * g22); // D . D at xi_1 = 0
    twice_merit = at_y + x * (2.0 * towards_1 + x * metric[0]);
    f2[0] = metric[0], f2[1] = metric[1] + bend, f2[2] = metric[2];
    r[0] = -F1, r[1] = -F2;
    if constexpr (H) {
      HeightJet<2, S> h;
      Shape<S, 2, 4> N;
      if (nodes.has_coordinates) Quad4::shape<2>(xi, N);
      nodes.template evaluate_height<2>(xi, N, h);
      const S half_1 = m01 + x * m11 + y * m12, half_2 = m02 + x * m12 + y * m22; // (m . m)_,a / 2
      const S area2 = (m00 + x * m01 + y * m02) + x * half_1 + y * half_2;
      const S q2 = unchecked_inverse(area2), q = square_root(area2) * q2; // neither waits for the other
      const S P1 = y * px - p1, P2 = x * px - p2, P = (y * P2 - p0) - x * p1;
      const S w = q * P, l1 = q2 * half_1, l2 = q2 * half_2;
      const S u1 = q * P1, u2 = q * P2, w1 = u1 - w * l1, w2 = u2 - w * l2;
      const S w11 = w * (3.0 * l1 * l1 - q2 * m11) - 2.0 * u1 * l1;
      const S w22 = w * (3.0 * l2 * l2 - q2 * m22) - 2.0 * u2 * l2;
      const S w12 = w * (3.0 * l1 * l2 - q2 * m12) + (q * px - (u1 * l2 + u2 * l1));
      const S above = w - h.h;
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
template <class B, bool H, class S> struct DescentOf {
  using type = PairProjector<B, H, S>&;
};
template <bool H, class S> struct DescentOf<Quad4, H, S> {
  using type = QuadDescent<H, S>;
};

} // namespace ents::ENTS_ISA
