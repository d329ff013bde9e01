// SPDX-License-Identifier: BSD-3-Clause
// What reading a text ends with.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "abi/read/model_json.hpp"

namespace ents::testing {

struct Verdict {
  std::int32_t status = ENTS_OK;
  std::string message;
};

inline Verdict verdict(std::string_view text, const std::filesystem::path& directory = {},
                       std::span<const NamedData> data = {}) {
  try {
    read_model(text, directory, data);
  } catch (const ModelError& error) {
    return {error.status, error.message};
  }
  return {};
}

} // namespace ents::testing
