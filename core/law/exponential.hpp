// SPDX-License-Identifier: BSD-3-Clause
// Regularised contact: p = p0 / (e - 1) u (e^u - 1), u = 1 - g / c0, g < c0 (pressure p0 at g = 0)
#pragma once

#include "core/law/normal_law.hpp"

namespace ents::ENTS_ISA {

// W over c0 p0 / (e - 1): the integral of v (e^v - 1) from 0 to u; e_minus_1 = e^u - 1.
template <class S> ENTS_INLINE S exponential_energy(const S& u, const S& e_minus_1) {
  // The closed form cancels for small u: sum over k >= 3 of (k - 1) / k! u^k.
  const S series =
      u * u * u *
      (1.0 / 3.0 +
       u * (1.0 / 8.0 + u * (1.0 / 30.0 + u * (1.0 / 144.0 + u * (1.0 / 840.0 + u * (1.0 / 5760.0))))));
  return select(u > 0.05, (u - 1.0) * e_minus_1 + u - 0.5 * u * u, series);
}

struct Exponential : NormalLaw {
  static constexpr char type[] = "exponential",
                        formula[] = "Pressure p0/(e-1) u (exp(u) - 1), u = 1 - g/clearance, for g < "
                                    "clearance: regularised contact, p0 at g = 0.";
  static constexpr LawNumber table[] = {{"pressure", "[F/L^2].", LawNumber::positive, true},
                                        {"clearance", "[L].", LawNumber::positive}};

  template <class S> static ENTS_INLINE S touching_gap(const ContactLaw& law, const S&, const S&) {
    return S(law.number[1]);
  }

  template <class S>
  static ENTS_INLINE NormalForce<S> force(const ContactLaw& law, const NormalPlace<S>& at) {
    constexpr double e_minus_1 = 1.718281828459045235;
    const double clearance = law.number[1];
    const S u = 1.0 - at.gap * (1.0 / clearance);
    const S scale = law_number<S>(law.number[0], law.rates.normal) / e_minus_1;
    const S e = exponential(clamp(u, 0.0, 200.0)) - 1.0;
    return {-(scale * u * e), (scale / clearance) * (e + u * (e + 1.0)),
            (scale * clearance) * exponential_energy(u, e), u > 0.0};
  }
};

} // namespace ents::ENTS_ISA
