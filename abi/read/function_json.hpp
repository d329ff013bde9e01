// SPDX-License-Identifier: BSD-3-Clause
// Heights that are functions: of the host ("callback"), or written down ("expression").
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "abi/read/height_json.hpp"

namespace ents {

Height read_callback(const nlohmann::json& value, const std::string& path, const HeightSources& sources);
Height read_expression(const nlohmann::json& value, const std::string& path, const HeightSources& sources);

} // namespace ents
