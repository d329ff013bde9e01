// SPDX-License-Identifier: BSD-3-Clause
// One contact element that may need any care: its inputs are checked, its projection is made safe or searched
// for. What follows from the projection is done by finish_element().
#pragma once

#include "core/model/slave_values.hpp"
#include "core/projection/collapsed_corner.hpp"
#include "core/projection/search.hpp"

namespace ents::ENTS_ISA {

ENTS_INLINE bool all_finite(const double* v, int count) {
  double zero = 0.0;
  for (int i = 0; i < count; ++i) zero += 0.0 * v[i];
  return zero == 0.0;
}

template <class B> ENTS_INLINE bool inputs_finite(const Plan& plan, const ElementInput& in) {
  constexpr int D = B::dim, T = D - 1;
  const int nodes = node_count(basis_of<B>(plan.basis));
  return all_finite(in.multiplier, plan.multipliers) && all_finite(in.slave, D) &&
         all_finite(in.master, D * nodes) &&
         (!in.surface_coordinates || all_finite(in.surface_coordinates, T * nodes)) &&
         (!in.start || all_finite(in.start, T)) && (!in.area || all_finite(in.area, 1));
}

ENTS_INLINE Status status_of(Found found) {
  switch (found) {
  case Found::yes:
    return Status::ok;
  case Found::degenerate:
    return Status::degenerate_segment;
  case Found::grazing:
    return Status::grazing_ray;
  default:
    return Status::no_projection;
  }
}

template <class B, bool H>
Status evaluate_element(const Plan& plan, const ElementInput& in, const ElementOutput& out) {
  constexpr int D = B::dim, T = D - 1;
  if (!inputs_finite<B>(plan, in)) return Status::non_finite;
  if (in.area && *in.area < 0.0) return Status::bad_value;
  if (const Status status = check_slave_values(plan.law, in.slave_values); status != Status::ok)
    return status;
  if (in.state_begin && !is_state(plan.state, in.state_begin)) return Status::bad_state;

  Geometry<B> g(basis_of<B>(plan.basis));
  g.set(in.slave, in.master);
  g.surface_coordinates = in.surface_coordinates ? in.surface_coordinates : plan.surface_coordinates;
  g.height = plan.height;
  Target t;
  if (!set_target<D>(plan, in.slave, t)) return Status::grazing_ray;

  // The iteration starts from the state of an element in contact, else from the caller's start, else it
  // searches the whole segment, since an open slave may have moved over another flank.
  Projection<B, H> p;
  FoundProjection at{};
  const double* start = in.start;
  if (in.state_begin && in.state_begin[StateLayout::history_at] > 1.0 && !(in.start_first && start))
    start = in.state_begin + StateLayout::xi_at;
  Found found = Found::not_converged;
  if (start) {
    for (int a = 0; a < T; ++a) // a start out there has not escaped, it is only bad
      p.xi[a] = start[a] < -far_outside ? -far_outside : (start[a] > far_outside ? far_outside : start[a]);
    found = project(g, t, p);
    // The iteration leaves the segment along an edge without length; the search knows the triangle.
    if ((found == Found::yes || found == Found::escaped) && collapsed_edge(g) >= 0 &&
        (is_in_collapsed_corner<B, H>(g, p.xi) || !on_segment(g.basis, p.xi, plan.border))) {
      Projection<B, H> on_triangle;
      const Search s = search<B, H>(g, t, plan, on_triangle);
      if (s.found == Found::yes && on_segment(g.basis, on_triangle.xi, plan.border)) {
        on_triangle.evaluations += p.evaluations;
        p = on_triangle, found = s.found;
        at.searched = true, at.ambiguous = s.ambiguous;
      }
    }
  }
  if (found != Found::yes && found != Found::escaped) {
    if (start) at.evaluations = p.evaluations;
    const Search s = search<B, H>(g, t, plan, p);
    found = s.found;
    at.ambiguous = s.ambiguous;
    at.searched = true;
  }
  at.escaped = found == Found::escaped;
  const bool verdict_wanted = (out.wanted & want::element) != 0 ||
                              ((out.wanted & want::flags) != 0 && plan.law.normal != NormalKind::none);
  if (found != Found::yes && !(at.escaped && verdict_wanted && !(out.wanted & want::kinematics)))
    return status_of(found);
  at.evaluations += p.evaluations;
  for (int a = 0; a < T; ++a) at.xi[a] = p.xi[a];
  for (int k = 0; k < symmetric_size<T>; ++k) at.f2[k] = p.f2[k];
  return plan.finish(plan, in, out, at);
}

} // namespace ents::ENTS_ISA
