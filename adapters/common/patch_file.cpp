// SPDX-License-Identifier: BSD-3-Clause
#include "patch_file.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <unordered_map>

#include <nlohmann/json.hpp>

namespace ents_adapter {
namespace {

using ents_deck::dot;
using ents_deck::Face;
using ents_deck::face_normal;
using ents_deck::length;
using ents_deck::minus;
using ents_deck::Shape;
using std::string;
using Coordinates = std::unordered_map<std::int64_t, ents_deck::Point>;

Shape shape_of(const string& name) {
  for (const Shape shape : {Shape::line2, Shape::line3, Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8})
    if (name == ents_deck::segment_name(shape)) return shape;
  throw std::runtime_error("unknown face '" + name + "'");
}

/// The slave's face that a point with so many nodes lies in.
Shape face_of(std::size_t nodes, bool plane) {
  switch (nodes) {
  case 2:
    return Shape::line2;
  case 3:
    return plane ? Shape::line3 : Shape::tri3;
  case 4:
    return Shape::quad4;
  case 6:
    return Shape::tri6;
  case 8:
    return Shape::quad8;
  default:
    return Shape::none;
  }
}

/// The undeformed master below a point.
void find_under(const WatchedPair& pair, WatchedPoint& p) {
  const ents_deck::Point x = place_of(pair.undeformed, p);
  const ents_deck::FacetTree::Closest under = pair.tree->closest(x, p.normal);
  if (under.face < 0) return;
  const ents_deck::Point n = face_normal(pair.undeformed, pair.faces[static_cast<std::size_t>(under.face)]);
  const ents_deck::Point away = minus(x, under.point);
  const double ahead = dot(away, n) / length(n);
  p.under = under.point;
  p.beside = p.element ? 0 : std::sqrt(std::max(dot(away, away) - ahead * ahead, 0.0));
}

WatchedPair read_pair(const nlohmann::json& json, const Coordinates& coordinates) {
  WatchedPair pair;
  pair.slave = json.at("slave").get<string>(), pair.master = json.at("master").get<string>();
  pair.slide = json.at("slide").get<double>(), pair.lowest = json.at("lowest").get<double>();
  std::unordered_map<std::int64_t, int> index;
  const auto nodes_of = [&](const nlohmann::json& list, bool of_master) {
    std::vector<int> out;
    for (const auto& entry : list) {
      const auto id = entry.get<std::int64_t>();
      const auto [found, is_new] = index.emplace(id, static_cast<int>(pair.nodes.size()));
      if (is_new) {
        const auto at = coordinates.find(id);
        if (at == coordinates.end())
          throw std::runtime_error("node " + std::to_string(id) + " is not among \"nodes\"");
        pair.nodes.push_back(id);
        pair.undeformed.nodes.emplace_back().x = at->second;
        pair.of_master.push_back(of_master);
      }
      out.push_back(found->second);
    }
    return out;
  };
  for (const auto& face : json.at("faces")) {
    Face& added = pair.faces.emplace_back();
    added.shape = shape_of(face.at(0).get<string>());
    added.nodes = nodes_of(face.at(1), true);
  }
  for (const auto& point : json.at("points")) {
    WatchedPoint p;
    p.element = point.at("element").get<std::int64_t>();
    p.face.nodes = nodes_of(point.at("nodes"), false);
    p.face.shape =
        face_of(p.face.nodes.size(), !pair.faces.empty() && corner_count(pair.faces[0].shape) == 2);
    p.weights = point.at("weights").get<std::vector<double>>();
    if (p.weights.size() != p.face.nodes.size())
      throw std::runtime_error("a point has another number of \"weights\" than of \"nodes\"");
    p.normal = point.at("normal").get<ents_deck::Point>();
    p.masters = nodes_of(point.at("masters"), true);
    p.faces = point.at("faces").get<std::vector<int>>();
    for (const int face : p.faces)
      if (face < 0 || face >= static_cast<int>(pair.faces.size()))
        throw std::runtime_error("a point has face " + std::to_string(face) +
                                 ", which is not among \"faces\"");
    pair.points.push_back(std::move(p));
  }
  pair.noted.assign(pair.nodes.size(), 0);
  pair.deformed.nodes = pair.undeformed.nodes;
  pair.tree = std::make_unique<ents_deck::FacetTree>(pair.undeformed, pair.faces);
  for (WatchedPoint& p : pair.points) find_under(pair, p);
  return pair;
}

} // namespace

ents_deck::Point place_of(const ents_deck::Mesh& mesh, const WatchedPoint& p) {
  ents_deck::Point x{};
  for (std::size_t i = 0; i < p.weights.size(); ++i)
    for (std::size_t j = 0; j < 3; ++j)
      x[j] += p.weights[i] * mesh.nodes[static_cast<std::size_t>(p.face.nodes[i])].x[j];
  return x;
}

double size_of(const ents_deck::Mesh& mesh, const Face& face) {
  const double n = length(face_normal(mesh, face));
  return corner_count(face.shape) == 2 ? n : std::sqrt(corner_count(face.shape) == 3 ? n : n / 2);
}

std::vector<WatchedPair> read_patches(const string& path) {
  std::vector<WatchedPair> out;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return out;
  const auto all = nlohmann::json::parse(stream);
  Coordinates coordinates;
  for (const auto& node : all.at("nodes"))
    coordinates[node.at(0).get<std::int64_t>()] = {node.at(1).get<double>(), node.at(2).get<double>(),
                                                   node.at(3).get<double>()};
  for (const auto& json : all.at("pairs")) out.push_back(read_pair(json, coordinates));
  return out;
}

} // namespace ents_adapter
