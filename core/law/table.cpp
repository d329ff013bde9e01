// SPDX-License-Identifier: BSD-3-Clause
#include "core/law/table.hpp"

#include <algorithm>
#include <cstddef>

namespace ents {
namespace {

// The cubic from point a to point b, from_a behind a
TableForce between(const LawTable& a, const LawTable& b, double from_a) {
  const double h = b.gap - a.gap, t = from_a / h, rise = (b.force - a.force) / h;
  const double c2 = 3.0 * rise - 2.0 * a.stiffness - b.stiffness, c3 = a.stiffness + b.stiffness - 2.0 * rise;
  return {a.force + h * t * (a.stiffness + t * (c2 + t * c3)), a.stiffness + t * (2.0 * c2 + t * (3.0 * c3)),
          a.energy + h * t * (a.force + h * t * (0.5 * a.stiffness + t * (c2 / 3.0 + t * (0.25 * c3)))),
          (2.0 * c2 + 6.0 * c3 * t) / h};
}

} // namespace

std::vector<LawTable> make_law_table(const std::vector<double>& gap, const std::vector<double>& pressure) {
  const std::size_t n = gap.size();
  std::vector<LawTable> table(n);
  for (std::size_t i = 0; i < n; ++i) table[i].gap = gap[i], table[i].force = 0.0 - pressure[i];
  const auto length = [&](std::size_t i) { return gap[i + 1] - gap[i]; };
  const auto rise = [&](std::size_t i) { return (table[i + 1].force - table[i].force) / length(i); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = rise(i - 1), after = rise(i);
    const double parabola = (before * length(i) + after * length(i - 1)) / (length(i - 1) + length(i));
    table[i].stiffness = std::min(2.0 * std::min(before, after), parabola);
  }
  if (n == 2) {
    table[0].stiffness = 2.0 * rise(0); // a parabola, which has slope zero at its end
  } else {
    const double share = length(0) / (length(0) + length(1));
    table[0].stiffness = std::clamp(rise(0) * (1.0 + share) - rise(1) * share, rise(0), 2.0 * rise(0));
  }
  for (std::size_t i = n - 1; i-- > 0;) // W is zero in the last point; so far in point i, too
    table[i].energy = table[i + 1].energy - between(table[i], table[i + 1], length(i)).energy;
  return table;
}

TableForce table_force(const LawTable* table, std::int32_t points, double gap) {
  const LawTable &first = table[0], &last = table[points - 1];
  if (!(gap < last.gap)) return {0.0, 0.0, 0.0, 0.0};
  if (gap < first.gap) {
    const double deep = gap - first.gap;
    return {first.force + first.stiffness * deep, first.stiffness,
            first.energy + deep * (first.force + 0.5 * first.stiffness * deep), 0.0};
  }
  const LawTable* after = std::upper_bound(table, table + points, gap,
                                           [](double g, const LawTable& point) { return g < point.gap; });
  return between(after[-1], after[0], gap - after[-1].gap);
}

} // namespace ents
