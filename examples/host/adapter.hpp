// SPDX-License-Identifier: BSD-3-Clause
// ents-host run --adapter NAME: forces, tangents and histories of the contact elements come through the
// adapter of another program, called as that program would call it. The rest (which segment, pictures) stays
// with the plain interface.
#pragma once

#include <string>
#include <vector>

#include "ents_library.hpp"

namespace host {

/// Names for --adapter, "plain" first. abaqus_explicit: forces and histories through VUEL; the tangent, which
/// an explicit program does not ask for, stays with the plain interface.
std::vector<std::string> adapter_names();

/// Put the adapter of this name between `library` and its users. Models that are made later are written for
/// it as ents_k.json into a folder of their own, which is removed when the program ends.
/// @throws InputError for a name that is none, JobError if the adapter's library is not there; later
///         InputError for a model that elements of that program cannot have, JobError where the program would end the job
void install_adapter(EntsLibrary& library, const std::string& name);

} // namespace host
