// SPDX-License-Identifier: BSD-3-Clause
// The height function h(s) and its first and second derivatives, evaluated from a tree of plain data.
//
//   none, constant   0, value
//   sine             amplitude sin(2 pi wave_vector . s + phase)
//   polynomial       sum c[i] s_1^i   or   sum c[i][j] s_1^i s_2^j
//   gaussian         amplitude exp(-|s - center|^2 / (2 width^2))
//   map              (bi)cubic B-spline through regular samples, see height_map.hpp
//   profile          periodic cubic B-spline of wave_vector . s + phase, see thread.hpp
//   sum, product     of other heights
//   shift            another height at s - by
//   external         two functions: an expression (expression.hpp), a function of the host
//
// With S = Dual<double> every derivative carries, in its `d`, its exact derivative along s.d, so that
// h2.d holds third derivatives of h. The cubic map has piecewise constant third derivatives; on a knot
// they are those of the cell on the right.
//
// Branches depend on the model only, never on s; the memory reads that do depend on s are in load_cell().
#pragma once

#include <cstdint>

#include "core/elementary.hpp"
#include "core/scalar.hpp"

namespace ents {

enum class HeightKind : std::int32_t {
  none,
  constant,
  sine,
  polynomial,
  gaussian,
  map,
  profile,
  sum,
  product,
  shift,
  external
};

// Deepest nesting of sums and products: bounds the recursion of evaluate_height.
inline constexpr std::int32_t max_height_depth = 8;

struct SineHeight {
  double amplitude;
  double wave_vector[2]; // turns per unit of s
  double phase;          // turns
};

struct PolynomialHeight {
  const double* coefficients; // [rows][columns]: s_1^row s_2^column; in 2D columns = 1
  std::int32_t rows;
  std::int32_t columns;
};

struct GaussianHeight {
  double amplitude;
  double center[2];
  double inverse_width;
};

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

struct ShiftHeight {
  double by[2];
};

// Any other height: functions that evaluate it at many points a call. Derivatives are in the order h, h_,a,
// h_,ab, h_,abc:
//   one surface coordinate   h, h1, h11, h111
//   two                      h, h1, h2, h11, h12, h22, h111, h112, h122, h222
struct ExternalHeight {
  static constexpr int most_points = 8, most_numbers = 10;
  // s: [T][count]; jet: [numbers][count], derivatives up to `order`, 2 or 3. The bits of a point do not
  // depend on the others, and those of lower derivatives do not depend on the order. NaN where the height is
  // not defined.
  using Jets = void (*)(const ExternalHeight&, std::int32_t order, std::int32_t count, const double* s,
                        double* jet);
  // Bounds [numbers] of all derivatives up to the third wherever low <= s <= high, [T]. +-no_range: no bound
  // is known. Where the height is not defined somewhere in the box, no bound is known.
  using Ranges = void (*)(const ExternalHeight&, const double* low, const double* high, double* least,
                          double* most);
  // Derivatives up to the second, at one point, of the derivative of h by values[parameter].
  using Rates = void (*)(const ExternalHeight&, std::int32_t parameter, const double* s, double* jet);
  static constexpr double no_range = 1e100;

  Jets jets;
  Ranges ranges;
  Rates rates;          // null: no parameters
  const void* data;     // what the functions need; the same for all calls
  const double* values; // numbers that they need, parameters first: a copy of the node may point to others
  std::int32_t value_count, parameter_count;
  double bound; // |h| is nowhere larger; may be infinite
};

struct HeightNode {
  HeightKind kind;
  std::int32_t child_count; // sum, product, shift
  std::int32_t first_child; // distance in nodes from this node to its first child; children are contiguous
  // Numbers that a named parameter gives (height_binding.hpp): 1 + its index, 0 for a number of the model's
  // own.
  //   constant: value; sine: amplitude, phase; gaussian: amplitude, center; shift: by; map: 1 + the index of
  //   its field; external: its parameters
  std::uint8_t bound_to[4];
  union {
    double value; // constant
    ShiftHeight shift;
    SineHeight sine;
    PolynomialHeight polynomial;
    GaussianHeight gaussian;
    MapHeight map;
    ProfileHeight profile;
    ExternalHeight external;
  };
};

namespace ENTS_ISA {

// h, h_,a and h_,ab in the order 11, 12, 22.
template <int T, class S> struct HeightJet {
  S h;
  S h1[T];
  S h2[T * (T + 1) / 2];
};

template <int T, class S> ENTS_INLINE HeightJet<T, S> constant_height(double value) {
  HeightJet<T, S> jet;
  jet.h = S(value);
  for (int a = 0; a < T; ++a) jet.h1[a] = S(0.0);
  for (int k = 0; k < T * (T + 1) / 2; ++k) jet.h2[k] = S(0.0);
  return jet;
}

template <int T, class S> ENTS_INLINE S turns_of(const SineHeight& p, const S (&s)[T]) {
  S turns = p.wave_vector[0] * s[0];
  if constexpr (T == 2) turns = turns + p.wave_vector[1] * s[1];
  return turns;
}
// h: amplitude times sine; slope: times cosine
template <int T, class S>
ENTS_INLINE HeightJet<T, S> sine_height(const SineHeight& p, const S& h, const S& slope) {
  HeightJet<T, S> jet;
  jet.h = h;
  int k = 0;
  for (int a = 0; a < T; ++a) {
    const double wa = two_pi * p.wave_vector[a];
    jet.h1[a] = wa * slope;
    for (int b = a; b < T; ++b) jet.h2[k++] = -(wa * (two_pi * p.wave_vector[b])) * jet.h;
  }
  return jet;
}
template <int T, class S> ENTS_INLINE HeightJet<T, S> sine_height(const SineHeight& p, const S (&s)[T]) {
  S sine, cosine;
  sin_cos_turns(turns_of(p, s), p.phase, sine, cosine);
  return sine_height<T>(p, p.amplitude * sine, p.amplitude * cosine);
}

template <class S> ENTS_INLINE HeightJet<1, S> polynomial_height(const PolynomialHeight& p, const S (&s)[1]) {
  S h(0.0), d1(0.0), d2(0.0); // Horner for p, p' and p''/2
  for (std::int32_t i = p.rows; i-- > 0;) {
    d2 = d2 * s[0] + d1;
    d1 = d1 * s[0] + h;
    h = h * s[0] + p.coefficients[i];
  }
  return {h, {d1}, {2.0 * d2}};
}

template <class S> ENTS_INLINE HeightJet<2, S> polynomial_height(const PolynomialHeight& p, const S (&s)[2]) {
  S h(0.0), h1(0.0), h11(0.0), h2(0.0), h12(0.0), h22(0.0); // Horner in s_1 of ...
  for (std::int32_t i = p.rows; i-- > 0;) {
    const double* c = p.coefficients + static_cast<std::int64_t>(i) * p.columns;
    S q(0.0), q2(0.0), q22(0.0); // ... Horner in s_2
    for (std::int32_t j = p.columns; j-- > 0;) {
      q22 = q22 * s[1] + q2;
      q2 = q2 * s[1] + q;
      q = q * s[1] + c[j];
    }
    h11 = h11 * s[0] + h1;
    h1 = h1 * s[0] + h;
    h = h * s[0] + q;
    h12 = h12 * s[0] + h2;
    h2 = h2 * s[0] + q2;
    h22 = h22 * s[0] + q22;
  }
  return {h, {h1, h2}, {2.0 * h11, h12, 2.0 * h22}};
}

template <int T, class S>
ENTS_INLINE HeightJet<T, S> gaussian_height(const GaussianHeight& p, const S (&s)[T]) {
  // Farther than 40 widths the exponential is below the smallest normal number and counted as 0.
  S r[T];
  for (int a = 0; a < T; ++a) r[a] = clamp((s[a] - p.center[a]) * p.inverse_width, -40.0, 40.0);
  S squared = r[0] * r[0];
  if constexpr (T == 2) squared = squared + r[1] * r[1];
  HeightJet<T, S> jet;
  jet.h = p.amplitude * exponential(-0.5 * squared);
  int k = 0;
  for (int a = 0; a < T; ++a) {
    const S slope = -p.inverse_width * r[a];
    jet.h1[a] = slope * jet.h;
    for (int b = a; b < T; ++b) {
      S factor = (-p.inverse_width * r[b]) * slope;
      if (a == b) factor = factor - p.inverse_width * p.inverse_width;
      jet.h2[k++] = factor * jet.h;
    }
  }
  return jet;
}

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

template <int T, class S> ENTS_INLINE void add_height(HeightJet<T, S>& total, const HeightJet<T, S>& term) {
  total.h = total.h + term.h;
  for (int a = 0; a < T; ++a) total.h1[a] = total.h1[a] + term.h1[a];
  for (int k = 0; k < T * (T + 1) / 2; ++k) total.h2[k] = total.h2[k] + term.h2[k];
}

template <int T, class S>
ENTS_INLINE void multiply_height(HeightJet<T, S>& total, const HeightJet<T, S>& factor) {
  int k = 0;
  for (int a = 0; a < T; ++a)
    for (int b = a; b < T; ++b, ++k)
      total.h2[k] = (total.h2[k] * factor.h + total.h * factor.h2[k]) +
                    (total.h1[a] * factor.h1[b] + total.h1[b] * factor.h1[a]);
  for (int a = 0; a < T; ++a) total.h1[a] = total.h1[a] * factor.h + total.h * factor.h1[a];
  total.h = total.h * factor.h;
}

// A scalar as the numbers that it stands for, one after the other, and back. The first returns how many.
ENTS_INLINE int store_numbers(double x, double* to) { return *to = x, 1; }
ENTS_INLINE void load_numbers(const double* from, double& x) { x = *from; }

// The numbers of ExternalHeight up to `order`, 2 or 3.
template <int T, class S>
ENTS_NOINLINE void external_jets(const ExternalHeight& height, int order, const S (&s)[T], S* jet) {
  constexpr int most = ExternalHeight::most_points;
  const int numbers = T == 1 ? order + 1 : (order + 1) * (order + 2) / 2;
  double at[T * 2 * most], values[ExternalHeight::most_numbers * 2 * most];
  const int count = store_numbers(s[0], at);
  if constexpr (T == 2) store_numbers(s[1], at + count);
  if (count <= most) {
    height.jets(height, order, count, at, values);
  } else {
    double some[T * most], of_some[ExternalHeight::most_numbers * most];
    for (int first = 0; first < count; first += most) { // whole parts
      for (int a = 0; a < T; ++a)
        for (int k = 0; k < most; ++k) some[a * most + k] = at[a * count + first + k];
      height.jets(height, order, most, some, of_some);
      for (int i = 0; i < numbers; ++i)
        for (int k = 0; k < most; ++k) values[i * count + first + k] = of_some[i * most + k];
    }
  }
  for (int i = 0; i < numbers; ++i) load_numbers(values + i * count, jet[i]);
}
template <int T>
ENTS_INLINE void external_jets(const ExternalHeight& height, int order, const double (&s)[T], double* jet) {
  height.jets(height, order, 1, s, jet);
}
template <int T, class S>
ENTS_INLINE HeightJet<T, S> external_height(const ExternalHeight& height, const S (&s)[T]) {
  S jet[ExternalHeight::most_numbers];
  external_jets(height, 2, s, jet);
  HeightJet<T, S> out;
  out.h = jet[0];
  for (int a = 0; a < T; ++a) out.h1[a] = jet[1 + a];
  for (int k = 0; k < T * (T + 1) / 2; ++k) out.h2[k] = jet[1 + T + k];
  return out;
}
template <int T, class S>
ENTS_INLINE HeightJet<T, Dual<S>> external_height(const ExternalHeight& height, const Dual<S> (&s)[T]) {
  S at[T], jet[ExternalHeight::most_numbers];
  for (int a = 0; a < T; ++a) at[a] = s[a].v;
  external_jets(height, 3, at, jet);
  // the derivative along s.d of the number whose own derivatives are first, first + 1
  const auto along = [&](int first) ENTS_LAMBDA_INLINE {
    return T == 1 ? jet[first] * s[0].d : jet[first] * s[0].d + jet[first + 1] * s[T - 1].d;
  };
  HeightJet<T, Dual<S>> out;
  out.h = {jet[0], along(1)};
  for (int a = 0; a < T; ++a) out.h1[a] = {jet[1 + a], along(1 + T + a)};
  for (int k = 0; k < T * (T + 1) / 2; ++k) out.h2[k] = {jet[1 + T + k], along(1 + T + T * (T + 1) / 2 + k)};
  return out;
}

// h and its derivatives at s. T: number of surface coordinates, as the tree was built for.
template <int T, class S> HeightJet<T, S> evaluate_height(const HeightNode& node, const S (&s)[T]) {
  switch (node.kind) {
  case HeightKind::none:
    break;
  case HeightKind::constant:
    return constant_height<T, S>(node.value);
  case HeightKind::sine:
    return sine_height(node.sine, s);
  case HeightKind::polynomial:
    return polynomial_height(node.polynomial, s);
  case HeightKind::gaussian:
    return gaussian_height(node.gaussian, s);
  case HeightKind::map:
    return map_height(node.map, s);
  case HeightKind::profile:
    return profile_height(node.profile, s);
  case HeightKind::external:
    return external_height(node.external, s);
  case HeightKind::sum:
  case HeightKind::product: {
    const HeightNode* child = &node + node.first_child;
    HeightJet<T, S> total = evaluate_height(child[0], s);
    for (std::int32_t i = 1; i < node.child_count; ++i) {
      const HeightJet<T, S> term = evaluate_height(child[i], s);
      if (node.kind == HeightKind::sum)
        add_height(total, term);
      else
        multiply_height(total, term);
    }
    return total;
  }
  case HeightKind::shift: {
    S moved[T];
    for (int a = 0; a < T; ++a) moved[a] = s[a] - node.shift.by[a];
    return evaluate_height(*(&node + node.first_child), moved);
  }
  }
  return constant_height<T, S>(0.0);
}

// The jet at s, in `d` its derivative along y. A sine's is known from the jet itself.
template <int T, class S>
ENTS_INLINE HeightJet<T, Dual<S>> jet_along(const HeightNode& node, const S (&s)[T], const S (&y)[T],
                                            const HeightJet<T, S>& at) {
  if (node.kind != HeightKind::sine) {
    Dual<S> moving[T];
    for (int a = 0; a < T; ++a) moving[a] = Dual<S>(s[a], y[a]);
    return evaluate_height(node, moving);
  }
  const auto along = [&](const S& first, const S& last) ENTS_LAMBDA_INLINE {
    return T == 1 ? y[0] * first : y[0] * first + y[T - 1] * last;
  };
  HeightJet<T, Dual<S>> jet;
  jet.h = {at.h, along(at.h1[0], at.h1[T - 1])};
  int k = 0;
  for (int a = 0; a < T; ++a) {
    const double wa = two_pi * node.sine.wave_vector[a];
    jet.h1[a] = {at.h1[a], along(at.h2[a], at.h2[a + T - 1])};
    for (int b = a; b < T; ++b, ++k)
      jet.h2[k] = {at.h2[k], -(wa * (two_pi * node.sine.wave_vector[b])) * jet.h.d};
  }
  return jet;
}

} // namespace ENTS_ISA
} // namespace ents
