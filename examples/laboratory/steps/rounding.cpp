// SPDX-License-Identifier: BSD-3-Clause
// Simulation: what rounding leaves of the residual. The sum of a row is known to 2^-53 of the sum of the
// sizes of its entries, |K| |u| + |K_contact| |x| + |loads|: the measure by which LAPACK ends iterative
// refinement (xGERFS). x are the positions whose differences the gaps are.
#include <cmath>

#include "layer_body.hpp"
#include "simulation.hpp"

namespace host {
namespace {

constexpr double unit_roundoff = 0x1p-53;

} // namespace

double Simulation::rounding_of_forces() const {
  double squared = 0;
  const auto d = static_cast<std::size_t>(mesh_.dimension);
  for (std::size_t i = 0; i < d; ++i) {
    double low = INFINITY, high = -low;
    for (std::size_t k = i; k < mesh_.coordinates.size(); k += d) {
      low = std::min(low, mesh_.coordinates[k]);
      high = std::max(high, mesh_.coordinates[k]);
    }
    squared += (high - low) * (high - low);
  }
  constexpr double roundings = 16 * unit_roundoff;
  return roundings * std::sqrt(squared) *
         (layer_ ? layer_->diagonal() : Eigen::VectorXd(system_->matrix().diagonal())).norm();
}

Simulation::Rounding Simulation::rounding_of_residual(const Evaluation& at,
                                                      const Configuration& where) const {
  const auto dofs = static_cast<std::size_t>(dofs_->dofs());
  const auto unknown = [&](std::size_t i) {
    return std::abs(i < dofs ? where.displacement[i] : where.multiplier[i - dofs]);
  };
  Eigen::VectorXd size = Eigen::VectorXd::Zero(equations()), sum = size;
  for (std::size_t i = 0; i < at.residual.size(); ++i)
    if (const int row = equation(i); row >= 0) size[row] = std::max(size[row], unknown(i));
  const SparseMatrix& matrix = system_->matrix();
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      const Eigen::Index row = entry.row();
      sum[row] += std::abs(entry.value()) * size[column];
      if (system_->symmetric() && row != column) sum[column] += std::abs(entry.value()) * size[row];
    }
  const std::vector<double> load = loads(where.load_factor);
  for (std::size_t dof = 0; dof < dofs; ++dof)
    if (const int row = equation(dof); row >= 0) sum[row] += std::abs(load[dof]);
  double force = 0;
  if (contact_) {
    const SparseMatrix& tangent = contact_->tangent().matrix();
    const std::vector<std::size_t>& unknowns = contact_->tangent().unknowns().dofs;
    const std::vector<double> positions = contact_->position_sizes(where);
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      double by_positions = 0, by_unknowns = 0;
      for (SparseMatrix::InnerIterator entry(tangent, static_cast<Eigen::Index>(i)); entry; ++entry) {
        const auto j = static_cast<std::size_t>(entry.row()); // compressed rows
        by_positions += std::abs(entry.value()) * positions[j];
        by_unknowns += std::abs(entry.value()) * unknown(unknowns[j]);
      }
      if (const int row = equation(unknowns[i]); row >= 0) sum[row] += by_positions;
      if (force_controlled())
        force +=
            std::abs(contact_->master().direction[unknowns[i] % static_cast<std::size_t>(mesh_.dimension)]) *
            (by_positions + by_unknowns);
    }
  }
  for (std::size_t i = dofs; i < at.residual.size(); ++i) // as residual_of_equations() has them
    if (const int row = equation(i); row >= 0) sum[row] *= contact_->multiplier_scale(i - dofs);
  return {unit_roundoff * sum.norm(), unit_roundoff * force};
}

} // namespace host
