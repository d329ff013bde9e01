// SPDX-License-Identifier: BSD-3-Clause
#include "spectrum.hpp"

#include <Eigen/Eigenvalues>

namespace host {

Spectrum spectrum_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(matrix)};
  return {solver.eigenvalues(), solver.eigenvectors()};
}

} // namespace host
