// SPDX-License-Identifier: BSD-3-Clause
// Small results of ordinary elements: all but residual and tangent.
#pragma once

#include "core/pair_friction.hpp"
#include "core/pair_inputs.hpp"

namespace ents::ENTS_ISA {

// What they are made of: a copy for where they are wanted. Numbers of a lane are read from memory, where nothing else of a Pair need be.
template <class B, bool F, class S> struct SmallResults {
  static constexpr int D = B::dim, T = D - 1;
  S xi[T], gap, per_gap, area, evaluations;
  Vec<S, D> normal, d, tangents[T]; // n_e, x_s - rho_e, rho_e,a
  std::uint32_t contact, outside;   // bits of lanes, as those below
  std::uint32_t active = 0, slip = 0, at_shear_limit = 0;
  S moved[T], raised[T], limit, norm, scale; // friction

  template <bool H> ENTS_INLINE SmallResults(const Pair<B, H, S>& p, const PairFriction<B, H, S>& f) {
    unroll<T>([&](auto a) ENTS_LAMBDA_INLINE { xi[a] = p.xi[a], tangents[a] = p.projector.s.e[a]; });
    gap = p.gap, per_gap = p.per_gap, area = p.area, evaluations = p.evaluations;
    normal = p.normal, d = p.projector.s.d;
    contact = bits_of(p.contact), outside = bits_of(p.outside);
    if constexpr (F) {
      active = bits_of(f.active), slip = bits_of(f.slip), at_shear_limit = bits_of(f.at_shear_limit);
      unroll<T>([&](auto a) ENTS_LAMBDA_INLINE { moved[a] = f.moved[a], raised[a] = f.raised[a]; });
      limit = f.limit, norm = f.norm, scale = f.scale;
    }
  }

  // Of lane k, to element e
  ENTS_INLINE void write(const Plan& plan, const PairBlock& block, int k, std::int64_t e) const {
    const std::int32_t wanted = block.wanted;
    const bool pair = contact >> k & 1;
    if (wanted & want::xi)
      for (int a = 0; a < T; ++a) block.xi[e * block.xi_stride + a] = lane(xi[a], k);
    const double g = lane(gap, k), stiffness = lane(per_gap, k), of_slave = lane(area, k);
    if (wanted & want::gap) block.gap[e * block.gap_stride] = g;
    if (wanted & want::normal_gap) block.normal_gap[e * block.normal_gap_stride] = g;
    for (int c = 0; c < D; ++c) {
      if (wanted & want::normal) block.normal[e * block.normal_stride + c] = lane(normal[c], k);
      if (wanted & want::point) block.point[e * block.point_stride + c] = block.slave[e * block.slave_stride + c] - lane(d[c], k);
      if (wanted & want::traction) { // t^a rho_e,a / A
        double sum = 0.0;
        if constexpr (F)
          for (int a = 0; a < T; ++a) sum += traction(of_slave, a, k) * lane(tangents[a][c], k);
        block.traction[e * block.traction_stride + c] = sum;
      }
    }
    if (wanted & want::pressure) block.pressure[e * block.pressure_stride] = pair ? 0.0 - stiffness * g : 0.0;
    if (wanted & want::energy)
      block.energy[e * block.energy_stride] = pair ? of_slave * (stiffness * g * g / (0.5 * plan.law.twice_exponent + 1.0)) : 0.0;
    if (wanted & want::iterations) block.iterations[e * block.iterations_stride] = static_cast<std::int32_t>(lane(evaluations, k));
    if (wanted & (want::state | want::flags | want::age | want::slip)) write_history(plan, block, k, e);
  }

private:
  // t^a / A
  ENTS_INLINE double traction(double of_slave, int a, int k) const {
    if (!(active >> k & 1) || !(of_slave > 0.0)) return 0.0;
    return (slip >> k & 1 ? lane(limit, k) * lane(raised[a], k) : lane(scale, k) * lane(moved[a], k)) / of_slave;
  }

  // Where the anchor is at the end, and how far the slave slipped: the elastic slip that is left belongs to the force that is left.
  ENTS_INLINE double move_anchor(int k, double* anchor) const {
    if (!(active >> k & 1)) {
      for (int a = 0; a < T; ++a) anchor[a] = lane(xi[a], k);
      return 0.0;
    }
    double step[T];
    for (int a = 0; a < T; ++a) step[a] = lane(moved[a], k);
    const double kept = slip >> k & 1 ? kept_elastic_slip(lane(limit, k), lane(norm, k), step) : 1.0;
    for (int a = 0; a < T; ++a) anchor[a] = lane(xi[a], k) - kept * step[a];
    const double stiffness = lane(scale, k);
    return kept < 1.0 && stiffness > 0.0 ? (1.0 - kept) * lane(norm, k) / stiffness : 0.0;
  }

  ENTS_INLINE void write_history(const Plan& plan, const PairBlock& block, int k, std::int64_t e) const {
    const std::int32_t wanted = block.wanted;
    const double* begin = element_at(block.state_begin, block.state_begin_stride, e);
    const bool pair = contact >> k & 1, rubs = active >> k & 1, slips = slip >> k & 1;
    const double now = static_cast<double>(!pair ? History::open : slips ? History::slip : History::stick);
    const bool changed = begin && !same_status(begin[StateLayout::history_at], now);
    const double age = begin && !changed ? begin[StateLayout::age_at] + 1.0 : 0.0;
    if (wanted & want::flags)
      block.flags[e * block.flags_stride] = (pair ? flag::contact : 0) | (outside >> k & 1 ? flag::outside : 0) | (changed ? flag::changed : 0) |
                                            (rubs ? (slips ? flag::slip : flag::stick) : 0) | (at_shear_limit >> k & 1 ? flag::shear_limit : 0);
    if (wanted & want::age) block.age[e * block.age_stride] = age;
    double anchor[T], slipped = 0.0;
    if constexpr (F) slipped = (begin ? begin[plan.state.slip_at] : 0.0) + move_anchor(k, anchor);
    if (wanted & want::slip) block.slip[e * block.slip_stride] = slipped;
    if (!(wanted & want::state)) return;
    double* end = block.state_end + e * block.state_end_stride;
    end[StateLayout::tag_at] = plan.state.tag;
    end[StateLayout::history_at] = now;
    end[StateLayout::age_at] = age;
    for (int a = 0; a < T; ++a) end[StateLayout::xi_at + a] = lane(xi[a], k);
    if constexpr (F) {
      for (int a = 0; a < T; ++a) end[plan.state.anchor_at + a] = anchor[a];
      end[plan.state.slip_at] = slipped;
    }
  }
};

} // namespace ents::ENTS_ISA
