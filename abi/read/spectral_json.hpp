// SPDX-License-Identifier: BSD-3-Clause
// Heights that are made of built-in ones: random roughness (a map), sums of waves, and a window that lets a
// height vanish at edges.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "abi/read/height_json.hpp"

namespace ents {

Height read_roughness(const nlohmann::json& value, const std::string& path, const HeightSources& sources);
Height read_fourier(const nlohmann::json& value, const std::string& path, const HeightSources& sources);
Height read_weierstrass(const nlohmann::json& value, const std::string& path, const HeightSources& sources);
// of: the height that the window multiplies; keys are checked already
Height read_window(const nlohmann::json& value, const std::string& path, const HeightSources& sources,
                   Height of);

} // namespace ents
