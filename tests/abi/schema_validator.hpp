// SPDX-License-Identifier: BSD-3-Clause
// The part of JSON Schema (draft 2020-12) that model.schema.json uses. A keyword it does not know throws,
// so that the schema cannot say something that is not checked.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace ents::testing {

class SchemaValidator {
public:
  explicit SchemaValidator(nlohmann::json schema) : root_(std::move(schema)) {}

  bool accepts(const nlohmann::json& value) const { return accepts(root_, value); }

  // The object schemas that may describe the object at `pointer` of `document`: all branches that lead there.
  std::vector<const nlohmann::json*> object_schemas(const nlohmann::json& document,
                                                    const nlohmann::json::json_pointer& pointer) const {
    std::vector<const nlohmann::json*> found;
    find(root_, document, pointer, found);
    return found;
  }

private:
  using json = nlohmann::json;

  const json& resolved(const json& schema) const {
    if (!schema.contains("$ref")) return schema;
    return resolved(root_.at(json::json_pointer(schema.at("$ref").get<std::string>().substr(1))));
  }

  static bool has_type(const json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "number") return value.is_number();
    if (type == "boolean") return value.is_boolean();
    if (type == "string") return value.is_string();
    if (type == "null") return value.is_null();
    throw std::logic_error("type " + type + " is not known to the test's validator");
  }

  bool accepts(const json& schema, const json& value) const {
    bool good = true;
    for (const auto& [keyword, rule] : schema.items()) {
      if (keyword == "$schema" || keyword == "$defs" || keyword == "title" || keyword == "description")
        continue;
      if (keyword == "$ref")
        good = good && accepts(resolved(schema), value);
      else if (keyword == "type")
        good = good && has_type(value, rule);
      else if (keyword == "const")
        good = good && value == rule;
      else if (keyword == "enum")
        good = good && std::find(rule.begin(), rule.end(), value) != rule.end();
      else if (keyword == "oneOf")
        good = good &&
               std::count_if(rule.begin(), rule.end(), [&](const json& s) { return accepts(s, value); }) == 1;
      else if (keyword == "minimum")
        good = good && (!value.is_number() || value >= rule);
      else if (keyword == "maximum")
        good = good && (!value.is_number() || value <= rule);
      else if (keyword == "exclusiveMaximum")
        good = good && (!value.is_number() || value < rule);
      else if (keyword == "multipleOf")
        good = good && (!value.is_number() || std::fmod(value.get<double>(), rule.get<double>()) == 0.0);
      else if (keyword == "minProperties")
        good = good && (!value.is_object() || value.size() >= rule.get<std::size_t>());
      else if (keyword == "minItems")
        good = good && (!value.is_array() || value.size() >= rule.get<std::size_t>());
      else if (keyword == "maxItems")
        good = good && (!value.is_array() || value.size() <= rule.get<std::size_t>());
      else if (keyword == "items")
        good = good && (!value.is_array() || std::all_of(value.begin(), value.end(),
                                                         [&](const json& v) { return accepts(rule, v); }));
      else if (keyword == "required")
        good = good && (!value.is_object() || std::all_of(rule.begin(), rule.end(), [&](const json& k) {
                 return value.contains(k.get<std::string>());
               }));
      else if (keyword == "properties") {
        for (const auto& [key, property] : rule.items())
          good = good && (!value.is_object() || !value.contains(key) || accepts(property, value.at(key)));
      } else if (keyword == "additionalProperties") {
        if (rule != false && !rule.is_object())
          throw std::logic_error("additionalProperties is false, absent, or a schema");
        if (value.is_object())
          for (const auto& [key, child] : value.items())
            good =
                good && (schema.at("properties").contains(key) || (rule.is_object() && accepts(rule, child)));
      } else {
        throw std::logic_error("keyword " + keyword + " is not known to the test's validator");
      }
    }
    return good;
  }

  void find(const json& schema_or_reference, const json& value, const json::json_pointer& pointer,
            std::vector<const json*>& found) const {
    const json& schema = resolved(schema_or_reference);
    if (schema.contains("oneOf")) {
      for (const json& branch : schema.at("oneOf"))
        if (accepts(branch, value)) find(branch, value, pointer, found);
      return;
    }
    if (pointer.empty()) {
      if (schema.contains("properties")) found.push_back(&schema);
      return;
    }
    std::string token = pointer.to_string().substr(1);
    token = token.substr(0, token.find('/'));
    const json::json_pointer rest(pointer.to_string().substr(1 + token.size()));
    if (value.is_array())
      find(schema.at("items"), value.at(std::stoul(token)), rest, found);
    else
      find(schema.at("properties").at(token), value.at(token), rest, found);
  }

  json root_;
};

} // namespace ents::testing
