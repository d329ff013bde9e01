// SPDX-License-Identifier: BSD-3-Clause
// Residual and tangent of multipliers that are unknowns, beside those of the nodes.
#pragma once

#include "core/tangent/contact_point.hpp"
#include "core/tangent/tangent_sum.hpp"

namespace ents::ENTS_ISA {

// Dofs of the nodes; those of multipliers come after them.
ENTS_INLINE int node_dofs(const Plan& plan) { return plan.dofs - plan.multipliers; }

// Results of multiplier dofs, of lane k: lambda_n [F/L^2], then lambda_a [F/L] with friction.
template <class Basis, bool Enriched, class Scalar> struct MultiplierEquations {
  static constexpr int T = Basis::dim - 1;
  const Plan& plan;
  const ContactPoint<Basis, Enriched, Scalar>& at;
  const Scalar* multiplier;

  ENTS_INLINE void write_residual(int k, double* out) const {
    const double area = area_of(k);
    out[0] = bits_of(at.point.contact) >> k & 1
                 ? -area * lane(at.law_gap, k)
                 : open_multiplier_residual(plan.law, 0, area, lane(multiplier[0], k));
    for (int a = 1; a < plan.multipliers; ++a)
      out[a] =
          (lane(at.friction.force[a - 1], k) - area * lane(multiplier[a], k)) / plan.law.friction_stiffness;
  }

  // Rows and columns of the multipliers of an element in contact; n: dofs of the nodes
  template <class Sum>
  ENTS_INLINE void write_tangent(int k, const Sum* sum, int n, double* out, std::int64_t leading) const {
    clear(n, out, leading);
    double* column = out + n * leading;
    for (int i = 0; i < n; ++i) column[i] = out[i * leading + n] = -area_of(k) * lane(sum->dg[i], k);
    if constexpr (Sum::friction)
      if (plan.multipliers > 1) write_friction(k, sum, n, out, leading);
  }
  // Of an open one
  ENTS_INLINE void write_open(int k, int n, double* out, std::int64_t leading) const {
    clear(n, out, leading);
    for (int a = 0; a < plan.multipliers; ++a)
      out[(n + a) * leading + n + a] = open_multiplier_tangent(plan.law, a, area_of(k));
  }

  // No entry of these rows and columns is larger.
  template <class Sum> ENTS_INLINE double bound(const Sum& sum) const {
    const auto& f = at.friction;
    if (!f.active || !plan.law.has_friction_force())
      return at.point.area * (sum.size_of(sum.dg) + 1.0 / plan.law.number[0]);
    const double rate = 1.0 / plan.law.friction_stiffness;
    double by_multiplier = at.point.area, nodes = 0.0, bound = 0.0;
    if (f.slip)
      by_multiplier += at.point.area * sum_of_absolutes(f.direction) * sum_of_absolutes(f.raised) *
                       (plan.law.coefficient_varies() ? 1.0 + absolute(f.radial) : 1.0);
    by_multiplier += at.point.area * sum_of_absolutes(f.by_force);
    for (int a = 0; a < T; ++a) {
      bound += rate * sum.size_of(sum.P[a]);
      nodes += sum.size_of(sum.dxi[a]);
    }
    return bound + by_multiplier * (nodes + rate);
  }

private:
  ENTS_INLINE double area_of(int k) const { return lane(at.point.area, k); }
  ENTS_INLINE void clear(int n, double* out, std::int64_t leading) const {
    for (int e = 0; e < plan.multipliers; ++e) {
      for (int i = 0; i < n; ++i) out[(n + e) * leading + i] = out[i * leading + n + e] = 0.0;
      for (int i = 0; i < plan.multipliers; ++i) out[(n + e) * leading + n + i] = 0.0;
    }
  }

  template <class Sum>
  ENTS_INLINE void write_friction(int k, const Sum* sum, int n, double* out, std::int64_t leading) const {
    const auto& f = at.friction;
    const double area = area_of(k), rate = 1.0 / plan.law.friction_stiffness;
    const bool rubs = plan.law.has_friction_force() && (bits_of(f.active) >> k & 1),
               slips = bits_of(f.slip) >> k & 1;
    const double radial = plan.law.coefficient_varies() ? lane(f.radial, k) : 1.0;
    double* column = out + n * leading;
    for (int b = 0; b < T; ++b) {
      double* by_multiplier = out + (n + 1 + b) * leading;
      for (int a = 0; a < T; ++a) {
        double d = 0.0; // dt_a / dlambda_b
        if (rubs) {
          d = a == b ? area : 0.0;
          if (slips)
            d = lane(f.limit, k) / lane(f.norm, k) *
                (d - radial * (area * lane(f.direction[a], k) * lane(f.raised[b], k)));
          for (int i = 0; i < n; ++i) by_multiplier[i] += lane(sum->dxi[a][i], k) * d;
        }
        by_multiplier[n + 1 + a] = rate * (d - (a == b ? area : 0.0));
      }
    }
    if (!rubs) return;
    for (int a = 0; a < T; ++a) {
      for (int i = 0; i < n; ++i) out[i * leading + n + 1 + a] = rate * lane(sum->P[a][i], k);
      const double d = lane(f.by_force[a], k) * area; // the pressure follows lambda_n
      for (int i = 0; i < n; ++i) column[i] += lane(sum->dxi[a][i], k) * d;
      column[n + 1 + a] = rate * d;
    }
  }
};

} // namespace ents::ENTS_ISA
