// The search (start = null) finds the closest point: against a dense sweep, on textures with many minima.
#include <gtest/gtest.h>

#include <iostream>

#include "scene.hpp"
#include "samples.hpp"
#include "sweep.hpp"

namespace mechanics {
namespace {

// Of the segment's size: the sweep knows the distance to 1e-12, the search to rounding.
constexpr double tolerance = 1e-10;

class ClosestPoint : public testing::TestWithParam<std::string> {};

TEST_P(ClosestPoint, IsFoundByTheSearch) {
  const Basis& basis = basis_named(GetParam());
  const Grid grid(basis, basis.dimension == 2 ? 401 : 61);
  const std::int64_t per_scene = samples(50), scenes = basis.dimension == 2 ? 50 : 29;
  Random random(51);
  Worst worst;
  std::int64_t compared = 0, on_border = 0, several = 0, failed = 0, border_elsewhere = 0;
  for (std::int64_t number = 0; number < scenes; ++number) {
    Scene scene = draw_scene(random, basis, "none", "normal");
    scene.height = draw_texture(random, basis.parameters());
    const Model model(scene.model().dump());
    Elements elements = draw_elements(random, scene, model, per_scene, number % 2 ? -0.6 : -0.1, number % 2 ? 1.5 : 0.2);
    elements.start.clear();
    const Results r = model.evaluate(elements, ENTS_XI | ENTS_POINT | ENTS_FLAGS);
    const Height height(scene.height, basis.parameters());
    const int d = basis.dimension, t = basis.parameters(), m = basis.node_count();
    for (std::int64_t e = 0; e < per_scene; ++e) {
      const Surface surface(basis, height, elements.master.data() + e * m * d,
                            scene.with_coordinates ? elements.surface_coordinates.data() + e * m * t : nullptr);
      const Vec3 slave = vec3(elements.slave.data() + e * d, d);
      const std::vector<Minimum> minima = sweep_minima(grid, basis, surface, slave, 4);
      const double mine = norm(slave - vec3(r.point.data() + e * d, d));
      several += minima.size() > 1;
      const bool border = basis.simplex ? std::min({minima[0].xi[0], minima[0].xi[1], 1.0 - minima[0].xi[0] - minima[0].xi[1]}) < 1e-5
         : std::max(std::fabs(minima[0].xi[0]), std::fabs(minima[0].xi[1])) > 1.0 - 1e-5;
      const auto where = [&] { return scene.model().dump() + " element " + std::to_string(e) + " of " + std::to_string(number) + (r.has_flag(e, ENTS_FLAG_OUTSIDE) ? " outside" : " inside"); };
      if (!r.ok(e)) { ++failed; if (!border) std::cout << "status " << r.statuses[static_cast<std::size_t>(e)] << " " << where() << " " << minima[0].distance << "\n"; continue; }
      if (border) { ++on_border; border_elsewhere += mine > minima[0].distance + 1e-10; continue; }
      ++compared;
      if (mine > minima[0].distance + 1e-10) std::cout << "missed " << mine - minima[0].distance << " dist " << minima[0].distance << " " << where() << "\n";
      worst.see(mine - minima[0].distance, where);
    }
  }
  EXPECT_LE(worst.error, tolerance) << worst.where;
  std::cout << basis.name << ": compared " << compared << " border " << on_border << " (elsewhere " << border_elsewhere << ") several " << several << " failed " << failed << " worst " << worst.error << "\n";
}

INSTANTIATE_TEST_SUITE_P(Basis, ClosestPoint, testing::ValuesIn(basis_names()),
                         [](const auto& parameter) { return parameter.param; });

} // namespace
} // namespace mechanics
