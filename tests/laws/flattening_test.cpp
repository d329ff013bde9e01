// Heights that give way to the pressure on them: the scale that is found, hollows, and what is refused. The
// tangent: tangent_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "law_elements.hpp"

namespace laws::flattening_test {
namespace {

constexpr double eps = 100.0, pressure_0 = 2.0, least = 0.2;

json model_with(double height) {
  const json constant = {{"type", "constant"}, {"value", height}};
  return {{"segment", "line2"},
          {"parameters", {{"flat", 1.0}}},
          {"height", {{"type", "scale"}, {"by", "flat"}, {"of", constant}}},
          {"contact",
           {{"normal", {{"type", "penalty"}, {"stiffness", eps}}},
            {"flattening", {{"scale", "flat"}, {"pressure", pressure_0}, {"least", least}}}}}};
}

struct FlattenedAnswer {
  std::int32_t status;
  double gap, pressure;
};
// A slave at height y over a line whose surface is `height` above it
FlattenedAnswer evaluate_at(double height, double y) {
  const mechanics::Model model(model_with(height).dump());
  const double slave[2] = {0.3, y}, master[4] = {-1, 0, 1, 0}, start = 0.3;
  FlattenedAnswer answer{};
  ents_input in{};
  in.struct_size = sizeof in, in.slave = slave, in.master = master, in.start = &start;
  ents_output out{};
  out.struct_size = sizeof out, out.wanted = ENTS_GAP | ENTS_PRESSURE;
  out.gap = &answer.gap, out.pressure = &answer.pressure;
  answer.status = ents_evaluate(model.handle(), 0, 1, &in, &out, nullptr);
  return answer;
}

// s - f(p(s)) of that slave, and its zeros
double miss(double height, double y, double s) {
  const double p = std::max(0.0, eps * (s * height - y));
  return s - (least + (1 - least) * std::exp(-p / pressure_0));
}
std::vector<double> scales(double height, double y) {
  std::vector<double> found;
  constexpr int steps = 4000;
  for (int i = 0; i < steps; ++i) {
    double low = least + (1 - least) * i / steps, high = least + (1 - least) * (i + 1) / steps;
    if (miss(height, y, low) > 0 || miss(height, y, high) <= 0) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (miss(height, y, middle) > 0 ? high : low) = middle;
    }
    found.push_back(low);
  }
  return found;
}

TEST(Flattening, TheScaleFollowsFromThePressure) {
  mechanics::Random random(5);
  int closed = 0, hollows = 0;
  for (int i = 0; i < 2000; ++i) {
    const double height = random.uniform(-0.02, 0.06), y = height + random.uniform(-0.06, 0.02);
    const FlattenedAnswer answer = evaluate_at(height, y);
    const std::vector<double> s = scales(height, y);
    if (eps * -height / pressure_0 * (1 - least) >= 1) continue; // may have several
    if (eps * (height - y) <= 0) {
      EXPECT_EQ(answer.status, ENTS_OK);
      EXPECT_EQ(answer.pressure, 0.0) << "open without pressure";
      continue;
    }
    ASSERT_EQ(s.size(), 1u) << height << " " << y;
    ASSERT_EQ(answer.status, ENTS_OK) << height << " " << y;
    EXPECT_NEAR(answer.gap, y - s[0] * height, 1e-14) << height << " " << y;
    EXPECT_NEAR(answer.pressure, eps * (s[0] * height - y), 1e-11) << height << " " << y;
    ++closed, hollows += height < 0;
  }
  EXPECT_GT(closed, 1000);
  EXPECT_GT(hollows, 200);
}

// A hollow that rises faster than the pressure on it could carry a slave that is open: refused where it has
// such an answer, on more than a sixteenth of the scales.
TEST(Flattening, SeveralAnswersAreRefused) {
  mechanics::Random random(6);
  int several = 0, one = 0;
  for (int i = 0; i < 4000; ++i) {
    const double height = random.uniform(-0.2, 0.05), y = height + random.uniform(0.0, 0.1);
    constexpr int steps = 1600;
    int risen = 0;
    for (int k = 0; k <= steps; ++k) risen += miss(height, y, least + (1 - least) * k / steps) > 0;
    const FlattenedAnswer answer = evaluate_at(height, y);
    if (risen == 0) {
      ++one;
      EXPECT_EQ(answer.status, ENTS_OK) << height << " " << y;
      EXPECT_EQ(answer.pressure, 0.0) << height << " " << y;
    }
    if (risen > steps / 16) {
      ++several;
      EXPECT_EQ(answer.status, ENTS_AMBIGUOUS_PROJECTION) << height << " " << y;
    }
  }
  EXPECT_GT(several, 100);
  EXPECT_GT(one, 1000);
}

// The variations of the gap are those at a fixed scale, whose gap is y - s h: 1 for the slave's y. The gap's own
// derivative is less: the surface gives way, ds/dy > 0 where h > 0. The tangent has it.
TEST(Flattening, VariationsOfTheGapAreThoseAtAFixedScale) {
  const double height = 0.05, y = 0.02, step = 1e-6;
  const mechanics::Model model(model_with(height).dump());
  const double slave[2] = {0.3, y}, master[4] = {-1, 0, 1, 0}, start = 0.3;
  double gradient[6], hessian[36], xi_gradient[6], tangent[36], gap = 0.0;
  ents_input in{};
  in.struct_size = sizeof in, in.slave = slave, in.master = master, in.start = &start;
  ents_output out{};
  out.struct_size = sizeof out;
  out.wanted = ENTS_GAP | ENTS_GAP_GRADIENT | ENTS_GAP_HESSIAN | ENTS_XI_GRADIENT | ENTS_TANGENT;
  out.gap = &gap, out.gap_gradient = gradient, out.gap_hessian = hessian, out.xi_gradient = xi_gradient;
  out.tangent = tangent;
  ASSERT_EQ(ents_evaluate(model.handle(), 0, 1, &in, &out, nullptr), ENTS_OK);
  const double share[2] = {0.5 * (1 - start), 0.5 * (1 + start)};
  const double expected[6] = {0, 1, 0, -share[0], 0, -share[1]}; // of y - s h - the height of the segment
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(gradient[i], expected[i], 1e-14) << i;
  // along the segment xi is x
  EXPECT_NEAR(xi_gradient[0], 1.0, 1e-14);
  EXPECT_NEAR(xi_gradient[2], -share[0], 1e-14);
  EXPECT_NEAR(hessian[7], 0.0, 1e-14);
  const auto difference = [&](double FlattenedAnswer::*of) {
    return (evaluate_at(height, y + step).*of - evaluate_at(height, y - step).*of) / (2 * step);
  };
  const double by_difference = difference(&FlattenedAnswer::gap);
  EXPECT_LT(by_difference, 0.9);
  EXPECT_NEAR(tangent[7], eps * by_difference, 1e-6 * eps);
}

std::string refusal(const json& text) {
  ents_model* model = nullptr;
  ents_report report{};
  report.struct_size = sizeof report;
  EXPECT_EQ(ents_model_create(text.dump().c_str(), -1, nullptr, nullptr, 0, &model, &report), ENTS_BAD_VALUE);
  ents_model_destroy(&model, nullptr);
  return report.message;
}

TEST(Flattening, MistakesAreNamed) {
  json text = model_with(0.01);
  text["parameters"]["flat"] = 0.5;
  EXPECT_NE(refusal(text).find("write 1"), std::string::npos);
  text = model_with(0.01);
  text["height"]["by"] = 0.5;
  EXPECT_NE(refusal(text).find("has to be the \"by\""), std::string::npos);
  text = model_with(0.01);
  text["contact"]["wear"] = {{"coefficient", 0.1}};
  EXPECT_NE(refusal(text).find("wear"), std::string::npos);
  text = model_with(0.01);
  text["contact"]["flattening"]["least"] = 1.0;
  EXPECT_NE(refusal(text).find("0 .. < 1"), std::string::npos);

  const mechanics::Model model(model_with(0.01).dump());
  const double half = 0.5;
  ents_model* bound = nullptr;
  ents_report report{};
  report.struct_size = sizeof report;
  EXPECT_EQ(ents_model_bind(model.handle(), &half, nullptr, 0, &bound, &report), ENTS_BAD_VALUE);
  EXPECT_NE(std::strstr(report.message, "scale of \"flattening\" is 1"), nullptr) << report.message;
}

} // namespace
} // namespace laws::flattening_test
