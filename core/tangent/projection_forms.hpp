// SPDX-License-Identifier: BSD-3-Clause
// Forms of the projection's own variations, F_,xi_a u and F_uu, and sums of forms.
#pragma once

#include "core/numbers/lanes.hpp"
#include "core/tangent/forms.hpp"

namespace ents::ENTS_ISA {

template <class Basis, bool Enriched>
inline constexpr int parts_of_f = parts_of_p<Enriched> | parts_of_slope<Basis, Enriched>;

// Forms of f_a = - F_,xi_a u
template <class Basis, bool Enriched, class Scalar>
ENTS_INLINE void forms_of_f(const Surface<Basis, Enriched, Scalar>& s,
                            Form<Basis, Scalar> (&f)[Basis::dim - 1]) {
  unroll<Basis::dim - 1>([&](auto a) ENTS_LAMBDA_INLINE {
    Form<Basis, Scalar> along;
    form_of_p<Basis, Enriched>(s, s.e[a], along);
    form_of_slope<a.value, Basis, Enriched>(s, s.d, f[a]);
    f[a].x = along.x;
    if constexpr (Enriched)
      for (int k = 0; k < Basis::dim - 1; ++k) f[a].a[k] = f[a].a[k] + along.a[k];
  });
}

// Forms of z_a of F_uu
template <class Basis, class Scalar>
ENTS_INLINE void forms_of_z(const Surface<Basis, true, Scalar>& s, Form<Basis, Scalar> (&z)[Basis::dim - 1]) {
  const Scalar half = 0.5 * s.height.h * s.height.h;
  unroll<Basis::dim - 1>([&](auto a) ENTS_LAMBDA_INLINE {
    form_of_z<a.value, Basis>(s, s.d, z[a]);
    z[a].x = s.height.h * s.dual[a];
    for (int k = 0; k < Basis::dim - 1; ++k)
      add_scaled(z[a].a[k], half * s.dual_metric[symmetric_index(k, a)], s.n);
  });
}

// to = factor f; they may be the same
template <int Parts, class Basis, class Scalar>
ENTS_INLINE void set_form(Form<Basis, Scalar>& to, const Scalar& factor, const Form<Basis, Scalar>& f) {
  constexpr int T = Basis::dim - 1;
  if constexpr ((Parts & on_position) != 0) to.x = factor * f.x;
  if constexpr ((Parts & on_tangents) != 0)
    for (int k = 0; k < T; ++k) to.a[k] = factor * f.a[k];
  if constexpr ((Parts & on_curvatures) != 0)
    unroll<symmetric_size<T>>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (Basis::second[k]) to.a2[k] = factor * f.a2[k];
    });
}
// sum += factor f
template <int Parts, class Basis, class Scalar>
ENTS_INLINE void add_form(Form<Basis, Scalar>& sum, const Scalar& factor, const Form<Basis, Scalar>& f) {
  constexpr int T = Basis::dim - 1;
  if constexpr ((Parts & on_position) != 0) add_scaled(sum.x, factor, f.x);
  if constexpr ((Parts & on_tangents) != 0)
    for (int k = 0; k < T; ++k) add_scaled(sum.a[k], factor, f.a[k]);
  if constexpr ((Parts & on_curvatures) != 0)
    unroll<symmetric_size<T>>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (Basis::second[k]) add_scaled(sum.a2[k], factor, f.a2[k]);
    });
}
template <int Parts, class Basis, class Scalar>
ENTS_INLINE void value_of_form(const Form<Basis, Dual<Scalar>>& f, Form<Basis, Scalar>& value) {
  if constexpr ((Parts & on_position) != 0) value.x = value_of(f.x);
  for (int k = 0; k < Basis::dim - 1; ++k) value.a[k] = value_of(f.a[k]);
  if constexpr ((Parts & on_curvatures) != 0)
    unroll<symmetric_size<Basis::dim - 1>>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (Basis::second[k]) value.a2[k] = value_of(f.a2[k]);
    });
}
// The form whose expansion is the derivative along y of that of f, but for third derivatives of the basis. It
// has a part on second ones where the basis has them.
template <int Parts, class Basis, class Scalar>
ENTS_INLINE void set_form_rate(const Form<Basis, Dual<Scalar>>& f, const Scalar (&y)[Basis::dim - 1],
                               Form<Basis, Scalar>& rate) {
  constexpr int T = Basis::dim - 1;
  if constexpr ((Parts & on_position) != 0) rate.x = derivative_of(f.x);
  for (int k = 0; k < T; ++k) {
    rate.a[k] = derivative_of(f.a[k]);
    if constexpr ((Parts & on_position) != 0) add_scaled(rate.a[k], -y[k], value_of(f.x));
  }
  unroll<symmetric_size<T>>([&](auto k) ENTS_LAMBDA_INLINE {
    if constexpr (Basis::second[k]) {
      constexpr int a = k / 2, b = (k + 1) / 2;
      rate.a2[k] = y[b] * value_of(f.a[a]);
      if constexpr (a != b) add_scaled(rate.a2[k], y[a], value_of(f.a[b]));
      if constexpr ((Parts & on_curvatures) != 0) rate.a2[k] = rate.a2[k] + derivative_of(f.a2[k]);
    }
  });
}

} // namespace ents::ENTS_ISA
