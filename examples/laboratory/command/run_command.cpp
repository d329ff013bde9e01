// SPDX-License-Identifier: BSD-3-Clause
// ents-lab run: solve a scene, tell, and leave files.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "check_extent.hpp"
#include "commands.hpp"
#include "conductance.hpp"
#include "restart.hpp"
#include "run_files.hpp"

namespace host {
namespace {

std::string headline(const Simulation& simulation) {
  const Sizes sizes = simulation.sizes();
  std::string text = simulation.scene().title + ": " + std::to_string(sizes.elements) + " elements, " +
                     std::to_string(sizes.equations) + " equations, " + simulation.solver_name();
  if (sizes.slaves > 0)
    text += "; " + std::to_string(sizes.slaves) + " contact elements on " +
            std::to_string(sizes.master_segments) +
            (sizes.master_segments == 1 ? " master segment" : " master segments");
  return text;
}

/// Table, exact quantities and time; what failed, if something did.
void print_report(const Simulation& simulation, const std::vector<StepRecord>& records,
                  const StepFailure* failure) {
  const Scene& scene = simulation.scene();
  if (!records.empty()) std::printf("\n%s", result_table(scene, records).text().c_str());
  if (!records.empty() && scene.contact) std::printf("\n%s", resultants_table(scene, records).text().c_str());
  if (const std::string exact = exact_table(records); !exact.empty()) std::printf("\n%s", exact.c_str());
  if (!records.empty() && simulation.resolution().too_coarse() && std::isfinite(records.back().area.fraction))
    std::printf(
        "\nno bound of the estimated contact is known: the mesh is too coarse for this surface (ents-lab "
        "check says what would do)\n");
  const Timings& timings = simulation.timings();
  std::printf("\nwall time %s s: setup %s, bulk %s, contact %s, solver %s\n",
              format_number(timings.total, 3).c_str(), format_number(timings.setup, 3).c_str(),
              format_number(timings.bulk, 3).c_str(), format_number(timings.contact, 3).c_str(),
              format_number(timings.solver, 3).c_str());
  if (failure != nullptr)
    std::printf("FAILED at step %d of %zu; %s\n", failure->step, scene.steps.size(),
                records.empty() ? "nothing is solved" : "results are those of the steps before it");
}

/// What was asked for and has no effect.
void note_ignored(const RunOptions& options, const Scene& scene) {
  const std::size_t steps = scene.steps.size();
  if (options.last_step > static_cast<int>(steps))
    std::fprintf(stderr, "ents-lab: --last-step %d: the scene has %zu %s; the run ends with its last\n",
                 options.last_step, steps, steps == 1 ? "step" : "steps");
  if (options.seed && options.cut != "random")
    std::fprintf(stderr, "ents-lab: --seed %u has no effect: only --cut random draws numbers\n",
                 *options.seed);
}

/// A run that converged because nothing touched.
void note_without_contact(const Scene& scene, const std::vector<StepRecord>& records) {
  const auto touched = [](const StepRecord& record) { return record.contact_fraction > 0; };
  if (!scene.contact || records.empty() || std::any_of(records.begin(), records.end(), touched)) return;
  std::fprintf(stderr, "ents-lab: no slave node was in contact at the end of a step: do the master's normal "
                       "(order of its nodes) and "
                       "the motion bring the surfaces together?\n");
}

/// A mesh that cannot follow the surface: its contact is another one.
void note_resolution(const Simulation& simulation) {
  const Resolution& resolution = simulation.resolution();
  if (resolution.too_coarse())
    std::fprintf(stderr, "ents-lab: warning: %s\n",
                 describe(resolution, simulation.scene().units.length).c_str());
}

} // namespace

int run_command(const CommonOptions& common, const RunOptions& options) {
  if (options.compare) return compare_command(common, options);
  const Scene scene = read_scene(options.scene, options.variant);
  std::unique_ptr<EntsLibrary> library;
  if (scene.contact) library = std::make_unique<EntsLibrary>(common.library);
  if (library && options.prepare) options.prepare(scene, *library);
  Simulation simulation(scene, library.get(), options.explicit_divisions);

  StepPlan plan;
  plan.cut = options.cut == "halves"   ? StepPlan::Cut::halves
             : options.cut == "random" ? StepPlan::Cut::random
                                       : StepPlan::Cut::none;
  plan.seed = options.seed.value_or(plan.seed);
  plan.discard = options.discard;
  plan.last = std::min(options.last_step, static_cast<int>(scene.steps.size()));
  if (!options.restart.empty()) plan.first = read_checkpoint(options.restart, simulation) + 1;
  if (plan.last > 0 && plan.first > plan.last)
    throw InputError("--last-step " + std::to_string(plan.last) + ": the checkpoint was written after step " +
                     std::to_string(plan.first - 1) + "; there is nothing left to solve");
  note_ignored(options, scene);
  // Before the run, for in its result such a map looks like a master that faces away.
  if (const std::string& mismatch = simulation.exact_axis().mismatch; !mismatch.empty())
    std::fprintf(stderr, "ents-lab: warning: %s; errors against the exact solution mean nothing\n",
                 mismatch.c_str());
  if (scene.contact) note_small_maps(scene, simulation.contact()->master().surface_coordinates);
  note_resolution(simulation);
  RunFiles files(options.out, options.restart, plan.first);

  RunObserver observer;
  if (!common.json)
    observer.line = [](const std::string& line) {
      std::printf("%s\n", line.c_str());
      std::fflush(stdout); // progress shall be seen while the next step runs, also through a pipe
    };
  if (observer.line) observer.line(headline(simulation));
  observer.step_done = [&](const Simulation&, const StepRecord& record) { files.add(simulation, record); };
  std::vector<StepRecord> records;
  std::unique_ptr<StepFailure> failure;
  try {
    records = solve(simulation, observer, plan);
  } catch (const StepFailure& caught) { // steps that were solved before are reported, too
    failure = std::make_unique<StepFailure>(caught);
    records = failure->solved;
  }
  Json result = result_json(simulation, records, options.nodes, failure.get());
  if (plan.first > 1) {
    result["restarted_after"] = plan.first - 1;
    result["steps"].insert(result["steps"].begin(), files.earlier().begin(), files.earlier().end());
  }
  add_energy_of_run(result);
  files.finish(result);
  if (scene.probe > 0 && !options.out.empty()) write_gaps(records, scene.dimension, options.out);
  std::string problem;
  if (!options.out.empty() && options.pictures && !records.empty())
    problem = draw_pictures(simulation, records, options.out);
  if (common.json) {
    std::printf("%s\n", result.dump(2).c_str());
  } else {
    print_report(simulation, records, failure.get());
    if (!problem.empty()) std::printf("%s\n", problem.c_str());
    if (!options.out.empty() && files.problem().empty()) std::printf("%s\n", files.names().c_str());
  }
  std::fflush(stdout); // before messages on stderr
  note_without_contact(scene, records);
  for (const std::string& message : {failure ? std::string(failure->what()) : std::string(), files.problem()})
    if (!message.empty()) std::fprintf(stderr, "ents-lab: %s\n", message.c_str());
  return failure || !files.problem().empty() ? 1 : 0;
}

} // namespace host
