// SPDX-License-Identifier: BSD-3-Clause
#include "scene.hpp"

#include <cmath>

namespace host {
namespace {

/// Keys of scenes that ents-lab reads and this program does not.
[[noreturn]] void leave_to_laboratory(const std::string& where) {
  throw NeedsLaboratory(where + " is solved by the laboratory");
}
void leave_keys(JsonObject& object, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (object.has(key)) leave_to_laboratory(object.where() + "/" + key);
}
Part read_part(const JsonValue& value, const Scene& scene, const Materials& materials,
               const ElementSetup& common) {
  JsonObject object(value);
  leave_keys(object, {"crown"});
  Part part;
  part.setup = common;
  const std::string other =
      read_part(object, scene.dimension, materials, scene.file.parent_path(), {"layer"}, part);
  if (!other.empty()) leave_to_laboratory(value.where() + "/element: \"" + other + "\"");
  object.finish();
  return part;
}

Support read_support(const JsonValue& value, int dimension, bool heat) {
  JsonObject object(value);
  leave_keys(object, {"turn", "turn_x", "turn_y", "turn_z", "about"});
  Support support;
  bool any = read_support(object, dimension, support);
  if (heat && object.has("temperature")) support.temperature = object.at("temperature").number(), any = true;
  if (!any)
    value.fail(std::string("give the displacement of at least one of the components x, y, z") +
               (heat ? ", or the temperature" : ""));
  object.finish();
  return support;
}

void read_master(const JsonValue& value, int dimension, bool heat, ContactInput& contact) {
  const auto d = static_cast<std::size_t>(dimension);
  JsonObject master(value);
  leave_keys(master, {"rigid_body", "mirror"});
  if (master.has("faces")) {
    contact.master = master.at("faces").string();
    contact.master_where = master.at("faces").where();
    if (master.has("ends"))
      contact.ends = master.at("ends").choice<std::int32_t>({{"repeated", ENTS_ENDS_REPEATED},
                                                             {"straight", ENTS_ENDS_STRAIGHT},
                                                             {"quasi_cubic", ENTS_ENDS_QUASI_CUBIC},
                                                             {"quasi_parabolic", ENTS_ENDS_QUASI_PARABOLIC}});
    if (master.has("surface_coordinates")) {
      const JsonValue rule = master.at("surface_coordinates");
      if (!rule.is_array()) leave_to_laboratory(rule.where());
      for (const JsonValue& axis : rule.items()) {
        const std::string name = axis.word({"x", "y", "z"});
        contact.coordinate_axes.push_back(name[0] - 'x');
      }
      if (contact.coordinate_axes.size() + 1 != d)
        rule.fail("one axis per direction of the surface is expected");
    }
  } else {
    for (const JsonValue& item : master.at("nodes").items())
      for (const double x : item.numbers(d)) contact.rigid.push_back(x);
    if (heat && master.has("temperature")) contact.temperature = master.at("temperature").number();
    const JsonValue direction = master.at("direction");
    contact.direction = direction.numbers(d);
    double squared = 0;
    for (const double component : contact.direction) squared += component * component;
    if (!(squared > 0)) direction.fail("the direction of the master's motion must not be zero");
    for (double& component : contact.direction) component /= std::sqrt(squared);
  }
  master.finish();
}

ContactInput read_contact(const JsonValue& value, const Scene& scene) {
  const int dimension = scene.dimension;
  JsonObject object(value);
  leave_keys(object,
             {"law", "cut_off", "enrichment", "wear_factor", "areas", "slave_height", "two_pass", "below"});
  ContactInput contact;
  contact.temperature = scene.temperature;
  contact.slave = object.at("slave").string();
  contact.slave_where = object.at("slave").where();
  if (object.has("sampling")) {
    const JsonValue sampling = object.at("sampling");
    if (!sampling.is_number()) leave_to_laboratory(sampling.where());
    contact.sampling = sampling.integer(1, 64);
  }
  read_master(object.at("master"), dimension, scene.heat, contact);
  if (contact.slave == contact.master)
    leave_to_laboratory(contact.slave_where + ": a surface in contact with itself");
  const JsonValue model = object.at("model");
  if (!model.is_object()) model.fail("an object is expected: the library's model");
  contact.model = model.json();
  contact.model_where = model.where();
  const Json heat = find_json(contact.model, "/contact/heat");
  if (!heat.is_null() && !scene.heat)
    model.fail("\"heat\" is for bodies with temperatures; give each of /materials a \"conductivity\"");
  // One place says whether the master is rigid: the scene.
  contact.model["master"] = contact.rigid.empty() ? "deformable" : "rigid";
  if (model.json().contains("master") && model.json().at("master") != contact.model["master"])
    model.fail("\"master\" contradicts the scene's master; leave it out here");
  // Plain faces of a body reach beyond their edges, as master faces of common codes do; smoothed ones need not.
  const Json segment = find_json(contact.model, "/segment");
  if (!contact.master.empty() && !contact.model.contains("border") && segment.is_string() &&
      !is_smoothed(segment.get<std::string>()))
    contact.model["border"] = 0.1;
  object.finish();
  return contact;
}

void read_solver(const JsonValue& value, Scene& scene) {
  JsonObject solver(value);
  leave_keys(solver, {"extrapolate", "segment_choices", "gap_tolerance", "max_augmentations", "line_search"});
  scene.tolerance = solver.positive_or("tolerance", scene.tolerance);
  scene.max_iterations = solver.integer_or("max_iterations", 2, 1000, scene.max_iterations);
  scene.min_step = solver.positive_or("min_step", scene.min_step);
  solver.finish();
}

void read_bodies(JsonObject& object, Scene& scene) {
  const ElementSetup common = read_formulation(object, scene.dimension);
  const Materials materials = read_materials(object.at("materials"), true);
  scene.heat = !materials.empty() && materials.begin()->second.conductivity > 0;
  if (scene.heat && object.has("temperature")) scene.temperature = object.at("temperature").number();
  for (const JsonValue& item : object.at("parts").items())
    scene.parts.push_back(read_part(item, scene, materials, common));
  if (scene.parts.empty()) object.fail("\"parts\" is empty");
}

Scene read(const Json& json, const std::filesystem::path& file) {
  Scene scene;
  scene.file = file;
  JsonObject object(JsonValue(json, file.string() + ": "));
  leave_keys(object, {"springs", "periodic", "tied", "half_space", "history"});
  scene.title = object.string_or("title", file.parent_path().filename().string());
  scene.dimension = object.at("dimension").integer(2, 3);
  read_bodies(object, scene);
  if (object.has("supports"))
    for (const JsonValue& item : object.at("supports").items())
      scene.supports.push_back(read_support(item, scene.dimension, scene.heat));
  scene.tractions = read_tractions(object, scene.dimension);
  if (object.has("contact")) scene.contact = read_contact(object.at("contact"), scene);
  scene.symmetry_copies = object.integer_or("symmetry_copies", 1, 64, 1);
  JsonObject steps(object.at("steps"));
  leave_keys(steps, {"probe"});
  scene.steps = read_steps(steps, scene.contact && !scene.contact->rigid.empty(), scene.control);
  scene.durations = read_durations(steps, scene.steps.size());
  steps.finish();
  if (object.has("units")) {
    JsonObject units(object.at("units"));
    scene.unit_of_length = units.string_or("length", ""), scene.unit_of_force = units.string_or("force", "");
    scene.unit_of_pressure = units.string_or("pressure", "");
    units.finish();
  }
  if (object.has("solver")) read_solver(object.at("solver"), scene);
  for (const char* compared : {"exact", "compare", "variants"}) object.has(compared); // of other programs
  object.finish();
  return scene;
}

} // namespace

bool is_smoothed(const std::string& segment) {
  return segment.starts_with("catmull_rom") || segment.starts_with("bspline") || segment == "bezier15";
}

Scene read_scene(const std::filesystem::path& file, const std::string& variant) {
  Scene scene = read(read_variant(file, variant), file);
  if (!variant.empty()) scene.title += ", " + variant;
  return scene;
}

} // namespace host
