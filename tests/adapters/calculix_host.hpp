// SPDX-License-Identifier: BSD-3-Clause
// CalculiX 2.20, emulated: its global arrays, its force pass with history and its stiffness pass without.
// U1A loads libents_abaqus.so.
#pragma once

#include "emulated_host.hpp"

namespace adapters {

class CalculixHost : public EmulatedHost {
public:
  /// @param element  "U1E" or "U1A"
  explicit CalculixHost(const Elements& elements, const std::string& element = "U1E");

  Answer evaluate(int element, const std::vector<double>& displacement) override;
  void accept() override { xstateini_ = xstate_; }
  void set_history(int element, const std::vector<double>& state) override;
  std::vector<double> history(int element) override;
  /// As in a *STEP without NLGEOM and in *BUCKLE: there is no memory for the history.
  void linear_step() { linear_step_ = true; }

private:
  std::vector<int> kon_, ipkon_, ielprop_;
  std::string lakon_; ///< 8 characters an element
  std::vector<double> co_, prop_, xstateini_, xstate_;
  int mi_[3] = {1, 3, 1}; ///< integration points, dofs of a node, layers
  int nstate_;
  bool uel_, linear_step_ = false;
};

} // namespace adapters
