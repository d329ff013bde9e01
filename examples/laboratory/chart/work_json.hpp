// SPDX-License-Identifier: BSD-3-Clause
// Work-precision diagrams as data: chart.py draws them.
#pragma once

#include <vector>

#include "chart/work.hpp"

namespace host::chart {

/// Errors for which the page says what to take.
inline const std::vector<double> advised_errors{0.1, 0.03, 0.01, 0.003, 0.001};

/// Runs, fronts, sentences and prices of every work.
Json work_json(const std::vector<Work>& works);

/// What a legend of these works shows: number and name of each family with charted runs, in order.
Json families_json(const std::vector<const Work*>& works);

} // namespace host::chart
