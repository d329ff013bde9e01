// SPDX-License-Identifier: BSD-3-Clause
// One contact element: projection, gap, penalty law, residual and tangent. What is not wanted is not computed.
//
// Penalty law, A the tributary area: W = eps A g^2 / 2 for g < 0, R = lambda dg, K = lambda' dg dg^T + lambda D2g
// with lambda = eps A g, lambda' = eps A.
#pragma once

#include "core/search.hpp"
#include "core/xi_hessian.hpp"

namespace ents::ENTS_ISA {

template <int N> ENTS_INLINE bool all_finite(const double* v) {
  double zero = 0.0;
  for (int i = 0; i < N; ++i) zero += 0.0 * v[i];
  return zero == 0.0;
}

template <class B> ENTS_INLINE bool inputs_finite(const ElementInput& in) {
  constexpr int D = B::dim, T = D - 1;
  return all_finite<D>(in.slave) && all_finite<D * B::nodes>(in.master) &&
         (!in.surface_coordinates || all_finite<T * B::nodes>(in.surface_coordinates)) &&
         (!in.start || all_finite<T>(in.start)) && (!in.area || all_finite<1>(in.area));
}

// A block that ents_state_init or an evaluation wrote?
template <int T> ENTS_INLINE bool is_state(const double* state) {
  const double history = state[1];
  return all_finite<2 + T>(state) && state[0] == state_tag(T) &&
         (history == static_cast<double>(History::none) || history == static_cast<double>(History::open) ||
          history == static_cast<double>(History::contact));
}

ENTS_INLINE Status status_of(Found found) {
  switch (found) {
    case Found::yes: return Status::ok;
    case Found::degenerate: return Status::degenerate_segment;
    case Found::grazing: return Status::grazing_ray;
    default: return Status::no_projection;
  }
}

// The ray of this element. False if the slave sits on the emitter.
template <int D> ENTS_INLINE bool set_target(const Plan& plan, const double* slave, Target& t) {
  t.kind = plan.projection;
  t.inverse_distance = 0.0;
  for (int c = 0; c < D; ++c) t.ray[c] = plan.ray[c];
  if (plan.projection != ProjectionKind::shadow_point) return true;
  Vec<double, D> r;
  for (int c = 0; c < D; ++c) r[c] = plan.ray[c] - slave[c];
  const double length = square_root(dot(r, r));
  if (!(length > 1e-150) || !(length < 1e150)) return false;
  t.inverse_distance = 1.0 / length;
  for (int c = 0; c < D; ++c) t.ray[c] = r[c] * t.inverse_distance;
  return true;
}

template <int N> ENTS_INLINE void copy(const double (&from)[N], double* to) {
  for (int i = 0; i < N; ++i) to[i] = from[i];
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

template <class B, bool Rigid> ENTS_INLINE void write_open(const ElementOutput& out) {
  constexpr int N = dof_count<B, Rigid>;
  if (out.wanted & want::energy) *out.energy = 0.0;
  if (out.wanted & want::pressure) *out.pressure = 0.0;
  if (out.wanted & want::residual)
    for (int i = 0; i < N; ++i) out.residual[i] = 0.0;
  if (out.wanted & want::tangent)
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) out.tangent[j * out.tangent_leading_dimension + i] = 0.0;
}

template <class B, bool H, bool Rigid>
Status evaluate_element(const Plan& plan, const ElementInput& in, const ElementOutput& out) {
  constexpr int D = B::dim, T = D - 1, N = dof_count<B, Rigid>;
  const std::int32_t wanted = out.wanted;
  const bool element = (wanted & want::element) != 0;
  if (!inputs_finite<B>(in)) return Status::non_finite;
  if (in.area && *in.area < 0.0) return Status::bad_value;
  if (in.state_begin && !is_state<T>(in.state_begin)) return Status::bad_state;

  Geometry<B> g;
  g.set(in.slave, in.master);
  g.surface_coordinates = in.surface_coordinates ? in.surface_coordinates : plan.surface_coordinates;
  g.height = plan.height;
  Target t;
  if (!set_target<D>(plan, in.slave, t)) return Status::grazing_ray;

  // start: the history, else the caller's, else the whole segment
  Projection<B, H> p;
  const double* start = in.start;
  if (in.state_begin && in.state_begin[1] != static_cast<double>(History::none)) start = in.state_begin + 2;
  std::int32_t flags = 0;
  Found found = Found::not_converged;
  bool ambiguous = false;
  std::int32_t spent = 0;
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
  if (found != Found::yes && !(escaped && element && !(wanted & want::kinematics))) return status_of(found);

  Kinematics<B, H, Rigid> k;
  if (!evaluate_gap(p, t, k))
    return t.kind == ProjectionKind::normal ? Status::degenerate_segment : Status::grazing_ray;
  if (!(absolute(k.gap) < largest_ingredient) || !(max_norm(p.xi) < 1e15)) return Status::out_of_range;
  if (escaped || !on_segment<B>(p.xi)) flags |= flag::outside;
  if (t.kind == ProjectionKind::normal && !is_minimum(p.f2, p.metric)) flags |= flag::far_side;
  const double area = in.area ? *in.area : 1.0;
  const bool contact = element && k.gap < 0.0 && !(flags & flag::outside);
  if (contact) {
    flags |= flag::contact;
    if (flags & flag::far_side) return Status::singular_projection;
    if (ambiguous) return Status::ambiguous_projection;
    // a ray that leaves the surface from behind would push the slave further in
    if (t.kind != ProjectionKind::normal && !(dot(k.normal, k.ray) > 1e-6)) return Status::grazing_ray;
    double limit = plan.penetration_limit;
    if (limit == 0.0) {
      double size = dot(p.s.a[0], p.s.a[0]);
      if constexpr (T == 2) size += dot(p.s.a[1], p.s.a[1]);
      limit = (B::simplex ? 1.0 : 2.0) * square_root(size);
    }
    if (-k.gap > limit) return Status::deep_penetration;
  }

  const bool tangent = contact && (wanted & want::tangent) && plan.tangent != TangentKind::first_variation;
  const bool second = (wanted & (want::gap_hessian | want::xi_hessian)) != 0;
  if ((wanted & want::kinematics) || (contact && (wanted & (want::residual | want::tangent))))
    evaluate_gap_gradient(p, k);
  const bool exact_xi = (wanted & (want::xi_gradient | want::xi_hessian | want::gap_hessian)) != 0;
  const bool small_gap = plan.tangent == TangentKind::small_gap;
  if (exact_xi || tangent) {
    if (t.kind != ProjectionKind::normal && (second || tangent)) evaluate_surface<2>(g, p.xi, p.N, p.s);
    if (t.kind == ProjectionKind::normal || second || tangent) evaluate_slopes(p, k);
    if (!evaluate_xi_gradient(p, t, !exact_xi && small_gap, k)) return Status::singular_projection;
  }
  if (!(k.magnitude < largest_ingredient)) return Status::out_of_range;

  // all that may go out of range first: after it everything is written
  const double stiffness = plan.penalty_stiffness * area, force = stiffness * k.gap;
  GapProducts<B, H, Rigid> sum;
  if (contact) {
    if (!(stiffness < largest_ingredient) || !(absolute(force) < largest_ingredient)) return Status::out_of_range;
    if (wanted & want::tangent) {
      sum.add(k.gap_gradient, stiffness, k.gap_gradient);
      if (tangent) {
        if (exact_xi && small_gap) {
          Kinematics<B, H, Rigid> approximate = k;
          evaluate_xi_gradient(p, t, true, approximate);
          add_second_variation(p, t, true, force, approximate, sum);
          k.magnitude = approximate.magnitude;
        } else {
          add_second_variation(p, t, small_gap, force, k, sum);
        }
        if (!(k.magnitude < largest_ingredient)) return Status::out_of_range;
      }
    }
  }
  if (second && !write_hessians(g, p, t, plan, k, out)) return Status::out_of_range;

  if (contact) {
    if (wanted & want::tangent) {
      sum.write(out.tangent, out.tangent_leading_dimension);
      if (tangent) add_turning_ray(k, k.c, force, out.tangent, out.tangent_leading_dimension);
    }
    if (wanted & want::residual)
      for (int i = 0; i < N; ++i) out.residual[i] = force * k.gap_gradient[i];
    if (wanted & want::energy) *out.energy = 0.5 * force * k.gap;
    if (wanted & want::pressure) *out.pressure = -plan.penalty_stiffness * k.gap;
  } else if (element) {
    write_open<B, Rigid>(out);
  }

  if (wanted & want::xi) copy(p.xi, out.xi);
  if (wanted & want::gap) *out.gap = k.gap;
  if (wanted & want::normal_gap) *out.normal_gap = k.normal_gap;
  if (wanted & want::normal) copy(k.normal.c, out.normal);
  if (wanted & want::point)
    for (int c = 0; c < D; ++c) out.point[c] = in.slave[c] - p.s.d[c];
  if (wanted & want::gap_gradient) copy(k.gap_gradient, out.gap_gradient);
  if (wanted & want::xi_gradient)
    for (int a = 0; a < T; ++a) copy(k.xi_gradient[a], out.xi_gradient + a * N);
  if (wanted & want::state) {
    out.state_end[0] = state_tag(T);
    out.state_end[1] = static_cast<double>(escaped ? History::none : contact ? History::contact : History::open);
    for (int a = 0; a < T; ++a) out.state_end[2 + a] = escaped ? 0.0 : p.xi[a];
  }
  if (wanted & want::flags) *out.flags = flags;
  if (wanted & want::iterations) *out.iterations = spent + p.evaluations;
  return Status::ok;
}

}  // namespace ents::ENTS_ISA
