// SPDX-License-Identifier: BSD-3-Clause
// The exact solution "boundary_elements" of a scene: its block is an elastic layer, its rigid segment a
// height over it.
#pragma once

#include <array>
#include <map>
#include <memory>

#include "dof_map.hpp"
#include "elastic_layer.hpp"
#include "ents_library.hpp"
#include "exact.hpp"
#include "mesh.hpp"

namespace host {

/// The block of the scene, and which way its surface looks.
struct Box {
  std::array<double, 3> low{}, high{};
  double up = 1; ///< z of its surface's normal
  double surface() const { return up > 0 ? high[2] : low[2]; }
  double base() const { return up > 0 ? low[2] : high[2]; }
};

/// A step beside its exact solution.
struct LayerAnswer {
  std::vector<Quantity> quantities;
  std::vector<double> pressure; ///< [slaves] exact: mean over the cells around each
};

class ExactLayer {
public:
  /// @throws InputError naming the key of the scene that is not a layer's
  ExactLayer(const Scene& scene, const EntsLibrary& library, const Mesh& mesh, const DofMap& dofs);

  /// A step against contact without friction at the same motion of the master: hard, or with the penalty of
  /// the key "stiffness".
  /// @param motion  of the master along its direction
  /// @throws JobError if the iteration does not converge, or the refinement that the key "error" asks for
  LayerAnswer compare(double motion, const SurfaceState& state) const;

private:
  /// A grid of cells, and the gap before the master moves.
  struct Cells {
    ElasticLayer layer;
    Eigen::ArrayXXd gap;
  };
  /// So many along the longer side; made when they are needed.
  const Cells& cells(int points) const;
  LayerContact press(int points, double motion) const;
  std::vector<double> pressure_at(const SurfaceState& state, const Cells& grid,
                                  const LayerContact& exact) const;

  const Scene* scene_;
  std::unique_ptr<EntsModel> model_;
  Box box_;
  bool periodic_;
  mutable std::map<int, Cells> cells_;
};

} // namespace host
