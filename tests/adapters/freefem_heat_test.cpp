// SPDX-License-Identifier: BSD-3-Clause
// Heat through the plugin of FreeFEM: two bars, a gas gap, heat of friction, all blocks of the tangent, and what is
// refused.
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "freefem/border_contact.hpp"
#include "heat_problems.hpp"
#include "measured.hpp"
#include "worst.hpp"

namespace freefem::freefem_heat_test {
namespace {

using adapters::Bars;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string with_heat(const std::string& heat, const std::string& segment = "line2", int stiffness = 400) {
  return R"({"segment": ")" + segment + R"(", "contact": {"normal": {"type": "penalty", "stiffness": )" +
         std::to_string(stiffness) + R"(}, "heat": )" + heat + "}}";
}

/// Residual and tangent at u, as the script adds them: dof 3 vertex + component.
void add(BorderContact& contact, const VectorXd& u, double dt, VectorXd& residual, MatrixXd& tangent) {
  contact.require_sizes(u.size(), residual.size());
  const Forces forces = contact.evaluate(u.data(), residual.data(), dt);
  ASSERT_EQ(forces.step_factor, 1) << forces.message;
  for (std::size_t e = 0; e < forces.value.size(); ++e)
    tangent(forces.row[e], forces.column[e]) += forces.value[e];
}
VectorXd residual_of(BorderContact& contact, const VectorXd& u, double dt = 0) {
  VectorXd residual = VectorXd::Zero(u.size());
  MatrixXd tangent = MatrixXd::Zero(u.size(), u.size());
  add(contact, u, dt, residual, tangent);
  return residual;
}

/// The interface of the bars: each slave node has an area of 0.6.
BorderContact between_bars(const std::string& model, double reach) {
  Options options;
  options.thickness = Bars::area, options.reach = reach;
  return {model, {{0, 1}, {-0.5, 0, 0.5, 0}, {1, 0}}, {{2, 3}, {-1, 0, 1, 0}, {0, 1}}, 8, options};
}
void solve(Bars& bars, BorderContact& contact) {
  bars.solve([&](const VectorXd& u, VectorXd& r, MatrixXd& k) { add(contact, u, 0, r, k); });
}
/// Temperatures of the upper ends beside the exact one.
double error_of(const Bars& bars, double conductance) {
  const double exact = Bars::end + Bars::power * bars.resistance(conductance);
  return std::max(std::abs(bars.unknowns(14) / exact - 1), std::abs(bars.unknowns(17) / exact - 1));
}

TEST(FreefemHeat, TwoBarsAreExactInOneIteration) {
  BorderContact contact = between_bars(with_heat(R"({"conductance": 10})"), 0.5);
  Bars bars;
  solve(bars, contact);
  test::expect_measured("two bars through FreeFEM against T_in + q R", error_of(bars, 10), 1e-10);
  EXPECT_EQ(bars.iterations, 1);
}

// h = 4 (p / 2)^0.95, p known from the springs
TEST(FreefemHeat, TwoBarsWithAConductanceOfThePressure) {
  BorderContact contact =
      between_bars(with_heat(R"({"power": {"coefficient": 4, "pressure": 2, "exponent": 0.95}})"), 0.5);
  Bars bars;
  bars.unknowns(1) = bars.unknowns(4) = -0.01; // the power has no slope where p = 0
  solve(bars, contact);
  const double pressure = 0.3 / (1 / 40. + 1 / 240. + 1 / 300.) / 0.6;
  test::expect_measured("the same, a conductance of the pressure",
                        error_of(bars, 4 * std::pow(pressure / 2, 0.95)), 1e-10);
  EXPECT_LE(bars.iterations, 3);
}

/// Two slave nodes at a gap of 0.05 above one segment.
VectorXd apart(double gap) {
  VectorXd u = VectorXd::Zero(24);
  u(1) = u(4) = gap;
  u(2) = 7, u(5) = 9, u(8) = 1, u(11) = 3; // of the master: 1.5 and 2.5 below the slave nodes
  return u;
}

// h = 0.3 / (gap + 0.01) where no pressure is, in every increment, as far as `reach`.
TEST(FreefemHeat, AnOpenGapConducts) {
  const std::string model = with_heat(R"({"gas": {"conductivity": 0.3, "jump": 0.01}})");
  BorderContact contact = between_bars(model, 0.1);
  double worst = 0;
  for (const double gap : {0.05, 0.02, 0.09}) {
    const VectorXd r = residual_of(contact, apart(gap));
    const double each[2] = {0.6 * 0.3 / (gap + 0.01) * (7 - 1.5), 0.6 * 0.3 / (gap + 0.01) * (9 - 2.5)};
    test::raise(worst, std::abs(r(2) / each[0] - 1));
    test::raise(worst, std::abs(r(5) / each[1] - 1));
    test::raise(worst, std::abs(r(8) / -(0.75 * each[0] + 0.25 * each[1]) - 1));
    test::raise(worst, std::abs(r(11) / -(0.25 * each[0] + 0.75 * each[1]) - 1));
    for (const int displacement : {0, 1, 3, 4, 6, 7, 9, 10}) EXPECT_EQ(r(displacement), 0);
    contact.accept();
  }
  test::expect_measured("an open gap through FreeFEM against h A (T_s - T_m)", worst, 1e-10);
  BorderContact short_sighted = between_bars(model, 0.04);
  EXPECT_EQ(residual_of(short_sighted, apart(0.05)).norm(), 0);
}

/// Vertices 0 .. `segments`: a master from x = 0 on, edges of 1; after them slave nodes at x.
BorderContact over_a_line(const std::string& model, int segments, const std::vector<double>& x) {
  Border master, slave;
  for (int a = 0; a <= segments; ++a) {
    master.vertices.push_back(a), master.start.insert(master.start.end(), {double(a), 0});
    if (a > 0) master.edges.insert(master.edges.end(), {a - 1, a});
  }
  const int count = static_cast<int>(x.size());
  for (int k = 0; k < count; ++k) {
    slave.vertices.push_back(segments + 1 + k);
    slave.start.insert(slave.start.end(), {x[static_cast<std::size_t>(k)], 0});
    if (k > 0) slave.edges.insert(slave.edges.end(), {k, k - 1});
  }
  Options options;
  options.reach = 0.5;
  return {model, slave, master, segments + 1 + count, options};
}

// Control points have the temperatures of the same combinations as their positions: a spline keeps a linear one.
TEST(FreefemHeat, ASmoothedMasterHasTheTemperatureOfThePlace) {
  for (const char* segment : {"catmull_rom4", "bspline4"}) {
    VectorXd u = VectorXd::Zero(33);
    for (int a = 0; a < 8; ++a) u(3 * a + 2) = 4 + 2 * a;
    for (const int slave : {8, 9, 10}) u(3 * slave + 1) = -0.01, u(3 * slave + 2) = 30;
    double worst = 0, sum = 0;
    for (const double moved : {0, 2}) { // as a rigid body
      BorderContact contact = over_a_line(with_heat(R"({"conductance": 10})", segment), 7, {3.1, 3.7, 4.3});
      for (int node = 0; node < 11; ++node) u(3 * node) += moved, u(3 * node + 1) += moved;
      const VectorXd r = residual_of(contact, u);
      for (const int k : {0, 1, 2}) {
        const double x = 3.1 + 0.6 * k, flow = (k == 1 ? 0.6 : 0.3) * 10 * (30 - (4 + 2 * x));
        test::raise(worst, std::abs(r(3 * (8 + k) + 2) / flow - 1));
      }
      for (int node = 0; node < 11; ++node) sum += r(3 * node + 2);
    }
    test::expect_measured((std::string(segment) + " with a linear temperature, flow").c_str(), worst, 1e-10);
    test::expect_measured("the sum of all its powers", std::abs(sum), 1e-10);
  }
}

// 0.9 mu N v enters the nodes, split as asked; the master's part goes to its nodes by their weights.
TEST(FreefemHeat, ADraggedBlockHeatsWithThePowerOfItsFriction) {
  using namespace adapters::dragged;
  constexpr double dt = 0.1, area = 0.2, power = 0.9 * mu * area * normal * depth * step / dt;
  double worst = 0;
  for (const double share : {0.0, 0.3, 1.0}) {
    BorderContact contact = over_a_line(model(share), 1, {0.1, 0.3}); // 0.1 of an area each
    VectorXd u = VectorXd::Zero(12);
    u(7) = u(10) = -depth;
    u(2) = 4, u(5) = 1, u(8) = 2, u(11) = 3; // no conductance: of no effect
    for (int i = 0; i < 12; ++i) {
      const VectorXd r = residual_of(contact, u, dt);
      const double x = 0.2 + u(6); // their middle
      if (i > 2) {
        test::raise(worst, std::abs(r(2) + r(5) + r(8) + r(11) + power) / power);
        test::raise(worst, std::abs(r(8) + r(11) + share * power) / power);
        test::raise(worst, std::abs(r(5) + x * (1 - share) * power) / power);
      }
      contact.accept();
      u(6) += step, u(9) += step;
    }
  }
  test::expect_measured("power of a dragged block through FreeFEM, split, against mu N v", worst, 1e-10);
}

/// Forces and powers by displacements and temperatures: the largest errors of the four blocks of K beside differences
/// of R of fourth order, relative to the largest entry of the block. No force depends on a temperature.
void expect_slopes(BorderContact& contact, const VectorXd& u, double dt, const std::string& name) {
  const Eigen::Index n = u.size();
  VectorXd residual = VectorXd::Zero(n);
  MatrixXd tangent = MatrixXd::Zero(n, n), numeric(n, n);
  add(contact, u, dt, residual, tangent);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double step = j % 3 == 2 ? 1e-2 : 1e-5;
    const auto at = [&](int times) {
      VectorXd moved = u;
      moved(j) += times * step;
      return residual_of(contact, moved, dt);
    };
    numeric.col(j) = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step);
  }
  double error[2][2] = {}, size[2][2] = {};
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      test::raise(error[i % 3 == 2][j % 3 == 2], std::abs(tangent(i, j) - numeric(i, j)));
      test::raise(size[i % 3 == 2][j % 3 == 2], std::abs(numeric(i, j)));
    }
  EXPECT_EQ(size[0][1], 0);
  EXPECT_EQ(error[0][1], 0);
  for (const auto& [i, j, block] : {std::tuple{0, 0, ", forces by displacements"},
                                    {1, 0, ", powers by displacements"},
                                    {1, 1, ", powers by temperatures"}}) {
    EXPECT_GT(size[i][j], 1) << name << block;
    test::expect_measured((name + block).c_str(), error[i][j] / size[i][j], 1e-8);
  }
}

// Nodes that stick, slip, and are open, over three segments or a spline.
TEST(FreefemHeat, AllBlocksOfTheTangentAreSlopes) {
  for (const char* segment : {"line2", "bspline4"}) {
    const std::string model = R"({"segment": ")" + std::string(segment) + R"(", "border": 0.1,
    "height": {"type": "sine", "amplitude": 0.01, "wave_vector": [0.4]},
    "contact": {"normal": {"type": "penalty", "stiffness": 200},
    "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 80},
    "heat": {"power": {"coefficient": 4, "pressure": 2, "exponent": 0.95}, "gas": {"conductivity": 0.3, "jump": 0.02},
             "friction": {"share": 0.9, "slave": 0.3}}}})";
    BorderContact contact = over_a_line(model, 4, {1.2, 1.6, 2.3, 2.8});
    VectorXd u = VectorXd::Zero(27);
    for (int node = 0; node < 9; ++node) u(3 * node + 2) = 3 + std::sin(2. * node);
    for (int a = 0; a < 5; ++a) u(3 * a + 1) = 0.02 * std::cos(1.7 * a);
    for (int k = 5; k < 9; ++k) u(3 * k + 1) = -0.06, u(3 * k + 2) += 20;
    residual_of(contact, u, 0.2);
    contact.accept();
    u(15) += 0.002;                             // sticks
    u(18) += 0.1, u(21) += 0.15, u(24) += 0.12; // slip
    u(25) += 0.2;                               // and opens
    const VectorXd r = residual_of(contact, u, 0.2);
    for (const int pressed : {16, 19, 22}) EXPECT_LT(r(pressed), -1);
    EXPECT_EQ(r(25), 0);
    EXPECT_GT(r(26), 1) << "the gas";
    expect_slopes(contact, u, 0.2, segment);
  }
}

void expect_refusal(const std::string& words, const std::function<void()>& action) {
  try {
    action();
    FAIL() << "no refusal: " << words;
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(FreefemHeat, WhatTheScriptHasToWriteIsSaid) {
  BorderContact warm = between_bars(adapters::dragged::model(0.5), 0.5),
                cold = between_bars(R"({"segment": "line2", "contact": {"normal": {"type": "penalty",
    "stiffness": 400}}})",
                                    0.5);
  EXPECT_EQ(warm.dofs(), 24);
  EXPECT_EQ(cold.dofs(), 16);
  warm.require_sizes(24, 24);
  cold.require_sizes(16, 16);
  for (const auto& [u, r] : {std::pair{16, 16}, {24, 16}, {16, 24}})
    expect_refusal("the model has \"heat\": write u[] of a space [P1, P1, P1] on the mesh",
                   [&, u = u, r = r] { warm.require_sizes(u, r); });
  expect_refusal("no \"heat\": write u[] of a space [P1, P1] on the mesh",
                 [&] { cold.require_sizes(24, 24); });
  const VectorXd u = VectorXd::Zero(24);
  VectorXd r = u;
  for (const double dt : {0., -1.})
    expect_refusal("write entsForces(..., dt=...)", [&] { warm.evaluate(u.data(), r.data(), dt); });
  expect_refusal("multipliers as unknowns", [] {
    between_bars(
        R"({"segment": "line2", "contact": {"normal": {"type": "augmented_multiplier", "stiffness": 400}}})",
        0.5);
  });
}

} // namespace
} // namespace freefem::freefem_heat_test
