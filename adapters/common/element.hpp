// SPDX-License-Identifier: BSD-3-Clause
// One contact element between a host's arrays and the library: dof order, sign, reference + displacement,
// properties, history. Written once; the hosts' entry routines say where things lie and nothing else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace ents_adapter {

/// A host's two-dimensional array wherever and however it lies: (i, j) is data[i * first + j * second].
template <class T> struct Grid {
  T* data = nullptr;
  std::ptrdiff_t first = 1, second = 0;
  T& operator()(std::ptrdiff_t i, std::ptrdiff_t j) const { return data[i * first + j * second]; }
  explicit operator bool() const { return data != nullptr; }
};

template <class T> struct Row {
  T* data = nullptr;
  std::ptrdiff_t stride = 1;
  T& operator()(std::ptrdiff_t i) const { return data[i * stride]; }
  explicit operator bool() const { return data != nullptr; }
};

/// What a deck may add up in property 3.
enum Option {
  option_selfcheck = 1,
  option_old_displacement = 2,
  option_negative_tangent = 4,
  option_slave_point =
      8, ///< properties 4 .. are n and n weights of the slave's nodes, before surface coordinates
  option_may_leave = 16, ///< a slave that leaves its segments while in contact is open, without a word: the
                         ///< master ends there
  option_offset = 32     ///< property 4 is a length [L] that is added to the gap; the model has "offset"
};
inline constexpr int common_options =
    option_selfcheck | option_slave_point | option_may_leave | option_offset;

/// What a host calls the things that a user can get wrong: a number is put behind each.
struct Host {
  const char* nodes;            ///< "*USER ELEMENT, NODES="
  const char* history;          ///< "*USER ELEMENT, VARIABLES="
  const char* properties;       ///< "*UEL PROPERTY, entry "
  std::string (*directory)();   ///< the job's directory, see model_number
  bool spare_nodes = false;     ///< the host's element may have more nodes than needed
  bool multipliers = true;      ///< its elements can carry them as unknowns
  bool displacements = true;    ///< it passes them; else present positions alone
  bool rotations = false;       ///< its nodes can have rotations as degrees of freedom
  bool temperatures = false;    ///< and temperatures
  const char* heat = "";        ///< what to write for a temperature in each node, or where else to go
  int own_history = 0;          ///< variables that it keeps before those of the model
  int options = common_options; ///< those that mean something there
  const char* numbers = "";     ///< what to know of the elements' numbers where one is not in the table
};

/// Properties of an element, in this order in every host:
///   1  k, whole number: the model is ents_k.json
///   2  tributary area of the slave node [A], > 0; 0: from ents_k.txt
///   3  a sum of the options that the host has. May be absent
///   4 ..  with option 8: n, then n weights of the slave's nodes; surface coordinates [m][d-1] of the master
///         nodes. May be absent; zeros at the end do not count
struct Element {
  const Host* host = nullptr;
  std::int64_t number = -1; ///< the host's; -1: it has none
  bool listed = true;       ///< the number is that of an element, which ents_k.txt may have a line for
  int nodes = 0;        ///< slave (or the nodes of the face that a slave point lies in), master nodes of the
                        ///< segment, then one for the multipliers if the model has any
  int dofs = 0;         ///< per node; the reference node of a rigid body may have rotations behind them
  int temperature = -1; ///< dof of each node that is its temperature; -1: there is none
  int all_dofs = 0;     ///< of the element, for messages; 0: nodes * dofs
  double time_increment =
      0; ///< for the heat of friction, a power, and coefficients that depend on the slip rate
  bool reference_turns = false; ///< it has (body.hpp): 3 rotations, in the plane one, in all arrays of dofs
  int coordinates = 0;          ///< per node
  Grid<const double> position;  ///< (coordinate, node) reference, or current with no displacement, [L]
  Grid<const double>
      displacement;             ///< (dof, node) or null; multipliers are the "displacements" of the last node
  Grid<const double> increment; ///< (dof, node) or null: added, too
  Grid<const double>
      change; ///< (dof, node) or null: what of the above belongs to this increment. A slave that touches
              ///< within an increment without a history has friction only where it is known
  Grid<const double> undone; ///< (dof, node) or null: subtracted, for the begin of the increment
  /// What a node has moved by: the only place where these arrays are read, and only dofs that the element has.
  double moved(int i, int node) const {
    double u = displacement ? displacement(i, node) : 0.0;
    if (increment) u += increment(i, node);
    return undone ? u - undone(i, node) : u;
  }
  Row<const double> spin; ///< [3] rotation vector of the reference node in this increment, or null: none
  Row<const double> properties;
  int property_count = 0;
  Row<const double>
      history; ///< begin of the increment; all zero: none yet. May be the same memory as `history_end`
  int history_size = 0;
  double sign = 1;         ///< of the residual: -1 where the host wants external minus internal
  double tangent_sign = 1; ///< of the tangent
  // Out; null: not wanted. Every entry is written: (nodes * dofs), zero where nothing acts.
  Grid<double> residual;         ///< (dof, node) [F]; of a temperature: the power that leaves the node
  Grid<double> tangent;          ///< (row, column), node-major, [F/L]
  Row<double> history_end;       ///< [history_size] end of the increment
  double* energy = nullptr;      ///< [1] [F L] stored by normal and tangential law
  double* dissipation = nullptr; ///< [1] [F L] what friction dissipates in this increment
};

enum class Outcome {
  done,
  cut, ///< the host should repeat the increment with `step_factor` of its size; residual and tangent are zero
  failed ///< the deck or the model is wrong, the job should stop; residual and tangent are zero
};

struct Result {
  Outcome outcome = Outcome::done;
  double step_factor = 1;       ///< in (0, 1) for Outcome::cut
  bool symmetric = true;        ///< the tangent of this model always is
  bool symmetric_forces = true; ///< its block of forces by displacements
  bool contact = false;         ///< the element carries pressure
  bool left = false;            ///< `cut` because the slave has left its segments while in contact
  bool beside = false;          ///< open, beside the model's patch and below the surface that goes on there
  double depth = 0;             ///< [L] below it
  int dimension = 0, state_size = 0; ///< of the model, as far as it could be read
  bool heat = false, rigid = false;  ///< the model has "heat", "master": "rigid"
  char message[1024];                ///< for `cut` and `failed`, and what the selfcheck found; else empty
};

/// @return what happened; the history is written for `done` only
Result evaluate(const Element& element);

/// Rotations that the element's last node has: 3 of a reference node of a rigid body in space, 1 in the
/// plane, else 0. For hosts with rotations; reads host, number, nodes, and properties.
int reference_rotations(const Element& element);

/// The value of an option property; 0 if it is absent, -1 if it is no sum of options of any host.
int options(const Row<const double>& properties, int count);

/// result = -matrix vector, both [n]: forces of a small change about the present state.
void negative_product(const Grid<const double>& matrix, int n, const double* vector, double* result);

/// What evaluate() would say to an element's description, without evaluating: for hosts that ask once, before
/// the job.
Result check(const Element& element);

} // namespace ents_adapter
