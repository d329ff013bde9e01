// SPDX-License-Identifier: BSD-3-Clause
// What a VTK reader relies on: well-formed XML, byte counts that match the data, indices in range. The
// reading side is written here anew from the format's description.
#include "results/series.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace vtu_test {
namespace {

namespace vtu = host::vtu;

struct Tag {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;
};

/// The elements of an XML text in the order of their start tags; throws if the text is not well formed.
std::vector<Tag> parse_xml(const std::string& xml) {
  std::vector<Tag> tags;
  std::vector<std::size_t> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) throw std::runtime_error("tag without end");
    std::string inside = xml.substr(at + 1, end - at - 1);
    at = end + 1;
    if (inside.starts_with('?')) continue;
    if (inside.starts_with('/')) {
      if (open.empty() || tags[open.back()].name != inside.substr(1))
        throw std::runtime_error("tags cross: " + inside);
      open.pop_back();
      continue;
    }
    const bool closed = inside.ends_with('/');
    if (closed) inside.pop_back();
    Tag tag;
    tag.name = inside.substr(0, inside.find(' '));
    std::size_t position = tag.name.size();
    while ((position = inside.find_first_not_of(' ', position)) != std::string::npos) {
      const std::size_t equal = inside.find("=\"", position), quote = inside.find('"', equal + 2);
      if (equal == std::string::npos || quote == std::string::npos)
        throw std::runtime_error("bad attribute in " + inside);
      tag.attributes[inside.substr(position, equal - position)] = inside.substr(equal + 2, quote - equal - 2);
      position = quote + 1;
    }
    tag.text = xml.substr(at, xml.find('<', at) - at);
    tags.push_back(tag);
    if (!closed) open.push_back(tags.size() - 1);
  }
  if (!open.empty()) throw std::runtime_error("tag not closed: " + tags[open.back()].name);
  return tags;
}

std::vector<unsigned char> from_base64(const std::string& text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  if (text.size() % 4 != 0) throw std::runtime_error("base64 length");
  std::vector<unsigned char> out;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    count += 6;
    if (count >= 8) out.push_back(static_cast<unsigned char>(bits >> (count -= 8) & 255u));
  }
  return out;
}

/// Values of a DataArray; checks its byte count.
template <class T> std::vector<T> values_of(const Tag& array) {
  const auto bytes = from_base64(array.text);
  std::uint64_t size = 0;
  if (bytes.size() < sizeof size) throw std::runtime_error("no byte count");
  std::memcpy(&size, bytes.data(), sizeof size);
  if (size + sizeof size != bytes.size() || size % sizeof(T) != 0)
    throw std::runtime_error("byte count is wrong");
  std::vector<T> out(size / sizeof(T));
  if (size > 0) std::memcpy(out.data(), bytes.data() + sizeof size, size);
  return out;
}

const Tag& array_named(const std::vector<Tag>& tags, const std::string& name) {
  for (const Tag& tag : tags)
    if (tag.name == "DataArray" && tag.attributes.at("Name") == name) return tag;
  throw std::runtime_error("no array " + name);
}

/// A quad and a triangle side by side in the plane.
vtu::Grid plane_grid() {
  vtu::Grid grid;
  grid.dimension = 2;
  grid.points = {0, 0, 1, 0, 1, 1, 0, 1, 2, 0.5};
  grid.add_cells(9, 4, std::vector{0, 1, 2, 3});
  grid.add_cells(5, 3, std::vector{1, 4, 2});
  grid.point_data = {{"pressure [MPa]", 1, {0.1, 1.0 / 3.0, -0.0, 1e-300, 5}},
                     {"displacement", 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}},
                     {"a < \"b\" & c", 4, {1, 2, 3, 4, 5, 6, 7, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9}}};
  return grid;
}

TEST(Vtu, HoldsEveryNumberBitForBit) {
  const auto tags = parse_xml(vtu::to_xml(plane_grid()));
  const auto pressure = values_of<double>(array_named(tags, "pressure [MPa]"));
  const auto expected = plane_grid().point_data[0].values;
  ASSERT_EQ(pressure.size(), expected.size());
  EXPECT_EQ(std::memcmp(pressure.data(), expected.data(), 8 * expected.size()), 0);
}

TEST(Vtu, PadsPlaneDataToSpace) {
  const auto tags = parse_xml(vtu::to_xml(plane_grid()));
  const auto points = values_of<double>(array_named(tags, "Points"));
  EXPECT_EQ(points, (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0.5, 0}));
  const Tag& vector = array_named(tags, "displacement");
  EXPECT_EQ(vector.attributes.at("NumberOfComponents"), "3");
  EXPECT_EQ(values_of<double>(vector)[3], 3);
  const Tag& tensor = array_named(tags, "a &lt; &quot;b&quot; &amp; c");
  EXPECT_EQ(tensor.attributes.at("NumberOfComponents"), "6");
  EXPECT_EQ(tensor.attributes.at("ComponentName3"), "XY");
  const std::vector<double> padded = values_of<double>(tensor);
  ASSERT_EQ(padded.size(), 30u);
  EXPECT_EQ(std::vector<double>(padded.begin(), padded.begin() + 12),
            (std::vector<double>{1, 2, 3, 4, 0, 0, 5, 6, 7, 8, 0, 0}));
  EXPECT_EQ(std::vector<double>(padded.end() - 6, padded.end()), (std::vector<double>{0, 0, 0, 9, 0, 0}));
}

TEST(Vtu, ListsMixedCellsInOrder) {
  const auto tags = parse_xml(vtu::to_xml(plane_grid()));
  EXPECT_EQ(values_of<std::int64_t>(array_named(tags, "connectivity")),
            (std::vector<std::int64_t>{0, 1, 2, 3, 1, 4, 2}));
  EXPECT_EQ(values_of<std::int64_t>(array_named(tags, "offsets")), (std::vector<std::int64_t>{4, 7}));
  EXPECT_EQ(values_of<std::uint8_t>(array_named(tags, "types")), (std::vector<std::uint8_t>{9, 5}));
  for (const Tag& tag : tags)
    if (tag.name == "Piece") {
      EXPECT_EQ(tag.attributes.at("NumberOfPoints"), "5");
      EXPECT_EQ(tag.attributes.at("NumberOfCells"), "2");
    }
}

TEST(Vtu, SampledSurfaceIsALineInThePlaneAndQuadsInSpace) {
  vtu::Grid line, patch;
  line.dimension = 2;
  for (int segment = 0; segment < 2; ++segment) line.add_surface(3, 1, {0, 0, 1, 1, 2, 0});
  EXPECT_EQ(line.types, (std::vector<std::uint8_t>{4, 4})); // polylines
  EXPECT_EQ(line.connectivity, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}));
  patch.add_surface(3, 2, std::vector<double>(18, 0.0));
  EXPECT_EQ(patch.connectivity, (std::vector<std::int64_t>{0, 1, 4, 3, 1, 2, 5, 4}));
  EXPECT_NO_THROW(vtu::to_xml(patch));
}

TEST(Vtu, EmptyCloudIsAValidFile) {
  const auto tags = parse_xml(vtu::to_xml(vtu::point_cloud(3, {})));
  EXPECT_TRUE(values_of<double>(array_named(tags, "Points")).empty());
}

std::string message_of(const vtu::Grid& grid) {
  try {
    vtu::to_xml(grid);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Vtu, RefusesDataThatDoNotFitAndNamesThem) {
  vtu::Grid grid = plane_grid();
  grid.point_data[0].values.pop_back();
  EXPECT_EQ(message_of(grid), "array 'pressure [MPa]' has 4 values; 5 x 1 are needed");
  grid = plane_grid();
  grid.connectivity[6] = 5;
  EXPECT_EQ(message_of(grid), "cells: node 5 of 5 points");
  grid = plane_grid();
  grid.connectivity.pop_back();
  EXPECT_EQ(message_of(grid), "cells: the last one ends at node 7 of 6");
}

TEST(VtuSeries, ListsEveryStepWithItsTimeAndPart) {
  const auto folder = std::filesystem::temp_directory_path() / "ents_vtu_series_test";
  std::filesystem::create_directories(folder);
  vtu::Series series(folder, "result");
  for (const int step : {0, 1}) {
    series.add(step, 0.1 * step, "bulk", plane_grid());
    series.add(step, 0.1 * step, "slave", vtu::point_cloud(2, {0, 0}));
    series.write_list();
  }
  std::ifstream stream(series.file());
  std::stringstream text;
  text << stream.rdbuf();
  std::vector<Tag> sets;
  for (const Tag& tag : parse_xml(text.str()))
    if (tag.name == "DataSet") sets.push_back(tag);
  ASSERT_EQ(sets.size(), 4u);
  EXPECT_EQ(sets[3].attributes.at("timestep"), "0.1");
  EXPECT_EQ(sets[3].attributes.at("part"), "1");
  EXPECT_EQ(sets[3].attributes.at("file"), "result_slave_0001.vtu");
  for (const Tag& set : sets) EXPECT_TRUE(std::filesystem::exists(folder / set.attributes.at("file")));
  std::filesystem::remove_all(folder);
}

TEST(VtuSeries, ARunThatGoesOnKeepsEarlierSteps) {
  const auto folder = std::filesystem::temp_directory_path() / "ents_vtu_resume_test";
  std::filesystem::create_directories(folder);
  const auto write = [&](vtu::Series& series, int first, int last, double time) {
    for (int step = first; step <= last; ++step) {
      series.add(step, time * step, "bulk", plane_grid());
      series.add(step, time * step, "slave", vtu::point_cloud(2, {0, 0}));
      series.write_list();
    }
  };
  vtu::Series series(folder, "result"), rest(folder, "result");
  write(series, 1, 3, 0.25);
  host::resume(rest, 3);
  write(rest, 3, 4, 0.5);
  std::ifstream stream(rest.file());
  std::stringstream text;
  text << stream.rdbuf();
  std::vector<std::string> found;
  for (const Tag& tag : parse_xml(text.str()))
    if (tag.name == "DataSet")
      found.push_back(tag.attributes.at("timestep") + " " + tag.attributes.at("part") + " " +
                      tag.attributes.at("file"));
  const std::vector<std::string> expected{"0.25 0 result_bulk_0001.vtu", "0.25 1 result_slave_0001.vtu",
                                          "0.5 0 result_bulk_0002.vtu",  "0.5 1 result_slave_0002.vtu",
                                          "1.5 0 result_bulk_0003.vtu",  "1.5 1 result_slave_0003.vtu",
                                          "2 0 result_bulk_0004.vtu",    "2 1 result_slave_0004.vtu"};
  EXPECT_EQ(found, expected);
  EXPECT_EQ(host::whole_steps(rest), (std::vector<int>{1, 2, 3, 4}));
  rest.add(5, 1, "bulk", plane_grid()); // a part is missing
  EXPECT_EQ(host::whole_steps(rest), (std::vector<int>{1, 2, 3, 4}));
  std::filesystem::remove_all(folder);
}

TEST(VtuSeries, NamesTheFileThatCannotBeWritten) {
  vtu::Series series("/no/such/folder", "result");
  try {
    series.add(0, 0, "bulk", plane_grid());
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such/folder/result_bulk_0000.vtu"), std::string::npos);
  }
}

} // namespace
} // namespace vtu_test
