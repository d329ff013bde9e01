// SPDX-License-Identifier: BSD-3-Clause
// Splines that follow the nodes (quasi-interpolation): order of their distance from the surface on which the
// nodes lie, continuity, ends, and the nodal forces of a uniform pressure.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "smoothed_surface.hpp"
#include "worst.hpp"

namespace mechanics::quasi_interpolation_test {
namespace {

constexpr double pi = 3.141592653589793;

const Model& plain(const std::string& basis) {
  static std::map<std::string, Model> models;
  const auto found = models.find(basis);
  if (found != models.end()) return found->second;
  return models.emplace(basis, Model(R"({"segment": ")" + basis + R"(", "height": null})")).first->second;
}

using Distance = std::function<double(const Vec3&)>;

// The largest distance of the spline from the surface on which its nodes lie, over the facets that `counts`.
double distance(
    const std::string& basis, const HostMesh& mesh, std::int32_t ends, const Distance& from_surface,
    const std::function<bool(std::int64_t)>& counts = [](std::int64_t) { return true; }) {
  const SmoothedSurface spline(basis, mesh, ends);
  const auto d = static_cast<std::size_t>(mesh.dimension());
  std::vector<double> xi;
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= (d == 3 ? 8 : 0); ++j) {
      xi.push_back(-1.0 + 0.25 * i);
      if (d == 3) xi.push_back(-1.0 + 0.25 * j);
    }
  double worst = 0.0;
  for (std::int64_t f = 0; f < mesh.facets(); ++f) {
    if (!counts(f)) continue;
    const SurfacePoints at = spline.evaluate(plain(basis), f, xi);
    EXPECT_EQ(at.status, 0);
    for (std::size_t i = 0; i < at.point.size(); i += d)
      test::raise(worst, std::abs(from_surface(vec3(&at.point[i], static_cast<int>(d)))));
  }
  return worst;
}

// Between the two finest of meshes that are each twice as fine as the one before; printed.
double order(const std::string& what, const std::vector<double>& distances) {
  std::cout << what << ':';
  for (const double d : distances) std::cout << ' ' << d;
  const double last = std::log2(distances[distances.size() - 2] / distances.back());
  std::cout << " (order " << last << ")\n";
  return last;
}

HostMesh scaled(HostMesh mesh, double by) {
  for (double& x : mesh.positions) x *= by;
  return mesh;
}

// At the nodes the distance is delta^4 x / 36, R (2 pi / n)^4 / 36: 1.4e-4 for n = 24; between them it
// is 1.3e-5 more.
TEST(QuasiInterpolation, OfARingHasOrderFour) {
  std::vector<double> nodes, quasi;
  const Distance from = [](const Vec3& x) { return norm(x) - 1.1; };
  for (const int facets : {12, 24, 48, 96}) {
    const HostMesh ring = scaled(chain(facets, true), 1.1);
    nodes.push_back(distance("bspline4", ring, ENTS_ENDS_STRAIGHT, from));
    quasi.push_back(distance("bspline4", ring, ENTS_ENDS_QUASI_CUBIC, from));
  }
  EXPECT_NEAR(order("ring, control points at the nodes", nodes), 2.0, 0.05);
  EXPECT_GT(order("ring, quasi-interpolation", quasi), 3.9);
  EXPECT_NEAR(quasi[1], 1.56e-4, 1e-6);
  // the spline whose control points are the nodes runs inside of them, most in the middle of a facet
  const double a = pi / 24;
  EXPECT_NEAR(nodes[1], 1.1 * (1.0 - (23.0 * std::cos(a) + std::cos(3.0 * a)) / 24.0), 1e-9);
  EXPECT_NEAR(nodes[1], 0.0125, 1e-5);
}

TEST(QuasiInterpolation, ControlPointsAreOfThreeNeighbours) {
  const HostMesh ring = chain(24, true);
  const SmoothedSurface spline("bspline4", ring, ENTS_ENDS_QUASI_CUBIC);
  for (const std::int64_t point : spline.surface.connectivity) {
    const std::int64_t first = spline.begin[static_cast<std::size_t>(point)],
                       end = spline.begin[static_cast<std::size_t>(point) + 1];
    std::vector<double> weights(spline.weights.begin() + first, spline.weights.begin() + end);
    std::sort(weights.begin(), weights.end());
    ASSERT_EQ(weights.size(), 3u);
    EXPECT_NEAR(weights[0], -1.0 / 6.0, 1e-15);
    EXPECT_NEAR(weights[1], -1.0 / 6.0, 1e-15);
    EXPECT_NEAR(weights[2], 8.0 / 6.0, 1e-15);
  }
}

// Over an arc whose ends are free: nodes that are not equidistant (x = t + t^2 / 4).
TEST(QuasiInterpolation, OfAnArcWithFreeEnds) {
  std::map<std::int32_t, std::vector<double>> found;
  for (const int facets : {8, 16, 32, 64, 128}) {
    HostMesh arc = chain(facets, false);
    for (int i = 0; i <= facets; ++i) {
      const double t = 1.0 * i / facets, angle = t + 0.25 * t * t;
      arc.positions[2 * static_cast<std::size_t>(i)] = std::sin(angle);
      arc.positions[2 * static_cast<std::size_t>(i) + 1] = std::cos(angle);
    }
    for (const std::int32_t ends : {ENTS_ENDS_STRAIGHT, ENTS_ENDS_QUASI_CUBIC, ENTS_ENDS_QUASI_PARABOLIC})
      found[ends].push_back(distance("bspline4", arc, ends, [](const Vec3& x) { return norm(x) - 1.0; }));
  }
  EXPECT_NEAR(order("arc, control points at the nodes", found[ENTS_ENDS_STRAIGHT]), 2.0, 0.2);
  EXPECT_GT(order("arc, quasi-interpolation, cubic ends", found[ENTS_ENDS_QUASI_CUBIC]), 3.7);
  EXPECT_GT(order("arc, quasi-interpolation, parabolic ends", found[ENTS_ENDS_QUASI_PARABOLIC]), 2.7);
}

// n x n facets over the square |x|, |y| < 1/2, lifted.
HostMesh lifted(int n, const std::function<double(double, double)>& z) {
  HostMesh mesh = squares(n);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    mesh.positions[i] = mesh.positions[i] / n - 0.5, mesh.positions[i + 1] = mesh.positions[i + 1] / n - 0.5;
    mesh.positions[i + 2] = z(mesh.positions[i], mesh.positions[i + 1]);
  }
  return mesh;
}

TEST(QuasiInterpolation, OfRegularQuadrilateralsHasOrderFour) {
  std::map<std::int32_t, std::vector<double>> cap, cylinder;
  for (const std::int32_t ends : {ENTS_ENDS_STRAIGHT, ENTS_ENDS_QUASI_CUBIC, ENTS_ENDS_QUASI_PARABOLIC}) {
    for (const int n : {6, 12, 24}) {
      cap[ends].push_back(
          distance("bspline16", lifted(n, [](double x, double y) { return std::sqrt(4.0 - x * x - y * y); }),
                   ends, [](const Vec3& x) { return norm(x) - 2.0; }));
      HostMesh tube{"quad4", {}, {}};
      Nodes nodes(tube);
      const int round = 4 * n;
      for (int i = 0; i < round; ++i)
        for (int j = 0; j < n; ++j)
          for (const auto& [a, b] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            const int k = (i + a) % round;
            tube.connectivity.push_back(nodes.at(
                k, j + b, 0,
                {std::cos(2.0 * pi * k / round), std::sin(2.0 * pi * k / round), 1.0 * (j + b) / n}));
          }
      cylinder[ends].push_back(
          distance("bspline16", tube, ends, [](const Vec3& x) { return std::hypot(x[0], x[1]) - 1.0; }));
    }
  }
  EXPECT_NEAR(order("cap, control points at the nodes", cap[ENTS_ENDS_STRAIGHT]), 2.0, 0.2);
  EXPECT_GT(order("cap, cubic ends", cap[ENTS_ENDS_QUASI_CUBIC]), 3.5);
  EXPECT_GT(order("cap, parabolic ends", cap[ENTS_ENDS_QUASI_PARABOLIC]), 2.7);
  EXPECT_NEAR(order("cylinder, control points at the nodes", cylinder[ENTS_ENDS_STRAIGHT]), 2.0, 0.1);
  for (const std::int32_t ends : {ENTS_ENDS_QUASI_CUBIC, ENTS_ENDS_QUASI_PARABOLIC})
    EXPECT_GT(order("cylinder, quasi-interpolation", cylinder[ends]), 3.9);
}

// A sphere has eight nodes of three facets: order two there, with a smaller factor than control points at the
// nodes have; order four where all facets near are regular.
TEST(QuasiInterpolation, OfAnIrregularSphere) {
  std::vector<double> nodes, quasi, regular;
  const Distance from = [](const Vec3& x) { return norm(x) - 1.0; };
  for (const int k : {6, 12, 24}) {
    const HostMesh mesh = sphere(k);
    nodes.push_back(distance("bspline16", mesh, ENTS_ENDS_STRAIGHT, from));
    quasi.push_back(distance("bspline16", mesh, ENTS_ENDS_QUASI_CUBIC, from));
    // in the middle third of the sides, but for their kinks at the edges of the cube
    regular.push_back(distance("bspline16", mesh, ENTS_ENDS_QUASI_CUBIC, from, [&](std::int64_t f) {
      const int i = static_cast<int>(f % k), j = static_cast<int>(f / k % k);
      return i >= k / 3 && i < k - k / 3 && j >= k / 3 && j < k - k / 3;
    }));
  }
  order("sphere, control points at the nodes", nodes);
  EXPECT_GT(order("sphere, quasi-interpolation", quasi), 1.9);
  EXPECT_GT(order("sphere, middle of its sides", regular), 3.5);
  for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_LT(quasi[i], 0.15 * nodes[i]);
}

// Continuity of second derivatives, seen in the normal of the enriched surface: it tilts with the curvature
// of its base. Control points are shared by neighbours, so what is left is rounding; 1e-14 for normals of
// sums of numbers of size 1.
TEST(QuasiInterpolation, IsC2) {
  Random random(11);
  for (const std::int32_t ends : {ENTS_ENDS_QUASI_CUBIC, ENTS_ENDS_QUASI_PARABOLIC}) {
    const Model line(
        R"({"segment": "bspline4", "height": {"type": "polynomial", "coefficients": [0.05, 0.1]}})");
    HostMesh arc = scaled(chain(9, false), 0.2);
    arc.shake(random, 0.03);
    SmoothedSurface curve("bspline4", arc, ends);
    curve.carry_texture();
    double worst = 0.0;
    for (std::int64_t f = 0; f < 8; ++f) {
      const SurfacePoints end = curve.evaluate(line, f, {1.0}), start = curve.evaluate(line, f + 1, {-1.0});
      for (std::size_t k = 0; k < 2; ++k) {
        test::raise(worst, std::abs(end.point[k] - start.point[k]));
        test::raise(worst, std::abs(end.normal[k] - start.normal[k]));
      }
    }
    const Model surface(
        R"({"segment": "bspline16", "height": {"type": "polynomial", "coefficients": [[0.05, 0.1], [0.1, 0.0]]}})");
    constexpr int n = 5;
    HostMesh mesh = lifted(n, [](double x, double y) { return x * y + 0.3 * x * x * x; });
    mesh.shake(random, 0.02);
    SmoothedSurface patch("bspline16", mesh, ends);
    patch.carry_texture();
    for (std::int64_t f = 0; f < n * n; ++f)
      for (const double s : {-0.7, 0.2, 1.0})
        for (const bool right : {true, false}) {
          if (right ? f % n == n - 1 : f / n == n - 1) continue;
          const SurfacePoints end =
              patch.evaluate(surface, f, right ? std::vector{1.0, s} : std::vector{s, 1.0});
          const SurfacePoints start = patch.evaluate(surface, right ? f + 1 : f + n,
                                                     right ? std::vector{-1.0, s} : std::vector{s, -1.0});
          for (std::size_t k = 0; k < 3; ++k) {
            test::raise(worst, std::abs(end.point[k] - start.point[k]));
            test::raise(worst, std::abs(end.normal[k] - start.normal[k]));
          }
        }
    std::cout << "jump of points and enriched normals, ends " << ends << ": " << worst << '\n';
    EXPECT_LT(worst, 2e-14);
  }
}

// Free ends end in their nodes, whatever the nodes; nodes on a line or plane give a spline on it; equidistant
// nodes give equidistant points.
TEST(QuasiInterpolation, EndsInItsNodesAndKeepsWhatIsFlat) {
  Random random(12);
  for (const std::int32_t ends : {ENTS_ENDS_QUASI_CUBIC, ENTS_ENDS_QUASI_PARABOLIC}) {
    for (const int facets : {1, 2, 3, 4, 7}) {
      HostMesh line = chain(facets, false);
      const SmoothedSurface even("bspline4", line, ends);
      for (std::int64_t f = 0; f < facets; ++f) {
        const SurfacePoints at = even.evaluate(plain("bspline4"), f, {-1.0, 0.2, 1.0});
        for (std::size_t i = 0; i < 3; ++i) {
          EXPECT_NEAR(at.point[2 * i], static_cast<double>(f) + 0.5 * (i == 0 ? 0.0 : (i == 1 ? 1.2 : 2.0)),
                      1e-14);
          EXPECT_NEAR(at.point[2 * i + 1], 0.0, 1e-14);
        }
      }
      line.shake(random, 0.2);
      const SmoothedSurface curve("bspline4", line, ends);
      const SurfacePoints first = curve.evaluate(plain("bspline4"), 0, {-1.0}),
                          last = curve.evaluate(plain("bspline4"), facets - 1, {1.0});
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(first.point[k], line.position(0)[k], 1e-14);
        EXPECT_NEAR(last.point[k], line.position(facets)[k], 1e-14);
      }
    }
    for (const int n : {1, 2, 3, 5}) {
      HostMesh mesh = squares(n);
      const SmoothedSurface even("bspline16", mesh, ends);
      for (std::int64_t f = 0; f < n * n; ++f) {
        const SurfacePoints at = even.evaluate(plain("bspline16"), f, {-1.0, 1.0, 0.2, -0.4});
        EXPECT_NEAR(at.point[0], static_cast<double>(f % n), 1e-14);
        EXPECT_NEAR(at.point[1], static_cast<double>(f / n) + 1.0, 1e-14);
        EXPECT_NEAR(at.point[3], static_cast<double>(f % n) + 0.6, 1e-14);
        EXPECT_NEAR(at.point[4], static_cast<double>(f / n) + 0.3, 1e-14);
      }
      mesh.shake(random, 0.1);
      const SmoothedSurface shaken("bspline16", mesh, ends);
      for (int k = 0; k < 4; ++k) {
        const std::int64_t f = (k % 3 == 0 ? 0 : n - 1) + n * (k / 2 == 0 ? 0 : n - 1);
        const SurfacePoints at =
            shaken.evaluate(plain("bspline16"), f, {k % 3 == 0 ? -1.0 : 1.0, k / 2 == 0 ? -1.0 : 1.0});
        for (std::size_t i = 0; i < 3; ++i)
          EXPECT_NEAR(at.point[i], mesh.position(mesh.corner(f, k))[i], 2e-14) << n << ' ' << k;
      }
    }
  }
}

// Share of each of the nodes 0 .. n in a uniform pressure of 1 on n facets of length 1, over that of plain
// facets (1/2, 1, 1 ...): what slave points at these places with these areas transmit.
std::vector<double> shares(const std::string& basis, std::int32_t ends, int n,
                           const std::vector<std::pair<double, double>>& places_and_areas) {
  std::vector<double> out;
  for (int node = 0; node <= n; ++node) {
    HostMesh line = chain(n, false);
    line.positions[2 * static_cast<std::size_t>(node) + 1] = 1.0;
    const SmoothedSurface curve(basis, line, ends);
    double sum = 0.0;
    for (const auto& [x, area] : places_and_areas) {
      const int f = std::min(static_cast<int>(x), n - 1);
      sum += area * curve.evaluate(plain(basis), f, {2.0 * (x - f) - 1.0}).point[1];
    }
    out.push_back(sum / (node == 0 || node == n ? 0.5 : 1.0));
  }
  return out;
}

std::vector<std::pair<double, double>> slave_nodes(int n, int slave_facets) {
  std::vector<std::pair<double, double>> out;
  for (int i = 0; i <= slave_facets; ++i)
    out.push_back({1.0 * n * i / slave_facets, (i == 0 || i == slave_facets ? 0.5 : 1.0) * n / slave_facets});
  return out;
}

// On flush ends. A constant pressure passes where all shares are 1.
TEST(QuasiInterpolation, SharesOfAUniformPressure) {
  const auto worst = [](const std::vector<double>& s) {
    double w = 0.0;
    for (const double x : s) test::raise(w, std::abs(x - 1.0));
    return w;
  };
  std::vector<std::pair<double, double>> integral; // Gauss and Legendre, 4 points: exact for cubics
  for (int f = 0; f < 8; ++f)
    for (const auto& [x, w] :
         {std::pair{0.861136311594053, 0.347854845137454}, {0.339981043584856, 0.652145154862546}})
      for (const double sign : {-1.0, 1.0}) integral.push_back({f + 0.5 + 0.5 * sign * x, 0.5 * w});
  const struct {
    const char* name;
    const char* basis;
    std::int32_t ends;
    bool passes_matching;
  } rows[] = {{"catmull_rom4, straight", "catmull_rom4", ENTS_ENDS_STRAIGHT, true},
              {"bspline4, straight", "bspline4", ENTS_ENDS_STRAIGHT, false},
              {"bspline4, quasi cubic", "bspline4", ENTS_ENDS_QUASI_CUBIC, false},
              {"bspline4, quasi parabolic", "bspline4", ENTS_ENDS_QUASI_PARABOLIC, true}};
  for (const auto& row : rows) {
    const auto matching = shares(row.basis, row.ends, 8, slave_nodes(8, 8));
    std::cout << row.name << ": 8:8 " << matching[0] << ' ' << matching[1] << ' ' << matching[2] << ", worst "
              << worst(matching) << "; 8:32 " << worst(shares(row.basis, row.ends, 8, slave_nodes(8, 32)))
              << "; 8:11 " << worst(shares(row.basis, row.ends, 8, slave_nodes(8, 11))) << "; integral ";
    const auto integrated = shares(row.basis, row.ends, 8, integral);
    std::cout << integrated[0] << ' ' << integrated[1] << ' ' << integrated[2] << ", worst "
              << worst(integrated) << '\n';
    if (row.passes_matching)
      EXPECT_LT(worst(matching), 1e-14) << row.name;
    else
      EXPECT_GT(worst(matching), 0.05) << row.name;
    EXPECT_GT(worst(integrated), 0.05) << row.name; // no smooth master passes at a free end
  }
  for (int n = 2; n <= 9; ++n)
    EXPECT_LT(worst(shares("bspline4", ENTS_ENDS_QUASI_PARABOLIC, n, slave_nodes(n, n))), 1e-14) << n;
}

TEST(QuasiInterpolation, IsRefusedWhereItIsNotKnown) {
  ents_report report{};
  report.struct_size = sizeof report;
  std::int64_t points = 0, terms = 0;
  const HostMesh quads = squares(2), lines = chain(3, false), triangles = halved(quads);
  const auto size = [&](const HostMesh& mesh, const char* basis, std::int32_t ends) {
    return ents_smooth_size(mesh.facet.c_str(), basis, ends, mesh.facets(), mesh.connectivity.data(),
                            mesh.nodes(), &points, &terms, &report);
  };
  for (const auto& [mesh, basis] : {std::pair{&quads, "catmull_rom16"}, {&lines, "catmull_rom4"}}) {
    EXPECT_EQ(size(*mesh, basis, ENTS_ENDS_QUASI_CUBIC), ENTS_BAD_VALUE);
    EXPECT_NE(std::string(report.message).find("quasi-interpolation is for bspline4 and bspline16"),
              std::string::npos)
        << report.message;
  }
  EXPECT_EQ(size(triangles, "bezier15", ENTS_ENDS_QUASI_CUBIC), ENTS_BAD_VALUE);
  EXPECT_EQ(size(lines, "bspline4", 4), ENTS_BAD_VALUE);
  EXPECT_NE(std::string(report.message).find("'ends' is 4"), std::string::npos) << report.message;
}

} // namespace
} // namespace mechanics::quasi_interpolation_test
