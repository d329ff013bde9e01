// SPDX-License-Identifier: BSD-3-Clause
// What the emulated hosts have in common: each owns the contact elements of a small problem, keeps their
// history as its host does, and calls its adapter as its host would. Answers come back in one form, so that
// one solver serves all of them.
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

  int unknowns() const { return static_cast<int>(reference.size()); }
};

/// One element's answer. Empty residual: the host was asked to cut its increment.
struct Answer {
  std::vector<double> residual; ///< [nodes of the element][d], R = dW/du
  std::vector<double> tangent;  ///< column-major, [rows][rows]
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

  const Elements elements_;
  std::vector<double> begin_;
};

} // namespace adapters
