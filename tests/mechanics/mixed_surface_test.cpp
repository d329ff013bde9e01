// SPDX-License-Identifier: BSD-3-Clause
// A surface of triangles and quadrilaterals is one of quad4, of which the triangles have two nodes in one:
// areas, points inside facets, search, contact area and the contact patch test.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "mixed_surface.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace mechanics::mixed_surface_test {
namespace {

constexpr double stiffness = 100.0;

std::string model_text() {
  return R"({"segment": "quad4", "border": 0.01, "contact": {"normal": {"type": "penalty", "stiffness": 100}}})";
}

// Exact shares of the nodes: those of triangles and of quadrilaterals, each as what they are.
std::vector<double> shares(const MixedSurface& s) {
  const auto n = static_cast<std::size_t>(s.nodes());
  std::vector<double> sum(n), part(n);
  const auto add = [&](const char* facet, const std::vector<std::int64_t>& nodes, std::int64_t each) {
    EXPECT_EQ(ents_tributary_areas(facet, static_cast<std::int64_t>(nodes.size()) / each, nodes.data(),
                                   s.nodes(), s.positions.data(), 1.0, part.data(), nullptr),
              ENTS_OK);
    for (std::size_t i = 0; i < n; ++i) sum[i] += part[i];
  };
  add("tri3", s.triangles, 3);
  add("quad4", s.quadrangles, 4);
  return sum;
}

struct Slaves {
  std::vector<double> positions, areas, weights;
  std::vector<std::int64_t> begin, nodes;
};
// Nodes, or points in facets, moved into the master.
Slaves slaves_of(const MixedSurface& s, int per_direction, double depth) {
  Slaves out;
  const std::vector<double> x = MixedSurface::moved(s.positions, s.normal, -depth);
  ents_report report = new_report();
  if (per_direction == 0) {
    out.positions = x;
    out.areas.resize(x.size() / 3);
    EXPECT_EQ(ents_tributary_areas("quad4", s.facets(), s.all.data(), s.nodes(), x.data(), 1.0,
                                   out.areas.data(), &report),
              ENTS_OK)
        << report.message;
    return out;
  }
  const auto points = static_cast<std::size_t>(s.facets() * per_direction * per_direction);
  out.begin.resize(points + 1), out.nodes.resize(4 * points), out.weights.resize(4 * points);
  out.areas.resize(points), out.positions.resize(3 * points);
  EXPECT_EQ(ents_sampling_points("quad4", per_direction, s.facets(), s.all.data(), s.nodes(), x.data(), 1.0,
                                 out.begin.data(), out.nodes.data(), out.weights.data(), out.areas.data(),
                                 &report),
            ENTS_OK)
      << report.message;
  ents_combination c{};
  c.struct_size = sizeof c, c.points = static_cast<std::int64_t>(points);
  c.begin = out.begin.data(), c.nodes = out.nodes.data(), c.weights = out.weights.data();
  EXPECT_EQ(ents_combine(&c, 3, s.nodes(), x.data(), out.positions.data(), &report), ENTS_OK)
      << report.message;
  return out;
}

// Forces of one pass of ents_iterate on the slave nodes, then on those of the master, [2 nodes][3].
std::vector<double> forces(const MixedSurface& s, const Slaves& slaves) {
  const Model model(model_text());
  ents_report report = new_report();
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = s.facets(), mesh.connectivity = s.all.data();
  mesh.nodes = s.nodes(), mesh.positions = s.positions.data();
  std::int64_t size = 0;
  EXPECT_EQ(ents_tree_size(model.handle(), mesh.segments, &size, &report), ENTS_OK);
  std::vector<double> tree(static_cast<std::size_t>(size));
  EXPECT_EQ(ents_tree_build(model.handle(), &mesh, tree.data(), size, &report), ENTS_OK) << report.message;
  const std::size_t count = slaves.areas.size(), n = static_cast<std::size_t>(s.nodes());
  std::vector<std::int64_t> segment(count, -1), rows(6 * n);
  std::vector<double> xi(2 * count), residual(6 * n);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<std::int64_t>(i);
  ents_detection detection{};
  detection.struct_size = sizeof detection;
  detection.slave = slaves.positions.data(), detection.reach = 0.5;
  detection.segment = segment.data(), detection.xi = xi.data();
  ents_input in{};
  in.struct_size = sizeof in;
  in.area = slaves.areas.data(), in.area_stride = 1;
  ents_combination combination{};
  combination.struct_size = sizeof combination;
  ents_system system{};
  system.struct_size = sizeof system, system.index_size = 8;
  if (!slaves.begin.empty()) {
    combination.points = static_cast<std::int64_t>(count), combination.begin = slaves.begin.data();
    combination.nodes = slaves.nodes.data(), combination.weights = slaves.weights.data();
    system.slave = &combination;
  }
  system.slave_nodes = system.master_nodes = s.nodes();
  system.slave_equations = rows.data(), system.master_equations = rows.data() + 3 * n;
  system.rows = static_cast<std::int64_t>(6 * n);
  system.residual = residual.data();
  EXPECT_EQ(ents_iterate(model.handle(), &mesh, tree.data(), size, 0, static_cast<std::int64_t>(count),
                         &detection, &in, nullptr, &system, &report),
            ENTS_OK)
      << report.message;
  for (const std::int64_t found : segment) EXPECT_GE(found, 0);
  return residual;
}

// Two bodies with the same mesh on their common face, pressed by the same depth everywhere: each node of both
// has the force of a uniform pressure, with points inside facets to rounding, with slave nodes to how close
// coordinates come to a corner that two nodes of its segment share.
TEST(MixedSurface, PassesTheContactPatchTest) {
  constexpr double depth = 0.01;
  double worst[2] = {}; // points inside facets, nodes
  std::int64_t triangles = 0, quadrangles = 0;
  for (std::int64_t round = 0; round < samples(60); ++round) {
    Random random(static_cast<std::uint64_t>(round) + 11);
    const MixedSurface s = draw_mixed_surface(random, 4);
    triangles += static_cast<std::int64_t>(s.triangles.size()) / 3;
    quadrangles += static_cast<std::int64_t>(s.quadrangles.size()) / 4;
    const std::vector<double> exact = shares(s);
    const auto n = static_cast<std::size_t>(s.nodes());
    for (const int per_direction :
         {0, 2, 3, 5}) { // one point does not give a distorted quadrilateral's shares
      const Slaves slaves = slaves_of(s, per_direction, depth);
      const std::vector<double> found = forces(s, slaves);
      if (HasFailure()) FAIL() << "round " << round << ", points " << per_direction;
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
          const double force = stiffness * depth * exact[i] * s.normal[k];
          // R is the internal force: it holds the slave back where the contact pushes it out
          double& error = worst[per_direction == 0];
          test::raise(error, std::fabs(found[3 * i + k] + force) / (stiffness * depth));
          test::raise(error, std::fabs(found[3 * (n + i) + k] - force) / (stiffness * depth));
        }
    }
  }
  std::printf("%lld triangles, %lld quadrilaterals: worst force %.2g of pressure times area, of nodes %.2g\n",
              static_cast<long long>(triangles), static_cast<long long>(quadrangles), worst[0], worst[1]);
  // The depth is known to the rounding of positions up to 6, 1e-15, over 0.01.
  EXPECT_LT(worst[0], 1e-13);
  // 1e-9 of a side, of 1.4 at most, beside the corner, over a depth of 0.01
  EXPECT_LT(worst[1], 2e-7);
}

// A closed body of triangles, as tri3 and as quad4: what detection says of slaves everywhere is the same,
// behind edges and vertices, too.
TEST(MixedSurface, IsSearchedAsOneOfTriangles) {
  const std::string law = R"("contact": {"normal": {"type": "penalty", "stiffness": 100}}})";
  const Model triangles(R"({"segment": "tri3", )" + law), quadrangles(R"({"segment": "quad4", )" + law);
  std::int64_t seen = 0, behind = 0;
  for (std::int64_t round = 0; round < samples(40); ++round) {
    Random random(static_cast<std::uint64_t>(round) + 3);
    MixedSurface s; // an octahedron with moved corners
    for (int k = 0; k < 3; ++k)
      for (const double sign : {1.0, -1.0})
        for (int c = 0; c < 3; ++c) s.positions.push_back((c == k ? sign : 0.0) + random.uniform(-0.2, 0.2));
    for (int octant = 0; octant < 8; ++octant) {
      const int x = octant & 1, y = 2 + (octant >> 1 & 1), z = 4 + (octant >> 2 & 1);
      const bool even = (x + y + z + round) % 2 == 0; // outwards, and every second time a cavity
      s.add_triangle(random, x, even ? y : z, even ? z : y);
    }
    constexpr std::int64_t count = 200;
    std::vector<double> slave;
    for (std::int64_t i = 0; i < 3 * count; ++i) slave.push_back(random.uniform(-1.3, 1.3));
    struct Found {
      std::vector<std::int64_t> segment = std::vector<std::int64_t>(count, -1);
      std::vector<double> gap = std::vector<double>(count), xi = std::vector<double>(2 * count);
      std::vector<std::int32_t> flags = std::vector<std::int32_t>(count);
    } found[2];
    for (const bool as_quadrangles : {false, true}) {
      const Model& model = as_quadrangles ? quadrangles : triangles;
      Found& f = found[as_quadrangles];
      ents_master_mesh mesh{};
      mesh.struct_size = sizeof mesh;
      mesh.segments = s.facets(), mesh.nodes = s.nodes(), mesh.positions = s.positions.data();
      mesh.connectivity = as_quadrangles ? s.all.data() : s.triangles.data();
      std::int64_t size = 0;
      ASSERT_EQ(ents_tree_size(model.handle(), mesh.segments, &size, nullptr), ENTS_OK);
      std::vector<double> tree(static_cast<std::size_t>(size));
      ASSERT_EQ(ents_tree_build(model.handle(), &mesh, tree.data(), size, nullptr), ENTS_OK);
      ents_detection d{};
      d.struct_size = sizeof d;
      d.slave = slave.data(), d.reach = 2.0, d.segment = f.segment.data(), d.xi = f.xi.data();
      d.gap = f.gap.data(), d.flags = f.flags.data();
      ents_report report = new_report();
      ASSERT_EQ(ents_detect(model.handle(), &mesh, tree.data(), size, 0, count, &d, &report), ENTS_OK)
          << report.message;
    }
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(found[0].segment[i], found[1].segment[i]) << "round " << round << " slave " << i;
      ASSERT_EQ(found[0].flags[i] & ENTS_FLAG_BEHIND_EDGE, found[1].flags[i] & ENTS_FLAG_BEHIND_EDGE) << i;
      ASSERT_NEAR(found[0].gap[i], found[1].gap[i], 1e-12) << "round " << round << " slave " << i;
      seen += found[0].segment[i] >= 0;
      behind += (found[0].flags[i] & ENTS_FLAG_BEHIND_EDGE) != 0;
    }
  }
  std::printf("%lld slaves on a segment, %lld behind an edge\n", static_cast<long long>(seen),
              static_cast<long long>(behind));
  EXPECT_GT(seen, 0);
  EXPECT_GT(behind, 0);
}

// Contact area: that of the triangles and quadrilaterals.
TEST(MixedSurface, HasTheContactAreaOfItsTriangles) {
  Random random(5);
  for (int round = 0; round < 20; ++round) {
    const MixedSurface s = draw_mixed_surface(random, 6, true);
    const auto n = static_cast<std::size_t>(s.nodes());
    std::vector<double> gap(n), pressure(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double depth = random.uniform(-1.0, 1.0);
      gap[i] = std::max(-depth, 0.0), pressure[i] = std::max(depth, 0.0);
    }
    for (const double modulus : {0.0, 3.0}) {
      ents_area of[2]{};
      for (const bool as_quadrangles : {false, true}) {
        of[as_quadrangles].struct_size = sizeof(ents_area);
        ASSERT_EQ(ents_contact_area(as_quadrangles ? "quad4" : "tri3", s.facets(),
                                    as_quadrangles ? s.all.data() : s.triangles.data(), s.nodes(),
                                    s.positions.data(), 1.0, gap.data(), pressure.data(), modulus,
                                    &of[as_quadrangles], nullptr),
                  ENTS_OK);
      }
      for (const double ents_area::*number :
           {&ents_area::surface, &ents_area::counted, &ents_area::border_corrected, &ents_area::zero_line,
            &ents_area::estimate, &ents_area::error, &ents_area::peak_pressure, &ents_area::peak_drop})
        EXPECT_NEAR(of[0].*number, of[1].*number, 1e-13) << round;
    }
  }
}

// The check of a whole surface samples to the corners, where such a segment has no normal: it says which one.
TEST(MixedSurface, IsRefusedByTheCheckOfSurfaces) {
  const Model model(R"({"segment": "quad4", "height": null})");
  Random random(8);
  const MixedSurface s = draw_mixed_surface(random, 3);
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = s.facets(), mesh.connectivity = s.all.data();
  mesh.nodes = s.nodes(), mesh.positions = s.positions.data();
  ents_surface_admissibility result{};
  result.struct_size = sizeof result;
  ents_report report = new_report();
  EXPECT_EQ(ents_surface_check(model.handle(), &mesh, &result, &report), ENTS_DEGENERATE_SEGMENT);
  EXPECT_GE(report.element, 0) << report.message;
}

} // namespace
} // namespace mechanics::mixed_surface_test
