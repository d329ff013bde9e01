// SPDX-License-Identifier: BSD-3-Clause
// Colours and letters of the maps: the same in the page and in the pictures.
#include <algorithm>
#include <array>
#include <cmath>

#include "chart/chart_page.hpp"

namespace host::chart {

unsigned iterations_color(int iterations) {
  // light to dark blue, a step for each factor of four from 32 on; ColorBrewer's Blues
  static constexpr std::array<unsigned, 5> blues{0xdeebf7, 0xb3d3ea, 0x7fb5da, 0x4292c6, 0x1f64a8};
  const double step = std::log2(std::max(iterations, 1) / 32.) / 2 + 1;
  return blues[static_cast<std::size_t>(std::clamp(std::floor(step), 0., 4.))];
}

Look look_of(const Cell& cell) {
  switch (cell.fate) {
  case Fate::solved:
    return {iterations_color(cell.outcome.iterations), 0};
  case Fate::wrong:
    return {0xd00000, 'W'};
  case Fate::unjudged:
    return {0xc77dff, '?'};
  case Fate::diverged:
    return {0x8d8d8d, 0};
  case Fate::flagged:
    break;
  }
  constexpr unsigned before = 0xffe08a, during = 0xf4a93b; // flagged by the check, or on the way
  switch (cell.outcome.end) {
  case End::fold:
    return {before, 'F'};
  case End::edge:
    return {before, 'E'};
  case End::self_shadow:
    return {before, 'S'};
  case End::crossing:
    return {before, 'X'};
  case End::ambiguous:
    return {during, 'A'};
  case End::behind:
    return {during, 'B'};
  case End::jump:
    return {during, 'J'};
  case End::unstable:
    return {during, 'U'};
  default:
    return {during, static_cast<char>('0' + cell.outcome.status % 10)};
  }
}

} // namespace host::chart
