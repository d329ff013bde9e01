// SPDX-License-Identifier: BSD-3-Clause
// The key "cut_off": a rough surface without its short waves and their law, on a mesh that does not resolve
// them, against boundary elements with all of them.
#include <cmath>

#include <gtest/gtest.h>

#include "removed_waves.hpp"
#include "support.hpp"

namespace host::removed_waves_test {
namespace {

Json rough_scene(int cells) {
  const Json roughness = {
      {"type", "roughness"}, {"seed", 7}, {"rms", 0.002}, {"hurst", 0.8}, {"wavelengths", {0.05, 0.5, 0.5}},
      {"size", {1, 1}}};
  Json json{{"dimension", 3},
            {"materials", {{"body", {{"law", "linear_elastic"}, {"young", 1000}, {"poisson", 0.3}}}}},
            {"parts",
             {{{"name", "block"},
               {"material", "body"},
               {"element", "layer"},
               {"x", test::axis(0, 1, cells)},
               {"y", test::axis(0, 1, cells)},
               {"z", test::axis(-0.5, 0, 1)}}}},
            {"steps", {{"control", "approach"}, {"values", {0.004, 0.006, 0.009}}}},
            {"exact", {{"type", "boundary_elements"}, {"points", 96}}}};
  json["contact"] = {{"slave", "block.z_max"},
                     {"master",
                      {{"nodes", {{-1, -1, 0.005}, {-1, 2, 0.005}, {2, 2, 0.005}, {2, -1, 0.005}}},
                       {"direction", {0, 0, -1}}}},
                     {"model",
                      {{"segment", "quad4"},
                       {"surface_coordinates", {{-1, -1}, {-1, 2}, {2, 2}, {2, -1}}},
                       {"height", roughness}}}};
  return json;
}

// A part of the AFM scan on cells of two heights each, with a cut-off of two cells. Without the key the same
// mesh is off by more in the area.
TEST(RemovedWaves, AreaPressureAndStiffnessOfAMeasuredSurface) {
  const auto scene_with = [](bool cut_off) {
    return test::shipped_scene("rough_afm", [&](Json& json) {
      for (const char* axis : {"x", "y"})
        json["parts"][0][axis]["pieces"][0] = {{"to", 5.5}, {"divisions", 32}};
      json["steps"]["values"] = {0.06, 0.08, 0.1};
      json["exact"]["points"] = 128;
      Json& contact = json["contact"];
      if (cut_off) {
        contact["cut_off"] = {{"wavelength", 0.15625}, {"points", 128}};
        contact.erase("law");
      } else {
        json.erase("exact");
      }
    });
  };
  const Scene scene = scene_with(true), plain_scene = scene_with(false);
  Simulation simulation(scene, &test::library()), plain_simulation(plain_scene, &test::library());
  const std::vector<StepRecord> records = solve(simulation, {}), plain = solve(plain_simulation, {});
  double before[2] = {};
  for (std::size_t k = 0; k < records.size(); ++k) {
    const Quantity &pressure = test::quantity(records[k], "mean pressure"),
                   &area = test::quantity(records[k], "contact fraction, estimated");
    std::printf("area %.2f %%: %+.1f %%, without %+.1f %%; pressure %+.2f %%, without %+.2f %%\n",
                100 * area.exact, 100 * area.error, 100 * (plain[k].area.fraction / area.exact - 1),
                100 * pressure.error, 100 * (plain[k].mean_pressure / pressure.exact - 1));
    // What the key is worth: no more than a third of the error in area is left. Nothing derives the 4 %: it
    // stands for the 3.1, 1.3 and -1.5 % that were measured, so that a change is noticed, and is no accuracy
    // that the key has on other surfaces (examples/rough_afm/README.md: up to 15 %).
    EXPECT_LT(std::abs(area.error), std::abs(plain[k].area.fraction / area.exact - 1) / 3);
    EXPECT_NEAR(area.error, 0, 0.04);
    EXPECT_NEAR(pressure.error, 0, 0.01);
    EXPECT_GT(std::abs(plain[k].area.fraction / area.exact - 1), 0.05);
    if (k > 0) {
      EXPECT_NEAR((pressure.value - before[0]) / (pressure.exact - before[1]), 1, 0.01);
    }
    before[0] = pressure.value, before[1] = pressure.exact;
  }
}

TEST(RemovedWaves, WrongScenesAreNamed) {
  const auto message = [](const Json& json) {
    try {
      const Scene scene = test::scene_from(json);
      Simulation simulation(scene, &test::library());
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Json json = rough_scene(4);
  json["contact"]["cut_off"] = 0.2;
  const auto expect = [&](const Json& scene, const std::string& text) {
    EXPECT_NE(message(scene).find(text), std::string::npos) << message(scene);
  };
  Json other = json;
  other["contact"]["model"]["contact"] = {{"normal", {{"type", "penalty"}, {"stiffness", 1e6}}}};
  expect(other, "/contact/cut_off: the law follows from the waves");
  other = json, other["contact"]["cut_off"] = -1;
  expect(other, "/contact/cut_off: a wavelength > 0");
  other = json, other["contact"]["cut_off"] = 0.01;
  expect(other, "/contact/cut_off: the height has no waves shorter than");
  other = json, other["contact"]["model"]["height"] = {{"type", "constant"}, {"value", 1}};
  expect(other, "/contact/cut_off: the model's height has no part of type map");
  other = json, other["contact"]["model"]["surface_coordinates"] = {{0, 0}, {0, 2}, {2, 2}, {2, 0}};
  expect(other, "/contact/cut_off: is for surface coordinates that are lengths");
  other = json, other["contact"]["sampling"] = "cut";
  expect(other, "/contact/cut_off: is not possible with \"sampling\": \"cut\"");
}

} // namespace
} // namespace host::removed_waves_test
