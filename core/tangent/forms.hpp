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
template <class Basis, class V> struct OnCurvatures {
  static constexpr int before(int k) {
    int count = 0;
    for (int i = 0; i < k; ++i) count += Basis::second[i];
    return count;
  }
  static constexpr int count = before(symmetric_size<Basis::dim - 1>);
  V of[count > 0 ? count : 1];
  ENTS_INLINE V& operator[](int k) { return of[before(k)]; }
  ENTS_INLINE const V& operator[](int k) const { return of[before(k)]; }
};

template <class Basis, class Scalar> struct Form {
  static constexpr int D = Basis::dim, T = D - 1;
  Vec<Scalar, D> x;                       // on delta X
  Vec<Scalar, D> a[T];                    // on delta a_k
  OnCurvatures<Basis, Vec<Scalar, D>> a2; // on delta a_kl, where the basis bends
};

// Which parts of a form are present (known at compile time).
inline constexpr int on_position = 1, on_tangents = 2, on_curvatures = 4;

// The most dofs of an element: the slave alone when the master is rigid.
template <class Basis, bool Rigid>
inline constexpr int dof_count = Rigid ? Basis::dim : Basis::dim*(Basis::nodes + 1);

// As many of a basis that is counted
template <bool Rigid, class Basis> ENTS_INLINE constexpr int dofs_of(const Basis& basis) {
  return Rigid ? Basis::dim : Basis::dim * (node_count(basis) + 1);
}
template <class Basis, bool Rigid> inline constexpr bool counts_dofs = is_counted<Basis> && !Rigid;

// out[dof] = form applied to the unit variation of that dof
template <bool Rigid, int Parts, class Basis, class Scalar>
ENTS_INLINE void expand(const Basis& basis, const Form<Basis, Scalar>& f,
                        const Shape<Scalar, Basis::dim - 1, Basis::nodes>& N,
                        Scalar (&out)[dof_count<Basis, Rigid>]) {
  constexpr int D = Basis::dim, T = D - 1, K = symmetric_size<T>;
  for (int c = 0; c < D; ++c) out[c] = (Parts & on_position) ? f.x[c] : Scalar(0.0);
  if constexpr (!Rigid) {
    const int nodes = node_count(basis);
    for (int i = 0; i < nodes; ++i) {
      Vec<Scalar, D> v = Vec<Scalar, D>::zero();
      if constexpr ((Parts & on_position) != 0) v = -(N.n[i] * f.x);
      if constexpr ((Parts & on_tangents) != 0)
        for (int k = 0; k < T; ++k) add_scaled(v, N.d1[k][i], f.a[k]);
      if constexpr ((Parts & on_curvatures) != 0)
        unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
          if constexpr (Basis::second[k]) add_scaled(v, N.d2[k][i], f.a2[k]);
        });
      store(v, &out[D * (i + 1)]);
    }
  }
}

// Parts of the forms below
template <bool Enriched> inline constexpr int parts_of_p = Enriched ? on_position | on_tangents : on_position;
template <class Basis, bool Enriched>
inline constexpr int parts_of_slope = Enriched && !is_flat<Basis> ? on_tangents | on_curvatures : on_tangents;

// c^k = c . a^k
template <class Basis, bool Enriched, class Scalar>
ENTS_INLINE void contravariant(const Surface<Basis, Enriched, Scalar>& s, const Vec<Scalar, Basis::dim>& c,
                               Scalar (&up)[Basis::dim - 1]) {
  for (int k = 0; k < Basis::dim - 1; ++k) up[k] = dot(c, s.dual[k]);
}

// c . p
template <class Basis, bool Enriched, class Scalar>
ENTS_INLINE void form_of_p(const Surface<Basis, Enriched, Scalar>& s, const Vec<Scalar, Basis::dim>& c,
                           Form<Basis, Scalar>& f) {
  f.x = c;
  if constexpr (Enriched) {
    Scalar up[Basis::dim - 1];
    contravariant(s, c, up);
    for (int k = 0; k < Basis::dim - 1; ++k) f.a[k] = (s.height.h * up[k]) * s.n;
  }
}

// c . delta rho_e,a   (index A known at compile time)
template <int A, class Basis, bool Enriched, class Scalar>
ENTS_INLINE void form_of_slope(const Surface<Basis, Enriched, Scalar>& s, const Vec<Scalar, Basis::dim>& c,
                               Form<Basis, Scalar>& f) {
  constexpr int D = Basis::dim, T = D - 1;
  constexpr bool bent = !is_flat<Basis>;
  if constexpr (!Enriched) {
    for (int k = 0; k < T; ++k) f.a[k] = k == A ? c : Vec<Scalar, D>::zero();
  } else {
    const Scalar h = s.height.h;
    Scalar up[T];
    contravariant(s, c, up);
    if constexpr (bent)
      for (auto& v : f.a2.of) v = Vec<Scalar, D>::zero();
    unroll<T>([&](auto k) ENTS_LAMBDA_INLINE {
      Scalar along_n = -(s.height.h1[A] * up[k]);
      if constexpr (bent) {
        Scalar t = dot(c, s.n) * dot(s.dual[k], s.n1[A]); // - c_n b^k_a
        unroll<T>([&](auto l) ENTS_LAMBDA_INLINE {
          if constexpr (Basis::second[symmetric_index(l, A)])
            t = t + up[l] * dot(s.dual[k], s.a2[symmetric_index(l, A)]);
        });
        along_n = along_n + h * t;
      }
      f.a[k] = along_n * s.n;
      if constexpr (bent) {
        add_scaled(f.a[k], -(h * up[k]), s.n1[A]);
        if constexpr (Basis::second[symmetric_index(k, A)]) f.a2[symmetric_index(k, A)] = -(h * up[k]) * s.n;
      }
      if constexpr (k == A) f.a[k] = f.a[k] + c;
    });
  }
}

// w_k = n . delta a_k
template <int I, class Basis, bool Enriched, class Scalar>
ENTS_INLINE void form_of_w(const Surface<Basis, Enriched, Scalar>& s, Form<Basis, Scalar>& f) {
  for (int k = 0; k < Basis::dim - 1; ++k) f.a[k] = k == I ? s.n : Vec<Scalar, Basis::dim>::zero();
}

// z_k of - c . DD'rho_e = sum_k (w_k z'_k + z_k w'_k)
template <int I, class Basis, class Scalar>
ENTS_INLINE void form_of_z(const Surface<Basis, true, Scalar>& s, const Vec<Scalar, Basis::dim>& c,
                           Form<Basis, Scalar>& f) {
  constexpr int T = Basis::dim - 1;
  Scalar up[T];
  contravariant(s, c, up);
  const Scalar h = s.height.h, half = 0.5 * h * dot(c, s.n);
  for (int k = 0; k < T; ++k) {
    f.a[k] = (half * s.dual_metric[symmetric_index(k, I)]) * s.n;
    add_scaled(f.a[k], -(h * up[k]), s.dual[I]);
  }
}

} // namespace ents::ENTS_ISA
