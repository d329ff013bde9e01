// SPDX-License-Identifier: BSD-3-Clause
// A rigid body that turns about several axes at once: invariance, moments, what its turns mean, Newton's
// order.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support.hpp"

namespace host::turning_test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d vector_of(const std::vector<double>& values) { return {values[0], values[1], values[2]}; }

Json json_of(const Vector3d& v) { return {v[0], v[1], v[2]}; }

Matrix3d rotation_of(const StepRecord& record) {
  if (record.body_rotation.size() != 9) throw std::runtime_error("no rotation");
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(record.body_rotation.data());
}

/// Of the decks, as long as the program runs.
struct Folder {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("ents-turning-" + std::to_string(std::random_device{}()));
  Folder() { std::filesystem::create_directory(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

/// A block of n x n x 2 bricks below z = 0, turned by `frame`, as a deck of its own.
std::string write_block(const std::string& name, int n, const Matrix3d& frame) {
  static const Folder folder;
  const std::filesystem::path file = folder.path / name;
  std::ofstream deck(file);
  deck.precision(17);
  deck << "*NODE\n";
  const auto number = [n](int i, int j, int k) { return 1 + i + (n + 1) * (j + (n + 1) * k); };
  for (int k = 0; k <= 2; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const Vector3d x = frame * Vector3d(2. * i / n - 1, 2. * j / n - 1, 0.5 * k - 1);
        deck << number(i, j, k) << ", " << x[0] << ", " << x[1] << ", " << x[2] << "\n";
      }
  deck << "*ELEMENT, TYPE=C3D8, ELSET=ALL\n";
  std::string top;
  int element = 0;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        deck << ++element;
        for (const int up : {k, k + 1})
          for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
            deck << ", " << number(i + a, j + b, up);
        deck << "\n";
        if (k == 1) top += std::to_string(element) + ", S2\n";
      }
  deck << "*NSET, NSET=BASE, GENERATE\n1, " << (n + 1) * (n + 1) << ", 1\n*SURFACE, NAME=TOP\n" << top;
  return file.string();
}

/// A surface of one segment with surface coordinates, pressed into a block from above, both turned by
/// `frame`.
/// @param height  over a segment 2 wide at z = `level` above the reference point; empty: none
Json pressed(const std::string& name, const std::string& height, double wide, double level,
             const Vector3d& reference, const Matrix3d& frame = Matrix3d::Identity(), int bricks = 6) {
  Json json = Json::parse(R"({"dimension": 3,
    "materials": {"block": {"law": "linear_elastic", "young": 1000, "poisson": 0.3}},
    "parts": [{"name": "block", "material": "block"}],
    "supports": [{"nodes": "block.BASE", "x": 0, "y": 0, "z": 0}],
    "contact": {"slave": "block.TOP", "master": {"rigid_body": {"segments": [[0, 1, 2, 3]]}},
      "model": {"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": 1e4}}}},
    "steps": {"control": "load_factor", "values": [1]}})");
  json["parts"][0]["deck"] = write_block(name, bricks, frame);
  Json& body = json["contact"]["master"]["rigid_body"];
  body["reference"] = json_of(frame * reference);
  for (const auto& [x, y] : {std::pair{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}) { // the normal points down
    body["nodes"].push_back(json_of(frame * (reference + Vector3d(wide * x, wide * y, level))));
    body["surface_coordinates"].push_back({wide * x, wide * y});
  }
  if (!height.empty()) json["contact"]["model"]["height"] = {{"type", "expression"}, {"h", height}};
  return json;
}

void add_components(Json& list, const Vector3d& moves, const Vector3d& turns) {
  list.push_back({{"x", moves[0]}, {"y", moves[1]}, {"z", moves[2]}});
  list.back().update({{"turn_x", turns[0]}, {"turn_y", turns[1]}, {"turn_z", turns[2]}});
}

/// A cap of a sphere about the reference point.
Json sphere(int bricks = 6) {
  return pressed("turning_sphere.inp", "sqrt(4-u^2-v^2)-1", 1, -1, {0.05, 0.02, 2}, Matrix3d::Identity(),
                 bricks);
}

TEST(Turning, OfASphereChangesNothing) {
  Json json = sphere();
  Json& prescribed = json["contact"]["master"]["rigid_body"]["prescribed"];
  add_components(prescribed, {0, 0, -0.03}, Vector3d::Zero());
  const StepRecord still = test::run(json).back();
  prescribed = Json::array();
  add_components(prescribed, {0, 0, -0.03}, {0.2, -0.15, 0.4});
  const StepRecord turned = test::run(json).back();
  EXPECT_GT(still.contact_force[2], 1);
  EXPECT_GT((rotation_of(turned) - Matrix3d::Identity()).norm(), 0.5);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(turned.contact_force[i], still.contact_force[i], 1e-10 * still.contact_force[2]);
    EXPECT_NEAR(turned.moment[i], 0, 1e-10 * still.contact_force[2]);
  }
  for (std::size_t k = 0; k < still.fields.node_forces.size(); ++k)
    EXPECT_NEAR(turned.fields.node_forces[k], still.fields.node_forces[k], 1e-10 * still.contact_force[2]);
}

// A flat punch finds the direction in which the contact has no moment about its reference point, and goes on
// to do so while it is turned about its axis.
TEST(Turning, AFlatPunchTiltsUntilTheLoadHasNoMoment) {
  Json json = pressed("turning_punch.inp", "", 3, -1, {0.2, 0.1, 0.999});
  Json& body = json["contact"]["master"]["rigid_body"];
  body["loads"] = {{{"z", -200}}};
  body["free"] = {"turn_x", "turn_y"};
  const StepRecord still = test::run(json).back();
  body["prescribed"] = {{{"turn_z", 0.7}}};
  const StepRecord turned = test::run(json).back();
  for (const StepRecord* record : {&still, &turned}) {
    EXPECT_NEAR(record->contact_force[2], 200, 1e-7);
    EXPECT_NEAR(record->moment[0], 0, 1e-7);
    EXPECT_NEAR(record->moment[1], 0, 1e-7);
    EXPECT_EQ(record->increments.size(), 1u);
    EXPECT_TRUE(quadratic(record->increments.back().residuals, 1e3, 1e-13))
        << testing::PrintToString(record->increments.back().residuals);
    // deeper where the load is
    EXPECT_LT(rotation_of(*record)(2, 2), 1 - 1e-4);
    EXPECT_GT(rotation_of(*record)(0, 2), 0.01);
    EXPECT_GT(rotation_of(*record)(1, 2), 0.005);
  }
  EXPECT_NEAR(std::atan2(rotation_of(turned)(1, 0), rotation_of(turned)(0, 0)), 0.7, 0.01);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(rotation_of(turned)(i, 2), rotation_of(still)(i, 2), 1e-9);
}

// The scene turned as a whole: all vectors turn with it. An egg with friction that is drawn along while it is
// turned; and one that forces and moments hold against springs.
TEST(Turning, AScenesForcesTurnWithIt) {
  const Matrix3d frame = AngleAxisd(0.9, Vector3d(0.3, -0.8, 0.5).normalized()).toRotationMatrix();
  for (const bool loaded : {false, true}) {
    std::vector<std::vector<StepRecord>> records;
    for (const bool turned : {false, true}) {
      const Matrix3d at = turned ? frame : Matrix3d::Identity();
      Json json = pressed(turned ? "turning_frame.inp" : "turning_egg.inp", "1-u^2/3-0.2*v^2+0.05*u*v", 1.2,
                          -0.99, {0, 0, 1.96}, at);
      Json& body = json["contact"]["master"]["rigid_body"];
      if (loaded) {
        add_components(body["loads"], at * Vector3d(5, -3, -40), at * Vector3d(20, 15, -60));
        add_components(body["springs"], Vector3d::Constant(100), Vector3d::Constant(90));
      } else {
        json["contact"]["model"]["contact"]["friction"] = {
            {"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 3e3}};
        add_components(body["prescribed"], at * Vector3d(0.1, 0.02, -0.02), at * Vector3d(0.15, -0.2, 0.3));
      }
      json["steps"]["values"] = {{{"to", 1}, {"count", 2}}};
      records.push_back(test::run(json));
      const std::vector<double>& residuals = records.back().back().increments.back().residuals;
      EXPECT_TRUE(quadratic(residuals, 1e3, 1e-13)) << loaded << turned << testing::PrintToString(residuals);
    }
    const StepRecord &one = records[0].back(), &other = records[1].back();
    const double size = vector_of(one.contact_force).norm();
    EXPECT_GT(size, 10);
    EXPECT_GT(vector_of(one.moment).norm(), 0.5);
    EXPECT_GT((rotation_of(one) - Matrix3d::Identity()).norm(), 0.4);
    EXPECT_LT((vector_of(other.contact_force) - frame * vector_of(one.contact_force)).norm(), 1e-10 * size);
    EXPECT_LT((vector_of(other.moment) - frame * vector_of(one.moment)).norm(), 1e-10 * size);
    EXPECT_LT((rotation_of(other) - frame * rotation_of(one) * frame.transpose()).norm(), 1e-10);
    EXPECT_EQ(one.iterations(), other.iterations());
  }
}

// Turns are integrals of the angular velocity: together they are one rotation vector, one after the other a
// product, in any number of increments; and many of them do not drift.
TEST(Turning, TurnsAreIntegralsOfTheSpin) {
  const auto rotation = [](const Json& prescribed, const Json& values) {
    Json json = sphere(1);
    json["contact"]["master"]["rigid_body"]["prescribed"] = prescribed;
    json["steps"]["values"] = values;
    return rotation_of(test::run(json).back());
  };
  const auto count = [](int steps) -> Json { return {{{"to", 1}, {"count", steps}}}; };
  Json vector;
  add_components(vector, {0, 0, 0.1}, {0.2, -0.15, 0.4}); // lifted: only the motion counts
  const Vector3d turn(0.2, -0.15, 0.4);
  const Matrix3d expected = AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  for (const int steps : {1, 3, 16})
    EXPECT_LT((rotation(vector, count(steps)) - expected).norm(), 1e-14 * steps + 1e-14) << steps;
  const Json product{{{"turn_x", 0.3}, {"path", {{0, 0}, {0.5, 1}}}},
                     {{"turn_y", 0.2}, {"path", {{0.5, 0}, {1, 1}}}},
                     {{"z", 0.1}}};
  const Matrix3d after =
      (AngleAxisd(0.2, Vector3d::UnitY()) * AngleAxisd(0.3, Vector3d::UnitX())).toRotationMatrix();
  for (const int steps : {2, 12}) EXPECT_LT((rotation(product, count(steps)) - after).norm(), 2e-14) << steps;
  Json many;
  add_components(many, {0, 0, 0.1}, {24, -18, 48}); // nine turns
  EXPECT_LT((rotation(many, count(64)) - AngleAxisd(120 * turn.norm(), turn.normalized()).toRotationMatrix())
                .norm(),
            1e-12);
}

TEST(Turning, ARestartGoesOnToTheSameBits) {
  Json json = pressed("turning_restart.inp", "", 3, -1, {0.2, 0.1, 0.999});
  Json& body = json["contact"]["master"]["rigid_body"];
  body["loads"] = {{{"z", -200}}};
  body["free"] = {"turn_x", "turn_y"};
  body["prescribed"] = {{{"turn_z", 0.7}}};
  json["contact"]["model"]["contact"]["friction"] = {
      {"type", "coulomb"}, {"coefficient", 0.1}, {"stiffness", 1e3}};
  json["steps"]["values"] = {0.5, 1};
  const Scene scene = test::scene_from(json);
  Simulation whole(scene, &test::library()), rest(scene, &test::library());
  Json checkpoint;
  solve(whole, {{}, [&](const Simulation& at, const StepRecord& record) {
                  if (record.step == 1) checkpoint = at.checkpoint();
                }});
  rest.restore(Json::parse(checkpoint.dump()));
  StepPlan plan;
  plan.first = 2;
  solve(rest, {}, plan);
  EXPECT_EQ(rest.fingerprint(), whole.fingerprint());
  checkpoint["body"]["rotation"] = {1, 0};
  EXPECT_THROW(rest.restore(checkpoint), InputError);
}

} // namespace
} // namespace host::turning_test
