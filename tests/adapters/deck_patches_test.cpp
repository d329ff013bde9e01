// SPDX-License-Identifier: BSD-3-Clause
// Patches and moved nodes of ents-deck; shells and beams.
#include <cmath>
#include <set>

#include "deck_text.hpp"
#include "facet_tree.hpp"

namespace ents_deck::deck_patches_test {
namespace {

// ---- patches ----

// The motion along the normal is no slide; without --slide what counts is the rest of it.
TEST(DeckPatches, MotionAlongTheNormalIsNoSlide) {
  const Job down = converted(deck("NHIGH, 1, 1, 0.05", "NHIGH, 3, 3, -0.4"));
  EXPECT_NEAR(down.contacts.at(0).patches.slide, 0, 1e-12);
  const Job along =
      converted(deck("NHIGH, 1, 1, 0.05", "NHIGH, 3, 3, -0.4\nNHIGH, 1, 1, 0.3\nNHIGH, 2, 2, 0.4"));
  EXPECT_NEAR(along.contacts.at(0).patches.slide, 0.5, 1e-12);
}

// Equal neighbourhoods have equal models: the nodes of a segment are numbered from the corner that makes the
// fewest.
TEST(DeckPatches, EqualNeighbourhoodsShareAModel) {
  Options options;
  options.slide = 0.05;
  const Job job = converted(deck(), options);
  EXPECT_EQ(job.models.size(), 3u) << "within the master, at its edges, and in its corners";
  EXPECT_EQ(job.elements.size(), 36u); // 3 x 3 points in each of four faces
}

// Where all faces within the slide are too many, a point that is driven along one axis has those of its way.
TEST(DeckPatches, AStraightSlideTakesTheFacesOfItsWay) {
  const string far = deck("NHIGH, 1, 1, 0.05", "NHIGH, 1, 1, 1.4");
  const Contact contact = converted(far).contacts.at(0);
  EXPECT_GT(contact.patches.narrow, 0);
  const Mesh mesh = mesh_of(far);
  const FacetTree tree(mesh, contact.master.faces);
  for (const Patch& patch : contact.patches.list) {
    EXPECT_LE(patch.nodes.size(), 16u);
    for (double way = -1.4; way <= 1.4; way += 0.05) {
      Point x = contact.points[static_cast<std::size_t>(patch.slave)].x;
      x[0] += way;
      if (x[0] < 0 || x[0] > 3) continue;
      const int face = tree.closest(x, {0, 0, -1}).face;
      EXPECT_NE(std::find(patch.faces.begin(), patch.faces.end(), face), patch.faces.end()) << x[0];
    }
  }
  const string error = error_of([] { converted(deck("NHIGH, 1, 1, 0.05", "NHIGH, 1, 2, 1.4")); });
  EXPECT_NE(error.find("--points 0 leaves 19 of them"), string::npos) << error;
}

// Two faces back to back, of a plate that is thinner than the gap: the point's is the one that faces it.
TEST(DeckPatches, AFaceThatLooksAwayIsNotBelow) {
  const Mesh mesh =
      mesh_of(block(1, {0, 0, 0}, {1, 1, 0.1}, 1, 1, 1, "E") + "*SURFACE, NAME=SKIN\nE, S1\nE, S2\n");
  const Side skin = side_of(mesh, "SKIN", {0, 1});
  const FacetTree tree(mesh, skin.faces);
  const Point deep{0.5, 0.5, 0.01}; // below the upper face, and nearer to the lower one
  EXPECT_EQ(tree.closest(deep, {0, 0, -1}).face, 1);
  EXPECT_EQ(tree.closest(deep, {0, 0, 1}).face, 0);
}

// All faces within the slide of a point are in its patch, however the slide comes; each segment's normal
// points out of the body.
TEST(DeckPatches, HaveAllFacesWithinTheSlide) {
  for (const double slide : {0.0, 0.3, 0.7}) {
    Options options;
    options.slide = slide;
    options.program = Program::abaqus; // 33 nodes
    const Job job = converted(deck(), options);
    const Contact& contact = job.contacts.at(0);
    const FacetTree tree(job.mesh, contact.master.faces);
    ASSERT_EQ(contact.patches.list.size(), contact.points.size());
    for (const Patch& patch : contact.patches.list) {
      const SlavePoint& point = contact.points[static_cast<std::size_t>(patch.slave)];
      const Point under = tree.closest(point.x, point.normal).point;
      for (int f = 0; f < static_cast<int>(contact.master.faces.size()); ++f) {
        const bool within = slide > 0.05 && tree.distance(under, f) <= slide;
        if (!within) continue;
        EXPECT_NE(std::find(patch.faces.begin(), patch.faces.end(), f), patch.faces.end())
            << slide << " " << f;
      }
      ASSERT_EQ(patch.topology.size(), patch.faces.size());
      for (std::size_t k = 0; k < patch.faces.size(); ++k) {
        Point x[4];
        for (std::size_t i = 0; i < 4; ++i)
          x[i] = job.mesh
                     .nodes[static_cast<std::size_t>(
                         patch.nodes[static_cast<std::size_t>(patch.topology[k][i])])]
                     .x;
        EXPECT_GT(cross(minus(x[1], x[0]), minus(x[3], x[0]))[2], 0) << "towards the slave, +z";
        const auto& nodes = contact.master.faces[static_cast<std::size_t>(patch.faces[k])].nodes;
        std::set<int> of_face(nodes.begin(), nodes.end());
        for (const int local : patch.topology[k])
          EXPECT_EQ(of_face.count(patch.nodes[static_cast<std::size_t>(local)]), 1u);
      }
    }
  }
}

// ---- moved nodes ----

TEST(DeckAdjust, PutsNodesOnTheMaster) {
  const string low = block(1, {0, 0, 0}, {3, 3, 1}, 4, 4, 1, "LOW"),
               high = block(101, {0.5, 0.5, 1.01}, {2.5, 2.5, 2}, 2, 2, 1, "HIGH");
  for (const double range : {0.02, 0.005}) {
    const string pair =
        "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE, ADJUST=" + std::to_string(range) +
        "\nSLAVE, MASTER\n";
    const Job job = converted(low + high + surfaces + material + law + pair + step);
    EXPECT_EQ(job.moves.size(), range > 0.01 ? 9u : 0u) << range;
    for (const Move& move : job.moves) EXPECT_NEAR(move.to[2], 1, 1e-14);
    for (const Move& move : job.moves)
      EXPECT_EQ(job.mesh.nodes[static_cast<std::size_t>(move.node)].x, move.to);
  }
}

// Slave and master on each other, gap 0: the master's height is raised a little, so that what only contact
// holds is not loose.
TEST(DeckAdjust, SurfacesThatTouchBeginInContact) {
  const Job touching = converted(deck());
  EXPECT_GT(touching.contacts.at(0).rise, 0);
  EXPECT_LT(touching.contacts.at(0).rise, 1e-5);
  for (const Model& model : touching.models)
    EXPECT_EQ(model.text.at("height").at("value"), touching.contacts.at(0).rise);
  EXPECT_EQ(converted(block(1, {0, 0, 0}, {3, 3, 1}, 4, 4, 1, "LOW") +
                      block(101, {0.5, 0.5, 1.2}, {2.5, 2.5, 2}, 2, 2, 1, "HIGH") + surfaces + material +
                      law + pair_of_surfaces + step)
                .contacts.at(0)
                .rise,
            0);
}

// ---- shells and beams ----

// Beside the bodies in contact they stay as they are; as slave or master they are refused with the line of
// the surface.
TEST(DeckShells, AndBeamsAreTakenBesideTheContactAndRefusedInIt) {
  const string plate = "*NODE\n901, 9., 0., 0.\n902, 10., 0., 0.\n903, 10., 1., 0.\n904, 9., 1., 0.\n905, "
                       "9.5, 0., 0.\n906, 10., .5, 0.\n907, 9.5, 1., 0.\n908, 9., .5, 0.\n";
  const struct {
    const char *type, *nodes;
  } shells[] = {{"S3", "901, 902, 903"},
                {"S4R", "901, 902, 903, 904"},
                {"S6", "901, 902, 903, 905, 906, 907"},
                {"S8R", "901, 902, 903, 904, 905, 906, 907, 908"},
                {"STRI65", "901, 902, 903, 905, 906, 907"}};
  for (const auto& shell : shells) {
    SCOPED_TRACE(shell.type);
    const string elements =
        plate + "*ELEMENT, TYPE=" + shell.type + ", ELSET=PLATE\n901, " + shell.nodes + "\n";
    EXPECT_EQ(converted(elements + deck()).elements.size(), converted(deck()).elements.size());
    for (const char* side : {"SPOS", "SNEG", ""})
      for (const bool master : {false, true}) {
        const string surface = "*SURFACE, NAME=SKIN\nPLATE" + string(*side == '\0' ? "" : ", ") + side + "\n";
        const string text =
            elements + surface + deck("SLAVE, MASTER\n", master ? "SLAVE, SKIN\n" : "SKIN, MASTER\n");
        const string error = error_of([&] { converted(text); });
        const auto line =
            1 + std::count(text.begin(),
                           text.begin() + static_cast<std::ptrdiff_t>(text.find("*SURFACE, NAME=SKIN")),
                           '\n');
        EXPECT_NE(error.find("deck.inp:" + std::to_string(line) + ": 'SKIN' has faces of shells"),
                  string::npos)
            << error;
      }
    const string error = error_of([&] { converted(elements + "*SURFACE, NAME=SKIN\nPLATE, S7\n" + deck()); });
    EXPECT_NE(error.find("expected SPOS or SNEG of the shell"), string::npos) << error;
  }
  for (const char* type : {"B31", "B32R", "T3D2"}) {
    SCOPED_TRACE(type);
    const string elements = plate + "*ELEMENT, TYPE=" + type + ", ELSET=BAR\n901, 901, 902" +
                            (type[2] == '2' ? ", 903" : "") + "\n";
    EXPECT_EQ(converted(elements + deck()).elements.size(), converted(deck()).elements.size());
    const string text =
        elements + "*SURFACE, NAME=SKIN\nBAR, S1\n" + deck("SLAVE, MASTER\n", "SKIN, MASTER\n");
    const string error = error_of([&] { converted(text); });
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find("BAR, S1")), '\n');
    EXPECT_NE(error.find("deck.inp:" + std::to_string(line) + ": element 901 (" + type +
                         ") has no faces that are known here"),
              string::npos)
        << error;
  }
}

} // namespace
} // namespace ents_deck::deck_patches_test
