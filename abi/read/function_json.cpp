// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/function_json.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "abi/read/expression_text.hpp"
#include "abi/read/height_registry.hpp"
#include "abi/read/json_check.hpp"
#include "abi/read/json_tree.hpp"
#include "abi/read/model_error.hpp"

namespace ents {

namespace {

using nlohmann::json;

constexpr std::size_t most_constants = 256;

// "feature_length": a length for each surface coordinate
void read_feature_length(const json& value, const std::string& path, const HeightSources& sources,
                         double (&lengths)[2]) {
  if (!value.contains("feature_length")) return;
  const std::vector<double> read = read_vector(value.at("feature_length"), member(path, "feature_length"),
                                               static_cast<std::size_t>(sources.dimension), Range::positive,
                                               "one per surface coordinate of the segment");
  std::copy(read.begin(), read.end(), lengths);
}

// Names of the model's parameters that an expression uses
void read_parameter_names(const json& value, const std::string& path, const HeightSources& sources,
                          ExpressionNames& names, std::vector<std::uint8_t>& bound_to) {
  check_array(value, path, std::extent_v<decltype(HeightNode::bound_to)>, "names of parameters");
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string at = item(path, i), name = read_text(value[i], at);
    std::string reason;
    if (!is_expression_name(name, reason)) fail(ENTS_BAD_VALUE, at, reason);
    for (const NamedNumber& other : names.parameters)
      if (other.name == name) fail(ENTS_BAD_VALUE, path, "has " + in_quotes(name) + " twice");
    const double number =
        read_bound_double(value[i], at, Range::any, sources.parameters, bound_to.emplace_back());
    names.parameters.push_back({name, number});
  }
}

} // namespace

Height read_callback(const json& value, const std::string& path, const HeightSources& sources) {
  check_keys(value, path, {"type", "name"}, {"bound", "slope", "curvature", "feature_length"});
  const std::string& name = read_text(value.at("name"), member(path, "name"));
  RegisteredHeight registered;
  std::vector<std::string> known;
  if (!find_registered_height(name, sources.dimension, registered, known)) {
    const std::vector<std::string_view> names(known.begin(), known.end());
    fail(ENTS_BAD_VALUE, member(path, "name"),
         "no height function called " + in_quotes(name) + " of " + std::to_string(sources.dimension) +
             " surface coordinate" + (sources.dimension == 1 ? "" : "s") + " is registered" +
             suggestion(name, names) + "; call ents_height_register before the model is made");
  }
  CallbackBounds bounds;
  bounds.height = read_double_or(value, path, "bound", Range::positive, bounds.height);
  bounds.slope = read_double_or(value, path, "slope", Range::positive, bounds.slope);
  bounds.curvature = read_double_or(value, path, "curvature", Range::positive, bounds.curvature);
  read_feature_length(value, path, sources, bounds.feature_length);
  return callback_height(registered, bounds);
}

Height read_expression(const json& value, const std::string& path, const HeightSources& sources) {
  check_keys(value, path, {"type", "h"}, {"constants", "parameters", "feature_length"});
  ExpressionNames names{sources.dimension, {}, {}};
  std::vector<std::uint8_t> bound_to;
  if (value.contains("parameters"))
    read_parameter_names(value.at("parameters"), member(path, "parameters"), sources, names, bound_to);
  if (value.contains("constants")) {
    const json& constants = value.at("constants");
    const std::string at = member(path, "constants");
    if (!constants.is_object()) fail(ENTS_BAD_VALUE, at, "write an object of names and numbers");
    if (constants.size() > most_constants)
      fail(ENTS_BAD_VALUE, at,
           "has " + std::to_string(constants.size()) + " constants; at most " +
               std::to_string(most_constants) + " are possible");
    for (const auto& [name, number] : constants.items()) {
      std::string reason;
      if (!is_expression_name(name, reason)) fail(ENTS_BAD_VALUE, member(at, name), reason);
      const auto same = [&name = name](const NamedNumber& parameter) { return parameter.name == name; };
      if (std::any_of(names.parameters.begin(), names.parameters.end(), same))
        fail(ENTS_BAD_VALUE, member(at, name),
             "is a parameter of this height, too; give one of them another name");
      names.constants.push_back({name, read_double(number, member(at, name), Range::any)});
    }
  }
  double feature_length[2] = {Height::unbounded, Height::unbounded};
  read_feature_length(value, path, sources, feature_length);
  Height height =
      read_expression(read_text(value.at("h"), member(path, "h")), member(path, "h"), names, feature_length);
  for (std::size_t i = 0; i < bound_to.size(); ++i)
    height.bind(static_cast<std::int32_t>(i), bound_to[i] - 1);
  return height;
}

} // namespace ents
