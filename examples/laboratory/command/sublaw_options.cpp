// SPDX-License-Identifier: BSD-3-Clause
#include "sublaw_options.hpp"

#include "arguments.hpp"

namespace host {

CLI::App* add_sublaw(CLI::App& app, SublawOptions& options) {
  CLI::App* command = app.add_subcommand(
      "sublaw",
      "The waves of a surface that no mesh resolves, as a contact law: pressure over gap, real area, "
      "stiffness and conductance from boundary elements of exactly these waves");
  command
      ->add_option("scan", options.scan,
                   "height map (a text file as models read it), or a .json file: a model or a scene, whose "
                   "height has a map or a spectrum (roughness, fourier, weierstrass)")
      ->required()
      ->check(CLI::ExistingFile)
      ->type_name("FILE");
  const auto number = [command](const char* name, double& value, const char* what) {
    return command->add_option(name, value, what)->check(positive());
  };
  number("--from", options.from, "waves shorter than this become the law; longer ones are left to a mesh")
      ->required();
  number("--to", options.to, "and waves shorter than this are left out of both [none]");
  number("--modulus", options.modulus, "E*, 1 / E* = (1 - nu1^2) / E1 + (1 - nu2^2) / E2")->required();
  command->add_option("--poisson", options.poisson, "nu of both bodies, for the tangential stiffness")
      ->check(number_check("a number from 0 to 0.5", [](double nu) { return nu >= 0 && nu <= 0.5; }))
      ->capture_default_str();
  number("--conductivity", options.conductivity,
         "k_s = 2 k1 k2 / (k1 + k2): the model part has the conductance of the interface, too");
  number("--unit", options.unit, "length unit in metres that a map is read in, 1e-6: micrometres [as it is]");
  command->add_option("--size", options.size, "lengths of the surface [as the file says]")
      ->expected(2)
      ->check(positive());
  command
      ->add_option("--points", options.points,
                   "cells along the longer side [6 per shortest wave, at most 512]")
      ->check(integer(16, 2048));
  command->add_option("--realisations", options.realisations, "surfaces of a spectrum that are averaged [4]")
      ->check(integer(1, 1000));
  command
      ->add_option("--out", options.out,
                   "folder for law.json (the part of a model), sublaw.json and pictures")
      ->type_name("DIR");
  command->add_flag_callback(
      "--no-pictures", [&options] { options.pictures = false; }, "leave the pictures out");
  command->footer(
      "The gap of the law is counted from the mean plane of the waves, which is the surface without them: a "
      "model "
      "whose height has\n"
      "\"cut_off\": FROM and whose \"contact\" is that of law.json has the whole surface. Columns: area, the "
      "real "
      "one in contact;\n"
      "stiffness, dp / d(-gap), and 2 (1 - nu) / (2 - nu) of it along the surface (Mindlin 1949), before "
      "slip; h_c / "
      "k_s, the\n"
      "conductance over the conductivity, stiffness / E* (Barber 2003). The law holds for its own pressures, "
      "the "
      "first and the last\n"
      "row, and where the pressure changes little within a wave of length FROM.\n\n"
      "The boundary elements of a surface are kept in $ENTS_CACHE (else ~/.cache/ents), by a hash of its "
      "waves, and "
      "serve every E*.\n\n"
      "Examples:\n"
      "  ents-lab sublaw examples/rough_afm/afm_10um_256.txt --unit 1e-6 --from 0.156 --modulus 1099 --out "
      "out/law\n"
      "  ents-lab sublaw examples/rough/scene.json --from 0.125 --modulus 1099 --realisations 8 --json");
  return command;
}

} // namespace host
