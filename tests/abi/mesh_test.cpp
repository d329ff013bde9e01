// SPDX-License-Identifier: BSD-3-Clause
// Whole master surfaces as arguments: elements gathered from a mesh are those of the caller's own arrays;
// mistakes have names.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "sample_count.hpp"
#include "support/element.hpp"

namespace mesh_test {
namespace {

using namespace test;

// Three elements, each with nodes of its own, as a mesh; numbered backwards.
struct MeshOfElements {
  MeshOfElements(const Model& model, const Basis& basis, Random& random) {
    mesh.struct_size = sizeof mesh;
    const int64_t count = 3, m = model.layout.nodes;
    for (int64_t e = 0; e < count; ++e) elements.push_back(draw(model, basis, random));
    for (Element& element : elements) // all or none
      if (elements[0][surface_coordinates].empty() || element[surface_coordinates].empty())
        for (Element& each : elements) each[surface_coordinates].clear();
    for (int64_t e = 0; e < count; ++e) {
      Element& element = elements[static_cast<std::size_t>(count - 1 - e)];
      positions.insert(positions.end(), element[master].begin(), element[master].end());
      coordinates.insert(coordinates.end(), element[surface_coordinates].begin(),
                         element[surface_coordinates].end());
      for (int64_t i = 0; i < m; ++i) connectivity.push_back(e * m + i);
      segments.push_back(count - 1 - e);
    }
    mesh.segments = count, mesh.nodes = count * m;
    mesh.connectivity = connectivity.data(), mesh.positions = positions.data();
    if (!coordinates.empty()) mesh.surface_coordinates = coordinates.data();
  }
  std::vector<Element> elements;
  std::vector<int64_t> connectivity, segments; // of each element
  std::vector<double> positions, coordinates;
  ents_master_mesh mesh{};
};

TEST(Mesh, GivesTheBitsOfTheCallersArrays) {
  Random random(81);
  for (const ModelKind& kind : all_kinds()) {
    const Model model(text(kind));
    const MeshOfElements m(model, basis(kind.basis), random);
    for (std::size_t e = 0; e < m.elements.size(); ++e) {
      Results expected(model.layout), results(model.layout);
      test::evaluate(model, m.elements[e], want_all, expected);
      ents_input input = input_of(m.elements[e]);
      input.master = input.surface_coordinates = nullptr;
      input.mesh = &m.mesh, input.segment = &m.segments[e];
      const ents_output output = output_of(results, want_all);
      call::evaluate(model.get(), int64_t{0}, int64_t{1}, &input, &output, nullptr);
      // but for the number of the segment, which a state knows with a mesh only
      constexpr std::size_t state_end = 13; // of the outputs
      static_assert(outputs[state_end].bit == ENTS_STATE);
      double& number = results.real[state_end].back();
      EXPECT_TRUE(results.status != ENTS_OK || number == static_cast<double>(m.segments[e] + 1));
      number = expected.real[state_end].back();
      ASSERT_TRUE(same_bits(results, expected)) << text(kind);
    }
  }
}

// A box holds all of its enriched segment, with its height.
TEST(Mesh, BoxesHoldTheEnrichedSegments) {
  Random random(83);
  for (const ModelKind& kind : all_kinds()) {
    const Model model(text(kind));
    const Basis& form = basis(kind.basis);
    MeshOfElements m(model, form, random);
    const int64_t d = model.layout.dimension, nodes = model.layout.nodes, p = model.layout.parameters;
    std::vector<double> boxes(static_cast<std::size_t>(m.mesh.segments * 2 * d), 7e77);
    ASSERT_EQ(call::surface_boxes(model.get(), &m.mesh, boxes.data(), nullptr), ENTS_OK) << text(kind);
    for (int64_t s = 0; s < m.mesh.segments; ++s) {
      double xi[2] = {random(0.0, 1.0), random(0.0, 1.0)}, point[3] = {};
      for (double& x : xi) x = form.simplex ? x / 2 : 2 * x - 1;
      ents_surface surface{};
      surface.struct_size = sizeof surface;
      surface.master = m.positions.data() + s * nodes * d, surface.xi = xi, surface.point = point;
      if (!m.coordinates.empty()) surface.surface_coordinates = m.coordinates.data() + s * nodes * p;
      ASSERT_EQ(call::surface_evaluate(model.get(), int64_t{1}, &surface, nullptr), ENTS_OK) << text(kind);
      const double* box = boxes.data() + s * 2 * d;
      for (int64_t k = 0; k < d; ++k) {
        const double rounding = 1e-14 * (std::fabs(box[k]) + std::fabs(box[d + k])); // of a sum over nodes
        EXPECT_GE(point[k], box[k] - rounding) << text(kind);
        EXPECT_LE(point[k], box[d + k] + rounding) << text(kind);
      }
    }
  }
}

class MeshMistakes : public testing::Test {
protected:
  MeshMistakes() {
    mesh_.struct_size = sizeof mesh_;
    mesh_.segments = 2, mesh_.nodes = 3;
    mesh_.connectivity = connectivity_, mesh_.positions = positions_;
    call::tree_size(model_.get(), int64_t{2}, &size_, nullptr);
    tree_.resize(static_cast<std::size_t>(size_));
    call::tree_build(model_.get(), &mesh_, tree_.data(), size_, nullptr);
    io_.struct_size = sizeof io_;
    io_.slave = slave_, io_.reach = 1, io_.segment = segment_, io_.xi = xi_;
    io_.gap = gap_, io_.flags = flags_;
  }
  int32_t build() { return call::tree_build(model_.get(), &mesh_, tree_.data(), size_, &report_); }
  int32_t refit() { return call::tree_refit(model_.get(), &mesh_, tree_.data(), size_, &report_); }
  int32_t detect() {
    return call::detect(model_.get(), &mesh_, tree_.data(), size_, int64_t{0}, int64_t{2}, &io_, &report_);
  }
  // `mistake` gives this status and a message with these words; without it all is well again.
  void expect(int32_t status, const char* words, const std::function<int32_t()>& call_it) {
    EXPECT_EQ(call_it(), status) << words;
    EXPECT_NE(std::strstr(report_.message, words), nullptr) << report_.message;
  }

  Model model_{R"({"segment": "line2"})"};
  int64_t connectivity_[4] = {0, 1, 1, 2};
  double positions_[6] = {0, 0, 1, 0, 2, 0};
  ents_master_mesh mesh_{};
  int64_t size_ = 0;
  std::vector<double> tree_;
  double slave_[4] = {0.5, 0.1, 1.5, 0.1}, xi_[2] = {0, 0}, gap_[2] = {7, 7};
  int64_t segment_[2] = {-1, -1};
  int32_t flags_[2] = {7, 7};
  ents_detection io_{};
  ents_report report_ = new_report();
};

TEST_F(MeshMistakes, NoneGivesTheProjections) {
  ASSERT_EQ(detect(), ENTS_OK) << report_.message;
  EXPECT_EQ(segment_[0], 0);
  EXPECT_EQ(segment_[1], 1);
  EXPECT_NEAR(gap_[1], 0.1, 1e-16);
  EXPECT_NEAR(xi_[1], 0.0, 1e-15);
  EXPECT_EQ(flags_[0], ENTS_FLAG_SEARCHED);
}

TEST_F(MeshMistakes, InTheMesh) {
  connectivity_[3] = 3;
  expect(ENTS_BAD_VALUE, "node 1 of segment 1 is 3; nodes are 0 .. 2", [&] { return build(); });
  connectivity_[3] = -1;
  expect(ENTS_BAD_STATE, "ents_tree_refit has failed", [&] { return detect(); });
  connectivity_[3] = 2;
  ASSERT_EQ(build(), ENTS_OK);
  connectivity_[3] = -1;
  expect(ENTS_BAD_VALUE, "node 1 of segment 1 is -1", [&] { return detect(); });
  expect(ENTS_BAD_VALUE, "node 1 of segment 1 is -1", [&] { return refit(); });
  connectivity_[3] = 2;
  ASSERT_EQ(build(), ENTS_OK);
  positions_[3] = std::numeric_limits<double>::quiet_NaN();
  segment_[0] = -1, segment_[1] = -1;
  expect(ENTS_NON_FINITE, "mesh.positions of node 1", [&] { return detect(); });
  expect(ENTS_NON_FINITE, "mesh.positions of node 1", [&] { return refit(); });
  positions_[3] = 0.0;
  ASSERT_EQ(build(), ENTS_OK);
  mesh_.segments = -1;
  expect(ENTS_BAD_COUNT, "mesh.segments = -1", [&] { return detect(); });
  mesh_.segments = 2;
  mesh_.positions = nullptr;
  expect(ENTS_NULL_ARGUMENT, "mesh.positions is null", [&] { return detect(); });
  mesh_.positions = positions_;
  mesh_.reserved = 1;
  expect(ENTS_STRUCT_SIZE, "mesh.reserved", [&] { return detect(); });
  mesh_.reserved = 0;
  EXPECT_EQ(detect(), ENTS_OK);
}

TEST_F(MeshMistakes, InTheBoxes) {
  double boxes[8] = {};
  const auto list = [&] { return call::surface_boxes(model_.get(), &mesh_, boxes, &report_); };
  ASSERT_EQ(list(), ENTS_OK);
  for (int s = 0; s < 2; ++s) { // lines of length 1 with the default border, a tenth of their half length
    const double* box = boxes + 4 * s;
    EXPECT_LE(box[0], s);
    EXPECT_GE(box[2], s + 1);
    EXPECT_LT(box[2] - box[0], 1.2);
    EXPECT_LT(box[3] - box[1], 0.2);
  }
  connectivity_[3] = 3;
  expect(ENTS_BAD_VALUE, "node 1 of segment 1 is 3; nodes are 0 .. 2", list);
  EXPECT_EQ(report_.element, 1);
  connectivity_[3] = 2;
  positions_[3] = std::numeric_limits<double>::quiet_NaN();
  expect(ENTS_NON_FINITE, "mesh.positions of node 1", list);
  positions_[3] = 0.0;
  EXPECT_EQ(call::surface_boxes(model_.get(), &mesh_, nullptr, &report_), ENTS_NULL_ARGUMENT);
  EXPECT_EQ(call::surface_boxes(nullptr, &mesh_, boxes, &report_), ENTS_NULL_ARGUMENT);
  mesh_.segments = 0;
  EXPECT_EQ(call::surface_boxes(model_.get(), &mesh_, nullptr, &report_), ENTS_OK);
}

TEST_F(MeshMistakes, InTheTree) {
  --size_;
  expect(ENTS_BAD_COUNT, "(ents_tree_size)", [&] { return build(); });
  expect(ENTS_BAD_COUNT, "(ents_tree_size)", [&] { return detect(); });
  ++size_;
  tree_[0] += 1.0;
  expect(ENTS_BAD_STATE, "ents_tree_build", [&] { return refit(); });
  expect(ENTS_BAD_STATE, "ents_tree_build", [&] { return detect(); });
  EXPECT_EQ(build(), ENTS_OK);
  mesh_.segments = 1; // a tree of two
  expect(ENTS_BAD_STATE, "not a whole tree of 1 segments", [&] { return detect(); });
  EXPECT_EQ(call::detect(model_.get(), &mesh_, nullptr, size_, int64_t{0}, int64_t{2}, &io_, &report_),
            ENTS_NULL_ARGUMENT);
  int64_t size = 0;
  EXPECT_EQ(call::tree_size(model_.get(), int64_t{-1}, &size, &report_), ENTS_BAD_COUNT);
  EXPECT_EQ(call::tree_size(model_.get(), std::numeric_limits<int64_t>::max(), &size, &report_),
            ENTS_BAD_COUNT);
  EXPECT_EQ(call::tree_size(model_.get(), int64_t{1}, nullptr, &report_), ENTS_NULL_ARGUMENT);
}

TEST_F(MeshMistakes, InTheSlaves) {
  slave_[2] = std::numeric_limits<double>::infinity();
  expect(ENTS_NON_FINITE, "detection.slave[0] of node 1 is infinite", [&] { return detect(); });
  EXPECT_EQ(segment_[0], 0) << "nodes before the mistake are done";
  EXPECT_EQ(segment_[1], -1);
  EXPECT_EQ(gap_[1], 7.0);
  slave_[2] = 1.5;
  segment_[1] = 2;
  expect(ENTS_BAD_VALUE, "detection.segment of node 1 is 2; -1 or 0 .. 1", [&] { return detect(); });
  segment_[1] = 1;
  xi_[1] = std::numeric_limits<double>::quiet_NaN();
  expect(ENTS_NON_FINITE, "detection.xi of node 1", [&] { return detect(); });
  xi_[1] = 0.0;
  for (const double reach :
       {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    io_.reach = reach;
    expect(ENTS_BAD_VALUE, "detection.reach", [&] { return detect(); });
  }
  io_.reach = 1.0;
  io_.xi = nullptr;
  expect(ENTS_NULL_ARGUMENT, "detection.xi is null", [&] { return detect(); });
  io_.xi = xi_;
  EXPECT_EQ(detect(), ENTS_OK);
}

TEST_F(MeshMistakes, InAnElement) {
  Results results(model_.layout);
  const ents_output output = output_of(results, ENTS_GAP);
  ents_input input{};
  input.struct_size = sizeof input;
  input.slave = slave_, input.mesh = &mesh_;
  const auto evaluate = [&] {
    return call::evaluate(model_.get(), int64_t{0}, int64_t{1}, &input, &output, &report_);
  };
  expect(ENTS_NULL_ARGUMENT, "input.segment is null", evaluate);
  segment_[0] = 0;
  input.segment = segment_;
  EXPECT_EQ(evaluate(), ENTS_OK);
  for (const int64_t segment : {int64_t{-1}, int64_t{2}}) {
    segment_[0] = segment;
    expect(ENTS_BAD_VALUE, "input.segment of element 0", evaluate);
    EXPECT_EQ(results.status, ENTS_BAD_VALUE);
  }
  segment_[0] = 1;
  input.master = positions_;
  expect(ENTS_BAD_VALUE, "input.master and input.mesh are both given", evaluate);
  input.master = nullptr, input.mesh = nullptr;
  expect(ENTS_NULL_ARGUMENT, "input.master is null", evaluate);
}

// Whatever the numbers: a status, and what is written is finite.
TEST(MeshNumbers, AnyEndInAStatus) {
  Random random(82);
  const double special[] = {std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity(),
                            1e308,
                            -1e155,
                            1e-155,
                            5e-324,
                            -0.0,
                            0.0};
  int64_t calls = 0, found = 0, refused = 0;
  for (const ModelKind& kind : all_kinds()) {
    if (!is_taken(random)) continue;
    const Model model(text(kind));
    MeshOfElements m(model, basis(kind.basis), random);
    int64_t size = 0;
    ASSERT_EQ(call::tree_size(model.get(), m.mesh.segments, &size, nullptr), ENTS_OK);
    std::vector<double> tree(static_cast<std::size_t>(size));
    const std::vector<double> good = m.positions;
    for (int repeat = 0; repeat < 4; ++repeat) {
      if (sample_divisor == 1 && !is_long_taken(random)) continue;
      m.positions = good;
      std::vector<double> node = m.elements[0][test::slave];
      for (int k = repeat % 4; k > 0; --k) {
        std::vector<double>& array = random.below(3) == 0 ? node : m.positions;
        double& x = array[static_cast<std::size_t>(random.below(static_cast<int>(array.size())))];
        x = random.below(2) == 0 ? special[random.below(8)] : x * std::pow(10.0, random(-300.0, 300.0));
      }
      m.mesh.positions = m.positions.data();
      int64_t segment = -1;
      double xi[2] = {0.0, 0.0}, gap = 0.0;
      ents_detection io{};
      io.struct_size = sizeof io;
      io.slave = node.data(), io.reach = std::pow(10.0, random(-3.0, 3.0)), io.segment = &segment, io.xi = xi,
      io.gap = &gap;
      int32_t status = call::tree_build(model.get(), &m.mesh, tree.data(), size, nullptr);
      if (status == ENTS_OK)
        status = call::detect(model.get(), &m.mesh, tree.data(), size, int64_t{0}, int64_t{1}, &io, nullptr);
      ++calls;
      found += segment >= 0;
      refused += status != ENTS_OK;
      ASSERT_TRUE(status == ENTS_OK || status == ENTS_NON_FINITE) << status;
      ASSERT_TRUE(std::isfinite(xi[0]) && std::isfinite(xi[1]) && std::isfinite(gap)) << text(kind);
    }
  }
  EXPECT_GT(found, calls / 4);
  EXPECT_GT(refused, calls / 20);
}

// The light stands on the slave: there is no ray, and nothing is found.
TEST(MeshNumbers, AnEmitterOnTheSlave) {
  const Model model(R"({"segment": "line2", "projection": {"type": "shadow_point", "emitter": [0.5, 1]}})");
  const int64_t connectivity[] = {0, 1};
  const double positions[] = {0, 0, 1, 0}, slave[] = {0.5, 1};
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = 1, mesh.nodes = 2, mesh.connectivity = connectivity, mesh.positions = positions;
  int64_t size = 0, segment = -1;
  ASSERT_EQ(call::tree_size(model.get(), int64_t{1}, &size, nullptr), ENTS_OK);
  std::vector<double> tree(static_cast<std::size_t>(size));
  ASSERT_EQ(call::tree_build(model.get(), &mesh, tree.data(), size, nullptr), ENTS_OK);
  double xi = 0.0;
  ents_detection io{};
  io.struct_size = sizeof io;
  io.slave = slave, io.reach = 2, io.segment = &segment, io.xi = &xi;
  EXPECT_EQ(call::detect(model.get(), &mesh, tree.data(), size, int64_t{0}, int64_t{1}, &io, nullptr),
            ENTS_OK);
  EXPECT_EQ(segment, -1);
}

// A surface without segments has a tree, and nothing on it.
TEST_F(MeshMistakes, NoSegmentsNoComplaint) {
  mesh_.segments = 0;
  ASSERT_EQ(build(), ENTS_OK) << report_.message;
  ASSERT_EQ(detect(), ENTS_OK) << report_.message;
  EXPECT_EQ(segment_[0], -1);
}

} // namespace
} // namespace mesh_test
