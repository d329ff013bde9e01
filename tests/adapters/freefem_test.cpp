// SPDX-License-Identifier: BSD-3-Clause
// Contact of two borders, as the plugin of FreeFEM has it: an increment that is cut or thrown away leaves no
// trace.
#include <cmath>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "freefem/border_contact.hpp"

namespace freefem::freefem_test {
namespace {

/// A V, and a slave edge over it whose first node touches. Within the border a node projects on both flanks,
/// and stays on the one that it was on.
class Valley : public testing::Test {
protected:
  static constexpr char model[] = R"({"segment": "line2", "border": 0.3, "penetration_limit": 0.2,
    "contact": {"normal": {"type": "penalty", "stiffness": 100},
                "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 50}}})";
  static constexpr double start[2] = {0.2, 0.3};

  static Border slave() { return {{3, 4}, {start[0], start[1], -0.5, 3}, {0, 1}}; }
  static Border master() { return {{0, 1, 2}, {-1, 1, 0, 0, 1, 1}, {0, 1, 1, 2}}; }
  static Options options() {
    Options result;
    result.reach = 0.5;
    return result;
  }

  /// The first slave node at (x, y): its force, and what the plugin gets.
  struct Answer {
    double force[2];
    Forces forces;
  };
  Answer at(double x, double y) {
    std::vector<double> u(10), r(10);
    u[6] = x - start[0], u[7] = y - start[1];
    Answer answer{{}, contact_.evaluate(u.data(), r.data())};
    answer.force[0] = r[6], answer.force[1] = r[7];
    return answer;
  }
  void expect_same(const Answer& a, const Answer& b) {
    EXPECT_EQ(b.forces.step_factor, 1);
    EXPECT_EQ(a.force[0], b.force[0]);
    EXPECT_EQ(a.force[1], b.force[1]);
    EXPECT_EQ(a.forces.value, b.forces.value);
  }

  BorderContact contact_{model, slave(), master(), 5, options()};
};

TEST_F(Valley, ACutReturnsToTheBeginOfTheIncrement) {
  for (const bool accepted : {false, true}) {
    const Answer before = at(0.1, 0.05); // on the right flank
    ASSERT_GT(std::abs(before.force[0]), 1);
    if (accepted) contact_.accept();
    const Answer reference = at(0.1, 0.05), diverged = at(-0.9, 0.4); // deep in the left one
    EXPECT_GT(diverged.forces.step_factor, 0);
    EXPECT_LT(diverged.forces.step_factor, 1);
    EXPECT_TRUE(diverged.forces.value.empty());
    EXPECT_FALSE(diverged.forces.message.empty());
    EXPECT_EQ(diverged.force[0], 0);
    expect_same(reference, at(0.1, 0.05));
  }
}

// Beyond the end of the right flank, below it as it would go on: no force, but not without a word. Above it
// the node is open.
TEST_F(Valley, ANodeThatLeavesTheMasterInContactAsksForACut) {
  for (const bool above : {false, true}) {
    ASSERT_GT(std::abs(at(0.1, 0.05).force[0]), 1);
    contact_.accept();
    const Answer left = at(1.3, above ? 1.5 : 1.2);
    EXPECT_EQ(left.force[0], 0);
    EXPECT_EQ(left.forces.step_factor < 1, !above);
    EXPECT_EQ(left.forces.message.find("beside all segments") != std::string::npos, !above)
        << left.forces.message;
  }
  // An open one leaves it as it likes, unless it passes through the flank on its way.
  EXPECT_EQ(at(0.5, 0.6).force[0], 0);
  contact_.accept();
  const Answer through = at(1.3, 1.2);
  EXPECT_LT(through.forces.step_factor, 1);
  EXPECT_NE(through.forces.message.find("passes through the master surface"), std::string::npos)
      << through.forces.message;
  EXPECT_EQ(at(1.3, 1.5).forces.step_factor, 1);
  contact_.accept();
  EXPECT_EQ(at(1.3, 1.2).forces.step_factor, 1);
}

TEST_F(Valley, SoDoesAnIncrementThatTheScriptThrowsAway) {
  at(0.12, 0.06);
  contact_.accept();
  const Answer before = at(0.1, 0.05);
  ASSERT_GT(std::abs(before.force[0]), 1);
  const auto leave = [&] { ASSERT_LT(at(-0.7, 0.6).force[0], -1); }; // on the left flank, not too deep
  leave();
  EXPECT_EQ(at(0.1, 0.05).force[0], 0) << "this node does not show which flank it was on";
  leave();
  contact_.reject();
  expect_same(before, at(0.1, 0.05));
  leave();
  contact_.reject();
  contact_.accept(); // of nothing
  expect_same(before, at(0.1, 0.05));
}

// What opens in the first increment has the bonds of the undeformed borders.
TEST(Border, ABondHoldsFromTheFirstIncrementOn) {
  const char model[] =
      R"({"segment": "line2", "contact": {"normal": {"type": "tied", "stiffness": 100, "range": 1e-6}}})";
  Options options;
  options.reach = 0.5;
  BorderContact contact(model, {{2, 3}, {0.9, 0, 0.1, 0}, {0, 1}}, {{0, 1}, {0, 0, 1, 0}, {0, 1}}, 4,
                        options);
  std::vector<double> u(8), r(8);
  for (const double gap : {0.1, 0.2}) {
    u[5] = u[7] = gap;
    r.assign(8, 0);
    EXPECT_EQ(contact.evaluate(u.data(), r.data()).step_factor, 1);
    EXPECT_NEAR(r[5] + r[7], 100 * gap * 0.8, 1e-12) << gap;
    contact.accept();
  }
}

// A bond whose energy, 0.05 of an area, is spent does not form again where its node comes back.
TEST(Border, ABondThatHasBrokenStaysBroken) {
  const char model[] = R"({"segment": "line2", "contact": {"normal": {"type": "cohesive", "stiffness": 100,
    "strength": 1, "energy": 0.05, "range": 0.01}}})";
  Options options;
  options.reach = 0.5;
  BorderContact contact(model, {{2, 3}, {0.9, 0, 0.1, 0}, {0, 1}}, {{0, 1}, {0, 0, 1, 0}, {0, 1}}, 4,
                        options);
  std::vector<double> u(8), r(8);
  const auto force = [&](double gap) {
    u[5] = u[7] = gap;
    r.assign(8, 0);
    EXPECT_EQ(contact.evaluate(u.data(), r.data()).step_factor, 1);
    contact.accept();
    return r[5] + r[7];
  };
  EXPECT_NEAR(force(0.005), 0.4, 1e-12);
  for (const double gap : {0.2, 0.0, 0.005}) EXPECT_EQ(force(gap), 0) << gap;
}

/// Without areas the contact would have no forces.
TEST(Border, WithAnEdgeWithoutLengthIsRefused) {
  const Border master{{0, 1}, {-1, 0, 1, 0}, {0, 1}},
      slave{{2, 3, 4}, {0.5, 0, -0.5, 0, -0.5, 0}, {0, 1, 1, 2}};
  try {
    BorderContact(R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 100}}})",
                  slave, master, 5, Options());
    FAIL() << "no refusal";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("facet 1"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace freefem::freefem_test
