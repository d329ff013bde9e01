// SPDX-License-Identifier: BSD-3-Clause
// A rigid body that turns, in the elements of programs.
#include <cmath>

#include "program.hpp"

namespace host::adapters {

void add_body(UserElement& e, const ents_pose& pose) {
  const std::vector<double> in_body = e.position;
  const auto d = static_cast<std::size_t>(e.dimension);
  e.body = true;
  for (std::size_t i = 0; i < d; ++i) {
    e.position[i] = pose.point[i];
    for (std::size_t j = 0; j < d; ++j) e.position[i] += pose.turn[d * i + j] * in_body[j];
  }
  e.position.insert(e.position.end(), pose.point, pose.point + d);
  e.position.resize(3 * d);
  e.displacement.assign(3 * d, 0.0);
  if (d == 2) {
    e.displacement[2 * d] = std::atan2(pose.turn[2], pose.turn[0]);
    return;
  }
  e.state.insert(e.state.end(), pose.turn, pose.turn + 9);
  e.state.resize(e.state.size() + 3);
}

} // namespace host::adapters
