// SPDX-License-Identifier: BSD-3-Clause
// Run with a PATH that holds no gnuplot.
#include "output/pictures.hpp"

#include <gtest/gtest.h>

namespace pictures_without_gnuplot_test {
namespace {

using namespace host::pictures;

TEST(PicturesWithoutGnuplot, NameThePackageAndLeaveDataAndScript) {
  ASSERT_FALSE(gnuplot_available());
  Chart chart;
  chart.curves = {{.label = "p", .x = {0, 1}, .y = {1, 2}, .style = Style::both, .fit_order = false}};
  const auto folder = std::filesystem::temp_directory_path() / "ents_without_gnuplot_test";
  const Outcome outcome = draw(chart, folder, "chart");
  EXPECT_TRUE(outcome.files.empty());
  EXPECT_NE(outcome.problem.find("gnuplot-nox"), std::string::npos);
  EXPECT_EQ(outcome.problem.find('\n'), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "chart.dat"));
  EXPECT_TRUE(std::filesystem::exists(folder / "chart.gp"));
  std::filesystem::remove_all(folder);
}

} // namespace
} // namespace pictures_without_gnuplot_test
