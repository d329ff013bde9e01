// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/map_json.hpp"

#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "abi/read/json_check.hpp"
#include "abi/read/json_text.hpp"
#include "abi/read/json_tree.hpp"
#include "abi/read/model_error.hpp"
#include "abi/read/surface_file.hpp"
#include "abi/read/text_file.hpp"
#include "core/height/low_pass.hpp"

namespace ents {

namespace {

using nlohmann::json;

constexpr double largest_height = 1e100; // as Range::any

void read_values(const json& value, const std::string& path, HeightMap& map) {
  if (map.dimension == 1) {
    check_array(value, path, most_json_values, "numbers, the samples along s1");
    map.rows = 1;
    map.columns = static_cast<std::int64_t>(value.size());
    map.values = read_vector(value, path, value.size(), Range::any, "");
    return;
  }
  check_array(value, path, most_json_values, "rows, each an array of numbers");
  check_array(value[0], item(path, 0), most_json_values, "numbers, the samples along s1");
  for (std::size_t j = 0; j < value.size(); ++j)
    for (const double height :
         read_vector(value[j], item(path, j), value[0].size(), Range::any, "as in row 0"))
      map.values.push_back(height);
  map.rows = static_cast<std::int64_t>(value.size());
  map.columns = static_cast<std::int64_t>(value[0].size());
}

void read_data(const json& value, const std::string& path, const HeightSources& sources, HeightMap& map) {
  const std::string& name = read_text(value, path);
  const NamedData* found = nullptr;
  std::vector<std::string_view> names;
  for (const NamedData& data : sources.data) {
    names.push_back(data.name);
    if (data.name != name) continue;
    if (found) fail(ENTS_BAD_VALUE, path, "two arrays given with the model are called " + in_quotes(name));
    found = &data;
  }
  if (!found)
    fail(ENTS_BAD_VALUE, path,
         "no array called " + in_quotes(name) + " is given with the model" +
             (names.empty() ? std::string("; there are none") : "; there are: " + alternatives(names)));
  const std::string what = "the array " + in_quotes(name);
  if (!found->values) fail(ENTS_NULL_ARGUMENT, path, what + " has no values (null pointer)");
  if (found->rows < 1 || found->columns < 1 || found->columns > most_map_samples ||
      found->rows > most_map_samples / found->columns)
    fail(ENTS_BAD_COUNT, path,
         what + " has " + std::to_string(found->rows) + " rows of " + std::to_string(found->columns) +
             "; write at least 1 and at most " + std::to_string(most_map_samples) + " samples in all");
  if (map.dimension == 1 && found->rows != 1)
    fail(ENTS_BAD_VALUE, path,
         what + " has " + std::to_string(found->rows) + " rows; a line segment takes one row");
  map.rows = found->rows;
  map.columns = found->columns;
  map.values.assign(found->values, found->values + found->rows * found->columns);
  for (std::size_t k = 0; k < map.values.size(); ++k)
    if (!std::isfinite(map.values[k])) {
      const std::int64_t at = static_cast<std::int64_t>(k);
      fail(ENTS_NON_FINITE, path,
           what + " is NaN or infinite in row " + std::to_string(at / map.columns) + ", column " +
               std::to_string(at % map.columns) + " (from 0)");
    }
}

// Returns whether the file states its size, which then stands in map.size, in model lengths.
bool read_file(const json& value, const std::string& path, const HeightSources& sources, HeightMap& map) {
  const std::string& name = read_text(value.at("file"), member(path, "file"));
  SurfaceFile file;
  try {
    file = read_surface_file(sources.directory / path_from_utf8(name));
  } catch (const ModelError& error) {
    fail(error.status, member(path, "file"), error.message);
  }
  if (value.contains("length_unit") && !file.states_units)
    fail(ENTS_BAD_VALUE, member(path, "length_unit"),
         "the file " + in_quotes(name) +
             " states no units; use \"size\" and \"scale\", and remove \"length_unit\"");
  const double length_unit = read_double_or(value, path, "length_unit", Range::positive, 1.0);

  map.rows = file.rows;
  map.columns = file.columns;
  if (map.dimension == 1 && file.columns == 1) {
    std::swap(map.rows, map.columns);
    std::swap(file.width, file.height);
  }
  if (map.dimension == 1 && map.rows != 1)
    fail(ENTS_BAD_VALUE, member(path, "file"),
         in_quotes(name) + " has " + std::to_string(file.rows) + " rows of " + std::to_string(file.columns) +
             "; a line segment takes a profile: one row or one column");
  map.values = std::move(file.values);
  if (!file.states_units) return false;
  for (double& height : map.values) height *= file.value_unit / length_unit;
  map.size[0] = file.width / length_unit;
  map.size[1] = file.height / length_unit;
  if (map.boundary == MapBoundary::clamped) {
    map.size[0] *= static_cast<double>(map.columns - 1) / static_cast<double>(map.columns);
    map.size[1] *= static_cast<double>(map.rows - 1) / static_cast<double>(map.rows);
  }
  return true;
}

MapBoundary read_boundary(const json& value, const std::string& path) {
  const bool periodic =
      read_choice(value.at("boundary"), member(path, "boundary"), {"periodic", "clamped"}) == 0;
  return periodic ? MapBoundary::periodic : MapBoundary::clamped;
}

} // namespace

HeightMap read_grid(const json& value, const std::string& path, std::int32_t dimension) {
  HeightMap map;
  map.dimension = dimension;
  map.boundary = read_boundary(value, path);
  const auto n = static_cast<std::size_t>(dimension);
  const std::string points_path = member(path, "points");
  const std::vector<double> points = read_vector(value.at("points"), points_path, n, Range::positive,
                                                 "samples along each surface coordinate");
  const std::vector<double> size =
      read_vector(value.at("size"), member(path, "size"), n, Range::positive, per_coordinate);
  std::vector<double> origin(n, 0.0);
  if (value.contains("origin"))
    origin = read_vector(value.at("origin"), member(path, "origin"), n, Range::any, per_coordinate);
  const double fewest = map.boundary == MapBoundary::clamped ? 2.0 : 1.0;
  double all = 1.0;
  for (std::size_t a = 0; a < n; ++a) {
    all *= points[a];
    if (points[a] != std::floor(points[a]) || points[a] < fewest ||
        all > static_cast<double>(most_map_samples))
      fail(ENTS_BAD_VALUE, item(points_path, a),
           "is " + shown(points[a]) + "; write a whole number of samples, at least " + shown(fewest) +
               ", and at most " + std::to_string(most_map_samples) + " in all");
    map.size[a] = size[a];
    map.origin[a] = origin[a];
  }
  map.columns = static_cast<std::int64_t>(points[0]);
  map.rows = n == 2 ? static_cast<std::int64_t>(points[1]) : 1;
  return map;
}

HeightMap read_map(const json& value, const std::string& path, const HeightSources& sources) {
  const bool file = value.contains("file"), values = value.contains("values"), data = value.contains("data");
  if (int(file) + int(values) + int(data) > 1)
    fail(ENTS_UNKNOWN_KEY, path,
         "more than one of \"file\", \"values\" and \"data\"; leave one source of heights");
  if (file)
    check_keys(value, path, {"type", "file", "boundary"},
               {"size", "origin", "scale", "length_unit", "cut_off"});
  else if (values)
    check_keys(value, path, {"type", "values", "boundary", "size"}, {"origin", "scale", "cut_off"});
  else if (data)
    check_keys(value, path, {"type", "data", "boundary", "size"}, {"origin", "scale", "cut_off"});
  else {
    check_keys(value, path, {"type"},
               {"boundary", "file", "values", "data", "size", "origin", "scale", "length_unit", "cut_off"});
    fail(ENTS_UNKNOWN_KEY, path,
         "the heights are missing; write one of \"file\", \"values\" and \"data\"" +
             std::string(value.contains("boundary") ? "" : ", and \"boundary\""));
  }

  HeightMap map;
  map.dimension = sources.dimension;
  map.boundary = read_boundary(value, path);
  const std::size_t n = static_cast<std::size_t>(map.dimension);
  // Cheap keys first: nothing is read from disk for a model that is wrong anyway.
  std::vector<double> size, origin(n, 0.0);
  if (value.contains("size"))
    size = read_vector(value.at("size"), member(path, "size"), n, Range::positive, per_coordinate);
  if (value.contains("origin"))
    origin = read_vector(value.at("origin"), member(path, "origin"), n, Range::any, per_coordinate);
  const double scale = read_double_or(value, path, "scale", Range::any, 1.0);
  const double cut_off = read_double_or(value, path, "cut_off", Range::positive, 0.0);
  const std::string source_path = member(path, file ? "file" : values ? "values" : "data");

  bool size_known = false;
  if (file) size_known = read_file(value, path, sources, map);
  if (values) read_values(value.at("values"), source_path, map);
  if (data) read_data(value.at("data"), source_path, sources, map);

  const std::int64_t fewest = map.boundary == MapBoundary::clamped ? 2 : 1;
  if (map.columns < fewest || (map.dimension == 2 && map.rows < fewest))
    fail(ENTS_BAD_VALUE, source_path,
         std::to_string(map.rows) + " rows of " + std::to_string(map.columns) +
             " samples; a clamped map needs at least 2 along every surface coordinate");
  if (size.empty() && !size_known)
    fail(ENTS_UNKNOWN_KEY, path,
         "the key \"size\" is missing; the file states none, so write the lengths it covers");

  for (std::size_t a = 0; a < n; ++a) {
    if (!size.empty()) map.size[a] = size[a];
    map.origin[a] = origin[a];
    if (!(map.size[a] >= 1e-100 && map.size[a] <= 1e100))
      fail(ENTS_BAD_VALUE, source_path,
           "the size stated in the file is not within 1e-100 .. 1e100 model lengths; check \"length_unit\"");
  }
  for (double& height : map.values) {
    height *= scale;
    if (!(std::fabs(height) <= largest_height))
      fail(ENTS_BAD_VALUE, source_path,
           "heights are beyond 1e100 after scaling; check \"scale\" and \"length_unit\"");
  }
  if (cut_off > 0.0) leave_out_short_waves(map, cut_off);
  return map;
}

} // namespace ents
