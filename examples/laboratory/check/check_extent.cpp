// SPDX-License-Identifier: BSD-3-Clause
#include "check_extent.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "map_file.hpp"
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

void find_maps(const Json& height, const std::string& where, const std::filesystem::path& folder,
               SurfaceExtent& out) {
  const std::size_t directions = out.coordinates.low.size();
  if (height.is_object() && height.contains("type") && height.at("type") == "map") {
    const std::vector<double> size = map_size(height, folder, directions).lengths;
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
  for (const std::string& line : warnings(extent)) std::fprintf(stderr, "ents-lab: %s\n", line.c_str());
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
