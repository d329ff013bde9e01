// SPDX-License-Identifier: BSD-3-Clause
#include "crown.hpp"

#include <cmath>

namespace host {

void round_block(Mesh& mesh, const std::vector<GridLines>& lines, const Crown& crown) {
  const auto d = static_cast<std::size_t>(mesh.dimension), axis = static_cast<std::size_t>(crown.axis);
  const GridLines& up = lines.back();
  std::size_t nodes = 1;
  for (const GridLines& line : lines) nodes *= line.size();
  for (std::size_t at = mesh.coordinates.size() - nodes * d; at < mesh.coordinates.size(); at += d) {
    const double x = mesh.coordinates[at + axis];
    double& height = mesh.coordinates[at + d - 1];
    height += (std::sqrt(crown.radius * crown.radius - x * x) - crown.radius) * (height - up.front()) /
              (up.back() - up.front());
  }
}

} // namespace host
