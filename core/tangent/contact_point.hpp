// SPDX-License-Identifier: BSD-3-Clause
// An element at its projection, for every law and both projections: covectors of gap and xi, normal force,
// friction.
//
//   delta g    = c . p         c = n_e (normal projection), n_e / (n_e . e) (shadow)
//   delta xi^a = onto^a . p    (shadow), M^ab f_b (normal projection)
//   p = delta x_s - delta rho_e (- g delta e where the ray turns with the slave)
#pragma once

#include "core/law/open_multiplier.hpp"
#include "core/law/worn_depth.hpp"
#include "core/tangent/friction_residual.hpp"

namespace ents::ENTS_ISA {

// The direction of a shadow projection.
template <class Scalar, int D> struct Ray {
  Vec<Scalar, D> e;
  Scalar inverse_distance; // 1 / |emitter - x_s|; 0 for a fixed direction
};

// Coefficients on the slave of c . delta e, e the unit vector from the slave to the emitter.
template <class Scalar, int D>
ENTS_INLINE Vec<Scalar, D> variation_of_ray(const Vec<Scalar, D>& c, const Ray<Scalar, D>& ray) {
  Vec<Scalar, D> v = (-ray.inverse_distance) * c;
  add_scaled(v, ray.inverse_distance * dot(c, ray.e), ray.e);
  return v;
}

template <class Basis, bool Enriched, class Scalar> struct ContactPoint {
  static constexpr int D = Basis::dim, T = D - 1;
  using V = Vec<Scalar, D>;
  ProjectedPoint<Basis, Enriched, Scalar>& point; // its projector is at xi
  const Ray<Scalar, D>* ray = nullptr;            // shadow projection
  Scalar gap, normal_gap, law_gap;                // the last with the offset
  Scalar clearance;            // to the gap from which on there is contact, with what is worn
  Scalar bonded = Scalar(0.0); // number of a law that bonds at the end of the increment
  SlipShare<Scalar> slipping;
  V normal, c, onto[T];    // n_e; onto: shadow
  NormalForce<Scalar> law; // 0 where there is no contact
  Truth<Scalar> safe;      // has the ray a frame, and does it enter the surface from the front?
  Friction<Scalar, Basis::dim - 1> friction;
  WearOfIncrement<Scalar, D> wear; // if the law has it
  Truth<Scalar> solved;            // was its pressure found?

  ENTS_INLINE explicit ContactPoint(ProjectedPoint<Basis, Enriched, Scalar>& at) : point(at) {}

  // Gap and normal; by_nodes: the surface is complete
  ENTS_INLINE typename ProjectedPoint<Basis, Enriched, Scalar>::Measured measure(const Plan& plan,
                                                                                 bool by_nodes = false) {
    const auto& area = point.projector.s.area;
    const auto at = by_nodes ? point.measure_at(plan, true, area * area, false) : point.measure(plan, true);
    gap = normal_gap = point.gap;
    normal = c = point.normal;
    safe = gap <= gap;
    if (ray) set_frame();
    return at;
  }

  // Law, wear and friction; multiplier: the normal one, then T tangential ones, or null; worn: null without
  // wear; offset, scale: of the slave node; bond: of the state.
  ENTS_INLINE void evaluate_law(const Plan& plan, const SlipBegin<Scalar, T>& begin, const Scalar* multiplier,
                                const WornState<Scalar, T>* worn, const Scalar& offset, const Scalar& scale,
                                const Scalar& bond) {
    const Scalar none(0.0), lambda = multiplier ? multiplier[0] : none;
    law_gap = gap + (offset + law_number<Scalar>(plan.law.offset, plan.law.rates.offset));
    clearance = law_gap - touching_gap(plan.law, scale, bond);
    if (worn) {
      clearance = clearance + worn->depth;
      slipping = slip_share(begin.clearance, -clearance);
      set_slid(plan.law, *worn, point.xi, point.projector.s.e, slipping, wear);
      law = worn_force(plan.law, law_gap, lambda, *worn, wear, solved);
    } else {
      solved = gap <= gap;
      law = normal_force(plan.law, law_gap, lambda, scale, bond);
    }
    if (plan.law.bonds) bonded = select(point.outside, bond, next_bond(plan.law, law_gap, bond));
    Truth<Scalar> outside = point.outside;
    if (plan.multipliers > 0) { // a slave without area holds them at zero
      const Truth<Scalar> held = point.area <= 0.0;
      point.area = select(held, Scalar(1.0), point.area);
      outside = either(outside, held);
    }
    point.contact = without(law.contact, outside);
    const Scalar held_energy =
        plan.law.multiplier_is_dof() ? open_multiplier_energy(plan.law.number[0], multiplier[0]) : none;
    law.energy = select(outside, held_energy, law.energy);
    law.force = select(point.contact, law.force, none);
    law.stiffness = select(point.contact, law.stiffness, none);
    if (worn) {
      wear.by_slid = select(point.contact, wear.by_slid, none);
      wear.lost = select(outside, none, wear.lost);
    }
    point.per_gap = plan.law.force_has_slope() ? force_per_gap(plan.law, gap) : none;
    if (plan.law.has_friction()) {
      SlipBegin<Scalar, T> of = begin;
      if (plan.law.multiplier_is_dof()) // these leave no depth, and no measure of the way after the touch
        of.known = select(begin.clearance > 0.0, none, begin.known);
      else if (!worn)
        slipping = slip_share(begin.clearance, -clearance);
      const Scalar press = plan.law.pulls ? point.area * rubbing_pressure(plan.law, law.force, law_gap, scale)
                                          : -(point.area * law.force);
      evaluate_friction(plan.law, point.place(), of, slipping, press, multiplier ? multiplier + 1 : nullptr,
                        friction);
      point.ordinary = both(point.ordinary, friction.ordinary);
    } else {
      friction.set_none();
    }
  }

  // The variation of ds at fixed xi is sum_b form_of_slope<b>(wear.moved[b] m), that by xi:
  ENTS_INLINE void slid_by_xi(Scalar (&by_xi)[T]) const {
    const auto& s = point.projector.s;
    for (int a = 0; a < T; ++a) {
      Vec<Scalar, D> along = slipping.share * s.e[a];
      for (int b = 0; b < T; ++b) add_scaled(along, wear.moved[b], s.e2[symmetric_index(a, b)]);
      by_xi[a] = dot(wear.m, along);
    }
  }

  // The covector whose work is that of both forces under a shadow projection, W' c + t_a onto^a of an area.
  ENTS_INLINE V covector(const Scalar& push, const Scalar (&force)[T]) const {
    V sum = push * c;
    for (int a = 0; a < T; ++a) add_scaled(sum, force[a], onto[a]);
    return sum;
  }

  // R = A W' dg + t_a dxi^a. Shape functions and their derivatives are there.
  ENTS_INLINE void residual(const Plan& plan, Scalar (&out)[dof_count<Basis, false>]) const {
    const bool friction_too = plan.law.has_friction_force();
    V push = (point.area * law.force) * c;
    // in the same roundings as those laws' own kernel
    if (!ray && plan.law.force_has_slope()) push = (point.area * point.per_gap) * point.gap_vector;
    if (!ray && friction_too) {
      friction_residual<false>(point, friction, push, out);
      return;
    }
    for (int a = 0; a < T && friction_too; ++a) add_scaled(push, friction.force[a], onto[a]);
    Form<Basis, Scalar> f;
    form_of_p<Basis, Enriched>(point.projector.s, push, f);
    expand_to_dofs<false, parts_of_p<Enriched>>(point.nodes.basis, f, point.projector.N, out);
    if (ray) {
      const V turn = variation_of_ray(push, *ray);
      for (int i = 0; i < D; ++i) out[i] = out[i] - gap * turn[i];
    }
  }

private:
  ENTS_INLINE void set_frame() {
    const Truth<Scalar> frame = ray_frame(point.projector.s.e, ray->e, onto, c);
    safe = both(frame, dot(normal, ray->e) > 1e-6);
    gap = dot(c, point.projector.s.d);
  }
};

} // namespace ents::ENTS_ISA
