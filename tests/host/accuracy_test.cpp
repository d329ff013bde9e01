// SPDX-License-Identifier: BSD-3-Clause
// Every scene of Part 1 against its exact solution, and Newton's iteration on it.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "program.hpp"

namespace host {
namespace {

using test::relative_error;
using test::run_scene;
using test::value;

/// Newton's iteration is quadratic while no slave node opens or closes: r[n] <= C r[n-1]^2. The residuals are relative to the
/// forces, so C compares the second derivative of the forces with the first over a step that changes them by as much as
/// themselves: of order one for a gently curved master, and times the ratio of its slopes' change to their size for a rough one.
/// Where the iteration stops, rounding is all there is.
void expect_quadratic(const Json& result, double constant) {
  const double tolerance = 1e-10; // the scenes' default: residuals below it are converged, not reduced any further
  for (const Json& step : result.at("steps")) {
    for (const Json& increment : step.at("increments")) {
      const auto residuals = increment.at("residuals").get<std::vector<double>>();
      const auto changes = increment.at("status_changes").get<std::vector<int>>();
      ASSERT_EQ(residuals.size(), changes.size());
      ASSERT_GE(residuals.size(), 2u);
      EXPECT_LE(residuals.back(), tolerance);
      EXPECT_EQ(changes.back(), 0) << "the last iteration still moves the contact's edge";
      for (std::size_t n = 1; n < residuals.size(); ++n) {
        if (changes[n] > 0) continue;
        EXPECT_LE(residuals[n], std::max(constant * residuals[n - 1] * residuals[n - 1], tolerance))
            << "step " << step.at("step") << ", iteration " << n;
      }
    }
    const Json& last = step.at("increments").back();
    std::printf("step %2d: last reductions %8.1e %8.1e, %zu iterations\n", step.at("step").get<int>(),
                last.at("last_reductions")[0].is_null() ? NAN : last.at("last_reductions")[0].get<double>(),
                last.at("last_reductions")[1].get<double>(), last.at("residuals").size());
    // The scenes need no cut: each step takes the load at once.
    EXPECT_TRUE(step.at("cuts").empty()) << step.at("cuts");
  }
}

TEST(Accuracy, Hertz2d) {
  const Json result = run_scene("hertz2d");
  const double spacing = 0.005; // of slave nodes in the contact
  ASSERT_EQ(result.at("steps").size(), 5u);
  for (const Json& step : result.at("steps")) {
    EXPECT_LT(std::abs(relative_error(step, "peak pressure")), 0.01);
    const double half_width = test::exact(step, "half-width").at("exact").get<double>();
    EXPECT_NEAR(value(step, "last closed node"), half_width, spacing);
    EXPECT_NEAR(value(step, "half-width"), half_width, spacing);
  }
  EXPECT_EQ(result.at("sizes").at("master_segments"), 1);
  expect_quadratic(result, 1);
}

TEST(Accuracy, Hertz3d) {
  const Json result = run_scene("hertz3d");
  ASSERT_EQ(result.at("steps").size(), 4u);
  for (const Json& step : result.at("steps")) {
    EXPECT_LT(std::abs(relative_error(step, "force")), 0.02); // at the approach of the step
    // A node spacing of 0.024 on a radius of 0.13 to 0.2: the area of closed nodes is a coarse measure.
    const Json& radius = test::exact(step, "contact radius");
    EXPECT_NEAR(radius.at("value").get<double>(), radius.at("exact").get<double>(), 0.024);
  }
  EXPECT_EQ(result.at("sizes").at("master_segments"), 1);
  expect_quadratic(result, 1);
}

TEST(Accuracy, Westergaard) {
  const Json result = run_scene("westergaard");
  ASSERT_EQ(result.at("steps").size(), 10u);
  for (const Json& step : result.at("steps")) EXPECT_LT(std::abs(relative_error(step, "mean pressure / p*")), 0.01);
  EXPECT_NEAR(value(result.at("steps").back(), "mean pressure / p*"), 1, 1e-6); // up to full contact
  EXPECT_EQ(result.at("sizes").at("master_segments"), 1);
  expect_quadratic(result, 1);
}

TEST(Accuracy, Wavy3d) {
  const Json result = run_scene("wavy3d");
  const Json& last = result.at("steps").back();
  EXPECT_EQ(last.at("contact_fraction"), 1.);
  EXPECT_LT(std::abs(relative_error(last, "full-contact pressure")), 0.02);
  // Two percent below p* some node is open, two percent above none.
  const Json& before = result.at("steps")[result.at("steps").size() - 2];
  EXPECT_NEAR(value(before, "mean pressure / p*"), 0.98, 1e-6);
  EXPECT_NEAR(value(last, "mean pressure / p*"), 1.02, 1e-6);
  EXPECT_LT(before.at("contact_fraction"), 1.);
  EXPECT_EQ(result.at("sizes").at("master_segments"), 1);
  expect_quadratic(result, 1);
}

TEST(Accuracy, RoughAfm) {
  const Json result = run_scene("rough_afm");
  ASSERT_EQ(result.at("steps").size(), 6u);
  double force = 0, fraction = 0, gap = INFINITY;
  std::printf("mean pressure [MPa]  contact [%%]  mean gap [um]\n");
  for (const Json& step : result.at("steps")) { // more load: more contact, less gap
    std::printf("%19.2f %12.1f %14.5f\n", step.at("mean_pressure").get<double>(),
                100 * step.at("contact_fraction").get<double>(), step.at("mean_gap").get<double>());
    EXPECT_GT(step.at("force").get<double>(), force);
    EXPECT_GT(step.at("contact_fraction").get<double>(), fraction);
    EXPECT_LT(step.at("mean_gap").get<double>(), gap);
    force = step.at("force").get<double>();
    fraction = step.at("contact_fraction").get<double>();
    gap = step.at("mean_gap").get<double>();
  }
  EXPECT_GT(fraction, 0.3); // the last step presses spots together, not a few tips
  EXPECT_EQ(result.at("sizes").at("master_segments"), 1);
  expect_quadratic(result, 100);
}

} // namespace
} // namespace host
