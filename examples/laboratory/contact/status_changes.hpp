// SPDX-License-Identifier: BSD-3-Clause
// Which slave points are closed, stick and slip, and on which segment, from one assembly to the next.
#pragma once

#include <cstdint>
#include <vector>

#include <ents.h>

namespace host {

/// Newton's iteration is quadratic once nothing changes any more.
struct StatusChanges {
  std::vector<char> closed;        ///< [slaves] by the last assembly, or at the begin of the increment
  std::vector<std::int64_t> found; ///< [slaves] segment and status of the last assembly; -1: open
  int all = 0;      ///< points in another status (open, stick, slip), or closed on another segment
  int switches = 0; ///< those of them that opened or closed
  int moves = 0;    ///< those that stayed closed on another segment

  void begin_increment(const std::vector<double>& pressure) {
    closed.clear();
    for (const double p : pressure) closed.push_back(p != 0);
  }

  /// After an assembly. @param flags, segment  [slaves]
  void count(const std::vector<std::int32_t>& flags, const std::vector<std::int64_t>& segment) {
    all = switches = moves = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
      closed[k] = (flags[k] & ENTS_FLAG_CONTACT) != 0;
      const std::int64_t now =
          closed[k] == 0 ? -1 : 2 * segment[k] + ((flags[k] & ENTS_FLAG_SLIP) != 0 ? 1 : 0);
      all += now != found[k];
      switches += (now < 0) != (found[k] < 0);
      moves += now >= 0 && found[k] >= 0 && now / 2 != found[k] / 2;
      found[k] = now;
    }
  }
};

} // namespace host
