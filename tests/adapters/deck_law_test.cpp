// SPDX-License-Identifier: BSD-3-Clause
// What ents-deck makes of *SURFACE BEHAVIOR, *FRICTION, *ELASTIC and *BOUNDARY: laws, stiffnesses, slides,
// and what both programs read.
#include <cmath>
#include <numbers>

#include "deck_text.hpp"
#include "write.hpp"

namespace ents_deck::deck_law_test {
namespace {

Law law(const string& behaviour, Program program, std::optional<double> stiffness = {},
        const string& elastic = "1000., .3") {
  string text = two_blocks() + "*MATERIAL, NAME=M\n" +
                (elastic.empty() ? "" : "*ELASTIC\n" + elastic + "\n") +
                "*MATERIAL, NAME=N\n*ELASTIC\n5000., .3\n*MATERIAL, NAME=O\n*ELASTIC\n2000., .3\n*SURFACE "
                "INTERACTION, NAME=OTHER\n*SURFACE BEHAVIOR, "
                "PRESSURE-OVERCLOSURE=LINEAR\n7.\n*SURFACE INTERACTION, NAME=I\n" +
                behaviour + pair_of_surfaces + step;
  const Mesh mesh = mesh_of(text);
  Bodies bodies = bodies_of(mesh);
  bodies.face_size = 0.5;
  return law_of(mesh, contact_pairs(mesh).at(0), bodies, program, stiffness);
}

nlohmann::ordered_json normal(const Law& made) { return made.contact.at("normal"); }

TEST(DeckLaw, LinearIsAPenalty) {
  for (const Program program : {Program::calculix, Program::abaqus}) {
    const Law made = law("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e6\n", program);
    EXPECT_EQ(normal(made).dump(), R"({"type":"penalty","stiffness":1000000.0})");
    EXPECT_FALSE(made.contact.contains("friction"));
    EXPECT_TRUE(made.remarks.empty());
    EXPECT_EQ(
        normal(law("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e6\n", program, 12.0)).at("stiffness"),
        12.0);
  }
}

// HARD, nothing at all, and LINEAR without a number: ccx's default is 50 E of the first material, for Abaqus
// 10 E / h of the largest.
TEST(DeckLaw, AMissingStiffnessIsProposed) {
  for (const char* behaviour : {"", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n", "*SURFACE BEHAVIOR\n",
                                "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n"}) {
    SCOPED_TRACE(behaviour);
    const Law ccx = law(behaviour, Program::calculix), abaqus = law(behaviour, Program::abaqus);
    EXPECT_EQ(normal(ccx).at("stiffness"), 50 * 1000.0);
    EXPECT_EQ(normal(abaqus).at("stiffness"), 10 * 5000.0 / 0.5);
    ASSERT_EQ(ccx.remarks.size(), 1u);
    EXPECT_NE(ccx.remarks[0].find("stiffness 50000"), string::npos) << ccx.remarks[0];
    ASSERT_EQ(abaqus.remarks.size(), 1u);
    EXPECT_NE(abaqus.remarks[0].find("stiffness 100000 proposed"), string::npos) << abaqus.remarks[0];
  }
}

// Abaqus's law is the library's. ccx's p0 exp(ln(100) d / c0) has the value p0 and the slope ln(100) p0 / c0
// at zero gap, and so has what is made of it: Abaqus's slope there is (2 e - 1) / (e - 1) p0 / c.
TEST(DeckLaw, ExponentialsAgreeInValueAndSlopeAtZeroGap) {
  const string behaviour = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL\n0.02, 3.\n";
  const auto abaqus = normal(law(behaviour, Program::abaqus)),
             ccx = normal(law(behaviour, Program::calculix));
  EXPECT_EQ(abaqus.dump(), R"({"type":"exponential","pressure":3.0,"clearance":0.02})");
  EXPECT_EQ(ccx.at("pressure"), 3.0);
  const double e = std::numbers::e;
  EXPECT_NEAR((2 * e - 1) / (e - 1) * 3.0 / ccx.at("clearance").get<double>(), std::log(100.0) * 3.0 / 0.02,
              1e-10);
  EXPECT_NE(error_of([] {
              law("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL\n0.02\n", Program::abaqus);
            }).find("needs c0 > 0 and p0 > 0"),
            string::npos);
}

TEST(DeckLaw, AStraightTableIsAPenaltyAndACurvedOneIsRefused) {
  const string head = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR\n";
  EXPECT_EQ(normal(law(head + "0., 0.\n20., 0.01\n40., 0.02\n", Program::abaqus)).at("stiffness"), 2000.0);
  const auto refused = [&](const string& table, const char* reason) {
    const string error = error_of([&] { law(head + table, Program::abaqus); });
    EXPECT_NE(error.find(reason), string::npos) << error;
    EXPECT_NE(error.find("deck.inp:"), string::npos) << error;
  };
  refused("0., 0.\n20., 0.01\n41., 0.02\n", "it is not a straight line");
  refused("1., 0.\n20., 0.01\n", "does not begin with pressure 0 at overclosure 0");
  refused("0., 0.\n", "needs two lines");
}

TEST(DeckLaw, Friction) {
  const string linear = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e6\n";
  const auto friction = [&](const string& text, Program program) {
    return law(linear + text, program).contact.value("friction", nlohmann::ordered_json());
  };
  EXPECT_EQ(friction("*FRICTION\n0.2, 4e5\n", Program::calculix).dump(),
            R"({"type":"coulomb","coefficient":0.2,"stiffness":400000.0})");
  // ccx's default is half of E of the first material; Abaqus has a slip rate behind the coefficient.
  EXPECT_EQ(friction("*FRICTION\n0.2\n", Program::calculix).at("stiffness"), 500.0);
  EXPECT_EQ(friction("*FRICTION\n0.2\n", Program::abaqus).at("stiffness"), 5e5);
  EXPECT_TRUE(friction("*FRICTION\n0.\n", Program::abaqus).is_null());
  EXPECT_EQ(friction("*FRICTION, ROUGH\n", Program::abaqus).dump(),
            R"({"type":"rough","stiffness":1000000.0})");
  const string error = error_of([&] { friction("*FRICTION, TEST DATA\n0.2, 0.1, 1.\n", Program::abaqus); });
  EXPECT_NE(error.find("*FRICTION, TEST DATA: "), string::npos) << error;
}

// The range of each direction over all steps: the motion from -0.2 to 0.3 slides by 0.5. What stands before
// the steps is no motion.
TEST(DeckLaw, TheSlideIsTheRangeOfThePrescribedMotion) {
  const string before = two_blocks() + "*BOUNDARY\nNHIGH, 1, 1, 77.\n";
  const Motion moved = prescribed_motion(mesh_of(
      before + "*STEP\n*STATIC\n*BOUNDARY\nNHIGH, 1, 2, 0.3\nNLOW, 3\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY\n"
               "NHIGH, 1, , -0.2\nNHIGH, ENCASTRE\n*END STEP\n"));
  EXPECT_DOUBLE_EQ(moved.range[0], 0.5);
  EXPECT_DOUBLE_EQ(moved.range[1], 0.3);
  EXPECT_DOUBLE_EQ(moved.range[2], 0.0);
  EXPECT_FALSE(moved.rotates);
  EXPECT_TRUE(prescribed_motion(mesh_of(before + "*STEP\n*BOUNDARY\nNHIGH, 4, 4, 0.1\n*END STEP\n")).rotates);
  EXPECT_FALSE(prescribed_motion(mesh_of(before + "*STEP\n*BOUNDARY\nNHIGH, 4, 6, 0.\n*END STEP\n")).rotates);
}

// ---- what the programs read ----

TEST(DeckPrograms, CcxReadsElementsBehindAllOthersAndItsOwnLimits) {
  Options options;
  options.slide = 0.2;
  const Job job = converted(
      deck() + "*STEP\n*STATIC\n*CONTROLS, PARAMETERS=TIME INCREMENTATION\n4, 8\n*END STEP\n", options);
  std::filesystem::remove_all("ccx");
  options.deck = "job/deck.inp";
  write_job(job, options, "ccx");
  const string text = content("ccx/deck.inp");
  EXPECT_EQ(first_free_element(job), 105); // the largest of the deck is 104
  EXPECT_NE(text.find("\n105, "), string::npos);
  std::size_t controls = 0; // those of the first step are written, those of the second its own
  for (std::size_t at = 0; (at = text.find("*CONTROLS", at)) != string::npos; ++at) ++controls;
  EXPECT_EQ(controls, 2u);
  EXPECT_LT(text.find("*CONTROLS, PARAMETERS=TIME INCREMENTATION\n10, 20, 9, 60, 22, 16, , 10\n"),
            text.find("*END STEP"));
  // The elements stand before the first step, a type for each number of nodes, with as many states as the
  // model asks for.
  EXPECT_LT(text.find("*USER ELEMENT"), text.find("\n*STEP"));
  std::map<int, int> types;
  int states = 1;
  for (const Model& model : job.models) ++types[model.nodes()], states = std::max(states, model.state_size);
  std::size_t written = 0;
  for (std::size_t at = 0; (at = text.find("*USER ELEMENT", at)) != string::npos; ++at) ++written;
  EXPECT_EQ(written, types.size());
  EXPECT_NE(text.find("*DEPVAR\n" + std::to_string(states) + "\n"), string::npos);
  EXPECT_NE(text.find("CONSTANTS=3\n" + std::to_string(job.models.back().number) + "., 0., 0.\n"),
            string::npos);
}

TEST(DeckPrograms, TablesHaveTheAreaAndTheWeightsOfEachElement) {
  const Job job = converted(deck());
  Options options;
  options.deck = "job/deck.inp";
  std::filesystem::remove_all("tables");
  write_job(job, options, "tables");
  double area = 0;
  std::size_t lines = 0;
  for (const Model& model : job.models) {
    std::istringstream table(content("tables/ents_" + std::to_string(model.number) + ".txt"));
    for (string line; std::getline(table, line);) {
      if (line.empty() || line[0] == '#' || line[0] == 's') continue;
      std::istringstream words(line);
      double element = 0, own = 0, weight = 0, sum = 0;
      words >> element >> own;
      for (int i = 0; i < model.slave_nodes && words >> weight; ++i) sum += weight;
      EXPECT_NEAR(sum, 1, 1e-14) << line;
      const ContactElement& made = job.elements.at(static_cast<std::size_t>(element) - 105);
      EXPECT_EQ(own, made.slave.area) << "the table is that of element " << element;
      EXPECT_EQ(job.models[static_cast<std::size_t>(made.model)].number, model.number);
      area += own, ++lines;
    }
  }
  EXPECT_EQ(lines, job.elements.size());
  EXPECT_NEAR(area, 4, 1e-13); // of the slave's face, 2 x 2
}

// Abaqus conducts k(p) in contact, k(0) of the clearances where there is no table of pressures, and k(g) where it is
// open.
TEST(DeckLaw, GapConductanceAndHeatGenerationAreHeat) {
  const string head = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e6\n", friction = "*FRICTION\n0.2\n",
               by_gap = "*GAP CONDUCTANCE\n4., 0.\n1., 0.1\n0., 0.3\n",
               by_pressure = "*GAP CONDUCTANCE, PRESSURE\n1., 0.\n3., 1.\n2., 4.\n";
  const auto heat = [&](const string& text) {
    const Law made = law(head + text, Program::abaqus);
    return made.contact.contains("heat") ? made.contact.at("heat").dump() : "none";
  };
  EXPECT_EQ(heat(""), "none");
  EXPECT_EQ(heat(by_gap),
            R"({"conductance":4.0,"clearance":{"gaps":[0.0,0.1,0.3],"conductances":[4.0,1.0,0.0]}})");
  EXPECT_EQ(heat(by_pressure), R"({"table":{"pressures":[0.0,1.0,4.0],"conductances":[1.0,3.0,2.0]}})");
  EXPECT_EQ(heat(by_gap + by_pressure),
            R"({"table":{"pressures":[0.0,1.0,4.0],"conductances":[1.0,3.0,2.0]},)"
            R"("clearance":{"gaps":[0.0,0.1,0.3],"conductances":[4.0,1.0,0.0]}})");
  EXPECT_EQ(heat(friction + "*GAP HEAT GENERATION\n"), R"({"friction":{"share":1.0,"slave":0.5}})");
  EXPECT_EQ(heat(friction + "*GAP HEAT GENERATION\n0.9, 0.3\n"), R"({"friction":{"share":0.9,"slave":0.3}})");
  const auto remark = [&](const string& text) {
    string all;
    for (const string& line : law(head + text, Program::abaqus).remarks) all += line + "\n";
    return all;
  };
  EXPECT_NE(remark("*GAP HEAT GENERATION\n").find("has no effect: the contact has no friction"),
            string::npos);
  EXPECT_NE(remark(friction + by_gap).find("friction of this contact makes no heat"), string::npos);
  const auto refused = [&](const string& text, Program program, const char* reason) {
    const string error = error_of([&] { law(head + text, program); });
    EXPECT_NE(error.find(reason), string::npos) << error;
    EXPECT_NE(error.find("deck.inp:"), string::npos) << error;
  };
  refused(by_gap + by_gap, Program::abaqus, "over the clearance is there a second time");
  refused("*GAP CONDUCTANCE\n4., 0.\n1., 0.1\n", Program::abaqus,
          "write a line more, with a conductance of 0");
  refused("*GAP CONDUCTANCE\n4., 0.1\n0., 0.3\n", Program::abaqus, "a table begins at 0 and rises");
  refused("*GAP CONDUCTANCE\n4.\n", Program::abaqus, "needs two lines");
  refused("*GAP CONDUCTANCE\n-4., 0.\n0., 0.3\n", Program::abaqus, "the conductance is -4");
  refused("*GAP CONDUCTANCE\n4., 0., 20.\n0., 0.3, 20.\n", Program::abaqus, "temperature (entry 3), '20.'");
  refused("*GAP CONDUCTANCE, USER\n", Program::abaqus, "a subroutine of your own");
  refused("*GAP CONDUCTANCE, PRESURE\n1., 0.\n", Program::abaqus, "is not known");
  refused(friction + "*GAP HEAT GENERATION\n1.2, 0.3\n", Program::abaqus, "two numbers from 0 to 1");
  refused("*GAP RADIATION\n1., 0.3\n", Program::abaqus, "without damping, radiation or cohesion");
}

// ccx: over the pressure alone, constant beyond both ends, and the velocity of the slip itself where it is negative.
TEST(DeckLaw, GapConductanceAndHeatGenerationOfCcx) {
  const string head = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e6\n",
               friction = "*FRICTION\n0.2, 1e5\n";
  const auto heat = [&](const string& text) {
    const Law made = law(head + text, Program::calculix);
    return made.contact.contains("heat") ? made.contact.at("heat").dump() : "none";
  };
  EXPECT_EQ(heat("*GAP CONDUCTANCE\n4., , 293.\n"), R"({"conductance":4.0})");
  EXPECT_EQ(heat("*GAP CONDUCTANCE\n1., 0., 20.\n3., 1., 20.\n2., 4., 20.\n"),
            R"({"table":{"pressures":[0.0,1.0,4.0],"conductances":[1.0,3.0,2.0]}})");
  EXPECT_EQ(heat("*GAP CONDUCTANCE\n1., 2.\n3., 5.\n"),
            R"({"table":{"pressures":[0.0,2.0,5.0],"conductances":[1.0,1.0,3.0]}})");
  EXPECT_EQ(heat(friction + "*GAP HEAT GENERATION\n0.9, 0.3, -1.\n"),
            R"({"friction":{"share":0.9,"slave":0.3}})");
  EXPECT_EQ(heat(friction + "*GAP HEAT GENERATION\n0.9, , -1.\n"),
            R"({"friction":{"share":0.9,"slave":0.0}})");
  const auto refused = [&](const string& text, const char* reason) {
    const string error = error_of([&] { law(head + text, Program::calculix); });
    EXPECT_NE(error.find(reason), string::npos) << error;
    EXPECT_NE(error.find("deck.inp:"), string::npos) << error;
  };
  refused("*GAP CONDUCTANCE\n1., 0., 20.\n3., 0., 30.\n", "a second temperature");
  refused("*GAP CONDUCTANCE\n1., 2.\n3., 2.\n", "they rise, from 0 or more");
  refused("*GAP CONDUCTANCE\n1., -2.\n", "they rise, from 0 or more");
  refused("*GAP CONDUCTANCE\n-1., 2.\n", "the conductance is -1");
  refused("*GAP CONDUCTANCE\n", "has no line");
  refused("*GAP CONDUCTANCE, USER\n", "a subroutine of your own");
  refused("*GAP CONDUCTANCE, PRESSURE\n1., 0.\n3., 1.\n", "is not known");
  refused(friction + "*GAP HEAT GENERATION\n0.9, 0.3, 200.\n", "the relative velocity (entry 3) is 200");
  refused(friction + "*GAP HEAT GENERATION\n0.9, 0.3\n", "write -1.");
  refused(friction + "*GAP HEAT GENERATION\n", "has no line");
  refused(friction + "*GAP HEAT GENERATION, USER\n", "a subroutine of your own");
}

TEST(DeckLaw, HeatTakesTemperaturesAndTheirSteps) {
  const string by_pressure = "1e6\n*GAP CONDUCTANCE, PRESSURE\n1., 0.\n3., 1.\n",
               of_ccx = "1e6\n*GAP CONDUCTANCE\n1., 0.\n3., 1.\n";
  const auto with = [](const string& text, const string& procedure) {
    string changed = text;
    return changed.replace(changed.find("*STATIC"), 7, procedure);
  };
  const string coupled = "*COUPLED TEMPERATURE-DISPLACEMENT", transfer = "*HEAT TRANSFER, STEADY STATE";
  const auto refused = [](const std::function<void()>& run, const char* reason) {
    const string error = error_of(run);
    EXPECT_NE(error.find(reason), string::npos) << error;
    EXPECT_NE(error.find("deck.inp:"), string::npos) << error;
  };
  Options options;
  options.program = Program::abaqus;
  const string text = deck("1e6\n", by_pressure);
  EXPECT_NE(abaqus_text(converted(with(text, coupled), options)).text.find("UNSYMM\n1, 2, 3, 11\n"),
            string::npos);
  refused([&] { abaqus_text(converted(text, options)); }, "*STATIC has no temperatures");
  refused([&] { abaqus_text(converted(with(text, transfer), options)); }, "conduct no heat in such a step");
  EXPECT_NE(abaqus_text(converted(deck(), options)).text.find("\n1, 2, 3\n"), string::npos);
  Options ccx;
  const string own = deck("1e6\n", of_ccx);
  for (const string& procedure : {coupled, transfer})
    EXPECT_NE(calculix_text(converted(with(own, procedure), ccx)).text.find("MAXDOF=3"), string::npos);
  refused([&] { calculix_text(converted(own, ccx)); }, "*STATIC has no temperatures");
  refused([&] { converted(with(own, "*HEAT TRANSFER, FREQUENCY"), ccx); }, "linear step");
  // ccx's limits of iterations are for these steps, too
  ccx.deck = "job/deck.inp";
  std::filesystem::remove_all("coupled");
  write_job(converted(with(own, coupled), ccx), ccx, "coupled");
  EXPECT_NE(content("coupled/deck.inp").find("*CONTROLS, PARAMETERS=TIME INCREMENTATION"), string::npos);
}

} // namespace
} // namespace ents_deck::deck_law_test
