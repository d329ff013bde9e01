// SPDX-License-Identifier: BSD-3-Clause
// Keys of a scene's bodies that the reference host leaves to the laboratory.
#include <algorithm>
#include <cmath>

#include "scene_keys.hpp"

namespace host {
namespace {

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

PartSpec read_part(const JsonValue& value, const Scene& scene, const Materials& materials,
                   const ElementSetup& common) {
  JsonObject object(value);
  PartSpec part;
  part.where = value.where();
  part.setup = common;
  part.layer =
      !read_part(object, scene.dimension, materials, scene.file.parent_path(), {"layer"}, part).empty();
  if (part.layer) check_layer(object, part);
  if (!part.lines.empty() && object.has("crown")) part.crown = read_crown(object.at("crown"), part);
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
