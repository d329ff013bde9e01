// SPDX-License-Identifier: BSD-3-Clause
#include "hosts.hpp"

#include "uel_host.hpp"

namespace adapters {

std::vector<HostKind> hosts() {
  return {
      {"abaqus_uel", [](const Elements& e) { return std::make_unique<UelHost>(e, UelHost::Program::abaqus); }},
  };
}

} // namespace adapters
