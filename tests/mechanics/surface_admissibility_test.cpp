// SPDX-License-Identifier: BSD-3-Clause
// ents_surface_check on whole surfaces, where projections fail. Panels a and b of Fig. 4 of the paper, each
// on both sides of its limit and with the number and the place of the worst: several projections,
// self-shadow; both sides of a gap, shadows from afar.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "checked_surface.hpp"

namespace mechanics::surface_admissibility_test {
namespace {

// Panel a. A sine over four segments: its crests and valleys have the smallest radius, and a slave at that
// distance two projections. The reach decides.
TEST(SurfaceAdmissibility, PanelAReachAgainstTheCurvature) {
  const double amplitude = 0.05, k = 2.0 * pi, radius = 1.0 / (amplitude * k * k);
  const Model m = model("line2", waves(amplitude, 1.0));
  const MeshSurface surface = strip(4, 3.0);
  for (const double part : {0.5, 0.999, 1.001, 2.0}) {
    const Checked c = check(m, surface, part * radius);
    EXPECT_EQ(c.violated, part < 1.0 ? 0 : bit(ENTS_CHECK_PROJECTION)) << part;
    EXPECT_TRUE(c.judges(ENTS_CHECK_PROJECTION));
    EXPECT_EQ(c.bound[ENTS_CHECK_PROJECTION], part * radius);
    // No two balls touch more closely than the curvature lets them (the curve is flattest off its crests),
    // but those that a crest's two flanks touch, as their samples come closer to the crest, take its radius
    // from above.
    EXPECT_NEAR(c.value[ENTS_CHECK_PROJECTION], radius, 1e-10 * radius);
    if (part > 1.0) {
      EXPECT_NEAR(c.missing[ENTS_CHECK_PROJECTION], (part - 1.0) * radius, 1e-10 * radius);
    }
    const double x = c.point[ENTS_CHECK_PROJECTION][0];
    EXPECT_NEAR(std::fabs(std::remainder(x, 0.5)), 0.25, 1e-6) << x; // a crest or a valley
  }
  // nothing is judged without a reach; the model's own limit of penetration is one
  EXPECT_FALSE(check(m, surface).judges(ENTS_CHECK_PROJECTION));
  EXPECT_NEAR(check(m, surface).value[ENTS_CHECK_PROJECTION], radius, 1e-10 * radius);
  const Model limited = model("line2", waves(amplitude, 1.0), {{"penetration_limit", 1.1 * radius}});
  EXPECT_TRUE(check(limited, surface).violates(ENTS_CHECK_PROJECTION));
}

// The same from afar: two plates that face each other, far less curved than near. A slave in the middle has a
// projection on each. Sides and bases; the distance is that of the enriched plates.
TEST(SurfaceAdmissibility, PanelATwoSidesOfAGap) {
  const double width = 0.4, h = 0.03;
  MeshSurface profile = polyline({0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 2.0, width, 1.0, width, 0.0, width});
  profile.connectivity = {0, 1, 1, 2, 3, 4, 4, 5}; // outer sides facing each other
  const json constant = {{"type", "constant"}, {"value", h}};
  for (const std::string basis : {"line2", "quad4", "tri3"}) {
    const Model m = model(basis, constant);
    MeshSurface surface = basis == "line2" ? profile : extruded(profile, basis);
    // surface coordinates make the height the surface's own: nothing is asked of the segments' edges
    surface.surface_coordinates.assign(surface.connectivity.size() * static_cast<std::size_t>(m.parameters()),
                                       0.0);
    for (std::size_t i = 0; i < surface.surface_coordinates.size(); ++i)
      surface.surface_coordinates[i] = 0.01 * static_cast<double>(i);
    const double half = 0.5 * width - h;
    EXPECT_EQ(check(m, surface, 0.999 * half).violated, 0) << basis;
    const Checked c = check(m, surface, 1.001 * half);
    EXPECT_EQ(c.violated, bit(ENTS_CHECK_PROJECTION)) << basis;
    EXPECT_NEAR(c.value[ENTS_CHECK_PROJECTION], half, rounding);
    EXPECT_NEAR(c.missing[ENTS_CHECK_PROJECTION], 0.001 * half, rounding);
    const auto upper = [&](std::int64_t s) { return s >= surface.segments() / 2; };
    EXPECT_NE(upper(c.segment[ENTS_CHECK_PROJECTION]), upper(c.other[ENTS_CHECK_PROJECTION])) << basis;
    for (const std::int64_t mark : c.marks) EXPECT_EQ(mark, bit(ENTS_CHECK_PROJECTION)) << basis; // all four
    EXPECT_NEAR(check(m, surface, 10.0).value[ENTS_CHECK_PROJECTION], half, rounding)
        << basis; // from a ball far too large
  }
}

// What the number of panel a claims, held against detection: a slave closer than it is projected on the point
// below it, wherever that is; beyond, at the worst place, on another one (at the border of the surface there
// may be none). 2 %: samples are a 16th of a wave apart.
TEST(SurfaceAdmissibility, PanelAAgainstDetection) {
  Random random(11);
  int inside = 0;
  for (int repeat = 0; repeat < 40; ++repeat) {
    const bool line = repeat % 4 != 0;
    const Basis& basis = basis_named(line ? "line2" : "quad4");
    MeshSurface surface = draw_mesh(random, basis, 3, 0.0);
    json height = {{"type", "sum"}, {"of", json::array()}};
    const double depth = random.uniform(0.05, repeat % 3 == 0 ? 1.2 : 0.3);
    for (int k = 0; k < 2; ++k) {
      json wave = {{"type", "sine"},
                   {"amplitude", depth / (k + 1)},
                   {"wave_vector", {random.uniform(0.1, 0.3 + 0.3 * k)}},
                   {"phase", random.uniform(0.0, 6.0)}};
      if (!line) wave["wave_vector"].push_back(random.uniform(-0.3, 0.3));
      height["of"].push_back(wave);
    }
    const Model m = model(basis.name, height);
    const Checked c = check(m, surface, 1e3);
    const double reach = c.value[ENTS_CHECK_PROJECTION];
    ASSERT_TRUE(c.violates(ENTS_CHECK_PROJECTION));
    Detector detector(m, surface);
    // its distance from the closest point, for a slave over this place
    const auto closest = [&](std::int64_t segment, const std::vector<double>& xi, double gap) {
      const SurfacePoints p =
          evaluate_surface(m, surface.master(segment).data(), surface.coordinates(segment), xi);
      std::vector<double> slave(p.point);
      for (std::size_t k = 0; k < slave.size(); ++k) slave[k] += gap * p.normal[k];
      Detector::Found found;
      detector.detect(slave, 2.0 * std::fabs(gap), found);
      return found.segment[0] < 0 ? 1e9 : std::fabs(found.gap[0]);
    };
    for (int i = 0; i < (line ? 200 : 60); ++i) {
      const std::int64_t segment =
          static_cast<std::int64_t>(random.uniform(0.0, 1.0) * static_cast<double>(surface.segments()));
      std::vector<double> xi(static_cast<std::size_t>(m.parameters()));
      for (double& x : xi) x = random.uniform(-0.99, 0.99);
      const double gap = random.uniform(-0.98, 0.98) * reach;
      EXPECT_NEAR(closest(segment, xi, gap), std::fabs(gap), 1e-9) << repeat << ": " << height;
    }
    const std::vector<double> worst(c.xi[ENTS_CHECK_PROJECTION],
                                    c.xi[ENTS_CHECK_PROJECTION] + m.parameters());
    const SurfacePoints place =
        evaluate_surface(m, surface.master(c.segment[ENTS_CHECK_PROJECTION]).data(),
                         surface.coordinates(c.segment[ENTS_CHECK_PROJECTION]), worst);
    bool border = false; // the surface is 6 long and wide
    for (int a = 0; a < m.parameters(); ++a)
      border =
          border || std::fabs(std::fabs(place.base_point[static_cast<std::size_t>(a)] - 3.0) - 3.0) < 1e-3;
    if (border) continue;
    ++inside;
    const double beyond = 1.02 * reach;
    double nearest = beyond;
    for (const double side : {-1.0, 1.0})
      nearest = std::min(nearest, closest(c.segment[ENTS_CHECK_PROJECTION], worst, side * beyond));
    EXPECT_LT(nearest, beyond * (1.0 - 1e-6)) << repeat << ": " << height;
  }
  EXPECT_GT(inside, 20);
}

// Segments that meet at almost no angle are one surface; what rounding leaves between them is no second
// sheet.
TEST(SurfaceAdmissibility, PanelANearlyFlatNeighbours) {
  for (const double bend : {0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3}) {
    MeshSurface surface = extruded(polyline({0.0, 0.0, 1.0, 0.0, 2.0, bend, 3.0, 0.0}), "quad4");
    surface.surface_coordinates.assign(surface.connectivity.size() * 2, 0.5);
    for (std::size_t i = 0; i < surface.surface_coordinates.size(); i += 3)
      surface.surface_coordinates[i] = 0.25;
    const Model m = model("quad4", {{"type", "constant"}, {"value", 0.02}});
    EXPECT_FALSE(check(m, surface, 0.5).violates(ENTS_CHECK_PROJECTION)) << bend;
  }
  MeshSurface step = polyline({0.0, 0.0, 1.0, 0.0, 2.0, 0.0}); // by less than what counts as a jump
  step.surface_coordinates = {0.0, 0.0, 1e-10, 1e-10};
  EXPECT_EQ(
      check(model("line2", {{"type", "polynomial"}, {"coefficients", {0.02, 1.0}}}), step, 0.01).violated, 0);
}

// Panel b. A sine under a slanted light: admissible up to the angle of its steepest flank; beyond, the number
// is the cosine there, and each crest keeps from the light a piece that starts where the ray touches it.
TEST(SurfaceAdmissibility, PanelBSelfShadow) {
  const double amplitude = 0.08, k = 2.0 * pi, slope = amplitude * k, limit = std::atan(1.0 / slope);
  const MeshSurface surface = strip(5, 4.0);
  for (const double part : {0.5, 0.999, 1.001, 1.2}) {
    const double angle = part * limit;
    const Model m = model(
        "line2", waves(amplitude, 1.0),
        {{"projection", {{"type", "shadow_direction"}, {"direction", {std::sin(angle), std::cos(angle)}}}}});
    const Checked c = check(m, surface, 0.0, 201);
    const double cosine = (std::cos(angle) - slope * std::sin(angle)) / std::sqrt(1.0 + slope * slope);
    EXPECT_NEAR(c.value[ENTS_CHECK_SHADOW], cosine, rounding);
    EXPECT_EQ(c.violates(ENTS_CHECK_SHADOW), part > 1.0);
    EXPECT_FALSE(c.judges(ENTS_CHECK_PROJECTION));
    if (part > 1.0) {
      EXPECT_NEAR(c.missing[ENTS_CHECK_SHADOW], -cosine, rounding);
    }
    if (part < 1.0) {
      EXPECT_EQ(c.violated, 0) << part;
      EXPECT_EQ(c.value[ENTS_CHECK_OCCLUSION], 0.0);
    } else if (part > 1.1) {
      // from every sample, the last place at which its ray leaves the surface
      const auto height = [&](double x) { return amplitude * std::sin(k * x); };
      double longest = 0.0;
      for (int i = 0; i <= 1000; ++i)
        for (int j = 0; j < 1000; ++j) {
          const double x = 0.004 * i, t = 1e-3 * j;
          const auto clear = [&](double d) {
            return height(x) + d * std::cos(angle) - height(x + d * std::sin(angle));
          };
          if (x + t * std::sin(angle) < 4.0 && clear(t) < -1e-9 && clear(t + 1e-3) > 0.0)
            longest = std::max(longest, t);
        }
      EXPECT_TRUE(c.violates(ENTS_CHECK_OCCLUSION));
      // the ray meets a facet, of 0.004, instead of the surface
      EXPECT_NEAR(c.value[ENTS_CHECK_OCCLUSION], longest, 3.0 * 0.004 / std::sin(angle));
    }
  }
}

// Panel b with no steep place at all: a roof over a plate.
TEST(SurfaceAdmissibility, PanelBAPartInTheLightOfAnother) {
  MeshSurface profile = polyline({0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 0.5, 0.7, 1.2, 0.7});
  profile.connectivity = {1, 0, 2, 1, 4, 3}; // turned tangents point down; the light comes from below
  for (const std::string basis : {"line2", "quad4", "tri3"}) {
    const MeshSurface surface = basis == "line2" ? profile : extruded(profile, basis);
    const json down = basis == "line2" ? json{0.0, -1.0} : json{0.0, -1.0, 0.0};
    const json near = basis == "line2" ? json{1.0, -1.0} : json{1.0, -1.0, 0.5};
    const Checked far =
        check(model(basis, nullptr, {{"projection", {{"type", "shadow_direction"}, {"direction", down}}}}),
              surface, 0.0, 9);
    EXPECT_EQ(far.violated, bit(ENTS_CHECK_OCCLUSION)) << basis;
    EXPECT_NEAR(far.value[ENTS_CHECK_OCCLUSION], 0.7, rounding);
    EXPECT_EQ(far.segment[ENTS_CHECK_OCCLUSION] >= surface.segments() * 2 / 3, true) << basis;
    EXPECT_EQ(far.marks[0], 0);
    // from an emitter at the height of -1: the longest ray is that of the farthest end of the roof
    const Checked lamp =
        check(model(basis, nullptr, {{"projection", {{"type", "shadow_point"}, {"emitter", near}}}}), surface,
              0.0, 9);
    EXPECT_EQ(lamp.violated, bit(ENTS_CHECK_OCCLUSION)) << basis;
    const double along = basis == "line2" ? 0.0 : 0.5;
    EXPECT_NEAR(lamp.value[ENTS_CHECK_OCCLUSION], std::sqrt(0.25 + 1.7 * 1.7 + along * along) * 0.7 / 1.7,
                rounding);
    // from an emitter between the two, the roof is lit
    const json between = basis == "line2" ? json{1.0, 0.3} : json{1.0, 0.3, 0.5};
    EXPECT_FALSE(
        check(model(basis, nullptr, {{"projection", {{"type", "shadow_point"}, {"emitter", between}}}}),
              surface, 0.0, 9)
            .violates(ENTS_CHECK_OCCLUSION));
  }
}

// Every piece of a facet casts a shadow: a small triangle under the middle piece of a large one that is cut
// into four.
TEST(SurfaceAdmissibility, PanelBTheMiddleOfATriangle) {
  MeshSurface surface;
  surface.basis = &basis_named("tri3");
  surface.positions = {0, 0, 1, 4, 0, 1, 0, 4, 1, 1.2, 1.2, 0, 1.4, 1.2, 0, 1.2, 1.4, 0};
  surface.connectivity = {0, 1, 2, 3, 4, 5};
  const json light = {{"projection", {{"type", "shadow_direction"}, {"direction", {0, 0, 1}}}}};
  const Checked c = check(model("tri3", nullptr, light), surface, 0.0, 3);
  EXPECT_EQ(c.violated, bit(ENTS_CHECK_OCCLUSION));
  EXPECT_NEAR(c.value[ENTS_CHECK_OCCLUSION], 1.0, rounding);
  EXPECT_EQ(c.segment[ENTS_CHECK_OCCLUSION], 1);
  EXPECT_EQ(c.other[ENTS_CHECK_OCCLUSION], 0);
  for (int a = 0; a < 2; ++a)
    EXPECT_NEAR(c.other_xi[ENTS_CHECK_OCCLUSION][a], 0.25 * c.point[ENTS_CHECK_OCCLUSION][a], rounding);
}

// A textured square that no ray meets at less than 3 degrees lies in no shadow, not of its own facets
// either.
TEST(SurfaceAdmissibility, PanelBNoFalseShadows) {
  Random random(5);
  int lit = 0;
  for (int repeat = 0; repeat < 40; ++repeat) {
    const Basis& basis = basis_named(repeat % 2 ? "quad4" : "tri3");
    MeshSurface surface = draw_mesh(random, basis, 2, 0.0);
    const json height = {{"type", "sine"},
                         {"amplitude", random.uniform(0.05, 0.3)},
                         {"wave_vector", {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)}}};
    const json light = {{"type", "shadow_direction"},
                        {"direction", {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 1.0}}};
    const Checked c = check(model(basis.name, height, {{"projection", light}}), surface, 0.0, 41);
    if (!(c.value[ENTS_CHECK_SHADOW] > 0.05)) continue;
    ++lit;
    EXPECT_EQ(c.violated, 0) << height << light;
  }
  EXPECT_GT(lit, 10);
}

} // namespace
} // namespace mechanics::surface_admissibility_test
