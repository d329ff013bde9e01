// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace host {

/// @throws std::runtime_error naming the file that cannot be written to its end
void write_text(const std::filesystem::path& file, const std::string& text);

} // namespace host
