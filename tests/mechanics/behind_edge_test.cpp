// SPDX-License-Identifier: BSD-3-Clause
// No gap through which a slave node slips: over a kinked surface every slave inside the body is projected, or flagged.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mesh_surface.hpp"
#include "samples.hpp"

namespace mechanics {
namespace {

constexpr int cells = 6;

// A height field of plain segments: nodes on a regular grid of spacing 2, heights drawn at random.
MeshSurface kinked(Random& random, const Basis& basis, double roughness) {
  MeshSurface mesh = draw_mesh(random, basis, cells, 0.0);
  const auto d = static_cast<std::size_t>(basis.dimension);
  for (std::size_t i = d - 1; i < mesh.positions.size(); i += d) mesh.positions[i] = random.uniform(-roughness, roughness);
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
    std::printf("%-6s %8lld slaves inside: %lld in a wedge and flagged, %lld unseen; %lld outside: %lld flagged\n", name,
                static_cast<long long>(inside), static_cast<long long>(lost), static_cast<long long>(unseen),
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

} // namespace
} // namespace mechanics
