// SPDX-License-Identifier: BSD-3-Clause
// The exact solution "boundary_elements" of a scene: its block is an elastic layer, its rigid segment a
// height over it.
#pragma once

#include <map>
#include <memory>

#include "dof_map.hpp"
#include "ents_library.hpp"
#include "exact.hpp"
#include "layer_scene.hpp"
#include "mesh.hpp"

namespace host {

/// The exact solution of a step, and the same with half the points.
struct LayerTruth {
  LayerContact coarse, fine;
  int points = 0; ///< along the longer side
  /// Of mean pressure and contact fraction from half the points, the larger, relative.
  double change() const;
};

/// A step beside it.
struct LayerAnswer {
  std::vector<Quantity> quantities;
  std::vector<double> pressure; ///< [slaves] exact: mean over the cells around each
};

class ExactLayer {
public:
  /// @throws InputError naming the key of the scene that is not a layer's
  ExactLayer(const Scene& scene, const EntsLibrary& library, const Mesh& mesh, const DofMap& dofs);

  /// Contact without friction at this motion of the master along its direction: hard, or with the penalty of
  /// the key "stiffness".
  /// @throws JobError if the iteration does not converge, or the refinement that the key "error" asks for
  LayerTruth truth(double motion) const;

  /// Exact pressures of the slave points: the mean over the cells around each.
  std::vector<double> pressure_at(const SurfaceState& state, const LayerTruth& truth) const;

  /// A step with the same motion beside it.
  LayerAnswer compare(const LayerTruth& truth, const SurfaceState& state) const;

private:
  /// A grid of cells, and the gap before the master moves.
  struct Cells {
    ElasticLayer layer;
    Eigen::ArrayXXd gap;
  };
  /// So many along the longer side; made when they are needed.
  const Cells& cells(int points) const;
  LayerContact press(int points, double motion) const;

  const Scene* scene_;
  LayerScene place_;
  std::unique_ptr<EntsModel> model_;
  mutable std::map<int, Cells> cells_;
};

} // namespace host
