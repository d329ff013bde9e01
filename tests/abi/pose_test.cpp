// SPDX-License-Identifier: BSD-3-Clause
// Poses of a rigid master: spins of every size, and what is no rotation.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "support/model.hpp"

namespace pose_test {
namespace {

using namespace test;

ents_pose new_pose(int32_t dimension) {
  ents_pose pose{};
  pose.struct_size = sizeof pose;
  EXPECT_EQ(ents_pose_init(dimension, &pose, nullptr), ENTS_OK);
  return pose;
}

TEST(Pose, SmallSpinsTurnByTheSpin) {
  for (int power = -323; power <= -10; ++power)
    for (const double factor : {1.0, 3.7}) {
      const double a = factor * std::pow(10.0, power), spin[] = {0.6 * a, -0.48 * a, 0.64 * a};
      ents_pose pose = new_pose(3);
      ASSERT_EQ(ents_pose_move(3, nullptr, spin, &pose, nullptr), ENTS_OK);
      // 1 + [spin]x; the next term, of size a^2 / 2, is below 2^-64 here
      const double expected[] = {1, -spin[2], spin[1], spin[2], 1, -spin[0], -spin[1], spin[0], 1};
      for (int i = 0; i < 9; ++i)
        EXPECT_NEAR(pose.turn[i], expected[i], 1e-15 * std::fabs(expected[i]) + 1e-19)
            << "1e" << power << " entry " << i;
    }
}

TEST(Pose, SpinsThatAreNoAnglesAreRefused) {
  for (const int32_t d : {2, 3})
    for (const double a : {1e7, 1e100, 1e154, 1e308}) {
      ents_pose pose = new_pose(d);
      const ents_pose before = pose;
      ents_report report = new_report();
      const double spin[] = {a, 0, 0};
      EXPECT_EQ(ents_pose_move(d, nullptr, spin, &pose, &report), ENTS_BAD_VALUE) << a;
      EXPECT_NE(std::strstr(report.message, "spin[0] is 1e+"), nullptr) << report.message;
      EXPECT_EQ(std::memcmp(&pose, &before, sizeof pose), 0);
    }
}

TEST(Pose, AReflectionIsNoRotation) {
  for (const int32_t d : {2, 3}) {
    ents_pose pose = new_pose(d);
    pose.turn[d * d - 1] = -1.0;
    ents_report report = new_report();
    double x[] = {1, 2, 3};
    EXPECT_EQ(ents_pose_to_body(d, &pose, 1, x, x, &report), ENTS_BAD_STATE);
    EXPECT_NE(std::strstr(report.message, "reflection"), nullptr) << report.message;
    EXPECT_EQ(x[0], 1.0);
  }
}

} // namespace
} // namespace pose_test
