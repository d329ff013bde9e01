// The search along a shadow ray (start = null) finds the lit point, the one nearest to the light: against
// dense ray casting. Distances are to this test's own surface at the xi found.
#include <gtest/gtest.h>

#include <iostream>

#include "ray_casting.hpp"
#include "samples.hpp"
#include "scene.hpp"

namespace mechanics::lit_point_test {
namespace {

class LitPoint : public testing::TestWithParam<std::string> {
protected:
  // The casting knows a gap to rounding (bisection or Newton's method to the end); 1e-10 of the segment's
  // size as for the closest point.
  static constexpr double tolerance = 1e-10;
};

TEST_P(LitPoint, IsFoundByTheSearch) {
  const Basis& basis = basis_named(GetParam());
  const int d = basis.dimension, t = basis.parameters(), m = basis.node_count();
  const Grid grid(basis, d == 2 ? 801 : 61);
  const RayCasting casting(grid, basis);
  const std::int64_t per_scene = samples(50), scenes = d == 2 ? 50 : 29;
  Random random(61);
  Worst later, off_ray;
  std::int64_t compared = 0, several = 0, missed_by_casting = 0;
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
    const Results r = model.evaluate(elements, ENTS_XI | ENTS_GAP | ENTS_FLAGS);
    const Height height(scene.height, t);
    for (std::int64_t e = 0; e < per_scene; ++e) {
      const Surface surface(basis, height, elements.master.data() + e * m * d,
                            scene.with_coordinates ? elements.surface_coordinates.data() + e * m * t
                                                   : nullptr);
      const Vec3 slave = vec3(elements.slave.data() + e * d, d);
      const Vec3 towards = emitter ? scene.ray - slave : scene.ray, ray = (1.0 / norm(towards)) * towards;
      const std::vector<double> gaps = casting.gaps(surface, slave, ray);
      const auto where = [&] { return scene.model().dump() + " element " + std::to_string(e); };
      if (gaps.empty()) continue;
      several += gaps.size() > 1;
      ++compared;
      const std::size_t i = static_cast<std::size_t>(e);
      ASSERT_TRUE(r.ok(e)) << where();
      const std::array<double, 2> xi = {r.xi[static_cast<std::size_t>(e * t)],
                                        t == 2 ? r.xi[static_cast<std::size_t>(e * t + 1)] : 0.0};
      const Vec3 offset = slave - surface.at(xi.data()).point;
      off_ray.see(norm(offset - r.gap[i] * ray), where);
      later.see(r.gap[i] - gaps[0], where);
      missed_by_casting += r.gap[i] < gaps[0] - tolerance;
    }
  }
  std::cout << basis.name << ": " << compared << " rays, " << several
            << " with several points; behind the casting's by at most " << later.error
            << ", off the ray by at most " << off_ray.error << "; the casting missed " << missed_by_casting
            << "\n";
  EXPECT_LE(later.error, tolerance) << later.where;
  EXPECT_LE(off_ray.error, tolerance) << off_ray.where;
  EXPECT_GE(compared, per_scene * scenes * 9 / 10);
  EXPECT_LE(missed_by_casting, 1 + compared / 200); // two points in one cell of the grid
}

INSTANTIATE_TEST_SUITE_P(Basis, LitPoint, testing::ValuesIn(basis_names()),
                         [](const auto& parameter) { return parameter.param; });

} // namespace
} // namespace mechanics::lit_point_test
