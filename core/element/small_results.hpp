// SPDX-License-Identifier: BSD-3-Clause
// Small results of ordinary elements: all but residual and tangent.
#pragma once

#include "core/element/inputs.hpp"
#include "core/law/normal_force.hpp"

namespace ents::ENTS_ISA {

template <class Basis, bool Enriched, class Scalar> struct ContactPoint; // tangent/contact_point.hpp

// What they are made of: a copy for where they are wanted. Numbers of a lane are read from memory, where
// nothing else of a ProjectedPoint need be.
template <class Basis, bool Frictional, class Scalar> struct SmallResults {
  static constexpr int D = Basis::dim, T = D - 1, K = symmetric_size<T>;
  Scalar xi[T], gap, normal_gap, force, area, evaluations; // force: W'
  Scalar energy = Scalar(0.0); // W of the area, if it is not a penalty's or a power law's
  bool has_energy = false;
  Vec<Scalar, D> normal, d, tangents[T]; // n_e, x_s - rho_e, rho_e,a
  std::uint32_t contact, outside;        // bits of lanes, as those below
  std::uint32_t active = 0, slip = 0, at_shear_limit = 0;
  Scalar moved[T], stretch[T], raised[T], limit, norm, scale; // friction
  Scalar tangential[T], metric[K]; // t_a and rho_e,a . rho_e,b, where the law has multipliers
  Scalar lost;                     // of the increment, where the law has wear
  Scalar clearance;                // of an open element
  Scalar bonded;                   // of a law that bonds, at the end
  std::int32_t more_flags = 0;
  bool escaped = false; // the projection left the segment for good

  // An ordinary element
  template <bool Enriched>
  ENTS_INLINE SmallResults(const ProjectedPoint<Basis, Enriched, Scalar>& p,
                           const Friction<Scalar, Basis::dim - 1>& f) {
    set(p, f);
    normal_gap = gap = p.gap;
    force = p.per_gap * p.gap;
    normal = p.normal;
    clearance = p.gap;
  }
  // Any element
  template <bool Enriched>
  ENTS_INLINE explicit SmallResults(const ContactPoint<Basis, Enriched, Scalar>& at) {
    set(at.point, at.friction);
    gap = at.gap, normal_gap = at.normal_gap, normal = at.normal;
    force = at.law.force;
    energy = area * at.law.energy;
    has_energy = true;
    if constexpr (Frictional)
      for (int a = 0; a < T; ++a) tangential[a] = at.friction.force[a];
    for (int k = 0; k < K; ++k) metric[k] = at.point.projector.metric[k];
    lost = at.wear.lost;
    clearance = at.clearance;
    bonded = at.bonded;
  }

  // Of lane k, to element e
  ENTS_INLINE void write(const Plan& plan, const ElementBlock& block, int k, std::int64_t e) const {
    const std::int32_t wanted = block.wanted;
    const bool touches = contact >> k & 1;
    if (wanted & want::xi)
      for (int a = 0; a < T; ++a) block.xi[e * block.xi_stride + a] = lane(xi[a], k);
    const double g = lane(gap, k), of_slave = lane(area, k);
    if (wanted & want::gap) block.gap[e * block.gap_stride] = g;
    if (wanted & want::normal_gap) block.normal_gap[e * block.normal_gap_stride] = lane(normal_gap, k);
    for (int c = 0; c < D; ++c) {
      if (wanted & want::normal) block.normal[e * block.normal_stride + c] = lane(normal[c], k);
      if (wanted & want::point)
        block.point[e * block.point_stride + c] = block.slave[e * block.slave_stride + c] - lane(d[c], k);
      if (wanted & want::traction) { // t^a rho_e,a / A
        double sum = 0.0;
        if constexpr (Frictional)
          for (int a = 0; a < T; ++a) sum += traction(of_slave, a, k) * lane(tangents[a][c], k);
        block.traction[e * block.traction_stride + c] = sum;
      }
    }
    if (wanted & want::pressure)
      block.pressure[e * block.pressure_stride] = touches ? 0.0 - lane(force, k) : 0.0;
    if (wanted & want::energy) {
      if (has_energy)
        block.energy[e * block.energy_stride] = lane(energy, k);
      else
        block.energy[e * block.energy_stride] =
            touches ? of_slave * (lane(force, k) * g / (0.5 * plan.law.twice_exponent + 1.0)) : 0.0;
    }
    if (wanted & (want::dissipation | want::friction_energy)) write_friction_work(plan, block, k, e);
    if (wanted & want::iterations)
      block.iterations[e * block.iterations_stride] = static_cast<std::int32_t>(lane(evaluations, k));
    if (wanted & (want::state | want::flags | want::age | want::slip)) write_history(plan, block, k, e);
  }

private:
  template <bool Enriched>
  ENTS_INLINE void set(const ProjectedPoint<Basis, Enriched, Scalar>& p,
                       const Friction<Scalar, Basis::dim - 1>& f) {
    unroll<T>([&](auto a) ENTS_LAMBDA_INLINE { xi[a] = p.xi[a], tangents[a] = p.projector.s.e[a]; });
    area = p.area, evaluations = p.evaluations;
    d = p.projector.s.d;
    contact = bits_of(p.contact), outside = bits_of(p.outside);
    if constexpr (Frictional) {
      active = bits_of(f.active), slip = bits_of(f.slip), at_shear_limit = bits_of(f.at_shear_limit);
      unroll<T>([&](auto a) ENTS_LAMBDA_INLINE {
        moved[a] = f.moved[a], stretch[a] = f.stretch[a], raised[a] = f.raised[a];
      });
      limit = f.limit, norm = f.norm, scale = f.scale;
    }
  }

  // t^a / A
  ENTS_INLINE double traction(double of_slave, int a, int k) const {
    if (!(active >> k & 1) || !(of_slave > 0.0)) return 0.0;
    return (slip >> k & 1 ? lane(limit, k) * lane(raised[a], k) : lane(scale, k) * lane(stretch[a], k)) /
           of_slave;
  }

  // What slip and damage have dissipated, and what is stored in the elastic slip; a multiplier stores nothing
  ENTS_INLINE void write_friction_work(const Plan& plan, const ElementBlock& block, int k,
                                       std::int64_t e) const {
    const ContactLaw& law = plan.law;
    double dissipated = 0.0, stored = 0.0;
    if (has_energy && law.is_damaged) {
      const double* begin = element_at(block.state_begin, block.state_begin_stride, e);
      dissipated =
          lane(area, k) * bond_dissipation(law, begin ? begin[plan.state.bond_at] : 0.0, lane(bonded, k));
    }
    if constexpr (Frictional) {
      const bool slips = slip >> k & 1;
      if ((active >> k & 1) && law.multiplier == Multiplier::none) {
        const double stiffness = lane(scale, k), force_left = slips ? lane(limit, k) : lane(norm, k);
        if (slips) dissipated += slip_dissipation(lane(limit, k), lane(norm, k), stiffness);
        if (stiffness > 0.0) stored = 0.5 * force_left * (force_left / stiffness);
      } else if ((active >> k & 1) && slips) {
        for (int a = 0; a < T; ++a) dissipated += lane(tangential[a], k) * lane(moved[a], k);
      }
    }
    if (block.wanted & want::dissipation) block.dissipation[e * block.dissipation_stride] = dissipated;
    if (block.wanted & want::friction_energy)
      block.friction_energy[e * block.friction_energy_stride] = stored;
  }

  // Where the anchor is at the end, and how far the slave slipped: the elastic slip that is left belongs to
  // the force that is left. With multipliers the anchor is where the increment began, and the force is in the
  // multiplier.
  ENTS_INLINE double move_anchor(const ContactLaw& law, int k, double* anchor) const {
    for (int a = 0; a < T; ++a) anchor[a] = lane(xi[a], k);
    if (!(active >> k & 1)) return 0.0;
    double step[T];
    for (int a = 0; a < T; ++a) step[a] = lane(moved[a], k);
    if (law.multiplier_is_dof() || law.multiplier_in_state()) {
      double square = lane(metric[0], k) * step[0] * step[0];
      if constexpr (T == 2)
        square += (2.0 * lane(metric[1], k) * step[0] + lane(metric[2], k) * step[1]) * step[1];
      return slip >> k & 1 ? square_root(absolute(square)) : 0.0;
    }
    const double kept = slip >> k & 1 ? kept_elastic_slip(lane(limit, k), lane(norm, k), step) : 1.0;
    for (int a = 0; a < T; ++a) anchor[a] = lane(xi[a], k) - kept * step[a];
    const double stiffness = lane(scale, k);
    return kept < 1.0 && stiffness > 0.0 ? (1.0 - kept) * lane(norm, k) / stiffness : 0.0;
  }

  // Multipliers at the end of an increment of Uzawa's iteration
  ENTS_INLINE void write_multipliers(const ContactLaw& law, int k, double* to) const {
    to[0] = contact >> k & 1 ? 0.0 - lane(force, k) : 0.0;
    if (Frictional && law.has_friction()) {
      const double of_slave = lane(area, k);
      double kept = 1.0;
      if ((slip >> k & 1) && lane(limit, k) > 0.0)
        kept = kept_multiplier(lane(limit, k),
                               lane(scale, k) * square_root(lane(metric[0], k) + lane(metric[K - 1], k)));
      for (int a = 0; a < T; ++a)
        to[1 + a] = (active >> k & 1) && of_slave > 0.0 ? kept * lane(tangential[a], k) / of_slave : 0.0;
    }
  }

  ENTS_INLINE void write_wear(const Plan& plan, int k, const double* begin, double* state) const {
    double* end = state + plan.state.wear_at;
    const double depth = lane(lost, k), slave = plan.law.wear.slave;
    begin = begin ? begin + plan.state.wear_at : nullptr;
    end[StateLayout::worn_slave] = (begin ? begin[StateLayout::worn_slave] : 0.0) + slave * depth;
    end[StateLayout::worn_master] = (begin ? begin[StateLayout::worn_master] : 0.0) + (1.0 - slave) * depth;
    end[StateLayout::worn_pressure] = contact >> k & 1 ? 0.0 - lane(force, k) : 0.0;
    for (int a = 0; a < T; ++a) end[StateLayout::worn_anchor + a] = escaped ? 0.0 : lane(xi[a], k);
  }

  ENTS_INLINE void write_history(const Plan& plan, const ElementBlock& block, int k, std::int64_t e) const {
    const std::int32_t wanted = block.wanted;
    const double* begin = element_at(block.state_begin, block.state_begin_stride, e);
    const bool touches = contact >> k & 1, rubs = active >> k & 1, slips = slip >> k & 1;
    const double now = static_cast<double>(escaped    ? History::none
                                           : !touches ? History::open
                                           : slips    ? History::slip
                                                      : History::stick);
    const bool changed = begin && !same_status(begin[StateLayout::history_at], now);
    const double age = begin && !changed ? begin[StateLayout::age_at] + 1.0 : 0.0;
    if (wanted & want::flags)
      block.flags[e * block.flags_stride] =
          (touches ? flag::contact : 0) | (outside >> k & 1 ? flag::outside : 0) |
          (changed ? flag::changed : 0) | (rubs ? (slips ? flag::slip : flag::stick) : 0) |
          (Frictional && touches && !rubs && plan.law.has_friction() ? flag::no_begin : 0) |
          (at_shear_limit >> k & 1 ? flag::shear_limit : 0) | more_flags;
    if (wanted & want::age) block.age[e * block.age_stride] = age;
    double anchor[T] = {}, slipped = 0.0;
    if constexpr (Frictional)
      if (plan.state.slip_at >= 0)
        slipped = (begin ? begin[plan.state.slip_at] : 0.0) + move_anchor(plan.law, k, anchor);
    if (wanted & want::slip) block.slip[e * block.slip_stride] = slipped;
    if (!(wanted & want::state)) return;
    double* end = block.state_end + e * block.state_end_stride;
    end[StateLayout::tag_at] = plan.state.tag;
    end[StateLayout::history_at] = now;
    end[StateLayout::age_at] = age;
    for (int a = 0; a < T; ++a) end[StateLayout::xi_at + a] = escaped ? 0.0 : lane(xi[a], k);
    if constexpr (Frictional)
      if (plan.state.slip_at >= 0) {
        for (int a = 0; a < T; ++a) end[plan.state.anchor_at + a] = escaped ? 0.0 : anchor[a];
        end[plan.state.slip_at] = slipped;
      }
    if (plan.state.multiplier_at >= 0) write_multipliers(plan.law, k, end + plan.state.multiplier_at);
    if (plan.state.wear_at >= 0) write_wear(plan, k, begin, end);
    if (has_energy && plan.state.bond_at >= 0) end[plan.state.bond_at] = lane(bonded, k);
    if (plan.state.clearance_at >= 0 && now == static_cast<double>(History::open)) {
      for (int a = 1; a < T; ++a) end[plan.state.clearance_at + a] = 0.0;
      end[plan.state.clearance_at] = lane(clearance, k);
    }
  }
};

} // namespace ents::ENTS_ISA
