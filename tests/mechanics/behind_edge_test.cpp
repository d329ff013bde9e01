// SPDX-License-Identifier: BSD-3-Clause
// No gap through which a slave node slips: over a kinked surface every slave inside the body is projected, or
// flagged.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mesh_surface.hpp"
#include "samples.hpp"

namespace mechanics::behind_edge_test {
namespace {

constexpr int cells = 6;

// A height field of plain segments: nodes on a regular grid of spacing 2, heights drawn at random.
MeshSurface kinked(Random& random, const Basis& basis, double roughness) {
  MeshSurface mesh = draw_mesh(random, basis, cells, 0.0);
  const auto d = static_cast<std::size_t>(basis.dimension);
  for (std::size_t i = d - 1; i < mesh.positions.size(); i += d)
    mesh.positions[i] = random.uniform(-roughness, roughness);
  return mesh;
}

// Its height at (x, y), from the definition of the segments.
double height_at(const MeshSurface& mesh, double x, double y) {
  const Basis& basis = *mesh.basis;
  const auto d = static_cast<std::size_t>(basis.dimension);
  for (std::int64_t s = 0; s < mesh.segments(); ++s) {
    const std::vector<double> nodes = mesh.master(s);
    double xi[2] = {};
    if (basis.simplex) { // right-angled at its first node
      xi[0] = (x - nodes[0]) / (nodes[3] - nodes[0]), xi[1] = (y - nodes[1]) / (nodes[7] - nodes[1]);
      if (xi[0] < 0.0 || xi[1] < 0.0 || xi[0] + xi[1] > 1.0) continue;
    } else {
      double low[2] = {1e9, 1e9};
      for (std::size_t i = 0; i < nodes.size(); i += d)
        for (std::size_t k = 0; k + 1 < d; ++k) low[k] = std::min(low[k], nodes[i + k]);
      xi[0] = x - low[0] - 1.0, xi[1] = d == 3 ? y - low[1] - 1.0 : 0.0;
      if (std::max(std::fabs(xi[0]), std::fabs(xi[1])) > 1.0) continue;
    }
    const Shape shape = shape_functions(basis, xi);
    double z = 0.0;
    for (std::size_t i = 0; i * d < nodes.size(); ++i) z += shape.value[i] * nodes[i * d + d - 1];
    return z;
  }
  throw std::runtime_error("outside");
}

TEST(BehindEdge, NoSlaveSlipsThroughAKinkedSurfaceUnseen) {
  for (const char* name : {"line2", "tri3", "quad4"}) {
    const Basis& basis = basis_named(name);
    Random random(23);
    std::int64_t inside = 0, lost = 0, outside = 0, unseen = 0, wrong = 0;
    for (int surface = 0; surface < samples(200); ++surface) {
      const MeshSurface mesh = kinked(random, basis, random.uniform(0.1, 1.0));
      const Model model(nlohmann::json{{"segment", name}}.dump());
      Detector detector(model, mesh);
      std::vector<double> slaves, above;
      for (int i = 0; i < 500; ++i) {
        const double x = random.uniform(4.0, 2.0 * cells - 4.0), y = random.uniform(4.0, 2.0 * cells - 4.0);
        above.push_back(random.uniform(-0.4, 0.2));
        slaves.push_back(x);
        if (basis.dimension == 3) slaves.push_back(y);
        slaves.push_back(height_at(mesh, x, y) + above.back());
      }
      Detector::Found found;
      detector.detect(slaves, 2.0, found);
      for (std::size_t i = 0; i < above.size(); ++i) {
        const bool none = found.segment[i] < 0, flagged = (found.flags[i] & ENTS_FLAG_BEHIND_EDGE) != 0;
        EXPECT_TRUE(none || !flagged);
        if (above[i] < 0.0) {
          ++inside, lost += flagged, unseen += none && !flagged;
        } else {
          ++outside, wrong += flagged;
        }
      }
    }
    std::printf(
        "%-6s %8lld slaves inside: %lld in a wedge and flagged, %lld unseen; %lld outside: %lld flagged\n",
        name, static_cast<long long>(inside), static_cast<long long>(lost), static_cast<long long>(unseen),
        static_cast<long long>(outside), static_cast<long long>(wrong));
    EXPECT_GT(lost, inside / 1000);
    EXPECT_EQ(unseen, 0);
    EXPECT_EQ(wrong, 0);
  }
}

// Beside a free edge, above or below the surface's level, a slave is open.
TEST(BehindEdge, AFreeEdgeIsNone) {
  Random random(29);
  for (const char* name : {"line2", "quad4"}) {
    const Basis& basis = basis_named(name);
    const MeshSurface mesh = kinked(random, basis, 0.0);
    const Model model(nlohmann::json{{"segment", name}}.dump());
    Detector detector(model, mesh);
    std::vector<double> slaves;
    for (int i = 0; i < 1000; ++i) {
      slaves.push_back(random.uniform(-0.5, -1e-3));
      if (basis.dimension == 3) slaves.push_back(random.uniform(0.0, 2.0 * cells));
      slaves.push_back(random.uniform(-0.5, 0.5));
    }
    Detector::Found found;
    detector.detect(slaves, 2.0, found);
    for (std::size_t i = 0; i < found.flags.size(); ++i) {
      EXPECT_EQ(found.segment[i], -1);
      EXPECT_EQ(found.flags[i] & ENTS_FLAG_BEHIND_EDGE, 0);
    }
  }
}

// What is detected for one slave.
std::int32_t flags_of(const MeshSurface& surface, const std::vector<double>& slave, double reach) {
  const Model model(nlohmann::json{{"segment", surface.basis->name}}.dump());
  Detector::Found found;
  Detector(model, surface).detect(slave, reach, found);
  EXPECT_EQ(found.segment[0], -1);
  return found.flags[0];
}

MeshSurface surface_of(const char* basis, std::vector<std::int64_t> connectivity,
                       std::vector<double> positions) {
  MeshSurface out;
  out.basis = &basis_named(basis);
  out.connectivity = std::move(connectivity), out.positions = std::move(positions);
  return out;
}

// Free edges that are equally far from a slave are no common one: between two plates, on the axis of a hole.
TEST(BehindEdge, FreeEdgesThatAreEquallyFarAreNone) {
  EXPECT_EQ(flags_of(surface_of("line2", {0, 1, 2, 3}, {-2, 0, -1, 0, 1, 0, 2, 0}), {0.0, -0.3}, 5.0),
            ENTS_FLAG_SEARCHED);
  const MeshSurface plates =
      surface_of("quad4", {0, 1, 2, 3, 4, 5, 6, 7},
                 {-2, -1, 0, -1, -1, 0, -1, 1, 0, -2, 1, 0, 1, -1, 0, 2, -1, 0, 2, 1, 0, 1, 1, 0});
  EXPECT_EQ(flags_of(plates, {0.0, 0.1, -0.3}, 5.0), ENTS_FLAG_SEARCHED);
  EXPECT_EQ(flags_of(plates, {0.0, 1.0, -0.3}, 5.0), ENTS_FLAG_SEARCHED); // corners
  for (const int n : {4, 12, 90}) {                                       // facets round a hole
    std::vector<std::int64_t> connectivity;
    std::vector<double> positions;
    for (int i = 0; i < n; ++i) {
      const double angle = 2.0 * std::acos(-1.0) * i / n, c = std::cos(angle), s = std::sin(angle);
      positions.insert(positions.end(), {c, s, 0.0, 2.0 * c, 2.0 * s, 0.0});
      const std::int64_t next = (i + 1) % n;
      connectivity.insert(connectivity.end(), {2 * i, 2 * i + 1, 2 * next + 1, 2 * next});
    }
    EXPECT_EQ(flags_of(surface_of("quad4", connectivity, positions), {0.0, 0.0, -0.3}, 5.0),
              ENTS_FLAG_SEARCHED)
        << n;
  }
}

// The same in an element of several segments: open, not lost.
TEST(BehindEdge, APatchBetweenFreeEdgesIsOpen) {
  const Model model(
      R"({"segment": "line2", "patch": [[0, 1], [2, 3]], "contact": {"normal": {"type": "penalty", "stiffness": 10}}})");
  const double slave[] = {0.0, -0.3}, master[] = {-2, 0, -1, 0, 1, 0, 2, 0};
  std::vector<double> residual(10, 7.0);
  std::int32_t flags = 0;
  ents_input in{};
  in.struct_size = sizeof in;
  in.slave = slave, in.master = master;
  ents_output out{};
  out.struct_size = sizeof out;
  out.wanted = ENTS_RESIDUAL | ENTS_FLAGS, out.residual = residual.data(), out.flags = &flags;
  EXPECT_EQ(ents_evaluate(model.handle(), 0, 1, &in, &out, nullptr), ENTS_OK);
  EXPECT_EQ(flags & (ENTS_FLAG_CONTACT | ENTS_FLAG_OUTSIDE), ENTS_FLAG_OUTSIDE);
  EXPECT_EQ(residual, std::vector<double>(10, 0.0));
}

// The border closes the wedge of a valley. What lies beyond the edge is no part of the gap, and the reach is
// of the gap.
TEST(BehindEdge, TheReachIsOfTheGap) {
  const MeshSurface valley = surface_of("line2", {0, 1, 1, 2}, {-1, 1, 0, 0, 1, 1});
  const Model model(R"({"segment": "line2", "border": 0.3})");
  const std::vector<double> slave = {0.0, -0.1}; // 0.0707 behind both flanks, as much beyond their edges
  for (const double reach : {0.2, 0.12, 0.08, 0.07})
    for (const bool followed : {false, true}) {
      Detector::Found found;
      if (followed) found.segment = {0}, found.xi = {0.95};
      Detector(model, valley).detect(slave, reach, found);
      EXPECT_EQ(found.segment[0] >= 0, reach > 0.0708) << reach << followed;
      EXPECT_EQ((found.flags[0] & ENTS_FLAG_LEFT) != 0, followed && reach < 0.0708) << reach;
      if (found.segment[0] < 0) continue;
      EXPECT_NEAR(found.gap[0], -0.1 * std::sqrt(0.5), 1e-12) << reach << followed;
    }
}

// Behind two grooves that are equally far: lost behind either.
TEST(BehindEdge, GroovesThatAreEquallyFarAreSeen) {
  const MeshSurface grooves =
      surface_of("line2", {0, 1, 1, 2, 2, 3, 3, 4}, {-2, 1, -1, 0, 0, 0.1, 1, 0, 2, 1});
  for (const double x : {0.0, 0.1, -0.1})
    EXPECT_EQ(flags_of(grooves, {x, -20.0}, 30.0), ENTS_FLAG_SEARCHED | ENTS_FLAG_BEHIND_EDGE);
}

// A pit and a hill of n facets: however many meet in its lowest point, a slave behind it is seen, and one
// ahead of the top is open (as far as facets are counted).
TEST(BehindEdge, FacetsRoundAPitAreAllCounted) {
  for (const int n : {3, 6, 12, 16, 17, 20, 32, 63, 64, 65, 100}) {
    std::vector<double> pit{0, 0, 0}, hill{0, 0, 0};
    std::vector<std::int64_t> connectivity;
    for (int i = 0; i < n; ++i) {
      const double angle = 2.0 * std::acos(-1.0) * i / n, c = std::cos(angle), s = std::sin(angle);
      pit.insert(pit.end(), {c, s, 0.7});
      hill.insert(hill.end(), {c, s, -0.7});
      connectivity.insert(connectivity.end(), {0, 1 + i, 1 + (i + 1) % n});
    }
    for (const double x : {0.0, 0.001, 0.02}) {
      EXPECT_EQ(flags_of(surface_of("tri3", connectivity, pit), {x, 0.5 * x, -0.1}, 0.5),
                ENTS_FLAG_SEARCHED | ENTS_FLAG_BEHIND_EDGE)
          << n;
      const std::int32_t open = flags_of(surface_of("tri3", connectivity, hill), {x, 0.5 * x, 0.1}, 0.5);
      EXPECT_EQ(open, n <= 64 ? ENTS_FLAG_SEARCHED : ENTS_FLAG_SEARCHED | ENTS_FLAG_BEHIND_EDGE) << n;
    }
  }
}

// The bottom of a valley whose course is curved, and slaves straight below it.
TEST(BehindEdge, ValleysWithCurvedEdgesAreSeen) {
  constexpr int n = 4;
  Random random(29);
  for (const char* name : {"tri3", "tri6", "quad4", "quad8", "quad9"}) {
    const Basis& basis = basis_named(name);
    const Model model(nlohmann::json{{"segment", name}}.dump());
    int unseen = 0;
    const int count = static_cast<int>(samples(400));
    for (int trial = 0; trial < count; ++trial) {
      MeshSurface mesh = draw_mesh(random, basis, n, 0.0);
      const double slope = random.uniform(0.05, 1.0), bend = random.uniform(0.0, 0.3),
                   phase = random.uniform(-3.0, 3.0);
      for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
        mesh.positions[i + 2] = slope * std::fabs(mesh.positions[i] - 4.0);
        mesh.positions[i] += bend * std::sin(mesh.positions[i + 1] + phase);
      }
      const int row = random.below(n);
      const double along = random.uniform(basis.simplex ? 0.1 : -0.8, basis.simplex ? 0.9 : 0.8);
      const std::int64_t segment = basis.simplex ? 2 * (row * n + 2) : row * n + 1;
      const std::vector<double> xi = {basis.simplex ? 0.0 : 1.0, along};
      SurfacePoints at = evaluate_surface(model, mesh.master(segment).data(), nullptr, xi);
      ASSERT_NEAR(at.point[2], 0.0, 1e-14) << "not on the bottom";
      at.point[2] -= random.uniform(0.001, 0.1);
      Detector::Found found;
      Detector(model, mesh).detect(at.point, 0.5, found);
      unseen += found.segment[0] < 0 && (found.flags[0] & ENTS_FLAG_BEHIND_EDGE) == 0;
      EXPECT_LT(found.segment[0], 0) << name;
    }
    EXPECT_EQ(unseen, 0) << name;
  }
}

// Far from the origin, where positions are known to 1e-10 only: a slave on the outer border of a textured
// surface is on the surface.
TEST(BehindEdge, SlavesOnTheOuterBorderAreFoundFarFromTheOrigin) {
  Random random(41);
  const Basis& basis = basis_named("tri3");
  const Model model(
      R"({"segment": "tri3", "height": {"type": "sine", "amplitude": 0.00025, "wave_vector": [0.4, 0.3]}})");
  for (const double offset : {0.0, 1e3, 1e6}) {
    std::int64_t lost = 0;
    const int count = static_cast<int>(samples(2000));
    for (int trial = 0; trial < count / 20; ++trial) {
      MeshSurface mesh = kinked(random, basis, 0.0);
      for (double& x : mesh.positions) x = 0.005 * x + offset;
      std::vector<double> slaves;
      for (int i = 0; i < 20; ++i) {
        const double along =
            0.05 +
            0.9 * random.uniform(0.0, 1.0); // the side xi_2 = 0 of the first segment, which is on the border
        const SurfacePoints at =
            evaluate_surface(model, mesh.master(0).data(), mesh.coordinates(0), {along, 0.0});
        const double gap = random.uniform(-0.00025, 0.00025);
        for (std::size_t k = 0; k < 3; ++k) slaves.push_back(at.point[k] + gap * at.normal[k]);
      }
      Detector::Found found;
      Detector(model, mesh).detect(slaves, 0.5, found);
      for (const std::int64_t segment : found.segment) lost += segment < 0;
    }
    std::printf("offset %5g: %lld of %d lost\n", offset, static_cast<long long>(lost), count / 20 * 20);
    EXPECT_EQ(lost, 0);
  }
}

// All of the boundary of a square or a cube is the master. Slaves of a body above it that lie below its top, near or
// beyond the corner, are on the top, although a side may be closer; without their normals some are not.
TEST(LooksAway, ASideNeverTakesTheSlavesOfTheTop) {
  for (const char* name : {"line2", "quad4"}) {
    const Basis& basis = basis_named(name);
    MeshSurface cube;
    cube.basis = &basis;
    if (basis.dimension == 2) { // outwards is to the left
      cube.positions = {-1, 1, 1, 1, 1, -1, -1, -1};
      cube.connectivity = {0, 1, 1, 2, 2, 3, 3, 0};
    } else {
      for (int k = 0; k < 8; ++k)
        for (const int axis : {1, 2, 4}) cube.positions.push_back((k & axis) != 0 ? 1 : -1);
      cube.connectivity = {4, 5, 7, 6, 0, 2, 3, 1, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    }
    const auto d = static_cast<std::size_t>(basis.dimension);
    Random random(5);
    std::int64_t taken = 0, on_top = 0, count = 0;
    for (int turn = 0; turn < samples(50); ++turn) {
      const double angle = random.uniform(-3.0, 3.0), c = std::cos(angle), s = std::sin(angle);
      const auto turned = [&](std::vector<double> x) { // first and last direction
        for (std::size_t i = 0; i < x.size(); i += d) {
          const double a = x[i], b = x[i + d - 1];
          x[i] = c * a - s * b, x[i + d - 1] = s * a + c * b;
        }
        return x;
      };
      MeshSurface mesh = cube;
      mesh.positions = turned(cube.positions);
      std::vector<double> slaves, normals, depth;
      for (int i = 0; i < 100; ++i) {
        for (std::size_t k = 0; k + 1 < d; ++k)
          slaves.push_back((random.uniform(0.0, 1.0) < 0.5 ? -1 : 1) * random.uniform(0.8, 1.09)),
              normals.push_back(random.uniform(-0.06, 0.06));
        depth.push_back(random.uniform(0.0, 0.3));
        slaves.push_back(1.0 - depth.back()), normals.push_back(-2.0);
      }
      slaves = turned(slaves), normals = turned(normals);
      const Model model(nlohmann::json{{"segment", name}, {"border", 0.1}}.dump());
      Detector detector(model, mesh);
      Detector::Found with, without;
      detector.detect(slaves, 1.0, with, normals);
      detector.detect(slaves, 1.0, without);
      for (std::size_t i = 0; i < depth.size(); ++i) {
        ++count;
        on_top += with.segment[i] == 0 && std::fabs(with.gap[i] + depth[i]) < 1e-12;
        taken += without.segment[i] > 0;
      }
    }
    EXPECT_EQ(on_top, count) << name;
    EXPECT_GT(taken, count / 10) << name;
  }
}

} // namespace
} // namespace mechanics::behind_edge_test
