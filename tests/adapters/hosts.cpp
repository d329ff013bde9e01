// SPDX-License-Identifier: BSD-3-Clause
#include "hosts.hpp"

#include "calculix_host.hpp"
#include "other_hosts.hpp"
#include "uel_host.hpp"

namespace adapters {

std::vector<HostKind> hosts() {
  return {
      {"abaqus_uel",
       [](const Elements& e) { return std::make_unique<UelHost>(e, UelHost::Program::abaqus); }},
      // A plane model is a layer of solids there.
      {"calculix", [](const Elements& e) { return std::make_unique<CalculixHost>(e); }, true, 3},
      {"abaqus_vuel", vuel_host, false, 0,
       false}, // an explicit increment cannot be cut, nor solved for multipliers
      {"opensees", opensees_host},
      {"opensees_frame", opensees_frame_host},
      {"feap", feap_host, false},
      {"ansys", ansys_host},
      // State variables come back as begin + increment: one rounding more.
      {"marc", marc_host, false, 0, true, false},
      {"lsdyna", lsdyna_host, false, 3, false},
  };
}

} // namespace adapters
