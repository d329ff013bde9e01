// SPDX-License-Identifier: BSD-3-Clause
// History variables of all elements, as most hosts keep them: committed at the end of an increment, zeros at
// first.
#pragma once

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
