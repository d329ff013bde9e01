// SPDX-License-Identifier: BSD-3-Clause
// (Bi)cubic B-splines: a map over s (height_map.hpp), and a profile along a direction of it (thread.hpp). The
// memory reads that depend on s are in load_cell(). Third derivatives are piecewise constant; on a knot they
// are those of the cell on the right.
#pragma once

#include <cstdint>

#include "core/height/jet.hpp"
#include "core/numbers/lanes.hpp"

namespace ents {

// Cubic B-spline coefficients, padded so that every cell in [first_cell, last_cell] finds its 4 (x 4)
// coefficients without index tests. Positions are in units of the knot spacing: u = (s - origin) / spacing.
struct MapHeight {
  const double*
      coefficients; // of sample (0, 0); that of sample (i along s_1, j along s_2): [j row_stride + i]
  std::int64_t row_stride;
  double origin[2];
  double inverse_spacing[2];
  double period[2];         // in spacings; 0: clamped
  double inverse_period[2]; // 0: clamped
  double low[2],
      high[2]; // range of u; beyond it a clamped map is constant, a periodic one out of the range of numbers
  double first_cell[2], last_cell[2];
  double bound; // of |h|
};

// The same along a direction: a map of turns, wave_vector . s + phase, with period 1.
struct ProfileHeight {
  MapHeight of_turns;
  double wave_vector[2]; // turns per unit of s
  double phase;          // turns
};

namespace ENTS_ISA {

// The 4 coefficients of a cell's row. `cell` holds an integer within [first_cell, last_cell].
ENTS_INLINE void load_cell(const double* coefficients, double cell, double (&c)[4]) {
  const double* p = coefficients + static_cast<std::int64_t>(cell) - 1;
  for (int i = 0; i < 4; ++i) c[i] = p[i];
}

// The 4 x 4 coefficients of a cell.
ENTS_INLINE void load_cell(const double* coefficients, std::int64_t row_stride, double cell_1, double cell_2,
                           double (&c)[4][4]) {
  const double* p = coefficients + (static_cast<std::int64_t>(cell_2) - 1) * row_stride;
  for (int j = 0; j < 4; ++j) load_cell(p + j * row_stride, cell_1, c[j]);
}

#if defined(ENTS_HAS_LANES)
// Coefficients of each lane's cell.
template <int W> ENTS_INLINE void load_cell(const double* coefficients, Lanes<W> cell, Lanes<W> (&c)[4]) {
  static_assert(W == 2 || W == 4 || W == 8);
  const double* at[W];
  for (int k = 0; k < W; ++k) at[k] = coefficients + static_cast<std::int64_t>(cell.v[k]) - 1;
  if constexpr (W == 2) {
    for (int i = 0; i < 4; ++i) c[i].v = VectorOf<W>::halves(at[0] + i, at[1] + i);
  } else {
    typename VectorOf<W>::Numbers r[4];
    read_transposed<W>([&](int k) ENTS_LAMBDA_INLINE { return at[k]; }, r);
    for (int i = 0; i < 4; ++i) c[i].v = r[i];
  }
}
template <int W>
ENTS_INLINE void load_cell(const double* coefficients, std::int64_t row_stride, Lanes<W> cell_1,
                           Lanes<W> cell_2, Lanes<W> (&c)[4][4]) {
  const Lanes<W> corner = cell_1 + (cell_2 - 1.0) * static_cast<double>(row_stride); // exact
  for (int j = 0; j < 4; ++j) load_cell(coefficients + j * row_stride, corner, c[j]);
}
template <class S> ENTS_INLINE void load_cell(const double* coefficients, Twice<S> cell, Twice<S> (&c)[4]) {
  S low[4], high[4];
  load_cell(coefficients, cell.low, low);
  load_cell(coefficients, cell.high, high);
  for (int i = 0; i < 4; ++i) c[i] = {low[i], high[i]};
}
template <class S>
ENTS_INLINE void load_cell(const double* coefficients, std::int64_t row_stride, Twice<S> cell_1,
                           Twice<S> cell_2, Twice<S> (&c)[4][4]) {
  S low[4][4], high[4][4];
  load_cell(coefficients, row_stride, cell_1.low, cell_2.low, low);
  load_cell(coefficients, row_stride, cell_1.high, cell_2.high, high);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) c[j][i] = {low[j][i], high[j][i]};
}
#endif

// Uniform cubic B-spline over one cell, f in [0, 1]; u-derivatives. Written in differences of the
// coefficients: where they are equal the value is exact and the derivatives are exactly zero.
template <class C, class S> ENTS_INLINE void cubic_bspline(const C (&c)[4], const S& f, S& h, S& h1, S& h2) {
  const C d1 = c[1] - c[0], d2 = c[2] - c[1], d3 = c[3] - c[2];
  const C e1 = d2 - d1, e2 = d3 - d2;
  const C a3 = (1.0 / 6.0) * (e2 - e1);
  const C a2 = 0.5 * e1;
  const S f_a3 = f * a3;
  h = f * (f * (f_a3 + a2) + 0.5 * (d1 + d2)) + (c[1] + (1.0 / 6.0) * e1);
  h1 = f * (3.0 * f_a3 + e1) + 0.5 * (d1 + d2);
  h2 = 6.0 * f_a3 + e1;
}

// Cell and place in the cell, both in units of the spacing. A NaN stays in `f`; the cell is always valid.
template <class S, class R> ENTS_INLINE void locate(const MapHeight& map, int a, const S& s, R& cell, S& f) {
  S u = (s - map.origin[a]) * map.inverse_spacing[a];
  u = minus_value(u, map.period[a] * round_down(value_of(u) * map.inverse_period[a]));
  u = clamp(u, map.low[a], map.high[a]);
  cell = round_down(clamp_not_nan(value_of(u), map.first_cell[a], map.last_cell[a]));
  f = minus_value(u, cell);
}

template <class S> ENTS_INLINE HeightJet<1, S> map_height(const MapHeight& map, const S (&s)[1]) {
  using R = decltype(value_of(s[0]));
  R cell;
  S f;
  locate(map, 0, s[0], cell, f);
  R c[4];
  load_cell(map.coefficients, cell, c);
  HeightJet<1, S> jet;
  cubic_bspline(c, f, jet.h, jet.h1[0], jet.h2[0]);
  jet.h1[0] = jet.h1[0] * map.inverse_spacing[0];
  jet.h2[0] = jet.h2[0] * (map.inverse_spacing[0] * map.inverse_spacing[0]);
  return jet;
}

template <class S> ENTS_INLINE HeightJet<2, S> map_height(const MapHeight& map, const S (&s)[2]) {
  using R = decltype(value_of(s[0]));
  R cell[2];
  S f[2];
  for (int a = 0; a < 2; ++a) locate(map, a, s[a], cell[a], f[a]);
  R c[4][4];
  load_cell(map.coefficients, map.row_stride, cell[0], cell[1], c);
  // Along s_2 first: the four columns lie side by side in memory, so one operation serves all of them.
  S q[4], q2[4], q22[4];
  for (int i = 0; i < 4; ++i) {
    const R column[4] = {c[0][i], c[1][i], c[2][i], c[3][i]};
    cubic_bspline(column, f[1], q[i], q2[i], q22[i]);
  }
  HeightJet<2, S> jet;
  S unused_1, unused_2;
  cubic_bspline(q, f[0], jet.h, jet.h1[0], jet.h2[0]);
  cubic_bspline(q2, f[0], jet.h1[1], jet.h2[1], unused_1);
  cubic_bspline(q22, f[0], jet.h2[2], unused_1, unused_2);
  const double k1 = map.inverse_spacing[0], k2 = map.inverse_spacing[1];
  jet.h1[0] = jet.h1[0] * k1;
  jet.h1[1] = jet.h1[1] * k2;
  jet.h2[0] = jet.h2[0] * (k1 * k1);
  jet.h2[1] = jet.h2[1] * (k1 * k2);
  jet.h2[2] = jet.h2[2] * (k2 * k2);
  return jet;
}

template <int T, class S>
ENTS_INLINE HeightJet<T, S> profile_height(const ProfileHeight& p, const S (&s)[T]) {
  S turns[1] = {p.wave_vector[0] * s[0] + p.phase};
  if constexpr (T == 2) turns[0] = turns[0] + p.wave_vector[1] * s[1];
  const HeightJet<1, S> along = map_height(p.of_turns, turns);
  HeightJet<T, S> jet;
  jet.h = along.h;
  int k = 0;
  for (int a = 0; a < T; ++a) {
    jet.h1[a] = p.wave_vector[a] * along.h1[0];
    for (int b = a; b < T; ++b) jet.h2[k++] = (p.wave_vector[a] * p.wave_vector[b]) * along.h2[0];
  }
  return jet;
}

} // namespace ENTS_ISA
} // namespace ents
