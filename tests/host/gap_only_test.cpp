// SPDX-License-Identifier: BSD-3-Clause
// The baseline "gap_only": a height that changes the gap alone.
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "support.hpp"

namespace host::gap_only_test {
namespace {

/// A block pressed on a rigid line that carries a height.
Json block(const Json& height, const char* enrichment) {
  Json json = Json::parse(R"({
    "dimension": 2, "formulation": "plane_strain",
    "materials": {"block": {"law": "linear_elastic", "young": 1000, "poisson": 0.3}},
    "parts": [{"name": "block", "material": "block", "element": "quad4",
      "x": {"from": -0.5, "pieces": [{"to": 0.5, "divisions": 16}]},
      "y": {"from": 0, "pieces": [{"to": 1, "divisions": 8}]}}],
    "supports": [{"nodes": "block.y_max", "x": 0, "y": 0}],
    "contact": {"slave": "block.y_min", "master": {"nodes": [[-2, -0.1], [2, -0.1]], "direction": [0, 1]},
      "model": {"segment": "line2", "surface_coordinates": [[-2], [2]],
        "contact": {"normal": {"type": "penalty", "stiffness": 1e5}}}},
    "steps": {"control": "approach", "values": [0.08]}})");
  json["contact"]["model"]["height"] = height;
  if (enrichment) json["contact"]["enrichment"] = enrichment;
  return json;
}

TEST(GapOnly, IsTheSameForAConstantHeight) {
  const Json height{{"type", "constant"}, {"value", 0.03}};
  const StepRecord full = test::last_step(block(height, nullptr)),
                   only = test::last_step(block(height, "gap_only"));
  EXPECT_GT(full.fields.pressure[3], 1);
  for (std::size_t k = 0; k < full.fields.pressure.size(); ++k) {
    EXPECT_NEAR(only.fields.pressure[k], full.fields.pressure[k], 1e-9 * full.fields.pressure[k]) << k;
    EXPECT_NEAR(only.fields.gap[k], full.fields.gap[k], 1e-12) << k;
  }
}

// A slope pushes sideways; a gap does not.
TEST(GapOnly, HasTheNormalOfTheSegment) {
  const Json height{{"type", "polynomial"}, {"coefficients", {0.03, 0.05}}};
  const StepRecord full = test::last_step(block(height, "full")),
                   only = test::last_step(block(height, "gap_only"));
  EXPECT_LT(only.fields.force[1], -1);
  EXPECT_NEAR(only.fields.force[0], 0, 1e-10 * std::abs(only.fields.force[1]));
  EXPECT_NEAR(std::abs(full.fields.force[0] / full.fields.force[1]), 0.05, 1e-6);
  // The approach is counted from the first touch on the height, with the pressure of the overlap.
  double deepest = 0;
  for (std::size_t k = 0; k < only.fields.gap.size(); ++k) {
    deepest = std::min(deepest, only.fields.gap[k]);
    EXPECT_NEAR(only.fields.pressure[k], 1e5 * std::max(0., -only.fields.gap[k]), 1e-7) << k;
  }
  EXPECT_LT(deepest, 0);
}

TEST(GapOnly, MistakesAreNamed) {
  EXPECT_NE(test::refusal(block(nullptr, "gap_only"))
                .find("/contact/enrichment: \"gap_only\" needs a model with a \"height\""),
            std::string::npos);
  Json json = block({{"type", "constant"}, {"value", 0.1}}, "none");
  EXPECT_NE(test::refusal(json).find("/contact/enrichment"), std::string::npos);
  json["contact"]["enrichment"] = "gap_only";
  json["contact"]["model"]["parameters"] = {{"t", 0}};
  EXPECT_NE(test::refusal(json).find("without \"parameters\""), std::string::npos) << test::refusal(json);
}

} // namespace
} // namespace host::gap_only_test
