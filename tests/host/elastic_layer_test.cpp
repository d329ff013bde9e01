// SPDX-License-Identifier: BSD-3-Clause
// Boundary elements against closed forms: the layer's compliance, Westergaard, the double sine, Hertz.
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>

#include <gtest/gtest.h>

#include "dof_map.hpp"
#include "elastic_layer.hpp"
#include "exact.hpp"
#include "support.hpp"

namespace host::elastic_layer_test {
namespace {

constexpr double pi = std::numbers::pi;

Material steel(double young, double poisson) { return {Material::Law::linear_elastic, young, poisson}; }

TEST(ElasticLayer, ComplianceOfLongAndShortWaves) {
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Material m = steel(std::pow(10, random.uniform(-3, 6)), random.uniform(-0.9, 0.45));
    const double h = std::pow(10, random.uniform(-3, 3));
    const double uniform = layer_compliance(0, h, m), plane = 2 / m.contact_modulus();
    // Second order in k h; the constant is below 10 / (1 - 2 nu)^2.
    EXPECT_NEAR(layer_compliance(1e-6 / h, h, m) / uniform, 1, 1e-8);
    EXPECT_NEAR(layer_compliance(40 / h, h, m) / (plane * h / 40), 1, 1e-12);
    EXPECT_DOUBLE_EQ(layer_compliance(101 / h, h, m), plane / (101 / h));
  }
}

// The work of a wave of pressure on a layer of finite elements, which share no formula with the compliance.
TEST(ElasticLayer, ComplianceOfFiniteElements) {
  for (const double poisson : {0.0, 0.3, 0.45})
    for (const double thickness : {0.125, 0.25}) {
      constexpr int n = 32; // half a wave of length 1
      const Scene scene = test::scene_from(
          {{"dimension", 2},
           {"formulation", "plane_strain"},
           {"materials", {{"m", {{"law", "linear_elastic"}, {"young", 100}, {"poisson", poisson}}}}},
           {"parts",
            {{{"name", "b"},
              {"material", "m"},
              {"element", "quad4"},
              {"x", test::axis(0, 0.5, n)},
              {"y", test::axis(-thickness, 0, static_cast<int>(2 * n * thickness))}}}},
           {"supports",
            {{{"nodes", "b.x_min"}, {"x", 0}},
             {{"nodes", "b.x_max"}, {"x", 0}},
             {{"nodes", "b.y_min"}, {"x", 0}, {"y", 0}}}},
           {"steps", {{"control", "load_factor"}, {"values", {1}}}}});
      const Simulation simulation(scene, nullptr);
      const Mesh& mesh = simulation.mesh();
      DofMap dofs(mesh.node_count(), 2);
      for (const SupportSpec& support : scene.supports)
        for (const int node : mesh.node_sets.at(support.nodes))
          for (int c = 0; c < 2; ++c)
            if (support.displacement[static_cast<std::size_t>(c)]) dofs.prescribe(node, c);
      dofs.number();
      const auto size = static_cast<std::size_t>(dofs.dofs());
      Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(dofs.size(), dofs.size());
      for (std::size_t column = 0; column < size; ++column) {
        if (dofs.equation(column) < 0) continue;
        std::vector<double> moved(size, 0.0), force(size, 0.0);
        moved[column] = 1;
        simulation.bulk().assemble(moved, {}, force, nullptr);
        for (std::size_t dof = 0; dof < size; ++dof)
          if (dofs.equation(dof) >= 0) stiffness(dofs.equation(dof), dofs.equation(column)) += force[dof];
      }
      Eigen::VectorXd load = Eigen::VectorXd::Zero(dofs.size());
      for (const int node : mesh.node_sets.at("b.y_max")) {
        const double x = mesh.coordinates[static_cast<std::size_t>(node) * 2];
        const double width = x == 0 || x == 0.5 ? 0.25 / n : 0.5 / n;
        load[dofs.equation(node, 1)] = width * std::cos(2 * pi * x);
      }
      const double work = load.dot(stiffness.llt().solve(load)); // amplitude of the displacement / 4
      EXPECT_NEAR(4 * work / layer_compliance(2 * pi, thickness, steel(100, poisson)), 1, 0.02)
          << poisson << " " << thickness;
    }
}

// A wave of one direction on a thick layer: mean pressure and peak of Westergaard's contact.
TEST(ElasticLayer, Westergaard) {
  const Material m = steel(1000, 0.3);
  constexpr double amplitude = 5e-4;
  const ElasticLayer layer(256, 1, 0.5, 1, 40, m);
  const double full = westergaard_full_contact(amplitude, 1, m.contact_modulus());
  for (const double share : {0.1, 0.3, 0.6, 0.9}) {
    // The motion that gives about this mean pressure: uniform compression and the wave's own.
    Eigen::ArrayXXd shape(256, 1);
    for (Eigen::Index i = 0; i < 256; ++i) shape(i, 0) = amplitude * (1 - std::cos(2 * pi * layer.x(i)));
    const LayerContact contact = layer.press(shape - layer_compliance(0, 40, m) * share * full);
    const double mean = contact.mean_pressure, half_width = westergaard_half_width(full, mean, 1);
    EXPECT_GT(mean, 0.3 * share * full);
    EXPECT_NEAR(contact.peak_pressure / (2 * std::sqrt(mean * full)), 1, 1e-3);
    EXPECT_NEAR(contact.fraction_counted, 2 * half_width, 1. / 256);
    for (Eigen::Index i = 0; i < 256; ++i)
      if (layer.x(i) < half_width - 0.02) {
        EXPECT_NEAR(contact.pressure(i, 0) / westergaard_pressure(full, mean, layer.x(i), 1), 1, 0.01);
      }
  }
}

TEST(ElasticLayer, DoubleSineInFullContact) {
  const Material m = steel(1000, 0.3);
  constexpr double amplitude = 2e-3;
  const ElasticLayer layer(32, 32, 0.5, 0.5, 10, m);
  Eigen::ArrayXXd shape(32, 32);
  for (Eigen::Index j = 0; j < 32; ++j)
    for (Eigen::Index i = 0; i < 32; ++i)
      shape(i, j) = -amplitude * std::cos(2 * pi * layer.x(i)) * std::cos(2 * pi * layer.y(j));
  const double full = double_sine_full_contact(amplitude, 1, m.contact_modulus());
  const LayerContact contact = layer.press(shape - 1.5 * full * layer_compliance(0, 10, m));
  EXPECT_EQ(contact.fraction, 1);
  EXPECT_NEAR(contact.mean_pressure / (1.5 * full), 1, 1e-7);
  const double wave = std::pow(std::cos(2 * pi * layer.x(0)), 2);
  EXPECT_NEAR((contact.peak_pressure - contact.mean_pressure) / (full * wave), 1, 1e-6);
}

// A sphere on a layer that is large and thick: Hertz to the share of the contact in the sides.
TEST(ElasticLayer, Hertz) {
  const Material m = steel(1000, 0.3);
  const ElasticLayer layer(256, 256, 2, 2, 2, m);
  Eigen::ArrayXXd shape(256, 256);
  for (Eigen::Index j = 0; j < 256; ++j)
    for (Eigen::Index i = 0; i < 256; ++i)
      shape(i, j) = (std::pow(layer.x(i), 2) + std::pow(layer.y(j), 2)) / 20;
  const LayerContact contact = layer.press(shape - 3e-3);
  const HertzPoint hertz =
      hertz_point_under(4 * 4 * contact.mean_pressure, 10, m.contact_modulus()); // four quarters of 2 x 2
  EXPECT_NEAR(contact.peak_pressure / hertz.peak_pressure, 1, 0.01);
  EXPECT_NEAR(contact.fraction * 16 / (pi * hertz.radius * hertz.radius), 1, 0.01);
}

Json layer_scene(int divisions) {
  Json json = test::shipped("rough_afm", "block");
  json.erase("compare");
  for (const char* axis : {"x", "y"}) json["parts"][0][axis]["pieces"][0]["divisions"] = divisions;
  json["contact"]["model"]["height"] = {{"type", "sine"}, {"amplitude", 0.05}, {"wave_vector", {0.4, 0.2}}};
  json["steps"] = {{"control", "approach"}, {"values", {0.06, 0.2}}};
  json["exact"] = {{"type", "boundary_elements"}, {"points", 48}};
  return json;
}

// Blocks and masters, both ways up, against boundary elements: the mean pressure of a wave converges with the
// mesh.
TEST(ExactLayer, IsWhatTheFiniteElementsConvergeTo) {
  const auto error = [](const Json& json) {
    const Scene scene = test::scene_from(json);
    Simulation simulation(scene, &test::library());
    const std::vector<StepRecord> records = solve(simulation, {});
    double worst = 0;
    for (const StepRecord& record : records) worst = std::max(worst, std::abs(record.exact.at(0).error));
    return worst;
  };
  const double coarse = error(layer_scene(8)), fine = error(layer_scene(24));
  EXPECT_LT(fine, 0.02);
  EXPECT_LT(fine, 0.5 * coarse);

  Json turned = layer_scene(24); // the block above the master
  turned["parts"][0]["z"] = {{"from", 0}, {"pieces", {{{"to", 2.5}, {"divisions", 5}, {"growth", 2}}}}};
  turned["supports"][4]["nodes"] = "block.z_max";
  turned["contact"]["slave"] = "block.z_min";
  turned["contact"]["master"] = {{"nodes", {{0, 0, -0.05}, {10, 0, -0.05}, {10, 10, -0.05}, {0, 10, -0.05}}},
                                 {"direction", {0, 0, 1}}};
  turned["contact"]["model"]["surface_coordinates"] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  EXPECT_NEAR(error(turned), fine, 1e-3);
}

TEST(ExactLayer, ScenesThatAreNotALayerAreRefusedByTheirKey) {
  const auto refusal = [](const char* pointer, const Json& value) -> std::string {
    Json json = layer_scene(4);
    json[Json::json_pointer(pointer)] = value;
    try {
      const Scene scene = test::scene_from(json);
      Simulation simulation(scene, &test::library());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal("/title", "as it is"), "");
  const std::vector<std::pair<const char*, Json>> mistakes{
      {"/materials/block/law", "neo_hooke"},
      {"/supports/0/x", 0.1},
      {"/supports/0", {{"nodes", "block.x_min"}, {"y", 0}}},
      {"/supports/4", {{"nodes", "block.z_min"}, {"z", 0}}},
      {"/contact/slave", "block.z_min"},
      {"/contact/master/nodes/2", {10, 10, 0.06}},
      {"/contact/master/nodes", {{0, 0, 0.05}, {0, 7, 0.05}, {7, 7, 0.05}, {7, 0, 0.05}}},
      {"/tractions", Json::array({{{"faces", "block.z_max"}, {"value", {0, 0, 1}}}})}};
  for (const auto& [pointer, value] : mistakes) {
    const std::string said = refusal(pointer, value), key = std::string(pointer).substr(0, 9);
    EXPECT_NE(said.find(key), std::string::npos) << pointer << ": " << said;
    EXPECT_NE(said.find("boundary_elements"), std::string::npos) << pointer << ": " << said;
  }
}

TEST(ElasticLayer, NoContactHasNoPressure) {
  const ElasticLayer layer(4, 4, 1, 1, 1, steel(1, 0));
  const LayerContact contact = layer.press(Eigen::ArrayXXd::Constant(4, 4, 0.1));
  EXPECT_EQ(contact.mean_pressure, 0);
  EXPECT_EQ(contact.fraction, 0);
}

} // namespace
} // namespace host::elastic_layer_test
