// SPDX-License-Identifier: BSD-3-Clause
// First and second variations of the gap (theory sections 2 and 4).
//
//   first:   delta g    = c . p          c = n_e (normal), n_e / (n_e . e) (shadow)
//            delta xi_a = M_ab f_b       f_b = rho_e,b . p + g q_b, M = F_,xixi^-1        (normal)
//            delta xi_a = c^a . p        c^a the covectors of the ray frame               (shadow)
//   second:  D2g = - c . DD'rho_e + q G q + 2 q P xi + xi (H P) xi,  q_a = c . delta rho_e,a
//            normal: G = g A_e^-1, P = g A_e^-1 H_e - 1;  small gap and shadow: G = 0, P = -1
// (D2g of theory section 2 with p eliminated in favour of delta xi: no difference of large numbers is left
// where g is small, and both projections share it.) A ray towards an emitter turns with the slave; that
// adds terms on the slave's dofs alone.
#pragma once

#include "core/forms.hpp"
#include "core/projection.hpp"

namespace ents::ENTS_ISA {

template <class B, bool H, bool Rigid> struct Kinematics {
  static constexpr int D = B::dim, T = D - 1, K = symmetric_size<T>, N = dof_count<B, Rigid>;
  double gap;                // g, along n_e or along the ray
  double normal_gap;         // (x_s - rho_e) . n_e
  Vec<double, D> normal;     // n_e
  Vec<double, D> c;          // covector of the gap
  Vec<double, D> onto[T];    // covectors of xi (shadow)
  Vec<double, D> ray;        // e (shadow)
  double inverse_distance;   // 1 / |emitter - x_s|; 0 for a fixed direction
  double inverse_metric[K];  // A_e^-1 (normal)
  double curvature[K];       // c . rho_e,ab
  double gap_gradient[N];    // delta g
  double xi_gradient[T][N];  // delta xi, or its small-gap approximation
  double slope[T][N];        // q_a
  double magnitude;          // sum of |.| of all that the dof vectors are made of: finite numbers ahead?
};

// Results made of ingredients below this stay far inside the range of double precision.
inline constexpr double largest_ingredient = 1e60;
// A bound of results that leaves room for a few terms more.
inline constexpr double largest_result = 1e300;

template <int D> ENTS_INLINE double sum_of_absolutes(const Vec<double, D>& v) {
  double s = 0.0;
  for (int c = 0; c < D; ++c) s += absolute(v[c]);
  return s;
}
template <int N> ENTS_INLINE double sum_of_absolutes(const double (&v)[N]) {
  double s = 0.0;
  for (int i = 0; i < N; ++i) s += absolute(v[i]);
  return s;
}
template <int Parts, class B> ENTS_INLINE double sum_of_absolutes(const Form<B, double>& f) {
  double s = 0.0;
  if constexpr ((Parts & on_position) != 0) s += sum_of_absolutes(f.x);
  if constexpr ((Parts & on_tangents) != 0)
    for (const auto& v : f.a) s += sum_of_absolutes(v);
  if constexpr ((Parts & on_curvatures) != 0)
    for (const auto& v : f.a2.of) s += sum_of_absolutes(v);
  return s;
}

// m v for a symmetric m
template <int N> ENTS_INLINE void multiply(const double (&m)[1], const double (&v)[1][N], double (&out)[1][N]) {
  for (int i = 0; i < N; ++i) out[0][i] = m[0] * v[0][i];
}
template <int N> ENTS_INLINE void multiply(const double (&m)[3], const double (&v)[2][N], double (&out)[2][N]) {
  for (int i = 0; i < N; ++i) {
    out[0][i] = m[0] * v[0][i] + m[1] * v[1][i];
    out[1][i] = m[1] * v[0][i] + m[2] * v[1][i];
  }
}

// The gap at a projection. False where rho_e has no normal or the ray grazes it.
template <class B, bool H, bool Rigid>
ENTS_INLINE bool evaluate_gap(const Projection<B, H>& p, const Target& t, Kinematics<B, H, Rigid>& k) {
  if (!enriched_normal(p.s, k.normal)) return false;
  k.normal_gap = dot(p.s.d, k.normal);
  k.inverse_distance = t.inverse_distance;
  k.magnitude = 0.0;
  if (t.kind == ProjectionKind::normal) {
    k.gap = k.normal_gap;
    k.c = k.normal;
  } else {
    k.ray = ray_of<B::dim>(t);
    if (!ray_frame(p.s.e, k.ray, k.onto, k.c)) return false;
    k.gap = dot(k.c, p.s.d);
  }
  return true;
}

// Slave coefficients of c . delta e, e the unit vector from the slave to the emitter.
template <int D>
ENTS_INLINE Vec<double, D> variation_of_ray(const Vec<double, D>& c, const Vec<double, D>& e, double inverse_distance) {
  Vec<double, D> v = (-inverse_distance) * c;
  add_scaled(v, inverse_distance * dot(c, e), e);
  return v;
}

// out = c . (p - g delta e); delta e only where the ray turns
template <class B, bool H, bool Rigid>
ENTS_INLINE void expand_covector(const Projection<B, H>& p, Kinematics<B, H, Rigid>& k, const Vec<double, B::dim>& c,
                                 double (&out)[dof_count<B, Rigid>]) {
  Form<B, double> f;
  form_of_p(p.s, c, f);
  k.magnitude += sum_of_absolutes<Rigid ? on_position : parts_of_p<H>>(f);
  expand<B, Rigid, parts_of_p<H>>(f, p.N, out);
  if (k.inverse_distance != 0.0) {
    const Vec<double, B::dim> r = variation_of_ray(c, k.ray, k.inverse_distance);
    for (int i = 0; i < B::dim; ++i) out[i] -= k.gap * r[i];
  }
}

template <class B, bool H, bool Rigid>
ENTS_INLINE void evaluate_gap_gradient(const Projection<B, H>& p, Kinematics<B, H, Rigid>& k) {
  expand_covector(p, k, k.c, k.gap_gradient);
}

// q_a = c . delta rho_e,a and H_ab = c . rho_e,ab
template <class B, bool H, bool Rigid>
ENTS_INLINE void evaluate_slopes(const Projection<B, H>& p, Kinematics<B, H, Rigid>& k) {
  for (int i = 0; i < symmetric_size<B::dim - 1>; ++i) k.curvature[i] = dot(k.c, p.s.e2[i]);
  k.magnitude += sum_of_absolutes(k.curvature);
  if constexpr (!Rigid)
    unroll<B::dim - 1>([&](auto a) ENTS_LAMBDA_INLINE {
      Form<B, double> f;
      form_of_slope<a.value>(p.s, k.c, f);
      k.magnitude += sum_of_absolutes<parts_of_slope<B, H>>(f);
      expand<B, Rigid, parts_of_slope<B, H>>(f, p.N, k.slope[a]);
    });
}

// delta xi; needs the slopes. small_gap: g -> 0. False where the projection is singular.
template <class B, bool H, bool Rigid>
ENTS_INLINE bool evaluate_xi_gradient(const Projection<B, H>& p, const Target& t, bool small_gap,
                                      Kinematics<B, H, Rigid>& k) {
  constexpr int T = B::dim - 1, K = symmetric_size<T>, N = dof_count<B, Rigid>;
  if (t.kind != ProjectionKind::normal) {
    for (int a = 0; a < T; ++a) expand_covector(p, k, k.onto[a], k.xi_gradient[a]);
    return true;
  }
  const double det_metric = determinant(p.metric);
  const double det = small_gap ? det_metric : determinant(p.f2);
  if (!(det_metric > 0.0) || !(absolute(det) > 1e-10 * det_metric)) return false;
  double f[T][N];
  for (int a = 0; a < T; ++a) {
    expand_covector(p, k, p.s.e[a], f[a]);
    if constexpr (!Rigid)
      if (!small_gap)
        for (int i = 0; i < N; ++i) f[a][i] += k.gap * k.slope[a][i];
  }
  double m[K];
  invert(small_gap ? p.metric : p.f2, det, m);
  invert(p.metric, det_metric, k.inverse_metric);
  k.magnitude += sum_of_absolutes(m) + sum_of_absolutes(k.inverse_metric);
  multiply(m, f, k.xi_gradient);
  return true;
}

// The lower part of a column of a symmetric matrix, and its mirror image.
template <bool Accumulate, int N>
ENTS_INLINE void write_column(const double (&column)[N], int j, double* out, std::int64_t leading) {
  if constexpr (Accumulate) {
    out[j * leading + j] += column[j];
    for (int i = j + 1; i < N; ++i) {
      out[j * leading + i] += column[i];
      out[i * leading + j] += column[i];
    }
  } else {
    for (int i = j; i < N; ++i) {
      out[j * leading + i] = column[i];
      out[i * leading + j] = column[i];
    }
  }
}

// A matrix as a sum of products of dof vectors: sum_k u_k v_k^T, symmetric in total.
template <int N, int Max> struct ProductSum {
  int count = 0;
  double u[Max][N], v[Max][N];
  ENTS_INLINE void add(const double (&a)[N], double scale, const double (&b)[N]) {
    for (int i = 0; i < N; ++i) {
      u[count][i] = a[i];
      v[count][i] = scale * b[i];
    }
    ++count;
  }
  // no entry, and no partial sum of one, is larger
  ENTS_INLINE double bound() const {
    double b = 0.0;
    for (int k = 0; k < count; ++k) b += sum_of_absolutes(u[k]) * sum_of_absolutes(v[k]);
    return b;
  }
  // lower triangle computed, upper one mirrored: exactly symmetric
  template <bool Accumulate = false> ENTS_INLINE void write(double* out, std::int64_t leading) const {
    for (int j = 0; j < N; ++j) {
      double column[N];
      for (int i = j; i < N; ++i) column[i] = u[0][i] * v[0][j];
      for (int k = 1; k < count; ++k)
        for (int i = j; i < N; ++i) column[i] += u[k][i] * v[k][j];
      write_column<Accumulate>(column, j, out, leading);
    }
  }
};

template <class B, bool H, bool Rigid>
using GapProducts = ProductSum<dof_count<B, Rigid>, 1 + 4 * (B::dim - 1)>;

// sum += scale D2g but for the terms of a turning ray; needs slopes and delta xi.
template <class B, bool H, bool Rigid>
ENTS_INLINE void add_second_variation(const Projection<B, H>& p, const Target& t, bool small_gap, double scale,
                                      Kinematics<B, H, Rigid>& k, GapProducts<B, H, Rigid>& sum) {
  constexpr int T = B::dim - 1, N = dof_count<B, Rigid>;
  if constexpr (H && !Rigid)  // - c . DD'rho_e
    unroll<T>([&](auto i) ENTS_LAMBDA_INLINE {
      double w[N], z[N];
      Form<B, double> f;
      form_of_w<i.value>(p.s, f);
      expand<B, Rigid, on_tangents>(f, p.N, w);
      form_of_z<i.value>(p.s, k.c, f);
      k.magnitude += sum_of_absolutes<on_tangents>(f);
      expand<B, Rigid, on_tangents>(f, p.N, z);
      sum.add(w, scale, z);
      sum.add(z, scale, w);
    });
  double G[T][T] = {}, P[T][T] = {};
  for (int a = 0; a < T; ++a) P[a][a] = -1.0;
  if (t.kind == ProjectionKind::normal && !small_gap) {
    G[0][0] = k.gap * k.inverse_metric[0];
    if constexpr (T == 2) {
      G[0][1] = G[1][0] = k.gap * k.inverse_metric[1];
      G[1][1] = k.gap * k.inverse_metric[2];
    }
  }
  double HP[T][T];
  for (int a = 0; a < T; ++a)
    for (int b = 0; b < T; ++b)
      for (int c = 0; c < T; ++c) P[a][b] += G[a][c] * k.curvature[symmetric_index(c, b)];
  for (int a = 0; a < T; ++a)
    for (int b = 0; b < T; ++b) {
      HP[a][b] = k.curvature[symmetric_index(a, 0)] * P[0][b];
      if constexpr (T == 2) HP[a][b] += k.curvature[symmetric_index(a, 1)] * P[1][b];
    }
  for (int a = 0; a < T; ++a) {
    double y[N];
    if constexpr (!Rigid) {
      for (int i = 0; i < N; ++i) {
        y[i] = 0.0;
        for (int b = 0; b < T; ++b) y[i] += G[a][b] * k.slope[b][i] + P[a][b] * k.xi_gradient[b][i];
      }
      sum.add(k.slope[a], scale, y);
    }
    for (int i = 0; i < N; ++i) {
      y[i] = 0.0;
      for (int b = 0; b < T; ++b) {
        if constexpr (!Rigid) y[i] += P[b][a] * k.slope[b][i];
        y[i] += HP[a][b] * k.xi_gradient[b][i];
      }
    }
    sum.add(k.xi_gradient[a], scale, y);
  }
}

// The terms of a ray that turns with the slave, in c . D2(...): matrix += scale ( - [dg (c . de) + sym] - g c . DD'e ).
template <class B, bool H, bool Rigid>
ENTS_INLINE void add_turning_ray(const Kinematics<B, H, Rigid>& k, const Vec<double, B::dim>& c, double scale,
                                 double* out, std::int64_t leading) {
  constexpr int D = B::dim, N = dof_count<B, Rigid>;
  if (k.inverse_distance == 0.0) return;
  const Vec<double, D> r = variation_of_ray(c, k.ray, k.inverse_distance);
  for (int j = 0; j < D; ++j)
    for (int i = 0; i < N; ++i) {
      const double mixed = -scale * r[j] * k.gap_gradient[i];
      out[j * leading + i] += mixed;
      out[i * leading + j] += mixed;
    }
  const double q = k.inverse_distance, along = dot(c, k.ray);
  for (int j = 0; j < D; ++j)
    for (int i = 0; i < D; ++i) {
      const double projector = (i == j ? 1.0 : 0.0) - k.ray[i] * k.ray[j];
      out[j * leading + i] -= scale * k.gap * (q * (r[i] * k.ray[j] + k.ray[i] * r[j]) - along * q * q * projector);
    }
}

}  // namespace ents::ENTS_ISA
