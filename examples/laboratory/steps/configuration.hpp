// SPDX-License-Identifier: BSD-3-Clause
// The unknowns of a scene.
#pragma once

#include <vector>

namespace host {

/// Where the system is.
struct Configuration {
  std::vector<double> displacement; ///< [dofs]
  std::vector<double>
      multiplier;         ///< [slaves][multipliers of a contact element], empty if the method has none
  double motion = 0;      ///< of the rigid master along its direction [L]
  double force = 0;       ///< on the rigid master along its direction, this mesh's share [F]
  double load_factor = 0; ///< of supports and tractions
  std::vector<double> parameters; ///< values of the contact model's, in alphabetical order; empty: none
  // Of a rigid body that turns, at the begin of the increment; empty: it has not turned yet.
  std::vector<double> rotation; ///< [d][d] row by row, its columns are the body's axes
  std::vector<double> turned;   ///< [3], 2D [1] what its turns were
};

} // namespace host
