// SPDX-License-Identifier: BSD-3-Clause
#include "abi/height_json.hpp"

#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "abi/json_check.hpp"
#include "abi/json_tree.hpp"
#include "abi/map_json.hpp"
#include "abi/model_error.hpp"
#include "core/thread.hpp"

namespace ents {

namespace {

using nlohmann::json;

constexpr std::string_view per_coordinate = "one per surface coordinate of the segment";
constexpr std::size_t most_coefficients = 64; // per surface coordinate
constexpr std::size_t most_parts = 1024;      // of a sum or product

constexpr double pi = 3.14159265358979323846;

std::vector<double> read_surface_vector(const json& value, const std::string& path, const char* key,
                                        const HeightSources& sources) {
  return read_vector(value.at(key), member(path, key), static_cast<std::size_t>(sources.dimension),
                     Range::any, per_coordinate);
}

Height read_sine(const json& value, const std::string& path, const HeightSources& sources) {
  check_keys(value, path, {"type", "amplitude", "wave_vector"}, {"phase"});
  const double amplitude = read_double(value, path, "amplitude", Range::any);
  const std::vector<double> wave_vector = read_surface_vector(value, path, "wave_vector", sources);
  return Height::sine(amplitude, wave_vector, read_double_or(value, path, "phase", Range::any, 0.0));
}

Height read_gaussian(const json& value, const std::string& path, const HeightSources& sources) {
  check_keys(value, path, {"type", "amplitude", "center", "width"}, {});
  const double amplitude = read_double(value, path, "amplitude", Range::any);
  const std::vector<double> center = read_surface_vector(value, path, "center", sources);
  return Height::gaussian(amplitude, center, read_double(value, path, "width", Range::positive));
}

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
  return one ? Height::polynomial(std::move(line)) : Height::bivariate_polynomial(rows);
}

// A number within low .. high; `text` says so.
double read_within(const json& value, const std::string& path, double low, double high, const std::string& text) {
  const double number = read_double(value, path, Range::any);
  if (!(number >= low && number <= high)) fail(ENTS_BAD_VALUE, path, "is " + shown(number) + "; write " + text);
  return number;
}

ThreadProfile read_thread_profile(const json& value, const std::string& path) {
  ThreadProfile p{};
  p.pitch = read_double(value, path, "pitch", Range::positive);
  const std::string angles = member(path, "flank_angles");
  if (const json& flanks = value.at("flank_angles"); flanks.is_array() && flanks.size() == 2) {
    constexpr double degree = pi / 180.0;
    p.rising = degree * read_within(flanks[0], item(angles, 0), 0.1, 89.0, "degrees from 0.1 to 89");
    p.falling = degree * read_within(flanks[1], item(angles, 1), 0.1, 89.0, "degrees from 0.1 to 89");
  } else {
    read_vector(flanks, angles, 2, Range::any, "degrees, of the flank that rises along the axis and of the one that falls");
  }
  const auto width = [&](const char* key) {
    return read_within(value.at(key), member(path, key), 0.0, p.pitch, "a length from 0 to the pitch");
  };
  p.crest = width("crest");
  p.root = width("root");
  if (!(p.crest + p.root < p.pitch))
    fail(ENTS_BAD_VALUE, path, "\"crest\" and \"root\" leave nothing of \"pitch\" for the flanks; make one of them narrower");
  const std::string at = member(path, "rounding");
  p.rounding = value.contains("rounding")
                   ? read_within(value.at("rounding"), at, p.pitch / 2048.0, p.pitch / 4.0, "a length from pitch / 2048 to pitch / 4")
                   : p.pitch / 16.0;
  return p;
}

Height read_thread(const json& value, const std::string& path, const HeightSources& sources) {
  check_keys(value, path, {"type", "pitch", "flank_angles", "crest", "root"}, {"rounding", "offset", "starts", "turn", "hand"});
  const bool winds = sources.dimension == 2;
  for (const char* key : {"starts", "turn", "hand"})
    if (!winds && value.contains(key))
      fail(ENTS_BAD_VALUE, member(path, key), "a line segment has no angle round the axis, only lengths along it; remove this key");
  const ThreadProfile profile = read_thread_profile(value, path);
  const double offset = read_double_or(value, path, "offset", Range::any, 0.0) / profile.pitch;
  std::vector<double> wave_vector = {1.0 / profile.pitch};
  if (winds) {
    const double starts =
        value.contains("starts") ? read_within(value.at("starts"), member(path, "starts"), 0.0, 64.0, "a whole number from 0 to 64") : 1.0;
    if (starts != std::floor(starts))
      fail(ENTS_BAD_VALUE, member(path, "starts"), "is " + shown(starts) + "; write a whole number: others do not close round the axis");
    const bool left = value.contains("hand") && read_choice(value.at("hand"), member(path, "hand"), {"right", "left"}) == 1;
    const double ridges_per_angle = starts / read_double_or(value, path, "turn", Range::positive, 2.0 * pi);
    wave_vector.insert(wave_vector.begin(), left ? ridges_per_angle : -ridges_per_angle);
  }
  return Height::profile(thread_coefficients(profile), wave_vector, -offset);
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
  constexpr HeightKind kinds[] = {HeightKind::constant, HeightKind::sine, HeightKind::polynomial,
                                  HeightKind::gaussian, HeightKind::map,  HeightKind::profile,
                                  HeightKind::sum, HeightKind::product};
  switch (kinds[read_type(value, path,
                          {"constant", "sine", "polynomial", "gaussian", "map", "thread", "sum", "product"})]) {
  case HeightKind::sine:
    return read_sine(value, path, sources);
  case HeightKind::polynomial:
    return read_polynomial(value, path, sources);
  case HeightKind::gaussian:
    return read_gaussian(value, path, sources);
  case HeightKind::map:
    return Height::map(read_map(value, path, sources));
  case HeightKind::profile:
    return read_thread(value, path, sources);
  case HeightKind::sum:
    return Height::sum(read_parts(value, path, sources, depth));
  case HeightKind::product:
    return Height::product(read_parts(value, path, sources, depth));
  default:
    check_keys(value, path, {"type", "value"}, {});
    return Height::constant(sources.dimension, read_double(value, path, "value", Range::any));
  }
}

} // namespace

Height read_height(const json& value, const std::string& path, const HeightSources& sources) {
  return read_at_depth(value, path, sources, 1);
}

} // namespace ents
