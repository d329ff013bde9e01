// SPDX-License-Identifier: BSD-3-Clause
// Measured heights of a model come from files, values and data.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "abi/read/model_json.hpp"
#include "model_errors.hpp"
#include "model_heights.hpp"

namespace map_files_test {
namespace {

using namespace ents;
using namespace ents::testing;

constexpr double eps = std::numeric_limits<double>::epsilon();

class MapFiles : public ::testing::Test {
protected:
  void SetUp() override { std::filesystem::create_directories(directory_); }
  void TearDown() override { std::filesystem::remove_all(directory_); }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(directory_ / name, std::ios::binary) << text;
  }
  std::filesystem::path directory_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("ents_model_json_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

// values[j][i] at s_1 = origin + i spacing, s_2 = origin + j spacing
TEST_F(MapFiles, SourcesOfAMapAreTheSame) {
  const double samples[] = {1, 2, 3, 4, 5, 7, 8, 9, 11, 12, 13, 17};
  const NamedData data[] = {{"other", samples, 1, 1}, {"scan", samples, 3, 4}};
  write("plain.txt", "1 2 3 4\n5 7 8 9\n11 12 13 17\n");
  const std::string rest = R"("boundary": "clamped", "size": [3, 1], "origin": [-1, 2], "scale": 0.5})";
  const ModelSpec from_values = read_model(with_height(
      "quad4", R"({"type": "map", "values": [[1, 2, 3, 4], [5, 7, 8, 9], [11, 12, 13, 17]], )" + rest));
  const ModelSpec from_file =
      read_model(with_height("quad4", R"({"type": "map", "file": "plain.txt", )" + rest), directory_);
  const ModelSpec from_data =
      read_model(with_height("quad4", R"({"type": "map", "data": "scan", )" + rest), {}, data);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i) {
      const double s1 = -1.0 + i, s2 = 2.0 + 0.5 * j;
      // coefficients below 3 * 17, a dozen roundings
      EXPECT_NEAR(height_2(from_values, s1, s2), 0.5 * samples[4 * j + i], 12 * 51 * eps);
      EXPECT_EQ(height_2(from_file, s1, s2), height_2(from_values, s1, s2));
      EXPECT_EQ(height_2(from_data, s1, s2), height_2(from_values, s1, s2));
    }
}

TEST_F(MapFiles, UnitsOfAFileBecomeModelUnits) {
  write("afm.txt",
        "# Channel: ZSensor\n# Width: 4 um\n# Height: 2 um\n# Value units: nm\n1 2 3 4\n5 7 8 9\n");
  const std::string text =
      R"({"type": "map", "file": "afm.txt", "boundary": "periodic", "length_unit": 1e-6, "scale": 2})";
  const ModelSpec model = read_model(with_height("quad4", text), directory_);
  EXPECT_DOUBLE_EQ(model.height.feature_length(0), 1.0); // 4 um / 4 pixels
  EXPECT_DOUBLE_EQ(model.height.feature_length(1), 1.0);
  EXPECT_NEAR(height_2(model, 2.0, 1.0), 2 * 8e-3, 12 * 27e-3 * eps + 4 * 8e-3 * eps);

  // In metres, and clamped: the pixels keep their distance.
  const ModelSpec clamped = read_model(
      with_height("quad4", R"({"type": "map", "file": "afm.txt", "boundary": "clamped"})"), directory_);
  EXPECT_DOUBLE_EQ(clamped.height.feature_length(0), 1e-6);
  EXPECT_DOUBLE_EQ(clamped.height.feature_length(1), 1e-6);
  EXPECT_NEAR(height_2(clamped, 3e-6, 1e-6), 9e-9, 1e-9 * 1000 * eps);

  // The model's own size wins over the file's.
  const ModelSpec sized = read_model(
      with_height("quad4", R"({"type": "map", "file": "afm.txt", "boundary": "periodic", "size": [8, 6]})"),
      directory_);
  EXPECT_DOUBLE_EQ(sized.height.feature_length(0), 2.0);
  EXPECT_DOUBLE_EQ(sized.height.feature_length(1), 3.0);
}

TEST_F(MapFiles, ProfilesAreOneRowOrOneColumn) {
  write("row.txt", "1 5 2 4\n");
  write("column.txt", "1\n5\n2\n4\n");
  write("column_units.txt", "# Width: 9 mm\n# Height: 4 mm\n# Value units: mm\n1\n5\n2\n4\n");
  const auto read = [&](const std::string& file, const std::string& rest) {
    return read_model(with_height("line2", R"({"type": "map", "boundary": "periodic", "file": ")" + file +
                                               "\"" + rest + "}"),
                      directory_);
  };
  const ModelSpec row = read("row.txt", R"(, "size": [4])"), column = read("column.txt", R"(, "size": [4])");
  const ModelSpec units = read("column_units.txt", R"(, "length_unit": 1e-3)");
  EXPECT_DOUBLE_EQ(units.height.feature_length(0), 1.0);
  for (double s = -3.0; s < 6.0; s += 0.31) {
    EXPECT_EQ(height_1(row, s), height_1(column, s));
    EXPECT_NEAR(height_1(row, s), height_1(units, s), 1000 * eps);
  }
}

TEST_F(MapFiles, ModelFilesReadMapsBesideThem) {
  std::filesystem::create_directories(directory_ / "data");
  write("data/map.txt", "1 2\n3 4\n");
  write("model.json",
        with_height("quad4",
                    R"({"type": "map", "file": "data/map.txt", "boundary": "periodic", "size": [1, 1]})"));
  EXPECT_FALSE(read_model_file((directory_ / "model.json").string()).height.none());
  EXPECT_THROW(read_model_file((directory_ / "nothing.json").string()), ModelError);
}

TEST_F(MapFiles, MistakesWithMaps) {
  write("plain.txt", "1 2\n3 x\n");
  write("good.txt", "1 2\n3 4\n");
  write("tiny.txt", "# Width: 1e-300 m\n# Height: 1 m\n# Value units: m\n1 2\n3 4\n");
  const double bad[] = {1.0, 2.0, 3.0, std::nan("")};
  const NamedData data[] = {{"bad", bad, 2, 2},   {"null", nullptr, 2, 2},
                            {"empty", bad, 0, 2}, {"huge", bad, std::int64_t{1} << 40, std::int64_t{1} << 40},
                            {"twin", bad, 1, 1},  {"twin", bad, 1, 1}};
  const auto expect = [&](const std::string& segment, const std::string& keys, std::int32_t status,
                          const std::string& start, const std::string& part) {
    const auto [got, message] =
        verdict(with_height(segment, R"({"type": "map", )" + keys + "}"), directory_, data);
    EXPECT_EQ(got, status) << keys << ": " << message;
    EXPECT_EQ(message.substr(0, start.size()), start) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  const std::string p = R"("boundary": "periodic", "size": [1, 1])";
  expect("quad4", R"("file": "plain.txt", )" + p, ENTS_FILE,
         "/height/file: ", "plain.txt, line 2, column 2: \"x\"");
  expect("quad4", R"("file": "none.txt", )" + p, ENTS_FILE,
         "/height/file: ", "none.txt: there is no such file");
  expect("quad4", R"("file": "", )" + p, ENTS_FILE, "/height/file: ", "is not a regular file");
  expect("quad4", R"("file": "a\u0000b", )" + p, ENTS_FILE, "/height/file: ", "zero byte");
  expect("quad4", R"("file": 7, )" + p, ENTS_BAD_VALUE, "/height/file: ", "is a number; write a text");
  expect("quad4", R"("file": "good.txt", "boundary": "periodic")", ENTS_UNKNOWN_KEY,
         "/height: ", "\"size\" is missing");
  expect("quad4", R"("file": "good.txt", "length_unit": 1e-6, )" + p, ENTS_BAD_VALUE,
         "/height/length_unit: ", "states no units");
  expect("quad4", R"("file": "tiny.txt", "boundary": "periodic")", ENTS_BAD_VALUE,
         "/height/file: ", "length_unit");
  expect("line2", R"("file": "good.txt", "boundary": "periodic", "size": [1])", ENTS_BAD_VALUE,
         "/height/file: ", "one row or one column");
  expect("quad4", R"("values": [[1, 2], [3]], )" + p, ENTS_BAD_VALUE,
         "/height/values/1: ", "has 1 entry; write an array of 2 numbers");
  expect("quad4", R"("values": [[1, 2], [3, "4"]], )" + p, ENTS_BAD_VALUE,
         "/height/values/1/1: ", "the text \"4\"");
  expect("quad4", R"("values": [1, 2], )" + p, ENTS_BAD_VALUE,
         "/height/values/0: ", "write an array of numbers");
  expect("line2", R"("values": [[1, 2]], "boundary": "periodic", "size": [1])", ENTS_BAD_VALUE,
         "/height/values/0: ", "is an array");
  expect("quad4", R"("values": [[1, 2]], "boundary": "clamped", "size": [1, 1])", ENTS_BAD_VALUE,
         "/height/values: ", "at least 2");
  expect("quad4", R"("values": [[1e99]], "scale": 1e9, )" + p, ENTS_BAD_VALUE, "/height/values: ", "1e100");
  expect("quad4", R"("values": [[1]], "length_unit": 1, )" + p, ENTS_UNKNOWN_KEY,
         "/height/length_unit: ", "unknown key");
  expect("quad4", R"("values": [[1]], "size": [1, 1])", ENTS_UNKNOWN_KEY,
         "/height: ", "\"boundary\" is missing");
  expect("quad4", R"("values": [[1]], "boundary": "peridoic", "size": [1, 1])", ENTS_BAD_VALUE,
         "/height/boundary: ", "did you mean \"periodic\"?");
  expect("quad4", R"("values": [[1]], "boundary": "periodic", "size": [1])", ENTS_BAD_VALUE,
         "/height/size: ", "2 numbers");
  expect("quad4", R"("values": [[1]], "boundary": "periodic", "size": [1, 0])", ENTS_BAD_VALUE,
         "/height/size/1: ", "1e-100");
  expect("quad4", R"("boundary": "periodic")", ENTS_UNKNOWN_KEY,
         "/height: ", "\"file\", \"values\" and \"data\"");
  expect("quad4", R"("size": [1, 1])", ENTS_UNKNOWN_KEY, "/height: ", "\"data\", and \"boundary\"");
  expect("quad4", R"("data": "bad", "values": [[1]], )" + p, ENTS_UNKNOWN_KEY, "/height: ", "more than one");
  expect("quad4", R"("data": "bad", )" + p, ENTS_NON_FINITE,
         "/height/data: ", "\"bad\" is NaN or infinite in row 1, column 1");
  expect("quad4", R"("data": "null", )" + p, ENTS_NULL_ARGUMENT, "/height/data: ", "null");
  expect("quad4", R"("data": "empty", )" + p, ENTS_BAD_COUNT, "/height/data: ", "has 0 rows of 2");
  expect("quad4", R"("data": "huge", )" + p, ENTS_BAD_COUNT, "/height/data: ", "samples");
  expect("quad4", R"("data": "twin", )" + p, ENTS_BAD_VALUE, "/height/data: ", "two arrays");
  expect("quad4", R"("data": "absent", )" + p, ENTS_BAD_VALUE, "/height/data: ", "there are: \"bad\"");
  expect("line2", R"("data": "bad", "boundary": "periodic", "size": [1])", ENTS_BAD_VALUE,
         "/height/data: ", "one row");
}

} // namespace
} // namespace map_files_test
