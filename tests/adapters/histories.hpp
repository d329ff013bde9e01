// SPDX-License-Identifier: BSD-3-Clause
// History variables of all elements, as most hosts keep them: committed at the end of an increment, zeros at
// first.
#pragma once

#include <algorithm>
#include <vector>

#include "emulated_host.hpp"

namespace adapters {

class HostWithHistory : public EmulatedHost {
public:
  HostWithHistory(const Elements& elements, int spare)
      : EmulatedHost(elements), size_(elements.state_size + spare),
        committed_(elements.nodes.size(), std::vector<double>(static_cast<std::size_t>(size_))),
        trial_(committed_) {}
  void accept() override { committed_ = trial_; }
  void set_history(int element, const std::vector<double>& state) override {
    std::copy(state.begin(), state.end(), committed_[static_cast<std::size_t>(element)].begin());
  }
  std::vector<double> history(int element) override { return trial(element); }

protected:
  const std::vector<double>& committed(int element) const {
    return committed_[static_cast<std::size_t>(element)];
  }
  std::vector<double>& trial(int element) { return trial_[static_cast<std::size_t>(element)]; }

  int size_;

private:
  std::vector<std::vector<double>> committed_, trial_;
};

} // namespace adapters
