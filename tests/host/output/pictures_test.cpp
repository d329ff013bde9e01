// SPDX-License-Identifier: BSD-3-Clause
// Pictures: the numbers reach pictures.json bit for bit, and the script draws every kind of picture from them
// without a complaint. What it draws is looked at in pictures_test.py.
#include "output/pictures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace pictures_test {
namespace {

using namespace host::pictures;

class PicturesTest : public testing::Test {
protected:
  // a blank and a quote: such folders exist
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      (std::string("ents picture's test ") + testing::UnitTest::GetInstance()->current_test_info()->name());

  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string content(const std::string& file) const {
    std::ifstream stream(folder_ / file, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  void expect_drawn(const std::string& name) const {
    EXPECT_TRUE(content(name + ".png").starts_with("\x89PNG")) << name;
    EXPECT_NE(content(name + ".svg").find("</svg>"), std::string::npos) << name;
  }
};

Curve parabola(const std::string& label, double factor) {
  Curve curve;
  curve.label = label;
  for (int i = 1; i <= 5; ++i) curve.x.push_back(0.1 * i), curve.y.push_back(factor * 0.01 * i * i);
  return curve;
}

Chart chart() {
  Chart out;
  out.title = "rough_afm {pressure} & 'quotes' \\ ~ $p$";
  out.x = {
      .label = "x", .unit = "mm", .logarithmic = false, .min = automatic, .max = automatic, .tic_step = 0};
  out.curves = {parabola("exact", 1), parabola("computed", 1.1)};
  out.curves[0].style = Style::exact;
  out.curves[1].y[2] = automatic; // interrupts the line
  out.guides = {{"half-width a", 0.3, true}, {"limit", 0.2, false}};
  return out;
}

Surface sine_surface(int dimension) {
  Surface surface;
  surface.dimension = dimension, surface.columns = 30, surface.rows = dimension == 2 ? 1 : 20;
  for (int j = 0; j < surface.rows; ++j)
    for (int i = 0; i < surface.columns; ++i) {
      const double x = i / 29.0, h = 0.01 * std::sin(10 * x);
      surface.enriched.push_back(x), surface.base.push_back(x);
      if (dimension == 3) surface.enriched.push_back(j / 19.0), surface.base.push_back(j / 19.0);
      surface.enriched.push_back(h), surface.base.push_back(0), surface.height.push_back(h);
    }
  surface.places = {{1, 0, 0, "edge height 0.01 mm", true}, {0.5, 0.5, 0, "smallest reach", false}};
  return surface;
}

Maps maps() {
  Maps out;
  out.title = "pressure";
  Map map;
  map.title = "p", map.unit = "MPa", map.columns = 3, map.rows = 2, map.values = {0, 1, 2, 3, 4, automatic};
  map.blank_zero = true, map.palette = Map::Palette::diverging;
  out.maps = {map};
  return out;
}

TEST_F(PicturesTest, EveryKindIsDrawnFromItsNumbers) {
  Pictures all;
  all.add("chart", chart());
  all.add("newton", residual_history("residual", {{1, 1e-2, 1e-5, 1e-11, 0}}));
  all.add("maps", maps());
  all.add("plane", sine_surface(2));
  all.add("space", sine_surface(3));
  EXPECT_EQ(all.draw(folder_), "");
  for (const char* name : {"chart", "newton", "maps", "plane", "space"}) expect_drawn(name);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "pictures.log"));
  const nlohmann::json data = nlohmann::json::parse(content("pictures.json"));
  EXPECT_EQ(data[0]["curves"][0]["y"].get<std::vector<double>>(), chart().curves[0].y);
  EXPECT_TRUE(data[0]["curves"][1]["y"][2].is_null());
  EXPECT_EQ(data[3]["enriched"].get<std::vector<double>>(), sine_surface(2).enriched);
  EXPECT_EQ(data[2]["maps"][0]["palette"], "diverging");
}

TEST_F(PicturesTest, ResidualHistoryNamesAFewOfManySteps) {
  const std::vector<std::vector<double>> steps(12, {1, 1e-2, 1e-5, 1e-11, 0});
  const Chart history = residual_history("residual", steps);
  int named = 0;
  for (const Curve& curve : history.curves) named += curve.label.empty() ? 0 : 1;
  EXPECT_EQ(history.curves.size(), 12u);
  EXPECT_LE(named, 6);
  EXPECT_TRUE(std::isnan(history.curves[0].y.back())); // a residual of zero has no logarithm: left out
}

TEST_F(PicturesTest, SizesThatDoNotFitAreRefused) {
  Pictures all;
  Chart bad_chart = chart();
  bad_chart.curves[0].y.pop_back();
  EXPECT_THROW(all.add("chart", bad_chart), std::invalid_argument);
  Maps bad_maps = maps();
  bad_maps.maps[0].values.pop_back();
  EXPECT_THROW(all.add("maps", bad_maps), std::invalid_argument);
  Surface bad_surface = sine_surface(3);
  bad_surface.height.pop_back();
  EXPECT_THROW(all.add("surface", bad_surface), std::invalid_argument);
}

TEST_F(PicturesTest, AFolderThatCannotBeWrittenIsAProblemAndNoException) {
  Pictures all;
  all.add("chart", chart());
  EXPECT_NE(all.draw("/proc/no"), "");
}

TEST_F(PicturesTest, WithoutMatplotlibTheDataAreThereAndTheLineNamesThePackage) {
  std::filesystem::create_directories(folder_ / "no");
  std::ofstream(folder_ / "no" / "matplotlib.py") << "raise ImportError\n";
  setenv("PYTHONPATH", (folder_ / "no").c_str(), 1);
  Pictures all;
  all.add("chart", chart());
  const std::string problem = all.draw(folder_);
  unsetenv("PYTHONPATH");
  EXPECT_NE(problem.find("python3-matplotlib"), std::string::npos) << problem;
  EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "chart.png"));
  EXPECT_EQ(nlohmann::json::parse(content("pictures.json")).size(), 1u);
  EXPECT_NE(content("pictures.py").find("def main"), std::string::npos);
}

TEST_F(PicturesTest, WhatAScriptComplainsOfIsTold) {
  std::filesystem::create_directories(folder_);
  std::ofstream(folder_ / "broken.py") << "raise ValueError('no such kind')\n";
  const std::string problem = run_script(folder_, "broken.py");
  EXPECT_NE(problem.find("broken.py: ValueError: no such kind"), std::string::npos) << problem;
}

} // namespace
} // namespace pictures_test
