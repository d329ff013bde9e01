// SPDX-License-Identifier: BSD-3-Clause
// The exact solution "boundary_elements" of a scene: its block is an elastic layer, its rigid segment a
// height over it.
#pragma once

#include "dof_map.hpp"
#include "elastic_layer.hpp"
#include "ents_library.hpp"
#include "exact.hpp"
#include "mesh.hpp"

namespace host {

class ExactLayer {
public:
  /// @throws InputError naming the key of the scene that is not a layer's
  ExactLayer(const Scene& scene, const EntsLibrary& library, const Mesh& mesh, const DofMap& dofs);

  /// A step against hard contact without friction at the same motion of the master.
  /// @param motion  of the master along its direction
  /// @throws JobError if the iteration does not converge
  std::vector<Quantity> compare(double motion, const SurfaceState& state) const;

private:
  /// A grid of cells, and the gap before the master moves.
  struct Grid {
    ElasticLayer layer;
    Eigen::ArrayXXd gap;
  };

  const Scene* scene_;
  std::vector<Grid> grids_; ///< fine, and half as fine
};

} // namespace host
