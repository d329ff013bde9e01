// SPDX-License-Identifier: BSD-3-Clause
#include "hosts.hpp"

#include "calculix_host.hpp"
#include "uel_host.hpp"

namespace adapters {

std::vector<HostKind> hosts() {
  return {
      {"abaqus_uel", [](const Elements& e) { return std::make_unique<UelHost>(e, UelHost::Program::abaqus); }},
      // A plane model is a layer of solids there.
      {"calculix", [](const Elements& e) { return std::make_unique<CalculixHost>(e); }, true, 3},
  };
}

} // namespace adapters
