// SPDX-License-Identifier: BSD-3-Clause
// A normal law that is given by points: the pressure is the monotone piecewise cubic of Steffen (Astron.
// Astrophys. 239 (1990) 443) through them, C1. It ends with slope zero in the last point, where it is zero,
// and continues on a straight line before the first. Of a slave node r p(g / r), r its scale.
#pragma once

#include <cstdint>
#include <vector>

#include "core/law/normal_law.hpp"

namespace ents {

// gap: rising; pressure: falling, the last one 0; at least 2 of each
std::vector<LawTable> make_law_table(const std::vector<double>& gap, const std::vector<double>& pressure);

// Derivatives of W by the gap: the first, the second, W itself, the third
struct TableForce {
  double force, stiffness, energy, third;
};
TableForce table_force(const LawTable* table, std::int32_t points, double gap);

namespace ENTS_ISA {

struct Tabular : NormalLaw {
  static constexpr char type[] = "table",
                        formula[] =
                            "Pressure through given points, a monotone piecewise cubic (Steffen 1990); a "
                            "straight line before the first gap, no contact from the last one on. A slave "
                            "node may have a scale r, ents_input.slave_values[3]: its pressure is r p(g/r). "
                            "Not with wear.";
  static constexpr LawNumber table[] = {
      {"gap", "Rising [L].", LawNumber::rising},
      {"pressure", "One per gap, falling, the last one 0 [F/L^2].", LawNumber::falling}};
  static constexpr bool wears = false, has_scale = true;

  template <class S> static ENTS_INLINE S touching_gap(const ContactLaw& law, const S& scale, const S&) {
    return law.table_points > 0 ? law.table[law.table_points - 1].gap * scale : S(0.0);
  }

  template <class S>
  static ENTS_INLINE NormalForce<S> force(const ContactLaw& law, const NormalPlace<S>& place) {
    const S at = place.gap / place.scale;
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
    f.force = place.scale * f.force;
    f.energy = (place.scale * place.scale) * f.energy;
    return f;
  }
};

} // namespace ENTS_ISA
} // namespace ents
