// SPDX-License-Identifier: BSD-3-Clause
// The key "below" and the command sublaw: short waves as the laws of places, against boundary elements with all
// waves; and what is wrong in their input.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>

#include "program.hpp"
#include "removed_waves.hpp"
#include "support.hpp"

namespace host::below_test {
namespace {

namespace fs = std::filesystem;

/// A folder of what is kept, for this test alone.
class Below : public testing::Test {
protected:
  Below() : folder_(fs::path(testing::TempDir()) / "ents_below_test") {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    setenv("ENTS_CACHE", (folder_ / "cache").c_str(), 1);
  }
  ~Below() override {
    unsetenv("ENTS_CACHE");
    fs::remove_all(folder_);
  }
  fs::path folder_;
};

/// A quarter of the scene rough_afm, four nodes in a wave of the length of the cut.
Scene part_of_scan(double cut) {
  return test::shipped_scene("rough_afm", [&](Json& json) {
    for (const char* axis : {"x", "y"})
      json["parts"][0][axis]["pieces"][0] = {{"to", 5.5}, {"divisions", std::lround(4 * 2.5 / cut)}};
    json["steps"]["values"] = {0.06, 0.08, 0.1};
    json["exact"]["points"] = 128;
    json["contact"].erase("law");
    json["contact"]["below"] = {{"cut", cut}, {"law", "boundary_elements"}, {"points", 128}};
  });
}

// Wherever the cut is: mean pressure and stiffness within 2 %, area within 5 %.
TEST_F(Below, TheResultDoesNotDependOnTheCut) {
  for (const double cut : {0.3125, 0.625}) {
    const Scene scene = part_of_scan(cut);
    Simulation simulation(scene, &test::library());
    double before[2] = {};
    for (const StepRecord& record : solve(simulation, {})) {
      const Quantity &pressure = test::quantity(record, "mean pressure"),
                     &area = test::quantity(record, "contact fraction");
      std::printf("cut %g: area %.2f %% %+.1f %%; pressure %+.2f %%\n", cut, 100 * area.exact,
                  100 * area.error, 100 * pressure.error);
      EXPECT_NEAR(area.error, 0, 0.05) << cut;
      EXPECT_NEAR(pressure.error, 0, 0.02) << cut;
      if (before[0] > 0) {
        EXPECT_NEAR((pressure.value - before[0]) / (pressure.exact - before[1]), 1, 0.02) << cut;
      }
      before[0] = pressure.value, before[1] = pressure.exact;
      // One place, one row: the springs of a place are one in all results.
      EXPECT_EQ(record.areas.size(), record.fields.pressure.size());
      double force = 0;
      for (std::size_t k = 0; k < record.areas.size(); ++k)
        force += record.areas[k] * record.fields.pressure[k];
      EXPECT_NEAR(force, record.force, 0.02 * record.force)
          << cut; // the normals are not all along the motion
    }
  }
}

TEST_F(Below, WrongScenesAreNamed) {
  const auto expect = [](const std::function<void(Json&)>& edit, const std::string& text) {
    std::string message;
    try {
      const Scene scene = test::shipped_scene("rough_afm", [&](Json& json) {
        json["contact"].erase("law");
        json["contact"]["below"] = {{"cut", 0.3125}};
        for (const char* axis : {"x", "y"}) json["parts"][0][axis]["pieces"][0]["divisions"] = 4;
        json.erase("exact");
        edit(json);
      });
      Simulation simulation(scene, &test::library());
    } catch (const InputError& error) {
      message = error.what();
    }
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  expect([](Json& json) { json["contact"]["below"]["cut"] = 0; }, "/contact/below/cut: a wavelength > 0");
  expect([](Json& json) { json["contact"]["below"].erase("cut"); }, "cut");
  expect([](Json& json) { json["contact"]["below"]["law"] = "greenwood"; }, "boundary_elements");
  expect([](Json& json) { json["contact"]["cut_off"] = 0.2; }, "leave one of the two keys out");
  expect([](Json& json) { json["contact"]["law"] = "hard"; }, "leave \"law\" out");
  expect([](Json& json) { json["contact"]["sampling"] = 2; }, "/contact/below: is for the nodes");
  expect([](Json& json) { json["contact"]["below"]["cut"] = 0.05; },
         "/contact/below: the height has no waves shorter");
}

TEST_F(Below, SublawWritesThePartOfAModel) {
  const std::string model = (folder_ / "model.json").string(), out = (folder_ / "out").string();
  std::ofstream(model)
      << R"({"segment": "quad4", "height": {"type": "roughness", "seed": 7, "rms": 0.01, "hurst": 0.8,
    "wavelengths": [0.125, 0.5, 0.5], "size": [1, 1]}})";
  const std::string command = "sublaw \"" + model +
                              "\" --from 0.3 --modulus 1000 --poisson 0.3 --conductivity 2 "
                              "--realisations 2 --no-pictures --json --out \"" +
                              out + "\"";
  const test::ProgramOutput output = test::ents_host(command);
  ASSERT_EQ(output.exit_code, 0) << output.text;
  const Json result = parse_json_file(fs::path(out) / "sublaw.json");
  EXPECT_FALSE(result.at("kept").get<bool>());
  EXPECT_EQ(result.at("realisations"), 2);
  EXPECT_NEAR(result.at("tangential_over_normal").get<double>(), 1.4 / 1.7, 1e-12);
  const Json& levels = result.at("levels");
  ASSERT_GT(levels.size(), 8u);
  for (std::size_t k = 1; k < levels.size(); ++k) {
    EXPECT_GT(levels[k].at("gap"), levels[k - 1].at("gap"));
    EXPECT_LT(levels[k].at("area"), levels[k - 1].at("area"));
    EXPECT_NEAR(levels[k].at("conductance_over_conductivity").get<double>() * 1000,
                levels[k].at("normal_stiffness").get<double>(),
                1e-9 * levels[k].at("normal_stiffness").get<double>());
  }
  // The library reads the part as it is.
  Json whole = parse_json_file(fs::path(out) / "law.json");
  whole["segment"] = "quad4";
  EXPECT_NO_THROW(EntsModel(test::library(), whole.dump(), folder_, "law.json"));
  EXPECT_TRUE(whole.at("contact").at("heat").contains("table"));
  // The second time nothing is computed.
  ASSERT_EQ(test::ents_host(command).exit_code, 0);
  EXPECT_TRUE(parse_json_file(fs::path(out) / "sublaw.json").at("kept").get<bool>());
  const auto refused = [&](const std::string& arguments, const std::string& text) {
    const test::ProgramOutput wrong = test::ents_host("sublaw \"" + model + "\" " + arguments);
    EXPECT_EQ(wrong.exit_code, 2) << wrong.text;
    EXPECT_NE(wrong.text.find(text), std::string::npos) << wrong.text;
  };
  refused("--from 0.3", "--modulus is required");
  refused("--from 0.01 --modulus 1000", "no waves between");
  refused("--from 0.3 --to 0.4 --modulus 1000", "--to 0.4");
  refused("--from 3 --modulus 1000", "--from 3");
}

} // namespace
} // namespace host::below_test
