// A normal law given by points, and its scale in each slave node.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "law_elements.hpp"

namespace laws::table_test {
namespace {

const std::vector<double> gaps = {-0.05, -0.02, 0.0, 0.01, 0.04}, pressures = {9.0, 2.5, 1.0, 0.4, 0.0};

json law(const json& friction = nullptr) {
  return {{"normal", {{"type", "table"}, {"gap", gaps}, {"pressure", pressures}}}, {"friction", friction}};
}

struct Answer {
  std::int32_t status = 0;
  double pressure = 0, energy = 0, residual[6] = {}, tangent[36] = {};
};

// Slaves above a line from (-1, 0) to (1, 0), at these gaps with these scales (empty: null), in one call
std::vector<Answer> answers(const mechanics::Model& model, const std::vector<double>& at,
                            const std::vector<double>& scale) {
  std::vector<double> slave, values;
  for (std::size_t k = 0; k < at.size(); ++k) slave.insert(slave.end(), {0.3, at[k]});
  for (const double r : scale) values.insert(values.end(), {0.0, 1.0, 1.0, r});
  const double master[4] = {-1, 0, 1, 0}, start = 0.3, area = 0.7;
  std::vector<Answer> to(at.size());
  constexpr std::int64_t stride = sizeof(Answer) / sizeof(double);
  ents_input in{};
  in.struct_size = sizeof in, in.slave = slave.data(), in.slave_stride = 2, in.master = master;
  in.start = &start, in.area = &area;
  if (!values.empty()) in.slave_values = values.data(), in.slave_values_stride = 4;
  ents_output out{};
  out.struct_size = sizeof out, out.wanted = ENTS_PRESSURE | ENTS_ENERGY | ENTS_RESIDUAL | ENTS_TANGENT;
  out.pressure = &to[0].pressure, out.pressure_stride = stride, out.energy = &to[0].energy,
  out.energy_stride = stride, out.residual = to[0].residual, out.residual_stride = stride,
  out.tangent = to[0].tangent, out.tangent_stride = stride;
  ents_report report{};
  report.struct_size = sizeof report;
  const std::int32_t status =
      ents_evaluate(model.handle(), 0, static_cast<std::int64_t>(at.size()), &in, &out, &report);
  EXPECT_EQ(status, ENTS_OK) << report.message;
  return to;
}

mechanics::Model line(const json& contact) {
  return mechanics::Model(json{{"segment", "line2"}, {"contact", contact}}.dump());
}

TEST(Table, GoesThroughItsPointsAndFallsBetweenThem) {
  const mechanics::Model model = line(law());
  std::vector<double> at = gaps;
  for (int i = 0; i <= 200; ++i) at.push_back(-0.07 + 0.0006 * i);
  const std::vector<Answer> found = answers(model, at, {});
  for (std::size_t i = 0; i < gaps.size(); ++i) EXPECT_NEAR(found[i].pressure, pressures[i], 1e-14);
  for (std::size_t k = gaps.size() + 1; k < at.size(); ++k) {
    if (at[k] < gaps.back()) {
      EXPECT_LT(found[k].pressure, found[k - 1].pressure) << at[k];
    } else {
      EXPECT_EQ(found[k].pressure, 0.0);
    }
    // Simpson's rule is exact for the cubic and its derivative between two points.
    const std::vector<Answer> middle = answers(model, {0.5 * (at[k] + at[k - 1])}, {});
    bool within = true;
    for (const double gap : gaps) within = within && !(gap > at[k - 1] && gap < at[k]);
    if (!within) continue;
    const double work =
        0.7 * (at[k] - at[k - 1]) / 6 * (found[k - 1].pressure + 4 * middle[0].pressure + found[k].pressure);
    EXPECT_NEAR(found[k - 1].energy - found[k].energy, work, 1e-14) << at[k];
    const double rise =
        (at[k] - at[k - 1]) / 6 *
        (found[k - 1].tangent[7] + 4 * middle[0].tangent[7] + found[k].tangent[7]); // of the area
    EXPECT_NEAR(0.7 * (found[k - 1].pressure - found[k].pressure), rise, 1e-13) << at[k];
  }
  // a straight line before the first point
  const std::vector<Answer> deep = answers(model, {-0.05, -0.06, -0.08}, {});
  EXPECT_NEAR((deep[1].pressure - deep[0].pressure) / 0.01, (deep[2].pressure - deep[1].pressure) / 0.02,
              1e-10);
}

// r p(g / r), r^2 W(g / r), p'(g / r): alone and among others, to the bit
TEST(Table, ScaleOfASlaveNode) {
  const mechanics::Model model = line(law());
  std::vector<double> at, scale, reduced;
  for (int i = 0; i < 43; ++i) {
    scale.push_back(0.4 + 0.05 * i);
    at.push_back(-0.08 + 0.003 * i);
    reduced.push_back(at.back() / scale.back());
  }
  const std::vector<Answer> all = answers(model, at, scale), plain = answers(model, reduced, {});
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double r = scale[k];
    EXPECT_NEAR(all[k].pressure, r * plain[k].pressure, 1e-13) << k;
    EXPECT_NEAR(all[k].energy, r * r * plain[k].energy, 1e-14) << k;
    EXPECT_NEAR(all[k].tangent[7], plain[k].tangent[7], 1e-11) << k;
    const std::vector<Answer> one = answers(model, {at[k]}, {r});
    EXPECT_EQ(std::memcmp(one.data(), &all[k], sizeof(Answer)), 0) << k;
  }
}

TEST(Table, WrongScalesAndTablesAreNamed) {
  const auto message = [](const json& contact) {
    ents_model* model = nullptr;
    ents_report report{};
    report.struct_size = sizeof report;
    const json text = {{"segment", "line2"}, {"contact", contact}};
    EXPECT_NE(ents_model_create(text.dump().c_str(), -1, nullptr, nullptr, 0, &model, &report), ENTS_OK);
    return std::string(report.message);
  };
  const auto table = [](const json& gap, const json& pressure) {
    return json{{"normal", {{"type", "table"}, {"gap", gap}, {"pressure", pressure}}}};
  };
  EXPECT_NE(message(table({0, 1, 1}, {2, 1, 0})).find("/contact/normal/gap/2: is 1.0, not above"),
            std::string::npos);
  EXPECT_NE(message(table({0, 1}, {2, 2})).find("/contact/normal/pressure/1"), std::string::npos);
  EXPECT_NE(message(table({0, 1}, {2, 1})).find("the last pressure is 0"), std::string::npos);
  EXPECT_NE(message(table({0, 1}, {2, 1, 0})).find("/contact/normal/pressure"), std::string::npos);
  EXPECT_NE(message(table({0}, {0})).find("write 2 to 1024 gaps"), std::string::npos);
  json wearing = law();
  wearing["wear"] = {{"coefficient", 1}};
  EXPECT_NE(message(wearing).find("/contact/wear: is not possible with the normal law"), std::string::npos);

  const mechanics::Model model = line(law());
  const double slave[2] = {0.3, 0.0}, master[4] = {-1, 0, 1, 0};
  ents_input in{};
  in.struct_size = sizeof in, in.slave = slave, in.master = master;
  double pressure = 0;
  ents_output out{};
  out.struct_size = sizeof out, out.wanted = ENTS_PRESSURE, out.pressure = &pressure;
  ents_report report{};
  report.struct_size = sizeof report;
  for (const double scale : {0.0, -1.0}) {
    const double values[4] = {0, 1, 1, scale};
    in.slave_values = values;
    EXPECT_EQ(ents_evaluate(model.handle(), 0, 1, &in, &out, &report), ENTS_BAD_VALUE);
    EXPECT_NE(std::strstr(report.message, "scale of the table"), nullptr) << report.message;
  }
}

} // namespace
} // namespace laws::table_test
