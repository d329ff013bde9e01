// SPDX-License-Identifier: BSD-3-Clause
// A height that functions of its own evaluate: an expression (expression.hpp), a function of the host.
#pragma once

#include <cstdint>

#include "core/height/jet.hpp"
#include "core/numbers/lanes.hpp"

namespace ents {

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

namespace ENTS_ISA {

// A scalar as the numbers that it stands for, one after the other, and back. The first returns how many.
ENTS_INLINE int store_numbers(double x, double* to) { return *to = x, 1; }
ENTS_INLINE void load_numbers(const double* from, double& x) { x = *from; }

#if defined(ENTS_HAS_LANES)
template <int W> ENTS_INLINE int store_numbers(const Lanes<W>& x, double* to) {
  for (int k = 0; k < W; ++k) to[k] = x.v[k];
  return W;
}
template <int W> ENTS_INLINE void load_numbers(const double* from, Lanes<W>& x) {
  for (int k = 0; k < W; ++k) x.v[k] = from[k];
}
template <class S> ENTS_INLINE int store_numbers(const Twice<S>& x, double* to) {
  const int low = store_numbers(x.low, to);
  return low + store_numbers(x.high, to + low);
}
template <class S> ENTS_INLINE void load_numbers(const double* from, Twice<S>& x) {
  load_numbers(from, x.low);
  load_numbers(from + width_of<S>, x.high);
}
#endif

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

} // namespace ENTS_ISA
} // namespace ents
