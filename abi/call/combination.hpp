// SPDX-License-Identifier: BSD-3-Clause
// The caller's points that are linear combinations of nodes, and facets: their arguments are checked here.
#pragma once

#include "abi/call/handle.hpp"
#include "core/slave/raised_point.hpp"

namespace ents {

// Counts and pointers of `caller`; its entries are checked as they are read.
std::int32_t check_combination(const ents_combination* caller, const char* name, ents_combination& out,
                               ents_report* report) noexcept;
std::int32_t check_combined_point(const ents_combination& c, const char* name, std::int64_t point,
                                  std::int64_t nodes, ents_report* report) noexcept;

// The place of a point that has a height, shifts not added, and its derivatives by its nodes, whose indices are checked.
std::int32_t raise_point(const ents_combination& c, const char* name, std::int64_t point, int dimension,
                         const double* positions, RaisedPoint& raised, ents_report* report) noexcept;

// A point in its facet: its surface coordinates, with null `coordinates` [begin[points]][d-1] natural ones; the place
// without its height; the facet's area (2D: length) of a unit of s.
struct FacetPlace {
  double s[2], point[3], area_per_s;
};
// slopes [nodes of the facet][d-1] are of its weights. The point's entries are checked.
std::int32_t slopes_on_facet(const ents_combination& c, const char* name, std::int64_t point, int dimension,
                             const double* coordinates, double* slopes, double (&s)[2],
                             ents_report* report) noexcept;
std::int32_t place_on_facet(const ents_combination& c, const char* name, std::int64_t point, int dimension,
                            const double* coordinates, const double* positions, FacetPlace& place,
                            ents_report* report) noexcept;

// Says why a facet has no area: DEGENERATE_SEGMENT.
std::int32_t refuse_facet(const BasisEntry& entry, std::int64_t facet, const std::int64_t* connectivity,
                          const double* positions, double thickness, ents_report* report) noexcept;

} // namespace ents
