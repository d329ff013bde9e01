// SPDX-License-Identifier: BSD-3-Clause
// A normal law that is given by points: the pressure is the monotone piecewise cubic of Steffen (Astron.
// Astrophys. 239 (1990) 443) through them, C1. It ends with slope zero in the last point, where it is zero,
// and continues on a straight line before the first.
#pragma once

#include <cstdint>
#include <vector>

namespace ents {

struct LawTable;

// gap: rising; pressure: falling, the last one 0; at least 2 of each
std::vector<LawTable> make_law_table(const std::vector<double>& gap, const std::vector<double>& pressure);

// Derivatives of W by the gap: the first, the second, W itself, the third
struct TableForce {
  double force, stiffness, energy, third;
};
TableForce table_force(const LawTable* table, std::int32_t points, double gap);

} // namespace ents
