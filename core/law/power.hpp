// SPDX-License-Identifier: BSD-3-Clause
// The laws whose force is a power of the gap:
//   penalty   W = eps g^2 / 2    g < 0
//   power     p = c (-g)^m       g < 0, m a multiple of 1/2, >= 1
// Elements of these have a kernel of their own (element/fast_block.hpp), which uses W'' = m W'/g.
#pragma once

#include "core/law/normal_law.hpp"

namespace ents::ENTS_ISA {

struct Power : NormalLaw {
  static constexpr char type[] = "power", formula[] = "Pressure coefficient (-g)^exponent for gap g < 0.";
  static constexpr LawNumber table[] = {{"coefficient", "[F/L^(2+exponent)].", LawNumber::positive, true},
                                        {"exponent", "A multiple of 1/2.", LawNumber::exponent}};
  static constexpr bool has_slope = true;
  static bool is_linear(const ContactLaw& law) { return law.twice_exponent == 2; }

  // c (-g)^(m-1), where there is contact
  template <class S> static ENTS_INLINE S force_per_gap(const ContactLaw& law, const S& gap) {
    S per_gap = law_number<S>(law.number[0], law.rates.normal);
    if (law.twice_exponent > 2) {
      const int n = law.twice_exponent - 2;
      const S depth = larger(-gap, S(0.0));
      if (n % 2) per_gap = per_gap * square_root(depth);
      for (int i = 0; i < n / 2; ++i) per_gap = per_gap * depth;
    }
    return per_gap;
  }
  template <class S>
  static ENTS_INLINE NormalForce<S> force(const ContactLaw& law, const NormalPlace<S>& at) {
    const double m = 0.5 * law.twice_exponent;
    const S per_gap = force_per_gap(law, at.gap);
    return {per_gap * at.gap, m * per_gap, per_gap * at.gap * at.gap / S(m + 1.0), at.gap <= 0.0};
  }
};

struct Penalty : Power {
  static constexpr char type[] = "penalty", formula[] = "W = stiffness/2 g^2 area for gap g < 0.";
  static constexpr LawNumber table[] = {{"stiffness", "[F/L^3].", LawNumber::positive, true}};
};

} // namespace ents::ENTS_ISA
