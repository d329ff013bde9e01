// SPDX-License-Identifier: BSD-3-Clause
// A call of many elements beside calls of some of them.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "law_elements.hpp"
#include "samples.hpp"

namespace laws {

inline constexpr std::int64_t call_size = 83; // ten registers of eight, and a remainder
inline constexpr std::int32_t call_results =
    ENTS_RESIDUAL | ENTS_TANGENT | ENTS_STATE | ENTS_FLAGS | ENTS_GAP | ENTS_PRESSURE;

/// Heights of one basis and law, in turn: none, and one of the others; with ENTS_TEST_SAMPLES=all every height.
inline std::vector<std::string> heights_in_turn(std::size_t turn) {
  const std::vector<std::string>& all = mechanics::height_kinds();
  if (mechanics::long_divisor() == 1) return all;
  return {all[0], all[1 + turn % (all.size() - 1)]};
}

// Elements first .. of e as a call of their own.
inline LawElements part(const LawElements& e, std::int64_t first, std::int64_t size) {
  LawElements p = e;
  const auto cut = [&](std::vector<double>& v) {
    if (v.empty()) return;
    const std::ptrdiff_t each = static_cast<std::ptrdiff_t>(v.size()) / e.at.count;
    v = std::vector<double>(v.begin() + first * each, v.begin() + (first + size) * each);
  };
  cut(p.at.slave), cut(p.at.master), cut(p.at.surface_coordinates), cut(p.at.start), cut(p.at.area),
      cut(p.state), cut(p.multiplier), cut(p.slave_values), cut(p.slave_temperature),
      cut(p.master_temperature);
  p.at.count = size;
  return p;
}

template <class T> bool same(const std::vector<T>& a, const std::vector<T>& b, std::int64_t first = 0) {
  return b.empty() || std::memcmp(a.data() + first, b.data(), sizeof(T) * b.size()) == 0;
}
// The results of elements first .. in `all`, and `of_part`: the same bits?
inline bool same(const LawResults& all, const LawResults& of_part, std::int64_t first, const ents_layout& l) {
  const std::int64_t n = l.dofs;
  return same(all.status, of_part.status, first) && same(all.flags, of_part.flags, first) &&
         same(all.gap, of_part.gap, first) && same(all.pressure, of_part.pressure, first) &&
         same(all.residual, of_part.residual, first * n) &&
         same(all.tangent, of_part.tangent, first * n * n) &&
         same(all.state, of_part.state, first * l.state_size);
}

} // namespace laws
