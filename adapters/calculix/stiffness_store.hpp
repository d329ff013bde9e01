// SPDX-License-Identifier: BSD-3-Clause
// ccx asks twice in an iteration: for forces, with the history of the element, and for its stiffness,
// without. Both come from the same place only if the stiffness is kept from the force pass, which has just
// been at the displacements whose residual is being solved for.
#pragma once

#include <map>
#include <mutex>
#include <set>
#include <vector>

namespace ccx {

inline constexpr int leading_dimension = 60; ///< s(60,60): 20 nodes of 3 degrees of freedom

/// Column-major stiffness of an element as its last force pass left it; empty before. Elements come from
/// several threads, each from one at a time.
std::vector<double>& stiffness(int element);

/// What flows through an element with heat, as its last force pass left it.
struct HeatFlow {
  std::vector<double> power;       ///< [nodes] that leaves each node [F L / time]
  std::vector<double> conductance; ///< [nodes][nodes] its derivatives by the temperatures, symmetric
};

/// Of the elements with heat. begin_heat() names those of a step before its first pass; one thread calls it.
HeatFlow& heat_flow(int element);
bool has_heat(int element);
void begin_heat(const std::set<int>& elements);

/// "*ERROR in LABEL: message" into ccx's output, and its exit status.
[[noreturn]] void stop(const char* label, const char* message);

/// Stops where ccx has made no room for `size` history variables: in linear steps.
void check_history(const char* label, int element, int size, const double* begin, const double* end);

/// Stops a step that is linear.
[[noreturn]] void stop_linear(const char* label, int element);

} // namespace ccx
