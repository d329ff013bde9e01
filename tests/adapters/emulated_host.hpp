// SPDX-License-Identifier: BSD-3-Clause
// What the emulated hosts have in common: each owns contact elements, keeps their history as its host does,
// and calls its adapter as its host would. Answers come back in one form, so that one solver serves all of
// them: that of a small problem (problem.hpp), and that of the scenes (scene_route.hpp), where a host owns one
// element for one evaluation.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace adapters {

/// Contact elements over shared nodes. Every host gets the same.
struct Elements {
  int dimension = 0;
  int model = 0;                       ///< number k of ents_k.json
  std::vector<double> reference;       ///< [nodes][d]
  std::vector<std::vector<int>> nodes; ///< slave, master nodes, the node of the multipliers if any
  std::vector<double> area;
  int state_size = 0;
  int multipliers = 0;
  bool symmetric = false; ///< the tangent
  int options = 0;        ///< the deck's
  bool body = false; ///< slave, reference node of a rigid body, and a node whose displacements are its turns
  bool stiffness = true;                   ///< is asked for, also where the host itself has none
  std::vector<double> surface_coordinates; ///< of every element's master nodes, where the deck gives them

  int unknowns() const { return static_cast<int>(reference.size()); }
};

/// One element's answer. Empty residual: the host was asked to cut its increment.
struct Answer {
  std::vector<double> residual; ///< [nodes of the element][d], R = dW/du
  std::vector<double> tangent;  ///< column-major, [rows][rows]; empty: there is none (Elements::stiffness)
  double step_factor = 1;
};

/// The adapter stopped the job through the host's own channel.
struct HostStopped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class EmulatedHost {
public:
  explicit EmulatedHost(const Elements& elements) : elements_(elements) {}
  virtual ~EmulatedHost() = default;
  EmulatedHost(const EmulatedHost&) = delete;
  EmulatedHost& operator=(const EmulatedHost&) = delete;

  /// An increment begins, for the first or a second time, from these displacements [nodes][d].
  virtual void begin(const std::vector<double>& displacement) { begin_ = displacement; }
  /// Any thread may ask for an element of its own.
  virtual Answer evaluate(int element, const std::vector<double>& displacement) = 0;
  /// The increment has converged: what the last evaluation left is the history.
  virtual void accept() = 0;
  /// History of an element at the begin of the increment, for a host that takes up a job of another one
  /// @param state  [state_size]; what the host keeps besides stays as it is
  virtual void set_history(int element, const std::vector<double>& state) = 0;
  /// What the last evaluation of this element leaves if its increment is accepted
  /// @return  [state_size] or more
  virtual std::vector<double> history(int element) = 0;
  /// Of an element, as the host passes it; -1: it passes none
  virtual int number(int /*element*/) const { return -1; }

protected:
  /// Entries of the element's nodes, one after the other.
  std::vector<double> gather(int element, const std::vector<double>& nodal) const {
    std::vector<double> values;
    for (const int node : nodes(element))
      for (int i = 0; i < elements_.dimension; ++i)
        values.push_back(nodal[static_cast<std::size_t>(node * elements_.dimension + i)]);
    return values;
  }
  /// What these displacements have changed by in the increment
  std::vector<double> gather_change(int element, const std::vector<double>& displacement) const {
    std::vector<double> values = gather(element, displacement);
    const std::vector<double> old =
        begin_.empty() ? std::vector<double>(values.size()) : gather(element, begin_);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] -= old[i];
    return values;
  }
  const std::vector<int>& nodes(int element) const {
    return elements_.nodes[static_cast<std::size_t>(element)];
  }
  double area(int element) const { return elements_.area[static_cast<std::size_t>(element)]; }
  /// Constants of a user element: model, area, and what the deck gives besides.
  std::vector<double> constants(int element) const {
    const std::vector<double>& coordinates = elements_.surface_coordinates;
    std::vector<double> values;
    values.reserve(3 + coordinates.size());
    values.insert(values.end(), {static_cast<double>(elements_.model), area(element)});
    if (elements_.options != 0 || !coordinates.empty()) values.push_back(elements_.options);
    values.insert(values.end(), coordinates.begin(), coordinates.end());
    return values;
  }

  const Elements elements_;
  std::vector<double> begin_;
};

} // namespace adapters
