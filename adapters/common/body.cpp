// SPDX-License-Identifier: BSD-3-Clause
#include "body.hpp"

#include <algorithm>
#include <cmath>

namespace ents_adapter {

std::string place_body(const Element& e, int dimension, int slave_nodes, bool turn_node, int state_size,
                       Body& body, bool& finite) {
  const int turns = turns_of(dimension);
  ents_report report{};
  report.struct_size = sizeof report;
  body.pose.struct_size = sizeof body.pose;
  ents_pose_init(dimension, &body.pose, nullptr);
  double point[3] = {};
  for (int i = 0; i < dimension; ++i) {
    point[i] = e.position(i, slave_nodes) + e.moved(i, slave_nodes);
    finite = finite && std::isfinite(point[i]);
  }
  for (int i = 0; i < turns; ++i) {
    if (turn_node)
      body.turns[i] = body.spin[i] = e.moved(i, slave_nodes + 1);
    else if (dimension == 2)
      body.spin[i] = e.moved(2, slave_nodes); // the whole angle
    else if (e.spin)
      body.spin[i] = e.spin(i);
    finite = finite && std::isfinite(body.spin[i]);
  }
  if (dimension == 3) {
    bool any = false;
    for (int i = 0; i < 9; ++i) any = any || e.history(state_size + i) != 0;
    for (int i = 0; i < 9 && any; ++i) body.pose.turn[i] = e.history(state_size + i);
    for (int i = 0; i < 3 && turn_node; ++i) body.spin[i] -= e.history(state_size + 9 + i);
  }
  if (!finite) return "";
  if (ents_pose_move(dimension, point, body.spin, &body.pose, &report) != ENTS_OK)
    return "the history variables " + std::to_string(state_size + 1) +
           " and following are no rotation of the "
           "body, which the element keeps there: let the job begin with zeros";
  return "";
}

void write_body(const Element& e, int dimension, bool turn_node, int state_size, const Body& body) {
  if (dimension == 2) return;
  for (int i = 0; i < 9; ++i) e.history_end(state_size + i) = body.pose.turn[i];
  for (int i = 0; i < 3 && turn_node; ++i) e.history_end(state_size + 9 + i) = body.turns[i];
}

// A change ds of a spin s turns the body by T ds: T = I + (1 - cos a) / a^2 [s]x + (a - sin a) / a^3 [s]x^2,
// a = |s|.
void turn_columns(const Body& body, double* tangent, int n) {
  const double* s = body.spin;
  const double a = std::hypot(s[0], s[1], s[2]), half = std::sin(a / 2);
  if (a == 0) return;
  // Below 1e-3 the difference a - sin a is mostly rounding, and two terms of its series are exact.
  const double first = 2 * half * half / (a * a),
               second = a < 1e-3 ? 1. / 6 - a * a / 120 : (a - std::sin(a)) / (a * a * a);
  double map[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) map[i][j] = second * s[i] * s[j] + (i == j ? 1 - second * a * a : 0);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    map[k][j] += first * s[i], map[j][k] -= first * s[i];
  }
  for (int row = 0; row < n; ++row) {
    double* const entry = tangent + row + n * (n - 3);
    const double spins[3] = {entry[0], entry[n], entry[2 * n]};
    for (int j = 0; j < 3; ++j)
      entry[j * n] = spins[0] * map[0][j] + spins[1] * map[1][j] + spins[2] * map[2][j];
  }
}

} // namespace ents_adapter
