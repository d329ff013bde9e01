// SPDX-License-Identifier: BSD-3-Clause
// The numbers of a contact law, per area: the normal law (normal_law.hpp), the limit of friction, wear.
#pragma once

#include <cstdint>
#include <type_traits>

#include "core/law/heat.hpp"
#include "core/law/normal_kinds.hpp"
#include "core/numbers/elementary.hpp"

namespace ents {

enum class FrictionKind : std::int32_t {
  none,
  coulomb, // |t| <= min(mu p, shear limit)
  rough    // no slip
};

// Archard's wear, dw = k p ds: see wear.hpp.
struct Wear {
  bool on = false;
  double coefficient = 0.0; // k [L^2/F]
  double implicit = 1.0;    // weight of the end's pressure: 1 implicit, 1/2 trapezoidal, 0 explicit
  double slave = 1.0;   // part of the depth that the slave surface loses, the master surface loses the rest
  double sliding = 0.0; // [L] per increment, beside and perpendicular to that of the slave on the master
};

// A coefficient of friction that depends on slip rate or pressure: see friction_coefficient.hpp.
struct VaryingCoefficient {
  enum Kind : std::int32_t { constant, decays, table };
  Kind kind = constant;
  double kinetic = 0.0, decay = 0.0; // at high rates; [T/L]
  // Of a plan, which its model has: rising pressures and slip rates, a row for each pressure
  const double *pressure = nullptr, *rate = nullptr, *coefficient = nullptr;
  std::int32_t pressures = 0, rates = 0;

  constexpr bool by_rate() const { return kind == decays || rates > 1; }
};

// A part of the height that gives way to the pressure: see flattening.hpp.
struct Flattening {
  std::uint8_t parameter = 0;         // 1 + index of its scale; 0: none
  double pressure = 0.0, least = 0.0; // [F/L^2]; the scale that is left under any pressure
};

// Derivatives of a law's numbers by the parameter of a differentiation (parameter_rates.hpp)
struct LawRates {
  double normal = 0.0, friction = 0.0, wear = 0.0, sliding = 0.0, offset = 0.0;
};

// Numbers that hold for one slave node: ents_input.slave_values
namespace slave_value {
enum : std::int32_t {
  offset,  // added to the law's offset
  wear,    // factor of k
  sliding, // factor of `sliding`
  scale    // factor of a table's gaps and pressures, of the work of adhesion
};
}

// A point of a table, derivatives of W by the gap: table.hpp
struct LawTable {
  double gap = 0.0;       // [L], rising
  double force = 0.0;     // W' = -p [F/L^2], rising to 0
  double stiffness = 0.0; // [F/L^3]
  double energy = 0.0;    // W [F/L]
};

struct ContactLaw {
  NormalKind normal = NormalKind::none;
  // What the law says of itself, see set_normal_law()
  Multiplier multiplier = Multiplier::none;
  bool has_slope = false, has_scale = false;
  bool pulls = false, bonds = false, is_damaged = false;
  double number[4] = {};           // of the law's table, in its order; of most laws eps [F/L^3]
  std::int32_t twice_exponent = 2; // 2 m (power)
  FrictionKind friction = FrictionKind::none;
  double friction_coefficient = 0.0; // mu; of one that varies the static one, or the largest
  VaryingCoefficient varying;
  double friction_stiffness = 0.0; // eps_t [F/L^3]
  double shear_limit = 0.0;        // [F/L^2]; 0: none
  bool rubs_adhering = false; // friction of p + strength(), not of what is compression: rubbing_pressure()
  bool symmetrised = false;   // tangent (K + K^T) / 2
  const LawTable* table = nullptr; // of a plan: points that its model has
  std::int32_t table_points = 0;
  bool has_offset = false;
  double offset = 0.0; // [L] added to the gap that the law sees: > 0 a clearance, < 0 a coating
  Wear wear;
  Flattening flattening;
  Heat heat;
  LawRates rates;

  constexpr bool has_friction() const { return friction != FrictionKind::none; }
  // Has friction a force, or a derivative of one? With a coefficient of 0 only the state knows of it.
  constexpr bool has_friction_force() const {
    return friction == FrictionKind::rough ||
           (has_friction() && (friction_coefficient != 0.0 || rates.friction != 0.0));
  }
  // Is the force W' = (W'/g) g with a finite W'/g?
  constexpr bool force_has_slope() const { return has_slope && !wear.on && !has_offset; }
  // Does it read numbers of the slave node (SlaveValues)?
  constexpr bool has_slave_values() const { return wear.on || has_offset || has_scale; }
  // How many?
  constexpr std::int32_t slave_values() const {
    return has_scale ? slave_value::scale + 1 : slave_value::scale;
  }
  constexpr bool coefficient_varies() const { return varying.kind != VaryingCoefficient::constant; }
  // Is there contact without a limit of friction?
  constexpr bool may_not_press() const { return multiplier_is_dof() || pulls; }
  constexpr bool multiplier_in_state() const { return multiplier == Multiplier::in_state; }
  constexpr bool multiplier_is_dof() const { return multiplier == Multiplier::is_dof; }
};

namespace ENTS_ISA {

// A number of the law; for dual numbers with its derivative
template <class S> ENTS_INLINE S law_number(double value, double rate) {
  if constexpr (std::is_same_v<S, Dual<double>>)
    return S(value, rate);
  else
    return S(value);
}

// What a slipping element keeps is a little less than the limit, so that the next increment, which begins
// there, begins inside of it whatever rounding does to xi: or equal elements would stick here and slip there.
inline constexpr double rounding_of_xi = 4e-15, rounding_of_limit = 1e-13;
// The part of xi - xi_0 that is left as elastic slip: L / |t|
template <int T>
ENTS_INLINE double kept_elastic_slip(double limit, double trial_norm, const double (&moved)[T]) {
  if (!(limit > 0.0)) return 0.0;
  double longest = absolute(moved[0]);
  if (T == 2 && absolute(moved[T - 1]) > longest) longest = absolute(moved[T - 1]);
  const double kept = limit / trial_norm * (1.0 - rounding_of_limit) - rounding_of_xi / longest;
  return kept > 0.0 ? kept : 0.0;
}
// The part of L that a multiplier takes along. force_of_xi: of a unit of xi
ENTS_INLINE double kept_multiplier(double limit, double force_of_xi) {
  const double kept = 1.0 - rounding_of_limit - rounding_of_xi * force_of_xi / limit;
  return kept > 0.0 ? kept : 0.0;
}

} // namespace ENTS_ISA
} // namespace ents
