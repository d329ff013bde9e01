// SPDX-License-Identifier: BSD-3-Clause
// The contact patch test (Taylor and Papadopoulos 1991): a uniform pressure between blocks whose meshes do
// not match. Forces in slave nodes cannot transmit it to another mesh's nodes; points inside the faces can,
// the better the more there are.
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "support.hpp"

namespace host {
namespace {

struct Pressures {
  double largest = 0, smallest = 0, scatter = 0;
};

Pressures pressures(const Scene& scene) {
  Simulation simulation(scene, &test::library());
  const StepRecord record = solve(simulation, {}).back();
  // Whatever the scatter, the whole force comes through: the traction of 1 on an area of 1.
  EXPECT_NEAR(record.contact_force.back(), -1, 1e-9);
  return {test::quantity(record, "largest pressure").value, test::quantity(record, "smallest pressure").value,
          test::quantity(record, "scatter of the pressure (rms)").value};
}

Scene with_slave(const std::function<void(Json&)>& edit, bool solid) {
  return test::shipped_scene("patch_test", [&](Json& scene) {
    edit(scene["contact"]);
    scene.erase("variants");
    if (!solid) return;
    scene["dimension"] = 3;
    scene.erase("formulation");
    const auto spread = [](Json& part, int divisions, double growth) {
      part["element"] = "hex8";
      part["z"] = part["y"];
      part["y"] = {{"from", 0}, {"pieces", {{{"to", 1}, {"divisions", divisions}, {"growth", growth}}}}};
    };
    spread(scene["parts"][0], 4, 0.9);
    spread(scene["parts"][1], 3, 1);
    Json supports = Json::array();
    for (const char* part : {"upper", "lower"})
      for (const char* axis : {"x", "y"})
        for (const char* side : {"_min", "_max"})
          supports.push_back({{"nodes", std::string(part) + "." + axis + side}, {axis, 0}});
    supports.push_back({{"nodes", "lower.z_min"}, {"z", 0}});
    scene["supports"] = supports;
    scene["tractions"] = {{{"faces", "upper.z_max"}, {"value", {0, 0, -1}}}};
    scene["contact"]["slave"] = "upper.z_min";
    scene["contact"]["master"]["faces"] = "lower.z_max";
    scene["contact"]["model"]["segment"] = "quad4";
  });
}

TEST(PatchTest, SamplingPointsRecoverWhatNodesCannotTransmit) {
  for (const bool solid : {false, true}) {
    const auto measure = [&](const char* what, const std::function<void(Json&)>& edit) {
      const Pressures p = pressures(with_slave(edit, solid));
      std::printf("%s, %-26s pressure %.5f to %.5f, scatter %.1e\n", solid ? "3D" : "2D", what, p.smallest,
                  p.largest, p.scatter);
      return p.scatter;
    };
    const auto sampling = [&](int n) {
      return measure(("sampling " + std::to_string(n)).c_str(),
                     [n](Json& contact) { contact["sampling"] = n; });
    };
    const double equal = measure("nodes of equal areas", [](Json& contact) { contact["areas"] = "equal"; });
    const double tributary = measure("nodes of tributary areas", [](Json&) {});
    EXPECT_GT(equal, 0.3);      // wrong by a third,
    EXPECT_GT(tributary, 0.01); // by some per cent,
    const double coarse = sampling(2), medium = sampling(8), fine = sampling(32);
    // and then with the order of a quadrature over kinks, which is between one and two
    EXPECT_LT(medium, coarse / 4);
    EXPECT_LT(fine, medium / 4);
    EXPECT_LT(fine, 2e-4);
  }
}

// With matching meshes both are exact, up to the penalty's own unevenness: none, the pressure is uniform.
TEST(PatchTest, MatchingMeshesAreExact) {
  for (const int points : {0, 1, 3}) {
    const Scene matching = test::shipped_scene("patch_test", [points](Json& json) {
      json["parts"][0]["x"] = json["parts"][1]["x"];
      if (points > 0) json["contact"]["sampling"] = points;
      json.erase("variants");
    });
    EXPECT_LT(pressures(matching).scatter, 1e-8) << points; // the residual is below 1e-10 of the forces
  }
}

TEST(PatchTest, BadKeysAreNamed) {
  const auto expect = [](const char* key, const Json& value, const char* text) {
    try {
      with_slave([&](Json& contact) { contact["sampling"] = 2, contact[key] = value; }, false);
      FAIL() << key;
    } catch (const std::exception& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  expect("areas", "equal", "/contact/areas");
  expect("sampling", 0, "/contact/sampling");
  expect("sampling", "many", "/contact/sampling");
}

} // namespace
} // namespace host
