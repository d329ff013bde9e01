// SPDX-License-Identifier: BSD-3-Clause
// History is what was accepted and nothing else: promises S2 to S6 (tests/host/README.md) in a run of the
// host.
#include <filesystem>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "program.hpp"
#include "restarts.hpp"
#include "sliding.hpp"

namespace host::history_test {
namespace {

using test::coulomb;
using test::penalty;
using test::sliding;
using Cut = StepPlan::Cut;

struct Method {
  std::string name;
  Json normal;
  std::string segment;
};
std::ostream& operator<<(std::ostream& stream, const Method& method) { return stream << method.name; }

/// Pressed, dragged over two segments and half of the way back: sticks, slips, sticks, slips, changes
/// segments.
Json scene(const Method& method) {
  Json json = sliding(method.normal, coulomb, method.segment);
  json["supports"][2]["path"] = {{1, 0}, {2, 1}, {2.5, 0.5}};
  json["steps"]["values"] = {0.5, 1, 1.3, 1.7, 2, 2.2, 2.5};
  return json;
}

struct End {
  std::string fingerprint;
  std::size_t increments = 0;
};

End end_of(const Json& json, const StepPlan& plan) {
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  End end;
  for (const StepRecord& record : solve(simulation, {}, plan)) end.increments += record.increments.size();
  end.fingerprint = simulation.fingerprint();
  return end;
}

class History : public testing::TestWithParam<Method> {};

TEST_P(History, StepsTriedAndThrownAwayLeaveNoBit) {
  const Json json = scene(GetParam());
  const End uncut = end_of(json, {}), halves = end_of(json, {Cut::halves}),
            cut = end_of(json, {Cut::halves, 1, true});
  EXPECT_EQ(halves.fingerprint, cut.fingerprint);
  EXPECT_EQ(halves.increments, cut.increments);
  EXPECT_GE(halves.increments, 2 * 7u);
  EXPECT_NE(halves.fingerprint, uncut.fingerprint); // the fingerprint does see how a run was stepped
  EXPECT_EQ(uncut.fingerprint, end_of(json, {Cut::none, 1, true}).fingerprint);
}

TEST_P(History, RandomCutsLeaveNoBit) {
  const Json json = scene(GetParam());
  const unsigned seeds = GetParam().name == "penalty" ? 20 : 2;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const End plain = end_of(json, {Cut::random, seed}), cut = end_of(json, {Cut::random, seed, true});
    EXPECT_EQ(plain.fingerprint, cut.fingerprint) << "seed " << seed;
    EXPECT_EQ(plain.increments, cut.increments) << "seed " << seed;
  }
}

TEST_P(History, RestartGoesOnWithTheSameBits) {
  test::expect_restarts(test::scene_from(scene(GetParam())), GetParam().name);
}

// Tried with too few iterations, then with a library that refuses deep penetrations: the increment fails,
// says how to go on, and the next one starts as if it had not been tried.
TEST_P(History, AFailedIncrementChangesNothing) {
  Json json = scene(GetParam());
  const End smooth = end_of(json, {});
  Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  StepPlan first, rest;
  first.last = 3;
  solve(simulation, {}, first);
  const std::string before = simulation.fingerprint();
  const int iterations = scene.solver.max_iterations;
  scene.solver.max_iterations = 1; // the simulation sees its scene change
  const NewtonOutcome outcome = simulation.advance({1.7, 1.7});
  scene.solver.max_iterations = iterations;
  EXPECT_FALSE(outcome.converged);
  EXPECT_GT(outcome.step_factor, 0);
  EXPECT_LT(outcome.step_factor, 1);
  EXPECT_EQ(simulation.fingerprint(), before);
  rest.first = 4;
  solve(simulation, {}, rest);
  EXPECT_EQ(simulation.fingerprint(), smooth.fingerprint);

  json["contact"]["model"]["penetration_limit"] = 1e-5;
  json["contact"]["model"]["contact"]["normal"] = penalty; // 1e-2 of approach, 2e-5 at least of penetration
  const Scene shallow = test::scene_from(json);
  Simulation refusing(shallow, &test::library());
  const std::string untouched = refusing.fingerprint();
  const NewtonOutcome refused = refusing.advance({1, 1});
  EXPECT_FALSE(refused.converged);
  EXPECT_NE(refused.reason.find("penetration_limit"), std::string::npos) << refused.reason;
  EXPECT_GT(refused.step_factor, 0);
  EXPECT_LT(refused.step_factor, 1);
  EXPECT_EQ(refusing.fingerprint(), untouched);
}

/// Scenes whose first guess of an increment takes the factors that the last one left, and two that make their
/// own; small meshes.
std::map<std::string, Json> scenes_to_restart() {
  std::map<std::string, Json> scenes;
  Json plane = test::shipped("hertz2d");
  plane.erase("compare"), plane.erase("variants");
  plane["parts"][0]["x"] = {{"from", 0},
                            {"pieces", {{{"to", 0.3}, {"divisions", 10}}, {{"to", 2}, {"divisions", 6}}}}};
  plane["parts"][0]["y"] = test::axis(-2, 0, 12);
  scenes["plane"] = plane;
  for (const char* law : {"multiplier", "augmented"}) { // not for Cholesky; with history
    scenes[law] = plane;
    scenes[law]["contact"]["model"]["contact"]["normal"] = {{"type", law}, {"stiffness", 1e5}};
  }
  Json space = test::shipped("hertz3d");
  space.erase("compare");
  for (const char* axis : {"x", "y"}) space["parts"][0][axis] = test::axis(0, 0.8, 6);
  space["parts"][0]["z"] = test::axis(-0.8, 0, 4);
  scenes["space"] = space;
  Json layer = test::shipped("rough_afm");
  for (const char* key : {"compare", "variants", "exact"}) layer.erase(key);
  layer["contact"].erase("law");
  layer["contact"]["model"]["contact"] = {{"normal", {{"type", "penalty"}, {"stiffness", 1e5}}}};
  layer["parts"][0]["x"] = layer["parts"][0]["y"] = test::axis(3, 8, 12);
  layer["contact"]["model"]["height"] = {{"type", "sine"}, {"amplitude", 0.05}, {"wave_vector", {0.2, 0}}};
  layer["steps"] = {{"control", "approach"}, {"values", {0.02, 0.04, 0.06}}};
  scenes["layer"] = layer;
  scenes["friction"] = test::shipped("slope");
  for (const bool extrapolate : {true, false}) {
    Json& bodies = scenes[extrapolate ? "bodies_extrapolated" : "bodies"];
    bodies = sliding(penalty, nullptr);
    bodies["materials"]["m"]["law"] = "neo_hooke";
    bodies["solver"]["extrapolate"] = extrapolate;
    bodies["steps"]["values"] = {0.5, 1, 1.3, 1.35};
  }
  Json turns = plane; // a rigid body that turns
  turns.erase("exact"), turns.erase("symmetry_copies");
  turns["parts"][0]["x"] = test::axis(-0.5, 0.5, 16);
  turns["supports"] = {{{"nodes", "block.y_min"}, {"x", 0}, {"y", 0}}};
  turns["contact"]["master"] = Json::parse(R"({"rigid_body": {
    "nodes": [[1, 0.05], [-1, 0.05]], "segments": [[0, 1]], "reference": [0, 1],
    "prescribed": [{"x": 0}, {"y": -0.003}, {"turn": 0.02}]}})");
  turns["contact"]["model"]["contact"]["normal"]["stiffness"] = 1e5;
  turns["steps"] = {{"control", "load_factor"}, {"values", {0.3, 0.6, 1}}};
  scenes["turning"] = turns;
  for (const bool friction : {true, false}) { // what a slave point had below it before it slid
    Json& profile = scenes[friction ? "gap_only_friction" : "gap_only"];
    profile = sliding(penalty, friction ? coulomb : Json());
    profile["contact"]["enrichment"] = "gap_only";
    profile["contact"]["model"]["height"] = {{"type", "sine"}, {"amplitude", 0.003}, {"wave_vector", {2}}};
    profile["steps"]["values"] = {0.5, 1, 1.3, 1.35};
  }
  return scenes;
}

// With or without history: the run that goes on is the run that goes through, whatever the solver still held.
TEST(Restart, OfAnySceneGoesOnWithTheSameBits) {
  for (const auto& [name, json] : scenes_to_restart()) {
    const Scene scene = test::scene_from(json);
    const std::size_t steps = scene.steps.size();
    ASSERT_GE(steps, 3u) << name;
    const std::vector<std::string> checkpoints = test::expect_restarts(scene, name, {1, steps - 1});
    const Json last = Json::parse(checkpoints.back());
    if (!last.at("factors").is_null()) { // as distances from the rest, which are short
      const std::size_t factors = last.at("factors").dump().size();
      EXPECT_LT(factors, (checkpoints.back().size() - factors) * 3 / 4) << name;
    }
  }
}

// A checkpoint that was cut short, is of another scene, or whose state is not of this model: an error that
// names it.
TEST(Restart, DamagedCheckpointsAreRefused) {
  const Json json = scene({"", penalty, "bspline4"});
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  StepPlan pressing;
  pressing.last = 2;
  solve(simulation, {}, pressing);
  const Json good = simulation.checkpoint();
  const auto expect_refused = [&](const Json& checkpoint, const std::string& what) {
    Simulation again(scene, &test::library());
    const std::string before = again.fingerprint();
    EXPECT_THROW(again.restore(checkpoint), InputError) << what;
    EXPECT_EQ(again.fingerprint(), before) << what;
  };
  for (const auto& [key, value] : good.items()) {
    Json damaged = good;
    damaged.erase(key);
    expect_refused(damaged, "without " + key);
    if (!value.is_array() || value.empty()) continue;
    damaged = good;
    damaged[key].erase(damaged[key].size() - 1);
    expect_refused(damaged, key + " too short");
  }
  for (const auto& [key, value] : good.at("contact").items()) {
    Json damaged = good;
    damaged["contact"].erase(key);
    expect_refused(damaged, "without contact/" + key);
    damaged = good;
    damaged["contact"][key].erase(damaged["contact"][key].size() - 1);
    expect_refused(damaged, "contact/" + key + " too short");
  }
  const std::size_t size = good.at("contact").at("state").size() / good.at("contact").at("segment").size();
  for (std::size_t k = 0; k < good.at("contact").at("segment").size(); ++k) { // every block's tag
    Json damaged = good;
    damaged["contact"]["state"][k * size] = 1.;
    expect_refused(damaged, "tag of block " + std::to_string(k));
  }
}

// The same through files and two processes.
TEST(Restart, ThroughTheProgram) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "ents_restart";
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "scene.json";
  std::ofstream(file) << scene({"", penalty, "bspline4"}).dump();
  const auto run = [&](const std::string& options) {
    return test::ents_host("run \"" + file.string() + "\" --json --no-pictures " + options);
  };
  const std::string out = "--out \"" + folder.string() + "\"";
  const test::ProgramOutput whole = run("");
  ASSERT_EQ(whole.exit_code, 0) << whole.text;
  ASSERT_EQ(run(out + " --last-step 4").exit_code, 0);
  const std::filesystem::path checkpoint = folder / "checkpoint.json";
  const test::ProgramOutput rest = run("--restart \"" + checkpoint.string() + "\"");
  ASSERT_EQ(rest.exit_code, 0) << rest.text;
  EXPECT_EQ(Json::parse(rest.text).at("fingerprint"), Json::parse(whole.text).at("fingerprint"));
  EXPECT_EQ(Json::parse(rest.text).at("steps").size(), 3u);
  // Cut short at many places: exit code 2, and the message names the file.
  std::ifstream stream(checkpoint);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t length = 0; length + 2 < text.size(); length += text.size() / 20) {
    std::ofstream(checkpoint) << text.substr(0, length);
    const test::ProgramOutput refused = run("--restart \"" + checkpoint.string() + "\"");
    EXPECT_EQ(refused.exit_code, 2) << length;
    EXPECT_NE(refused.text.find("checkpoint.json"), std::string::npos) << refused.text;
  }
  std::filesystem::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(
    Method, History,
    testing::Values(Method{"penalty", penalty, "bspline4"}, Method{"penalty_line2", penalty, "line2"},
                    Method{"augmented", {{"type", "augmented"}, {"stiffness", 1e4}}, "bspline4"},
                    Method{"augmented_multiplier",
                           {{"type", "augmented_multiplier"}, {"stiffness", 1e3}},
                           "catmull_rom4"},
                    Method{"multiplier", {{"type", "multiplier"}, {"stiffness", 1e3}}, "bspline4"}),
    [](const auto& method) { return method.param.name; });

} // namespace
} // namespace host::history_test
