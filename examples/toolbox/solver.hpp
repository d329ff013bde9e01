// SPDX-License-Identifier: BSD-3-Clause
// Direct solvers: Cholesky for a symmetric tangent, LU otherwise. SuiteSparse's supernodal CHOLMOD and
// UMFPACK if this program was built with them, Eigen's own else.
#pragma once

#include <memory>
#include <string>

#include <Eigen/SparseCore>

namespace host {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

class LinearSolver {
public:
  /// @param symmetric   the matrices hold their lower triangle only
  /// @param indefinite  takes over where such a matrix is not positive definite; null: LU of all its entries
  static std::unique_ptr<LinearSolver> create(bool symmetric,
                                              std::unique_ptr<LinearSolver> indefinite = nullptr);
  virtual ~LinearSolver() = default;

  /// Ordering and symbolic factorisation; again only when the pattern changes.
  virtual void analyze(const SparseMatrix& matrix) = 0;
  /// Before `analyze`: an ordering that another solver has found, [equations], the first pivot first.
  virtual void take_order(const int* /*order*/, int /*size*/) {}
  /// @return false if the matrix is singular to working precision
  virtual bool factorize(const SparseMatrix& matrix) = 0;
  /// @param right_hand_sides  [equations][any number]
  virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) = 0;
  /// Is the matrix of the factors known not to be positive definite?
  virtual bool indefinite() const { return false; }
  /// "CHOLMOD supernodal Cholesky", for the run's header and result.
  virtual std::string name() const = 0;
};

} // namespace host
