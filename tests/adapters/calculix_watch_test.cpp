// SPDX-License-Identifier: BSD-3-Clause
// CalculiX: what the adapter says at the end of an increment of slave points that are beside their patches.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

extern "C" void ents_ccx_increment_end_(const double* co, const double* vold, const int* mi, const int* istep,
                                        const int* iinc);

namespace adapters::calculix_watch_test {
namespace {

/// A master of five lines, nodes 1 .. 6 at x = 0 .. 5 on y = 0. Nodes 7, 8 are a slave's face above the first one, with
/// a patch of two lines.
constexpr const char* watched =
    R"({"nodes": [[1, 0, 0, 0], [2, 1, 0, 0], [3, 2, 0, 0], [4, 3, 0, 0], [5, 4, 0, 0], [6, 5, 0, 0],
 [7, 0.2, 0.5, 0], [8, 0.8, 0.5, 0]], "pairs": [{"slave": "S", "master": "M", "slide": 1.0, "lowest": 0.0,
 "faces": [["line2", [1, 2]], ["line2", [2, 3]], ["line2", [3, 4]], ["line2", [4, 5]], ["line2", [5, 6]]],
 "points": [{"element": 10, "nodes": [8, 7], "weights": [0.5, 0.5], "normal": [0, -1, 0], "masters": [1, 2, 3], "faces": [0, 1]}]}]})";

/// The slave moves; then the adapter's words and its file are written to stderr.
void increment(double right, double down) {
  std::ofstream("ents_patches.json") << watched;
  const double co[24] = {}; // not read
  double vold[32] = {};
  for (const int node : {6, 7}) vold[4 * node + 1] = right, vold[4 * node + 2] = -down;
  const int mi[] = {1, 3, 1}, step = 2, number = 7;
  std::fflush(stdout);
  dup2(STDERR_FILENO, STDOUT_FILENO); // ccx's channel
  ents_ccx_increment_end_(co, vold, mi, &step, &number);
  std::ifstream file("ents_slide.txt");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::printf("%s", text.substr(text.find('\n') + 1).c_str());
  std::printf("end");
  std::fflush(stdout);
  std::_Exit(0);
}

class CalculixWatch : public testing::Test {
  // Each increment in a process of its own: the file is read once.
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(CalculixWatch, NothingIsSaidOfPointsAboveTheirPatchesOrBeyondTheMaster) {
  EXPECT_EXIT(increment(0, 0), testing::ExitedWithCode(0), "^end$");
  EXPECT_EXIT(increment(1.2, 0.6), testing::ExitedWithCode(0), "^end$"); // its element sees it
  EXPECT_EXIT(increment(6, 0.6), testing::ExitedWithCode(0), "^end$");
}

TEST_F(CalculixWatch, OpenPointsBesideTheirPatchesAreCounted) {
  EXPECT_EXIT(increment(3, 0), testing::ExitedWithCode(0),
              "WARNING in U1E: pair S, M: 1 of 1 slave points are open and lie beside their patches, up to "
              "1.5 beyond; "
              "contact there is not seen: run ents-deck with --slide 2.75");
  EXPECT_EXIT(increment(3, 0), testing::ExitedWithCode(0), "2 7 open 1 1.5 2.75 S, M\nend");
}

TEST_F(CalculixWatch, APointPressedIntoTheMasterBesideItsPatchEndsTheJob) {
  EXPECT_EXIT(increment(3, 0.51), testing::ExitedWithCode(201),
              "ERROR in U1E: pair S, M: 1 slave points are pressed into the master beside their patches, up "
              "to 0.01 deep");
}

} // namespace
} // namespace adapters::calculix_watch_test
