// SPDX-License-Identifier: BSD-3-Clause
// The file from which a run goes on.
#pragma once

#include <filesystem>

#include "simulation.hpp"

namespace host {

/// The simulation's checkpoint, with the step it was written after and the values of the steps up to there.
Json checkpoint_after(const Simulation& simulation, int step);

/// @return the step it was written after
/// @throws InputError naming the file: no checkpoint, damaged, of another scene, or of other steps up to
/// there
int read_checkpoint(const std::filesystem::path& file, Simulation& simulation);

} // namespace host
