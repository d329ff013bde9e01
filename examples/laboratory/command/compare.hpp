// SPDX-License-Identifier: BSD-3-Clause
// One enriched segment against explicit meshes of plain segments on the same scene.
#pragma once

#include <string>
#include <vector>

#include "ents_library.hpp"
#include "run.hpp"

namespace host {

/// One way to solve the scene.
struct CompareRow {
  int divisions = 0; ///< 0: the enriched segment
  Sizes sizes;
  double wall_time = 0;
  double contact_time = 0; ///< part of it: search and contact elements
  double difference = 0; ///< of the surface displacement in the last step, relative to the enriched one (L2)
  double force_difference = 0; ///< relative, of the force (approach given) or the approach (force given)
  std::vector<Quantity> exact; ///< of the last step
};

struct Comparison {
  CompareRow enriched;
  std::vector<CompareRow> explicit_meshes;
  double order = 0;                    ///< fitted: difference ~ divisions^-order; one mesh: NaN
  double constant = 0;                 ///< fitted: difference = constant * divisions^-order
  double error = 0;                    ///< at which the prices are compared
  std::vector<CompareRow> equal_error; ///< the explicit mesh that reaches it, solved; empty if out of reach
  std::vector<CompareRow> missed;      ///< the same, where the fit has promised too much
  std::string unsolved;                ///< the same, where it cannot be solved: which mesh, and why not
};

/// @param equal_error  also solve the explicit mesh that the fit says reaches the scene's /compare/error
Comparison compare(const Scene& scene, const EntsLibrary& library, const std::vector<int>& divisions,
                   bool equal_error, const RunObserver& observer);

} // namespace host
