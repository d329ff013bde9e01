// SPDX-License-Identifier: BSD-3-Clause
// Sampling points inside slave facets, so that texture between slave nodes is seen: their weights over the
// facet's nodes, and the areas that belong to them.
#pragma once

#include <cstdint>

#include "core/model/model.hpp"
#include "core/model/plan.hpp"

namespace ents {

inline constexpr int most_sampling_points = 64; // per direction

// Per facet: lines n, triangles and quadrilaterals n^2 points. Lines and quadrilaterals: Gauss and
// Legendre's, whose areas integrate a polynomial of degree 2 n - 1 in each natural coordinate exactly;
// triangles: the centroids of n^2 equal parts.
inline std::int64_t sampling_points_of(int parameters, int n) {
  return parameters == 1 ? n : std::int64_t{n} * n;
}

// nodes, weights [facets][points][nodes of the facet]; areas [facets][points].
// degenerate_segment: a facet without area at a point; `facet` says which.
Status sample_facets(Basis facet_basis, int n, std::int64_t count, const std::int64_t* connectivity,
                     const double* positions, double thickness, std::int64_t* nodes, double* weights,
                     double* areas, std::int64_t& facet);

} // namespace ents
