// The search along a shadow ray (start = null) finds the lit point, the one nearest to the light: against dense ray casting.
#include <gtest/gtest.h>

#include <iostream>

#include "samples.hpp"
#include "scene.hpp"
#include "sweep.hpp"

namespace mechanics {
namespace {

// The casting knows a gap to rounding (bisection or Newton's method to the end); 1e-10 of the segment's size as for the closest
// point.
constexpr double tolerance = 1e-10;

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
    if (basis_.dimension == 2) cast_line(surface, slave, ray, b1, across, found);
    else cast_triangles(surface, slave, ray, b1, b2, across, found);
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
  void cast_triangles(const Surface& surface, const Vec3& slave, const Vec3& ray, const Vec3& b1, const Vec3& b2,
                      const std::vector<std::array<double, 2>>& across, std::vector<double>& found) const {
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
        for (const auto& triangle : {std::array<std::size_t, 3>{a, b, c}, std::array<std::size_t, 3>{d, c, b}}) {
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
      const double j11 = (fx[0] - f[0]) / h, j12 = (fy[0] - f[0]) / h, j21 = (fx[1] - f[1]) / h, j22 = (fy[1] - f[1]) / h;
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

class LitPoint : public testing::TestWithParam<std::string> {};

TEST_P(LitPoint, IsFoundByTheSearch) {
  const Basis& basis = basis_named(GetParam());
  const int d = basis.dimension, t = basis.parameters(), m = basis.node_count();
  const Grid grid(basis, d == 2 ? 801 : 61);
  const RayCasting casting(grid, basis);
  const std::int64_t per_scene = samples(50), scenes = d == 2 ? 50 : 29;
  Random random(61);
  Worst later, off_ray;
  std::int64_t compared = 0, several = 0, missed_by_casting = 0, none = 0;
  for (std::int64_t number = 0; number < scenes; ++number) {
    const bool emitter = number % 2 == 0;
    Scene scene = draw_scene(random, basis, "none", emitter ? "shadow_point" : "shadow_direction");
    scene.height = draw_texture(random, basis.parameters());
    if (number % 4 >= 2) { // low light: waves cast shadows on each other
      Vec3 low = random.uniform(0.25, 0.6) * scene.axes[static_cast<std::size_t>(d - 1)];
      low = low + (random.coin() ? 1.0 : -1.0) * scene.axes[0];
      scene.ray = emitter ? scene.origin + 6.0 * low : low;
    }
    const Model model(scene.model().dump());
    Elements elements = draw_elements(random, scene, model, per_scene, -0.3, 0.5);
    elements.start.clear();
    const Results r = model.evaluate(elements, ENTS_XI | ENTS_GAP | ENTS_POINT | ENTS_FLAGS);
    const Height height(scene.height, t);
    for (std::int64_t e = 0; e < per_scene; ++e) {
      const Surface surface(basis, height, elements.master.data() + e * m * d,
                            scene.with_coordinates ? elements.surface_coordinates.data() + e * m * t : nullptr);
      const Vec3 slave = vec3(elements.slave.data() + e * d, d);
      const Vec3 towards = emitter ? scene.ray - slave : scene.ray, ray = (1.0 / norm(towards)) * towards;
      const std::vector<double> gaps = casting.gaps(surface, slave, ray);
      const auto where = [&] { return scene.model().dump() + " element " + std::to_string(e) + " of " + std::to_string(number); };
      if (gaps.empty()) { ++none; continue; }
      several += gaps.size() > 1;
      ++compared;
      const std::size_t i = static_cast<std::size_t>(e);
      if (!r.ok(e)) { std::cout << "status " << r.statuses[i] << " " << gaps.size() << " " << where() << "\n"; continue; }
      const Vec3 offset = slave - vec3(r.point.data() + e * d, d);
      off_ray.see(norm(offset - r.gap[i] * ray), where);
      if (r.gap[i] > gaps[0] + 1e-10) std::cout << "missed " << r.gap[i] - gaps[0] << " " << gaps.size() << " " << r.flags[i] << " " << where() << "\n";
      later.see(r.gap[i] - gaps[0], where);
      missed_by_casting += r.gap[i] < gaps[0] - tolerance;
    }
  }
  std::cout << basis.name << ": compared " << compared << " several " << several << " none " << none << " casting missed " << missed_by_casting << " later " << later.error << " off " << off_ray.error << "\n";
  EXPECT_LE(later.error, tolerance) << later.where;
  EXPECT_LE(off_ray.error, tolerance) << off_ray.where;
}

INSTANTIATE_TEST_SUITE_P(Basis, LitPoint, testing::ValuesIn(basis_names()),
                         [](const auto& parameter) { return parameter.param; });

} // namespace
} // namespace mechanics
