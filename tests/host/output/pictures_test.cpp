// SPDX-License-Identifier: BSD-3-Clause
// Every kind of picture goes through gnuplot without a complaint and leaves its four files, the data bit for
// bit.
#include "output/pictures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "output/gnuplot.hpp"

namespace pictures_test {
namespace {

using namespace host::pictures;

class Pictures : public testing::Test {
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

  void expect_drawn(const Outcome& outcome, const std::string& name) const {
    EXPECT_EQ(outcome.problem, "");
    ASSERT_EQ(outcome.files.size(), 2u);
    EXPECT_TRUE(content(name + ".png").starts_with("\x89PNG"));
    const std::string svg = content(name + ".svg");
    EXPECT_TRUE(svg.starts_with("<?xml"));
    EXPECT_NE(svg.find("</svg>"), std::string::npos); // gnuplot came to the end
    EXPECT_FALSE(std::filesystem::exists(folder_ / (name + ".log")));
  }
};

Curve parabola(const std::string& label, double factor) {
  Curve curve;
  curve.label = label;
  for (int i = 1; i <= 5; ++i) curve.x.push_back(0.1 * i), curve.y.push_back(factor * 0.01 * i * i);
  return curve;
}

TEST_F(Pictures, ChartWithGuides) {
  Chart chart;
  chart.title = "rough_afm {pressure} & 'quotes' \\ ~";
  chart.x = {
      .label = "x", .unit = "mm", .logarithmic = false, .min = automatic, .max = automatic, .tic_step = 0};
  chart.curves = {parabola("exact", 1), parabola("computed", 1.1)};
  chart.curves[0].style = Style::exact;
  chart.guides = {{"half-width a", 0.3, true}, {"limit", 0.2, false}};
  expect_drawn(draw(chart, folder_, "chart"), "chart");
  EXPECT_NE(content("chart.svg").find("rough_afm"), std::string::npos); // not read as a subscript
  for (const double value : chart.curves[1].y)
    EXPECT_NE(content("chart.dat").find(std::string(" ").append(gnuplot::number(value)) + "\n"),
              std::string::npos);
}

TEST_F(Pictures, ConvergenceShowsTheFittedOrder) {
  Chart chart;
  chart.x.logarithmic = chart.y.logarithmic = true;
  chart.curves = {parabola("force", 1)};
  chart.curves[0].fit_order = true;
  chart.slope_triangle = 2;
  expect_drawn(draw(chart, folder_, "order"), "order");
  EXPECT_NE(content("order.gp").find("force, order 2.00"), std::string::npos);
}

TEST_F(Pictures, AnErrorOverTheNumberOfSegmentsHasTheSameOrder) {
  Chart chart;
  chart.x.logarithmic = chart.y.logarithmic = true;
  Curve curve;
  curve.label = "force", curve.fit_order = true;
  for (const double n : {4., 8., 16., 32.}) curve.x.push_back(n), curve.y.push_back(1 / (n * n));
  chart.curves = {curve};
  chart.slope_triangle = 2;
  expect_drawn(draw(chart, folder_, "falling"), "falling");
  EXPECT_NE(content("falling.gp").find("force, order 2.00"), std::string::npos);
}

TEST_F(Pictures, ResidualHistoryNamesAFewOfManySteps) {
  const std::vector<std::vector<double>> steps(12, {1, 1e-2, 1e-5, 1e-11, 0});
  const Chart chart = residual_history("residual", steps);
  int named = 0;
  for (const Curve& curve : chart.curves) named += curve.label.empty() ? 0 : 1;
  EXPECT_EQ(chart.curves.size(), 12u);
  EXPECT_LE(named, 6);
  expect_drawn(draw(chart, folder_, "newton"), "newton"); // a residual of zero has no logarithm: left out
}

TEST_F(Pictures, MapsWithBlanksAndAClippedPeak) {
  Maps maps;
  maps.title = "pressure";
  Map map;
  map.title = "p", map.unit = "MPa", map.columns = 3, map.rows = 2, map.values = {0, 1, 2, 3, 4, 1000};
  map.blank_zero = true, map.clip = 0.8;
  Map flat = map;
  flat.values.assign(6, 7.0), flat.palette = Map::Palette::diverging, flat.blank_zero = false;
  maps.maps = {map, flat};
  expect_drawn(draw(maps, folder_, "maps"), "maps");
  EXPECT_NE(content("maps.gp").find("set cbrange [0:4]"), std::string::npos);
  EXPECT_NE(content("maps.gp").find("peak 1000"), std::string::npos);
  maps.maps[0].at_nodes = true; // 3 columns from 0 to 1: pixels of 0.5, the outer ones centred on the border
  expect_drawn(draw(maps, folder_, "nodes"), "nodes");
  EXPECT_NE(content("nodes.gp").find("set xrange [-0.25:1.25]"), std::string::npos);
  EXPECT_NE(content("nodes.gp").find("(0+$1*0.5)"), std::string::npos);
  maps.maps[0].values.pop_back();
  EXPECT_THROW(draw(maps, folder_, "maps"), std::invalid_argument);
}

// Three maps side by side are narrow. Every letter is taken as 0.6 of its height, more than the mean of the
// font.
TEST_F(Pictures, NotesUnderMapsDoNotMeet) {
  Maps maps;
  maps.title = "pressure";
  Map map;
  map.title = "p", map.columns = 3, map.rows = 2, map.values = {-123.4, 1, 2, 3, 4, -1234.5}, map.clip = 0.6;
  maps.maps = {map, map, map};
  maps.maps[1].blank_zero = true;
  expect_drawn(draw(maps, folder_, "notes"), "notes");
  const std::string script = content("notes.gp");
  const auto number_after = [&](const char* word, std::size_t from) {
    return std::stod(script.substr(script.find(word, from) + std::string(word).size()));
  };
  const double width = number_after("set terminal svg enhanced size ", 0);
  std::map<double, std::vector<std::pair<double, double>>> rows; // by height: left and right ends
  for (std::size_t at = 0; (at = script.find("right font ',10.5'", at)) != std::string::npos; ++at) {
    const std::size_t line = script.rfind('\n', at) + 1;
    const std::string words = script.substr(line, script.find("' at ", line) - line);
    const double letters = static_cast<double>(words.size() - std::string("set label '").size()),
                 right = width * number_after("' at screen ", line);
    rows[number_after(", screen ", line)].emplace_back(right - 0.6 * 10.5 * letters, right);
  }
  EXPECT_EQ(rows.size(), 2u);
  for (const auto& [height, notes] : rows) {
    ASSERT_EQ(notes.size(), 3u);
    double last = 0;
    for (const auto& [left, right] : notes) {
      EXPECT_GT(left, last) << height;
      last = right;
    }
    EXPECT_LE(last, width);
  }
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

TEST_F(Pictures, SurfaceWithMarkedPlacesInThePlaneAndInSpace) {
  for (const int dimension : {2, 3}) {
    const std::string name = "check" + std::to_string(dimension);
    expect_drawn(draw(sine_surface(dimension), folder_, name), name);
    EXPECT_NE(content(name + ".svg").find("edge height 0.01 mm"), std::string::npos);
  }
  Surface wrong = sine_surface(3);
  wrong.height.pop_back();
  EXPECT_THROW(draw(wrong, folder_, "wrong"), std::invalid_argument);
}

TEST_F(Pictures, AFolderThatCannotBeWrittenIsAProblemAndNoException) {
  Chart chart;
  chart.curves = {parabola("p", 1)};
  EXPECT_NE(draw(chart, "/proc/no", "chart").problem, "");
}

} // namespace
} // namespace pictures_test
