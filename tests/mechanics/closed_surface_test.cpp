// SPDX-License-Identifier: BSD-3-Clause
// Closed surfaces, whose every slave has one right answer: inside or outside, and how far. The reference is
// the exact signed distance: the closest point over all facets, and the parity of the facets that a ray from
// the slave goes through.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "flat_facets.hpp"
#include "mesh_surface.hpp"
#include "samples.hpp"

namespace mechanics::closed_surface_test {
namespace {

struct Reference {
  explicit Reference(const MeshSurface& mesh) : dimension(mesh.basis->dimension) {
    const auto d = static_cast<std::size_t>(dimension);
    for (std::int64_t s = 0; s < mesh.segments(); ++s) {
      const std::vector<double> nodes = mesh.master(s);
      facets.emplace_back();
      for (std::size_t i = 0; i < nodes.size(); i += d)
        facets.back().push_back({nodes[i], nodes[i + 1], d == 3 ? nodes[i + 2] : 0.0});
    }
  }
  // > 0 outside
  double signed_distance(const Point& x) const {
    double least = 1e300;
    bool inside = false;
    const Point u = {0.5377, 0.3117, 0.7833};
    for (const auto& p : facets) {
      if (dimension == 2) {
        least = std::min(least, distance_to_edge(x, p[0], p[1]));
        if ((p[0][1] > x[1]) != (p[1][1] > x[1]) &&
            x[0] < p[0][0] + (x[1] - p[0][1]) / (p[1][1] - p[0][1]) * (p[1][0] - p[0][0]))
          inside = !inside;
        continue;
      }
      least = std::min(least, distance_to_facet(x, p));
      for (std::size_t i = 2; i < p.size(); ++i) inside = inside != goes_through(x, u, p[0], p[i - 1], p[i]);
    }
    return inside ? -least : least;
  }
  int dimension;
  std::vector<std::vector<Point>> facets;
};

// A polygon whose corners lie at random radii round a centre: valleys and ridges of any angle. The body is
// inside: clockwise.
MeshSurface star(Random& random) {
  MeshSurface out;
  out.basis = &basis_named("line2");
  const int n = 4 + random.below(20);
  const double least = random.uniform(0.1, 0.9);
  for (int i = 0; i < n; ++i) {
    const double angle = -2.0 * std::acos(-1.0) * (i + random.uniform(-0.3, 0.3)) / n,
                 r = random.uniform(least, 1.0);
    out.positions.insert(out.positions.end(), {r * std::cos(angle), r * std::sin(angle)});
    out.connectivity.insert(out.connectivity.end(), {i, (i + 1) % n});
  }
  return out;
}

// A strip with two sides, bent or tapered, its ends closed.
MeshSurface plate(Random& random) {
  MeshSurface out;
  out.basis = &basis_named("line2");
  const int n = 1 + random.below(8);
  const double thick = std::pow(10.0, random.uniform(-2.5, -0.5)),
               taper = random.coin() ? random.uniform(0.05, 1.0) : 1.0;
  std::vector<double> middle;
  for (int i = 0; i <= n; ++i) middle.push_back(random.uniform(-0.2, 0.2));
  for (const int side : {1, -1})
    for (int k = 0; k <= n; ++k) {
      const int i = side > 0 ? k : n - k;
      const double t = static_cast<double>(i) / n, half = 0.5 * thick * (1.0 + t * (taper - 1.0));
      out.positions.insert(out.positions.end(),
                           {2.0 * t - 1.0, middle[static_cast<std::size_t>(i)] + side * half});
    }
  for (int i = 0; i < 2 * (n + 1);
       ++i) { // the upper side from left to right would have its normal up: as it has to be
    out.connectivity.push_back(i);
    out.connectivity.push_back((i + 1) % (2 * (n + 1)));
  }
  // left of who walks from left to right is up, outwards of the upper side
  return out;
}

// An icosahedron, its facets divided once, nodes at random radii.
MeshSurface ball(Random& random) {
  MeshSurface out;
  out.basis = &basis_named("tri3");
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Point> nodes = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::array<int, 3>> facets = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                            {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                            {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                            {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = random.below(2); level > 0; --level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [it, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(nodes.size()));
      if (is_new) {
        const Point p = nodes[static_cast<std::size_t>(a)], q = nodes[static_cast<std::size_t>(b)];
        nodes.push_back({p[0] + q[0], p[1] + q[1], p[2] + q[2]});
      }
      return it->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : facets) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    facets = finer;
  }
  const double least = random.uniform(0.3, 1.0);
  for (const Point& p : nodes) {
    const double r = random.uniform(least, 1.0) / std::sqrt(dot(p, p));
    for (const double x : p) out.positions.push_back(r * x);
  }
  for (const auto& f : facets) out.connectivity.insert(out.connectivity.end(), f.begin(), f.end());
  return out;
}

// A hexahedron of flat quadrilaterals: a plate tapered in one direction.
MeshSurface wedge(Random& random) {
  MeshSurface out;
  out.basis = &basis_named("quad4");
  const double thick = std::pow(10.0, random.uniform(-2.0, 0.0)), thin = thick * random.uniform(0.02, 1.0);
  for (const double z : {-0.5, 0.5})
    out.positions.insert(out.positions.end(),
                         {-1, -1, z * thick, 1, -1, z * thin, 1, 1, z * thin, -1, 1, z * thick});
  out.connectivity = {4, 5, 6, 7, 3, 2, 1, 0, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
  return out;
}

struct Counts {
  std::int64_t slaves = 0, phantom = 0, farther = 0, unseen = 0, flagged = 0, flagged_clear = 0, clear = 0,
               wrong_flag = 0;
};

std::int64_t slaves_of_each_reach() {
  const char* text = std::getenv("ENTS_TEST_SLAVES");
  return text ? std::atoll(text) : samples(20000);
}

void expect_right_answers(const char* what, MeshSurface (*draw)(Random&), std::uint64_t seed) {
  for (const double reach : {0.15, 0.5, 2.5}) {
    Random random(seed);
    Counts all;
    while (all.slaves < slaves_of_each_reach()) {
      const MeshSurface mesh = draw(random);
      const int d = mesh.basis->dimension;
      const Model model(nlohmann::json{{"segment", mesh.basis->name}}.dump());
      Detector detector(model, mesh);
      const Reference reference(mesh);
      std::vector<double> slaves;
      std::vector<double> distance;
      for (int i = 0; i < 200; ++i) {
        Point x = {random.uniform(-1.3, 1.3), random.uniform(-1.3, 1.3),
                   d == 3 ? random.uniform(-1.3, 1.3) : 0.0};
        if (random.coin()) { // near a node: where edges meet
          const std::int64_t node = random.below(static_cast<int>(mesh.nodes()));
          const double off = std::pow(10.0, random.uniform(-4.0, -0.5));
          for (int k = 0; k < d; ++k)
            x[static_cast<std::size_t>(k)] =
                mesh.positions[static_cast<std::size_t>(node * d + k)] + random.uniform(-off, off);
        }
        for (int k = 0; k < d; ++k) slaves.push_back(x[static_cast<std::size_t>(k)]);
        distance.push_back(reference.signed_distance(x));
      }
      Detector::Found found;
      detector.detect(slaves, reach, found);
      for (std::size_t i = 0; i < distance.size(); ++i) {
        const bool none = found.segment[i] < 0,
                   flagged = (found.flags[i] & (ENTS_FLAG_BEHIND_EDGE | ENTS_FLAG_AMBIGUOUS)) != 0;
        const bool behind = (found.flags[i] & ENTS_FLAG_BEHIND_EDGE) != 0;
        const double gap = found.gap[i], exact = distance[i];
        ++all.slaves;
        // a slave beside an edge may be projected within the border, 1e-7 of half a segment, which is at most
        // 1 long
        const bool right = !none && std::fabs(gap - exact) <= 1e-7;
        all.clear += right || (none && !flagged);
        all.flagged += flagged;
        all.flagged_clear += flagged && right;
        if (flagged) {
          all.wrong_flag += behind && exact > 0.0;
          continue;
        }
        if (std::fabs(exact) < 1e-11) continue;
        if (none)
          all.unseen += exact < 0.0 && -exact < reach;
        else if (gap < 0.0 && exact > 0.0)
          ++all.phantom;
        else
          all.farther += !right;
      }
    }
    std::printf("%-8s reach %4.2f: %8lld slaves, %lld phantom contacts, %lld on a farther face, %lld unseen; "
                "%lld flagged, %lld of them wrongly, %lld of %lld with a clear answer\n",
                what, reach, static_cast<long long>(all.slaves), static_cast<long long>(all.phantom),
                static_cast<long long>(all.farther), static_cast<long long>(all.unseen),
                static_cast<long long>(all.flagged), static_cast<long long>(all.wrong_flag),
                static_cast<long long>(all.flagged_clear), static_cast<long long>(all.clear));
    EXPECT_EQ(all.phantom, 0);
    EXPECT_EQ(all.farther, 0);
    EXPECT_EQ(all.unseen, 0);
    EXPECT_EQ(all.wrong_flag, 0);
    EXPECT_LE(static_cast<double>(all.flagged_clear), 0.005 * static_cast<double>(all.clear));
  }
}

TEST(ClosedSurface, PolygonsOfAnyShape) { expect_right_answers("star", star, 1); }
TEST(ClosedSurface, PlatesWhoseTwoSidesAreMaster) { expect_right_answers("plate", plate, 2); }
TEST(ClosedSurface, PolyhedraOfTriangles) { expect_right_answers("ball", ball, 3); }
TEST(ClosedSurface, WedgesOfQuadrilaterals) { expect_right_answers("wedge", wedge, 4); }

} // namespace
} // namespace mechanics::closed_surface_test
