// SPDX-License-Identifier: BSD-3-Clause
#include "toolbox/json_reader.hpp"

#include <cmath>
#include <fstream>
#include <set>

namespace host {
namespace {

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// What is larger is no input of this program, and reading on would take the machine's memory: one value takes
// sixteen bytes, an object, a key or a string a hundred.
constexpr std::size_t most_bytes = std::size_t{1} << 30, most_words = 1000000, most_arrays = 10000000;
constexpr std::size_t most_objects = 100000; // the parser looks through an array after every object in it
constexpr int deepest = 100;                 // copying and writing call themselves at every level

/// What the parser meets, value by value: a wrong file shall be refused before it is in memory.
class Watch {
public:
  explicit Watch(const std::string& name) : name_(name) {}

  bool operator()(int depth, Json::parse_event_t event, const Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::object_end || event == Event::array_end) {
      if (event == Event::object_end) keys_.pop_back();
      return true;
    }
    if (depth == 0 && event != Event::object_start)
      fail(std::string("an object is expected, this is ") +
           (event == Event::array_start ? "array" : parsed.type_name()));
    if (depth >= deepest && (event == Event::object_start || event == Event::array_start))
      fail("objects and arrays lie more than " + std::to_string(deepest) + " levels deep in each other");
    if (event == Event::array_start) {
      if (++arrays_ > most_arrays) fail("more than " + std::to_string(most_arrays) + " arrays");
      return true;
    }
    if (event == Event::object_start) {
      if (++objects_ > most_objects) fail("more than " + std::to_string(most_objects) + " objects");
      keys_.emplace_back();
      return true;
    }
    if ((event == Event::key || parsed.is_string()) && ++words_ > most_words)
      fail("more than " + std::to_string(most_words) + " keys and strings");
    // The parser keeps the last of two equal keys without a word; a scene with a key twice is a mistake.
    if (event == Event::key && !keys_.back().insert(parsed.get<std::string>()).second)
      fail("the key \"" + parsed.get<std::string>() + "\" appears twice in one object");
    return true;
  }

private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(name_ + ": " + message); }

  const std::string& name_;
  std::vector<std::set<std::string>> keys_; ///< of the objects that are open
  std::size_t words_ = 0, arrays_ = 0, objects_ = 0;
};

std::string read_text(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw InputError(name + ": this is a folder; name a file in it");
  if (std::filesystem::is_character_file(file, ignored) || std::filesystem::is_block_file(file, ignored))
    throw InputError(name + ": this is a device; name a file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(name + ": cannot be opened for reading (does it exist?)");
  std::string text;
  std::vector<char> part(1 << 20); // a pipe does not say how long it is
  while (stream.read(part.data(), static_cast<std::streamsize>(part.size())), stream.gcount() > 0) {
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > most_bytes)
      throw InputError(name + ": larger than " + std::to_string(most_bytes >> 20) + " MB");
  }
  if (stream.bad()) throw InputError(name + ": cannot be read to its end");
  return text;
}

} // namespace

Json parse_json(std::string_view text, const std::string& name) {
  Watch watch(name);
  try {
    return Json::parse(text.begin(), text.end(), [&](int depth, Json::parse_event_t event, Json& parsed) {
      return watch(depth, event, parsed);
    });
  } catch (const Json::parse_error& error) {
    const std::string_view before = text.substr(0, std::min(error.byte, text.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    std::string what = error.what();
    if (const auto start = what.find("syntax error"); start != std::string::npos) what = what.substr(start);
    throw InputError(name + ":" + std::to_string(line) + ": not valid JSON: " + what);
  } catch (const Json::exception& error) {
    throw InputError(name + ": not valid JSON: " + error.what());
  }
}

Json parse_json_file(const std::filesystem::path& file) { return parse_json(read_text(file), file.string()); }

Json read_variant(const std::filesystem::path& file, const std::string& variant) {
  Json json = parse_json_file(file);
  if (variant.empty()) return json;
  const Json variants = find_json(json, "/variants");
  if (!variants.is_object() || !variants.contains(variant)) {
    std::string names;
    for (const auto& item : variants.items()) names += (names.empty() ? "" : ", ") + item.key();
    throw InputError(file.string() + ": no variant \"" + variant +
                     "\" in /variants; there are: " + (names.empty() ? "none" : names));
  }
  json.merge_patch(variants.at(variant));
  return json;
}

void JsonValue::fail(const std::string& message) const {
  throw InputError(where_ + (where_.ends_with(": ") ? "" : ": ") +
                   message); // the root has no path of its own
}

double JsonValue::number() const {
  if (!json_->is_number()) fail(std::string("a number is expected, this is ") + json_->type_name());
  const double value = json_->get<double>();
  if (!std::isfinite(value)) fail("the number is outside the range of double precision");
  return value;
}

double JsonValue::positive() const {
  const double value = number();
  if (!(value > 0)) fail("a number > 0 is expected");
  return value;
}

int JsonValue::integer(int min, int max) const {
  if (!json_->is_number_integer()) fail(std::string("an integer is expected, this is ") + json_->dump());
  const auto value = json_->get<std::int64_t>();
  if (value < min || value > max)
    fail("an integer from " + std::to_string(min) + " to " + std::to_string(max) + " is expected");
  return static_cast<int>(value);
}

bool JsonValue::boolean() const {
  if (!json_->is_boolean()) fail(std::string("true or false is expected, this is ") + json_->type_name());
  return json_->get<bool>();
}

std::string JsonValue::string() const {
  if (!json_->is_string()) fail(std::string("a string is expected, this is ") + json_->type_name());
  return json_->get<std::string>();
}

std::string JsonValue::word(const std::vector<std::string>& words) const {
  const std::string value = string();
  if (std::find(words.begin(), words.end(), value) == words.end())
    fail("\"" + value + "\" is not one of: " + listed(words));
  return value;
}

std::vector<JsonValue> JsonValue::items() const {
  if (!json_->is_array()) fail(std::string("an array is expected, this is ") + json_->type_name());
  std::vector<JsonValue> values;
  values.reserve(json_->size());
  for (std::size_t i = 0; i < json_->size(); ++i)
    values.emplace_back((*json_)[i], where_ + "/" + std::to_string(i));
  return values;
}

std::vector<double> JsonValue::numbers() const {
  std::vector<double> values;
  for (const JsonValue& item : items()) values.push_back(item.number());
  return values;
}

std::vector<double> JsonValue::numbers(std::size_t size) const {
  std::vector<double> values = numbers();
  if (values.size() != size)
    fail(std::to_string(size) + " numbers are expected, there are " + std::to_string(values.size()));
  return values;
}

JsonObject::JsonObject(const JsonValue& value) : value_(value) {
  if (!value.json().is_object())
    value.fail(std::string("an object is expected, this is ") + value.json().type_name());
}

bool JsonObject::has(const std::string& key) {
  known_.push_back(key);
  return value_.json().contains(key);
}

JsonValue JsonObject::at(const std::string& key) {
  if (!has(key)) fail("the key \"" + key + "\" is missing");
  return {value_.json().at(key), value_.where() + "/" + key};
}

std::vector<std::string> JsonObject::all_keys() {
  std::vector<std::string> keys;
  for (const auto& item : value_.json().items()) keys.push_back(item.key());
  known_ = keys;
  return keys;
}

double JsonObject::positive_or(const std::string& key, double otherwise) {
  return has(key) ? at(key).positive() : otherwise;
}
int JsonObject::integer_or(const std::string& key, int min, int max, int otherwise) {
  return has(key) ? at(key).integer(min, max) : otherwise;
}
bool JsonObject::boolean_or(const std::string& key, bool otherwise) {
  return has(key) ? at(key).boolean() : otherwise;
}
std::string JsonObject::string_or(const std::string& key, const std::string& otherwise) {
  return has(key) ? at(key).string() : otherwise;
}

void JsonObject::finish() const {
  for (const auto& item : value_.json().items()) {
    if (std::find(known_.begin(), known_.end(), item.key()) != known_.end()) continue;
    std::vector<std::string> known = known_;
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    fail("unknown key \"" + item.key() + "\"; known here: " + listed(known));
  }
}

} // namespace host
