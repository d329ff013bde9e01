// SPDX-License-Identifier: BSD-3-Clause
// One stability map as a picture: surfaces from top to bottom, projections and tangents from left to right.
#pragma once

#include <filesystem>

#include "chart/map.hpp"
#include "output/pictures.hpp"

namespace host::chart {

pictures::Outcome draw(const Map& map, const std::filesystem::path& directory);

} // namespace host::chart
