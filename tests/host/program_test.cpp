// SPDX-License-Identifier: BSD-3-Clause
// ents-lab as typed in a shell: it names a mistake before hours of work are lost.
#include <gtest/gtest.h>

#include "advice.hpp"
#include "program_fixture.hpp"

namespace host::test::program_test {
namespace {

TEST_F(Program, NamesACommandItDoesNotKnow) {
  expect(ents_host("rum scene.json"), 2, {"\"rum\" is not a command; write run"});
  expect(ents_host("--foo"), 2, {"\"--foo\"", "run, variants, sublaw, verify"});
  expect(ents_host(""), 2, {"a command is missing", "run, variants, sublaw, verify"});
  expect(ents_host("--help"), 0, {"Exit codes", "variants"});
}

TEST_F(Program, NamesAnOptionItDoesNotKnowAndTheOneThatWasMeant) {
  const std::string scene = write("small.json", small()), model = write("model.json", {{"segment", "line2"}});
  expect(ents_host("run " + scene + " --outt x"), 2,
         {"ents-lab run: unknown option --outt; did you mean --out?\n"});
  expect(ents_host("run --no-picture=1 " + scene), 2,
         {"ents-lab run: unknown option --no-picture; did you mean --no-pictures?\n"});
  expect(ents_host("run --helpp"), 2, {"ents-lab run: unknown option --helpp; did you mean --help?\n"});
  expect(ents_host("check " + model + " --colour red"), 2,
         {"ents-lab check: unknown option --colour\n", "ents-lab check --help"});
  expect(ents_host("run " + scene + " other.json more.json"), 2,
         {"ents-lab run: unexpected argument \"other.json\"\n"});
  expect(ents_host("run"), 2, {"ents-lab run: scene is required"});
}

TEST_F(Program, HelpOfACommandBeginsWithItsNameAndSaysWhatItTells) {
  expect(ents_host("--help"), 0, {"Usage: ents-lab [OPTIONS] SUBCOMMAND\n"});
  expect(ents_host("run --help"), 0,
         {"Usage: ents-lab run [OPTIONS] scene\n", "dimension, formulation (2D), materials, parts and steps",
          "abi/model.schema.json", "tangential over normal force is mu / (1 - kappa |g|)",
          "checkpoint_before.json"});
  const ProgramOutput verify = ents_host("verify --help"), variants = ents_host("variants --help");
  expect(verify, 0,
         {"Usage: ents-lab verify [OPTIONS] files...\n",
          "Columns: worst relative error of each quantity, gaps relative to the segment's size; exit 1 above "
          "--tolerance"});
  expect(variants, 0,
         {"Usage: ents-lab variants [OPTIONS] scene\n", "The first row, \"as it is\", is the scene",
          "Columns: "});
  for (const ProgramOutput& output : {verify, variants})
    EXPECT_EQ(output.text.find("ents-lab chart"), std::string::npos) << output.text;
}

// The scripts answer by their own names, before they do anything.
TEST_F(Program, ScriptsNameOptionsThatAreWrong) {
  const auto script = [](const std::string& command) {
    return run_in_shell("sh \"" EXAMPLES "/../" + command);
  };
  for (const char* options : {"--target", "-DA=1 --target ents", "--target -DA=1"})
    expect(script(std::string("examples/setup.sh\" ") + options), 2,
           {"setup.sh: --target needs a NAME and stands before -D..."});
  expect(script("examples/setup.sh\" --configuration foo"), 2,
         {"setup.sh: there is no configuration 'foo'; write one of: asan dev native quick release"});
  expect(script("examples/setup.sh\" --configuration"), 2, {"setup.sh: --configuration needs a NAME"});
  expect(script("examples/setup.sh\" --with"), 2, {"setup.sh: --with needs a PACKAGE"});
  for (const char* options : {"--foo", "-DA=1 --foo", "foo"}) {
    const ProgramOutput output = script(std::string("tests/run.sh\" ") + options);
    expect(output, 2, {"run.sh: unknown option ", "usage: sh tests/run.sh"});
    EXPECT_EQ(output.text.find("setup.sh: unknown"), std::string::npos) << output.text;
  }
}

// ents-lab names an --out that is no folder before it computes: at the end of a long run it would be too
// late.
TEST_F(Program, AnOutputFolderThatCannotBeIsToldFirst) {
  const std::string scene = write("small.json", small()), file = write_text("afile", "");
  const std::string model = write("model.json", {{"segment", "line2"}});
  for (const std::string& command :
       {"run " + scene, "run " + scene + " --compare 3,6", "check " + model, std::string("chart")}) {
    const ProgramOutput output = ents_host(command + " --out " + file);
    expect(output, 2, {"--out", "afile is a file; name a folder"});
    EXPECT_EQ(output.text.find("enriched segment"), std::string::npos) << output.text; // nothing was computed
    EXPECT_EQ(output.text.find("step 1"), std::string::npos) << output.text;
  }
  expect(ents_host("run " + scene + " --out --json"), 2, {"--out", "--json is no name of a folder"});
  EXPECT_FALSE(fs::exists("--json"));
}

TEST_F(Program, AFailedStepLeavesWhatWasSolvedBefore) {
  const std::string scene = write("scene.json", failing()), out = " --no-pictures --out " + path("out");
  write("whole.json", small());
  ASSERT_EQ(ents_host("run " + path("whole.json") + out).exit_code, 0); // an older run in the same folder
  EXPECT_EQ(read("out/result.json").at("failure"), nullptr);
  expect(ents_host("run " + scene + out), 1,
         {"mean pressure", "FAILED at step 3 of 3", "step 3 cannot be solved"});
  const Json result = read("out/result.json");
  EXPECT_EQ(result.at("steps").size(), 2u);
  EXPECT_EQ(result.at("failure").at("step"), 3);
  EXPECT_NE(result.at("failure").at("reason").get<std::string>().find("penetration"), std::string::npos);
  EXPECT_EQ(read("out/checkpoint.json").at("step"), 2);
  // also on stdout; and where a part of the third step was taken before the next one failed, the state is
  // still that after the second
  Json partly = failing();
  partly["steps"]["values"][2] = 0.2;
  const std::string command = "run " + write("partly.json", partly) + " --json --cut random --seed 12";
  const ProgramOutput output = ents_host(command + " 2>/dev/null; exit $?; :");
  EXPECT_EQ(output.exit_code, 1);
  const Json told = Json::parse(output.text);
  EXPECT_EQ(told.at("steps").size(), 2u);
  const Json before = Json::parse(ents_host(command + " --last-step 2").text);
  EXPECT_EQ(told.at("fingerprint"), before.at("fingerprint"));
  // nothing solved: files of the older run must not look like this one's
  Json hopeless = failing();
  hopeless["steps"]["values"] = {0.05};
  expect(ents_host("run " + write("scene.json", hopeless) + out), 1,
         {"FAILED at step 1 of 1", "nothing is solved"});
  EXPECT_EQ(read("out/result.json").at("steps").size(), 0u);
  EXPECT_FALSE(fs::exists(folder_ / "out" / "result.pvd"));
  EXPECT_FALSE(fs::exists(folder_ / "out" / "checkpoint.json"));
}

TEST_F(Program, ARestartKeepsTheStepsBefore) {
  const std::string out = " --no-pictures --out " + path("out"),
                    restart = " --restart " + path("out/checkpoint.json");
  const std::string scene = write("scene.json", three());
  ASSERT_EQ(ents_host("run " + scene + out + " --last-step 1").exit_code, 0);
  fs::copy(folder_ / "out", folder_ / "kept");
  expect(ents_host("run " + scene + out + restart), 0, {});
  const Json result = read("out/result.json");
  ASSERT_EQ(result.at("steps").size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(result.at("steps")[static_cast<std::size_t>(i)].at("step"), i + 1);
  EXPECT_EQ(result.at("restarted_after"), 1);
  const Json whole = Json::parse(ents_host("run " + scene + " --json").text);
  EXPECT_EQ(result.at("fingerprint"), whole.at("fingerprint"));
  for (const char* file : {"result_bulk_0001.vtu", "result_bulk_0002.vtu", "result_bulk_0003.vtu"})
    EXPECT_NE(text("out/result.pvd").find(file), std::string::npos) << file;
  // elsewhere: the later steps alone
  ASSERT_EQ(ents_host("run " + scene + " --no-pictures --out " + path("other") + " --restart " +
                      path("kept/checkpoint.json"))
                .exit_code,
            0);
  EXPECT_EQ(read("other/result.json").at("steps").size(), 2u);
  expect(ents_host("run " + scene + restart), 2, {"the run is finished"});
}

// What a user changes after a failure is taken; another scene is not.
TEST_F(Program, ACheckpointOfAnotherSceneIsRefused) {
  const std::string scene = write("scene.json", three()),
                    restart = " --restart " + path("out/checkpoint.json");
  ASSERT_EQ(ents_host("run " + scene + " --last-step 2 --no-pictures --out " + path("out")).exit_code, 0);
  const auto go_on = [&](const std::function<void(Json&)>& edit) {
    Json json = three();
    edit(json);
    return ents_host("run " + write("changed.json", json) + restart);
  };
  expect(go_on([](Json& j) { j["materials"]["block"]["young"] = 5000; }), 2,
         {"checkpoint.json", "/materials/block/young is 1000 there and 5000 here"});
  expect(go_on([](Json& j) { j["contact"]["model"]["height"]["coefficients"][2] = -0.06; }), 2,
         {"/contact/model/height/coefficients/2 is -0.05 there and -0.06 here"});
  expect(go_on([](Json& j) { j["thickness"] = 2; }), 2, {"/thickness is not there and 2 here"});
  expect(go_on([](Json& j) {
           j["steps"]["values"] = {0.25, 0.6, 0.75};
         }),
         2, {"/steps/values: step 2 is 0.5000 there and 0.6000"});
  expect(go_on([](Json& j) { j["steps"]["values"] = {0.25}; }), 2, {"after step 2, the scene has 1"});
  expect(ents_host("run " + scene + " --explicit 8" + restart), 2, {"another master surface"});
  expect(go_on([](Json& j) { j["steps"]["values"] = {0.25, 0.5, 0.6, 0.7, 0.75}; }), 0, {"step 5/5"});
  expect(go_on([](Json& j) {
           j["solver"] = {{"max_iterations", 50}, {"min_step", 1e-4}};
           j["contact"]["model"]["penetration_limit"] = 0.1;
           j["contact"]["model"]["tangent"] = "small_gap";
           j["title"] = "again";
           j.erase("compare");
         }),
         0, {"step 3/3"});
  expect(ents_host("run " + scene + " --restart " + scene), 2,
         {"this is no checkpoint", "checkpoint.json that a run leaves"});
}

// Files on a full disk: the table all the same, then what could not be written.
TEST_F(Program, AFileThatCannotBeWrittenDoesNotCostTheTable) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full, the file of Linux that is always full";
  const std::string scene = write("small.json", small());
  for (const char* file : {"result.json", "result.pvd", "checkpoint.json"}) {
    const fs::path out = folder_ / (std::string("full_") + file);
    fs::create_directories(out);
    fs::create_symlink("/dev/full", out / file);
    const ProgramOutput output = ents_host("run " + scene + " --no-pictures --out " + quoted(out));
    expect(output, 1, {"mean pressure", "wall time", std::string(file) + ": cannot be written"});
    EXPECT_LT(output.text.find("mean pressure"), output.text.rfind("cannot be written"));
  }
}

TEST_F(Program, AnAnswerThatCannotBeWrittenIsAFailure) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full, the file of Linux that is always full";
  const std::string scene = write("small.json", small()), model = write("model.json", {{"segment", "line2"}});
  for (const std::string& command :
       {"run " + scene, "run " + scene + " --json", "check " + model, std::string("--help")})
    expect(ents_host(command + " >/dev/full 2>" + path("errors") + "; code=$?; cat " + path("errors") +
                     "; exit $code; :"),
           1, {"stdout cannot be written"});
}

TEST_F(Program, NumbersOfOptionsAreNamedWithWhatIsWanted) {
  const std::string scene = write("small.json", small()), model = write("model.json", {{"segment", "line2"}});
  for (const char* value : {"-1", "inf", "nan", "0", "x"})
    expect(ents_host("check " + model + " --reach " + value), 2,
           {"--reach: a number > 0 is expected, this is \"" + std::string(value) + "\""});
  for (const char* value : {"0", "1.5", "99999999999"})
    expect(ents_host("run " + scene + " --last-step " + value), 2,
           {"--last-step: an integer from 1 to 1000000 is expected"});
  expect(ents_host("run " + scene + " --cut random --seed -1"), 2, {"--seed: an integer from 0"});
  expect(ents_host("run " + scene + " --compare 3,0"), 2, {"--compare: integers from 1 to 100000"});
}

TEST_F(Program, OptionsWithoutEffectSaySo) {
  const std::string scene = write("small.json", small());
  expect(ents_host("run " + scene + " --last-step 99"), 0, {"--last-step 99: the scene has 1 step"});
  expect(ents_host("run " + scene + " --seed 5"), 0, {"--seed 5 has no effect: only --cut random"});
  Json plain = small();
  plain.erase("variants");
  expect(ents_host("variants " + write("plain.json", plain)), 2, {"plain.json", "no key \"variants\""});
}

TEST_F(Program, CompareLeavesTheSceneItsPlace) {
  Json json = small();
  json["compare"] = {{"divisions", {3, 6}}, {"error", 0.5}};
  const std::string scene = write("small.json", json);
  expect(ents_host("run --compare " + scene), 0, {"explicit 3", "explicit 6", "with order"});
  expect(ents_host("run --compare 4,8 " + scene), 0,
         {"explicit 4", "explicit 8", "do not fall"}); // both have a node in the middle
  const ProgramOutput one = ents_host("run " + scene + " --compare 3");
  expect(one, 0, {"one mesh shows no order"});
  EXPECT_EQ(one.text.find("with order"), std::string::npos) << one.text;
  EXPECT_EQ(Json::parse(ents_host("run " + scene + " --compare 3 --json").text).at("order"), nullptr);
}

// With an edge in the middle all of the force lies on one node, which comes deeper than the model lets it.
TEST_F(Program, AMeshOfTheFitThatCannotBeSolvedDoesNotCostTheTable) {
  Json json = small();
  json["compare"] = {{"divisions", {3, 5}}, {"error", 0.3}};
  json["contact"]["model"]["contact"]["normal"]["stiffness"] =
      1e5; // penetrations 2e-6, 9e-6; 2.7e-5 (enriched); 5e-5 (two segments)
  json["contact"]["model"]["penetration_limit"] = 4e-5;
  const std::string command = "run --compare " + write("small.json", json);
  expect(ents_host(command), 0,
         {"explicit 3", "explicit 5", "cannot be solved, 2 segments per direction: step 1", "penetrat"});
  const Json result = Json::parse(ents_host(command + " --json").text);
  EXPECT_EQ(result.at("explicit").size(), 2u);
  EXPECT_EQ(result.at("explicit_unsolved").get<std::string>().rfind("2 segments", 0), 0u);
}

// On few slave nodes the difference scatters, and the fit may promise too much.
TEST_F(Program, EqualErrorIsOnlySaidWhereItHolds) {
  Json json = small();
  json["compare"] = {{"divisions", {23, 47, 95, 191}}, {"error", 5e-6}};
  for (const double force : {0.25, 0.5}) {
    json["steps"]["values"] = {force};
    const std::string command = "run " + write("small.json", json) + " --compare";
    const Json result = Json::parse(ents_host(command + " --json").text);
    const Json &reached = result.at("explicit_at_equal_error"), &missed = result.at("explicit_from_fit");
    ASSERT_EQ(reached.size(), force < 0.3 ? 1u : 0u);
    ASSERT_EQ(missed.size(), force < 0.3 ? 0u : 1u);
    for (const Json& row : reached) EXPECT_LT(row.at("difference").get<double>(), 1.34 * 5e-6);
    for (const Json& row : missed) EXPECT_GT(row.at("difference").get<double>(), 1.33 * 5e-6);
    const ProgramOutput text = ents_host(command);
    EXPECT_EQ(text.text.find(", equal error") != std::string::npos, !reached.empty()) << text.text;
    EXPECT_EQ(text.text.find("is not reached: the fit asks for") != std::string::npos, reached.empty())
        << text.text;
  }
}

// How Newton's iteration failed says what may help.
TEST_F(Program, AStepThatCannotBeSolvedSaysWhatMayHelp) {
  const std::string stiffness = "the contact stiffness (/contact/model/contact/normal/stiffness)";
  Json stiff = parse_json_file(fs::path(EXAMPLES) / "hertz2d" / "scene.json");
  stiff["contact"]["model"]["contact"]["normal"]["stiffness"] = 1e9;
  stiff["solver"]["min_step"] = 0.9; // one try
  expect(ents_host("run " + write("scene.json", stiff)), 0,
         {"(rounding leaves up to "}); // no tolerance is below that
  Json soft = small();
  soft["contact"]["model"]["contact"]["normal"]["stiffness"] = 1e-3;
  expect(
      ents_host("run " + write("scene.json", soft)), 1,
      {"penetration exceeds", "; take smaller steps, or see /solver/min_step, or raise " + stiffness + "\n"});
  Json chatter = parse_json_file(fs::path(EXAMPLES) / "chatter" / "scene.json");
  chatter["solver"]["line_search"] = "never";
  expect(ents_host("run " + write("scene.json", chatter)), 1,
         {"; nodes open and close in turn: see examples/chatter (power or exponential law)"});
}

TEST(Advice, IsOnlyGivenWhereThePatternIsPlain) {
  const auto advice = [](const std::vector<double>& residuals, int switches, const char* law = "penalty") {
    Json normal = {{"type", law}};
    if (std::string(law) != "exponential") normal["stiffness"] = 1;
    const std::vector<int> none(residuals.size(), 0);
    return advice_if_stuck({residuals, std::vector<int>(residuals.size(), switches), none},
                           {{"contact", {{"normal", normal}}}});
  };
  const std::vector<double> still{1, 0.1, 1.2e-8, 3e-9, 5.9e-8, 1.2e-8, 4e-9, 1.2e-8, 1.2e-8, 5.9e-8},
      in_turn{1, .5, .2, .1, .2, .1, .2, .1, .2, .1};
  EXPECT_EQ(advice(still, 0).substr(0, 40), "the residual does not fall any more: low");
  EXPECT_EQ(advice(still, 0, "exponential"), "the residual does not fall any more: raise /solver/tolerance");
  EXPECT_EQ(
      advice_if_stuck({still, std::vector<int>(still.size(), 0), std::vector<int>(still.size(), 0)}, Json()),
      "the residual does not fall any more: raise /solver/tolerance");
  EXPECT_EQ(advice(in_turn, 1).substr(0, 18), "nodes open and clo");
  EXPECT_EQ(advice(in_turn, 0), "");                // no node opens or closes
  EXPECT_EQ(advice(in_turn, 1, "exponential"), ""); // a law that begins smoothly already
  EXPECT_EQ(advice({1, 1e-9, 1e-9, 1e-9}, 0), "");  // too few to tell
  std::vector<double> slow{1e-4}, growing{1e-9}, lost{0.5};
  for (int i = 0; i < 12; ++i)
    slow.push_back(0.7 * slow.back()), growing.push_back(5 * growing.back()),
        lost.push_back(i % 3 == 0 ? 0.7 : 0.4);
  for (const auto& residuals : {slow, growing, lost}) EXPECT_EQ(advice(residuals, 0), "") << residuals.back();
}

} // namespace
} // namespace host::test::program_test
