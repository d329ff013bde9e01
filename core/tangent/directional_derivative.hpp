// SPDX-License-Identifier: BSD-3-Clause
// How the segment changes along a direction y in xi, at fixed nodes: Dual numbers whose derivative is that
// along y, written rather than evaluated, for nearly all of it is known already,
//   (x_s - rho_e)' = - y^b rho_e,b,  rho_e,a' = y^b rho_e,ab,  n' = y^b n_,b,  h' = y^b h_,b ...
// What is new: n_,ab, third derivatives of h and, in F_,xixi', d . rho_e,ab'.
#pragma once

#include "core/surface/surface_at.hpp"

namespace ents::ENTS_ISA {

template <class Basis, bool Enriched, class Scalar> struct DirectionalDerivative {
  static constexpr int D = Basis::dim, T = D - 1, K = symmetric_size<T>;
  static constexpr bool bend_changes = any_third<Basis>(); // y^c rho_,abc, where has_thirds()
  using U = Dual<Scalar>;
  using V = Vec<Scalar, D>;

  const SurfaceAt<Basis, Enriched, Scalar>& p;
  Scalar y[T];
  Surface<Basis, Enriched, U> s; // plain: d and e only
  Scalar f2[K];                  // F_,xixi'

  ENTS_INLINE DirectionalDerivative(const SurfaceAt<Basis, Enriched, Scalar>& projector,
                                    const Scalar (&xi)[T], const Scalar (&direction)[T])
      : p(projector) {
    for (int a = 0; a < T; ++a) y[a] = direction[a];
    if constexpr (!Enriched) {
      if constexpr (is_flat<Basis>)
        move_flat();
      else
        move_plain(xi);
    } else {
      p.nodes.height_along(xi, y, p.s.height, s.height);
      if constexpr (is_flat<Basis>)
        move_height();
      else
        move_enriched(xi);
    }
  }

private:
  // y^b v_b
  template <class X> ENTS_INLINE X along(const X (&v)[T]) const {
    X sum = y[0] * v[0];
    if constexpr (T == 2) sum = sum + y[1] * v[1];
    return sum;
  }
  // y^b rho_,ab
  template <int A> ENTS_INLINE V along_curvature() const {
    if constexpr (T == 1)
      return y[0] * p.s.a2[0];
    else if constexpr (!Basis::second[0])
      return y[1 - A] * p.s.a2[1];
    else
      return y[0] * p.s.a2[A] + y[1] * p.s.a2[A + 1];
  }
  // y^c rho_,abc
  template <int I> ENTS_INLINE V along_third(const V (&third)[T == 1 ? 1 : 4]) const {
    if constexpr (T == 1) {
      return y[0] * third[0];
    } else {
      if (!has_third(p.nodes.basis, I)) return y[1] * third[I + 1];
      if (!has_third(p.nodes.basis, I + 1)) return y[0] * third[I];
      return y[0] * third[I] + y[1] * third[I + 1];
    }
  }
  static ENTS_INLINE Scalar rate_of_product(const V& a, const V& a1, const V& b, const V& b1) {
    return dot(a1, b) + dot(a, b1);
  }

  ENTS_INLINE void move_flat() {
    set_dual(s.d, p.s.d, -along(p.s.a));
    for (int a = 0; a < T; ++a) set_constant(s.e[a], p.s.a[a]);
    for (Scalar& f : f2) f = Scalar(0.0);
  }

  ENTS_INLINE void move_plain(const Scalar (&xi)[T]) {
    const V d1 = -along(p.s.a);
    V third[T == 1 ? 1 : 4];
    const bool changes = has_thirds(p.nodes.basis);
    if constexpr (bend_changes)
      if (changes) p.rho.thirds(p.nodes.basis, xi, third);
    V e1[T];
    set_dual(s.d, p.s.d, d1);
    unroll<T>([&](auto a) ENTS_LAMBDA_INLINE {
      e1[a] = along_curvature<a.value>();
      set_dual(s.e[a], p.s.a[a], e1[a]);
    });
    unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
      constexpr int a = k / 2, b = (k + 1) / 2;
      f2[k] = rate_of_product(p.s.a[a], e1[a], p.s.a[b], e1[b]);
      if constexpr (Basis::second[k]) f2[k] = f2[k] - dot(d1, p.s.a2[k]);
      if constexpr (bend_changes && Basis::second[k])
        if (changes) f2[k] = f2[k] - dot(p.s.d, along_third<k.value>(third));
    });
  }

  // e = a + grad h n over a plane
  ENTS_INLINE void move_height() {
    const auto& h = s.height;
    set_dual(s.d, p.s.d, -along(p.s.e));
    set_constant(s.n, p.s.n);
    for (int a = 0; a < T; ++a) {
      set_constant(s.a[a], p.s.a[a]);
      set_constant(s.dual[a], p.s.dual[a]);
      set_dual(s.e[a], p.s.e[a], h.h1[a].d * p.s.n);
    }
    const Scalar above = p.zeta - h.h.v;
    for (int k = 0; k < K; ++k) {
      s.dual_metric[k] = U(p.s.dual_metric[k]);
      const U &h_a = h.h1[k / 2], &h_b = h.h1[(k + 1) / 2];
      f2[k] = (h_a.d * h_b.v + h_a.v * h_b.d) + (h.h.d * h.h2[k].v - above * h.h2[k].d);
    }
  }

  // rho_,a, rho_,ab and the area vector m
  ENTS_INLINE void move_base(const Scalar (&xi)[T], AreaVector<U, D>& v) {
    unroll<T>([&](auto a) ENTS_LAMBDA_INLINE { set_dual(s.a[a], p.s.a[a], along_curvature<a.value>()); });
    if constexpr (Rho<Basis, Scalar>::linear_area) {
      for (int k = 0; k < K; ++k) set_constant(s.a2[k], p.s.a2[k]);
      AreaVector<Scalar, D> at;
      p.rho.area_vector(p.nodes.basis, p.s, at);
      set_dual(v.m, at.m, along(at.m1));
      for (int a = 0; a < T; ++a) set_constant(v.m1[a], at.m1[a]);
    } else {
      V rate[T == 1 ? 1 : 4]; // y^d rho_,abcd
      const Basis& basis = p.nodes.basis;
      const bool changes = has_thirds(basis);
      if (changes) p.rho.third_rates(basis, xi, y, rate);
      unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
        if (changes)
          set_dual(s.a2[k], p.s.a2[k], along_third<k.value>(p.s.a3));
        else
          set_constant(s.a2[k], p.s.a2[k]);
      });
      unroll<T == 1 ? 1 : 4>([&](auto k) ENTS_LAMBDA_INLINE {
        if (has_third(basis, k))
          set_dual(s.a3[k], p.s.a3[k], rate[k]);
        else
          s.a3[k] = Vec<U, D>::zero();
      });
      Rho<Basis, U>::area_vector(basis, s, v);
    }
  }

  ENTS_INLINE void move_enriched(const Scalar (&xi)[T]) {
    AreaVector<U, D> v;
    move_base(xi, v);
    const auto& h = s.height;
    const auto& at = p.s;
    const Scalar q = unchecked_inverse(at.area);
    const V d1 = -along(at.e), n1 = along(at.n1), &d = at.d, &n = at.n;
    set_dual(s.d, d, d1);
    set_dual(s.n, n, n1);

    // |m| n_,ab = m_,ab - n_,a (n . m_,b) - n_,b (n . m_,a) - n (n_,a . m_,b + n . m_,ab)
    constexpr bool linear = Rho<Basis, Scalar>::linear_area;
    V m1[T], m1_rate[T], n2[K];
    Scalar along_n[T], turned[K];
    for (int a = 0; a < T; ++a) {
      m1[a] = value_of(v.m1[a]);
      if constexpr (!linear) m1_rate[a] = derivative_of(v.m1[a]);
      along_n[a] = dot(n, m1[a]);
    }
    for (int k = 0; k < K; ++k) {
      const int a = k / 2, b = (k + 1) / 2;
      turned[k] = dot(at.n1[a], m1[b]);
      if constexpr (!linear) turned[k] = turned[k] + dot(n, value_of(v.m2[k]));
      n2[k] = -turned[k] * n;
      if constexpr (!linear) n2[k] = n2[k] + value_of(v.m2[k]);
      add_scaled(n2[k], -along_n[b], at.n1[a]);
      add_scaled(n2[k], -along_n[a], at.n1[b]);
      n2[k] = q * n2[k];
    }

    V n1_rate[T], e1[T];
    Scalar d_n1[T], d_n1_rate[T], along_n_rate[T];
    for (int a = 0; a < T; ++a) {
      n1_rate[a] = y[0] * n2[symmetric_index(a, 0)];
      if constexpr (T == 2) add_scaled(n1_rate[a], y[1], n2[symmetric_index(a, 1)]);
      e1[a] = y[0] * at.e2[symmetric_index(a, 0)];
      if constexpr (T == 2) add_scaled(e1[a], y[1], at.e2[symmetric_index(a, 1)]);
      set_dual(s.n1[a], at.n1[a], n1_rate[a]);
      set_dual(s.e[a], at.e[a], e1[a]);
      d_n1[a] = dot(d, at.n1[a]);
      d_n1_rate[a] = dot(d, n1_rate[a]);
      along_n_rate[a] = dot(n1, m1[a]);
      if constexpr (!linear) along_n_rate[a] = along_n_rate[a] + dot(n, m1_rate[a]);
    }
    const Scalar d_n = dot(d, n), d_n_rate = dot(d, n1), area_rate = dot(n, derivative_of(v.m));
    unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
      constexpr int a = k / 2, b = (k + 1) / 2;
      // |m| d . n_,ab'
      const Scalar d_n2 = dot(d, n2[k]);
      Scalar turned_rate = dot(n1_rate[a], m1[b]);
      if constexpr (!linear)
        turned_rate = turned_rate + dot(at.n1[a], m1_rate[b]) + dot(n1, value_of(v.m2[k])) +
                      dot(n, derivative_of(v.m2[k]));
      Scalar third = -(d_n_rate * turned[k] + d_n * turned_rate) - area_rate * d_n2;
      if constexpr (a == b) {
        third = third - 2.0 * (d_n1_rate[a] * along_n[a] + d_n1[a] * along_n_rate[a]);
      } else {
        third = third - (d_n1_rate[a] * along_n[b] + d_n1[a] * along_n_rate[b]);
        third = third - (d_n1_rate[b] * along_n[a] + d_n1[b] * along_n_rate[a]);
      }
      if constexpr (!linear) third = third + dot(d, derivative_of(v.m2[k]));
      // d . rho_e,ab'
      Scalar bend = h.h2[k].d * d_n + h.h2[k].v * d_n_rate + h.h.d * d_n2 + h.h.v * (q * third);
      if constexpr (a == b)
        bend = bend + 2.0 * (h.h1[a].d * d_n1[a] + h.h1[a].v * d_n1_rate[a]);
      else
        bend = bend + (h.h1[a].d * d_n1[b] + h.h1[a].v * d_n1_rate[b]) +
               (h.h1[b].d * d_n1[a] + h.h1[b].v * d_n1_rate[a]);
      if constexpr (bend_changes && Basis::second[k])
        if (has_thirds(p.nodes.basis)) bend = bend + dot(d, derivative_of(s.a2[k]));
      f2[k] = rate_of_product(at.e[a], e1[a], at.e[b], e1[b]) - (dot(d1, at.e2[k]) + bend);
    });

    // a^ab and a^a
    U base[K];
    for (int k = 0; k < K; ++k) base[k] = dot(s.a[k / 2], s.a[(k + 1) / 2]);
    const Scalar q2 = q * q;
    invert_with(base, U(q2, -2.0 * (area_rate * q) * q2), s.dual_metric);
    set_dual_tangents(s);
  }
};

} // namespace ents::ENTS_ISA
