// SPDX-License-Identifier: BSD-3-Clause
// Areas and surface coordinates of ents-deck.
#include <cmath>
#include <numbers>

#include "deck_text.hpp"
#include "point_counts.hpp"
#include "surface_coordinates.hpp"

namespace ents_deck::deck_geometry_test {
namespace {

// ---- areas ----

/// A strip of three plane elements of 1 x 1; the upper edges are the slave.
string strip(const string& type, const string& section) {
  string text = "*NODE\n";
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 4; ++i)
      text +=
          std::to_string(1 + i + 4 * j) + ", " + std::to_string(2 + i) + ".0, " + std::to_string(j) + ".0\n";
  text += "*ELEMENT, TYPE=" + type + ", ELSET=E\n";
  for (int i = 1; i < 4; ++i)
    text += std::to_string(i) + ", " + std::to_string(i) + ", " + std::to_string(i + 1) + ", " +
            std::to_string(i + 5) + ", " + std::to_string(i + 4) + "\n";
  return text + "*SURFACE, NAME=TOP\nE, S3\n" + section;
}

double area_of(const Mesh& mesh, const string& side, int points, Program program) {
  const Side slave = side_of(mesh, side, {0, 1});
  std::vector<string> remarks;
  double sum = 0;
  for (const SlavePoint& p :
       points == 0 ? slave_nodes(mesh, slave, slave, program, remarks)
                   : points_in_faces(mesh, slave, std::vector(slave.faces.size(), points), program))
    sum += p.area;
  return sum;
}

TEST(DeckAreas, AreThoseOfTheSlave) {
  const Mesh blocks = mesh_of(two_blocks());
  const Mesh plate = mesh_of(strip(
      "CPS4", "*SOLID SECTION, ELSET=NONE, MATERIAL=M\n7.\n*SOLID SECTION, ELSET=E, MATERIAL=M\n0.25\n"));
  const Mesh ring = mesh_of(strip("CAX4", "*SOLID SECTION, ELSET=E, MATERIAL=M\n"));
  const double full_turn = std::numbers::pi * (25 - 4); // from the radius 2 to 5
  for (const int points : {0, 1, 2}) {
    for (const Program program : {Program::calculix, Program::abaqus}) {
      EXPECT_NEAR(area_of(blocks, "SLAVE", points, program), 4, 1e-13);
      EXPECT_NEAR(area_of(plate, "TOP", points, program), 3 * 0.25, 1e-14) << "length times thickness";
    }
    EXPECT_NEAR(area_of(ring, "TOP", points, Program::abaqus), full_turn, 1e-12) << points;
    EXPECT_NEAR(area_of(ring, "TOP", points, Program::calculix), full_turn * 2 / 360, 1e-13)
        << "ccx makes a wedge of 2 degrees";
  }
}

/// A C3D20 of length 1, as its nodes are numbered in `DeckFaces`.
string brick20() {
  const int corners[8][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0},
                             {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}};
  const int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                            {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  std::ostringstream out;
  out << "*NODE\n";
  for (int i = 0; i < 8; ++i)
    out << i + 1 << ", " << corners[i][0] / 2. << ", " << corners[i][1] / 2. << ", " << corners[i][2] / 2.
        << "\n";
  for (int i = 0; i < 12; ++i) {
    out << i + 9;
    for (int j = 0; j < 3; ++j) out << ", " << (corners[edges[i][0]][j] + corners[edges[i][1]][j]) / 4.;
    out << "\n";
  }
  out << "*ELEMENT, TYPE=C3D20, ELSET=E\n1";
  for (int i = 1; i <= 20; ++i) out << ", " << i;
  out << "\n*SURFACE, NAME=TOP\nE, S2\n";
  return out.str();
}

// ccx's shares of a quadratic face: corners 1/100, middles 24/100. Abaqus's are the library's, all positive.
TEST(DeckAreas, NodesOfQuadraticFacesHaveTheSharesOfTheirProgram) {
  const Mesh mesh = mesh_of(brick20());
  const Side slave = side_of(mesh, "TOP", {0, 1});
  std::vector<string> remarks;
  ASSERT_EQ(slave.nodes.size(), 8u);
  int corners = 0;
  for (const SlavePoint& p : slave_nodes(mesh, slave, slave, Program::calculix, remarks)) {
    const bool corner = mesh.nodes[static_cast<std::size_t>(p.nodes[0])].id <= 8;
    corners += corner;
    EXPECT_NEAR(p.area, corner ? 0.01 : 0.24, 1e-15);
  }
  EXPECT_EQ(corners, 4);
  for (const SlavePoint& p : slave_nodes(mesh, slave, slave, Program::abaqus, remarks))
    EXPECT_GT(p.area, 0.02);
}

/// What n x n slave faces over m x m of the master get: the number of the first face, and the remark.
std::pair<int, string> points_over(int n, int m, std::optional<int> asked = {}) {
  const Mesh mesh =
      mesh_of(block(1, {0, 0, 0}, {1, 1, 1}, m, m, 1, "LOW") + "*SURFACE, NAME=MASTER\nLOW, S2\n" +
              block(1001, {0, 0, 1}, {1, 1, 2}, n, n, 1, "HIGH") + "*SURFACE, NAME=SLAVE\nHIGH, S1\n");
  Contact contact;
  contact.slave = side_of(mesh, "SLAVE", {0, 1});
  contact.master = side_of(mesh, "MASTER", {0, 1});
  Options options;
  options.points = asked;
  std::vector<string> remarks;
  const std::vector<int> counts = point_counts(mesh, contact, options, remarks);
  for (const int count : counts) EXPECT_EQ(count, counts[0]) << n << " over " << m;
  return {counts.at(0), remarks.empty() ? "" : remarks[0]};
}

// Faces over many finer ones carry a uniform pressure with one point more per direction than those: three points
// were wrong by 59 % over 4, without a word (adapters.deck_run solves such a deck).
TEST(DeckPoints, FacesOverFinerOnesHaveMore) {
  const int expected[][3] = {{1, 1, 3}, {4, 4, 3}, {5, 2, 3}, {2, 3, 3}, {2, 4, 3},  {2, 5, 4},
                             {1, 3, 4}, {2, 7, 5}, {1, 4, 5}, {1, 8, 9}, {1, 15, 16}};
  for (const auto& [n, m, points] : expected) {
    const auto [count, remark] = points_over(n, m);
    EXPECT_EQ(count, points) << n << " over " << m;
    EXPECT_EQ(remark.empty(), 2 * n >= m) << remark; // all faces alike: nothing to report but what is too few
  }
  EXPECT_NE(points_over(1, 20).second.find("wants up to 21 points"), string::npos) << "16 are the most";
  EXPECT_NE(points_over(1, 4, 3).second.find("wants up to 5 points"), string::npos) << "asked for fewer";
  EXPECT_EQ(points_over(1, 4, 5).second, "");
}

// Points lie inside of their faces, where the weights say; the mean of those of a face is its middle.
TEST(DeckAreas, PointsLieWhereTheirWeightsSay) {
  const Mesh mesh = mesh_of(two_blocks());
  const Side slave = side_of(mesh, "SLAVE", {0, 1});
  const std::vector<SlavePoint> points =
      points_in_faces(mesh, slave, std::vector(slave.faces.size(), 2), Program::abaqus);
  ASSERT_EQ(points.size(), 4 * slave.faces.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    Point x{}, middle{};
    for (std::size_t k = 0; k < points[i].nodes.size(); ++k)
      for (std::size_t j = 0; j < 3; ++j)
        x[j] += points[i].weights[k] * mesh.nodes[static_cast<std::size_t>(points[i].nodes[k])].x[j];
    EXPECT_NEAR(length(minus(x, points[i].x)), 0, 1e-15);
    EXPECT_NEAR(points[i].normal[2], -1, 1e-15);
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t j = 0; j < 3; ++j) middle[j] += points[i / 4 * 4 + k].x[j] / 4;
    EXPECT_NEAR(length(minus(middle, face_middle(mesh, slave.faces[i / 4]))), 0, 1e-15);
    EXPECT_NEAR(length(minus(points[i].x, middle)), 0.5 / std::sqrt(1.5), 1e-15)
        << "Gauss's, of faces of 1 x 1";
  }
}

TEST(DeckAreas, OfNodesAloneAreTheDecksForAbaqus) {
  const string text = two_blocks() + "*SURFACE, NAME=POINTS, TYPE=NODE\n1, 0.3\n2, 0.4\n";
  const Mesh mesh = mesh_of(text);
  EXPECT_NEAR(area_of(mesh, "POINTS", 0, Program::abaqus), 0.7, 1e-15);
}

// ---- surface coordinates ----

/// A quarter of a pipe about the axis z, radius 1 to 2, in n elements, that begins at the angle `from`.
string pipe(int n, double from) {
  std::ostringstream out;
  out.precision(17);
  out << "*NODE\n";
  const auto number = [&](int i, int j, int k) { return 1 + i + (n + 1) * (j + 2 * k); };
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i <= n; ++i) {
        const double angle = from + std::numbers::pi / 2 * i / n, r = 1 + j;
        out << number(i, j, k) << ", " << r * std::cos(angle) << ", " << r * std::sin(angle) << ", " << 3 * k
            << "\n";
      }
  out << "*ELEMENT, TYPE=C3D8, ELSET=E\n";
  for (int i = 0; i < n; ++i)
    out << i + 1 << ", " << number(i, 0, 0) << ", " << number(i, 1, 0) << ", " << number(i + 1, 1, 0) << ", "
        << number(i + 1, 0, 0) << ", " << number(i, 0, 1) << ", " << number(i, 1, 1) << ", "
        << number(i + 1, 1, 1) << ", " << number(i + 1, 0, 1) << "\n";
  out << "*SURFACE, NAME=OUT\nE, S4\n";
  return out.str();
}

// The seam of the angle at pi lies inside of the surface: within a face, and within the patch of an element,
// angles go on.
TEST(DeckCoordinates, OfACylinderGoOnOverItsSeam) {
  const int n = 6;
  const Mesh mesh = mesh_of(pipe(n, 0.8 * std::numbers::pi));
  const Side master = side_of(mesh, "OUT", {0, 1});
  ASSERT_EQ(master.faces.size(), static_cast<std::size_t>(n));
  const auto faces = coordinates_of_faces(mesh, master, "cylinder z", "");
  Patch patch;
  std::map<int, int> local;
  for (int f = 0; f < n; ++f) {
    const Face& face = master.faces[static_cast<std::size_t>(f)];
    double low = 1e9, high = -1e9;
    for (std::size_t i = 0; i < 4; ++i) {
      const Point& x = mesh.nodes[static_cast<std::size_t>(face.nodes[i])].x;
      const double s = faces[static_cast<std::size_t>(f)][2 * i];
      EXPECT_NEAR(std::cos(s), x[0] / 2, 1e-14);
      EXPECT_NEAR(std::sin(s), x[1] / 2, 1e-14);
      EXPECT_EQ(faces[static_cast<std::size_t>(f)][2 * i + 1], x[2]);
      low = std::min(low, s), high = std::max(high, s);
      if (local.emplace(face.nodes[i], static_cast<int>(local.size())).second)
        patch.nodes.push_back(face.nodes[i]);
    }
    EXPECT_NEAR(high - low, std::numbers::pi / 2 / n, 1e-14) << f;
    patch.faces.push_back(f);
  }
  const std::vector<double> whole = coordinates_of_patch(master, patch, faces, 2, "cylinder z");
  double low = 1e9, high = -1e9;
  for (std::size_t i = 0; i < patch.nodes.size(); ++i)
    low = std::min(low, whole[2 * i]), high = std::max(high, whole[2 * i]);
  EXPECT_NEAR(high - low, std::numbers::pi / 2, 1e-13);
}

TEST(DeckCoordinates, OfTheMeshOrOfAFile) {
  const Mesh mesh = mesh_of(two_blocks());
  const Side master = side_of(mesh, "MASTER", {0, 1});
  const auto yx = coordinates_of_faces(mesh, master, "yx", "");
  string table = "# node, s1, s2\n";
  for (const int node : master.nodes)
    table += std::to_string(mesh.nodes[static_cast<std::size_t>(node)].id) + " " + std::to_string(10 * node) +
             " 0.5 # of it\n";
  write("coordinates.txt", table);
  const auto read = coordinates_of_faces(mesh, master, "file", "coordinates.txt");
  for (std::size_t f = 0; f < master.faces.size(); ++f)
    for (std::size_t i = 0; i < 4; ++i) {
      const int node = master.faces[f].nodes[i];
      const Point& x = mesh.nodes[static_cast<std::size_t>(node)].x;
      EXPECT_EQ(yx[f][2 * i], x[1]);
      EXPECT_EQ(yx[f][2 * i + 1], x[0]);
      EXPECT_EQ(read[f][2 * i], 10.0 * node);
      EXPECT_EQ(read[f][2 * i + 1], 0.5);
    }
  const auto refused = [&](const string& how, const string& file_text, const char* reason) {
    write("wrong.txt", file_text);
    const string error = error_of([&] { coordinates_of_faces(mesh, master, how, "wrong.txt"); });
    EXPECT_NE(error.find(reason), string::npos) << error;
  };
  refused("x", "", "this master has 2 surface coordinates, write two letters such as xy");
  refused("file", "1 0.5\n", "wrong.txt:1: expected a node and 2 surface coordinates");
  refused("file", "1 0.5 half\n", "wrong.txt:1: expected a number, found 'half'");
  refused("file", "# nothing\n", "has no line for the master node");
}

// Friction without a height: lengths in the plane of the patch, so that an anchor that moves to the next
// segment stays in its place.
TEST(DeckCoordinates, OfAPlanePatchAreLengths) {
  Options options;
  options.slide = 0.9;
  const Job job = converted(deck("=LINEAR\n1e6\n", "=LINEAR\n1e6\n*FRICTION\n0.2\n"), options);
  ASSERT_FALSE(job.elements.empty());
  for (const ContactElement& e : job.elements) {
    ASSERT_EQ(e.surface_coordinates.size(), 2 * e.masters.size());
    for (std::size_t i = 0; i < e.masters.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Point a = job.mesh.nodes[static_cast<std::size_t>(e.masters[i])].x,
                    b = job.mesh.nodes[static_cast<std::size_t>(e.masters[j])].x;
        const double s = std::hypot(e.surface_coordinates[2 * i] - e.surface_coordinates[2 * j],
                                    e.surface_coordinates[2 * i + 1] - e.surface_coordinates[2 * j + 1]);
        EXPECT_NEAR(s, length(minus(a, b)), 1e-13);
      }
  }
}

// In the plane: lengths along the chain of edges, whose elements have other sizes.
TEST(DeckCoordinates, OfAChainAreItsLength) {
  string text = "*NODE\n";
  const double x[4] = {0, 0.5, 1.5, 3};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 4; ++i)
      text +=
          std::to_string(1 + i + 4 * j) + ", " + std::to_string(x[i]) + ", " + std::to_string(j - 1) + ".0\n";
  text += "*ELEMENT, TYPE=CPE4, ELSET=E\n";
  for (int i = 1; i < 4; ++i)
    text += std::to_string(i) + ", " + std::to_string(i) + ", " + std::to_string(i + 1) + ", " +
            std::to_string(i + 5) + ", " + std::to_string(i + 4) + "\n";
  const Mesh mesh = mesh_of(text + "*SURFACE, NAME=TOP\nE, S3\n");
  const Side master = side_of(mesh, "TOP", {0, 1});
  SlavePoint point;
  point.nodes = {0}, point.weights = {1}, point.x = {1, 0.1, 0}, point.normal = {0, -1, 0};
  PatchRequest request;
  request.slide = 5, request.largest = 20;
  const Patches patches = patches_of(mesh, {point}, master, request);
  ASSERT_EQ(patches.list.size(), 1u);
  const Patch& patch = patches.list[0];
  ASSERT_EQ(patch.nodes.size(), 4u);
  const std::vector<double> s = plane_coordinates(mesh, master, patch);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_NEAR(std::abs(s[i] - s[j]),
                  std::abs(mesh.nodes[static_cast<std::size_t>(patch.nodes[i])].x[0] -
                           mesh.nodes[static_cast<std::size_t>(patch.nodes[j])].x[0]),
                  1e-14);
}

// ccx keeps surfaces of nodes and of faces apart, so that both may have one name.
TEST(DeckGeometry, ASurfaceOfNodesAndOneOfFacesMayShareAName) {
  const string faces = "*SURFACE, NAME=SLAVE\nETOP, S1\n";
  const string all = "*NSET, NSET=LOWER, GENERATE\n101, 109\n*SURFACE, NAME=SLAVE, TYPE=NODE\nLOWER\n";
  const auto points = [](const string& by) {
    return converted(deck("*SURFACE, NAME=SLAVE\nETOP, S1\n", by)).contacts.at(0).points.size();
  };
  EXPECT_EQ(points(all + faces), points(faces));
  EXPECT_EQ(points(faces + all), points(faces));
  const string error = error_of([&] { points(faces + "*SURFACE, NAME=SLAVE, TYPE=NODE\n101\n102\n"); });
  EXPECT_NE(error.find("deck.inp:"), string::npos) << error;
  EXPECT_NE(error.find("two surfaces are called 'SLAVE'"), string::npos) << error;
  EXPECT_NE(error.find("node 103 belongs to one of them alone"), string::npos) << error;
}

} // namespace
} // namespace ents_deck::deck_geometry_test
