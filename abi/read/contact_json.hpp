// SPDX-License-Identifier: BSD-3-Clause
// "contact" of a model's text: the normal law, friction, wear, heat.
#pragma once

#include <cstdint>
#include <string>

#include "abi/read/height_json.hpp"
#include "abi/read/json_check.hpp"
#include "core/model/model.hpp"

namespace ents {

// path: of the object, for messages
void read_contact(const nlohmann::json& value, const std::string& path, ModelSpec& model);

// After the height is read: is what gives way to the pressure a part of it?
void check_flattened(const ModelSpec& model);

// heat_json.cpp; after the laws that it depends on
void read_heat(const nlohmann::json& value, const std::string& path, ModelSpec& model);

// A number of the law, or the name of a parameter: bound_to
double read_law_number(const nlohmann::json& object, const std::string& path, const char* key,
                       const ModelSpec& model, std::uint8_t& bound_to, Range range = Range::positive);

} // namespace ents
