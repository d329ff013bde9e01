// SPDX-License-Identifier: BSD-3-Clause
// What a run says at its end: the JSON result, the table, the files for ParaView and the pictures.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "compare.hpp"
#include "output/table.hpp"
#include "run.hpp"
#include "toolbox/json_reader.hpp"
#include "toolbox/vtu.hpp"

namespace host {

/// The whole run. examples/laboratory/README.md describes the keys.
/// @param nodes    with the fields of every slave node in every step
/// @param failure  of the step after these; null: the run came to its end
Json result_json(const Simulation& simulation, const std::vector<StepRecord>& records, bool nodes = false,
                 const StepFailure* failure = nullptr);

/// The key "energy" of a run whose steps have one: sums over all of them, and over those with jumps.
void add_energy_of_run(Json& result);

/// 0 open, 1 stick (without friction: closed), 2 slip, 3 slip at the shear limit.
int status_number(std::int32_t flags);

/// One row per step.
Table result_table(const Scene& scene, const std::vector<StepRecord>& records);

/// What the contact carries together in each step, of this mesh: forces and moment (about the origin) on the slave.
/// @param scene  with a contact
Table resultants_table(const Scene& scene, const std::vector<StepRecord>& records);

/// Exact quantities of every step; empty text if the scene has none.
std::string exact_table(const std::vector<StepRecord>& records);

/// rho_e of all segments of the master, where they are now.
vtu::Grid master_grid(Simulation& simulation);

/// What writes the parts of one step for the VTU series: "bulk", "slave" and "surface" (the enriched master),
/// then their list. Each may fail on its own, as Series::add; the arguments have to live as long.
std::vector<std::function<void()>> parts_of_step(vtu::Series& series, Simulation& simulation,
                                                 const StepRecord& record);

/// The pictures that draw_pictures and draw_comparison may leave, each as NAME.svg and NAME.png.
inline constexpr std::array picture_names{"residuals", "force",        "torque",      "traction",
                                          "worn",      "pressure",     "westergaard", "contact_fraction",
                                          "mean_gap",  "pressure_map", "compare"};

/// @return empty, or a line that says why there are none
std::string draw_pictures(Simulation& simulation, const std::vector<StepRecord>& records,
                          const std::filesystem::path& folder);

/// Difference against segments per direction: compare.svg and .png.
/// @return as draw_pictures
std::string draw_comparison(const Scene& scene, const Comparison& comparison,
                            const std::filesystem::path& folder);

} // namespace host
