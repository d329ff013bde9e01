// SPDX-License-Identifier: BSD-3-Clause
#include "abi/height_json.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "abi/json_check.hpp"
#include "abi/map_json.hpp"
#include "abi/model_error.hpp"

namespace ents {

namespace {

using nlohmann::json;

constexpr std::string_view per_coordinate = "one per surface coordinate of the segment";
constexpr std::size_t most_coefficients = 64; // per surface coordinate
constexpr std::size_t most_parts = 1024;      // of a sum or product

Height read_polynomial(const json& value, const std::string& path, const HeightSources& sources) {
  check_keys(value, path, {"type", "coefficients"}, {});
  const json& table = value.at("coefficients");
  const std::string table_path = member(path, "coefficients");
  const bool one = sources.dimension == 1;
  check_array(table, table_path, most_coefficients,
              one ? "numbers c[i] of s1^i" : "arrays of numbers, c[i][j] of s1^i s2^j");
  std::vector<double> line;
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::string row_path = item(table_path, i);
    if (one) {
      line.push_back(read_double(table[i], row_path, Range::any));
      continue;
    }
    check_array(table[i], row_path, most_coefficients, "numbers c[i][j] of s1^i s2^j");
    rows.emplace_back();
    for (std::size_t j = 0; j < table[i].size(); ++j)
      rows.back().push_back(read_double(table[i][j], item(row_path, j), Range::any));
  }
  return one ? Height::polynomial(std::move(line)) : Height::polynomial(rows);
}

Height read_at_depth(const json& value, const std::string& path, const HeightSources& sources,
                     std::int32_t depth);

std::vector<Height> read_parts(const json& value, const std::string& path, const HeightSources& sources,
                               std::int32_t depth) {
  check_keys(value, path, {"type", "of"}, {});
  const json& of = value.at("of");
  const std::string of_path = member(path, "of");
  check_array(of, of_path, most_parts, "height objects");
  if (depth == max_height_depth)
    fail(ENTS_BAD_VALUE, path,
         "sums and products nest at most " + std::to_string(max_height_depth) +
             " levels deep, the innermost functions included; merge sums of sums and products of products");
  std::vector<Height> parts;
  for (std::size_t i = 0; i < of.size(); ++i)
    parts.push_back(read_at_depth(of[i], item(of_path, i), sources, depth + 1));
  return parts;
}

// depth: level of this height, 1 for the outermost.
Height read_at_depth(const json& value, const std::string& path, const HeightSources& sources,
                     std::int32_t depth) {
  const auto n = static_cast<std::size_t>(sources.dimension);
  switch (read_type(value, path, {"constant", "sine", "polynomial", "gaussian", "map", "sum", "product"})) {
  case 0:
    check_keys(value, path, {"type", "value"}, {});
    return Height::constant(sources.dimension, read_double(value, path, "value", Range::any));
  case 1:
    check_keys(value, path, {"type", "amplitude", "wave_vector"}, {"phase"});
    return Height::sine(
        read_double(value, path, "amplitude", Range::any),
        read_vector(value.at("wave_vector"), member(path, "wave_vector"), n, Range::any, per_coordinate),
        read_double_or(value, path, "phase", Range::any, 0.0));
  case 2:
    return read_polynomial(value, path, sources);
  case 3:
    check_keys(value, path, {"type", "amplitude", "center", "width"}, {});
    return Height::gaussian(
        read_double(value, path, "amplitude", Range::any),
        read_vector(value.at("center"), member(path, "center"), n, Range::any, per_coordinate),
        read_double(value, path, "width", Range::positive));
  case 4:
    return Height::map(read_map(value, path, sources));
  case 5:
    return Height::sum(read_parts(value, path, sources, depth));
  default:
    return Height::product(read_parts(value, path, sources, depth));
  }
}

} // namespace

Height read_height(const json& value, const std::string& path, const HeightSources& sources) {
  return read_at_depth(value, path, sources, 1);
}

} // namespace ents
