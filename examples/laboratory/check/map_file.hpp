// SPDX-License-Identifier: BSD-3-Clause
// How large a measured map is: what its model and its file say together.
#pragma once

#include <filesystem>
#include <vector>

#include "toolbox/json_reader.hpp"

namespace host {

/// Along each surface coordinate; empty: neither the file nor the model says it.
struct MapSize {
  std::vector<double> lengths; ///< covered, in units of s
  std::vector<double> samples;
};

/// @param map     a height of type "map"; the library has read it before and found nothing wrong
/// @param folder  where its file names start
MapSize map_size(const Json& map, const std::filesystem::path& folder, std::size_t directions);

} // namespace host
