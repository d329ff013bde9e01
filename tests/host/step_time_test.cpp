// SPDX-License-Identifier: BSD-3-Clause
// Steps take time: heat of friction, and a coefficient that depends on the slip rate. A block is pressed on a flat rigid
// body and dragged along it.
#include <cmath>
#include <iostream>

#include <gtest/gtest.h>

#include "result.hpp"
#include "support.hpp"

namespace host::step_time_test {
namespace {

constexpr double pressed = 0.01, way = 0.3; // the first step presses, each of the next drags by so much

/// @param friction  of the model; durations  of the steps
Json dragged(const Json& friction, const Json& durations) {
  const std::size_t steps = durations.size();
  Json press{{0, 0}, {1, 1}}, drag = Json::array();
  for (std::size_t i = 1; i <= steps; ++i) drag.push_back({i, i - 1});
  Json values;
  for (std::size_t i = 1; i <= steps; ++i) values.push_back(i);
  return {{"dimension", 2},
          {"formulation", "plane_strain"},
          {"materials", {{"steel", {{"law", "linear_elastic"}, {"young", 1000}, {"poisson", 0}}}}},
          {"parts",
           {{{"name", "block"},
             {"material", "steel"},
             {"element", "quad4"},
             {"x", test::axis(0, 2, 4)},
             {"y", test::axis(0, 1, 2)}}}},
          {"supports",
           {{{"nodes", "block.y_max"}, {"y", -pressed}, {"path", press}},
            {{"nodes", "block.y_max"}, {"x", way}, {"path", drag}}}},
          {"contact",
           {{"slave", "block.y_min"},
            {"master", {{"rigid_body", {{"nodes", {{-5, 0}, {10, 0}}}, {"segments", {{0, 1}}}}}}},
            {"model",
             {{"segment", "line2"},
              {"contact",
               {{"normal", {{"type", "penalty"}, {"stiffness", 1e4}}},
                {"friction", friction},
                {"heat", {{"friction", {{"share", 0.9}, {"slave", 0.3}}}}}}}}}}},
          {"steps", {{"control", "load_factor"}, {"values", values}, {"duration", durations}}}};
}

Json steps_of(const Json& json) {
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  return result_json(simulation, solve(simulation, {})).at("steps");
}

double length(const Json& vector) {
  double squared = 0;
  for (const double component : vector.get<std::vector<double>>()) squared += component * component;
  return std::sqrt(squared);
}

TEST(StepTime, ADraggedBlockHeatsByMuNV) {
  constexpr double mu = 0.2;
  const Json durations{1.0, 0.5, 0.5, 2.0};
  const Json steps =
      steps_of(dragged({{"type", "coulomb"}, {"coefficient", mu}, {"stiffness", 1e4}}, durations));
  for (const std::size_t i : {2, 3}) { // in the step before the block shears
    const double normal = length(steps[i].at("resultants").at("normal")),
                 power = 0.9 * mu * normal * way / durations[i].get<double>();
    const Json& heat = steps[i].at("heat");
    std::cout << "power " << heat.at("power") << ", mu N v " << power << "\n";
    EXPECT_NEAR(heat.at("power").get<double>() / power, 1, 1e-10);
    EXPECT_NEAR(heat.at("slave").get<double>() / power, 0.3, 1e-10);
    EXPECT_NEAR(heat.at("master").get<double>() / power, 0.7, 1e-10);
    EXPECT_EQ(steps[i].at("resultants").at("slip"), 5);
  }
  EXPECT_GT(steps[1].at("heat").at("power").get<double>(), 0);
}

TEST(StepTime, ACoefficientThatFallsWithTheSpeed) {
  const Json durations{1, 1, 1, 1, 1, 1, 0.1, 0.1, 0.1, 0.1, 0.1};
  const Json steps = steps_of(dragged(
      {{"type", "coulomb"}, {"coefficient", 0.4}, {"kinetic", 0.2}, {"decay", 2.0}, {"stiffness", 1e4}},
      durations));
  for (const std::size_t i : {5, 10}) { // the shear of the block follows the speed within some steps
    const double v = way / durations[i].get<double>(), mu = 0.2 + 0.2 * std::exp(-2 * v);
    const Json& sum = steps[i].at("resultants");
    EXPECT_NEAR(length(sum.at("tangential")) / length(sum.at("normal")), mu, 1e-10) << v;
  }
}

// A step that is cut takes as long as one that is not.
TEST(StepTime, IsSharedByThePartsOfAStep) {
  const Json json = dragged({{"type", "coulomb"}, {"coefficient", 0.2}, {"stiffness", 1e4}}, {1, 1, 1, 4});
  const Scene scene = test::scene_from(json);
  const auto heat = [&](StepPlan::Cut cut) {
    Simulation simulation(scene, &test::library());
    return solve(simulation, {}, {.cut = cut}).back().heat;
  };
  EXPECT_NEAR(heat(StepPlan::Cut::halves) / heat(StepPlan::Cut::none), 1, 1e-10);
}

TEST(StepTime, WhatIsWrongIsNamed) {
  const Json friction{{"type", "coulomb"}, {"coefficient", 0.2}, {"stiffness", 1e4}};
  Json json = dragged(friction, {1, 1});
  json["steps"]["duration"] = {1, 0};
  EXPECT_NE(test::refusal(json).find("/steps/duration: times above 0"), std::string::npos)
      << test::refusal(json);
  json["steps"]["duration"] = {1, 1, 1};
  EXPECT_NE(test::refusal(json).find("/steps/duration"), std::string::npos);
  json = dragged(friction, {1, 1});
  json["contact"]["model"]["contact"]["heat"]["conductance"] = 10;
  EXPECT_NE(test::refusal(json).find("/contact/model/contact/heat: bodies have no temperatures"),
            std::string::npos)
      << test::refusal(json);
  json = dragged(friction, {1, 1});
  json["contact"]["model"]["contact"].erase("friction");
  EXPECT_NE(test::refusal(json).find("/contact/model/contact/heat/friction"), std::string::npos);
  json = dragged(friction, {1, 1});
  json["contact"]["model"]["contact"]["heat"]["friction"]["slave"] = 2;
  EXPECT_NE(test::refusal(json).find("heat/friction/slave"), std::string::npos);
}

} // namespace
} // namespace host::step_time_test
