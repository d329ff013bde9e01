// SPDX-License-Identifier: BSD-3-Clause
// Second variation of the projection point, D2xi: needed by friction and by any host that builds its own
// weak form from eq. (3)-(4) of the paper.
//
// Normal projection (theory section 3): let y = - F_,xixi^-1 t and ' the derivative along y in xi; then
//   t . D2xi = F_uu' + (F_u,xi)' xi_u + xi_u^T (F_xi,u)' + xi_u^T F_xixi' xi_u .
// The blocks are evaluated with dual numbers in xi: the same code, no third derivative written by hand.
// Shadow projection needs second derivatives only.
#pragma once

#include "core/kinematics.hpp"

namespace ents::ENTS_ISA {

// F_uu' and (F_xi,u)', F_xixi' at p along y, contracted with xi_u: out += t . D2xi.
template <class B, bool H, bool Rigid>
ENTS_NOINLINE void directional_hessian(const Geometry<B>& g, const Projection<B, H>& p, const double (&y)[B::dim - 1],
                                     const Kinematics<B, H, Rigid>& k, double* out, std::int64_t leading) {
  constexpr int D = B::dim, T = D - 1, K = symmetric_size<T>, N = dof_count<B, Rigid>;
  using S = Dual<double>;
  S xi[T];
  for (int a = 0; a < T; ++a) xi[a] = S(p.xi[a], y[a]);
  Shape<S, T, B::nodes> shape;
  Surface<B, H, S> s;
  if (!evaluate_surface<2>(g, xi, shape, s)) return;  // it was regular in p

  const auto add_symmetric = [&](const double(&u)[N], const double(&v)[N]) {
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) out[j * leading + i] += u[i] * v[j] + v[i] * u[j];
  };
  const auto split = [](const S(&f)[N], double(&value)[N], double(&derivative)[N]) {
    for (int i = 0; i < N; ++i) {
      value[i] = f[i].v;
      derivative[i] = f[i].d;
    }
  };

  // F_uu = delta X . delta'X + sum_k (w_k z'_k + z_k w'_k)
  if constexpr (!Rigid) {
    S weight[B::nodes + 1];
    weight[0] = S(1.0);
    for (int i = 0; i < B::nodes; ++i) weight[i + 1] = -shape.n[i];
    for (int j = 0; j <= B::nodes; ++j)
      for (int i = 0; i <= B::nodes; ++i)
        for (int c = 0; c < D; ++c) out[(D * j + c) * leading + D * i + c] += (weight[i] * weight[j]).d;
    if constexpr (H)
      unroll<T>([&](auto b) {
        // z_k of theory's F_uu: h a^k . dX + the z_k of - d . DD'rho_e + h^2/2 a^kl w_l
        Form<B, S> w, z;
        form_of_w<b.value>(s, w);
        form_of_z<b.value>(s, s.d, z);
        z.x = s.height.h * s.dual[b];
        const S half = 0.5 * s.height.h * s.height.h;
        for (int a = 0; a < T; ++a) add_scaled(z.a[a], half * s.dual_metric[symmetric_index(a, b)], s.n);
        S w_dof[N], z_dof[N];
        expand<B, Rigid, on_tangents>(w, shape, w_dof);
        expand<B, Rigid, on_position | on_tangents>(z, shape, z_dof);
        double w0[N], w1[N], z0[N], z1[N];
        split(w_dof, w0, w1);
        split(z_dof, z0, z1);
        add_symmetric(w0, z1);
        add_symmetric(w1, z0);
      });
  }
  // F_xi_a,u = - rho_e,a . p - d . delta rho_e,a
  unroll<T>([&](auto a) {
    Form<B, S> f, q;
    S f_dof[N], q_dof[N];
    form_of_p(s, s.e[a], f);
    expand<B, Rigid, parts_of_p<H>>(f, shape, f_dof);
    if constexpr (!Rigid) {
      form_of_slope<a.value>(s, s.d, q);
      expand<B, Rigid, parts_of_slope<B, H>>(q, shape, q_dof);
    }
    double f1[N];
    for (int i = 0; i < N; ++i) {
      f1[i] = -f_dof[i].d;
      if constexpr (!Rigid) f1[i] -= q_dof[i].d;
    }
    add_symmetric(f1, k.xi_gradient[a]);
  });
  // F_xixi = rho_e,a . rho_e,b - d . rho_e,ab
  for (int i = 0; i < K; ++i) {
    const int a = i / 2, b = (i + 1) / 2;
    const double f2 = (dot(s.e[a], s.e[b]) - dot(s.d, s.e2[i])).d;
    double half[N];
    for (int n = 0; n < N; ++n) half[n] = (a == b ? 0.5 : 1.0) * f2 * k.xi_gradient[b][n];
    add_symmetric(k.xi_gradient[a], half);
  }
}

// out += t_a D2xi^a; k holds the exact delta xi of this projection.
template <class B, bool H, bool Rigid>
ENTS_NOINLINE void add_contracted_xi_hessian(const Geometry<B>& g, const Projection<B, H>& p, const Target& t,
                                           const Kinematics<B, H, Rigid>& k, const double (&weight)[B::dim - 1],
                                           double* out, std::int64_t leading) {
  constexpr int T = B::dim - 1;
  if (t.kind == ProjectionKind::normal) {
    double minus[T], y[T];
    for (int a = 0; a < T; ++a) minus[a] = -weight[a];
    solve(p.f2, minus, y);
    directional_hessian(g, p, y, k, out, leading);
  } else {
    Kinematics<B, H, Rigid> turned = k;  // the covector t_a c^a in the place of that of the gap
    turned.c = weight[0] * k.onto[0];
    if constexpr (T == 2) add_scaled(turned.c, weight[1], k.onto[1]);
    evaluate_slopes(p, turned);
    GapProducts<B, H, Rigid> sum;
    add_second_variation(p, t, false, 1.0, turned, sum);
    sum.template write<true>(out, leading);
    add_turning_ray(k, turned.c, 1.0, out, leading);
  }
}

// out[T][N][N]
template <class B, bool H, bool Rigid>
ENTS_INLINE void evaluate_xi_hessian(const Geometry<B>& g, const Projection<B, H>& p, const Target& t,
                                     const Kinematics<B, H, Rigid>& k, double* out) {
  constexpr int T = B::dim - 1, N = dof_count<B, Rigid>;
  for (int i = 0; i < T * N * N; ++i) out[i] = 0.0;
  for (int a = 0; a < T; ++a) {
    double unit[T] = {};
    unit[a] = 1.0;
    add_contracted_xi_hessian(g, p, t, k, unit, out + a * N * N, N);
  }
}

}  // namespace ents::ENTS_ISA
