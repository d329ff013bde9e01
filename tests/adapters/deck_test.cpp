// SPDX-License-Identifier: BSD-3-Clause
// ents-deck's reading and writing: faces, placements, limits, what is refused, and lines that stay as they
// are.
#include <cmath>
#include <random>

#include "deck_text.hpp"
#include "write.hpp"

namespace ents_deck::deck_test {
namespace {

// ---- faces ----

/// Corners of the reference element, then the middles of its edges in the order of Abaqus.
const std::vector<std::pair<const char*, std::vector<Point>>> reference{
    {"C3D4", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    {"C3D10",
     {{0, 0, 0},
      {1, 0, 0},
      {0, 1, 0},
      {0, 0, 1},
      {.5, 0, 0},
      {.5, .5, 0},
      {0, .5, 0},
      {0, 0, .5},
      {.5, 0, .5},
      {0, .5, .5}}},
    {"C3D6", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
    {"C3D15R",
     {{0, 0, 0},
      {1, 0, 0},
      {0, 1, 0},
      {0, 0, 1},
      {1, 0, 1},
      {0, 1, 1},
      {.5, 0, 0},
      {.5, .5, 0},
      {0, .5, 0},
      {.5, 0, 1},
      {.5, .5, 1},
      {0, .5, 1},
      {0, 0, .5},
      {1, 0, .5},
      {0, 1, .5}}},
    {"C3D8I", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}},
    {"C3D20R", {{0, 0, 0},  {1, 0, 0},  {1, 1, 0},  {0, 1, 0},  {0, 0, 1},  {1, 0, 1},  {1, 1, 1},
                {0, 1, 1},  {.5, 0, 0}, {1, .5, 0}, {.5, 1, 0}, {0, .5, 0}, {.5, 0, 1}, {1, .5, 1},
                {.5, 1, 1}, {0, .5, 1}, {0, 0, .5}, {1, 0, .5}, {1, 1, .5}, {0, 1, .5}}},
    {"CPE3", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
    {"CPS6", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {.5, 0, 0}, {.5, .5, 0}, {0, .5, 0}}},
    {"CAX4R", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
    {"CPE8", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {.5, 0, 0}, {1, .5, 0}, {.5, 1, 0}, {0, .5, 0}}},
};

// Of every type: normals point out, all faces together close the element, and middles lie in the middle of
// their sides in the order of the library.
TEST(DeckFaces, PointOutAndCloseTheElement) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> random(-0.3, 0.3);
  for (const auto& [type, corners] : reference) {
    SCOPED_TRACE(type);
    const bool plane = type[1] != '3';
    double a[3][3]; // a random affine map with a positive determinant
    for (auto& row : a)
      for (double& entry : row) entry = random(engine);
    for (int i = 0; i < 3; ++i) a[i][i] += 1.5;
    std::ostringstream text;
    text.precision(17);
    text << "*NODE\n";
    for (std::size_t n = 0; n < corners.size(); ++n) {
      text << n + 1;
      for (int i = 0; i < 3; ++i)
        text << ", "
             << (plane && i == 2
                     ? 0
                     : a[i][0] * corners[n][0] + a[i][1] * corners[n][1] + a[i][2] * corners[n][2]);
      text << "\n";
    }
    text << "*ELEMENT, TYPE=" << type << ", ELSET=E\n1";
    for (std::size_t n = 0; n < corners.size(); ++n) text << ", " << n + 1;
    text << "\n*SURFACE, NAME=S\nE\n";
    const Mesh mesh = mesh_of(text.str());
    const Side side = side_of(mesh, "s", {0, 1}); // checks that normals point out
    EXPECT_EQ(static_cast<int>(side.faces.size()), face_count(mesh.shape(0)));
    Point sum{};
    for (const Face& face : side.faces) {
      const Point n = face_normal(mesh, face);
      const auto c = static_cast<std::size_t>(corner_count(face.shape));
      // A triangle's normal is its area twice, a quadrilateral's, too.
      for (std::size_t j = 0; j < 3; ++j) sum[j] += n[j];
      ASSERT_EQ(face.nodes.size(), static_cast<std::size_t>(node_count(face.shape)));
      for (std::size_t i = c; i < face.nodes.size(); ++i) {
        const auto x = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(face.nodes[k])].x; };
        for (std::size_t j = 0; j < 3; ++j)
          EXPECT_NEAR(x(i)[j], (x(i - c)[j] + x((i - c + 1) % c)[j]) / 2, 1e-14);
      }
    }
    EXPECT_NEAR(length(sum), 0, 1e-14);
  }
}

TEST(DeckFaces, ATurnedElementIsRefused) {
  string text = two_blocks();
  const string line = "101, 101, 102, 105, 104, 110, 111, 114, 113";
  ASSERT_NE(text.find(line), string::npos);
  text.replace(text.find(line), line.size(), "101, 110, 111, 114, 113, 101, 102, 105, 104");
  const string error = error_of([&] { side_of(mesh_of(text), "SLAVE", {0, 1}); });
  EXPECT_NE(error.find("element 101 turns the wrong way"), string::npos) << error;
}

TEST(DeckFaces, ASetOfNodesOrOfBoundaryElementsIsASideToo) {
  const string text =
      two_blocks() +
      "*NSET, NSET=BELOW, GENERATE\n101, 109\n*ELEMENT, TYPE=CPS4, ELSET=MARKED\n901, 101, 102, 105, 104\n";
  const Mesh mesh = mesh_of(text);
  EXPECT_EQ(side_of(mesh, "below", {0, 1}).faces.size(), 4u);
  const Side marked = side_of(mesh, "MARKED", {0, 1});
  ASSERT_EQ(marked.faces.size(), 1u);
  EXPECT_LT(face_normal(mesh, marked.faces[0])[2], 0) << "out of the body, however the marker turns";
}

// Whole elements of a surface stand for their free faces, and nodes for the free faces between them: what
// lies between two elements is none of them.
TEST(DeckFaces, BetweenTwoElementsAreNone) {
  const Mesh mesh = mesh_of(block(1, {0, 0, 0}, {2, 2, 2}, 2, 2, 2, "E") + "*SURFACE, NAME=ALL\nE\n");
  EXPECT_EQ(side_of(mesh, "ALL", {0, 1}).faces.size(), 24u);
  EXPECT_EQ(side_of(mesh, "NE", {0, 1}).faces.size(), 24u);
}

// ---- instances ----

TEST(DeckInstances, AreTranslatedThenTurned) {
  const string part = "*PART, NAME=P\n*NODE\n1, 1., 0., 0.\n2, 0., 1., 0.\n3, 0., 0., 1.\n4, 0., 0., "
                      "0.\n*ELEMENT, TYPE=C3D4, ELSET=E\n1, 4, 1, 2, 3\n*END PART\n";
  const Mesh mesh = mesh_of(part + "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=one, PART=P\n10., 0., 0.\n0., 0., 0., "
                                   "0., 0., 2., 90.\n*END INSTANCE\n"
                                   "*INSTANCE, NAME=two, PART=P\n*END INSTANCE\n*NODE\n1, 7., 7., 7.\n*NSET, "
                                   "NSET=S, INSTANCE=two\n1, 2\n*NSET, NSET=S\n1, one.3\n*END ASSEMBLY\n");
  ASSERT_EQ(mesh.nodes.size(), 9u);
  EXPECT_NEAR(mesh.nodes[0].x[0], 0, 1e-15); // (11, 0, 0), turned by a right angle about z
  EXPECT_NEAR(mesh.nodes[0].x[1], 11, 1e-14);
  EXPECT_EQ(mesh.node_label(0), "one.1");
  EXPECT_EQ(mesh.nodes[4].x, (Point{1, 0, 0}));
  EXPECT_EQ(mesh.node_sets.at("S"), (std::vector<int>{4, 5, 8, 2}));
  EXPECT_TRUE(mesh.element_sets.count("TWO.E"));
}

// ---- limits ----

TEST(DeckLimits, DevicesAndCirclesAreRefused) {
  EXPECT_NE(error_of([] { read_source("/dev/zero"); }).find("device"), string::npos);
  write("limits/a.inp", "*INCLUDE, INPUT=/dev/zero\n");
  EXPECT_NE(error_of([] {
              read_source("limits/a.inp");
            }).find("limits/a.inp:1: *INCLUDE: /dev/zero: cannot be read: it is a folder or a device"),
            string::npos);
  write("limits/b.inp", "*NODE\n*INCLUDE, INPUT=b.inp\n");
  EXPECT_NE(
      error_of([] { read_source("limits/b.inp"); }).find("b.inp:2: *INCLUDE: limits/b.inp includes itself"),
      string::npos);
  // Each file reads the next one twice: 2^40 files.
  for (int i = 0; i < 40; ++i)
    write("limits/c" + std::to_string(i) + ".inp", "*NODE\n*INCLUDE, INPUT=c" + std::to_string(i + 1) +
                                                       ".inp\n*INCLUDE, INPUT=c" + std::to_string(i + 1) +
                                                       ".inp\n");
  write("limits/c40.inp", "1, 0., 0., 0.\n");
  const string deep = error_of([] { read_source("limits/c0.inp"); });
  EXPECT_NE(deep.find("deep"), string::npos) << deep;
  for (int i = 25; i >= 0; --i)
    std::filesystem::copy_file("limits/c" + std::to_string(i + 14) + ".inp",
                               "limits/d" + std::to_string(i) + ".inp",
                               std::filesystem::copy_options::overwrite_existing);
  for (int i = 0; i < 26; ++i)
    write("limits/d" + std::to_string(i) + ".inp", "*NODE\n*INCLUDE, INPUT=d" + std::to_string(i + 1) +
                                                       ".inp\n*INCLUDE, INPUT=d" + std::to_string(i + 1) +
                                                       ".inp\n");
  write("limits/d26.inp", "1, 0., 0., 0.\n");
  const string many = error_of([] { read_source("limits/d0.inp"); });
  EXPECT_NE(many.find("more than 10000 files"), string::npos) << many;
}

TEST(DeckLimits, SetsThatDoubleStaySmall) {
  string text = two_blocks() + "*NSET, NSET=D0\nNLOW\n";
  for (int i = 1; i < 60; ++i)
    text += "*NSET, NSET=D" + std::to_string(i) + "\nD" + std::to_string(i - 1) + ", D" +
            std::to_string(i - 1) + "\n";
  EXPECT_EQ(mesh_of(text).node_sets.at("D59").size(), 50u);
  EXPECT_EQ(
      mesh_of(two_blocks() + "*NSET, NSET=G, GENERATE\n1, 1000000000000000000\n").node_sets.at("G").size(),
      68u);
}

// ---- what is refused ----

TEST(DeckRefuses, WithLineAndReason) {
  struct Mistake {
    string changed, by, at, reason;
  };
  const string text = deck();
  const auto line_of = [&](const string& part) {
    return "deck.inp:" +
           std::to_string(1 + std::count(text.begin(),
                                         text.begin() + static_cast<std::ptrdiff_t>(text.find(part)), '\n')) +
           ": ";
  };
  const Mistake mistakes[] = {
      {"=LINEAR\n1e6", "=SOFT\n1e6", line_of("*SURFACE BEHAVIOR"), "SOFT"},
      {"*STATIC", "*UNCOUPLED TEMPERATURE-DISPLACEMENT", line_of("*STATIC"), "conduct no heat"},
      {"*STATIC", "*MODAL DYNAMIC", line_of("*STATIC"), "linear step"},
      {"*STATIC", "*DYNAMIC", line_of("*STATIC"), "verified in *STATIC"},
      {"*STEP, NLGEOM", "*STEP, PERTURBATION", line_of("*STEP"), "linear step"},
      {"1e6\n", "1e6\n*GAP RADIATION\n1., 2.\n", line_of("*CONTACT PAIR"),
       "cannot be had from contact elements"},
      {"SLAVE, MASTER\n", "SLAVE, NOBODY\n", line_of("SLAVE, MASTER"), "no surface or set 'NOBODY'"},
      {"INTERACTION=I,", "INTERACTION=J,", line_of("SLAVE, MASTER"), "no *SURFACE INTERACTION, NAME=J"},
      {"0.05\n*NODE", "1.6\nNHIGH, 2, 2, 1.6\n*NODE", line_of("*SURFACE, NAME=MASTER"),
       "an element may have 16 master nodes"},
      {"ETOP, S1", "ETOP, S7", line_of("ETOP, S1"), "S1 .. S6 of element 101 (C3D8)"},
      {"*MATERIAL, NAME=M", "*NGEN\n1, 2, 3\n*MATERIAL, NAME=M", line_of("*MATERIAL"),
       "*NGEN changes the mesh"},
      {"1000., .3", "1000., .3\n*CLEARANCE, VALUE=1", line_of("*SOLID SECTION"), "*CLEARANCE"},
      {"1000., .3", "1000., .3\n*CONTACT, OP=NEW", line_of("*SOLID SECTION"), "second time"},
  };
  for (const Mistake& m : mistakes) {
    const string error = error_of([&] { converted(deck(m.changed, m.by)); });
    EXPECT_NE(error.find(m.at), string::npos) << error << "\nexpected at " << m.at;
    EXPECT_NE(error.find(m.reason), string::npos) << error;
  }
}

// ---- what is written ----

// Random blanks, comments, continued lines and line ends of Windows: all but the lines of the pair is copied.
TEST(DeckWrites, EveryOtherLineByteForByte) {
  std::mt19937 engine(11);
  for (int round = 0; round < 20; ++round) {
    const bool windows = engine() % 2 != 0;
    string text;
    std::istringstream lines(deck());
    for (string line; std::getline(lines, line);) {
      if (engine() % 10 == 0) text += "** a comment, with = and *STEP" + string(windows ? "\r\n" : "\n");
      if (engine() % 4 == 0)
        line = string(engine() % 3, ' ') + line + string(engine() % 3, engine() % 2 ? ' ' : '\t');
      text += line + (windows ? "\r\n" : "\n");
    }
    if (engine() % 3 == 0) text.resize(text.size() - (windows ? 2 : 1)); // no end of line at the end
    const Job job = converted(text);
    Options options;
    options.deck = "job/deck.inp";
    std::filesystem::remove_all("out");
    write_job(job, options, "out");
    const string written = content("out/deck.inp");
    // Take away what was put in: between marks, and the note of the pair.
    std::vector<string> kept, wanted;
    const auto lines_of = [](const string& all) {
      std::vector<string> out;
      for (std::size_t at = 0; at < all.size();) {
        const std::size_t end = std::min(all.find('\n', at), all.size() - 1);
        out.push_back(all.substr(at, end + 1 - at));
        at = end + 1;
      }
      return out;
    };
    bool inserted = false;
    int data = 0;
    for (const string& line : lines_of(written)) {
      if (line.rfind("** ents-deck: contact elements", 0) == 0) inserted = true;
      if (inserted && string(trimmed(line.substr(0, line.find('\n')))).rfind("*STEP", 0) == 0)
        inserted = false;
      if (line.rfind("** ents-deck: limits", 0) == 0) data = 3;
      if (data > 0) {
        --data;
        continue;
      }
      if (!inserted && line.rfind("** ents-deck:", 0) != 0) kept.push_back(line);
    }
    bool pair = false;
    for (const string& line : lines_of(text)) {
      const string trim(trimmed(std::string_view(line).substr(0, line.find('\n'))));
      if (trim.rfind("*CONTACT PAIR", 0) == 0) {
        pair = true;
        continue;
      }
      if (pair && trim.rfind("**", 0) == 0) continue; // a comment inside of the pair goes with it
      if (pair && trim.rfind("SLAVE", 0) == 0) {
        pair = false;
        continue;
      }
      wanted.push_back(line);
    }
    // Comments between the keyword before *STEP and *STEP come before the elements.
    EXPECT_EQ(kept, wanted) << "round " << round;
  }
}

// With --pair only some of the deck's pairs become elements: the others stay, and so does the output that
// they have.
TEST(DeckWrites, PairsThatAreNotWantedStay) {
  const string text = deck("SLAVE, MASTER\n", "SLAVE, MASTER\nMASTER, OTHER\n");
  const string print = "*CONTACT PRINT\nCDIS\n";
  string with = text;
  with.insert(with.find("*END STEP"), print);
  with.insert(with.find("*SURFACE INTERACTION"), "*SURFACE, NAME=OTHER\nETOP, S2\n");
  Options options;
  options.pairs = {{"slave", "Master"}};
  const Job job = converted(with, options);
  EXPECT_EQ(job.contacts.size(), 1u);
  options.deck = "job/deck.inp";
  std::filesystem::remove_all("some");
  write_job(job, options, "some");
  const string written = content("some/deck.inp");
  EXPECT_NE(written.find("\nMASTER, OTHER\n"), string::npos);
  EXPECT_NE(written.find(print), string::npos);
  EXPECT_EQ(written.find("\nSLAVE, MASTER\n"), string::npos);
  // Of a deck whose pairs all become elements the output goes.
  string one = deck();
  one.insert(one.find("*END STEP"), print);
  std::filesystem::remove_all("one");
  write_job(converted(one), options, "one");
  EXPECT_EQ(content("one/deck.inp").find("\n" + print), string::npos);
  options.pairs = {{"MASTER", "SLAVE"}};
  const string error = error_of([&] { converted(deck(), options); });
  EXPECT_NE(error.find("in the deck 'SLAVE' is the slave; write --pair SLAVE,MASTER"), string::npos) << error;
}

TEST(DeckWrites, IncludedFilesAsTheyAre) {
  string text = deck();
  const std::size_t at = text.find("*MATERIAL");
  write("job/sub/mesh.inp", text.substr(0, at));
  const Job job = converted("*INCLUDE, INPUT=sub/mesh.inp\n" + text.substr(at));
  Options options;
  options.deck = "job/deck.inp";
  write_job(job, options, "out2");
  EXPECT_EQ(content("out2/sub/mesh.inp"), content("job/sub/mesh.inp"));
  EXPECT_NE(content("out2/deck.inp").find("*USER ELEMENT, TYPE=U1E"), string::npos);
  write("other/outside.inp", text.substr(0, at));
  const Job outside = converted("*INCLUDE, INPUT=../other/outside.inp\n" + text.substr(at));
  EXPECT_NE(error_of([&] { write_job(outside, options, "out3"); }).find("deck.inp:1: *INCLUDE"),
            string::npos);
}

} // namespace
} // namespace ents_deck::deck_test
