// SPDX-License-Identifier: BSD-3-Clause
// Forms of the projection's own variations, F_,xi_a u and F_uu, and sums of forms.
#pragma once

#include "core/forms.hpp"
#include "core/lanes.hpp"

namespace ents::ENTS_ISA {

template <class B, bool H> inline constexpr int parts_of_f = parts_of_p<H> | parts_of_slope<B, H>;

// Forms of f_a = - F_,xi_a u
template <class B, bool H, class S> ENTS_INLINE void forms_of_f(const Surface<B, H, S>& s, Form<B, S> (&f)[B::dim - 1]) {
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
template <class B, class S> ENTS_INLINE void forms_of_z(const Surface<B, true, S>& s, Form<B, S> (&z)[B::dim - 1]) {
  const S half = 0.5 * s.height.h * s.height.h;
  unroll<B::dim - 1>([&](auto a) ENTS_LAMBDA_INLINE {
    form_of_z<a.value, B>(s, s.d, z[a]);
    z[a].x = s.height.h * s.dual[a];
    for (int k = 0; k < B::dim - 1; ++k) add_scaled(z[a].a[k], half * s.dual_metric[symmetric_index(k, a)], s.n);
  });
}

template <int Parts, class B, class S> ENTS_INLINE void scale(Form<B, S>& f, const S& by) {
  if constexpr ((Parts & on_position) != 0) f.x = by * f.x;
  for (auto& v : f.a) v = by * v;
  if constexpr ((Parts & on_curvatures) != 0)
    unroll<symmetric_size<B::dim - 1>>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (B::second[k]) f.a2[k] = by * f.a2[k];
    });
}
// sum += factor f
template <int Parts, class B, class S> ENTS_INLINE void add_form(Form<B, S>& sum, const S& factor, const Form<B, S>& f) {
  constexpr int T = B::dim - 1;
  if constexpr ((Parts & on_position) != 0) add_scaled(sum.x, factor, f.x);
  for (int k = 0; k < T; ++k) add_scaled(sum.a[k], factor, f.a[k]);
  if constexpr ((Parts & on_curvatures) != 0)
    unroll<symmetric_size<T>>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (B::second[k]) add_scaled(sum.a2[k], factor, f.a2[k]);
    });
}
template <class B, class S> ENTS_INLINE Form<B, S> zero_form() {
  Form<B, S> f;
  f.x = Vec<S, B::dim>::zero();
  for (auto& v : f.a) v = Vec<S, B::dim>::zero();
  for (auto& v : f.a2) v = Vec<S, B::dim>::zero();
  return f;
}
// f = value + derivative along y
template <int Parts, class B, class S>
ENTS_INLINE void split(const Form<B, Dual<S>>& f, Form<B, S>& value, Form<B, S>& derivative) {
  const auto part = [](const Vec<Dual<S>, B::dim>& from, Vec<S, B::dim>& v, Vec<S, B::dim>& d) ENTS_LAMBDA_INLINE {
    v = value_of(from);
    d = derivative_of(from);
  };
  if constexpr ((Parts & on_position) != 0) part(f.x, value.x, derivative.x);
  for (int k = 0; k < B::dim - 1; ++k) part(f.a[k], value.a[k], derivative.a[k]);
  if constexpr ((Parts & on_curvatures) != 0)
    unroll<symmetric_size<B::dim - 1>>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (B::second[k]) part(f.a2[k], value.a2[k], derivative.a2[k]);
    });
}
template <int Parts, class B, class S> ENTS_INLINE void select_form(Truth<S> condition, const Form<B, S>& yes, Form<B, S>& other) {
  const auto part = [&](const Vec<S, B::dim>& from, Vec<S, B::dim>& to) ENTS_LAMBDA_INLINE {
    for (int c = 0; c < B::dim; ++c) to[c] = select(condition, from[c], to[c]);
  };
  if constexpr ((Parts & on_position) != 0) part(yes.x, other.x);
  for (int k = 0; k < B::dim - 1; ++k) part(yes.a[k], other.a[k]);
  if constexpr ((Parts & on_curvatures) != 0)
    unroll<symmetric_size<B::dim - 1>>([&](auto k) ENTS_LAMBDA_INLINE {
      if constexpr (B::second[k]) part(yes.a2[k], other.a2[k]);
    });
}

} // namespace ents::ENTS_ISA
