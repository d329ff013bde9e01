// SPDX-License-Identifier: BSD-3-Clause
// A stride of 0 that was forgotten gives all elements the first one's values: ents_assemble and ents_iterate
// want to be told that it is meant.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>

#include "support/surface.hpp"

namespace shared_test {
namespace {

using namespace test;

struct Array {
  const char* name;
  int64_t bit;
  int64_t ents_input::*stride;
};
const Array arrays[] = {{"slave", ENTS_SHARED_SLAVE, &ents_input::slave_stride},
                        {"segment", ENTS_SHARED_SEGMENT, &ents_input::segment_stride},
                        {"area", ENTS_SHARED_AREA, &ents_input::area_stride},
                        {"state_begin", ENTS_SHARED_STATE, &ents_input::state_begin_stride},
                        {"multiplier", ENTS_SHARED_MULTIPLIER, &ents_input::multiplier_stride},
                        {"slave_values", ENTS_SHARED_SLAVE_VALUES, &ents_input::slave_values_stride}};

TEST(Shared, AStrideOfZeroHasToBeMeant) {
  mechanics::Random random(71);
  const Surface surface(random, 3);
  const Model model(
      text_of(3, R"({"normal": {"type": "augmented_multiplier", "stiffness": 10}, "offset": 0})"));
  Found found;
  ents_report report = new_report();
  ASSERT_EQ(detect(model, surface, tree_of(model, surface), surface.slave, 0.5, found, report), ENTS_OK);
  System system(model, surface, random);
  const std::vector<double> area(Surface::slaves, 1.0), multiplier(Surface::slaves, 0.0);
  std::vector<double> states(static_cast<std::size_t>(model.layout.state_size) * Surface::slaves);
  call::state_init(model.get(), int64_t{Surface::slaves}, states.data(), int64_t{model.layout.state_size},
                   nullptr);
  std::vector<int64_t> equations(Surface::slaves, -1);
  system.clear();
  ents_system made = system.made(surface.mesh, false);
  made.multiplier_equations = equations.data();
  ents_input right{};
  right.struct_size = sizeof right;
  right.slave = surface.slave.data(), right.slave_stride = 3;
  right.mesh = &surface.mesh, right.segment = found.segment.data(), right.segment_stride = 1;
  right.area = area.data(), right.area_stride = 1;
  right.state_begin = states.data(), right.state_begin_stride = model.layout.state_size;
  right.multiplier = multiplier.data(), right.multiplier_stride = 1;
  std::vector<double> values;
  for (int i = 0; i < Surface::slaves; ++i) values.insert(values.end(), {0.0, 1.0, 1.0});
  right.slave_values = values.data(), right.slave_values_stride = 3;
  const auto assemble = [&](const ents_input& in, int64_t count) {
    return call::assemble(model.get(), int64_t{0}, count, &in, nullptr, &made, &report);
  };
  EXPECT_EQ(assemble(right, Surface::slaves), ENTS_OK) << report.message;
  for (const Array& a : arrays) {
    ents_input in = right;
    in.*a.stride = 0;
    EXPECT_EQ(assemble(in, Surface::slaves), ENTS_BAD_COUNT) << a.name;
    EXPECT_NE(std::strstr(report.message, ("input." + std::string(a.name) + "_stride is 0").c_str()), nullptr)
        << report.message;
    EXPECT_EQ(assemble(in, 1), ENTS_OK) << "one element: its strides are not read";
    in.shared = a.bit;
    EXPECT_EQ(assemble(in, Surface::slaves), ENTS_OK) << report.message;
    in.shared = 0, in.struct_size = offsetof(ents_input, shared); // an older caller
    EXPECT_EQ(assemble(in, Surface::slaves), ENTS_OK) << report.message;
  }
  ents_input in = right;
  in.shared = 1 << 20;
  EXPECT_EQ(assemble(in, Surface::slaves), ENTS_BAD_MASK);
  EXPECT_NE(std::strstr(report.message, "input.shared has unknown bits"), nullptr) << report.message;
}

// Without states friction would never act, and no number would say so.
TEST(Shared, StatesAreLeftOutOnPurposeOnly) {
  mechanics::Random random(74);
  const Surface surface(random, 2);
  const struct {
    std::string contact;
    bool history;
  } laws[] = {
      {penalty, false},
      {R"({"normal": {"type": "penalty", "stiffness": 10}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 5}})",
       true},
      {R"({"normal": {"type": "augmented", "stiffness": 10}})", true},
      {R"({"normal": {"type": "penalty", "stiffness": 10}, "wear": {"coefficient": 1e-3}})", true},
      {R"({"normal": {"type": "multiplier", "stiffness": 10}})", false}};
  for (const auto& law : laws) {
    const Model model(text_of(2, law.contact));
    const std::vector<double> tree = tree_of(model, surface), area(Surface::slaves, 1.0),
                              multiplier(Surface::slaves, 1.0);
    std::vector<int64_t> segment(Surface::slaves, -1), equations(Surface::slaves, -1);
    std::vector<double> xi(Surface::slaves);
    ents_detection detection{};
    detection.struct_size = sizeof detection;
    detection.slave = surface.slave.data(), detection.reach = 0.5;
    detection.segment = segment.data(), detection.xi = xi.data();
    ents_input in{};
    in.struct_size = sizeof in;
    in.area = area.data(), in.area_stride = 1;
    if (model.layout.multipliers > 0) in.multiplier = multiplier.data(), in.multiplier_stride = 1;
    System system(model, surface, random);
    system.clear();
    ents_system made = system.made(surface.mesh, false);
    made.multiplier_equations = equations.data();
    ents_report report = new_report();
    const auto iterate = [&] {
      std::fill(segment.begin(), segment.end(), -1);
      return call::iterate(model.get(), &surface.mesh, tree.data(), static_cast<int64_t>(tree.size()),
                           int64_t{0}, int64_t{Surface::slaves}, &detection, &in, nullptr, &made, &report);
    };
    EXPECT_EQ(iterate(), law.history ? ENTS_NULL_ARGUMENT : ENTS_OK) << law.contact << report.message;
    if (law.history) {
      EXPECT_NE(std::strstr(report.message, "ents_state_init"), nullptr) << report.message;
    }
    in.shared = ENTS_SHARED_NO_STATE;
    EXPECT_EQ(iterate(), ENTS_OK) << law.contact << report.message;
    in.shared = 0, in.struct_size = offsetof(ents_input, shared); // an older caller
    EXPECT_EQ(iterate(), ENTS_OK) << law.contact << report.message;
  }
}

TEST(Shared, IterateAsksAsAssembleDoes) {
  mechanics::Random random(73);
  const Surface surface(random, 2);
  const Model model(text_of(2, penalty));
  const std::vector<double> tree = tree_of(model, surface), area(Surface::slaves, 1.0);
  std::vector<int64_t> segment(Surface::slaves, -1);
  std::vector<double> xi(Surface::slaves), gap(Surface::slaves);
  ents_detection detection{};
  detection.struct_size = sizeof detection;
  detection.slave = surface.slave.data(), detection.reach = 0.5;
  detection.segment = segment.data(), detection.xi = xi.data();
  ents_input in{};
  in.struct_size = sizeof in;
  in.area = area.data();
  ents_output out{};
  out.struct_size = sizeof out;
  out.wanted = ENTS_GAP, out.gap = gap.data(), out.gap_stride = 1;
  ents_report report = new_report();
  const auto iterate = [&] {
    return call::iterate(model.get(), &surface.mesh, tree.data(), static_cast<int64_t>(tree.size()),
                         int64_t{0}, int64_t{Surface::slaves}, &detection, &in, &out, nullptr, &report);
  };
  EXPECT_EQ(iterate(), ENTS_BAD_COUNT);
  EXPECT_NE(std::strstr(report.message, "ENTS_SHARED_AREA in input.shared"), nullptr) << report.message;
  EXPECT_EQ(segment[0], -1) << "refused before anything is written";
  in.shared = ENTS_SHARED_AREA;
  EXPECT_EQ(iterate(), ENTS_OK) << report.message;
}

} // namespace
} // namespace shared_test
