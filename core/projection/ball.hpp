// SPDX-License-Identifier: BSD-3-Clause
// Midpoint-radius intervals ("balls"; van der Hoeven, Ball arithmetic, 2010): a kernel scalar that stands for
// all values within `r` of `v`. Evaluated with the balls xi +- w, every formula of the kernel gives its value
// at the centre of that box of the segment and a bound of how far it departs from it within the box.
//
// Radii are not rounded outwards: they hold up to a few units of rounding, which the search's tie tolerance
// covers.
#pragma once

#include "core/height/height.hpp"
#include "core/numbers/elementary.hpp"
#include "core/numbers/scalar.hpp"
#include "core/numbers/vec.hpp"

namespace ents::ENTS_ISA {

struct Ball {
  double v;
  double r;
  Ball() = default;
  constexpr Ball(double value) : v(value), r(0.0) {}
  constexpr Ball(double value, double radius) : v(value), r(radius) {}
};

template <> inline constexpr bool is_range<Ball> = true;

inline constexpr double no_bound = 1e100; // radius of "any value"; finite, so that 0 times it is 0

ENTS_INLINE double lesser(double a, double b) { return a < b ? a : b; }
ENTS_INLINE double greater(double a, double b) { return a > b ? a : b; }
ENTS_INLINE double magnitude(Ball a) { return absolute(a.v) + a.r; }

ENTS_INLINE Ball operator+(Ball a, Ball b) { return {a.v + b.v, a.r + b.r}; }
ENTS_INLINE Ball operator-(Ball a, Ball b) { return {a.v - b.v, a.r + b.r}; }
ENTS_INLINE Ball operator-(Ball a) { return {-a.v, a.r}; }
ENTS_INLINE Ball operator*(Ball a, Ball b) {
  return {a.v * b.v, lesser(absolute(a.v) * b.r + a.r * (absolute(b.v) + b.r), no_bound)};
}
ENTS_INLINE Ball operator+(Ball a, double b) { return {a.v + b, a.r}; }
ENTS_INLINE Ball operator+(double a, Ball b) { return {a + b.v, b.r}; }
ENTS_INLINE Ball operator-(Ball a, double b) { return {a.v - b, a.r}; }
ENTS_INLINE Ball operator-(double a, Ball b) { return {a - b.v, b.r}; }
ENTS_INLINE Ball operator*(Ball a, double b) { return {a.v * b, a.r * absolute(b)}; }
ENTS_INLINE Ball operator*(double a, Ball b) { return b * a; }
ENTS_INLINE Ball operator/(double a, Ball b) { // callers have checked that b keeps away from 0
  const double q = a / b.v, nearest = absolute(b.v) - b.r;
  return {q, nearest > 0.0 ? absolute(q) * b.r / nearest : no_bound};
}

// Branches follow the smallest of the values: "positive" then holds for all of them.
ENTS_INLINE double value_of(Ball a) { return a.v - a.r; }

ENTS_INLINE Ball square_root(Ball a) {
  const double root = square_root(a.v), least = a.v - a.r;
  return {root, root - (least > 0.0 ? square_root(least) : 0.0)};
}

ENTS_INLINE Ball clamp(Ball x, double low, double high) { return {clamp(x.v, low, high), x.r}; }

// |sin(x + d) - sin x| <= |cos x| |d| + d^2 / 2, and no value leaves -1 .. 1
ENTS_INLINE void sin_cos_turns(Ball t, double offset, Ball& sine, Ball& cosine) {
  sin_cos_turns(t.v, offset, sine.v, cosine.v);
  const double angle = lesser(two_pi * t.r, 4.0), s = absolute(sine.v), c = absolute(cosine.v);
  sine.r = lesser(c * angle + 0.5 * angle * angle, 1.0 + s);
  cosine.r = lesser(s * angle + 0.5 * angle * angle, 1.0 + c);
}

ENTS_INLINE Ball exponential(Ball x) {
  const double y = exponential(x.v);
  return {y, exponential(lesser(x.v + x.r, 300.0)) - y};
}

// u . e for a fixed vector u
template <int D> ENTS_INLINE Ball dot(const Vec<double, D>& u, const Vec<Ball, D>& e) {
  Ball s = u[0] * e[0];
  for (int k = 1; k < D; ++k) s = s + u[k] * e[k];
  return s;
}

// Smallest length in a box of vectors.
template <int D> ENTS_INLINE double least_length(const Vec<Ball, D>& d) {
  double low2 = 0.0;
  for (int k = 0; k < D; ++k) {
    const double low = greater(absolute(d[k].v) - d[k].r, 0.0);
    low2 += low * low;
  }
  return square_root(low2);
}

// The mean value theorem: x departs from its centre by no more than sum_a |x_,a| w_a. `derivative(a)` is x_,a
// or null if that is identically zero.
template <int T, int D, class F>
ENTS_INLINE void narrow_by(Vec<Ball, D>& x, const Ball (&xi)[T], F&& derivative) {
  double radius[D] = {};
  for (int a = 0; a < T; ++a)
    if (const Vec<Ball, D>* x1 = derivative(a))
      for (int k = 0; k < D; ++k) radius[k] += magnitude((*x1)[k]) * xi[a].r;
  for (int k = 0; k < D; ++k) x[k].r = lesser(x[k].r, radius[k]);
}

// Of rho_,ab, rho_,a and rho, from the higher derivatives: evaluate_surface calls it before it computes with
// them.
template <int Order, class B, class Surface>
ENTS_INLINE void narrow([[maybe_unused]] const B& basis, const Ball (&xi)[B::dim - 1], Surface& s) {
  constexpr int T = B::dim - 1;
  if constexpr (Order > 2)
    for (int k = 0; k < symmetric_size<T>; ++k)
      if (B::second[k])
        narrow_by(s.a2[k], xi, [&](int c) { return has_third(basis, k + c) ? &s.a3[k + c] : nullptr; });
  if constexpr (Order > 1)
    for (int a = 0; a < T; ++a)
      narrow_by(s.a[a], xi, [&](int b) {
        return B::second[symmetric_index(a, b)] ? &s.a2[symmetric_index(a, b)] : nullptr;
      });
  narrow_by(s.d, xi, [&](int a) { return &s.a[a]; });
}

// Range of a height map over a box: the differences of B-spline coefficients are the coefficients of the
// derivatives, and a spline stays between its coefficients. Radii: from the coefficients of the quantity
// itself or, better in a small box, from those of its derivatives. A box of more than `most` cells gets the
// bounds of the whole map.
template <int T> struct MapBox {
  static constexpr int most = 4;
  static constexpr int widest = most + 4;
  double w[2] = {0.0, 0.0};       // half-widths in spacings
  std::int64_t first[2] = {0, 0}; // first coefficient
  int count[2] = {4, T == 2 ? 4 : 1};
  bool small = true;

  ENTS_INLINE MapBox(const MapHeight& map, const Ball (&s)[T]) {
    for (int a = 0; a < T; ++a) {
      w[a] = s[a].r * absolute(map.inverse_spacing[a]);
      double u = (s[a].v - map.origin[a]) * map.inverse_spacing[a];
      u = u - map.period[a] * round_down(u * map.inverse_period[a]);
      // whole knot spans that the box touches; periodic: coefficients beyond the last wrap round
      const bool periodic = map.period[a] > 0.0;
      const double low = periodic ? u - w[a] : clamp_not_nan(u - w[a], map.first_cell[a], map.last_cell[a]);
      const double high = periodic ? u + w[a] : clamp_not_nan(u + w[a], map.first_cell[a], map.last_cell[a]);
      if (!(high - low < most) || !(absolute(u) < 1e9)) {
        small = false;
        return;
      }
      const double cell = round_down(low);
      first[a] = static_cast<std::int64_t>(cell) - 1;
      count[a] = static_cast<int>(round_down(high) - cell) + 4;
    }
  }
};

ENTS_INLINE std::int64_t wrapped(std::int64_t i, double period) {
  const std::int64_t n = static_cast<std::int64_t>(period);
  return n == 0 ? i : (i % n + n) % n;
}

// Largest |difference of order I along rows (and J along columns) - shift| of a table of coefficients.
template <int I> ENTS_INLINE double difference(const double* c, int stride) {
  if constexpr (I == 0)
    return c[0];
  else
    return difference<I - 1>(c + stride, stride) - difference<I - 1>(c, stride);
}
template <int I, int J, int W>
ENTS_INLINE double largest_difference(const double (&c)[W][W], const int (&count)[2], double shift) {
  double most = 0.0;
  for (int j = 0; j + J < count[1]; ++j)
    for (int i = 0; i + I < count[0]; ++i) {
      double d;
      if constexpr (J == 0)
        d = difference<I>(&c[j][i], 1);
      else if constexpr (J == 1)
        d = difference<I>(&c[j + 1][i], 1) - difference<I>(&c[j][i], 1);
      else if constexpr (J == 2)
        d = difference<I>(&c[j + 2][i], 1) - 2.0 * difference<I>(&c[j + 1][i], 1) +
            difference<I>(&c[j][i], 1);
      else
        d = difference<3>(&c[j][i], W);
      most = greater(most, absolute(d - shift));
    }
  return most;
}

template <int T> ENTS_NOINLINE HeightJet<T, Ball> map_height_range(const MapHeight& map, const Ball (&s)[T]) {
  constexpr int K = T * (T + 1) / 2;
  double centre[T];
  for (int a = 0; a < T; ++a) centre[a] = s[a].v;
  const HeightJet<T, double> at = map_height(map, centre);
  const MapBox<T> box(map, s);
  HeightJet<T, Ball> jet;
  if (!box.small) {
    jet.h = {at.h, map.bound + absolute(at.h)};
    for (int a = 0; a < T; ++a) jet.h1[a] = {at.h1[a], no_bound};
    for (int k = 0; k < K; ++k) jet.h2[k] = {at.h2[k], no_bound};
    return jet;
  }
  constexpr int W = MapBox<T>::widest;
  double c[W][W];
  for (int j = 0; j < box.count[1]; ++j) {
    const std::int64_t row = T == 2 ? wrapped(box.first[1] + j, map.period[1]) : 0;
    for (int i = 0; i < box.count[0]; ++i)
      c[j][i] = map.coefficients[row * map.row_stride + wrapped(box.first[0] + i, map.period[0])];
  }
  const double* k = map.inverse_spacing;
  const double w1 = box.w[0], w2 = box.w[1];
  // in units of the spacing: values at the centre and radii
  const double u1 = at.h1[0] / k[0], u11 = at.h2[0] / (k[0] * k[0]);
  const double r111 = largest_difference<3, 0>(c, box.count, 0.0);
  if constexpr (T == 1) {
    const double r11 = lesser(r111 * w1, largest_difference<2, 0>(c, box.count, u11));
    const double r1 = lesser((absolute(u11) + r11) * w1, largest_difference<1, 0>(c, box.count, u1));
    const double r0 = lesser((absolute(u1) + r1) * w1, largest_difference<0, 0>(c, box.count, at.h));
    jet.h = {at.h, r0};
    jet.h1[0] = {at.h1[0], r1 * absolute(k[0])};
    jet.h2[0] = {at.h2[0], r11 * k[0] * k[0]};
  } else {
    const double u2 = at.h1[1] / k[1], u12 = at.h2[1] / (k[0] * k[1]), u22 = at.h2[2] / (k[1] * k[1]);
    const double r112 = largest_difference<2, 1>(c, box.count, 0.0);
    const double r122 = largest_difference<1, 2>(c, box.count, 0.0);
    const double r222 = largest_difference<0, 3>(c, box.count, 0.0);
    const double r11 = lesser(r111 * w1 + r112 * w2, largest_difference<2, 0>(c, box.count, u11));
    const double r12 = lesser(r112 * w1 + r122 * w2, largest_difference<1, 1>(c, box.count, u12));
    const double r22 = lesser(r122 * w1 + r222 * w2, largest_difference<0, 2>(c, box.count, u22));
    const double r1 = lesser((absolute(u11) + r11) * w1 + (absolute(u12) + r12) * w2,
                             largest_difference<1, 0>(c, box.count, u1));
    const double r2 = lesser((absolute(u12) + r12) * w1 + (absolute(u22) + r22) * w2,
                             largest_difference<0, 1>(c, box.count, u2));
    const double r0 = lesser((absolute(u1) + r1) * w1 + (absolute(u2) + r2) * w2,
                             largest_difference<0, 0>(c, box.count, at.h));
    jet.h = {at.h, r0};
    jet.h1[0] = {at.h1[0], r1 * absolute(k[0])};
    jet.h1[1] = {at.h1[1], r2 * absolute(k[1])};
    jet.h2[0] = {at.h2[0], r11 * k[0] * k[0]};
    jet.h2[1] = {at.h2[1], r12 * absolute(k[0] * k[1])};
    jet.h2[2] = {at.h2[2], r22 * k[1] * k[1]};
  }
  return jet;
}

// Found by evaluate_height in place of the formula through one cell.
ENTS_INLINE HeightJet<1, Ball> map_height(const MapHeight& map, const Ball (&s)[1]) {
  return map_height_range(map, s);
}
ENTS_INLINE HeightJet<2, Ball> map_height(const MapHeight& map, const Ball (&s)[2]) {
  return map_height_range(map, s);
}

// Range of an external height: values at the centre, radii from its bounds of the quantity itself or, better
// in a small box, from those of its derivatives (mean value theorem). Where it is not defined: any value.
template <int T>
ENTS_NOINLINE HeightJet<T, Ball> external_height(const ExternalHeight& height, const Ball (&s)[T]) {
  static_assert(ExternalHeight::no_range == no_bound);
  constexpr int K = T * (T + 1) / 2, numbers = T == 1 ? 4 : 10, thirds = 1 + T + K;
  double centre[T], low[T], high[T], at[numbers], least[numbers], most[numbers];
  for (int a = 0; a < T; ++a) centre[a] = s[a].v, low[a] = s[a].v - s[a].r, high[a] = s[a].v + s[a].r;
  height.jets(height, 2, 1, centre, at);
  height.ranges(height, low, high, least, most);
  Ball all[numbers];
  bool holds = true; // do the bounds hold at the centre?
  for (int i = 0; i < thirds; ++i) {
    const double rounding = 1e-9 * greater(absolute(least[i]), absolute(most[i]));
    holds = holds && !(at[i] < least[i] - rounding || at[i] > most[i] + rounding);
  }
  // number i; largest sizes of its derivatives
  const auto narrowed = [&](int i, double by_1, double by_2) ENTS_LAMBDA_INLINE {
    if (!(absolute(at[i]) < no_bound)) return Ball(0.0, no_bound);
    if (!holds) return Ball(at[i], no_bound);
    double mean = by_1 * s[0].r;
    if constexpr (T == 2) mean += by_2 * s[1].r;
    const bool known = least[i] > -no_bound && most[i] < no_bound;
    const double whole = known ? greater(most[i] - at[i], at[i] - least[i]) : no_bound;
    return Ball(at[i], lesser(greater(whole, 0.0), lesser(mean, no_bound)));
  };
  const auto size = [&](int i) ENTS_LAMBDA_INLINE { return greater(absolute(least[i]), absolute(most[i])); };
  for (int k = 0; k < K; ++k)
    all[1 + T + k] = narrowed(1 + T + k, size(thirds + k), T == 2 ? size(thirds + k + 1) : 0.0);
  for (int a = 0; a < T; ++a)
    all[1 + a] = narrowed(1 + a, magnitude(all[1 + T + a]), magnitude(all[T + T + a]));
  all[0] = narrowed(0, magnitude(all[1]), magnitude(all[T]));
  HeightJet<T, Ball> out;
  out.h = all[0];
  for (int a = 0; a < T; ++a) out.h1[a] = all[1 + a];
  for (int k = 0; k < K; ++k) out.h2[k] = all[1 + T + k];
  return out;
}

} // namespace ents::ENTS_ISA
