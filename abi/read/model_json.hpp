// SPDX-License-Identifier: BSD-3-Clause
// The model reader: JSON text (model.schema.json) to a checked model.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "abi/read/model_error.hpp"
#include "core/search/patch.hpp"

namespace ents {

// Samples a height map may take by name; values [rows][columns], row by row. Copied.
struct NamedData {
  std::string_view name;
  const double* values = nullptr;
  std::int64_t rows = 0;
  std::int64_t columns = 0;
};

// directory: where relative file names of height maps start; empty: the working directory.
// Throws ModelError, and std::bad_alloc when memory runs out.
PatchedModel read_model(std::string_view text, const std::filesystem::path& directory = {},
                        std::span<const NamedData> data = {});

// The same from a file; relative names start at its own folder. path: UTF-8.
PatchedModel read_model_file(std::string_view path);

} // namespace ents
