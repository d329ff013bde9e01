// SPDX-License-Identifier: BSD-3-Clause
// Forms of the projection's own variations, F_,xi_a u and F_uu, and sums of forms.
#pragma once

#include "core/numbers/lanes.hpp"
#include "core/tangent/forms.hpp"

namespace ents::ENTS_ISA {

template <class B, bool H> inline constexpr int parts_of_f = parts_of_p<H> | parts_of_slope<B, H>;

// Forms of f_a = - F_,xi_a u
template <class B, bool H, class S>
ENTS_INLINE void forms_of_f(const Surface<B, H, S>& s, Form<B, S> (&f)[B::dim - 1]) {
  unroll<B::dim - 1>([&](auto a) ENTS_LAMBDA_INLINE {
    Form<B, S> along;
    form_of_p<B, H>(s, s.e[a], along);
    form_of_slope<a.value, B, H>(s, s.d, f[a]);
    f[a].x = along.x;
    if constexpr (H)
      for (int k = 0; k < B::dim - 1; ++k) f[a].a[k] = f[a].a[k] + along.a[k];
  });
}

// Forms of z_a of F_uu
template <class B, class S>
ENTS_INLINE void forms_of_z(const Surface<B, true, S>& s, Form<B, S> (&z)[B::dim - 1]) {
  const S half = 0.5 * s.height.h * s.height.h;
  unroll<B::dim - 1>([&](auto a) ENTS_LAMBDA_INLINE {
    form_of_z<a.value, B>(s, s.d, z[a]);
    z[a].x = s.height.h * s.dual[a];
    for (int k = 0; k < B::dim - 1; ++k)
      add_scaled(z[a].a[k], half * s.dual_metric[symmetric_index(k, a)], s.n);
  });
}

// to = factor f; they may be the same
template <int Parts, class B, class S>
ENTS_INLINE void set_form(Form<B, S>& to, const S& factor, const Form<B, S>& f) {
  constexpr int T = B::dim - 1;
  if constexpr ((Parts & on_position) != 0) to.x = factor * f.x;
  if constexpr ((Parts & on_tangents) != 0)
    for (int k = 0; k < T; ++k) to.a[k] = factor * f.a[k];
  if constexpr ((Parts & on_curvatures) != 0)
    unroll<symmetric_size<T>>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (B::second[k]) to.a2[k] = factor * f.a2[k];
    });
}
// sum += factor f
template <int Parts, class B, class S>
ENTS_INLINE void add_form(Form<B, S>& sum, const S& factor, const Form<B, S>& f) {
  constexpr int T = B::dim - 1;
  if constexpr ((Parts & on_position) != 0) add_scaled(sum.x, factor, f.x);
  if constexpr ((Parts & on_tangents) != 0)
    for (int k = 0; k < T; ++k) add_scaled(sum.a[k], factor, f.a[k]);
  if constexpr ((Parts & on_curvatures) != 0)
    unroll<symmetric_size<T>>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (B::second[k]) add_scaled(sum.a2[k], factor, f.a2[k]);
    });
}
template <int Parts, class B, class S>
ENTS_INLINE void value_of_form(const Form<B, Dual<S>>& f, Form<B, S>& value) {
  if constexpr ((Parts & on_position) != 0) value.x = value_of(f.x);
  for (int k = 0; k < B::dim - 1; ++k) value.a[k] = value_of(f.a[k]);
  if constexpr ((Parts & on_curvatures) != 0)
    unroll<symmetric_size<B::dim - 1>>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (B::second[k]) value.a2[k] = value_of(f.a2[k]);
    });
}
// The form whose expansion is the derivative along y of that of f, but for third derivatives of the basis. It
// has a part on second ones where the basis has them.
template <int Parts, class B, class S>
ENTS_INLINE void set_form_rate(const Form<B, Dual<S>>& f, const S (&y)[B::dim - 1], Form<B, S>& rate) {
  constexpr int T = B::dim - 1;
  if constexpr ((Parts & on_position) != 0) rate.x = derivative_of(f.x);
  for (int k = 0; k < T; ++k) {
    rate.a[k] = derivative_of(f.a[k]);
    if constexpr ((Parts & on_position) != 0) add_scaled(rate.a[k], -y[k], value_of(f.x));
  }
  unroll<symmetric_size<T>>([&](auto k) ENTS_LAMBDA_INLINE {
    if constexpr (B::second[k]) {
      constexpr int a = k / 2, b = (k + 1) / 2;
      rate.a2[k] = y[b] * value_of(f.a[a]);
      if constexpr (a != b) add_scaled(rate.a2[k], y[a], value_of(f.a[b]));
      if constexpr ((Parts & on_curvatures) != 0) rate.a2[k] = rate.a2[k] + derivative_of(f.a2[k]);
    }
  });
}

} // namespace ents::ENTS_ISA
