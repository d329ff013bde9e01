// SPDX-License-Identifier: BSD-3-Clause
#include "keys.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace host {
namespace {

Material read_material(const JsonValue& value, bool heat) {
  JsonObject object(value);
  Material material;
  material.law =
      object.at("law").choice<Material::Law>({{"linear_elastic", Material::Law::linear_elastic},
                                              {"st_venant_kirchhoff", Material::Law::st_venant_kirchhoff},
                                              {"neo_hooke", Material::Law::neo_hooke}});
  material.young = object.at("young").positive();
  material.poisson = object.at("poisson").number();
  if (!(material.poisson > -1 && material.poisson < 0.5))
    object.at("poisson").fail("Poisson's ratio lies between -1 and 0.5");
  if (heat && object.has("conductivity")) material.conductivity = object.at("conductivity").positive();
  if (heat && object.has("expansion")) {
    material.expansion = object.at("expansion").number();
    if (!(material.conductivity > 0))
      object.at("expansion").fail("a body that expands has a temperature: give its \"conductivity\"");
    if (material.law != Material::Law::linear_elastic)
      object.at("expansion").fail("expansion is for linear_elastic");
  }
  object.finish();
  return material;
}

/// {"from": 0, "pieces": [{"to": 1, "divisions": 10, "growth": 1.2}, ...]}
GridLines read_axis(const JsonValue& value) {
  JsonObject object(value);
  GridLines lines{object.at("from").number()};
  for (const JsonValue& item : object.at("pieces").items()) {
    JsonObject piece(item);
    const double to = piece.at("to").number();
    if (!(to > lines.back())) piece.at("to").fail("grid pieces run upwards: a number > the previous end");
    const int divisions = piece.at("divisions").integer(1, 100000);
    const double growth = piece.positive_or("growth", 1);
    piece.finish();
    if (lines.size() + static_cast<std::size_t>(divisions) > 1000000)
      piece.at("divisions").fail("an axis has at most 1000000 divisions");
    append_graded(lines, to, divisions, growth);
    if (!std::is_sorted(lines.begin(), lines.end(), std::less_equal<>{}) || !std::isfinite(lines.back()))
      item.fail("cells vanish: \"growth\" is too far from 1 for so many divisions");
  }
  object.finish();
  if (lines.size() < 2) value.fail("at least one piece is expected");
  return lines;
}

} // namespace

double Path::at(double load_factor) const {
  if (points.empty()) return load_factor;
  if (load_factor <= points.front()[0]) return points.front()[1];
  for (std::size_t i = 1; i < points.size(); ++i)
    if (load_factor <= points[i][0]) {
      const double t = (load_factor - points[i - 1][0]) / (points[i][0] - points[i - 1][0]);
      return (1 - t) * points[i - 1][1] + t * points[i][1];
    }
  return points.back()[1];
}

Path read_path(JsonObject& object) {
  Path path;
  if (!object.has("path")) return path;
  const JsonValue value = object.at("path");
  for (const JsonValue& item : value.items()) {
    const auto point = item.numbers(2);
    if (!path.points.empty() && !(point[0] > path.points.back()[0]))
      item.fail("load factors of a path ascend");
    path.points.push_back({point[0], point[1]});
  }
  if (path.points.empty()) value.fail("at least one point [load factor, factor] is expected");
  return path;
}

ElementSetup read_formulation(JsonObject& scene, int dimension) {
  ElementSetup setup; // in space: solid
  if (dimension == 3) return setup;
  setup.formulation = scene.at("formulation")
                          .choice<Formulation>({{"plane_strain", Formulation::plane_strain},
                                                {"plane_stress", Formulation::plane_stress},
                                                {"axisymmetric", Formulation::axisymmetric}});
  if (setup.formulation != Formulation::axisymmetric) setup.thickness = scene.positive_or("thickness", 1);
  return setup;
}

Materials read_materials(const JsonValue& value, bool heat) {
  Materials materials;
  JsonObject object(value);
  for (const std::string& name : object.all_keys()) {
    const Material& material = materials[name] = read_material(object.at(name), heat);
    if ((material.conductivity > 0) != (materials.begin()->second.conductivity > 0))
      object.at(name).fail("some materials have a \"conductivity\" and others none; give it to all of them");
  }
  return materials;
}

std::string read_part(JsonObject& object, int dimension, const Materials& materials,
                      const std::filesystem::path& folder, const std::vector<std::string>& others,
                      Part& part) {
  part.name = object.at("name").string();
  const JsonValue material = object.at("material");
  const auto found = materials.find(material.string());
  if (found == materials.end()) material.fail("no material \"" + material.string() + "\" in /materials");
  part.setup.material = found->second;
  if (object.has("deck")) {
    part.deck = folder / object.at("deck").string();
    part.deck_where = object.at("deck").where();
    part.element_set = object.string_or("element_set", "");
    return "";
  }
  const bool plane = dimension == 2;
  std::vector<std::string> words;
  for (const ElementTraits& type : element_types)
    if (type.dimension == dimension) words.emplace_back(type.name);
  if (!plane) words.insert(words.end(), others.begin(), others.end());
  const std::string word = object.at("element").word(words);
  const auto type = std::find_if(element_types.begin(), element_types.end(),
                                 [&](const ElementTraits& one) { return one.name == word; });
  if (type != element_types.end()) part.type = static_cast<ElementType>(type - element_types.begin());
  for (const char* axis : {"x", "y", "z"})
    if (axis != std::string("z") || !plane) part.lines.push_back(read_axis(object.at(axis)));
  if (part.setup.formulation == Formulation::axisymmetric && part.lines[0].front() < 0)
    object.at("x").fail("x is the radius of an axisymmetric body and starts at 0 or above");
  return type == element_types.end() ? word : "";
}

bool read_support(JsonObject& object, int dimension, Support& support) {
  static const char* const axes[] = {"x", "y", "z"};
  support.where = object.where();
  support.nodes = object.at("nodes").string();
  bool any = false;
  for (int i = 0; i < dimension; ++i) {
    auto& component = support.displacement.emplace_back();
    if (object.has(axes[i])) component = object.at(axes[i]).number(), any = true;
  }
  support.path = read_path(object);
  return any;
}

std::vector<Traction> read_tractions(JsonObject& scene, int dimension) {
  std::vector<Traction> tractions;
  if (!scene.has("tractions")) return tractions;
  for (const JsonValue& item : scene.at("tractions").items()) {
    JsonObject traction(item);
    tractions.push_back({traction.at("faces").string(), item.where(),
                         traction.at("value").numbers(static_cast<std::size_t>(dimension)),
                         read_path(traction)});
    traction.finish();
  }
  return tractions;
}

std::vector<double> read_step_values(const JsonValue& values, double start) {
  std::vector<double> steps;
  for (const JsonValue& item : values.items()) {
    if (!item.is_object()) {
      steps.push_back(item.number());
      continue;
    }
    JsonObject range(item);
    const double from = steps.empty() ? start : steps.back(), to = range.at("to").number();
    const int most = 1000000 - static_cast<int>(steps.size()); // of the run
    const int count = range.at("count").integer(1, std::max(most, 1));
    range.finish();
    for (int i = 1; i < count; ++i) steps.push_back(from + (to - from) * i / count);
    steps.push_back(to);
  }
  return steps;
}

std::vector<double> read_steps(JsonObject& object, bool movable, Control& control) {
  const JsonValue word = object.at("control");
  control = word.choice<Control>({{"load_factor", Control::load_factor},
                                  {"approach", Control::approach},
                                  {"force", Control::force},
                                  {"mean_pressure", Control::mean_pressure}});
  if (control != Control::load_factor && !movable)
    word.fail("only a rigid master can be moved; use load_factor");
  const JsonValue values = object.at("values");
  std::vector<double> steps = read_step_values(values, 0);
  if (steps.empty()) values.fail("at least one step is expected");
  if (control == Control::force || control == Control::mean_pressure)
    for (const double step : steps)
      if (!(step > 0)) values.fail("forces and pressures are > 0 in contact");
  return steps;
}

std::vector<double> read_durations(JsonObject& object, std::size_t steps) {
  if (!object.has("duration")) return std::vector<double>(steps, 1.0);
  const JsonValue value = object.at("duration");
  const std::vector<double> given =
      value.json().is_array() ? value.numbers(steps) : std::vector<double>(steps, value.number());
  for (const double duration : given)
    if (!(duration > 0)) value.fail("times above 0 are expected; left out a step takes 1");
  return given;
}

} // namespace host
