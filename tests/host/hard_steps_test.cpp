// SPDX-License-Identifier: BSD-3-Clause
// Steps that used to fail, or failed with the wrong reason: multipliers that nothing presses yet, slave
// points without a projection, bodies that nothing holds.
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "advice.hpp"
#include "holding.hpp"
#include "spectrum.hpp"
#include "support.hpp"

namespace host::hard_steps_test {
namespace {

/// A shipped scene with `divisions` cells in every piece of its axes, pressed by approach from a gap.
Json approached(const std::string& name, int divisions, double gap, double depth) {
  Json json = test::shipped(name, name == "rough_afm" ? "block" : "");
  for (const char* key : {"compare", "exact"}) json.erase(key);
  for (const char* axis : {"x", "y", "z"})
    if (json["parts"][0].contains(axis))
      for (Json& piece : json["parts"][0][axis]["pieces"]) piece["divisions"] = divisions;
  for (Json& node : json["contact"]["master"]["nodes"]) node.back() = node.back().get<double>() + gap;
  json["steps"] = {{"control", "approach"}, {"values", {gap + depth}}};
  Json& height = json["contact"]["model"]["height"];
  if (height.contains("file"))
    height["file"] = (test::scene_file(name).parent_path() / height["file"].get<std::string>()).string();
  return json;
}

double force_of(Json json, const std::string& law, double stiffness) {
  if (law == "hard") {
    json["contact"]["law"] = law, json["contact"]["model"].erase("contact");
  } else {
    json["contact"]["model"]["contact"]["normal"] = {{"type", law}, {"stiffness", stiffness}};
  }
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  const std::vector<StepRecord> records = solve(simulation, {});
  EXPECT_TRUE(records.back().cuts.empty()) << law << ": " << records.back().cuts.front();
  for (const double residual : records.back().increments.back().residuals)
    EXPECT_TRUE(std::isfinite(residual));
  return records.back().force;
}

// In one step from any gap: no multiplier presses when the surfaces first overlap.
TEST(HardSteps, MultipliersFromNoContactByApproach) {
  test::Random random(1);
  struct Case {
    const char* scene;
    int divisions;
    double depth, stiffness;
  };
  for (const Case& each :
       {Case{"hertz2d", 8, 1e-3, 1e5}, Case{"wavy3d", 6, 2e-3, 1e5}, Case{"rough_afm", 10, 0.03, 1e5}})
    for (int i = 0; i < 4; ++i) {
      const Json json = approached(each.scene, each.divisions, each.depth * random.uniform(0, 3),
                                   each.depth * random.uniform(0.7, 1.5));
      const double force = force_of(json, "multiplier", each.stiffness);
      EXPECT_GT(force, 0) << each.scene;
      EXPECT_NEAR(force_of(json, "augmented_multiplier", each.stiffness) / force, 1, 1e-8) << each.scene;
      EXPECT_NEAR(force_of(json, "hard", 0) / force, 1, 1e-8) << each.scene;
    }
}

/// A flat line3 in the plane y = 0.05; `middle` is where its middle node lies, `reach` how far its ends.
Json on_line3(double middle, double reach) {
  Json json = approached("hertz2d", 6, 0, 0.001);
  json["parts"][0]["y"]["pieces"][1]["divisions"] = 2;
  json["contact"]["master"]["nodes"] = {{reach, 0.05}, {-reach, 0.05}, {middle, 0.05}};
  json["contact"]["model"] = {{"segment", "line3"},
                              {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 1e5}}}}}};
  json["steps"]["values"] = {0.051};
  return json;
}

// The segment's extension folds beyond its ends, where some slave nodes lie. They are open; the flat punch is
// the same.
TEST(HardSteps, SlavesWithoutAProjectionBesideTheSegmentAreOpen) {
  test::Random random(2);
  const auto force = [](const Json& json) {
    const Scene scene = test::scene_from(json);
    Simulation simulation(scene, &test::library());
    const std::vector<StepRecord> records = solve(simulation, {});
    EXPECT_TRUE(records.back().cuts.empty()) << records.back().cuts.front();
    return records.back().force;
  };
  const double straight = force(on_line3(0, 1));
  for (int i = 0; i < 20; ++i)
    EXPECT_NEAR(force(on_line3(random.uniform(-0.45, 0.45), 1)) / straight, 1, 1e-9);
  // The same with friction and multipliers: their states and unknowns stay those of open nodes.
  Json json = on_line3(0.4, 1);
  for (const char* law : {"multiplier", "augmented"}) {
    json["contact"]["model"]["contact"] = {
        {"normal", {{"type", law}, {"stiffness", 1e5}}},
        {"friction", {{"type", "coulomb"}, {"coefficient", 0.1}, {"stiffness", 1e4}}}};
    json["solver"] = {{"gap_tolerance", 1e-7}};
    EXPECT_GT(force(json), straight) << law; // no penetration
  }
}

// A segment of no length is a mistake, however far away the slave nodes are.
TEST(HardSteps, ADegenerateSegmentStillFails) {
  Json json = on_line3(0.9, 1);
  for (Json& node : json["contact"]["master"]["nodes"]) node = {-20, 0.05};
  const Scene scene = test::scene_from(json);
  EXPECT_THROW(
      {
        Simulation simulation(scene, &test::library());
        solve(simulation, {});
      },
      JobError);
}

// A body that is only carried along has no forces but rounding: the residual cannot fall below a part of
// them.
TEST(HardSteps, ABodyWithoutStressIsInEquilibrium) {
  test::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const double size = std::pow(10, random.uniform(-3, 3)), young = std::pow(10, random.uniform(-3, 6)),
                 x = size * random.uniform(-10, 10), y = size * random.uniform(-10, 10);
    const char* laws[] = {"linear_elastic", "st_venant_kirchhoff", "neo_hooke"};
    const Json json{
        {"dimension", 2},
        {"formulation", "plane_strain"},
        {"materials", {{"m", {{"law", laws[i % 3]}, {"young", young}, {"poisson", 0.3}}}}},
        {"parts",
         {{{"name", "b"},
           {"material", "m"},
           {"element", i % 2 == 0 ? "tri3" : "quad4"},
           {"x", test::axis(x, x + size * random.uniform(0.5, 2), 6)},
           {"y", test::axis(y, y + size * random.uniform(0.5, 2), 5)}}}},
        {"supports",
         {{{"nodes", "b.y_max"}, {"x", size * random.uniform(-1, 1)}, {"y", size * random.uniform(-1, 1)}}}},
        {"steps", {{"control", "load_factor"}, {"values", {0.2, 0.4, 1}}}}};
    const Scene scene = test::scene_from(json);
    Simulation simulation(scene, nullptr);
    std::vector<StepRecord> records;
    ASSERT_NO_THROW(records = solve(simulation, {})) << json.dump();
    for (const StepRecord& record : records) {
      EXPECT_TRUE(record.cuts.empty()) << json.dump();
      EXPECT_LE(record.iterations(), 3) << json.dump();
    }
  }
}

TEST(HardSteps, ABodyThatNothingHoldsYetIsTold) {
  test::Random random(3);
  for (int i = 0; i < 10; ++i) {
    Json json = approached("hertz2d", 6, random.uniform(1e-4, 1), 0);
    json["supports"] = {{{"nodes", "block.x_min"}, {"x", 0}}};
    json["tractions"] = {{{"faces", "block.y_min"}, {"value", {0, random.uniform(1e-3, 10)}}}};
    json["steps"] = {{"control", "load_factor"}, {"values", {random.uniform(0.1, 10)}}};
    const Scene scene = test::scene_from(json);
    Simulation simulation(scene, &test::library());
    try {
      solve(simulation, {});
      ADD_FAILURE() << "solved";
    } catch (const JobError& error) {
      const std::string said = error.what();
      EXPECT_NE(said.find("step 1 cannot be solved: nothing holds the bodies: part block can move along y, "
                          "and no slave node is in "
                          "contact yet; give it supports or springs"),
                std::string::npos)
          << said;
      EXPECT_EQ(said.find("stiffness"), std::string::npos) << said;
    }
  }
}

// Against the rank of the stiffness: what nothing holds has a motion without forces.
TEST(HardSteps, WhatCanMoveIsWhatHasNoStiffness) {
  test::Random random(4);
  int free = 0;
  for (int i = 0; i < 60; ++i) {
    const bool solid = i % 3 == 0;
    Json json{{"dimension", solid ? 3 : 2},
              {"materials", {{"m", {{"law", "linear_elastic"}, {"young", 1}, {"poisson", 0.3}}}}}};
    if (!solid) json["formulation"] = i % 3 == 1 ? "plane_strain" : "axisymmetric";
    Json part{{"name", "b"},
              {"material", "m"},
              {"element", solid ? "hex8" : "quad4"},
              {"x", test::axis(0, 1, 2)},
              {"y", test::axis(0, 1, 2)}};
    if (solid) part["z"] = test::axis(0, 1, 2);
    json["parts"] = {part};
    json["steps"] = {{"control", "load_factor"}, {"values", {1}}};
    json["supports"] = Json::array();
    const std::vector<std::string> axes =
        solid ? std::vector<std::string>{"x", "y", "z"} : std::vector<std::string>{"x", "y"};
    const auto one_of = [&](const auto& list) {
      return list[static_cast<std::size_t>(random.uniform(0, 0.999) * static_cast<double>(std::size(list)))];
    };
    for (int s = 0; s < 1 + i % 3; ++s)
      json["supports"].push_back(
          {{"nodes", "b." + one_of(axes) + (random.uniform(0, 1) < 0.5 ? "_min" : "_max")},
           {one_of(axes), 0}});
    if (random.uniform(0, 1) < 0.3) json["periodic"] = Json::array({Json::array({"b.x_min", "b.x_max"})});
    const Scene scene = test::scene_from(json);
    Simulation simulation(scene, nullptr);
    const Bulk& bulk = simulation.bulk();
    // Dense stiffness of what is not prescribed, column by column.
    DofMap dofs(simulation.mesh().node_count(), scene.dimension);
    if (json.contains("periodic")) {
      const auto &first = simulation.mesh().node_sets.at("b.x_min"),
                 &second = simulation.mesh().node_sets.at("b.x_max");
      for (std::size_t n = 0; n < first.size(); ++n)
        dofs.tie(second[n], first[n]); // the same order on both sides
    }
    for (const SupportSpec& support : scene.supports)
      for (const int node : simulation.mesh().node_sets.at(support.nodes))
        for (int c = 0; c < scene.dimension; ++c)
          if (support.displacement[static_cast<std::size_t>(c)]) dofs.prescribe(node, c);
    dofs.number();
    const auto n = static_cast<std::size_t>(dofs.dofs());
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(dofs.size(), dofs.size());
    for (int column = 0; column < dofs.size(); ++column) {
      std::vector<double> moved(n, 0.0), force(n, 0.0);
      for (std::size_t dof = 0; dof < n; ++dof) moved[dof] = dofs.equation(dof) == column ? 1 : 0;
      bulk.assemble(moved, {}, force, nullptr);
      for (std::size_t dof = 0; dof < n; ++dof)
        if (dofs.equation(dof) >= 0) stiffness(dofs.equation(dof), column) += force[dof];
    }
    const double smallest = spectrum_of(stiffness).values[0];
    const std::string said = what_can_move(simulation.mesh(), dofs, {}, scene);
    EXPECT_EQ(said.empty(), smallest > 1e-9) << json.dump() << "\n" << smallest << " " << said;
    free += !said.empty();
  }
  EXPECT_GT(free, 10);
  EXPECT_LT(free, 50);
}

TEST(Advice, NodesThatChangeTheirSegmentsAreNotBlamedOnTheStiffness) {
  const Json model{{"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 1}}}}}};
  const auto advice = [&](const std::vector<double>& residuals, int moves) {
    return advice_if_stuck(
        {residuals, std::vector<int>(residuals.size(), 0), std::vector<int>(residuals.size(), moves)}, model);
  };
  const std::vector<double> still{1, 0.1, 1.2e-8, 3e-9, 5.9e-8, 1.2e-8, 4e-9, 1.2e-8, 1.2e-8, 5.9e-8},
      in_turn{1, .5, .2, .1, .2, .1, .2, .1, .2, .1};
  for (const auto& residuals : {still, in_turn}) {
    const std::string said = advice(residuals, 1);
    EXPECT_EQ(said.rfind("slave nodes change between neighbouring segments", 0), 0u) << said;
    EXPECT_EQ(said.find("stiffness"), std::string::npos) << said;
  }
  EXPECT_NE(advice(still, 0).find("stiffness"), std::string::npos);
}

} // namespace
} // namespace host::hard_steps_test
