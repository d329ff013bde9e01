// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/model_json.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "abi/read/contact_json.hpp"
#include "abi/read/height_json.hpp"
#include "abi/read/json_check.hpp"
#include "abi/read/json_text.hpp"
#include "abi/read/json_tree.hpp"
#include "abi/read/text_file.hpp"
#include "core/model/binding.hpp"

namespace ents {

namespace {

using nlohmann::json;

Basis read_segment(const json& value) {
  std::vector<std::string_view> names;
  for (const BasisEntry& entry : basis_table) names.push_back(entry.name);
  return basis_table[read_choice(value, "/segment", names)].basis;
}

// [m][parameters]
std::vector<double> read_surface_coordinates(const json& value, const BasisEntry& basis, const Patch& patch) {
  const std::string path = "/surface_coordinates";
  const auto nodes = static_cast<std::size_t>(patch.empty() ? basis.nodes : patch.nodes);
  check_array(value, path, most_json_values, "arrays, one per master node");
  if (value.size() != nodes)
    fail(ENTS_BAD_VALUE, path,
         "has " + std::to_string(value.size()) + " entries; " + (patch.empty() ? basis.name : "the patch") +
             " has " + std::to_string(nodes) + " master nodes, write one array for each");
  std::vector<double> result;
  for (std::size_t i = 0; i < nodes; ++i)
    for (const double s : read_vector(value[i], item(path, i), static_cast<std::size_t>(basis.parameters),
                                      Range::any, "the surface coordinates of this master node"))
      result.push_back(s);
  return result;
}

// A quad4 may have two neighbouring nodes in one: then it is a triangle. No other segment has a node twice.
void check_repeated_nodes(std::span<const std::int64_t> nodes, const BasisEntry& basis,
                          const std::string& path) {
  const std::size_t n = nodes.size();
  int pairs = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      if (nodes[i] != nodes[j]) continue;
      const bool collapses = basis.basis == Basis::quad4 && (j == i + 1 || j - i == n - 1);
      if (!collapses || ++pairs > 1)
        fail(ENTS_BAD_VALUE, path,
             "has node " + std::to_string(nodes[i]) + " twice" +
                 (basis.basis == Basis::quad4
                      ? "; a triangle among quadrilaterals is a quad4 whose last two nodes are the same one"
                      : ""));
    }
}

// [segments][m] indices of the patch's nodes
Patch read_patch(const json& value, const BasisEntry& basis) {
  const std::string path = "/patch";
  check_array(value, path, most_patch_segments, "arrays, the nodes of one segment each");
  if (value.empty()) fail(ENTS_BAD_VALUE, path, "is empty; leave it out for elements of one segment");
  Patch patch;
  for (std::size_t s = 0; s < value.size(); ++s) {
    const auto nodes = read_vector(value[s], item(path, s), static_cast<std::size_t>(basis.nodes), Range::any,
                                   "the patch's nodes that this segment has, counted from 0");
    for (const double node : nodes) {
      if (node < 0.0 || node >= most_patch_nodes || node != std::floor(node))
        fail(ENTS_BAD_VALUE, item(path, s),
             "has an entry that is not a node 0 .. " + std::to_string(most_patch_nodes - 1));
      patch.connectivity.push_back(static_cast<std::int64_t>(node));
      patch.nodes = std::max(patch.nodes, static_cast<std::int32_t>(node) + 1);
    }
    check_repeated_nodes(std::span(patch.connectivity).last(nodes.size()), basis, item(path, s));
  }
  for (std::int64_t node = 0; node < patch.nodes; ++node)
    if (std::find(patch.connectivity.begin(), patch.connectivity.end(), node) == patch.connectivity.end())
      fail(ENTS_BAD_VALUE, path,
           "has no segment with node " + std::to_string(node) + "; nodes are numbered without gaps");
  return patch;
}

void read_projection(const json& value, ModelSpec& model) {
  const std::string path = "/projection";
  const auto d = static_cast<std::size_t>(basis_entry(model.basis).parameters) + 1;
  constexpr ProjectionKind kinds[] = {ProjectionKind::normal, ProjectionKind::shadow_point,
                                      ProjectionKind::shadow_direction};
  model.projection = kinds[read_type(value, path, {"normal", "shadow_point", "shadow_direction"})];
  if (model.projection == ProjectionKind::normal) return check_keys(value, path, {"type"}, {});

  const bool point = model.projection == ProjectionKind::shadow_point;
  const char* key = point ? "emitter" : "direction";
  check_keys(value, path, {"type", key}, {});
  const std::vector<double> ray = read_vector(value.at(key), member(path, key), d, Range::any,
                                              point ? "the emitter's position" : "any length but zero");
  std::copy(ray.begin(), ray.end(), model.ray);
  if (point) return;

  // Twice, by the largest entry first: squares of very small entries would vanish.
  double largest = 0.0, squared = 0.0;
  for (const double r : ray) largest = std::max(largest, std::fabs(r));
  if (largest == 0.0)
    fail(ENTS_BAD_VALUE, member(path, key), "is zero; write any other vector, its length does not matter");
  for (double& r : model.ray) r /= largest;
  for (const double r : model.ray) squared += r * r;
  for (double& r : model.ray) r /= std::sqrt(squared);
}

std::vector<NamedParameter> read_parameters(const json& value) {
  const std::string path = "/parameters";
  if (!value.is_object())
    fail(ENTS_BAD_VALUE, path,
         "is no object; write {\"NAME\": NUMBER, ...}, the names and the values where the caller binds none");
  std::vector<NamedParameter> parameters;
  for (const auto& [name, number] : value.items()) {
    if (name.empty()) fail(ENTS_BAD_VALUE, path, "has a parameter without a name");
    parameters.push_back({name, read_double(number, member(path, name), Range::any)});
  }
  std::sort(parameters.begin(), parameters.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  if (parameters.size() > most_parameters)
    fail(ENTS_BAD_VALUE, path,
         "has " + std::to_string(parameters.size()) + " parameters; at most " +
             std::to_string(most_parameters) + " are possible");
  return parameters;
}

} // namespace

PatchedModel read_model(std::string_view text, const std::filesystem::path& directory,
                        std::span<const NamedData> data) {
  const JsonTree tree = parse_json(text);
  const json& root = *tree;
  check_keys(root, "", {"segment"},
             {"height", "surface_coordinates", "projection", "contact", "tangent", "master",
              "penetration_limit", "border", "patch", "parameters"});

  PatchedModel model;
  model.basis = read_segment(root.at("segment"));
  const BasisEntry& basis = basis_entry(model.basis);
  if (root.contains("parameters")) model.parameters = read_parameters(root.at("parameters"));
  if (root.contains("patch")) model.patch = read_patch(root.at("patch"), basis);
  if (root.contains("surface_coordinates")) {
    model.own_surface_coordinates = true;
    model.surface_coordinates = read_surface_coordinates(root.at("surface_coordinates"), basis, model.patch);
  }
  if (root.contains("projection")) read_projection(root.at("projection"), model);
  if (root.contains("contact")) read_contact(root.at("contact"), "/contact", model);
  if (root.contains("tangent")) {
    constexpr TangentKind kinds[] = {TangentKind::consistent, TangentKind::small_gap,
                                     TangentKind::first_variation};
    model.tangent =
        kinds[read_choice(root.at("tangent"), "/tangent", {"consistent", "small_gap", "first_variation"})];
  }
  if (root.contains("master"))
    model.rigid_master = read_choice(root.at("master"), "/master", {"deformable", "rigid"}) == 1;
  if (root.contains("penetration_limit"))
    model.penetration_limit = read_double(root, "", "penetration_limit", Range::positive);
  if (root.contains("border")) {
    model.border = read_double(root, "", "border", Range::positive);
    if (model.border < 1e-9 || model.border > 0.5)
      fail(ENTS_BAD_VALUE, "/border",
           "is " + shown(model.border) + ", not in 1e-9 .. 0.5; it is a length in natural coordinates");
  }

  if (!model.patch.empty() && model.law.multiplier_in_state() && model.law.has_friction())
    fail(ENTS_BAD_VALUE, "/contact/normal/type",
         "is \"augmented\" with friction: its multipliers cannot change segments within a patch; write "
         "\"augmented_multiplier\" or \"penalty\"");

  // Last: it may read a file.
  model.height = Height(basis.parameters);
  if (root.contains("height") && !root.at("height").is_null())
    model.height = read_height(root.at("height"), "/height",
                               {basis.parameters, directory, data, model.parameters, &model.fields});
  check_flattened(model);
  return model;
}

PatchedModel read_model_file(std::string_view path) {
  const std::filesystem::path file = path_from_utf8(path);
  return read_model(read_text_file(file, largest_json_text), file.parent_path());
}

} // namespace ents
