// SPDX-License-Identifier: BSD-3-Clause
#include "areas.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace host {

std::vector<double> tributary_areas(const Mesh& mesh, const std::vector<Face>& faces,
                                    const std::vector<int>& nodes, double thickness, bool axisymmetric) {
  std::map<int, std::size_t> position;
  for (std::size_t i = 0; i < nodes.size(); ++i) position[nodes[i]] = i;
  std::vector<double> areas(nodes.size(), 0.0);
  const auto add = [&](int node, double area) { areas[position.at(node)] += area; };
  const double g = 1 / std::sqrt(3.);
  for (const Face& face : faces) {
    std::array<Eigen::Vector3d, 4> x;
    for (std::size_t a = 0; a < static_cast<std::size_t>(face.count); ++a) {
      const auto place = mesh.node(face.nodes[a]);
      x[a] = {place[0], place[1], mesh.dimension == 3 ? place[2] : 0};
    }
    if (face.count == 2) {
      const double length = (x[1] - x[0]).norm();
      for (const double xi : {-g, g}) { // two points: exact for N r, a quadratic
        const double radius = 0.5 * ((1 - xi) * x[0][0] + (1 + xi) * x[1][0]);
        const double weight = 0.5 * length * (axisymmetric ? 2 * std::numbers::pi * radius : thickness);
        add(face.nodes[0], weight * 0.5 * (1 - xi));
        add(face.nodes[1], weight * 0.5 * (1 + xi));
      }
    } else if (face.count == 3) {
      const double area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm();
      for (std::size_t a = 0; a < 3; ++a) add(face.nodes[a], area / 3);
    } else {
      for (const double xi : {-g, g})
        for (const double eta : {-g, g}) {
          const auto point = detail::multilinear<4, 2>({xi, eta, 0}, 1);
          Eigen::Vector3d first = Eigen::Vector3d::Zero(), second = Eigen::Vector3d::Zero();
          for (int a = 0; a < 4; ++a) {
            first += point.derivatives(a, 0) * x[static_cast<std::size_t>(a)];
            second += point.derivatives(a, 1) * x[static_cast<std::size_t>(a)];
          }
          const double weight = first.cross(second).norm();
          for (int a = 0; a < 4; ++a) add(face.nodes[static_cast<std::size_t>(a)], weight * point.values[a]);
        }
    }
  }
  return areas;
}

} // namespace host
