// SPDX-License-Identifier: BSD-3-Clause
// Heat through the gap: closed forms of single elements, and what is refused. The tangent: tangent_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "heated_point.hpp"
#include "measured.hpp"
#include "model_handle.hpp"
#include "parts_of_calls.hpp"
#include "worst.hpp"

namespace laws::heat_test {
namespace {

using heated::coulomb, heated::eps, heated::k_t, heated::mu, heated::Point, heated::text_of;

// h A (T_s - T_m) of every part, and where there is none.
TEST(Heat, ConductanceIsTheSumOfItsParts) {
  const json parts[] = {{{"conductance", 3.0}},
                        {{"power", {{"coefficient", 2.0}, {"pressure", 5.0}, {"exponent", 0.95}}}},
                        {{"table", {{"pressures", {0, 1, 4}}, {"conductances", {1, 3, 2}}}}},
                        {{"clearance", {{"gaps", {0, 0.1, 0.3}}, {"conductances", {4, 1, 0}}}}},
                        {{"gas", {{"conductivity", 0.2}, {"jump", 0.05}}}}};
  const auto expected = [](int part, double gap) {
    const double p = gap < 0.0 ? -eps * gap : 0.0;
    switch (part) {
    case 0:
      return gap < 0.0 ? 3.0 : 0.0;
    case 1:
      return gap < 0.0 ? 2.0 * std::pow(p / 5.0, 0.95) : 0.0;
    case 2:
      return gap >= 0.0 ? 0.0 : p < 1.0 ? 1.0 + 2.0 * p : p < 4.0 ? 3.0 - (p - 1.0) / 3.0 : 2.0;
    case 3:
      return gap < 0.0 ? 0.0 : gap < 0.1 ? 4.0 - 30.0 * gap : gap < 0.3 ? 1.0 - 5.0 * (gap - 0.1) : 0.0;
    default:
      return 0.2 / ((gap > 0.0 ? gap : 0.0) + 0.05);
    }
  };
  json all = json::object();
  for (const json& part : parts) all.update(part);
  for (const double gap : {-0.2, -0.03, -0.005, 0.02, 0.2, 0.5}) {
    const double x = 0.4, difference = 5.0 - (0.3 * 1.0 + 0.7 * 2.0);
    double sum = 0.0;
    for (int i = 0; i < 5; ++i) {
      Point point(text_of(parts[i]));
      ASSERT_EQ(point.evaluate(x, gap), ENTS_OK);
      EXPECT_NEAR(point.heat[0], 0.7 * expected(i, gap) * difference, 1e-13) << i << " " << gap;
      sum += point.heat[0];
    }
    Point point(text_of(all));
    ASSERT_EQ(point.evaluate(x, gap), ENTS_OK);
    EXPECT_NEAR(point.heat[0], sum, 1e-12);
    EXPECT_NEAR(point.residual[2], sum, 1e-12);
    EXPECT_NEAR(point.residual[5], -0.3 * sum, 1e-12);
    EXPECT_NEAR(point.residual[8], -0.7 * sum, 1e-12);
  }
}

// mu N v, split as asked; the mechanics are those without heat, to the last bit.
TEST(Heat, FrictionHeatsWithTheWorkThatItDissipates) {
  double worst[3] = {};
  for (const double slave : {0.0, 0.3, 1.0}) {
    Point point(text_of({{"friction", {{"share", 0.9}, {"slave", slave}}}}, coulomb)),
        cold(text_of(nullptr, coulomb));
    const double depth = 0.02, step = 0.05, N = 0.7 * eps * depth;
    double x = -0.8;
    for (int i = 0; i < 20; ++i, x += step) {
      ASSERT_EQ(point.evaluate(x, -depth), ENTS_OK);
      if (i > 2) { // the elastic slip is full
        const double power = 0.9 * mu * N * step / 0.1;
        test::raise(worst[0], std::fabs(point.heat[1] / power - 1.0));
        test::raise(worst[1], std::fabs(point.dissipation / (mu * N * step) - 1.0));
        test::raise(worst[2], std::fabs(point.residual[2] + slave * power) / power);
        EXPECT_NEAR(point.friction_energy, 0.5 * mu * N * mu * N / (0.7 * k_t), 1e-12);
        EXPECT_NEAR(point.residual[2] + point.residual[5] + point.residual[8], -point.heat[1], 1e-14);
      }
      point.commit();
    }
  }
  test::expect_measured("power of a dragged point against mu N v", worst[0], 1e-10);
  test::expect_measured("dissipation against mu N times the way", worst[1], 1e-10);
  test::expect_measured("share of the slave", worst[2], 1e-10);
}

// A patch has the numbers of its segment, and a rigid master those of a deformable one in the slave's rows.
TEST(Heat, OfPatchesAndRigidMasters) {
  const json heat = {{"power", {{"coefficient", 2.0}, {"pressure", 5.0}, {"exponent", 0.95}}}};
  const Handle one = make(text_of(heat)), patch = make(text_of(heat, nullptr, {{"patch", {{0, 1}, {1, 2}}}})),
               rigid = make(text_of(heat, nullptr, {{"master", "rigid"}}));
  ASSERT_EQ(layout_of(one.get()).dofs, 9);
  ASSERT_EQ(layout_of(patch.get()).dofs, 12);
  ASSERT_EQ(layout_of(rigid.get()).dofs, 3);
  ASSERT_EQ(layout_of(rigid.get()).node_dofs, 3);
  const double slave[2] = {0.4, -0.02}, slave_temperature = 7.0;
  const double positions[6] = {-1, 0.1, 0, 0, 1, 0.05}, temperature[3] = {1, 2, 4};
  double r[3][12], k[3][144];
  const Handle* models[] = {&one, &patch, &rigid};
  for (int i = 0; i < 3; ++i) {
    const int skip = i == 1 ? 0 : 1;
    ents_input in{};
    in.struct_size = sizeof in, in.slave = slave, in.master = positions + 2 * skip;
    in.slave_temperature = &slave_temperature, in.master_temperature = temperature + skip;
    ents_output out{};
    out.struct_size = sizeof out, out.wanted = ENTS_RESIDUAL | ENTS_TANGENT, out.residual = r[i],
    out.tangent = k[i];
    ASSERT_EQ(ents_evaluate(models[i]->get(), 0, 1, &in, &out, nullptr), ENTS_OK);
  }
  const auto of_patch = [](int dof) { return dof < 3 ? dof : dof + 3; };
  EXPECT_GT(std::fabs(r[0][2]), 1.0);
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(r[0][i], r[1][of_patch(i)], 1e-13);
    for (int j = 0; j < 9; ++j)
      EXPECT_NEAR(k[0][9 * j + i], k[1][12 * of_patch(j) + of_patch(i)], 1e-11) << i << " " << j;
  }
  for (int i = 3; i < 6; ++i) EXPECT_EQ(r[1][i], 0.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(r[0][i], r[2][i], 1e-14);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(k[0][9 * j + i], k[2][3 * j + i], 1e-12);
  }
}

// Beside the segment nothing flows; a multiplier is held at zero there.
TEST(Heat, NothingFlowsBesideTheSegment) {
  for (const char* law : {"penalty", "augmented_multiplier"}) {
    const json normal = {{"type", law}, {"stiffness", eps}};
    const Handle model = make(
        {{"segment", "line2"},
         {"contact", {{"normal", normal}, {"heat", {{"gas", {{"conductivity", 1.0}, {"jump", 0.1}}}}}}}});
    const ents_layout layout = layout_of(model.get());
    const int n = layout.dofs, multipliers = layout.multipliers;
    const double slave[2] = {7.0, 0.1}, master[4] = {-1, 0, 1, 0}, temperature[2] = {1, 2}, start = 0.9,
                 lambda = 0.5;
    std::vector<double> residual(static_cast<std::size_t>(n), 9.0),
        tangent(static_cast<std::size_t>(n * n), 9.0);
    double heat[2] = {9.0, 9.0};
    ents_input in{};
    in.struct_size = sizeof in, in.slave = slave, in.master = master, in.start = &start;
    in.slave_temperature = temperature, in.master_temperature = temperature;
    if (multipliers) in.multiplier = &lambda;
    ents_output out{};
    out.struct_size = sizeof out, out.wanted = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_HEAT;
    out.residual = residual.data(), out.tangent = tangent.data(), out.heat = heat;
    ASSERT_EQ(ents_evaluate(model.get(), 0, 1, &in, &out, nullptr), ENTS_OK);
    EXPECT_EQ(heat[0], 0.0);
    EXPECT_EQ(heat[1], 0.0);
    for (int i = 0; i < n; ++i) {
      const bool held = i == n - 1 && multipliers == 1;
      EXPECT_EQ(residual[static_cast<std::size_t>(i)], held ? -lambda / eps : 0.0) << i;
      for (int j = 0; j < n; ++j)
        EXPECT_EQ(tangent[static_cast<std::size_t>(j * n + i)], held && j == i ? -1.0 / eps : 0.0)
            << i << " " << j;
    }
  }
}

// Heat changes no bit of the mechanics.
TEST(Heat, LeavesTheMechanicsAlone) {
  Random random(5);
  for (const Basis& basis : mechanics::all_bases()) {
    const mechanics::Scene scene = draw_scene(random, basis, "sine", "normal");
    Method method = laws::coulomb;
    const mechanics::Model cold = model_of(scene, method);
    method.heat = {{"conductance", 1.0}, {"friction", json::object()}};
    const mechanics::Model warm = model_of(scene, method);
    LawElements e = draw(random, scene, warm, 40, 0.05);
    LawResults hot, plain;
    evaluate_near(warm.handle(), e, ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS | ENTS_STATE | ENTS_GAP, hot);
    const ents_layout with = e.layout;
    e.layout = layout_of(cold.handle());
    const auto n = static_cast<std::size_t>(e.layout.dofs), all = static_cast<std::size_t>(with.dofs),
               d = static_cast<std::size_t>(with.dimension);
    for (std::size_t i = 0; i < 40; ++i) { // one by one, as elements with heat are
      const LawElements single = part(e, static_cast<std::int64_t>(i), 1);
      evaluate_near(cold.handle(), single, ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS | ENTS_STATE | ENTS_GAP,
                    plain);
      const auto place = [d](std::size_t dof) { return dof / d * (d + 1) + dof % d; };
      for (std::size_t row = 0; row < n; ++row) {
        ASSERT_EQ(plain.residual[row], hot.residual[i * all + place(row)]) << basis.name;
        for (std::size_t column = 0; column < n; ++column)
          ASSERT_EQ(plain.tangent[column * n + row],
                    hot.tangent[(i * all + place(column)) * all + place(row)]);
      }
    }
  }
}

TEST(Heat, NamesWhatIsWrong) {
  const auto refused = [](const json& heat, const std::string& words, const json& friction = nullptr) {
    try {
      make(text_of(heat, friction));
      ADD_FAILURE() << heat << " is taken";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused({{"conductance", -1.0}}, "/contact/heat/conductance");
  refused(json::object(), "/contact/heat: is empty");
  refused({{"gas", {{"conductivity", 1.0}, {"jump", 0.0}}}}, "/contact/heat/gas/jump");
  refused({{"table", {{"pressures", {0, 1, 1}}, {"conductances", {1, 2, 3}}}}},
          "/contact/heat/table/pressures/2");
  refused({{"table", {{"pressures", {1, 2}}, {"conductances", {1, 2}}}}}, "a table begins at 0");
  refused({{"clearance", {{"gaps", {0, 1}}, {"conductances", {2, 1}}}}}, "the last one is 0");
  refused({{"friction", json::object()}}, "needs friction");
  refused({{"friction", {{"slave", 1.5}}}}, "/contact/heat/friction/slave", coulomb);
  refused({{"radiation", 1.0}}, "/contact/heat/radiation");

  const Handle model = make(text_of({{"conductance", 1.0}, {"friction", json::object()}}, coulomb));
  const double slave[2] = {0.0, -0.01}, master[4] = {-1, 0, 1, 0}, temperature[2] = {1, 2},
               nan = std::nan("");
  double residual[9];
  ents_input in{};
  in.struct_size = sizeof in, in.slave = slave, in.master = master;
  ents_output out{};
  out.struct_size = sizeof out, out.wanted = ENTS_RESIDUAL, out.residual = residual;
  const auto says = [&](std::int32_t status, const std::string& words) {
    ents_report report = mechanics::new_report();
    EXPECT_EQ(ents_evaluate(model.get(), 0, 1, &in, &out, &report), status);
    EXPECT_NE(std::string(report.message).find(words), std::string::npos) << report.message;
  };
  says(ENTS_NULL_ARGUMENT, "input.slave_temperature");
  in.slave_temperature = temperature;
  says(ENTS_NULL_ARGUMENT, "input.master_temperature");
  in.master_temperature = temperature;
  says(ENTS_BAD_VALUE, "input.time_increment");
  in.time_increment = 0.1;
  says(ENTS_OK, "");
  in.slave_temperature = &nan;
  says(ENTS_NON_FINITE, "input.slave_temperature[0]");
  // A part of the whole, also where a parameter stands for it
  const Handle named =
      make(text_of({{"friction", {{"share", "k"}}}}, coulomb, {{"parameters", {{"k", 0.5}}}}));
  ents_model* bound = nullptr;
  for (const double share : {-0.1, 1.1})
    EXPECT_EQ(ents_model_bind(named.get(), &share, nullptr, 0, &bound, nullptr), ENTS_BAD_VALUE) << share;
  EXPECT_EQ(bound, nullptr);
  const double share = 0.25;
  EXPECT_EQ(ents_model_bind(named.get(), &share, nullptr, 0, &bound, nullptr), ENTS_OK);
  const Handle owned(bound);
  Point quarter(text_of({{"friction", {{"share", 0.25}}}}, coulomb)),
      whole(text_of({{"friction", json::object()}}, coulomb));
  for (Point* point : {&quarter, &whole})
    for (const double x : {0.0, 0.1}) {
      ASSERT_EQ(point->evaluate(x, -0.02), ENTS_OK);
      point->commit();
    }
  EXPECT_GT(whole.heat[1], 0.0);
  EXPECT_NEAR(quarter.heat[1], 0.25 * whole.heat[1], 1e-15);
  const Handle cold = make(text_of(nullptr, coulomb));
  ents_report report = mechanics::new_report();
  EXPECT_EQ(ents_evaluate(cold.get(), 0, 1, &in, &out, &report), ENTS_BAD_VALUE);
  EXPECT_NE(std::string(report.message).find("input.slave_temperature"), std::string::npos) << report.message;
  in.slave_temperature = in.master_temperature = nullptr;
  out.wanted = ENTS_HEAT;
  EXPECT_EQ(ents_evaluate(cold.get(), 0, 1, &in, &out, &report), ENTS_BAD_MASK);
}

} // namespace
} // namespace laws::heat_test
