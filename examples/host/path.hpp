// SPDX-License-Identifier: BSD-3-Clause
// How a prescribed value follows the load factor.
#pragma once

#include <array>
#include <vector>

namespace host {

/// Factor on a prescribed value as a function of the load factor: straight lines between points, constant
/// beyond them. No points: the load factor itself.
struct Path {
  std::vector<std::array<double, 2>> points; ///< (load factor, factor), load factors ascending

  double at(double load_factor) const {
    if (points.empty()) return load_factor;
    if (load_factor <= points.front()[0]) return points.front()[1];
    for (std::size_t i = 1; i < points.size(); ++i)
      if (load_factor <= points[i][0]) {
        const double t = (load_factor - points[i - 1][0]) / (points[i][0] - points[i - 1][0]);
        return (1 - t) * points[i - 1][1] + t * points[i][1];
      }
    return points.back()[1];
  }
};

class JsonObject;
/// {"path": [[load factor, factor], ...]} of an object that may have one.
Path read_path(JsonObject& object);

} // namespace host
