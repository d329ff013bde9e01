// SPDX-License-Identifier: BSD-3-Clause
// Checked access to a JSON tree. Every function throws a ModelError that starts with the JSON path
// (RFC 6901, like /height/of/1/width) and says what to write instead.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ents {

[[noreturn]] void fail(std::int32_t status, const std::string& path, const std::string& message);

// Path of a member of the object at `path`, of an entry of the array at `path`.
std::string member(const std::string& path, std::string_view key);
std::string item(const std::string& path, std::size_t index);

// The number as JSON writes it, whatever the locale
std::string shown(double value);

// "\"a\", \"b\" or \"c\""
std::string alternatives(const std::vector<std::string_view>& names);

// "; did you mean \"width\"?" if one of the names is close to `word`, else empty.
std::string suggestion(std::string_view word, const std::vector<std::string_view>& names);

// `value` is an object with all `required` keys, perhaps `optional` ones and no others.
void check_keys(const nlohmann::json& value, const std::string& path, std::vector<std::string_view> required,
                std::vector<std::string_view> optional);

// Magnitudes are limited so that squares and products of two stay within double precision.
enum class Range {
  any,          // |x| <= 1e100
  not_negative, // 0 <= x <= 1e100
  positive      // 1e-100 <= x <= 1e100
};
constexpr double least_of(Range range) {
  return range == Range::positive ? 1e-100 : range == Range::not_negative ? 0.0 : -1e100;
}

double read_double(const nlohmann::json& value, const std::string& path, Range range);
double read_double(const nlohmann::json& object, const std::string& path, const char* key, Range range);
double read_double_or(const nlohmann::json& object, const std::string& path, const char* key, Range range,
                      double otherwise);

// Exactly `size` numbers; `meaning` says what they are ("one per surface coordinate").
constexpr std::string_view per_coordinate = "one per surface coordinate of the segment";
std::vector<double> read_vector(const nlohmann::json& value, const std::string& path, std::size_t size,
                                Range range, std::string_view meaning);

// At least one, at most `most` entries.
void check_array(const nlohmann::json& value, const std::string& path, std::size_t most,
                 std::string_view of_what);

bool read_bool(const nlohmann::json& value, const std::string& path);

const std::string& read_text(const nlohmann::json& value, const std::string& path);

// Index of the text among `names`.
std::size_t read_choice(const nlohmann::json& value, const std::string& path,
                        const std::vector<std::string_view>& names);

// The member "type" of an object, as index among `names`; checked before the other keys because it decides
// them.
std::size_t read_type(const nlohmann::json& value, const std::string& path,
                      const std::vector<std::string_view>& names);

} // namespace ents
