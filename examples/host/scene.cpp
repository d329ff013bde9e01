// SPDX-License-Identifier: BSD-3-Clause
#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace host {
namespace {

using Materials = std::map<std::string, Material>;

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

Formulation read_formulation(JsonObject& scene, int dimension) {
  if (dimension == 3) return Formulation::solid;
  const std::string word = scene.at("formulation").word({"plane_strain", "plane_stress", "axisymmetric"});
  return word == "plane_strain"   ? Formulation::plane_strain
         : word == "plane_stress" ? Formulation::plane_stress
                                  : Formulation::axisymmetric;
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

/// Nothing else fits beside a layer: its supports are its own, and it knows no forces along its surface.
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
  }
  object.finish();
  return part;
}

/// [[load factor, factor], ...]
SupportSpec read_support(const JsonValue& value, int dimension) {
  static constexpr std::array<const char*, 3> axes{"x", "y", "z"};
  JsonObject object(value);
  SupportSpec support;
  support.where = value.where();
  support.nodes = object.at("nodes").string();
  bool any = false;
  for (int i = 0; i < dimension; ++i) {
    const char* axis = axes[static_cast<std::size_t>(i)];
    auto& component = support.displacement.emplace_back();
    if (object.has(axis)) component = object.at(axis).number(), any = true;
  }
  if (!any) value.fail("give the displacement of at least one of the components x, y, z");
  support.path = read_path(object);
  object.finish();
  return support;
}

/// Rows of `dimension` numbers, one per node.
std::vector<double> read_nodes(const JsonValue& value, int dimension) {
  std::vector<double> nodes;
  for (const JsonValue& item : value.items()) {
    const auto node = item.numbers(static_cast<std::size_t>(dimension));
    nodes.insert(nodes.end(), node.begin(), node.end());
  }
  if (nodes.empty()) value.fail("an array of node positions is expected");
  return nodes;
}

ContactSpec read_contact(const JsonValue& value, int dimension) {
  JsonObject object(value);
  ContactSpec contact;
  contact.slave = object.at("slave").string();
  contact.slave_where = object.at("slave").where();
  if (object.has("sampling")) read_sampling(object.at("sampling"), contact);
  if (object.has("areas")) {
    const JsonValue areas = object.at("areas");
    contact.equal_areas = areas.word({"tributary", "equal"}) == "equal";
    if (contact.equal_areas && (contact.sampling > 0 || contact.cut > 0))
      areas.fail("sampling points have areas of their own; leave it out");
  }
  if (object.has("enrichment"))
    contact.gap_only = object.at("enrichment").word({"full", "gap_only"}) == "gap_only";
  if (object.has("cut_off")) read_cut_off(object.at("cut_off"), contact);
  if (object.has("wear_factor")) {
    const JsonValue table = object.at("wear_factor");
    for (const JsonValue& item : table.items()) {
      const std::vector<double> point = item.numbers(2);
      if (point[0] < 0 || point[1] < 0) item.fail("[pressure, factor] are not negative");
      if (!contact.wear_factor.points.empty() && !(point[0] > contact.wear_factor.points.back()[0]))
        item.fail("pressures ascend");
      contact.wear_factor.points.push_back({point[0], point[1]});
    }
    if (contact.wear_factor.points.empty() || find_json(object.at("model").json(), "/contact/wear").is_null())
      table.fail("[[pressure, factor], ...] is expected, and a model with contact.wear");
  }
  JsonObject master(object.at("master"));
  if (master.has("faces")) {
    contact.master = master.at("faces").string();
    contact.master_where = master.at("faces").where();
    read_ends(master, dimension, contact);
    if (master.has("surface_coordinates")) {
      const JsonValue axes = master.at("surface_coordinates");
      for (const JsonValue& item : axes.items()) {
        const std::string axis = item.word(dimension == 2 ? std::vector<std::string>{"x", "y"}
                                                          : std::vector<std::string>{"x", "y", "z"});
        contact.surface_axes.push_back(axis == "x" ? 0 : axis == "y" ? 1 : 2);
      }
      if (static_cast<int>(contact.surface_axes.size()) != dimension - 1)
        axes.fail("one reference coordinate per surface coordinate is expected: " +
                  std::to_string(dimension - 1));
    }
  } else if (master.has("rigid_body")) {
    const Json segment = find_json(object.at("model").json(), "/segment");
    contact.body = read_rigid_body(master.at("rigid_body"), dimension,
                                   segment.is_string() ? segment.get<std::string>() : std::string());
  } else {
    contact.rigid = read_nodes(master.at("nodes"), dimension);
    const JsonValue direction = master.at("direction");
    contact.direction = direction.numbers(static_cast<std::size_t>(dimension));
    double squared = 0;
    for (const double component : contact.direction) squared += component * component;
    if (!(squared > 0)) direction.fail("the direction of the master's motion must not be zero");
    for (double& component : contact.direction) component /= std::sqrt(squared);
  }
  master.finish();
  const JsonValue model = object.at("model");
  if (!model.is_object()) model.fail("an object is expected: the library's model");
  contact.model = model.json();
  contact.model_where = model.where();
  // One place says whether the master is rigid: the scene.
  contact.model["master"] = contact.rigid.empty() && !contact.body ? "deformable" : "rigid";
  if (model.json().contains("master") && model.json().at("master") != contact.model["master"])
    model.fail("\"master\" contradicts the scene's master; leave it out here");
  if (contact.gap_only) {
    const char* of = find_json(contact.model, "/height").is_null() ? "a model with a \"height\""
                     : contact.cut > 0                             ? "no \"sampling\": \"cut\""
                     : contact.model.contains("parameters")        ? "a model without \"parameters\""
                                                                   : nullptr;
    if (of) object.at("enrichment").fail(std::string("\"gap_only\" needs ") + of);
  }
  check_cut_off(contact);
  object.finish();
  return contact;
}

/// One number per step; {"to": 3, "count": 40}: equal steps from the value before.
/// @param start  the value before the first step
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
  static const std::map<std::string, Control> controls{{"load_factor", Control::load_factor},
                                                       {"approach", Control::approach},
                                                       {"force", Control::force},
                                                       {"mean_pressure", Control::mean_pressure}};
  JsonObject object(value);
  const JsonValue control = object.at("control");
  scene.control = controls.at(control.word({"load_factor", "approach", "force", "mean_pressure"}));
  if (scene.control != Control::load_factor && (!scene.contact || scene.contact->rigid.empty()))
    control.fail("only a rigid master can be moved; use load_factor");
  const JsonValue values = object.at("values");
  scene.steps = read_step_values(values, 0);
  if (scene.steps.empty()) values.fail("at least one step is expected");
  if (scene.control == Control::force || scene.control == Control::mean_pressure)
    for (const double step : scene.steps)
      if (!(step > 0)) values.fail("forces and pressures are > 0 in contact");
  object.finish();
}

/// @param variant  its name, for messages; empty: the scene as it is
Scene read(const Json& json, const std::filesystem::path& file, const std::string& variant = {}) {
  Scene scene;
  scene.file = file;
  scene.definition = json;
  JsonObject object(JsonValue(json, file.string() + ": " + (variant.empty() ? "" : "/variants/" + variant)));
  scene.title = object.string_or("title", file.parent_path().filename().string());
  scene.dimension = object.at("dimension").integer(2, 3);
  ElementSetup common;
  common.formulation = read_formulation(object, scene.dimension);
  if (scene.dimension == 2 && common.formulation != Formulation::axisymmetric)
    common.thickness = object.positive_or("thickness", 1);

  Materials materials;
  JsonObject material_object(object.at("materials"));
  for (const std::string& name : material_object.all_keys())
    materials[name] = read_material(material_object.at(name));
  for (const JsonValue& item : object.at("parts").items()) {
    scene.parts.push_back(read_part(item, scene, materials, common));
    for (std::size_t i = 0; i + 1 < scene.parts.size(); ++i)
      if (scene.parts[i].name == scene.parts.back().name)
        item.fail("there is a part \"" + scene.parts[i].name + "\" already");
  }
  if (scene.parts.empty()) object.fail("\"parts\" is empty");
  if (object.has("supports"))
    for (const JsonValue& item : object.at("supports").items())
      scene.supports.push_back(read_support(item, scene.dimension));
  if (object.has("tractions"))
    for (const JsonValue& item : object.at("tractions").items()) {
      JsonObject traction(item);
      scene.tractions.push_back({traction.at("faces").string(), item.where(),
                                 traction.at("value").numbers(static_cast<std::size_t>(scene.dimension)),
                                 read_path(traction)});
      traction.finish();
    }
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
  if (object.has("contact")) scene.contact = read_contact(object.at("contact"), scene.dimension);
  scene.symmetry_copies = object.integer_or("symmetry_copies", 1, 64, 1);
  read_steps(object.at("steps"), scene);
  read_history(object, scene);
  if (object.has("half_space")) {
    const JsonValue value = object.at("half_space");
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
  if (scene.parts.front().layer || scene.parts.back().layer) check_scene_of_layer(scene);
  if (object.has("exact")) scene.exact = read_exact(object.at("exact"), scene);
  if (object.has("units")) {
    JsonObject units(object.at("units"));
    scene.units = {units.string_or("length", ""), units.string_or("force", ""),
                   units.string_or("pressure", "")};
    units.finish();
  }
  if (object.has("solver")) {
    JsonObject solver(object.at("solver"));
    scene.solver.tolerance = solver.positive_or("tolerance", scene.solver.tolerance);
    if (!(scene.solver.tolerance < 1))
      solver.at("tolerance")
          .fail("a number < 1 is expected: the residual relative to the forces present, 1e-10 say");
    scene.solver.max_iterations = solver.integer_or("max_iterations", 2, 1000, scene.solver.max_iterations);
    scene.solver.min_step = solver.positive_or("min_step", scene.solver.min_step);
    scene.solver.segment_choices =
        solver.integer_or("segment_choices", 1, 1000, scene.solver.segment_choices);
    scene.solver.extrapolate = solver.boolean_or("extrapolate", scene.solver.extrapolate);
    if (scene.solver.extrapolate && scene.control != Control::load_factor)
      solver.at("extrapolate").fail("only with steps that control the load factor");
    scene.solver.gap_tolerance = solver.positive_or("gap_tolerance", scene.solver.gap_tolerance);
    scene.solver.max_augmentations =
        solver.integer_or("max_augmentations", 1, 10000, scene.solver.max_augmentations);
    solver.finish();
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
  object.finish();
  return scene;
}

} // namespace

Scene read_scene(const std::filesystem::path& file, const std::string& variant) {
  const Json json = parse_json_file(file);
  Scene wanted = read(json, file);
  bool found = variant.empty();
  std::string names;
  const std::vector<Variant> variants = wanted.variants;
  for (const Variant& candidate :
       variants) { // all are read: a mistake in one shall not wait until it is asked for
    Json changed = json;
    changed.merge_patch(candidate.patch);
    Scene scene = read(changed, file, candidate.name);
    scene.title += ", " + candidate.name;
    if (candidate.name == variant) wanted = std::move(scene), found = true;
    names += (names.empty() ? "" : ", ") + candidate.name;
  }
  if (!found)
    throw InputError(file.string() + ": no variant \"" + variant +
                     "\" in /variants; there are: " + (names.empty() ? "none" : names));
  return wanted;
}

Scene read_scene_text(const std::string& text, const std::filesystem::path& file) {
  return read(parse_json(text, file.string()), file);
}

} // namespace host
