// SPDX-License-Identifier: BSD-3-Clause
// Contact laws per area: the normal force from a potential W(g) or a multiplier, and the limit of friction.
//
//   penalty               W = eps g^2 / 2                             g < 0
//   power                 p = c (-g)^m                                g < 0, m a multiple of 1/2, >= 1
//   exponential           p = p0 / (e - 1) u (e^u - 1), u = 1 - g / c0, g < c0 (pressure p0 at g = 0)
//   augmented             W = (<p>^2 - lambda^2) / (2 eps), p = lambda - eps g; lambda in the state (Uzawa)
//   augmented_multiplier  the same with lambda as a dof (Alart and Curnier 1991, semi-smooth Newton)
//   multiplier            lambda as a dof, no augmentation; eps only decides the active set
#pragma once

#include <cstdint>

#include "core/elementary.hpp"

namespace ents {

enum class NormalKind : std::int32_t {
  none,
  penalty,
  power,
  exponential,
  augmented,
  augmented_multiplier,
  multiplier
};

enum class FrictionKind : std::int32_t {
  none,
  coulomb,  // |t| <= min(mu p, shear limit)
  rough     // no slip
};

struct ContactLaw {
  NormalKind normal = NormalKind::none;
  double stiffness = 0.0;             // eps [F/L^3]; power: c [F/L^(2+m)]
  std::int32_t twice_exponent = 2;    // 2 m (power)
  double pressure = 0.0;              // p0 [F/L^2] (exponential)
  double clearance = 0.0;             // c0 [L] (exponential)
  FrictionKind friction = FrictionKind::none;
  double friction_coefficient = 0.0;  // mu
  double friction_stiffness = 0.0;    // eps_t [F/L^3]
  double shear_limit = 0.0;           // [F/L^2]; 0: none
  bool symmetrised = false;           // tangent (K + K^T) / 2

  constexpr bool has_friction() const { return friction != FrictionKind::none; }
  constexpr bool multiplier_in_state() const { return normal == NormalKind::augmented; }
  constexpr bool multiplier_is_dof() const {
    return normal == NormalKind::augmented_multiplier || normal == NormalKind::multiplier;
  }
};

namespace ENTS_ISA {

// Per area: dW/dg (<= 0), d2W/dg2, W, and whether the pair is in contact.
struct NormalForce {
  double force;
  double stiffness;
  double energy;
  bool contact;
};

// x^(n/2), x >= 0
ENTS_INLINE double half_power(double x, std::int32_t n) {
  double r = n % 2 ? square_root(x) : 1.0;
  for (std::int32_t i = 0; i < n / 2; ++i) r *= x;
  return r;
}

// W of the exponential law over c0 p0 / (e - 1): integral of v (e^v - 1) from 0 to u
ENTS_INLINE double exponential_energy(double u, double e_minus_1) {
  if (u > 0.05) return (u - 1.0) * e_minus_1 + u - 0.5 * u * u;
  // sum over k >= 3 of (k - 1) / k! u^k: the closed form cancels here
  return u * u * u *
         (1.0 / 3.0 + u * (1.0 / 8.0 + u * (1.0 / 30.0 + u * (1.0 / 144.0 + u * (1.0 / 840.0 + u / 5760.0)))));
}

ENTS_INLINE NormalForce normal_force(const ContactLaw& law, double gap, double multiplier) {
  const NormalForce open = {0.0, 0.0, 0.0, false};
  switch (law.normal) {
    case NormalKind::none: return open;
    case NormalKind::penalty:
      if (!(gap < 0.0)) return open;
      return {law.stiffness * gap, law.stiffness, 0.5 * law.stiffness * gap * gap, true};
    case NormalKind::power: {
      if (!(gap < 0.0)) return open;
      const double m = 0.5 * law.twice_exponent;
      const double below = law.stiffness * half_power(-gap, law.twice_exponent - 2);  // c (-g)^(m-1)
      return {below * gap, m * below, below * gap * gap / (m + 1.0), true};
    }
    case NormalKind::exponential: {
      const double u = 1.0 - gap / law.clearance;
      if (!(u > 0.0)) return open;
      constexpr double e_minus_1 = 1.718281828459045235;
      const double scale = law.pressure / e_minus_1;
      const double e = exponential(u < 200.0 ? u : 200.0) - 1.0;
      return {-scale * u * e, scale / law.clearance * (e + u * (e + 1.0)),
              scale * law.clearance * exponential_energy(u, e), true};
    }
    case NormalKind::augmented:
    case NormalKind::augmented_multiplier: {
      const double p = multiplier - law.stiffness * gap;
      const double before = 0.5 * multiplier * multiplier / law.stiffness;
      if (!(p > 0.0)) return {0.0, 0.0, -before, false};
      return {-p, law.stiffness, 0.5 * p * p / law.stiffness - before, true};
    }
    case NormalKind::multiplier:
      if (!(multiplier - law.stiffness * gap > 0.0)) return {0.0, 0.0, -0.5 * multiplier * multiplier / law.stiffness, false};
      return {-multiplier, 0.0, -multiplier * gap, true};
  }
  return open;
}

// What a slipping element keeps is a little less than the limit, so that the next increment, which begins there, begins inside of it
// whatever rounding does to xi: or equal elements would stick here and slip there.
inline constexpr double rounding_of_xi = 4e-15, rounding_of_limit = 1e-13;
// The part of xi - xi_0 that is left as elastic slip: L / |t|
template <int T> ENTS_INLINE double kept_elastic_slip(double limit, double trial_norm, const double (&moved)[T]) {
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

}  // namespace ENTS_ISA
}  // namespace ents
