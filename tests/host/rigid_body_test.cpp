// SPDX-License-Identifier: BSD-3-Clause
// A rigid master that moves and turns, in whole scenes: loads and moments, against the master that moves
// along a line, many turns.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "program.hpp"
#include "support.hpp"

namespace host::rigid_body_test {
namespace {

constexpr double pi = std::numbers::pi;

// Hertz's cylinder, pressed in by prescribed displacements: as the master that moves along a line.
TEST(RigidBody, MovedAlongALineIsTheMasterThatOnlyMovesSo) {
  const auto edit = [](Json& json) {
    json["steps"] = {{"control", "approach"}, {"values", {0.001, 0.003}}};
    json.erase("variants"), json.erase("compare"), json.erase("exact");
  };
  const Scene line = test::shipped_scene("hertz2d", edit);
  const Scene body = test::shipped_scene("hertz2d", [&](Json& json) {
    edit(json);
    json["steps"]["control"] = "load_factor";
    json["contact"]["master"] = {{"rigid_body",
                                  {{"reference", {0.2, 0.03}},
                                   {"nodes", {{1, 0.05}, {-1, 0.05}}},
                                   {"segments", {{0, 1}}},
                                   {"prescribed", {{{"y", -1}}}}}}};
  });
  const std::vector<StepRecord> one = test::run(line), two = test::run(body);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t s = 0; s < one.size(); ++s) {
    EXPECT_GT(one[s].contact_fraction, 0.001);
    EXPECT_NEAR(two[s].contact_force[1], one[s].contact_force[1], 1e-9);
    double moment = 0;
    for (std::size_t k = 0; k < one[s].fields.pressure.size(); ++k) {
      EXPECT_NEAR(two[s].fields.pressure[k], one[s].fields.pressure[k], 1e-7) << k;
      moment += (one[s].positions[2 * k] - 0.2) * one[s].fields.node_forces[2 * k + 1] -
                (one[s].positions[2 * k + 1] - 0.03 + body.steps[s]) * one[s].fields.node_forces[2 * k];
    }
    EXPECT_NEAR(two[s].moment[0], moment, 1e-9);
  }
  EXPECT_TRUE(quadratic(two.back().increments.back().residuals, 1e4, 1e-11));
}

/// A smooth wheel of radius 1 on an elastic block, pressed in by 0.01.
Json wheel(double moment, int turns_steps) {
  Json json = Json::parse(R"({
    "dimension": 2, "formulation": "plane_strain",
    "materials": {"block": {"law": "linear_elastic", "young": 1000, "poisson": 0.3}},
    "parts": [{"name": "block", "material": "block", "element": "quad4",
      "x": {"from": -2, "pieces": [{"to": 2, "divisions": 40}]}, "y": {"from": -1, "pieces": [{"to": 0, "divisions": 8}]}}],
    "supports": [{"nodes": "block.y_min", "x": 0, "y": 0}],
    "contact": {"slave": "block.y_max", "master": {"rigid_body": {"reference": [0, 0.99]}},
      "model": {"segment": "bspline4", "contact": {"normal": {"type": "penalty", "stiffness": 1e5},
        "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 1e4}}}},
    "steps": {"control": "load_factor", "values": [1]}})");
  Json nodes = Json::array(), segments = Json::array();
  constexpr int count = 32;
  constexpr double step = 2 * pi / count;
  const double radius = 3 / (2 + std::cos(step)); // of control points: then the knots are on the circle
  for (int i = 0; i < count; ++i) { // clockwise: the normal of a line points to the left, outwards
    nodes.push_back({radius * std::cos(-step * i), 0.99 + radius * std::sin(-step * i)});
    segments.push_back({i, (i + 1) % count, (i + 2) % count, (i + 3) % count});
  }
  Json& body = json["contact"]["master"]["rigid_body"];
  body["nodes"] = nodes, body["segments"] = segments;
  if (moment != 0) {
    body["loads"] = {{{"turn", moment}}};
    body["springs"] = {{{"turn", 1.0}}};
  } else {
    body["prescribed"] = {{{"turn", 4 * pi}, {"path", {{0, 0}, {1, 1}}}}};
    json["steps"]["values"] = {{{"to", 1}, {"count", turns_steps}}};
  }
  return json;
}

// Two turns over the seam of its segments: pressures have no moment about the centre of a circle, friction
// has mu N R.
TEST(RigidBody, TurnsOverTheSeamOfItsSurface) {
  const Scene scene = test::scene_from(wheel(0, 48));
  Simulation simulation(scene, &test::library());
  const std::vector<StepRecord> records = solve(simulation, {});
  ASSERT_EQ(records.size(), 48u);
  for (std::size_t s = 1; s < records.size(); ++s) {
    double normal = 0;
    for (std::size_t k = 0; k < records[s].fields.pressure.size(); ++k)
      normal += records[s].fields.pressure[k] * simulation.contact()->areas()[k];
    EXPECT_GT(normal, 1);
    EXPECT_NEAR(records[s].moment[0] / normal, -0.3, 1e-3) << "step " << s + 1;
  }
}

// A cylinder that nothing but contact holds, from a first touch of one node or two.
TEST(RigidBody, AForcePressesItQuadratically) {
  Json json = parse_json_file(test::scene_file("wear_cylinder"));
  Json& contact = json["contact"];
  contact["master"] = {{"rigid_body",
                        {{"nodes", {{2, 0.1}, {-0.5, 0.1}, {-2, 0.1}}},
                         {"segments", {{0, 1}, {1, 2}}},
                         {"surface_coordinates", {{2}, {-0.5}, {-2}}},
                         {"loads", {{{"y", -10.8333 / 2}}}}}}};
  Json& model = contact["model"];
  for (const char* key : {"surface_coordinates", "parameters"}) model.erase(key);
  model["contact"].erase("wear");
  for (const char* key : {"exact", "history"}) json.erase(key);
  const auto peak = [](const StepRecord& record) {
    return *std::max_element(record.fields.pressure.begin(), record.fields.pressure.end());
  };
  Json moved = json;
  moved["contact"]["master"] = {{"nodes", {{2, 0.1}, {-2, 0.1}}}, {"direction", {0, -1}}};
  moved["contact"]["model"]["surface_coordinates"] = {{2}, {-2}};
  moved["steps"] = {{"control", "force"}, {"values", {10.8333}}};
  const double expected = peak(test::run(moved).back());
  json["steps"] = {{"control", "load_factor"}, {"values", {1}}};
  for (const double overlap : {1e-5, 1e-4, 1e-2}) {
    model["height"]["coefficients"][0] = 0.1 + overlap;
    const StepRecord record = test::run(json).back();
    EXPECT_EQ(record.increments.size(), 1u) << overlap;
    EXPECT_TRUE(quadratic(record.increments.back().residuals, 1e8, 1e-9)) << overlap;
    EXPECT_NEAR(peak(record) / expected, 1, 1e-9) << overlap;
  }
}

// A moment that friction holds, and one that it cannot hold alone: the spring takes the rest.
TEST(RigidBody, AMomentTurnsItQuadratically) {
  for (const double moment : {0.5, 6.0}) {
    Json json = wheel(moment, 1);
    json["steps"]["values"] = {{{"to", 1}, {"count", 24}}};
    const Scene scene = test::scene_from(json);
    Simulation simulation(scene, &test::library());
    const std::vector<StepRecord> records = solve(simulation, {});
    const double angle = simulation.now().displacement[simulation.now().displacement.size() - 2];
    // of the nut on the body, the load and the spring
    EXPECT_NEAR(records.back().moment[0] + moment - angle, 0, 1e-8 * (1 + moment));
    EXPECT_GT(angle, moment > 1 ? 1.0 : 1e-5);
    EXPECT_LT(angle, moment > 1 ? moment - 1 : 0.1);
    EXPECT_TRUE(quadratic(records.back().increments.back().residuals, 1e5, 1e-11));
  }
}

// The scene of the gallery, as far as the whole flank slips.
TEST(RigidBody, AScrewHasItsTorque) {
  const Scene scene = test::shipped_scene("screw", [](Json& json) { json["steps"]["values"] = {1, 1.001}; });
  const std::vector<StepRecord> records = test::run(scene);
  const Quantity& torque = test::quantity(records.back(), "torque / force, tightened");
  EXPECT_GT(torque.exact, 1.4);
  EXPECT_NEAR(torque.error, 0, 1e-3);
  EXPECT_TRUE(quadratic(records.back().increments.back().residuals, 1e6, 1e-10));
}

TEST(RigidBody, MistakesAreNamed) {
  Json json = wheel(0, 4);
  Json& body = json["contact"]["master"]["rigid_body"];
  body["loads"] = {{{"turn", 1}}};
  EXPECT_NE(test::refusal(json).find("turn is prescribed, a load on it has no effect"), std::string::npos)
      << test::refusal(json);
  body.erase("loads");
  body["free"] = {"z"};
  EXPECT_NE(test::refusal(json).find("/rigid_body/free"), std::string::npos) << test::refusal(json);
  body.erase("free");
  body["segments"][3] = {3};
  EXPECT_NE(test::refusal(json).find("as many nodes as in the first segment"), std::string::npos)
      << test::refusal(json);
  body["segments"][3] = {3, 64};
  EXPECT_NE(test::refusal(json).find("/segments"), std::string::npos) << test::refusal(json);
  body.erase("segments");
  EXPECT_NE(test::refusal(json).find("segments"), std::string::npos) << test::refusal(json);
  json = wheel(0, 4);
  json["contact"]["master"]["rigid_body"]["prescribed"][0]["turn_z"] = 1;
  EXPECT_NE(test::refusal(json).find("turn_z"), std::string::npos) << test::refusal(json);
}

} // namespace
} // namespace host::rigid_body_test
