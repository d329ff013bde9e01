// SPDX-License-Identifier: BSD-3-Clause
// Thin things: a sheet whose two sides have the same nodes, and a surface that touches itself.
#include <gtest/gtest.h>

#include "support.hpp"

namespace host::thin_test {
namespace {

/// A block above or below a rigid sheet at y = 0, far enough to be open, whatever the order of the sheet's
/// sides.
Json beside_a_sheet(bool below, bool bottom_first, const Json& height) {
  Json scene{{"dimension", 2},
             {"formulation", "plane_strain"},
             {"materials", {{"m", {{"law", "linear_elastic"}, {"young", 1000}, {"poisson", 0.3}}}}},
             {"parts",
              {{{"name", "b"},
                {"material", "m"},
                {"element", "quad4"},
                {"x", test::axis(-1, 1, 5)},
                {"y", below ? test::axis(-1.2, -0.2, 2) : test::axis(0.2, 1.2, 2)}}}},
             {"steps", {{"control", "load_factor"}, {"values", {0.4, 1}}}}};
  scene["supports"] = {{{"nodes", below ? "b.y_min" : "b.y_max"}, {"x", 0}, {"y", below ? 0.16 : -0.16}}};
  const Json up{{0, 1}, {1, 2}}, down{{1, 0}, {2, 1}};
  Json sides = bottom_first ? down : up;
  for (const Json& side : bottom_first ? up : down) sides.push_back(side);
  scene["contact"] = {
      {"slave", below ? "b.y_max" : "b.y_min"},
      {"master", {{"rigid_body", {{"nodes", {{-2, 0}, {0.1, 0}, {2, 0}}}, {"segments", sides}}}}},
      {"model",
       {{"segment", "line2"},
        {"height", height},
        {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 1e5}}}}}}}};
  return scene;
}

// The height is half the thickness, 0.05: the block is open 0.086 away from the surface, then 0.01 deep in
// it.
TEST(ThinSheet, EachSideIsFound) {
  for (const bool below : {false, true})
    for (const bool bottom_first : {false, true}) {
      const Scene scene =
          test::scene_from(beside_a_sheet(below, bottom_first, {{"type", "constant"}, {"value", 0.05}}));
      Simulation simulation(scene, &test::library());
      const std::vector<StepRecord> steps = solve(simulation, {});
      EXPECT_EQ(steps[0].peak_pressure, 0) << below << bottom_first;
      EXPECT_EQ(steps[1].contact_fraction, 1) << below << bottom_first;
      const double force = steps[1].contact_force[1]; // on the sheet
      EXPECT_GT(below ? force : -force, 5) << below << bottom_first;
    }
}

std::string refusal_of_simulation(const Json& json) {
  try {
    const Scene scene = test::scene_from(json);
    Simulation simulation(scene, &test::library());
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ThinSheet, WithoutThicknessIsRefused) {
  for (const Json& height : {Json(), Json{{"type", "constant"}, {"value", 0}},
                             Json{{"type", "sine"}, {"amplitude", 0.1}, {"wave_vector", {1}}}})
    EXPECT_NE(refusal_of_simulation(beside_a_sheet(false, false, height))
                  .find("/contact/model: two segments of the master have the same nodes"),
              std::string::npos)
        << height;
}

// Its four segments have the same four nodes, in another order each.
TEST(ThinSheet, ASmoothedRingOfFourIsNone) {
  Json scene = beside_a_sheet(false, false, Json());
  scene["contact"]["model"] = {{"segment", "bspline4"},
                               {"height", {{"type", "constant"}, {"value", 0}}},
                               {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 1e5}}}}}};
  scene["contact"]["master"] = {{"rigid_body",
                                 {{"nodes", {{0.2, -0.2}, {-0.2, -0.2}, {-0.2, 0.2}, {0.2, 0.2}}},
                                  {"segments", {{3, 0, 1, 2}, {0, 1, 2, 3}, {1, 2, 3, 0}, {2, 3, 0, 1}}}}}};
  scene["parts"][0]["x"] = test::axis(-1, 1, 8);
  scene["supports"][0]["y"] = -0.05;
  const Scene read = test::scene_from(scene);
  Simulation simulation(read, &test::library());
  EXPECT_LT(solve(simulation, {}).back().contact_force[1], -0.1);
}

/// The last step of a shipped scene of the fold, as a variant of it says.
StepRecord pressed_fold(const std::string& variant, const std::function<void(Json&)>& edit = {}) {
  return test::run(test::shipped_scene("fold", edit, variant)).back();
}

// Each leg of 0.3 is behind its own other side by less than the surface is wide. Both legs are slaves, with half of
// their areas: the pressure is whole. The half is pressed on a plane, whose normal does not bend: 2e-6.
TEST(ThinSheet, AFoldAgainstItselfIsItsHalfOnAPlane) {
  const StepRecord half = pressed_fold("half_points"), whole = pressed_fold("whole"),
                   two_pass = pressed_fold("two_pass");
  const auto carried = [](const StepRecord& step) {
    double sum = 0;
    for (std::size_t k = 0; k < step.areas.size(); ++k)
      sum += step.areas[k] * step.fields.pressure[k] * std::abs(step.fields.normal[2 * k + 1]);
    return sum;
  };
  EXPECT_NEAR(carried(whole) / carried(half), 1, 1e-5);
  EXPECT_NEAR(whole.peak_pressure / half.peak_pressure, 1, 1e-4);
  EXPECT_NEAR(whole.contact_force[1], 0, 1e-12);
  EXPECT_NEAR(-two_pass.contact_force[1] / carried(whole), 1, 1e-5);
  // Which of the two is called the slave has no effect.
  const StepRecord swapped = pressed_fold("two_pass", [](Json& scene) {
    scene["contact"]["slave"] = "fold.LOWER";
    scene["contact"]["master"] = {{"faces", "fold.UPPER"}};
  });
  EXPECT_NEAR(swapped.contact_force[1] / -two_pass.contact_force[1], 1, 1e-9);
}

// The whole boundary has waves, and meets its mirror image; the half has the same waves, on the smooth plane. Their
// slopes are up to .03: normals of the waves turn, that of the plane does not.
TEST(ThinSheet, ARoughFoldAgainstItselfIsItsHalfOnAPlane) {
  const StepRecord half = pressed_fold("rough_half"), whole = pressed_fold("rough");
  double carried = 0;
  for (std::size_t k = 0; k < whole.areas.size(); ++k)
    carried += whole.areas[k] * whole.fields.pressure[k] * std::abs(whole.fields.normal[2 * k + 1]);
  EXPECT_NEAR(carried / -half.contact_force[1], 1, 2e-3);
  EXPECT_GT(std::abs(carried / -pressed_fold("half_points").contact_force[1] - 1), 0.02)
      << "waves have an effect";
  EXPECT_NEAR(whole.contact_force[1], 0, 1e-12);
}

// Faces that meet the master's in a corner; two passes over such faces; and what a surface against itself can not have.
TEST(ThinSheet, SidesThatMeetAreRefused) {
  Json scene = beside_a_sheet(false, false, Json());
  scene["contact"]["model"].erase("height");
  scene["contact"]["slave"] = "b.x_min";
  scene["contact"]["master"] = {{"faces", "b.y_min"}};
  const auto expect = [&](const char* words) {
    const std::string refusal = refusal_of_simulation(scene);
    EXPECT_NE(refusal.find("/contact/slave"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find(words), std::string::npos) << refusal;
  };
  expect("slave and master faces share nodes");
  scene["contact"]["two_pass"] = true;
  expect("two passes need sets that do not meet");
  scene["contact"].erase("two_pass");
  scene["contact"]["slave"] = "b.y_min";
  scene["contact"]["model"]["height"] = {{"type", "constant"}, {"value", 0.05}};
  EXPECT_NE(refusal_of_simulation(scene).find("has its points inside its faces"), std::string::npos);
  scene["contact"]["sampling"] = 2;
  scene["contact"]["slave_height"] = {{"height", {{"type", "constant"}, {"value", 0.05}}},
                                      {"surface_coordinates", {"x"}}};
  EXPECT_NE(refusal_of_simulation(scene).find("its height is that of the model"), std::string::npos);
  scene["contact"].erase("slave_height");
  scene["contact"]["model"].erase("height");
  scene["contact"]["model"]["contact"]["normal"] = {{"type", "augmented"}, {"stiffness", 1.0}};
  expect("over-constraint");
}

} // namespace
} // namespace host::thin_test
