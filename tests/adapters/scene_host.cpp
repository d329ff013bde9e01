// SPDX-License-Identifier: BSD-3-Clause
// adapters_scene: ents-lab run, with the contact through the adapter of another program.
#include <cstdio>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "scene_route.hpp"
#include "toolbox/error.hpp"

int main(int argc, char** argv) {
  CLI::App app{"Solve a scene of ents-lab with the contact through the adapter of another program, which is "
               "emulated",
               "adapters_scene"};
  host::CommonOptions common;
  host::RunOptions run;
  run.pictures = false;
  std::string adapter, names;
  for (const std::string& name : adapters::route_names()) names += (names.empty() ? "" : ", ") + name;
  app.add_option("scene", run.scene, "scene file of ents-lab run")->required()->type_name("FILE");
  app.add_option("--adapter", adapter, names)->required()->type_name("NAME");
  app.add_option("--out", run.out, "folder for result.json and the VTU series")->type_name("DIR");
  app.add_option("--variant", run.variant, "one of the scene's variants");
  app.add_option("--last-step", run.last_step, "stop after this step")->check(CLI::PositiveNumber);
  app.add_flag("--nodes", run.nodes, "fields of the slave nodes in the JSON result");
  app.add_flag("--json", common.json, "print the result as JSON on stdout, and nothing else there");
  CLI11_PARSE(app, argc, argv);
  run.prepare = [&](const host::Scene& scene, host::EntsLibrary& library) {
    adapters::check_adapter(scene, adapter);
    adapters::install_adapter(library, adapter);
  };
  try {
    return host::run_command(common, run);
  } catch (const host::InputError& error) {
    std::fprintf(stderr, "adapters_scene: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "adapters_scene: %s\n", error.what());
    return 1;
  }
}
