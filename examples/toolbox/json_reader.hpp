// SPDX-License-Identifier: BSD-3-Clause
// Strict reading of JSON: every key that is not asked for is an error, and every error names the file and
// the JSON path.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "toolbox/error.hpp"

namespace host {

using Json = nlohmann::ordered_json;

/// Parse a file whose outermost value is an object.
/// @throws InputError naming it: a syntax error, a duplicate key, a device, or more than any input of this
///         program takes (the limits stand in json_reader.cpp)
Json parse_json_file(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
Json parse_json(std::string_view text, const std::string& name);

/// The file's text, changed by one of its variants (RFC 7386); empty: as it is.
/// @throws InputError naming the file and the variants that there are
Json read_variant(const std::filesystem::path& file, const std::string& variant);

/// What stands at a JSON pointer such as "/contact/wear"; null where nothing does. For values that another
/// reader checks, and may not have checked yet.
inline Json find_json(const Json& value, const char* pointer) {
  const Json::json_pointer place(pointer);
  return value.contains(place) ? value.at(place) : Json();
}

/// JSON has no NaN.
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// One JSON value together with where it was found.
class JsonValue {
public:
  JsonValue(const Json& json, std::string where) : json_(&json), where_(std::move(where)) {}

  const Json& json() const { return *json_; }
  const std::string& where() const { return where_; }
  [[noreturn]] void fail(const std::string& message) const;

  double number() const;
  double positive() const;
  int integer(int min, int max) const;
  bool boolean() const;
  std::string string() const;
  /// One of the given words.
  std::string word(const std::vector<std::string>& words) const;
  /// What stands beside the word that is given.
  template <class T> T choice(std::initializer_list<std::pair<const char*, T>> of) const {
    std::vector<std::string> words;
    for (const auto& [name, value] : of) words.emplace_back(name);
    const std::string chosen = word(words);
    return std::find_if(of.begin(), of.end(), [&](const auto& one) { return one.first == chosen; })->second;
  }
  std::vector<double> numbers() const;
  /// Exactly `size` numbers.
  std::vector<double> numbers(std::size_t size) const;
  /// Elements of an array.
  std::vector<JsonValue> items() const;
  bool is_object() const { return json_->is_object(); }
  bool is_array() const { return json_->is_array(); }
  bool is_number() const { return json_->is_number(); }
  bool is_string() const { return json_->is_string(); }

private:
  const Json* json_;
  std::string where_;
};

/// An object whose keys are taken one by one; `finish` complains about those nobody took.
class JsonObject {
public:
  explicit JsonObject(const JsonValue& value);

  bool has(const std::string& key);
  /// @throws InputError if the key is missing
  JsonValue at(const std::string& key);
  /// Keys in the order of the file; taken by this call.
  std::vector<std::string> all_keys();
  const std::string& where() const { return value_.where(); }
  [[noreturn]] void fail(const std::string& message) const { value_.fail(message); }

  double positive_or(const std::string& key, double otherwise);
  int integer_or(const std::string& key, int min, int max, int otherwise);
  bool boolean_or(const std::string& key, bool otherwise);
  std::string string_or(const std::string& key, const std::string& otherwise);

  /// @throws InputError naming the first key that was never asked for and those that could have been
  void finish() const;

private:
  JsonValue value_;
  std::vector<std::string> known_;
};

} // namespace host
