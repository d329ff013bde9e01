// SPDX-License-Identifier: BSD-3-Clause
// Tributary areas: what part of a slave surface belongs to each of its nodes, so that a stiffness is per area
// and results depend neither on the slave mesh nor on the units (Zavarise and De Lorenzis, IJNME 79, 2009).
#pragma once

#include <cstdint>

#include "core/model/model.hpp"
#include "core/model/plan.hpp"

namespace ents {

// Adds to areas[nodes] what `count` facets bring. A facet of an axisymmetric body (thickness 0) is its full
// turn about the second axis. Linear facets: integral of N_i; quadratic ones: the area in proportion to the
// integral of N_i^2 (Hinton, Rock and Zienkiewicz 1976), because their integral of N_i is 0 or negative at
// corners. degenerate_segment: a facet without area; `facet` says which.
Status add_tributary_areas(Basis facet_basis, std::int64_t count, const std::int64_t* connectivity,
                           const double* positions, double thickness, double* areas, std::int64_t& facet);

} // namespace ents
