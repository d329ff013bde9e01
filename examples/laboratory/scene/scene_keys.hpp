// SPDX-License-Identifier: BSD-3-Clause
// The keys of a scene, read group by group. All throw InputError naming the key.
#pragma once

#include "scene.hpp"

namespace host {

/// One of the key "parts".
/// @param scene   its file and dimension are read
/// @param common  thickness and formulation
PartSpec read_part(const JsonValue& value, const Scene& scene, const Materials& materials,
                   const ElementSetup& common);

/// Nothing else fits beside a layer: its supports are its own, and it knows no forces along its surface.
void check_scene_of_layer(const Scene& scene);

/// The key "contact".
ContactSpec read_contact(const JsonValue& value, int dimension);

/// The key "sampling" of a contact: a number, "cut" or {"cut": number}.
void read_sampling(const JsonValue& value, ContactSpec& contact);

/// Its key "law", which stands for the law of the model.
void read_law(const JsonValue& value, ContactSpec& contact);

/// Its keys "cut_off" and "below", and what it excludes in the rest of the contact.
void read_cut_off(const JsonValue& value, ContactSpec& contact);
void read_below(const JsonValue& value, ContactSpec& contact);
void check_cut_off(const ContactSpec& contact);

/// The keys "ends" and "mirror" of a master on the faces of a body.
void read_ends(JsonObject& master, int dimension, ContactSpec& contact);

/// The key "exact", where the solution is one of such a scene.
/// @param scene  all of it that is read before this key
ExactSpec read_exact(const JsonValue& value, const Scene& scene);

} // namespace host
