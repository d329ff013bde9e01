// SPDX-License-Identifier: BSD-3-Clause
#include "point.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ents_adapter {
namespace {

constexpr int largest_corners = 4;

Result fail(const Point& p, const char* text) {
  Result result;
  result.outcome = Outcome::failed;
  std::snprintf(result.message, sizeof result.message, "ents, point %lld: %s",
                static_cast<long long>(p.number), text);
  return result;
}

} // namespace

Result evaluate(const Point& p) {
  const int d = p.directions, corners = d == 2 ? 2 : 4, n = d + 1; // a temperature behind the displacements
  std::fill(p.traction, p.traction + d, 0.0);
  std::fill(p.stiffness, p.stiffness + d * d, 0.0);
  std::fill(p.flux, p.flux + 2, 0.0);
  std::fill(p.flux_by_temperature, p.flux_by_temperature + 4, 0.0);
  std::fill(p.flux_by_closing, p.flux_by_closing + 2 * d, 0.0);
  *p.energy = *p.dissipation = 0;
  if (!p.properties || p.property_count < 2)
    return fail(p, "write at least two properties: the model's number k (file ents_k.json), half the length "
                   "of the face");
  const double half = p.properties(1);
  if (!(half > 0) || !std::isfinite(half))
    return fail(p, "property 2, half the length of the face under the point, must be > 0");

  // Slave node over the face; its corners lie where their surface coordinates say, the normal is the last
  // axis.
  static constexpr double sign[largest_corners][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  double position[3 * (1 + largest_corners)] = {},
                           properties[3 + 2 * largest_corners] = {p.properties(0), 1, 0};
  if (p.property_count > 2) properties[2] = p.properties(2);
  for (int a = 0; a + 1 < d; ++a) position[a] = p.start[a] + p.closing[1 + a];
  position[d - 1] = -p.closing[0];
  for (int corner = 0; corner < corners; ++corner)
    for (int a = 0; a + 1 < d; ++a)
      position[d * (1 + corner) + a] = properties[3 + (d - 1) * corner + a] =
          p.start[a] + half * sign[corner][a];

  double change[4 * (1 + largest_corners)] = {}, moved[4 * (1 + largest_corners)] = {};
  for (int node = 0; node <= corners; ++node) moved[n * node + d] = p.temperature[node == 0 ? 0 : 1];
  for (int a = 0; p.change && a + 1 < d; ++a) change[a] = p.change[1 + a];
  if (p.change) change[d - 1] = -p.change[0];
  double residual[4 * (1 + largest_corners)], tangent[16 * (1 + largest_corners) * (1 + largest_corners)];
  const int rows = n * (1 + corners);
  Element e;
  e.host = p.host;
  e.number = p.number;
  e.listed = false; // it is a node's
  e.nodes = 1 + corners;
  e.dofs = n, e.coordinates = e.temperature = d;
  e.time_increment = p.time_increment;
  e.position = {position, 1, d};
  e.displacement = {moved, 1, n};
  if (p.change) e.change = {change, 1, n};
  e.properties = {properties};
  e.property_count = 3 + (d - 1) * corners;
  e.history = p.history;
  e.history_size = p.history_size;
  e.residual = {residual, 1, n};
  e.tangent = {tangent, 1, rows};
  e.history_end = p.history_end;
  e.energy = p.energy;
  e.dissipation = p.dissipation;
  const Result result = evaluate(e);
  if (result.outcome != Outcome::done) return result;
  if (result.heat && result.rigid)
    return fail(p, "the model has \"heat\" and \"master\": \"rigid\", whose heat the point does not know: "
                   "remove \"master\", the face under a point is rigid anyway");

  // The face closes where the node goes down; traction and slip are the master's and the slave's.
  const auto entry = [d](int i) { return i == 0 ? d - 1 : i - 1; };
  const auto side = [](int i) { return i == 0 ? -1.0 : 1.0; };
  for (int j = 0; j < d; ++j) {
    p.traction[j] = side(j) * residual[entry(j)];
    for (int i = 0; i < d; ++i)
      p.stiffness[i + d * j] = side(i) * side(j) * tangent[entry(i) + rows * entry(j)];
  }
  for (int node = 0; node <= corners; ++node) { // what leaves the corners, together, leaves the face
    const int row = n * node + d, i = node == 0 ? 0 : 1;
    p.flux[i] -= residual[row];
    for (int other = 0; other <= corners; ++other)
      p.flux_by_temperature[i + 2 * (other == 0 ? 0 : 1)] -= tangent[row + rows * (n * other + d)];
    for (int j = 0; j < d; ++j) p.flux_by_closing[i + 2 * j] -= side(j) * tangent[row + rows * entry(j)];
  }
  return result;
}

} // namespace ents_adapter
