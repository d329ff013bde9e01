// SPDX-License-Identifier: BSD-3-Clause
// Products of a field on a regular rectangular grid with an operator that is a number for each wave, by fast
// Fourier transforms.
#pragma once

#include <Eigen/Core>

namespace host {

/// Where a grid has its points, and what is beyond its sides.
enum class Grid {
  nodes,    ///< n + 1 points, the first and last on sides that are planes of symmetry
  cells,    ///< n points in the middle of cells; sides that are planes of symmetry
  periodic, ///< n points; the field repeats itself
};

/// F, the matrix of the modes [points][modes]:
///   nodes     sqrt(a_m / n) cos(pi m i / n), a = 1 for m = 0 and m = n, else 2;  F^T W F = 1 with the
///             weights W
///   cells     sqrt(a_m / n) cos(pi m (i + 1/2) / n), a = 1 for m = 0, else 2;  F^T F = 1
///   periodic  exp(2 pi i m j / n) / sqrt(n);  F^* F = 1
class WaveTransform {
public:
  /// @param nx, ny  cells
  WaveTransform(Grid grid, Eigen::Index nx, Eigen::Index ny);

  /// F_x (operator * (F_x^* field F_y)) F_y^*, the product in the middle mode by mode.
  /// @param field              [points x][points y]
  /// @param operator_of_modes  [modes x][modes y]; periodic: of m and n - m the same
  Eigen::ArrayXXd filter(const Eigen::ArrayXXd& field, const Eigen::ArrayXXd& operator_of_modes) const;

  /// Share of a cell that belongs to a point: 1; nodes: on a side 1/2, in a corner 1/4.
  const Eigen::ArrayXXd& weights() const { return weights_; }
  /// Waves of a mode along the length of the grid, twice (as of the half waves of a cosine).
  double half_waves(Eigen::Index mode, Eigen::Index cells) const;

private:
  Grid grid_;
  Eigen::Index nx_, ny_;
  Eigen::ArrayXXd weights_;
};

/// The modes of nodes or cells, dense.
Eigen::MatrixXd cosines(Grid grid, Eigen::Index cells);

} // namespace host
