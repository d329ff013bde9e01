// SPDX-License-Identifier: BSD-3-Clause
// The key "height" of a model: JSON to a height function.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "abi/model_json.hpp"
#include "core/height_tree.hpp"

namespace ents {

// What a height may refer to.
struct HeightSources {
  std::int32_t dimension;          // surface coordinates of the segment: 1 or 2
  std::filesystem::path directory; // where relative file names start
  std::span<const NamedData> data;
};

// `value`: an object with "type", at `path`.
Height read_height(const nlohmann::json& value, const std::string& path, const HeightSources& sources);

} // namespace ents
