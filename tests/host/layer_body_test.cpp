// SPDX-License-Identifier: BSD-3-Clause
// A body with surface nodes only: its transform and stiffness against dense sums, and scenes against boundary
// elements.
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include <gtest/gtest.h>

#include "elastic_layer.hpp"
#include "layer_body.hpp"
#include "support.hpp"

namespace host::layer_body_test {
namespace {

constexpr double pi = std::numbers::pi;

Eigen::ArrayXXd random_field(test::Random& random, Eigen::Index rows, Eigen::Index columns) {
  Eigen::ArrayXXd field(rows, columns);
  for (double& value : field.reshaped()) value = random.uniform(-1, 1);
  return field;
}

TEST(WaveTransform, FiltersAsTheSumOverAllModesDoes) {
  test::Random random(3);
  for (const Grid grid : {Grid::nodes, Grid::cells})
    for (const auto& [nx, ny] : {std::pair(1, 1), std::pair(2, 5), std::pair(8, 8), std::pair(15, 6),
                                 std::pair(31, 33), std::pair(131, 150)}) {
      const WaveTransform transform(grid, nx, ny);
      const Eigen::MatrixXd x = cosines(grid, nx), y = cosines(grid, ny);
      const double of_side = grid == Grid::nodes ? 2 : 1; // weights of a row on the side
      const Eigen::VectorXd wx = transform.weights().matrix().col(0) * of_side;
      const Eigen::MatrixXd orthogonal = x.transpose() * wx.asDiagonal() * x;
      EXPECT_LT((orthogonal - Eigen::MatrixXd::Identity(x.cols(), x.cols())).lpNorm<Eigen::Infinity>(),
                1e-13);
      const Eigen::ArrayXXd field = random_field(random, x.rows(), y.rows()),
                            modes = random_field(random, x.cols(), y.cols());
      const Eigen::MatrixXd spectrum = x.transpose() * field.matrix() * y;
      const Eigen::MatrixXd expected = x * (modes * spectrum.array()).matrix() * y.transpose();
      EXPECT_LT((transform.filter(field, modes).matrix() - expected).lpNorm<Eigen::Infinity>(), 1e-12)
          << nx << " " << ny;
    }
}

TEST(WaveTransform, OfPeriodicFields) {
  test::Random random(4);
  constexpr int nx = 12, ny = 9;
  const WaveTransform transform(Grid::periodic, nx, ny);
  const Eigen::ArrayXXd field = random_field(random, nx, ny);
  EXPECT_LT((transform.filter(field, Eigen::ArrayXXd::Ones(nx, ny)) - field).abs().maxCoeff(), 1e-14);
  Eigen::ArrayXXd wave(nx, ny), modes(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      wave(i, j) = std::sin(2 * pi * (5. * i / nx + 2. * j / ny));
      modes(i, j) = 10 * transform.half_waves(i, nx) + transform.half_waves(j, ny);
    }
  EXPECT_LT((transform.filter(wave, modes) - (10 * 10 + 4) * wave).abs().maxCoeff(), 1e-11);
}

std::vector<GridLines> grid(double lx, int nx, double ly, int ny, double thickness) {
  std::vector<GridLines> lines{{0.5}, {-1}, {-thickness, 0}};
  append_graded(lines[0], 0.5 + lx, nx, 1);
  append_graded(lines[1], -1 + ly, ny, 1);
  return lines;
}

TEST(LayerBody, IsTheMatrixOfItsCompliance) {
  test::Random random(5);
  const Material material{Material::Law::linear_elastic, 700, 0.3};
  const LayerBody body(grid(2, 6, 3, 5, 0.8), material);
  ASSERT_EQ(body.nodes(), 7 * 6);
  Eigen::MatrixXd matrix(body.nodes(), body.nodes());
  for (Eigen::Index i = 0; i < body.nodes(); ++i)
    matrix.col(i) = body.force(Eigen::VectorXd::Unit(body.nodes(), i));
  const double scale = matrix.lpNorm<Eigen::Infinity>();
  EXPECT_LT((matrix - matrix.transpose()).lpNorm<Eigen::Infinity>(), 1e-13 * scale);
  EXPECT_LT((matrix.diagonal() - body.diagonal()).lpNorm<Eigen::Infinity>(), 1e-13 * scale);
  const Eigen::VectorXd force = random_field(random, body.nodes(), 1).matrix();
  EXPECT_LT((body.force(body.displacement(force)) - force).lpNorm<Eigen::Infinity>(), 1e-12);
  // A wave of pressure: nodal forces are its values times tributary areas.
  constexpr int mx = 2, my = 3;
  Eigen::VectorXd wave(body.nodes()), forces(body.nodes());
  for (int j = 0; j <= 5; ++j)
    for (int i = 0; i <= 6; ++i) {
      wave[i + 7 * j] = std::cos(pi * mx * i / 6) * std::cos(pi * my * j / 5);
      forces[i + 7 * j] = wave[i + 7 * j] * 2. / 6 * 3. / 5 * (i % 6 == 0 ? 0.5 : 1) * (j % 5 == 0 ? 0.5 : 1);
    }
  const double compliance = layer_compliance(pi * std::hypot(mx / 2., my / 3.), 0.8, material);
  EXPECT_LT((body.displacement(forces) - compliance * wave).lpNorm<Eigen::Infinity>(), 1e-12 * compliance);
}

// All kinds of multipliers: of closed nodes (their equation prescribes the displacement), of open ones, and
// coupled ones.
TEST(LayerSolver, SolvesWhatADenseMatrixDoes) {
  test::Random random(9);
  const auto body = std::make_shared<const LayerBody>(grid(2, 6, 3, 5, 0.8),
                                                      Material{Material::Law::linear_elastic, 700, 0.3});
  const Eigen::Index nodes = body->nodes();
  for (const bool multipliers : {false, true}) {
    const Eigen::Index size = multipliers ? 2 * nodes : nodes;
    Eigen::MatrixXd contact = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index i = 0; i < nodes; ++i) {
      if (i % 4 != 0) contact(i, i) = random.uniform(0, 1000);
      if (!multipliers) continue;
      if (i % 4 < 2) contact(i, nodes + i) = contact(nodes + i, i) = random.uniform(0.5, 1);
      if (i % 4 > 0) contact(nodes + i, nodes + i) = -random.uniform(0.01, 0.1);
    }
    if (!multipliers) contact(3, 2) = contact(2, 3) = 200;
    Eigen::MatrixXd dense = contact;
    for (Eigen::Index i = 0; i < nodes; ++i)
      dense.col(i).head(nodes) += body->force(Eigen::VectorXd::Unit(nodes, i));
    const Eigen::MatrixXd stored =
        multipliers ? contact : Eigen::MatrixXd(contact.triangularView<Eigen::Lower>());
    LayerSolver solver(body);
    ASSERT_TRUE(solver.factorize(stored.sparseView()));
    const Eigen::MatrixXd sides = random_field(random, size, 2).matrix();
    const Eigen::MatrixXd solution = solver.solve(sides), exact = dense.fullPivLu().solve(sides);
    for (const auto& [first, count] :
         {std::pair<Eigen::Index, Eigen::Index>(0, nodes), {nodes, size - nodes}}) {
      if (count == 0) continue;
      const double scale = exact.middleRows(first, count).norm();
      EXPECT_LT((solution - exact).middleRows(first, count).norm(), 1e-4 * scale)
          << multipliers << " " << first;
    }
  }
  Eigen::SparseMatrix<double> negative(nodes, nodes);
  negative.insert(5, 5) = -10 * body->diagonal()[5];
  LayerSolver solver(body);
  EXPECT_FALSE(solver.factorize(negative));
  // A diagonal above zero hides it, and conjugate gradients find it.
  negative.coeffRef(5, 5) = -0.999 * body->diagonal()[5];
  ASSERT_TRUE(solver.factorize(negative));
  const Eigen::MatrixXd side = random_field(random, nodes, 1).matrix();
  EXPECT_FALSE(solver.solve(side).allFinite());
}

/// A double wave, symmetric about the sides, pressed on a layer; the answer is that of boundary elements.
Json scene_of(int divisions, const char* law, double stiffness = 1e5) {
  Json json = test::shipped("rough_afm");
  json.erase("compare"), json["contact"].erase("law");
  Json& part = json["parts"][0];
  part["x"] = test::axis(3, 8, divisions), part["y"] = test::axis(3, 8, divisions);
  const auto wave = [](double amplitude, const Json& vector) -> Json { // crests at 3 and 8
    return {{"type", "sine"}, {"amplitude", amplitude}, {"wave_vector", vector}, {"phase", -0.7 * pi}};
  };
  json["contact"]["model"]["height"] = {{"type", "product"},
                                        {"of", {wave(0.05, {0.2, 0}), wave(1, {0, 0.2})}}};
  json["contact"]["model"]["contact"]["normal"] = {{"type", law}, {"stiffness", stiffness}};
  json["steps"] = {{"control", "approach"}, {"values", {0.02, 0.06}}};
  json["exact"] = {{"type", "boundary_elements"}, {"points", 64}};
  return json;
}

TEST(LayerBody, WithMultipliersIsTheAnswerOfBoundaryElements) {
  for (const StepRecord& record : test::run(scene_of(64, "augmented_multiplier"))) {
    EXPECT_LT(record.penetration, 1e-12);
    EXPECT_NEAR(test::quantity(record, "mean pressure").error, 0, 1e-3);
    EXPECT_NEAR(test::quantity(record, "contact fraction, estimated").error, 0, 0.02);
    EXPECT_NEAR(test::quantity(record, "peak pressure").error, 0, 0.01);
    // cells lie half a spacing beside the nodes, which shows at the border of the contact
    EXPECT_LT(test::quantity(record, "pressure (rms of the difference, relative)").value, 0.08);
    EXPECT_LE(record.iterations(), 12);
  }
}

TEST(LayerBody, AllNormalLawsMeetInTheSameAnswer) {
  const std::vector<StepRecord> hard = test::run(scene_of(24, "augmented_multiplier"));
  const auto difference = [&](const Json& json) {
    double worst = 0;
    const std::vector<StepRecord> records = test::run(json);
    for (std::size_t i = 0; i < records.size(); ++i)
      worst = std::max(worst, std::abs(records[i].force / hard[i].force - 1));
    return worst;
  };
  EXPECT_LT(difference(scene_of(24, "multiplier")), 1e-8);
  EXPECT_LT(difference(scene_of(24, "augmented")), 1e-8);
  Json in_a_word = scene_of(24, "penalty");
  in_a_word["contact"]["law"] = "hard", in_a_word["contact"]["model"].erase("contact");
  EXPECT_LT(difference(in_a_word), 1e-8);
  const double soft = difference(scene_of(24, "penalty", 1e5)),
               stiff = difference(scene_of(24, "penalty", 1e6));
  EXPECT_NEAR(stiff / soft, 0.1, 0.02);
  Json sampled = scene_of(24, "penalty", 1e7);
  sampled["contact"]["sampling"] = 2;
  EXPECT_LT(difference(sampled), 0.05);
}

TEST(LayerBody, ForcesAreGivenAsWellAsMotions) {
  const std::vector<StepRecord> moved = test::run(scene_of(24, "augmented_multiplier"));
  Json json = scene_of(24, "augmented_multiplier");
  json["steps"] = {{"control", "force"}, {"values", {moved[0].force, moved[1].force}}};
  const std::vector<StepRecord> pressed = test::run(json);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(pressed[i].approach / moved[i].approach, 1, 1e-8);
    EXPECT_NEAR(pressed[i].peak_pressure / moved[i].peak_pressure, 1, 1e-8);
  }
}

TEST(LayerBody, WhatDoesNotFitIsRefusedByItsKey) {
  const auto refusal = [](const std::function<void(Json&)>& edit) -> std::string {
    Json json = scene_of(4, "penalty");
    edit(json);
    try {
      const Scene scene = test::scene_from(json);
      Simulation simulation(scene, &test::library());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal([](Json&) {}), "");
  const std::vector<std::pair<const char*, std::function<void(Json&)>>> mistakes{
      {"/parts/0/x", [](Json& j) { j["parts"][0]["x"]["pieces"][0]["growth"] = 1.5; }},
      {"/parts/0/y", [](Json& j) { j["parts"][0]["y"] = test::axis(3, 8, 1); }},
      {"/parts/0/z", [](Json& j) { j["parts"][0]["z"] = test::axis(-2.5, 0, 2); }},
      {"/parts/0/material", [](Json& j) { j["materials"]["block"]["law"] = "neo_hooke"; }},
      {"/supports",
       [](Json& j) {
         j["supports"] = {{{"nodes", "block"}, {"x", 0}}};
       }},
      {"/tractions",
       [](Json& j) {
         j["tractions"] = {{{"faces", "block.z_max"}, {"value", {0, 0, 1}}}};
       }},
      {"/springs",
       [](Json& j) {
         j["springs"] = {{{"faces", "block.z_max"}, {"stiffness", {0, 0, 1}}}};
       }},
      {"/periodic",
       [](Json& j) {
         j["periodic"] = Json::array({Json::array({"block.x_min", "block.x_max"})});
       }},
      {"/contact/master",
       [](Json& j) {
         j["contact"]["master"]["direction"] = {0, 0.1, -1};
       }},
      {"/contact/model/contact/friction",
       [](Json& j) {
         j["contact"]["model"]["contact"]["friction"] = {
             {"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 1e5}};
       }},
      {"/contact/model", [](Json& j) {
         j["contact"]["sampling"] = 2;
         j["contact"]["model"]["contact"]["normal"]["type"] = "multiplier";
       }}};
  for (const auto& [key, edit] : mistakes) {
    const std::string said = refusal(edit);
    EXPECT_NE(said.find(key), std::string::npos) << key << ": " << said;
    EXPECT_NE(said.find("layer"), std::string::npos) << key << ": " << said;
  }
  EXPECT_NE(refusal([](Json& j) {
              j["parts"].push_back(j["parts"][0]), j["parts"][1]["name"] = "b";
            }).find("/parts"),
            std::string::npos);
}

} // namespace
} // namespace host::layer_body_test
