// SPDX-License-Identifier: BSD-3-Clause
// {"type": "map", ...}: a height map from a file, from the model text or from the caller's memory.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "abi/read/height_json.hpp"
#include "core/height/height_map.hpp"

namespace ents {

// Keys
//   file | values | data   where the samples come from: a text file (surface_file.hpp), numbers in place
//                          (2D: an array; 3D: an array of rows), or the name of an array of ents_data
//   boundary               "periodic" or "clamped", see height_map.hpp
//   size                   lengths covered along s_1 (and s_2); a file that states its size needs none
//   origin                 s of the first sample, default 0
//   scale                  factor on the heights, default 1
//   length_unit            metres in one length unit of the model, default 1; for files that state units
// Row 0 lies at s_2 = origin[1], column 0 at s_1 = origin[0]. In 2D a map is one row (or, from a file, one
// column). A file's own width W is that of n pixels: periodic it is the size; clamped the n samples cover W
// (n-1)/n.
HeightMap read_map(const nlohmann::json& value, const std::string& path, const HeightSources& sources);

// A map without its samples: "points" (their number along each surface coordinate), "boundary", "size",
// "origin".
HeightMap read_grid(const nlohmann::json& value, const std::string& path, std::int32_t dimension);

} // namespace ents
