// SPDX-License-Identifier: BSD-3-Clause
// A height and its derivatives at one point.
#pragma once

#include "core/numbers/elementary.hpp"
#include "core/numbers/scalar.hpp"

namespace ents::ENTS_ISA {

// h, h_,a and h_,ab in the order 11, 12, 22. T: number of surface coordinates.
template <int T, class S> struct HeightJet {
  S h;
  S h1[T];
  S h2[T * (T + 1) / 2];
};

template <int T, class S> ENTS_INLINE HeightJet<T, S> constant_jet(const S& value) {
  HeightJet<T, S> jet;
  jet.h = value;
  for (int a = 0; a < T; ++a) jet.h1[a] = S(0.0);
  for (int k = 0; k < T * (T + 1) / 2; ++k) jet.h2[k] = S(0.0);
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

} // namespace ents::ENTS_ISA
