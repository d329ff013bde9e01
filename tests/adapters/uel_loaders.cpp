// SPDX-License-Identifier: BSD-3-Clause
// Programs that are not Abaqus but load its user elements; they have none of Abaqus's services.
#include "calculix_host.hpp"
#include "hosts.hpp"
#include "uel_host.hpp"

namespace adapters {

std::vector<HostKind> hosts() {
  return {
      // It adds old solution and increment, in another order than the plain interface.
      {"moose", [](const Elements& e) { return std::make_unique<UelHost>(e, UelHost::Program::moose); },
       false, 0, true, false},
      {"moose_mesh",
       [](const Elements& e) { return std::make_unique<UelHost>(e, UelHost::Program::moose_mesh); }, false, 0,
       true, false},
      {"oofem", [](const Elements& e) { return std::make_unique<UelHost>(e, UelHost::Program::oofem); },
       false},
      {"calculix_u1a", [](const Elements& e) { return std::make_unique<CalculixHost>(e, "U1A"); }, true, 3},
  };
}

} // namespace adapters
