// SPDX-License-Identifier: BSD-3-Clause
// ents-host run: solve a scene, tell, and leave files.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "adapter.hpp"
#include "commands.hpp"
#include "output_folder.hpp"
#include "result.hpp"

namespace host {
namespace {

std::string headline(const Simulation& simulation) {
  const Sizes sizes = simulation.sizes();
  std::string text = simulation.scene().title + ": " + std::to_string(sizes.elements) + " elements, " +
                     std::to_string(sizes.equations) + " equations, " + simulation.solver_name();
  if (sizes.slaves > 0)
    text += "; " + std::to_string(sizes.slaves) + " contact elements on " + std::to_string(sizes.master_segments) +
            (sizes.master_segments == 1 ? " master segment" : " master segments");
  return text;
}

/// @return the step it was written after
int read_checkpoint(const std::filesystem::path& file, Simulation& simulation) {
  Json json = parse_json_file(file);
  const std::string where = file.string() + ": ";
  const int step = JsonObject(JsonValue(json, where)).at("step").integer(1, static_cast<int>(simulation.scene().steps.size()));
  json.erase("step");
  try {
    simulation.restore(json);
  } catch (const InputError& error) {
    throw InputError(where + error.what());
  }
  if (step == static_cast<int>(simulation.scene().steps.size()))
    throw InputError(where + "the run is finished: this is the checkpoint of its last step");
  return step;
}

} // namespace

int run_command(const CommonOptions& common, const RunOptions& options) {
  if (options.compare) return compare_command(common, options);
  const Scene scene = read_scene(options.scene, options.variant);
  std::unique_ptr<EntsLibrary> library;
  if (scene.contact) library = std::make_unique<EntsLibrary>(common.library);
  if (library) install_adapter(*library, options.adapter);
  Simulation simulation(scene, library.get(), options.explicit_divisions);

  StepPlan plan;
  plan.cut = options.cut == "halves" ? StepPlan::Cut::halves
             : options.cut == "random" ? StepPlan::Cut::random
                                       : StepPlan::Cut::none;
  plan.seed = options.seed;
  plan.discard = options.discard;
  plan.last = std::min(options.last_step, static_cast<int>(scene.steps.size()));
  if (!options.restart.empty()) plan.first = read_checkpoint(options.restart, simulation) + 1;

  RunObserver observer;
  if (!common.json)
    observer.line = [](const std::string& line) {
      std::printf("%s\n", line.c_str());
      std::fflush(stdout); // progress shall be seen while the next step runs, also through a pipe
    };
  if (observer.line) observer.line(headline(simulation));
  std::unique_ptr<vtu::Series> series;
  if (!options.out.empty()) {
    make_output_folder(options.out);
    series = std::make_unique<vtu::Series>(options.out, "result");
    observer.step_done = [&](const Simulation&, const StepRecord& record) {
      write_step(*series, simulation, record);
      Json checkpoint = simulation.checkpoint();
      checkpoint["step"] = record.step;
      write_text(options.out / "checkpoint.json", checkpoint.dump() + "\n");
    };
  }
  const std::vector<StepRecord> records = solve(simulation, observer, plan);
  const Json result = result_json(simulation, records, options.nodes);
  std::vector<std::string> problems;
  if (!options.out.empty()) {
    write_text(options.out / "result.json", result.dump(2) + "\n");
    if (options.pictures) problems = draw_pictures(simulation, records, options.out);
  }
  if (common.json) {
    std::printf("%s\n", result.dump(2).c_str());
    return 0;
  }
  std::printf("\n%s", result_table(scene, records).text().c_str());
  if (const std::string exact = exact_table(records); !exact.empty()) std::printf("\n%s", exact.c_str());
  const Timings& timings = simulation.timings();
  std::printf("\nwall time %s s: setup %s, bulk %s, contact %s, solver %s\n",
              format_number(timings.total, 3).c_str(), format_number(timings.setup, 3).c_str(),
              format_number(timings.bulk, 3).c_str(), format_number(timings.contact, 3).c_str(),
              format_number(timings.solver, 3).c_str());
  for (const std::string& problem : problems) std::printf("%s\n", problem.c_str());
  if (series)
    std::printf("%s and %s\n", series->file().string().c_str(), (options.out / "result.json").string().c_str());
  return 0;
}

} // namespace host
