// How neighbouring segments of smoothed surfaces meet: in their points everywhere, in their normals but for
// edges that end in an extraordinary node, in their curvatures between regular facets. A texture leans with
// the curvature: its normals n_e jump by h times the jump of that.
#include <gtest/gtest.h>

#include <iostream>

#include "smoothed_surface.hpp"
#include "worst.hpp"

namespace mechanics::smoothed_borders_test {
namespace {

enum Kind {
  regular,
  beside,
  extraordinary,
  kinds
}; // edges between regular facets; others with regular ends; the rest

struct Edge {
  std::int64_t facet[2];
  int corner[2]; // where the edge starts
  Kind kind;
};

// Edges of two facets each. Facets and nodes are regular as a mesh of squares is.
std::vector<Edge> edges_of(const HostMesh& mesh) {
  const int m = mesh.corners();
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::pair<std::int64_t, int>>> found;
  std::map<std::int64_t, int> incident;
  for (std::int64_t f = 0; f < mesh.facets(); ++f)
    for (int k = 0; k < m; ++k) {
      const std::int64_t a = mesh.corner(f, k), b = mesh.corner(f, (k + 1) % m);
      found[std::minmax(a, b)].push_back({f, k});
      ++incident[a];
    }
  std::map<std::int64_t, bool> border;
  for (const auto& [ends, facets] : found)
    if (facets.size() == 1) border[ends.first] = border[ends.second] = true;
  const auto is_regular = [&](std::int64_t node) {
    const bool at_border = border.count(node) != 0; // its facets are those of a regular mesh, laid around it
    return m == 3 ? (at_border ? incident[node] <= 3 : incident[node] == 6)
                  : (at_border ? incident[node] <= 2 : incident[node] == 4);
  };
  std::vector<Edge> edges;
  for (const auto& [ends, facets] : found) {
    if (facets.size() < 2) continue;
    Edge edge{{facets[0].first, facets[1].first}, {facets[0].second, facets[1].second}, regular};
    for (const std::int64_t f : edge.facet)
      for (int k = 0; k < m; ++k)
        if (!is_regular(mesh.corner(f, k))) edge.kind = beside;
    if (!is_regular(ends.first) || !is_regular(ends.second)) edge.kind = extraordinary;
    edges.push_back(edge);
  }
  return edges;
}

// Natural coordinates on the edge that starts in a corner.
std::vector<double> on_edge(const HostMesh& mesh, int corner, double u) {
  if (mesh.corners() == 3) {
    const double t = 0.5 * (1.0 + u);
    return corner == 0   ? std::vector{t, 0.0}
           : corner == 1 ? std::vector{1.0 - t, t}
                         : std::vector{0.0, 1.0 - t};
  }
  switch (corner) {
  case 0:
    return {u, -1.0};
  case 1:
    return {1.0, u};
  case 2:
    return {-u, 1.0};
  default:
    return {-1.0, -u};
  }
}

struct Jumps {
  double point[kinds] = {}, normal[kinds] = {};
  double at_nodes = 0.0; // of the normal, at the ends of edges
  int edges[kinds] = {};
};

Jumps jumps_of(const HostMesh& mesh, const std::string& basis, bool textured) {
  nlohmann::json text{{"segment", basis}, {"height", nullptr}};
  if (textured)
    text["height"] = {{"type", "sine"}, {"amplitude", 0.02}, {"wave_vector", {1.0, 0.7}}, {"phase", 0.3}};
  const Model model(text.dump());
  SmoothedSurface smoothed = basis == mesh.facet
                                 ? SmoothedSurface(basis == "quad4" ? "bspline16" : "bezier15", mesh)
                                 : SmoothedSurface(basis, mesh);
  if (basis == mesh.facet)
    smoothed.surface.basis = &basis_named(basis), smoothed.surface.connectivity = mesh.connectivity,
    smoothed.surface.positions = mesh.positions;
  if (textured) smoothed.carry_texture();
  Jumps jumps;
  for (const Edge& edge : edges_of(mesh)) {
    ++jumps.edges[edge.kind];
    for (int i = 0; i <= 20; ++i) {
      const double u = 0.1 * i - 1.0;
      const SurfacePoints a = smoothed.evaluate(model, edge.facet[0], on_edge(mesh, edge.corner[0], u)),
                          b = smoothed.evaluate(model, edge.facet[1], on_edge(mesh, edge.corner[1], -u));
      const auto see = [&](double& worst, const std::vector<double>& x, const std::vector<double>& y) {
        test::raise(worst, norm(vec3(x.data(), 3) - vec3(y.data(), 3)));
      };
      see(jumps.normal[edge.kind], a.normal, b.normal);
      if (i % 20 == 0) see(jumps.at_nodes, a.normal, b.normal);
      see(jumps.point[edge.kind], a.base_point, b.base_point);
    }
  }
  return jumps;
}

// A shallow bowl.
HostMesh bowl(HostMesh mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    const double x = mesh.positions[i], y = mesh.positions[i + 1];
    mesh.positions[i + 2] = 0.3 * x * x + 0.2 * y * y + 0.1 * x * y + 0.1 * x * x * y;
  }
  return mesh;
}

TEST(SmoothedBorders, MeetInPointsNormalsCurvatures) {
  Random random(11);
  // weights of up to 225 in control points (see smoothing_test.cpp) of coordinates up to 6, over edges of 0.2
  // at least
  constexpr double rounding = 225.0 * 8.0 * 1.1e-16 * 6.0;
  for (HostMesh mesh : {sphere(2), sphere(4), star(3, 3), star(5, 3), star(6, 3), squares(5),
                        squares(4, [](int i, int j) { return i < 2 || j < 2; }),
                        squares(5, [](int i, int j) { return i != 2 || j != 2; })}) {
    mesh.shake(random, 0.04);
    const Jumps plain = jumps_of(mesh, "bspline16", false), textured = jumps_of(mesh, "bspline16", true);
    for (const Kind kind : {regular, beside, extraordinary}) EXPECT_LE(plain.point[kind], rounding);
    for (const Kind kind : {regular, beside}) EXPECT_LE(plain.normal[kind], rounding / 0.2);
    EXPECT_LE(plain.at_nodes, rounding / 0.2);
    EXPECT_LE(textured.normal[regular], 1e-10);
    if (plain.edges[extraordinary] > 0) {
      EXPECT_GT(plain.normal[extraordinary], 1e-6);
      EXPECT_GT(textured.normal[beside], 1e-8); // C1 only
    }
  }
  for (const char* basis : {"catmull_rom16", "bspline16"}) {
    HostMesh mesh = squares(5);
    mesh.shake(random, 0.1);
    const Jumps plain = jumps_of(mesh, basis, false);
    EXPECT_LE(plain.point[regular], 1e-13);
    EXPECT_LE(plain.normal[regular], 1e-13);
  }
}

// `most`: what ents.h says of the kink.
// A bowl meshed finer and finer round a node of n facets: the kink at its edges against the angles between
// plain facets.
void show_kinks(const char* facet, const char* basis, int regular_valence, double most) {
  std::cout << "facets in the node, edge length | jump of n_e: plain " << facet << " | " << basis
            << ": extraordinary edges, beside, regular | with a texture of 0.02: the same three\n";
  for (const int n : {3, 4, 5, 6, 7, 8, 0}) { // 0: a sphere with eight nodes of three facets
    double before = 0.0, finest = 0.0, finest_plain = 0.0;
    for (const int k : {2, 4, 8, 16}) {
      const bool triangles = regular_valence == 6;
      const HostMesh mesh = n == 0 ? (triangles ? halved(sphere(k)) : sphere(k))
                                   : bowl(triangles ? triangle_star(n, k) : star(n, k));
      const Jumps local = jumps_of(mesh, facet, false), smooth = jumps_of(mesh, basis, false),
                  textured = jumps_of(mesh, basis, true);
      const double plain =
          std::max({local.normal[regular], local.normal[beside], local.normal[extraordinary]});
      std::printf("%d  1/%-2d | %.1e | %.1e %.1e %.1e | %.1e %.1e %.1e\n", n, k, plain,
                  smooth.normal[extraordinary], smooth.normal[beside], smooth.normal[regular],
                  textured.normal[extraordinary], textured.normal[beside], textured.normal[regular]);
      EXPECT_LE(textured.normal[regular], 1e-10); // C2
      before = finest, finest = smooth.normal[extraordinary], finest_plain = plain;
    }
    if (n == regular_valence) continue;
    EXPECT_LT(finest, 0.6 * before) << n; // it falls at least with the edge length
    EXPECT_LT(finest, most * finest_plain) << n;
  }
}

TEST(SmoothedBorders, TheKinkAtAnExtraordinaryNode) { show_kinks("quad4", "bspline16", 4, 0.05); }
TEST(SmoothedBorders, TheKinkAtAnExtraordinaryNodeOfTriangles) { show_kinks("tri3", "bezier15", 6, 0.07); }

TEST(SmoothedBorders, OfTrianglesMeetInPointsNormalsCurvatures) {
  Random random(12);
  // sums of 40 terms of coordinates up to 6, over edges of 0.2 at least
  constexpr double rounding = 40.0 * 1.1e-16 * 6.0;
  for (HostMesh mesh :
       {halved(sphere(2)), halved(sphere(4)), triangle_star(3, 3), triangle_star(5, 3), triangle_star(8, 2),
        halved(squares(4)), halved(squares(4, [](int i, int j) { return i < 2 || j < 2; })),
        triangle_star(6, 4)}) {
    mesh.shake(random, 0.04);
    const Jumps plain = jumps_of(mesh, "bezier15", false), textured = jumps_of(mesh, "bezier15", true);
    for (const Kind kind : {regular, beside, extraordinary}) EXPECT_LE(plain.point[kind], rounding);
    for (const Kind kind : {regular, beside}) EXPECT_LE(plain.normal[kind], rounding / 0.05);
    EXPECT_LE(plain.at_nodes, rounding / 0.05);
    EXPECT_LE(textured.normal[regular], 1e-10);
  }
}

} // namespace
} // namespace mechanics::smoothed_borders_test
