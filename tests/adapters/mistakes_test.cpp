// SPDX-License-Identifier: BSD-3-Clause
// Mistakes in deck and model, in every host: the job ends by the host's own way of ending, the user reads
// what to write where, and nothing crashes. Each runs in a process of its own, for CalculiX ends its process.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "abaqus_services.hpp"
#include "hosts.hpp"
#include "problem.hpp"

namespace adapters::mistakes_test {
namespace {

constexpr int host_stopped = 77, nothing_wrong = 78; // exit statuses of our own

struct Ending {
  int status = -1;  ///< of the process; -1: a signal
  std::string text; ///< all that the user can read
};

/// Set up the job, and one iteration of all elements.
Ending run(const HostKind& kind, const Elements& elements, const std::vector<double>& displacement) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("pipe");
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    int status = nothing_wrong;
    abaqus_messages();
    try {
      const auto host = kind.make(elements);
      host->begin(std::vector<double>(displacement.size()));
      for (int k = 0; k < static_cast<int>(elements.nodes.size()); ++k) host->evaluate(k, displacement);
    } catch (const HostStopped& stop) {
      std::printf("%s\n", stop.what());
      status = host_stopped;
    } catch (const std::exception& error) {
      std::printf("the emulated host says: %s\n", error.what());
      status = 1;
    }
    for (const AbaqusMessage& message : abaqus_messages()) std::printf("%s\n", message.text.c_str());
    std::fflush(stdout);
    _exit(status);
  }
  close(ends[1]);
  Ending ending;
  std::array<char, 4096> part;
  for (ssize_t size; (size = read(ends[0], part.data(), part.size())) > 0;)
    ending.text.append(part.data(), static_cast<std::size_t>(size));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) ending.status = WEXITSTATUS(status);
  return ending;
}

/// How a host calls what a user can get wrong; null: its user cannot.
struct Words {
  const char *host, *nodes, *history, *area;
  int options = 57; ///< that it has, a sum
  const char* heat =
      "this host's elements carry displacements alone. Remove \"heat\""; ///< what it lacks for it
};
constexpr Words words[] = {
    {"abaqus", "*USER ELEMENT, NODES=5", "*USER ELEMENT, VARIABLES=", "*UEL PROPERTY, entry 2", 63,
     "15 degrees of freedom at 5 nodes. Write the degrees of freedom 1, 2, 3, 11"},
    {"abaqus_explicit", "*USER ELEMENT, NODES=5", "*USER ELEMENT, VARIABLES=", "*UEL PROPERTY, entry 2", 61},
    {"calculix", "*USER ELEMENT, NODES=5", "*DEPVAR ", "*USER SECTION, CONSTANTS=3, entry 2", 57,
     "This step has no temperatures: write *HEAT TRANSFER or *COUPLED TEMPERATURE-DISPLACEMENT"},
    {"opensees", "with nodes: 5", nullptr, "element entsContact, property 2"},
    {"opensees_frame", "with nodes: 5", nullptr, "element entsContact, property 2"},
    {"feap", "nodes of the elements: 5", nullptr, "MATErial, user 7, entry 2"},
    {"ansys", "USRELEM, NNODES=5", "USRELEM, NSAVEVARS=", "real constant R, entry 2"},
    {"marc", "nodes of the element: 5", "STATE VARS, number: ", "EGEOM2", 63},
    {"lsdyna", nullptr, "*SECTION_SOLID, NHSV=", "*SECTION_SOLID, entry 2"}, // always a solid of eight nodes
};

class Mistakes : public testing::TestWithParam<HostKind> {
protected:
  void SetUp() override {
    const auto write = [](const char* file, const char* text) { std::ofstream(file) << text; };
    write("ents_941.json", "{\"segment\": \"quad4\",");
    write("ents_942.json", R"({"segment": "quad4", "hight": null})");
    write("ents_943.json", R"({"segment": "quad4"})");
    write("ents_944.json",
          R"({"segment": "catmull_rom16", "contact": {"normal": {"type": "penalty", "stiffness": 400}}})");
    write("ents_945.json",
          R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 400}}})");
    write("ents_946.json",
          R"({"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": 400}}})");
    write("ents_946.txt", "1 0.5\n1 0.6\n");
  }
  const Words& own() const {
    return *std::find_if(std::begin(words), std::end(words),
                         [](const Words& w) { return GetParam().name == w.host; });
  }
  /// @param expected  two things that the user reads
  void expect(const char* mistake, const std::function<void(Elements&)>& make, const std::string& expected,
              const std::string& advice = "") {
    SCOPED_TRACE(mistake);
    Elements elements = problem_.elements;
    make(elements);
    const Ending ending = run(GetParam(), elements, pressed(problem_));
    EXPECT_EQ(ending.status, GetParam().name == "calculix" ? 201 : host_stopped) << ending.text;
    EXPECT_NE(ending.text.find("ents"), std::string::npos) << ending.text;
    EXPECT_NE(ending.text.find(expected), std::string::npos) << ending.text;
    EXPECT_NE(ending.text.find(advice), std::string::npos) << ending.text;
  }

  const Problem problem_ = problem("quad4_friction");
};

TEST_P(Mistakes, NoneIsNoMistake) {
  EXPECT_EQ(run(GetParam(), problem_.elements, pressed(problem_)).status, nothing_wrong);
}

TEST_P(Mistakes, AreasInTheTableAreNone) {
  if (GetParam().name == "lsdyna") return; // it does not tell the element's number
  const Problem p = problem("quad4_friction");
  std::ofstream("ents_947.json") << std::ifstream("ents_14.json").rdbuf();
  std::ofstream table("ents_947.txt");
  for (const int first : {1, 100, 7000, 90001}) // numbers that the emulated hosts give
    for (int k = 0; k < 9; ++k) table << first + k << " 0.4\n";
  for (int b = 0; b < 136; ++b) table << 500001 + b << " 0.4\n"; // others in a block of Abaqus/Explicit
  table.close();
  Elements in_table = p.elements, in_deck = p.elements;
  in_table.model = 947, in_table.area.assign(9, 0), in_deck.area.assign(9, 0.4);
  const auto a = GetParam().make(in_table), b = GetParam().make(in_deck);
  const std::vector<double> u = pressed(p), start(u.size());
  a->begin(start), b->begin(start);
  for (int k = 0; k < 9; ++k) EXPECT_EQ(a->evaluate(k, u).residual, b->evaluate(k, u).residual);
}

TEST_P(Mistakes, EndTheJobWithAdvice) {
  const auto model = [](int number) { return [number](Elements& e) { e.model = number; }; };
  const auto area = [](double value) {
    return [value](Elements& e) { e.area.assign(e.area.size(), value); };
  };
  expect("no such file", model(940), "ents_940.json");
  expect("no JSON", model(941), "ents_941.json");
  expect("a key that is none", model(942), "ents_942.json", "hight");
  expect(
      "no contact law", [](Elements& e) { e.model = 943, e.symmetric = true; }, "ents_943.json", "contact");
  expect("model number 0", model(0), "write the model's number k");
  expect("model number too large", model(1234567), "1 .. 9999");
  expect("area < 0", area(-1), own().area, "tributary area");
  expect("area not a number", area(std::nan("")), own().area, "tributary area");
  if (GetParam().name != "lsdyna") { // it does not tell the element's number
    expect(
        "two lines for an element", [](Elements& e) { e.model = 946, e.area.assign(e.area.size(), 0); },
        "two lines for element 1");
    expect(
        "no table", [](Elements& e) { e.area.assign(e.area.size(), 0); }, "ents_14.txt", "ELEMENT AREA");
  }
}

TEST_P(Mistakes, OptionsThatMeanNothingAreRefused) {
  const auto option = [](int value) { return [value](Elements& e) { e.options = value; }; };
  const std::string area = own().area, property = area.substr(0, area.size() - 1) + "3 is ";
  for (const int value : {1, 2, 3, 4, 5, 6, 7, 16, 17, 32, 33, 64, 65, -1}) {
    if (value > 0 && (value & ~own().options) == 0) {
      Elements elements = problem_.elements;
      elements.options = value;
      const Ending ending = run(GetParam(), elements, pressed(problem_));
      EXPECT_EQ(ending.text.find("here 1"), std::string::npos) << ending.text;
    } else {
      expect("option", option(value), property + std::to_string(value), "here 1");
    }
  }
  expect("a slave point without weights", option(8), area.substr(0, area.size() - 1) + "4",
         "number of the slave's nodes");
}

TEST_P(Mistakes, AnAreaOfNothingIsRefusedWhereThereIsNoTable) {
  if (GetParam().name != "lsdyna") return;
  const auto area = [](double value) {
    return [value](Elements& e) { e.area.assign(e.area.size(), value); };
  };
  for (const double value : {0.0, -1.0}) {
    Elements elements = problem_.elements;
    area(value)(elements);
    EXPECT_EQ(run(GetParam(), elements, pressed(problem_)).text.find(".txt"), std::string::npos) << value;
    expect("area", area(value), own().area, "write the tributary area of the slave node");
  }
  expect("area 0", area(0), "there is no table");
}

TEST_P(Mistakes, MultipliersWhereThereIsNoPlaceForThemAreRefused) {
  if (GetParam().multipliers) return;
  const auto with = [](const char* name) {
    const int model = problem(name).elements.model;
    return [model](Elements& e) {
      e.model = model;
      for (auto& nodes : e.nodes) nodes.push_back(nodes.back()); // the node that they would have
    };
  };
  for (const char* name : {"quad4_multiplier", "quad4_friction_multiplier"})
    expect(name, with(name), "multipliers as unknowns", "\"augmented\"");
}

// A temperature per node is an unknown that the elements of most hosts cannot have.
TEST_P(Mistakes, HeatWithoutTemperaturesIsRefused) {
  std::ofstream("ents_948.json") << R"({"segment": "quad4", "contact": {"normal": {"type": "penalty",
    "stiffness": 400}, "heat": {"conductance": 3}}})";
  expect(
      "heat", [](Elements& e) { e.model = 948; }, "ents_948.json has \"heat\", which takes a temperature",
      own().heat);
}

TEST_P(Mistakes, InTheNumberOfNodesNameTheRightOne) {
  expect(
      "a model with more nodes", [](Elements& e) { e.model = 944; }, "ents_944.json");
  if (own().nodes == nullptr) return;
  const auto cut = [](Elements& e) {
    for (auto& nodes : e.nodes) nodes.pop_back();
  };
  expect("a node missing", cut, own().nodes, "needs 5 nodes");
  if (GetParam().name == "marc") return; // its elements may have spare nodes
  const auto add = [](Elements& e) {
    for (auto& nodes : e.nodes) nodes.push_back(nodes.back());
  };
  expect("a node too many", add, own().nodes, "the element has 6");
  expect(
      "a model in 2D", [](Elements& e) { e.model = 945; }, "ents_945.json", "needs 3 nodes");
}

TEST_P(Mistakes, InTheHistoryNameItsSize) {
  const std::string size = std::to_string(problem_.elements.state_size);
  // Emulated hosts have up to two history variables more than needed.
  if (own().history != nullptr)
    expect(
        "too little", [](Elements& e) { e.state_size -= 3; }, own().history + size,
        "needs " + size + " history variables");
}

INSTANTIATE_TEST_SUITE_P(Adapters, Mistakes, testing::ValuesIn(hosts()),
                         [](const auto& test) { return test.param.name; });

} // namespace
} // namespace adapters::mistakes_test
