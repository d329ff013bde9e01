// SPDX-License-Identifier: BSD-3-Clause
// Bodies of decks in the host's mesh; the reader itself is tested in tests/adapters.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "mesh.hpp"
#include "toolbox/error.hpp"

namespace host::deck_mesh_test {
namespace {

Mesh read(const std::string& text, int dimension = 2, const std::string& element_set = "") {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "deck_mesh_test.inp";
  std::ofstream(file) << text;
  Mesh mesh;
  mesh.dimension = dimension;
  add_deck(mesh, "b", file, element_set, 0);
  return mesh;
}

std::string error_of(const std::string& text, int dimension = 2, const std::string& element_set = "") {
  try {
    read(text, dimension, element_set);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

Mesh data(const std::string& name, int dimension) {
  Mesh mesh;
  mesh.dimension = dimension;
  add_deck(mesh, "b", std::filesystem::path(DECKS) / name, "", 0);
  return mesh;
}

TEST(DeckMesh, OfGmshInThePlane) {
  const Mesh mesh = data("plate.inp", 2);
  EXPECT_EQ(mesh.node_count(), 6);
  ASSERT_EQ(mesh.groups.size(), 1u); // lines mark the boundary
  EXPECT_EQ(mesh.groups[0].type, ElementType::quad4);
  EXPECT_EQ(mesh.groups[0].size(), 2u);
  const std::vector<Face>& top = mesh.face_sets.at("b.TOP");
  ASSERT_EQ(top.size(), 2u);
  for (const Face& face : top) // the normal is the tangent turned by +90 degrees: up
    EXPECT_GT(mesh.node(face.nodes[1])[0], mesh.node(face.nodes[0])[0]);
  EXPECT_EQ(mesh.node_sets.at("b.TOP").size(), 3u);
  EXPECT_EQ(mesh.node_sets.at("b").size(), 6u);
  EXPECT_EQ(mesh.face_sets.count("b.BLOCK"), 0u); // the body is no part of its boundary
}

TEST(DeckMesh, OfGmshInSpace) {
  const Mesh mesh = data("cube.inp", 3);
  double area = 0;
  for (const Face& face : mesh.face_sets.at("b.BOTTOM"))
    for (int a = 0; a < face.count; ++a) { // shoelace: the normal looks down
      const auto p = mesh.node(face.nodes[static_cast<std::size_t>(a)]);
      const auto q = mesh.node(face.nodes[static_cast<std::size_t>((a + 1) % face.count)]);
      area += 0.5 * (p[0] * q[1] - q[0] * p[1]);
    }
  EXPECT_EQ(area, -1);
}

const std::string squares =
    "*NODE\n1,0,0\n2,1,0\n3,2,0\n4,0,1\n5,1,1\n6,2,1\n9,7,7\n*ELEMENT,TYPE=CPS4,ELSET=E\n"
    "1,1,2,5,4\n2,2,3,6,5\n*ELSET,ELSET=LEFT\n1\n*NSET,NSET=between\n2,5\n";

TEST(DeckMesh, NodesOfNoElementAreLeftOut) { EXPECT_EQ(read(squares).node_count(), 6); }

TEST(DeckMesh, APartOfTheBody) {
  const Mesh mesh = read(squares, 2, "left");
  EXPECT_EQ(mesh.node_count(), 4);
  EXPECT_EQ(mesh.groups[0].size(), 1u);
}

TEST(DeckMesh, ANodeSetInsideHasNoFaces) {
  const Mesh mesh = read(squares);
  EXPECT_EQ(mesh.node_sets.at("b.BETWEEN").size(), 2u);
  EXPECT_EQ(mesh.face_sets.count("b.BETWEEN"), 0u);
}

TEST(DeckMesh, AWedgeIsABrickWithTwoEdgesThatArePoints) {
  const Mesh mesh = read(
      "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,1,0,1\n6,0,1,1\n*ELEMENT,TYPE=C3D6\n1,1,2,3,4,5,6\n", 3);
  EXPECT_EQ(mesh.groups[0].type, ElementType::hex8);
  EXPECT_EQ(mesh.groups[0].nodes, (std::vector<int>{0, 1, 2, 2, 3, 4, 5, 5}));
}

TEST(DeckMesh, MistakesAreNamed) {
  EXPECT_NE(error_of(squares, 3).find("the body has dimension 2, the scene 3"), std::string::npos);
  EXPECT_NE(error_of(squares, 2, "nowhere").find("no set of elements 'nowhere'"), std::string::npos);
  const std::string turned = "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n*ELEMENT,TYPE=CPE4\n7,1,4,3,2\n";
  EXPECT_NE(error_of(turned).find(":7: element 7 turns the wrong way"), std::string::npos)
      << error_of(turned);
  const std::string second =
      "*NODE\n1,0,0\n2,1,0\n3,0,1\n4,.5,0\n5,.5,.5\n6,0,.5\n*ELEMENT,TYPE=CPE6\n1,1,2,3,4,5,6\n";
  EXPECT_NE(error_of(second).find("of second order"), std::string::npos) << error_of(second);
}

} // namespace
} // namespace host::deck_mesh_test
