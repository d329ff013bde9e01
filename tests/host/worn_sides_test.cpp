// SPDX-License-Identifier: BSD-3-Clause
// Wear that goes into the heights of both sides: shares of k p s under a uniform pressure, two sines on a layer that
// decay as the composite one does, and tries and restarts.
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>

#include <gtest/gtest.h>

#include "restarts.hpp"

namespace host::worn_sides_test {
namespace {

using std::numbers::pi;

constexpr double share = 0.3, coefficient = 1e-6;

/// A sine and a field over one wavelength.
Json rough(double amplitude, int cells) {
  return {{"type", "sum"},
          {"of",
           {{{"type", "sine"}, {"amplitude", amplitude}, {"wave_vector", {1}}, {"phase", pi / 2}},
            {{"type", "field"},
             {"name", "worn"},
             {"points", {cells}},
             {"boundary", "periodic"},
             {"origin", {-0.5}},
             {"size", {1}}}}}};
}

/// A layer on a rigid master, sines on both, pressed together by a mean pressure of 4.
Json layer(double of_master, double of_slave, int divisions, const char* scheme, double of_wear = share) {
  Json json = Json::parse(R"({
    "dimension": 2, "formulation": "plane_strain",
    "materials": {"block": {"law": "linear_elastic", "young": 1000, "poisson": 0.3}},
    "parts": [{"name": "block", "material": "block", "element": "quad4",
      "x": {"from": -0.5, "pieces": [{"to": 0.5, "divisions": 96}]},
      "y": {"from": -0.2, "pieces": [{"to": 0, "divisions": 19}]}}],
    "periodic": [["block.x_min", "block.x_max"]],
    "supports": [{"nodes": "block.y_min", "x": 0, "y": 0}],
    "contact": {"slave": "block.y_max", "sampling": 2, "slave_height": {"surface_coordinates": ["x"]},
      "master": {"nodes": [[0.75, 0.0005], [-0.75, 0.0005]], "direction": [0, -1]},
      "model": {"segment": "line2", "surface_coordinates": [[0.75], [-0.75]], "parameters": {"slid": 0},
        "contact": {"normal": {"type": "penalty", "stiffness": 1e7}}}},
    "steps": {"control": "mean_pressure"}})");
  json["parts"][0]["x"]["pieces"][0]["divisions"] = divisions;
  json["parts"][0]["y"]["pieces"][0]["divisions"] = divisions / 5;
  Json& contact = json["contact"];
  contact["slave_height"]["height"] = rough(of_slave, divisions);
  contact["model"]["height"] = rough(of_master, divisions);
  contact["model"]["contact"]["wear"] = {
      {"coefficient", coefficient}, {"slave", of_wear}, {"sliding", "slid"}, {"scheme", scheme}};
  return json;
}

// Without waves the pressure is uniform: each side has lost its share of k p s, the heights of the slave's points are
// that much lower, and the master has moved by the whole depth.
TEST(WornSides, LoseTheirSharesOfThePressureTimesTheWay) {
  Json json = layer(0, 0, 20, "implicit");
  json["steps"]["values"] = {4, 4, 2, 4};
  json["history"]["slid"] = {0, 100, 250, 400};
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  const std::vector<StepRecord> records = solve(simulation, {});
  const double depth = coefficient * (4 * 100 + 2 * 150 + 4 * 150);
  const StepRecord& last = records.back();
  EXPECT_NEAR(last.worn_slave, share * depth, 1e-10 * depth);
  EXPECT_NEAR(last.worn_master, (1 - share) * depth, 1e-10 * depth);
  EXPECT_NEAR(last.worn_depth, share * depth, 1e-10 * depth);
  ASSERT_FALSE(simulation.contact()->slaves().heights.empty());
  for (const double height : simulation.contact()->slaves().heights)
    EXPECT_NEAR(height, -share * depth, 1e-10 * depth);
  EXPECT_NEAR(last.approach - records.front().approach, depth, 1e-9 * depth);
  std::cout << "depth of the slave / k p s: " << last.worn_slave / depth
            << ", of the master: " << last.worn_master / depth << "\n";
}

constexpr double amplitude = 0.0005;

/// Compliance of the layer at the wavelength, and of the penalty.
double compliance() {
  const double kappa = 3 - 4 * 0.3, t = 2 * pi * 0.2, modulus = 1000 / (1 - 0.09);
  return 2 / (modulus * 2 * pi) * (kappa * std::sinh(2 * t) - 2 * t) /
             (kappa * std::cosh(2 * t) + 2 * t * t + (1 + kappa * kappa) / 2) +
         1e-7;
}

/// First Fourier coefficients of the heights of slave and master after a slide of 1.5 compliances / k.
std::array<double, 2> waves_left(double of_slave, int divisions, double of_wear) {
  const double c = compliance();
  Json json = layer(amplitude - of_slave, of_slave, divisions, "trapezoidal", of_wear);
  json["steps"]["values"] = {4, {{"to", 4}, {"count", 20}}};
  json["history"]["slid"] = {0, {{"to", 1.5 * c / coefficient}, {"count", 20}}};
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  const std::vector<StepRecord> records = solve(simulation, {});
  const StepRecord& last = records.back();
  EXPECT_EQ(last.contact_fraction, 1) << "no full contact";
  EXPECT_NEAR(last.worn_slave / (last.worn_slave + last.worn_master), of_wear, 1e-12);
  EXPECT_NEAR((last.worn_slave + last.worn_master) / (1.5 * c * 4), 1, 1e-4);
  const SlavePoints& points = simulation.contact()->slaves();
  const EntsModel& model = *simulation.contact()->master().model;
  const std::vector<double>& block = model.fields().at("worn");
  std::array<double, 2> left{0, amplitude - of_slave};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double x = points.place(k, simulation.mesh())[0], wave = 2 * std::cos(2 * pi * x) * points.areas[k];
    double height = 0;
    auto report = ents_struct<ents_report>();
    EXPECT_EQ(model.library().field_sample(model.get(), "worn", block.data(), stride(block.size()), 1, &x,
                                           &height, &report),
              ENTS_OK);
    left[0] += wave * points.heights[k], left[1] += wave * height;
  }
  return left;
}

// Two sines in full contact: the composite one decays as A exp(-k s / c), as that of one side alone does. The fields
// lose waves of length L by a factor 1 - (2 pi h / L)^2 / 3, h their spacing: second order.
TEST(WornSides, TheCompositeSineDecaysByTheComplianceOfTheLayer) {
  const double exact = amplitude * std::exp(-1.5);
  std::array<double, 2> off{};
  for (const int refined : {0, 1}) {
    const int divisions = refined ? 96 : 48;
    const auto [slave, master] = waves_left(0.0003, divisions, share);
    const auto [none, one_side] = waves_left(0, divisions, 0);
    off[refined] = (slave + master) / exact - 1;
    EXPECT_NEAR(none, 0, 1e-12);
    EXPECT_NEAR((slave + master) / one_side, 1, 1e-3);
    EXPECT_NEAR((0.0003 - slave) / (amplitude - slave - master), share, 1e-3); // the part of what is lost
    std::cout << divisions << " cells: amplitudes 0.0003 and 0.0002 have become " << slave << " and "
              << master << ", together " << off[refined] << " off the exact one, "
              << (slave + master) / one_side - 1 << " off that of one side\n";
  }
  EXPECT_LT(std::abs(off[1]), 3e-3);
  EXPECT_LT(std::abs(off[1]), std::abs(off[0]) / 3);
}

// Nothing is lost twice by a try that is thrown away, and a checkpoint has both fields.
TEST(WornSides, TriesLeaveNoBitAndRestartsGoOn) {
  Json json = layer(0.0002, 0.0003, 20, "trapezoidal");
  json["steps"]["values"] = {0.3, 1, 0.2, 2};
  json["history"]["slid"] = {0, 20, 45, 50};
  const Scene scene = test::scene_from(json);
  const StepRecord last = test::expect_no_bit_of_tries(scene, "two sides");
  EXPECT_GT(last.worn_slave, 0);
  EXPECT_GT(last.worn_master, 0);
  const std::vector<std::string> checkpoints = test::expect_restarts(scene, "two sides");
  Json other = Json::parse(checkpoints.back());
  other["contact"].erase("slave_fields"), other["contact"].erase("given_away");
  Simulation again(scene, &test::library());
  EXPECT_THROW(again.restore(other), InputError);
}

} // namespace
} // namespace host::worn_sides_test
