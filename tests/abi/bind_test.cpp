// SPDX-License-Identifier: BSD-3-Clause
// ents_model_bind: after an error the bound model is as it was; trees serve it while its height is that of
// the tree; fields are structs of any version.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "support/model.hpp"

namespace bind_test {
namespace {

using namespace test;

// A height that a parameter and a field make, a law with another parameter.
struct Bound {
  Bound() {
    EXPECT_EQ(ents_field_size(model.get(), "f", &size, nullptr), ENTS_OK);
    block.resize(static_cast<std::size_t>(size));
    EXPECT_EQ(ents_field_init(model.get(), "f", nullptr, block.data(), size, nullptr), ENTS_OK);
  }
  ~Bound() { ents_model_destroy(&handle, nullptr); }
  int32_t bind(double height, double stiffness, const std::vector<double>& of_field) {
    const double values[] = {height, stiffness};
    ents_data data{};
    data.struct_size = sizeof data, data.name = "f", data.values = of_field.data();
    data.rows = 1, data.columns = size;
    return ents_model_bind(model.get(), values, &data, 1, &handle, &report);
  }
  // gap, and forces of the slave
  std::vector<double> results() {
    const double slave[] = {0.1, 0.05}, master[] = {-1, 0, 1, 0}, start = 0.1;
    double gap = 0.0, residual[6];
    ents_input in{};
    in.struct_size = sizeof in;
    in.slave = slave, in.master = master, in.start = &start;
    ents_output out{};
    out.struct_size = sizeof out;
    out.wanted = ENTS_GAP | ENTS_RESIDUAL;
    out.gap = &gap, out.residual = residual;
    EXPECT_EQ(ents_evaluate(handle, 0, 1, &in, &out, &report), ENTS_OK) << report.message;
    return {gap, residual[0], residual[1]};
  }

  Model model{
      R"({"segment": "line2", "parameters": {"a": 0.1, "eps": 100}, "height": {"type": "sum", "of": [)"
      R"({"type": "constant", "value": "a"}, )"
      R"({"type": "field", "name": "f", "points": [8], "boundary": "clamped", "size": [2], "origin": [-1]}]}, )"
      R"("contact": {"normal": {"type": "penalty", "stiffness": "eps"}}})"};
  ents_model* handle = nullptr;
  int64_t size = 0;
  std::vector<double> block;
  ents_report report = new_report();
};

TEST(Bind, LeavesTheModelAsItWasAfterAnError) {
  Bound bound;
  ASSERT_EQ(bound.bind(0.1, 100.0, bound.block), ENTS_OK) << bound.report.message;
  const std::vector<double> before = bound.results();
  EXPECT_NEAR(before[0], -0.05, 1e-15);
  std::vector<double> no_field = bound.block;
  no_field[0] = 0.0; // its tag
  EXPECT_EQ(bound.bind(0.3, 200.0, no_field), ENTS_BAD_STATE);
  EXPECT_EQ(bound.results(), before);
  EXPECT_EQ(bound.bind(0.3, -1.0, bound.block), ENTS_BAD_VALUE);
  EXPECT_EQ(bound.results(), before);
}

// A tree is built with the model and used with the one that these values make of it: status, and the gap of a slave
// above a crest of the height.
int32_t detect_bound(const std::string& text, const std::vector<double>& values, double& gap) {
  const Model model(text);
  const int64_t connectivity[] = {0, 1};
  const double positions[] = {-1, 0, 1, 0}, slave[] = {0.25, 0.2};
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = 1, mesh.nodes = 2, mesh.connectivity = connectivity, mesh.positions = positions;
  int64_t size = 0, segment = -1;
  EXPECT_EQ(ents_tree_size(model.get(), 1, &size, nullptr), ENTS_OK);
  std::vector<double> tree(static_cast<std::size_t>(size));
  EXPECT_EQ(ents_tree_build(model.get(), &mesh, tree.data(), size, nullptr), ENTS_OK);
  ents_model* bound = nullptr;
  EXPECT_EQ(ents_model_bind(model.get(), values.data(), nullptr, 0, &bound, nullptr), ENTS_OK);
  double xi = 0.0;
  ents_detection detection{};
  detection.struct_size = sizeof detection;
  detection.slave = slave, detection.reach = 1.0, detection.segment = &segment, detection.xi = &xi;
  detection.gap = &gap;
  const int32_t status = ents_detect(bound, &mesh, tree.data(), size, 0, 1, &detection, nullptr);
  ents_model_destroy(&bound, nullptr);
  return status;
}

TEST(Bind, TreesOfTheModelServeABoundOneOfTheSameHeight) {
  const auto text = [](const char* amplitude, const char* parameters) {
    return R"({"segment": "line2", "height": {"type": "sine", "wave_vector": [1], "phase": 0, "amplitude": )" +
           std::string(amplitude) +
           R"(}, "contact": {"normal": {"type": "penalty", "stiffness": "eps"}}, "parameters": )" +
           parameters + "}";
  };
  const std::string with = text("\"a\"", R"({"a": 0.1, "eps": 100})"),
                    without = text("0.1", R"({"eps": 100})");
  double gap = 0.0;
  EXPECT_EQ(detect_bound(with, {0.1, 300.0}, gap), ENTS_OK);
  EXPECT_NEAR(gap, 0.1, 1e-15);
  EXPECT_EQ(detect_bound(with, {0.2, 300.0}, gap), ENTS_BAD_STATE);
  EXPECT_EQ(detect_bound(without, {300.0}, gap = 0.0), ENTS_OK);
  EXPECT_NEAR(gap, 0.1, 1e-15);
}

TEST(Bind, TakesFieldsOfANewerCallerAndRefusesWhatItDoesNotKnow) {
  Bound bound;
  struct Newer {
    ents_data known;
    double later;
  } newer{};
  newer.known.struct_size = sizeof newer;
  newer.known.name = "f", newer.known.values = bound.block.data(), newer.known.rows = 1;
  newer.known.columns = bound.size;
  const auto bind = [&] {
    return ents_model_bind(bound.model.get(), nullptr, &newer.known, 1, &bound.handle, &bound.report);
  };
  EXPECT_EQ(bind(), ENTS_OK) << bound.report.message;
  newer.later = 1.0;
  EXPECT_EQ(bind(), ENTS_STRUCT_SIZE);
  newer.later = 0.0, newer.known.reserved = 1;
  EXPECT_EQ(bind(), ENTS_STRUCT_SIZE);
  EXPECT_NE(std::strstr(bound.report.message, "fields.reserved is 1"), nullptr) << bound.report.message;
}

TEST(Bind, FieldsTakeWhatBindTakes) {
  Bound bound;
  std::vector<double> samples(8, 0.0), before = bound.block;
  samples[3] = 1e308;
  EXPECT_EQ(
      ents_field_init(bound.model.get(), "f", samples.data(), bound.block.data(), bound.size, &bound.report),
      ENTS_BAD_VALUE);
  EXPECT_NE(std::strstr(bound.report.message, "samples[3] is 1e+308"), nullptr) << bound.report.message;
  EXPECT_EQ(bound.block, before);
  samples[3] = 1e98;
  EXPECT_EQ(
      ents_field_init(bound.model.get(), "f", samples.data(), bound.block.data(), bound.size, &bound.report),
      ENTS_OK);
  EXPECT_EQ(bound.bind(0.1, 100.0, bound.block), ENTS_OK) << bound.report.message;
}

} // namespace
} // namespace bind_test
