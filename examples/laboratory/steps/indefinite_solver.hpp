// SPDX-License-Identifier: BSD-3-Clause
// L D L^T of symmetric matrices that are not positive definite, with MUMPS: a tenth of the time of LU.
#pragma once

#include "toolbox/solver.hpp"

namespace host {

/// For LinearSolver::create: LU of all entries where L D L^T fails.
/// @return null: this program was built without MUMPS
std::unique_ptr<LinearSolver> indefinite_solver();

} // namespace host
