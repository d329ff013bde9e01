// SPDX-License-Identifier: BSD-3-Clause
#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

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
/// A word that the laboratory knows, too.
std::string word(const JsonValue& value, std::vector<std::string> own, const std::vector<std::string>& more) {
  std::vector<std::string> all = own;
  all.insert(all.end(), more.begin(), more.end());
  const std::string found = value.word(all);
  if (std::find(more.begin(), more.end(), found) != more.end())
    leave_to_laboratory(value.where() + ": \"" + found + "\"");
  return found;
}

Material read_material(const JsonValue& value) {
  static const std::map<std::string, Material::Law> laws{
      {"linear_elastic", Material::Law::linear_elastic},
      {"st_venant_kirchhoff", Material::Law::st_venant_kirchhoff},
      {"neo_hooke", Material::Law::neo_hooke}};
  JsonObject object(value);
  Material material;
  material.law = laws.at(object.at("law").word({"linear_elastic", "st_venant_kirchhoff", "neo_hooke"}));
  material.young = object.at("young").positive();
  material.poisson = object.at("poisson").number();
  if (!(material.poisson > -1 && material.poisson < 0.5))
    object.at("poisson").fail("Poisson's ratio lies between -1 and 0.5");
  if (object.has("conductivity")) material.conductivity = object.at("conductivity").positive();
  if (object.has("expansion")) {
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
    append_graded(lines, to, piece.at("divisions").integer(1, 100000), piece.positive_or("growth", 1));
    piece.finish();
    if (!std::is_sorted(lines.begin(), lines.end(), std::less_equal<>{}) || !std::isfinite(lines.back()))
      item.fail("cells vanish: \"growth\" is too far from 1 for so many divisions");
  }
  object.finish();
  if (lines.size() < 2) value.fail("at least one piece is expected");
  return lines;
}

Part read_part(const JsonValue& value, const Scene& scene, const std::map<std::string, Material>& materials,
               const ElementSetup& common) {
  static const std::map<std::string, ElementType> types{{"tri3", ElementType::tri3},
                                                        {"quad4", ElementType::quad4},
                                                        {"tet4", ElementType::tet4},
                                                        {"hex8", ElementType::hex8}};
  JsonObject object(value);
  leave_keys(object, {"crown"});
  Part part;
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
    const bool plane = scene.dimension == 2;
    part.type = types.at(plane ? object.at("element").word({"tri3", "quad4"})
                               : word(object.at("element"), {"tet4", "hex8"}, {"layer"}));
    for (const char* axis : {"x", "y", "z"})
      if (axis != std::string("z") || !plane) part.lines.push_back(read_axis(object.at(axis)));
    if (common.formulation == Formulation::axisymmetric && part.lines[0].front() < 0)
      object.at("x").fail("x is the radius of an axisymmetric body and starts at 0 or above");
  }
  object.finish();
  return part;
}

Support read_support(const JsonValue& value, int dimension, bool heat) {
  static const char* const axes[] = {"x", "y", "z"};
  JsonObject object(value);
  leave_keys(object, {"turn", "turn_x", "turn_y", "turn_z", "about"});
  Support support;
  support.where = value.where();
  support.nodes = object.at("nodes").string();
  bool any = false;
  for (int i = 0; i < dimension; ++i) {
    support.displacement.emplace_back();
    if (object.has(axes[i])) support.displacement.back() = object.at(axes[i]).number(), any = true;
  }
  if (heat && object.has("temperature")) support.temperature = object.at("temperature").number(), any = true;
  if (!any)
    value.fail(heat ? "give the displacement of at least one of the components x, y, z, or the temperature"
                    : "give the displacement of at least one of the components x, y, z");
  support.path = read_path(object);
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
      contact.ends = master.at("ends").word({"repeated", "straight", "quasi_cubic", "quasi_parabolic"});
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
  if (heat.contains("friction"))
    model.fail(
        "friction heats in time, and the steps of a scene have none; leave \"friction\" out of \"heat\"");
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

/// One number per step; {"to": 3, "count": 40}: equal steps from the value before.
std::vector<double> read_step_values(const JsonValue& values) {
  std::vector<double> steps;
  for (const JsonValue& item : values.items()) {
    if (!item.is_object()) {
      steps.push_back(item.number());
      continue;
    }
    JsonObject range(item);
    const double from = steps.empty() ? 0 : steps.back(), to = range.at("to").number();
    const int count = range.at("count").integer(1, 1000000);
    range.finish();
    for (int i = 1; i < count; ++i) steps.push_back(from + (to - from) * i / count);
    steps.push_back(to);
  }
  if (steps.empty()) values.fail("at least one step is expected");
  return steps;
}

void read_steps(const JsonValue& value, Scene& scene) {
  JsonObject object(value);
  const JsonValue control = object.at("control");
  static const std::map<std::string, Control> controls{{"load_factor", Control::load_factor},
                                                       {"approach", Control::approach},
                                                       {"force", Control::force},
                                                       {"mean_pressure", Control::mean_pressure}};
  scene.control = controls.at(control.word({"load_factor", "approach", "force", "mean_pressure"}));
  if (scene.control != Control::load_factor && (!scene.contact || scene.contact->rigid.empty()))
    control.fail("only a rigid master can be moved; use load_factor");
  const JsonValue values = object.at("values");
  scene.steps = read_step_values(values);
  for (const double step : scene.steps)
    if (scene.by_force() && !(step > 0)) values.fail("forces and pressures are > 0 in contact");
  object.finish();
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
  ElementSetup common;
  if (scene.dimension == 2) {
    const std::string name = object.at("formulation").word({"plane_strain", "plane_stress", "axisymmetric"});
    common.formulation = name == "plane_strain"   ? Formulation::plane_strain
                         : name == "plane_stress" ? Formulation::plane_stress
                                                  : Formulation::axisymmetric;
    if (name != "axisymmetric") common.thickness = object.positive_or("thickness", 1);
  }
  std::map<std::string, Material> materials;
  JsonObject all(object.at("materials"));
  for (const std::string& name : all.all_keys()) {
    const Material& material = materials[name] = read_material(all.at(name));
    if (materials.size() > 1 && scene.heat != (material.conductivity > 0))
      all.at(name).fail("some materials have a \"conductivity\" and others none; give it to all of them");
    scene.heat = material.conductivity > 0;
  }
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
  if (object.has("tractions"))
    for (const JsonValue& item : object.at("tractions").items()) {
      JsonObject traction(item);
      scene.tractions.push_back({traction.at("faces").string(), item.where(),
                                 traction.at("value").numbers(static_cast<std::size_t>(scene.dimension)),
                                 read_path(traction)});
      traction.finish();
    }
  if (object.has("contact")) scene.contact = read_contact(object.at("contact"), scene);
  scene.symmetry_copies = object.integer_or("symmetry_copies", 1, 64, 1);
  read_steps(object.at("steps"), scene);
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
  Json json = parse_json_file(file);
  if (variant.empty()) return read(json, file);
  const Json variants = find_json(json, "/variants");
  if (!variants.is_object() || !variants.contains(variant)) {
    std::string names;
    for (const auto& item : variants.items()) names += (names.empty() ? "" : ", ") + item.key();
    throw InputError(file.string() + ": no variant \"" + variant +
                     "\" in /variants; there are: " + (names.empty() ? "none" : names));
  }
  json.merge_patch(variants.at(variant)); // RFC 7386
  Scene scene = read(json, file);
  scene.title += ", " + variant;
  return scene;
}

} // namespace host
