// SPDX-License-Identifier: BSD-3-Clause
// Flat surfaces of triangles and quadrilaterals, all as quad4: a triangle has two nodes in one.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "library.hpp"
#include "random.hpp"

namespace mechanics {

struct MixedSurface {
  std::vector<double> positions;                    // [nodes][3]
  std::vector<std::int64_t> all;                    // [facets][4]
  std::vector<std::int64_t> triangles, quadrangles; // the same as tri3 and quad4
  std::array<double, 3> normal{}, along{};          // unit vectors

  std::int64_t nodes() const { return static_cast<std::int64_t>(positions.size() / 3); }
  std::int64_t facets() const { return static_cast<std::int64_t>(all.size() / 4); }

  void add_triangle(Random& random, std::int64_t a, std::int64_t b, std::int64_t c) {
    triangles.insert(triangles.end(), {a, b, c});
    const std::array<std::int64_t, 4> rows[] = {{a, b, c, c}, {a, b, b, c}, {a, a, b, c}, {c, a, b, c}};
    const auto& row = rows[random.below(4)];
    all.insert(all.end(), row.begin(), row.end());
  }
  void add_quadrangle(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
    quadrangles.insert(quadrangles.end(), {a, b, c, d});
    all.insert(all.end(), {a, b, c, d});
  }
  // Moves the nodes (or those of another surface) along a vector.
  static std::vector<double> moved(std::vector<double> x, const std::array<double, 3>& by, double factor) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += factor * by[i % 3];
    return x;
  }
};

// n x n cells of side 1 with moved nodes, half of them (or all) cut along one of their diagonals, in any
// orientation.
inline MixedSurface draw_mixed_surface(Random& random, int n, bool triangles_alone = false) {
  MixedSurface s;
  double turn[3][3];
  for (int a = 0; a < 3; ++a) {
    for (double& x : turn[a]) x = random.uniform(-1.0, 1.0);
    for (int b = 0; b < a; ++b) {
      double part = 0.0;
      for (int k = 0; k < 3; ++k) part += turn[a][k] * turn[b][k];
      for (int k = 0; k < 3; ++k) turn[a][k] -= part * turn[b][k];
    }
    const double length =
        std::sqrt(turn[a][0] * turn[a][0] + turn[a][1] * turn[a][1] + turn[a][2] * turn[a][2]);
    for (double& x : turn[a]) x /= length;
  }
  for (int k = 0; k < 3; ++k) { // of a right-handed frame
    s.along[static_cast<std::size_t>(k)] = turn[0][k];
    turn[2][k] = turn[0][(k + 1) % 3] * turn[1][(k + 2) % 3] - turn[0][(k + 2) % 3] * turn[1][(k + 1) % 3];
    s.normal[static_cast<std::size_t>(k)] = turn[2][k];
  }
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = i + random.uniform(-0.2, 0.2), y = j + random.uniform(-0.2, 0.2);
      for (int k = 0; k < 3; ++k) s.positions.push_back(x * turn[0][k] + y * turn[1][k]);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::int64_t a = j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
      switch (random.below(triangles_alone ? 2 : 4)) {
      case 0:
        s.add_triangle(random, a, b, c), s.add_triangle(random, a, c, d);
        break;
      case 1:
        s.add_triangle(random, a, b, d), s.add_triangle(random, b, c, d);
        break;
      default:
        s.add_quadrangle(a, b, c, d);
      }
    }
  return s;
}

} // namespace mechanics
