// SPDX-License-Identifier: BSD-3-Clause
// CalculiX 2.20, emulated: its global arrays, its force pass with history and its stiffness pass without.
#pragma once

#include "emulated_host.hpp"

namespace adapters {

class CalculixHost : public EmulatedHost {
public:
  explicit CalculixHost(const Elements& elements);

  Answer evaluate(int element, const std::vector<double>& displacement) override;
  void accept() override { xstateini_ = xstate_; }

private:
  std::vector<int> kon_, ipkon_, ielprop_;
  std::string lakon_; ///< 8 characters an element
  std::vector<double> co_, prop_, xstateini_, xstate_;
  int mi_[3] = {1, 3, 1}; ///< integration points, dofs of a node, layers
  int nstate_;
};

} // namespace adapters
