// SPDX-License-Identifier: BSD-3-Clause
// Degenerate and borderline geometry: each case has one verdict, at three sizes and three rotations.
//
// Elsewhere: friction without slip or pressure, what is searched or outside (borderline_test.cpp), numbers of
// a law (bad_input_test.cpp), node numbers and surfaces without segments (mesh_test.cpp), many segments
// (tests/mechanics/detection_test.cpp).
#include <gtest/gtest.h>

#include "support/pose.hpp"

namespace degenerate_test {
namespace {

using namespace test;

TEST(Degenerate, ZeroLengthOrZeroAreaIsADegenerateSegment) {
  everywhere([](const Basis& b, const std::string& h, const std::string& p, const Pose& pose) {
    const Model model = model_in(pose, b, h, p);
    Results results(model.layout);
    ents_report report = new_report();
    const auto d = static_cast<std::size_t>(b.dimension);

    Element point; // all nodes in one point
    point[slave] = above_centre(b, -0.1);
    for (std::size_t i = 0; i < b.nodes.size(); ++i)
      point[master].insert(point[master].end(), {0.3, 0.1}), point[master].resize(d * (i + 1), 0.2);
    for (const bool searched : {false, true}) {
      Element e = posed(point, pose, b.dimension);
      if (!searched) e[start] = centre(b);
      EXPECT_EQ(test::evaluate(model, e, want_all, results, &report), ENTS_DEGENERATE_SEGMENT);
      EXPECT_STREQ(report.message, "element 0: degenerate segment: zero area, folded, or no normal");
      EXPECT_EQ(report.element, 0);
    }
    if (d == 2) return;
    Element line; // all nodes on one line: the second natural coordinate does nothing
    line[slave] = above_centre(b, -0.1);
    for (const auto& node : b.nodes) line[master].insert(line[master].end(), {node[0], 0.5 * node[0], 0.0});
    for (const bool searched : {false, true}) {
      Element e = posed(line, pose, b.dimension);
      if (!searched) e[start] = centre(b);
      EXPECT_EQ(test::evaluate(model, e, want_all, results, &report), ENTS_DEGENERATE_SEGMENT);
    }
  });
}

// Where rho turns back on itself it has no tangent: a line3 whose middle node lies beyond the quarter points
// folds on the segment. The slave lies beyond the fold, so the fold is the closest point. (Enriched, the
// surface jumps there by twice the height; the fold itself is not on it.)
TEST(Degenerate, ProjectionOnAFoldHasNoNormal) {
  const Basis& b = basis("line3");
  for (const Pose& pose : poses(2)) {
    SCOPED_TRACE("size " + number(pose.size));
    const Model model = model_in(pose, b, "none", "normal");
    Results results(model.layout);
    Element e;
    e[master] = {-1.0, 0.0, 1.0, 0.0, 0.7, 0.0}; // rho(xi) = 0.7 + xi - 0.7 xi^2: the fold is at xi = 1 / 1.4
    e[slave] = {1.5, 0.0};
    e = posed(e, pose, 2);
    for (const double x : {0.5, 0.9, 1.0 / 1.4}) {
      e[start] = {x};
      EXPECT_EQ(test::evaluate(model, e, want_all, results), ENTS_DEGENERATE_SEGMENT) << "from " << x;
    }
    e[start].clear();
    EXPECT_EQ(test::evaluate(model, e, want_all, results), ENTS_DEGENERATE_SEGMENT);
  }
}

// A quad4 with two neighbouring corners exchanged is twisted by half a turn: on the line through its middle,
// eta = 0, the first tangent vanishes and the normal turns over.
TEST(Degenerate, TwistedSegmentHasNoNormalInItsMiddle) {
  const Basis& b = basis("quad4");
  for (const std::string& p : projection_kinds())
    for (const Pose& pose : poses(3)) {
      SCOPED_TRACE(p + " size " + number(pose.size));
      const Model model = model_in(pose, b, "none", p);
      Results results(model.layout);
      Element e;
      e[master] = {-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0};
      e[slave] =
          p == "normal" ? std::vector<double>{0.0, 0.0, -0.01} : std::vector<double>{-0.002, 0.001, -0.01};
      e[start] = {0.0, 0.0};
      e = posed(e, pose, 3);
      const int32_t status = test::evaluate(model, e, want_all, results);
      EXPECT_TRUE(status == ENTS_DEGENERATE_SEGMENT || status == ENTS_GRAZING_RAY)
          << status << ", gap " << results.gap();
    }
}

TEST(Degenerate, CollapsedEdgeHasNoNormal) { // a quad4 used as a triangle, the slave on its tip
  const Basis& b = basis("quad4");
  for (const char* h : {"none", "sine"})
    for (const std::string& p : projection_kinds())
      for (const Pose& pose : poses(3)) {
        SCOPED_TRACE(std::string(h) + " " + p + " size " + number(pose.size));
        const Model model = model_in(pose, b, h, p);
        Results results(model.layout);
        Element e;
        e[master] = {-1, -1, 0, 1, -1, 0, 0, 1, 0, 0, 1, 0};
        e[slave] = {0.0, 1.0, 0.0};
        e[start] = {0.0, 1.0};
        e = posed(e, pose, 3);
        const int32_t status = test::evaluate(model, e, want_all, results);
        if (h == std::string("none") && p == "normal") // the plain triangle's own tip
          EXPECT_TRUE(status == ENTS_OK && std::fabs(results.gap()) < 1e-9 * pose.size)
              << status << ", gap " << results.gap();
        else
          EXPECT_TRUE(status > 0) << status << ", gap " << results.gap();
        // and a little inside, where there is a normal, all is well
        e[slave] = {0.0, 0.5, -0.01};
        e[start] = {0.0, 0.5};
        Element inside = posed(e, {1.0, pose.turn}, 3);
        inside[master] = e[master];
        for (double& v : inside[slave]) v *= pose.size;
        EXPECT_EQ(test::evaluate(model, inside, want_all, results), ENTS_OK);
      }
}

} // namespace
} // namespace degenerate_test
