// SPDX-License-Identifier: BSD-3-Clause
// Heat through CalculiX's U1E, its passes emulated: forces and temperatures one after the other, no block between them.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <unistd.h>

#include "calculix_routines.hpp"
#include "guarded.hpp"
#include "heat_problems.hpp"
#include "measured.hpp"
#include "plain_model.hpp"
#include "worst.hpp"

namespace adapters::heat_calculix_test {
namespace {

using Values = std::vector<double>;
using Response = Bars::Response;

constexpr int heat_transfer = 2, coupled = 3;

/// One element of a slave and two master nodes, (x, y, T) each, in ccx's arrays.
struct Ccx {
  static constexpr int nstate = 30, nodes = 3;
  int ne = 1, nprop = 3, ithermal = coupled, nmethod = 1;
  double prop[3], dtime = 0.1;
  int kon[nodes] = {1, 2, 3}, ipkon[1] = {0}, ielprop[1] = {0}, mi[3] = {1, 3, 1};
  const char* label = "U1E   \x03\x03";
  Values co, v, vini, before = Values(nstate), after = Values(nstate);
  Guarded fn{4 * nodes};
  double qa[4] = {0, 0, -1, 0};

  Ccx(int model, int procedure = coupled) : ithermal(procedure), prop{static_cast<double>(model), 0.6, 0} {
    ents_ccx_find_heat_(&ne, ipkon, label, ielprop, prop, &nprop, &ithermal, 8);
  }
  /// @param reference  [3][2]; unknowns and those of the begin: [3][3]
  void place(const Values& reference, const Values& unknowns, const Values& begin) {
    co.assign(9, 0.0), v.assign(12, 0.0), vini.assign(12, 0.0);
    for (std::size_t node = 0; node < 3; ++node) {
      for (std::size_t i = 0; i < 2; ++i) {
        co[3 * node + i] = reference[2 * node + i];
        v[4 * node + 1 + i] = unknowns[3 * node + i], vini[4 * node + 1 + i] = begin[3 * node + i];
      }
      v[4 * node] = unknowns[3 * node + 2], vini[4 * node] = begin[3 * node + 2];
    }
  }
  /// The force passes, as results.c calls them.
  void forces() {
    const int one = 1;
    int mechanical = 0, thermal = 0;
    for (std::size_t i = 0; i < fn.size(); ++i) fn[i] = 0;
    qa[0] = qa[1] = 0;
    if (ithermal != heat_transfer)
      ents_ccx_force_(&one, kon, ipkon, label, co.data(), v.data(), vini.data(), mi, ielprop, prop, fn.data(),
                      qa, &mechanical, &one, &one, before.data(), after.data(), &nstate, &dtime, 8);
    for (int node = 0; node < nodes; ++node) EXPECT_EQ(fn[at(4 * node)], 0);
    ents_ccx_heat_force_(&one, kon, ipkon, label, co.data(), v.data(), mi, ielprop, prop, fn.data(), qa,
                         &thermal, &one, &one, before.data(), &nstate, &dtime, &ithermal, &nmethod, 8);
    fn.check_guards("fn");
    EXPECT_EQ(mechanical, ithermal == heat_transfer ? 0 : 9);
    EXPECT_EQ(thermal, 3);
    EXPECT_DOUBLE_EQ(qa[1], std::abs(fn[0]) + std::abs(fn[4]) + std::abs(fn[8]));
  }
  /// The stiffness passes; the blocks between displacements and temperatures stay zero, as ccx has none.
  Response response() {
    const int one = 1;
    int nope = 0;
    Guarded s(3600), sm(3600), ff(60), st(3600), smt(3600), fft(60);
    ents_ccx_stiffness_(&one, label, s.data(), sm.data(), ff.data(), 8);
    ents_ccx_heat_stiffness_(&one, &nope, st.data(), smt.data(), fft.data());
    EXPECT_EQ(nope, 3);
    for (Guarded* each : {&s, &sm, &st, &smt}) each->check_guards("s, sm");
    Response r;
    r.tangent.assign(81, 0.0);
    for (int i = 0; i < 9; ++i) {
      const bool temperature = i % 3 == 2;
      r.residual.push_back(fn[at(4 * (i / 3) + (temperature ? 0 : 1 + i % 3))]);
      for (int j = 0; j < 9; ++j) {
        if (temperature != (j % 3 == 2)) continue;
        const int row = i / 3, column = j / 3;
        r.tangent[at(i + 9 * j)] =
            temperature ? st[at(row + 60 * column)] : s[at(3 * row + i % 3 + 60 * (3 * column + j % 3))];
        EXPECT_EQ(smt[at(row + 60 * column)], 0);
      }
      if (temperature) {
        EXPECT_EQ(fft[at(i / 3)], 0);
      }
    }
    return r;
  }
};

Response ccx(int model, const Values& reference, const Values& unknowns) {
  Ccx host(model);
  host.place(reference, unknowns, unknowns);
  host.forces();
  return host.response();
}

double error_of(const Bars& bars, double conductance) {
  const double exact = Bars::end + Bars::power * bars.resistance(conductance);
  return std::max(std::abs(bars.unknowns(14) / exact - 1), std::abs(bars.unknowns(17) / exact - 1));
}

TEST(HeatThroughCcx, TwoBarsAreExactInOneIteration) {
  write("ents_831.json", R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 400},
    "heat": {"conductance": 10}}})");
  Bars bars;
  bars.solve([](int, const Values& x, const Values& u) { return ccx(831, x, u); });
  test::expect_measured("two bars through ccx against T_in + q R", error_of(bars, 10), 1e-10);
  EXPECT_EQ(bars.iterations, 1);
}

// The pressure is linear here and found in one iteration; its conductance then takes a second one: ccx has no block
// of powers by displacements.
TEST(HeatThroughCcx, TwoBarsWithAConductanceOfThePressure) {
  write("ents_832.json", R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 400},
    "heat": {"power": {"coefficient": 4, "pressure": 2, "exponent": 0.95}}}})");
  Bars bars;
  bars.unknowns(1) = bars.unknowns(4) = -0.01; // in contact
  bars.solve([](int, const Values& x, const Values& u) { return ccx(832, x, u); });
  const double p = 0.3 / (1 / 40. + 1 / 240. + 1 / 300.) / 0.6;
  test::expect_measured("the same, a conductance of the pressure", error_of(bars, 4 * std::pow(p / 2, 0.95)),
                        1e-10);
  EXPECT_EQ(bars.iterations, 2);
}

constexpr double mu = 0.3, depth = 0.02, step = 0.05, normal = 0.6 * 100 * depth;

std::string dragged(const std::string& heat) {
  return R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 100},
    "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 80}, "heat": {)" +
         heat + "}}}";
}

TEST(HeatThroughCcx, ADraggedBlockHeatsWithThePowerOfItsFriction) {
  write("ents_833.json", dragged(R"("friction": {"share": 0.9, "slave": 0.3})"));
  Ccx host(833);
  const double power = 0.9 * mu * normal * step / host.dtime;
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    const auto at_step = [&](int k) { return Values{step * k, -depth, 4, 0, 0, 1, 0, 0, 2}; };
    host.place({-0.8, 0, -1, 0, 1, 0}, at_step(i), at_step(std::max(i - 1, 0)));
    for (int pass = 0; pass < 2; ++pass) host.forces(); // an iteration begins from the begin of the increment
    host.before = host.after;
    if (i <= 2) continue;
    test::raise(worst, std::abs(-host.fn[0] - 0.3 * power) / power);
    test::raise(worst, std::abs(-host.fn[4] - host.fn[8] - 0.7 * power) / power);
  }
  test::expect_measured("power of a dragged block through ccx, split, against mu N v", worst, 1e-10);
}

// In *HEAT TRANSFER nothing moves: what flows is that of the coupled step, but for the heat of friction.
TEST(HeatThroughCcx, AStepOfTemperaturesAloneHasTheSameFlow) {
  const std::string flow = R"("power": {"coefficient": 4, "pressure": 2, "exponent": 0.95})";
  write("ents_834.json", dragged(flow));
  write("ents_835.json", dragged(flow + R"(, "friction": {})"));
  const Values x{-0.3, 0, -1, 0, 1, 0}, u{0.1, -depth, 4, 0, 0, 1, 0, 0, 2};
  Ccx both(834);
  both.place(x, u, {0, -depth, 4, 0, 0, 1, 0, 0, 2});
  both.forces();
  const Response expected = both.response();
  Ccx alone(835, heat_transfer);
  alone.place(x, u, u);
  alone.forces();
  for (const std::size_t node : {0, 4, 8}) EXPECT_EQ(alone.fn[node], both.fn[node]);
  EXPECT_NE(alone.fn[0], 0);
  const Response found = alone.response();
  for (const std::size_t i : {2, 5, 8})
    for (const std::size_t j : {2, 5, 8}) EXPECT_EQ(found.tangent[i + 9 * j], expected.tangent[i + 9 * j]);
  EXPECT_EQ(alone.after, Values(Ccx::nstate)) << "the history stays";
}

// The linear begin of an increment: forces go on linearly from where the last one ended, and so do powers with the
// temperatures that are prescribed anew, where they are linear.
TEST(HeatThroughCcx, ALinearBeginTakesTheNewTemperatures) {
  write("ents_839.json", dragged(R"("conductance": 3)"));
  const Values x{-0.3, 0, -1, 0, 1, 0}, begin{0.1, -depth, 4, 0, 0, 1, 0, 0, 2},
      end{0.1, -depth, 6, 0, 0, -3, 0, 0, 5};
  const int one = 1, no = 0;
  int count = 0;
  Ccx expected(839);
  expected.place(x, end, begin);
  expected.forces();
  Ccx host(839);
  host.place(x, begin, begin);
  const Values vold = host.v;
  host.place(x, end, begin);
  std::fill(host.fn.data(), host.fn.data() + host.fn.size(), 0.0);
  ents_ccx_force_(&one, host.kon, host.ipkon, host.label, host.co.data(), vold.data(), host.vini.data(),
                  host.mi, host.ielprop, host.prop, host.fn.data(), host.qa, &count, &no, &no,
                  host.before.data(), host.after.data(), &Ccx::nstate, &host.dtime, 8);
  ents_ccx_linear_force_(&one, host.kon, host.ipkon, host.label, vold.data(), host.v.data(), host.mi,
                         host.fn.data(), &one, 8);
  ents_ccx_heat_force_(&one, host.kon, host.ipkon, host.label, host.co.data(), host.v.data(), host.mi,
                       host.ielprop, host.prop, host.fn.data(), host.qa, &count, &one, &no,
                       host.before.data(), &Ccx::nstate, &host.dtime, &host.ithermal, &host.nmethod, 8);
  for (const std::size_t node : {0, 4, 8}) EXPECT_NEAR(host.fn[node], expected.fn[node], 1e-13);
  EXPECT_GT(std::abs(host.fn[0]), 1);
}

// What stops the job, and what needs no unsymmetric solver: rows of forces and of temperatures are apart.
TEST(HeatThroughCcx, ProceduresWithoutTemperaturesAreNamed) {
  write("ents_836.json", R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 400},
    "heat": {"power": {"coefficient": 4, "pressure": 2, "exponent": 0.95}}}})");
  write("ents_837.json",
        R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 400}}})");
  const int element = 0;
  const auto unsymmetric = [](Ccx& c) {
    return ents_ccx_unsymmetric_(&c.ne, c.ipkon, c.label, c.ielprop, c.prop, &c.nprop);
  };
  Ccx heat(836);
  EXPECT_EQ(ents_ccx_has_heat_(&element), 1);
  EXPECT_EQ(unsymmetric(heat), 0);
  write("ents_838.json", dragged(R"("conductance": 3)"));
  Ccx friction(838);
  EXPECT_EQ(unsymmetric(friction), 1);
  Ccx none(837);
  EXPECT_EQ(ents_ccx_has_heat_(&element), 0) << "that of the step before is forgotten";
  const auto stops = [](int procedure, int nmethod) {
    dup2(STDERR_FILENO, STDOUT_FILENO); // ccx's channel
    Ccx c(836, procedure);
    c.nmethod = nmethod;
    c.place({-0.3, 0, -1, 0, 1, 0}, Values(9), Values(9));
    c.forces();
  };
  EXPECT_EXIT(stops(1, 1), testing::ExitedWithCode(201),
              "This step has no temperatures: write .HEAT TRANSFER");
  EXPECT_EXIT(stops(4, 1), testing::ExitedWithCode(201), "write .COUPLED TEMPERATURE-DISPLACEMENT");
  EXPECT_EXIT(stops(heat_transfer, 2), testing::ExitedWithCode(201), "this step is linear");
}

} // namespace
} // namespace adapters::heat_calculix_test
