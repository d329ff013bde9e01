// SPDX-License-Identifier: BSD-3-Clause
// Elastic half-space under a point force normal to its surface: Boussinesq's displacement.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "material.hpp"

namespace host {

/// Displacement at `position` per unit force (K. L. Johnson, Contact Mechanics, 1985, eq. 3.18).
/// @param position   relative to the point of load, not zero
/// @param direction  unit vector of the force, into the half-space
inline std::array<double, 3> boussinesq(const Material& material, const std::array<double, 3>& position,
                                        const std::array<double, 3>& direction) {
  double depth = 0, squared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    depth += position[i] * direction[i];
    squared += position[i] * position[i];
  }
  const double distance = std::sqrt(squared), nu = material.poisson;
  const double shear = 4 * std::numbers::pi * material.mu();
  const double radial =
      (depth / (squared * distance) - (1 - 2 * nu) / (distance * (distance + depth))) / shear;
  const double axial = (depth * depth / (squared * distance) + 2 * (1 - nu) / distance) / shear;
  std::array<double, 3> displacement{};
  for (std::size_t i = 0; i < 3; ++i)
    displacement[i] = radial * (position[i] - depth * direction[i]) + axial * direction[i];
  return displacement;
}

} // namespace host
