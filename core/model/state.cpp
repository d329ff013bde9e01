// SPDX-License-Identifier: BSD-3-Clause
#include "core/model/state.hpp"

#include "core/model/model.hpp"

namespace ents {

StateLayout make_state_layout(const ModelSpec& model) {
  const ContactLaw& law = model.law;
  const std::int32_t parameters = basis_entry(model.basis).parameters;
  StateLayout s{-1, -1, -1, -1, -1, -1, StateLayout::xi_at + parameters, 0.0};
  if (law.has_friction()) {
    s.anchor_at = s.size;
    s.slip_at = s.anchor_at + parameters;
    s.size = s.slip_at + 1;
  }
  if (law.multiplier_in_state()) {
    s.multiplier_at = s.size;
    s.size += law.has_friction() ? 1 + parameters : 1;
  }
  if (law.wear.on) {
    s.wear_at = s.size;
    s.size += StateLayout::worn_anchor + parameters;
  }
  if (law.bonds) s.bond_at = s.size++;
  s.clearance_at = s.anchor_at >= 0 ? s.anchor_at
                   : s.wear_at >= 0 ? s.wear_at + StateLayout::worn_anchor
                                    : -1;
  constexpr double ents = 1701737587.0; // the four letters
  const auto basis = static_cast<std::int32_t>(model.basis), normal = static_cast<std::int32_t>(law.normal),
             friction = static_cast<std::int32_t>(law.friction);
  s.tag = ents * 65536.0 + (((StateLayout::version * 32 + basis) * 16 + normal) * 4 + friction) +
          (law.wear.on ? 32768.0 : 0.0);
  return s;
}

} // namespace ents
