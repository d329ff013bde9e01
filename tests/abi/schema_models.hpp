// SPDX-License-Identifier: BSD-3-Clause
// Models that together use every key and every word of model.schema.json.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace ents::testing {

/// A new key or word needs a place here: ModelSchema.EveryPropertyIsUsed names what is missing.
std::vector<nlohmann::json> schema_models();

} // namespace ents::testing
