// SPDX-License-Identifier: BSD-3-Clause
// Every test program works in a directory of its own: models and tables are files there.
#include <filesystem>
#include <random>

#include <gtest/gtest.h>

namespace {

class WorkingDirectory : public testing::Environment {
public:
  void SetUp() override {
    path_ =
        std::filesystem::temp_directory_path() / ("ents-adapters-" + std::to_string(std::random_device{}()));
    std::filesystem::create_directory(path_);
    std::filesystem::current_path(path_);
  }
  void TearDown() override {
    std::filesystem::current_path(path_.parent_path());
    std::filesystem::remove_all(path_);
  }

private:
  std::filesystem::path path_;
};

[[maybe_unused]] const testing::Environment* const registered =
    testing::AddGlobalTestEnvironment(new WorkingDirectory);

} // namespace
