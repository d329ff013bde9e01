// SPDX-License-Identifier: BSD-3-Clause
// Exact solutions are computed with the modulus, the axis and the geometry of the scene, or refused by the
// name of a key.
#include <cmath>

#include <gtest/gtest.h>

#include "support.hpp"

namespace host::exact_scope_test {
namespace {

Json shipped(const std::string& name) {
  Json json = parse_json_file(test::scene_file(name));
  for (const char* key : {"variants", "compare"}) json.erase(key);
  return json;
}

std::vector<StepRecord> solved(const Json& json) {
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  EXPECT_EQ(simulation.exact_axis().mismatch, "");
  return solve(simulation, {});
}

/// Move all that has an x.
void shift(Json& json, double by) {
  for (Json& part : json["parts"]) {
    part["x"]["from"] = part["x"]["from"].get<double>() + by;
    for (Json& piece : part["x"]["pieces"]) piece["to"] = piece["to"].get<double>() + by;
  }
  for (Json& node : json["contact"]["master"]["nodes"]) node[0] = node[0].get<double>() + by;
}

TEST(ExactScope, SolutionsOfAnotherFormulationAreRefused) {
  const Json plane = shipped("hertz2d"), space = shipped("hertz3d");
  const std::map<std::string, Json> exact{{"hertz_line", {{"radius", 10}}},
                                          {"hertz_point", {{"radius", 10}}},
                                          {"westergaard", {{"amplitude", 1e-3}, {"wavelength", 1}}},
                                          {"double_sine", {{"amplitude", 1e-3}, {"wavelength", 1}}},
                                          {"slope", {{"coefficient", 0.3}}},
                                          {"uniform_pressure", {{"pressure", 1}}}};
  const std::map<std::string, std::string> solved_in{
      {"hertz_line", "plane"},  {"hertz_point", "space axis"},
      {"westergaard", "plane"}, {"double_sine", "space"},
      {"slope", "plane"},       {"uniform_pressure", "plane space axis"}};
  for (const auto& [type, keys] : exact)
    for (const char* formulation : {"plane_strain", "plane_stress", "axisymmetric", ""}) {
      Json json = *formulation == 0 ? space : plane;
      if (*formulation != 0) json["formulation"] = formulation;
      json["exact"] = keys;
      json["exact"]["type"] = type;
      const std::string here = *formulation == 0                            ? "space"
                               : formulation == std::string("axisymmetric") ? "axis"
                                                                            : "plane";
      const std::string said = test::refusal(json);
      if (solved_in.at(type).find(here) != std::string::npos)
        EXPECT_EQ(said, "") << type << " " << formulation;
      else
        EXPECT_NE(said.find("/exact/type: this exact solution is one "), std::string::npos)
            << type << " " << formulation << said;
    }
}

TEST(ExactScope, BodiesAndMotionsThatAreNotSolvedForAreRefused) {
  Json json = shipped("cattaneo_mindlin");
  EXPECT_EQ(test::refusal(json), "");
  json["materials"]["other"] = {{"law", "linear_elastic"}, {"young", 2000}, {"poisson", 0.3}};
  json["parts"][1]["material"] = "other";
  EXPECT_NE(test::refusal(json).find(
                "/exact: \"cattaneo\" is for two bodies of equal elasticity; upper and lower differ"),
            std::string::npos);
  json = shipped("hertz2d");
  json["contact"]["master"]["direction"] = {0.1, -1};
  EXPECT_NE(test::refusal(json).find("/contact/master/direction: the exact solution is for a motion along y"),
            std::string::npos);
  json = shipped("slope");
  json["contact"]["master"]["nodes"] = {{-3, 0}, {3, 1}};
  EXPECT_NE(test::refusal(json).find("/contact/master/nodes: the slope"), std::string::npos);
}

// E* = E in plane stress; with that of plane strain the error of the peak pressure is 5 % and more.
TEST(ExactScope, PlaneStressHasItsOwnModulus) {
  for (const char* name : {"hertz2d", "westergaard"}) {
    Json json = shipped(name);
    json["formulation"] = "plane_stress";
    const std::string quantity = name == std::string("hertz2d") ? "peak pressure" : "mean pressure / p*";
    for (const StepRecord& record : solved(json)) {
      if (record.contact_fraction == 1) continue; // beyond p* there is no edge
      EXPECT_LT(std::abs(test::quantity(record, quantity).error), 0.01) << name << " step " << record.step;
    }
  }
}

// By whole elements of the slave's mesh, so that nothing but the place changes; then by any length.
TEST(ExactScope, TheAxisIsWhereTheMasterHasItsCrest) {
  test::Random random(1);
  Json wave = shipped("westergaard");
  wave["steps"]["values"] = {0.5178449, 0.8630749};
  const std::vector<StepRecord> there = solved(wave);
  for (int i = 0; i < 8; ++i) {
    const bool whole = i < 4;
    const double by = whole ? std::floor(random.uniform(0, 128)) / 256 : random.uniform(0, 0.5);
    Json json = wave; // the wave alone moves: x = -s, so its phase grows
    json["contact"]["model"]["height"]["phase"] = 1.5707963267948966 + 2 * std::acos(-1.) * by;
    const std::vector<StepRecord> here = solved(json);
    for (std::size_t step = 0; step < here.size(); ++step) {
      const Quantity &one = test::quantity(here[step], "half-width / lambda"),
                     &two = test::quantity(there[step], "half-width / lambda");
      EXPECT_NEAR(one.value, two.value, whole ? 1e-6 : 1. / 256) << by;
      EXPECT_LT(std::abs(one.error), 0.02) << by;
    }
  }
  Json hertz = shipped("hertz2d");
  hertz["steps"]["values"] = {1.5};
  const double half_width = test::quantity(solved(hertz).back(), "half-width").value;
  for (int i = 0; i < 4; ++i) {
    const double by = random.uniform(-30, 30);
    Json json = hertz;
    shift(json, by);
    EXPECT_NEAR(test::quantity(solved(json).back(), "half-width").value, half_width, 1e-6) << by;
  }
}

// A sphere on a body round the axis: Johnson 1985, eq. 4.22, a^3 = 3 P R / (4 E*), p0 = 3 P / (2 pi a^2).
TEST(ExactScope, ASphereOnAnAxisymmetricBody) {
  Json json = shipped("hertz2d");
  json["formulation"] = "axisymmetric";
  json["symmetry_copies"] = 1;
  json["exact"]["type"] = "hertz_point";
  json["steps"]["values"] = {0.3, 0.6, 1.2};
  const double modulus = 1000 / (1 - 0.09), spacing = 0.3 / 60;
  for (const StepRecord& record : solved(json)) {
    const double radius = std::cbrt(3 * record.force * 10 / (4 * modulus));
    const Quantity &pressure = test::quantity(record, "peak pressure"),
                   &edge = test::quantity(record, "contact radius");
    EXPECT_NEAR(edge.exact, radius, 1e-12);
    EXPECT_NEAR(pressure.exact, 1.5 * record.force / (std::acos(-1.) * radius * radius), 1e-12);
    EXPECT_NEAR(edge.value, edge.exact, spacing);
    EXPECT_LT(std::abs(pressure.error), 0.02) << "step " << record.step;
  }
}

TEST(ExactScope, TheModulusIsThatOfTheSlaveAndNotOfTheFirstPart) {
  Json json = shipped("hertz2d");
  const double modulus = contact_modulus(test::scene_from(json));
  json["materials"]["other"] = {{"law", "linear_elastic"}, {"young", 10}, {"poisson", 0.1}};
  Json first = json["parts"][0];
  first["name"] = "bl"; // the beginning of the other name
  first["material"] = "other";
  json["parts"].insert(json["parts"].begin(), first);
  EXPECT_EQ(contact_modulus(test::scene_from(json)), modulus);
  EXPECT_NEAR(modulus, 1000 / 0.91, 1e-9);
}

TEST(ExactScope, AMasterOfAnotherShapeIsTold) {
  const auto mismatch = [](const Json& json) {
    return exact_axis(test::scene_from(json), test::library()).mismatch;
  };
  test::Random random(2);
  const Json hertz = shipped("hertz2d"), wave = shipped("westergaard");
  EXPECT_EQ(mismatch(hertz), "");
  EXPECT_EQ(mismatch(wave), "");
  for (int i = 0; i < 50; ++i) {
    const double factor = random.uniform(1.05, 2);
    Json other = hertz;
    other["exact"]["radius"] = 10 * (i % 2 == 0 ? factor : 1 / factor);
    EXPECT_NE(mismatch(other).find("/exact: the master's surface is not the circle of this radius"),
              std::string::npos)
        << factor;
    other = wave;
    const char* key = i % 2 == 0 ? "amplitude" : "wavelength";
    other["exact"][key] = factor * other["exact"][key].get<double>();
    EXPECT_NE(mismatch(other).find("/exact: the master's surface is not the wave"), std::string::npos)
        << key << factor;
  }
  Json ring = hertz; // a torus
  ring["formulation"] = "axisymmetric";
  ring["exact"]["type"] = "hertz_point";
  EXPECT_EQ(mismatch(ring), "");
  for (Json& node : ring["contact"]["master"]["nodes"]) node[0] = node[0].get<double>() + 0.1;
  EXPECT_NE(mismatch(ring).find("not on the axis"), std::string::npos);
}

} // namespace
} // namespace host::exact_scope_test
