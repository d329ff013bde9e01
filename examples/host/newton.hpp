// SPDX-License-Identifier: BSD-3-Clause
// Newton's iteration in one increment, and the increments of a step: those that fail are cut.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "equations.hpp"

namespace host {

/// One increment that converged.
struct Increment {
  double value = 0;              ///< of the control at its end
  std::vector<double> residuals; ///< relative to the forces present, at each iteration
};

struct Step {
  int number = 0; ///< from 1
  double value = 0;
  std::vector<Increment> increments;
  std::vector<std::string> cuts; ///< why increments were cut
  Configuration at;              ///< at its end
  double force = 0;              ///< on the rigid master, all symmetric copies
  double approach = 0;           ///< motion of the rigid master since first touch
  ContactResults contact;
  double wall_time = 0;

  int iterations() const;
};

/// What the run does, for people that wait: a line each.
using Say = std::function<void(const std::string&)>;

class Newton {
public:
  Newton(Equations& equations, Say say);
  /// Steps 1, 2, ... in this order. @throws JobError if a step cannot be solved in parts of /solver/min_step
  Step solve(int step);

private:
  /// From `now_` to a value of the control, in the time `duration`.
  /// @return not ok: nothing has changed, take a smaller increment
  Outcome attempt(double value, double duration, Increment& increment);
  void touch(Configuration& at);

  Equations* equations_;
  Say say_;
  Configuration now_; ///< at the end of the last increment
  double first_touch_ = 0;
};

} // namespace host
