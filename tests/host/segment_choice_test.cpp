// SPDX-License-Identifier: BSD-3-Clause
// Which segment a slave node belongs to where two plain ones meet.
#include <gtest/gtest.h>

#include "support.hpp"

namespace host::segment_choice_test {
namespace {

using test::axis;

/// A soft block of 2 x 2 cells pressed into a groove of two plain segments; the middle node of its three is
/// `offset` beside the groove's bottom.
Json block_in_groove(double offset) {
  return {{"dimension", 2},
          {"formulation", "plane_strain"},
          {"materials", {{"m", {{"law", "linear_elastic"}, {"young", 1}, {"poisson", 0.3}}}}},
          {"parts",
           {{{"name", "b"},
             {"material", "m"},
             {"element", "quad4"},
             {"x", axis(offset - 0.5, offset + 0.5, 2)},
             {"y", axis(-0.5, 0, 2)}}}},
          {"supports", {{{"nodes", "b.y_min"}, {"x", 0}, {"y", 0}}}},
          {"contact",
           {{"slave", "b.y_max"},
            {"master", {{"nodes", {{1, 0.02}, {-1, 0.02}}}, {"direction", {0, -1}}}},
            {"model",
             {{"segment", "line2"},
              {"surface_coordinates", {{1}, {-1}}},
              {"height", {{"type", "polynomial"}, {"coefficients", {0, 0, 0.2}}}},
              {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 30}}}}}}}}},
          {"steps", {{"control", "approach"}, {"values", {0.1}}}}};
}

// Pressed below the bottom, a node is ahead of neither segment, and each pushes it over to the other: without
// the rule that it stays in the margin of its own one, Newton's iteration alternates for ever, however small
// the step.
TEST(SegmentChoice, ANodeAtTheBottomOfAGrooveStaysWithOneSegment) {
  const Scene scene = test::scene_from(block_in_groove(0.02));
  Simulation simulation(scene, &test::library(), 2);
  const std::vector<StepRecord> records = solve(simulation, {});
  ASSERT_EQ(records.size(), 1u);
  EXPECT_EQ(records[0].increments.size(), 1u); // the step was not cut
  EXPECT_EQ(records[0].contact_fraction, 1);   // nor did a node slip through
}

} // namespace
} // namespace host::segment_choice_test
