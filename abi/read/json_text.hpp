// SPDX-License-Identifier: BSD-3-Clause
// JSON text to a tree, strictly: RFC 8259, no key twice in an object, bounded size and nesting, numbers
// within the range of double, one document and nothing after it.
#pragma once

#include <cstddef>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace ents {

inline constexpr std::size_t largest_json_text = std::size_t{64} << 20; // bytes
inline constexpr std::size_t deepest_json = 32; // arrays and objects inside each other
inline constexpr std::size_t most_json_values = std::size_t{1} << 24;

// Takes a tree apart from its leaves. nlohmann::json's own destructor allocates memory for a tree that holds
// arrays or objects; when there is none left, that exception leaves a destructor and ends the process.
struct JsonDeleter {
  void operator()(nlohmann::json* tree) const noexcept;
};
using JsonTree = std::unique_ptr<nlohmann::json, JsonDeleter>;

// Every number of the tree is a double. Throws ModelError: JSON_SYNTAX with the byte offset, UNKNOWN_KEY
// (a key twice) or BAD_VALUE with the JSON path.
JsonTree parse_json(std::string_view text);

} // namespace ents
