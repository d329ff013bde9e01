// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/height/formula_number.hpp"

namespace ents {

template <class P> struct Gaussian {
  static constexpr char type[] = "gaussian", formula[] = "amplitude exp(-|s - center|^2 / (2 width^2)).";
  static constexpr FormulaNumber table[] = {{"amplitude", "[L].", FormulaNumber::any, true},
                                            {"center", "", FormulaNumber::vector, true},
                                            {"width", "In units of s.", FormulaNumber::positive}};
  P amplitude;
  P center[2];
  P inverse_width;
};

namespace ENTS_ISA {

template <class P> ENTS_INLINE void set_height(Gaussian<P>& to, const P* numbers, int) {
  to.amplitude = numbers[0];
  to.center[0] = numbers[1], to.center[1] = numbers[2];
  to.inverse_width = 1.0 / numbers[3];
}
template <int T, class P, class S>
ENTS_INLINE HeightJet<T, S> height_jet(const Gaussian<P>& p, const S (&s)[T]) {
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
inline double largest_height(const Gaussian<double>& p) { return absolute(p.amplitude); }
inline double feature_length(const Gaussian<double>& p, int) { return 1.0 / p.inverse_width; }

} // namespace ENTS_ISA
} // namespace ents
