// SPDX-License-Identifier: BSD-3-Clause
// What an element remembers from increment to increment.
#pragma once

#include <cstdint>
#include <initializer_list>

namespace ents {

struct ModelSpec;

// State block of an element: where its parts are; -1: not part of it.
enum class History : std::int32_t { none = 0, open = 1, stick = 2, slip = 3 }; // stick: also without friction
// Is the element what it was? One without a history is open.
constexpr bool same_status(double before, double now) {
  return before == now || (before <= 1.0 && now <= 1.0);
}
struct StateLayout {
  static constexpr std::int32_t version = 3;
  static constexpr std::int32_t tag_at = 0, history_at = 1;
  static constexpr std::int32_t age_at = 2; // increments since the last change of status
  static constexpr std::int32_t xi_at = 3;  // [T]
  std::int32_t anchor_at;                   // [T], friction; of an open element see clearance_at
  std::int32_t slip_at;                     // accumulated slip [L], friction
  std::int32_t multiplier_at;               // [1] or, with friction, [1 + T]: augmented Lagrangian
  std::int32_t wear_at;      // [worn_slave, worn_master, pressure, anchor [T]], see below; wear
  std::int32_t bond_at;      // [1] largest gap of a bond [L], 0: no bond; laws that bond
  std::int32_t clearance_at; // of an open element: how far from contact it was [L], in place of an anchor
  std::int32_t size;
  double tag; // "ents", version, basis and kinds of law in one exactly representable number
  // From wear_at on: depth that the slave surface has lost [L]; depth that the master surface has lost here
  // and that no field has yet [L]; pressure [F/L^2] and projection at the end of the increment before
  static constexpr std::int32_t worn_slave = 0, worn_master = 1, worn_pressure = 2, worn_anchor = 3;
};
StateLayout make_state_layout(const ModelSpec& model);
// A block of this layout, with finite numbers and a known history?
inline bool is_state(const StateLayout& layout, const double* state) {
  double zero = 0.0;
  for (int i = 0; i < layout.size; ++i) zero += 0.0 * state[i];
  const double history = state[StateLayout::history_at];
  return zero == 0.0 && state[StateLayout::tag_at] == layout.tag &&
         (history == 0.0 || history == 1.0 || history == 2.0 || history == 3.0);
}

// The numbers that an open element without a segment keeps of the state `before` (or null): the worn depths, and
// the bond.
inline void keep_worn_depths(const StateLayout& layout, const double* before, double* state) {
  if (layout.bond_at >= 0 && before) state[layout.bond_at] = before[layout.bond_at];
  if (layout.wear_at < 0 || !before) return;
  for (const std::int32_t i : {StateLayout::worn_slave, StateLayout::worn_master})
    state[layout.wear_at + i] = before[layout.wear_at + i];
}
inline constexpr int largest_state = 24;

} // namespace ents
