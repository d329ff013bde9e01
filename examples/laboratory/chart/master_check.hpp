// SPDX-License-Identifier: BSD-3-Clause
// What a careful host asks before the first increment: is the enrichment admissible on this master?
#pragma once

#include <string>
#include <vector>

#include "chart/press.hpp"
#include "ents_library.hpp"

namespace host::chart {

/// Worst values over all segments (ents_admissibility), and whether rho_e crosses itself.
struct MasterCheck {
  double fold = 0, edge_height = 0, reach = 0, shadow = 1;
  bool degenerate = false; ///< somewhere rho_e has no normal
  bool crossing = false;   ///< two far parts of rho_e intersect (in the plane)
};

/// Points and normals of rho_e along a row, for the host's own looks at it.
struct MasterPoints {
  std::vector<double> point, normal; ///< [count][d]
};

std::string model_text(const Press& press, double penetration_limit);
MasterPoints sample_master(const EntsModel& model, const Press& press, int per_segment);
MasterCheck check_master(const EntsModel& model, const Press& press, const MasterPoints& points);

/// Nodes of one segment [m][d], and its surface coordinates [m][d-1] or none.
std::vector<double> segment_nodes(const Press& press, std::int64_t segment);
std::vector<double> segment_coordinates(const Press& press, std::int64_t segment);

} // namespace host::chart
