// SPDX-License-Identifier: BSD-3-Clause
#include "check_extent.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <utility>

#include "output/table.hpp"
#include "smoothing.hpp"

namespace host {
namespace {

constexpr double most_points = 100000; // on all segments
constexpr double missing_share = 0.05; // of a direction; a clamped map ends a pixel before its width

Extent nothing(std::size_t directions) {
  return {std::vector<double>(directions, std::numeric_limits<double>::infinity()),
          std::vector<double>(directions, -std::numeric_limits<double>::infinity())};
}

void include(Extent& extent, std::size_t direction, double value) {
  extent.low[direction] = std::min(extent.low[direction], value);
  extent.high[direction] = std::max(extent.high[direction], value);
}

/// Surface coordinates at the nodes a segment lies between; the outer ones of smoothed segments are its
/// neighbours'.
/// @param of_segments  [segments][m][d-1], or empty: the model's own, else s = xi
Extent coordinates_of(const Json& text, std::size_t directions, const std::vector<double>& of_segments) {
  const std::string name = text.at("segment").get<std::string>();
  const std::size_t m = directions == 1 ? 4 : 16; // of smoothed segments
  const auto between = [&](std::size_t node) {
    const auto middle = [](std::size_t i) { return i == 1 || i == 2; };
    return !is_smoothed(name) ||
           (directions == 1 ? middle(node % m) : middle(node % m % 4) && middle(node % m / 4));
  };
  Extent extent = nothing(directions);
  if (!of_segments.empty()) {
    for (std::size_t k = 0; k < of_segments.size(); ++k)
      if (between(k / directions)) include(extent, k % directions, of_segments[k]);
  } else if (text.contains("surface_coordinates")) {
    const Json& own = text.at("surface_coordinates");
    const auto include_node = [&](std::size_t a) {
      for (std::size_t i = 0; i < directions; ++i) include(extent, i, own.at(a).at(i).get<double>());
    };
    if (text.contains("patch")) {
      for (const Json& segment : text.at("patch"))
        for (std::size_t a = 0; a < segment.size(); ++a)
          if (between(a)) include_node(segment.at(a).get<std::size_t>());
    } else {
      for (std::size_t a = 0; a < own.size(); ++a)
        if (between(a)) include_node(a);
    }
  } else {
    for (std::size_t i = 0; i < directions; ++i)
      include(extent, i, is_triangle(name) ? 0 : -1), include(extent, i, 1);
  }
  return extent;
}

/// What a file says and holds; the library has read it before and found nothing wrong.
struct MapFile {
  std::map<std::string, double> lengths; ///< "# Width: 10.00 um" of Gwyddion's text export, metres
  double rows = 0, columns = 0;
};

MapFile read_map_file(const std::filesystem::path& file) {
  static const std::map<std::string, double> units{
      {"m", 1},     {"dm", 1e-1},    {"cm", 1e-2}, {"mm", 1e-3},  {"\xC2\xB5m", 1e-6}, {"\xCE\xBCm", 1e-6},
      {"um", 1e-6}, {"\xB5m", 1e-6}, {"nm", 1e-9}, {"pm", 1e-12}, {"fm", 1e-15},       {"\xC3\x85", 1e-10},
      {"km", 1e3}};
  MapFile map;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line.empty()) continue;
    if (line[0] != '#') {
      if (map.rows++ > 0) continue;
      const char* separators = line.find(';') != line.npos                                   ? ";"
                               : line.find(',') != line.npos && line.find('\t') == line.npos ? ","
                                                                                             : " \t";
      for (std::size_t at = 0; (at = line.find_first_not_of(separators, at)) != line.npos; ++map.columns)
        at = std::min(line.find_first_of(separators, at), line.size());
      continue;
    }
    const auto colon = line.find(':'), key = line.find_first_not_of(" \t", 1);
    if (colon == line.npos || key == line.npos) continue;
    char* end = nullptr;
    const double number = std::strtod(line.c_str() + colon + 1, &end);
    std::string unit = end;
    unit.erase(0, unit.find_first_not_of(" \t"));
    if (const auto found = units.find(unit); found != units.end() && number > 0)
      map.lengths[line.substr(key, colon - key)] = number * found->second;
  }
  return map;
}

/// Lengths covered. Empty: the file does not say, and the model does not, either.
std::vector<double> size_of(const Json& map, const std::filesystem::path& folder, std::size_t directions) {
  std::vector<double> size;
  if (map.contains("size")) {
    for (const Json& length : map.at("size")) size.push_back(length.get<double>());
  } else if (map.contains("file")) {
    MapFile file = read_map_file(folder / map.at("file").get<std::string>());
    if (file.lengths.size() != 2) return {};
    if (directions == 1 && file.columns == 1) { // a profile may stand
      std::swap(file.rows, file.columns);
      std::swap(file.lengths["Width"], file.lengths["Height"]);
    }
    // The stated width is that of n pixels; the samples of a clamped map lie n - 1 apart.
    const bool clamped = map.value("boundary", "") == "clamped";
    const double unit = map.value("length_unit", 1.);
    for (const auto& [key, count] : {std::pair{"Width", file.columns}, std::pair{"Height", file.rows}})
      if (size.size() < directions)
        size.push_back(file.lengths[key] / unit * (clamped ? (count - 1) / count : 1));
  }
  return size.size() == directions ? size : std::vector<double>{};
}

void find_maps(const Json& height, const std::string& where, const std::filesystem::path& folder,
               SurfaceExtent& out) {
  const std::size_t directions = out.coordinates.low.size();
  if (height.is_object() && height.contains("type") && height.at("type") == "map") {
    const std::vector<double> size = size_of(height, folder, directions);
    if (size.empty()) return;
    MapExtent map{where, height.value("boundary", "") == "clamped", nothing(directions)};
    for (std::size_t i = 0; i < directions; ++i) {
      const double origin = height.contains("origin") ? height.at("origin").at(i).get<double>() : 0;
      const double low = out.coordinates.low[i], high = out.coordinates.high[i];
      map.covers.low[i] = origin, map.covers.high[i] = origin + size[i];
      const double covered = std::min(high, origin + size[i]) - std::max(low, origin);
      map.too_small = map.too_small || (map.clamped && covered < (1 - missing_share) * (high - low));
    }
    out.maps.push_back(std::move(map));
    return;
  }
  if (height.is_structured())
    for (const auto& item : height.items()) find_maps(item.value(), where + "/" + item.key(), folder, out);
}

/// All but the heights.
/// @param where  path of the model
SurfaceExtent coverage(const Json& text, const std::string& where, const std::filesystem::path& folder,
                       std::size_t directions, const std::vector<double>& of_segments) {
  SurfaceExtent extent;
  extent.coordinates = coordinates_of(text, directions, of_segments);
  if (text.contains("height")) find_maps(text.at("height"), where + "/height", folder, extent);
  return extent;
}

std::vector<std::string> warnings(const SurfaceExtent& extent) {
  std::vector<std::string> lines;
  for (const MapExtent& map : extent.maps)
    if (map.too_small)
      lines.push_back(
          "warning: the map " + map.where +
          " covers only a part of the segments, beyond it the heights of its border go on; look at "
          "\"size\", \"origin\" "
          "and \"length_unit\" (metres in one unit of length)");
  return lines;
}

std::string text_of(const Extent& extent) {
  std::string text;
  for (std::size_t i = 0; i < extent.low.size(); ++i)
    text += (i == 0 ? "s1 = " : ", s2 = ") + format_number(extent.low[i]) + " .. " +
            format_number(extent.high[i]);
  return text;
}

} // namespace

SurfaceExtent extent_of(const EntsModel& model, const Json& text, const std::filesystem::path& folder,
                        const MasterSurface& surface) {
  const bool triangles = is_triangle(text.at("segment").get<std::string>());
  SurfaceExtent extent = coverage(text, "", folder, surface.d - 1, surface.surface_coordinates);

  const double each = most_points / static_cast<double>(surface.segments());
  const int n =
      static_cast<int>(surface.d == 2 ? std::clamp(each, 5., 2001.) : std::clamp(std::sqrt(each), 3., 257.));
  const std::vector<double> xi =
      even_grid(model.layout().parameters, static_cast<std::size_t>(n - 1), triangles);
  extent.low = std::numeric_limits<double>::infinity(), extent.high = -extent.low;
  for (std::size_t s = 0; s < surface.segments(); ++s)
    for (const double height : sample_surface(model, surface.master(s), surface.coordinates(s), xi).height)
      extent.low = std::min(extent.low, height), extent.high = std::max(extent.high, height);
  return extent;
}

std::string describe(const SurfaceExtent& extent) {
  std::string text;
  if (extent.low != 0 || extent.high != 0)
    text = "height: " + format_number(extent.low) + " .. " + format_number(extent.high) + " over " +
           text_of(extent.coordinates) + " (sampled)\n";
  for (const MapExtent& map : extent.maps)
    text += "map " + map.where + (map.clamped ? ": covers " : ": repeats ") + text_of(map.covers) + "\n";
  for (const std::string& line : warnings(extent)) text += line + "\n";
  return text;
}

void note_small_maps(const Scene& scene, const std::vector<double>& of_segments) {
  if (!scene.contact) return;
  const auto directions = static_cast<std::size_t>(scene.dimension - 1);
  const SurfaceExtent extent =
      coverage(scene.contact->model, "/contact/model", scene.file.parent_path(), directions, of_segments);
  for (const std::string& line : warnings(extent)) std::fprintf(stderr, "ents-host: %s\n", line.c_str());
}

Json extent_json(const SurfaceExtent& extent) {
  Json json{{"height_range", {extent.low, extent.high}},
            {"surface_coordinates", {{"low", extent.coordinates.low}, {"high", extent.coordinates.high}}},
            {"maps", Json::array()}};
  for (const MapExtent& map : extent.maps)
    json["maps"].push_back({{"path", map.where},
                            {"boundary", map.clamped ? "clamped" : "periodic"},
                            {"low", map.covers.low},
                            {"high", map.covers.high},
                            {"covers_segments", !map.too_small}});
  return json;
}

} // namespace host
