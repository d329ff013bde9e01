// SPDX-License-Identifier: BSD-3-Clause
// Patches and moved nodes of ents-deck; shells and beams.
#include <cmath>
#include <random>
#include <set>

#include "deck_text.hpp"
#include "facet_tree.hpp"

#include <ents.h>

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
  for (const bool told : {false, true}) { // by the deck alone, or as --slide, along what the deck drives
    Options options;
    if (told) options.slide = 1.4;
    const string far = deck("NHIGH, 1, 1, 0.05", told ? "NHIGH, 1, 1, 0.1" : "NHIGH, 1, 1, 1.4");
    const Contact contact = converted(far, options).contacts.at(0);
    EXPECT_GT(contact.patches.narrow, 0);
    const Mesh mesh = mesh_of(far);
    const FacetTree tree(mesh, contact.master.faces);
    std::set<std::vector<int>> different;
    for (const Patch& patch : contact.patches.list) {
      EXPECT_LE(patch.nodes.size(), 16u);
      different.insert(patch.faces);
      for (double way = -1.4; way <= 1.4; way += 0.05) {
        Point x = contact.points[static_cast<std::size_t>(patch.slave)].x;
        x[0] += way;
        if (x[0] < 0 || x[0] > 3) continue;
        const int face = tree.closest(x, {0, 0, -1}).face;
        EXPECT_NE(std::find(patch.faces.begin(), patch.faces.end(), face), patch.faces.end()) << x[0];
      }
    }
    EXPECT_GE(different.size(), 4u) << "each point has those that it meets itself";
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

// ---- triangles among quadrilaterals ----

/// n x n cells of side 1/n and height 1: bricks and, in every second one, two wedges.
string bricks_and_wedges(int first, double low, int n, const string& set) {
  std::ostringstream nodes, bricks, wedges;
  nodes.precision(17);
  const auto number = [&](int i, int j, int k) { return first + i + (n + 1) * (j + (n + 1) * k); };
  for (int k = 0; k <= 1; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        nodes << number(i, j, k) << ", " << double(i) / n << ", " << double(j) / n << ", " << low + k << "\n";
  int e = first;
  const auto prism = [&](std::ostream& out, std::initializer_list<std::pair<int, int>> corners) {
    out << e++;
    for (int k = 0; k <= 1; ++k)
      for (const auto& [i, j] : corners) out << ", " << number(i, j, k);
    out << "\n";
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      if ((i + j) % 2 == 0) {
        prism(bricks, {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
      } else {
        prism(wedges, {{i, j}, {i + 1, j}, {i + 1, j + 1}});
        prism(wedges, {{i, j}, {i + 1, j + 1}, {i, j + 1}});
      }
    }
  return "*NODE, NSET=N" + set + "\n" + nodes.str() + "*ELEMENT, TYPE=C3D8, ELSET=" + set + "\n" +
         bricks.str() + "*ELEMENT, TYPE=C3D6, ELSET=" + set + "\n" + wedges.str();
}

string mixed_deck() {
  return bricks_and_wedges(1, 0, 4, "LOW") + bricks_and_wedges(101, 1, 4, "HIGH") +
         "*SURFACE, NAME=SLAVE\nHIGH, S1\n*SURFACE, NAME=MASTER\nLOW, S2\n" + material + law +
         pair_of_surfaces + "*STEP, NLGEOM\n*STATIC\n*BOUNDARY\nNHIGH, 3, 3, -0.01\n*END STEP\n";
}

/// The library's element of one of a job's.
struct OneElement {
  ents_model* model = nullptr;
  std::vector<double> master;
  std::size_t dofs = 0, state_size = 0;
  const ContactElement& element;

  OneElement(const Job& job, const ContactElement& of) : element(of) {
    const string text = job.models.at(static_cast<std::size_t>(of.model)).text.dump();
    ents_report report{};
    report.struct_size = sizeof report;
    EXPECT_EQ(ents_model_create(text.c_str(), -1, nullptr, nullptr, 0, &model, &report), ENTS_OK)
        << report.message;
    ents_layout layout{};
    layout.struct_size = sizeof layout;
    EXPECT_EQ(ents_model_layout(model, &layout, &report), ENTS_OK) << report.message;
    dofs = static_cast<std::size_t>(layout.dofs), state_size = static_cast<std::size_t>(layout.state_size);
    for (const int node : of.masters) {
      const Point& x = job.mesh.nodes[static_cast<std::size_t>(node)].x;
      master.insert(master.end(), x.begin(), x.end());
    }
  }
  ~OneElement() { ents_model_destroy(&model, nullptr); }
  OneElement(const OneElement&) = delete;

  /// `state`: of the begin, then of the end
  int evaluate(const Point& slave, const std::vector<double>& at, std::vector<double>& state,
               std::vector<double>& residual) const {
    std::vector<double> end(state.size());
    ents_input in{};
    in.struct_size = sizeof in;
    in.slave = slave.data(), in.master = at.data(), in.area = &element.slave.area;
    ents_output out{};
    out.struct_size = sizeof out;
    out.wanted = ENTS_RESIDUAL;
    out.residual = residual.data();
    if (!state.empty()) {
      in.state_begin = state.data();
      out.wanted |= ENTS_STATE;
      out.state_end = end.data();
    }
    ents_report report{};
    report.struct_size = sizeof report;
    const int status = ents_evaluate(model, 0, 1, &in, &out, &report);
    if (status == ENTS_OK) state = end;
    return status;
  }
};

/// Residuals of all elements with the slave lower by `depth`, summed up at the nodes of the deck, [nodes].
std::vector<Point> forces(const Job& job, double depth) {
  std::vector<Point> sum(job.mesh.nodes.size());
  for (const ContactElement& element : job.elements) {
    const OneElement one(job, element);
    Point slave = element.slave.x;
    slave[2] -= depth;
    std::vector<double> none, residual(one.dofs);
    EXPECT_EQ(one.evaluate(slave, one.master, none, residual), ENTS_OK);
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < element.slave.nodes.size(); ++i)
        sum[static_cast<std::size_t>(element.slave.nodes[i])][k] += element.slave.weights[i] * residual[k];
      for (std::size_t i = 0; i < element.masters.size(); ++i)
        sum[static_cast<std::size_t>(element.masters[i])][k] += residual[3 + 3 * i + k];
    }
  }
  return sum;
}

// A body of bricks and wedges on another one with the same mesh, pressed by the same depth everywhere: every
// node of both has the force of a uniform pressure, whether its elements have one kind of faces or both.
TEST(DeckPatches, OfTrianglesAndQuadrilateralsPassThePatchTest) {
  constexpr double depth = 0.05, stiffness = 1e6, cell = 1.0 / 16;
  for (const double slide : {0.0, 0.3})
    for (const int points : {0, 1, 2, 3}) {
      Options options;
      options.slide = slide;
      options.points = points;
      options.program = Program::abaqus;
      const Job job = converted(mixed_deck(), options);
      std::set<string> segments;
      for (const Model& model : job.models) segments.insert(model.text.at("segment").get<string>());
      EXPECT_TRUE(segments.count("quad4"));
      const double pressure = stiffness * (depth + job.contacts.at(0).rise);
      std::vector<double> share(job.mesh.nodes.size());
      for (const Side* side : {&job.contacts.at(0).slave, &job.contacts.at(0).master})
        for (const Face& face : side->faces)
          for (const int node : face.nodes)
            share[static_cast<std::size_t>(node)] +=
                (side == &job.contacts.at(0).slave ? -1 : 1) * (face.nodes.size() == 3 ? cell / 6 : cell / 4);
      const std::vector<Point> found = forces(job, depth);
      double worst = 0;
      for (std::size_t i = 0; i < share.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
          worst = std::max(worst, std::abs(found[i][k] / pressure - (k == 2 ? share[i] : 0)) / cell);
      // positions of 1 and forces of a depth of 0.05: twenty roundings and a few
      EXPECT_LT(worst, 1e-13) << "slide " << slide << ", points " << points;
    }
}

// Of such elements every point has its pressure wherever it has slid to within its patch, on a plane master and on one
// whose nodes have moved at random: no projection is lost, none doubtful.
TEST(DeckPatches, OfTrianglesAndQuadrilateralsLoseNoPointThatSlides) {
  constexpr double depth = 0.02, stiffness = 1e6, farthest = 0.125;
  Options options;
  options.slide = 0.3;
  options.points = 2;
  options.program = Program::abaqus;
  const Job job = converted(mixed_deck(), options);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  int moved = 0, lost = 0;
  double worst = 0;
  for (const double warp : {0.0, 0.002})
    for (const ContactElement& element : job.elements) {
      const OneElement one(job, element);
      std::vector<double> master = one.master;
      for (double& x : master) x += warp * any(random);
      std::vector<double> state(one.state_size);
      EXPECT_EQ(
          ents_state_init(one.model, 1, state.data(), static_cast<std::int64_t>(one.state_size), nullptr),
          ENTS_OK);
      Point slave = element.slave.x;
      slave[2] -= depth;
      for (int step = 0; step < 4; ++step) {
        std::vector<double> residual(one.dofs);
        const int status = one.evaluate(slave, master, state, residual);
        ++moved;
        if (status != ENTS_OK) ++lost;
        if (warp == 0 && status == ENTS_OK) {
          const double pressure = stiffness * (depth + job.contacts.at(0).rise);
          worst = std::max(worst, std::abs(residual[2] / (-pressure * element.slave.area) - 1));
        }
        for (std::size_t k = 0; k < 2; ++k)
          slave[k] = std::clamp(element.slave.x[k] + farthest * any(random), 0.0, 1.0);
      }
    }
  EXPECT_GT(moved, 400);
  EXPECT_EQ(lost, 0) << "of " << moved;
  EXPECT_LT(worst, 1e-12);
}

// Where segments of both kinds are in one element a height needs coordinates that both have.
TEST(DeckPatches, OfTrianglesAndQuadrilateralsNeedCoordinatesForAHeight) {
  write("job/wave.json",
        R"({"height": {"type": "sine", "amplitude": 0.001, "wave_vector": [6.283, 0], "phase": 0}})");
  Options options;
  options.slide = 0.3;
  options.program = Program::abaqus;
  options.model = "job/wave.json";
  const string error = error_of([&] { converted(mixed_deck(), options); });
  EXPECT_NE(error.find("'MASTER' has triangles and quadrilaterals in one element"), string::npos) << error;
  EXPECT_NE(error.find("--coordinates"), string::npos) << error;
  options.coordinates = "xy";
  EXPECT_GT(converted(mixed_deck(), options).elements.size(), 0u);
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
