// SPDX-License-Identifier: BSD-3-Clause
// Wear in whole scenes against closed forms of a sine in full contact and of a flat punch; volumes; tries
// that are thrown away, and restarts. Parameters of a model over the steps.
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "restarts.hpp"

namespace host::wear_test {
namespace {

using std::numbers::pi;

/// A wave of the master in full contact on a layer of depth `depth`.
Json wave(double depth, double share, const char* scheme) {
  Json json = Json::parse(R"({
    "dimension": 2, "formulation": "plane_strain",
    "materials": {"block": {"law": "linear_elastic", "young": 1000, "poisson": 0.3}},
    "parts": [{"name": "block", "material": "block", "element": "quad4",
      "x": {"from": -0.5, "pieces": [{"to": 0.5, "divisions": 96}]}}],
    "periodic": [["block.x_min", "block.x_max"]],
    "supports": [{"nodes": "block.y_min", "x": 0, "y": 0}],
    "contact": {"slave": "block.y_max", "master": {"nodes": [[0.75, 0.0005], [-0.75, 0.0005]], "direction": [0, -1]},
      "model": {"segment": "line2", "surface_coordinates": [[0.75], [-0.75]], "parameters": {"slid": 0},
        "height": {"type": "sine", "amplitude": 0.0005, "wave_vector": [1], "phase": 1.5707963267948966},
        "contact": {"normal": {"type": "penalty", "stiffness": 1e8}, "wear": {"coefficient": 1e-6, "sliding": "slid"}}}},
    "steps": {"control": "mean_pressure", "values": [4, {"to": 4, "count": 20}]}})");
  json["parts"][0]["y"] = {{"from", -depth},
                           {"pieces", {{{"to", 0}, {"divisions", static_cast<int>(96 * depth)}}}}};
  json["contact"]["model"]["contact"]["wear"]["scheme"] = scheme;
  if (share < 1) {
    json["contact"]["model"]["contact"]["wear"]["slave"] = share;
    const Json sine = json["contact"]["model"]["height"];
    const Json field{{"type", "field"},        {"name", "worn"},   {"points", {96}},
                     {"boundary", "periodic"}, {"origin", {-0.5}}, {"size", {1}}};
    json["contact"]["model"]["height"] = {{"type", "sum"}, {"of", {sine, field}}};
  }
  return json;
}

/// Displacement of a bonded layer's surface over a pressure of wave number q (plane strain).
double compliance(double young, double poisson, double q, double depth) {
  const double kappa = 3 - 4 * poisson, t = q * depth, modulus = young / (1 - poisson * poisson);
  const double numerator = kappa * std::sinh(2 * t) - 2 * t;
  const double denominator = kappa * std::cosh(2 * t) + 2 * t * t + (1 + kappa * kappa) / 2;
  return 2 / (modulus * q) * numerator / denominator;
}

/// First Fourier coefficient of what the slave has lost.
double first_wave(const Scene& scene, const StepRecord& record) {
  Simulation simulation(scene, &test::library());
  double sum = 0, area = 0;
  for (std::size_t k = 0; k < record.fields.worn.size(); ++k) {
    const double x = simulation.contact()->slaves().place(k, simulation.mesh())[0];
    sum += 2 * record.fields.worn[k] * std::cos(2 * pi * x) * simulation.contact()->areas()[k];
    area += simulation.contact()->areas()[k];
  }
  return sum / area;
}

// A = A0 exp(-k s / c), c the compliance of the layer at the wave length, and of the penalty.
TEST(Wear, ASineInFullContactDecaysByTheComplianceOfItsLayer) {
  constexpr double amplitude = 5e-5;
  for (const double depth : {1., 0.2}) {
    const double c = compliance(1000, 0.3, 2 * pi, depth) + 1e-8, distance = 0.75 * c / 1e-6;
    if (depth > 0.5) { // that of the half-plane: L / (pi E*)
      EXPECT_NEAR(c, 0.91e-3 / pi + 1e-8, 1e-3 * c);
    }
    // The elements' own error is of second order in their size: two meshes, extrapolated (Richardson).
    std::map<int, std::array<double, 3>> left;
    for (const int cells : {40, 80}) {
      Json json = wave(depth, 1, "trapezoidal");
      // A tenth of height and pressure: the tilt of the normal is an error of the size of pressure / E*.
      json["contact"]["model"]["height"]["amplitude"] = amplitude;
      json["steps"]["values"] = {0.4, {{"to", 0.4}, {"count", 20}}};
      json["parts"][0]["x"]["pieces"][0]["divisions"] = cells;
      json["parts"][0]["y"]["pieces"][0]["divisions"] = static_cast<int>(cells * depth);
      json["history"]["slid"] = {0, {{"to", distance}, {"count", 20}}};
      const Scene scene = test::scene_from(json);
      const std::vector<StepRecord> records = test::run(scene);
      for (const std::size_t i : {0u, 1u, 2u}) {
        const StepRecord& record = records[5u << i];
        EXPECT_EQ(record.contact_fraction, 1) << "no full contact";
        left[cells][i] = amplitude - std::abs(first_wave(scene, record));
      }
    }
    for (const std::size_t i : {0u, 1u, 2u}) {
      const double extrapolated = (4 * left[80][i] - left[40][i]) / 3;
      const double s = distance * static_cast<double>(5u << i) / 20;
      EXPECT_NEAR(extrapolated / (amplitude * std::exp(-1e-6 * s / c)), 1, 1e-3)
          << "depth " << depth << ", slid " << s;
    }
  }
}

// Both sides lose their share of k p ds, the master into its field: the same decay, and exact volumes.
TEST(Wear, BothSidesLoseTheirShares) {
  Json json = wave(0.2, 0.4, "trapezoidal");
  const double c = compliance(1000, 0.3, 2 * pi, 0.2) + 1e-8, distance = 1.5 * c / 1e-6;
  json["history"]["slid"] = {0, {{"to", distance}, {"count", 20}}};
  const Scene scene = test::scene_from(json);
  const std::vector<StepRecord> records = test::run(scene);
  const StepRecord& last = records.back();
  EXPECT_NEAR(last.worn_slave / (last.worn_slave + last.worn_master), 0.4, 1e-12);
  EXPECT_NEAR((last.worn_slave + last.worn_master) / (1e-6 * 4 * distance), 1, 1e-4);
  const double left = 0.0005 - std::abs(first_wave(scene, last)) / 0.4;
  EXPECT_NEAR(left / (0.0005 * std::exp(-1.5)), 1, 3e-3);
  // Gaps are those of the worn surfaces: the penalty's pressure over its stiffness.
  for (std::size_t k = 0; k < last.fields.gap.size(); ++k)
    EXPECT_NEAR(-1e8 * last.fields.gap[k], last.fields.pressure[k], 1e-6) << k;
  EXPECT_LT(last.penetration, 1e-7);
}

// A flat punch: first the root-singular pressure of a rigid punch, in the end the uniform one.
TEST(Wear, AFlatPunchRunsInToUniformPressure) {
  const Json json = Json::parse(R"({
    "dimension": 2, "formulation": "plane_strain",
    "materials": {"block": {"law": "linear_elastic", "young": 1000, "poisson": 0.3}},
    "parts": [{"name": "block", "material": "block", "element": "quad4",
      "x": {"from": 0, "pieces": [{"to": 1.2, "divisions": 120}, {"to": 30, "divisions": 24, "growth": 1.2}]},
      "y": {"from": -30, "pieces": [{"to": -0.2, "divisions": 24, "growth": 0.833333}, {"to": 0, "divisions": 16}]}}],
    "symmetry_copies": 2,
    "supports": [{"nodes": "block.x_min", "x": 0}, {"nodes": "block.y_min", "y": 0}],
    "contact": {"slave": "block.y_max", "master": {"nodes": [[1.005, 0], [-1.005, 0]], "direction": [0, -1]},
      "model": {"segment": "line2", "height": null, "parameters": {"slid": 0},
        "contact": {"normal": {"type": "penalty", "stiffness": 1e7}, "wear": {"coefficient": 1e-6, "sliding": "slid"}}}},
    "steps": {"control": "force", "values": [2, {"to": 2, "count": 30}]},
    "history": {"slid": [0, {"to": 60000, "count": 30}]}})");
  const Scene scene = test::scene_from(json);
  const std::vector<StepRecord> records = test::run(scene);
  Simulation simulation(scene, &test::library());
  for (std::size_t k = 0; k < simulation.contact()->slaves().size(); ++k) {
    const double x = simulation.contact()->slaves().place(k, simulation.mesh())[0];
    if (x < 0.9) {
      EXPECT_NEAR(records.front().fields.pressure[k] * pi * std::sqrt(1 - x * x) / 2, 1, 0.03) << x;
      EXPECT_NEAR(records.back().fields.pressure[k], 1, 0.01) << x;
    }
  }
}

// A coefficient that grows with the pressure: with that of the begin of each increment.
TEST(Wear, TheCoefficientMayFollowThePressure) {
  Json json = wave(0.2, 1, "implicit");
  json["contact"]["model"]["height"] = nullptr; // uniform pressure
  json["contact"]["wear_factor"] = {{1, 0}, {3, 2}};
  json["steps"]["values"] = {2, 4, 2.5, 0.5, 4};
  json["history"]["slid"] = {100, 200, 350, 400, 500};
  const std::vector<StepRecord> records = test::run(json);
  constexpr double pressure[] = {2, 4, 2.5, 0.5, 4}, slid[] = {100, 100, 150, 50, 100},
                   factor[] = {0, 1, 2, 1.5, 0}; // of the pressure before
  double depth = 0;
  for (std::size_t s = 0; s < 5; ++s) {
    depth += 1e-6 * factor[s] * pressure[s] * slid[s];
    EXPECT_NEAR(records[s].worn_slave, depth, 1e-9 * (1e-3 + depth)) << "step " << s + 1;
  }
}

// An annular punch that turns: every radius wears by k p r per radian, so that in the end p r is the same
// everywhere, F / (2 pi (b - a)).
TEST(Wear, AnAnnularPunchRunsInToPressuresOfOneOverTheRadius) {
  const Json json = Json::parse(R"({
    "dimension": 2, "formulation": "axisymmetric",
    "materials": {"block": {"law": "linear_elastic", "young": 1000, "poisson": 0.3}},
    "parts": [{"name": "block", "material": "block", "element": "quad4",
      "x": {"from": 0, "pieces": [{"to": 2, "divisions": 100}, {"to": 10, "divisions": 12, "growth": 1.3}]},
      "y": {"from": -10, "pieces": [{"to": -0.4, "divisions": 14, "growth": 0.75}, {"to": 0, "divisions": 16}]}}],
    "supports": [{"nodes": "block.x_min", "x": 0}, {"nodes": "block.y_min", "y": 0}],
    "contact": {"slave": "block.y_max", "master": {"nodes": [[1.51, 0], [0.51, 0]], "direction": [0, -1]},
      "model": {"segment": "line2", "height": null, "parameters": {"angle": 0},
        "contact": {"normal": {"type": "penalty", "stiffness": 1e7}, "wear": {"coefficient": 1e-6, "sliding": "angle"}}}},
    "steps": {"control": "force", "values": [2, {"to": 2, "count": 30}]},
    "history": {"angle": [0, {"to": 60000, "count": 30}]}})");
  const Scene scene = test::scene_from(json);
  const std::vector<StepRecord> records = test::run(scene);
  Simulation simulation(scene, &test::library());
  int looked_at = 0;
  for (std::size_t k = 0; k < simulation.contact()->slaves().size(); ++k) {
    const double r = simulation.contact()->slaves().place(k, simulation.mesh())[0];
    if (r < 0.59 || r > 1.41) continue;
    ++looked_at;
    EXPECT_NEAR(records.back().fields.pressure[k] * 2 * pi * r * 1.0 / 2, 1, 0.01) << r;
  }
  EXPECT_GT(looked_at, 30);
}

// The limit 4 dx / (pi k E*) over three decades of dx: below it no pressure alternates, above it a warning,
// and they do.
TEST(Wear, ExplicitSchemeIsStableBelowItsLimitAndWarnedAboutAboveIt) {
  for (const double size : {0.01, 0.1, 1., 10.})
    for (const double part : {0.8, 4.}) {
      Json json = wave(0.2, 1, "explicit");
      json["parts"][0]["x"]["pieces"][0]["divisions"] = 64;
      const auto scaled = [&](Json& value) { value = value.get<double>() * size; };
      Json& block = json["parts"][0];
      for (const char* axis : {"x", "y"}) scaled(block[axis]["from"]), scaled(block[axis]["pieces"][0]["to"]);
      for (Json& node : json["contact"]["master"]["nodes"])
        for (Json& x : node) scaled(x);
      Json& model = json["contact"]["model"];
      for (Json& s : model["surface_coordinates"]) scaled(s[0]);
      scaled(model["height"]["amplitude"]);
      model["height"]["wave_vector"][0] = 1 / size;
      model["contact"]["normal"]["stiffness"] = 1e8 / size;
      const double limit = 4 * size / 64 / (pi * 1e-6 * 1000 / 0.91);
      json["steps"]["values"] = {4, {{"to", 4}, {"count", 40}}};
      json["history"]["slid"] = {0, {{"to", 40 * part * limit}, {"count", 40}}};
      const Scene scene = test::scene_from(json);
      Simulation simulation(scene, &test::library());
      int warnings = 0;
      RunObserver observer;
      observer.line = [&](const std::string& line) {
        warnings += line.find("4 dx / (pi k E*)") != std::string::npos;
      };
      const std::vector<StepRecord> records = solve(simulation, observer);
      EXPECT_EQ(warnings, part < 1 ? 0 : 40);
      const std::vector<double>& pressure = records.back().fields.pressure;
      double alternating = 0;
      for (std::size_t k = 1; k + 1 < pressure.size(); ++k)
        alternating = std::max(alternating, std::abs(pressure[k] - (pressure[k - 1] + pressure[k + 1]) / 2));
      if (part < 1) {
        EXPECT_LT(alternating, 0.02) << size;
      } else {
        EXPECT_GT(alternating, 1) << size;
      }
    }
}

// Nothing is lost twice by a try that is thrown away, and a checkpoint has it all: states, field, distance.
TEST(Wear, TriesLeaveNoBitAndRestartsGoOn) {
  for (const char* scheme : {"implicit", "trapezoidal", "explicit"}) {
    Json json = wave(0.2, 0.4, scheme);
    json["parts"][0]["x"]["pieces"][0]["divisions"] = 32;
    json["parts"][0]["y"]["pieces"][0]["divisions"] = 4;
    json["steps"]["values"] = {0.3, 1, 0.2, 2}; // contact opens and closes
    json["history"]["slid"] = {0, 20, 45, 50};
    const Scene scene = test::scene_from(json);
    const StepRecord last = test::expect_no_bit_of_tries(scene, scheme);
    EXPECT_GT(last.worn_slave, 0);
    EXPECT_GT(last.worn_master, 0);
    test::expect_restarts(scene, scheme);
  }
}

// A height that rises by itself, without a load: the force is that of the same master in that place.
TEST(Scenes, AParameterChangesTheHeight) {
  Json json = wave(0.2, 1, "implicit");
  Json& model = json["contact"]["model"];
  model["contact"].erase("wear");
  model["parameters"] = {{"rise", 0}};
  const Json sine = model["height"];
  model["height"] = {{"type", "sum"}, {"of", {sine, {{"type", "constant"}, {"value", "rise"}}}}};
  json["steps"] = {{"control", "approach"}, {"values", {0.0005, 0.0005}}};
  json["history"]["rise"] = {0, 0.0002};
  const auto risen = test::run(json);
  json.erase("history");
  json["steps"]["values"] = {0.0005, 0.0007};
  const auto moved = test::run(json);
  EXPECT_EQ(risen[0].force, moved[0].force);
  EXPECT_NEAR(risen[1].force / moved[1].force, 1, 1e-9);
}

// Waves that give way to the pressure on them: quadratic, more contact and smaller peaks than without.
TEST(Scenes, AHeightThatGivesWayToThePressureConvergesQuadratically) {
  Json json = wave(0.2, 1, "implicit");
  json["parts"][0]["x"]["pieces"][0]["divisions"] = 32;
  json["parts"][0]["y"]["pieces"][0]["divisions"] = 4;
  json["steps"]["values"] = {1, 3, 6, 10};
  json["contact"]["master"]["nodes"] = {{0.75, 0.02}, {-0.75, 0.02}};
  Json& model = json["contact"]["model"];
  Json sine = model["height"];
  sine["amplitude"] = 0.005;
  model["height"] = {{"type", "scale"},
                     {"by", "flat"},
                     {"of", {{"type", "sum"}, {"of", {sine, {{"type", "constant"}, {"value", 0.0065}}}}}}};
  model["parameters"] = {{"flat", 1}};
  model["contact"] = {{"normal", {{"type", "penalty"}, {"stiffness", 1e5}}}};
  const std::vector<StepRecord> hard = test::run(json);
  model["contact"]["flattening"] = {{"scale", "flat"}, {"pressure", 20}, {"least", 0.2}};
  const std::vector<StepRecord> soft = test::run(json);
  for (std::size_t s = 0; s < soft.size(); ++s) {
    EXPECT_LT(soft[s].peak_pressure, 0.8 * hard[s].peak_pressure);
    EXPECT_GT(soft[s].contact_fraction, hard[s].contact_fraction);
    EXPECT_TRUE(quadratic(soft[s].increments.back().residuals, 1e4, 1e-11)) << "step " << s + 1;
  }
}

TEST(Scenes, AHistoryThatDoesNotFitIsRefused) {
  Json json = wave(0.2, 1, "implicit");
  EXPECT_NE(test::refusal(json).find("/history is the distance slid"), std::string::npos)
      << test::refusal(json);
  json["history"]["slid"] = {0, 1};
  EXPECT_NE(test::refusal(json).find("there are 21 steps and 2 values"), std::string::npos)
      << test::refusal(json);
  json["steps"]["values"] = {4, 4};
  json["history"]["slid"] = {2, 1};
  EXPECT_NE(test::refusal(json).find("never falls"), std::string::npos) << test::refusal(json);
  json["history"] = {{"slid", {0, 1}}, {"slide", {0, 1}}};
  EXPECT_NE(test::refusal(json).find("no parameter \"slide\""), std::string::npos) << test::refusal(json);
  json["history"] = {{"slid", {0, 1}}};
  json["exact"] = {{"type", "worn_cylinder"}, {"radius", 20}};
  EXPECT_EQ(test::refusal(json), "");
  json["contact"]["model"]["contact"]["wear"].erase("coefficient");
  EXPECT_NE(test::refusal(json).find("a coefficient that is a number"), std::string::npos)
      << test::refusal(json);
}

} // namespace
} // namespace host::wear_test
