// SPDX-License-Identifier: BSD-3-Clause
// Results of places at which several contact elements stand.
#pragma once

#include <vector>

#include "run.hpp"
#include "slave_points.hpp"

namespace host {

/// Where several points stand at one place, their fields become one: pressures and tractions are means over
/// the areas, forces sums, all others are those of the first.
/// @return the first point of each place
/// @param[in,out] record  its fields and areas
std::vector<std::size_t> merge_places(const SlavePoints& points, StepRecord& record);

} // namespace host
