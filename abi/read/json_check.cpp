// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/json_check.hpp"

#include <algorithm>

#include "abi/read/json_tree.hpp"
#include "abi/read/model_error.hpp"

namespace ents {

namespace {

using nlohmann::json;

std::string kind_of(const json& value) {
  switch (value.type()) {
  case json::value_t::null:
    return "null";
  case json::value_t::boolean:
    return "true or false";
  case json::value_t::string:
    return "the text " + in_quotes(value.get_ref<const std::string&>(), 40);
  case json::value_t::array:
    return "an array";
  case json::value_t::object:
    return "an object";
  default:
    return "a number";
  }
}

// Levenshtein distance: single-letter edits that turn one word into the other.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row.back();
}

std::string list(const std::vector<std::string_view>& names, std::string_view last_join) {
  std::string result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) result += i + 1 == names.size() ? last_join : ", ";
    result += in_quotes(names[i]);
  }
  return result;
}

bool within(const json& value, Range range) {
  if (!value.is_number()) return false;
  const double number = value.get<double>();
  return number >= least_of(range) && number <= 1e100;
}

} // namespace

void fail(std::int32_t status, const std::string& path, const std::string& message) {
  throw ModelError(status, (path.empty() ? "model" : path) + ": " + message);
}

std::string shown(double value) { return json(value).dump(); }

std::string member(const std::string& path, std::string_view key) {
  std::string escaped;
  for (const char c : printable(key, 40)) {
    if (c == '~')
      escaped += "~0";
    else if (c == '/')
      escaped += "~1";
    else
      escaped += c;
  }
  return path + '/' + escaped;
}

std::string item(const std::string& path, std::size_t index) { return path + '/' + std::to_string(index); }

std::string alternatives(const std::vector<std::string_view>& names) { return list(names, " or "); }

std::string suggestion(std::string_view word, const std::vector<std::string_view>& names) {
  std::string_view nearest;
  std::size_t least = 4;
  if (word.size() > 60) return {};
  for (const std::string_view name : names) {
    const std::size_t distance = edits(word, name);
    // more than half of the letters changed is another word
    if (distance < least && 2 * distance <= name.size()) {
      least = distance;
      nearest = name;
    }
  }
  return nearest.empty() ? std::string() : "; did you mean " + in_quotes(nearest) + "?";
}

void check_keys(const json& value, const std::string& path, std::vector<std::string_view> required,
                std::vector<std::string_view> optional) {
  std::vector<std::string_view> allowed = required;
  allowed.insert(allowed.end(), optional.begin(), optional.end());
  if (!value.is_object())
    fail(ENTS_BAD_VALUE, path,
         "is " + kind_of(value) + "; write an object with the keys " + list(allowed, ", "));
  for (const auto& [key, unused] : value.items())
    if (std::find(allowed.begin(), allowed.end(), key) == allowed.end()) {
      const std::string hint = suggestion(key, allowed);
      fail(ENTS_UNKNOWN_KEY, member(path, key),
           "unknown key" + hint + (hint.empty() ? "; allowed here: " : " Allowed here: ") +
               list(allowed, ", "));
    }
  for (const std::string_view key : required)
    if (!value.contains(key))
      fail(
          ENTS_UNKNOWN_KEY, path,
          "the key " + in_quotes(key) + " is missing" + (optional.empty() ? "; " : "; required: ") +
              (optional.empty() ? "all of " + list(required, ", ") + " are required" : list(required, ", ")));
}

double read_double(const json& value, const std::string& path, Range range) {
  if (within(value, range)) return value.get<double>();
  fail(ENTS_BAD_VALUE, path,
       "is " + (value.is_number() ? shown(value.get<double>()) : kind_of(value)) + "; write a number from " +
           (range == Range::positive       ? "1e-100"
            : range == Range::not_negative ? "0"
                                           : "-1e100") +
           " to 1e100");
}

double read_double(const json& object, const std::string& path, const char* key, Range range) {
  return read_double(object.at(key), member(path, key), range);
}

double read_double_or(const json& object, const std::string& path, const char* key, Range range,
                      double otherwise) {
  return object.contains(key) ? read_double(object, path, key, range) : otherwise;
}

std::vector<double> read_vector(const json& value, const std::string& path, std::size_t size, Range range,
                                std::string_view meaning) {
  const std::string write = "; write an array of " + std::to_string(size) +
                            (size == 1 ? " number, " : " numbers, ") + std::string(meaning);
  if (!value.is_array()) fail(ENTS_BAD_VALUE, path, "is " + kind_of(value) + write);
  if (value.size() != size)
    fail(ENTS_BAD_VALUE, path,
         "has " + std::to_string(value.size()) + (value.size() == 1 ? " entry" : " entries") + write);
  std::vector<double> result;
  for (std::size_t i = 0; i < size; ++i)
    result.push_back(within(value[i], range) ? value[i].get<double>()
                                             : read_double(value[i], item(path, i), range)); // throws
  return result;
}

void check_array(const json& value, const std::string& path, std::size_t most, std::string_view of_what) {
  if (!value.is_array())
    fail(ENTS_BAD_VALUE, path, "is " + kind_of(value) + "; write an array of " + std::string(of_what));
  if (value.empty() || value.size() > most)
    fail(ENTS_BAD_VALUE, path,
         "has " + std::to_string(value.size()) + " entries; write an array of 1 to " + std::to_string(most) +
             " " + std::string(of_what));
}

bool read_bool(const json& value, const std::string& path) {
  if (!value.is_boolean()) fail(ENTS_BAD_VALUE, path, "is " + kind_of(value) + "; write true or false");
  return value.get<bool>();
}

const std::string& read_text(const json& value, const std::string& path) {
  if (!value.is_string()) fail(ENTS_BAD_VALUE, path, "is " + kind_of(value) + "; write a text");
  return value.get_ref<const std::string&>();
}

std::size_t read_choice(const json& value, const std::string& path,
                        const std::vector<std::string_view>& names) {
  if (!value.is_string())
    fail(ENTS_BAD_VALUE, path, "is " + kind_of(value) + "; write " + alternatives(names));
  const std::string& text = value.get_ref<const std::string&>();
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) {
    const std::string hint = suggestion(text, names);
    fail(ENTS_BAD_VALUE, path,
         "is " + in_quotes(text, 40) + hint + (hint.empty() ? "; write " : " Write ") + alternatives(names));
  }
  return static_cast<std::size_t>(found - names.begin());
}

std::size_t read_type(const json& value, const std::string& path,
                      const std::vector<std::string_view>& names) {
  if (!value.is_object())
    fail(ENTS_BAD_VALUE, path,
         "is " + kind_of(value) + "; write an object with \"type\": " + alternatives(names));
  if (!value.contains("type"))
    fail(ENTS_UNKNOWN_KEY, path, "the key \"type\" is missing; write \"type\": " + alternatives(names));
  return read_choice(value.at("type"), member(path, "type"), names);
}

} // namespace ents
