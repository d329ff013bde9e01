// SPDX-License-Identifier: BSD-3-Clause
#include "inp.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace inp_faces_test {
namespace {

namespace inp = host::inp;
using Vector = std::array<double, 3>;

inp::Deck read(const std::string& text) { return inp::read_text(text, "deck.inp"); }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector centre(const inp::Deck& deck, const int* nodes, int count) {
  Vector out{};
  for (int i = 0; i < count; ++i)
    for (std::size_t a = 0; a < 3; ++a)
      out[a] += deck.coordinates[static_cast<std::size_t>(nodes[i])][a] / count;
  return out;
}

/// Normal times area by the contract: tangent turned by +90 degrees, or rho_,1 x rho_,2.
Vector area_vector(const inp::Deck& deck, const inp::Face& face) {
  const auto x = [&](std::size_t i) { return deck.coordinates[static_cast<std::size_t>(face.nodes[i])]; };
  if (face.count == 2) {
    const Vector t = minus(x(1), x(0));
    return {-t[1], t[0], 0};
  }
  Vector out = face.count == 3 ? cross(minus(x(1), x(0)), minus(x(2), x(0)))
                               : cross(minus(x(2), x(0)), minus(x(3), x(1)));
  for (double& value : out) value *= 0.5;
  return out;
}

const std::string brick_nodes =
    "*NODE\n1,0,0,0\n2,2,0,0.1\n3,2,1,0\n4,0.2,1,0\n5,0,0,1\n6,2,0,1\n7,2,1.1,1\n8,0,1,1\n";

// Abaqus Elements Guide, node numbers of the faces S1, S2 ...
struct Reference {
  std::string type, nodes;
  std::vector<std::set<int>> faces;
};
const std::vector<Reference> references{
    {"CPE3", "1,2,3", {{1, 2}, {2, 3}, {3, 1}}},
    {"CPE4", "1,2,3,4", {{1, 2}, {2, 3}, {3, 4}, {4, 1}}},
    {"C3D4", "1,2,3,5", {{1, 2, 3}, {1, 5, 2}, {2, 5, 3}, {3, 5, 1}}},
    {"C3D8",
     "1,2,3,4,5,6,7,8",
     {{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}}},
};

TEST(InpFaces, FollowAbaqusNumberingAndPointOutOfTheBody) {
  for (const Reference& reference : references) {
    Vector sum{};
    for (std::size_t f = 0; f < reference.faces.size(); ++f) {
      const inp::Deck deck =
          read(brick_nodes + "*ELEMENT, TYPE=" + reference.type + "\n1," + reference.nodes +
               "\n*SURFACE, NAME=s\n1, S" + std::to_string(f + 1) + "\n");
      const auto faces = inp::faces_of(deck, "s");
      ASSERT_EQ(faces.size(), 1u);
      const inp::Face& face = faces[0];
      std::set<int> ids;
      for (int i = 0; i < face.count; ++i) ids.insert(face.nodes[static_cast<std::size_t>(i)] + 1);
      EXPECT_EQ(ids, reference.faces[f]) << reference.type << " S" << f + 1;
      const inp::Element& element = deck.elements[0];
      const Vector outward = minus(centre(deck, face.nodes.data(), face.count),
                                   centre(deck, element.nodes.data(), inp::node_count(element.shape)));
      EXPECT_GT(dot(area_vector(deck, face), outward), 0) << reference.type << " S" << f + 1;
      for (std::size_t a = 0; a < 3; ++a) sum[a] += area_vector(deck, face)[a];
    }
    // Divergence theorem: the area vectors of a closed surface cancel; at most 6 faces of size < 4, each
    // rounded to 2^-52 of it.
    for (const double component : sum) EXPECT_LT(std::abs(component), 24 * 0x1p-52) << reference.type;
  }
}

TEST(InpFaces, OfGmshBoundariesByElementSetNodeSetAndSurface) {
  const inp::Deck plate = inp::read(std::string(DECKS) + "/plate.inp");
  const auto top = inp::faces_of(plate, "top");
  ASSERT_EQ(top.size(), 2u);
  for (const inp::Face& face : top) {
    EXPECT_GT(area_vector(plate, face)[1], 0);
    EXPECT_EQ(plate.elements[static_cast<std::size_t>(face.element)].shape, inp::Shape::quad4);
  }
  const inp::Deck cube = inp::read(std::string(DECKS) + "/cube.inp");
  double area = 0;
  for (const inp::Face& face : inp::faces_of(cube, "Bottom")) area += area_vector(cube, face)[2];
  EXPECT_EQ(area, -1);
}

TEST(InpFaces, OfANodeSetAreOnTheBoundaryOnly) {
  // two squares side by side; the nodes of the common edge are a set, too
  const std::string text =
      "*NODE\n1,0,0\n2,1,0\n3,2,0\n4,0,1\n5,1,1\n6,2,1\n*ELEMENT,TYPE=CPS4\n1,1,2,5,4\n2,2,3,6,5\n"
      "*NSET,NSET=top\n4,5,6\n*NSET,NSET=all,GENERATE\n1,6\n*NSET,NSET=between\n2,5\n";
  const inp::Deck deck = read(text);
  EXPECT_EQ(inp::faces_of(deck, "top").size(), 2u);
  EXPECT_EQ(inp::faces_of(deck, "all").size(), 6u);
  EXPECT_THROW(inp::faces_of(deck, "between"), inp::Error);
}

std::string error_of(const inp::Deck& deck, const std::string& name) {
  try {
    inp::faces_of(deck, name);
  } catch (const inp::Error& error) {
    return error.what();
  }
  return "";
}

TEST(InpFaces, ErrorsSayWhatIsWrong) {
  const std::string square =
      "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n5,3,3\n*ELEMENT,TYPE=CPS4,ELSET=block\n1,1,2,3,4\n";
  const inp::Deck deck = read(square + "*ELEMENT,TYPE=T3D2,ELSET=off\n2,4,5\n*NSET,NSET=a\n1\n");
  EXPECT_EQ(error_of(deck, "nowhere"),
            "deck.inp: no set or surface 'nowhere'; the deck has *NSET A, *ELSET BLOCK, *ELSET OFF");
  EXPECT_EQ(error_of(deck, "off"), "deck.inp:10: element 2 is no face of the body");
  EXPECT_NE(error_of(deck, "block").find("deck.inp:8: element 1 is no boundary element of a 2D body"),
            std::string::npos);
  EXPECT_EQ(error_of(deck, "a"), "deck.inp: 'a' holds no face of the body");
  EXPECT_THROW(inp::body(deck, "nowhere"), inp::Error);
}

TEST(InpFaces, ABodyThatIsInsideOutIsAnError) {
  for (const Reference& reference : references) {
    // a mirror image of the nodes turns every element inside out
    std::string mirrored =
        "*NODE\n1,0,0,0\n2,-2,0,0.1\n3,-2,1,0\n4,-0.2,1,0\n5,0,0,1\n6,-2,0,1\n7,-2,1.1,1\n8,0,1,1\n";
    const inp::Deck deck =
        read(mirrored + "*ELEMENT, TYPE=" + reference.type + "\n5," + reference.nodes + "\n");
    try {
      inp::body(deck);
      FAIL() << reference.type;
    } catch (const inp::Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("deck.inp:11: element 5 has zero or negative size"))
          << error.what();
    }
  }
}

} // namespace
} // namespace inp_faces_test
