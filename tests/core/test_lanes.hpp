// SPDX-License-Identifier: BSD-3-Clause
// A vector scalar of four numbers, to show that the kernel's templates take one and give each lane the bits
// of the plain number.
#pragma once

#include "core/height.hpp"

namespace ents::ENTS_ISA {

struct Lanes {
  static constexpr int count = 4;
  double lane[count];
  Lanes() = default;
  Lanes(double value) : lane{value, value, value, value} {}
};

struct LaneMask {
  bool lane[Lanes::count];
};

template <class F> Lanes each_lane(F f) {
  Lanes r;
  for (int i = 0; i < Lanes::count; ++i) r.lane[i] = f(i);
  return r;
}

inline Lanes operator+(Lanes a, Lanes b) {
  return each_lane([&](int i) { return a.lane[i] + b.lane[i]; });
}
inline Lanes operator-(Lanes a, Lanes b) {
  return each_lane([&](int i) { return a.lane[i] - b.lane[i]; });
}
inline Lanes operator*(Lanes a, Lanes b) {
  return each_lane([&](int i) { return a.lane[i] * b.lane[i]; });
}
inline Lanes operator/(Lanes a, Lanes b) {
  return each_lane([&](int i) { return a.lane[i] / b.lane[i]; });
}
inline LaneMask operator<(Lanes a, Lanes b) {
  LaneMask m;
  for (int i = 0; i < Lanes::count; ++i) m.lane[i] = a.lane[i] < b.lane[i];
  return m;
}
inline LaneMask operator>(Lanes a, Lanes b) { return b < a; }

inline Lanes value_of(Lanes a) { return a; }
inline Lanes minus_value(Lanes a, Lanes b) { return a - b; }
inline Lanes select(LaneMask m, Lanes a, Lanes b) {
  return each_lane([&](int i) { return m.lane[i] ? a.lane[i] : b.lane[i]; });
}
inline int store_numbers(const Lanes& x, double* to) {
  for (int i = 0; i < Lanes::count; ++i) to[i] = x.lane[i];
  return Lanes::count;
}
inline void load_numbers(const double* from, Lanes& x) {
  for (int i = 0; i < Lanes::count; ++i) x.lane[i] = from[i];
}
inline Lanes power_of_two(Lanes n) {
  return each_lane([&](int i) { return power_of_two(n.lane[i]); });
}
inline void add_quarters(Lanes quarters, Lanes& sine, Lanes& cosine) {
  for (int i = 0; i < Lanes::count; ++i) add_quarters(quarters.lane[i], sine.lane[i], cosine.lane[i]);
}
inline void load_cell(const double* coefficients, Lanes cell, Lanes (&c)[4]) {
  for (int i = 0; i < Lanes::count; ++i) {
    double row[4];
    load_cell(coefficients, cell.lane[i], row);
    for (int k = 0; k < 4; ++k) c[k].lane[i] = row[k];
  }
}
inline void load_cell(const double* coefficients, std::int64_t row_stride, Lanes cell_1, Lanes cell_2,
                      Lanes (&c)[4][4]) {
  for (int i = 0; i < Lanes::count; ++i) {
    double patch[4][4];
    load_cell(coefficients, row_stride, cell_1.lane[i], cell_2.lane[i], patch);
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) c[j][k].lane[i] = patch[j][k];
  }
}

} // namespace ents::ENTS_ISA
