// SPDX-License-Identifier: BSD-3-Clause
// ents-lab: the command line.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include <CLI/CLI.hpp>

#include "arguments.hpp"
#include "commands.hpp"
#include "sublaw_options.hpp"
#include "toolbox/error.hpp"

namespace {

using host::integer;
using host::number_check;
using host::positive;

constexpr const char* command_names = "run, variants, sublaw, verify, check or chart, or --help";

/// The command line, and what it says.
class Program {
public:
  Program() {
    app_.footer("Exit codes: 0 done, 1 the job failed, 2 the command line or an input file is wrong.\n\n"
                "Examples:\n"
                "  ents-lab run examples/hertz2d/scene.json --out out/hertz2d\n"
                "  ents-lab run examples/westergaard/scene.json --compare\n"
                "  ents-lab variants examples/hertz2d/scene.json\n"
                "  ents-lab sublaw scan.txt --from 0.5 --unit 1e-6 --modulus 1100\n"
                "  ents-lab verify tests/mechanics/golden/*.json\n"
                "  ents-lab check model.json --mesh master.inp\n"
                "  ents-lab chart --out out/chart\n\n"
                "ents-lab SUBCOMMAND --help says more of each.");
    app_.require_subcommand(1);
    add_run(), add_variants(), add_verify(), add_check(), add_chart();
    sublaw_app_ = host::add_sublaw(app_, sublaw_);
    add_common(*sublaw_app_);
  }

  int run(int argc, char** argv) {
    if (const int code = parse(argc, argv); code >= 0) return code;
    return perform();
  }

private:
  void add_common(CLI::App& command) {
    command.add_option("--library", common_.library,
                       "libents.so to load [../lib/libents.so from the program's folder, else the system's]");
    command.add_flag("--json", common_.json, "print the result as JSON on stdout, and nothing else there");
  }
  void add_run();
  void add_increments();
  void explain_run();
  void add_variants();
  void add_verify();
  void add_check();
  void explain_check();
  void add_chart();
  int parse(int argc, char** argv);
  int perform();

  CLI::App app_{"Laboratory of ents, enriched node-to-segment contact.\n"
                "On top of the reference host: it loads libents.so and knows nothing of it but ents.h.\n",
                "ents-lab"};
  CLI::App *run_app_ = nullptr, *variants_app_ = nullptr, *sublaw_app_ = nullptr, *verify_app_ = nullptr,
           *check_app_ = nullptr, *chart_app_ = nullptr;
  CLI::Option* compare_ = nullptr;
  std::string compare_list_;
  host::CommonOptions common_;
  host::RunOptions run_;
  host::VariantsOptions variants_;
  host::SublawOptions sublaw_;
  host::VerifyOptions verify_;
  host::CheckOptions check_;
  host::ChartOptions chart_;
};

void Program::add_run() {
  run_app_ = app_.add_subcommand("run", "Solve a scene");
  run_app_->add_option("scene", run_.scene, "scene file; examples/laboratory/README.md describes its keys")
      ->required()
      ->type_name("FILE");
  run_app_
      ->add_option("--out", run_.out,
                   "folder for result.json, the VTU series (open result.pvd in ParaView), checkpoints and "
                   "the pictures; no "
                   "other run may write into it meanwhile; without it nothing is written but the lines on "
                   "the terminal")
      ->type_name("DIR");
  run_app_
      ->add_option(
          "--explicit", run_.explicit_divisions,
          "replace the enriched segment by a mesh of N (3D: N x N) plain segments of the same geometry")
      ->check(integer(1, 100000))
      ->type_name("N");
  compare_ = run_app_
                 ->add_option("--compare", compare_list_,
                              "solve the scene as it is and with explicit meshes of N1,N2,... segments per "
                              "direction [the scene's own list]; print how they converge and what they cost")
                 ->type_name("N1,N2,...")
                 ->excludes("--explicit");
  add_increments();
  add_common(*run_app_);
  explain_run();
}

/// How steps are taken, and what is left of them.
void Program::add_increments() {
  run_app_->add_flag_callback(
      "--no-pictures", [this] { run_.pictures = false; }, "leave the pictures out");
  run_app_->add_option("--variant", run_.variant,
                       "solve one of the scene's variants (its key \"variants\") instead");
  run_app_->add_flag(
      "--nodes", run_.nodes,
      "gap, pressure, traction, slip, status, segment and force of every slave node in the JSON result");
  run_app_
      ->add_option("--cut", run_.cut,
                   "take every step in two halves, or in one to four increments of random sizes")
      ->check(CLI::IsMember({"halves", "random"}));
  run_app_->add_option("--seed", run_.seed, "of --cut random [1]")->check(integer(0, 4294967295));
  run_app_->add_flag(
      "--discard", run_.discard,
      "before the increments solve others (the whole step; with --cut random now and then some parts) and "
      "throw them away: the result must not change by a bit, see \"fingerprint\" in it");
  run_app_->add_option("--last-step", run_.last_step, "stop after this step")->check(integer(1, 1000000));
  run_app_
      ->add_option("--restart", run_.restart,
                   "continue from the checkpoint.json that a run left in its --out folder, or from "
                   "checkpoint_before.json, that of "
                   "one step before; the same folder keeps the earlier steps in result.pvd")
      ->check(CLI::ExistingFile);
  for (const char* other : {"--restart", "--cut", "--seed", "--discard", "--last-step", "--nodes"})
    compare_->excludes(other); // each mesh is solved in one go, by the library itself
}

void Program::explain_run() {
  run_app_->footer(
      "A scene needs dimension, formulation (2D), materials, parts and steps; and supports, "
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
}

void Program::add_variants() {
  variants_app_ = app_.add_subcommand(
      "variants",
      "Solve a scene and all its variants; one table compares error, penetration, iterations, time");
  variants_app_->add_option("scene", variants_.scene, "scene file with a key \"variants\"")
      ->required()
      ->type_name("FILE");
  add_common(*variants_app_);
  variants_app_->footer(
      "The first row, \"as it is\", is the scene without a variant. Columns: steps solved; of the last step "
      "the relative error of each\n"
      "quantity of the exact solution (none without /exact), and the deepest penetration over the size of "
      "the slave surface; of all\n"
      "steps Newton's iterations, cuts, and the time. A variant that fails has no penetration; below the "
      "table stands why.\n\n"
      "Example:\n"
      "  ents-lab variants examples/hertz2d/scene.json                      six laws of contact");
}

void Program::add_verify() {
  verify_app_ = app_.add_subcommand(
      "verify", "Compare the library with golden vectors (references computed with 100 digits)");
  verify_app_->add_option("files", verify_.files, "golden files")->required()->check(CLI::ExistingFile);
  verify_app_->add_option("--tolerance", verify_.tolerance, "largest relative error that passes")
      ->check(number_check("a number >= 0", [](double value) { return value >= 0; }))
      ->capture_default_str();
  add_common(*verify_app_);
  verify_app_->footer(
      "One row per file. Columns: worst relative error of each quantity, gaps relative to the "
      "segment's size; exit 1 above --tolerance.\n"
      "Quantities: xi, normal, gap and normal gap, gradients (d_) and Hessians (d2_) with "
      "respect to the coordinates of the nodes.\n\n"
      "Example:\n"
      "  ents-lab verify tests/mechanics/golden/*.json");
}

void Program::add_check() {
  check_app_ =
      app_.add_subcommand("check", "Is the enrichment of a model admissible? Exit code 1 and what fails, "
                                   "where and by how much, if not. And what does it need?");
  check_app_
      ->add_option(
          "model", check_.model,
          "model file (JSON, as ents_model_create_from_file reads it), or a scene: its model on its own "
          "segments, and whether its slave mesh is fine enough for the height")
      ->required();
  check_app_->add_option("--variant", check_.variant, "of the scene, from its key \"variants\"");
  check_app_->add_option(
      "--mesh", check_.mesh,
      "where the segments are: a .json file {\"nodes\": [[x, y], ...], \"segments\": [[0, 1], ...]} "
      "or an Abaqus/CalculiX deck whose elements are the segments [one segment whose nodes lie "
      "at their natural coordinates]");
  check_app_
      ->add_option("--samples", check_.samples,
                   "grid points per direction of a segment [as the height asks for]")
      ->check(integer(2, 4096));
  check_app_
      ->add_option("--reach", check_.reach,
                   "a slave node this far from the surface shall have one normal projection [the model's "
                   "\"penetration_limit\"; "
                   "without one: for information]")
      ->check(positive());
  check_app_
      ->add_option("--kink", check_.kink,
                   "largest angle of the normals where segments meet, degrees [for information]")
      ->check(
          number_check("an angle from 0 to 180", [](double value) { return value >= 0 && value <= 180; }));
  check_app_->add_option("--out", check_.out,
                         "folder for a picture of the enriched surface with the offending places marked");
  add_common(*check_app_);
  explain_check();
}

void Program::explain_check() {
  check_app_->footer(
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
}

void Program::add_chart() {
  chart_app_ = app_.add_subcommand(
      "chart",
      "What does an error cost, and where does each method work? Work-precision diagrams and stability maps");
  chart_app_
      ->add_option("--out", chart_.out,
                   "folder for chart.html (one page, no network), chart.json and the pictures")
      ->type_name("DIR");
  chart_app_->add_flag("--quick", chart_.quick, "a few runs of each scene and points of each map");
  chart_app_->add_option("--only", chart_.only, "these scenes alone, as wavy3d,rough_truth, and no maps")
      ->type_name("NAME")
      ->delimiter(',');
  chart_app_
      ->add_option("--scenes", chart_.scenes,
                   "the folder examples of the sources [from the program's folder]")
      ->type_name("DIR");
  chart_app_->add_flag_callback(
      "--no-pictures", [this] { chart_.pictures = false; }, "leave the pictures out; the page has its own");
  add_common(*chart_app_);
  chart_app_->footer("Exit code 1 if any result is wrong without a status or flag that says so.\n\n"
                     "Example:\n"
                     "  ents-lab chart --out out/chart && xdg-open out/chart/chart.html");
}

/// @return an exit code; -1: the command line is right
int Program::parse(int argc, char** argv) {
  try {
    app_.parse(host::arguments(argc, argv));
    run_.compare = compare_->count() > 0;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app_.exit(error); // --help
    if (!app_.get_subcommands().empty()) {
      const CLI::App& command = *app_.get_subcommands().front();
      const std::string name = "ents-lab " + command.get_name();
      std::fprintf(stderr, "%s: %s\n%s --help lists what there is\n", name.c_str(),
                   host::parse_error(command, error).c_str(), name.c_str());
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
  return -1;
}

int Program::perform() {
  using namespace host;
  try {
    run_.compare_divisions = divisions_of(compare_list_);
    if (run_app_->parsed()) return run_command(common_, run_);
    if (variants_app_->parsed()) return variants_command(common_, variants_);
    if (sublaw_app_->parsed()) return sublaw_command(common_, sublaw_);
    if (verify_app_->parsed()) return verify_command(common_, verify_);
    if (chart_app_->parsed()) return chart_command(common_, chart_);
    return check_command(common_, check_);
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
  const int code = Program().run(argc, argv);
  // Answers that never arrived shall not look like success.
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  std::fprintf(stderr, "ents-lab: stdout cannot be written: %s\n", std::strerror(errno));
  return code == 0 ? 1 : code;
}
