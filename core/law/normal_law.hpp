// SPDX-License-Identifier: BSD-3-Clause
// The normal force of a contact law at a gap (the laws: contact_law.hpp), for a double or for one number per
// lane.
#pragma once

#include "core/law/contact_law.hpp"
#include "core/law/law_table.hpp"
#include "core/law/open_multiplier.hpp"
#include "core/numbers/lanes.hpp"

namespace ents::ENTS_ISA {

// Per area: dW/dg (<= 0), d2W/dg2, W, and whether the element is in contact.
template <class S> struct NormalForce {
  S force, stiffness, energy;
  Truth<S> contact;
};

template <class S> ENTS_INLINE S larger(S a, S b) { return select(a > b, a, b); }

// W'/g = c (-g)^(m-1) of the penalty and the power law, where they are in contact.
template <class S> ENTS_INLINE S force_per_gap(const ContactLaw& law, const S& gap) {
  S per_gap = law_number<S>(law.stiffness, law.rates.normal);
  if (law.normal == NormalKind::power && law.twice_exponent > 2) {
    const int n = law.twice_exponent - 2;
    const S depth = larger(-gap, S(0.0));
    if (n % 2) per_gap = per_gap * square_root(depth);
    for (int i = 0; i < n / 2; ++i) per_gap = per_gap * depth;
  }
  return per_gap;
}

// W of the exponential law over c0 p0 / (e - 1): the integral of v (e^v - 1) from 0 to u; e_minus_1 = e^u
// - 1.
template <class S> ENTS_INLINE S exponential_energy(const S& u, const S& e_minus_1) {
  // The closed form cancels for small u: sum over k >= 3 of (k - 1) / k! u^k.
  const S series =
      u * u * u *
      (1.0 / 3.0 +
       u * (1.0 / 8.0 + u * (1.0 / 30.0 + u * (1.0 / 144.0 + u * (1.0 / 840.0 + u * (1.0 / 5760.0))))));
  return select(u > 0.05, (u - 1.0) * e_minus_1 + u - 0.5 * u * u, series);
}

// The law of a table; scale: r of r p(g / r)
template <class S>
ENTS_INLINE NormalForce<S> tabular_force(const ContactLaw& law, const S& gap, const S& scale) {
  const S at = gap / scale;
  const auto of = [&](double g) { return table_force(law.table, law.table_points, g); };
  NormalForce<S> f{S(0.0), S(0.0), S(0.0), S(1.0) < S(0.0)};
  if constexpr (std::is_same_v<S, double>) {
    const TableForce t = of(at);
    f.force = t.force, f.stiffness = t.stiffness, f.energy = t.energy;
  } else if constexpr (std::is_same_v<S, Dual<double>>) {
    const TableForce t = of(at.v);
    f.force = S(t.force, t.stiffness * at.d), f.stiffness = S(t.stiffness, t.third * at.d);
    f.energy = S(t.energy, t.force * at.d);
  } else {
    for (int k = 0; k < width_of<S>; ++k) {
      const TableForce t = of(lane(at, k));
      f.force.v[k] = t.force, f.stiffness.v[k] = t.stiffness, f.energy.v[k] = t.energy;
    }
  }
  f.contact = f.force < 0.0;
  f.force = scale * f.force;
  f.energy = (scale * scale) * f.energy;
  return f;
}

// multiplier: lambda of the augmented and the multiplier laws, a pressure; of_table: its scale
template <class S>
ENTS_INLINE NormalForce<S> normal_force(const ContactLaw& law, const S& gap, const S& multiplier,
                                        const S& of_table = S(1.0)) {
  NormalForce<S> f{S(0.0), S(0.0), S(0.0), S(1.0) < S(0.0)};
  S held = S(0.0); // energy where there is no contact
  const S eps = law_number<S>(law.stiffness, law.rates.normal);
  switch (law.normal) {
  case NormalKind::none:
    return f;
  case NormalKind::penalty:
  case NormalKind::power: {
    const double m = 0.5 * law.twice_exponent;
    const S per_gap = force_per_gap(law, gap);
    f = {per_gap * gap, m * per_gap, per_gap * gap * gap / S(m + 1.0), gap <= 0.0};
    break;
  }
  case NormalKind::exponential: {
    constexpr double e_minus_1 = 1.718281828459045235;
    const S u = 1.0 - gap * (1.0 / law.clearance);
    const S scale = law_number<S>(law.pressure, law.rates.normal) / e_minus_1;
    const S e = exponential(clamp(u, 0.0, 200.0)) - 1.0;
    f = {-(scale * u * e), (scale / law.clearance) * (e + u * (e + 1.0)),
         (scale * law.clearance) * exponential_energy(u, e), u > 0.0};
    break;
  }
  case NormalKind::augmented:
  case NormalKind::augmented_multiplier: {
    const S p = multiplier - eps * gap;
    held = open_multiplier_energy(eps, multiplier);
    f = {-p, eps, 0.5 * p * p * (1.0 / eps) + held, p > 0.0};
    break;
  }
  case NormalKind::table:
    f = tabular_force(law, gap, of_table);
    break;
  case NormalKind::multiplier:
    held = open_multiplier_energy(eps, multiplier);
    f = {-multiplier, S(0.0), -(multiplier * gap), multiplier - eps * gap > 0.0};
    break;
  }
  f.force = select(f.contact, f.force, S(0.0));
  f.stiffness = select(f.contact, f.stiffness, S(0.0));
  f.energy = select(f.contact, f.energy, held);
  return f;
}

} // namespace ents::ENTS_ISA
