// SPDX-License-Identifier: BSD-3-Clause
// One contact element: projection, gap, law, residual and tangent. What is not wanted is not computed.
#pragma once

#include "core/contact.hpp"
#include "core/search.hpp"

namespace ents::ENTS_ISA {

template <int N> ENTS_INLINE bool all_finite(const double* v) {
  double zero = 0.0;
  for (int i = 0; i < N; ++i) zero += 0.0 * v[i];
  return zero == 0.0;
}

template <class B> ENTS_INLINE bool inputs_finite(const Plan& plan, const ElementInput& in) {
  constexpr int D = B::dim, T = D - 1;
  for (int i = 0; i < plan.multipliers; ++i)
    if (!all_finite<1>(in.multiplier + i)) return false;
  return all_finite<D>(in.slave) && all_finite<D * B::nodes>(in.master) &&
         (!in.surface_coordinates || all_finite<T * B::nodes>(in.surface_coordinates)) &&
         (!in.start || all_finite<T>(in.start)) && (!in.area || all_finite<1>(in.area));
}

ENTS_INLINE Status status_of(Found found) {
  switch (found) {
    case Found::yes: return Status::ok;
    case Found::degenerate: return Status::degenerate_segment;
    case Found::grazing: return Status::grazing_ray;
    default: return Status::no_projection;
  }
}

template <int N> ENTS_INLINE void copy(const double (&from)[N], double* to) {
  for (int i = 0; i < N; ++i) to[i] = from[i];
}

inline constexpr int largest_state = 16;

// The model's limit, or the size of the segment.
template <class B, bool H> ENTS_INLINE double penetration_limit(const Plan& plan, const Projection<B, H>& p) {
  if (plan.penetration_limit > 0.0) return plan.penetration_limit;
  double size = dot(p.s.a[0], p.s.a[0]);
  if constexpr (B::dim == 3) size += dot(p.s.a[1], p.s.a[1]);
  return (B::simplex ? 1.0 : 2.0) * square_root(size);
}

// Second variations that few hosts ask for; kept out of the element's own instruction stream. False, and nothing
// written, where a result would leave the range of double precision.
template <class B, bool H, bool Rigid>
ENTS_NOINLINE bool write_hessians(const Geometry<B>& g, const Projection<B, H>& p, const Target& t, const Plan& plan,
                                  const Kinematics<B, H, Rigid>& exact, const ElementOutput& out) {
  constexpr int N = dof_count<B, Rigid>;
  const bool gap = (out.wanted & want::gap_hessian) != 0;
  const bool products = gap && plan.tangent != TangentKind::first_variation;
  GapProducts<B, H, Rigid> sum;
  if (products) {
    Kinematics<B, H, Rigid> k = exact;
    const bool small_gap = plan.tangent == TangentKind::small_gap;
    if (small_gap) evaluate_xi_gradient(p, t, true, k);
    add_second_variation(p, t, small_gap, 1.0, k, sum);
    if (!(sum.bound() < largest_result)) return false;
  }
  if ((out.wanted & want::xi_hessian) != 0 && !write_xi_hessian(g, p, t, exact, out.xi_hessian)) return false;
  if (products) {
    sum.write(out.gap_hessian, N);
    add_turning_ray(exact, exact.c, 1.0, out.gap_hessian, N);
  } else if (gap) {
    for (int i = 0; i < N * N; ++i) out.gap_hessian[i] = 0.0;
  }
  return true;
}

// Everything of the law for a pair that is not in contact.
template <class B, bool H, bool Rigid>
ENTS_INLINE void write_open(const Plan& plan, const ElementInput& in, const ContactForce<B::dim - 1>& c,
                            const Kinematics<B, H, Rigid>& k, const ElementOutput& out) {
  if (out.wanted & want::residual) write_residual(plan, in, c, k, false, out.residual);
  if (out.wanted & want::tangent) {
    const std::int64_t leading = out.tangent_leading_dimension;
    for (int j = 0; j < dof_count<B, Rigid>; ++j)
      for (int i = 0; i < dof_count<B, Rigid>; ++i) out.tangent[j * leading + i] = 0.0;
    const double dt[B::dim - 1][dof_count<B, Rigid>] = {};
    if (plan.multipliers > 0) write_multiplier_tangent(plan, c, k, false, dt, out.tangent, leading);
  }
}

// T^a = A^ab t_b rho_e,a / A: the tangential traction that the slave exerts on the master
template <class B, bool H>
ENTS_INLINE void evaluate_traction(const Projection<B, H>& p, const ContactForce<B::dim - 1>& c,
                                   double (&out)[B::dim]) {
  constexpr int D = B::dim, T = D - 1;
  Vec<double, D> v = Vec<double, D>::zero();
  if (c.friction && c.area > 0.0) {
    double raised[T];
    multiply<T>(c.tangential.inverse_metric, c.tangential.force, raised);
    for (int a = 0; a < T; ++a) add_scaled(v, raised[a] / c.area, p.s.e[a]);
  }
  for (int i = 0; i < D; ++i) out[i] = v[i];
}

template <class B, bool H, bool Rigid>
Status evaluate_element(const Plan& plan, const ElementInput& in, const ElementOutput& out) {
  constexpr int D = B::dim, T = D - 1, N = dof_count<B, Rigid>;
  const std::int32_t wanted = out.wanted;
  const bool element = (wanted & want::element) != 0;
  // flags are those of the element; alone, or with kinematics, they refuse nothing
  const bool judged = element || ((wanted & want::flags) != 0 && plan.law.normal != NormalKind::none);
  if (!inputs_finite<B>(plan, in)) return Status::non_finite;
  if (in.area && *in.area < 0.0) return Status::bad_value;
  if (in.state_begin && !is_state(plan.state, in.state_begin)) return Status::bad_state;

  Geometry<B> g;
  g.set(in.slave, in.master);
  g.surface_coordinates = in.surface_coordinates ? in.surface_coordinates : plan.surface_coordinates;
  g.height = plan.height;
  Target t;
  if (!set_target<D>(plan, in.slave, t)) return Status::grazing_ray;

  // start: that of a history in contact, else the caller's, else the whole segment: a slave that is open may be over another flank by now
  Projection<B, H> p;
  std::int32_t spent = 0;
  const double* start = in.start;
  History history = History::none;
  if (in.state_begin) {
    history = static_cast<History>(static_cast<int>(in.state_begin[StateLayout::history_at]));
    if (history > History::open && !(in.start_first && start)) start = in.state_begin + StateLayout::xi_at;
  }
  std::int32_t flags = 0;
  Found found = Found::not_converged;
  bool ambiguous = false;
  if (start) {
    for (int a = 0; a < T; ++a)  // a start out there has not escaped, it is only bad
      p.xi[a] = start[a] < -far_outside ? -far_outside : (start[a] > far_outside ? far_outside : start[a]);
    found = project(g, t, p);
  }
  if (found != Found::yes && found != Found::escaped) {
    if (start) spent = p.evaluations;
    const Search s = search<B, H>(g, t, plan, p);
    found = s.found;
    ambiguous = s.ambiguous;
    flags |= flag::searched;
  }
  const bool escaped = found == Found::escaped;
  if (found != Found::yes && !(escaped && judged && !(wanted & want::kinematics))) return status_of(found);

  Kinematics<B, H, Rigid> k;
  if (!evaluate_gap(p, t, k))
    return t.kind == ProjectionKind::normal ? Status::degenerate_segment : Status::grazing_ray;
  if (!(absolute(k.gap) < largest_ingredient) || !(max_norm(p.xi) < 1e15)) return Status::out_of_range;
  if (escaped || !on_segment<B>(p.xi, plan.border)) flags |= flag::outside;
  if (t.kind == ProjectionKind::normal && !is_minimum(p.f2, p.metric)) flags |= flag::far_side;

  ContactForce<T> c{};
  c.area = in.area ? *in.area : 1.0;
  if (judged) c.normal = normal_force(plan.law, k.gap, normal_multiplier(plan, in));
  const bool holds_multipliers = plan.multipliers > 0 && c.area == 0.0; // a slave without area holds them at zero
  if (holds_multipliers) c.area = 1.0;
  const bool outside = (flags & flag::outside) || holds_multipliers;
  const bool pair = judged && c.normal.contact && !outside;
  if (pair) flags |= flag::contact;
  if (pair && element) {
    if (flags & flag::far_side) return Status::singular_projection;
    if (ambiguous) return Status::ambiguous_projection;
    // a ray that leaves the surface from behind would push the slave further in
    if (t.kind != ProjectionKind::normal && !(dot(k.normal, k.ray) > 1e-6)) return Status::grazing_ray;
    if (-k.gap > penetration_limit(plan, p)) return Status::deep_penetration;
  } else if (element && outside) {
    c.normal.energy = plan.law.multiplier_is_dof() ? -0.5 * in.multiplier[0] * in.multiplier[0] / plan.law.stiffness : 0.0;
  }
  // a pair that has just come into contact has no anchor yet: it gets one at the end
  c.friction = pair && plan.law.has_friction() && (history == History::stick || history == History::slip);

  const bool forces = pair && (wanted & (want::residual | want::tangent));
  const bool second = pair && (wanted & want::tangent) && plan.tangent != TangentKind::first_variation;
  const bool hessians = (wanted & (want::gap_hessian | want::xi_hessian)) != 0;
  const bool exact_xi = (wanted & (want::xi_gradient | want::xi_hessian | want::gap_hessian)) != 0 || (forces && c.friction);
  const bool friction_tangent = c.friction && (wanted & want::tangent);
  if ((wanted & want::kinematics) || forces) evaluate_gap_gradient(p, k);
  if (t.kind != ProjectionKind::normal && (hessians || second || friction_tangent))
    evaluate_surface<2>(g, p.xi, p.N, p.s);
  if (exact_xi || second) {
    if (t.kind == ProjectionKind::normal || hessians || second) evaluate_slopes(p, k);
    const bool small_gap = plan.tangent == TangentKind::small_gap;
    if (!evaluate_xi_gradient(p, t, !exact_xi && small_gap, k)) return Status::singular_projection;
  }
  if (c.friction &&
      !evaluate_friction(plan.law, p, in.state_begin + plan.state.anchor_at, tangential_multiplier(plan, in),
                         -c.area * c.normal.force, c.area, c.tangential)) {
    if (element) return Status::degenerate_segment;
    c.friction = false;
  }
  if (c.friction) flags |= c.tangential.slip ? flag::slip : flag::stick;
  if (c.friction && c.tangential.at_shear_limit) flags |= flag::shear_limit;
  if (!(k.magnitude < largest_ingredient)) return Status::out_of_range;

  // all that may go out of range first: after it everything is written
  const double energy = c.area * c.normal.energy;
  double traction[D] = {}, end[largest_state];
  if (judged) {
    if (element && !law_in_range(plan, in, c, k.gap)) return Status::out_of_range;
    if ((wanted & want::energy) && !(absolute(energy) < largest_result)) return Status::out_of_range;
    if (wanted & want::traction) {
      evaluate_traction(p, c, traction);
      if (!(sum_of_absolutes(traction) < largest_result)) return Status::out_of_range;
    }
    if (wanted & (want::state | want::slip | want::age | want::flags)) {
      end_state(plan, in, p, c, pair, escaped, end);
      double size = 0.0;
      for (int i = 0; i < plan.state.size; ++i) size += absolute(end[i]);
      if (element && !(size < largest_result)) return Status::out_of_range;
      if (in.state_begin && !same_status(in.state_begin[StateLayout::history_at], end[StateLayout::history_at])) flags |= flag::changed;
    }
  }
  ContactTangent<B, H, Rigid> tangent;
  if (pair && (wanted & want::tangent) && !tangent.evaluate(plan, g, p, t, c, k, exact_xi)) return Status::out_of_range;
  if (hessians && !write_hessians(g, p, t, plan, k, out)) return Status::out_of_range;

  if (pair) {
    if (wanted & want::tangent) tangent.write(plan, c, k, out.tangent, out.tangent_leading_dimension);
    if (wanted & want::residual) write_residual(plan, in, c, k, true, out.residual);
  } else if (element) {
    write_open(plan, in, c, k, out);
  }
  if (wanted & want::energy) *out.energy = energy;
  if (wanted & want::pressure) *out.pressure = pair ? 0.0 - c.normal.force : 0.0;
  if (element) {
    if (wanted & want::traction) copy(traction, out.traction);
    if (wanted & want::state)
      for (int i = 0; i < plan.state.size; ++i) out.state_end[i] = end[i];
    if (wanted & want::slip) *out.slip = plan.state.slip_at >= 0 ? end[plan.state.slip_at] : 0.0;
    if (wanted & want::age) *out.age = end[StateLayout::age_at];
  }

  if (wanted & want::xi) copy(p.xi, out.xi);
  if (wanted & want::gap) *out.gap = k.gap;
  if (wanted & want::normal_gap) *out.normal_gap = k.normal_gap;
  if (wanted & want::normal) copy(k.normal.c, out.normal);
  if (wanted & want::point)
    for (int i = 0; i < D; ++i) out.point[i] = in.slave[i] - p.s.d[i];
  if (wanted & want::gap_gradient) copy(k.gap_gradient, out.gap_gradient);
  if (wanted & want::xi_gradient)
    for (int a = 0; a < T; ++a) copy(k.xi_gradient[a], out.xi_gradient + a * N);
  if (wanted & want::flags) *out.flags = flags;
  if (wanted & want::iterations) *out.iterations = spent + p.evaluations;
  return Status::ok;
}

}  // namespace ents::ENTS_ISA
