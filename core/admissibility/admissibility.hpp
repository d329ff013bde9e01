// SPDX-License-Identifier: BSD-3-Clause
// Is an enrichment admissible on a segment? Conditions of section 3 and Fig. 4 of the paper
// (theory.md, section 10), measured on a regular grid of natural coordinates.
#pragma once

#include "core/model/plan.hpp"

namespace ents {

// The worst value of a quantity and where it was found.
struct Worst {
  double value;
  double xi[2];
};

struct Admissibility {
  int samples;       // per direction
  int continuity;    // h is C^continuity; Height::smooth: all derivatives
  Worst fold;        // max |h| |kappa| of rho; >= 1: rho_e folds over itself
  Worst edge_height; // max |h| on the segment's edges
  Worst reach;       // min 1 / |kappa_e|; infinite for a flat rho_e
  Worst shadow;      // min n_e . e; 1 for normal projection
  double height_min, height_max;
};

inline constexpr int most_samples = 4096;

// n_e . e of the ray through a point of the surface; 1 for normal projection.
double cosine_of_ray(const Plan& plan, const double* point, const double* normal);

// samples: 2 .. most_samples per direction, or 0 for as many as the height's features ask for (at most 1025).
Status check_admissibility(const ModelSpec& model, const Plan& plan, const double* master,
                           const double* surface_coordinates, int samples, Admissibility& result);

} // namespace ents
