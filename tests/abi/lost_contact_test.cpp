// SPDX-License-Identifier: BSD-3-Clause
// A slave in contact that leaves all segments: ents_detect and ents_iterate say so, unless the caller permits
// it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>

#include "sample_count.hpp"
#include "support/surface.hpp"

namespace lost_contact_test {
namespace {

using namespace test;

// A flat sheet of n x n squares of length 1 (2D: a line of n segments) in the plane of the first axes.
struct Sheet {
  static constexpr int n = 3;
  explicit Sheet(int d) : dimension(d) {
    for (int j = 0; j < (d == 3 ? n + 1 : 1); ++j)
      for (int i = 0; i <= n; ++i) {
        positions.push_back(i);
        if (d == 3) positions.push_back(j);
        positions.push_back(0.0);
      }
    for (int j = 0; j < (d == 3 ? n : 1); ++j)
      for (int i = 0; i < n; ++i) {
        const int64_t a = j * (n + 1) + i;
        connectivity.insert(connectivity.end(), {a, a + 1});
        if (d == 3) connectivity.insert(connectivity.end(), {a + n + 2, a + n + 1});
      }
    mesh.struct_size = sizeof mesh;
    mesh.nodes = static_cast<int64_t>(positions.size()) / d;
    mesh.segments = static_cast<int64_t>(connectivity.size()) / (d == 2 ? 2 : 4);
    mesh.positions = positions.data(), mesh.connectivity = connectivity.data();
  }
  Sheet(const Sheet&) = delete;
  int dimension;
  std::vector<double> positions;
  std::vector<int64_t> connectivity;
  ents_master_mesh mesh{};
};

// One slave, searched again and again.
struct Slave {
  Slave(const Model& m, const ents_master_mesh& on) : model(m), mesh(on) {
    int64_t size = 0;
    call::tree_size(model.get(), mesh.segments, &size, nullptr);
    tree.resize(static_cast<std::size_t>(size));
    EXPECT_EQ(call::tree_build(model.get(), &mesh, tree.data(), size, nullptr), ENTS_OK);
    detection.struct_size = sizeof detection;
    detection.slave = at, detection.reach = 0.5;
    detection.segment = &segment, detection.xi = xi, detection.flags = &flags;
  }
  Slave(const Slave&) = delete;
  int32_t detect() {
    return call::detect(model.get(), &mesh, tree.data(), static_cast<int64_t>(tree.size()), int64_t{0},
                        int64_t{1}, &detection, &report);
  }
  const Model& model;
  const ents_master_mesh& mesh;
  std::vector<double> tree;
  double at[3] = {}, xi[2] = {};
  int64_t segment = -1;
  int32_t flags = 0;
  ents_detection detection{};
  ents_report report = new_report();
};

// Where a slave of a flat sheet with a texture of this amplitude is: what has become of its contact?
enum class Fate { contact, open, beside, too_deep };
Fate fate(const Sheet& sheet, const double* at, double reach, double amplitude) {
  const double height = at[sheet.dimension - 1];
  bool inside = true;
  for (int k = 0; k + 1 < sheet.dimension; ++k) inside = inside && at[k] >= 0.0 && at[k] <= Sheet::n;
  if (inside) return std::fabs(height) <= reach ? Fate::contact : height > 0.0 ? Fate::open : Fate::too_deep;
  return height > amplitude ? Fate::open : Fate::beside;
}

TEST(LostContact, IsToldOfEverySlaveThatDoesNotRise) {
  mechanics::Random random(41);
  int count[4] = {};
  for (int trial = 0; trial < samples(4000); ++trial) {
    const int d = trial % 2 == 0 ? 2 : 3;
    const Sheet sheet(d);
    const Model model(text_of(d, penalty));
    Slave slave(model, sheet.mesh);
    for (int k = 0; k + 1 < d; ++k) slave.at[k] = random.uniform(0.1, Sheet::n - 0.1);
    slave.at[d - 1] = random.uniform(-0.3, 0.0);
    ASSERT_EQ(slave.detect(), ENTS_OK) << slave.report.message;
    ASSERT_GE(slave.segment, 0);
    const int64_t before = slave.segment;
    for (int k = 0; k + 1 < d; ++k) slave.at[k] = random.uniform(-1.5, Sheet::n + 1.5);
    slave.at[d - 1] = random.uniform(-0.8, 0.8);
    const Fate expected = fate(sheet, slave.at, slave.detection.reach, 0.0);
    double border = 1.0; // within the model's border an edge still has the slave, or not
    for (int k = 0; k + 1 < d; ++k)
      border = std::min({border, std::fabs(slave.at[k]), std::fabs(slave.at[k] - Sheet::n)});
    if (border < 0.06 || std::fabs(slave.at[d - 1]) < 1e-9) continue;
    ++count[static_cast<int>(expected)];
    const bool lost = expected == Fate::beside || expected == Fate::too_deep;
    const double xi[2] = {slave.xi[0], slave.xi[1]};
    for (const bool permitted : {false, true}) {
      slave.segment = before, slave.xi[0] = xi[0], slave.xi[1] = xi[1];
      slave.detection.permitted = permitted ? ENTS_FLAG_LEFT : 0;
      EXPECT_EQ(slave.detect(), lost && !permitted ? ENTS_NO_PROJECTION : ENTS_OK)
          << slave.at[0] << " " << slave.at[1] << " " << slave.at[2] << ": " << slave.report.message;
      EXPECT_EQ(slave.segment >= 0, expected == Fate::contact);
      EXPECT_EQ((slave.flags & ENTS_FLAG_LEFT) != 0, lost);
      if (!lost || permitted) continue;
      EXPECT_EQ(slave.report.element, 0);
      EXPECT_NE(std::strstr(slave.report.message,
                            expected == Fate::beside ? "beside all segments" : "deeper than detection.reach"),
                nullptr)
          << slave.report.message;
    }
    slave.segment = -1; // it was open
    slave.detection.permitted = 0;
    EXPECT_EQ(slave.detect(), ENTS_OK) << slave.report.message;
    EXPECT_EQ(slave.flags & ENTS_FLAG_LEFT, 0);
  }
  for (const int c : count) EXPECT_GT(c, samples(4000) / 50);
}

// A master that collapses to a point, as an iterate may, has no side on which its slaves could be open.
TEST(LostContact, ACollapsedMasterIsNone) {
  for (const int d : {2, 3})
    for (const double size : {1e-9, 1e-300, 0.0}) {
      Sheet sheet(d);
      const Model model(text_of(d, penalty));
      Slave slave(model, sheet.mesh);
      slave.at[0] = 1.4, slave.at[1] = d == 2 ? -0.01 : 1.3, slave.at[2] = -0.01;
      ASSERT_EQ(slave.detect(), ENTS_OK) << slave.report.message;
      ASSERT_GE(slave.segment, 0);
      for (double& x : sheet.positions) x *= size;
      ASSERT_EQ(call::tree_refit(model.get(), &sheet.mesh, slave.tree.data(),
                                 static_cast<int64_t>(slave.tree.size()), nullptr),
                ENTS_OK);
      EXPECT_EQ(slave.detect(), ENTS_NO_PROJECTION) << size;
      EXPECT_NE(slave.flags & ENTS_FLAG_LEFT, 0) << size;
    }
}

// How a texture goes on beyond the edge is unknown: a slave that is not above its crests has not risen.
TEST(LostContact, ATextureCountsWithItsGreatestHeight) {
  mechanics::Random random(43);
  int lost = 0, open = 0;
  constexpr double amplitude = 0.1;
  for (int trial = 0; trial < samples(1000); ++trial) {
    const int d = trial % 2 == 0 ? 2 : 3;
    const Sheet sheet(d);
    const Model model(
        text_of(d, penalty,
                std::string(R"(, "height": {"type": "sine", "amplitude": 0.1, "wave_vector": )") +
                    (d == 2 ? "[1.5]" : "[1.5, 0.5]") + "}"));
    Slave slave(model, sheet.mesh);
    for (int k = 0; k + 1 < d; ++k) slave.at[k] = random.uniform(0.3, Sheet::n - 0.3);
    slave.at[d - 1] = random.uniform(-0.2, -0.1);
    ASSERT_EQ(slave.detect(), ENTS_OK) << slave.report.message;
    if (slave.segment < 0) continue;
    const bool right = random.coin();
    slave.at[0] = right ? random.uniform(Sheet::n + 0.2, Sheet::n + 1.0) : random.uniform(-1.0, -0.2);
    slave.at[d - 1] = random.uniform(-0.4, 0.4);
    const double margin = slave.at[d - 1] - amplitude;
    if (std::fabs(margin) < 1e-9) continue;
    const int32_t status = slave.detect();
    if (slave.segment >= 0) continue; // a flank at the edge faces it
    EXPECT_EQ(status, margin > 0.0 ? ENTS_OK : ENTS_NO_PROJECTION)
        << slave.at[0] << " " << slave.at[1] << " " << slave.at[2] << ": " << slave.report.message;
    ++(margin > 0.0 ? open : lost);
  }
  EXPECT_GT(lost, samples(1000) / 4);
  EXPECT_GT(open, samples(1000) / 10);
}

// Kinks and ridges inside a surface are no free edges: a slave that moves over them by small steps is not
// lost, as long as it is not behind an edge.
TEST(LostContact, NoSlaveIsLostInsideASurface) {
  mechanics::Random random(47);
  int steps = 0, opened = 0;
  for (int trial = 0; trial < samples(400); ++trial) {
    const int d = trial % 2 == 0 ? 2 : 3;
    const Surface surface(random, d);
    const Model model(text_of(
        d, penalty,
        trial % 4 < 2 ? ""
                      : std::string(R"(, "height": {"type": "sine", "amplitude": 0.03, "wave_vector": )") +
                            (d == 2 ? "[0.5]" : "[0.5, 0.25]") + "}"));
    Slave slave(model, surface.mesh);
    slave.detection.permitted = ENTS_FLAG_BEHIND_EDGE;
    slave.detection.reach = 0.15;
    double direction[2] = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    for (int k = 0; k + 1 < d; ++k) slave.at[k] = random.uniform(1.0, 3.0);
    for (int step = 0; step < 40; ++step) {
      for (int k = 0; k + 1 < d; ++k) {
        slave.at[k] += 0.1 * direction[k];
        if (slave.at[k] < 0.5 || slave.at[k] > 3.5) direction[k] = -direction[k];
      }
      slave.at[d - 1] = random.uniform(-0.02, 0.3);
      const int64_t before = slave.segment;
      ASSERT_EQ(slave.detect(), ENTS_OK) << slave.report.message;
      opened += before >= 0 && slave.segment < 0;
      ++steps;
    }
  }
  EXPECT_GT(opened, steps / 20);
}

// Ahead of a ridge whose segments carry bulges: lower than these are high, but open.
TEST(LostContact, AheadOfARidgeASlaveIsOpen) {
  const double positions[6] = {-1, -0.5, 0, 0, 1, -0.5};
  const int64_t connectivity[4] = {0, 1, 1, 2};
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = 2, mesh.nodes = 3, mesh.connectivity = connectivity, mesh.positions = positions;
  const Model model(
      R"({"segment": "line2", "height": {"type": "polynomial", "coefficients": [0.05, 0, -0.05]}, "contact": )" +
      penalty + "}");
  Slave slave(model, mesh);
  slave.at[0] = -0.4, slave.at[1] = -0.25;
  ASSERT_EQ(slave.detect(), ENTS_OK) << slave.report.message;
  ASSERT_EQ(slave.segment, 0);
  slave.at[0] = 0.0, slave.at[1] = 0.03;
  EXPECT_EQ(slave.detect(), ENTS_OK) << slave.report.message;
  EXPECT_EQ(slave.segment, -1);
  EXPECT_EQ(slave.flags, ENTS_FLAG_SEARCHED);
}

struct Groove {
  double positions[6] = {-1, 0.5, 0, 0, 1, 0.5};
  int64_t connectivity[4] = {0, 1, 1, 2};
  ents_master_mesh mesh{};
  Groove() {
    mesh.struct_size = sizeof mesh;
    mesh.segments = 2, mesh.nodes = 3, mesh.connectivity = connectivity, mesh.positions = positions;
  }
};

TEST(LostContact, BehindAConcaveEdgeItIsToldOfSlavesThatHadASegment) {
  const Groove groove;
  const Model model(R"({"segment": "line2", "contact": )" + penalty + "}");
  Slave slave(model, groove.mesh);
  slave.at[1] = -0.1;
  EXPECT_EQ(slave.detect(), ENTS_OK) << slave.report.message; // never in contact: a flag alone
  EXPECT_EQ(slave.flags, ENTS_FLAG_BEHIND_EDGE | ENTS_FLAG_SEARCHED);
  slave.segment = 0, slave.xi[0] = 0.9;
  EXPECT_EQ(slave.detect(), ENTS_NO_PROJECTION);
  EXPECT_EQ(slave.flags, ENTS_FLAG_BEHIND_EDGE | ENTS_FLAG_SEARCHED);
  EXPECT_NE(std::strstr(slave.report.message, "slave 0 is behind an edge"), nullptr) << slave.report.message;
  EXPECT_NE(std::strstr(slave.report.message, "\"border\""), nullptr) << slave.report.message;
  EXPECT_EQ(slave.report.step_factor, 0.5);
  slave.segment = 0, slave.detection.permitted = ENTS_FLAG_BEHIND_EDGE;
  EXPECT_EQ(slave.detect(), ENTS_OK) << slave.report.message;
}

// The slave is a node of the surface itself, of a segment that faces the others.
TEST(LostContact, OfSelfContactIsTold) {
  double positions[] = {0, 0, 1, 0, 2, 0, 1.5, -0.05, 1, 1};
  const int64_t connectivity[] = {0, 1, 1, 2, 3, 4}, own = 3;
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = 3, mesh.nodes = 5, mesh.connectivity = connectivity, mesh.positions = positions;
  const Model model(text_of(2, penalty));
  for (const double height : {-0.05, 0.3}) {
    Slave slave(model, mesh);
    slave.detection.slave_node = &own;
    slave.at[0] = 1.5, slave.at[1] = -0.05;
    ASSERT_EQ(slave.detect(), ENTS_OK) << slave.report.message;
    ASSERT_EQ(slave.segment, 1);
    positions[6] = slave.at[0] = 2.4, positions[7] = slave.at[1] = height;
    ASSERT_EQ(call::tree_refit(model.get(), &mesh, slave.tree.data(), static_cast<int64_t>(slave.tree.size()),
                               nullptr),
              ENTS_OK);
    EXPECT_EQ(slave.detect(), height < 0.0 ? ENTS_NO_PROJECTION : ENTS_OK) << slave.report.message;
    positions[6] = 1.5, positions[7] = -0.05;
  }
}

// A caller that was compiled before `permitted` existed is served as it was then.
TEST(LostContact, OlderCallersAreServedAsBefore) {
  const Sheet sheet(2);
  const Model model(text_of(2, penalty));
  Slave slave(model, sheet.mesh);
  slave.detection.struct_size = offsetof(ents_detection, permitted);
  slave.at[0] = Sheet::n - 0.1, slave.at[1] = -0.1;
  ASSERT_EQ(slave.detect(), ENTS_OK);
  ASSERT_GE(slave.segment, 0);
  slave.at[0] = Sheet::n + 0.5;
  EXPECT_EQ(slave.detect(), ENTS_OK);
  EXPECT_EQ(slave.segment, -1);
  EXPECT_EQ(slave.flags, ENTS_FLAG_SEARCHED);
}

TEST(LostContact, UnknownBitsOfPermittedAreRefused) {
  const Sheet sheet(2);
  const Model model(text_of(2, penalty));
  Slave slave(model, sheet.mesh);
  slave.detection.permitted = ENTS_FLAG_CONTACT;
  EXPECT_EQ(slave.detect(), ENTS_BAD_MASK);
  EXPECT_NE(std::strstr(slave.report.message, "detection.permitted"), nullptr) << slave.report.message;
}

// All slaves are written, whichever of them is lost, and no element is evaluated.
TEST(LostContact, IterateEndsBeforeItEvaluates) {
  const Sheet sheet(2);
  const Model model(text_of(2, coulomb));
  Slave tree(model, sheet.mesh); // for its tree
  double slave[4] = {1.5, -0.05, 2.9, -0.05}, xi[2] = {}, gap[2] = {};
  int64_t segment[2] = {-1, -1};
  int32_t flags[2] = {};
  const auto size = static_cast<std::size_t>(model.layout.state_size);
  std::vector<double> begin(2 * size), end(2 * size, -7.0);
  ASSERT_EQ(
      call::state_init(model.get(), int64_t{2}, begin.data(), int64_t{model.layout.state_size}, nullptr),
      ENTS_OK);
  ents_detection detection{};
  detection.struct_size = sizeof detection;
  detection.slave = slave, detection.reach = 0.5, detection.segment = segment, detection.xi = xi;
  detection.flags = flags;
  ents_input in{};
  in.struct_size = sizeof in;
  in.state_begin = begin.data(), in.state_begin_stride = model.layout.state_size;
  in.positions_begin = sheet.positions.data();
  ents_output out{};
  out.struct_size = sizeof out;
  out.wanted = ENTS_GAP | ENTS_STATE, out.gap = gap, out.gap_stride = 1;
  out.state_end = end.data(), out.state_end_stride = model.layout.state_size;
  ents_report report = new_report();
  const auto iterate = [&] {
    return call::iterate(model.get(), &sheet.mesh, tree.tree.data(), static_cast<int64_t>(tree.tree.size()),
                         int64_t{0}, int64_t{2}, &detection, &in, &out, nullptr, &report);
  };
  ASSERT_EQ(iterate(), ENTS_OK) << report.message;
  begin = end;
  end.assign(2 * size, -7.0);
  slave[0] = 1.6, slave[2] = 3.5;
  for (const bool forgotten : {false, true}) { // by the caller; its state is in contact all the same
    segment[0] = 1, segment[1] = forgotten ? -1 : 2;
    detection.permitted = 0;
    EXPECT_EQ(iterate(), ENTS_NO_PROJECTION) << forgotten;
    EXPECT_EQ(report.element, 1);
    EXPECT_NE(std::strstr(report.message, "slave 1 was on segment 2"), nullptr) << report.message;
    EXPECT_EQ(segment[0], 1);
    EXPECT_EQ(segment[1], -1);
    EXPECT_EQ(flags[1] & ENTS_FLAG_LEFT, ENTS_FLAG_LEFT);
    EXPECT_EQ(end, std::vector<double>(2 * size, -7.0));
    segment[1] = forgotten ? -1 : 2;
    detection.permitted = ENTS_FLAG_LEFT;
    EXPECT_EQ(iterate(), ENTS_OK) << report.message;
    EXPECT_NE(end[0], -7.0);
    end.assign(2 * size, -7.0);
  }
  detection.permitted = 0; // of several the first is named
  segment[0] = 1, segment[1] = 2, slave[0] = -0.5;
  EXPECT_EQ(iterate(), ENTS_NO_PROJECTION);
  EXPECT_EQ(report.element, 0);
  EXPECT_EQ(flags[0] & flags[1] & ENTS_FLAG_LEFT, ENTS_FLAG_LEFT);
}

} // namespace
} // namespace lost_contact_test
