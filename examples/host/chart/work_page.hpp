// SPDX-License-Identifier: BSD-3-Clause
// The chapter of the work-precision diagrams: HTML and JSON.
#pragma once

#include <string>
#include <vector>

#include "chart/work.hpp"

namespace host::chart {

/// Errors for which the page says what to take.
inline const std::vector<double> advised_errors{0.1, 0.03, 0.01, 0.003, 0.001};

std::string work_section(const std::vector<Work>& works);

Json work_json(const std::vector<Work>& works);

} // namespace host::chart
