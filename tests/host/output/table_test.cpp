// SPDX-License-Identifier: BSD-3-Clause
#include "output/table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <limits>
#include <sstream>

namespace table_test {
namespace {

using host::format_number;
using host::Table;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) out.push_back(line);
  return out;
}

Table sample() {
  Table table;
  table.column("load").column("peak", "MPa").column("error", "%", 3).column("scene").column("Δu", "µm");
  table.row({1, 123.4567, 0.01234, "hertz", 1e-9});
  table.row({10, 1.5, 1.234, "wavy λ", 2.5e-3});
  table.row({200, 0.0, std::nan(""), std::monostate{}, 1.0});
  return table;
}

TEST(Table, AlignsColumnsAndPicksOneNotationPerColumn) {
  EXPECT_EQ(sample().text(), "load   peak  error  scene          Δu\n"
                             "        MPa      %                 µm\n"
                             "────  ─────  ─────  ──────  ─────────\n"
                             "   1  123.5  0.012  hertz   1.000e-09\n"
                             "  10    1.5  1.234  wavy λ  2.500e-03\n"
                             " 200      0      -  -       1.000e+00\n");
}

TEST(Table, EveryLineOfNumbersHasTheSameWidthOnTheTerminal) {
  const auto lines = lines_of(sample().text());
  for (std::size_t i = 2; i < lines.size(); ++i)
    EXPECT_EQ(host::display_width(lines[i]), host::display_width(lines[2])) << lines[i];
}

// A terminal has 120 columns: what does not fit follows below, under the first column again.
TEST(Table, IsBrokenWhereItIsWiderThanATerminal) {
  Table table;
  table.column("step");
  for (const char* name : {"mean pressure", "contact fraction", "pressure (rms of the difference)"})
    table.column(name, "MPa", 5).column("exact", "MPa", 5).beside().column("error", "%", 2).beside();
  table.row({1, 1.25, 1.5, -17.0, 0.5, 0.25, 100.0, 3.0, 2.0, 50.0});
  for (const int width : {120, 100, 60, 40}) {
    const auto lines = lines_of(table.text(width));
    for (const std::string& line : lines) EXPECT_LE(host::display_width(line), std::max(width, 54)) << line;
    const std::size_t parts = 1 + static_cast<std::size_t>(std::count(lines.begin(), lines.end(), ""));
    EXPECT_EQ(parts, width == 120 ? 1u : width == 100 ? 2u : 3u);
    EXPECT_EQ(lines.size(), 5 * parts - 1); // title, unit, rule, one row; a blank line between
    for (std::size_t i = 0; i < lines.size(); i += 5) EXPECT_TRUE(lines[i].starts_with("step  ")) << lines[i];
  }
  // A number never stands apart from its exact value and its error.
  EXPECT_EQ(lines_of(table.text(60))[0], "step  mean pressure   exact  error");
  EXPECT_EQ(table.text(), table.text(Table::terminal_width));
}

TEST(Table, ATableOfOneColumnIsOneTable) {
  Table table;
  table.column("name");
  table.row({std::string(130, 'x')});
  EXPECT_EQ(lines_of(table.text()).size(), 3u);
}

TEST(Table, MarkdownCarriesUnitsInTheHeadAndEscapesBars) {
  Table table;
  table.column("|h| κ").column("gap", "mm", 3);
  table.row({"a|b", 0.25});
  EXPECT_EQ(table.markdown(), "| \\|h\\| κ | gap [mm] |\n|---|---:|\n| a\\|b | 0.250 |\n");
}

TEST(Table, RefusesARowOfTheWrongLengthAndALateColumn) {
  Table table;
  table.column("a").column("b");
  EXPECT_THROW(table.row({1.0}), std::invalid_argument);
  table.row({1.0, 2.0});
  EXPECT_THROW(table.column("c"), std::invalid_argument);
}

TEST(FormatNumber, KeepsTheSignificantDigits) {
  EXPECT_EQ(format_number(0.5), "0.5000");
  EXPECT_EQ(format_number(12345.678), "12346");
  EXPECT_EQ(format_number(1234567.0), "1.235e+06");
  EXPECT_EQ(format_number(1e-3), "0.001000");
  EXPECT_EQ(format_number(1.234e-4), "1.234e-04");
  EXPECT_EQ(format_number(9.9996), "10.00"); // rounding reaches the next power of ten
  EXPECT_EQ(format_number(-2.0 / 3.0, 2), "-0.67");
  EXPECT_EQ(format_number(0), "0");
  EXPECT_EQ(format_number(std::numeric_limits<double>::infinity()), "inf");
}

TEST(FormatNumber, DoesNotDependOnTheLocale) {
  // A locale with a decimal comma, if this machine has one; std::to_chars does not ask for it either way.
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"})
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  EXPECT_EQ(format_number(1.5), "1.500");
  std::setlocale(LC_ALL, "C");
}

TEST(DisplayWidth, CountsWhatTheTerminalShows) {
  EXPECT_EQ(host::display_width("gap"), 3);
  EXPECT_EQ(host::display_width("Δu λ"), 4);
  EXPECT_EQ(host::display_width("p\xCC\x84"), 1); // p with a combining macron
}

} // namespace
} // namespace table_test
