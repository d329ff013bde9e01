// SPDX-License-Identifier: BSD-3-Clause
// Heat through Abaqus: two bars and their contact, heat of friction, and what is refused.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "abaqus_services.hpp"
#include "emulated_host.hpp"
#include "heat_problems.hpp"
#include "measured.hpp"
#include "plain_model.hpp"
#include "uel_host.hpp"
#include "worst.hpp"

namespace adapters::heat_test {
namespace {

using Values = std::vector<double>;
using Response = Bars::Response;

/// Abaqus/Standard with the degrees of freedom 1, 2, 11.
UelCall abaqus_call(int model, const Values& reference, const Values& unknowns) {
  const int nodes = static_cast<int>(reference.size()) / 2;
  UelCall c(nodes, 3, 30);
  c.mcrd = 2;
  c.props = {static_cast<double>(model), 0.6};
  c.coords = reference;
  c.u = c.du = unknowns;
  c.lflags[0] = 72;
  return c;
}

Response abaqus(int model, const Values& reference, const Values& unknowns) {
  UelCall c = abaqus_call(model, reference, unknowns);
  c();
  Response r;
  const auto n = static_cast<std::size_t>(c.ndofel);
  c.rhs.check_written("RHS", 0, n), c.amatrx.check_written("AMATRX", 0, n * n);
  for (std::size_t i = 0; i < n; ++i) r.residual.push_back(-c.rhs[i]);
  for (std::size_t i = 0; i < n * n; ++i) r.tangent.push_back(c.amatrx[i]);
  return r;
}

// T_out = T_in + q R, R = sum of L / (k A), and 1 / (h A). The springs and the contact that closes at zero are
// linear: one iteration.
TEST(Heat, TwoBarsThroughAbaqusAreExactInOneIteration) {
  write("ents_811.json", R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 400},
    "heat": {"conductance": 10}}})");
  Bars bars;
  bars.solve([](int, const Values& x, const Values& u) { return abaqus(811, x, u); });
  const double exact = Bars::end + Bars::power * bars.resistance(10);
  test::expect_measured(
      "two bars through Abaqus against T_in + q R",
      std::max(std::abs(bars.unknowns(14) / exact - 1), std::abs(bars.unknowns(17) / exact - 1)), 1e-10);
  EXPECT_EQ(bars.iterations, 1);
}

// h = 4 (p / 2)^0.95, p known from the springs: no longer linear.
TEST(Heat, TwoBarsWithAConductanceOfThePressure) {
  write("ents_812.json", R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 400},
    "heat": {"power": {"coefficient": 4, "pressure": 2, "exponent": 0.95}}}})");
  Bars bars;
  bars.unknowns(1) = bars.unknowns(4) = -0.01; // the power has no slope where p = 0
  bars.solve([](int, const Values& x, const Values& u) { return abaqus(812, x, u); });
  const double force = 0.3 / (1 / 40. + 1 / 240. + 1 / 300.), p = force / 0.6,
               exact = Bars::end + Bars::power * bars.resistance(4 * std::pow(p / 2, 0.95));
  test::expect_measured("the same, a conductance of the pressure", std::abs(bars.unknowns(14) / exact - 1),
                        1e-10);
  EXPECT_LE(bars.iterations, 3);
}

using dragged::depth, dragged::mu, dragged::step;
constexpr double k_t = dragged::tangential, normal = 0.6 * dragged::normal * depth;

// A block that is dragged: 0.9 mu N v, split as asked; ENERGY(4) is the sum of what is dissipated, mu N times the
// way less the elastic slip, and ENERGY(2) what is stored.
TEST(Heat, ADraggedBlockHeatsAbaqusWithThePowerOfItsFriction) {
  int model = 814;
  double worst = 0, worst_energy = 0;
  for (const double share : {0.0, 0.3, 1.0}) {
    write("ents_" + std::to_string(model) + ".json", dragged::model(share));
    const double dtime = 0.1, power = 0.9 * mu * normal * step / dtime;
    Values history(30), energy(8);
    for (int i = 0; i < 20; ++i) {
      const double x = -0.8 + step * i;
      UelCall c = abaqus_call(model, {-0.8, 0, -1, 0, 1, 0}, {x + 0.8, -depth, 4, 0, 0, 1, 0, 0, 2});
      c.dtime = dtime;
      c.du.assign(9, 0.0);
      c.du[0] = i == 0 ? 0 : step;
      for (int pass = 0; pass < 2; ++pass) { // an iteration begins from the begin of the increment
        for (std::size_t k = 0; k < 30; ++k) c.svars[k] = history[k];
        for (std::size_t k = 0; k < 8; ++k) c.energy[k] = energy[k];
        c();
      }
      for (std::size_t k = 0; k < 30; ++k) history[k] = c.svars[k];
      for (std::size_t k = 0; k < 8; ++k) energy[k] = c.energy[k];
      if (i > 2) {
        test::raise(worst, std::abs(c.rhs[2] + c.rhs[5] + c.rhs[8] - power) / power);
        test::raise(worst, std::abs(c.rhs[2] - share * power) / power); // no conductance here
        EXPECT_NEAR(c.rhs[5] * (1 + x), c.rhs[8] * (1 - x), 1e-10 * power);
      }
    }
    const double way = 19 * step - mu * normal / (0.6 * k_t);
    test::raise(worst_energy, std::abs(energy[3] / (mu * normal * way) - 1));
    EXPECT_NEAR(energy[1], 0.5 * 0.6 * 100 * depth * depth + 0.5 * mu * normal * mu * normal / (0.6 * k_t),
                1e-12);
    for (const std::size_t other : {0, 2, 4, 5, 6, 7}) EXPECT_EQ(energy[other], 0);
    ++model;
  }
  test::expect_measured("power of a dragged block through Abaqus, split, against mu N v", worst, 1e-10);
  test::expect_measured("its ENERGY(4) against mu N times the way", worst_energy, 1e-10);
}

TEST(Heat, SelfcheckLooksAtAllBlocks) {
  write("ents_817.json",
        R"({"segment": "line2", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.8]},
    "contact": {"normal": {"type": "penalty", "stiffness": 100},
    "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 80},
    "heat": {"power": {"coefficient": 4, "pressure": 2, "exponent": 0.95}, "friction": {}}}})");
  abaqus_messages();
  Values history(30);
  for (int i = 0; i < 2; ++i) {
    UelCall c = abaqus_call(817, {-0.3, 0, -1, 0, 1, 0}, {0.1 * i, -0.06, 4, 0, 0, 1, 0, 0, 2});
    if (i == 1) c.props.push_back(1);
    c.du.assign(9, 0.0);
    c.du[0] = 0.1 * i;
    for (std::size_t k = 0; k < 30; ++k) c.svars[k] = history[k];
    c();
    for (std::size_t k = 0; k < 30; ++k) history[k] = c.svars[k];
  }
  const std::string text = only_message();
  EXPECT_NE(text.find("K is the slope of R"), std::string::npos) << text;
}

TEST(Heat, WhatAbaqusLacksIsNamed) {
  write("ents_818.json", dragged::model(0.5));
  write("ents_819.json", R"({"segment": "line2", "master": "rigid", "contact": {"normal": {"type": "penalty",
    "stiffness": 400}, "heat": {"conductance": 10}}})");
  write("ents_819.txt", "body -1 0\nbody 1 0\n");
  const auto refused = [](int model, const std::function<void(UelCall&)>& make) {
    abaqus_messages();
    UelCall c = abaqus_call(model, {-0.3, 0, -1, 0, 1, 0}, {0, -depth, 4, 0, 0, 1, 0, 0, 2});
    make(c);
    EXPECT_THROW(c(), HostStopped);
    return only_message();
  };
  const auto has = [](const std::string& text, const char* words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  // One node without 11, one with a spare degree of freedom, no 11 at all
  for (const int dofs : {8, 10, 6}) {
    const std::string text = refused(818, [&](UelCall& c) { c.ndofel = dofs; });
    has(text, ("the element has " + std::to_string(dofs) + " degrees of freedom at 3 nodes").c_str());
    has(text, "Write the degrees of freedom 1, 2, 3, 11 (in the plane 1, 2, 11)");
  }
  has(refused(818, [](UelCall& c) { c.dtime = 0; }), "time_increment");
  has(refused(819, [](UelCall& c) { c.ndofel = 6, c.nnode = 2; }),
      "a rigid body with a reference node has no temperature");
  // Where no time passes and nothing moves: a stiffness alone
  UelCall c = abaqus_call(818, {-0.3, 0, -1, 0, 1, 0}, {0, -depth, 4, 0, 0, 1, 0, 0, 2});
  c.lflags[2] = 2, c.dtime = 0;
  c();
  EXPECT_NE(c.amatrx[0], 0);
  // A temperature that is not finite is a diverged iteration.
  UelCall lost = abaqus_call(818, {-0.3, 0, -1, 0, 1, 0}, {0, -depth, std::nan(""), 0, 0, 1, 0, 0, 2});
  lost();
  EXPECT_EQ(lost.pnewdt, 0.5);
}

} // namespace
} // namespace adapters::heat_test
