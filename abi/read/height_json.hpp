// SPDX-License-Identifier: BSD-3-Clause
// The key "height" of a model: JSON to a height function.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "abi/read/json_check.hpp"
#include "abi/read/model_json.hpp"
#include "core/height/height_tree.hpp"

namespace ents {

// What a height may refer to.
struct HeightSources {
  std::int32_t dimension;          // surface coordinates of the segment: 1 or 2
  std::filesystem::path directory; // where relative file names start
  std::span<const NamedData> data;
  std::span<const NamedParameter> parameters; // those of the model's key "parameters"
  std::vector<std::string>* fields;           // names of fields so far
};

// A number, or the name of a parameter, whose number it is then; bound_to: 1 + its index, or 0.
double read_bound_double(const nlohmann::json& value, const std::string& path, Range range,
                         std::span<const NamedParameter> parameters, std::uint8_t& bound_to);

// `value`: an object with "type", at `path`.
Height read_height(const nlohmann::json& value, const std::string& path, const HeightSources& sources);

} // namespace ents
