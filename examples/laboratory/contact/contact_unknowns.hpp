// SPDX-License-Identifier: BSD-3-Clause
// The unknowns that contact elements have, and the equations of the library's points among them.
#pragma once

#include <cstdint>
#include <vector>

#include "master.hpp"
#include "slave_points.hpp"

namespace host {

/// Equations are numbers of `dofs`; -1: none.
struct ContactUnknowns {
  ContactUnknowns() = default;
  /// @param mesh_dofs  number of dofs of the mesh; multipliers stand behind them
  ContactUnknowns(const Master& master, const SlavePoints& points, std::size_t mesh_dofs);

  /// [equations] which of [dofs of the mesh, multipliers]: slave nodes, prescribed ones, too, then master nodes,
  /// multipliers
  std::vector<std::size_t> dofs;
  std::vector<double> signs;           ///< of each: -1 if it is a mirror image's, that moves against its dof
  std::size_t slave_dofs = 0;          ///< so many come first
  std::vector<std::int64_t> of_dofs;   ///< [dofs of the mesh]
  std::vector<std::int64_t> of_master; ///< [nodes of the mesh, images of the net][d]
  std::vector<std::int64_t> of_slaves; ///< [nodes of the slave points][d]
  std::vector<std::int64_t> of_multipliers; ///< [slave points][multipliers of each]
  std::vector<std::int64_t> of_body; ///< of a rigid body that turns: displacements and turns; else empty
};

} // namespace host
