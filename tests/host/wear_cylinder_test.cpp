// SPDX-License-Identifier: BSD-3-Clause
// A rigid cylinder that wears into a block, against a boundary-element program of a half-plane that knows
// nothing of the library; on one segment and on many.
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "support.hpp"

namespace host::wear_cylinder_test {
namespace {

using std::numbers::pi;
using Vector = Eigen::VectorXd;

/// Depths worn into a half-plane by a rigid cylinder that slides across: cells of uniform pressure (Johnson,
/// Contact Mechanics, 1985, eq. 2.30b), Archard's law implicit in time.
struct HalfPlane {
  double modulus, radius, load, coefficient;
  int cells;
  double half_width;

  Vector worn(double distance, int increments) const {
    const double cell = 2 * half_width / cells, ds = distance / increments;
    const auto place = [&](int i) { return (i + 0.5) * cell - half_width; };
    const auto primitive = [](double x) { return x * std::log(x * x) - 2 * x; };
    Eigen::MatrixXd influence(cells, cells);
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j) {
        const double x = place(i) - place(j);
        influence(i, j) = -(primitive(x + cell / 2) - primitive(x - cell / 2)) / (pi * modulus);
      }
    Vector depth = Vector::Zero(cells);
    for (int n = 0; n < increments; ++n) {
      std::vector<int> closed(static_cast<std::size_t>(cells));
      std::iota(closed.begin(), closed.end(), 0);
      for (bool changed = true;
           changed;) { // cells that pull are open; then none of them overlaps (a convex body)
        const auto size = static_cast<Eigen::Index>(closed.size());
        Eigen::MatrixXd system = Eigen::MatrixXd::Zero(size + 1, size + 1);
        Vector right(size + 1);
        for (Eigen::Index a = 0; a < size; ++a) {
          const int i = closed[static_cast<std::size_t>(a)];
          for (Eigen::Index b = 0; b < size; ++b)
            system(a, b) = influence(i, closed[static_cast<std::size_t>(b)]);
          system(a, a) += coefficient * ds;
          system(a, size) = -1, system(size, a) = cell;
          right[a] = -place(i) * place(i) / (2 * radius) - depth[i];
        }
        right[size] = load;
        const Vector pressure = system.partialPivLu().solve(right);
        std::vector<int> pressed;
        for (Eigen::Index a = 0; a < size; ++a)
          if (pressure[a] > 0) pressed.push_back(closed[static_cast<std::size_t>(a)]);
        changed = pressed.size() < closed.size();
        if (!changed)
          for (Eigen::Index a = 0; a < size; ++a)
            depth[closed[static_cast<std::size_t>(a)]] += coefficient * ds * pressure[a];
        closed = pressed;
      }
    }
    return depth;
  }
};

// Rigid cylinder, R = 20 mm, 10.8333 N/mm, 3600 m, k = 2e-9 / MPa, E* = 115 385 MPa.
TEST(Wear, ACylinderWearsInAsOnAHalfPlane) {
  const Scene scene = read_scene(std::filesystem::path(EXAMPLES) / "wear_cylinder/scene.json");
  const std::vector<StepRecord> records = test::run(scene);
  ASSERT_EQ(records.size(), 51u);
  const double modulus = 105000 / (1 - 0.09);
  const HalfPlane coarse{modulus, 20, 10.8333, 2e-9, 150, 1.5}, fine{modulus, 20, 10.8333, 2e-9, 300, 1.5};
  const double deepest = fine.worn(3.6e6, 200).maxCoeff(), other = coarse.worn(3.6e6, 100).maxCoeff();
  EXPECT_NEAR(other, deepest, 2e-5) << "the boundary elements have not converged";
  EXPECT_NEAR(records.back().worn_depth, deepest, 2e-4); // 0.2 um
  // Worn area: k sum p A ds, which is k P s but for the slope of the cylinder.
  double expected = 0;
  for (std::size_t step = 1; step < records.size(); ++step) {
    const double ds = scene.history[0].values[step] - scene.history[0].values[step - 1];
    double force = 0;
    const ContactFields& fields = records[step].fields;
    for (std::size_t k = 0; k < fields.pressure.size(); ++k)
      if (fields.closed[k]) force += std::hypot(fields.node_forces[2 * k], fields.node_forces[2 * k + 1]);
    expected += 2 * 2e-9 * force * ds;
  }
  EXPECT_NEAR(records.back().worn_slave / expected, 1, 1e-10);
  EXPECT_NEAR(records.back().worn_slave / (2e-9 * 10.8333 * 3.6e6), 1, 1e-3);
  EXPECT_EQ(records.back().worn_master, 0);
  for (const StepRecord& record : records)
    for (const IncrementRecord& increment : record.increments)
      EXPECT_TRUE(quadratic(increment.residuals, 1e8, 1e-9)) << "step " << record.step;
}

/// The same scene with a master of many segments, pressed by a load.
Json cylinder_of(int segments, int increments) {
  Json json = parse_json_file(test::scene_file("wear_cylinder"));
  Json nodes, connectivity, coordinates;
  for (int i = 0; i <= segments; ++i) {
    const double x = 2 - 4.0 * i / segments;
    nodes.push_back({x, 0.1}), coordinates.push_back({x});
    if (i < segments) connectivity.push_back({i, i + 1});
  }
  Json& contact = json["contact"];
  contact["master"] = {{"rigid_body",
                        {{"nodes", nodes},
                         {"segments", connectivity},
                         {"surface_coordinates", coordinates},
                         {"loads", {{{"y", -10.8333 / 2}}}}}}};
  contact["model"].erase("surface_coordinates");
  contact["model"]["height"]["coefficients"][0] = 0.1001; // overlaps a little
  json["steps"] = {{"control", "load_factor"}, {"values", {1, {{"to", 1}, {"count", increments}}}}};
  json["history"]["distance"] = {0, {{"to", 72000 * increments}, {"count", increments}}};
  json.erase("exact");
  return json;
}

TEST(Wear, ACylinderWearsInTheSameWithAnySegments) {
  const int increments = 12;
  const Scene one = test::shipped_scene("wear_cylinder", [&](Json& json) {
    json["steps"]["values"][1]["count"] = increments;
    json["history"]["distance"][1] = {{"to", 72000 * increments}, {"count", increments}};
  });
  const StepRecord expected = test::run(one).back();
  for (const int segments : {1, 4, 16}) {
    const Scene scene = test::scene_from(cylinder_of(segments, increments));
    const std::vector<StepRecord> records = test::run(scene);
    ASSERT_EQ(records.size(), increments + 1u);
    EXPECT_NEAR(records.back().worn_depth / expected.worn_depth, 1, 1e-9) << segments;
    EXPECT_NEAR(records.back().worn_slave / expected.worn_slave, 1, 1e-9) << segments;
    for (const StepRecord& record : records)
      for (const IncrementRecord& increment : record.increments) {
        EXPECT_TRUE(quadratic(increment.residuals, 1e8, 1e-9)) << segments << ", step " << record.step;
        EXPECT_LE(increment.residuals.size(), 6u) << segments << ", step " << record.step;
      }
  }
}

} // namespace
} // namespace host::wear_cylinder_test
