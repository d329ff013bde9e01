// SPDX-License-Identifier: BSD-3-Clause
// Structured blocks, their faces, and tributary areas.
#include "areas.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace host::mesh_test {
namespace {

TEST(Grid, GradedPieceIsAGeometricProgression) {
  GridLines lines{1};
  append_graded(lines, 3, 5, 1.3);
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines.back(), 3);
  for (std::size_t i = 2; i < lines.size(); ++i)
    EXPECT_NEAR((lines[i] - lines[i - 1]) / (lines[i - 1] - lines[i - 2]), 1.3, 1e-13);
}

class Blocks : public testing::TestWithParam<ElementType> {
protected:
  Mesh block() const {
    Mesh mesh;
    mesh.dimension = dimension(GetParam());
    std::vector<GridLines> lines{{0, 1, 3}, {-1, 0, 1, 1.5}};
    if (mesh.dimension == 3) lines.push_back({0, 0.5, 2});
    add_block(mesh, "b", GetParam(), lines, 0);
    return mesh;
  }
};

TEST_P(Blocks, FacesPointOutwards) {
  const Mesh mesh = block();
  const std::vector<std::pair<std::string, Eigen::Vector3d>> sides{
      {"b.x_min", -Eigen::Vector3d::UnitX()}, {"b.x_max", Eigen::Vector3d::UnitX()},
      {"b.y_min", -Eigen::Vector3d::UnitY()}, {"b.y_max", Eigen::Vector3d::UnitY()},
      {"b.z_min", -Eigen::Vector3d::UnitZ()}, {"b.z_max", Eigen::Vector3d::UnitZ()}};
  for (std::size_t s = 0; s < 2 * static_cast<std::size_t>(mesh.dimension); ++s) {
    const auto& faces = mesh.face_sets.at(sides[s].first);
    ASSERT_FALSE(faces.empty());
    for (const Face& face : faces) {
      std::array<Eigen::Vector3d, 4> x;
      for (std::size_t a = 0; a < static_cast<std::size_t>(face.count); ++a) {
        const auto node = mesh.node(face.nodes[a]);
        x[a] = {node[0], node[1], mesh.dimension == 3 ? node[2] : 0};
      }
      Eigen::Vector3d normal;
      if (face.count == 2)
        normal = {-(x[1] - x[0]).y(), (x[1] - x[0]).x(), 0};
      else
        normal = (x[1] - x[0]).cross(x[static_cast<std::size_t>(face.count) - 1] - x[0]);
      EXPECT_NEAR((normal.normalized() - sides[s].second).norm(), 0, 1e-14) << sides[s].first;
    }
  }
}

TEST_P(Blocks, ElementsFillTheBlock) {
  const Mesh mesh = block();
  double volume = 0;
  for (std::size_t e = 0; e < mesh.groups[0].size(); ++e) {
    const auto nodes = mesh.groups[0].element(e);
    const auto at = [&](std::size_t a) {
      const auto node = mesh.node(nodes[a]);
      return Eigen::Vector3d(node[0], node[1], mesh.dimension == 3 ? node[2] : 0);
    };
    const Eigen::Vector3d a = at(1) - at(0);
    switch (GetParam()) {
    case ElementType::tri3:
      volume += 0.5 * a.cross(at(2) - at(0)).z();
      break;
    case ElementType::quad4:
      volume += a.cross(at(3) - at(0)).z();
      break;
    case ElementType::tet4: {
      const double part = a.cross(at(2) - at(0)).dot(at(3) - at(0)) / 6;
      EXPECT_GT(part, 0);
      volume += part;
      break;
    }
    case ElementType::hex8:
      volume += a.cross(at(3) - at(0)).dot(at(4) - at(0));
      break;
    }
  }
  EXPECT_NEAR(volume, 3 * 2.5 * (mesh.dimension == 3 ? 2 : 1), 1e-13);
}

TEST_P(Blocks, TributaryAreasAddUp) {
  const Mesh mesh = block();
  const auto& faces = mesh.face_sets.at("b.x_max");
  const std::vector<int> nodes = nodes_of(faces);
  const std::vector<double> areas = tributary_areas(mesh, faces, nodes, 0.5, false);
  const double exact = mesh.dimension == 3 ? 2.5 * 2 : 2.5 * 0.5;
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), exact, 1e-14);
  for (const double area : areas) EXPECT_GT(area, 0);
}

INSTANTIATE_TEST_SUITE_P(All, Blocks,
                         testing::Values(ElementType::tri3, ElementType::quad4, ElementType::tet4,
                                         ElementType::hex8));

TEST(TributaryAreas, OfADiscWeighWithTheRadius) {
  Mesh mesh;
  mesh.dimension = 2;
  add_block(mesh, "b", ElementType::quad4, {{0, 1, 3}, {0, 1}}, 0);
  const auto& faces = mesh.face_sets.at("b.y_max");
  const std::vector<int> nodes = nodes_of(faces);
  const std::vector<double> areas = tributary_areas(mesh, faces, nodes, 1, true);
  // Integrals of the hat functions times 2 pi r: of (1-r) r over (0,1); r r and (3-r)/2 r over (0,1), (1,3);
  // (r-1)/2 r.
  const double pi = std::numbers::pi;
  ASSERT_EQ(areas.size(), 3u);
  EXPECT_NEAR(areas[0], pi / 3, 1e-14);
  EXPECT_NEAR(areas[1], 2 * pi * (1. / 3 + 5. / 3), 1e-14);
  EXPECT_NEAR(areas[2], 2 * pi * (7. / 3), 1e-14);
}

} // namespace
} // namespace host::mesh_test
