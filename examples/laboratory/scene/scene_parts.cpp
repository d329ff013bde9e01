// SPDX-License-Identifier: BSD-3-Clause
// Keys of a scene's bodies: materials and parts.
#include <algorithm>
#include <cmath>

#include "scene_keys.hpp"

namespace host {
namespace {

Material read_material(const JsonValue& value) {
  JsonObject object(value);
  Material material;
  const std::string law = object.at("law").word({"linear_elastic", "st_venant_kirchhoff", "neo_hooke"});
  material.law = law == "neo_hooke"             ? Material::Law::neo_hooke
                 : law == "st_venant_kirchhoff" ? Material::Law::st_venant_kirchhoff
                                                : Material::Law::linear_elastic;
  material.young = object.at("young").positive();
  material.poisson = object.at("poisson").number();
  if (!(material.poisson > -1 && material.poisson < 0.5))
    object.at("poisson").fail("Poisson's ratio lies between -1 and 0.5");
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

/// A layer has equal cells on its surface, none below, and a compliance in closed form.
void check_layer(JsonObject& part, const PartSpec& read) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const GridLines& line = read.lines[axis];
    const double cell = (line.back() - line.front()) / static_cast<double>(line.size() - 1);
    for (std::size_t i = 1; i < line.size(); ++i)
      if (std::abs(line[i] - line[i - 1] - cell) > 1e-9 * cell)
        part.at(axis == 0 ? "x" : "y").fail("a layer has equal cells: give one piece, without \"growth\"");
    if (line.size() < 3) part.at(axis == 0 ? "x" : "y").fail("a layer has two cells or more along x and y");
  }
  if (read.lines[2].size() != 2)
    part.at("z").fail(
        "a layer has nodes on its surface alone: give one piece with \"divisions\": 1, its thickness");
  if (read.setup.material.law != Material::Law::linear_elastic)
    part.at("material").fail("a layer is linear_elastic");
}

/// {"radius": 1, "across": "x"}
Crown read_crown(const JsonValue& value, const PartSpec& part) {
  if (part.layer) value.fail("the surface of a layer is flat; take hex8");
  JsonObject object(value);
  Crown crown;
  crown.radius = object.at("radius").positive();
  if (part.lines.size() == 3 && object.has("across"))
    crown.axis = object.at("across").word({"x", "y"}) == "x" ? 0 : 1;
  object.finish();
  const GridLines &across = part.lines[static_cast<std::size_t>(crown.axis)], &up = part.lines.back();
  const double widest = std::max(std::abs(across.front()), std::abs(across.back()));
  if (!(widest < crown.radius) ||
      !(crown.radius - std::sqrt(crown.radius * crown.radius - widest * widest) < up.back() - up.front()))
    value.fail("the cylinder does not cover the block: a larger radius, or a narrower or higher block");
  return crown;
}

} // namespace

Materials read_materials(const JsonValue& value) {
  Materials materials;
  JsonObject object(value);
  for (const std::string& name : object.all_keys()) materials[name] = read_material(object.at(name));
  return materials;
}

PartSpec read_part(const JsonValue& value, const Scene& scene, const Materials& materials,
                   const ElementSetup& common) {
  JsonObject object(value);
  PartSpec part;
  part.where = value.where();
  part.name = object.at("name").string();
  part.setup = common;
  const JsonValue material = object.at("material");
  const auto found = materials.find(material.string());
  if (found == materials.end()) material.fail("no material \"" + material.string() + "\" in /materials");
  part.setup.material = found->second;
  if (object.has("deck")) {
    part.deck = scene.file.parent_path() / object.at("deck").string();
    part.deck_where = object.at("deck").where();
    part.element_set = object.string_or("element_set", "");
  } else {
    static const std::map<std::string, ElementType> types{{"tri3", ElementType::tri3},
                                                          {"quad4", ElementType::quad4},
                                                          {"tet4", ElementType::tet4},
                                                          {"hex8", ElementType::hex8}};
    const bool plane = scene.dimension == 2;
    const JsonValue element = object.at("element");
    const std::string word = element.word(plane ? std::vector<std::string>{"tri3", "quad4"}
                                                : std::vector<std::string>{"tet4", "hex8", "layer"});
    part.layer = word == "layer";
    if (!part.layer) part.type = types.at(word);
    part.lines = {read_axis(object.at("x")), read_axis(object.at("y"))};
    if (!plane) part.lines.push_back(read_axis(object.at("z")));
    if (common.formulation == Formulation::axisymmetric && part.lines[0].front() < 0)
      object.at("x").fail("x is the radius of an axisymmetric body and starts at 0 or above");
    if (part.layer) check_layer(object, part);
    if (object.has("crown")) part.crown = read_crown(object.at("crown"), part);
  }
  object.finish();
  return part;
}

void check_scene_of_layer(const Scene& scene) {
  const auto fail = [&](const std::string& key, const std::string& text) {
    throw InputError(scene.file.string() + ": " + key + ": with \"element\": \"layer\" " + text);
  };
  if (scene.parts.size() > 1) fail("/parts", "there is one part; take hex8 for several");
  if (!scene.supports.empty())
    fail("/supports",
         "there are none; leave the key out: the base is held and the sides are planes of symmetry");
  if (!scene.periodic.empty()) fail("/periodic", "sides are planes of symmetry; take hex8");
  if (!scene.springs.empty()) fail("/springs", "there are none; take hex8");
  if (!scene.tractions.empty()) fail("/tractions", "there are none; take hex8");
  if (scene.half_space) fail("/half_space", "the base is held; take a thick layer, or hex8");
  if (!scene.contact || scene.contact->rigid.empty() || std::abs(scene.contact->direction[2] + 1) > 1e-12)
    fail("/contact/master", "there is a rigid master that moves down: \"direction\": [0, 0, -1]");
  if (scene.contact->model.contains(Json::json_pointer("/contact/friction")))
    fail("/contact/model/contact/friction", "there is no friction: its nodes move along z alone");
}

const PartSpec* part_of_set(const Scene& scene, const std::string& set) {
  const PartSpec* found = nullptr; // names may have dots: the longest decides
  for (const PartSpec& part : scene.parts)
    if ((set == part.name || set.starts_with(part.name + ".")) &&
        (found == nullptr || part.name.size() > found->name.size()))
      found = &part;
  return found;
}

} // namespace host
