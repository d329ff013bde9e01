// SPDX-License-Identifier: BSD-3-Clause
// Energies of laws that pull.
#pragma once

#include <cstddef>
#include <vector>

#include "ents.h"

namespace host {

/// Of all elements together.
struct ContactEnergy {
  double stored = 0;     ///< by the laws of normal contact and friction [F L]
  double dissipated = 0; ///< within the increment [F L]
  double size = 0;       ///< sum of the elements' sizes: the measure of rounding
};

/// What the library writes of each element, and its sum.
class ElementEnergies {
public:
  /// @param elements  as many; 0: none is asked for
  ElementEnergies(std::size_t elements, ents_output& out);
  ContactEnergy sum() const;

private:
  std::vector<double> of_; ///< three of each element: stored, stored by friction, dissipated
};

} // namespace host
