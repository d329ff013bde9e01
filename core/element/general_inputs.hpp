// SPDX-License-Identifier: BSD-3-Clause
// What an element of any law, or each lane's, begins the increment with: its state and its multipliers.
#pragma once

#include "core/element/inputs.hpp"
#include "core/model/slave_values.hpp"
#include "core/tangent/contact_point.hpp"

namespace ents::ENTS_ISA {

// number(k) of element, or lane, k
template <class Scalar, class Number> ENTS_INLINE Scalar of_each(Number&& number) {
  if constexpr (std::is_same_v<Scalar, double>)
    return number(0);
  else
    return each_lane<width_of<Scalar>>(number);
}

ENTS_INLINE bool has_sound_values(const Plan& plan, const ElementBlock& block, std::int64_t e) {
  return check_slave_values(plan.law, element_at(block.slave_values, block.slave_values_stride, e)) ==
         Status::ok;
}

// What an element, or each lane's, is evaluated from.
template <class Basis, bool Enriched, class Scalar> struct GeneralInputs {
  static constexpr int D = Basis::dim, T = D - 1;
  SlipBegin<Scalar, T> begin; // friction, or wear
  Scalar multiplier[1 + T];
  Scalar offset, scale; // of the gap, beside the law's own; of a table or the work of adhesion
  Scalar bond;
  bool has_multiplier, has_wear;
  WornState<Scalar, T> worn;

  ENTS_INLINE GeneralInputs(const Plan& plan, const ElementBlock& block, std::int64_t first) {
    const auto state = [&](int k) ENTS_LAMBDA_INLINE {
      return element_at(block.state_begin, block.state_begin_stride, first + k);
    };
    begin.known = begin.clearance = Scalar(0.0);
    // Without a time no force is asked for (`check_time` in abi), a gap at most.
    begin.time = block.time_increment > 0.0 ? block.time_increment : 1.0;
    for (Scalar& x : begin.from) x = Scalar(0.0);
    for (Scalar& x : multiplier) x = Scalar(0.0);
    if (plan.state.clearance_at >= 0 && block.state_begin) {
      const auto slip = [&](int k)
                            ENTS_LAMBDA_INLINE { return slip_begin<T>(state(k), plan.state.clearance_at); };
      begin.known = of_each<Scalar>([&](int k) ENTS_LAMBDA_INLINE { return slip(k).known; });
      begin.clearance = of_each<Scalar>([&](int k) ENTS_LAMBDA_INLINE { return slip(k).clearance; });
      for (int a = 0; a < T; ++a)
        begin.from[a] = of_each<Scalar>([&](int k) ENTS_LAMBDA_INLINE { return slip(k).from[a]; });
    }
    const int count = plan.law.has_friction() ? 1 + T : 1;
    has_multiplier = plan.law.multiplier_is_dof() || (plan.law.multiplier_in_state() && block.state_begin);
    for (int i = 0; has_multiplier && i < count; ++i)
      multiplier[i] = of_each<Scalar>([&](int k) ENTS_LAMBDA_INLINE {
        return plan.law.multiplier_is_dof()
                   ? element_at(block.multiplier, block.multiplier_stride, first + k)[i]
                   : state(k)[plan.state.multiplier_at + i];
      });
    const auto own = [&](int i, double otherwise) ENTS_LAMBDA_INLINE {
      return !block.slave_values ? Scalar(otherwise) : of_each<Scalar>([&](int k) ENTS_LAMBDA_INLINE {
        return block.slave_values[(first + k) * block.slave_values_stride + i];
      });
    };
    offset = own(slave_value::offset, 0.0);
    scale = plan.law.has_scale ? own(slave_value::scale, 1.0) : Scalar(1.0);
    bond = Scalar(0.0);
    if (plan.state.bond_at >= 0 && block.state_begin)
      bond = of_each<Scalar>([&](int k) ENTS_LAMBDA_INLINE { return state(k)[plan.state.bond_at]; });
    has_wear = plan.law.wear.on;
    if (!has_wear) return;
    worn.factor = own(slave_value::wear, 1.0), worn.sliding_factor = own(slave_value::sliding, 1.0);
    worn.depth = worn.pressure = worn.seen = Scalar(0.0);
    for (Scalar& x : worn.anchor) x = Scalar(0.0);
    if (!block.state_begin) return;
    const auto number = [&](std::int32_t i) ENTS_LAMBDA_INLINE {
      return of_each<Scalar>([&](int k) ENTS_LAMBDA_INLINE { return state(k)[plan.state.wear_at + i]; });
    };
    worn.depth = number(StateLayout::worn_slave) + number(StateLayout::worn_master);
    worn.pressure = number(StateLayout::worn_pressure);
    worn.seen = begin.known;
    for (int a = 0; a < T; ++a)
      worn.anchor[a] = of_each<Scalar>([&](int k) ENTS_LAMBDA_INLINE {
        return slip_begin<T>(state(k), plan.state.wear_at + StateLayout::worn_anchor).from[a];
      });
  }

  // As ContactPoint::evaluate_law() takes them
  ENTS_INLINE const Scalar* multipliers() const { return has_multiplier ? multiplier : nullptr; }
  ENTS_INLINE const WornState<Scalar, T>* worn_or_null() const { return has_wear ? &worn : nullptr; }
};

} // namespace ents::ENTS_ISA
