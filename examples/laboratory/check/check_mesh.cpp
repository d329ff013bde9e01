// SPDX-License-Identifier: BSD-3-Clause
#include "check_mesh.hpp"

#include <map>

#include "deck/mesh.hpp"
#include "toolbox/json_reader.hpp"

namespace host {
namespace {

/// Natural coordinates of the nodes: a segment of its own, flat and undistorted.
std::vector<double> natural_nodes(const std::string& segment) {
  static const std::map<std::string, std::vector<double>> nodes{
      {"line2", {-1, 1}},
      {"line3", {-1, 1, 0}},
      {"catmull_rom4", {-3, -1, 1, 3}},
      {"bspline4", {-3, -1, 1, 3}},
      {"tri3", {0, 0, 1, 0, 0, 1}},
      {"tri6", {0, 0, 1, 0, 0, 1, .5, 0, .5, .5, 0, .5}},
      {"quad4", {-1, -1, 1, -1, 1, 1, -1, 1}},
      {"quad8", {-1, -1, 1, -1, 1, 1, -1, 1, 0, -1, 1, 0, 0, 1, -1, 0}},
      {"quad9", {-1, -1, 1, -1, 1, 1, -1, 1, 0, -1, 1, 0, 0, 1, -1, 0, 0, 0}},
      {"bezier15", {0,  0,   1,   0, 0,   1, .25, 0, .5,  0,   .75, 0,  .75, .25, .5,
                    .5, .25, .75, 0, .75, 0, .5,  0, .25, .25, .25, .5, .25, .25, .5}}};
  const auto found = nodes.find(segment);
  if (found != nodes.end()) return found->second;
  std::vector<double> patch; // 16-node patches: 4 j + i
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) patch.insert(patch.end(), {2. * i - 3, 2. * j - 3});
  return patch;
}

MasterSurface empty_surface(const ents_layout& layout) {
  MasterSurface surface;
  surface.d = static_cast<std::size_t>(layout.dimension);
  surface.m = static_cast<std::size_t>(layout.nodes);
  return surface;
}

MasterSurface one_segment(const std::string& name, const ents_layout& layout) {
  MasterSurface surface = empty_surface(layout);
  const std::vector<double> flat = natural_nodes(name);
  for (std::size_t a = 0; a < surface.m; ++a) {
    for (std::size_t i = 0; i + 1 < surface.d; ++i) surface.nodes.push_back(flat[a * (surface.d - 1) + i]);
    surface.nodes.push_back(0);
    surface.connectivity.push_back(static_cast<std::int64_t>(a));
  }
  return surface;
}

MasterSurface json_surface(const std::filesystem::path& file, const ents_layout& layout) {
  const Json json = parse_json_file(file);
  JsonObject object(JsonValue(json, file.string() + ": "));
  MasterSurface surface = empty_surface(layout);
  for (const JsonValue& item : object.at("nodes").items()) {
    const auto node = item.numbers(surface.d);
    surface.nodes.insert(surface.nodes.end(), node.begin(), node.end());
  }
  const int nodes = static_cast<int>(surface.nodes.size() / surface.d);
  for (const JsonValue& item : object.at("segments").items()) {
    const auto entries = item.items();
    if (entries.size() != surface.m)
      item.fail("the model's segment has " + std::to_string(surface.m) + " nodes, here are " +
                std::to_string(entries.size()));
    for (const JsonValue& entry : entries) surface.connectivity.push_back(entry.integer(0, nodes - 1));
  }
  if (object.has("surface_coordinates")) {
    const JsonValue value = object.at("surface_coordinates");
    std::vector<std::vector<double>> of_nodes;
    for (const JsonValue& item : value.items()) of_nodes.push_back(item.numbers(surface.d - 1));
    if (of_nodes.size() != static_cast<std::size_t>(nodes)) value.fail("one entry per node is expected");
    for (const std::int64_t node : surface.connectivity) {
      const auto& s = of_nodes[static_cast<std::size_t>(node)];
      surface.surface_coordinates.insert(surface.surface_coordinates.end(), s.begin(), s.end());
    }
  }
  object.finish();
  if (surface.connectivity.empty()) throw InputError(file.string() + ": there are no segments");
  return surface;
}

/// Elements of the deck that have as many nodes as a segment: lines in the plane, shells in space.
MasterSurface deck_surface(const std::filesystem::path& file, const ents_layout& layout) {
  const ents_deck::Mesh deck = ents_deck::read_mesh(ents_deck::read_source(file));
  MasterSurface surface = empty_surface(layout);
  for (const ents_deck::Node& node : deck.nodes)
    surface.nodes.insert(surface.nodes.end(), node.x.begin(), node.x.begin() + layout.dimension);
  for (std::size_t e = 0; e < deck.elements.size(); ++e)
    if (const ents_deck::Shape shape = deck.shape(static_cast<int>(e));
        dimension(shape) == layout.dimension - 1 && node_count(shape) == layout.nodes)
      surface.connectivity.insert(surface.connectivity.end(), deck.elements[e].nodes.begin(),
                                  deck.elements[e].nodes.end());
  if (surface.connectivity.empty())
    throw InputError(
        file.string() + ": no element has the " + std::to_string(layout.nodes) +
        " nodes of the model's segment; write smoothed and higher-order segments as a .json mesh");
  return surface;
}

} // namespace

ents_master_mesh MasterSurface::mesh() const {
  auto mesh = ents_struct<ents_master_mesh>();
  mesh.segments = static_cast<std::int64_t>(segments());
  mesh.connectivity = connectivity.data();
  mesh.nodes = static_cast<std::int64_t>(nodes.size() / d);
  mesh.positions = nodes.data();
  mesh.surface_coordinates = surface_coordinates.empty() ? nullptr : surface_coordinates.data();
  return mesh;
}

std::vector<double> MasterSurface::master(std::size_t segment) const {
  std::vector<double> result;
  for (std::size_t a = 0; a < m; ++a) {
    const auto first = connectivity[segment * m + a] * static_cast<std::int64_t>(d);
    result.insert(result.end(), nodes.begin() + first, nodes.begin() + first + static_cast<std::int64_t>(d));
  }
  return result;
}

std::vector<double> MasterSurface::coordinates(std::size_t segment) const {
  if (surface_coordinates.empty()) return {};
  const auto size = static_cast<std::ptrdiff_t>(m * (d - 1));
  const auto first = surface_coordinates.begin() + static_cast<std::ptrdiff_t>(segment) * size;
  return {first, first + size};
}

MasterSurface read_surface(const std::filesystem::path& file, const std::string& segment,
                           const ents_layout& layout) {
  if (file.empty()) return one_segment(segment, layout);
  if (file.extension() == ".json") return json_surface(file, layout);
  try {
    return deck_surface(file, layout);
  } catch (const ents_deck::Error& error) {
    throw InputError(error.what());
  }
}

} // namespace host
