// Smoothed triangles against Loop's subdivision (1987), carried out here.
#include <gtest/gtest.h>

#include <set>

#include "smoothed_surface.hpp"
#include "worst.hpp"

namespace mechanics::smoothed_triangles_test {
namespace {

const Model& plain() {
  static const Model model(R"({"segment": "bezier15", "height": null})");
  return model;
}

double vertex_weight(std::size_t n) { // of each neighbour of a node
  const double c = 0.375 + 0.25 * std::cos(2.0 * 3.141592653589793 / static_cast<double>(n));
  return (0.625 - c * c) / static_cast<double>(n);
}

// Neighbours of each node; of an edge, the opposite nodes of its facets.
struct Topology {
  std::map<std::int64_t, std::set<std::int64_t>> neighbours;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::int64_t>> opposite;
  std::set<std::int64_t> border;

  explicit Topology(const HostMesh& mesh) {
    for (std::int64_t f = 0; f < mesh.facets(); ++f)
      for (int k = 0; k < 3; ++k) {
        const std::int64_t a = mesh.corner(f, k), b = mesh.corner(f, (k + 1) % 3);
        neighbours[a].insert(b), neighbours[b].insert(a);
        opposite[std::minmax(a, b)].push_back(mesh.corner(f, (k + 2) % 3));
      }
    for (const auto& [edge, nodes] : opposite)
      if (nodes.size() == 1) border.insert(edge.first), border.insert(edge.second);
  }
  bool inside(std::int64_t node) const { return border.count(node) == 0; }
};

// One step; facet f becomes 4 f .. 4 f + 3: at its corners, and the middle one. Nodes of the border stay.
HostMesh subdivided(const HostMesh& mesh) {
  const Topology topology(mesh);
  HostMesh out{"tri3", {}, {}};
  Nodes nodes(out);
  for (std::int64_t v = 0; v < mesh.nodes(); ++v) {
    Vec3 x = mesh.position(v);
    if (topology.inside(v)) {
      const auto& around = topology.neighbours.at(v);
      const double beta = vertex_weight(around.size());
      x = (1.0 - static_cast<double>(around.size()) * beta) * x;
      for (const std::int64_t e : around) x = x + beta * mesh.position(e);
    }
    nodes.at(-1, static_cast<int>(v), 0, x);
  }
  const auto middle = [&](std::int64_t a, std::int64_t b) {
    const auto& opposite = topology.opposite.at(std::minmax(a, b));
    Vec3 x = 0.5 * (mesh.position(a) + mesh.position(b));
    if (opposite.size() == 2)
      x = 0.75 * x + 0.125 * (mesh.position(opposite[0]) + mesh.position(opposite[1]));
    return nodes.at(static_cast<int>(std::min(a, b)), static_cast<int>(std::max(a, b)), 0, x);
  };
  for (std::int64_t f = 0; f < mesh.facets(); ++f) {
    const std::int64_t a = mesh.corner(f, 0), b = mesh.corner(f, 1), c = mesh.corner(f, 2);
    const std::int64_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    out.connectivity.insert(out.connectivity.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
  }
  return out;
}

// A regular patch is a part of the limit surface: the patches of the subdivided mesh are its quarters.
TEST(SmoothedTriangles, RegularOnesStayWhenTheyAreSubdivided) {
  Random random(21);
  HostMesh mesh = triangle_star(6, 4);
  mesh.shake(random, 0.1);
  const Topology topology(mesh);
  const HostMesh finer = subdivided(mesh);
  const SmoothedSurface coarse("bezier15", mesh), fine("bezier15", finer);
  int compared = 0;
  for (std::int64_t f = 0; f < mesh.facets(); ++f) {
    if (!topology.inside(mesh.corner(f, 0)) || !topology.inside(mesh.corner(f, 1)) ||
        !topology.inside(mesh.corner(f, 2)))
      continue;
    for (const auto& [x, y] :
         {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.3, 0.2}, {0.1, 0.75}, {0.5, 0.5}}) {
      const std::pair<double, double> in_coarse[] = {{0.5 * x, 0.5 * y},
                                                     {0.5 + 0.5 * x, 0.5 * y},
                                                     {0.5 * x, 0.5 + 0.5 * y},
                                                     {0.5 - 0.5 * y, 0.5 * (x + y)}};
      // corners of the children: (a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)
      for (int child = 0; child < 4; ++child) {
        const SurfacePoints there = fine.evaluate(plain(), 4 * f + child, {x, y});
        const SurfacePoints here =
            coarse.evaluate(plain(), f, {in_coarse[child].first, in_coarse[child].second});
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_NEAR(here.point[k], there.point[k], 1e-15 * 8.0)
              << f << " " << child; // sums of 12 and 15 terms below 1
          EXPECT_NEAR(here.normal[k], there.normal[k], 1e-15 * 100.0) << f << " " << child;
        }
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, 54 * 24); // the 54 facets of the inner three rings
}

// Corners lie on the limit surface, extraordinary ones too: the ring of a node, subdivided until nothing
// changes.
TEST(SmoothedTriangles, CornersLieOnTheLimitOfSubdivision) {
  Random random(22);
  double worst = 0.0;
  std::set<std::size_t> valences;
  for (HostMesh mesh : {halved(sphere(1)), halved(sphere(3)), triangle_star(3, 2), triangle_star(5, 3),
                        triangle_star(9, 2)}) {
    mesh.shake(random, 0.1);
    const Topology topology(mesh);
    const SmoothedSurface smoothed("bezier15", mesh);
    for (std::int64_t f = 0; f < mesh.facets(); ++f)
      for (int corner = 0; corner < 3; ++corner) {
        const std::int64_t v = mesh.corner(f, corner);
        if (!topology.inside(v)) continue;
        Vec3 x = mesh.position(v), mean{};
        const auto& around = topology.neighbours.at(v);
        const double n = static_cast<double>(around.size()), beta = vertex_weight(around.size());
        for (const std::int64_t e : around) mean = mean + (1.0 / n) * mesh.position(e);
        // the mean of the ring: 3/8 of the node and of itself, 1/8 of both neighbours
        for (int step = 0; step < 200; ++step) {
          const Vec3 next = (1.0 - n * beta) * x + (n * beta) * mean;
          mean = 0.375 * x + 0.625 * mean, x = next;
        }
        const SurfacePoints at =
            smoothed.evaluate(plain(), f, {corner == 1 ? 1.0 : 0.0, corner == 2 ? 1.0 : 0.0});
        test::raise(worst, norm(vec3(at.point.data(), 3) - x));
        valences.insert(around.size());
      }
  }
  EXPECT_LE(worst, 200.0 * 1.1e-16); // roundings of the steps
  for (const std::size_t n : {3, 4, 5, 6, 9}) EXPECT_TRUE(valences.count(n)) << n;
}

// Detection on them, enriched: never farther than the nearest of many points.
TEST(SmoothedTriangles, AreSearchedLikeAnySegment) {
  Random random(23);
  HostMesh mesh = triangle_star(5, 2);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
    mesh.positions[i + 2] = 0.3 * std::sin(2.0 * mesh.positions[i]) + random.uniform(-0.05, 0.05);
  SmoothedSurface smoothed("bezier15", mesh);
  smoothed.carry_texture();
  const Model model(
      R"({"segment": "bezier15", "height": {"type": "sine", "amplitude": 0.02, "wave_vector": [1.1, 0.7]}})");
  Detector detector(model, smoothed.surface);
  std::vector<double> cloud;
  std::vector<bool> on_edge;
  for (std::int64_t f = 0; f < mesh.facets(); ++f) {
    std::vector<double> xi;
    for (int j = 0; j <= 40; ++j)
      for (int i = 0; i + j <= 40; ++i) {
        xi.insert(xi.end(), {i / 40.0, j / 40.0});
        on_edge.push_back(i == 0 || j == 0 || i + j == 40);
      }
    const SurfacePoints at = smoothed.evaluate(model, f, xi);
    cloud.insert(cloud.end(), at.point.begin(), at.point.end());
  }
  int found = 0;
  for (int i = 0; i < 30; ++i) {
    const std::vector<double> slave = {random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6),
                                       random.uniform(-0.4, 0.4)};
    Detector::Found at;
    detector.detect(slave, 1.0, at);
    double least = 10.0;
    bool edge = false;
    for (std::size_t k = 0; k < cloud.size(); k += 3)
      if (const double far = norm(vec3(&cloud[k], 3) - vec3(slave.data(), 3)); far < least)
        least = far, edge = on_edge[k / 3];
    if (edge || at.segment[0] < 0) continue; // a kink has points without a normal through the slave
    ++found;
    EXPECT_LE(std::fabs(at.gap[0]), least + 1e-12);
    EXPECT_GE(std::fabs(at.gap[0]), least - 0.02); // points of the cloud lie that close
  }
  EXPECT_GT(found, 20);
}

TEST(SmoothedTriangles, RefuseWhatTheyMust) {
  ents_report report{};
  report.struct_size = sizeof report;
  std::int64_t points = 0, terms = 0;
  const auto size = [&](const std::vector<std::int64_t>& connectivity, std::int32_t ends) {
    return ents_smooth_size("tri3", "bezier15", ends, static_cast<std::int64_t>(connectivity.size()) / 3,
                            connectivity.data(), 9, &points, &terms, &report);
  };
  const auto says = [&](const char* text) {
    return std::string(report.message).find(text) != std::string::npos;
  };
  EXPECT_EQ(size({0, 1, 2}, ENTS_ENDS_REPEATED), ENTS_BAD_VALUE);
  EXPECT_TRUE(says("ENTS_ENDS_STRAIGHT only")) << report.message;
  EXPECT_EQ(size({0, 1, 2, 1, 2, 3}, 0), ENTS_BAD_VALUE);
  EXPECT_TRUE(says("facets 1 and 0") && says("oriented")) << report.message;
  EXPECT_EQ(size({0, 1, 2, 2, 1, 3, 1, 2, 4}, 0), ENTS_BAD_VALUE);
  EXPECT_TRUE(says("more than two") && says("nodes 1 and 2")) << report.message;
  EXPECT_EQ(size({0, 1, 2, 2, 3, 4}, 0), ENTS_BAD_VALUE);
  EXPECT_TRUE(says("touch in node 2")) << report.message;
  EXPECT_EQ(size({0, 1, 0}, 0), ENTS_BAD_VALUE);
  EXPECT_TRUE(says("facet 0 has node 0 twice")) << report.message;
  EXPECT_EQ(size({0, 1, 2}, 0), ENTS_OK);
}

} // namespace
} // namespace mechanics::smoothed_triangles_test
