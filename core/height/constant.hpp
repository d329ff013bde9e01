// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/height/formula_number.hpp"

namespace ents {

template <class P> struct Constant {
  static constexpr char type[] = "constant", formula[] = "";
  static constexpr FormulaNumber table[] = {{"value", "[L].", FormulaNumber::any, true}};
  P value;
};

namespace ENTS_ISA {
template <class P> ENTS_INLINE void set_height(Constant<P>& to, const P* numbers, int) {
  to.value = numbers[0];
}
template <int T, class P, class S>
ENTS_INLINE HeightJet<T, S> height_jet(const Constant<P>& p, const S (&)[T]) {
  return constant_jet<T>(S(p.value));
}
inline double largest_height(const Constant<double>& p) { return absolute(p.value); }
inline double feature_length(const Constant<double>&, int) { return std::numeric_limits<double>::infinity(); }
} // namespace ENTS_ISA

} // namespace ents
