// SPDX-License-Identifier: BSD-3-Clause
// What a run leaves: result.json, and a VTU series for ParaView.
#pragma once

#include <filesystem>
#include <vector>

#include "newton.hpp"
#include "toolbox/vtu.hpp"

namespace host {

/// Sizes, and what every step reached. README.md lists the keys.
/// @param failure  of the step after these; empty: the run came to its end
Json result_json(Equations& equations, const std::vector<Step>& steps, const std::string& failure);

/// Bodies, slave points and the enriched master of one step.
/// @throws std::runtime_error naming the file that cannot be written
void write_step(vtu::Series& series, Equations& equations, const Step& step);

} // namespace host
