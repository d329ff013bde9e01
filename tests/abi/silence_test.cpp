// SPDX-License-Identifier: BSD-3-Clause
// The library says nothing but through its reports and leaves the process as it is: no byte on standard
// output or error, no open file, no changed locale, directory, mask, environment or signal handler.
#include <gtest/gtest.h>

#include <clocale>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/element.hpp"

extern char** environ;

namespace silence_test {
namespace {

using namespace test;

// Everything: models good and bad, from text and files, evaluations of all kinds, errors.
void work(const std::filesystem::path& folder) {
  Random random(131);
  ents_report report = new_report();
  ents_model* made = nullptr;
  for (const ModelKind& kind : some_kinds()) {
    const Model model(text(kind));
    Results results(model.layout);
    for (int i = 0; i < 6; ++i) {
      Element e = draw(model, basis(kind.basis), random);
      if (i == 1) e[start].clear();
      if (i == 2) e[slave][0] = std::numeric_limits<double>::quiet_NaN();
      if (i == 3) e[master].assign(e[master].size(), 1.0);
      if (i == 4) e[area] = {-1.0};
      if (i == 5) e[slave].assign(e[slave].size(), 1e200);
      test::evaluate(model, e, want_all, results, &report);
      ents_admissibility result{};
      result.struct_size = sizeof result;
      result.samples = 5;
      call::model_check(model.get(), e[master].data(), nullptr, &result, &report);
    }
  }
  const char* texts[] = {
      "",
      "{",
      R"({"segment": 7})",
      R"({"segment": "quad4", "segment": "quad4"})",
      "\xff\xfe",
      R"({"segment": "line2", "height": {"type": "map", "file": "missing", "boundary": "clamped"}})"};
  for (const char* t : texts)
    call::model_create(t, int64_t{-1}, folder.c_str(), nullptr, int64_t{0}, &made, &report);
  for (const char* name : {"model.json", "broken.json", "missing.json", "."}) {
    call::model_create_from_file((folder / name).c_str(), &made, &report);
    call::model_destroy(&made, &report);
  }
  call::evaluate(nullptr, int64_t{0}, int64_t{0}, nullptr, nullptr, &report);
}

// What of the process a host might notice.
struct Process {
  std::map<int, std::pair<void*, int>> handlers;
  std::string locale, decimal_point, directory, environment;
  mode_t mask;
  std::size_t open_files;
  bool operator==(const Process&) const = default;
};

Process observe() {
  Process p;
  for (int s = 1; s < 65; ++s) {
    struct sigaction action {};
    if (sigaction(s, nullptr, &action) == 0)
      p.handlers[s] = {reinterpret_cast<void*>(action.sa_handler), action.sa_flags};
  }
  p.locale = std::setlocale(LC_ALL, nullptr);
  p.decimal_point = std::localeconv()->decimal_point;
  p.directory = std::filesystem::current_path().string();
  for (char** variable = environ; *variable; ++variable) p.environment += std::string(*variable) + "\n";
  p.mask = umask(0);
  umask(p.mask);
  p.open_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
    p.open_files += entry.is_symlink();
  return p;
}

class Silence : public ::testing::Test {
protected:
  Silence() : folder(std::filesystem::temp_directory_path() / ("ents_silence_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "scan.txt") << "0.1 0.2 0.3\n0.2 0.1 0.0\n";
    std::ofstream(folder / "model.json")
        << R"({"segment": "quad4", "height": {"type": "map", "file": "scan.txt",)"
           R"( "boundary": "periodic", "size": [1, 1]}})";
    std::ofstream(folder / "broken.json") << "{\"segment\": ";
  }
  ~Silence() override { std::filesystem::remove_all(folder); }
  std::filesystem::path folder;
};

TEST_F(Silence, NotAByteOnStandardOutputOrError) {
  // both go into one file for the time of the work
  const std::filesystem::path path = folder / "output";
  std::fflush(nullptr);
  const int file = open(path.c_str(), O_CREAT | O_RDWR | O_TRUNC, 0600), out = dup(1), err = dup(2);
  ASSERT_GE(file, 0);
  dup2(file, 1);
  dup2(file, 2);
  work(folder);
  std::fflush(nullptr);
  const auto silent = std::filesystem::file_size(path);
  std::printf("?"); // the file does receive what is printed
  std::fprintf(stderr, "!");
  std::fflush(nullptr);
  const auto printed = std::filesystem::file_size(path);
  dup2(out, 1);
  dup2(err, 2);
  for (const int descriptor : {file, out, err}) close(descriptor);
  EXPECT_EQ(silent, 0u);
  EXPECT_EQ(printed, 2u);
}

TEST_F(Silence, TheProcessIsAsBefore) {
  for (const char* locale : {"C", "C.UTF-8", ""}) {
    if (!std::setlocale(LC_ALL, locale)) continue; // not installed
    const Process before = observe();
    work(folder);
    const Process after = observe();
    EXPECT_EQ(before.handlers, after.handlers);
    EXPECT_EQ(before.locale, after.locale);
    EXPECT_EQ(before.decimal_point, after.decimal_point);
    EXPECT_EQ(before.directory, after.directory);
    EXPECT_EQ(before.environment, after.environment);
    EXPECT_EQ(before.mask, after.mask);
    EXPECT_EQ(before.open_files, after.open_files);
  }
  std::setlocale(LC_ALL, "C");
}

// The files themselves are neither written nor added to.
TEST_F(Silence, FilesAreOnlyRead) {
  const auto list = [&] {
    std::map<std::string, std::pair<std::uintmax_t, std::filesystem::file_time_type>> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      files[entry.path().string()] = {entry.file_size(), entry.last_write_time()};
    return files;
  };
  const auto before = list();
  work(folder);
  EXPECT_EQ(list(), before);
}

} // namespace
} // namespace silence_test
