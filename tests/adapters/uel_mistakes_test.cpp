// SPDX-License-Identifier: BSD-3-Clause
// Mistakes in the deck of a user element reach the user through Abaqus's own channel.
#include <filesystem>
#include <fstream>
#include <functional>

#include "uel_fixture.hpp"

namespace adapters::uel_mistakes_test {
namespace {

struct Mistake {
  const char* name;
  std::function<void(UelCall&)> make;
  const char* expected; ///< what the message says
};

TEST_F(Uel, MistakesInTheDeckStopTheJobWithAdvice) {
  const auto write = [](const char* file, const char* text) { std::ofstream(file) << text; };
  write("ents_41.json", "{\"segment\": \"quad4\",");
  write("ents_42.json", R"({"segment": "quad4", "hight": null})");
  write("ents_43.json", R"({"segment": "quad4"})");
  const char* good = R"({"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": 400}}})";
  for (const char* file : {"ents_44.json", "ents_45.json", "ents_46.json", "ents_47.json", "ents_48.json",
                           "ents_49.json", "ents_50.json"})
    write(file, good);
  write("ents_44.txt", "90001 0.5\n90002 0.5 much\n");
  write("ents_45.txt", "90001 0.5 1 2 3\n");
  write("ents_46.txt", "90001 0.5\n90001 0.6\n");
  write("ents_47.txt", "90002 0.5\n");
  write("ents_48.txt", "90002 0.5\n90001 0\n");
  std::filesystem::create_directory("ents_49.txt");
  std::filesystem::remove("ents_50.txt");
  std::filesystem::create_symlink("no_such_file", "ents_50.txt");
  const Mistake mistakes[] = {
      {"no properties", [](UelCall& c) { c.props = {}; }, "write *UEL PROPERTY, entry 1 and 2"},
      {"no file",
       [](UelCall& c) {
         c.props = {40, 0.5};
       },
       "ents_40.json"},
      {"not a number k",
       [](UelCall& c) {
         c.props = {1.5, 0.5};
       },
       "*UEL PROPERTY, entry 1"},
      {"k not a number",
       [](UelCall& c) {
         c.props = {std::nan(""), 0.5};
       },
       "*UEL PROPERTY, entry 1"},
      {"k too large",
       [](UelCall& c) {
         c.props = {1e300, 0.5};
       },
       "1 .. 9999"},
      {"negative area", [](UelCall& c) { c.props[1] = -1; }, "*UEL PROPERTY, entry 2"},
      {"area not a number", [](UelCall& c) { c.props[1] = std::nan(""); }, "*UEL PROPERTY, entry 2"},
      {"no such option", [](UelCall& c) { c.props.push_back(1000); }, "*UEL PROPERTY, entry 3"},
      {"JSON",
       [](UelCall& c) {
         c.props = {41, 0.5};
       },
       "ents_41.json"},
      {"key",
       [](UelCall& c) {
         c.props = {42, 0.5};
       },
       "hight"},
      {"no law",
       [](UelCall& c) {
         c.props = {43, 0.5};
       },
       "contact"},
      {"word in the table",
       [](UelCall& c) {
         c.props = {44, 0};
       },
       "ents_44.txt, line 2"},
      {"length of a line",
       [](UelCall& c) {
         c.props = {45, 0};
       },
       "8 surface coordinates"},
      {"element twice",
       [](UelCall& c) {
         c.props = {46, 0};
       },
       "two lines for element 90001"},
      {"element missing",
       [](UelCall& c) {
         c.props = {47, 0};
       },
       "ents_47.txt"},
      {"element missing, of a part",
       [](UelCall& c) {
         c.props = {47, 0};
       },
       "With *PART or *INSTANCE"},
      {"area 0 in the table",
       [](UelCall& c) {
         c.props = {48, 0};
       },
       "ents_48.txt, line 2: the area is 0; write"},
      {"the table is a folder", [](UelCall& c) { c.props[0] = 49; }, "ents_49.txt is not a file"},
      {"the table is a link to nothing", [](UelCall& c) { c.props[0] = 50; }, "ents_50.txt is not a file"},
      {"a surface coordinate missing", [](UelCall& c) { c.props = {14, 0.5, 0, 0, 0, 3, 0, 3, 2, 1}; },
       "*UEL PROPERTY, entry 4 and the following are 7 surface coordinates, "},
      {"half of them", [](UelCall& c) { c.props = {14, 0.5, 0, 0, 3, 3, 0}; },
       "ents_14.json needs 8, 2 for each of its 4 master nodes. Write 11 properties, or 3"},
      {"two too many", [](UelCall& c) { c.props = {14, 0.5, 0, 0, 0, 3, 0, 3, 2, 0, 2, 0, 5, 0}; },
       "are 10 surface coordinates"},
      {"surface coordinate", [](UelCall& c) { c.props = {14, 0.5, 0, 0, 0, 3, 0, 3, std::nan(""), 0, 2}; },
       "entry 9"},
      {"too few nodes", [](UelCall& c) { c.nnode = 4, c.ndofel = 12; }, "Write *USER ELEMENT, NODES=5"},
      {"too many nodes", [](UelCall& c) { c.props[0] = 15; }, "Write *USER ELEMENT, NODES=4"},
      {"plane element", [](UelCall& c) { c.ndofel = 10, c.mcrd = 2; }, "3D"},
      {"too few SVARS", [](UelCall& c) { c.nsvars = 1; }, "Write *USER ELEMENT, VARIABLES="},
      {"multipliers without a node", [](UelCall& c) { c.props[0] = 16; }, "NODES=6"},
  };
  problem("tri3_friction"), problem("quad4_multiplier"); // write their models
  for (const Mistake& mistake : mistakes) {
    UelCall c = request(1);
    mistake.make(c);
    EXPECT_THROW(c(), HostStopped) << mistake.name;
    const std::string text = only_message(-2);
    EXPECT_NE(text.find(mistake.expected), std::string::npos) << mistake.name << ": " << text;
    EXPECT_NE(text.find("90001"), std::string::npos) << text;
  }
}

} // namespace
} // namespace adapters::uel_mistakes_test
