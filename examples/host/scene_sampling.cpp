// SPDX-License-Identifier: BSD-3-Clause
// The key "sampling" of a contact: which points of the slave surface have a contact element.
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

} // namespace host
