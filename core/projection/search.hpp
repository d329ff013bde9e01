// SPDX-License-Identifier: BSD-3-Clause
// Projection without a start value; compiled apart (search_*.cpp), because elements rarely need it.
#pragma once

#include "core/model/plan.hpp"
#include "core/projection/projection.hpp"
#include "core/projection/target.hpp"

namespace ents::ENTS_ISA {

struct Search {
  Found found;
  bool ambiguous; // a second point is as good within 1e-9 of the segment's size, or could be
};

// normal: the closest of the projections on the segment; shadow: the lit point, the one nearest to the light
// along the ray. `escaped`, or a point outside the segment: none is on it. Only what ranks below `limit`
// matters. `budget`: evaluations of the surface, after which the best that is known is `ambiguous`.
inline constexpr double no_limit = 1e100;
inline constexpr int search_budget = 10000;
template <class B, bool H>
Search search(const Geometry<B>& g, const Target& t, const Plan& plan, Projection<B, H>& p,
              double limit = no_limit, int budget = search_budget);

// What a surface of many segments asks of one (ProjectKernel, BoxKernel, BorderKernel; defined in
// segment_projection.hpp and border.hpp).
template <class B, bool H>
bool project_on_segment(const Plan& plan, const double* slave, const double* master,
                        const double* surface_coordinates, const double* start, double limit, int budget,
                        SegmentProjection& out);
template <class B, bool H>
bool closest_border_point(const Plan& plan, const double* from, const double* master,
                          const double* surface_coordinates, double limit, BorderPoint& out);
template <class B, bool H>
void segment_box(const Plan& plan, const double* master, const double* surface_coordinates, double* low,
                 double* high);
// The half-sizes of a segment with its border over those of the box of its nodes: at most max sum_i |N_i|.
template <class B> double hull_spread(Basis which, double border);

} // namespace ents::ENTS_ISA
