// SPDX-License-Identifier: BSD-3-Clause
// ents-lab: the command line.
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <sstream>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "error.hpp"
#include "nearest_word.hpp"

namespace {

// CLI11's own ranges print their bounds with 300 digits and accept what is no number.
CLI::Validator number_check(const std::string& wanted, const std::function<bool(double)>& good) {
  return CLI::Validator(
      [=](const std::string& text) {
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool number = error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
        return number && good(value) ? std::string() : wanted + " is expected, this is \"" + text + "\"";
      },
      "");
}

CLI::Validator positive() {
  return number_check("a number > 0", [](double value) { return value > 0; });
}

CLI::Validator integer(std::int64_t low, std::int64_t high) {
  return number_check("an integer from " + std::to_string(low) + " to " + std::to_string(high),
                      [=](double value) {
                        return value == std::floor(value) && value >= static_cast<double>(low) &&
                               value <= static_cast<double>(high);
                      });
}

constexpr const char* own_list = "own"; // of the scene

/// Does a word after --compare belong to it? A scene may stand there, too.
bool is_list(const std::string& word) {
  return !word.empty() && word.find_first_not_of("0123456789,") == std::string::npos;
}

/// Arguments in the order in which CLI11 wants them, the last first.
std::vector<std::string> arguments(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i] == "--compare" && (i + 1 == words.size() || !is_list(words[i + 1])))
      words[i] += std::string("=") + own_list;
  std::reverse(words.begin(), words.end());
  return words;
}

std::vector<int> divisions_of(const std::string& list) {
  std::vector<int> divisions;
  std::istringstream words(list);
  for (std::string word; list != own_list && std::getline(words, word, ',');) {
    int n = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n);
    if (error != std::errc{} || end != word.data() + word.size() || n < 1 || n > 100000)
      throw host::InputError(
          "--compare: integers from 1 to 100000 with commas between them are expected, this is \"" + list +
          "\"");
    divisions.push_back(n);
  }
  return divisions;
}

/// What stands where no argument is expected, an option first; else what is wrong with those that are.
std::string parse_error(const CLI::App& command, const CLI::ParseError& error) {
  const std::vector<std::string> rest = command.remaining();
  const auto option =
      std::find_if(rest.begin(), rest.end(), [](const std::string& word) { return word.starts_with('-'); });
  if (option == rest.end()) {
    if (!rest.empty()) return "unexpected argument \"" + rest.front() + "\"";
    return error.what();
  }
  const std::string word = option->substr(0, option->find('='));
  std::vector<std::string> known;
  for (const CLI::Option* each : command.get_options())
    for (const std::string& name : each->get_lnames()) known.push_back("--" + name);
  const std::string near = host::nearest_word(word, known);
  return "unknown option " + word + (near.empty() ? "" : "; did you mean " + near + "?");
}

constexpr const char* command_names = "run, variants, verify, check or chart, or --help";

int run_program(int argc, char** argv) {
  using namespace host;
  CLI::App app{"Reference finite element host of ents, enriched node-to-segment contact.\n"
               "An ordinary host: it loads libents.so and knows nothing of it but ents.h.\n",
               "ents-lab"};
  app.footer("Exit codes: 0 done, 1 the job failed, 2 the command line or an input file is wrong.\n\n"
             "Examples:\n"
             "  ents-lab run examples/hertz2d/scene.json --out out/hertz2d\n"
             "  ents-lab run examples/westergaard/scene.json --compare\n"
             "  ents-lab variants examples/hertz2d/scene.json\n"
             "  ents-lab verify tests/mechanics/golden/*.json\n"
             "  ents-lab check model.json --mesh master.inp\n"
             "  ents-lab chart --out out/chart\n\n"
             "ents-lab SUBCOMMAND --help says more of each.");
  app.require_subcommand(1);
  CommonOptions common;
  const auto add_common = [&](CLI::App& command) {
    command.add_option("--library", common.library,
                       "libents.so to load [../lib/libents.so from the program's folder, else the system's]");
    command.add_flag("--json", common.json, "print the result as JSON on stdout, and nothing else there");
  };

  RunOptions run;
  CLI::App* run_app = app.add_subcommand("run", "Solve a scene");
  run_app->add_option("scene", run.scene, "scene file; examples/laboratory/README.md describes its keys")
      ->required()
      ->type_name("FILE");
  run_app
      ->add_option("--out", run.out,
                   "folder for result.json, the VTU series (open result.pvd in ParaView), checkpoints and "
                   "the pictures; no "
                   "other run may write into it meanwhile; without it nothing is written but the lines on "
                   "the terminal")
      ->type_name("DIR");
  run_app
      ->add_option(
          "--explicit", run.explicit_divisions,
          "replace the enriched segment by a mesh of N (3D: N x N) plain segments of the same geometry")
      ->check(integer(1, 100000))
      ->type_name("N");
  std::string compare_list;
  CLI::Option* compare =
      run_app
          ->add_option("--compare", compare_list,
                       "solve the scene as it is and with explicit meshes of N1,N2,... segments per "
                       "direction [the scene's own list]; print how they converge and what they cost")
          ->type_name("N1,N2,...")
          ->excludes("--explicit");
  run_app->add_flag_callback(
      "--no-pictures", [&] { run.pictures = false; }, "leave the pictures out");
  run_app->add_option("--variant", run.variant,
                      "solve one of the scene's variants (its key \"variants\") instead");
  run_app->add_flag(
      "--nodes", run.nodes,
      "gap, pressure, traction, slip, status, segment and force of every slave node in the JSON result");
  run_app
      ->add_option("--cut", run.cut,
                   "take every step in two halves, or in one to four increments of random sizes")
      ->check(CLI::IsMember({"halves", "random"}));
  run_app->add_option("--seed", run.seed, "of --cut random [1]")->check(integer(0, 4294967295));
  run_app->add_flag(
      "--discard", run.discard,
      "before the increments solve others (the whole step; with --cut random now and then some parts) and "
      "throw them away: the result must not change by a bit, see \"fingerprint\" in it");
  run_app->add_option("--last-step", run.last_step, "stop after this step")->check(integer(1, 1000000));
  run_app
      ->add_option("--restart", run.restart,
                   "continue from the checkpoint.json that a run left in its --out folder, or from "
                   "checkpoint_before.json, that of "
                   "one step before; the same folder keeps the earlier steps in result.pvd")
      ->check(CLI::ExistingFile);
  add_common(*run_app);
  run_app->footer("A scene needs dimension, formulation (2D), materials, parts and steps; and supports, "
                  "springs or a half_space, to hold the bodies.\n"
                  "The schema of /contact/model is abi/model.schema.json.\n\n"
                  "Each step prints one line: approach and force of the rigid master, the relative residual "
                  "of every Newton iteration, and\n"
                  "its last two reductions. A step that fails is cut into parts; steps too small end the run "
                  "with exit code 1;\n"
                  "the steps solved before are reported and written.\n\n"
                  "Friction: slip begins where \"traction\", per area of the surface, reaches mu times the "
                  "pressure. A penalty leaves a gap g\n"
                  "at which the force on the slave node is another one: tangential over normal force is mu / "
                  "(1 - kappa |g|) in slip, with\n"
                  "the curvature kappa of the enriched surface along it (> 0 on crests); a stiffer penalty "
                  "or a multiplier brings it to mu.\n\n"
                  "A file is replaced when the new one is on the disk: a run that is killed or finds the "
                  "disk full leaves the files of the\n"
                  "last whole step, of which checkpoint.json has a checksum.\n\n"
                  "Examples:\n"
                  "  ents-lab run examples/rough_afm/scene.json --out out/rough_afm     a measured surface "
                  "on ONE segment\n"
                  "  ents-lab run examples/hertz2d/scene.json --explicit 95             the same with 95 "
                  "plain segments\n"
                  "  ents-lab run examples/westergaard/scene.json --compare             how the two "
                  "converge to each other\n"
                  "  ents-lab run examples/hertz3d/scene.json --json | jq .steps[-1].exact");

  VariantsOptions variants;
  CLI::App* variants_app = app.add_subcommand(
      "variants",
      "Solve a scene and all its variants; one table compares error, penetration, iterations, time");
  variants_app->add_option("scene", variants.scene, "scene file with a key \"variants\"")
      ->required()
      ->type_name("FILE");
  add_common(*variants_app);
  variants_app->footer(
      "The first row, \"as it is\", is the scene without a variant. Columns: steps solved; of the last step "
      "the relative error of each\n"
      "quantity of the exact solution (none without /exact), and the deepest penetration over the size of "
      "the slave surface; of all\n"
      "steps Newton's iterations, cuts, and the time. A variant that fails has no penetration; below the "
      "table stands why.\n\n"
      "Example:\n"
      "  ents-lab variants examples/hertz2d/scene.json                      six laws of contact");

  VerifyOptions verify;
  CLI::App* verify_app = app.add_subcommand(
      "verify", "Compare the library with golden vectors (references computed with 100 digits)");
  verify_app->add_option("files", verify.files, "golden files")->required()->check(CLI::ExistingFile);
  verify_app->add_option("--tolerance", verify.tolerance, "largest relative error that passes")
      ->check(number_check("a number >= 0", [](double value) { return value >= 0; }))
      ->capture_default_str();
  add_common(*verify_app);
  verify_app->footer("One row per file. Columns: worst relative error of each quantity, gaps relative to the "
                     "segment's size; exit 1 above --tolerance.\n"
                     "Quantities: xi, normal, gap and normal gap, gradients (d_) and Hessians (d2_) with "
                     "respect to the coordinates of the nodes.\n\n"
                     "Example:\n"
                     "  ents-lab verify tests/mechanics/golden/*.json");

  CheckOptions check;
  CLI::App* check_app =
      app.add_subcommand("check", "Is the enrichment of a model admissible? Exit code 1 and what fails, "
                                  "where and by how much, if not. And what does it need?");
  check_app
      ->add_option(
          "model", check.model,
          "model file (JSON, as ents_model_create_from_file reads it), or a scene: its model on its own "
          "segments, and whether its slave mesh is fine enough for the height")
      ->required();
  check_app->add_option("--variant", check.variant, "of the scene, from its key \"variants\"");
  check_app->add_option(
      "--mesh", check.mesh,
      "where the segments are: a .json file {\"nodes\": [[x, y], ...], \"segments\": [[0, 1], ...]} "
      "or an Abaqus/CalculiX deck whose elements are the segments [one segment whose nodes lie "
      "at their natural coordinates]");
  check_app
      ->add_option("--samples", check.samples,
                   "grid points per direction of a segment [as the height asks for]")
      ->check(integer(2, 4096));
  check_app
      ->add_option("--reach", check.reach,
                   "a slave node this far from the surface shall have one normal projection [the model's "
                   "\"penetration_limit\"; "
                   "without one: for information]")
      ->check(positive());
  check_app
      ->add_option("--kink", check.kink,
                   "largest angle of the normals where segments meet, degrees [for information]")
      ->check(
          number_check("an angle from 0 to 180", [](double value) { return value >= 0 && value <= 180; }));
  check_app->add_option("--out", check.out,
                        "folder for a picture of the enriched surface with the offending places marked");
  add_common(*check_app);
  check_app->footer(
      "\"this scene needs: ...\" lists what the library computes for this model, \"it does not need: ...\" "
      "what it does not compute, and why.\n"
      "Both come from ents_layout.needs, which the library fills in; ents-bench --savings measures the time "
      "that each costs.\n"
      "Each condition prints its worst value on the whole surface, the bound, how much is missing, and "
      "where: the segment, natural\n"
      "coordinates on it and, for edges and pairs, the other segment. Lengths are the mesh's.\n\n"
      "Examples:\n"
      "  ents-lab check model.json                                        one flat segment of size 2\n"
      "  ents-lab check model.json --mesh surface.json --reach 0.1 --out out/check\n"
      "  ents-lab check scene.json                                        before a run of this scene\n"
      "  ents-lab check model.json --mesh shell.inp --json | jq .conditions");

  ChartOptions chart;
  CLI::App* chart_app = app.add_subcommand(
      "chart",
      "What does an error cost, and where does each method work? Work-precision diagrams and stability maps");
  chart_app
      ->add_option("--out", chart.out,
                   "folder for chart.html (one page, no network), chart.json and the pictures")
      ->type_name("DIR");
  chart_app->add_flag("--quick", chart.quick, "a few runs of each scene and points of each map");
  chart_app->add_option("--only", chart.only, "these scenes alone, as wavy3d,rough_truth, and no maps")
      ->type_name("NAME")
      ->delimiter(',');
  chart_app
      ->add_option("--scenes", chart.scenes, "the folder examples of the sources [from the program's folder]")
      ->type_name("DIR");
  chart_app->add_flag_callback(
      "--no-pictures", [&] { chart.pictures = false; }, "leave the pictures out; the page has its own");
  add_common(*chart_app);
  chart_app->footer("Exit code 1 if any result is wrong without a status or flag that says so.\n\n"
                    "Example:\n"
                    "  ents-lab chart --out out/chart && xdg-open out/chart/chart.html");

  for (const char* other : {"--restart", "--cut", "--seed", "--discard", "--last-step", "--nodes"})
    compare->excludes(other); // each mesh is solved in one go, by the library itself

  try {
    app.parse(arguments(argc, argv));
    run.compare = compare->count() > 0;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error); // --help
    if (!app.get_subcommands().empty()) {
      const CLI::App& command = *app.get_subcommands().front();
      const std::string name = "ents-lab " + command.get_name();
      std::fprintf(stderr, "%s: %s\n%s --help lists what there is\n", name.c_str(),
                   parse_error(command, error).c_str(), name.c_str());
      return 2;
    }
    if (argc < 2)
      std::fprintf(stderr, "ents-lab: a command is missing; write ents-lab with %s\n", command_names);
    else if (argv[1][0] == '-')
      std::fprintf(stderr, "ents-lab: \"%s\" is not an option here, options follow a command; write %s\n",
                   argv[1], command_names);
    else
      std::fprintf(stderr, "ents-lab: \"%s\" is not a command; write %s\n", argv[1], command_names);
    return 2;
  }
  try {
    run.compare_divisions = divisions_of(compare_list);
    if (run_app->parsed()) return run_command(common, run);
    if (variants_app->parsed()) return variants_command(common, variants);
    if (verify_app->parsed()) return verify_command(common, verify);
    if (chart_app->parsed()) return chart_command(common, chart);
    return check_command(common, check);
  } catch (const InputError& error) {
    std::fprintf(stderr, "ents-lab: %s\n", error.what());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "ents-lab: the equations are too large for the machine's memory, or for the "
                         "solver's 32-bit indices; take a coarser mesh (/parts), fewer points "
                         "(/contact/sampling), or fewer segments (--explicit, --compare)\n");
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ents-lab: %s\n", error.what());
    return 1;
  }
}

} // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN); // a file beyond the shell's limit gets the message of a full disk
  const int code = run_program(argc, argv);
  // Answers that never arrived shall not look like success.
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  std::fprintf(stderr, "ents-lab: stdout cannot be written: %s\n", std::strerror(errno));
  return code == 0 ? 1 : code;
}
