// SPDX-License-Identifier: BSD-3-Clause
// A small problem for every host: slave nodes that hang on springs are pressed on and dragged over textured
// segments whose nodes stand on springs. The springs of a node couple its components without symmetry, nodes
// are scattered irregularly in all directions: an index in the wrong place changes the solution.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "emulated_host.hpp"

namespace adapters {

struct Problem {
  std::string name;
  Elements elements;
  std::vector<double> spring; ///< [nodes][d][d] stiffness, row by row
  std::vector<double> target; ///< [nodes][d] displacement of the springs' feet at the end of the path
  int increments = 4;
};

struct ProblemName {
  std::string name;
  int dimension;
  bool multipliers;
};
std::vector<ProblemName> problem_names();

/// Writes ents_k.json, with a k of its own, into the working directory. The same numbers in every call.
Problem problem(const std::string& name);

/// Displacements that press all slave nodes, and move every node differently.
std::vector<double> pressed(const Problem& problem);

/// What a host program keeps of its run.
struct Solution {
  std::vector<double> displacement; ///< [increments][unknowns]
  std::vector<int> iterations;      ///< of each increment, cuts included
  int cuts = 0;
  int in_contact = 0; ///< elements that carry a force at the end
};

/// Newton's iteration with step cutting.
/// @throws std::runtime_error if it does not converge
Solution solve(const Problem& problem, EmulatedHost& host);

/// No adapter: the plain ABI.
std::unique_ptr<EmulatedHost> plain_host(const Elements& elements);

} // namespace adapters
