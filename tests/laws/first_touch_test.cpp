// Friction and wear begin where a slave touches within an increment.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "law_elements.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace laws::first_touch_test {
namespace {

json friction(double coefficient, double stiffness) {
  return {{"type", "coulomb"}, {"coefficient", coefficient}, {"stiffness", stiffness}};
}

// A slave node over a flat rigid line, evaluated at the begin of the first increment.
struct Path {
  explicit Path(const json& contact) : model(text(contact)) {
    elements.layout = layout_of(model.handle());
    elements.at.count = 1;
    elements.at.area = {1.0};
    elements.at.master = {-10.0, 0.0, 10.0, 0.0};
    elements.state.resize(static_cast<std::size_t>(elements.layout.state_size));
    elements.multiplier.resize(static_cast<std::size_t>(elements.layout.multipliers));
    ents_state_init(model.handle(), 1, elements.state.data(), elements.layout.state_size, nullptr);
  }
  static std::string text(const json& contact) {
    return json({{"segment", "line2"}, {"master", "rigid"}, {"contact", contact}}).dump();
  }
  void evaluate_at(double x, double y) {
    elements.at.slave = {x, y};
    evaluate(model, elements, ENTS_FLAGS | ENTS_RESIDUAL | ENTS_TRACTION | ENTS_PRESSURE | ENTS_STATE,
             results);
    ASSERT_EQ(results.status[0], ENTS_OK);
  }
  void commit() { elements.state = results.state; }

  mechanics::Model model;
  LawElements elements;
  LawResults results;
};

const json penalty = {{"type", "penalty"}, {"stiffness", 1000.0}};

// Down by 0.1 and along by 1, from 0.05 above the line to 0.05 below: mu p in any number of increments.
TEST(FirstTouch, IsSlipInAnyNumberOfIncrements) {
  for (int increments = 1; increments <= 64; increments *= 4) {
    Path path({{"normal", penalty}, {"friction", friction(0.3, 1000.0)}});
    path.evaluate_at(0.0, 0.05);
    path.commit();
    for (int k = 1; k <= increments; ++k) {
      path.evaluate_at(1.0 * k / increments, 0.05 - 0.1 * k / increments);
      path.commit();
    }
    EXPECT_NEAR(path.results.pressure[0], 50.0, 1e-12);
    EXPECT_NEAR(path.results.traction[0], 15.0, 1e-11) << increments;
    EXPECT_TRUE(path.results.flags[0] & ENTS_FLAG_SLIP) << increments;
    EXPECT_FALSE(path.results.flags[0] & ENTS_FLAG_NO_BEGIN) << increments;
  }
}

// It comes down steeper than the friction angle: the spring along the line is longer by the way after the
// touch, as in increments that are as small as one likes.
TEST(FirstTouch, SticksWhereItComesDownSteeply) {
  const double y_begin = 0.05, y_end = -0.01, along = 0.012, depth = -y_end;
  for (const int increments : {1, 2, 7, 1000}) {
    Path path({{"normal", penalty}, {"friction", friction(0.3, 1000.0)}});
    path.evaluate_at(0.0, y_begin);
    path.commit();
    for (int k = 1; k <= increments; ++k) {
      path.evaluate_at(along * k / increments, y_begin + (y_end - y_begin) * k / increments);
      path.commit();
    }
    EXPECT_NEAR(path.results.traction[0], 1000.0 * along * depth / (y_begin - y_end), 1e-11) << increments;
    EXPECT_TRUE(path.results.flags[0] & ENTS_FLAG_STICK) << increments;
  }
}

// Whoever touches at the begin has an anchor there; a gap of exactly 0 is contact, with its stiffness.
TEST(FirstTouch, OfABodyThatTouchesAtTheStartIsItsAnchor) {
  Path path({{"normal", penalty}, {"friction", friction(0.9, 1000.0)}});
  path.evaluate_at(0.0, 0.0);
  EXPECT_TRUE(path.results.flags[0] & ENTS_FLAG_CONTACT);
  LawResults matrix;
  evaluate(path.model, path.elements, ENTS_TANGENT, matrix);
  EXPECT_NEAR(matrix.tangent[3], 1000.0, 1e-9);
  path.commit();
  path.evaluate_at(0.004, -0.01);
  EXPECT_NEAR(path.results.traction[0], 4.0, 1e-12);
}

// Without an evaluation at the begin nobody knows the way: no friction, and the flag says so.
TEST(FirstTouch, IsFlaggedWhereTheBeginIsNotKnown) {
  Path path({{"normal", penalty}, {"friction", friction(0.3, 1000.0)}});
  path.evaluate_at(1.0, -0.05);
  EXPECT_EQ(path.results.traction[0], 0.0);
  EXPECT_TRUE(path.results.flags[0] & ENTS_FLAG_NO_BEGIN);
  path.commit();
  path.evaluate_at(1.1, -0.05);
  EXPECT_NEAR(path.results.traction[0], 15.0, 1e-11);
  EXPECT_FALSE(path.results.flags[0] & ENTS_FLAG_NO_BEGIN);
}

// Every law: full slip is the limit, whatever the law's own gap of contact. With multipliers that are unknowns
// there is no friction in the increment of the touch, and a flag says so.
TEST(FirstTouch, IsTheLimitForEveryLaw) {
  for (const Method& method : methods()) {
    if (!method.name.ends_with("_coulomb") || method.normal["type"] == "separation") // that is never open
      continue;
    Path path({{"normal", method.normal}, {"friction", friction(0.3, 8000.0)}});
    const bool multiplies = !path.elements.multiplier.empty();
    if (multiplies) path.elements.multiplier = {0.0, 0.0};
    path.evaluate_at(0.0, 0.04);
    EXPECT_FALSE(path.results.flags[0] & ENTS_FLAG_CONTACT) << method.name;
    path.commit();
    if (multiplies) path.elements.multiplier = {2.0, 0.0};
    path.evaluate_at(1.0, -0.01);
    const double p = path.results.pressure[0];
    EXPECT_GT(p, 0.0) << method.name;
    EXPECT_NEAR(path.results.traction[0], multiplies ? 0.0 : 0.3 * p, 1e-10 * p) << method.name;
    EXPECT_TRUE(path.results.flags[0] & (multiplies ? ENTS_FLAG_NO_BEGIN : ENTS_FLAG_SLIP)) << method.name;
  }
}

// Wear k p ds with ds the way after the touch: the sum of many increments is the integral of k p along the
// path.
TEST(FirstTouch, WearsFromTheTouchOn) {
  const double k = 1e-6, y_begin = 0.03, y_end = -0.01, along = 1.0;
  const double touch = y_begin / (y_begin - y_end), exact = k * 1000.0 * 0.5 * -y_end * along * (1.0 - touch);
  double last = 0.0;
  for (const int increments : {1, 10, 1000}) {
    Path path({{"normal", penalty}, {"wear", {{"coefficient", k}}}});
    path.evaluate_at(0.0, y_begin);
    path.commit();
    for (int i = 1; i <= increments; ++i) {
      path.evaluate_at(along * i / increments, y_begin + (y_end - y_begin) * i / increments);
      path.commit();
    }
    last = path.results.state[static_cast<std::size_t>(path.elements.layout.worn)];
    if (increments ==
        1) { // the pressure of the end counts for all of an increment, and is less by what wears
      EXPECT_NEAR(last, 2.0 * exact / (1.0 + k * 1000.0 * along * (1.0 - touch)), 1e-12 * exact);
    }
  }
  EXPECT_NEAR(last, exact, 0.01 * exact);
}

} // namespace
} // namespace laws::first_touch_test
