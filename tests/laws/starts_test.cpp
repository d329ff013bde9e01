// SPDX-License-Identifier: BSD-3-Clause
// Many elements at once look at starts and states in registers, one element at its numbers. Where the
// projection starts, and what is wrong, is the same for both and for the kernels that take elements one by
// one.
#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "parts_of_calls.hpp"

namespace laws::starts_test {
namespace {

class StatesAndStarts : public testing::Test {
protected:
  struct Starting {
    mechanics::Scene scene;
    LawElements elements;
    std::string name;
    Method method;
    std::vector<double> start; // empty: none
  };
  // In contact, open without and with a history, and starts that matter only for those
  static Starting draw_starting(const std::string& basis, const std::string& height, const Method& method,
                                bool with_start) {
    Random random(8);
    Starting d;
    d.method = method;
    d.name = basis + " " + height + " " + method.friction.dump() + (with_start ? " with start" : "");
    d.scene = mechanics::draw_scene(random, mechanics::basis_named(basis), height, "normal");
    d.elements = draw(random, d.scene, model_of(d.scene, method), call_size, 0.05);
    if (with_start) d.start = d.elements.at.start;
    const std::size_t size = static_cast<std::size_t>(d.elements.layout.state_size),
                      t = static_cast<std::size_t>(d.elements.layout.parameters);
    for (std::size_t e = 0; e < static_cast<std::size_t>(call_size); ++e) {
      d.elements.state[e * size + 1] = static_cast<double>(e % 4);
      if (with_start && e % 4 > 1) d.start[e * t] += 0.4;
    }
    return d;
  }
  static std::vector<Starting> all_starting() {
    const Method frictionless = {"penalty", {{"type", "penalty"}, {"stiffness", 100.0}}, nullptr};
    Method friction = frictionless;
    friction.friction = {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 80.0}};
    std::vector<Starting> all;
    for (const char* basis : {"line2", "tri3", "quad4", "quad9"})
      for (const char* height : {"none", "sine"})
        for (const Method& method : {frictionless, friction})
          for (const bool starts : {false, true}) all.push_back(draw_starting(basis, height, method, starts));
    return all;
  }
};

TEST_F(StatesAndStarts, AreThoseOfTheElementAlone) {
  std::int64_t followed = 0, all_of_them = 0;
  for (const Starting& d : all_starting()) {
    const mechanics::Model model = model_of(d.scene, d.method);
    LawResults all;
    ents_report report;
    ASSERT_GE(try_evaluate(model.handle(), d.elements, call_results, all, report, d.start), 0)
        << d.name << ": " << report.message;
    for (std::int64_t e = 0; e < call_size; ++e) {
      const std::ptrdiff_t t = d.elements.layout.parameters;
      LawResults one;
      try_evaluate(model.handle(), part(d.elements, e, 1), call_results, one, report,
                   d.start.empty()
                       ? d.start
                       : std::vector<double>(d.start.begin() + e * t, d.start.begin() + (e + 1) * t));
      ASSERT_EQ(all.status[static_cast<std::size_t>(e)], one.status[0]) << d.name << " element " << e;
      if (one.status[0] != ENTS_OK) continue;
      ASSERT_TRUE(same(all, one, e, d.elements.layout)) << d.name << " element " << e;
      followed += e % 4 > 1;
      ++all_of_them;
    }
  }
  EXPECT_GT(followed, all_of_them / 3); // from their states
  EXPECT_GT(all_of_them - followed, all_of_them / 3);
}

TEST_F(StatesAndStarts, AreRefusedWhereverTheyAreWrong) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   infinite = std::numeric_limits<double>::infinity();
  for (const Starting& d : all_starting()) {
    const mechanics::Model model = model_of(d.scene, d.method);
    const int t = d.elements.layout.parameters, size = d.elements.layout.state_size;
    const std::vector<std::pair<int, double>> wrong = {{0, d.elements.state[0] + 1.0},
                                                       {0, nan},
                                                       {1, 1.5},
                                                       {1, 4.0},
                                                       {1, -1.0},
                                                       {2, infinite},
                                                       {3 + t - 1, nan},
                                                       {size - 1, -infinite}};
    for (std::size_t k = 0; k < wrong.size() + !d.start.empty(); ++k) {
      const std::size_t e = 3 + 9 * k; // in registers, each time at another place
      Starting spoilt = d;
      const bool in_state = k < wrong.size();
      if (in_state)
        spoilt.elements.state[e * static_cast<std::size_t>(size) + static_cast<std::size_t>(wrong[k].first)] =
            wrong[k].second;
      else
        spoilt.start[(e + 1) * static_cast<std::size_t>(t) - 1] = nan;
      LawResults r;
      ents_report report;
      EXPECT_EQ(try_evaluate(model.handle(), spoilt.elements, call_results, r, report, spoilt.start),
                in_state ? ENTS_BAD_STATE : ENTS_NON_FINITE)
          << d.name << " wrong " << k;
      EXPECT_EQ(report.element, static_cast<std::int64_t>(e)) << d.name << " wrong " << k;
    }
  }
}

} // namespace
} // namespace laws::starts_test
