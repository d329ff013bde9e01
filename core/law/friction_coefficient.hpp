// SPDX-License-Identifier: BSD-3-Clause
// A coefficient of friction that depends on slip rate and pressure (theory.md, section 5.11), and the limit of
// an element that slips under it. With s the slip of the increment and D its time, the return mapping is one
// equation for s >= 0, of the norm of the trial and the pressure force P,
//   norm = eps_t A s + P mu(P / A, s / D),  L = P mu
// whose smallest root is taken. mu = mu_k + (mu_s - mu_k) e^(-d v), or linear between the points of a table.
#pragma once

#include <cmath>

#include "core/law/contact_law.hpp"
#include "core/numbers/lanes.hpp"

namespace ents {

// L and its derivatives: by norm, by P, and by mu_s
struct SlipLimit {
  double limit, by_norm, by_force, by_coefficient;
};

// A table at a pressure, between two columns; weight: of the row after
struct TableRow {
  const VaryingCoefficient& of;
  std::int32_t row = 0;
  double weight = 0.0, by_pressure = 0.0; // of the weight

  TableRow(const VaryingCoefficient& table, double pressure) : of(table) {
    if (of.pressures < 2 || !(pressure > of.pressure[0])) return;
    row = of.pressures - 2;
    weight = 1.0;
    for (std::int32_t i = 1; i < of.pressures; ++i)
      if (pressure < of.pressure[i]) {
        row = i - 1;
        by_pressure = 1.0 / (of.pressure[i] - of.pressure[i - 1]);
        weight = (pressure - of.pressure[i - 1]) * by_pressure;
        break;
      }
  }
  double at(std::int32_t column) const {
    const double low = of.coefficient[row * of.rates + column];
    return of.pressures < 2 ? low : low + weight * (of.coefficient[(row + 1) * of.rates + column] - low);
  }
  double slope(std::int32_t column) const { // by the pressure
    return of.pressures < 2 ? 0.0
                            : by_pressure * (of.coefficient[(row + 1) * of.rates + column] -
                                             of.coefficient[row * of.rates + column]);
  }
};

// mu and its derivatives by slip rate and pressure
struct CoefficientAt {
  double mu, by_rate, by_pressure;
};
inline CoefficientAt coefficient_between(const TableRow& row, std::int32_t column, double rate) {
  const VaryingCoefficient& of = row.of;
  if (column + 1 >= of.rates) return {row.at(of.rates - 1), 0.0, row.slope(of.rates - 1)};
  const double length = of.rate[column + 1] - of.rate[column], u = (rate - of.rate[column]) / length;
  const double rise = row.at(column + 1) - row.at(column);
  return {row.at(column) + u * rise, rise / length,
          row.slope(column) + u * (row.slope(column + 1) - row.slope(column))};
}

// The slip of a table: its column, and mu there
inline CoefficientAt slip_of_table(const VaryingCoefficient& of, double norm, double force, double area,
                                   double scale, double time) {
  const TableRow row(of, area > 0.0 ? force / area : 0.0);
  const auto needed = [&](std::int32_t column) { // norm that slips at the rate of a column
    return scale * (of.rate[column] * time) + force * row.at(column);
  };
  if (of.rates < 2 || !(norm > needed(0))) return {row.at(0), 0.0, row.slope(0)};
  for (std::int32_t column = 0; column + 1 < of.rates; ++column)
    if (const double low = needed(column), high = needed(column + 1); norm < high) {
      const double u = (norm - low) / (high - low);
      return coefficient_between(row, column, of.rate[column] + u * (of.rate[column + 1] - of.rate[column]));
    }
  return coefficient_between(row, of.rates - 1, 0.0);
}

// The slip of mu_k + (mu_s - mu_k) e^(-d v): Newton's method from the side from which it is monotone
inline CoefficientAt slip_of_decay(const ContactLaw& law, double norm, double force, double scale,
                                   double time) {
  const VaryingCoefficient& of = law.varying;
  const double fall = law.friction_coefficient - of.kinetic, by_slip = of.decay / time;
  if (!(norm > force * law.friction_coefficient)) return {law.friction_coefficient, 0.0, 0.0};
  double slip = fall > 0.0 ? (norm - force * of.kinetic) / scale : 0.0;
  for (int step = 0; step < 200; ++step) {
    const double more = fall * std::exp(-by_slip * slip);
    const double miss = scale * slip + force * (of.kinetic + more) - norm;
    const double next = slip - miss / (scale - force * more * by_slip);
    const bool met = std::fabs(next - slip) <= 1e-16 * std::fabs(next) || !(next >= 0.0);
    if (next >= 0.0) slip = next;
    if (met) break;
  }
  const double more = fall * std::exp(-by_slip * slip);
  return {of.kinetic + more, -of.decay * more, 0.0};
}

// norm: of the trial; force: P >= 0; scale: eps_t A; time: of the increment
inline SlipLimit slip_limit(const ContactLaw& law, double norm, double force, double area, double scale,
                            double time) {
  const bool is_table = law.varying.kind == VaryingCoefficient::table;
  const CoefficientAt at = is_table ? slip_of_table(law.varying, norm, force, area, scale, time)
                                    : slip_of_decay(law, norm, force, scale, time);
  const double by_slip = at.by_rate != 0.0 ? force * (at.by_rate / time) : 0.0, slope = scale + by_slip;
  const double by_force = at.mu + (area > 0.0 ? force * (at.by_pressure / area) : 0.0);
  if (!(slope > 0.0)) return {force * at.mu, 0.0, by_force, 0.0};
  const double fall = law.friction_coefficient - law.varying.kinetic;
  const double of_static =
      is_table || fall == 0.0 ? (is_table ? 0.0 : 1.0) : (at.mu - law.varying.kinetic) / fall;
  return {force * at.mu, by_slip / slope, scale / slope * by_force, scale / slope * force * of_static};
}

namespace ENTS_ISA {

// The same of any scalar
template <class S> struct SlipLimitOf { S limit, by_norm, by_force; };
template <class S>
ENTS_NOINLINE SlipLimitOf<S> slip_limit_of(const ContactLaw& law, const S& norm, const S& force,
                                           const S& area, const S& scale, double time) {
  SlipLimitOf<S> of;
  if constexpr (std::is_same_v<S, double>) {
    const SlipLimit one = slip_limit(law, norm, force, area, scale, time);
    of = {one.limit, one.by_norm, one.by_force};
  } else if constexpr (std::is_same_v<S, Dual<double>>) {
    const SlipLimit one = slip_limit(law, norm.v, force.v, area.v, scale.v, time);
    of.limit =
        S(one.limit, one.by_norm * norm.d + one.by_force * force.d + one.by_coefficient * law.rates.friction);
    of.by_norm = S(one.by_norm), of.by_force = S(one.by_force);
  } else {
    for (int k = 0; k < width_of<S>; ++k) {
      const SlipLimit one =
          slip_limit(law, lane(norm, k), lane(force, k), lane(area, k), lane(scale, k), time);
      of.limit.v[k] = one.limit, of.by_norm.v[k] = one.by_norm, of.by_force.v[k] = one.by_force;
    }
  }
  return of;
}

} // namespace ENTS_ISA
} // namespace ents
