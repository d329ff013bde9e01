// All intersections of a ray with a segment's enriched surface, by casting it on a dense grid of the surface.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sweep.hpp"

namespace mechanics {

// The gaps g of all points of the segment on the ray: slave - rho_e = g e.
class RayCasting {
public:
  RayCasting(const Grid& grid, const Basis& basis) : grid_(grid), basis_(basis) {}

  std::vector<double> gaps(const Surface& surface, const Vec3& slave, const Vec3& ray) const {
    // coordinates across the ray
    Vec3 b1 = cross(ray, Vec3{0.0, 0.0, 1.0});
    if (norm(b1) < 0.5) b1 = cross(ray, Vec3{1.0, 0.0, 0.0});
    b1 = (1.0 / norm(b1)) * b1;
    const Vec3 b2 = cross(ray, b1);
    std::vector<std::array<double, 2>> across;
    for (std::size_t k = 0; k < grid_.xi.size(); ++k) {
      const Vec3 d = slave - surface.at(grid_.xi[k].data(), grid_.shape[k]).point;
      across.push_back({dot(d, b1), dot(d, b2)});
    }
    std::vector<double> found;
    if (basis_.dimension == 2)
      cast_line(surface, slave, ray, b1, across, found);
    else
      cast_triangles(surface, slave, ray, b1, b2, across, found);
    std::sort(found.begin(), found.end());
    return found;
  }

private:
  // 2D: a change of sign, then bisection
  void cast_line(const Surface& surface, const Vec3& slave, const Vec3& ray, const Vec3& b1,
                 const std::vector<std::array<double, 2>>& across, std::vector<double>& found) const {
    for (std::size_t k = 0; k + 1 < across.size(); ++k) {
      if ((across[k][0] > 0.0) == (across[k + 1][0] > 0.0)) continue;
      double low = grid_.xi[k][0], high = grid_.xi[k + 1][0];
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        const bool positive = dot(slave - surface.at(&middle).point, b1) > 0.0;
        (positive == (across[k][0] > 0.0) ? low : high) = middle;
      }
      found.push_back(dot(slave - surface.at(&low).point, ray));
    }
  }

  // 3D: a cell's triangle that the ray pierces, then Newton's method with differences
  void cast_triangles(const Surface& surface, const Vec3& slave, const Vec3& ray, const Vec3& b1,
                      const Vec3& b2, const std::vector<std::array<double, 2>>& across,
                      std::vector<double>& found) const {
    const std::size_t n = static_cast<std::size_t>(grid_.columns());
    const auto pierced = [&](std::size_t a, std::size_t b, std::size_t c) {
      const auto side = [&](std::size_t i, std::size_t j) {
        return across[i][0] * across[j][1] - across[i][1] * across[j][0] >= 0.0;
      };
      const bool ab = side(a, b);
      return grid_.inside[a] && grid_.inside[b] && grid_.inside[c] && ab == side(b, c) && ab == side(c, a);
    };
    for (std::size_t j = 0; j + 1 < n; ++j)
      for (std::size_t i = 0; i + 1 < n; ++i) {
        const std::size_t a = j * n + i, b = a + 1, c = a + n, d = c + 1;
        for (const auto& triangle :
             {std::array<std::size_t, 3>{a, b, c}, std::array<std::size_t, 3>{d, c, b}}) {
          if (!pierced(triangle[0], triangle[1], triangle[2])) continue;
          std::array<double, 2> xi{};
          for (const std::size_t corner : triangle)
            for (std::size_t t = 0; t < 2; ++t) xi[t] += grid_.xi[corner][t] / 3.0;
          const double gap = polish(surface, slave, ray, b1, b2, xi);
          if (!std::isnan(gap)) found.push_back(gap);
        }
      }
  }

  double polish(const Surface& surface, const Vec3& slave, const Vec3& ray, const Vec3& b1, const Vec3& b2,
                std::array<double, 2> xi) const {
    const auto off = [&](double x, double y) {
      const double at[2] = {x, y};
      const Vec3 d = slave - surface.at(at).point;
      return std::array<double, 2>{dot(d, b1), dot(d, b2)};
    };
    constexpr double h = 1e-6;
    const std::array<double, 2> first = xi;
    for (int k = 0; k < 12; ++k) {
      const auto f = off(xi[0], xi[1]), fx = off(xi[0] + h, xi[1]), fy = off(xi[0], xi[1] + h);
      const double j11 = (fx[0] - f[0]) / h, j12 = (fy[0] - f[0]) / h, j21 = (fx[1] - f[1]) / h,
                   j22 = (fy[1] - f[1]) / h;
      const double det = j11 * j22 - j12 * j21;
      xi[0] -= (j22 * f[0] - j12 * f[1]) / det;
      xi[1] -= (j11 * f[1] - j21 * f[0]) / det;
      if (!(std::fabs(xi[0] - first[0]) + std::fabs(xi[1] - first[1]) < 3.0 * grid_.spacing()))
        return std::numeric_limits<double>::quiet_NaN(); // the ray only grazes the true surface here
    }
    if (!in_domain(basis_, xi)) return std::numeric_limits<double>::quiet_NaN();
    return dot(slave - surface.at(xi.data()).point, ray);
  }

  const Grid& grid_;
  const Basis& basis_;
};

} // namespace mechanics
