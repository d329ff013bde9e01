// SPDX-License-Identifier: BSD-3-Clause
// Is an enrichment admissible on a whole surface? The conditions of section 3 and Fig. 4 of the paper
// (theory.md, section 10), each with its worst place. Measured on grids of natural coordinates; the worst
// place of a smooth quantity is then sought between the samples.
#pragma once

#include <vector>

#include "core/search/detection.hpp"

namespace ents {

namespace condition {
enum : int {
  continuity, // derivatives of h: 2
  fold,       // largest |h| |kappa| of rho: < 1
  edge,       // largest |h| on the edges: 0 for a local enrichment
  jump,       // largest distance of the two rho_e on a shared edge: 0
  kink,       // largest angle between the two n_e on a shared edge
  wedge,      // smallest angle that is free between two segments at their shared edge: > 0
  projection, // smallest |gap| at which a slave has two normal projections
  shadow,     // smallest n_e . e: > 0
  occlusion,  // largest distance along the ray between a point of the surface and another in its light: 0
  crossing,   // largest depth of one segment behind another that it intersects: 0
  count
};
}

struct Finding {
  double value = 0.0, bound = 0.0;
  bool judged = false, violated = false;
  std::int64_t segment = -1, other = -1; // -1: there is none
  double xi[2] = {}, other_xi[2] = {};
};

struct SurfaceLimits {
  int samples;  // per direction and segment; 0: as fine as the height asks for
  double reach; // [L] up to which a slave shall have one normal projection; 0: the model's penetration limit,
                // if it has one
  double kink;  // [rad] tolerated between neighbours; 0: not judged
};

struct SurfaceAdmissibility {
  int samples = 0; // the most that were taken on a segment, per direction
  Finding findings[condition::count];
  double height_min, height_max;
  std::vector<std::int64_t> violations; // [segments] 1 << condition
};

// Allocates: see ents_surface_check. Errors as `gather` and of a plain segment that is degenerate, at
// `segment`.
Status check_surface(const ModelSpec& model, const Plan& plan, const MasterMesh& mesh,
                     const SurfaceLimits& limits, SurfaceAdmissibility& result, std::int64_t& segment);

} // namespace ents
