// SPDX-License-Identifier: BSD-3-Clause
// Arguments of ents_surface_check: mistakes have names, what is not asked for is not written, the same bits
// twice, also for a host that traps. What the numbers mean is tested in tests/mechanics.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "support/element.hpp"

namespace surface_check_test {
namespace {

using namespace test;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

class SurfaceCheck : public testing::Test {
protected:
  SurfaceCheck() {
    mesh_.struct_size = sizeof mesh_;
    mesh_.segments = 2, mesh_.nodes = 3;
    mesh_.connectivity = connectivity_, mesh_.positions = positions_;
    fresh();
  }
  void fresh() {
    result_ = {};
    result_.struct_size = sizeof result_;
    result_.samples = 9;
  }
  int32_t check() { return call::surface_check(model_.get(), &mesh_, &result_, &report_); }
  // A mistake gives this status and a message with these words, and nothing is written.
  void expect(int32_t status, const char* words) {
    const ents_surface_admissibility before = result_;
    EXPECT_EQ(check(), status) << words;
    EXPECT_NE(std::strstr(report_.message, words), nullptr) << report_.message;
    EXPECT_EQ(std::memcmp(&before, &result_, sizeof before), 0) << words;
    fresh();
  }

  Model model_{R"({"segment": "line2", "height": {"type": "constant", "value": 0.1}})"};
  int64_t connectivity_[4] = {0, 1, 1, 2};
  double positions_[6] = {0, 0, 1, 0, 2, 0.5};
  ents_master_mesh mesh_{};
  ents_surface_admissibility result_{};
  ents_report report_ = new_report();
};

TEST_F(SurfaceCheck, Answers) {
  int64_t violations[3] = {-1, -1, 77};
  result_.violations = violations;
  ASSERT_EQ(check(), ENTS_OK) << report_.message;
  const int64_t torn =
      (1 << ENTS_CHECK_JUMP) | (1 << ENTS_CHECK_EDGE) | (1 << ENTS_CHECK_CROSSING); // a concave corner
  EXPECT_EQ(result_.violated, torn);
  EXPECT_EQ(violations[0], torn);
  EXPECT_EQ(violations[1], torn);
  EXPECT_EQ(violations[2], 77);
  EXPECT_EQ(result_.violations, violations);
  EXPECT_EQ(result_.samples, 9);
  EXPECT_EQ(result_.value[ENTS_CHECK_EDGE], 0.1);
  EXPECT_EQ(result_.segment[ENTS_CHECK_JUMP], 0);
  EXPECT_EQ(result_.other[ENTS_CHECK_JUMP], 1);
  EXPECT_EQ(result_.segment[15], -1); // of a later condition
  EXPECT_EQ(result_.height_min, 0.1);
  const ents_surface_admissibility first = result_;
  fresh();
  result_.violations = violations;
  ASSERT_EQ(check(), ENTS_OK);
  EXPECT_EQ(std::memcmp(&first, &result_, sizeof first), 0);
  fresh(); // without the report and the list
  EXPECT_EQ(call::surface_check(model_.get(), &mesh_, &result_, nullptr), ENTS_OK);
  EXPECT_EQ(result_.violated, torn);
}

TEST_F(SurfaceCheck, ASurfaceWithoutSegmentsIsAdmissible) {
  mesh_.segments = 0;
  ASSERT_EQ(check(), ENTS_OK) << report_.message;
  EXPECT_EQ(result_.violated, 0);
  for (int k = 0; k < 16; ++k) EXPECT_EQ(result_.segment[k], -1);
}

TEST_F(SurfaceCheck, Mistakes) {
  EXPECT_EQ(call::surface_check(nullptr, &mesh_, &result_, &report_), ENTS_NULL_ARGUMENT);
  EXPECT_NE(std::strstr(report_.message, "'model'"), nullptr);
  EXPECT_EQ(call::surface_check(model_.get(), nullptr, &result_, &report_), ENTS_NULL_ARGUMENT);
  EXPECT_NE(std::strstr(report_.message, "'mesh'"), nullptr);
  EXPECT_EQ(call::surface_check(model_.get(), &mesh_, nullptr, &report_), ENTS_NULL_ARGUMENT);
  EXPECT_NE(std::strstr(report_.message, "'result'"), nullptr);
  for (const int32_t samples : {-1, 1, 4097}) {
    result_.samples = samples;
    expect(ENTS_BAD_COUNT, "result.samples is");
  }
  for (const double reach : {-1.0, nan_value, infinity}) {
    result_.reach = reach;
    expect(ENTS_BAD_VALUE, "result.reach is");
  }
  for (const double kink : {-1.0, nan_value, 100.0}) {
    result_.kink = kink;
    expect(ENTS_BAD_VALUE, "result.kink is");
  }
  connectivity_[3] = 3;
  expect(ENTS_BAD_VALUE, "node 1 of segment 1 is 3; nodes are 0 .. 2");
  connectivity_[3] = 2;
  positions_[5] = nan_value;
  expect(ENTS_NON_FINITE, "mesh.positions of node 2");
  positions_[5] = 0.5;
  const double s[4] = {0, 1, 1, infinity};
  mesh_.surface_coordinates = s;
  expect(ENTS_NON_FINITE, "mesh.surface_coordinates of segment 1");
  mesh_.surface_coordinates = nullptr;
  mesh_.positions = nullptr;
  expect(ENTS_NULL_ARGUMENT, "mesh.positions is null");
}

// A plain segment without a normal: which one. With a height it has none either.
TEST_F(SurfaceCheck, DegenerateSegments) {
  const Model plain(R"({"segment": "line2"})");
  positions_[4] = 1, positions_[5] = 0;
  EXPECT_EQ(call::surface_check(plain.get(), &mesh_, &result_, &report_), ENTS_DEGENERATE_SEGMENT);
  EXPECT_EQ(report_.element, 1);
}

} // namespace
} // namespace surface_check_test
