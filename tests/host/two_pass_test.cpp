// SPDX-License-Identifier: BSD-3-Clause
// Two passes over two sides with the same height: the force of one pass within the discretisation.
#include <cmath>
#include <iostream>

#include <gtest/gtest.h>

#include "support.hpp"

namespace host::two_pass_test {
namespace {

/// Two blocks with waves that meet crest on crest, on meshes of n and 5 n / 4 cells, pressed together by 1.5e-3.
Json waves(int n, bool two_pass) {
  const Json wave{{"type", "sine"}, {"amplitude", 5e-4}, {"wave_vector", {2}}, {"phase", 0.6}};
  Json json = Json::parse(R"({
    "dimension": 2, "formulation": "plane_strain",
    "materials": {"block": {"law": "linear_elastic", "young": 1000, "poisson": 0.3}},
    "parts": [{"name": "lower", "material": "block", "element": "quad4"},
              {"name": "upper", "material": "block", "element": "quad4"}],
    "supports": [{"nodes": "upper.x_min", "x": 0}, {"nodes": "upper.x_max", "x": 0}, {"nodes": "lower.x_min", "x": 0},
                 {"nodes": "lower.x_max", "x": 0}, {"nodes": "lower.y_min", "y": 0}, {"nodes": "upper.y_max", "y": -1.5e-3}],
    "contact": {"slave": "upper.y_min", "sampling": 4, "slave_height": {"surface_coordinates": ["x"]},
      "master": {"faces": "lower.y_max", "surface_coordinates": ["x"]},
      "model": {"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 3e5}}}},
    "steps": {"control": "load_factor", "values": [{"to": 1, "count": 5}]}})");
  json["parts"][0]["x"] = test::axis(0, 1, n), json["parts"][0]["y"] = test::axis(-0.5, 0, n / 2);
  json["parts"][1]["x"] = test::axis(0, 1, n + n / 4), json["parts"][1]["y"] = test::axis(1e-3, 0.501, n / 2);
  Json& contact = json["contact"];
  contact["model"]["height"] = wave, contact["slave_height"]["height"] = wave;
  if (two_pass) contact["two_pass"] = true;
  return json;
}

// Both differ by less than what the mesh costs one pass, and both converge to the same force.
TEST(TwoPass, WavesOnWavesCarryTheForceOfOnePass) {
  const double fine = test::last_step(waves(64, false)).contact_force[1];
  for (const int n : {8, 16, 32}) {
    const StepRecord one = test::last_step(waves(n, false)), two = test::last_step(waves(n, true));
    EXPECT_GT(two.fields.pressure.size(), one.fields.pressure.size());
    EXPECT_GT(std::abs(one.contact_force[1]), 0.1);
    const double apart = std::abs(two.contact_force[1] / one.contact_force[1] - 1),
                 off = std::abs(one.contact_force[1] / fine - 1);
    EXPECT_LT(apart, off) << n;
    EXPECT_LT(std::abs(two.contact_force[1] / fine - 1), 1.1 * off) << n;
    EXPECT_LT(off, 10.0 / (n * n)); // of second order
    std::cout << n << " cells: forces of one and two passes differ by " << apart
              << ", one pass from that on 64 cells by " << off << "\n";
  }
}

// Which of the two is called the slave has no effect.
TEST(TwoPass, SidesWithOneHeightMayBeSwapped) {
  Json json = waves(8, true);
  const StepRecord as_given = test::last_step(json);
  json["contact"]["slave"] = "lower.y_max", json["contact"]["master"]["faces"] = "upper.y_min";
  EXPECT_NEAR(-test::last_step(json).contact_force[1] / as_given.contact_force[1], 1, 1e-9);
}

TEST(TwoPass, TwoHeightsAreRefused) {
  const auto expect = [](const Json& json, const char* words) {
    const std::string refusal = test::refusal(json);
    EXPECT_NE(refusal.find("/contact/two_pass"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find(words), std::string::npos) << refusal;
  };
  Json json = waves(8, true);
  json["contact"]["slave_height"]["height"]["phase"] = 0.5;
  expect(json, "write the same \"height\" into \"model\" and \"slave_height\"");
  json = waves(8, true);
  json["contact"].erase("slave_height");
  expect(json, "write the same \"height\"");
  json = waves(8, true);
  json["contact"]["model"].erase("height");
  expect(json, "write the same \"height\"");
  json = waves(8, true);
  json["contact"]["master"].erase("surface_coordinates");
  expect(json, "write the \"surface_coordinates\" of \"slave_height\" into \"master\", too");
}

} // namespace
} // namespace host::two_pass_test
