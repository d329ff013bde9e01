// SPDX-License-Identifier: BSD-3-Clause
// Heat of a contact point of Abaqus: FLUX and its derivatives, two bars, heat of friction.
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "abaqus_services.hpp"
#include "emulated_host.hpp"
#include "measured.hpp"
#include "plain_model.hpp"
#include "uinter_host.hpp"
#include "worst.hpp"

namespace adapters::heat_uinter_test {
namespace {

UinterCall point(int directions, int model, double closing, double point_temperature,
                 double face_temperature) {
  UinterCall c(directions);
  c.props[0] = model;
  c.rdisp[0] = closing;
  c.temp[0] = point_temperature, c.temp[1] = face_temperature;
  return c;
}

// FLUX flows into a surface, point first; DDFDDT is minus its derivative, DDFDDR its derivative.
TEST(HeatOfAPoint, DerivativesAreTheSlopesOfTheFlux) {
  for (const int d : {2, 3}) {
    const int model = 820 + d;
    write("ents_" + std::to_string(model) + ".json",
          std::string(R"({"segment": ")") + (d == 2 ? "line2" : "quad4") +
              R"(", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": )" +
              (d == 2 ? "[0.8]" : "[0.8, 0.3]") +
              R"(}, "contact": {"normal": {"type": "penalty", "stiffness": 500},
          "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 300},
          "heat": {"power": {"coefficient": 4, "pressure": 2, "exponent": 0.95}, "gas": {"conductivity": 0.2, "jump": 0.05},
                   "friction": {"share": 0.9, "slave": 0.3}}}})");
    UinterCall before = point(d, model, 0.02, 7, 3);
    before.place(0.15, -0.35);
    before();
    for (const double slip : {0.002, 0.05})        // sticking, slipping
      for (const double closing : {0.025, -0.1}) { // and open
        const auto at = [&](int column, double step) {
          UinterCall c = point(d, model, closing, 7, 3);
          for (std::size_t i = 0; i < c.statev.size(); ++i) c.statev[i] = before.statev[i];
          c.rdisp[1] = slip, c.rdisp[2] = d == 3 ? -0.7 * slip : 0;
          c.dtime = 0.2;
          if (column < d)
            c.rdisp[column] += step;
          else if (column <= d + 1)
            c.temp[column - d] += step;
          for (int i = 0; i < d; ++i) c.drdisp[i] = c.rdisp[i] - before.rdisp[i];
          c();
          return c;
        };
        UinterCall c = at(9, 0);
        double largest = 0;
        for (const std::size_t i : {0, 1}) EXPECT_NE(c.flux[i], 0);
        for (std::size_t i = 0; i < static_cast<std::size_t>(2 * d); ++i)
          largest = std::max(largest, std::abs(c.ddfddr[i]));
        const double step = 1e-6;
        for (int j = 0; j < d + 2; ++j) {
          UinterCall less = at(j, -step), more = at(j, step);
          for (std::size_t i = 0; i < 2; ++i) {
            const double slope = (more.flux[i] - less.flux[i]) / (2 * step);
            if (j < d)
              EXPECT_NEAR(c.ddfddr[i + 2 * static_cast<std::size_t>(j)], slope, 1e-7 * largest) << i << j;
            else
              EXPECT_NEAR(c.ddfddt[i + 2 * static_cast<std::size_t>(j - d)], -slope, 1e-7) << i << j;
          }
          for (std::size_t i = 0; i < static_cast<std::size_t>(d) && j >= d; ++i)
            EXPECT_EQ(more.stress[i], less.stress[i]) << "DDSDDT = 0";
        }
        for (std::size_t i = 0; i < static_cast<std::size_t>(2 * d); ++i) EXPECT_EQ(c.ddsddt[i], 0);
      }
  }
}

// T_out = T_in + q R: unknowns are the closing and the temperatures of point, face and far end.
TEST(HeatOfAPoint, TwoBarsAreExactInOneIteration) {
  write("ents_824.json", R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 400},
    "heat": {"conductance": 10}}})");
  constexpr double area = 1.2, upper = 3 * area / 2, lower = 5 * area / 0.7, power = 8, end = 20;
  Eigen::Vector4d x(1e-3, 0, 0, 0);
  int iterations = 0;
  for (;; ++iterations) {
    ASSERT_LT(iterations, 10);
    UinterCall c = point(2, 824, x(0), x(1), x(2));
    c();
    Eigen::Vector4d residual(area * c.stress[0] + 40 * (x(0) - 0.3), upper * (x(1) - x(3)) - area * c.flux[0],
                             lower * (x(2) - end) - area * c.flux[1], upper * (x(3) - x(1)) - power);
    if (residual.norm() < 1e-11 * power) break;
    Eigen::Matrix4d tangent = Eigen::Matrix4d::Zero();
    tangent(0, 0) = area * c.ddsddr[0] + 40;
    for (int i = 0; i < 2; ++i) {
      tangent(1 + i, 0) = -area * c.ddfddr[at(i)];
      for (int j = 0; j < 2; ++j) tangent(1 + i, 1 + j) = area * c.ddfddt[at(i + 2 * j)];
    }
    tangent(1, 1) += upper, tangent(2, 2) += lower, tangent(3, 3) = upper;
    tangent(1, 3) = tangent(3, 1) = -upper;
    x -= tangent.partialPivLu().solve(residual);
  }
  const double exact = end + power * (1 / upper + 1 / lower + 1 / (10 * area));
  test::expect_measured("two bars through UINTER against T_in + q R", std::abs(x(3) / exact - 1), 1e-10);
  EXPECT_EQ(iterations, 1);
}

// 0.9 mu p v enters the surfaces, split as asked. SFD is mu p times the slip of the increment, SED what is stored.
TEST(HeatOfAPoint, FrictionHeatsWithItsPower) {
  int model = 825;
  double worst = 0;
  for (const double share : {0.0, 0.3, 1.0}) {
    write("ents_" + std::to_string(model) + ".json",
          R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 100},
    "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 80},
    "heat": {"friction": {"share": 0.9, "slave": )" +
              std::to_string(share) + "}}}}");
    constexpr double step = 0.05, dtime = 0.1, depth = 0.02, limit = 0.3 * 100 * depth,
                     power = 0.9 * limit * step / dtime;
    std::vector<double> state(20);
    double dissipated = 0;
    for (int i = 0; i < 20; ++i) {
      UinterCall c = point(2, model, depth, 4, 1);
      c.rdisp[1] = -0.5 + step * i, c.drdisp[1] = i == 0 ? 0 : step, c.dtime = i == 0 ? 0 : dtime;
      c.place(0, 0);
      for (std::size_t k = 0; k < 20; ++k) c.statev[k] = state[k];
      c();
      for (std::size_t k = 0; k < 20; ++k) state[k] = c.statev[k];
      dissipated += c.sfd[0];
      if (i > 2) {
        test::raise(worst, std::abs(c.flux[0] - share * power) / power);
        test::raise(worst, std::abs(c.flux[1] - (1 - share) * power) / power);
        EXPECT_NEAR(c.sfd[0], limit * step, 1e-10 * limit * step);
        EXPECT_NEAR(c.sed[0], 0.5 * 100 * depth * depth + 0.5 * limit * limit / 80, 1e-12);
      }
    }
    EXPECT_NEAR(dissipated, limit * (19 * step - limit / 80), 1e-10 * dissipated);
    ++model;
  }
  test::expect_measured("power of a dragged point, split, against mu p v", worst, 1e-10);
}

TEST(HeatOfAPoint, WhatItLacksIsNamed) {
  write("ents_828.json", R"({"segment": "line2", "master": "rigid", "contact": {"normal": {"type": "penalty",
    "stiffness": 400}, "heat": {"conductance": 10}}})");
  abaqus_messages();
  UinterCall rigid = point(2, 828, 0.01, 4, 1);
  EXPECT_THROW(rigid(), HostStopped);
  const std::string text = only_message();
  EXPECT_NE(text.find("remove \"master\""), std::string::npos) << text;
  write("ents_829.json", R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 100},
    "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 80}, "heat": {"friction": {}}}})");
  UinterCall time = point(2, 829, 0.01, 4, 1);
  time.drdisp[1] = 0.01, time.dtime = 0;
  EXPECT_THROW(time(), HostStopped);
  const std::string words = only_message();
  EXPECT_NE(words.find("time_increment"), std::string::npos) << words;
}

} // namespace
} // namespace adapters::heat_uinter_test
