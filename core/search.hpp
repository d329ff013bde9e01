// SPDX-License-Identifier: BSD-3-Clause
// Projection without a start value; compiled apart (search_*.cpp), because elements rarely need it.
#pragma once

#include "core/plan.hpp"
#include "core/projection.hpp"

namespace ents::ENTS_ISA {

struct Search {
  Found found;
  bool ambiguous;  // a second point is as good within 1e-9 of the segment's size, or could be
};

// normal: the closest of the projections on the segment; shadow: the lit point, the one nearest to the light along the
// ray. `escaped`, or a point outside the segment: none is on it.
template <class B, bool H> Search search(const Geometry<B>& g, const Target& t, const Plan& plan, Projection<B, H>& p);

}  // namespace ents::ENTS_ISA
