// SPDX-License-Identifier: BSD-3-Clause
// How far the driven motion of a deck can slide one body over the other.
#include "contact_pair.hpp"

#include <algorithm>
#include <cmath>

namespace ents_deck {

Motion prescribed_motion(const Mesh& mesh) {
  Motion out;
  Point low{}, high{};
  bool in_step = false;
  for (const Statement& s : mesh.source.list) {
    if (s.keyword == "STEP") in_step = true;
    if (s.keyword != "BOUNDARY" || !in_step || s.has("SUBMODEL")) continue;
    for (const Line& line : s.lines) {
      const auto fields = fields_of(line.text);
      std::int64_t first = 0, last = 0;
      double value = 0;
      if (fields.size() < 4 || !parse(fields[1], first)) continue; // ENCASTRE ..., or no motion
      if (!parse(fields[2], last)) last = first;
      if (!parse(fields[3], value)) continue;
      out.rotates = out.rotates || (value != 0 && last >= 4 && first <= 6);
      for (std::int64_t dof = std::max<std::int64_t>(first, 1); dof <= std::min<std::int64_t>(last, 3);
           ++dof) {
        const auto i = static_cast<std::size_t>(dof - 1);
        low[i] = std::min(low[i], value), high[i] = std::max(high[i], value);
      }
    }
  }
  for (std::size_t i = 0; i < 3; ++i) out.range[i] = high[i] - low[i];
  return out;
}

} // namespace ents_deck
