// SPDX-License-Identifier: BSD-3-Clause
// The file from which a run goes on.
#pragma once

#include <filesystem>

#include "simulation.hpp"

namespace host {

/// In the folder of --out: that of the last step, and the one before it.
inline constexpr const char *checkpoint_name = "checkpoint.json",
                            *checkpoint_before_name = "checkpoint_before.json";

/// A checkpoint file: the simulation's checkpoint, the step it was written after, the values of the steps up
/// to there, and a checksum of all of them.
std::string checkpoint_text(const Simulation& simulation, int step);

/// @return the step it was written after
/// @throws InputError naming the file: no checkpoint, damaged, of another scene, or of other steps up to
///         there
int read_checkpoint(const std::filesystem::path& file, Simulation& simulation);

} // namespace host
