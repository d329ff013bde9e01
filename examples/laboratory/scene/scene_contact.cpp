// SPDX-License-Identifier: BSD-3-Clause
// Keys of a contact: its slave and its master, which points of the slave surface have a contact element, and
// what lies beyond the borders of a smoothed master.
#include <cmath>

#include "scene_keys.hpp"
#include "smoothing.hpp"

namespace host {
namespace {

/// Natural coordinates by which plain faces reach beyond their edges where the model says nothing, as common codes
/// extend master faces. A rigid segment is a whole body, whose edges are meant; smoothed ones meet without kinks.
constexpr double default_border = 0.1;

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

} // namespace

void read_sampling(const JsonValue& value, ContactSpec& contact) {
  constexpr int usual = 2; // exact for a uniform pressure between faces that are parallelograms
  if (value.is_number()) {
    contact.sampling = value.integer(1, 64);
  } else if (value.is_object()) {
    JsonObject object(value);
    contact.cut = object.at("cut").integer(1, 16);
    object.finish();
  } else if (value.is_string() && value.string() == "cut") {
    contact.cut = usual;
  } else {
    value.fail("expected: a number of points per direction from 1 to 64, \"cut\", or {\"cut\": points per "
               "direction}");
  }
}

void read_cut_off(const JsonValue& value, ContactSpec& contact) {
  contact.cut_off.where = value.where();
  const auto wavelength = [&](const JsonValue& length) {
    if (!(length.number() > 0)) length.fail("a wavelength > 0 is expected");
    contact.cut_off.wavelength = length.number();
  };
  if (!value.is_object()) return wavelength(value);
  JsonObject object(value);
  wavelength(object.at("wavelength"));
  if (object.has("points")) contact.cut_off.points = object.at("points").integer(16, 2048);
  object.finish();
}

void read_slave_height(const JsonValue& value, int dimension, ContactSpec& contact) {
  JsonObject object(value);
  contact.slave_height = object.at("height").json();
  contact.slave_height_where = value.where();
  contact.slave_coordinates = read_coordinate_rule(object.at("surface_coordinates"), dimension);
  object.finish();
  if (contact.sampling == 0 && contact.cut == 0)
    value.fail("a rough slave has its points inside its faces; write \"sampling\": 1 or more, or \"cut\"");
}

void read_below(const JsonValue& value, ContactSpec& contact) {
  if (contact.cut_off.wavelength > 0)
    value.fail("\"cut_off\" leaves the short waves to a law, too; leave one of the two keys out");
  contact.cut_off.where = value.where();
  JsonObject object(value);
  const JsonValue cut = object.at("cut");
  if (!(cut.number() > 0)) cut.fail("a wavelength > 0 is expected");
  contact.cut_off.wavelength = cut.number();
  if (object.has("law")) object.at("law").word({"boundary_elements"});
  if (object.has("points")) contact.cut_off.points = object.at("points").integer(16, 2048);
  contact.cut_off.own = true;
  object.finish();
}

/// "heat" of the model. Bodies here have no temperatures: it says what of the work of friction is heat, and where that
/// goes.
void read_heat(const JsonValue& model, ContactSpec& contact) {
  if (find_json(contact.model, "/contact/heat").is_null()) return;
  JsonObject heat(JsonObject(JsonObject(model).at("contact")).at("heat"));
  const auto names = heat.all_keys();
  if (names != std::vector<std::string>{"friction"})
    heat.fail("bodies have no temperatures here, only \"friction\" may stand in \"heat\"; examples/host "
              "conducts heat "
              "through the gap");
  JsonObject friction(heat.at("friction"));
  if (find_json(contact.model, "/contact/friction").is_null())
    heat.at("friction").fail("heats a contact with \"friction\" beside \"heat\"");
  const auto share = [&](const char* key, double otherwise) {
    if (!friction.has(key)) return otherwise;
    const JsonValue value = friction.at(key);
    if (!(value.number() >= 0 && value.number() <= 1)) value.fail("a share between 0 and 1 is expected");
    return value.number();
  };
  contact.heat_share = share("share", 1), contact.heat_slave = share("slave", 0.5);
  friction.finish();
  contact.model["contact"].erase("heat");
}

void read_law(const JsonValue& value, ContactSpec& contact) {
  contact.hard = value.word({"hard"}) == "hard";
  if (contact.cut_off.wavelength > 0)
    value.fail("the law follows from the waves that \"cut_off\" or \"below\" leaves out; leave \"law\" out");
  if (!find_json(contact.model, "/contact/normal").is_null())
    value.fail("the model has a law, too; leave out this key, or \"normal\" of /contact/model/contact");
  // The stiffness is none of the answer; Simulation::build_contact puts one that suits the mesh.
  contact.model["contact"]["normal"] = {{"type", "augmented_multiplier"}, {"stiffness", 1}};
}

void check_cut_off(const ContactSpec& contact) {
  if (!(contact.cut_off.wavelength > 0)) return;
  const auto fail = [&](const std::string& text) { throw InputError(contact.cut_off.where + ": " + text); };
  if (contact.rigid.empty()) fail("is for a rigid master of one segment, \"master\": {\"nodes\": ...}");
  if (!find_json(contact.model, "/contact").is_null())
    fail("the law follows from the waves that are left out, without friction; leave \"contact\" out of the "
         "model");
  if (contact.cut > 0)
    fail("is not possible with \"sampling\": \"cut\"; take the nodes, or a number of points");
  if (contact.gap_only) fail("is not possible with \"enrichment\": \"gap_only\"");
  if (!contact.slave_height.is_null()) fail("is not possible with \"slave_height\"; leave one of them out");
  if (contact.cut_off.own && contact.sampling > 0)
    fail("is for the nodes of the slave surface, whose distances its law needs; leave \"sampling\" out");
  if (contact.model.contains("parameters")) fail("is for a model without \"parameters\"");
}

void read_ends(JsonObject& master, int dimension, ContactSpec& contact) {
  if (master.has("ends"))
    contact.ends = master.at("ends").word({"repeated", "straight", "quasi_cubic", "quasi_parabolic"});
  if (!master.has("mirror")) return;
  JsonObject planes(master.at("mirror"));
  const std::vector<std::string> axes{"x", "y", "z"};
  for (int axis = 0; axis < dimension; ++axis)
    if (const std::string& name = axes[static_cast<std::size_t>(axis)]; planes.has(name))
      contact.mirror.push_back({axis, planes.at(name).number(), planes.at(name).where()});
  planes.finish();
  if (contact.mirror.empty()) planes.fail("a plane of symmetry is expected: {\"x\": place} or another axis");
}

/// A surface in contact with itself: its points lie on its own height.
void raise_one_surface(const JsonValue& model, ContactSpec& contact) {
  const Json height = find_json(contact.model, "/height");
  if (contact.master != contact.slave || height.is_null() || contact.gap_only) return;
  if (!contact.slave_height.is_null())
    model.fail(
        "slave and master are one surface, and its height is that of the model; leave out \"slave_height\"");
  if (contact.sampling == 0)
    model.fail(
        "a rough surface in contact with itself has its points inside its faces; write \"sampling\": 2");
  contact.slave_height = height;
  contact.slave_height_where = contact.model_where + "/height";
  contact.slave_coordinates = contact.coordinates;
}

/// Two passes over two sides: each face is slave and master of one model, and its points lie on the height of that.
void check_one_height(JsonObject& object, const ContactSpec& contact) {
  if (!contact.two_pass || contact.master == contact.slave) return;
  const Json height = find_json(contact.model, "/height");
  if (contact.slave_height != height)
    object.at("two_pass")
        .fail("both sides are slaves of one model, whose height is that of both; write the same \"height\" "
              "into "
              "\"model\" and \"slave_height\", or leave both out");
  const Json of_slave = object.has("slave_height")
                            ? find_json(object.at("slave_height").json(), "/surface_coordinates")
                            : Json(),
             of_master = find_json(object.at("master").json(), "/surface_coordinates");
  if (!height.is_null() && of_slave != of_master)
    object.at("two_pass")
        .fail("both sides have one height, in one kind of coordinates; write the \"surface_coordinates\" of "
              "\"slave_height\" into \"master\", too");
}

ContactSpec read_contact(const JsonValue& value, int dimension) {
  JsonObject object(value);
  ContactSpec contact;
  contact.slave = object.at("slave").string();
  contact.slave_where = object.at("slave").where();
  if (object.has("sampling")) read_sampling(object.at("sampling"), contact);
  if (object.has("slave_height")) read_slave_height(object.at("slave_height"), dimension, contact);
  if (object.has("areas")) {
    const JsonValue areas = object.at("areas");
    contact.equal_areas = areas.word({"tributary", "equal"}) == "equal";
    if (contact.equal_areas && (contact.sampling > 0 || contact.cut > 0))
      areas.fail("sampling points have areas of their own; leave it out");
  }
  if (object.has("enrichment"))
    contact.gap_only = object.at("enrichment").word({"full", "gap_only"}) == "gap_only";
  if (object.has("two_pass")) contact.two_pass = object.at("two_pass").boolean();
  if (object.has("cut_off")) read_cut_off(object.at("cut_off"), contact);
  if (object.has("below")) read_below(object.at("below"), contact);
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
    if (master.has("surface_coordinates"))
      contact.coordinates = read_coordinate_rule(master.at("surface_coordinates"), dimension);
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
  read_heat(model, contact);
  // One place says whether the master is rigid: the scene.
  contact.model["master"] = contact.rigid.empty() && !contact.body ? "deformable" : "rigid";
  if (model.json().contains("master") && model.json().at("master") != contact.model["master"])
    model.fail("\"master\" contradicts the scene's master; leave it out here");
  const Json segment = find_json(contact.model, "/segment");
  if (!contact.master.empty() && !contact.model.contains("border") && segment.is_string() &&
      !is_smoothed(segment.get<std::string>()))
    contact.model["border"] = default_border;
  if (contact.gap_only) {
    const char* of = find_json(contact.model, "/height").is_null() ? "a model with a \"height\""
                     : contact.cut > 0                             ? "no \"sampling\": \"cut\""
                     : contact.model.contains("parameters")        ? "a model without \"parameters\""
                                                                   : nullptr;
    if (of) object.at("enrichment").fail(std::string("\"gap_only\" needs ") + of);
  }
  raise_one_surface(model, contact);
  check_one_height(object, contact);
  if (object.has("law")) read_law(object.at("law"), contact);
  check_cut_off(contact);
  object.finish();
  return contact;
}

} // namespace host
