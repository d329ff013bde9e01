// SPDX-License-Identifier: BSD-3-Clause
// Contact area between the nodes of a slave mesh: where pressure and gap say that the border of contact
// crosses the edges of the facets, and the count of nodes corrected by the length of its border.
#pragma once

#include <cstdint>
#include <vector>

#include "core/surface/bases.hpp"

namespace ents {

// thickness: of lines [L], 0: axisymmetric; modulus: E / (1 - nu^2) of the bodies [F/L^2], 0: not known
struct SlaveFields {
  const BasisEntry* facet;
  std::int64_t facets, nodes;
  const std::int64_t* connectivity;
  const double *positions, *gap, *pressure;
  double thickness, modulus;
};

struct ContactArea { // [L^2]
  double surface = 0.0, counted = 0.0, border_corrected = 0.0, zero_line = 0.0;
  double estimate = 0.0, error = 0.0;
  double peak_pressure = 0.0, peak_drop = 0.0; // [F/L^2]
};
// facet: line2, tri3 or quad4; share: the tributary areas of the nodes
ContactArea estimate_contact_area(const SlaveFields& f, const std::vector<double>& share);

} // namespace ents
