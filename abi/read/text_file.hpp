// SPDX-License-Identifier: BSD-3-Clause
// Whole files as bytes; the only place that opens one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace ents {

// The file's bytes. Throws ModelError ENTS_FILE when it is missing, no regular file, unreadable or larger
// than `largest` bytes.
std::string read_text_file(const std::filesystem::path& path, std::uintmax_t largest);

// UTF-8, whatever the system's own encoding of names. A name with a zero byte is an error (ENTS_FILE).
std::filesystem::path path_from_utf8(std::string_view name);
std::string display_name(const std::filesystem::path& path);

} // namespace ents
