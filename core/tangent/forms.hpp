// SPDX-License-Identifier: BSD-3-Clause
// Linear forms of the dof variations, in the reduced space of the surface fields
//   delta X (X = x_s - rho),  delta a_k (tangents),  delta a_kl (second derivatives),
// and their expansion to the dofs. The dofs enter only here: a form is a few vectors; expanding it
// multiplies them by the shape functions of each node.
//
// For a covector c (n_e, rho_e,a, d, a covector of the ray frame), with c^k = c . a^k:
//   c . p         = c . dX + h c^k (n . da_k)                    p = delta x_s - delta rho_e
//   c . drho_e,a  , p and drho_e,a at fixed xi
//   c . DD'rho_e  = - sum_k (w_k z'_k + z_k w'_k),  w_k = n . da_k
#pragma once

#include "core/surface/surface.hpp"

namespace ents::ENTS_ISA {

// Vectors on delta a_kl, k = 11 | 11, 12, 22: those that the basis has
template <class B, class V> struct OnCurvatures {
  static constexpr int before(int k) {
    int count = 0;
    for (int i = 0; i < k; ++i) count += B::second[i];
    return count;
  }
  static constexpr int count = before(symmetric_size<B::dim - 1>);
  V of[count > 0 ? count : 1];
  ENTS_INLINE V& operator[](int k) { return of[before(k)]; }
  ENTS_INLINE const V& operator[](int k) const { return of[before(k)]; }
};

template <class B, class S> struct Form {
  static constexpr int D = B::dim, T = D - 1;
  Vec<S, D> x;                   // on delta X
  Vec<S, D> a[T];                // on delta a_k
  OnCurvatures<B, Vec<S, D>> a2; // on delta a_kl, where the basis bends
};

// Which parts of a form are present (known at compile time).
inline constexpr int on_position = 1, on_tangents = 2, on_curvatures = 4;

// The most dofs of an element: the slave alone when the master is rigid.
template <class B, bool Rigid> inline constexpr int dof_count = Rigid ? B::dim : B::dim*(B::nodes + 1);

// As many of a basis that is counted
template <bool Rigid, class B> ENTS_INLINE constexpr int dofs_of(const B& basis) {
  return Rigid ? B::dim : B::dim * (node_count(basis) + 1);
}
template <class B, bool Rigid> inline constexpr bool counts_dofs = is_counted<B> && !Rigid;

// out[dof] = form applied to the unit variation of that dof
template <bool Rigid, int Parts, class B, class S>
ENTS_INLINE void expand(const B& basis, const Form<B, S>& f, const Shape<S, B::dim - 1, B::nodes>& N,
                        S (&out)[dof_count<B, Rigid>]) {
  constexpr int D = B::dim, T = D - 1, K = symmetric_size<T>;
  for (int c = 0; c < D; ++c) out[c] = (Parts & on_position) ? f.x[c] : S(0.0);
  if constexpr (!Rigid) {
    const int nodes = node_count(basis);
    for (int i = 0; i < nodes; ++i) {
      Vec<S, D> v = Vec<S, D>::zero();
      if constexpr ((Parts & on_position) != 0) v = -(N.n[i] * f.x);
      if constexpr ((Parts & on_tangents) != 0)
        for (int k = 0; k < T; ++k) add_scaled(v, N.d1[k][i], f.a[k]);
      if constexpr ((Parts & on_curvatures) != 0)
        unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
          if constexpr (B::second[k]) add_scaled(v, N.d2[k][i], f.a2[k]);
        });
      store(v, &out[D * (i + 1)]);
    }
  }
}

// Parts of the forms below
template <bool H> inline constexpr int parts_of_p = H ? on_position | on_tangents : on_position;
template <class B, bool H>
inline constexpr int parts_of_slope = H && !is_flat<B> ? on_tangents | on_curvatures : on_tangents;

// c^k = c . a^k
template <class B, bool H, class S>
ENTS_INLINE void contravariant(const Surface<B, H, S>& s, const Vec<S, B::dim>& c, S (&up)[B::dim - 1]) {
  for (int k = 0; k < B::dim - 1; ++k) up[k] = dot(c, s.dual[k]);
}

// c . p
template <class B, bool H, class S>
ENTS_INLINE void form_of_p(const Surface<B, H, S>& s, const Vec<S, B::dim>& c, Form<B, S>& f) {
  f.x = c;
  if constexpr (H) {
    S up[B::dim - 1];
    contravariant(s, c, up);
    for (int k = 0; k < B::dim - 1; ++k) f.a[k] = (s.height.h * up[k]) * s.n;
  }
}

// c . delta rho_e,a   (index A known at compile time)
template <int A, class B, bool H, class S>
ENTS_INLINE void form_of_slope(const Surface<B, H, S>& s, const Vec<S, B::dim>& c, Form<B, S>& f) {
  constexpr int D = B::dim, T = D - 1;
  constexpr bool bent = !is_flat<B>;
  if constexpr (!H) {
    for (int k = 0; k < T; ++k) f.a[k] = k == A ? c : Vec<S, D>::zero();
  } else {
    const S h = s.height.h;
    S up[T];
    contravariant(s, c, up);
    if constexpr (bent)
      for (auto& v : f.a2.of) v = Vec<S, D>::zero();
    unroll<T>([&](auto k) ENTS_LAMBDA_INLINE {
      S along_n = -(s.height.h1[A] * up[k]);
      if constexpr (bent) {
        S t = dot(c, s.n) * dot(s.dual[k], s.n1[A]); // - c_n b^k_a
        unroll<T>([&](auto l) ENTS_LAMBDA_INLINE {
          if constexpr (B::second[symmetric_index(l, A)])
            t = t + up[l] * dot(s.dual[k], s.a2[symmetric_index(l, A)]);
        });
        along_n = along_n + h * t;
      }
      f.a[k] = along_n * s.n;
      if constexpr (bent) {
        add_scaled(f.a[k], -(h * up[k]), s.n1[A]);
        if constexpr (B::second[symmetric_index(k, A)]) f.a2[symmetric_index(k, A)] = -(h * up[k]) * s.n;
      }
      if constexpr (k == A) f.a[k] = f.a[k] + c;
    });
  }
}

// w_k = n . delta a_k
template <int I, class B, bool H, class S>
ENTS_INLINE void form_of_w(const Surface<B, H, S>& s, Form<B, S>& f) {
  for (int k = 0; k < B::dim - 1; ++k) f.a[k] = k == I ? s.n : Vec<S, B::dim>::zero();
}

// z_k of - c . DD'rho_e = sum_k (w_k z'_k + z_k w'_k)
template <int I, class B, class S>
ENTS_INLINE void form_of_z(const Surface<B, true, S>& s, const Vec<S, B::dim>& c, Form<B, S>& f) {
  constexpr int T = B::dim - 1;
  S up[T];
  contravariant(s, c, up);
  const S h = s.height.h, half = 0.5 * h * dot(c, s.n);
  for (int k = 0; k < T; ++k) {
    f.a[k] = (half * s.dual_metric[symmetric_index(k, I)]) * s.n;
    add_scaled(f.a[k], -(h * up[k]), s.dual[I]);
  }
}

} // namespace ents::ENTS_ISA
