// SPDX-License-Identifier: BSD-3-Clause
// A file is replaced as a whole or stays as it was.
#include "output/text_file.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <stdexcept>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "toolbox/vtu.hpp"

namespace host::text_file_test {
namespace {

namespace fs = std::filesystem;

class TextFile : public testing::Test {
protected:
  TextFile()
      : folder_(fs::temp_directory_path() / ("ents_text_file_" + std::to_string(getpid()))),
        file_(folder_ / "file") {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~TextFile() override { fs::remove_all(folder_); }
  std::string text() const {
    std::ifstream stream(file_);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void expect_one_file() const {
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "something lies beside " << file_;
  }
  using Write = void (*)(const fs::path&, const std::string&);
  static std::string message(const fs::path& file, const std::string& text, Write write = write_text) {
    try {
      write(file, text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_, file_;
};

// write_text is the laboratory's, which also survives a power failure; save_text the reference host's.
constexpr void (*both[])(const fs::path&, const std::string&) = {write_text, save_text};

TEST_F(TextFile, IsReplaced) {
  for (const auto write : both)
    for (const char* version : {"one", "two, longer", "3"}) {
      write(file_, version);
      EXPECT_EQ(text(), version);
    }
  expect_one_file();
}

TEST_F(TextFile, StaysAsItWasIfTheNewOneCannotBeWrittenToItsEnd) {
  write_text(file_, "old");
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit small{1000, limit.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  for (const auto write : both) {
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::string said = message(file_, std::string(5000, 'x'), write);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    EXPECT_EQ(said, file_.string() + ": cannot be written: File too large");
    EXPECT_EQ(text(), "old");
    expect_one_file();
  }
}

TEST_F(TextFile, StaysAsItWasUntilReplaceIsCalled) {
  write_text(file_, "old");
  {
    NewFile thrown_away(file_, "new");
    EXPECT_EQ(text(), "old");
  }
  EXPECT_EQ(text(), "old");
  expect_one_file();
  NewFile(file_, "new").replace();
  EXPECT_EQ(text(), "new");
}

TEST_F(TextFile, KeepsItsLinksAndPermissions) {
  const fs::path target = folder_ / "below" / "target";
  fs::create_directories(target.parent_path());
  fs::create_symlink("below/target", file_);
  write_text(file_, "one"); // the link leads nowhere yet
  EXPECT_TRUE(fs::is_symlink(file_));
  EXPECT_EQ(text(), "one");
  ASSERT_EQ(chmod(target.c_str(), 0640), 0);
  write_text(file_, "two");
  EXPECT_TRUE(fs::is_symlink(file_));
  EXPECT_EQ(text(), "two");
  struct stat now {};
  ASSERT_EQ(stat(target.c_str(), &now), 0);
  EXPECT_EQ(now.st_mode & 0777, 0640u);
}

TEST_F(TextFile, DevicesAreWrittenDirectly) {
  EXPECT_EQ(message("/dev/null", "text"), "");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  if (fs::exists("/dev/full")) {
    EXPECT_EQ(message("/dev/full", "text"), "/dev/full: cannot be written: No space left on device");
  }
}

TEST_F(TextFile, NamesTheFileInAFolderThatIsNotThere) {
  for (const auto write : both)
    EXPECT_EQ(message("/no/such/folder/file", "text", write),
              "/no/such/folder/file: cannot be written: No such file or directory");
}

} // namespace
} // namespace host::text_file_test
