// SPDX-License-Identifier: BSD-3-Clause
// Direct solvers: Cholesky for a symmetric tangent, LU otherwise. SuiteSparse's supernodal CHOLMOD and
// UMFPACK if this program was built with them, Eigen's own else.
#pragma once

#include <memory>
#include <string>

#include <Eigen/Core>

#include "sparse_system.hpp"

namespace host {

class LinearSolver {
public:
  /// @param symmetric  the matrices hold their lower triangle only
  static std::unique_ptr<LinearSolver> create(bool symmetric);
  virtual ~LinearSolver() = default;

  /// Ordering and symbolic factorisation; again only when the pattern changes.
  virtual void analyze(const SparseSystem::Matrix& matrix) = 0;
  /// @return false if the matrix is singular to working precision
  virtual bool factorize(const SparseSystem::Matrix& matrix) = 0;
  /// @param right_hand_sides  [equations][any number]
  virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) = 0;
  /// "CHOLMOD supernodal Cholesky", for the run's header and result.
  virtual std::string name() const = 0;
};

} // namespace host
