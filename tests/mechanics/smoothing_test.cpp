// Smoothed surfaces over a host's facets: what they are on regular meshes, that they know nothing of where
// the axes are, how neighbours meet, and where they end.
#include <gtest/gtest.h>

#include <iostream>

#include "smoothed_surface.hpp"
#include "worst.hpp"

namespace mechanics::smoothing_test {
namespace {

// A control point of an irregular facet is a sum of Bezier points with weights of (6 + 7 + 2)^2 = 225 in
// size, each rounded a few times.
constexpr double rounding = 225.0 * 8.0 * 1.1e-16;

const Model& plain(const std::string& basis) {
  static std::map<std::string, Model> models;
  const auto found = models.find(basis);
  if (found != models.end()) return found->second;
  return models.emplace(basis, Model(R"({"segment": ")" + basis + R"(", "height": null})")).first->second;
}

std::vector<HostMesh> irregular_meshes() {
  return {sphere(2),
          sphere(4),
          star(3, 2),
          star(5, 3),
          star(6, 2),
          star(7, 1),
          squares(4, [](int i, int j) { return i < 2 || j < 2; }),
          squares(5, [](int i, int j) { return i != 2 || j != 2; })};
}

std::int64_t other_corner(const HostMesh& mesh, std::int64_t facet, int corner) {
  return mesh.corner(facet, corner % 4);
}

TEST(Smoothing, OfRegularSquaresIsTheBasisItself) {
  Random random(5);
  HostMesh mesh = squares(5);
  mesh.shake(random, 0.2);
  std::map<std::pair<int, int>, std::int64_t> node;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i)
      for (int k = 0; k < 4; ++k) node[{i + (k == 1 || k == 2), j + k / 2}] = mesh.corner(5 * j + i, k);
  // The facets start in any of their corners: so do the segments.
  const HostMesh straight = mesh;
  for (std::size_t f = 0; f < 25; ++f)
    std::rotate(mesh.connectivity.begin() + static_cast<std::ptrdiff_t>(4 * f),
                mesh.connectivity.begin() + static_cast<std::ptrdiff_t>(4 * f + f % 4),
                mesh.connectivity.begin() + static_cast<std::ptrdiff_t>(4 * f + 4));
  for (const char* basis : {"catmull_rom16", "bspline16"})
    for (const std::int32_t ends : {ENTS_ENDS_STRAIGHT, ENTS_ENDS_REPEATED}) {
      const SmoothedSurface smoothed(basis, straight, ends), turned(basis, mesh, ends);
      const auto point = [&](int i,
                             int j) -> Vec3 { // extended over the borders, one direction after the other
        const auto line = [&](int at, const auto& value) {
          const int inside = std::clamp(at, 0, 5);
          if (at == inside) return value(at);
          if (ends == ENTS_ENDS_REPEATED) return value(inside);
          return 2.0 * value(inside) - value(inside + (at < 0 ? 1 : -1));
        };
        return line(j, [&](int b) {
          return line(i, [&](int a) { return straight.position(node.at({a, b})); });
        });
      };
      for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 5; ++i) {
          const std::int64_t f = 5 * j + i;
          const std::vector<double> master = smoothed.surface.master(f);
          std::vector<double> expected;
          for (int b = -1; b < 3; ++b)
            for (int a = -1; a < 3; ++a) {
              const Vec3 x = point(i + a, j + b);
              expected.insert(expected.end(), x.begin(), x.end());
            }
          const bool inside = i > 0 && i < 4 && j > 0 && j < 4;
          for (std::size_t k = 0; k < expected.size(); ++k)
            if (inside)
              EXPECT_EQ(master[k], expected[k]);
            else
              EXPECT_NEAR(master[k], expected[k], 1e-14); // sums of numbers up to 20
          // a quarter turn of the facet is one of the natural coordinates
          std::vector<double> xi = {0.3, -0.6};
          const SurfacePoints here = smoothed.evaluate(plain(basis), f, xi);
          for (int k = 0; k < f % 4; ++k) xi = {xi[1], -xi[0]};
          const SurfacePoints there = turned.evaluate(plain(basis), f, xi);
          for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(here.point[k], there.point[k], 1e-14) << f;
        }
    }
}

TEST(Smoothing, OfChainsIsTheBasisItself) {
  Random random(6);
  for (const bool closed : {false, true}) {
    HostMesh mesh = chain(8, closed);
    mesh.shake(random, 0.1);
    std::reverse(mesh.connectivity.begin(), mesh.connectivity.end()); // any order of facets
    for (std::size_t f = 0; f < 8; ++f) std::swap(mesh.connectivity[2 * f], mesh.connectivity[2 * f + 1]);
    for (const char* basis : {"catmull_rom4", "bspline4"})
      for (const std::int32_t ends : {ENTS_ENDS_STRAIGHT, ENTS_ENDS_REPEATED}) {
        const SmoothedSurface smoothed(basis, mesh, ends);
        for (int f = 0; f < 8; ++f) {
          const std::vector<double> master = smoothed.surface.master(7 - f);
          for (int a = 0; a < 4; ++a) {
            const int i = f - 1 + a;
            Vec3 expected = mesh.position(closed ? (i + 8) % 8 : std::clamp(i, 0, 8));
            if (!closed && ends == ENTS_ENDS_STRAIGHT && (i < 0 || i > 8))
              expected = 2.0 * expected - mesh.position(i < 0 ? 1 : 7);
            for (std::size_t k = 0; k < 2; ++k)
              EXPECT_EQ(master[2 * static_cast<std::size_t>(a) + k], expected[k]) << basis << f;
          }
        }
      }
  }
}

// A circle of eight nodes: every facet has the same arc; bspline4 lies inside, at 2/3 + 1/3 cos 45 of the
// radius.
TEST(Smoothing, OfACircleOfEightNodes) {
  const HostMesh mesh = chain(8, true);
  for (const char* basis : {"catmull_rom4", "bspline4"}) {
    const SmoothedSurface circle(basis, mesh);
    const double radius = std::string(basis) == "bspline4" ? 2.0 / 3.0 + std::sqrt(0.5) / 3.0 : 1.0;
    double lowest = 2.0, highest = 0.0;
    for (std::int64_t f = 0; f < 8; ++f) {
      const SurfacePoints at = circle.evaluate(plain(basis), f, {-1.0, 0.0, 1.0});
      const SurfacePoints next = circle.evaluate(plain(basis), (f + 1) % 8, {-1.0});
      for (std::size_t k : {std::size_t{0}, std::size_t{4}})
        EXPECT_NEAR(std::hypot(at.point[k], at.point[k + 1]), radius, 1e-15 * 4.0);
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(at.point[4 + k], next.point[k], 1e-15 * 4.0);
        EXPECT_NEAR(at.normal[4 + k], next.normal[k], 1e-15 * 8.0);
      }
      const double between = std::hypot(at.point[2], at.point[3]);
      test::lower(lowest, between);
      test::raise(highest, between);
    }
    EXPECT_NEAR(lowest, highest, 1e-15 * 4.0) << basis;
    std::cout << basis << ": radius " << radius << " at the nodes, " << lowest
              << " between (the chord: " << std::cos(3.141592653589793 / 8.0) << ")\n";
  }
}

TEST(Smoothing, KnowsNothingOfTheAxes) {
  Random random(7);
  std::vector<HostMesh> meshes = irregular_meshes();
  meshes.push_back(squares(3)), meshes.push_back(chain(5, false)), meshes.push_back(chain(5, true));
  meshes.push_back(halved(sphere(2))), meshes.push_back(triangle_star(5, 2)),
      meshes.push_back(halved(squares(3)));
  for (HostMesh& mesh : meshes) {
    mesh.shake(random, 0.05);
    const auto d = static_cast<std::size_t>(mesh.dimension());
    for (const std::int32_t ends :
         {ENTS_ENDS_STRAIGHT, ENTS_ENDS_REPEATED, ENTS_ENDS_QUASI_CUBIC, ENTS_ENDS_QUASI_PARABOLIC}) {
      if (mesh.facet == "tri3" && ends != ENTS_ENDS_STRAIGHT) continue;
      // weights of a control point of quasi-interpolation add up to (70 / 6)^2 at a corner in size
      const double tolerance = (ends >= ENTS_ENDS_QUASI_CUBIC ? 136.0 : 1.0) * rounding;
      const std::string basis = d == 2 ? "bspline4" : (mesh.facet == "tri3" ? "bezier15" : "bspline16");
      SmoothedSurface smoothed(basis, mesh, ends);
      for (std::size_t i = 0; i + 1 < smoothed.begin.size(); ++i) {
        double sum = 0.0;
        for (auto j = smoothed.begin[i]; j < smoothed.begin[i + 1]; ++j)
          sum += smoothed.weights[static_cast<std::size_t>(j)];
        EXPECT_NEAR(sum, 1.0, tolerance);
      }
      // a rigid motion of the nodes is one of the control points
      const double c = std::cos(0.7), s = std::sin(0.7);
      const auto moved = [&](const std::vector<double>& x) {
        std::vector<double> y = x;
        for (std::size_t i = 0; i < x.size(); i += d) {
          y[i] = c * x[i] - s * x[i + 1] + 2.0, y[i + 1] = s * x[i] + c * x[i + 1] - 1.0;
          if (d == 3) y[i + 2] = x[i + 2] + 0.5;
        }
        return y;
      };
      const std::vector<double> after = moved(smoothed.surface.positions);
      smoothed.follow(moved(mesh.positions));
      for (std::size_t i = 0; i < after.size(); ++i)
        EXPECT_NEAR(smoothed.surface.positions[i], after[i], 8.0 * tolerance); // positions up to 8
      // what is plane stays so
      std::vector<double> flat = mesh.positions;
      for (std::size_t i = 0; i < flat.size(); i += d) flat[i + d - 1] = 0.3 * flat[i] + 1.0;
      smoothed.follow(flat);
      for (std::size_t i = 0; i < smoothed.surface.positions.size(); i += d)
        EXPECT_NEAR(smoothed.surface.positions[i + d - 1], 0.3 * smoothed.surface.positions[i] + 1.0,
                    8.0 * tolerance);
    }
  }
}

// Straight ends: equidistant nodes give the plain facets again, corners and all.
TEST(Smoothing, WithStraightEndsKeepsEquidistantNodes) {
  const HostMesh mesh = squares(3);
  for (const char* basis : {"catmull_rom16", "bspline16"}) {
    const SmoothedSurface smoothed(basis, mesh);
    for (std::int64_t f = 0; f < 9; ++f)
      for (const double x : {-1.0, -0.2, 1.0})
        for (const double y : {-1.0, 0.6, 1.0}) {
          const SurfacePoints at = smoothed.evaluate(plain(basis), f, {x, y});
          EXPECT_NEAR(at.point[0], static_cast<double>(f % 3) + 0.5 + 0.5 * x, 1e-14);
          EXPECT_NEAR(at.point[1], static_cast<double>(f / 3) + 0.5 + 0.5 * y, 1e-14);
        }
  }
  // borders of bspline16 are the splines of their nodes, whatever lies inside
  Random random(8);
  for (HostMesh shaken : {squares(3), star(5, 3)}) {
    shaken.shake(random, 0.1);
    const SmoothedSurface smoothed("bspline16", shaken);
    // facet 2 is the last one of the first row; its edge 0 (star: 1) lies on the border
    const bool is_star = shaken.facets() != 9;
    const auto border = [&](double u) {
      return smoothed.evaluate(plain("bspline16"), 1 + (is_star ? 4 : 0),
                               is_star ? std::vector<double>{1.0, u} : std::vector<double>{u, -1.0});
    };
    const std::int64_t f = is_star ? 5 : 1;
    const int first = is_star ? 1 : 0, second = is_star ? 2 : 1;
    for (const auto& [u, node] :
         {std::pair{-1.0, shaken.corner(f, first)}, {1.0, shaken.corner(f, second)}}) {
      // neighbours along the border: nodes of facets of this border
      Vec3 sum = {};
      int neighbours = 0;
      std::map<std::int64_t, int> uses;
      for (std::int64_t g = 0; g < shaken.facets(); ++g)
        for (int k = 0; k < 4; ++k)
          for (const int step : {1, 3})
            if (shaken.corner(g, k) == node) ++uses[other_corner(shaken, g, k + step)];
      for (const auto& [neighbour, count] : uses)
        if (count == 1) sum = sum + shaken.position(neighbour), ++neighbours;
      ASSERT_EQ(neighbours, 2);
      const Vec3 expected = (1.0 / 6.0) * (sum + 4.0 * shaken.position(node));
      const SurfacePoints at = border(u);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(at.point[k], expected[k], rounding) << is_star;
    }
  }
}

// Corners lie on the limit surface of Catmull and Clark (1978): against subdivision of the rings, repeated
// until nothing changes.
TEST(Smoothing, CornersLieOnTheLimitOfSubdivision) {
  Random random(9);
  double worst = 0.0, worst_normal = 0.0;
  int extraordinary = 0;
  for (HostMesh mesh : {sphere(1), sphere(3), star(5, 2), star(6, 2), star(9, 2)}) {
    mesh.shake(random, 0.1);
    const SmoothedSurface smoothed("bspline16", mesh);
    for (std::int64_t v = 0; v < mesh.nodes(); ++v) {
      struct Facet {
        std::int64_t next, opposite, previous;
      };
      std::vector<Facet> around, ring;
      std::int64_t facet = -1;
      int corner = 0;
      for (std::int64_t f = 0; f < mesh.facets(); ++f)
        for (int k = 0; k < 4; ++k)
          if (mesh.corner(f, k) == v) {
            facet = f, corner = k;
            around.push_back(
                {other_corner(mesh, f, k + 1), other_corner(mesh, f, k + 2), other_corner(mesh, f, k + 3)});
          }
      ring.push_back(around[0]);
      while (ring.size() < around.size()) {
        const auto next = std::find_if(around.begin(), around.end(),
                                       [&](const Facet& f) { return f.next == ring.back().previous; });
        if (next == around.end()) break;
        ring.push_back(*next);
      }
      if (ring.size() < around.size() || ring.back().previous != ring[0].next) continue; // a border
      const std::size_t n = ring.size();
      extraordinary += n != 4;
      Vec3 x = mesh.position(v);
      std::vector<Vec3> edge, face;
      for (const Facet& f : ring)
        edge.push_back(mesh.position(f.next)), face.push_back(mesh.position(f.opposite));
      double scale = 1.0;
      Vec3 limit{}, normal{};
      for (int step = 0; step < 150;
           ++step) { // about x, and blown up again: what remains is the limit and its tangents
        std::vector<Vec3> faces, edges;
        Vec3 mean_face{}, mean_edge{};
        for (std::size_t i = 0; i < n; ++i)
          faces.push_back(0.25 * (x + edge[i] + face[i] + edge[(i + 1) % n]));
        for (std::size_t i = 0; i < n; ++i) {
          edges.push_back(0.25 * (x + edge[i] + faces[i] + faces[(i + n - 1) % n]));
          mean_face = mean_face + (1.0 / static_cast<double>(n)) * faces[i];
          mean_edge = mean_edge + (0.5 / static_cast<double>(n)) * (x + edge[i]);
        }
        x = (1.0 / static_cast<double>(n)) *
            (mean_face + 2.0 * mean_edge + (static_cast<double>(n) - 3.0) * x);
        limit = limit + scale * x;
        normal = {};
        const double size = norm(edges[0] - x);
        for (std::size_t i = 0; i < n; ++i)
          edge[i] = (1.0 / size) * (edges[i] - x), face[i] = (1.0 / size) * (faces[i] - x);
        for (std::size_t i = 0; i < n; ++i) normal = normal + cross(edge[i], edge[(i + 1) % n]);
        scale *= size, x = {};
      }
      const SurfacePoints at = smoothed.evaluate(
          plain("bspline16"), facet, {corner == 1 || corner == 2 ? 1.0 : -1.0, corner > 1 ? 1.0 : -1.0});
      test::raise(worst, norm(vec3(at.point.data(), 3) - limit));
      test::raise(worst_normal, norm(vec3(at.normal.data(), 3) - (1.0 / norm(normal)) * normal));
    }
  }
  EXPECT_EQ(extraordinary, 8 + 8 + 3);
  EXPECT_LE(worst, rounding);
  EXPECT_LE(worst_normal, 1e-8); // what 150 steps leave of the third eigenvalue, 0.85^150 at nine facets
}

} // namespace
} // namespace mechanics::smoothing_test
