// SPDX-License-Identifier: BSD-3-Clause
// Scenes that cannot be solved, through ents-lab: what is too large, what is no scene, what nothing holds,
// maps that cover too little.
#include <functional>

#include "check_extent.hpp"
#include "program_fixture.hpp"

namespace host::test::program_mistakes_test {
namespace {

// Asked before the mesh is made: later there is no more than "bad_alloc", or the operating system ends the
// program.
TEST_F(Program, AMeshThatDoesNotFitIsRefusedByItsKey) {
  Json json = small();
  for (const char* axis : {"x", "y"})
    json["parts"][0][axis]["pieces"] = {{{"to", *axis == 'x' ? 10 : 0}, {"divisions", 100000}}};
  expect(ents_host("run " + write("large.json", json)), 2,
         {"large.json: /parts/0: /x, /y: 100000 x 100000 divisions", "GB of memory"});
  Json solid = parse_json_file(fs::path(EXAMPLES) / "hertz3d" / "scene.json");
  expect(ents_host("run " + write("solid.json", solid) + " --explicit 100000"), 2,
         {"--explicit", "100000 x 100000 segments need at least"});
  // The shell's limit: refused by the key where the mesh alone is too large, else told when memory is used
  // up.
  for (Json& piece : json["parts"][0]["x"]["pieces"]) piece["divisions"] = 300;
  for (Json& piece : json["parts"][0]["y"]["pieces"]) piece["divisions"] = 300;
  const std::string scene = write("middle.json", json);
  int refused = 0, used_up = 0;
  for (const int megabytes : {50, 80, 120, 180, 240}) {
    const ProgramOutput output = run_in_shell("ulimit -v " + std::to_string(megabytes * 1024) +
                                              "; exec \"" ENTS_HOST "\" run " + scene);
    if (output.text.find("shared object") != std::string::npos) continue; // not even the program fits
    refused += output.exit_code == 2;
    used_up += output.exit_code == 1;
    EXPECT_NE(output.text.find(output.exit_code == 2 ? "/parts/0: /x, /y: 300 x 300 divisions"
                                                     : "too large for the machine's memory"),
              std::string::npos)
        << megabytes << " MB: " << output.text;
    EXPECT_EQ(output.text.find("singular"), std::string::npos) << output.text;
  }
  EXPECT_GT(used_up, 0);
}

TEST_F(Program, WhatIsNoSceneIsRefusedBeforeItFillsTheMemory) {
  expect(ents_host("run /dev/zero"), 2, {"/dev/zero: this is a device; name a file"});
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "{\"of\":[";
  Json json = small();
  json["contact"]["model"]["height"] = "deep";
  std::string text = json.dump();
  text.replace(text.find("\"deep\""), 6, deep);
  expect(ents_host("run " + write_text("deep.json", text)), 2,
         {"deep.json: objects and arrays lie more than 100 levels deep"});
  expect(ents_host("run " + write("small.json", small()) + " --restart " +
                   write_text("checkpoint.json", "{\"displacement\":" + std::string(100000, '[') + "0")),
         2, {"checkpoint.json: objects and arrays lie more than 100 levels deep"});
}

TEST_F(Program, MistakesInFilesAreNamed) {
  Json json = small();
  json["variants"] = {{"a", {{"solvr", Json::object()}}}};
  const std::string scene = write("badvar.json", json);
  for (const std::string& command : {"run " + scene, "variants " + scene, "run " + scene + " --variant a"})
    expect(ents_host(command), 2, {"badvar.json: /variants/a: unknown key \"solvr\""});
  json = small();
  json["parts"][0] = {{"name", "block"}, {"material", "block"}, {"deck", "nope.inp"}};
  json.erase("variants");
  expect(ents_host("run " + write("scene.json", json)), 2,
         {"scene.json: /parts/0/deck: ", "nope.inp: cannot be read"});
  expect(ents_host("run " + path("")), 2, {"this is a folder"});
  const std::string model = write("model.json", {{"segment", "line2"}});
  expect(ents_host("check " + model + " --mesh " + write_text("empty.inp", "")), 2,
         {"empty.inp: no mesh; expected *NODE"});
  expect(ents_host("check " + model + " --mesh " +
                   write_text("typo.inp", "*NOED\n1, 0, 0\n2, 1, 0\n*ELEMENT, TYPE=T2D2\n1, 1, 2\n")),
         2,
         {"typo.inp:5: node 1 is not defined in this deck, which has no *NODE; it begins with *NOED (",
          "typo.inp:1)"});
}

TEST_F(Program, ABodyThatNothingHoldsAndAMasterThatFacesAwayAreTold) {
  Json json = small();
  json["supports"] = Json::array();
  expect(ents_host("run " + write("scene.json", json)), 2, {"/supports: nothing holds the bodies"});
  json = small();
  json["contact"]["master"]["nodes"] = {{-1, 0.05}, {1, 0.05}};
  expect(ents_host("run " + write("scene.json", json)), 1, {"no slave node", "order of its nodes"});
  json = small();
  json["contact"]["master"]["direction"] = {0, 1};
  expect(ents_host("run " + write("scene.json", json)), 1, {"no slave node", "direction"});
  json["steps"] = {{"control", "approach"}, {"values", {0.0005}}}; // solved, for nothing is in the way
  expect(ents_host("run " + write("scene.json", json)), 0,
         {"no slave node was in contact", "order of its nodes"});
  json["contact"]["master"]["direction"] = {0, -1};
  const ProgramOutput good = ents_host("run " + write("scene.json", json));
  expect(good, 0, {});
  EXPECT_EQ(good.text.find("no slave node"), std::string::npos) << good.text;
}

// Without "length_unit" a map covers a small part of the segment: ents-lab warns before the run, whose
// result looks like that of a master with reversed normals.
TEST_F(Program, AMapThatCoversLessThanTheSegmentsIsAWarning) {
  write_text("profile.txt", "# Channel: z\n# Width: 4 mm\n# Height: 1 mm\n# Value units: m\n"
                            "1e-5 2e-5 3e-5 4e-5 5e-5 4e-5 3e-5 2e-5 1e-5 1e-5\n");
  const auto scene = [&](const Json& more) {
    Json json = small();
    json["contact"]["model"]["height"] = {
        {"type", "map"}, {"file", "profile.txt"}, {"boundary", "clamped"}, {"origin", {-1.5}}};
    json["contact"]["model"]["height"].update(more);
    json.erase("exact");
    json["steps"] = {{"control", "approach"}, {"values", {1e-4}}};
    return write("scene.json", json);
  };
  const std::string warning =
                        "ents-lab: warning: the map /contact/model/height covers only a part of the segments",
                    good = scene({{"length_unit", 1e-3}});
  for (const char* more : {"", " --explicit 8", " --compare 4,8"}) {
    const ProgramOutput fine = ents_host("run " + good + more);
    EXPECT_EQ(fine.text.find(warning), std::string::npos) << fine.text;
  }
  const std::string bad = scene(Json::object());
  for (const char* more : {"", " --explicit 8", " --compare 4,8", " --json"}) {
    const ProgramOutput output = ents_host("run " + bad + more);
    EXPECT_NE(output.text.find(warning), std::string::npos) << output.text;
    EXPECT_LT(output.text.find(warning), output.text.find("step 1"))
        << output.text; // before anything is solved
  }
  const ProgramOutput json = ents_host("run " + bad + " --json 2>/dev/null; exit $?; :");
  EXPECT_TRUE(Json::accept(json.text)) << json.text;
}

// Of a master that deforms the faces say where the segments lie; the outer nodes of smoothed ones are its
// neighbours'.
TEST_F(Program, AMapIsHeldAgainstTheSurfaceCoordinatesOfTheSegments) {
  Json text = small();
  text["contact"]["model"]["segment"] = "catmull_rom4";
  text["contact"]["model"].erase("surface_coordinates");
  text["contact"]["model"]["height"] = {
      {"type", "map"}, {"values", {0, 1e-3, 0}}, {"boundary", "clamped"}, {"size", {1}}};
  const Scene scene = read_scene_text(text.dump(), folder_ / "scene.json");
  const auto said = [&](const std::vector<double>& of_segments) {
    testing::internal::CaptureStderr();
    note_small_maps(scene, of_segments);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said({-1, 0, 0.5, 1, 0, 0.5, 1, 2}), "");
  EXPECT_NE(said({-1, 0, 0.5, 1, 0, 0.5, 1.1, 2}).find("warning: the map /contact/model/height"),
            std::string::npos);
  EXPECT_NE(said({}).find("warning: the map /contact/model/height"), std::string::npos); // s = xi: -1 .. 1
}

} // namespace
} // namespace host::test::program_mistakes_test
