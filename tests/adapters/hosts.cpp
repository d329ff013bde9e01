// SPDX-License-Identifier: BSD-3-Clause
#include "hosts.hpp"

#include "calculix_host.hpp"
#include "other_hosts.hpp"
#include "uel_host.hpp"

namespace adapters {
namespace {

std::unique_ptr<EmulatedHost> abaqus_host(const Elements& elements) {
  return std::make_unique<UelHost>(elements, UelHost::Program::abaqus);
}

std::unique_ptr<EmulatedHost> calculix_host(const Elements& elements) {
  return std::make_unique<CalculixHost>(elements);
}

} // namespace

std::vector<HostKind> hosts() {
  return {
      {.name = "abaqus", .make = abaqus_host, .title = "Abaqus/Standard", .coordinates = true},
      // A plane model is a layer of solids there.
      {.name = "calculix", .make = calculix_host, .dimension = 3, .title = "CalculiX", .nodes = 20},
      // An explicit increment cannot be cut, nor solved for multipliers.
      {.name = "abaqus_explicit",
       .make = vuel_host,
       .cuts = false,
       .multipliers = false,
       .title = "Abaqus/Explicit",
       .coordinates = true,
       .stiffness = false},
      {.name = "opensees", .make = opensees_host, .title = "OpenSees", .nodes = 18},
      {.name = "opensees_frame", .make = opensees_frame_host, .title = "OpenSees", .nodes = 18},
      {.name = "feap", .make = feap_host, .cuts = false, .title = "FEAP"},
      {.name = "ansys", .make = ansys_host, .title = "Ansys MAPDL", .coordinates = true},
      // State variables come back as begin + increment: one rounding more.
      {.name = "marc", .make = marc_host, .cuts = false, .same_bits = false, .title = "MSC Marc"},
      {.name = "lsdyna",
       .make = lsdyna_host,
       .cuts = false,
       .dimension = 3,
       .multipliers = false,
       .title = "LS-DYNA",
       .nodes = 8},
  };
}

} // namespace adapters
