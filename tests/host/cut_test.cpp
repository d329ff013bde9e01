// SPDX-License-Identifier: BSD-3-Clause
// Slave faces that are cut at the borders of the master's segments: pieces, quadrature, curved surfaces, the
// choice of master and slave, histories. The patch test is in patch_test.cpp.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "areas.hpp"
#include "cut_points.hpp"
#include "polygon.hpp"
#include "support.hpp"

namespace host::cut_test {
namespace {

// ---- pieces ----------------------------------------------------------------------------------------------

Polygon random_triangle(test::Random& random) {
  while (true) {
    Polygon triangle;
    for (int i = 0; i < 3; ++i) triangle.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1));
    if (area_of(triangle) > 0.05) return triangle;
  }
}

TEST(Polygon, IntersectionAndDifferenceDivideIt) {
  test::Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const Polygon one = random_triangle(random), other = random_triangle(random);
    std::vector<Polygon> parts;
    append_difference(one, other, 1e-12, parts);
    double sum = area_of(intersection(one, other, 1e-12));
    EXPECT_NEAR(sum, area_of(intersection(other, one, 1e-12)), 1e-11);
    for (const Polygon& part : parts) {
      EXPECT_TRUE(area_of(part) < 1e-10 || is_convex(part));
      EXPECT_LT(std::abs(area_of(intersection(part, other, 1e-12))), 1e-11);
      sum += area_of(part);
    }
    EXPECT_NEAR(sum, area_of(one), 1e-11); // 6 cuts, each moves a corner by at most 1e-12
  }
}

// Exact moments of a polygon from its border (Green): of x^i y^j, by quadrature over the edges.
double moment(const Polygon& polygon, int i, int j) {
  double sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector2d a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    for (const auto& [s, weight] : gauss_legendre(12)) {
      const Eigen::Vector2d x = 0.5 * ((1 - s) * a + (1 + s) * b);
      sum += 0.5 * weight * std::pow(x[0], i + 1) / (i + 1) * std::pow(x[1], j) * (b - a)[1];
    }
  }
  return sum;
}

TEST(Polygon, QuadratureIsExactToItsDegree) {
  const Polygon triangle{{0, 0}, {2, 0.5}, {0.4, 1.7}},
      quadrilateral{{0, 0}, {2, 0.3}, {1.6, 1.9}, {-0.3, 1}},
      pentagon{{0, 0}, {1, -0.4}, {1.9, 0.5}, {1.2, 1.6}, {0, 1.2}};
  for (const Polygon& polygon : {triangle, quadrilateral, pentagon})
    for (int n = 1; n <= 8; ++n) {
      std::vector<PlanePoint> rule;
      append_quadrature(polygon, n, rule);
      const int degree = n == 1 ? 1 : 2 * n - 2;
      for (int i = 0; i <= degree + 1; ++i)
        for (int j = 0; i + j <= degree; ++j) {
          double sum = 0;
          for (const PlanePoint& point : rule)
            sum += point.weight * std::pow(point.place[0], i) * std::pow(point.place[1], j);
          const double exact = moment(polygon, i, j);
          EXPECT_NEAR(sum, exact, 1e-13 * (1 + std::abs(exact))) << n << ": " << i << ", " << j;
        }
    }
}

/// A flat sheet of quadrilaterals over the unit square, z = 0, whose inner nodes are moved.
struct Sheet {
  Mesh mesh;
  std::vector<Face> faces;
};

Sheet sheet(int nx, int ny, double distortion, bool upwards, unsigned seed, double scale = 1) {
  Sheet result;
  test::Random random(seed);
  result.mesh.dimension = 3;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      const bool inner = i > 0 && i < nx && j > 0 && j < ny;
      const double dx = random.uniform(-distortion, distortion) / nx,
                   dy = random.uniform(-distortion, distortion) / ny;
      for (const double x : {i / double(nx) + (inner ? dx : 0), j / double(ny) + (inner ? dy : 0), 0.})
        result.mesh.coordinates.push_back(scale * x);
    }
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = i + j * (nx + 1), c = a + nx + 2;
      result.faces.push_back(upwards ? Face{4, {a, a + 1, c, c - 1}} : Face{4, {a, c - 1, c, a + 1}});
    }
  return result;
}

SegmentCorners corners_of(const Sheet& master) {
  SegmentCorners result;
  result.corners = 4;
  for (const Face& face : master.faces)
    for (const int node : face.nodes)
      for (const double x : master.mesh.node(node)) result.points.push_back(x);
  result.normals.assign(result.points.size(), 0.0);
  return result;
}

SlavePoints cut(const Sheet& slave, const SegmentCorners& master, int n) {
  return cut_points(slave.mesh, slave.faces, slave.mesh.coordinates, master, n, {});
}

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.); }

// A face's points have its area, whatever lies over it: a part of a master, two layers of it, none, and one
// that faces away.
TEST(CutPoints, AreasAddUpToTheFaces) {
  const Sheet slave = sheet(3, 4, 0.3, false, 1);
  const Sheet whole = sheet(4, 3, 0.3, true, 2), part = sheet(2, 2, 0, true, 3, 0.37);
  SegmentCorners two = corners_of(whole);
  const SegmentCorners second = corners_of(part);
  for (const std::vector<double>& more : {second.points})
    two.points.insert(two.points.end(), more.begin(), more.end());
  two.normals.resize(two.points.size());
  for (const SegmentCorners& master :
       {corners_of(whole), second, two, corners_of(sheet(4, 3, 0, false, 4)), SegmentCorners{4, {}, {}}}) {
    const SlavePoints points = cut(slave, master, 2);
    EXPECT_NEAR(total(points.areas), 1, 1e-12);
    for (const double area : points.areas) EXPECT_GT(area, 0);
    std::vector<double> areas(slave.mesh.coordinates.size() / 3, 0.0);
    for (std::size_t i = 0; i < points.nodes.size(); ++i)
      areas[static_cast<std::size_t>(points.nodes[i])] += points.weights[i] * points.areas[i / 4];
    const std::vector<double> exact =
        tributary_areas(slave.mesh, slave.faces, nodes_of(slave.faces), 1, false);
    for (std::size_t node = 0; node < areas.size(); ++node) EXPECT_NEAR(areas[node], exact[node], 2e-4);
  }
  EXPECT_EQ(cut(slave, corners_of(sheet(4, 3, 0, false, 4)), 2).size(), 12u * 4); // faces away: no cut
  EXPECT_GT(cut(slave, second, 2).size(), 12u * 4 + 3);
}

/// Shape functions of a flat quadrilateral at a place inside; false: outside.
bool shape_at(const Sheet& sheet, const Face& face, const std::array<double, 3>& place,
              Eigen::Vector4d& shape) {
  Eigen::Vector2d xi(0, 0);
  for (int iteration = 0; iteration < 30; ++iteration) {
    const auto point = detail::multilinear<4, 2>({xi[0], xi[1], 0}, 1);
    Eigen::Matrix<double, 2, 4> nodes;
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 2; ++i)
        nodes(i, a) = sheet.mesh.node(face.nodes[static_cast<std::size_t>(a)])[static_cast<std::size_t>(i)];
    shape = point.values;
    const Eigen::Vector2d miss = Eigen::Vector2d(place[0], place[1]) - nodes * shape;
    xi += (nodes * point.derivatives).inverse() * miss;
    if (!(xi.norm() < 10)) return false;
  }
  return xi.cwiseAbs().maxCoeff() <= 1 + 1e-9;
}

// What the patch test requires: a constant pressure gives every node of the master its tributary area. Flat
// parallelograms: exactly. Distorted quadrilaterals: to the order of the quadrature, because the inverse of a
// bilinear map is no polynomial.
TEST(CutPoints, MasterNodesGetTheirTributaryAreas) {
  for (const double distortion : {0., 0.3}) {
    const Sheet slave = sheet(3, 4, distortion, false, 5), master = sheet(5, 2, distortion, true, 6);
    const std::vector<double> exact =
        tributary_areas(master.mesh, master.faces, nodes_of(master.faces), 1, false);
    double before = 1;
    for (const int n : {2, 4, 6, 8}) {
      const SlavePoints points = cut(slave, corners_of(master), n);
      std::vector<double> areas(exact.size(), 0.0);
      for (std::size_t k = 0; k < points.size(); ++k) {
        Eigen::Vector4d shape;
        for (const Face& face : master.faces)
          if (shape_at(master, face, points.place(k, slave.mesh), shape)) {
            for (std::size_t a = 0; a < 4; ++a)
              areas[static_cast<std::size_t>(face.nodes[a])] += points.areas[k] * shape[static_cast<int>(a)];
            break;
          }
      }
      double error = 0;
      for (std::size_t node = 0; node < exact.size(); ++node)
        error = std::max(error, std::abs(areas[node] - exact[node]));
      std::printf("distortion %.1f, n = %d: %.1e of the area\n", distortion, n, error);
      EXPECT_LT(error, distortion == 0 ? 1e-14 : std::max(before / 4, 1e-13));
      before = error;
    }
    EXPECT_LT(before, 1e-8);
  }
}

// A polyline over a polyline, in the plane: a face is cut where the mean normal of two segments meets it.
TEST(CutPoints, LinesAreCutAtTheMeanNormal) {
  Mesh slave;
  slave.coordinates = {-1, 0.1, 1, 0.1};
  // Two segments that meet at (0.2, 0) under an angle: the normals are (-s, c) and (0, 1).
  const double slope = 0.2, c = std::cos(slope), s = std::sin(slope);
  SegmentCorners master;
  master.points = {0.2 - c, -s, 0.2, 0, 0.2, 0, 1.2, 0};
  master.normals = {-s, c, -s, c, 0, 1, 0, 1};
  const Face face{2, {1, 0, -1, -1}}; // its normal points down
  const SlavePoints points = cut_points(slave, {face}, slave.coordinates, master, 1, {2.0, false, false});
  ASSERT_EQ(points.size(), 3u); // and the rest beyond the left end of the master
  const double cut = 0.2 - 0.1 * std::tan(slope / 2), left = 0.2 - c - (0.1 + s) * std::tan(slope);
  // Points are numbered along the face, from right to left.
  EXPECT_NEAR(points.areas[0], 2 * (1 - cut), 1e-14);
  EXPECT_NEAR(points.areas[1], 2 * (cut - left), 1e-14);
  EXPECT_NEAR(points.areas[2], 2 * (left + 1), 1e-14);
  EXPECT_NEAR(points.place(1, slave)[0], 0.5 * (cut + left), 1e-14);
}

// ---- scenes ----------------------------------------------------------------------------------------------

/// Blocks pressed together in full contact, a wave on the master, meshes that do not match.
Scene wavy_patch(const std::function<void(Json&)>& edit) {
  return test::shipped_scene("patch_test", [&](Json& scene) {
    scene.erase("variants"), scene.erase("exact");
    scene["contact"]["master"]["surface_coordinates"] = {"x"};
    scene["contact"]["model"]["height"] = {{"type", "sine"}, {"amplitude", 1e-4}, {"wave_vector", {1.}}};
    scene["solver"] = {{"tolerance", 1e-13}};
    edit(scene);
  });
}

std::vector<double> displacement_of(const Scene& scene) {
  Simulation simulation(scene, &test::library());
  const std::vector<StepRecord> records = solve(simulation, {});
  EXPECT_EQ(records.back().contact_fraction, 1);
  return simulation.now().displacement;
}

double difference(const std::vector<double>& one, const std::vector<double>& other) {
  double sum = 0, norm = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
    sum += std::pow(one[i] - other[i], 2), norm += std::pow(other[i], 2);
  return std::sqrt(sum / norm);
}

// On pieces the integrand is smooth: two points more make the error smaller by orders. Points inside whole
// faces see the kinks of the master's shape functions, whatever their number.
TEST(Cut, CurvedSurfacesConvergeWithTheOrderOfTheQuadrature) {
  const auto with = [](const Json& sampling) {
    return displacement_of(wavy_patch([&](Json& scene) { scene["contact"]["sampling"] = sampling; }));
  };
  const std::vector<double> limit = with({{"cut", 10}});
  std::vector<double> cut, sampled;
  for (const int n : {1, 2, 3, 4}) cut.push_back(difference(with({{"cut", n}}), limit));
  for (const int n : {4, 8, 16}) sampled.push_back(difference(with(n), limit));
  std::printf("pieces, n = 1 to 4: %.1e, %.1e, %.1e, %.1e; faces, n = 4, 8, 16: %.1e, %.1e, %.1e\n", cut[0],
              cut[1], cut[2], cut[3], sampled[0], sampled[1], sampled[2]);
  // Gauss and Legendre: (h/4)^2n / (2n)! f^(2n), h the piece's part of a wavelength, f^(2n) ~ (2 pi)^2n; each
  // point more takes (2 pi h / 4)^2 / (2n (2n - 1)) < 1/40 of pieces h < 1/5
  for (std::size_t i = 1; i < cut.size(); ++i) EXPECT_LT(cut[i], cut[i - 1] / 20);
  EXPECT_LT(cut[3], sampled[2] / 1000);
}

struct Hertz {
  double force = 0, peak = 0, half_width = 0;
};

/// Two equal cylinders without friction, 52 faces over 44 where they touch. Peak: of the pressures at nodes,
/// which are those of their faces' points.
Hertz press_cylinders(bool swapped, const Json& sampling) {
  const Scene scene = test::shipped_scene("cattaneo_mindlin", [&](Json& json) {
    json.erase("variants"), json.erase("exact");
    Json& contact = json["contact"];
    contact["model"]["contact"].erase("friction");
    contact["model"]["segment"] = "line2", contact["model"]["border"] = 0.02;
    json["supports"].erase(2);
    json["supports"][1]["x"] = 0;
    json["parts"][0]["x"]["pieces"][1]["divisions"] = 44;
    json["steps"]["values"] = {0.25, 0.5, 0.75, 1};
    contact["sampling"] = sampling;
    if (swapped) contact["slave"] = "lower.y_max", contact["master"]["faces"] = "upper.y_min";
  });
  Simulation simulation(scene, &test::library());
  const StepRecord record = solve(simulation, {}).back();
  const SlavePoints& points = simulation.contact()->slaves();
  std::map<int, std::pair<double, double>> nodes; // force and area
  Hertz result;
  result.force = std::abs(record.contact_force[1]);
  double second = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double x = points.place(k, simulation.mesh())[0];
    second += points.areas[k] * record.fields.pressure[k] * x * x;
    for (std::size_t a = 0; a < 2; ++a) {
      const double area = points.areas[k] * points.weights[2 * k + a];
      auto& [force, sum] = nodes[points.nodes[2 * k + a]];
      force += area * record.fields.pressure[k], sum += area;
    }
  }
  result.half_width = 2 * std::sqrt(second / result.force); // the second moment of an ellipse is P a^2 / 4
  for (const auto& [node, sums] : nodes) result.peak = std::max(result.peak, sums.first / sums.second);
  return result;
}

TEST(Cut, MasterAndSlaveMayBeSwapped) {
  const Hertz one = press_cylinders(false, "cut"), other = press_cylinders(true, "cut");
  // Two equal bodies: E* = E / (2 (1 - nu^2)); the relative radius is that of the height.
  const double modulus = 1000 / (2 * 0.91),
               half_width = std::sqrt(4 * one.force * 10 / (std::numbers::pi * modulus)),
               peak = 2 * one.force / (std::numbers::pi * half_width);
  for (const Hertz& hertz : {one, other}) {
    std::printf("force %.6f, peak %.4f (%.4f), half-width %.5f (%.5f)\n", hertz.force, hertz.peak, peak,
                hertz.half_width, half_width);
    EXPECT_NEAR(hertz.peak / peak, 1, 0.01);
    EXPECT_NEAR(hertz.half_width / half_width, 1, 0.005);
  }
  EXPECT_NEAR(other.force / one.force, 1, 1e-5);
  EXPECT_NEAR(other.peak / one.peak, 1, 0.005);
  EXPECT_NEAR(other.half_width / one.half_width, 1, 0.005);
}

/// A block with eight faces on a master of five segments, pressed and moved along it by two segments.
Scene moving_block(bool friction) {
  return test::shipped_scene("patch_test", [&](Json& scene) {
    scene.erase("variants"), scene.erase("exact");
    scene["parts"][0]["x"] = test::axis(0.1, 0.5, 8);
    scene["supports"] = {{{"nodes", "lower.y_min"}, {"x", 0}, {"y", 0}},
                         {{"nodes", "upper.y_max"}, {"y", -0.002}, {"path", {{0, 0}, {1, 1}}}},
                         {{"nodes", "upper.y_max"}, {"x", 0.4}, {"path", {{1, 0}, {2, 1}}}}};
    scene["tractions"] = Json::array();
    scene["contact"]["sampling"] = "cut";
    if (friction)
      scene["contact"]["model"]["contact"]["friction"] = {
          {"type", "coulomb"}, {"coefficient", 0.1}, {"stiffness", 1e5}};
    scene["steps"]["values"] = {0.5, 1, 1.25, 1.5, 1.75, 2};
  });
}

// Without a history the faces are cut again in each increment: a checkpoint need not hold the points, and
// the run goes on to the same bits.
TEST(Cut, FollowsTheMotionAndGoesOnAfterARestart) {
  const Scene scene = moving_block(false);
  Simulation simulation(scene, &test::library());
  std::vector<std::string> checkpoints, fingerprints;
  std::vector<std::vector<double>> areas;
  RunObserver observer;
  observer.step_done = [&](const Simulation& at, const StepRecord& record) {
    EXPECT_EQ(record.fields.pressure.size(), at.contact()->slaves().size());
    checkpoints.push_back(at.checkpoint().dump());
    fingerprints.push_back(at.fingerprint());
    areas.push_back(at.contact()->areas());
  };
  solve(simulation, observer);
  ASSERT_EQ(checkpoints.size(), 6u);
  EXPECT_NE(areas[4], areas[5]);
  for (const std::vector<double>& of : areas) EXPECT_NEAR(total(of), 0.4, 1e-12);
  for (std::size_t step = 1; step < checkpoints.size(); ++step) {
    Simulation again(scene, &test::library());
    again.restore(Json::parse(checkpoints[step - 1]));
    EXPECT_EQ(again.fingerprint(), fingerprints[step - 1]);
    const double value = scene.steps[step];
    ASSERT_TRUE(again.advance({value, value}).converged);
    EXPECT_EQ(again.fingerprint(), fingerprints[step]) << step;
  }
}

// Friction has a history at each point: the points of the reference configuration stay.
TEST(Cut, PointsWithAHistoryStay) {
  const Scene scene = moving_block(true);
  Simulation simulation(scene, &test::library());
  EXPECT_FALSE(simulation.contact()->cuts_again());
  const std::vector<double> areas = simulation.contact()->areas();
  const std::vector<StepRecord> records = solve(simulation, {});
  EXPECT_EQ(simulation.contact()->areas(), areas);
  EXPECT_EQ(records.size(), scene.steps.size());
}

} // namespace
} // namespace host::cut_test
