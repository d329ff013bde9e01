// SPDX-License-Identifier: BSD-3-Clause
// Heat through the gap (theory.md, section 7.5): a conductance h [power / (area temperature)] that is the sum of the
// parts a model has, and the heat of friction. Functions of numbers.
//
//   in contact   constant + coefficient (p / p_0)^exponent + table over p
//   open         table over the gap
//   gas          conductivity / (g + jump), g >= 0 the gap, 0 in contact (Kennard 1938)
//
// The power covers Cooper, Mikic and Yovanovich (Int. J. Heat Mass Transfer 12, 1969; exponent 0.95) and Mikic's
// elastic one (ibid. 17, 1974; 0.94). A potential in place of the temperature makes it an electrical contact.
#pragma once

#include <cmath>
#include <cstdint>

namespace ents {

// A point of a table; between points the conductance is linear.
struct ConductancePoint {
  double at = 0.0; // pressure or gap, rising
  double conductance = 0.0;
};

struct Heat {
  bool on = false;
  double constant = 0.0;
  double coefficient = 0.0, pressure = 1.0, exponent = 1.0; // of the power
  double conductivity = 0.0, jump = 1.0;                    // of the gas; jump [L]
  double share = 0.0;                                       // of what friction dissipates that becomes heat
  double slave = 0.5;                                       // of this heat that enters the slave side
  bool has_friction = false;
  const ConductancePoint *by_pressure = nullptr, *by_gap = nullptr; // of a plan: tables that its model has
  std::int32_t pressures = 0, gaps = 0;                             // their points
};

// h and its derivatives
struct Conductance {
  double value = 0.0, by_gap = 0.0, by_pressure = 0.0;
};

// The table at x; beyond its ends it is constant. slope: its derivative there
inline double conductance_of_table(const ConductancePoint* points, std::int32_t count, double x,
                                   double& slope) {
  slope = 0.0;
  if (count == 0) return 0.0;
  if (!(x > points[0].at)) return points[0].conductance;
  for (std::int32_t i = 1; i < count; ++i)
    if (x < points[i].at) {
      const ConductancePoint &low = points[i - 1], &high = points[i];
      slope = (high.conductance - low.conductance) / (high.at - low.at);
      return low.conductance + slope * (x - low.at);
    }
  return points[count - 1].conductance;
}

// gap [L], pressure [F/L^2] of an element that is in contact or not
inline Conductance conductance(const Heat& heat, double gap, double pressure, bool contact) {
  Conductance h;
  double slope = 0.0;
  if (contact) {
    h.value = heat.constant + conductance_of_table(heat.by_pressure, heat.pressures, pressure, slope);
    h.by_pressure = slope;
    if (heat.coefficient != 0.0 && pressure > 0.0) {
      const double power = heat.coefficient * std::pow(pressure / heat.pressure, heat.exponent);
      h.value += power;
      h.by_pressure += heat.exponent * power / pressure;
    }
  } else {
    h.value = conductance_of_table(heat.by_gap, heat.gaps, gap, slope);
    h.by_gap = slope;
  }
  if (heat.conductivity != 0.0) {
    const bool apart = gap > 0.0 && !contact;
    const double gas = heat.conductivity / (apart ? gap + heat.jump : heat.jump);
    h.value += gas;
    if (apart) h.by_gap -= gas / (gap + heat.jump);
  }
  return h;
}

} // namespace ents
