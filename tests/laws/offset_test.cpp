// Numbers of a slave node: clearances and coatings beside the geometry, factors of wear.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "law_elements.hpp"

namespace laws::offset_test {
namespace {

// One slave above a line from (-1, 0) to (1, 0).
struct Slave {
  explicit Slave(const json& contact)
      : model(json{{"segment", "line2"}, {"contact", contact}}.dump()), layout(layout_of(model.handle())) {
    state.resize(static_cast<std::size_t>(layout.state_size));
    ents_state_init(model.handle(), 1, state.data(), layout.state_size, nullptr);
    end = state;
  }
  std::int32_t evaluate(double x, double y, const double* values = nullptr) {
    const double slave[2] = {x, y}, master[4] = {-1, 0, 1, 0}, start = x;
    ents_input in{};
    in.struct_size = sizeof in, in.slave = slave, in.master = master, in.start = &start;
    in.state_begin = state.data(), in.multiplier = &multiplier, in.slave_values = values;
    ents_output out{};
    out.struct_size = sizeof out;
    out.wanted = ENTS_GAP | ENTS_PRESSURE | ENTS_ENERGY | ENTS_STATE | ENTS_RESIDUAL;
    out.gap = &gap, out.pressure = &pressure, out.energy = &energy, out.state_end = end.data(),
    out.residual = residual;
    report = {};
    report.struct_size = sizeof report;
    return ents_evaluate(model.handle(), 0, 1, &in, &out, &report);
  }

  mechanics::Model model;
  ents_layout layout;
  std::vector<double> state, end;
  double multiplier = 0.4, gap = 0, pressure = 0, energy = 0, residual[8] = {};
  ents_report report{};
};

TEST(Offset, IsAGapBesideTheGeometry) {
  for (const Method& method : methods()) {
    if (!method.friction.is_null()) continue;
    for (const double offset : {0.02, -0.03}) {
      Slave with(json{{"normal", method.normal}, {"offset", offset}}),
          without(json{{"normal", method.normal}});
      for (const double gap : {-0.05, -0.01, 0.01, 0.025}) {
        ASSERT_EQ(with.evaluate(0.3, gap), ENTS_OK) << with.report.message;
        ASSERT_EQ(without.evaluate(0.3, gap + offset), ENTS_OK);
        EXPECT_NEAR(with.gap, gap, 1e-16) << method.name;
        EXPECT_NEAR(with.pressure, without.pressure, 1e-12) << method.name << " " << gap;
        EXPECT_NEAR(with.energy, without.energy, 1e-12) << method.name << " " << gap;
        for (int i = 0; i < with.layout.dofs; ++i)
          EXPECT_NEAR(with.residual[i], without.residual[i], 1e-12) << method.name << " " << gap;
      }
    }
  }
}

TEST(Offset, OfTheModelAndOfTheSlaveAddUp) {
  const json normal = {{"type", "penalty"}, {"stiffness", 100.0}};
  Slave both(json{{"normal", normal}, {"offset", 0.02}}), one(json{{"normal", normal}, {"offset", -0.03}});
  const double values[3] = {-0.05, 1.0, 1.0};
  ASSERT_EQ(both.evaluate(0.3, 0.01, values), ENTS_OK);
  ASSERT_EQ(one.evaluate(0.3, 0.01), ENTS_OK);
  EXPECT_GT(one.pressure, 0.0);
  EXPECT_NEAR(both.pressure, one.pressure, 1e-14);
}

TEST(SlaveValues, AreFactorsOfWear) {
  const json normal = {{"type", "penalty"}, {"stiffness", 100.0}};
  const auto contact = [&](double k, double sliding) {
    return json{{"normal", normal}, {"wear", {{"coefficient", k}, {"sliding", sliding}}}};
  };
  Slave turns(contact(0.01, 0.5)), slides(contact(0.02, 1.5)), rests(contact(0.01, 0.0));
  const double arm[3] = {0.0, 2.0, 3.0}, zone[3] = {0.0, 0.0, 1.0};
  ASSERT_EQ(turns.evaluate(0.3, -0.02, arm), ENTS_OK);
  ASSERT_EQ(slides.evaluate(0.3, -0.02), ENTS_OK);
  const auto worn = static_cast<std::size_t>(turns.layout.worn);
  EXPECT_GT(turns.end[worn], 1e-3);
  EXPECT_NEAR(turns.end[worn], slides.end[worn], 1e-16);
  EXPECT_NEAR(turns.pressure, slides.pressure, 1e-14);
  ASSERT_EQ(turns.evaluate(0.3, -0.02, zone), ENTS_OK); // where nothing wears
  ASSERT_EQ(rests.evaluate(0.3, -0.02), ENTS_OK);
  EXPECT_EQ(turns.end[worn], 0.0);
  EXPECT_EQ(turns.pressure, rests.pressure);
}

TEST(SlaveValues, MistakesAreNamed) {
  const json normal = {{"type", "penalty"}, {"stiffness", 100.0}};
  const double good[3] = {0.0, 1.0, 1.0}, nan = std::numeric_limits<double>::quiet_NaN();
  Slave plain(json{{"normal", normal}}), offset(json{{"normal", normal}, {"offset", 0}});
  EXPECT_EQ(plain.evaluate(0.3, -0.02, good), ENTS_BAD_VALUE);
  EXPECT_NE(std::strstr(plain.report.message, "write \"offset\": 0"), nullptr) << plain.report.message;
  EXPECT_EQ(offset.evaluate(0.3, -0.02, good), ENTS_OK);
  for (int i = 0; i < 3; ++i) {
    double bad[3] = {0.0, 1.0, 1.0};
    bad[i] = nan;
    EXPECT_EQ(offset.evaluate(0.3, -0.02, bad), ENTS_NON_FINITE);
    EXPECT_NE(std::strstr(offset.report.message, "input.slave_values["), nullptr) << offset.report.message;
    bad[i] = -0.5;
    EXPECT_EQ(offset.evaluate(0.3, -0.02, bad), i == 0 ? ENTS_OK : ENTS_BAD_VALUE);
    if (i > 0) {
      EXPECT_NE(std::strstr(offset.report.message, "negative factor"), nullptr) << offset.report.message;
    }
  }
}

// A slave of a patch has them as any other.
TEST(SlaveValues, ReachTheElementsOfPatches) {
  const json contact = {{"normal", {{"type", "penalty"}, {"stiffness", 100.0}}}, {"offset", 0}};
  const mechanics::Model model(
      json{{"segment", "line2"}, {"patch", {{0, 1}, {1, 2}}}, {"contact", contact}}.dump());
  const double slave[2] = {0.4, 0.01}, master[6] = {-1, 0, 0, 0, 1, 0}, values[3] = {-0.03, 1, 1};
  double pressure = 0;
  ents_input in{};
  in.struct_size = sizeof in, in.slave = slave, in.master = master, in.slave_values = values;
  ents_output out{};
  out.struct_size = sizeof out, out.wanted = ENTS_PRESSURE, out.pressure = &pressure;
  ASSERT_EQ(ents_evaluate(model.handle(), 0, 1, &in, &out, nullptr), ENTS_OK);
  EXPECT_NEAR(pressure, 100 * 0.02, 1e-12);
}

} // namespace
} // namespace laws::offset_test
