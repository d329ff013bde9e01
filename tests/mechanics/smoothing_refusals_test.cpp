// SPDX-License-Identifier: BSD-3-Clause
// Facets that are no surface.
#include <gtest/gtest.h>

#include "smoothed_surface.hpp"

namespace mechanics::smoothing_refusals_test {
namespace {

// Everything that is refused, and that it is named.
TEST(Smoothing, RefusesWhatIsNoSurface) {
  struct Bad {
    const char *facet, *basis;
    std::vector<std::int64_t> connectivity;
    std::int64_t nodes, facets;
    std::int32_t status;
    std::int64_t element;
    std::vector<std::string> says;
  };
  const std::vector<Bad> all = {
      {"line2", "bspline4", {0, 1, 2, 1}, 3, 2, ENTS_BAD_VALUE, 1, {"facets 1 and 0", "node 1", "oriented"}},
      {"line2",
       "bspline4",
       {0, 1, 1, 2, 1, 3},
       4,
       3,
       ENTS_BAD_VALUE,
       2,
       {"more than two", "node 1", "2 and 1"}},
      {"line2", "catmull_rom4", {0, 1, 1, 1}, 2, 2, ENTS_BAD_VALUE, 1, {"facet 1 has node 1 twice"}},
      {"line2",
       "bspline4",
       {0, 1, 1, 4},
       4,
       2,
       ENTS_BAD_VALUE,
       1,
       {"connectivity[3] = 4 is not a node (0 .. 3)"}},
      {"line2", "bspline4", {0, -1}, 4, 1, ENTS_BAD_VALUE, 0, {"connectivity[1] = -1"}},
      {"quad4", "bspline16", {0, 1, 2, 0}, 3, 1, ENTS_BAD_VALUE, 0, {"facet 0 has node 0 twice"}},
      {"quad4",
       "bspline16",
       {0, 1, 2, 3, 1, 2, 4, 5},
       6,
       2,
       ENTS_BAD_VALUE,
       1,
       {"facets 1 and 0", "nodes 1 and 2", "oriented"}},
      {"quad4",
       "bspline16",
       {0, 1, 2, 3, 2, 1, 4, 5, 1, 2, 6, 7},
       8,
       3,
       ENTS_BAD_VALUE,
       2,
       {"more than two", "nodes 1 and 2"}},
      {"quad4", "bspline16", {0, 1, 2, 3, 2, 4, 5, 6}, 7, 2, ENTS_BAD_VALUE, 1, {"touch in node 2"}},
      {"quad4",
       "bspline16",
       {0, 1, 2, 3, 0, 3, 2, 4},
       5,
       2,
       ENTS_BAD_VALUE,
       0,
       {"only two facets", "node 3"}},
      {"quad4", "tri3", {0, 1, 2, 3}, 4, 1, ENTS_BAD_VALUE, -1, {"'facet' and 'basis'"}},
      {"line2", "bspline16", {0, 1}, 2, 1, ENTS_BAD_VALUE, -1, {"'facet' and 'basis'"}},
      {nullptr, "bspline16", {0, 1}, 2, 1, ENTS_NULL_ARGUMENT, -1, {"'facet'"}},
      {"line2", nullptr, {0, 1}, 2, 1, ENTS_NULL_ARGUMENT, -1, {"'basis'"}},
      {"line2", "bspline4", {}, 2, 1, ENTS_NULL_ARGUMENT, -1, {"'connectivity'"}},
      {"line2", "bspline4", {0, 1}, 2, -1, ENTS_BAD_COUNT, -1, {"facets = -1"}},
      {"line2", "bspline4", {0, 1}, std::int64_t{1} << 41, 1, ENTS_BAD_COUNT, -1, {"nodes = "}}};
  ents_report report{};
  report.struct_size = sizeof report;
  const auto expect = [&](std::int32_t got, const Bad& bad) {
    EXPECT_EQ(got, bad.status) << report.message;
    EXPECT_EQ(report.element, bad.element) << report.message;
    for (const std::string& text : bad.says)
      EXPECT_NE(std::string(report.message).find(text), std::string::npos) << report.message;
  };
  for (const Bad& bad : all) {
    std::int64_t points = -7, terms = -7, segment_points = -7, begin = -7, nodes = -7;
    double weights = -7.0;
    const std::int64_t* connectivity = bad.connectivity.empty() ? nullptr : bad.connectivity.data();
    expect(ents_smooth_size(bad.facet, bad.basis, 0, bad.facets, connectivity, bad.nodes, &points, &terms,
                            &report),
           bad);
    expect(ents_smooth(bad.facet, bad.basis, 0, bad.facets, connectivity, bad.nodes, 1, 1, &segment_points,
                       &begin, &nodes, &weights, &report),
           bad);
    for (const std::int64_t value : {points, terms, segment_points, begin, nodes}) EXPECT_EQ(value, -7);
    EXPECT_EQ(weights, -7.0);
  }
  // two closed surfaces that touch in a node
  HostMesh two = sphere(1);
  const std::int64_t shift = two.nodes() - 1;
  const std::vector<std::int64_t> one = two.connectivity;
  for (const std::int64_t node : one) two.connectivity.push_back(node == 0 ? 0 : node + shift);
  std::int64_t points = 0, terms = 0;
  const auto size = [&](const HostMesh& mesh, const char* basis, std::int32_t ends) {
    return ents_smooth_size("quad4", basis, ends, mesh.facets(), mesh.connectivity.data(), 1000, &points,
                            &terms, &report);
  };
  EXPECT_EQ(size(two, "bspline16", 0), ENTS_BAD_VALUE);
  EXPECT_NE(std::string(report.message).find("touch in node 0"), std::string::npos) << report.message;
  // irregular: an inner node, a node of the border
  for (const auto& [mesh, node] :
       {std::pair{star(5, 2), 0}, {squares(2, [](int i, int j) { return i + j < 2; }), 4}}) {
    EXPECT_EQ(size(mesh, "catmull_rom16", 0), ENTS_BAD_VALUE);
    EXPECT_NE(std::string(report.message)
                  .find("irregular at node " + std::to_string(mesh.facets() == 3 ? mesh.corner(0, 2) : node)),
              std::string::npos)
        << report.message;
    EXPECT_EQ(size(mesh, "bspline16", 0), ENTS_OK);
  }
  EXPECT_EQ(size(squares(1), "bspline16", -1), ENTS_BAD_VALUE);
  EXPECT_NE(std::string(report.message).find("'ends' is -1"), std::string::npos);
  // sizes that are not those
  const HostMesh mesh = squares(1);
  ASSERT_EQ(size(mesh, "bspline16", 0), ENTS_OK);
  std::vector<std::int64_t> segment(16), begin(2000), nodes(2000);
  std::vector<double> weights(2000);
  for (const auto& [wrong_points, wrong_terms] : {std::pair{1, 0}, {0, 1}, {0, -1}})
    EXPECT_EQ(ents_smooth("quad4", "bspline16", 0, 1, mesh.connectivity.data(), 1000, points + wrong_points,
                          terms + wrong_terms, segment.data(), begin.data(), nodes.data(), weights.data(),
                          &report),
              ENTS_BAD_COUNT);
  EXPECT_EQ(ents_smooth("quad4", "bspline16", 0, 1, mesh.connectivity.data(), 1000, points, terms,
                        segment.data(), begin.data(), nodes.data(), nullptr, &report),
            ENTS_NULL_ARGUMENT);
  // nothing is a surface, too
  EXPECT_EQ(ents_smooth_size("quad4", "bspline16", 0, 0, nullptr, 3, &points, &terms, &report), ENTS_OK);
  EXPECT_EQ(points, 3);
}

} // namespace
} // namespace mechanics::smoothing_refusals_test
