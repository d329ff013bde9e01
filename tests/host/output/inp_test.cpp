// SPDX-License-Identifier: BSD-3-Clause
#include "inp.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace inp_test {
namespace {

namespace inp = host::inp;

inp::Deck read(const std::string& text) { return inp::read_text(text, "deck.inp"); }

/// The message of the error that the text must cause; "" if there is none.
std::string error_of(const std::string& text) {
  try {
    read(text);
  } catch (const inp::Error& error) {
    return error.what();
  }
  return "";
}

void expect_error(const std::string& text, const std::string& place, const std::string& what) {
  const std::string message = error_of(text);
  EXPECT_TRUE(message.starts_with(place + ": ")) << message;
  EXPECT_NE(message.find(what), std::string::npos) << message;
}

const std::string square = "*NODE\n1, 0., 0.\n2, 1., 0.\n3, 1., 1.\n4, 0., 1.\n"
                           "*ELEMENT, TYPE=CPE4, ELSET=block\n1, 1, 2, 3, 4\n";

TEST(Inp, ReadsWhatGmshWritesInThePlane) {
  const inp::Deck deck = inp::read(std::string(DECKS) + "/plate.inp");
  EXPECT_EQ(deck.heading, "plate.inp");
  EXPECT_EQ(deck.node_ids.size(), 6u);
  EXPECT_EQ(inp::dimension(deck), 2);
  EXPECT_EQ(inp::body(deck).size(), 2u);
  EXPECT_EQ(inp::body(deck, "Block").size(), 2u); // names do not depend on case
  EXPECT_EQ(deck.element_sets.at("TOP").size(), 2u);
  EXPECT_EQ(deck.elements[0].shape, inp::Shape::line2);
  EXPECT_TRUE(deck.ignored.empty());
}

TEST(Inp, ReadsWhatGmshWritesInSpace) {
  const inp::Deck deck = inp::read(std::string(DECKS) + "/cube.inp");
  EXPECT_EQ(inp::dimension(deck), 3);
  EXPECT_EQ(inp::body(deck, "body").size(), 6u);
  EXPECT_EQ(inp::nodes_of(deck, "top").size(), 4u);
  for (const int node : inp::nodes_of(deck, "top"))
    EXPECT_EQ(deck.coordinates[static_cast<std::size_t>(node)][2], 1);
}

TEST(Inp, KeepsCoordinatesBitForBitAndReadsFortranExponents) {
  const inp::Deck deck = read("*node\n 7, 0.1, -1.5D-03, +2e1\n 9, .5, 3.\n*element, type=T3D2\n1, 7, 9\n");
  EXPECT_EQ(deck.coordinates[0], (std::array<double, 3>{0.1, -1.5e-3, 20}));
  EXPECT_EQ(deck.coordinates[1], (std::array<double, 3>{0.5, 3, 0}));
  EXPECT_EQ(deck.node_ids, (std::vector<std::int64_t>{7, 9}));
}

TEST(Inp, KnowsEveryElementType) {
  const std::string nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n";
  const std::vector<std::tuple<std::string, std::string, inp::Shape, inp::Kind>> cases{
      {"CPS3", "1,2,3", inp::Shape::tri3, inp::Kind::plane_stress},
      {"cps4", "1,2,3,4", inp::Shape::quad4, inp::Kind::plane_stress},
      {"CPE3", "1,2,3", inp::Shape::tri3, inp::Kind::plane_strain},
      {"CPE4", "1,2,3,4", inp::Shape::quad4, inp::Kind::plane_strain},
      {"CAX3", "1,2,3", inp::Shape::tri3, inp::Kind::axisymmetric},
      {"CAX4", "1,2,3,4", inp::Shape::quad4, inp::Kind::axisymmetric},
      {"C3D4", "1,2,3,5", inp::Shape::tet4, inp::Kind::solid},
      {"C3D8", "1,2,3,4,5,6,7,8", inp::Shape::hex8, inp::Kind::solid},
      {"S3", "1,2,3", inp::Shape::tri3, inp::Kind::shell},
      {"S4", "1,2,3,4", inp::Shape::quad4, inp::Kind::shell},
      {"T2D2", "1,2", inp::Shape::line2, inp::Kind::truss},
      {"T3D2", "1,2", inp::Shape::line2, inp::Kind::truss}};
  for (const auto& [name, list, shape, kind] : cases) {
    const inp::Deck deck = read(nodes + "*ELEMENT, TYPE=" + name + "\n1," + list + "\n");
    ASSERT_EQ(deck.elements.size(), 1u) << name;
    EXPECT_EQ(deck.elements[0].shape, shape) << name;
    EXPECT_EQ(deck.elements[0].kind, kind) << name;
    EXPECT_EQ(inp::body(deck).size(), kind == inp::Kind::truss ? 0u : 1u) << name;
  }
}

TEST(Inp, CommentsBlanksWindowsLineEndsAndContinuation) {
  std::string text = "** made by hand\n*HEADING\nA block\nsecond line\n\n*Node,\n NSET=All\n1,0,0\n2,1,0\n 3 "
                     ", 1 , 1 \n4,0,1\n"
                     "** the element goes on in a second line\n*ELEMENT,\nTYPE=CPS4\n11, 1, 2,\n3, "
                     "4\n*ELSET, ELSET=e\n11,\n";
  for (const bool windows : {false, true}) {
    if (windows)
      for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
        text.insert(at, 1, '\r');
    const inp::Deck deck = read(text);
    EXPECT_EQ(deck.heading, "A block\nsecond line");
    EXPECT_EQ(deck.node_sets.at("ALL"), (std::vector<int>{0, 1, 2, 3}));
    EXPECT_EQ(deck.elements.at(0).nodes, (std::array<int, 8>{0, 1, 2, 3}));
    EXPECT_EQ(deck.element_sets.at("E"), (std::vector<int>{0}));
  }
}

TEST(Inp, SetsByNumberNameAndGenerate) {
  const inp::Deck deck = read(square + "*NSET, NSET=odd, GENERATE\n1, 3, 2\n*NSET, NSET=some\n4, 4\nODD, 2\n"
                                       "*nset, nset=SOME, unsorted\n1\n*ELSET, ELSET=\"all of it\"\nblock\n");
  EXPECT_EQ(deck.node_sets.at("ODD"), (std::vector<int>{0, 2}));
  EXPECT_EQ(deck.node_sets.at("SOME"), (std::vector<int>{3, 0, 2, 1})); // no repetition, the deck's order
  EXPECT_EQ(deck.element_sets.at("ALLOFIT"), (std::vector<int>{0}));    // blanks do not count
}

TEST(Inp, SurfacesOfElementFacesAndOfNodes) {
  const inp::Deck deck = read("*SURFACE, NAME=Top\nblock, S3\n*SURFACE, NAME=right, TYPE=ELEMENT\n1, s2\n"
                              "*SURFACE, NAME=dots, TYPE=NODE\n3, 1.\nleft\n*NSET, NSET=left\n1, 4\n" +
                              square); // before the mesh
  EXPECT_EQ(deck.surfaces.at("TOP").facets.at(0).face, 2);
  EXPECT_EQ(deck.surfaces.at("RIGHT").facets.at(0).face, 1);
  EXPECT_EQ(deck.surfaces.at("DOTS").nodes, (std::vector<int>{2, 0, 3}));
}

TEST(Inp, ReportsWhatItIgnores) {
  const inp::Deck deck =
      read(square + "*Surface  Interaction, NAME=i\n1.\n*STEP\n*STATIC\n0.1, 1.\n*NODE FILE\nU\n*END STEP\n");
  std::vector<std::string> words;
  for (const auto& ignored : deck.ignored) words.push_back(ignored.keyword);
  EXPECT_EQ(words,
            (std::vector<std::string>{"SURFACE INTERACTION", "STEP", "STATIC", "NODE FILE", "END STEP"}));
  EXPECT_EQ(deck.ignored[0].line, 8);
  EXPECT_EQ(deck.ignored[0].file, "deck.inp");
}

TEST(Inp, IncludesFilesFromTheFolderOfTheDeck) {
  const auto folder = std::filesystem::temp_directory_path() / "ents_inp_include_test";
  std::filesystem::create_directories(folder / "parts");
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
  };
  write("main.inp",
        "*INCLUDE, INPUT=parts/nodes.inp\n3, 1., 1.\n4, 0., 1.\n*ELEMENT, TYPE=CPS4\n1, 1, 2, 3, 4\n");
  write("parts/nodes.inp", "*NODE\n*INCLUDE, INPUT=two.inp\n"); // relative to the file that includes
  write("parts/two.inp", "1, 0., 0.\n2, 1., 0.\n");
  EXPECT_EQ(inp::read(folder / "main.inp").node_ids.size(), 4u); // data go on behind the included lines
  write("parts/two.inp", "1, 0., 0.\n2, 1., oops\n");
  try {
    inp::read(folder / "main.inp");
    FAIL();
  } catch (const inp::Error& error) {
    EXPECT_NE(std::string(error.what()).find("two.inp:2: expected coordinate 2 of node 2"), std::string::npos)
        << error.what();
  }
  write("parts/two.inp", "*INCLUDE, INPUT=../main.inp\n");
  try {
    inp::read(folder / "main.inp");
    FAIL();
  } catch (const inp::Error& error) {
    EXPECT_NE(std::string(error.what()).find("includes itself"), std::string::npos) << error.what();
  }
  std::filesystem::remove_all(folder);
}

TEST(InpErrors, NodesAndElements) {
  expect_error("*NODE\n1, 0., 0.\n2, 1., zero\n", "deck.inp:3",
               "expected coordinate 2 of node 2 (a finite number), found 'zero'");
  expect_error("*NODE\n1, nan, 0.\n", "deck.inp:2", "finite number");
  expect_error("*NODE\n1, 1e999, 0.\n", "deck.inp:2", "finite number");
  expect_error("*NODE\n1, 0.\n", "deck.inp:2", "expected node number, x, y[, z]; found 2 entries");
  expect_error("*NODE\nx, 0., 0.\n", "deck.inp:2",
               "expected a node number (a whole number from 1), found 'x'");
  expect_error("*NODE\n-1, 0., 0.\n", "deck.inp:2", "whole number");
  expect_error("*NODE\n1, 0., 0.\n1, 1., 0.\n", "deck.inp:3", "node 1 is defined a second time");
  expect_error(square + "1, 1, 2, 3, 4\n", "deck.inp:8", "element 1 is defined a second time");
  expect_error(square + "2, 1, 2, 3, 44\n", "deck.inp:8", "node 44 is not defined");
  expect_error(square + "2, 1, 2, 3\n", "deck.inp:8",
               "expected an element number and 4 nodes (CPE4), found 4 entries");
  expect_error(square + "2, 1, 2, 3,\n", "deck.inp:8", "found 4 entries"); // the deck ends inside an element
  expect_error(square + "2, 1, 2, 3, 4, 1\n", "deck.inp:8", "found 6 entries");
  expect_error(square + "2, 1, 2, 3.5, 4\n", "deck.inp:8", "expected a node number");
  expect_error("*NODE\n1,0,0\n*ELEMENT, TYPE=C3D20\n", "deck.inp:3",
               "element type 'C3D20' is not read; expected CPS3, CPS4");
  expect_error("*NODE\n1,0,0\n*ELEMENT\n", "deck.inp:3", "*ELEMENT needs TYPE=");
  expect_error("*NODE, SYSTEM=C\n1,0,0\n", "deck.inp:1", "parameter 'SYSTEM'");
}

TEST(InpErrors, SetsAndSurfaces) {
  expect_error(square + "*NSET, NSET=a\n1, 9\n", "deck.inp:9", "node 9 is not defined");
  expect_error(square + "*NSET, NSET=a\nlater\n*NSET, NSET=later\n1\n", "deck.inp:9",
               "the name of a set defined before, found 'later'");
  expect_error(square + "*NSET, NSET=a, GENERATE\n1, 4, 2\n", "deck.inp:9", "whole number of steps");
  expect_error(square + "*ELSET\n1\n", "deck.inp:8", "*ELSET needs ELSET=");
  expect_error(square + "*SURFACE, NAME=s\nblock, S5\n", "deck.inp:9",
               "expected a face S1 .. S4 of element 1, found 'S5'");
  expect_error(square + "*SURFACE, NAME=s\nblock\n", "deck.inp:9",
               "expected an element or element set, then S1");
  expect_error(square + "*SURFACE, NAME=s\nnone, S1\n", "deck.inp:9",
               "no element set 'none'; the deck has BLOCK");
  expect_error(square + "*SURFACE, NAME=s, TYPE=CYLINDER\n", "deck.inp:8", "TYPE=CYLINDER is not read");
}

TEST(InpErrors, Files) {
  expect_error("1, 0., 0.\n", "deck.inp:1", "data before the first keyword");
  for (const std::string keyword : {"*PART, NAME=p", "*ASSEMBLY, NAME=a", "*INSTANCE, NAME=i, PART=p"})
    expect_error(square + keyword + "\n", "deck.inp:8",
                 keyword.substr(0, keyword.find(',')) +
                     " changes the mesh and is not read; write a flat deck of *NODE and *ELEMENT "
                     "(Abaqus/CAE: choose \"Do not use parts and assemblies in input files\")");
  EXPECT_TRUE(error_of(square + "*NGEN\n1, 2\n").ends_with("write a flat deck of *NODE and *ELEMENT"));
  expect_error(square + "*NSET,\n", "deck.inp:8", "ends inside the keyword line");
  expect_error("*INCLUDE, INPUT=none.inp\n", "deck.inp:1", "none.inp: cannot be read: it does not exist");
  EXPECT_EQ(error_of(""), "deck.inp: no mesh; expected *NODE and *ELEMENT with data lines");
  EXPECT_THROW(inp::read("/no/such/deck.inp"), inp::Error);
  EXPECT_THROW(inp::read("/"), inp::Error); // a folder
}

TEST(InpErrors, CutDecksGiveErrorsOrDecksButNoCrash) {
  const std::string text = square + "*NSET, NSET=a, GENERATE\n1, 4\n*SURFACE, NAME=top\nblock, S3\n";
  for (std::size_t length = 0; length <= text.size(); ++length)
    EXPECT_NO_FATAL_FAILURE(error_of(text.substr(0, length)));
  for (std::size_t i = 0; i < text.size(); ++i)
    for (const char c : {'*', ',', '\n', 'x', '\0', '\xff'}) {
      std::string changed = text;
      changed[i] = c;
      EXPECT_NO_FATAL_FAILURE(error_of(changed));
    }
}

} // namespace
} // namespace inp_test
