// SPDX-License-Identifier: BSD-3-Clause
// Files that are no input are refused before they take the stack or the memory of the machine.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <sys/resource.h>

#include "toolbox/json_reader.hpp"

namespace host::json_reader_test {
namespace {

std::string message(const std::string& text) {
  try {
    parse_json(text, "file");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

/// Memory that this process has had at most, in MB.
double peak() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

TEST(JsonReader, NestingIsLimited) {
  const auto nested = [](int depth, const std::string& open, const std::string& close) {
    return "{\"a\":" + repeated(open, depth) + "1" + repeated(close, depth) + "}";
  };
  for (const auto& [open, close] : {std::pair{"[", "]"}, std::pair{"{\"b\":", "}"}}) {
    EXPECT_EQ(message(nested(99, open, close)), "");
    for (const int depth : {100, 1000, 1000000})
      EXPECT_EQ(message(nested(depth, open, close)),
                "file: objects and arrays lie more than 100 levels deep in each other");
  }
  // What is refused has not been copied or written: half a file does as well.
  EXPECT_NE(message("{\"a\":" + repeated("[", 100000)), "");
}

TEST(JsonReader, TheOutermostValueIsAnObject) {
  EXPECT_EQ(message("[1]"), "file: an object is expected, this is array");
  EXPECT_EQ(message("1"), "file: an object is expected, this is number");
  EXPECT_EQ(message("null"), "file: an object is expected, this is null");
  EXPECT_EQ(message("{}"), "");
  EXPECT_EQ(message("{\"a\":1,\"a\":2}"), "file: the key \"a\" appears twice in one object");
}

TEST(JsonReader, MillionsOfObjectsAreRefusedBeforeTheyAreInMemory) {
  std::string many = "[";                           // GCC 12 warns falsely of "[" + std::string
  (many += repeated("{\"\":0},", 8000000)) += "0]"; // 56 MB
  const double before = peak();
  EXPECT_EQ(message(many), "file: an object is expected, this is array");
  EXPECT_EQ(message("{\"a\":" + many + "}"), "file: more than 100000 objects");
  EXPECT_EQ(message("{\"a\":[" + repeated("\"\",", 8000000) + "0]}"),
            "file: more than 1000000 keys and strings");
  EXPECT_LT(peak() - before, 600); // copies of the text; all the objects would take 1400
  EXPECT_EQ(message("{\"a\":[" + repeated("[],", 11000000) + "0]}"), "file: more than 10000000 arrays");
}

TEST(JsonReader, DevicesAndFoldersAreNoFiles) {
  const auto of_file = [](const char* file) {
    try {
      parse_json_file(file);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(of_file("/dev/zero"), "/dev/zero: this is a device; name a file");
  EXPECT_EQ(of_file("/"), "/: this is a folder; name a file in it");
  EXPECT_EQ(of_file("/no/such/file"), "/no/such/file: cannot be opened for reading (does it exist?)");
}

} // namespace
} // namespace host::json_reader_test
