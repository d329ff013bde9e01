// SPDX-License-Identifier: BSD-3-Clause
// Height-map files: what is read, and the file, line and column in the message when it is not.
#include "abi/read/surface_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "abi/read/model_error.hpp"
#include "abi/read/text_file.hpp"

namespace surface_file_test {
namespace {

using ents::ModelError;
using ents::parse_surface;
using ents::SurfaceFile;
using Values = std::vector<double>;

std::string error_of(std::string_view text) {
  try {
    parse_surface(text, "map.txt");
  } catch (const ModelError& error) {
    EXPECT_EQ(error.status, ENTS_FILE);
    return error.message;
  }
  return "no error";
}

void expect_error(std::string_view text, const std::string& start, const std::string& part) {
  const std::string message = error_of(text);
  EXPECT_EQ(message.substr(0, start.size()), start) << text;
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

const char* gwyddion =
    "# Channel: ZSensor\n# Width: 10.00 \xC2\xB5m\n# Height: 5.0 \xC2\xB5m\n# Value units: nm\n"
    "1.8823e-008\t1\t-2.5\n3\t4\t5\n";

TEST(SurfaceFile, ReadsGwyddionsTextExport) {
  const SurfaceFile surface = parse_surface(gwyddion, "map.txt");
  EXPECT_EQ(surface.rows, 2);
  EXPECT_EQ(surface.columns, 3);
  EXPECT_EQ(surface.values, (Values{1.8823e-8, 1.0, -2.5, 3.0, 4.0, 5.0}));
  EXPECT_TRUE(surface.states_units);
  EXPECT_EQ(surface.width, 10.0 * 1e-6);
  EXPECT_EQ(surface.height, 5.0 * 1e-6);
  EXPECT_EQ(surface.value_unit, 1e-9);
}

TEST(SurfaceFile, KnowsTheSpellingsOfMicro) {
  for (const std::string micro : {"\xC2\xB5", "\xCE\xBC", "\xB5", "u"}) {
    const std::string text =
        "# Width: 2 " + micro + "m\n# Height: 3 mm\n# Value units: " + micro + "m\n1 2\n";
    EXPECT_EQ(parse_surface(text, "map.txt").width, 2.0 * 1e-6);
    EXPECT_EQ(parse_surface(text, "map.txt").value_unit, 1e-6);
  }
}

TEST(SurfaceFile, ReadsPlainMatricesWithEverySeparator) {
  for (const char* text : {"1 2 3\n4 5 6\n", "1\t2\t3\n4\t5\t6", "1,2,3\r\n4,5,6\r\n", "1;2;3\n4;5;6\n",
                           " 1, 2 ,3 \n\n 4,5, 6\n\n",
                           "\xEF\xBB\xBF"
                           "1 2 3\n# a remark\n4 5 6\n",
                           "1 \t 2   3\t\n4 5 6 \n"}) {
    const SurfaceFile surface = parse_surface(text, "map.txt");
    EXPECT_EQ(surface.rows, 2) << text;
    EXPECT_EQ(surface.columns, 3) << text;
    EXPECT_EQ(surface.values, (Values{1, 2, 3, 4, 5, 6})) << text;
    EXPECT_FALSE(surface.states_units);
  }
}

TEST(SurfaceFile, ErrorsNameFileLineAndColumn) {
  expect_error("", "map.txt: ", "no numbers");
  expect_error("# Width: 1 m\n", "map.txt: ", "no numbers");
  expect_error("1 2\n3 x\n", "map.txt, line 2, column 2: ", "\"x\" is not a number");
  expect_error("# a\n\n1 2\n3 nan\n", "map.txt, line 4, column 2: ", "not a number");
  expect_error("1 inf\n", "map.txt, line 1, column 2: ", "not a number");
  expect_error("1 2e999\n", "map.txt, line 1, column 2: ", "outside the range");
  expect_error("1 2\n3 4 5\n", "map.txt, line 2: ", "holds 3 numbers, but line 1 holds 2");
  expect_error("1 2\n3\n", "map.txt, line 2: ", "holds 1 number, but line 1 holds 2");
  expect_error("1,2,\n", "map.txt, line 1, column 3: ", "missing");
  expect_error("1,,2\n", "map.txt, line 1, column 2: ", "missing");
  expect_error(std::string_view("1 2\0 3", 6), "map.txt: ", "zero bytes");
}

// "1,5 2,5" may be four numbers or two: nothing is guessed.
TEST(SurfaceFile, DecimalCommasAreAnError) {
  expect_error("1,5\t2,5\n", "map.txt, line 1, column 1: ", "decimal points");
  expect_error("1,5;2,5\n", "map.txt, line 1, column 1: ", "decimal points");
  expect_error("1,5 2,5\n", "map.txt, line 1, column 2: ", "not a number");
  expect_error("1.5 2.5\n1,5 2,5\n", "map.txt, line 2, column 1: ", "decimal points");
}

TEST(SurfaceFile, HeadersAreAllOrNothingAndInLengths) {
  expect_error("# Width: 1 m\n1 2\n", "map.txt: ", "some but not all");
  expect_error("# Width: 1 m\n# Height: 1 m\n1 2\n", "map.txt: ", "Value units");
  expect_error("# Width: 1 m\n# Width: 1 m\n1 2\n", "map.txt, line 2: ", "twice");
  expect_error("# Width: 10 parsec\n1\n", "map.txt, line 1: ", "\"parsec\" is not a unit of length");
  expect_error("# Value units: V\n1\n", "map.txt, line 1: ", "\"V\" is not a unit of length");
  expect_error("# Width: -1 m\n1\n", "map.txt, line 1: ", "positive number and a unit");
  expect_error("# Width: 10,00 um\n1\n", "map.txt, line 1: ", "is not a length");
  expect_error("# Height: um\n1\n", "map.txt, line 1: ", "is not a length");
}

TEST(SurfaceFile, TextFilesThatCannotBeRead) {
  const std::filesystem::path directory =
      std::filesystem::path(::testing::TempDir()) / "ents_surface_file_test";
  std::filesystem::create_directories(directory);
  const auto message = [&](const std::filesystem::path& path, std::uintmax_t largest) -> std::string {
    try {
      ents::read_text_file(path, largest);
    } catch (const ModelError& error) {
      EXPECT_EQ(error.status, ENTS_FILE);
      return error.message;
    }
    return "no error";
  };
  EXPECT_NE(message(directory / "missing.txt", 10).find("missing.txt: there is no such file"),
            std::string::npos);
  EXPECT_NE(message(directory, 10).find("is not a regular file"), std::string::npos);
  std::ofstream(directory / "map.txt") << "1 2 3 4 5 6";
  EXPECT_NE(message(directory / "map.txt", 10).find("has 11 bytes; at most 10"), std::string::npos);
  EXPECT_EQ(ents::read_text_file(directory / "map.txt", 11), "1 2 3 4 5 6");
  EXPECT_THROW(ents::path_from_utf8(std::string_view("a\0b", 3)), ModelError);
  std::filesystem::remove_all(directory);
}

} // namespace
} // namespace surface_file_test
