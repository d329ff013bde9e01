// SPDX-License-Identifier: BSD-3-Clause
// A scene: its supports, loads, steps and all keys of one line; parts and contact are in files of their own.
#include <algorithm>
#include <utility>

#include "scene_keys.hpp"

namespace host {
namespace {

SupportSpec read_support(const JsonValue& value, const Scene& scene, Formulation formulation) {
  static const std::vector<std::string> of_plane{"turn"}, of_space{"turn_x", "turn_y", "turn_z"};
  const auto d = static_cast<std::size_t>(scene.dimension);
  JsonObject object(value);
  SupportSpec support;
  const bool any = read_support(object, scene.dimension, support);
  const std::vector<std::string>& turns = d == 2 ? of_plane : of_space;
  std::vector<double> turn(turns.size(), 0.0);
  bool turned = false;
  for (std::size_t i = 0; i < turns.size(); ++i)
    if (object.has(turns[i])) turn[i] = object.at(turns[i]).number(), turned = true;
  if (!any && !turned)
    value.fail("give the displacement of at least one of the components x, y, z, or a turn: " +
               std::string(d == 2 ? "turn" : "turn_x, turn_y, turn_z"));
  if (turned) {
    if (formulation == Formulation::axisymmetric) value.fail("a body round an axis has no turns");
    const PartSpec* part = part_of_set(scene, support.nodes);
    if (part != nullptr && part->setup.material.law == Material::Law::linear_elastic)
      value.fail("a turn strains a body of linear_elastic; take st_venant_kirchhoff or neo_hooke for " +
                 part->name);
    support.turn = turn;
    for (auto& component : support.displacement) component = component.value_or(0); // all are held
    if (object.has("about")) {
      const std::vector<double> point = object.at("about").numbers(d);
      std::copy(point.begin(), point.end(), support.about.begin());
    }
  }
  object.finish();
  return support;
}

/// The key "history". Wear beside the motion of the mesh has to be one of them: a step that is cut would
/// slide twice as far.
void read_history(JsonObject& scene_object, Scene& scene) {
  const Json model = scene.contact ? scene.contact->model : Json();
  const Json parameters = find_json(model, "/parameters");
  const Json sliding = find_json(model, "/contact/wear/sliding");
  bool slides = false;
  if (scene_object.has("history")) {
    JsonObject object(scene_object.at("history"));
    for (const std::string& name : object.all_keys()) {
      const JsonValue values = object.at(name);
      if (!parameters.is_object() || !parameters.contains(name) || !parameters.at(name).is_number())
        values.fail("no parameter \"" + name + "\" of the contact's model; write {\"parameters\": {\"" +
                    name + "\": VALUE BEFORE THE FIRST STEP}} into /contact/model");
      const double start = parameters.at(name).get<double>();
      scene.history.push_back({name, read_step_values(values, start)});
      const std::vector<double>& read = scene.history.back().values;
      if (read.size() != scene.steps.size())
        values.fail("a value at the end of each step is expected: there are " +
                    std::to_string(scene.steps.size()) + " steps and " + std::to_string(read.size()) +
                    " values");
      if (sliding != name) continue;
      slides = true;
      for (std::size_t i = 0; i < read.size(); ++i)
        if (read[i] < (i == 0 ? start : read[i - 1]))
          values.fail("the distance slid until the end of each step is expected, which never falls");
    }
  }
  if (!sliding.is_null() && !slides)
    throw InputError(
        scene.contact->model_where +
        "/contact/wear/sliding: in a scene this is the name of a parameter, whose /history is the "
        "distance slid until the end of each step; an increment gets its share, also when a step is cut");
}

void read_steps(const JsonValue& value, Scene& scene) {
  JsonObject object(value);
  scene.steps = read_steps(object, scene.contact && !scene.contact->rigid.empty(), scene.control);
  scene.durations = read_durations(object, scene.steps.size());
  if (object.has("probe")) {
    const JsonValue probe = object.at("probe");
    scene.probe = probe.number();
    if (!(scene.probe > 0 && scene.probe <= 0.1))
      probe.fail("a part of the load is expected, above 0 and up to 0.1");
    if (scene.control == Control::load_factor)
      probe.fail("only steps of a rigid master that is moved have a conductance");
  }
  object.finish();
}

/// The keys "materials" and "parts".
Materials read_bodies(JsonObject& object, Scene& scene, const ElementSetup& common) {
  const Materials materials = read_materials(object.at("materials"), false);
  for (const JsonValue& item : object.at("parts").items()) {
    scene.parts.push_back(read_part(item, scene, materials, common));
    for (std::size_t i = 0; i + 1 < scene.parts.size(); ++i)
      if (scene.parts[i].name == scene.parts.back().name)
        item.fail("there is a part \"" + scene.parts[i].name + "\" already");
  }
  if (scene.parts.empty()) object.fail("\"parts\" is empty");
  return materials;
}

/// The keys "supports", "tractions", "springs", "periodic" and "tied".
void read_supports_and_loads(JsonObject& object, Scene& scene, Formulation formulation) {
  if (object.has("supports"))
    for (const JsonValue& item : object.at("supports").items())
      scene.supports.push_back(read_support(item, scene, formulation));
  scene.tractions = read_tractions(object, scene.dimension);
  if (object.has("springs"))
    for (const JsonValue& item : object.at("springs").items()) {
      JsonObject spring(item);
      const JsonValue stiffness = spring.at("stiffness");
      scene.springs.push_back({spring.at("faces").string(), item.where(),
                               stiffness.numbers(static_cast<std::size_t>(scene.dimension))});
      for (const double component : scene.springs.back().stiffness)
        if (component < 0) stiffness.fail("stiffnesses are >= 0");
      spring.finish();
    }
  for (const auto& [key, sides] : {std::pair{"periodic", &scene.periodic}, {"tied", &scene.tied}})
    if (object.has(key))
      for (const JsonValue& item : object.at(key).items()) {
        const auto pair = item.items();
        if (pair.size() != 2) item.fail("a pair of sides is expected");
        sides->push_back({pair[0].string(), pair[1].string(), item.where()});
      }
}

void read_half_space(const JsonValue& value, const Materials& materials, Scene& scene) {
  if (scene.dimension != 3 || (scene.control != Control::force && scene.control != Control::mean_pressure))
    value.fail("the half-space's displacement needs dimension 3 and steps that control force or pressure");
  JsonObject half_space(value);
  HalfSpaceSpec spec;
  spec.where = value.where();
  for (const JsonValue& item : half_space.at("nodes").items()) spec.nodes.push_back(item.string());
  spec.point = half_space.at("point").numbers(3);
  const JsonValue material = half_space.at("material");
  const auto found = materials.find(material.string());
  if (found == materials.end()) material.fail("no material \"" + material.string() + "\" in /materials");
  spec.material = found->second;
  half_space.finish();
  scene.half_space = spec;
}

void read_solver(const JsonValue& value, Scene& scene) {
  JsonObject solver(value);
  scene.solver.tolerance = solver.positive_or("tolerance", scene.solver.tolerance);
  if (!(scene.solver.tolerance < 1))
    solver.at("tolerance")
        .fail("a number < 1 is expected: the residual relative to the forces present, 1e-10 say");
  scene.solver.max_iterations = solver.integer_or("max_iterations", 2, 1000, scene.solver.max_iterations);
  scene.solver.min_step = solver.positive_or("min_step", scene.solver.min_step);
  scene.solver.segment_choices = solver.integer_or("segment_choices", 1, 1000, scene.solver.segment_choices);
  scene.solver.extrapolate = solver.boolean_or("extrapolate", scene.solver.extrapolate);
  if (scene.solver.extrapolate && scene.control != Control::load_factor)
    solver.at("extrapolate").fail("only with steps that control the load factor");
  scene.solver.gap_tolerance = solver.positive_or("gap_tolerance", scene.solver.gap_tolerance);
  scene.solver.max_augmentations =
      solver.integer_or("max_augmentations", 1, 10000, scene.solver.max_augmentations);
  if (solver.has("line_search"))
    scene.solver.line_search = solver.at("line_search")
                                   .choice<LineSearch>({{"when_needed", LineSearch::when_needed},
                                                        {"always", LineSearch::always},
                                                        {"never", LineSearch::never}});
  solver.finish();
}

/// The keys that change nothing of the solution: words, and what the scene is compared with.
void read_beside(JsonObject& object, Scene& scene) {
  if (object.has("units")) {
    JsonObject units(object.at("units"));
    scene.units = {units.string_or("length", ""), units.string_or("force", ""),
                   units.string_or("pressure", "")};
    units.finish();
  }
  if (object.has("compare")) {
    JsonObject compare(object.at("compare"));
    for (const JsonValue& item : compare.at("divisions").items())
      scene.compare.divisions.push_back(item.integer(1, 100000));
    scene.compare.error = compare.positive_or("error", scene.compare.error);
    compare.finish();
  }
  if (object.has("variants")) {
    JsonObject variants(object.at("variants"));
    for (const std::string& name : variants.all_keys()) {
      const JsonValue patch = variants.at(name);
      if (!patch.is_object()) patch.fail("an object is expected: the keys of the scene that change");
      scene.variants.push_back({name, patch.json()});
    }
  }
}

/// @param variant  its name, for messages; empty: the scene as it is
Scene read(const Json& json, const std::filesystem::path& file, const std::string& variant = {}) {
  Scene scene;
  scene.file = file;
  scene.definition = json;
  JsonObject object(JsonValue(json, file.string() + ": " + (variant.empty() ? "" : "/variants/" + variant)));
  scene.title = object.string_or("title", file.parent_path().filename().string());
  scene.dimension = object.at("dimension").integer(2, 3);
  const ElementSetup common = read_formulation(object, scene.dimension);
  const Materials materials = read_bodies(object, scene, common);
  read_supports_and_loads(object, scene, common.formulation);
  if (object.has("contact")) scene.contact = read_contact(object.at("contact"), scene.dimension);
  scene.symmetry_copies = object.integer_or("symmetry_copies", 1, 64, 1);
  read_steps(object.at("steps"), scene);
  read_history(object, scene);
  if (object.has("half_space")) read_half_space(object.at("half_space"), materials, scene);
  if (scene.parts.front().layer || scene.parts.back().layer) check_scene_of_layer(scene);
  if (object.has("exact")) scene.exact = read_exact(object.at("exact"), scene);
  if (object.has("solver")) read_solver(object.at("solver"), scene);
  read_beside(object, scene);
  object.finish();
  return scene;
}

} // namespace

Scene read_scene(const std::filesystem::path& file, const std::string& variant) {
  Scene wanted = read(read_variant(file, {}), file);
  bool found = variant.empty();
  const std::vector<Variant> variants = wanted.variants;
  for (const Variant& candidate :
       variants) { // all are read: a mistake in one shall not wait until it is asked for
    Scene scene = read(read_variant(file, candidate.name), file, candidate.name);
    scene.title += ", " + candidate.name;
    if (candidate.name == variant) wanted = std::move(scene), found = true;
  }
  if (!found) read_variant(file, variant); // names those that there are
  return wanted;
}

Scene read_scene_text(const std::string& text, const std::filesystem::path& file) {
  return read(parse_json(text, file.string()), file);
}

} // namespace host
