// SPDX-License-Identifier: BSD-3-Clause
// Scenes of the reference host through the emulated hosts: forces, tangents and histories of the contact
// elements come through the adapter of another program. The rest (which segment, pictures) stays with the
// plain interface.
#pragma once

#include <string>
#include <vector>

#include "ents_library.hpp"
#include "scene.hpp"

namespace adapters {

/// "plain", "direct", and the names of hosts(). direct: no adapter, but projections start where those of
/// adapters do. abaqus_explicit: forces and histories through VUEL; the tangent, which an explicit program
/// does not ask for, stays with the plain interface.
std::vector<std::string> route_names();

/// @throws InputError for what no element of that program can have
void check_adapter(const host::Scene& scene, const std::string& name);

/// Put the adapter of this name between `library` and its users. Models that are made later are written for
/// it as ents_k.json into a folder of their own, which is removed when the program ends.
/// @throws InputError for an unknown name; the route throws it later for a model that the elements of that program cannot
///         have, JobError where the program would end the job
void install_adapter(host::EntsLibrary& library, const std::string& name);

} // namespace adapters
