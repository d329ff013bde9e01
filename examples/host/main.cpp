// SPDX-License-Identifier: BSD-3-Clause
// ents-host: the command line.
#include <cmath>
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "result.hpp"

namespace {

struct Options {
  std::string scene, variant, out;
  bool json = false;
};

int run(const Options& options) {
  using namespace host;
  const Scene scene = read_scene(options.scene, options.variant);
  Equations equations(scene);
  std::FILE* const said = options.json ? stderr : stdout;
  const auto say = [said](const std::string& line) {
    std::fprintf(said, "%s\n", line.c_str());
    std::fflush(said); // a run of hours can be watched through a pipe
  };
  say(scene.title + ": " + std::to_string(equations.size()) + " equations, " + equations.solver_name());
  if (!options.out.empty()) std::filesystem::create_directories(options.out);
  vtu::Series series(options.out, "result");
  std::vector<Step> steps;
  std::string failure;
  try {
    Newton newton(equations, say);
    for (int step = 1; step <= static_cast<int>(scene.steps.size()); ++step) {
      steps.push_back(newton.solve(step));
      if (!options.out.empty()) write_step(series, equations, steps.back());
    }
  } catch (const JobError& error) { // what was solved before is kept
    failure = error.what();
  }
  const std::string result = result_json(equations, steps, failure).dump(2) + "\n";
  if (!options.out.empty()) save_text(std::filesystem::path(options.out) / "result.json", result);
  if (options.json) std::printf("%s", result.c_str());
  if (!options.json && !options.out.empty()) say(options.out + ": result.json, and result.pvd for ParaView");
  if (!failure.empty()) throw JobError(failure);
  return 0;
}

/// Is the master surface admissible? @return exit code: 1 if a condition is violated
int check(const Options& options) {
  const host::Scene scene = host::read_scene(options.scene, options.variant);
  if (!scene.contact) throw host::InputError(options.scene + ": the scene has no contact");
  host::Equations equations(scene);
  const host::Contact& contact = *equations.contact();
  const ents_master_mesh mesh = contact.mesh();
  auto result = ents::make<ents_surface_admissibility>();
  ents::require(ents::linked(), ents_surface_check, contact.model().get(), &mesh, &result);
  std::printf("%lld segments, height %g to %g %s, %d samples per direction\n",
              static_cast<long long>(mesh.segments), result.height_min, result.height_max,
              scene.unit_of_length.c_str(), result.samples);
#define HOST_CONDITION(name, index, text) {index, text},
  static constexpr struct {
    int index;
    const char* text;
  } conditions[] = {ENTS_CONDITION_TABLE(HOST_CONDITION)};
#undef HOST_CONDITION
  for (const auto& [index, text] : conditions) {
    const bool judged = (result.judged >> index & 1) != 0, violated = (result.violated >> index & 1) != 0;
    if (!judged && !std::isfinite(result.value[index])) continue;
    std::printf("%-9s %11.4g  %s", violated ? "violated" : judged ? "holds" : "", result.value[index], text);
    if (violated && result.segment[index] >= 0)
      std::printf(" (segment %lld)", static_cast<long long>(result.segment[index]));
    std::printf("\n");
  }
  return result.violated != 0 ? 1 : 0;
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"Reference finite element host of ents, enriched node-to-segment contact.\n"
               "More scenes, exact solutions and pictures: ents-lab.\n",
               "ents-host"};
  app.footer("Exit codes: 0 done, 1 the job failed, 2 the command line or an input file is wrong.\n\n"
             "Example: ents-host run examples/hertz2d/scene.json --out out/hertz2d");
  app.require_subcommand(1);
  Options options;
  CLI::App* const run_app = app.add_subcommand("run", "solve a scene");
  CLI::App* const check_app = app.add_subcommand("check", "is the master surface of a scene admissible?");
  for (CLI::App* command : {run_app, check_app}) {
    command->add_option("scene", options.scene, "scene file; examples/host/README.md lists its keys")
        ->required();
    command->add_option("--variant", options.variant, "one of the scene's variants");
  }
  run_app->add_option("--out", options.out, "folder for result.json and the files for ParaView");
  run_app->add_flag("--json", options.json, "print result.json on stdout, and nothing else there");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "ents-host: %s; try --help\n", error.what());
    return 2;
  }
  const char* const command = run_app->parsed() ? "run" : "check";
  try {
    return run_app->parsed() ? run(options) : check(options);
  } catch (const host::NeedsLaboratory& error) {
    const std::string variant = options.variant.empty() ? "" : " --variant \"" + options.variant + "\"";
    std::fprintf(stderr, "ents-host: %s; take: ents-lab %s %s%s\n", error.what(), command,
                 options.scene.c_str(), variant.c_str());
    return 2;
  } catch (const host::InputError& error) {
    std::fprintf(stderr, "ents-host: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ents-host: %s\n", error.what());
    return 1;
  }
}
