// SPDX-License-Identifier: BSD-3-Clause
// ents_surface_check on whole surfaces, where the surface itself is wrong. Panels c and d of Fig. 4 of the
// paper, each on both sides of its limit: jumps at the edges of segments, folds and neighbours that cross.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "checked_surface.hpp"

namespace mechanics::surface_continuity_test {
namespace {

// Panel c. A local height that does not vanish on the edges: the surface is torn by 2 h sin(angle / 2) where
// segments meet at an angle, and by nothing where they do not. The kink is the angle, turned by the slopes of
// h.
TEST(SurfaceAdmissibility, PanelCHeightOnTheEdges) {
  const double angle = 0.9, c = std::cos(angle), s = std::sin(angle);
  const MeshSurface profile = polyline({-2.0, 0.0, 0.0, 0.0, 2.0 * c, -2.0 * s}); // convex
  for (const std::string basis : {"line2", "quad4"}) {
    const MeshSurface surface = basis == "line2" ? profile : extruded(profile, basis);
    for (const double edge : {0.0, 0.03}) {
      // 0.1 (1 - s^2) + edge, along the profile (quad4: minus its xi_1, an even function)
      const json height = {{"type", "polynomial"},
                           {"coefficients", basis == "line2" ? json{0.1 + edge, 0.0, -0.1}
                                                             : json{{0.1 + edge}, {0.0}, {-0.1}}}};
      const Checked r = check(model(basis, height), surface, 0.0, 0);
      std::int64_t expected = edge > 0.0 ? bit(ENTS_CHECK_EDGE) | bit(ENTS_CHECK_JUMP) : 0;
      if (basis == "quad4") expected |= bit(ENTS_CHECK_EDGE); // on the sides of the strip, too
      EXPECT_EQ(r.violated, expected) << basis << " " << edge;
      EXPECT_NEAR(r.value[ENTS_CHECK_EDGE], basis == "quad4" ? 0.1 + edge : edge, 1e-15);
      EXPECT_NEAR(r.value[ENTS_CHECK_JUMP], 2.0 * edge * std::sin(0.5 * angle), 1e-15);
      EXPECT_NEAR(r.missing[ENTS_CHECK_JUMP], 2.0 * edge * std::sin(0.5 * angle),
                  r.bound[ENTS_CHECK_JUMP] + 1e-15);
      const double turn = 2.0 * std::atan(0.2); // down to the edge and up again: slopes of h, half-length 1
      EXPECT_NEAR(r.value[ENTS_CHECK_KINK], angle - turn, rounding);
      EXPECT_NEAR(r.value[ENTS_CHECK_WEDGE], pi + angle - turn, rounding);
      EXPECT_EQ(r.segment[ENTS_CHECK_JUMP], 0);
      EXPECT_EQ(r.other[ENTS_CHECK_JUMP], 1);
      EXPECT_NEAR(r.point[ENTS_CHECK_JUMP][1], edge, 1e-15);
      EXPECT_FALSE(r.judges(ENTS_CHECK_KINK));
      EXPECT_TRUE(check(model(basis, height), surface, 0.0, 0, 0.4).violates(ENTS_CHECK_KINK));
      EXPECT_FALSE(check(model(basis, height), surface, 0.0, 0, 0.6).violates(ENTS_CHECK_KINK));
    }
  }
}

// The same on smoothed surfaces: C1 (Catmull-Rom) leaves a kink where the height is not zero, C2 (B-spline)
// none. Neither is torn, and the height need not vanish anywhere.
TEST(SurfaceAdmissibility, SmoothedSurfacesAreNotTorn) {
  std::vector<double> points, s;
  for (int i = 0; i < 9; ++i) points.insert(points.end(), {0.5 * i, 0.2 * std::sin(0.9 * i)});
  for (const std::string basis : {"catmull_rom4", "bspline4"}) {
    MeshSurface surface;
    surface.basis = &basis_named(basis);
    surface.positions = points;
    for (std::int64_t i = -1; i < 7;
         ++i) // at the ends of the chain its last node stands in for the missing one
      for (std::int64_t a = 0; a < 4; ++a) {
        surface.connectivity.push_back(std::clamp<std::int64_t>(i + a, 0, 8));
        surface.surface_coordinates.push_back(0.5 * static_cast<double>(i + a));
      }
    const Checked c = check(model(basis, waves(0.02, 0.8)), surface, 0.0, 0, 1e-10);
    const bool smooth = basis == "bspline4";
    EXPECT_EQ(c.violated, smooth ? 0 : bit(ENTS_CHECK_KINK)) << basis;
    EXPECT_EQ(c.value[ENTS_CHECK_KINK] > 1e-4, !smooth) << c.value[ENTS_CHECK_KINK];
    EXPECT_LE(c.value[ENTS_CHECK_JUMP], 1e-15);
    EXPECT_NEAR(c.value[ENTS_CHECK_WEDGE], pi, smooth ? 1e-10 : 0.1);
    EXPECT_FALSE(c.judges(ENTS_CHECK_EDGE));
  }
}

// One flat patch; the height goes on into its neighbours, wherever they are.
TEST(SurfaceAdmissibility, SmoothedTrianglesMayHaveAHeightOnTheirSides) {
  MeshSurface surface;
  surface.basis = &basis_named("bezier15");
  const double points[15][2] = {{0, 0}, {4, 0}, {0, 4}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {2, 2},
                                {1, 3}, {0, 3}, {0, 2}, {0, 1}, {1, 1}, {2, 1}, {1, 2}};
  for (const auto& p : points) {
    surface.connectivity.push_back(static_cast<std::int64_t>(surface.positions.size() / 3));
    surface.positions.insert(surface.positions.end(), {p[0], p[1], 0.0});
  }
  const Checked c = check(model("bezier15", {{"type", "constant"}, {"value", 0.05}}), surface);
  EXPECT_FALSE(c.judges(ENTS_CHECK_EDGE));
  EXPECT_EQ(c.violated, 0);
}

// Panel d, first case. |h| against the radius of curvature over every segment: three parabolas side by side,
// of which the middle one is the most curved, at its top.
TEST(SurfaceAdmissibility, PanelDFolds) {
  MeshSurface surface;
  surface.basis = &basis_named("line3");
  const double bend[] = {0.1, 0.4, 0.2}; // y = bend (1 - x^2): kappa = 2 bend at the top
  for (int i = 0; i < 3; ++i) {
    const std::int64_t node = i == 0 ? 0 : 2 * i;
    if (i == 0) surface.positions = {-1.0, 0.0};
    surface.positions.insert(surface.positions.end(), {2.0 * i, bend[i], 2.0 * i + 1.0, 0.0});
    surface.connectivity.insert(surface.connectivity.end(), {node, node + 2, node + 1});
    surface.surface_coordinates.insert(surface.surface_coordinates.end(), {0.0, 2.0, 1.0});
  }
  for (const double part : {0.5, 0.999, 1.001, 1.2}) {
    const double height = -part / 0.8;
    // 10 samples: none at the top, where the worst is found all the same
    const Checked c = check(model("line3", {{"type", "constant"}, {"value", height}}), surface, 0.0, 10);
    EXPECT_NEAR(c.value[ENTS_CHECK_FOLD], part, rounding + search_step * search_step * 10.0);
    EXPECT_EQ(c.violates(ENTS_CHECK_FOLD), part > 1.0);
    EXPECT_EQ(c.segment[ENTS_CHECK_FOLD], 1);
    EXPECT_NEAR(c.xi[ENTS_CHECK_FOLD][0], 0.0, 1e-6);
    EXPECT_EQ((c.marks[1] & bit(ENTS_CHECK_FOLD)) != 0, part > 1.0);
    EXPECT_EQ((c.marks[0] | c.marks[2]) & bit(ENTS_CHECK_FOLD), 0);
    if (part > 1.0) {
      EXPECT_NEAR(c.missing[ENTS_CHECK_FOLD], part - 1.0, 1e-10);
    }
    // The folded arc crosses itself where x + h n_x = 0: sqrt(1 + 0.64 x^2) = part.
    if (part == 1.2) {
      const Checked fine =
          check(model("line3", {{"type", "constant"}, {"value", height}}), surface, 0.0, 101);
      EXPECT_TRUE(fine.marks[1] & bit(ENTS_CHECK_CROSSING));
      const double x = std::sqrt(part * part - 1.0) / 0.8;
      EXPECT_NEAR(std::fabs(fine.xi[ENTS_CHECK_CROSSING][0]), x, 0.02); // a sample
      EXPECT_EQ(fine.segment[ENTS_CHECK_CROSSING], 1);
      EXPECT_EQ(fine.other[ENTS_CHECK_CROSSING], 1);
      EXPECT_GT(fine.value[ENTS_CHECK_CROSSING], 0.0);
    }
  }
}

// Panel d, second case. Constant heights on two plates with a concave corner of the angle `corner`: the
// plates cross at the distance h / tan(corner / 2) from the corner; the end of each lies 2 h cos^2(corner /
// 2) ... behind the other: its height over the other plate's plane is h - h cos(corner') with the turned
// normal. Lines, quadrangles, triangles.
TEST(SurfaceAdmissibility, PanelDNeighboursCross) {
  const double h = 0.1;
  for (const double corner : {2.6, pi / 2, 1.0}) {
    const double c = std::cos(corner), s = std::sin(corner);
    const MeshSurface profile = polyline({-c, s, 0.0, 0.0, 1.0, 0.0});
    MeshSurface turned = profile;
    turned.positions = {c, s, 0.0, 0.0, 1.0, 0.0}; // the outer side is inside the corner
    for (const std::string basis : {"line2", "quad4", "tri3"}) {
      MeshSurface surface = basis == "line2" ? turned : extruded(turned, basis);
      const Model m = model(basis, {{"type", "constant"}, {"value", h}});
      surface.surface_coordinates.assign(
          surface.connectivity.size() * static_cast<std::size_t>(m.parameters()), 0.0);
      for (std::size_t i = 0; i < surface.surface_coordinates.size(); ++i)
        surface.surface_coordinates[i] = 0.01 * static_cast<double>(i);
      const Checked r = check(m, surface, 0.0, 33);
      EXPECT_EQ(r.violated, bit(ENTS_CHECK_CROSSING) | bit(ENTS_CHECK_JUMP)) << basis << " " << corner;
      // The end of one plate at (0, h), or turned. Behind the other it is h (1 - n . n'), n . n' = -
      // cos(corner), if its foot is on the other: at h sin(corner) from the corner, always. Deeper points
      // have their foot beyond the end.
      EXPECT_NEAR(r.value[ENTS_CHECK_CROSSING], h * (1.0 + c), 1e-12) << basis << " " << corner;
      EXPECT_NE(r.segment[ENTS_CHECK_CROSSING], r.other[ENTS_CHECK_CROSSING]);
      EXPECT_NEAR(r.value[ENTS_CHECK_JUMP], 2.0 * h * std::cos(0.5 * corner), 1e-12);
      EXPECT_NEAR(r.value[ENTS_CHECK_WEDGE], corner, 1e-12);
      // on the other side of the plates the corner is convex: torn, but not crossed
      const Model below = model(basis, {{"type", "constant"}, {"value", -h}});
      EXPECT_EQ(check(below, surface, 0.0, 33).violated, bit(ENTS_CHECK_JUMP)) << basis << " " << corner;
    }
  }
}

// A thread on two plates with a convex corner: where h > 0 they part, where h = -g < 0 they cross, and the
// end of a root lies g (1 / cos(corner) - 1) behind the other plate at most. A point of a ridge has a normal
// projection on the far side of the neighbour's ridge, from behind: it is no depth.
TEST(SurfaceAdmissibility, PanelDThreadsCrossAtTheirRoots) {
  const double corner = 0.4, root = 0.08;
  MeshSurface surface =
      extruded(polyline({-2.0 * std::cos(corner), -2.0 * std::sin(corner), 0.0, 0.0, 2.0, 0.0}), "quad4");
  for (std::size_t i = 2; i < surface.positions.size(); i += 3) surface.positions[i] *= 3.0;
  for (const double lead : {0.0, 0.1, 0.3}) {
    surface.surface_coordinates.clear(); // along z, and how far round
    for (const std::int64_t node : surface.connectivity) {
      const double* x = &surface.positions[static_cast<std::size_t>(3 * node)];
      surface.surface_coordinates.insert(surface.surface_coordinates.end(),
                                         {2.0 * double(node / 2 - 1), x[2]});
    }
    const Model m =
        model("quad4", {{"type", "sum"},
                        {"of",
                         {{{"type", "constant"}, {"value", 0.7 - root}},
                          {{"type", "sine"}, {"amplitude", 0.7}, {"wave_vector", {lead, 1.0}}}}}});
    const Checked r = check(m, surface, 0.0, 65);
    EXPECT_TRUE(r.violates(ENTS_CHECK_CROSSING)) << lead;
    const double exact = root * (1.0 / std::cos(corner) - 1.0);
    EXPECT_NEAR(r.value[ENTS_CHECK_CROSSING], exact, (0.3 + lead) * exact) << lead;
  }
}

// Heights that vanish on the edge and rise from it: neighbours overlap from the edge on where the slopes
// leave no angle between them, and meet again where the heights have come down. h = a (1 - s^2): slope 2 a.
TEST(SurfaceAdmissibility, PanelDNoAngleIsLeft) {
  const double corner = 0.6;
  MeshSurface surface = polyline({2.0 * std::cos(corner), 2.0 * std::sin(corner), 0.0, 0.0, 2.0, 0.0});
  for (const double part : {0.5, 0.99, 1.01, 1.5}) { // of the slope that closes the angle
    const double a = 0.5 * std::tan(0.5 * part * corner);
    const Checked r =
        check(model("line2", {{"type", "polynomial"}, {"coefficients", {a, 0.0, -a}}}), surface, 0.0, 129);
    EXPECT_NEAR(r.value[ENTS_CHECK_WEDGE], (1.0 - part) * corner, rounding);
    const std::int64_t crossing = bit(ENTS_CHECK_WEDGE) | bit(ENTS_CHECK_CROSSING);
    EXPECT_EQ(r.violated & bit(ENTS_CHECK_WEDGE), part < 1.0 ? 0 : bit(ENTS_CHECK_WEDGE)) << part;
    EXPECT_EQ(r.violated, part < 1.0 ? 0 : part > 1.1 ? crossing : r.violated & crossing) << part;
    EXPECT_EQ(r.value[ENTS_CHECK_JUMP], 0.0);
  }
}

// Any two segments, not only neighbours: a bump on one of two plates that reaches through the other.
TEST(SurfaceAdmissibility, PanelDFarSegmentsCross) {
  MeshSurface profile = polyline({0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 2.0, 0.2, 1.0, 0.2, 0.0, 0.2});
  profile.connectivity = {0, 1, 1, 2, 3, 4, 4, 5};
  MeshSurface surface = profile;
  surface.surface_coordinates = {0.0, 1.0, 1.0, 2.0,
                                 5.0, 6.0, 6.0, 7.0}; // the bump is on the lower plate alone
  for (const double amplitude : {0.19, 0.23}) {
    const json bump = {{"type", "gaussian"}, {"amplitude", amplitude}, {"center", {1.4375}}, {"width", 0.1}};
    const Checked r = check(model("line2", bump), surface, 0.0, 257);
    const bool through = amplitude > 0.2;
    EXPECT_EQ(r.violated, through ? bit(ENTS_CHECK_CROSSING) : 0) << amplitude;
    if (!through) continue;
    EXPECT_NEAR(r.value[ENTS_CHECK_CROSSING], amplitude - 0.2, 1e-12); // its top is a sample
    EXPECT_EQ(r.segment[ENTS_CHECK_CROSSING], 1);
    EXPECT_EQ(r.other[ENTS_CHECK_CROSSING], 2);
    EXPECT_EQ(r.marks, (std::vector<std::int64_t>{0, r.violated, r.violated, 0}));
    EXPECT_NEAR(r.point[ENTS_CHECK_CROSSING][0], 1.4375, 1e-12);
  }
}

// C2 is enough, also with friction, though its exact tangent jumps then: a height map is a cubic spline.
TEST(SurfaceAdmissibility, ContinuityWithFriction) {
  const json map = {
      {"type", "map"}, {"values", {0.0, 0.01, 0.03, 0.02}}, {"size", {4.0}}, {"boundary", "periodic"}};
  const json normal = {{"type", "penalty"}, {"stiffness", 1.0}};
  const json friction = {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 1.0}};
  const MeshSurface surface = strip(2, 2.0);
  for (const json& contact : {json{{"normal", normal}}, json{{"normal", normal}, {"friction", friction}}}) {
    const Checked of_map = check(model("line2", map, {{"contact", contact}}), surface);
    EXPECT_EQ(of_map.value[ENTS_CHECK_CONTINUITY], 2.0);
    EXPECT_EQ(of_map.bound[ENTS_CHECK_CONTINUITY], 2.0);
    EXPECT_EQ(of_map.violated, 0);
    EXPECT_EQ(
        check(model("line2", waves(0.01, 1.0), {{"contact", contact}}), surface).value[ENTS_CHECK_CONTINUITY],
        1000.0);
  }
}

// Random textures on distorted surfaces of all bases that are not smoothed, far below the bounds of single
// segments: only their neighbours are torn, or overlap, by the height on the edge times the angle between
// them.
TEST(SurfaceAdmissibility, RandomSurfacesBelowEveryBound) {
  Random random(4);
  for (const Basis& basis : bases()) {
    if (basis.family == Family::catmull_rom || basis.family == Family::bspline) continue;
    for (int repeat = 0; repeat < 5; ++repeat) {
      MeshSurface surface = draw_mesh(random, basis, 3, 0.02);
      json height = {{"type", "sine"}, {"amplitude", 0.01}, {"wave_vector", {0.2}}};
      if (basis.dimension == 3) height["wave_vector"] = {0.2, -0.15};
      const Model m = model(basis.name, height);
      const Checked c = check(m, surface, 0.1);
      EXPECT_EQ(c.violated & ~(bit(ENTS_CHECK_JUMP) | bit(ENTS_CHECK_CROSSING)), 0) << basis.name;
      EXPECT_LT(c.value[ENTS_CHECK_JUMP], 0.01 * c.value[ENTS_CHECK_KINK] * 1.5 + 1e-12) << basis.name;
      EXPECT_LT(c.value[ENTS_CHECK_CROSSING], 0.01 * c.value[ENTS_CHECK_KINK] * 1.5 + 1e-12) << basis.name;
      EXPECT_LT(c.value[ENTS_CHECK_KINK], 0.4);
    }
  }
}

} // namespace
} // namespace mechanics::surface_continuity_test
