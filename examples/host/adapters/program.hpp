// SPDX-License-Identifier: BSD-3-Clause
// Programs whose adapters ents-host can call (--adapter), and one contact element as all of them see it. Each
// .cpp file says how its program calls a user element, and offers the functions of that program that the
// adapter calls back.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <ents.h>

#include "../error.hpp"

/// A function that adapters find in the program that loads them.
#define ENTS_HOST_SERVICE extern "C" __attribute__((visibility("default")))

namespace host::adapters {

/// Slave, master nodes, one more for multipliers if there are any; with a rigid body that turns slave,
/// reference node, and a node whose displacements are the turns. Outputs are NaN before the call.
struct UserElement {
  bool body = false;
  int dimension = 0, nodes = 0, state_size = 0;
  int place = 0;                         ///< in the present list of elements
  std::vector<double> position;          ///< [nodes][d]; here the whole motion is in the position
  std::vector<double> displacement;      ///< [nodes][d]: multipliers, else zero
  std::vector<double> properties;        ///< model number, area, options, surface coordinates
  std::vector<double> state;             ///< [state_size] begin of the increment; returns the end
  std::vector<double> residual, tangent; ///< out: [rows], R = dW/du; [rows][rows] column-major, K = dR/du
  double step_factor = 1;                ///< out, < 1: the increment shall be cut

  int rows() const { return dimension * nodes; }
};

/// Reference point and turns of a rigid body, as nodes at the end of the element; where the slave is in
/// space. The whole rotation is the history, and nothing has been turned since: the derivatives are by spins.
void add_body(UserElement& e, const ents_pose& pose);

struct Program {
  const char *name, *file; ///< of --adapter; the library
  const char* title;
  int dimension = 0;        ///< of its user elements; 0: both
  int nodes = 0;            ///< the most that an element can have; 0: no limit of the program
  bool multipliers = true;  ///< elements can carry them as unknowns
  bool cuts = true;         ///< an element can ask for a smaller increment
  bool coordinates = false; ///< elements can carry surface coordinates, else they are the model's
  bool tangent = true;      ///< asks for one
  void (*call)(void* library, UserElement& e) = nullptr;
};

extern const Program abaqus, abaqus_explicit, ansys, calculix, feap, lsdyna, marc, opensees;

/// A function or a common block of an adapter.
template <class Symbol> Symbol* find(void* library, const char* name) {
  void* symbol = dlsym(library, name);
  if (symbol == nullptr) throw JobError(std::string("the adapter has no ") + name);
  return reinterpret_cast<Symbol*>(symbol);
}

inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The adapter has called what ends a job in this program.
[[noreturn]] inline void stopped(const Program& program, const std::string& why) {
  throw JobError(std::string("--adapter ") + program.name + ": the adapter has ended the job: " + why);
}

} // namespace host::adapters
