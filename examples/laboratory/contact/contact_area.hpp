// SPDX-License-Identifier: BSD-3-Clause
// Area in contact between the slave nodes of a step, by the library's ents_contact_area.
#pragma once

#include <limits>

namespace host {

struct ContactFields;
class Simulation;

/// Shares of the slave surface, and the peak of the pressure. NaN: not known, because the slave has sampling
/// points instead of nodes, or quadratic faces.
struct AreaEstimate {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double fraction = unknown; ///< in contact
  double error = unknown;    ///< bound of its error; NaN, too, where the mesh is too coarse for the surface
  double border_corrected = unknown; ///< closed nodes, corrected by the length of the border of contact
  double zero_line = unknown;        ///< within the places on the edges where pressure and gap end
  double peak_drop = unknown; ///< peak pressure minus the mean pressure of the neighbouring nodes [F/L^2]
};

AreaEstimate estimate_area(const Simulation& simulation, const ContactFields& fields);

} // namespace host
