// SPDX-License-Identifier: BSD-3-Clause
// Smoothed surfaces that end on planes of symmetry: a half with its plane is the whole.
#include <gtest/gtest.h>

#include <cstddef>
#include <iostream>

#include "smoothed_surface.hpp"
#include "worst.hpp"

namespace mechanics::smoothed_mirror_test {
namespace {

// The facets that `keeps`, with the nodes of `whole`.
HostMesh part(const HostMesh& whole, const std::function<bool(const Vec3&)>& keeps,
              std::vector<std::int64_t>& facets) {
  HostMesh mesh{whole.facet, {}, whole.positions};
  for (std::int64_t f = 0; f < whole.facets(); ++f) {
    bool all = true;
    for (int k = 0; k < whole.corners(); ++k) all = all && keeps(whole.position(whole.corner(f, k)));
    if (!all) continue;
    facets.push_back(f);
    for (int k = 0; k < whole.corners(); ++k) mesh.connectivity.push_back(whole.corner(f, k));
  }
  return mesh;
}

// A chain of 2 n lines, or 2 n x 2 n quadrilaterals (or halves of them), symmetric in x (and y), bent.
HostMesh symmetric(const std::string& facet, int n, bool in_y) {
  HostMesh mesh = facet == "line2" ? chain(2 * n, false) : squares(2 * n);
  const auto d = static_cast<std::size_t>(mesh.dimension());
  for (std::size_t i = 0; i < mesh.positions.size(); i += d) {
    double* x = &mesh.positions[i];
    x[0] -= n;
    if (d == 3) x[1] -= in_y ? n : 0;
    x[d - 1] = std::cos(0.7 * x[0]) + (d == 3 ? 0.3 * std::cos(in_y ? 0.5 * x[1] : x[1] * x[1]) : 0.0);
    x[0] += 0.05 * std::sin(x[0]);
  }
  return mesh;
}

TEST(SmoothedMirror, AHalfIsTheWhole) {
  const struct {
    const char *facet, *basis;
  } all[] = {
      {"line2", "bspline4"}, {"line2", "catmull_rom4"}, {"quad4", "bspline16"}, {"quad4", "catmull_rom16"}};
  double worst = 0.0;
  for (const auto& [facet, basis] : all)
    for (const std::int32_t ends :
         {ENTS_ENDS_STRAIGHT, ENTS_ENDS_REPEATED, ENTS_ENDS_QUASI_CUBIC, ENTS_ENDS_QUASI_PARABOLIC})
      for (const bool in_y : {false, true}) {
        const bool line = std::string(facet) == "line2";
        if ((ends >= ENTS_ENDS_QUASI_CUBIC && std::string(basis).starts_with("catmull")) || (line && in_y))
          continue;
        const HostMesh whole = symmetric(facet, 4, in_y);
        std::vector<std::int64_t> kept;
        const HostMesh half = part(
            whole, [&](const Vec3& x) { return x[0] > -1e-9 && (!in_y || x[1] > -1e-9); }, kept);
        const SmoothedSurface expected(basis, whole, ends);
        const SmoothedSurface got(basis, half, ends,
                                  in_y ? MirrorPlanes{{0, 1}, {0.0, 0.0}} : MirrorPlanes{{0}, {0.0}});
        for (std::size_t f = 0; f < kept.size(); ++f) {
          const std::vector<double> a = expected.surface.master(kept[f]),
                                    b = got.surface.master(static_cast<std::int64_t>(f));
          for (std::size_t i = 0; i < a.size(); ++i) test::raise(worst, std::abs(a[i] - b[i]));
        }
      }
  std::cout << "points of halves and quarters against those of the whole: " << worst << '\n';
  EXPECT_LT(worst,
            1e-13); // weights add up to 100 / 36 and 21 + 28 + 17 + 4 over 6 at ends, squared in 3D; |x| <= 4
}

// Irregular nodes, and triangles.
TEST(SmoothedMirror, HalvesOfASphere) {
  double worst = 0.0;
  for (const bool triangles : {false, true})
    for (const std::int32_t ends : {ENTS_ENDS_STRAIGHT, ENTS_ENDS_QUASI_CUBIC}) {
      if (triangles && ends != ENTS_ENDS_STRAIGHT) continue;
      HostMesh whole = sphere(4);
      if (triangles) { // four about the middle of each facet, so that planes are planes of symmetry
        HostMesh cut{"tri3", {}, whole.positions};
        for (std::int64_t f = 0; f < whole.facets(); ++f) {
          Vec3 middle{};
          for (int k = 0; k < 4; ++k) middle = middle + 0.25 * whole.position(whole.corner(f, k));
          const std::int64_t node = cut.nodes();
          cut.positions.insert(cut.positions.end(), middle.begin(), middle.end());
          for (int k = 0; k < 4; ++k)
            cut.connectivity.insert(cut.connectivity.end(),
                                    {whole.corner(f, k), whole.corner(f, (k + 1) % 4), node});
        }
        whole = cut;
      }
      std::vector<std::int64_t> kept;
      const HostMesh eighth = part(
          whole, [](const Vec3& x) { return x[0] > -1e-9 && x[1] > -1e-9 && x[2] > -1e-9; }, kept);
      const char* basis = triangles ? "bezier15" : "bspline16";
      const SmoothedSurface expected(basis, whole, ends);
      const SmoothedSurface got(basis, eighth, ends, MirrorPlanes{{2, 0, 1}, {0.0, 0.0, 0.0}});
      for (std::size_t f = 0; f < kept.size(); ++f) {
        const std::vector<double> a = expected.surface.master(kept[f]),
                                  b = got.surface.master(static_cast<std::int64_t>(f));
        for (std::size_t i = 0; i < a.size(); ++i) test::raise(worst, std::abs(a[i] - b[i]));
      }
    }
  std::cout << "points of an eighth of a sphere: " << worst << '\n';
  EXPECT_LT(
      worst,
      1e-12); // 225 x 8 roundings of the patches (smoothing_test.cpp), times those of quasi-interpolation
}

// Between two planes of one axis the surface is repeated without end, also if it is one or two facets wide.
TEST(SmoothedMirror, BetweenTwoPlanes) {
  for (const int facets : {1, 2, 3, 5})
    for (const bool reversed : {false, true}) {
      HostMesh cell = chain(facets, false);
      HostMesh many = chain(9 * facets, false);
      const auto height = [&](int i) {
        const int period = 2 * facets, k = ((i % period) + period) % period;
        return 0.2 * std::min(k, period - k) + 0.1 * std::cos(1.0 * std::min(k, period - k));
      };
      for (int i = 0; i <= facets; ++i) cell.positions[2 * static_cast<std::size_t>(i) + 1] = height(i);
      for (int i = 0; i <= 9 * facets; ++i) {
        many.positions[2 * static_cast<std::size_t>(i)] = i - 4.0 * facets;
        many.positions[2 * static_cast<std::size_t>(i) + 1] = height(i - 4 * facets);
      }
      MirrorPlanes planes{{0, 0}, {0.0, 1.0 * facets}};
      if (reversed) std::swap(planes.places[0], planes.places[1]);
      const SmoothedSurface expected("bspline4", many, ENTS_ENDS_QUASI_CUBIC);
      const SmoothedSurface got("bspline4", cell, ENTS_ENDS_QUASI_CUBIC, planes);
      for (std::int64_t f = 0; f < facets; ++f) {
        const std::vector<double> a = expected.surface.master(f + 4 * facets), b = got.surface.master(f);
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-13) << facets << ' ' << f;
      }
    }
}

TEST(SmoothedMirror, IsRefusedByName) {
  const HostMesh line = chain(4, false);
  ents_report report{};
  report.struct_size = sizeof report;
  ents_mirror mirror{};
  mirror.struct_size = sizeof mirror;
  mirror.positions = line.positions.data();
  std::int64_t points = 0, terms = 0;
  const auto says = [&](const MirrorPlanes& planes, std::int32_t status, const std::string& text) {
    mirror.planes = static_cast<std::int32_t>(planes.axes.size());
    mirror.axes = planes.axes.data(), mirror.places = planes.places.data();
    EXPECT_EQ(ents_smooth_mirrored_size("line2", "bspline4", ENTS_ENDS_STRAIGHT, 4, line.connectivity.data(),
                                        5, &mirror, &points, &terms, &report),
              status);
    EXPECT_NE(std::string(report.message).find(text), std::string::npos) << report.message;
  };
  says({{0}, {2.0}}, ENTS_BAD_VALUE, "lie on both sides of plane 0 (x = 2)");
  says({{0, 0}, {0.0, 4.5}}, ENTS_BAD_VALUE, "have no node on plane 1 (x = 4.5)");
  says({{2}, {0.0}}, ENTS_BAD_VALUE, "mirror.axes[0] is 2; it must be 0 .. 1");
  says({{0}, {std::nan("")}}, ENTS_NON_FINITE, "mirror.places[0]");
  says({std::vector<std::int32_t>(7, 0), std::vector<double>(7, 0.0)}, ENTS_BAD_COUNT, "mirror.planes = 7");
  says({{0, 0}, {0.0, 4.0}}, ENTS_OK, "");
  says({}, ENTS_OK, ""); // as ents_smooth
  EXPECT_EQ(points, 7);
  mirror.planes = 1, mirror.axes = nullptr;
  EXPECT_EQ(ents_smooth_mirrored_size("line2", "bspline4", ENTS_ENDS_STRAIGHT, 4, line.connectivity.data(), 5,
                                      &mirror, &points, &terms, &report),
            ENTS_NULL_ARGUMENT);
  EXPECT_EQ(ents_smooth_mirrored_size("line2", "bspline4", ENTS_ENDS_STRAIGHT, 4, line.connectivity.data(), 5,
                                      nullptr, &points, &terms, &report),
            ENTS_NULL_ARGUMENT);
}

// Of points whose terms are reflected, values that no reflection has are refused.
TEST(SmoothedMirror, CombinationsAreChecked) {
  const std::int64_t begin[] = {0, 1}, nodes[] = {0};
  const double weights[] = {1.0}, positions[] = {2.0, 3.0}, shifts[] = {10.0, 0.0};
  std::int32_t reflected[] = {1};
  ents_combination c{};
  c.struct_size = sizeof c;
  c.points = 1, c.begin = begin, c.nodes = nodes, c.weights = weights;
  c.reflected = reflected, c.shifts = shifts;
  ents_report report{};
  report.struct_size = sizeof report;
  double out[2] = {};
  ASSERT_EQ(ents_combine(&c, 2, 1, positions, out, &report), ENTS_OK) << report.message;
  EXPECT_EQ(out[0], 8.0);
  EXPECT_EQ(out[1], 3.0);
  reflected[0] = 8;
  EXPECT_EQ(ents_combine(&c, 2, 1, positions, out, &report), ENTS_BAD_VALUE);
  EXPECT_NE(std::string(report.message).find("reflected[0] (point 0) is 8"), std::string::npos)
      << report.message;
  c.struct_size = offsetof(ents_combination, reflected); // a caller of contract 1.7
  ASSERT_EQ(ents_combine(&c, 2, 1, positions, out, &report), ENTS_OK) << report.message;
  EXPECT_EQ(out[0], 2.0);
}

} // namespace
} // namespace mechanics::smoothed_mirror_test
