// SPDX-License-Identifier: BSD-3-Clause
// Coulomb friction with return mapping, on the enriched surface.
//
// The elastic slip is counted from an anchor xi_0, a point of the master surface kept in the state: a rigid
// motion of the element does not move it, and no vector has to be rotated. Covariant tangential force, per
// element, work-conjugate to delta xi^a:
//   trial  t_a = A (lambda_a + eps_t A_ab (xi^b - xi_0^b)),  A_ab = rho_e,a . rho_e,b
//   stick  |t| = sqrt(t_a A^ab t_b) <= L,  slip  t_a = L m_a, m_a = t_a / |t|,  L = min(mu p A, shear limit A)
// Residual t_a delta xi^a; its exact derivative is delta xi^a dt_a + t_a D2xi^a (eq. 4 of the paper).
#pragma once

#include "core/contact_law.hpp"
#include "core/xi_hessian.hpp"

namespace ents::ENTS_ISA {

template <int T> struct FrictionForce {
  static constexpr int K = symmetric_size<T>;
  double force[T];           // t_a
  double trial_norm;         // |t| of the trial
  double direction[T];       // m_a (slip)
  double raised[T];          // m^a = A^ab m_b (slip)
  double metric[K], inverse_metric[K];
  double moved[T];           // xi - xi_0
  double limit;              // L
  double limit_by_pressure;  // dL / d(p A): mu, or 0 at the shear limit
  bool slip, at_shear_limit;
};

template <int T> ENTS_INLINE void multiply(const double (&m)[symmetric_size<T>], const double (&v)[T], double (&out)[T]) {
  for (int a = 0; a < T; ++a) {
    out[a] = m[symmetric_index(a, 0)] * v[0];
    if constexpr (T == 2) out[a] += m[symmetric_index(a, 1)] * v[1];
  }
}
template <int T> ENTS_INLINE double contract(const double (&u)[T], const double (&v)[T]) {
  double s = u[0] * v[0];
  if constexpr (T == 2) s += u[1] * v[1];
  return s;
}

// pressure_force: p A, below 0 where a multiplier pulls: no friction; multiplier: lambda_a [F/L]. False where rho_e has no area: no direction has a length there.
template <class B, bool H>
ENTS_INLINE bool evaluate_friction(const ContactLaw& law, const Projection<B, H>& p, const double* anchor,
                                   const double* multiplier, double pressure_force, double area,
                                   FrictionForce<B::dim - 1>& f) {
  constexpr int T = B::dim - 1, K = symmetric_size<T>;
  for (int k = 0; k < K; ++k) f.metric[k] = dot(p.s.e[k / 2], p.s.e[(k + 1) / 2]);
  const double det = determinant(f.metric);
  if (!(det > 0.0)) return false;
  invert(f.metric, det, f.inverse_metric);
  for (int a = 0; a < T; ++a) f.moved[a] = p.xi[a] - anchor[a];
  multiply<T>(f.metric, f.moved, f.force);
  for (int a = 0; a < T; ++a)
    f.force[a] = area * ((multiplier ? multiplier[a] : 0.0) + law.friction_stiffness * f.force[a]);
  double raised[T];
  multiply<T>(f.inverse_metric, f.force, raised);
  f.trial_norm = square_root(contract<T>(f.force, raised));
  f.slip = f.at_shear_limit = false;
  f.limit = 0.0;
  f.limit_by_pressure = 0.0;
  if (law.friction == FrictionKind::rough) return true;
  if (pressure_force > 0.0) {
    f.limit = law.friction_coefficient * pressure_force;
    f.limit_by_pressure = law.friction_coefficient;
  }
  if (law.shear_limit > 0.0 && law.shear_limit * area < f.limit) {
    f.limit = law.shear_limit * area;
    f.limit_by_pressure = 0.0;
    f.at_shear_limit = true;
  }
  f.slip = f.trial_norm > f.limit;
  if (!f.slip) {
    f.at_shear_limit = false;
    return true;
  }
  for (int a = 0; a < T; ++a) {
    f.direction[a] = f.force[a] / f.trial_norm;
    f.raised[a] = raised[a] / f.trial_norm;
    f.force[a] = f.limit * f.direction[a];
  }
  return true;
}

// Where the anchor is at the end (no multiplier): behind xi by the elastic slip that is left.
template <int T>
ENTS_INLINE void dragged_anchor(const double (&xi)[T], const FrictionForce<T>& f, const double* anchor, double (&end)[T]) {
  const double kept = f.slip ? kept_elastic_slip(f.limit, f.trial_norm, f.moved) : 1.0;
  for (int a = 0; a < T; ++a) end[a] = f.slip ? xi[a] - kept * f.moved[a] : anchor[a];
}

// D(rho_e,b) w^b for total variations D: out_a = rho_e,a . D(rho_e,b) w^b + W . D(rho_e,a) with
// W = rho_e,b w^b; that is dA_ab w^b as a vector of dofs. Needs delta xi.
template <class B, bool H, bool Rigid>
ENTS_NOINLINE void metric_variation(const Projection<B, H>& p, const Kinematics<B, H, Rigid>& k,
                                  const double (&w)[B::dim - 1], double (&out)[B::dim - 1][dof_count<B, Rigid>]) {
  constexpr int D = B::dim, T = D - 1, N = dof_count<B, Rigid>;
  Vec<double, D> W = Vec<double, D>::zero();
  for (int b = 0; b < T; ++b) add_scaled(W, w[b], p.s.e[b]);
  unroll<T>([&](auto a) ENTS_LAMBDA_INLINE {
    for (int i = 0; i < N; ++i) out[a][i] = 0.0;
    if constexpr (!Rigid) {
      const auto add_slope = [&](auto b, const Vec<double, D>& c) ENTS_LAMBDA_INLINE {
        Form<B, double> f;
        double v[N];
        form_of_slope<b.value>(p.s, c, f);
        expand<B, Rigid, parts_of_slope<B, H>>(f, p.N, v);
        for (int i = 0; i < N; ++i) out[a][i] += v[i];
      };
      unroll<T>([&](auto b) ENTS_LAMBDA_INLINE { add_slope(b, w[b] * p.s.e[a]); });
      add_slope(a, W);
    }
    for (int c = 0; c < T; ++c) {
      Vec<double, D> bend = Vec<double, D>::zero();  // rho_e,bc w^b
      for (int b = 0; b < T; ++b) add_scaled(bend, w[b], p.s.e2[symmetric_index(b, c)]);
      const double rate = dot(p.s.e[a], bend) + dot(W, p.s.e2[symmetric_index(a, c)]);
      for (int i = 0; i < N; ++i) out[a][i] += rate * k.xi_gradient[c][i];
    }
  });
}

// dt_a by the dofs. limit_gradient: dL/du = - limit_by_pressure lambda' dg
template <class B, bool H, bool Rigid>
ENTS_NOINLINE void friction_gradient(const ContactLaw& law, const Projection<B, H>& p, const Kinematics<B, H, Rigid>& k,
                                   const FrictionForce<B::dim - 1>& f, double area, double normal_stiffness,
                                   double (&dt)[B::dim - 1][dof_count<B, Rigid>]) {
  constexpr int T = B::dim - 1, N = dof_count<B, Rigid>;
  const double scale = law.friction_stiffness * area;
  metric_variation(p, k, f.moved, dt);
  for (int a = 0; a < T; ++a)
    for (int i = 0; i < N; ++i) {
      double metric_xi = f.metric[symmetric_index(a, 0)] * k.xi_gradient[0][i];
      if constexpr (T == 2) metric_xi += f.metric[symmetric_index(a, 1)] * k.xi_gradient[1][i];
      dt[a][i] = scale * (dt[a][i] + metric_xi);
    }
  if (!f.slip) return;
  // |t|^2 = t_a A^ab t_b: d|t| = m^a dt_a - |t| / 2 m^a dA_ab m^b
  double bent[T][N];
  metric_variation(p, k, f.raised, bent);
  const double ratio = f.limit / f.trial_norm, by_gap = -f.limit_by_pressure * normal_stiffness;
  for (int i = 0; i < N; ++i) {
    double d_norm = 0.0;
    for (int a = 0; a < T; ++a) d_norm += f.raised[a] * (dt[a][i] - 0.5 * f.trial_norm * bent[a][i]);
    for (int a = 0; a < T; ++a)
      dt[a][i] = f.direction[a] * by_gap * k.gap_gradient[i] + ratio * (dt[a][i] - f.direction[a] * d_norm);
  }
}

// delta xi^a dt_a + t_a D2xi^a
template <class B, bool H, bool Rigid> struct FrictionTangent {
  static constexpr int T = B::dim - 1, N = dof_count<B, Rigid>;
  double dt[T][N];
  bool exact;  // with D2xi
  ContractedXiHessian<B, H, Rigid> second;

  // no entry, and no partial sum of one, is larger
  ENTS_INLINE double bound(const Kinematics<B, H, Rigid>& k) const {
    double b = exact ? second.bound() : 0.0;
    for (int a = 0; a < T; ++a) b += sum_of_absolutes(k.xi_gradient[a]) * sum_of_absolutes(dt[a]);
    return b;
  }
  ENTS_INLINE void add_to(const Kinematics<B, H, Rigid>& k, double* out, std::int64_t leading) const {
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) {
        double s = k.xi_gradient[0][i] * dt[0][j];
        if constexpr (T == 2) s += k.xi_gradient[1][i] * dt[1][j];
        out[j * leading + i] += s;
      }
    if (exact) second.template write<true>(k, out, leading);
  }
};

}  // namespace ents::ENTS_ISA
