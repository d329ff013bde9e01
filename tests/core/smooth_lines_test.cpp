// Smoothed lines alone: combinations of nodes, without a model.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/smoothing/smoothing.hpp"
#include "core/surface/basis.hpp"

namespace smooth_lines_test {
namespace {

using namespace ents;

// Point at xi of a segment whose control points are combinations of the nodes x.
double at(const Smoothed& s, std::int64_t segment, const std::vector<double>& x, double xi) {
  ENTS_ISA::Shape<double, 1, 4> N{};
  const double place[1] = {xi};
  ENTS_ISA::BSpline4::shape<0>(place, N);
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto point = static_cast<std::size_t>(s.segment_points[static_cast<std::size_t>(segment) * 4 + i]);
    for (auto k = static_cast<std::size_t>(s.begin[point]); k < static_cast<std::size_t>(s.begin[point + 1]);
         ++k)
      sum += N.n[i] * s.weights[k] * x[static_cast<std::size_t>(s.nodes[k])];
  }
  return sum;
}

struct Row {
  std::vector<std::int64_t> connectivity;
  std::vector<double> x;
};
// A closed ring of n facets, or an open row of them; x: a cubic of the arc where it is open
Row row(std::int64_t n, bool closed) {
  Row r;
  for (std::int64_t i = 0; i < n; ++i)
    r.connectivity.push_back(i), r.connectivity.push_back(closed ? (i + 1) % n : i + 1);
  const std::int64_t nodes = closed ? n : n + 1;
  for (std::int64_t i = 0; i < nodes; ++i) {
    const double t = static_cast<double>(i);
    r.x.push_back(closed ? std::cos(2.0 * std::numbers::pi * t / static_cast<double>(n))
                         : 0.1 * t * t * t - t);
  }
  return r;
}

Smoothed smooth(Ends ends, const Row& r) {
  Smoothed out;
  const Refusal refusal = smooth_lines(ends, static_cast<std::int64_t>(r.connectivity.size()) / 2,
                                       r.connectivity.data(), static_cast<std::int64_t>(r.x.size()), out);
  EXPECT_EQ(refusal.reason, Refusal::none);
  return out;
}

TEST(SmoothedLines, CombinationsSumToOne) {
  for (const Ends ends : {Ends::straight, Ends::repeated, Ends::quasi_cubic, Ends::quasi_parabolic})
    for (const bool closed : {false, true}) {
      Row r = row(9, closed);
      r.x.assign(r.x.size(), 1.0);
      const Smoothed s = smooth(ends, r);
      for (std::int64_t e = 0; e < 9; ++e)
        for (const double xi : {-1.0, -0.3, 0.8}) EXPECT_NEAR(at(s, e, r.x, xi), 1.0, 1e-15);
    }
}

// R (2 + cos t) / 3 of its nodes (theory.md): a spline whose control points are the nodes runs inside them.
TEST(SmoothedLines, AQuasiInterpolationFollowsTheNodesToOrderFour) {
  for (const std::int64_t n : {12, 24, 48}) {
    const Row r = row(n, true);
    const double t = 2.0 * std::numbers::pi / static_cast<double>(n);
    EXPECT_NEAR(at(smooth(Ends::straight, r), 0, r.x, -1.0), (2.0 + std::cos(t)) / 3.0, 1e-15);
    // (-1, 8, -1) / 6: 1 - (1 - cos t)^2 / 9, a 36th of the fourth difference
    EXPECT_NEAR(at(smooth(Ends::quasi_cubic, r), 0, r.x, -1.0), 1.0 - std::pow(1.0 - std::cos(t), 2) / 9.0,
                1e-14);
  }
}

TEST(SmoothedLines, QuasiCubicEndsReproduceCubics) {
  const Row r = row(8, false);
  const Smoothed s = smooth(Ends::quasi_cubic, r);
  for (std::int64_t e = 0; e < 8; ++e)
    for (const double xi : {-1.0, 0.1, 1.0}) {
      const double t = static_cast<double>(e) + 0.5 * (xi + 1.0);
      EXPECT_NEAR(at(s, e, r.x, xi), 0.1 * t * t * t - t, 1e-13) << e;
    }
}

TEST(SmoothedLines, ThreeFacetsInANodeAreRefused) {
  const std::vector<std::int64_t> connectivity = {0, 1, 1, 2, 1, 3};
  Smoothed out;
  const Refusal refusal = smooth_lines(Ends::straight, 3, connectivity.data(), 4, out);
  EXPECT_EQ(refusal.reason, Refusal::branch);
  EXPECT_EQ(refusal.node, 1);
}

} // namespace
} // namespace smooth_lines_test
