// SPDX-License-Identifier: BSD-3-Clause
// The shortest wave of a height against the slave mesh; the bound of a contact area that holds, or is not
// given; and tables that fit a terminal.
#include <cmath>
#include <numbers>
#include <sstream>

#include <gtest/gtest.h>

#include "output/table.hpp"
#include "program_fixture.hpp"
#include "resolution.hpp"
#include "support.hpp"

namespace host::test::resolution_test {
namespace {

double wave_of(const char* height, std::size_t directions = 2) {
  return shortest_wave(Json::parse(height), scene_file("rough_afm").parent_path(), directions);
}

TEST(ShortestWave, OfEveryHeightThatHasOne) {
  EXPECT_DOUBLE_EQ(wave_of(R"({"type": "sine", "amplitude": 1, "wave_vector": [3, 4]})"), 0.2);
  EXPECT_DOUBLE_EQ(wave_of(R"({"type": "gaussian", "amplitude": 1, "center": [0, 0], "width": 0.5})"),
                   std::numbers::pi);
  const std::string scan = R"({"type": "map", "file": "afm_10um_256.txt", "length_unit": 1e-6, "boundary": )";
  EXPECT_NEAR(wave_of((scan + R"("clamped"})").c_str()), 20. / 256, 1e-12); // two pixels
  EXPECT_NEAR(wave_of((scan + R"("periodic"})").c_str()), 20. / 256, 1e-12);
  EXPECT_DOUBLE_EQ(wave_of((scan + R"("clamped", "cut_off": 0.3})").c_str()), 0.3);
  EXPECT_NEAR(wave_of((scan + R"("clamped", "size": [5.1, 10.2]})").c_str()), 2 * 5.1 / 255, 1e-12);
  EXPECT_DOUBLE_EQ(
      wave_of(R"({"type": "map", "values": [1, 2, 3, 4], "boundary": "periodic", "size": [2]})", 1), 1);
  EXPECT_DOUBLE_EQ(
      wave_of(
          R"({"type": "roughness", "seed": 1, "rms": 1, "hurst": 1, "wavelengths": [0.1, 1, 2], "size": [4, 4]})"),
      0.1);
  EXPECT_DOUBLE_EQ(wave_of(R"({"type": "fourier", "wave_vectors": [[1, 0], [0, 4]], "amplitudes": [1, 1]})"),
                   0.25);
  EXPECT_DOUBLE_EQ(
      wave_of(
          R"({"type": "weierstrass", "amplitude": 1, "wave_vector": [1, 0], "hurst": 0.5, "terms": 3, "ratio": 2})"),
      0.25);
}

TEST(ShortestWave, OfHeightsOfHeights) {
  const std::string one = R"({"type": "sine", "amplitude": 1, "wave_vector": [2, 0]})",
                    two = R"({"type": "sine", "amplitude": 1, "wave_vector": [0, 3]})",
                    unknown = R"x({"type": "expression", "h": "sin(u)"})x";
  const auto of = [](const char* type, const std::string& a, const std::string& b) {
    return wave_of(("{\"type\": \"" + std::string(type) + "\", \"of\": [" + a + ", " + b + "]}").c_str());
  };
  EXPECT_DOUBLE_EQ(of("sum", one, two), 1. / 3);
  EXPECT_DOUBLE_EQ(of("product", one, two), 1. / 5); // at most: these two are across each other
  EXPECT_DOUBLE_EQ(wave_of((R"({"type": "scale", "by": 2, "of": )" + one + "}").c_str()), 0.5);
  EXPECT_TRUE(std::isnan(of("sum", one, unknown)));
  EXPECT_TRUE(std::isnan(of("product", unknown, two)));
  EXPECT_TRUE(std::isinf(wave_of(R"({"type": "polynomial", "coefficients": [[0, 0, 1], [0], [1]]})")));
  EXPECT_TRUE(std::isinf(wave_of("null")));
}

// (pi / 4) E* w / s^2, with the strength s of each law
TEST(Resolution, OfTheTensionOfALaw) {
  const auto of = [](const char* law) {
    return tension_length(
        Json::parse(std::string(R"({"parameters": {"w": 0.02}, "contact": {"normal": )") + law + "}}"), 1000);
  };
  const double pi = std::numbers::pi, e = std::numbers::e;
  EXPECT_TRUE(std::isinf(of(R"({"type": "penalty", "stiffness": 1e6})")));
  EXPECT_DOUBLE_EQ(of(R"({"type": "dugdale", "work": 0.02, "strength": 5, "stiffness": 1e5})"),
                   pi / 4 * 20 / 25);
  EXPECT_DOUBLE_EQ(of(R"({"type": "dugdale", "work": "w", "strength": 5, "stiffness": 1e5})"),
                   pi / 4 * 20 / 25);
  EXPECT_NEAR(of(R"({"type": "separation", "work": 0.02, "length": 0.001})"),
              pi / 4 * 20 / std::pow(20 / e, 2), 1e-12);
  EXPECT_NEAR(of(R"({"type": "lennard_jones", "work": 0.02, "length": 0.001, "range": 0.01})"),
              pi / 4 * 20 / std::pow(1.0264 * 20, 2), 1e-5);
  Resolution some;
  some.spacing = 0.1, some.wave = 10, some.tension = 0.3;
  EXPECT_TRUE(some.too_coarse());
  EXPECT_NE(describe(some, "mm").find("take nodes at most 0.0750 mm apart"), std::string::npos)
      << describe(some, "mm");
  some.tension = 0.5;
  EXPECT_FALSE(some.too_coarse());
  EXPECT_NE(describe(some, "mm").find("acts over 0.500 mm"), std::string::npos);
}

Resolution of_scene(const Json& json) {
  const Scene scene = scene_from(json);
  return Simulation(scene, &library()).resolution();
}

/// A wave of this length, in the scene's length, over an elastic body of 5 x 5 x 2.5.
Json wave_scene(double wave, const char* variant, int divisions, int layers = 1) {
  Json json = shipped("rough_afm", variant);
  json.erase("compare"), json.erase("exact");
  Json& part = json["parts"][0];
  part["x"] = part["y"] = axis(3, 8, divisions);
  part["z"] = axis(-2.5, 0, layers);
  Json& model = json["contact"]["model"]; // s is in units of half a length
  model["surface_coordinates"] = {{0, 0}, {0, 20}, {20, 20}, {20, 0}};
  model["height"] = {{"type", "sine"}, {"amplitude", 0.01}, {"wave_vector", {0.5 / wave, 0}}};
  return json;
}

TEST(Resolution, IsThatOfNodesAndOfElements) {
  const Resolution layer = of_scene(wave_scene(1, "", 10)), coarse = of_scene(wave_scene(1, "", 9));
  EXPECT_DOUBLE_EQ(layer.wave, 1);
  EXPECT_DOUBLE_EQ(layer.spacing, 0.5);
  EXPECT_EQ(layer.depth, 0);
  EXPECT_FALSE(layer.too_coarse());
  EXPECT_TRUE(coarse.too_coarse());
  const Resolution block = of_scene(wave_scene(2, "block", 20, 10)),
                   deep = of_scene(wave_scene(2, "block", 20, 9));
  EXPECT_DOUBLE_EQ(block.wave, 2);
  EXPECT_DOUBLE_EQ(block.spacing, 0.25);
  EXPECT_DOUBLE_EQ(block.depth, 0.25);
  EXPECT_FALSE(block.too_coarse());
  EXPECT_NEAR(deep.depth, 2.5 / 9, 1e-12);
  EXPECT_TRUE(deep.too_coarse());
  EXPECT_EQ(describe(block, "um"),
            "the shortest wave of the height is 2.00 um long; slave nodes lie up to 0.250 um "
            "apart, the elements below them are up to 0.250 um deep: fine enough");
}

// The shipped scan: one node per height is the least, and a block of hex8 is far too coarse.
TEST_F(Program, ACoarseBlockUnderAScanIsToldBeforeTheRun) {
  const std::string scene = quoted(scene_file("rough_afm"));
  expect(ents_host("check " + scene), 0,
         {"the shortest wave of the height is 0.0781 um long; slave nodes lie up to 0.0391 um apart: fine "
          "enough",
          "covers", "admissible on 1 segment"});
  expect(ents_host("check " + scene + " --variant block"), 0,
         {"warning: the shortest wave of the height is 0.0781 um long; slave nodes lie up to 0.0893 um "
          "apart, the "
          "elements below them are up to 0.0806 um deep. The mesh is too coarse for this surface: elements "
          "have to "
          "be at most 0.00977 um wide and deep",
          "or the element \"layer\" takes the place of the mesh, with nodes at most 0.0391 um apart"});
  expect(ents_host("check " + scene + " --variant \"cut off\""), 0, {"fine enough"});
  expect(ents_host("check " + scene + " --variant no"), 2,
         {"no variant \"no\" in /variants; there are: conductance, block, fine"});
  const std::string model = write("model.json", {{"segment", "line2"}});
  expect(ents_host("check " + scene + " --mesh " + model), 2, {"--mesh: this is a scene"});
  expect(ents_host("check " + model + " --variant block"), 2, {"--variant: this is a model"});
}

// A run of a mesh that is too coarse prints no bound; one that is fine enough does.
TEST_F(Program, NoBoundIsPrintedOfAMeshThatIsTooCoarse) {
  for (const int cells : {9, 20}) {
    Json json = wave_scene(1, "", cells);
    json["steps"] = {{"control", "approach"}, {"values", {0.045}}};
    const std::string scene = write("scene.json", json);
    const ProgramOutput output = ents_host("run " + scene),
                        as_json = ents_host("run " + scene + " --json"); // the warning comes first
    const bool told = output.text.find("no bound of the estimated contact is known") != std::string::npos;
    EXPECT_EQ(told, cells == 9) << output.text;
    EXPECT_EQ(output.text.find("ents-lab: warning: the shortest wave") == 0, cells == 9) << output.text;
    const Json result = Json::parse(as_json.text.substr(as_json.text.find('{')));
    EXPECT_EQ(result.at("resolution").at("too_coarse"), cells == 9);
    EXPECT_EQ(result.at("steps").at(0).at("contact_estimate").at("error").is_null(), cells == 9);
  }
}

int widest_line(const std::string& text) {
  int widest = 0;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.find("  ") != std::string::npos) // of a table
      widest = std::max(widest, display_width(line));
  return widest;
}

// Boundary elements have six quantities: the table of a scan was 260 columns wide.
TEST_F(Program, TablesFitIntoATerminal) {
  Json layer = wave_scene(1, "", 20);
  layer["steps"] = {{"control", "approach"}, {"values", {0.045}}};
  layer["exact"] = {{"type", "boundary_elements"}, {"points", 40}};
  layer["compare"] = {{"divisions", {20, 40}}};
  layer["variants"] = {{"finer", {{"exact", {{"points", 20}}}}}};
  const std::string scene = write("layer.json", layer), plane = write("plane.json", small());
  for (const std::string& command :
       {"run " + scene, "run " + scene + " --compare", "variants " + scene, "check " + scene, "run " + plane,
        "run " + plane + " --compare 3,6",
        "verify " + quoted(fs::path(EXAMPLES) / ".." / "tests" / "mechanics" / "golden") + "/*.json"}) {
    const ProgramOutput output = ents_host(command);
    EXPECT_EQ(output.exit_code, 0) << output.text;
    EXPECT_GT(widest_line(output.text), 20) << command;
    EXPECT_LE(widest_line(output.text), Table::terminal_width) << command << "\n" << output.text;
  }
}

} // namespace
} // namespace host::test::resolution_test
