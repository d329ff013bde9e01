// SPDX-License-Identifier: BSD-3-Clause
// Torque and axial force of a screw: a rigid helix whose flanks are inclined by beta in an axial section
// slides in its nut (e.g. VDI 2230; Shigley, Mechanical Engineering Design: square and inclined threads),
//   T / F = r (tan a + mu sec b) / (1 - mu sec b tan a)   tightened,
//   T / F = r (mu sec b - tan a) / (1 + mu sec b tan a)   loosened,
//   tan a = lead / (2 pi r),  tan b = tan beta cos a
// at the radius r at which the flanks carry on average; below mu = tan a cos b the second is negative: the
// load turns the screw.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "exact.hpp"

namespace host {

double screw_torque(double radius, double lead, double flank_angle, double coefficient, bool tightened) {
  const double rise = lead / (2 * std::numbers::pi * radius), a = std::atan(rise),
               flank = std::atan(std::tan(flank_angle * std::numbers::pi / 180) * std::cos(a)),
               mu = coefficient / std::cos(flank);
  return tightened ? radius * (rise + mu) / (1 - mu * rise) : radius * (mu - rise) / (1 + mu * rise);
}

std::vector<Quantity> compare_with_screw(const Scene& scene, const SurfaceState& state) {
  const ExactSpec& exact = scene.exact;
  double closed = 0, slips = 0;
  for (std::size_t k = 0; k < state.closed.size(); ++k) {
    closed += state.area[k] * state.closed[k];
    slips += state.area[k] * (state.closed[k] && !state.sticks[k]);
  }
  const double force = state.contact_force.back();
  if (state.turning == 0 || force == 0) return {};
  // A screw with a right-hand thread that turns forwards moves along z: against a force of the nut in that
  // direction it does not have to be tightened.
  const bool tightened = (state.turning > 0) == (force > 0);
  const double sign = tightened ? -1 : 1;
  std::vector<Quantity> result{{"mean radius of contact", scene.units.length, state.mean_radius},
                               {"slipping", "%", 100 * slips / closed}};
  if (slips > 0.95 * closed) // until then the nut only twists
    result.push_back(exact_quantity(
        tightened ? "torque / force, tightened" : "torque / force, loosened", scene.units.length,
        sign * state.moment / force,
        screw_torque(state.mean_radius, exact.lead, exact.flank_angle, exact.coefficient, tightened)));
  return result;
}

} // namespace host
