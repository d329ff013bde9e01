// SPDX-License-Identifier: BSD-3-Clause
// What each adapter says at the end of an increment of slave points that are beside their patches. Every test is a
// process of its own: ents_patches.json is read once.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "abaqus_services.hpp"
#include "hosts.hpp"
#include "other_hosts.hpp"
#include "uel_host.hpp"

namespace adapters::patch_watch_test {
namespace {

using std::string;

/// A master of five faces of length 1 along x, width 1, at height 0: in the plane nodes 2 k at x = k, in space the
/// second row behind them. The first slave point is above the first face, with a patch of two; the second one above
/// the last face, with a patch of the last two.
Elements two_points(int dimension) {
  Elements e;
  e.dimension = dimension;
  e.model = 70 + dimension;
  const bool plane = dimension == 2;
  const auto add = [&](double x, double y, double z) {
    e.reference.push_back(x);
    if (!plane) e.reference.push_back(y);
    e.reference.push_back(z);
  };
  for (int i = 0; i < 6; ++i) {
    add(i, 0, 0);
    if (!plane) add(i, 1, 0);
  }
  add(0.5, 0.5, 0.2), add(4.5, 0.5, 0.2);
  for (int point = 0; point < 2; ++point) {
    std::vector<int> nodes{(plane ? 6 : 12) + point};
    for (int i = 3 * point; i < 3 * point + 3; ++i) {
      nodes.push_back(plane ? i : 2 * i);
      if (!plane) nodes.push_back(2 * i + 1);
    }
    e.nodes.push_back(nodes);
    e.area.push_back(1);
  }
  std::ofstream("ents_" + std::to_string(e.model) + ".json")
      << R"({"segment": ")" << (plane ? "line2" : "quad4") << R"(", "patch": )"
      << (plane ? "[[0, 1], [1, 2]]" : "[[0, 2, 3, 1], [2, 4, 5, 3]]")
      << R"(, "contact": {"normal": {"type": "penalty", "stiffness": 100}}})";
  e.symmetric = true;
  e.state_size = plane ? 5 : 6; // of a patch without friction; an adapter refuses another number
  return e;
}

string list(const std::vector<int>& values) {
  string out;
  for (const int value : values) out += (out.empty() ? "" : ", ") + std::to_string(value + 1);
  return "[" + out + "]";
}

/// As ents-deck writes it: numbers of nodes count from 1, elements are the host's.
void write_patches(const Elements& e, const EmulatedHost& host) {
  const bool plane = e.dimension == 2;
  std::ostringstream nodes, faces, points;
  const auto d = static_cast<std::size_t>(e.dimension);
  for (std::size_t i = 0; i < e.reference.size() / d; ++i)
    nodes << (i ? ", " : "") << "[" << i + 1 << ", " << e.reference[d * i] << ", " << e.reference[d * i + 1]
          << ", " << (plane ? 0 : e.reference[d * i + 2]) << "]";
  for (int i = 0; i < 5; ++i)
    faces << (i ? ", " : "") << (plane ? R"(["line2", )" : R"(["quad4", )")
          << (plane ? list({i, i + 1}) : list({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1})) << "]";
  for (int k = 0; k < 2; ++k) {
    const std::vector<int>& own = e.nodes[static_cast<std::size_t>(k)];
    points << (k ? ", " : "") << R"({"element": )" << host.number(k) << R"(, "nodes": )" << list({own[0]})
           << R"(, "weights": [1], "normal": )" << (plane ? "[0, -1, 0]" : "[0, 0, -1]") << R"(, "masters": )"
           << list({own.begin() + 1, own.end()}) << R"(, "faces": )" << (k ? "[3, 4]" : "[0, 1]") << "}";
  }
  std::ofstream("ents_patches.json")
      << R"({"nodes": [)" << nodes.str()
      << R"(], "pairs": [{"slave": "S", "master": "M", "slide": 1, "lowest": 0, "faces": [)" << faces.str()
      << R"(], "points": [)" << points.str() << "]}]}";
}

/// The first slave point moves, in two increments; what the host's user reads goes to stderr. Exit status: 0 the job
/// goes on, 3 the host has stopped it.
void job(const HostKind& kind, double right, double down, bool with_file = true, int options = 0) {
  Elements e = two_points(kind.dimension ? kind.dimension : 2);
  e.options = options;
  std::fflush(stdout);
  dup2(STDERR_FILENO, STDOUT_FILENO); // where most hosts' users look
  int status = 0;
  try {
    const auto host = kind.make(e);
    if (with_file) write_patches(e, *host);
    const auto d = static_cast<std::size_t>(e.dimension), slave = static_cast<std::size_t>(e.nodes[0][0]);
    std::vector<double> u(e.reference.size());
    for (int increment = 1; increment <= 3; ++increment) {
      host->begin(u);
      if (increment == 1) u[d * slave] = right, u[d * slave + d - 1] = -down;
      for (int element = 0; element < 2; ++element) host->evaluate(element, u);
      host->accept();
    }
  } catch (const HostStopped& stopped) {
    std::fprintf(stderr, "stopped: %s\n", stopped.what());
    status = 3;
  }
  for (const AbaqusMessage& message : abaqus_messages())
    std::fprintf(stderr, "%d: %s\n", message.severity, message.text.c_str());
  std::fprintf(stderr, "end");
  std::fflush(stdout);
  std::_Exit(status);
}

class PatchWatch : public testing::TestWithParam<HostKind> {
protected:
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_P(PatchWatch, NothingIsSaidOfPointsAboveTheirPatchesOrBeyondTheMaster) {
  EXPECT_EXIT(job(GetParam(), 0, 0), testing::ExitedWithCode(0), "^end$");
  EXPECT_EXIT(job(GetParam(), 0.9, 0.3), testing::ExitedWithCode(0), "^end$"); // its element sees it
  EXPECT_EXIT(job(GetParam(), 6, 0.3), testing::ExitedWithCode(0), "^end$");
}

TEST_P(PatchWatch, OpenPointsBesideTheirPatchesAreCountedOnce) {
  const string words =
      "ents: pair S, M: 1 of 2 slave points are open and lie beside their patches, up to 1.2 beyond; "
      "contact there is not seen: run ents-deck with --slide 2.75\n";
  EXPECT_EXIT(job(GetParam(), 2.7, 0), testing::ExitedWithCode(0), "^[^\n]*" + words + "end$");
}

TEST_P(PatchWatch, APointPressedIntoTheMasterBesideItsPatchEndsTheJob) {
  EXPECT_EXIT(
      job(GetParam(), 2.7, 0.21), testing::ExitedWithCode(3),
      "ents: pair S, M: 1 slave points are pressed into the master beside their patches, up to 0.01 deep, "
      "without a force: run ents-deck with --slide 2.75");
}

// Who makes patches without ents-deck has no such file: whether the master goes on there only its user knows.
TEST_P(PatchWatch, WithoutTheFilePointsBelowTheSurfaceThatGoesOnAreCounted) {
  EXPECT_EXIT(
      job(GetParam(), 2.7, 0.21, false), testing::ExitedWithCode(0),
      "1 slave points \\(element [0-9]* ...\\) are open, lie beside their patches and up to 0.01 below the "
      "surface that goes on there: .*add 16 to .*3\nend$");
  EXPECT_EXIT(job(GetParam(), 2.7, 0, false), testing::ExitedWithCode(0), "^end$");
  EXPECT_EXIT(job(GetParam(), 2.7, 0.21, false, 16), testing::ExitedWithCode(0), "^end$");
}

/// The hosts that tell an element's number, and a program that loads a UEL but has no UEXTERNALDB: the next
/// increment shows that one has ended. calculix_watch_test.cpp has CalculiX, whose adapter ends the program.
std::vector<HostKind> hosts_and_loader() {
  std::vector<HostKind> all = hosts();
  std::erase_if(all, [](const HostKind& kind) { return kind.name == "lsdyna" || kind.name == "calculix"; });
  all.push_back(
      {"oofem", [](const Elements& e) { return std::make_unique<UelHost>(e, UelHost::Program::oofem); }});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Hosts, PatchWatch, testing::ValuesIn(hosts_and_loader()),
                         [](const auto& param) { return param.param.name; });

TEST(PatchWatchLsDyna, TheFirstPointBelowTheSurfaceThatGoesOnIsReported) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      job({"lsdyna", lsdyna_host, false, 3}, 2.5, 0.21, false), testing::ExitedWithCode(0),
      "^ \\*\\*\\* ents: warning: the slave at \\(3, 0.5, -0.01\\) is open, lies beside its patch and 0.01 "
      "below the surface that goes on there [^\n]*\nend$");
}

} // namespace
} // namespace adapters::patch_watch_test
