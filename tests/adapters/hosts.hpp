// SPDX-License-Identifier: BSD-3-Clause
// All emulated hosts of a test program, by name.
#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <tuple>

#include "emulated_host.hpp"
#include "problem.hpp"

namespace adapters {

struct HostKind {
  std::string name;
  std::function<std::unique_ptr<EmulatedHost>(const Elements&)> make;
  bool cuts = true;        ///< it can cut its increments when an element asks for it
  int dimension = 0;       ///< 0: both
  bool multipliers = true; ///< its elements can carry them as unknowns
  bool same_bits = true;   ///< its elements get the positions that the plain interface gets, to the last bit
  // For scenes: what the program calls itself, and what its elements can have.
  std::string title = "";
  int nodes = 0;            ///< the most that an element can have; 0: no limit of the program
  bool coordinates = false; ///< elements can carry surface coordinates, else they are the model's
  bool stiffness = true;    ///< the program asks for one
};
inline void PrintTo(const HostKind& kind, std::ostream* out) { *out << kind.name; }

std::vector<HostKind> hosts();

/// Hosts with the problems that they can have.
inline std::vector<std::tuple<HostKind, std::string>> hosts_and_problems() {
  std::vector<std::tuple<HostKind, std::string>> pairs;
  for (const HostKind& host : hosts())
    for (const ProblemName& p : problem_names())
      if ((host.dimension == 0 || host.dimension == p.dimension) && (host.multipliers || !p.multipliers))
        pairs.emplace_back(host, p.name);
  return pairs;
}

} // namespace adapters
