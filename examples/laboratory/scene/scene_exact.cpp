// SPDX-License-Identifier: BSD-3-Clause
// The key "exact" of a scene: which solution, and whether the scene is one that it solves.
#include <algorithm>
#include <cmath>
#include <map>

#include "scene_keys.hpp"

namespace host {
namespace {

using Type = ExactSpec::Type;

const std::map<std::string, Type> types{{"hertz_line", Type::hertz_line},
                                        {"hertz_point", Type::hertz_point},
                                        {"westergaard", Type::westergaard},
                                        {"double_sine", Type::double_sine},
                                        {"cattaneo", Type::cattaneo},
                                        {"slope", Type::slope},
                                        {"uniform_pressure", Type::uniform_pressure},
                                        {"boundary_elements", Type::boundary_elements},
                                        {"worn_cylinder", Type::worn_cylinder},
                                        {"screw", Type::screw}};

bool is_rigid(const Scene& scene) { return !scene.contact->rigid.empty(); }

/// Lines and profiles are of bodies in the plane; points of bodies in space or round an axis; sheets of
/// bodies in space.
void check_formulation(Type type, const JsonValue& word, const Scene& scene) {
  if (type == Type::uniform_pressure) return;
  const bool axisymmetric =
      scene.dimension == 2 && scene.parts.front().setup.formulation == Formulation::axisymmetric;
  const bool point = type == Type::hertz_point,
             space = type == Type::double_sine || type == Type::boundary_elements || type == Type::screw;
  if (point   ? scene.dimension == 3 || axisymmetric
      : space ? scene.dimension == 3
              : scene.dimension == 2 && !axisymmetric)
    return;
  const std::string place = point ? "in space or round an axis" : space ? "in space" : "in the plane";
  const std::string here =
      axisymmetric ? "/formulation is axisymmetric" : "/dimension is " + std::to_string(scene.dimension);
  word.fail("this exact solution is one " + place + ", and " + here + "; take " +
            (axisymmetric && type == Type::hertz_line ? "hertz_point for a sphere" : "another one") +
            ", or leave \"exact\" out");
}

/// What else the formulae take for granted.
void check_bodies(const ExactSpec& exact, const JsonValue& value, const Scene& scene) {
  if (exact.type == Type::uniform_pressure) return;
  if (exact.type == Type::screw) {
    const auto turns = [](const BodyComponent& c) { return c.component == 5 && c.value != 0; };
    const auto& body = scene.contact->body;
    if (!body || std::none_of(body->prescribed.begin(), body->prescribed.end(), turns))
      value.fail("\"screw\" is for a master that is a rigid_body whose turn_z is prescribed");
    return;
  }
  if (exact.type == Type::cattaneo) {
    if (is_rigid(scene)) value.fail("\"cattaneo\" is for two elastic bodies in the plane");
    const PartSpec *slave = part_of_set(scene, scene.contact->slave),
                   *master = part_of_set(scene, scene.contact->master);
    if (slave == nullptr || master == nullptr) return; // told when the sets are looked up
    const Material &one = slave->setup.material, &two = master->setup.material;
    if (one.young != two.young || one.poisson != two.poisson)
      value.fail("\"cattaneo\" is for two bodies of equal elasticity; " + slave->name + " and " +
                 master->name + " differ in young or poisson");
    return;
  }
  if (!is_rigid(scene)) value.fail("this exact solution is for contact with a rigid master");
  // Heights are measured along the last axis: of the master's motion, or of the slope's normal.
  const std::vector<double>& direction = scene.contact->direction;
  if (std::abs(direction.back()) < 1 - 1e-12)
    throw InputError(scene.file.string() +
                     ": /contact/master/direction: the exact solution is for a motion along " +
                     (scene.dimension == 2 ? "y" : "z"));
  if (exact.type == Type::worn_cylinder) {
    const Json& model = scene.contact->model;
    const Json slave = find_json(model, "/contact/wear/slave");
    if (!find_json(model, "/contact/wear/coefficient").is_number() || !(slave.is_null() || slave == 1))
      throw InputError(scene.contact->model_where +
                       "/contact/wear: \"worn_cylinder\" is for a slave that loses all of the wear, with a "
                       "coefficient that is a number");
    return;
  }
  if (exact.type != Type::slope) return;
  const auto d = static_cast<std::size_t>(scene.dimension);
  for (std::size_t a = d; a < scene.contact->rigid.size(); a += d)
    if (scene.contact->rigid[a + d - 1] != scene.contact->rigid[d - 1])
      throw InputError(
          scene.file.string() +
          ": /contact/master/nodes: the slope of this exact solution lies level, and its load turns");
}

} // namespace

ExactSpec read_exact(const JsonValue& value, const Scene& scene) {
  JsonObject object(value);
  ExactSpec exact;
  exact.where = value.where();
  std::vector<std::string> words;
  for (const auto& [word, type] : types) words.push_back(word);
  const JsonValue word = object.at("type");
  exact.type = types.at(word.word(words));
  if (exact.type == Type::hertz_line || exact.type == Type::hertz_point ||
      exact.type == Type::worn_cylinder) {
    exact.radius = object.at("radius").positive();
  } else if (exact.type == Type::cattaneo) {
    exact.radius = object.at("radius").positive();
    exact.coefficient = object.at("coefficient").positive();
    exact.distance = object.at("distance").positive();
  } else if (exact.type == Type::screw) {
    exact.lead = object.at("lead").positive();
    exact.flank_angle = object.at("flank_angle").number();
    if (!(exact.flank_angle >= 0 && exact.flank_angle < 89))
      object.at("flank_angle").fail("degrees between the flank and the plane across the axis, 0 .. < 89");
    exact.coefficient = object.at("coefficient").number();
    if (!(exact.coefficient >= 0)) object.at("coefficient").fail("a number >= 0 is expected");
  } else if (exact.type == Type::slope) {
    exact.coefficient = object.at("coefficient").positive();
  } else if (exact.type == Type::uniform_pressure) {
    exact.pressure = object.at("pressure").positive();
  } else if (exact.type == Type::boundary_elements) {
    exact.points = object.integer_or("points", 8, 1024, exact.points);
    if (object.has("error")) exact.error = object.at("error").positive();
    if (object.has("stiffness")) exact.stiffness = object.at("stiffness").positive();
  } else {
    exact.amplitude = object.at("amplitude").positive();
    exact.wavelength = object.at("wavelength").positive();
  }
  object.finish();
  if (!scene.contact) value.fail("the exact solutions are for contact");
  if (!scene.tied.empty() && exact.type != Type::uniform_pressure)
    value.fail("the exact solutions are of bodies of one material; with /tied leave \"exact\" out");
  check_formulation(exact.type, word, scene);
  check_bodies(exact, value, scene);
  return exact;
}

} // namespace host
