// SPDX-License-Identifier: BSD-3-Clause
// Abaqus UINTER: traction and stiffness of one point, in both argument lists.
#include <cmath>
#include <cstring>
#include <fstream>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "abaqus_services.hpp"
#include "emulated_host.hpp"
#include "uinter_host.hpp"

namespace adapters::uinter_test {
namespace {

using Call = UinterCall;

class Uinter : public testing::Test {
protected:
  void SetUp() override {
    abaqus_messages();
    std::ofstream("ents_61.json")
        << R"({"segment": "line2", "projection": {"type": "shadow_direction", "direction": [0, 1]},
      "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.8], "phase": 0.4}, "contact": {"normal": {"type": "penalty", "stiffness": 500}}})";
    std::ofstream("ents_62.json")
        << R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.8, 0.3]},
      "contact": {"normal": {"type": "penalty", "stiffness": 500}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 300}}})";
    std::ofstream("ents_63.json")
        << R"({"segment": "line2", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.8]},
      "contact": {"normal": {"type": "penalty", "stiffness": 500}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 300}}})";
  }
};

TEST_F(Uinter, FrictionlessLawAlongTheNormalIsThatOfThePotential) {
  // W(g), g = closing + h(s), s = start + slip: traction W' (1, h'), stiffness W'' (1, h')(1, h') + W' h'' in
  // the slip's place.
  for (const double slip : {-0.3, 0.0, 0.17, 0.4}) {
    Call c(2);
    c.rdisp[0] = 0.01, c.rdisp[1] = slip;
    c.place(0.25, 0);
    c();
    const double k = 2 * M_PI * 0.8, s = 0.25 + slip, h = 0.03 * std::sin(k * s + 0.4),
                 h1 = 0.03 * k * std::cos(k * s + 0.4), h2 = -k * k * h, g = 0.01 + h,
                 force = g > 0 ? 500 * g : 0, stiffness = g > 0 ? 500.0 : 0.0;
    const double expected[4] = {stiffness, stiffness * h1, stiffness * h1, stiffness * h1 * h1 + force * h2};
    EXPECT_NEAR(c.stress[0], force, 1e-12 * 500); // roundings of lengths of order one times the stiffness
    EXPECT_NEAR(c.stress[1], force * h1, 1e-12 * 500);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(c.ddsddr[i], expected[i], 1e-11 * 500) << i;
    EXPECT_EQ(c.ddsddr[1], c.ddsddr[2]) << "no UNSYMM without friction";
    EXPECT_NEAR(c.sed[0], 0.5 * force * g, 1e-12);
    EXPECT_EQ(c.lopenclose, g > 0 ? 1 : 0);
  }
}

TEST_F(Uinter, StiffnessIsTheSlopeOfTheTraction) {
  for (const int d : {2, 3}) {
    Call before(d);
    before.props[0] = d == 2 ? 63 : 62;
    before.rdisp[0] = 0.02;
    before.place(0.15, -0.35);
    before();
    for (const double slip : {0.002, 0.05}) { // sticking, slipping
      const auto at = [&](int column, double step) {
        Call c(d);
        c.props[0] = before.props[0];
        for (std::size_t i = 0; i < c.statev.size(); ++i) c.statev[i] = before.statev[i];
        c.rdisp[0] = 0.025, c.rdisp[1] = slip, c.rdisp[2] = d == 3 ? -0.7 * slip : 0;
        c.rdisp[column] += step;
        c.coords[0] = c.coords[1] = 1e9; // the start is known by now
        c();
        return c;
      };
      Call c = at(0, 0);
      const double step = 1e-6;
      bool symmetric = true;
      for (int j = 0; j < d; ++j) {
        Call less = at(j, -step), more = at(j, step);
        for (int i = 0; i < d; ++i) {
          const auto entry = static_cast<std::size_t>(i + d * j), row = static_cast<std::size_t>(i);
          // Differences: step^2 times third derivatives of 500 (2 pi 0.8)^3; roundings: 1e-14 / step.
          EXPECT_NEAR(c.ddsddr[entry], (more.stress[row] - less.stress[row]) / (2 * step), 1e-5) << i << j;
          symmetric =
              symmetric && std::abs(c.ddsddr[entry] - c.ddsddr[static_cast<std::size_t>(j + d * i)]) < 1;
        }
      }
      EXPECT_GT(c.stress[0], 0);
      EXPECT_EQ(symmetric, slip < 0.01) << "slip depends on pressure, not the other way round";
    }
  }
}

TEST_F(Uinter, BothArgumentListsAgree) {
  void* library = dlopen(ENTS_UINTER_44_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(library, nullptr) << dlerror();
  Call now(3), old(3);
  for (Call* c : {&now, &old}) {
    c->props[0] = 62;
    c->rdisp[0] = 0.02, c->rdisp[1] = 0.03, c->rdisp[2] = -0.01;
    c->place(0.1, 0.2);
  }
  now();
  old(reinterpret_cast<Uinter44*>(dlsym(library, "uinter_")));
  EXPECT_NE(now.stress[1], 0);
  EXPECT_EQ(std::memcmp(now.stress.data(), old.stress.data(), 3 * sizeof(double)), 0);
  EXPECT_EQ(std::memcmp(now.ddsddr.data(), old.ddsddr.data(), 9 * sizeof(double)), 0);
  EXPECT_EQ(std::memcmp(now.statev.data(), old.statev.data(), 20 * sizeof(double)), 0);
}

TEST_F(Uinter, NoMasterIsNoContact) {
  Call c(2);
  c.rdisp[0] = -1e36;
  c();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(c.ddsddr[i], 0);
  EXPECT_EQ(c.stress[0], 0);
  EXPECT_EQ(c.lopenclose, -1) << "not in use yet";
  EXPECT_EQ(c.statev[0], 0);
}

TEST_F(Uinter, APointThatHasLeftTheMasterLandsWithoutHistory) {
  for (const int d : {2, 3}) {
    const auto land = [&](Call& c) {
      c.rdisp[0] = 0.02, c.rdisp[1] = 0.7, c.rdisp[2] = -0.2;
      c.place(0.9, 0.4);
      c();
    };
    Call fresh(d), back(d);
    fresh.props[0] = back.props[0] = d == 2 ? 63 : 62;
    land(fresh);
    back.rdisp[0] = 0.02;
    back.place(0.15, -0.35);
    back();
    ASSERT_EQ(back.statev[0], 1);
    back.rdisp[0] = -1e36;
    back();
    EXPECT_EQ(back.lopenclose, 0);
    for (std::size_t i = 0; i < back.statev.size(); ++i) EXPECT_EQ(back.statev[i], 0) << i;
    land(back);
    const auto n = static_cast<std::size_t>(d);
    EXPECT_GT(fresh.stress[0], 0);
    EXPECT_EQ(std::memcmp(back.stress.data(), fresh.stress.data(), n * sizeof(double)), 0);
    EXPECT_EQ(std::memcmp(back.ddsddr.data(), fresh.ddsddr.data(), n * n * sizeof(double)), 0);
  }
}

TEST_F(Uinter, ALineOfTheTableIsAnElementsAndNoNodes) {
  std::ofstream("ents_64.json") << std::ifstream("ents_62.json").rdbuf();
  std::ofstream("ents_64.txt") << "17 0.5  0 0  3 0  3 2  0 2\n";
  Call listed(3), plain(3);
  listed.props[0] = 64, plain.props[0] = 62;
  for (Call* c : {&listed, &plain}) {
    c->rdisp[0] = 0.02;
    c->place(0.15, -0.35);
    (*c)();
  }
  EXPECT_GT(plain.stress[0], 0);
  EXPECT_EQ(std::memcmp(listed.stress.data(), plain.stress.data(), 3 * sizeof(double)), 0);
  Call selfcheck(3);
  selfcheck.props[0] = 64, selfcheck.props[2] = 1, selfcheck.nprops = 3;
  selfcheck.rdisp[0] = 0.02;
  selfcheck.place(0.15, -0.35);
  selfcheck();
  const auto messages = abaqus_messages();
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].text.find("17"), std::string::npos) << messages[0].text;
}

TEST_F(Uinter, OpensAndCloses) {
  Call c(2);
  for (const double closing : {-0.1, 0.1, -0.1}) {
    c.rdisp[0] = closing;
    c.place(0, 0);
    c();
    EXPECT_EQ(c.lopenclose, closing > 0 ? 1 : 0);
  }
}

TEST_F(Uinter, AMessageNamesOnePoint) {
  Call deep(3);
  deep.props[0] = 62, deep.rdisp[0] = 10;
  deep.place(0.15, -0.35);
  deep();
  EXPECT_LT(deep.pnewdt, 1);
  const auto messages = abaqus_messages();
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].text.find("element 17"), std::string::npos) << messages[0].text;
  EXPECT_EQ(messages[0].text.find("element 0"), std::string::npos) << messages[0].text;
}

TEST_F(Uinter, TheOtherArgumentListIsNoticedBeforeAnythingIsWritten) {
  void* library = dlopen(ENTS_UINTER_44_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(library, nullptr) << dlerror();
  for (const int d : {2, 3}) {
    Call now(d), old(d);
    now.props[0] = old.props[0] = d == 2 ? 63 : 62;
    now.nprops = old.nprops = d; // with the wrong list NPROPS stands where NDIR is looked for
    EXPECT_THROW(now(nullptr, reinterpret_cast<Uinter47*>(dlsym(library, "uinter_"))), HostStopped);
    EXPECT_THROW(old(reinterpret_cast<Uinter44*>(dlsym(RTLD_DEFAULT, "uinter_"))), HostStopped);
    const auto messages = abaqus_messages();
    ASSERT_EQ(messages.size(), 2u);
    EXPECT_NE(messages[0].text.find("libents_abaqus.so"), std::string::npos) << messages[0].text;
    EXPECT_NE(messages[1].text.find("libents_abaqus_uinter44.so"), std::string::npos) << messages[1].text;
    for (const Call* c : {&now, &old})
      for (const Guarded* array : {&c->stress, &c->ddsddr, &c->dviscous, &c->dstructural, &c->flux})
        array->check_untouched("an array", 0, 2);
  }
}

TEST_F(Uinter, MistakesStopTheJobWithAdvice) {
  const auto message = [](Call& c) {
    EXPECT_THROW(c(), HostStopped);
    const auto messages = abaqus_messages();
    return messages.empty() ? std::string() : messages.back().text;
  };
  Call linear(2);
  linear.linper = 1;
  EXPECT_NE(message(linear).find("perturbation"), std::string::npos);
  Call directions(2);
  directions.ndir = 4;
  EXPECT_NE(message(directions).find("NDIR = 4"), std::string::npos);
  Call coordinates(3);
  coordinates.mcrd = 2;
  EXPECT_NE(message(coordinates).find("MCRD = 2"), std::string::npos);
  Call history(3); // 9 of the model and 3 of the point
  history.props[0] = 62, history.rdisp[0] = 0.02;
  for (const int few : {0, 2, 11}) {
    history.nstatv = few;
    EXPECT_NE(message(history).find("DEPVAR=12"), std::string::npos) << few;
  }
  Call file(2);
  file.props[0] = 60;
  EXPECT_NE(message(file).find("ents_60.json"), std::string::npos);
  Call segment(2);
  segment.props[0] = 62;
  EXPECT_NE(message(segment).find("line2"), std::string::npos);
  Call face(2);
  face.props[1] = 0;
  EXPECT_NE(message(face).find("property 2"), std::string::npos);
}

} // namespace
} // namespace adapters::uinter_test
