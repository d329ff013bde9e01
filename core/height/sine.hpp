// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/height/formula_number.hpp"

namespace ents {

template <class P> struct Sine {
  static constexpr char type[] = "sine", formula[] = "amplitude sin(2 pi wave_vector . s + phase).";
  static constexpr FormulaNumber table[] = {{"amplitude", "[L].", FormulaNumber::any, true},
                                            {"wave_vector", "Waves per unit of s.", FormulaNumber::vector},
                                            {"phase", "Radians; default 0.", FormulaNumber::any, true, 0.0}};
  P amplitude;
  P wave_vector[2]; // turns per unit of s
  P phase;          // turns, within half a turn
};

namespace ENTS_ISA {

template <class P> ENTS_INLINE void set_height(Sine<P>& to, const P* numbers, int) {
  to.amplitude = numbers[0];
  to.wave_vector[0] = numbers[1], to.wave_vector[1] = numbers[2];
  const P turns = numbers[3] / two_pi;
  to.phase = minus_value(turns, nearest_integer(value_of(turns)));
}

template <int T, class P, class S> ENTS_INLINE S turns_of(const Sine<P>& p, const S (&s)[T]) {
  S turns = p.wave_vector[0] * s[0];
  if constexpr (T == 2) turns = turns + p.wave_vector[1] * s[1];
  return turns;
}
// h: amplitude times sine; slope: times cosine
template <int T, class P, class S>
ENTS_INLINE HeightJet<T, S> sine_jet(const Sine<P>& p, const S& h, const S& slope) {
  HeightJet<T, S> jet;
  jet.h = h;
  int k = 0;
  for (int a = 0; a < T; ++a) {
    const P wa = two_pi * p.wave_vector[a];
    jet.h1[a] = wa * slope;
    for (int b = a; b < T; ++b) jet.h2[k++] = -(wa * (two_pi * p.wave_vector[b])) * jet.h;
  }
  return jet;
}
template <int T, class P, class S> ENTS_INLINE HeightJet<T, S> height_jet(const Sine<P>& p, const S (&s)[T]) {
  S sine, cosine;
  sin_cos_turns(turns_of(p, s), p.phase, sine, cosine);
  return sine_jet<T>(p, p.amplitude * sine, p.amplitude * cosine);
}
inline double largest_height(const Sine<double>& p) { return absolute(p.amplitude); }
inline double feature_length(const Sine<double>& p, int a) {
  return p.wave_vector[a] != 0.0 ? 0.25 / absolute(p.wave_vector[a])
                                 : std::numeric_limits<double>::infinity();
}

// The jet of a sine, in `d` its derivative along y, known from the jet itself.
template <int T, class S>
ENTS_INLINE HeightJet<T, Dual<S>> sine_along(const Sine<double>& p, const S (&y)[T],
                                             const HeightJet<T, S>& at) {
  const auto along = [&](const S& first, const S& last) ENTS_LAMBDA_INLINE {
    return T == 1 ? y[0] * first : y[0] * first + y[T - 1] * last;
  };
  HeightJet<T, Dual<S>> jet;
  jet.h = {at.h, along(at.h1[0], at.h1[T - 1])};
  int k = 0;
  for (int a = 0; a < T; ++a) {
    const double wa = two_pi * p.wave_vector[a];
    jet.h1[a] = {at.h1[a], along(at.h2[a], at.h2[a + T - 1])};
    for (int b = a; b < T; ++b, ++k) jet.h2[k] = {at.h2[k], -(wa * (two_pi * p.wave_vector[b])) * jet.h.d};
  }
  return jet;
}

} // namespace ENTS_ISA
} // namespace ents
