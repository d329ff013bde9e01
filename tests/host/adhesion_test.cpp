// SPDX-License-Identifier: BSD-3-Clause
// Adhesion on an elastic layer without a mesh: a cylinder from the JKR limit to rigid bodies (Maugis), waves (Johnson),
// and the energy that jumps take.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <tuple>

#include <gtest/gtest.h>

#include "sample_count.hpp"
#include "support.hpp"

namespace host::adhesion_test {
namespace {

constexpr double pi = std::numbers::pi;
const double modulus = 1000 / (1 - 0.3 * 0.3); // E*

/// A rigid height over half of a period of a layer: planes of symmetry at both ends, a strip of two rows of cells. It sticks
/// down by h(x), and touches z = 0 at x = 0 where it has moved by 0.
Json scene_of(double length, int cells, double thickness, const Json& height, double top, const Json& law) {
  const double width = 2 * length / cells;
  return {
      {"dimension", 3},
      {"materials", {{"layer", {{"law", "linear_elastic"}, {"young", 1000}, {"poisson", 0.3}}}}},
      {"parts",
       {{{"name", "block"},
         {"material", "layer"},
         {"element", "layer"},
         {"x", test::axis(0, length, cells)},
         {"y", test::axis(0, width, 2)},
         {"z", test::axis(-thickness, 0, 1)}}}},
      {"contact",
       {{"slave", "block.z_max"},
        {"master",
         {{"nodes", {{-4, -4, top}, {-4, 4, top}, {4, 4, top}, {4, -4, top}}}, {"direction", {0, 0, -1}}}},
        {"model",
         {{"segment", "quad4"},
          {"surface_coordinates", {{-4, -4}, {-4, 4}, {4, 4}, {4, -4}}},
          {"height", height},
          {"contact", {{"normal", law}}}}}}},
      {"steps", {{"control", "approach"}}}};
}

std::vector<StepRecord> solved(Json json, const Json& values) {
  json["steps"]["values"] = values;
  return test::run(json);
}

/// The largest tension while the master moves away, from contact at 0 over `near` until it is free: force over all of the
/// period, per length.
double pull_off(const Json& json, double near, double to, double step) {
  const std::vector<StepRecord> records =
      solved(json, {0, near, {{"to", to}, {"count", std::lround((near - to) / step)}}});
  double least = 0;
  for (const StepRecord& record : records) least = std::min(least, record.force);
  EXPECT_LT(std::abs(records.back().force), 0.1 * std::abs(least)) << "does not come off";
  return least / json["parts"][0]["y"]["pieces"][0]["to"].get<double>() * 2;
}

// ---- a cylinder, line contact: R 10, w 0.01 ----

constexpr double radius = 10, work = 0.01;

/// Baney and Hui, J. Appl. Phys. 82 (1997) 519; K. L. Johnson and J. A. Greenwood, J. Phys. D 41 (2008) 155315: half-widths
/// of contact a and of tension m a, tension s: the load at a.
double maugis_load(double a, double s) {
  const auto opening = [&](double m) {
    const double root = std::sqrt(m * m - 1), log = std::log(m + root);
    return a * a / (2 * radius) * (m * root - log) +
           4 * s * a / (pi * modulus) * (root * log - m * std::log(m));
  };
  double low = 1, high = 2;
  while (opening(high) < work / s) high *= 2;
  for (int i = 0; i < 200; ++i) (opening(0.5 * (low + high)) < work / s ? low : high) = 0.5 * (low + high);
  return pi * modulus * a * a / (4 * radius) - 2 * s * a * std::sqrt(low * low - 1);
}
double maugis_pull_off(double s) {
  double least = 0;
  for (int i = 0; i <= 4000; ++i) least = std::min(least, maugis_load(std::pow(10.0, -4 + i / 1000.0), s));
  return least;
}
const double jkr = -3 * std::cbrt(pi * modulus * work * work * radius / 16);

const Json round_height{{"type", "polynomial"}, {"coefficients", {{0.0}, {0.0}, {-0.5 / radius}}}};

Json dugdale(double w, double strength, double least_stiffness) {
  return {{"type", "dugdale"},
          {"work", w},
          {"strength", strength},
          {"stiffness", std::max(least_stiffness, 4 * strength * strength / w)}};
}

double cylinder(const Json& law, int cells, double near, double to, double step) {
  return pull_off(scene_of(2, cells, 4, round_height, 0, law), near, to, step);
}

TEST(Adhesion, CylinderFromJkrToRigidBodies) {
  EXPECT_NEAR(jkr, -1.799357, 1e-6);
  EXPECT_NEAR(maugis_pull_off(64) / jkr, 1, 2e-5);
  for (const auto& [strength, cells, near, to, step] :
       {std::tuple(0.25, 256, -1e-3, -0.06, 1e-3), std::tuple(1.0, 256, -1e-3, -0.015, 2e-4),
        std::tuple(4.0, 512, -2e-3, -0.008, 1e-4), std::tuple(8.0, 512, -3e-3, -0.006, 1e-4),
        std::tuple(16.0, 1024, -3e-3, -0.006, 1e-4)}) {
    if (strength < 4 && ::test::long_divisor() > 1) continue; // minutes: with ENTS_TEST_SAMPLES=all
    const double force = cylinder(dugdale(work, strength, 2e5), cells, near, to, step),
                 exact = maugis_pull_off(strength);
    std::cout << "strength " << strength << ": " << force << ", Maugis " << exact << ", error "
              << force / exact - 1 << ", JKR " << force / jkr - 1 << "\n";
    EXPECT_NEAR(force / exact, 1, 0.01) << strength;
    if (strength > 8) {
      EXPECT_NEAR(force / jkr, 1, 0.01);
    }
  }
  // rigid: all points within the range pull
  EXPECT_NEAR(maugis_pull_off(0.25) / (-2 * std::sqrt(2 * radius * work * 0.25)), 1, 0.01);
}

// Tension that has no end, or a long one: the limit is the same, a stronger law nearer to it.
TEST(Adhesion, CylinderOfTheOtherLaws) {
  const double e = std::numbers::e, strength = 24, stronger = 32;
  for (const Json& law : {Json{{"type", "separation"}, {"work", work}, {"length", work / (e * strength)}},
                          Json{{"type", "lennard_jones"},
                               {"work", work},
                               {"length", 1.0264 * work / stronger},
                               {"range", 0.005}}}) {
    if (law["type"] == "lennard_jones" && ::test::long_divisor() > 1) continue;
    const double force = cylinder(law, 1024, -1e-4, -0.0046, 1e-4);
    std::cout << law["type"] << ": " << force << ", JKR " << force / jkr - 1 << "\n";
    EXPECT_NEAR(force / jkr, 1, 0.01) << law["type"];
  }
}

// ---- a wave: Johnson, Int. J. Solids Struct. 32 (1995) 423 ----

const double amplitude = 5e-4, full = pi * modulus * amplitude; // of a wave of the length 1; p*

Json wave() {
  return {{"type", "sine"}, {"amplitude", amplitude}, {"wave_vector", {1, 0}}, {"phase", pi / 2}};
}
Json wave_law(double alpha, double strength) {
  return dugdale(0.5 * alpha * alpha * pi * pi * modulus * amplitude * amplitude, strength, 2e6);
}

TEST(Adhesion, PullOffOfAWave) {
  const double pull[] = {-0.0219842, -0.0556107, -0.1415920}, alphas[] = {0.1, 0.2, 0.4};
  for (int i = 0; i < 3; ++i) {
    const double alpha = alphas[i];
    const double force = pull_off(scene_of(0.5, 512, 1, wave(), amplitude, wave_law(alpha, 10 * alpha)),
                                  -3e-4 * alpha, -1.5e-3 * alpha, 5e-5 * alpha) /
                         full;
    std::cout << "alpha " << alpha << ": " << force << ", Johnson " << pull[i] << ", error "
              << force / pull[i] - 1 << "\n";
    EXPECT_NEAR(force / pull[i], 1, 0.02) << alpha;
  }
}

/// Of all steps together, and of those in which surfaces jumped.
struct Loop {
  double work = 0, stored = 0, in_jumps = 0, uncertainty = 0, largest_of_others = 0;
  int jumps = 0;
};
Loop loop_of(const std::vector<StepRecord>& records) {
  Loop loop;
  for (const StepRecord& record : records) {
    if (!record.energy()) continue; // the first: the surfaces overlap before it
    const EnergyBalance energy = *record.energy();
    loop.work += energy.work, loop.stored += energy.stored;
    if (energy.jumped)
      loop.in_jumps += energy.lost(), loop.uncertainty += energy.uncertainty, ++loop.jumps;
    else
      loop.largest_of_others = std::max(loop.largest_of_others, std::abs(energy.lost()));
  }
  std::cout << "loop " << loop.work << ", " << loop.jumps << " jumps lost " << loop.in_jumps << " +- "
            << loop.uncertainty << ", other steps at most " << loop.largest_of_others << "\n";
  return loop;
}

// Down and up again: between jumps the work of the master is the change of energy, and what is missing in the loop is
// lost in two steps, jump into contact and out of it.
TEST(Adhesion, OfALoopJumpsTakeTheEnergy) {
  constexpr double low = -4e-4, high = 2e-4;
  const Loop loop = loop_of(solved(scene_of(0.5, 256, 1, wave(), amplitude, wave_law(0.2, 1.2)),
                                   {low, {{"to", high}, {"count", 150}}, {{"to", low}, {"count", 150}}}));
  EXPECT_EQ(loop.jumps, 2);
  EXPECT_NEAR(loop.stored, 0, 1e-9 * loop.work);
  EXPECT_NEAR(loop.work, loop.in_jumps, 0.01 * loop.in_jumps);
  EXPECT_LT(loop.uncertainty, 0.1 * loop.in_jumps);
  EXPECT_LT(loop.largest_of_others, 1e-3 * loop.in_jumps); // of the trapezoidal rule, one step
}

/// The same wave on a block of elements, in the plane; half a wave long.
Json block(const Json& friction) {
  Json contact{{"normal", wave_law(0.4, 1.6)}};
  if (!friction.is_null()) contact["friction"] = friction;
  return {
      {"dimension", 2},
      {"formulation", "plane_strain"},
      {"materials", {{"block", {{"law", "linear_elastic"}, {"young", 1000}, {"poisson", 0.3}}}}},
      {"parts",
       {{{"name", "block"},
         {"material", "block"},
         {"element", "quad4"},
         {"x", test::axis(0, 0.5, 128)},
         {"y", {{"from", -0.5}, {"pieces", {{{"to", 0}, {"divisions", 16}, {"growth", 0.8}}}}}}}}},
      {"supports",
       {{{"nodes", "block.y_min"}, {"x", 0}, {"y", 0}},
        {{"nodes", "block.x_min"}, {"x", 0}},
        {{"nodes", "block.x_max"}, {"x", 0}}}},
      {"contact",
       {{"slave", "block.y_max"},
        {"master", {{"nodes", {{0.75, amplitude}, {-0.75, amplitude}}}, {"direction", {0, -1}}}},
        {"model",
         {{"segment", "line2"},
          {"surface_coordinates", {{0.75}, {-0.75}}},
          {"height", {{"type", "sine"}, {"amplitude", amplitude}, {"wave_vector", {1}}, {"phase", pi / 2}}},
          {"contact", contact}}}}},
      {"steps", {{"control", "approach"}}}};
}

// The direct solvers of meshes, and friction, which has no energy.
TEST(Adhesion, AMeshJumpsWithAndWithoutFriction) {
  const Json values{-1e-3, {{"to", 0}, {"count", 20}}, {{"to", -1e-3}, {"count", 20}}};
  const Loop without = loop_of(solved(block(nullptr), values));
  EXPECT_EQ(without.jumps, 2); // on half as many cells single nodes jump between, which takes 4 %
  EXPECT_NEAR(without.work, without.in_jumps, 0.02 * without.in_jumps);
  const std::vector<StepRecord> records = solved(
      block({{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 2e6}, {"adhesion", true}}), values);
  const Loop with = loop_of(records);
  double dissipated = 0;
  for (const StepRecord& record : records) dissipated += record.energy() ? record.energy()->dissipated : 0;
  std::cout << "friction dissipates " << dissipated << "\n";
  EXPECT_EQ(with.jumps, 2);
  EXPECT_GT(dissipated, 0);
  EXPECT_NEAR(with.work, with.in_jumps + dissipated, 0.02 * with.in_jumps);
}

} // namespace
} // namespace host::adhesion_test
