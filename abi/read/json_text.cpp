// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/json_text.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "abi/read/json_check.hpp"
#include "abi/read/json_tree.hpp"
#include "abi/read/model_error.hpp"
#include "abi/read/number_text.hpp"

namespace ents {

namespace {

using nlohmann::json;

void dismantle(json& value) noexcept {
  if (!value.is_structured()) return;
  for (json& child : value) dismantle(child);
  value.clear();
}

// Receives the parser's events and builds the tree.
class TreeBuilder {
public:
  JsonTree tree{new json};

  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(json::number_integer_t value) { return add(static_cast<double>(value)); }
  bool number_unsigned(json::number_unsigned_t value) { return add(static_cast<double>(value)); }
  bool number_float(json::number_float_t, const json::string_t& text) {
    // The parser has put the locale's decimal point into `text`.
    std::string number = text;
    for (char& c : number)
      if (std::string_view("+-0123456789eE").find(c) == std::string_view::npos) c = '.';
    double value = 0.0;
    if (read_number(number, value) != NumberText::ok)
      fail(ENTS_BAD_VALUE, path(), printable(number) + " is outside the range of double precision");
    return add(value);
  }
  bool string(json::string_t& value) { return add(std::move(value)); }
  bool binary(json::binary_t&) { return false; } // not in text

  bool start_object(std::size_t) { return open(json::object()); }
  bool key(json::string_t& name) {
    open_.back().key = std::move(name);
    if (open_.back().value->contains(open_.back().key))
      fail(ENTS_UNKNOWN_KEY, path(), "the key stands twice in its object; leave one");
    return true;
  }
  bool end_object() { return close(); }
  bool start_array(std::size_t) { return open(json::array()); }
  bool end_array() { return close(); }

  bool parse_error(std::size_t position, const std::string& last_token, const json::exception& error) {
    if (error.id == 406) // the parser's own verdict on a number, in the C locale only
      fail(ENTS_BAD_VALUE, path(), printable(last_token) + " is outside the range of double precision");
    // "[json.exception...] parse error at line 1, column 2: syntax error ...; last read: '...'; expected ..."
    std::string_view what = error.what();
    if (const auto start = what.find("parse error at "); start != what.npos) what.remove_prefix(start + 15);
    std::string_view where = what.substr(0, what.find(": "));
    std::string_view reason = what.substr(std::min(what.size(), where.size() + 2));
    std::string_view read, rest;
    if (const auto start = reason.find("; last read: '"); start != reason.npos) {
      read = reason.substr(start + 14);
      const auto end = read.rfind('\'');
      rest = end == read.npos ? std::string_view() : read.substr(end + 1);
      read = read.substr(0, end);
      reason = reason.substr(0, start);
    }
    std::string message = "the model text is not JSON at byte offset " +
                          std::to_string(position == 0 ? 0 : position - 1) + " (" + printable(where) +
                          "): " + printable(reason, 120);
    if (!read.empty()) message += "; last read: " + in_quotes(read);
    message += printable(rest, 60);
    if (!last_token.empty() && (last_token.back() == 'N' || last_token.back() == 'I'))
      message += "; numbers are finite, NaN and Infinity are not JSON";
    throw ModelError(ENTS_JSON_SYNTAX, message);
  }

private:
  struct Open {
    json* value;
    std::string key; // of the member being read
  };

  bool add(json value) {
    place(std::move(value));
    return true;
  }

  bool open(json value) {
    if (open_.size() == deepest_json)
      fail(ENTS_BAD_VALUE, path(),
           "arrays and objects lie deeper than " + std::to_string(deepest_json) + " inside each other");
    // The parent does not grow while its child is open, so that the pointer stays good.
    open_.push_back({place(std::move(value)), {}});
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  json* place(json value) {
    if (++count_ > most_json_values)
      fail(ENTS_BAD_VALUE, path(),
           "more than " + std::to_string(most_json_values) +
               " values in the text; give large height maps as a file or through ents_data");
    if (open_.empty()) {
      *tree = std::move(value);
      return tree.get();
    }
    json& parent = *open_.back().value;
    if (parent.is_object()) return &(parent[open_.back().key] = std::move(value));
    parent.push_back(std::move(value));
    return &parent.back();
  }

  // Of the value being read.
  std::string path() const {
    std::string result;
    for (const Open& level : open_) {
      // An entry that is itself open already stands in its array.
      const std::size_t begun = &level == &open_.back() ? 0 : 1;
      result =
          level.value->is_object() ? member(result, level.key) : item(result, level.value->size() - begun);
    }
    return result;
  }

  std::vector<Open> open_;
  std::size_t count_ = 0;
};

} // namespace

void JsonDeleter::operator()(json* tree) const noexcept {
  dismantle(*tree);
  delete tree;
}

JsonTree parse_json(std::string_view text) {
  if (text.size() > largest_json_text)
    throw ModelError(ENTS_BAD_VALUE, "the model text has " + std::to_string(text.size()) +
                                         " bytes; at most " + std::to_string(largest_json_text) +
                                         " are read. Give large height maps as a file or through ents_data");
  // The parser would take a zero byte for the end of the text.
  if (const std::size_t zero = text.find('\0'); zero != text.npos)
    throw ModelError(ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset " + std::to_string(zero) +
                                           ": zero byte; give the length of the text without it");
  TreeBuilder builder;
  json::sax_parse(text.begin(), text.end(), &builder);
  return std::move(builder.tree);
}

} // namespace ents
