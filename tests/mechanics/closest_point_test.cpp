// The search (start = null) finds the closest point: against a dense sweep, on textures with many minima.
// Distances are to this test's own surface at the xi found.
#include <gtest/gtest.h>

#include <iostream>

#include "samples.hpp"
#include "scene.hpp"
#include "sweep.hpp"

namespace mechanics::closest_point_test {
namespace {

constexpr double same_point = 1e-13; // positions up to 8, as in surface_test.cpp

class ClosestPoint : public testing::TestWithParam<std::string> {
protected:
  // Of the segment's size: the sweep knows the distance to 1e-12, the search to rounding.
  static constexpr double tolerance = 1e-10;
};

TEST_P(ClosestPoint, IsFoundByTheSearch) {
  const Basis& basis = basis_named(GetParam());
  const Grid grid(basis, basis.dimension == 2 ? 401 : 61);
  const std::int64_t per_scene = samples(50), scenes = basis.dimension == 2 ? 50 : 29;
  Random random(51);
  Worst worst, off;
  std::int64_t compared = 0, on_border = 0, spent = 0;
  std::int32_t most_spent = 0;
  for (std::int64_t number = 0; number < scenes; ++number) {
    Scene scene = draw_scene(random, basis, "none", "normal");
    scene.height = draw_texture(random, basis.parameters());
    const Model model(scene.model().dump());
    const bool far = number % 2;
    Elements elements = draw_elements(random, scene, model, per_scene, far ? -0.6 : -0.1, far ? 1.5 : 0.2);
    elements.start.clear();
    const Results r = model.evaluate(elements, ENTS_XI | ENTS_POINT | ENTS_FLAGS | ENTS_ITERATIONS);
    const Height height(scene.height, basis.parameters());
    const int d = basis.dimension, t = basis.parameters(), m = basis.node_count();
    for (std::int64_t e = 0; e < per_scene; ++e) {
      const Surface surface(basis, height, elements.master.data() + e * m * d,
                            scene.with_coordinates ? elements.surface_coordinates.data() + e * m * t
                                                   : nullptr);
      const Vec3 slave = vec3(elements.slave.data() + e * d, d);
      const Minimum closest = sweep_minima(grid, basis, surface, slave, 4).front();
      const auto where = [&] { return scene.model().dump() + " element " + std::to_string(e); };
      const std::int32_t iterations = r.iterations[static_cast<std::size_t>(e)];
      spent += iterations;
      most_spent = std::max(most_spent, iterations);
      if (is_on_border(basis, closest.xi)) { // no projection there: the search looks for one elsewhere
        ++on_border;
        continue;
      }
      ++compared;
      ASSERT_TRUE(r.ok(e)) << where();
      const std::array<double, 2> xi = {r.xi[static_cast<std::size_t>(e * t)],
                                        t == 2 ? r.xi[static_cast<std::size_t>(e * t + 1)] : 0.0};
      const Vec3 point = surface.at(xi.data()).point;
      worst.see(norm(slave - point) - closest.distance, where);
      off.see(norm(vec3(r.point.data() + e * d, d) - point), where);
    }
  }
  EXPECT_LE(worst.error, tolerance) << worst.where;
  EXPECT_LE(off.error, same_point) << off.where;
  EXPECT_GT(compared, 9 * on_border);
  std::cout << basis.name << ": " << compared << " positions, farther than the sweep by at most "
            << worst.error << ", points off the surface by " << off.error
            << "; surface evaluations: " << spent / (per_scene * scenes) << " in the mean, at most "
            << most_spent << "\n";
}

INSTANTIATE_TEST_SUITE_P(Basis, ClosestPoint, testing::ValuesIn(all_basis_names()),
                         [](const auto& parameter) { return parameter.param; });

} // namespace
} // namespace mechanics::closest_point_test
