// SPDX-License-Identifier: BSD-3-Clause
// ents-lab in a folder of its own, with small scenes to run.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "program.hpp"

namespace host::test {

namespace fs = std::filesystem;

inline std::string quoted(const fs::path& file) { return std::string("'").append(file.string()).append("'"); }

class Program : public testing::Test {
protected:
  Program()
      : folder_(fs::temp_directory_path() / (std::string("ents_program_") +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Program() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return quoted(folder_ / name); }
  std::string write(const std::string& name, const Json& json) const { return write_text(name, json.dump()); }
  std::string write_text(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return path(name);
  }
  Json read(const std::string& name) const { return parse_json_file(folder_ / name); }
  std::string text(const std::string& name) const {
    std::ifstream stream(folder_ / name);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// hertz2d on a coarse mesh: a run takes some hundredths of a second.
  static Json small() {
    Json json = parse_json_file(fs::path(EXAMPLES) / "hertz2d" / "scene.json");
    for (const char* axis : {"x", "y"})
      for (Json& piece : json["parts"][0][axis]["pieces"]) piece["divisions"] = 6;
    json["parts"][0]["y"]["pieces"][1]["divisions"] = 2;
    json["steps"]["values"] = {0.25};
    return json;
  }
  /// Three approaches, of which the last goes deeper than the model lets it.
  static Json failing() {
    Json json = small();
    json["steps"] = {{"control", "approach"}, {"values", {0.0005, 0.001, 0.05}}};
    json["contact"]["model"]["penetration_limit"] = 1e-2;
    json["solver"]["min_step"] = 0.9;
    return json;
  }
  static Json three() {
    Json json = small();
    json["steps"]["values"] = {0.25, 0.5, 0.75};
    return json;
  }
  static void expect(const ProgramOutput& output, int exit_code, const std::vector<std::string>& words) {
    EXPECT_EQ(output.exit_code, exit_code) << output.text;
    for (const std::string& word : words)
      EXPECT_NE(output.text.find(word), std::string::npos) << word << "\n" << output.text;
  }

  fs::path folder_;
};

} // namespace host::test
