// ents_surface_evaluate: points, heights and normals of the enriched surface, against its definition and
// against each other.
#include <gtest/gtest.h>

#include <iostream>

#include "differences.hpp"
#include "samples.hpp"

namespace mechanics::surface_test {
namespace {

class EnrichedSurface : public testing::TestWithParam<std::string> {
protected:
  const Basis& basis() const { return basis_named(GetParam()); }

  struct Segment {
    const Scene& scene;
    const Model& model;
    const double* master;
    const double* coordinates; // or null
  };

  // Calls f(segment, random) for segments of every height.
  template <class F> void for_every_segment(std::uint64_t seed, F&& f) {
    Random random(seed);
    for (const std::string& kind : height_kinds())
      for (int number = 0; number < 4; ++number) {
        const Scene scene = draw_scene(random, basis(), kind, "normal");
        const Model model(scene.model().dump());
        const Elements elements = draw_elements(random, scene, model, 1, 0.0, 0.0);
        f(Segment{scene, model, elements.master.data(),
                  scene.with_coordinates ? elements.surface_coordinates.data() : nullptr},
          random);
      }
  }

  // All over the segment, its border included, and somewhat beyond; a quartic of random control points folds
  // there
  std::vector<double> draw_points(Random& random, std::int64_t count) const {
    const bool quartic = basis().family == Family::bernstein;
    std::vector<double> xi;
    for (std::int64_t k = 0; k < count; ++k) {
      for (int a = 0; a < basis().parameters(); ++a)
        xi.push_back(quartic           ? random.uniform(0.0, 1.0)
                     : basis().simplex ? random.uniform(-0.1, 1.1)
                                       : random.uniform(-1.2, 1.2));
      if (!quartic) continue;
      double* at = &xi[xi.size() - 2];
      if (at[0] + at[1] > 1.0) at[0] = 1.0 - at[0], at[1] = 1.0 - at[1];
    }
    return xi;
  }
};

TEST_P(EnrichedSurface, PointHeightAndBaseAreThoseOfTheDefinition) {
  constexpr double tolerance = 1e-13; // positions up to 8 in 1e-16, polynomials of degree 6 in both
  Worst point, normal, height_error;
  for_every_segment(71, [&](const Segment& segment, Random& random) {
    const std::vector<double> xi = draw_points(random, samples(200));
    const SurfacePoints p = evaluate_surface(segment.model, segment.master, segment.coordinates, xi);
    ASSERT_EQ(p.status, ENTS_OK);
    const Height height(segment.scene.height, basis().parameters());
    const Surface surface(basis(), height, segment.master, segment.coordinates);
    const int d = basis().dimension;
    const auto where = [&] { return segment.scene.model().dump(); };
    for (std::size_t k = 0; k < p.height.size(); ++k) {
      const int i = static_cast<int>(k);
      const Surface::Point expected = surface.at(&xi[k * static_cast<std::size_t>(d - 1)]);
      point.see(norm(vec3(&p.point[0] + d * i, d) - expected.point), where);
      point.see(norm(vec3(&p.base_point[0] + d * i, d) - expected.base), where);
      normal.see(norm(vec3(&p.base_normal[0] + d * i, d) - expected.normal), where);
      height_error.see(std::fabs(p.height[k] - expected.height), where);
    }
  });
  EXPECT_LE(point.error, tolerance) << point.where;
  EXPECT_LE(normal.error, tolerance) << normal.where;
  EXPECT_LE(height_error.error, tolerance) << height_error.where;
  std::cout << GetParam() << ": point " << point.error << ", base normal " << normal.error << ", height "
            << height_error.error << "\n";
}

// n_e is a unit vector, orthogonal to the tangents of rho_e (differences of its points), on the side of n.
TEST_P(EnrichedSurface, NormalIsOrthogonalToDifferencesOfPoints) {
  constexpr double step = 1e-3;
  constexpr double tolerance =
      1e-7; // rounding 1e-15 * 1.5 / step; truncation step^4 / 30 over lengths of 0.02 and more
  Worst worst, length;
  for_every_segment(72, [&](const Segment& segment, Random& random) {
    const int d = basis().dimension, t = basis().parameters();
    const Height height(segment.scene.height, t);
    const Surface surface(basis(), height, segment.master, segment.coordinates);
    const auto cell = [&](const double* xi) {
      const auto s = surface.coordinates(xi, shape_values(basis(), xi));
      return height.cell(s.data());
    };
    const std::vector<double> centres = draw_points(random, samples(100));
    for (std::size_t k = 0; k < centres.size(); k += static_cast<std::size_t>(t))
      for (int a = 0; a < t; ++a) {
        std::vector<double> xi;
        bool one_cell = true;
        for (int point = -1; point < stencil_points; ++point) {
          xi.insert(xi.end(), &centres[k], &centres[k] + t);
          if (point >= 0) xi[xi.size() - static_cast<std::size_t>(t - a)] += step * stencil_offsets[point];
          one_cell = one_cell && cell(&xi[xi.size() - static_cast<std::size_t>(t)]) == cell(&centres[k]);
        }
        if (!one_cell) continue;
        const SurfacePoints p = evaluate_surface(segment.model, segment.master, segment.coordinates, xi);
        ASSERT_EQ(p.status, ENTS_OK);
        Vec3 tangent{};
        for (int c = 0; c < d; ++c)
          tangent[static_cast<std::size_t>(c)] =
              difference(&p.point[static_cast<std::size_t>(d + c)], static_cast<std::size_t>(d), step);
        const Vec3 n = vec3(p.normal.data(), d);
        const auto where = [&] { return segment.scene.model().dump(); };
        worst.see(std::fabs(dot(n, tangent)) / norm(tangent), where);
        length.see(std::fabs(norm(n) - 1.0), where);
        EXPECT_GT(dot(n, vec3(p.base_normal.data(), d)), 0.0) << where();
      }
  });
  EXPECT_LE(worst.error, tolerance) << worst.where;
  EXPECT_LE(length.error, 1e-15) << length.where;
  std::cout << GetParam() << ": worst cosine " << worst.error << "\n";
}

// The point and normal that an evaluation reports are those of the surface at its xi.
TEST_P(EnrichedSurface, IsWhatTheElementProjectsOn) {
  constexpr double tolerance =
      1e-14 * 10; // positions up to 4 seen from the slave in one case, from a node in the other
  Worst worst;
  Random random(73);
  for (const std::string& kind : height_kinds())
    for (const char* projection : projections) {
      const Scene scene = draw_scene(random, basis(), kind, projection);
      const Model model(scene.model().dump());
      const Elements elements = draw_elements(random, scene, model, samples(20), -0.1, 0.1);
      const Results r =
          model.evaluate(elements, ENTS_XI | ENTS_POINT | ENTS_NORMAL | ENTS_GAP | ENTS_NORMAL_GAP);
      const int d = basis().dimension, t = basis().parameters(), m = basis().node_count();
      for (int e = 0; e < static_cast<int>(elements.count); ++e) {
        const std::vector<double> xi(&r.xi[0] + e * t, &r.xi[0] + (e + 1) * t);
        const SurfacePoints p = evaluate_surface(
            model, &elements.master[0] + e * m * d,
            scene.with_coordinates ? &elements.surface_coordinates[0] + e * m * t : nullptr, xi);
        const Vec3 slave = vec3(&elements.slave[0] + e * d, d), point = vec3(&r.point[0] + e * d, d);
        const Vec3 normal = vec3(&r.normal[0] + e * d, d), offset = slave - point;
        const double gap = r.gap[static_cast<std::size_t>(e)],
                     normal_gap = r.normal_gap[static_cast<std::size_t>(e)];
        Vec3 along = normal;
        if (scene.projection == "shadow_direction") along = (1.0 / norm(scene.ray)) * scene.ray;
        if (scene.projection == "shadow_point") along = (1.0 / norm(scene.ray - slave)) * (scene.ray - slave);
        const auto where = [&] { return scene.model().dump(); };
        worst.see(norm(point - vec3(p.point.data(), d)), where);
        worst.see(norm(normal - vec3(p.normal.data(), d)), where);
        worst.see(norm(offset - gap * along), where);
        worst.see(std::fabs(dot(offset, normal) - normal_gap), where);
      }
    }
  EXPECT_LE(worst.error, tolerance) << worst.where;
  std::cout << GetParam() << ": worst " << worst.error << "\n";
}

// Surface coordinates in the model text and in the caller's arrays: the same bits.
TEST_P(EnrichedSurface, CoordinatesMayComeFromTheModelOrFromTheCaller) {
  Random random(74);
  for (const std::string& kind : height_kinds()) {
    Scene scene = draw_scene(random, basis(), kind, "normal");
    scene.with_coordinates = true;
    const Model plain(scene.model().dump());
    Elements elements = draw_elements(random, scene, plain, 1, -0.1, -0.02);
    nlohmann::json text = scene.model(), coordinates = nlohmann::json::array();
    const std::size_t t = static_cast<std::size_t>(basis().parameters());
    for (std::size_t k = 0; k < elements.surface_coordinates.size(); k += t)
      coordinates.push_back(
          std::vector<double>(elements.surface_coordinates.begin() + static_cast<std::ptrdiff_t>(k),
                              elements.surface_coordinates.begin() + static_cast<std::ptrdiff_t>(k + t)));
    text["surface_coordinates"] = coordinates;
    const Model own(text.dump());
    constexpr std::int32_t wanted = ENTS_XI | ENTS_GAP | ENTS_RESIDUAL | ENTS_TANGENT | ENTS_XI_HESSIAN;
    const Results from_caller = plain.evaluate(elements, wanted);
    const SurfacePoints there =
        evaluate_surface(plain, elements.master.data(), elements.surface_coordinates.data(), elements.start);
    elements.surface_coordinates.clear();
    const Results from_model = own.evaluate(elements, wanted);
    const SurfacePoints here = evaluate_surface(own, elements.master.data(), nullptr, elements.start);
    EXPECT_EQ(from_caller.xi, from_model.xi) << kind;
    EXPECT_EQ(from_caller.gap, from_model.gap) << kind;
    EXPECT_EQ(from_caller.residual, from_model.residual) << kind;
    EXPECT_EQ(from_caller.tangent, from_model.tangent) << kind;
    EXPECT_EQ(from_caller.xi_hessian, from_model.xi_hessian) << kind;
    EXPECT_EQ(there.point, here.point) << kind;
    EXPECT_EQ(there.normal, here.normal) << kind;
  }
}

INSTANTIATE_TEST_SUITE_P(Basis, EnrichedSurface, testing::ValuesIn(all_basis_names()),
                         [](const auto& parameter) { return parameter.param; });

} // namespace
} // namespace mechanics::surface_test
