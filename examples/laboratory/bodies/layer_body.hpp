// SPDX-License-Identifier: BSD-3-Clause
// A body with surface nodes only: a linear elastic layer that is bonded to a rigid base and whose sides are
// planes of symmetry. Its stiffness is that of its compliance in closed form (layer_compliance): no mesh
// below the surface, no error of such a mesh. The nodes move along z alone.
#pragma once

#include <memory>
#include <vector>

#include "mesh.hpp"
#include "scene.hpp"
#include "toolbox/solver.hpp"
#include "wave_transform.hpp"

namespace host {

/// Add the surface of a layer: nodes on the grid of x and y at the largest z; the sets NAME and NAME.z_max.
void add_layer(Mesh& mesh, const std::string& name, const std::vector<GridLines>& lines);

class LayerBody {
public:
  /// @param lines  of the part: equal cells along x and y; thickness from the first to the last of z
  LayerBody(const std::vector<GridLines>& lines, const Material& material);

  Eigen::Index nodes() const { return stiffness_.size(); }
  /// Forces along z that hold the nodes at displacements along z.
  Eigen::VectorXd force(const Eigen::VectorXd& displacement) const;
  /// The inverse of `force`.
  Eigen::VectorXd displacement(const Eigen::VectorXd& force) const;
  /// Diagonal of the matrix that `force` multiplies with.
  const Eigen::VectorXd& diagonal() const { return diagonal_; }

private:
  WaveTransform transform_;
  Eigen::ArrayXXd compliance_; ///< inverse of the next
  Eigen::ArrayXXd stiffness_;  ///< [modes x][modes y] pressure per displacement times the area of a cell
  Eigen::VectorXd diagonal_;   ///< [nodes]
};

/// Conjugate gradients for the layer's stiffness plus the matrix of the contact elements. Preconditioner: the
/// layer's compliance on the nodes that are free, which makes the number of iterations nearly independent of
/// the mesh; the diagonal on those that contact elements hold. Multipliers, one for each node, are
/// eliminated: where contact is closed their equation prescribes the displacement. Of a
/// matrix that is not positive definite `factorize` says no, or the solution is not finite.
class LayerSolver final : public LinearSolver {
public:
  explicit LayerSolver(std::shared_ptr<const LayerBody> body) : body_(std::move(body)) {}
  void analyze(const SparseMatrix&) override {}
  bool factorize(const SparseMatrix& matrix) override;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) override;
  std::string name() const override { return "conjugate gradients on a layer's surface"; }

private:
  /// f lambda + diagonal displacement = rest of the node's row; g displacement + h lambda = rest of its own.
  struct Multiplier {
    Eigen::Index node = -1;
    double f = 0, g = 0, h = 0;
  };
  Eigen::VectorXd product(const Eigen::VectorXd& displacement) const;
  /// Displacements of the free nodes for forces; the others' are zero. Empty: the matrix is not positive
  /// definite.
  Eigen::VectorXd free_displacement(const Eigen::VectorXd& force) const;

  std::shared_ptr<const LayerBody> body_;
  SparseMatrix contact_;     ///< of the displacements, lower triangle
  Eigen::VectorXd diagonal_; ///< of both
  Eigen::ArrayXd free_;      ///< [nodes] 0: the displacement is prescribed, 1
  Eigen::ArrayXd open_;      ///< [nodes] 1: free, and contact elements are soft there; 0
  std::vector<Multiplier> multipliers_;
};

} // namespace host
