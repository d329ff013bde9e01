// SPDX-License-Identifier: BSD-3-Clause
// Slaves that move far within an increment: none passes through the surface without a word. The reference is
// the parity of crossings with a fine polygon through points of the enriched surface, at many places on the way.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "mesh_surface.hpp"
#include "sample_count.hpp"

namespace mechanics::way_test {
namespace {

const double pi = std::acos(-1.0);

// A closed C2 curve with waves across it; the body is inside: clockwise.
struct Ring {
  MeshSurface mesh;
  Model model;

  explicit Ring(Random& random) : Ring(random, 12 + random.below(20)) {}
  Ring(Random& random, int n)
      : model(nlohmann::json{{"segment", "bspline4"},
                             {"height",
                              {{"type", "sine"},
                               {"amplitude", random.uniform(0.0, 0.06)},
                               {"wave_vector", {1 + random.below(3)}}}}}
                  .dump()) {
    mesh.basis = &basis_named("bspline4");
    for (int i = 0; i < n; ++i) {
      const double angle = -2.0 * pi * i / n, r = random.uniform(0.8, 1.2);
      mesh.positions.insert(mesh.positions.end(), {r * std::cos(angle), r * std::sin(angle)});
      for (int k = 0; k < 4; ++k) {
        mesh.connectivity.push_back((i + k) % n);
        mesh.surface_coordinates.push_back(i + k);
      }
    }
  }
  // Corners of the polygon, two numbers each.
  std::vector<double> polygon(const std::vector<double>& positions, int points_per_segment = 16) const {
    MeshSurface there = mesh;
    there.positions = positions;
    std::vector<double> xi, out;
    for (int k = 0; k < points_per_segment; ++k) xi.push_back(2.0 * k / points_per_segment - 1.0);
    for (std::int64_t s = 0; s < mesh.segments(); ++s) {
      const SurfacePoints of = evaluate_surface(model, there.master(s).data(), mesh.coordinates(s), xi);
      out.insert(out.end(), of.point.begin(), of.point.end());
    }
    return out;
  }
};

bool is_inside(const std::vector<double>& polygon, double x, double y) {
  bool inside = false;
  const std::size_t n = polygon.size() / 2;
  for (std::size_t i = 0; i < n; ++i) {
    const double *a = &polygon[2 * i], *b = &polygon[2 * ((i + 1) % n)];
    if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
  }
  return inside;
}

struct Counts {
  int ways = 0, through = 0, refused = 0, missed = 0, without_reason = 0;
};

// `at(t)`: a number at the part t of the increment.
double at(double begin, double end, double t) { return begin + t * (end - begin); }

// How far a slave moves relative to the mesh at most, as ents_detect has it.
double largest_motion(const std::vector<double>& begin, const std::vector<double>& end, const double (&x)[2],
                      const double (&y)[2]) {
  double mean[2] = {}, rest = 0.0;
  for (std::size_t i = 0; i < begin.size(); ++i)
    mean[i % 2] += 2.0 * (end[i] - begin[i]) / static_cast<double>(begin.size());
  for (std::size_t i = 0; i < begin.size(); i += 2)
    rest = std::max(rest, std::hypot(end[i] - begin[i] - mean[0], end[i + 1] - begin[i + 1] - mean[1]));
  return std::hypot(y[0] - x[0] - mean[0], y[1] - x[1] - mean[1]) + rest;
}

void try_way(const Ring& ring, Random& random, Counts& all) {
  const double reach = random.uniform(0.1, 0.3), turn = random.uniform(-0.3, 0.3);
  std::vector<double> begin = ring.mesh.positions, end = begin;
  const double shift[2] = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
  for (std::size_t i = 0; i < begin.size(); i += 2) {
    end[i] = std::cos(turn) * begin[i] - std::sin(turn) * begin[i + 1] + shift[0];
    end[i + 1] = std::sin(turn) * begin[i] + std::cos(turn) * begin[i + 1] + shift[1];
  }
  const double angle = random.uniform(0.0, 2.0 * pi), far = random.uniform(1.0, 2.5),
               length = random.uniform(0.5, 10.0) * reach, way = random.uniform(0.0, 2.0 * pi);
  const double x[2] = {far * std::cos(angle), far * std::sin(angle)},
               y[2] = {x[0] + shift[0] + length * std::cos(way), x[1] + shift[1] + length * std::sin(way)};
  // Rings lie within 1.3; a chord of the coarse polygon may leave outside what is in the body.
  if (far < 1.3 && is_inside(ring.polygon(begin, 400), x[0], x[1])) return;
  // The reference: the longest part of the way that is inside, and does it end?
  constexpr int places = 160;
  double longest = 0.0, now = 0.0;
  const double step = largest_motion(begin, end, x, y) / places;
  for (int k = 1; k <= places; ++k) {
    const double t = static_cast<double>(k) / places;
    std::vector<double> nodes(begin.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = at(begin[i], end[i], t);
    const bool inside = is_inside(ring.polygon(nodes), at(x[0], y[0], t), at(x[1], y[1], t));
    now = inside ? now + step : 0.0;
    longest = std::max(longest, now);
  }
  const bool ends_inside = now > 0.0;

  MeshSurface surface = ring.mesh;
  surface.positions = end;
  const ents_master_mesh mesh = surface.mesh();
  std::int64_t size = 0, segment = -1;
  ents_tree_size(ring.model.handle(), mesh.segments, &size, nullptr);
  std::vector<double> tree(static_cast<std::size_t>(size));
  ASSERT_EQ(ents_tree_build(ring.model.handle(), &mesh, tree.data(), size, nullptr), ENTS_OK);
  double xi = 0.0, gap = 0.0;
  ents_detection io{};
  io.struct_size = sizeof io;
  io.slave = y, io.reach = reach, io.segment = &segment, io.xi = &xi, io.gap = &gap;
  io.slave_begin = x, io.positions_begin = begin.data();
  ents_report report = new_report();
  const std::int32_t status = ents_detect(ring.model.handle(), &mesh, tree.data(), size, 0, 1, &io, &report);
  ASSERT_GE(status, 0) << report.message;
  const bool closed = segment >= 0 && gap <= 0.0;
  ++all.ways;
  // A place of those looked at, reach / 2 apart at most, lies in what is longer.
  const bool through = !closed && longest > 0.5 * reach + 2.0 * step && (!ends_inside || segment < 0);
  all.through += through;
  all.refused += status == ENTS_NO_PROJECTION;
  all.missed += through && status == ENTS_OK;
  if (status == ENTS_NO_PROJECTION) { // the increment ends where the slave is in the body, however briefly
    const double t = report.step_factor;
    std::vector<double> nodes(begin.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = at(begin[i], end[i], t);
    all.without_reason += !is_inside(ring.polygon(nodes, 400), at(x[0], y[0], t), at(x[1], y[1], t));
  }
}

TEST(Way, NothingPassesThroughARoughClosedSurface) {
  const char* wanted = std::getenv("ENTS_TEST_WAYS");
  const std::int64_t most = wanted ? std::atoll(wanted) : ::test::samples(1000);
  Random random(7);
  Counts all;
  while (all.ways < most) {
    const Ring ring(random);
    for (int k = 0; k < 20; ++k) try_way(ring, random, all);
  }
  std::printf("%d ways, %d through the body, %d refused, %d of these outside of it\n", all.ways, all.through,
              all.refused, all.without_reason);
  EXPECT_EQ(all.missed, 0);
  EXPECT_EQ(all.without_reason, 0);
  EXPECT_GT(all.through, all.ways / 20);
}

// A plane, and a slave above it.
struct Plane {
  Model model{R"({"segment": "line2"})"};
  MeshSurface surface;
  std::vector<double> tree;
  double reach = 1.0, gap = 0.0, xi = 0.0;
  std::int64_t segment = -1;
  std::vector<double> begin = {-5, 0, 5, 0};
  ents_report report = new_report();

  Plane() {
    surface.basis = &basis_named("line2");
    surface.connectivity = {0, 1};
  }
  // A slave moves from x to y, and the plane by `moved`.
  std::int32_t detect(const std::vector<double>& x, const std::vector<double>& y, double moved,
                      std::int64_t permitted = 0) {
    surface.positions = {-5, moved, 5, moved};
    const ents_master_mesh mesh = surface.mesh();
    std::int64_t size = 0;
    ents_tree_size(model.handle(), 1, &size, nullptr);
    tree.resize(static_cast<std::size_t>(size));
    EXPECT_EQ(ents_tree_build(model.handle(), &mesh, tree.data(), size, nullptr), ENTS_OK);
    ents_detection io{};
    io.struct_size = sizeof io;
    io.slave = y.data(), io.reach = reach, io.segment = &segment, io.xi = &xi, io.gap = &gap;
    io.permitted = permitted, io.slave_begin = x.data(), io.positions_begin = begin.data();
    segment = -1;
    return ents_detect(model.handle(), &mesh, tree.data(), size, 0, 1, &io, &report);
  }
};

TEST(Way, AStepThatEndsBelowThePlaneIsCut) {
  Plane plane;
  EXPECT_EQ(plane.detect({0, 0.01}, {0, -10}, 0.0), ENTS_NO_PROJECTION);
  EXPECT_GT(plane.report.step_factor, 0.01 / 10.01); // it is behind the plane there
  EXPECT_LE(plane.report.step_factor, 0.51 / 10.01); // and in reach
  EXPECT_NE(std::string(plane.report.message).find("passes through"), std::string::npos);
  EXPECT_EQ(plane.detect({0, 0.01}, {0, -10}, 0.0, ENTS_FLAG_CROSSED), ENTS_OK);
  EXPECT_EQ(plane.detect({0, 0.01}, {0, -0.5}, 0.0), ENTS_OK); // in contact
  EXPECT_EQ(plane.detect({0, 0.5}, {0, 20}, 0.0), ENTS_OK);
  EXPECT_EQ(plane.detect({0, 0.5}, {0, 0.5}, 4.0), ENTS_NO_PROJECTION); // the plane moves
  EXPECT_EQ(plane.detect({0, 0.5}, {0, 4.5}, 4.0), ENTS_OK);            // with it
}

TEST(Way, IsRefusedWhereItIsLongerThanWhatIsLookedAt) {
  Plane plane;
  EXPECT_EQ(plane.detect({0, 50}, {0, -50}, 0.0), ENTS_NO_PROJECTION);
  EXPECT_NEAR(plane.report.step_factor, 0.32, 1e-12);
  EXPECT_NE(std::string(plane.report.message).find("unseen"), std::string::npos);
  EXPECT_EQ(plane.detect({100, 50}, {100, -50}, 0.0), ENTS_OK); // beside the plane
}

TEST(Way, NumbersThatAreNotFiniteAreNamed) {
  Plane plane;
  EXPECT_EQ(plane.detect({0, std::nan("")}, {0, 1}, 0.0), ENTS_NON_FINITE);
  EXPECT_EQ(plane.report.element, 0);
  plane.begin[3] = INFINITY;
  EXPECT_EQ(plane.detect({0, 1}, {0, 1}, 0.0), ENTS_NON_FINITE);
  EXPECT_EQ(plane.report.element, 1);
}

} // namespace
} // namespace mechanics::way_test
