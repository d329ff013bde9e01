// SPDX-License-Identifier: BSD-3-Clause
// ents-host: the command line.
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "adapter.hpp"
#include "commands.hpp"
#include "error.hpp"

int main(int argc, char** argv) {
  using namespace host;
  CLI::App app{"Reference finite element host of ents, enriched node-to-segment contact.\n"
               "An ordinary host: it loads libents.so and knows nothing of it but ents.h.\n"};
  app.footer("Exit codes: 0 done, 1 the job failed, 2 the command line or an input file is wrong.\n\n"
             "Examples:\n"
             "  ents-host run examples/hertz2d/scene.json --out out/hertz2d\n"
             "  ents-host run examples/westergaard/scene.json --compare\n"
             "  ents-host variants examples/hertz2d/scene.json\n"
             "  ents-host verify tests/mechanics/golden/*.json\n"
             "  ents-host check model.json --mesh master.inp\n"
             "  ents-host chart --out out/chart\n\n"
             "ents-host SUBCOMMAND --help says more of each.");
  app.require_subcommand(1);
  CommonOptions common;
  const auto add_common = [&](CLI::App& command) {
    command.add_option("--library", common.library,
                       "libents.so to load [../lib/libents.so from the program's folder, else the system's]");
    command.add_flag("--json", common.json, "print the result as JSON on stdout, and nothing else there");
  };

  RunOptions run;
  CLI::App* run_app = app.add_subcommand("run", "Solve a scene");
  run_app->add_option("scene", run.scene, "scene file; examples/host/README.md describes its keys")
      ->required()
      ->type_name("FILE");
  run_app->add_option("--out", run.out,
                      "folder for result.json, the VTU series (open result.pvd in ParaView) and the pictures; without "
                      "it only the terminal is told")
      ->type_name("DIR");
  std::string names; // install_adapter checks the name
  for (const std::string& name : adapter_names())
    if (name != "plain") names += (names.empty() ? "" : ", ") + name;
  run_app->add_option("--adapter", run.adapter, "how the contact reaches the library: directly (plain), or through the adapter of another program: " + names)
      ->type_name("NAME")
      ->capture_default_str();
  run_app->add_option("--explicit", run.explicit_divisions,
                      "replace the enriched segment by a mesh of N (3D: N x N) plain segments of the same geometry")
      ->check(CLI::Range(1, 100000))
      ->type_name("N");
  CLI::Option* compare = run_app
                             ->add_option("--compare", run.compare_divisions,
                                          "solve the scene as it is and with explicit meshes of N1,N2,... segments per "
                                          "direction [the scene's own list]; print how they converge and what they cost")
                             ->delimiter(',')
                             ->check(CLI::Range(1, 100000))
                             ->type_name("N1,N2,...")
                             ->expected(0, 1000)
                             ->excludes("--explicit");
  run_app->add_flag_callback("--no-pictures", [&] { run.pictures = false; }, "leave the pictures out");
  run_app->add_option("--variant", run.variant, "solve one of the scene's variants (its key \"variants\") instead");
  run_app->add_flag("--nodes", run.nodes, "gap, pressure, traction, slip, status and segment of every slave node in the JSON result");
  run_app->add_option("--cut", run.cut, "take every step in two halves, or in one to four increments of random sizes")
      ->check(CLI::IsMember({"halves", "random"}));
  run_app->add_option("--seed", run.seed, "of --cut random")->capture_default_str();
  run_app->add_flag("--discard", run.discard,
                    "before the increments solve others (the whole step; with --cut random now and then some parts) and "
                    "throw them away: the result must not change by a bit, see \"fingerprint\" in it");
  run_app->add_option("--last-step", run.last_step, "stop after this step")->check(CLI::PositiveNumber);
  run_app->add_option("--restart", run.restart, "continue from the checkpoint.json that a run left in its --out folder")
      ->check(CLI::ExistingFile);
  add_common(*run_app);
  run_app->footer("Each step prints one line: approach and force of the rigid master, the relative residual of every Newton iteration, and\n"
                  "its last two reductions. A step that fails is cut into parts; steps too small end the run with exit code 1.\n\n"
                  "Examples:\n"
                  "  ents-host run examples/rough_afm/scene.json --out out/rough_afm     a measured surface on ONE segment\n"
                  "  ents-host run examples/hertz2d/scene.json --explicit 95             the same with 95 plain segments\n"
                  "  ents-host run examples/westergaard/scene.json --compare             how the two converge to each other\n"
                  "  ents-host run examples/hertz3d/scene.json --json | jq .steps[-1].exact");

  VariantsOptions variants;
  CLI::App* variants_app =
      app.add_subcommand("variants", "Solve a scene and all its variants; one table compares error, penetration, iterations, time");
  variants_app->add_option("scene", variants.scene, "scene file with a key \"variants\"")->required();
  add_common(*variants_app);

  VerifyOptions verify;
  CLI::App* verify_app =
      app.add_subcommand("verify", "Hold the library against golden vectors (100-digit references)");
  verify_app->add_option("files", verify.files, "golden files")->required()->check(CLI::ExistingFile);
  verify_app->add_option("--tolerance", verify.tolerance, "largest relative error that passes")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_common(*verify_app);

  CheckOptions check;
  CLI::App* check_app = app.add_subcommand(
      "check", "Is the enrichment of a model admissible? Exit code 1 and what fails, where and by how much, if not. And what does it need?");
  check_app->add_option("model", check.model, "model file (JSON, as ents_model_create_from_file reads it)")->required();
  check_app->add_option("--mesh", check.mesh,
                        "where the segments are: a .json file {\"nodes\": [[x, y], ...], \"segments\": [[0, 1], ...]} "
                        "or an Abaqus/CalculiX deck whose elements are the segments [one segment whose nodes lie "
                        "at their natural coordinates]");
  check_app->add_option("--samples", check.samples, "grid points per direction of a segment [as the height asks for]")
      ->check(CLI::Range(2, 4096));
  check_app->add_option("--reach", check.reach,
                        "a slave node this far from the surface shall have one normal projection [the model's \"penetration_limit\"; "
                        "without one: for information]")
      ->check(CLI::PositiveNumber);
  check_app->add_option("--kink", check.kink, "largest angle of the normals where segments meet, degrees [for information]")
      ->check(CLI::Range(0.0, 180.0));
  check_app->add_option("--out", check.out, "folder for a picture of the enriched surface with the offending places marked");
  add_common(*check_app);
  check_app->footer("\"this scene needs: ...\" is what the library computes for this model, \"it does not need: ...\" what it leaves out, and why: its own\n"
                    "decision (ents_layout.needs), not a reading of the file; ents-bench --savings says what each is worth.\n"
                    "Each condition prints its worst value on the whole surface, the bound, how much is missing, and where: the segment, natural\n"
                    "coordinates on it and, for edges and pairs, the other segment. Lengths are the mesh's.\n\n"
                    "Examples:\n"
                    "  ents-host check model.json                                        one flat segment of size 2\n"
                    "  ents-host check model.json --mesh surface.json --reach 0.1 --out out/check\n"
                    "  ents-host check model.json --mesh shell.inp --json | jq .conditions");

  ChartOptions chart;
  CLI::App* chart_app = app.add_subcommand("chart", "What does an error cost, and where does each method work? Work-precision diagrams and stability maps");
  chart_app->add_option("--out", chart.out, "folder for chart.html (one page, no network), chart.json and the pictures")->type_name("DIR");
  chart_app->add_flag("--quick", chart.quick, "a few runs of each scene and points of each map");
  chart_app->add_option("--scenes", chart.scenes, "the folder examples of the sources [from the program's folder]")->type_name("DIR");
  chart_app->add_flag_callback("--no-pictures", [&] { chart.pictures = false; }, "leave the pictures out; the page has its own");
  add_common(*chart_app);
  chart_app->footer("Exit code 1 if any result is wrong and nothing has said so.\n\n"
                    "Example:\n"
                    "  ents-host chart --out out/chart && xdg-open out/chart/chart.html");

  try {
    app.parse(argc, argv);
    run.compare = compare->count() > 0;
    std::erase(run.compare_divisions, 0); // what CLI11 makes of --compare without a list
  } catch (const CLI::ParseError& error) {
    if (argc > 1 && argv[1][0] != '-' && app.get_subcommands().empty()) {
      std::fprintf(stderr, "ents-host: \"%s\" is not a command; write run, variants, verify, check or chart, or --help\n", argv[1]);
      return 2;
    }
    return app.exit(error) == 0 ? 0 : 2; // 0: --help
  }
  try {
    if (run_app->parsed()) return run_command(common, run);
    if (variants_app->parsed()) return variants_command(common, variants);
    if (verify_app->parsed()) return verify_command(common, verify);
    if (chart_app->parsed()) return chart_command(common, chart);
    return check_command(common, check);
  } catch (const InputError& error) {
    std::fprintf(stderr, "ents-host: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ents-host: %s\n", error.what());
    return 1;
  }
}
