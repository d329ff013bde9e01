// SPDX-License-Identifier: BSD-3-Clause
// Scenes in which rounding keeps the residual above the tolerance: the run ends there, and says what rounding
// may leave.
#include <gtest/gtest.h>

#include "support.hpp"

namespace host::rounding_test {
namespace {

/// The scene converges with more than the tolerance left, in one step without cuts.
void ends_with_rounding(const Json& json, const char* what) {
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  std::string lines;
  std::vector<StepRecord> records;
  ASSERT_NO_THROW(records = solve(simulation, {[&](const std::string& line) { lines += line + "\n"; }, {}}))
      << what << "\n"
      << lines;
  for (const StepRecord& record : records) {
    EXPECT_TRUE(record.cuts.empty()) << what << "\n" << lines;
    const IncrementRecord& increment = record.increments.back();
    EXPECT_GT(increment.residuals.back(), scene.solver.tolerance) << what << "\n" << lines;
    EXPECT_LE(increment.residuals.back(), increment.rounding) << what << "\n" << lines;
    EXPECT_LT(increment.rounding, 1e-6) << what << "\n" << lines;
  }
  EXPECT_NE(lines.find("(rounding leaves up to "), std::string::npos) << lines;
}

Json hertz() {
  Json json = parse_json_file(test::scene_file("hertz2d"));
  json.erase("variants"), json.erase("compare"), json.erase("exact");
  json["steps"]["values"] = {0.25, 0.75};
  return json;
}

TEST(Rounding, NearlyIncompressible) {
  Json json = hertz();
  json["materials"]["block"]["poisson"] = 0.499;
  json["parts"][0]["x"]["pieces"][0]["divisions"] = 150;
  json["parts"][0]["y"]["pieces"][1]["divisions"] = 50;
  ends_with_rounding(json, "nu = 0.499");
  json["materials"]["block"]["poisson"] = 0.4999;
  ends_with_rounding(json, "nu = 0.4999");
}

TEST(Rounding, StiffLawOnAFineMesh) {
  Json json = hertz();
  json["parts"][0]["x"]["pieces"][0]["divisions"] = 150; // 0.002 apart
  json["contact"]["model"]["contact"]["normal"]["stiffness"] = 1e10;
  ends_with_rounding(json, "stiffness 1e10");
}

// The segment is tilted by 17 degrees, and its wave with it.
TEST(Rounding, TiltedWave) {
  const Json json = Json::parse(R"({"dimension": 2, "formulation": "plane_strain",
    "materials": {"block": {"law": "linear_elastic", "young": 1000, "poisson": 0.3}},
    "parts": [{"name": "block", "material": "block", "element": "quad4",
               "x": {"from": -0.2, "pieces": [{"to": 0.2, "divisions": 200}]},
               "y": {"from": -0.4, "pieces": [{"to": 0, "divisions": 40}]}}],
    "supports": [{"nodes": "block.y_min", "x": 0, "y": 0}],
    "contact": {"slave": "block.y_max",
      "master": {"nodes": [[2, 0.6], [-2, -0.6]], "direction": [0, -1]},
      "model": {"segment": "line2", "surface_coordinates": [[2], [-2]],
        "height": {"type": "sine", "amplitude": 0.005, "wave_vector": [2.5]},
        "contact": {"normal": {"type": "penalty", "stiffness": 4e9}}}},
    "steps": {"control": "force", "values": [0.2]}})");
  ends_with_rounding(json, "tilted wave");
}

// Where the tolerance can be reached nothing else ends the iteration.
TEST(Rounding, IsNoExcuseAboveIt) {
  Json json = hertz();
  json["steps"]["values"] = {0.25};
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  const IncrementRecord increment = solve(simulation, {}).back().increments.back();
  EXPECT_LE(increment.residuals.back(), scene.solver.tolerance);
  EXPECT_EQ(increment.rounding, 0);
}

} // namespace
} // namespace host::rounding_test
