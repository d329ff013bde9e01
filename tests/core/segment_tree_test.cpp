// The tree of boxes alone: a plan whose only kernel is the box of a straight line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/search/detection.hpp"
#include "core/search/segment_tree.hpp"

namespace segment_tree_test {
namespace {

using namespace ents;

void box_of_line(const Plan&, const double* master, const double*, double* low, double* high) {
  for (int k = 0; k < 2; ++k)
    low[k] = std::min(master[k], master[2 + k]), high[k] = std::max(master[k], master[2 + k]);
}

class SegmentTree : public testing::Test {
protected:
  explicit SegmentTree(std::int64_t segments = 1000) {
    plan.dimension = 2, plan.nodes = 2, plan.parameters = 1;
    plan.box = box_of_line;
    for (std::int64_t i = 0; i < segments; ++i) connectivity.push_back(i), connectivity.push_back(i + 1);
    double x = 0.0, y = 0.0;
    for (std::int64_t i = 0; i <= segments; ++i) {
      positions.push_back(x), positions.push_back(y);
      x += random(-1.0, 1.0), y += random(-1.0, 1.0);
    }
    mesh = {segments, connectivity.data(), segments + 1, positions.data(), nullptr};
    tree.resize(static_cast<std::size_t>(tree_size(plan, segments)));
    std::int64_t refused = -1;
    EXPECT_EQ(build_tree(plan, mesh, tree.data(), refused), Status::ok);
  }
  double random(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  double distance(std::int64_t segment, const double* point) {
    double box[4];
    box_of_line(plan, positions.data() + 2 * segment, nullptr, box, box + 2);
    return distance_to_box(2, point, box);
  }
  // The segment whose box is closest, and how many were looked at
  Status nearest(const double* point, std::int64_t& found, int& visited) {
    double least = 1e100;
    found = -1, visited = 0;
    return visit_segments(
        BoxTree(plan, mesh.segments), tree.data(),
        [&](const double* box) { return distance_to_box(2, point, box); }, [&] { return least; },
        [&](std::int64_t s) {
          ++visited;
          if (const double here = distance(s, point); here < least) least = here, found = s;
          return Status::ok;
        });
  }
  void compare_with_all(int most_visited) {
    for (int i = 0; i < 500; ++i) {
      const double point[2] = {random(-30.0, 30.0), random(-30.0, 30.0)};
      std::int64_t found = -1;
      int visited = 0;
      ASSERT_EQ(nearest(point, found, visited), Status::ok);
      double least = 1e100;
      for (std::int64_t s = 0; s < mesh.segments; ++s) least = std::min(least, distance(s, point));
      ASSERT_EQ(distance(found, point), least);
      sum += visited;
    }
    EXPECT_LE(sum / 500, most_visited);
  }

  std::mt19937 engine{3};
  Plan plan{};
  std::vector<std::int64_t> connectivity;
  std::vector<double> positions, tree;
  MasterMesh mesh{};
  int sum = 0;
};

TEST_F(SegmentTree, FindsTheNearestBoxAndLooksAtFew) { compare_with_all(100); }

TEST_F(SegmentTree, FollowsNodesThatMove) {
  for (double& x : positions) x += random(-5.0, 5.0);
  std::int64_t refused = -1;
  ASSERT_EQ(refit_tree(plan, mesh, tree.data(), refused), Status::ok);
  compare_with_all(400);
}

TEST_F(SegmentTree, SaysThatItWasWrittenOver) {
  const double point[2] = {0.0, 0.0};
  std::int64_t found = -1;
  int visited = 0;
  BoxTree(plan, mesh.segments).order(tree.data())[0] = -7.0;
  for (std::int64_t node = 1; node < 2 * BoxTree(plan, mesh.segments).leaves();
       ++node) // so that all is looked at
    std::fill_n(BoxTree(plan, mesh.segments).box(tree.data(), node), 2, -1e9),
        std::fill_n(BoxTree(plan, mesh.segments).box(tree.data(), node) + 2, 2, 1e9);
  EXPECT_EQ(nearest(point, found, visited), Status::bad_state);
}

TEST_F(SegmentTree, IsNoneOfAnotherMesh) {
  EXPECT_TRUE(is_tree(plan, mesh, tree.data()));
  MasterMesh other = mesh;
  other.segments -= 1;
  EXPECT_FALSE(is_tree(plan, other, tree.data()));
  plan.dimension = 3;
  EXPECT_FALSE(is_tree(plan, mesh, tree.data()));
}

TEST_F(SegmentTree, NamesTheSegmentWhoseNodeIsNoNumber) {
  positions[2 * 500] = std::nan("");
  std::int64_t refused = -1;
  EXPECT_EQ(build_tree(plan, mesh, tree.data(), refused), Status::non_finite);
  EXPECT_EQ(refused, 499);
  EXPECT_FALSE(is_tree(plan, mesh, tree.data()));
}

} // namespace
} // namespace segment_tree_test
