// SPDX-License-Identifier: BSD-3-Clause
// Does a mesh fit into this machine? Asked before it is made: where memory is promised and not there, the
// operating system ends the program without a word.
#pragma once

#include "scene.hpp"

namespace host {

/// Blocks of the scene's parts; decks are as large as their files.
/// @throws InputError naming the part
void check_mesh_size(const Scene& scene);

/// The explicit mesh of --explicit or --compare.
/// @throws InputError naming its divisions
void check_explicit_size(const Scene& scene, int divisions);

} // namespace host
