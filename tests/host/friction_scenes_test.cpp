// SPDX-License-Identifier: BSD-3-Clause
// The scenes with friction, and every normal method on Hertz's, against what is exact or published.
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "program.hpp"
#include "support.hpp"

namespace host::friction_scenes_test {
namespace {

using test::exact;
using test::relative_error;
using test::run_scene;
using test::value;

constexpr double tolerance = 1e-10; // of the scenes' Newton iteration, relative to the forces present

/// Largest r[n] / r[n-1]^2 of iterations that changed no node's status, as in accuracy_test.cpp; every
/// increment must end with such an iteration.
double quadratic_constant(const Json& result) {
  double constant = 0;
  for (const Json& step : result.at("steps"))
    for (const Json& increment : step.at("increments")) {
      const auto r = increment.at("residuals").get<std::vector<double>>();
      const auto changes = increment.at("status_changes").get<std::vector<int>>();
      EXPECT_EQ(changes.back(), 0) << "step " << step.at("step");
      EXPECT_LE(r.back(), tolerance) << "step " << step.at("step");
      for (std::size_t n = 1; n < r.size(); ++n)
        if (changes[n] == 0 && r[n] > tolerance) constant = std::max(constant, r[n] / (r[n - 1] * r[n - 1]));
    }
  return constant;
}

std::size_t cuts(const Json& result) {
  std::size_t count = 0;
  for (const Json& step : result.at("steps")) count += step.at("cuts").size();
  return count;
}

void expect_cattaneo_mindlin(const Json& result) {
  ASSERT_EQ(result.at("steps").size(), 8u);
  const double spacing = 0.01; // of slave nodes in the contact
  for (const Json& step : result.at("steps")) {
    EXPECT_LT(std::abs(relative_error(step, "peak pressure")), 0.02);
    EXPECT_LT(std::abs(relative_error(step, "half-width")), 0.02);
    if (step.at("value") <= 1.) continue; // pressed only
    std::printf("Q / mu P %.3f: stick half-width %+.2f %%, tangential displacement %+.2f %%\n",
                value(step, "Q / mu P"), 100 * relative_error(step, "stick half-width"),
                100 * relative_error(step, "tangential displacement"));
    EXPECT_LT(std::abs(relative_error(step, "stick half-width")), 0.02);
    EXPECT_LT(std::abs(relative_error(step, "tangential displacement")), 0.02);
    // Nodes know nothing of the fitted edge: it must lie between the last that sticks and the first that
    // slips.
    const double edge = exact(step, "stick half-width").at("exact");
    EXPECT_NEAR(value(step, "last sticking node"), edge, spacing);
    EXPECT_NEAR(value(step, "first slipping node"), edge, spacing);
  }
  EXPECT_GT(value(result.at("steps").back(), "Q / mu P"), 0.6); // most of the contact slips
  EXPECT_EQ(cuts(result), 0u);
  EXPECT_LT(quadratic_constant(result), 10);
}

TEST(FrictionScene, CattaneoMindlin) { expect_cattaneo_mindlin(run_scene("cattaneo_mindlin")); }

// Uzawa's forces are those of its last equilibrium, not one augmentation further: force-displacement would be
// 16 % off. displacement here.
TEST(FrictionScene, CattaneoMindlinAugmented) {
  expect_cattaneo_mindlin(run_scene("cattaneo_mindlin", "--variant augmented"));
}

TEST(FrictionScene, CattaneoMindlinMultiplier) {
  expect_cattaneo_mindlin(run_scene("cattaneo_mindlin", "--variant multiplier"));
}

// The pull is 1e-6 of the threshold below it, then as much above. Below, the block moves by the elastic slip
// mu p / stiffness (1.6 * 0.4 / 1e5 under the edge) and its own strain (0.4 * 4 / 1e6), 8e-6 together. Above,
// weak springs take what friction does not, 1e-6 * 0.4 * area, and the block moves by 4e-4; elastic parts add
// 8e-6 * (1e-3 / 1e5).
TEST(FrictionScene, SlopeThresholdIsExact) {
  const Json result = run_scene("slope");
  const Json &below = result.at("steps")[2], &above = result.at("steps")[3];
  EXPECT_NEAR(value(below, "tan(slope) / mu") - 1, -1e-6, 1e-12);
  EXPECT_NEAR(value(above, "tan(slope) / mu") - 1, 1e-6, 1e-12);
  std::printf("moved %.2e mm below the threshold, %.6e above (exact %.6e)\n", value(below, "moved"),
              value(above, "moved"), exact(above, "moved").at("exact").get<double>());
  EXPECT_LT(value(below, "slipping nodes"), 100);
  EXPECT_LT(value(below, "moved"), 1e-5);
  EXPECT_LT(std::abs(relative_error(below, "friction / mu N") + 1e-6),
            1e-6 + 1e-11); // carries the pull, less than mu N
  EXPECT_EQ(value(above, "slipping nodes"), 100);
  EXPECT_NEAR(value(above, "friction / mu N"), 1, 1e-12);
  // Newton's tolerance 2e-11 of forces of 4 N leaves 2e-11 * 4 / (1e-3 * 4) = 2e-8 mm: 5e-5 of 4e-4.
  EXPECT_LT(std::abs(relative_error(above, "moved")), 5e-5);
  EXPECT_LT(std::abs(relative_error(result.at("steps")[4], "moved")), 5e-5);
}

/// Largest change of the tangential force from one step to the next while all of the punch slides; the steps
/// are a quarter of a segment long.
double largest_jump(const Json& result) {
  double largest = 0;
  const Json& steps = result.at("steps");
  for (std::size_t i = 7; i < steps.size(); ++i) // four steps press, two overcome sticking
    largest = std::max(largest, std::abs(steps[i].at("contact_force")[0].get<double>() /
                                             steps[i - 1].at("contact_force")[0].get<double>() -
                                         1));
  return largest;
}

TEST(FrictionScene, Ironing) {
  const Json result = run_scene("ironing");
  ASSERT_EQ(result.at("steps").size(), 101u);
  const double constant = quadratic_constant(result), jump = largest_jump(result);
  std::printf("bspline4: r[n] <= %.2f r[n-1]^2 in every step, force jumps by %.2f %%\n", constant,
              100 * jump);
  EXPECT_LT(constant, 1);
  EXPECT_LT(jump, 0.02);
  EXPECT_EQ(cuts(result), 0u);
}

TEST(FrictionScene, IroningOverACatmullRomSurface) {
  const Json result = run_scene("ironing", "--variant catmull_rom4 --last-step 40");
  const double constant = quadratic_constant(result), jump = largest_jump(result);
  std::printf("catmull_rom4: r[n] <= %.2f r[n-1]^2 in every step, force jumps by %.2f %%\n", constant,
              100 * jump);
  EXPECT_LT(constant, 1);
  EXPECT_LT(jump, 0.02);
  EXPECT_EQ(cuts(result), 0u);
}

// What the smoothing is for: over plain segments the force jumps by more.
TEST(FrictionScene, IroningOverPlainSegments) {
  const Json result = run_scene("ironing", "--variant line2");
  const Json smooth = run_scene("ironing", "--last-step 14");
  EXPECT_EQ(result.at("steps").size(), 101u);
  EXPECT_EQ(cuts(result), 0u);
  std::printf("line2: force jumps by %.2f %%, %zu cuts\n", 100 * largest_jump(result), cuts(result));
  EXPECT_GT(largest_jump(result), 5 * largest_jump(smooth));
}

// An elastic nut on a rigid bolt: the ridges at its ends carry more than those between, most of all the one
// at the bearing; all together carry the load, on the loaded flanks alone; and 512 plain segments, 73 to a
// pitch, give the same motion.
TEST(FrictionScene, ThreadSharesItsLoad) {
  const Json result = run_scene("thread", "--nodes");
  const Json &last = result.at("steps").back(), &nodes = last.at("nodes");
  constexpr double pitch = 1.5;
  double share[5] = {};
  for (std::size_t k = 0; k < nodes.at("gap").size(); ++k) {
    const double y = nodes.at("position")[2 * k + 1], force = nodes.at("force")[2 * k + 1];
    const std::size_t ridge = std::min<std::size_t>(4, static_cast<std::size_t>(std::max(0.0, y) / pitch));
    share[ridge] += force / last.at("force").get<double>();
    if (nodes.at("status")[k] != "open") {
      EXPECT_GT(std::fmod(y, pitch), 0.5 * pitch) << "an unloaded flank carries";
    }
  }
  std::printf("shares of the load, from the bearing on: %.1f %.1f %.1f %.1f %.1f %%\n", 100 * share[0],
              100 * share[1], 100 * share[2], 100 * share[3], 100 * share[4]);
  EXPECT_NEAR(share[0] + share[1] + share[2] + share[3] + share[4], 1, 1e-9);
  EXPECT_GT(share[0], share[4]);
  EXPECT_GT(share[4], share[1]);
  EXPECT_GT(share[1], share[2]);
  EXPECT_EQ(cuts(result), 0u);

  const Json comparison = run_scene("thread", "--compare 512");
  EXPECT_LT(comparison.at("explicit")[0].at("difference").get<double>(), 2e-3);
}

// The third derivatives of a map jump between its cells, and with them the tangent of friction: that costs no
// iteration.
TEST(FrictionScene, FrictionOverACubicMap) {
  const auto run = [](const std::function<void(Json&)>& edit) {
    return test::run(test::shipped_scene("texture", [&](Json& json) { edit(json["contact"]["model"]); }));
  };
  const auto iterations = [](const std::vector<StepRecord>& records) {
    int sum = 0;
    for (const StepRecord& record : records) sum += record.iterations();
    return sum;
  };
  constexpr int samples = 16; // of a wave
  const auto as_map = [&](Json& model) {
    const Json& sine = model.at("height");
    Json map{{"type", "map"},
             {"boundary", "periodic"},
             {"values", Json::array()},
             {"size", {1 / sine.at("wave_vector")[0].get<double>()}}};
    for (int i = 0; i < samples; ++i)
      map["values"].push_back(sine.at("amplitude").get<double>() *
                              std::sin(2 * std::numbers::pi * i / samples));
    model["height"] = map;
  };
  const std::vector<StepRecord> wave = run([](Json&) {}), map = run(as_map);
  const std::vector<StepRecord> map_without = run([&](Json& model) {
    as_map(model);
    model["tangent"] = "first_variation";
  });
  std::printf("iterations: %d over a sine, %d over its map, %d with first variations alone\n",
              iterations(wave), iterations(map), iterations(map_without));
  EXPECT_NEAR(iterations(map), iterations(wave), 0.02 * iterations(wave));
  EXPECT_GT(iterations(map_without), 1.1 * iterations(map));
  EXPECT_NEAR(map.back().force, wave.back().force, 1e-3 * wave.back().force);
}

struct Method {
  const char* variant;
  double penetration; ///< over the size of the slave surface
};

// Penalty and its kin: pressure over stiffness. Augmented: |g| <= 1e-8 of the size. Multipliers: 1e-12.
TEST(FrictionScene, HertzWithEveryNormalMethod) {
  for (const Method& method :
       {Method{"", 1e-5}, Method{"power", 1e-5}, Method{"exponential", 1e-5}, Method{"augmented", 1e-8},
        Method{"augmented_multiplier", 1e-12}, Method{"multiplier", 1e-12}}) {
    const Scene scene = read_scene(test::scene_file("hertz2d"), method.variant);
    Simulation simulation(scene, &test::library());
    const std::vector<StepRecord> records = solve(simulation, {});
    const double penetration = records.back().penetration / simulation.contact()->size();
    std::printf("%-20s |g| / size %.1e", method.variant, penetration);
    EXPECT_LE(penetration, method.penetration) << method.variant;
    for (const char* name : {"peak pressure", "half-width"}) {
      const double error = test::quantity(records.back(), name).error;
      std::printf(", %s %+.2f %%", name, 100 * error);
      EXPECT_LT(std::abs(error), 0.01) << method.variant;
    }
    std::printf("\n");
    for (const StepRecord& record : records)
      EXPECT_TRUE(record.cuts.empty()) << method.variant << " " << record.step;
  }
}

TEST(FrictionScene, PenaltyChattersAndRegularisedLawsDoNot) {
  const auto run = [](const std::string& variant) {
    return test::run(read_scene(test::scene_file("chatter"), variant)).front();
  };
  try {
    run("");
    ADD_FAILURE() << "the plain penalty converges: the scene shows nothing";
  } catch (const JobError& error) { // the same two residuals for ever, however small the step
    std::printf("%s\n", error.what());
    EXPECT_NE(std::string(error.what()).find("no convergence"), std::string::npos) << error.what();
  }
  for (const char* variant : {"exponential_wide", "power"}) {
    const StepRecord record = run(variant);
    std::printf("%s: %d iterations\n", variant, record.iterations());
    EXPECT_TRUE(record.cuts.empty()) << variant;
    // The load of 4 N less what the springs (0.01 * 4 N/mm, moved by 0.01 mm at most) hold.
    EXPECT_NEAR(record.force, 4, 4e-4) << variant;
  }
}

} // namespace
} // namespace host::friction_scenes_test
