// SPDX-License-Identifier: BSD-3-Clause
// Slave nodes behind a concave edge between two plain segments: they project on neither, and no result may
// come from a step that leaves one there.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "support.hpp"

namespace host::behind_edge_test {
namespace {

using test::axis;

std::string failure_of(const Json& json, const std::filesystem::path& file = "test.json") {
  const Scene scene = read_scene_text(json.dump(), file);
  Simulation simulation(scene, &test::library());
  try {
    solve(simulation, {});
  } catch (const StepFailure& failure) {
    return failure.what();
  }
  return "";
}

/// A rigid V groove y = left |x|, right x, and a block whose middle node comes to (x, -depth); all nodes that
/// touch are held.
class Groove : public testing::Test {
protected:
  Groove() : folder_(std::filesystem::temp_directory_path() / ("ents_groove_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Groove() override { std::filesystem::remove_all(folder_); }

  Json scene(double left, double right, double x, double depth) const {
    std::ofstream(folder_ / "groove.inp")
        << "*NODE\n1, -1, -1\n2, 0, -1\n3, 1, -1\n4, -1, " << left << "\n5, 0, 0\n6, 1, " << right
        << "\n*ELEMENT, TYPE=CPE4, ELSET=ALL\n1, 1, 2, 5, 4\n2, 2, 3, 6, 5\n"
           "*NSET, NSET=ALL\n1, 2, 3, 4, 5, 6\n*SURFACE, NAME=TOP, TYPE=ELEMENT\n1, S3\n2, S3\n";
    return {
        {"dimension", 2},
        {"formulation", "plane_strain"},
        {"materials", {{"m", {{"law", "linear_elastic"}, {"young", 1}, {"poisson", 0.3}}}}},
        {"parts",
         {{{"name", "groove"}, {"material", "m"}, {"deck", "groove.inp"}},
          {{"name", "b"},
           {"material", "m"},
           {"element", "quad4"},
           {"x", axis(x - 0.5, x + 0.5, 2)},
           {"y", axis(0, 1, 2)}}}},
        {"supports",
         {{{"nodes", "groove.ALL"}, {"x", 0}, {"y", 0}}, {{"nodes", "b.y_min"}, {"x", 0}, {"y", -depth}}}},
        {"contact",
         {{"slave", "b.y_min"},
          {"master", {{"faces", "groove.TOP"}}},
          {"model",
           {{"segment", "line2"},
            {"border", 1e-7},
            {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 30}}}}}}}}},
        {"steps", {{"control", "load_factor"}, {"values", {1}}}},
        {"solver", {{"min_step", 0.9}}}};
  }

  std::filesystem::path folder_;
};

// Equilibrium is found at once with the node open: nothing but this test of its place can tell.
TEST_F(Groove, AStepThatLeavesANodeBehindTheEdgeFails) {
  test::Random random(3);
  int lost = 0, held = 0;
  for (int i = 0; i < 60; ++i) {
    const double left = random.uniform(0.05, 0.6), right = random.uniform(0.05, 0.6),
                 depth = random.uniform(0.01, 0.1);
    const double x = depth * random.uniform(-2 * left, 2 * right);
    // Projections on the two lines end before the bottom where (x, -depth) lies between their normals there.
    const bool between = x > -left * depth && x < right * depth;
    Json json = scene(left, right, x, depth);
    const std::string failure = failure_of(json, folder_ / "scene.json");
    if (between) {
      EXPECT_NE(failure.find("behind a concave edge"), std::string::npos) << failure;
      EXPECT_NE(failure.find("raise /contact/model/border"), std::string::npos) << failure;
      json["contact"]["model"]["border"] = 0.2; // 0.2 halves of a segment: more than depth times slope
      EXPECT_EQ(failure_of(json, folder_ / "scene.json"), "");
    } else {
      EXPECT_EQ(failure, "") << left << " " << right << " " << x << " " << depth;
    }
    ++(between ? lost : held);
  }
  EXPECT_GT(std::min(lost, held), 15);
}

// A block that is drawn over the end of a flat master: its nodes leave it in contact. The step fails, whether
// the iteration has lost them at its begin or on its way; a block that stays, or that is lifted on its way,
// does not mind.
TEST_F(Groove, AStepThatDrawsANodeOverTheEndOfTheMasterFails) {
  Json json = scene(0, 0, 0, 0.02);
  json["solver"]["min_step"] = 0.05;
  json["steps"]["values"] = {0.5, 1};
  for (const double shift : {0.3, 0.45, 0.6, 0.75, 2.1}) {
    json["supports"][1]["x"] = shift;
    const std::string failure = failure_of(json, folder_ / "scene.json");
    EXPECT_EQ(failure.empty(), shift < 0.5) << shift << ": " << failure;
    if (failure.empty()) continue;
    EXPECT_NE(failure.find("was in contact and lies beside all segments of the master now"),
              std::string::npos)
        << failure;
    EXPECT_NE(failure.find("let the master reach farther"), std::string::npos) << failure;
  }
}

/// A stiff block presses beside a node of a soft block's flat surface, which bends to a concave kink there.
Json pressed(double from, double to, double depth) {
  const auto part = [](const char* name, const char* material, const Json& x, const Json& y) {
    return Json{{"name", name}, {"material", material}, {"element", "tri3"}, {"x", x}, {"y", y}};
  };
  const auto material = [](double young) {
    return Json{{"law", "st_venant_kirchhoff"}, {"young", young}, {"poisson", 0.3}};
  };
  return {
      {"dimension", 2},
      {"formulation", "plane_strain"},
      {"materials", {{"soft", material(1000)}, {"stiff", material(37000)}}},
      {"parts",
       {part("lower", "soft", axis(0, 4, 13), axis(0, 2, 4)),
        part("upper", "stiff", axis(from, to, 6), axis(2.05, 3.55, 5))}},
      {"supports",
       {{{"nodes", "lower.y_min"}, {"x", 0}, {"y", 0}}, {{"nodes", "upper.y_max"}, {"x", 0}, {"y", -depth}}}},
      {"contact",
       {{"slave", "upper.y_min"},
        {"master", {{"faces", "lower.y_max"}}},
        {"model",
         {{"segment", "line2"},
          {"border", 1e-7},
          {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 3662}}}}}}}}},
      {"steps", {{"control", "load_factor"}, {"values", {0.2, 0.4, 0.6, 0.8, 1}}}}};
}

// The iteration alternates between the node open in the kink and pushed out of it.
TEST(BehindEdge, AnIterationThatStallsInAKinkNamesTheCure) {
  test::Random random(1);
  int stalled = 0;
  for (int i = 0; i < 24; ++i) {
    Json json = pressed(0.5, 1.21546 + random.uniform(-2e-3, 2e-3), 0.1458 + random.uniform(-2e-3, 2e-3));
    const std::string failure = failure_of(json);
    if (failure.empty()) continue;
    ++stalled;
    EXPECT_NE(failure.find("no convergence"), std::string::npos) << failure;
    EXPECT_NE(failure.find("raise /contact/model/border"), std::string::npos) << failure;
    EXPECT_NE(failure.find("take a smoothed segment"), std::string::npos) << failure;
    json["contact"]["model"]["segment"] =
        "bspline4"; // a border ends the stall as well, but nodes may then change sides for ever
    EXPECT_EQ(failure_of(json), "");
  }
  EXPECT_GE(stalled, 3);
}

/// Two blocks of the same width, one on the other, squeezed by 2 % between planes on which they slide; all sides of the
/// lower one, from a deck, or its top alone are the master.
Json flush(int slave_faces, const std::string& deck, const std::string& master) {
  const double height = 1;
  return {{"dimension", 2},
          {"formulation", "plane_strain"},
          {"materials", {{"m", {{"law", "linear_elastic"}, {"young", 1000}, {"poisson", 0.3}}}}},
          {"parts",
           {{{"name", "lower"}, {"material", "m"}, {"deck", deck}},
            {{"name", "upper"},
             {"material", "m"},
             {"element", "quad4"},
             {"x", axis(0, 1, slave_faces)},
             {"y", axis(height, 2 * height, 4)}}}},
          {"supports",
           {{{"nodes", "lower.BOTTOM"}, {"y", 0}},
            {{"nodes", "lower.CORNER"}, {"x", 0}},
            {{"nodes", "upper.x_min"}, {"x", 0}},
            {{"nodes", "upper.y_max"}, {"y", -0.04}}}},
          {"contact",
           {{"slave", "upper.y_min"},
            {"master", {{"faces", "lower." + master}}},
            {"model",
             {{"segment", "line2"}, {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 1e5}}}}}}}}},
          {"steps", {{"control", "load_factor"}, {"values", {1}}}}};
}

void write_block(const std::filesystem::path& file, int cells) {
  std::ofstream deck(file);
  deck.precision(17);
  std::string bottom, top, left, right;
  deck << "*NODE\n";
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= cells; ++i)
      deck << 1 + i + (cells + 1) * j << ", " << double(i) / cells << ", " << 0.25 * j << "\n";
  deck << "*ELEMENT, TYPE=CPE4, ELSET=ALL\n";
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < cells; ++i) {
      const int e = 1 + i + cells * j, a = 1 + i + (cells + 1) * j, b = a + cells + 1;
      deck << e << ", " << a << ", " << a + 1 << ", " << b + 1 << ", " << b << "\n";
      if (j == 0) bottom += std::to_string(e) + ", S1\n";
      if (j == 3) top += std::to_string(e) + ", S3\n";
      if (i == 0) left += std::to_string(e) + ", S4\n";
      if (i == cells - 1) right += std::to_string(e) + ", S2\n";
    }
  deck << "*NSET, NSET=CORNER\n1\n*NSET, NSET=BOTTOM\n";
  for (int i = 0; i <= cells; ++i) deck << 1 + i << "\n";
  deck << "*SURFACE, NAME=TOP, TYPE=ELEMENT\n"
       << top << "*SURFACE, NAME=SKIN, TYPE=ELEMENT\n"
       << bottom << right << top << left;
}

// Nodes at the ends stay on their faces, and no side takes them: both masters carry the uniform pressure of a bar.
TEST(FlushBlocks, ConvergeWithTheTopOrAllSidesAsMaster) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("ents_flush_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  for (const auto& [slave, lower] : {std::pair{9, 7}, {7, 9}, {5, 6}, {8, 8}}) {
    write_block(folder / "lower.inp", lower);
    for (const char* master : {"TOP", "SKIN"}) {
      const Scene scene = read_scene_text(flush(slave, "lower.inp", master).dump(), folder / "scene.json");
      Simulation simulation(scene, &test::library());
      const std::vector<StepRecord> records = solve(simulation, {});
      ASSERT_EQ(records.size(), 1u);
      const double force = 1000 / (1 - 0.09) * 0.02; // plane strain, free to spread
      EXPECT_NEAR(-records[0].contact_force[1], force, 0.01 * force)
          << slave << " on " << lower << ", " << master;
      EXPECT_LE(records[0].iterations(), 6) << slave << " on " << lower << ", " << master;
    }
  }
  std::filesystem::remove_all(folder);
}

} // namespace
} // namespace host::behind_edge_test
