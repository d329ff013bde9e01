// SPDX-License-Identifier: BSD-3-Clause
// Eigenvalues of small symmetric matrices, compiled once: of a solver of Eigen's every file that names it takes ten seconds.
#pragma once

#include <Eigen/Core>

namespace host {

struct Spectrum {
  Eigen::VectorXd values;  ///< rising
  Eigen::MatrixXd vectors; ///< columns, of length 1
};

/// @param matrix  symmetric: its lower triangle is read
Spectrum spectrum_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

} // namespace host
