// SPDX-License-Identifier: BSD-3-Clause
// Keys of a contact: which points of the slave surface have a contact element, and what lies beyond the
// borders of a smoothed master.
#include "scene.hpp"

namespace host {

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
  if (contact.model.contains("parameters")) fail("is for a model without \"parameters\"");
}

void read_ends(JsonObject& master, int dimension, ContactSpec& contact) {
  if (master.has("ends"))
    contact.straight_ends = master.at("ends").word({"repeated", "straight"}) == "straight";
  if (!master.has("mirror")) return;
  JsonObject planes(master.at("mirror"));
  const std::vector<std::string> axes{"x", "y", "z"};
  for (int axis = 0; axis < dimension; ++axis)
    if (const std::string& name = axes[static_cast<std::size_t>(axis)]; planes.has(name))
      contact.mirror.push_back({axis, planes.at(name).number(), planes.at(name).where()});
  planes.finish();
  if (contact.mirror.empty()) planes.fail("a plane of symmetry is expected: {\"x\": place} or another axis");
}

} // namespace host
