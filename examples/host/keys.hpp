// SPDX-License-Identifier: BSD-3-Clause
// Keys of a scene that the laboratory's scenes have, too: bodies, supports, loads and steps.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "element.hpp"
#include "mesh.hpp"
#include "toolbox/json_reader.hpp"

namespace host {

/// A body: a structured block, or the mesh of a deck.
struct Part {
  std::string name;
  ElementSetup setup;
  ElementType type = ElementType::quad4; ///< block
  std::vector<GridLines> lines;          ///< block: one per axis; empty: deck
  std::filesystem::path deck;
  std::string deck_where, element_set; ///< deck_where: file and JSON path, for messages
};

/// Factor on a prescribed value as a function of the load factor: straight lines between points, constant
/// beyond them. No points: the load factor itself.
struct Path {
  std::vector<std::array<double, 2>> points; ///< (load factor, factor), load factors ascending

  double at(double load_factor) const;
};

/// Displacement components of a set of nodes; they follow the load factor along a path.
struct Support {
  std::string nodes, where;
  std::vector<std::optional<double>> displacement; ///< [dimension]
  std::optional<double> temperature;
  Path path;
};

/// Force per undeformed area of a set of faces, dead load.
struct Traction {
  std::string faces, where;
  std::vector<double> value; ///< [dimension]
  Path path;
};

/// What the values of the steps are.
enum class Control {
  load_factor,   ///< of supports and tractions; a rigid master stays
  approach,      ///< motion of the rigid master along its direction [L]
  force,         ///< on the rigid master along its direction [F], of all symmetric copies together
  mean_pressure, ///< the same over the area of the slave surface [F/L^2]
};

using Materials = std::map<std::string, Material>;

/// All of these throw InputError naming file and key.
/// @param dimension  of the scene; in space "formulation" and "thickness" are no keys
ElementSetup read_formulation(JsonObject& scene, int dimension);

/// @param heat  "conductivity" and "expansion" are keys
Materials read_materials(const JsonValue& value, bool heat);

/// The keys of a part, without `finish`.
/// @param part    its `setup` has formulation and thickness
/// @param folder  of the scene: decks are named from there
/// @param others  elements that only the caller knows, in space
/// @return which of them it is; empty: a bulk element, or a deck
std::string read_part(JsonObject& object, int dimension, const Materials& materials,
                      const std::filesystem::path& folder, const std::vector<std::string>& others,
                      Part& part);

/// {"path": [[load factor, factor], ...]} of an object that may have one.
Path read_path(JsonObject& object);

/// The keys "nodes", "x", "y", "z" and "path" of a support, without `finish`.
/// @return false: no component is given
bool read_support(JsonObject& object, int dimension, Support& support);

std::vector<Traction> read_tractions(JsonObject& scene, int dimension);

/// One number per step; {"to": 3, "count": 40}: equal steps from the value before.
/// @param start  the value before the first step
std::vector<double> read_step_values(const JsonValue& values, double start);

/// The keys "control" and "values" of the steps, without `finish`.
/// @param movable  there is a rigid master that moves along a line
std::vector<double> read_steps(JsonObject& object, bool movable, Control& control);

/// The key "duration" of the steps: one time for all, or one of each; left out 1.
std::vector<double> read_durations(JsonObject& object, std::size_t steps);

/// Add the block or the deck of a part.
void add_part(Mesh& mesh, const Part& part, int index);

} // namespace host
