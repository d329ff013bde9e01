// SPDX-License-Identifier: BSD-3-Clause
// Stability maps: is the judge right, does it see what is wrong, and is nothing silently wrong?
#include <cmath>

#include <gtest/gtest.h>

#include "chart/careful_host.hpp"
#include "chart/judge.hpp"
#include "chart/map.hpp"
#include "chart/master_check.hpp"
#include "chart/true_curve.hpp"
#include "chart/true_sheet.hpp"
#include "support.hpp"

namespace host::chart::chart_test {
namespace {

using test::library;

Profile wavy(SurfaceKind surface, double amplitude, double waves, double curvature) {
  Profile profile;
  profile.surface = surface;
  profile.curvature = curvature;
  profile.height.constant = 0.1;
  profile.height.sum = {{amplitude, waves, 0.3}};
  profile.wavelength = 1 / waves;
  return profile;
}

// The judge's surface and the library's, each from its own formulae, are the same: to rounding of numbers of
// order 1, a few of them added.
TEST(Judge, SurfaceIsTheLibrarys) {
  for (const SurfaceKind surface : surface_kinds) {
    const Profile profile = wavy(surface, 0.07, 1.5, 0.3);
    const Press press = make_press({profile, {surface, ProjectionKind::normal, TangentKind::consistent}});
    const EntsModel model(library(), model_text(press, 0), "", "test");
    const TrueCurve curve(profile, ProjectionKind::normal, 0);
    ASSERT_EQ(curve.pieces(), press.row.segments());
    constexpr int parts = 7;
    const MasterPoints points = sample_master(model, press, parts);
    for (int k = 0; k < curve.pieces(); ++k)
      for (int i = 0; i <= parts; ++i) {
        const Eigen::Vector2d point = curve.point(k, static_cast<double>(i) / parts);
        const auto at = static_cast<std::size_t>(2 * (k * (parts + 1) + i));
        EXPECT_NEAR(point[0], points.point[at], 1e-14) << word(surface);
        EXPECT_NEAR(point[1], points.point[at + 1], 1e-14) << word(surface);
      }
  }
}

/// Energy of the press with the distance from a dense polygon of the surface: signed by the side, no
/// projection and no derivative.
double brute_energy(const Press& press, const std::vector<double>& polygon, const Vec& anchor, double x,
                    double y) {
  double least = INFINITY, side = 0;
  for (std::size_t i = 0; i + 3 < polygon.size(); i += 2) {
    const double ax = polygon[i], ay = polygon[i + 1], bx = polygon[i + 2] - ax, by = polygon[i + 3] - ay;
    const double share = std::clamp(((x - ax) * bx + (y - ay) * by) / (bx * bx + by * by), 0., 1.);
    const double square = std::pow(x - ax - share * bx, 2) + std::pow(y - ay - share * by, 2);
    if (square < least) least = square, side = bx * (y - ay) - by * (x - ax);
  }
  const Vec spring = press.spring();
  const double dx = x - anchor[0], dy = y - anchor[1];
  return 0.5 * (spring[0] * dx * dx + spring[1] * dy * dy + (side < 0 ? press.penalty * least : 0));
}

// Where the judge stands at the end of its way, the energy is lower than at all places around, in rings of
// several sizes. The polygon's sagitta is 0.07 (3 pi / 2000)^2 / 8 = 2e-7: the energy is off by penalty * gap
// * sagitta, 1e-7.
TEST(Judge, StandsAtAMinimumOfTheEnergy) {
  for (const double waves : {0.5, 1.5}) {
    const Press press = make_press({wavy(SurfaceKind::c2, 0.07, waves, 0.1), {}});
    const Truth truth = true_path(press);
    ASSERT_TRUE(truth.complete);
    const TrueCurve curve(wavy(SurfaceKind::c2, 0.07, waves, 0.1), ProjectionKind::normal, 0);
    std::vector<double> polygon;
    for (int k = 0; k < curve.pieces(); ++k)
      for (int i = 0; i < 1000; ++i) {
        const Eigen::Vector2d point = curve.point(k, i / 1000.);
        polygon.insert(polygon.end(), {point[0], point[1]});
      }
    const Vec anchor = press.anchor(1), x = truth.position.back();
    const double here = brute_energy(press, polygon, anchor, x[0], x[1]);
    for (const double radius : {0.003, 0.01, 0.03, 0.1})
      for (int i = 0; i < 64; ++i) {
        const double angle = i * 0.09817477042468103; // 2 pi / 64
        EXPECT_GT(brute_energy(press, polygon, anchor, x[0] + radius * std::cos(angle),
                               x[1] + radius * std::sin(angle)),
                  here - 1e-7)
            << waves << " waves, radius " << radius << ", direction " << i;
      }
    EXPECT_LT(energy_gradient(press, anchor, x, truth.pair.back()).norm(), 1e-9);
  }
}

// A step of the judge's that is twice as long changes nothing: its path is that of continuity.
TEST(Judge, DoesNotDependOnItsSteps) {
  const Press press = make_press({wavy(SurfaceKind::c1, 0.05, 1, 0.1),
                                  {SurfaceKind::c1, ProjectionKind::shadow, TangentKind::consistent}});
  const Truth fine = true_path(press, 512), coarse = true_path(press, 256);
  ASSERT_TRUE(fine.complete && coarse.complete);
  for (std::size_t i = 0; i < coarse.position.size(); ++i)
    EXPECT_LT((coarse.position[i] - fine.position[2 * i]).norm(), 1e-8) << i;
}

// A result that is moved by less than a thousandth of a wave is not taken for right.
TEST(Judge, SeesAWrongPosition) {
  const Press press = make_press({wavy(SurfaceKind::c2, 0.03, 1, 0.1), {}});
  Outcome outcome = solve(library(), press);
  ASSERT_EQ(outcome.end, End::solved);
  ASSERT_EQ(outcome.levels.size(), 16u);
  const Truth truth = true_path(press);
  EXPECT_EQ(judged(outcome, press, truth).fate, Fate::solved);
  outcome.levels[9].position[0] += 5e-4;
  const Cell cell = judged(outcome, press, truth);
  EXPECT_EQ(cell.fate, Fate::wrong);
  EXPECT_EQ(cell.wrong_increment, 10);
}

// Without its rules the same host is silently wrong somewhere on the very same points, and the judge sees it;
// with them nowhere.
TEST(StabilityMaps, NothingIsSilentlyWrong) {
  int careless_wrong = 0, solved = 0;
  for (Map& map : stability_maps(true)) {
    fill(map, library(), true);
    for (const Panel& panel : map.panels)
      for (std::size_t i = 0; i < panel.cells.size(); ++i) {
        const Fate fate = panel.cells[i].fate;
        if (!panel.careful) {
          careless_wrong += fate == Fate::wrong;
          continue;
        }
        solved += fate == Fate::solved;
        EXPECT_TRUE(fate != Fate::wrong && fate != Fate::unjudged)
            << map.title << ", " << word(panel.method.surface) << ", " << word(panel.method.projection)
            << ", " << word(panel.method.tangent) << ", point " << i << ": " << word(fate) << ", error "
            << panel.cells[i].error;
      }
  }
  EXPECT_GT(careless_wrong, 0);
  EXPECT_GT(solved, 0);
}

// In space: two bases carry one surface; both find the judge's way, with all tangents.
TEST(StabilityMaps, InSpaceBasesAgree) {
  for (const ProjectionKind projection : projection_kinds) {
    Truth truth;
    for (const SurfaceKind surface : {SurfaceKind::local, SurfaceKind::c2})
      for (const TangentKind tangent : tangent_kinds) {
        const Press press = make_press_in_space(0.02, 1, {surface, projection, tangent});
        if (truth.position.empty()) truth = true_path(press);
        const Outcome outcome = solve(library(), press);
        EXPECT_EQ(outcome.levels.size(), 16u)
            << word(surface) << ", " << word(projection) << ", " << word(tangent);
        EXPECT_EQ(judged(outcome, press, truth).fate, Fate::solved)
            << word(surface) << ", " << word(projection) << ", " << word(tangent);
      }
  }
}

// A segment whose height exceeds its radius of curvature is refused before the first increment.
TEST(StabilityMaps, AFoldIsSeenFirst) {
  Profile profile = wavy(SurfaceKind::c2, 0.004, 2, 0.5);
  profile.height.constant = 2.5;
  const Outcome outcome = solve(library(), make_press({profile, {}}));
  EXPECT_EQ(outcome.end, End::fold);
  EXPECT_EQ(outcome.iterations, 0);
}

} // namespace
} // namespace host::chart::chart_test
