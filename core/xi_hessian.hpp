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

// t . D2xi as the products it is the sum of, so that its size is known before anything is written.
template <class B, bool Rigid> struct XiHessian {
  static constexpr int D = B::dim, T = D - 1, N = dof_count<B, Rigid>, max = 3 * T + symmetric_size<T>;
  int count = 0;
  double u[max][N], v[max][N];                                // u v^T + v u^T
  double weight[B::nodes + 1] = {}, weight1[B::nodes + 1] = {};  // of delta X and its derivative: (w w^T)' I

  ENTS_INLINE void add(const double (&a)[N], const double (&b)[N]) {
    for (int i = 0; i < N; ++i) {
      u[count][i] = a[i];
      v[count][i] = b[i];
    }
    ++count;
  }
  // no entry, and no partial sum of one, is larger
  ENTS_INLINE double bound() const {
    double b = 2.0 * sum_of_absolutes(weight) * sum_of_absolutes(weight1);
    for (int k = 0; k < count; ++k) b += 2.0 * sum_of_absolutes(u[k]) * sum_of_absolutes(v[k]);
    return b;
  }
  // lower triangle computed, upper one mirrored
  template <bool Accumulate = false> ENTS_INLINE void write(double* out, std::int64_t leading) const {
    for (int j = 0; j < N; ++j) {
      double column[N];
      for (int i = j; i < N; ++i) column[i] = 0.0;
      for (int k = 0; k < count; ++k)
        for (int i = j; i < N; ++i) column[i] += u[k][i] * v[k][j] + v[k][i] * u[k][j];
      if constexpr (!Rigid)
        for (int n = j / D, i = j; i < N; ++n, i += D)
          column[i] += weight[n] * weight1[j / D] + weight1[n] * weight[j / D];
      write_column<Accumulate>(column, j, out, leading);
    }
  }
};

// F_uu' and (F_xi,u)', F_xixi' at p along y, contracted with xi_u: sum = t . D2xi.
template <class B, bool H, bool Rigid>
ENTS_NOINLINE void directional_hessian(const Geometry<B>& g, const Projection<B, H>& p, const double (&y)[B::dim - 1],
                                     const Kinematics<B, H, Rigid>& k, XiHessian<B, Rigid>& sum) {
  constexpr int D = B::dim, T = D - 1, K = symmetric_size<T>, N = dof_count<B, Rigid>;
  using S = Dual<double>;
  S xi[T];
  for (int a = 0; a < T; ++a) xi[a] = S(p.xi[a], y[a]);
  Shape<S, T, B::nodes> shape;
  Surface<B, H, S> s;
  if (!evaluate_surface<2>(g, xi, shape, s)) return;  // it was regular in p

  const auto split = [](const S(&f)[N], double(&value)[N], double(&derivative)[N]) {
    for (int i = 0; i < N; ++i) {
      value[i] = f[i].v;
      derivative[i] = f[i].d;
    }
  };

  // F_uu = delta X . delta'X + sum_k (w_k z'_k + z_k w'_k)
  if constexpr (!Rigid) {
    sum.weight[0] = 1.0;
    for (int i = 0; i < B::nodes; ++i) {
      sum.weight[i + 1] = -shape.n[i].v;
      sum.weight1[i + 1] = -shape.n[i].d;
    }
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
        sum.add(w0, z1);
        sum.add(w1, z0);
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
    sum.add(f1, k.xi_gradient[a]);
  });
  // F_xixi = rho_e,a . rho_e,b - d . rho_e,ab
  for (int i = 0; i < K; ++i) {
    const int a = i / 2, b = (i + 1) / 2;
    const double f2 = (dot(s.e[a], s.e[b]) - dot(s.d, s.e2[i])).d;
    double half[N];
    for (int n = 0; n < N; ++n) half[n] = (a == b ? 0.5 : 1.0) * f2 * k.xi_gradient[b][n];
    sum.add(k.xi_gradient[a], half);
  }
}

// The direction along which the blocks change in t . D2xi: y = - F_,xixi^-1 t.
template <class B, bool H>
ENTS_INLINE void direction_of(const Projection<B, H>& p, const double (&t)[B::dim - 1], double (&y)[B::dim - 1]) {
  double minus[B::dim - 1];
  for (int a = 0; a < B::dim - 1; ++a) {
    minus[a] = -t[a];
    y[a] = 0.0;
  }
  solve(p.f2, minus, y);  // regular: delta xi exists
}

// t_a D2xi^a of either projection, its size known before it is written. k holds the exact delta xi.
template <class B, bool H, bool Rigid> struct ContractedXiHessian {
  static constexpr int T = B::dim - 1;
  bool normal;
  XiHessian<B, Rigid> blocks;        // normal projection
  GapProducts<B, H, Rigid> products; // shadow: the covector t_a c^a in the place of that of the gap
  Vec<double, B::dim> covector;

  ENTS_NOINLINE void evaluate(const Geometry<B>& g, const Projection<B, H>& p, const Target& t,
                              const Kinematics<B, H, Rigid>& k, const double (&weight)[T]) {
    normal = t.kind == ProjectionKind::normal;
    if (normal) {
      double y[T];
      direction_of(p, weight, y);
      directional_hessian(g, p, y, k, blocks);
      return;
    }
    Kinematics<B, H, Rigid> turned = k;
    turned.c = weight[0] * k.onto[0];
    if constexpr (T == 2) add_scaled(turned.c, weight[1], k.onto[1]);
    covector = turned.c;
    evaluate_slopes(p, turned);
    add_second_variation(p, t, false, 1.0, turned, products);
  }
  ENTS_INLINE double bound() const { return normal ? blocks.bound() : products.bound(); }
  template <bool Accumulate>
  ENTS_INLINE void write(const Kinematics<B, H, Rigid>& k, double* out, std::int64_t leading) const {
    if (normal) {
      blocks.template write<Accumulate>(out, leading);
    } else {
      products.template write<Accumulate>(out, leading);
      add_turning_ray(k, covector, 1.0, out, leading);
    }
  }
};

// out[T][N][N]. False, and nothing written, where an entry would leave the range of double precision.
template <class B, bool H, bool Rigid>
ENTS_INLINE bool write_xi_hessian(const Geometry<B>& g, const Projection<B, H>& p, const Target& t,
                                  const Kinematics<B, H, Rigid>& k, double* out) {
  constexpr int T = B::dim - 1, N = dof_count<B, Rigid>;
  ContractedXiHessian<B, H, Rigid> hessian[T];
  double bound = 0.0;
  for (int a = 0; a < T; ++a) {
    double unit[T] = {};
    unit[a] = 1.0;
    hessian[a].evaluate(g, p, t, k, unit);
    bound += hessian[a].bound();
  }
  if (!(bound < largest_result)) return false;
  for (int a = 0; a < T; ++a) hessian[a].template write<false>(k, out + a * N * N, N);
  return true;
}

}  // namespace ents::ENTS_ISA
