// SPDX-License-Identifier: BSD-3-Clause
// The element in contact: from gap, xi and their variations to residual and tangent.
//   R = A (dW/dg dg) + t_a dxi^a,   K = A (W'' dg dg^T + W' D2g) + dxi^a dt_a + t_a D2xi^a
// Dofs of multipliers follow those of the nodes: lambda_n [F/L^2], then lambda_a [F/L] with friction.
#pragma once

#include "core/friction.hpp"
#include "core/plan.hpp"

namespace ents::ENTS_ISA {

// What the law makes of a pair.
template <int T> struct ContactForce {
  NormalForce normal;          // per area
  double area;
  bool friction;               // a pair in contact with an anchor
  FrictionForce<T> tangential; // (friction)
};

// May every force, residual and traction of the pair be computed without leaving the range of double precision?
template <int T>
ENTS_INLINE bool law_in_range(const Plan& plan, const ElementInput& in, const ContactForce<T>& c, double gap) {
  double size = c.area * (absolute(c.normal.force) + c.normal.stiffness);
  if (c.friction) size += sum_of_absolutes(c.tangential.force);
  if (plan.multipliers > 0) {  // they come back in the residual, over a stiffness
    size += c.area * (1.0 + absolute(gap) + absolute(in.multiplier[0]) * (1.0 + 1.0 / plan.law.stiffness));
    if (plan.multipliers > 1) {
      double tangential = c.friction ? sum_of_absolutes(c.tangential.force) : 0.0;
      for (int a = 1; a < plan.multipliers; ++a) tangential += c.area * absolute(in.multiplier[a]);
      size += tangential / plan.law.friction_stiffness;
    }
  }
  return size < largest_ingredient;
}

// The tangential multiplier: a dof, in the state, or none.
ENTS_INLINE const double* tangential_multiplier(const Plan& plan, const ElementInput& in) {
  if (!plan.law.has_friction()) return nullptr;
  if (plan.law.multiplier_is_dof()) return in.multiplier + 1;
  if (plan.law.multiplier_in_state() && in.state_begin) return in.state_begin + plan.state.multiplier_at + 1;
  return nullptr;
}
ENTS_INLINE double normal_multiplier(const Plan& plan, const ElementInput& in) {
  if (plan.law.multiplier_is_dof()) return in.multiplier[0];
  if (plan.law.multiplier_in_state() && in.state_begin) return in.state_begin[plan.state.multiplier_at];
  return 0.0;
}

template <class B, bool H, bool Rigid>
ENTS_INLINE void write_residual(const Plan& plan, const ElementInput& in, const ContactForce<B::dim - 1>& c,
                                const Kinematics<B, H, Rigid>& k, bool pair, double* out) {
  constexpr int T = B::dim - 1, N = dof_count<B, Rigid>;
  const double force = c.area * c.normal.force;
  if (pair) {
    for (int i = 0; i < N; ++i) out[i] = force * k.gap_gradient[i];
    if (c.friction)
      for (int a = 0; a < T; ++a)
        for (int i = 0; i < N; ++i) out[i] += c.tangential.force[a] * k.xi_gradient[a][i];
  } else {
    for (int i = 0; i < N; ++i) out[i] = 0.0;
  }
  if (plan.multipliers == 0) return;
  out[N] = pair ? -c.area * k.gap : -c.area / plan.law.stiffness * in.multiplier[0];
  for (int a = 1; a < plan.multipliers; ++a)
    out[N + a] = (c.tangential.force[a - 1] - c.area * in.multiplier[a]) / plan.law.friction_stiffness;
}

// Rows and columns of the multipliers. dt: dt_a by the nodes' dofs (friction).
template <class B, bool H, bool Rigid>
ENTS_INLINE void write_multiplier_tangent(const Plan& plan, const ContactForce<B::dim - 1>& c,
                                          const Kinematics<B, H, Rigid>& k, bool pair,
                                          const double (&dt)[B::dim - 1][dof_count<B, Rigid>], double* out,
                                          std::int64_t leading) {
  constexpr int T = B::dim - 1, N = dof_count<B, Rigid>;
  const int E = plan.multipliers;
  for (int e = 0; e < E; ++e) {
    for (int i = 0; i < N; ++i) out[(N + e) * leading + i] = out[i * leading + N + e] = 0.0;
    for (int f = 0; f < E; ++f) out[(N + e) * leading + N + f] = 0.0;
  }
  double* column = out + N * leading;
  if (pair)
    for (int i = 0; i < N; ++i) column[i] = out[i * leading + N] = -c.area * k.gap_gradient[i];
  else
    column[N] = -c.area / plan.law.stiffness;
  if (E == 1) return;
  const auto& f = c.tangential;
  const double rate = 1.0 / plan.law.friction_stiffness;
  for (int b = 0; b < T; ++b) {  // by lambda_b; b = -1 would be lambda_n, below
    double* by_multiplier = out + (N + 1 + b) * leading;
    for (int a = 0; a < T; ++a) {
      double d = 0.0;  // dt_a / dlambda_b
      if (c.friction) {
        d = a == b ? c.area : 0.0;
        if (f.slip) d = f.limit / f.trial_norm * (d - c.area * f.direction[a] * f.raised[b]);
        for (int i = 0; i < N; ++i) by_multiplier[i] += k.xi_gradient[a][i] * d;
      }
      by_multiplier[N + 1 + a] = rate * (d - (a == b ? c.area : 0.0));
    }
  }
  if (!c.friction) return;
  for (int a = 0; a < T; ++a) {
    for (int i = 0; i < N; ++i) out[i * leading + N + 1 + a] = rate * dt[a][i];
    if (f.slip) {  // the limit follows the pressure, that is lambda_n
      const double d = f.direction[a] * f.limit_by_pressure * c.area;
      for (int i = 0; i < N; ++i) column[i] += k.xi_gradient[a][i] * d;
      column[N + 1 + a] = rate * d;
    }
  }
}

// K of a pair in contact: made first, written when its size is known to be in range.
template <class B, bool H, bool Rigid> struct ContactTangent {
  static constexpr int N = dof_count<B, Rigid>;
  GapProducts<B, H, Rigid> normal;
  FrictionTangent<B, H, Rigid> friction;

  // k holds gap gradient, delta xi (exact, or its small-gap approximation) and slopes as far as `tangent` and
  // friction ask. False where the tangent would leave the range of double precision.
  ENTS_INLINE bool evaluate(const Plan& plan, const Geometry<B>& g, const Projection<B, H>& p, const Target& t,
                            const ContactForce<B::dim - 1>& c, Kinematics<B, H, Rigid>& k, bool exact_xi) {
    const double force = c.area * c.normal.force, stiffness = c.area * c.normal.stiffness;
    const bool small_gap = plan.tangent == TangentKind::small_gap;
    normal.add(k.gap_gradient, stiffness, k.gap_gradient);
    if (plan.tangent != TangentKind::first_variation) {
      if (exact_xi && small_gap) {
        Kinematics<B, H, Rigid> approximate = k;
        evaluate_xi_gradient(p, t, true, approximate);
        add_second_variation(p, t, true, force, approximate, normal);
        k.magnitude = approximate.magnitude;
      } else {
        add_second_variation(p, t, small_gap, force, k, normal);
      }
    }
    if (!(k.magnitude < largest_ingredient)) return false;
    if (!c.friction) return true;
    friction_gradient(plan.law, p, k, c.tangential, c.area, stiffness, friction.dt);
    friction.exact = plan.tangent == TangentKind::consistent;
    if (friction.exact) friction.second.evaluate(g, p, t, k, c.tangential.force);
    double bound = friction.bound(k);
    if (plan.multipliers > 0) {  // their rows: dt over a stiffness, and the products of write_multiplier_tangent
      for (const auto& row : friction.dt) bound += sum_of_absolutes(row) / plan.law.friction_stiffness;
      double by_multiplier = c.area;
      if (c.tangential.slip)
        by_multiplier += c.area * sum_of_absolutes(c.tangential.direction) *
                         (sum_of_absolutes(c.tangential.raised) + c.tangential.limit_by_pressure);
      double nodes = 0.0;
      for (const auto& row : k.xi_gradient) nodes += sum_of_absolutes(row);
      bound += by_multiplier * (nodes + 1.0 / plan.law.friction_stiffness);
    }
    return bound < largest_result;
  }

  ENTS_INLINE void write(const Plan& plan, const ContactForce<B::dim - 1>& c, const Kinematics<B, H, Rigid>& k,
                         double* out, std::int64_t leading) const {
    normal.write(out, leading);
    if (plan.tangent != TangentKind::first_variation)
      add_turning_ray(k, k.c, c.area * c.normal.force, out, leading);
    if (c.friction) friction.add_to(k, out, leading);
    if (plan.multipliers > 0) write_multiplier_tangent(plan, c, k, true, friction.dt, out, leading);
    if (plan.law.symmetrised)
      for (int j = 0; j < plan.dofs; ++j)
        for (int i = j + 1; i < plan.dofs; ++i)
          out[j * leading + i] = out[i * leading + j] = 0.5 * (out[j * leading + i] + out[i * leading + j]);
  }
};

// State at the end: history, place, anchor, slip, multipliers.
template <class B, bool H>
ENTS_INLINE void end_state(const Plan& plan, const ElementInput& in, const Projection<B, H>& p,
                           const ContactForce<B::dim - 1>& c, bool pair, bool escaped, double* end) {
  constexpr int T = B::dim - 1;
  const StateLayout& s = plan.state;
  const History now = escaped ? History::none
                      : !pair ? History::open
                              : (c.friction && c.tangential.slip ? History::slip : History::stick);
  const double before = in.state_begin ? in.state_begin[StateLayout::history_at] : 0.0;
  end[StateLayout::tag_at] = s.tag;
  end[StateLayout::history_at] = static_cast<double>(now);
  end[StateLayout::age_at] =
      in.state_begin && same_status(before, static_cast<double>(now)) ? in.state_begin[StateLayout::age_at] + 1.0 : 0.0;
  for (int a = 0; a < T; ++a) end[StateLayout::xi_at + a] = escaped ? 0.0 : p.xi[a];
  if (s.anchor_at >= 0) {
    double anchor[T];
    double slipped = 0.0;
    for (int a = 0; a < T; ++a) anchor[a] = escaped ? 0.0 : p.xi[a];
    if (c.friction) {
      const double* begin = in.state_begin + s.anchor_at;
      double moved[T], lowered[T];
      // with multipliers the anchor is where the increment began; the force is in the multiplier
      if (!plan.law.multiplier_in_state() && !plan.law.multiplier_is_dof())
        dragged_anchor<T>(p.xi, c.tangential, begin, anchor);
      if (c.tangential.slip) {
        for (int a = 0; a < T; ++a) moved[a] = anchor[a] - begin[a];
        multiply<T>(c.tangential.metric, moved, lowered);
        slipped = square_root(absolute(contract<T>(moved, lowered)));
      }
    }
    for (int a = 0; a < T; ++a) end[s.anchor_at + a] = anchor[a];
    end[s.slip_at] = (in.state_begin ? in.state_begin[s.slip_at] : 0.0) + slipped;
  }
  if (s.multiplier_at >= 0) {
    end[s.multiplier_at] = pair ? -c.normal.force : 0.0;
    if (s.anchor_at >= 0) {
      double kept = 1.0;
      if (c.friction && c.tangential.slip && c.tangential.limit > 0.0) {
        const double (&metric)[symmetric_size<T>] = c.tangential.metric;
        kept = kept_multiplier(c.tangential.limit, plan.law.friction_stiffness * c.area * square_root(metric[0] + metric[symmetric_size<T> - 1]));
      }
      for (int a = 0; a < T; ++a)
        end[s.multiplier_at + 1 + a] = c.friction && c.area > 0.0 ? kept * c.tangential.force[a] / c.area : 0.0;
    }
  }
}

}  // namespace ents::ENTS_ISA
