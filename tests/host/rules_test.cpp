// SPDX-License-Identifier: BSD-3-Clause
// Rules of a scene: supports that turn, and surface coordinates.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "sliding.hpp"

namespace host::rules_test {
namespace {

using std::numbers::pi;

/// A block whose base moves and turns, with nothing else on it.
Json turned(int dimension, const Json& support) {
  Json json{{"dimension", dimension},
            {"materials", {{"m", {{"law", "neo_hooke"}, {"young", 1000}, {"poisson", 0.3}}}}},
            {"parts",
             {{{"name", "b"},
               {"material", "m"},
               {"element", dimension == 2 ? "quad4" : "hex8"},
               {"x", test::axis(0, 1, 3)},
               {"y", test::axis(0, 0.5, 2)}}}},
            {"supports", {support}},
            {"steps", {{"control", "load_factor"}, {"values", {{{"to", 1}, {"count", 8}}}}}}};
  if (dimension == 2) json["formulation"] = "plane_strain";
  if (dimension == 3) json["parts"][0]["z"] = test::axis(0, 0.4, 2);
  return json;
}

// Everything follows its base as a rigid body, without a stress, on the exact rotation of each increment.
TEST(TurnedSupport, TurnsABodyAsAWhole) {
  for (const int d : {2, 3}) {
    Json support{{"nodes", "b.y_min"}, {"x", 0.3}, {"y", -0.1}, {"about", {0.2, -0.3}}};
    if (d == 2) support["turn"] = 2.5;
    if (d == 3)
      support.update({{"about", {0.2, -0.3, 0.1}}, {"turn_x", 0.8}, {"turn_y", -1.5}, {"turn_z", 1.2}});
    const Scene scene = test::scene_from(turned(d, support));
    Simulation simulation(scene, nullptr);
    const std::vector<StepRecord> records = solve(simulation, {});
    EXPECT_EQ(records.size(), 8u);
    const Eigen::Vector3d turn = d == 2 ? Eigen::Vector3d(0, 0, 2.5) : Eigen::Vector3d(0.8, -1.5, 1.2),
                          about(0.2, -0.3, d == 3 ? 0.1 : 0), shift(0.3, -0.1, 0);
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    const Mesh& mesh = simulation.mesh();
    for (int node = 0; node < mesh.node_count(); ++node) {
      Eigen::Vector3d x = Eigen::Vector3d::Zero();
      for (int i = 0; i < d; ++i) x[i] = mesh.node(node)[static_cast<std::size_t>(i)];
      const Eigen::Vector3d moved = about + shift + rotation * (x - about) - x;
      for (int i = 0; i < d; ++i)
        EXPECT_NEAR(simulation.now().displacement[static_cast<std::size_t>(node * d + i)], moved[i], 1e-11);
    }
  }
}

TEST(TurnedSupport, MistakesAreNamed) {
  const auto expect = [](const Json& json, const char* text) {
    EXPECT_NE(test::refusal(json).find(text), std::string::npos) << test::refusal(json);
  };
  const Json support{{"nodes", "b.y_min"}, {"turn", 1}};
  Json json = turned(2, support);
  json["materials"]["m"]["law"] = "linear_elastic";
  expect(json, "/supports/0: a turn strains a body of linear_elastic; take st_venant_kirchhoff or neo_hooke");
  json = turned(2, support);
  json["formulation"] = "axisymmetric";
  expect(json, "/supports/0: a body round an axis has no turns");
  json = turned(3, support);
  expect(json, "or a turn: turn_x, turn_y, turn_z");
  json = turned(2, {{"nodes", "b.y_min"}, {"x", 0}, {"about", {0, 0}}});
  expect(json, "about");
}

// The upper side is the cylinder, the base is flat, and the grid between them goes along.
TEST(Crown, IsACylinder) {
  for (const int d : {2, 3}) {
    Json json = turned(d, {{"nodes", "b.y_min"}, {"x", 0}, {"y", 0}});
    json["parts"][0]["x"] = test::axis(-0.5, 0.5, 4);
    json["parts"][0]["crown"] = {{"radius", 0.8}};
    if (d == 3) json["parts"][0]["crown"]["across"] = "y";
    const Scene scene = test::scene_from(json);
    const Simulation simulation(scene, nullptr);
    const Mesh& mesh = simulation.mesh();
    const double low = 0, high = d == 2 ? 0.5 : 0.4;
    std::size_t top = 0;
    for (int node = 0; node < mesh.node_count(); ++node) {
      const auto x = mesh.node(node);
      const double across = d == 2 ? x[0] : x[1], crown = std::sqrt(0.64 - across * across) - 0.8;
      const double share = (x.back() - low) / (high + crown - low); // 0, 1/2 or 1 of two cells
      EXPECT_NEAR(share, std::round(2 * share) / 2, 1e-14);
      top += share > 0.75;
    }
    EXPECT_EQ(top, mesh.node_sets.at(d == 2 ? "b.y_max" : "b.z_max").size());
    json["parts"][0]["crown"]["radius"] = 0.4;
    EXPECT_NE(test::refusal(json).find("/parts/0/crown: the cylinder does not cover the block"),
              std::string::npos)
        << test::refusal(json);
  }
}

CoordinateRule rule_of(const Json& json, int dimension) {
  return read_coordinate_rule(JsonValue(json, "test: "), dimension);
}

// Those that a cylinder has by itself, but for whole turns of a segment.
TEST(SurfaceCoordinates, OfACylinder) {
  for (const char* segment : {"quad4", "bspline16"})
    for (const int around : {4, 7, 24}) {
      const Json json{
          {"cylinder", {{"radius", 2}, {"from", -1}, {"to", 3}, {"around", around}, {"along", 2}}}};
      const RigidBodySpec body = read_rigid_body(JsonValue(json, "test: "), 3, segment);
      const std::size_t nodes = segment[0] == 'q' ? 4 : 16;
      const std::vector<double> found = surface_coordinates(rule_of({{"cylinder", Json::object()}}, 3), 3,
                                                            body.positions, body.connectivity, nodes);
      const std::vector<double>& own = body.surface_coordinates;
      ASSERT_EQ(found.size(), own.size());
      for (std::size_t first = 0; first < own.size(); first += 2 * nodes) {
        const double turns = std::round((found[first] - own[first]) / (2 * pi)) * 2 * pi;
        for (std::size_t i = 0; i < 2 * nodes; i += 2) {
          EXPECT_NEAR(found[first + i] - turns, own[first + i], 1e-12) << segment << around;
          EXPECT_NEAR(found[first + i + 1], own[first + i + 1], 1e-12);
        }
      }
    }
}

TEST(SurfaceCoordinates, OfADiscAndAWheel) {
  const std::vector<double> points{5, 3, 1, 7, 3, 1, 7, 5, 1, 5, 5, 1};
  const std::vector<double> polar = surface_coordinates(
      rule_of({{"polar", {{"axis", "z"}, {"point", {5, 4, 0}}}}}, 3), 3, points, {0, 1, 2, 3}, 4);
  EXPECT_NEAR(polar[0], 1, 1e-15);
  EXPECT_NEAR(polar[1], -pi / 2, 1e-15);
  EXPECT_NEAR(polar[2], std::sqrt(5), 1e-15);
  EXPECT_NEAR(polar[5], std::atan2(1, 2), 1e-15);
  const std::vector<double> angle =
      surface_coordinates(rule_of({{"polar", Json::object()}}, 2), 2, {-1, 0.1, -1, -0.1}, {0, 1}, 2);
  EXPECT_NEAR(angle[1] - angle[0], 2 * std::atan(0.1), 1e-15); // over the seam of atan2
}

TEST(SurfaceCoordinates, AlongALine) {
  const std::vector<double> points{0, 0, 3, 4, 3, 6, 0, 6};
  // in any order of the segments, from the beginning of the line
  EXPECT_EQ(surface_coordinates(rule_of("arc_length", 2), 2, points, {1, 2, 0, 1, 2, 3}, 2),
            (std::vector<double>{5, 7, 0, 5, 7, 10}));
  // closed and smoothed: four control points, the second and third of which are the segment's
  EXPECT_EQ(surface_coordinates(rule_of("arc_length", 2), 2, {0, 0, 2, 0, 2, 2, 0, 2},
                                {0, 1, 2, 3, 1, 2, 3, 0, 2, 3, 0, 1, 3, 0, 1, 2}, 4),
            (std::vector<double>{-2, 0, 2, 4, 0, 2, 4, 6, 2, 4, 6, 8, 4, 6, 8, 10}));
  EXPECT_THROW(surface_coordinates(rule_of("arc_length", 2), 2, points, {0, 1, 2, 3}, 2), InputError);
  EXPECT_THROW(surface_coordinates(rule_of({{"polar", Json::object()}}, 2), 2, points, {0, 1}, 2),
               InputError);
  EXPECT_THROW(rule_of("arc_length", 3), InputError);
  EXPECT_THROW(rule_of("length", 2), InputError);
  EXPECT_THROW(rule_of({{"cylinder", Json::object()}}, 2), InputError);
}

// On a flat surface that is x, from the other end.
TEST(SurfaceCoordinates, OfFacesOfABody) {
  std::vector<double> forces;
  for (const Json& rule : {Json{"x"}, Json("arc_length")}) {
    Json json = test::sliding(test::penalty, nullptr);
    json["contact"]["master"]["surface_coordinates"] = rule;
    json["contact"]["model"]["height"] = {
        {"type", "sine"}, {"amplitude", 0.003}, {"wave_vector", {2}}, {"phase", pi / 2}};
    json["steps"]["values"] = {1, 1.2};
    const Scene scene = test::scene_from(json);
    Simulation simulation(scene, &test::library());
    const std::vector<double> force = solve(simulation, {}).back().fields.node_forces;
    if (forces.empty()) forces = force;
    for (std::size_t i = 0; i < force.size(); ++i) EXPECT_NEAR(force[i], forces[i], 1e-9);
  }
  EXPECT_GT(*std::max_element(forces.begin(), forces.end()), 0.003);
}

} // namespace
} // namespace host::rules_test
