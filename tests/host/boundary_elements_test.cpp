// SPDX-License-Identifier: BSD-3-Clause
// Boundary elements on periodic surfaces and half-spaces against closed forms; softness, load control, gaps,
// refinement.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include <gtest/gtest.h>

#include "elastic_layer.hpp"
#include "exact.hpp"
#include "support.hpp"

namespace host::boundary_elements_test {
namespace {

constexpr double pi = std::numbers::pi, half_space = INFINITY;

const Material steel{Material::Law::linear_elastic, 1000, 0.3};

template <class Height> Eigen::ArrayXXd heights(const ElasticLayer& layer, const Height& height) {
  Eigen::ArrayXXd field(layer.cells_x(), layer.cells_y());
  for (Eigen::Index j = 0; j < field.cols(); ++j)
    for (Eigen::Index i = 0; i < field.rows(); ++i) field(i, j) = height(layer.x(i), layer.y(j));
  return field;
}

// A wave on a half-space: pressures, peak, half-width and the gap outside, at the same mean pressure.
TEST(BoundaryElements, Westergaard) {
  constexpr double amplitude = 5e-4;
  constexpr Eigen::Index n = 2048;
  const ElasticLayer layer(n, 1, 1, 1, half_space, steel, Grid::periodic);
  const double full = westergaard_full_contact(amplitude, 1, steel.contact_modulus());
  const Eigen::ArrayXXd shape =
      heights(layer, [](double x, double) { return amplitude * (1 - std::cos(2 * pi * x)); });
  for (const double share : {0.1, 0.5, 0.9}) {
    const double mean = share * full, half_width = westergaard_half_width(full, mean, 1);
    const LayerContact contact = layer.press_with(mean, shape);
    EXPECT_NEAR(contact.mean_pressure / mean, 1, 1e-12);
    EXPECT_NEAR(contact.peak_pressure / (2 * std::sqrt(mean * full)), 1, 1e-3);
    EXPECT_NEAR(contact.fraction_counted, 2 * half_width, 2. / n);
    double squared = 0, exact_squared = 0, gap_off = 0, mean_gap = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double x = std::min(layer.x(i), 1 - layer.x(i)), exact = westergaard_pressure(full, mean, x, 1);
      squared += std::pow(contact.pressure(i, 0) - exact, 2), exact_squared += exact * exact;
      const double gap = westergaard_gap(amplitude, half_width, x, 1);
      gap_off = std::max(gap_off, std::abs(contact.gap(i, 0) - gap)), mean_gap += gap / n;
    }
    EXPECT_LT(std::sqrt(squared / exact_squared), 1e-3);
    EXPECT_LT(gap_off, 1e-4 * amplitude);
    EXPECT_NEAR(mean_gap, westergaard_mean_gap(amplitude, share), 1e-6 * amplitude);
    // Elastic energy: half the work of the pressure on the displacement, which the half-space knows up to its
    // mean.
    const double energy = 0.5 * (contact.pressure * layer.displacement(contact.pressure)).mean();
    EXPECT_NEAR(energy / (full * amplitude), share * share * (0.25 - 0.5 * std::log(share)), 1e-4);
  }
  const LayerContact pressed = layer.press_with(1.5 * full, shape);
  EXPECT_EQ(pressed.fraction, 1);
  EXPECT_NEAR(pressed.peak_pressure / (2.5 * full), 1, 1e-5); // the middle of a cell is not the crest
}

TEST(BoundaryElements, DoubleSine) {
  constexpr double amplitude = 2e-3;
  const ElasticLayer layer(64, 64, 1, 1, half_space, steel, Grid::periodic);
  const double full = double_sine_full_contact(amplitude, 1, steel.contact_modulus());
  const Eigen::ArrayXXd wave =
      heights(layer, [](double x, double y) { return std::cos(2 * pi * x) * std::cos(2 * pi * y); });
  const LayerContact contact = layer.press_with(1.2 * full, -amplitude * wave);
  EXPECT_LT((contact.pressure - full * (1.2 + wave)).abs().maxCoeff(), 1e-6 * full);
  EXPECT_EQ(contact.fraction, 1);
}

// A sphere over the corner of a quarter of its period; its images change the pressure by the third power of
// the share. The field is off where contact ends: by the inverse of the cells in the radius.
// ENTS_TEST_CELLS=2048 (minutes): 205 in the radius, 0.1 %.
TEST(BoundaryElements, Hertz) {
  const char* text = std::getenv("ENTS_TEST_CELLS");
  const Eigen::Index n = text ? std::atoi(text) : 256;
  constexpr double sphere = 1, share = 0.05;
  const double force = 4. / 3 * share * share * share * steel.contact_modulus() / sphere;
  const HertzPoint hertz = hertz_point_under(force, sphere, steel.contact_modulus());
  ASSERT_NEAR(hertz.radius, share, 1e-12);
  const ElasticLayer layer(n, n, 0.5, 0.5, half_space, steel, Grid::cells);
  const Eigen::ArrayXXd distance = heights(layer, [&](double x, double y) { return std::hypot(x, y); });
  const LayerContact contact = layer.press_with(force, distance.square() / (2 * sphere)); // over the period 1
  const double cells = share / 0.5 * static_cast<double>(n);
  EXPECT_NEAR(contact.peak_pressure / hertz.peak_pressure, 1, 1e-3);
  const Eigen::ArrayXXd exact = (1 - (distance / hertz.radius).square()).max(0.).sqrt() * hertz.peak_pressure;
  const double field = (contact.pressure - exact).matrix().norm() / exact.matrix().norm();
  std::printf("%.0f cells in the radius: field off by %.2e, peak by %.2e\n", cells, field,
              contact.peak_pressure / hertz.peak_pressure - 1);
  EXPECT_LT(field, 0.2 / cells);
  EXPECT_NEAR(contact.fraction_counted / (pi * share * share), 1, 2 / cells); // a row of cells round it
}

// The images of a cylinder change the pressure by the second power of the share.
TEST(BoundaryElements, HertzLine) {
  constexpr double cylinder = 1;
  constexpr Eigen::Index n = 1 << 17; // 1024 cells in the half-width: its ends are half a cell off
  const double share = 1. / 128, force = pi / 4 * share * share * steel.contact_modulus() / cylinder;
  const HertzLine hertz = hertz_line(force, cylinder, steel.contact_modulus());
  ASSERT_NEAR(hertz.half_width, share, 1e-12);
  const ElasticLayer layer(n, 1, 1, 1, half_space, steel, Grid::periodic);
  const Eigen::ArrayXXd distance =
      heights(layer, [&](double x, double) { return std::abs(x - layer.x(n / 2)); });
  const LayerContact contact = layer.press_with(force, distance.square() / (2 * cylinder));
  const Eigen::ArrayXXd exact =
      (1 - (distance / hertz.half_width).square()).max(0.).sqrt() * hertz.peak_pressure;
  EXPECT_NEAR(contact.peak_pressure / hertz.peak_pressure, 1, 1e-3);
  EXPECT_LT((contact.pressure - exact).matrix().norm() / exact.matrix().norm(), 1e-3);
  EXPECT_NEAR(contact.fraction_counted, 2 * hertz.half_width, 4. / n);
}

TEST(BoundaryElements, MirroredSidesAreAQuarterOfThePeriod) {
  const auto height = [](double x, double y) {
    return 1e-3 * (std::cos(2 * pi * x) * std::cos(2 * pi * y) + 0.4 * std::cos(6 * pi * x));
  };
  for (const double thickness : {0.1, 2.}) {
    const ElasticLayer quarter(16, 16, 0.5, 0.5, thickness, steel),
        whole(32, 32, 1, 1, thickness, steel, Grid::periodic);
    const LayerContact one = quarter.press(heights(quarter, height) + 2e-4),
                       four = whole.press(heights(whole, height) + 2e-4);
    EXPECT_GT(one.fraction, 0.05);
    EXPECT_LT(one.fraction, 0.9);
    EXPECT_LT((one.pressure - four.pressure.topLeftCorner(16, 16)).abs().maxCoeff(),
              1e-5 * one.peak_pressure);
    EXPECT_NEAR(one.fraction, four.fraction, 1e-12);
    for (int shift = 1; shift < 32; ++shift) { // borders of contact that lie on the border of the period
      const auto moved = [&](double x, double y) { return height(x + shift / 32., y); };
      EXPECT_NEAR(whole.press(heights(whole, moved) + 2e-4).fraction, four.fraction, 1e-12);
    }
  }
}

TEST(BoundaryElements, LoadsAndMotionsGapsAndSoftness) {
  const ElasticLayer layer(32, 24, 1, 0.75, 0.4, steel, Grid::periodic);
  const Eigen::ArrayXXd gap = heights(layer, [](double x, double y) {
    return 1e-3 *
           (std::cos(2 * pi * x) + std::cos(2 * pi * y / 0.75) + std::sin(2 * pi * (x + 2 * y / 0.75)));
  });
  for (const double softness : {0., 1e-4}) {
    const LayerContact moved = layer.press(gap + 2e-4, softness),
                       loaded = layer.press_with(moved.mean_pressure, gap, softness);
    EXPECT_LT((moved.pressure - loaded.pressure).abs().maxCoeff(), 1e-4 * moved.peak_pressure);
    EXPECT_LT((moved.gap - loaded.gap).abs().maxCoeff(), 1e-7);
    const Eigen::ArrayXXd law =
        moved.gap + softness * moved.pressure; // >= 0, and zero where there is pressure
    EXPECT_GT(law.minCoeff(), -1e-10);
    EXPECT_LT(((moved.pressure > 0).cast<double>() * law).maxCoeff(), 1e-10);
    EXPECT_GT(moved.gap.maxCoeff(), 1e-4);
    EXPECT_LE(moved.iterations, softness > 0 ? 20 : 40);
  }
  const Eigen::ArrayXXd flat = Eigen::ArrayXXd::Constant(32, 24, -1e-3);
  EXPECT_NEAR(layer.press(flat, 2e-5).mean_pressure / (1e-3 / (layer_compliance(0, 0.4, steel) + 2e-5)), 1,
              1e-12);
}

/// A wave of period 5 on the block of rough_afm.
Json scene_of(const char* element, const Json& exact) {
  Json json = test::shipped("rough_afm", "block");
  json.erase("compare");
  const bool layer = std::string(element) == "layer";
  Json& part = json["parts"][0];
  part["element"] = element;
  part["x"] = part["y"] = test::axis(3, 8, layer ? 48 : 20);
  part["z"] = test::axis(-2.5, 0, layer ? 1 : 10);
  if (layer) json.erase("supports");
  json["contact"]["model"]["height"] = {
      {"type", "product"},
      {"of",
       {{{"type", "sine"}, {"amplitude", 0.05}, {"wave_vector", {0.2, 0}}, {"phase", -0.7 * pi}},
        {{"type", "sine"}, {"amplitude", 1}, {"wave_vector", {0, 0.2}}, {"phase", -0.7 * pi}}}}};
  json["steps"] = {{"control", "approach"}, {"values", {0.04}}};
  json["exact"] = exact;
  return json;
}

TEST(BoundaryElements, WithThePenaltyOfTheScene) {
  const Json hard{{"type", "boundary_elements"}, {"points", 64}};
  Json soft = hard;
  soft["stiffness"] = 1e5;
  const StepRecord record = test::last_step(scene_of("layer", soft));
  EXPECT_NEAR(test::quantity(record, "mean pressure").error, 0, 1e-3);
  EXPECT_NEAR(test::quantity(record, "mean gap").error, 0, 2e-3);
  EXPECT_NEAR(test::quantity(record, "peak pressure").error, 0, 5e-3);
  EXPECT_LT(test::quantity(test::last_step(scene_of("layer", hard)), "mean pressure").error, -3e-3);
}

TEST(BoundaryElements, AreRefinedUntilTheyStay) {
  const StepRecord record =
      test::last_step(scene_of("layer", {{"type", "boundary_elements"}, {"points", 8}, {"error", 0.01}}));
  EXPECT_GE(test::quantity(record, "points of the exact solution").value, 32);
  EXPECT_LE(test::quantity(record, "change from half the points").value, 0.01);
  Json rough = scene_of("layer", {{"type", "boundary_elements"}, {"points", 8}, {"error", 1e-12}});
  rough["parts"][0]["x"] = rough["parts"][0]["y"] = test::axis(3, 8, 8);
  for (Json& node : rough["contact"]["master"]["nodes"])
    node[2] = 0.1;                                    // above the surface after the step, too
  EXPECT_EQ(test::last_step(rough).mean_pressure, 0); // no contact: nothing to refine
}

TEST(BoundaryElements, OfABlockWithPeriodicSides) {
  Json json = scene_of("hex8", {{"type", "boundary_elements"}, {"points", 64}});
  json["supports"] = {{{"nodes", "block.z_min"}, {"x", 0}, {"y", 0}, {"z", 0}}};
  json["periodic"] =
      Json::array({Json::array({"block.x_min", "block.x_max"}), Json::array({"block.y_max", "block.y_min"})});
  for (Json& wave : json["contact"]["model"]["height"]["of"])
    wave["phase"] = 0.3; // sides are no planes of symmetry
  EXPECT_NEAR(test::quantity(test::last_step(json), "mean pressure").error, 0, 0.02);
  json["periodic"].erase(1);
  json["supports"].push_back({{"nodes", "block.y_min"}, {"y", 0}});
  json["supports"].push_back({{"nodes", "block.y_max"}, {"y", 0}});
  try {
    test::last_step(json);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/periodic: the exact solution \"boundary_elements\""),
              std::string::npos)
        << error.what();
  }
}

} // namespace
} // namespace host::boundary_elements_test
