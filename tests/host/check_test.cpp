// SPDX-License-Identifier: BSD-3-Clause
// ents-lab check: exit codes, what is printed, and the picture. What the numbers mean is tested in
// tests/mechanics.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "check_mesh.hpp"
#include "ents_library.hpp"
#include "program.hpp"

namespace host::test::check_test {
namespace {

std::string quoted(const std::filesystem::path& file) {
  return std::string("'").append(file.string()).append("'");
}

class Check : public testing::Test {
protected:
  Check()
      : folder_(
            std::filesystem::temp_directory_path() /
            (std::string("ents_check_") + testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~Check() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& name, const Json& json) const {
    std::ofstream(folder_ / name) << json;
    return quoted(folder_ / name);
  }
  std::string content(const std::filesystem::path& file) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / file).rdbuf();
    return text.str();
  }
  static const Json& condition(const Json& result, const std::string& name) {
    for (const Json& entry : result.at("conditions"))
      if (entry.at("name") == name) return entry;
    throw std::runtime_error("no condition " + name + " in " + result.dump());
  }
  ProgramOutput check(const std::string& model, const std::string& more) const {
    return ents_host("check " + model + " " + more);
  }
  Json result(const std::string& model, const std::string& more, int exit_code) const {
    const ProgramOutput output = check(model, more + " --json");
    EXPECT_EQ(output.exit_code, exit_code) << output.text;
    return Json::parse(output.text);
  }

  std::filesystem::path folder_;
  const Json roof_ = {{"nodes", {{0, 0}, {1, 0.5}, {2, 0}}}, {"segments", {{0, 1}, {1, 2}}}};
};

// The four panels of Fig. 4 as a user meets them: a model, a mesh, and an exit code with a reason.
TEST_F(Check, TheFourPanelsOfFigureFour) {
  const double pi = std::acos(-1.0);
  const Json flat = {{"nodes", {{0, 0}, {1, 0}, {2, 0}}},
                     {"segments", {{0, 1}, {1, 2}}},
                     {"surface_coordinates", {{0}, {1}, {2}}}};
  const std::string mesh = " --mesh " + write("flat.json", flat);
  const Json wave = {{"type", "sine"}, {"amplitude", 0.05}, {"wave_vector", {1}}};
  // a: two projections beyond the radius 1 / (a k^2)
  const double radius = 1 / (0.05 * 4 * pi * pi);
  const std::string a = write("a.json", {{"segment", "line2"}, {"height", wave}});
  EXPECT_EQ(check(a, mesh + " --reach " + std::to_string(0.99 * radius)).exit_code, 0);
  const Json two = result(a, mesh + " --reach " + std::to_string(1.5 * radius), 1);
  EXPECT_NEAR(condition(two, "projection").at("value").get<double>(), radius, 1e-9);
  EXPECT_NEAR(condition(two, "projection").at("missing").get<double>(), 0.5 * radius,
              2e-6); // digits of --reach
  // b: self-shadow
  const auto lit = [&](double x) {
    return write("b.json", {{"segment", "line2"},
                            {"height", wave},
                            {"projection", {{"type", "shadow_direction"}, {"direction", {x, 1}}}}});
  };
  EXPECT_EQ(check(lit(1), mesh).exit_code, 0);
  const Json dark = result(lit(4), mesh, 1);
  EXPECT_TRUE(condition(dark, "shadow").at("violated").get<bool>());
  EXPECT_TRUE(condition(dark, "occlusion").at("violated").get<bool>());
  // c: the height does not vanish on the edges
  const auto local = [&](double edge) {
    return write("c.json", {{"segment", "line2"},
                            {"height", {{"type", "polynomial"}, {"coefficients", {0.1 + edge, 0, -0.1}}}}});
  };
  const std::string roof = " --mesh " + write("roof.json", roof_);
  EXPECT_EQ(check(local(0), roof).exit_code, 0);
  const Json torn = result(local(0.02), roof, 1);
  EXPECT_NEAR(condition(torn, "jump").at("value").get<double>(), 0.04 * std::sin(std::atan(0.5)), 1e-12);
  EXPECT_TRUE(condition(torn, "edge").at("violated").get<bool>());
  EXPECT_EQ(torn.at("failing_segments"), Json({0, 1}));
  // d: the surface folds (a parabola under a height beyond its radius 1.25), and neighbours cross (a valley)
  const auto deep = [&](double h) {
    return write("d.json", {{"segment", "line3"},
                            {"surface_coordinates", {{0}, {2}, {1}}},
                            {"height", {{"type", "constant"}, {"value", h}}}});
  };
  const std::string arc =
      " --mesh " + write("arc.json", {{"nodes", {{-1, 0}, {1, 0}, {0, 0.4}}}, {"segments", {{0, 1, 2}}}});
  EXPECT_EQ(check(deep(-1.2), arc).exit_code, 0);
  EXPECT_NEAR(condition(result(deep(-1.3), arc, 1), "fold").at("value").get<double>(), 1.04, 1e-12);
  const std::string valley = " --mesh " + write("valley.json", {{"nodes", {{0, 0.5}, {1, 0}, {2, 0.5}}},
                                                                {"segments", {{0, 1}, {1, 2}}}});
  const std::string even =
      write("even.json", {{"segment", "line2"}, {"height", {{"type", "constant"}, {"value", 0.02}}}});
  const Json crossed = result(even, valley, 1);
  EXPECT_TRUE(condition(crossed, "crossing").at("violated").get<bool>());
  EXPECT_NEAR(condition(crossed, "crossing").at("value").get<double>(),
              0.02 * (1 - std::cos(2 * std::atan(0.5))), 1e-9);
}

TEST_F(Check, SaysWhatFailsWhereAndByHowMuch) {
  const std::string model =
      write("model.json",
            {{"segment", "line2"}, {"height", {{"type", "polynomial"}, {"coefficients", {0.12, 0, -0.1}}}}});
  const std::string mesh = " --mesh " + write("roof.json", roof_);
  const ProgramOutput text = check(model, mesh + " --kink 10");
  EXPECT_EQ(text.exit_code, 1);
  for (const char* words :
       {"FAILS", "not admissible: neighbours meet: largest jump of rho_e at an edge is 0.01789",
        "segment 0, xi = 1.000; segment 1, xi = -1.000", "2 of 2 segments fail", "bound <= 10.0"})
    EXPECT_NE(text.text.find(words), std::string::npos) << words << "\n" << text.text;
  const Json json = result(model, mesh, 1);
  const Json& jump = condition(json, "jump");
  EXPECT_EQ(jump.at("segment"), 0);
  EXPECT_EQ(jump.at("other"), 1);
  EXPECT_EQ(jump.at("xi"), Json({1.0}));
  EXPECT_EQ(jump.at("other_xi"), Json({-1.0}));
  EXPECT_EQ(jump.at("point").size(), 2u);
  EXPECT_FALSE(condition(json, "kink").at("judged").get<bool>());
  EXPECT_FALSE(condition(json, "kink").contains("bound"));
}

// The shipped scan on its one segment: admissible, with two projections beyond some nanometres.
TEST_F(Check, AMeasuredSurface) {
  const Json scene = parse_json_file(std::filesystem::path(EXAMPLES) / "rough_afm" / "scene.json");
  Json text = scene.at("contact").at("model");
  text["height"]["file"] =
      std::filesystem::absolute(std::filesystem::path(EXAMPLES) / "rough_afm" / "afm_10um_256.txt").string();
  const std::string model = write("model.json", text);
  const std::string mesh =
      " --samples 257 --mesh " + write("mesh.json", {{"nodes", scene.at("contact").at("master").at("nodes")},
                                                     {"segments", {{0, 1, 2, 3}}}});
  const Json wide = result(model, mesh, 0);
  EXPECT_EQ(condition(wide, "continuity").at("value"), 2.0);
  const double least = condition(wide, "projection").at("value").get<double>();
  EXPECT_GT(least, 0.0);
  const Json near = result(model, mesh + " --reach " + std::to_string(10 * least), 1);
  EXPECT_LE(condition(near, "projection").at("value").get<double>(), least);
  EXPECT_EQ(condition(near, "projection").at("segment"), 0);
}

// What is left out is the library's decision: the bits of the layout, in words.
TEST_F(Check, SaysWhatTheSceneNeeds) {
  const Json penalty = {{"normal", {{"type", "penalty"}, {"stiffness", 1}}}};
  const Json friction = {{"normal", {{"type", "augmented_multiplier"}, {"stiffness", 1}}},
                         {"friction", {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 1}}}};
  const Json wave = {{"type", "sine"}, {"amplitude", 0.01}, {"wave_vector", {1, 0}}},
             even = {{"type", "constant"}, {"value", 0.01}};
  const std::string
      enriched = "a height (not zero)",
      varies = "slopes of the height (it varies)", iterated = "iterations of the projection (no closed form)",
      turns = "a normal that turns (curved or warped segments)",
      deforms = "forces and stiffness of the master (it deforms)",
      frictionless = "friction (none in the model), history (forces follow from positions "
                     "alone), multipliers as unknowns (none in the law), ",
      rare = "temperatures of the nodes (no heat in the law), bonds of the undeformed bodies (none "
             "in the law)",
      plain = "a height (zero everywhere), a normal that turns (flat segments), iterations of "
              "the projection (closed form)";
  struct {
    Json model;
    std::string needs, does_not_need;
  } const cases[] = {
      {{{"segment", "line2"}, {"contact", penalty}}, deforms, plain + ", " + frictionless + rare},
      {{{"segment", "tri3"},
        {"master", "rigid"},
        {"contact", penalty},
        {"height", {{"type", "constant"}, {"value", 0}}}},
       "positions alone",
       plain + ", forces and stiffness of the master (it is rigid), " + frictionless + rare},
      {{{"segment", "quad4"}, {"contact", penalty}, {"height", wave}},
       enriched + ", " + varies + ", " + turns + ", " + iterated + ", " + deforms,
       frictionless + rare},
      {{{"segment", "quad4"}, {"master", "rigid"}, {"contact", penalty}, {"height", even}},
       enriched + ", " + turns + ", " + iterated,
       "slopes of the height (it is constant), forces and stiffness of the master (it is rigid), " +
           frictionless + rare},
      {{{"segment", "quad9"}, {"contact", friction}, {"height", wave}},
       enriched + ", " + varies + ", " + turns + ", " + iterated + ", " + deforms +
           ", friction (in the model), history (forces depend on it), multipliers as unknowns (in the law)",
       rare},
  };
  const char* const names[] = {"height",     "slope",        "curved",     "iteration",
                               "master",     "friction",     "history",    "multipliers",
                               "one_by_one", "temperatures", "first_state"};
  const EntsLibrary library;
  for (const auto& c : cases) {
    const std::string file = write("model.json", c.model);
    const ProgramOutput text = check(file, "");
    std::string expected = "this scene needs: " + c.needs + "\n";
    if (!c.does_not_need.empty()) expected += "it does not need: " + c.does_not_need + "\n";
    EXPECT_EQ(text.text.substr(0, text.text.find("kernels: ")), expected) << c.model;
    const EntsModel model(library, c.model.dump(), "", "here");
    const std::string set = model.layout().instruction_set;
    EXPECT_NE(text.text.find((model.layout().needs & ENTS_NEEDS_ONE_BY_ONE) != 0
                                 ? "kernels: " + set + ", elements one after the other"
                                 : "kernels: " + set + ", several"),
              std::string::npos)
        << text.text;
    EXPECT_NE(text.text.find("element: " + std::to_string(model.layout().nodes) + " master nodes, " +
                             std::to_string(model.layout().state_size) + " history variables"),
              std::string::npos)
        << text.text;
    const Json json = result(file, "", text.exit_code);
    EXPECT_EQ(json.at("instruction_set").get<std::string>(), set);
    std::vector<std::string> by_bit[2]; // not needed, needed
    for (int bit = 0; bit < 11; ++bit) by_bit[model.layout().needs >> bit & 1].push_back(names[bit]);
    EXPECT_EQ(json.at("needs").get<std::vector<std::string>>(), by_bit[1]);
    EXPECT_EQ(json.at("does_not_need").get<std::vector<std::string>>(), by_bit[0]);
  }
}

// Without a mesh: one segment that does nothing but carry its natural coordinates, whatever its basis.
TEST_F(Check, WithoutAMeshNodesLieAtNaturalCoordinates) {
  const EntsLibrary library;
  for (const std::string name : {"line2", "line3", "catmull_rom4", "bspline4", "tri3", "tri6", "quad4",
                                 "quad8", "quad9", "catmull_rom16", "bspline16", "bezier15"}) {
    const Json text = {{"segment", name}};
    const EntsModel model(library, text.dump(), "", "here");
    const auto d = static_cast<std::size_t>(model.layout().dimension);
    const std::vector<double> xi = even_grid(model.layout().parameters, 7, is_triangle(name));
    const MasterSurface surface = read_surface("", name, model.layout());
    const SurfaceSample sample = sample_surface(model, surface.master(0), {}, xi);
    for (std::size_t k = 0; k < xi.size() / (d - 1); ++k) {
      for (std::size_t i = 0; i + 1 < d; ++i)
        EXPECT_NEAR(sample.point[k * d + i], xi[k * (d - 1) + i], 1e-14) << name;
      EXPECT_EQ(sample.point[k * d + d - 1], 0) << name;
    }
    const Json json = result(write("model.json", text), "", 0);
    const bool triangle = name.starts_with("tri") || name == "bezier15";
    EXPECT_EQ(json.at("surface_coordinates").at("low"), Json(std::vector<double>(d - 1, triangle ? 0. : -1.)))
        << name;
    EXPECT_EQ(json.at("surface_coordinates").at("high"), Json(std::vector<double>(d - 1, 1.))) << name;
  }
}

// Without a law of contact there is no element, and no kernel that could be too slow for it.
TEST_F(Check, AModelWithoutContactHasNoKernel) {
  const std::string model = write("model.json", {{"segment", "line2"}});
  const ProgramOutput text = check(model, "");
  EXPECT_NE(text.text.find("kernels: no contact law in the model"), std::string::npos) << text.text;
  EXPECT_EQ(result(model, "", 0).at("instruction_set"), nullptr);
}

// Ten micrometres on a segment of ten lengths: right with "length_unit" 1e-6; without it the map
// covers 1e-6 of the segment.
TEST_F(Check, AMapThatCoversLessThanTheSegmentsIsAWarning) {
  {
    std::ofstream file(folder_ / "map.txt");
    file << "# Channel: z\n# Width: 10.00 \xC2\xB5m\n# Height: 5 um\n# Value units: m\n";
    for (int j = 0; j < 41; ++j, file << "\n")
      for (int i = 0; i < 41; ++i) file << (i + j) * 1e-9 << " ";
  }
  const auto model = [&](const Json& more) {
    Json map = {{"type", "map"}, {"file", "map.txt"}, {"boundary", "clamped"}};
    map.update(more);
    return write("model.json",
                 {{"segment", "quad4"},
                  {"surface_coordinates", {{0, 0}, {10, 0}, {10, 5}, {0, 5}}},
                  {"height", {{"type", "sum"}, {"of", {{{"type", "constant"}, {"value", 1}}, map}}}}});
  };
  const std::string mesh =
      " --samples 9 --mesh " + write("mesh.json", {{"nodes", {{0, 0, 0}, {10, 0, 0}, {10, 5, 0}, {0, 5, 0}}},
                                                   {"segments", {{0, 1, 2, 3}}}});
  const std::string good = model({{"length_unit", 1e-6}});
  EXPECT_EQ(check(good, mesh).text.find("warning"), std::string::npos);
  const Json right = result(good, mesh, check(good, mesh).exit_code);
  EXPECT_NEAR(right.at("height_range")[0].get<double>(), 1, 1e-12);
  // The last sample is a pixel before the corner; there a plane goes on by (c_n+1 + 4 c_n + c_n-1) / 6 with
  // c_n+1 = c_n-1.
  EXPECT_NEAR(right.at("height_range")[1].get<double>(), 1 + 0.08 + 2 * 4. / 6 * 1e-3, 1e-12);
  EXPECT_EQ(right.at("maps")[0].at("path"), "/height/of/1");
  for (std::size_t i :
       {0u, 1u}) // 41 samples: their pixels cover the stated width, they themselves 40 of them
    EXPECT_NEAR(right.at("maps")[0].at("high")[i].get<double>(), (i == 0 ? 10. : 5.) * 40 / 41, 1e-12);
  EXPECT_TRUE(right.at("maps")[0].at("covers_segments").get<bool>());
  for (const Json& more : {Json(Json::object()), Json{{"length_unit", 1e-6}, {"origin", {3, 0}}}}) {
    const std::string bad = model(more);
    const ProgramOutput text = check(bad, mesh);
    for (const char* words : {"warning: the map /height/of/1", "length_unit", "over s1 = 0 .. 10.00"})
      EXPECT_NE(text.text.find(words), std::string::npos) << words << "\n" << text.text;
    EXPECT_FALSE(result(bad, mesh, text.exit_code).at("maps")[0].at("covers_segments").get<bool>());
  }
  EXPECT_EQ(check(model({{"size", {0.1, 0.1}}, {"boundary", "periodic"}}), mesh).text.find("warning"),
            std::string::npos);
}

TEST_F(Check, WrongInputIsExitCodeTwo) {
  const std::string good = write("good.json", {{"segment", "line2"}});
  EXPECT_EQ(check(good, "").exit_code, 0);
  EXPECT_EQ(check(quoted(folder_ / "none.json"), "").exit_code, 2);
  EXPECT_EQ(check(write("model.json", {{"segment", "line7"}}), "").exit_code, 2);
  EXPECT_EQ(check(write("model.json", {{"segment", "line2"}, {"patch", {{0, 1}, {1, 2}}}}), "").exit_code, 2);
  EXPECT_EQ(check(good, "--reach -1").exit_code, 2);
  EXPECT_EQ(check(good, "--kink 200").exit_code, 2);
  const ProgramOutput corners =
      check(good, "--mesh " + write("mesh.json", {{"nodes", {{0, 0}, {1, 0}}}, {"segments", {{0, 1, 2}}}}));
  EXPECT_EQ(corners.exit_code, 2);
  EXPECT_NE(corners.text.find("the model's segment has 2 nodes, here are 3"), std::string::npos)
      << corners.text;
  // a mesh that is read and has no normal: the job fails
  const ProgramOutput degenerate =
      check(good, "--mesh " + write("mesh.json", {{"nodes", {{1, 1}, {1, 1}}}, {"segments", {{0, 1}}}}));
  EXPECT_EQ(degenerate.exit_code, 1);
  EXPECT_NE(degenerate.text.find("segment 0"), std::string::npos) << degenerate.text;
}

// The picture shows every segment, those that fail in their own colour, and the worst places.
TEST_F(Check, ThePictureMarksTheOffences) {
  const Json sheet = {
      {"nodes",
       {{0, 0, 0}, {1, 0, 0}, {2, 0, 0.5}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0.5}, {-1, 0, 0}, {-1, 1, 0}}},
      {"segments", {{0, 1, 4, 3}, {1, 2, 5, 4}, {6, 0, 3, 7}}},
      {"surface_coordinates", {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {-1, 0}, {-1, 1}}}};
  const Json bump = {{"type", "gaussian"}, {"amplitude", 0.1}, {"center", {1, 0.5}}, {"width", 0.1}};
  const std::string model = write("model.json", {{"segment", "quad4"}, {"height", bump}});
  const std::string out = " --out " + quoted(folder_ / "out");
  EXPECT_EQ(result(model, "--mesh " + write("sheet.json", sheet) + out, 1).at("failing_segments"),
            Json({0, 1}));
  const Json picture = Json::parse(content("out/pictures.json"))[0];
  EXPECT_EQ(picture.at("wrong"), Json({true, true, false}));
  EXPECT_EQ(picture.at("subtitle"), "3 segments");
  EXPECT_NE(picture.at("places").dump().find("neighbours meet"), std::string::npos) << picture.at("places");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / "check.png"));
  // in the plane: a red line beside the dark one
  const Json line = {{"nodes", {{0, 0}, {1, 0}, {2, 0}, {3, 1}}},
                     {"segments", {{0, 1}, {1, 2}, {2, 3}}},
                     {"surface_coordinates", {{0}, {1}, {2}, {3}}}};
  const std::string plane =
      write("plane.json", {{"segment", "line2"}, {"height", {{"type", "constant"}, {"value", 0.1}}}});
  EXPECT_EQ(check(plane, "--mesh " + write("line.json", line) + out).exit_code, 1);
  const Json section = Json::parse(content("out/pictures.json"))[0];
  EXPECT_NE(section.at("wrong").dump().find("true"), std::string::npos) << section.at("wrong");
  EXPECT_NE(section.at("places").dump().find("segments do not cross"), std::string::npos);
}

} // namespace
} // namespace host::test::check_test
