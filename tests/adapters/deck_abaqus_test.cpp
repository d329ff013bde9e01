// SPDX-License-Identifier: BSD-3-Clause
// A deck of two instances of one part, as Abaqus/CAE writes it, through ents-deck and the emulated Abaqus,
// which numbers elements anew, as Abaqus does with parts. The forces must be those of the whole surfaces
// through the library's own search and assembly.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include <gtest/gtest.h>

#include "abaqus_services.hpp"
#include "convert.hpp"
#include "plain_model.hpp"
#include "uel_host.hpp"
#include "write.hpp"

namespace adapters::deck_abaqus_test {
namespace {

using namespace ents_deck;
using std::string;

/// Part of 4 x 3 x 1 cells of 4 x 3 x 1, and two instances: one below; one above, moved and turned about z by
/// 30 degrees.
string cae_deck() {
  std::ostringstream out;
  out << "*Heading\n** Job name: two Model name: Model-1\n*Preprint, echo=NO, model=NO, history=NO, "
         "contact=NO\n**\n** PARTS\n**\n*Part, name=Block\n*Node\n";
  const auto number = [](int i, int j, int k) { return 1 + i + 5 * (j + 4 * k); };
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 5; ++i)
        out << "      " << number(i, j, k) << ",           " << i << ".,           " << j << ".,           "
            << k << ".\n";
  out << "*Element, type=C3D8R\n";
  int e = 0;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i)
      out << ++e << ", " << number(i, j, 0) << ", " << number(i + 1, j, 0) << ", " << number(i + 1, j + 1, 0)
          << ", " << number(i, j + 1, 0) << ", " << number(i, j, 1) << ", " << number(i + 1, j, 1) << ", "
          << number(i + 1, j + 1, 1) << ", " << number(i, j + 1, 1) << "\n";
  out << "*Elset, elset=Set-1, generate\n  1,  12,   1\n** Section: Section-1\n*Solid Section, elset=Set-1, "
         "material=Steel\n,\n*End Part\n**  \n**\n** ASSEMBLY\n**\n"
         "*Assembly, name=Assembly\n**  \n*Instance, name=Block-1, part=Block\n*End Instance\n**  "
         "\n*Instance, name=Block-2, part=Block\n"
         "          1.2,         -0.3,        0.99\n          1.2,         -0.3,         0.99,        1.2,   "
         "     -0.3,        1.99,          30.\n*End Instance\n**  \n"
         "*Elset, elset=_Top_S2, internal, instance=Block-1, generate\n  1,  12,   1\n*Surface, "
         "type=ELEMENT, name=Top\n_Top_S2, S2\n"
         "*Elset, elset=_Low_S1, internal, instance=Block-2, generate\n  1,  12,   1\n*Surface, "
         "type=ELEMENT, name=Low\n_Low_S1, S1\n*End Assembly\n** \n"
         "** MATERIALS\n** \n*Material, name=Steel\n*Elastic\n210000., 0.3\n** \n** INTERACTION "
         "PROPERTIES\n** \n*Surface Interaction, name=IntProp-1\n1.,\n"
         "*Friction\n 0.2,\n*Surface Behavior, pressure-overclosure=LINEAR\n1e5,\n** \n** INTERACTIONS\n** "
         "\n** Interaction: Int-1\n"
         "*Contact Pair, interaction=IntProp-1, type=SURFACE TO SURFACE\nLow, Top\n** \n** STEP: Step-1\n** "
         "\n*Step, name=Step-1, nlgeom=YES\n*Static\n1., 1., 1e-05, 1.\n*End Step\n";
  return out.str();
}

/// What Abaqus has read: a user element with its nodes and properties.
struct Element {
  std::vector<string> nodes;
  std::vector<double> properties;
  int variables = 0, jelem = 0;
};

std::vector<Element> read_user_elements(const Source& source) {
  std::map<string, const Statement*> types, sets;
  std::vector<Element> out;
  std::map<string, std::vector<std::size_t>> members;
  for (const Statement& s : source.list) {
    if (s.keyword == "USER ELEMENT") types[s.value("TYPE")] = &s;
    if (s.keyword == "ELEMENT" && types.count(s.value("TYPE")) != 0) {
      const Statement& type = *types[s.value("TYPE")];
      const auto count = static_cast<std::size_t>(std::stoi(type.value("NODES"))) + 1;
      EXPECT_TRUE(type.has("UNSYMM"));
      std::vector<string> words;
      for (const Line& line : s.lines)
        for (const auto field : fields_of(line.text)) words.emplace_back(field);
      EXPECT_EQ(words.size() % count, 0u);
      for (std::size_t i = 0; i < words.size(); i += count) {
        members[s.value("ELSET")].push_back(out.size());
        out.push_back({{words.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                        words.begin() + static_cast<std::ptrdiff_t>(i + count)},
                       {},
                       std::stoi(type.value("VARIABLES")),
                       0});
        sets[s.value("ELSET")] = &type;
      }
    }
    if (s.keyword == "UEL PROPERTY") {
      std::vector<double> values;
      for (const Line& line : s.lines) {
        EXPECT_LE(fields_of(line.text).size(), 8u) << "Abaqus reads eight real numbers a line";
        for (const auto field : fields_of(line.text)) values.push_back(std::stod(string(field)));
      }
      EXPECT_EQ(values.size(),
                static_cast<std::size_t>(std::stoi(sets.at(s.value("ELSET"))->value("PROPERTIES"))));
      for (const std::size_t i : members.at(s.value("ELSET"))) out[i].properties = values;
    }
  }
  return out;
}

Job job_of(std::optional<int> points, const string& coordinates, int first_model) {
  std::filesystem::create_directories("cae");
  std::ofstream("cae/two.inp") << cae_deck();
  std::ofstream("cae/wavy.json")
      << R"({"height": {"type": "sine", "amplitude": 0.004, "wave_vector": [0.4, 0.3]}})";
  Options options;
  options.deck = "cae/two.inp";
  options.model = "cae/wavy.json";
  options.program = Program::abaqus;
  options.slide = 0.3;
  options.points = points;
  options.coordinates = coordinates;
  options.first_model = first_model; // a model is read once in a process
  Job job = convert(options);
  write_job(job, options, ".");
  return job;
}

/// Forces on nodes of both instances by label: each element through UEL.
std::map<string, Point> forces_through_abaqus(const Mesh& mesh, const std::map<string, Point>& displacement) {
  std::map<string, Point> position, out;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    position[mesh.node_label(static_cast<int>(n))] = mesh.nodes[n].x;
  std::vector<Element> elements = read_user_elements(read_source("two.inp"));
  // Numbers of its own: those of both parts first, in an order that nobody has promised.
  for (std::size_t i = 0; i < elements.size(); ++i)
    elements[i].jelem = 25 + static_cast<int>((7 * i + 3) % elements.size());
  for (const Element& e : elements) {
    UelCall c(static_cast<int>(e.nodes.size()), 3, e.variables);
    c.props = e.properties;
    c.jelem = e.jelem;
    for (const string& node : e.nodes)
      for (std::size_t j = 0; j < 3; ++j)
        c.coords.push_back(position.at(node)[j]), c.u.push_back(displacement.at(node)[j]);
    c();
    EXPECT_EQ(c.pnewdt, 1e36);
    for (std::size_t n = 0; n < e.nodes.size(); ++n)
      for (std::size_t j = 0; j < 3; ++j) out[e.nodes[n]][j] += c.rhs[3 * n + j];
  }
  for (const auto& message : abaqus_messages()) ADD_FAILURE() << message.text;
  return out;
}

/// The same of the whole surfaces: detection, evaluation, forces of points handed to the nodes of their
/// faces.
std::map<string, Point> forces_of_surfaces(const Job& job, const std::map<string, Point>& displacement) {
  const Mesh& mesh = job.mesh;
  const Contact& contact = job.contacts.at(0);
  nlohmann::json text = contact.model;
  text["contact"].erase("friction"); // from zero displacement slip begins nowhere: see the caller
  const PlainModel model(text);
  std::map<int, int64_t> index;
  std::vector<int> nodes;
  std::vector<int64_t> connectivity;
  std::vector<double> positions;
  const auto current = [&](int node) {
    Point x = mesh.nodes[static_cast<std::size_t>(node)].x;
    const Point& u = displacement.at(mesh.node_label(node));
    for (std::size_t j = 0; j < 3; ++j) x[j] += u[j];
    return x;
  };
  std::vector<double> coordinates;
  for (std::size_t f = 0; f < contact.master.faces.size(); ++f) {
    for (const int node : contact.master.faces[f].nodes) {
      if (index.emplace(node, static_cast<int64_t>(index.size())).second) {
        const Point x = current(node);
        positions.insert(positions.end(), x.begin(), x.end());
        nodes.push_back(node);
      }
      connectivity.push_back(index.at(node));
    }
    if (!contact.face_coordinates.empty())
      coordinates.insert(coordinates.end(), contact.face_coordinates[f].begin(),
                         contact.face_coordinates[f].end());
  }
  auto surface = ents_struct<ents_master_mesh>();
  surface.segments = static_cast<int64_t>(contact.master.faces.size());
  surface.connectivity = connectivity.data();
  surface.nodes = static_cast<int64_t>(index.size());
  surface.positions = positions.data();
  surface.surface_coordinates = coordinates.empty() ? nullptr : coordinates.data();
  int64_t size = 0;
  EXPECT_EQ(ents_tree_size(model.get(), surface.segments, &size, nullptr), ENTS_OK);
  std::vector<double> tree(static_cast<std::size_t>(size));
  EXPECT_EQ(ents_tree_build(model.get(), &surface, tree.data(), size, nullptr), ENTS_OK);

  std::map<string, Point> out;
  for (const SlavePoint& point : contact.points) {
    Point x{};
    for (std::size_t k = 0; k < point.nodes.size(); ++k) {
      const Point node = current(point.nodes[k]);
      for (std::size_t j = 0; j < 3; ++j) x[j] += point.weights[k] * node[j];
    }
    int64_t segment = -1;
    double xi[2], area = point.area, residual[15];
    auto detection = ents_struct<ents_detection>();
    detection.slave = x.data(), detection.reach = 1, detection.segment = &segment, detection.xi = xi;
    EXPECT_EQ(ents_detect(model.get(), &surface, tree.data(), size, 0, 1, &detection, nullptr), ENTS_OK);
    if (segment < 0) continue;
    auto in = ents_struct<ents_input>();
    in.slave = x.data(), in.mesh = &surface, in.segment = &segment, in.start = xi, in.area = &area;
    auto result = ents_struct<ents_output>();
    result.wanted = ENTS_RESIDUAL, result.residual = residual;
    EXPECT_EQ(ents_evaluate(model.get(), 0, 1, &in, &result, nullptr), ENTS_OK);
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < point.nodes.size(); ++k)
        out[mesh.node_label(point.nodes[k])][j] -= point.weights[k] * residual[j];
      for (std::size_t m = 0; m < 4; ++m)
        out[mesh.node_label(
            nodes[static_cast<std::size_t>(connectivity[static_cast<std::size_t>(4 * segment) + m])])][j] -=
            residual[3 + 3 * m + j];
    }
  }
  return out;
}

class DeckAbaqus : public testing::TestWithParam<std::tuple<int, const char*, int>> {};

TEST_P(DeckAbaqus, TwoInstancesOfOnePartCarryTheForcesOfTheSurfaces) {
  abaqus_messages();
  const auto [points, coordinates, first_model] = GetParam();
  const Job job = job_of(points, coordinates, first_model);
  EXPECT_TRUE(job.mesh.has_parts());
  EXPECT_FALSE(std::filesystem::exists("ents_" + std::to_string(first_model) + ".txt"))
      << "a table by element numbers would be another element's";
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> random(-1, 1);
  std::map<string, Point> displacement; // small and rough, and the upper block goes down and along
  for (std::size_t n = 0; n < job.mesh.nodes.size(); ++n) {
    const bool upper = job.mesh.nodes[n].instance == 1;
    displacement[job.mesh.node_label(static_cast<int>(n))] = {(upper ? 0.13 : 0) + 0.01 * random(engine),
                                                              0.01 * random(engine),
                                                              (upper ? -0.02 : 0) + 0.004 * random(engine)};
  }
  const auto abaqus = forces_through_abaqus(job.mesh, displacement),
             surfaces = forces_of_surfaces(job, displacement);
  double largest = 0, difference = 0, lower = 0;
  Point total{};
  for (const auto& [node, force] : surfaces)
    for (std::size_t j = 0; j < 3; ++j) {
      largest = std::max(largest, std::abs(force[j]));
      const auto found = abaqus.find(node);
      difference = std::max(difference, std::abs(force[j] - (found == abaqus.end() ? 0 : found->second[j])));
    }
  for (const auto& [node, force] : abaqus) {
    for (std::size_t j = 0; j < 3; ++j) total[j] += force[j];
    if (node.rfind("Block-1.", 0) == 0) lower += force[2];
  }
  EXPECT_GT(largest, 1000);
  EXPECT_LT(lower, -1000) << "the lower block is pressed down";
  EXPECT_LT(difference,
            1e-9 * largest); // two starts of one projection: roundings, times stiffness over force
  EXPECT_LT(length(total), 1e-9 * largest);
}

INSTANTIATE_TEST_SUITE_P(PointsAndCoordinates, DeckAbaqus,
                         testing::Values(std::tuple{2, "xy", 100}, std::tuple{0, "xy", 400},
                                         std::tuple{3, "", 700}));

} // namespace
} // namespace adapters::deck_abaqus_test
