// SPDX-License-Identifier: BSD-3-Clause
// Scenes of the reference host, on coarse meshes, through every adapter: same bits, same iterations.
// scenes_table.cpp does the same with the meshes as they are shipped.
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "scene_comparison.hpp"

namespace adapters::scenes_test {
namespace {

class Scenes : public testing::Test {
protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("ents-scenes-" + std::to_string(std::random_device{}()));
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

class EveryScene : public Scenes, public testing::WithParamInterface<std::string> {};

// Another start leaves other last bits in the projection, and motions differ by the like. Forces are penalty
// stiffness times gap: 1e7 times the rounding of coordinates up to 10, 1e-15, over pressures of 10.
constexpr double roundings_of_forces = 1e-9;
// Of slope's block nothing holds the slope but springs, 4e-3 in all, and forces of 4 balance to 2e-11 of
// them.
constexpr double motion_of_slope = 2e-8;

// `direct` calls the plain interface with projections that start where those of adapters do.
TEST_P(EveryScene, HasTheSameBitsThroughEveryAdapter) {
  const std::string file = write_scene(GetParam(), Mesh::coarse, folder_);
  const SceneResult direct = run_scene(file, "direct");
  ASSERT_EQ(direct.refusal, "");
  int solved = 0;
  for (const std::string& adapter : scene_adapters()) {
    SCOPED_TRACE(adapter);
    const SceneResult through = run_scene(file, adapter);
    if (!through.refusal.empty()) { // these have elements in 3D only
      EXPECT_NE(through.refusal.find("/dimension is 2"), std::string::npos) << through.refusal;
      EXPECT_TRUE(adapter == "calculix" || adapter == "lsdyna");
      continue;
    }
    ++solved;
    const Comparison c = compare(direct, through);
    EXPECT_TRUE(c.iterations);
    // Marc gets increments of history: begin + (end - begin) is not end. VUEL has no tangent: it is that of
    // the plain interface from another start of the projection. Bounds as below.
    if ((adapter == "marc" || adapter == "abaqus_explicit") && !c.bits) {
      EXPECT_LE(c.motion, GetParam() == "slope" ? motion_of_slope : 1e-12);
      EXPECT_LE(c.force, roundings_of_forces);
    } else {
      EXPECT_TRUE(c.bits) << "motion " << c.motion << ", force " << c.force;
    }
  }
  EXPECT_GE(solved, 6);
}

TEST_P(EveryScene, HasTheSolutionOfThePlainInterface) {
  const std::string file = write_scene(GetParam(), Mesh::coarse, folder_);
  const SceneResult plain = run_scene(file, "plain"), direct = run_scene(file, "direct");
  ASSERT_EQ(plain.refusal, "");
  const Comparison c = compare(plain, direct);
  EXPECT_TRUE(c.iterations);
  EXPECT_LE(c.motion, GetParam() == "slope" ? motion_of_slope : 1e-12);
  EXPECT_LE(c.force, roundings_of_forces);
}

INSTANTIATE_TEST_SUITE_P(Adapters, EveryScene, testing::ValuesIn(scene_names()),
                         [](const auto& test) { return test.param; });

// What the stiffness makes of the last bits: a thousandth of it, a thousandth of the difference.
TEST_F(Scenes, ForcesDifferByStiffnessTimesRoundings) {
  const std::string file = write_scene("hertz2d", Mesh::coarse, folder_);
  std::ifstream in(file);
  auto scene = nlohmann::json::parse(in);
  double force[2];
  for (int i = 0; i < 2; ++i) {
    scene["contact"]["model"]["contact"]["normal"]["stiffness"] = i == 0 ? 1e7 : 1e4;
    std::ofstream(file) << scene;
    force[i] = compare(run_scene(file, "plain"), run_scene(file, "direct")).force;
  }
  EXPECT_LE(force[0], roundings_of_forces);
  EXPECT_LE(force[1], 1e-3 * roundings_of_forces);
}

// Two guided cubes that touch at the start, pressed and sheared until friction, which sticks, carries 0.1972
// (CalculiX with its own penalty contact on the same mesh and laws). An adapter
// that takes the first increment's touch for one without friction has next to nothing in one increment, and
// a half in two.
TEST_F(Scenes, FrictionBeginsAtTheTouchInEveryAdapter) {
  auto scene = nlohmann::json::parse(R"({"dimension": 3,
  "materials": {"cube": {"law": "linear_elastic", "young": 1000, "poisson": 0}},
  "parts": [
    {"name": "upper", "material": "cube", "element": "hex8", "x": {"from": 0, "pieces": [{"to": 1, "divisions": 1}]},
      "y": {"from": 0, "pieces": [{"to": 1, "divisions": 1}]}, "z": {"from": 1, "pieces": [{"to": 2, "divisions": 1}]}},
    {"name": "lower", "material": "cube", "element": "hex8", "x": {"from": 0, "pieces": [{"to": 1, "divisions": 1}]},
      "y": {"from": 0, "pieces": [{"to": 1, "divisions": 1}]}, "z": {"from": 0, "pieces": [{"to": 1, "divisions": 1}]}}],
  "supports": [{"nodes": "upper.y_min", "y": 0}, {"nodes": "upper.y_max", "y": 0}, {"nodes": "lower.y_min", "y": 0},
    {"nodes": "lower.y_max", "y": 0}, {"nodes": "lower.z_min", "x": 0, "z": 0}, {"nodes": "upper.z_max", "x": 0.002, "z": -0.01}],
  "contact": {"slave": "upper.z_min", "master": {"faces": "lower.z_max"},
    "model": {"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": 2000},
      "friction": {"type": "coulomb", "coefficient": 0.9, "stiffness": 500}}}},
  "steps": {"control": "load_factor"}})");
  std::vector<std::string> adapters = scene_adapters();
  adapters.insert(adapters.end(), {"plain", "direct"});
  for (const int increments : {1, 2, 10, 50}) {
    scene["steps"]["values"] = {{{"to", 1}, {"count", increments}}};
    const std::string file = (folder_ / "first_touch.json").string();
    std::ofstream(file) << scene;
    for (const std::string& adapter : adapters) {
      SCOPED_TRACE(adapter + ", " + std::to_string(increments));
      const SceneResult result = run_scene(file, adapter);
      ASSERT_EQ(result.refusal, "");
      EXPECT_NEAR(result.steps.back()["contact_force"][0].get<double>(), 0.1972, 0.01 * 0.1972);
    }
  }
}

// Hosts with symmetric matrices: Newton's iteration is slower and ends in the same place. Its last error is
// not the square of the one before but a part of it: that of the forces is the scenes' tolerance, 1e-10, over
// the part that is still missing, a tenth or more.
TEST_F(Scenes, SymmetrisedTangentsConvergeToTheSameSolution) {
  for (const char* name : {"cattaneo_soft", "wavy3d_friction"}) {
    SCOPED_TRACE(name);
    const SceneResult exact = run_scene(write_scene(name, Mesh::coarse, folder_), "direct");
    const std::string file = write_scene(name, Mesh::coarse, folder_, true);
    const SceneResult symmetrised = run_scene(file, "direct");
    ASSERT_EQ(symmetrised.refusal, "");
    const Comparison c = compare(exact, symmetrised);
    EXPECT_LE(c.motion, 1e-12);
    EXPECT_LE(c.force, 1e-9);
    for (const char* adapter : {"abaqus", "calculix"}) {
      const SceneResult through = run_scene(file, adapter);
      if (through.refusal.empty()) {
        EXPECT_TRUE(compare(symmetrised, through).bits) << adapter;
      }
    }
  }
}

// An element may ask for a smaller increment. Programs that it can ask cut as the plain interface does; the
// others end the job and say what to do.
TEST_F(Scenes, CutsAreThoseOfThePlainInterfaceOrTheJobEnds) {
  const std::string file = write_scene("hertz2d", Mesh::coarse, folder_);
  std::ifstream in(file);
  auto scene = nlohmann::json::parse(in);
  scene["contact"]["model"]["penetration_limit"] = 1e-3;
  scene["contact"]["model"]["contact"]["normal"]["stiffness"] = 1e5;
  scene["steps"]["values"] = {3.5};
  scene["solver"]["line_search"] = "never"; // which needs no cut here
  std::ofstream(file) << scene;
  const SceneResult plain = run_scene(file, "plain"), direct = run_scene(file, "direct");
  ASSERT_EQ(plain.refusal, "");
  ASSERT_GE(plain.steps[0]["cuts"].size(), 1u);
  EXPECT_TRUE(compare(plain, direct).iterations);
  for (const char* adapter : {"abaqus", "ansys", "opensees"}) {
    const SceneResult through = run_scene(file, adapter);
    ASSERT_EQ(through.refusal, "") << adapter;
    EXPECT_TRUE(compare(direct, through).bits) << adapter;
  }
  for (const char* adapter : {"abaqus_explicit", "feap", "marc"}) {
    const std::string refusal = run_scene(file, adapter).refusal;
    EXPECT_NE(refusal.find("penetration_limit"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find("/steps/values"), std::string::npos) << refusal;
  }
}

TEST_F(Scenes, WhatAProgramLacksIsNamedByItsKey) {
  const struct {
    const char *scene, *adapter, *options, *expected;
  } lacks[] = {
      {"hertz2d", "calculix", "", "/dimension is 2"},
      {"hertz2d", "lsdyna", "", "/dimension is 2"},
      {"hertz2d", "abaqus_explicit", "--variant multiplier",
       "/contact/model/contact/normal/type \"multiplier\""},
      {"hertz2d", "abaqus_uinter", "", "law of a point"},
      {"hertz2d", "abacus", "", "write one of plain, direct, abaqus"},
  };
  for (const auto& lack : lacks) {
    const std::string refusal =
        run_scene(write_scene(lack.scene, Mesh::coarse, folder_), lack.adapter, lack.options).refusal;
    EXPECT_NE(refusal.find(lack.expected), std::string::npos) << lack.adapter << ": " << refusal;
  }
}

// Multipliers as unknowns: an element's last node carries them, in all programs where it can.
TEST_F(Scenes, MultipliersAreUnknownsOfTheirOwnNode) {
  const std::string file = write_scene("hertz2d", Mesh::coarse, folder_),
                    variant = "--variant augmented_multiplier --last-step 2";
  const SceneResult direct = run_scene(file, "direct", variant);
  ASSERT_EQ(direct.refusal, "");
  for (const char* adapter : {"abaqus", "ansys", "feap", "marc", "opensees"})
    EXPECT_TRUE(compare(direct, run_scene(file, adapter, variant)).bits) << adapter;
}

// Rigid bodies that a load tilts while they turn, with friction: the reference node of Abaqus has rotations,
// the others have a node for the turns. One plane scene, one in space. Bounds as above.
TEST_F(Scenes, RigidBodiesHaveAReferenceNode) {
  const struct {
    const char *name, *scene;
    std::vector<std::string> adapters;
  } kinds[] = {
      {"plane",
       R"({"dimension": 2, "formulation": "plane_strain",
  "materials": {"block": {"law": "neo_hooke", "young": 1000, "poisson": 0.3}},
  "parts": [{"name": "block", "material": "block", "element": "quad4",
    "x": {"from": -1, "pieces": [{"to": 1, "divisions": 8}]}, "y": {"from": -1, "pieces": [{"to": 0, "divisions": 3}]}}],
  "supports": [{"nodes": "block.y_min", "x": 0, "y": 0}],
  "contact": {"slave": "block.y_max", "master": {"rigid_body": {"reference": [0.1, 0.5],
      "nodes": [[2, -0.003], [0, -0.003], [-2, -0.003]], "segments": [[0, 1], [1, 2]], "surface_coordinates": [[2], [0], [-2]],
      "loads": [{"y": -50}], "free": ["turn"], "prescribed": [{"x": 0.05}]}},
    "model": {"segment": "line2", "height": {"type": "sine", "amplitude": 0.002, "wave_vector": [0.4]},
      "contact": {"normal": {"type": "penalty", "stiffness": 1e4}, "friction": {"type": "coulomb", "coefficient": 0.2, "stiffness": 1e3}}}},
  "steps": {"control": "load_factor", "values": [0.5, 1]}})",
       {"abaqus", "abaqus_explicit", "ansys", "feap", "marc", "opensees"}},
      {"space",
       R"({"dimension": 3,
  "materials": {"block": {"law": "linear_elastic", "young": 1000, "poisson": 0.3}},
  "parts": [{"name": "block", "material": "block", "element": "hex8", "x": {"from": -1, "pieces": [{"to": 1, "divisions": 4}]},
    "y": {"from": -1, "pieces": [{"to": 1, "divisions": 4}]}, "z": {"from": -1, "pieces": [{"to": 0, "divisions": 2}]}}],
  "supports": [{"nodes": "block.z_min", "x": 0, "y": 0, "z": 0}],
  "contact": {"slave": "block.z_max", "master": {"rigid_body": {"reference": [0.2, 0.1, 1],
      "nodes": [[-3, 3, -0.004], [3, 3, -0.004], [3, -3, -0.004], [-3, -3, -0.004]], "segments": [[0, 1, 2, 3]],
      "surface_coordinates": [[-3, 3], [3, 3], [3, -3], [-3, -3]],
      "loads": [{"z": -200}], "free": ["turn_x", "turn_y"], "prescribed": [{"turn_z": 0.3}]}},
    "model": {"segment": "quad4", "height": {"type": "sine", "amplitude": 0.003, "wave_vector": [0.3, 0.2]},
      "contact": {"normal": {"type": "penalty", "stiffness": 1e4}, "friction": {"type": "coulomb", "coefficient": 0.1, "stiffness": 1e3}}}},
  "steps": {"control": "load_factor", "values": [0.5, 1]}})",
       {"abaqus", "abaqus_explicit", "ansys", "calculix", "feap", "marc", "opensees"}},
  };
  for (const auto& kind : kinds) {
    SCOPED_TRACE(kind.name);
    const std::string file = (folder_ / (std::string(kind.name) + ".json")).string();
    std::ofstream(file) << kind.scene;
    const SceneResult plain = run_scene(file, "plain"), direct = run_scene(file, "direct");
    ASSERT_EQ(plain.refusal, "");
    for (const nlohmann::json& moment : plain.steps.back()["moment"]) {
      const bool of_turn =
          moment == plain.steps.back()["moment"].back() && plain.steps.back()["moment"].size() == 3;
      EXPECT_EQ(std::abs(moment.get<double>()) > 1e-3, of_turn) << moment; // the others are free
    }
    std::vector<std::string> adapters = kind.adapters;
    adapters.insert(adapters.begin(), "direct");
    for (const std::string& adapter : adapters) {
      SCOPED_TRACE(adapter);
      const SceneResult through = run_scene(file, adapter);
      ASSERT_EQ(through.refusal, "");
      const Comparison c = compare(plain, through);
      EXPECT_TRUE(c.iterations);
      EXPECT_LE(c.motion, 1e-12);
      EXPECT_LE(c.force, roundings_of_forces);
    }
  }
  const std::string refusal = run_scene((folder_ / "space.json").string(), "lsdyna").refusal;
  EXPECT_NE(refusal.find("/contact/master/rigid_body"), std::string::npos) << refusal;
}

TEST_F(Scenes, ModelsWhoseParametersMoveAreRefused) {
  const std::string refusal = run_scene(ENTS_EXAMPLES "/wear_cylinder/scene.json", "abaqus").refusal;
  EXPECT_NE(refusal.find("run it without --adapter abaqus"), std::string::npos) << refusal;
}

TEST_F(Scenes, AnUnknownNameIsToldWithTheList) {
  try {
    write_scene("hertz4d", Mesh::coarse, folder_);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    for (const char* words : {"hertz4d", "hertz2d, hertz3d"})
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace adapters::scenes_test
