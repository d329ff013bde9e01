// SPDX-License-Identifier: BSD-3-Clause
// What ents-deck makes of surfaces that hold each other, and of coefficients of friction that vary.
#include "deck_text.hpp"

namespace ents_deck::deck_bond_test {
namespace {

using Json = nlohmann::ordered_json;

Law law(const string& behaviour, Program program, double face_size = 0.5) {
  const string text = two_blocks() +
                      "*MATERIAL, NAME=M\n*ELASTIC\n1000., .3\n*SURFACE INTERACTION, NAME=I\n" + behaviour +
                      pair_of_surfaces + step;
  const Mesh mesh = mesh_of(text);
  Bodies bodies = bodies_of(mesh);
  bodies.face_size = face_size;
  return law_of(mesh, contact_pairs(mesh).at(0), bodies, program, {});
}
const string linear = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", number = "\n1e6\n";

void refused(const string& text, Program program, const char* reason) {
  const string error = error_of([&] { law(text, program); });
  EXPECT_NE(error.find(reason), string::npos) << error;
  EXPECT_NE(error.find("deck.inp:"), string::npos) << error;
}

TEST(DeckBond, NoSeparationIsTiedFromTheTouchOn) {
  const Law made = law(linear + ", NO SEPARATION" + number, Program::abaqus);
  EXPECT_EQ(made.contact.at("normal").dump(), R"({"type":"tied","stiffness":1000000.0,"range":5e-07})");
  EXPECT_FALSE(made.contact.contains("friction"));
  EXPECT_EQ(law("*SURFACE BEHAVIOR, NO SEPARATION\n*FRICTION, ROUGH\n", Program::abaqus).contact.dump(),
            R"({"normal":{"type":"tied","stiffness":20000.0,"range":5e-07},)"
            R"("friction":{"type":"rough","stiffness":20000.0}})");
  refused("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL, NO SEPARATION\n0.1, 2.\n", Program::abaqus,
          "one stiffness");
}

TEST(DeckBond, TiedOfCcxSticksWithItsSlope) {
  const string tied = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n1e6\n";
  EXPECT_EQ(law(tied + "*FRICTION\n0., 4e5\n", Program::calculix).contact.dump(),
            R"({"normal":{"type":"tied","stiffness":1000000.0,"range":0.25},)"
            R"("friction":{"type":"rough","stiffness":400000.0}})");
  EXPECT_EQ(law(tied, Program::calculix).contact.dump(),
            R"({"normal":{"type":"tied","stiffness":1000000.0,"range":0.25}})");
  refused(tied, Program::abaqus, "TIED");
}

TEST(DeckBond, CohesiveBehaviorIsTheBilinearLaw) {
  const string cohesive = linear + number + "*COHESIVE BEHAVIOR\n2e5, 0., 0.\n";
  const string starts = "*DAMAGE INITIATION, CRITERION=MAXS\n10., 10., 10.\n";
  const auto normal = [&](const string& text) {
    return law(text, Program::abaqus).contact.at("normal").dump();
  };
  EXPECT_EQ(normal(cohesive), R"({"type":"tied","stiffness":200000.0,"range":5e-07})");
  EXPECT_EQ(normal(cohesive + starts + "*DAMAGE EVOLUTION, TYPE=ENERGY\n0.01\n"),
            R"({"type":"cohesive","stiffness":200000.0,"strength":10.0,"energy":0.01,"range":5e-07})");
  // the opening at failure is beyond that at initiation, 10 / 2e5
  EXPECT_EQ(law(cohesive + starts + "*DAMAGE EVOLUTION, TYPE=DISPLACEMENT\n0.00195\n", Program::abaqus)
                .contact.at("normal")
                .at("energy"),
            0.5 * 10 * (10 / 2e5 + 0.00195));
  const Program abaqus = Program::abaqus;
  refused(linear + number + "*COHESIVE BEHAVIOR\n2e5, 1e5, 1e5\n", abaqus, "write 0 for K_ss and K_tt");
  refused(linear + number + "*COHESIVE BEHAVIOR\n", abaqus, "needs a stiffness K_nn above 0");
  refused(cohesive + starts, abaqus, "has no *DAMAGE EVOLUTION");
  refused(cohesive + "*DAMAGE EVOLUTION, TYPE=ENERGY\n0.01\n", abaqus, "has no *DAMAGE INITIATION");
  refused(linear + number + starts, abaqus, "has no *COHESIVE BEHAVIOR");
  refused(cohesive + starts + "*DAMAGE EVOLUTION, TYPE=ENERGY, SOFTENING=EXPONENTIAL\n0.01\n", abaqus,
          "SOFTENING=EXPONENTIAL");
  refused(cohesive + "*COHESIVE BEHAVIOR\n1., 0., 0.\n", abaqus, "a second time");
  refused(cohesive, Program::calculix, "COHESIVE BEHAVIOR");
}

TEST(DeckBond, CoefficientsThatVary) {
  const auto friction = [&](const string& text) {
    return law(linear + number + text, Program::abaqus).contact.value("friction", Json()).dump();
  };
  EXPECT_EQ(friction("*FRICTION, EXPONENTIAL DECAY\n0.3, 0.2, 1.5\n"),
            R"({"type":"coulomb","coefficient":0.3,"kinetic":0.2,"decay":1.5,"stiffness":500000.0})");
  EXPECT_EQ(friction("*FRICTION\n0.3, 0.\n0.2, 1.\n"),
            R"({"type":"coulomb","coefficient":{"slip_rates":[0.0,1.0],"coefficients":[[0.3,0.2]]},)"
            R"("stiffness":500000.0})");
  EXPECT_EQ(friction("*FRICTION\n0.3, , 0.\n0.2, , 10.\n"),
            R"({"type":"coulomb","coefficient":{"pressures":[0.0,10.0],"coefficients":[[0.3],[0.2]]},)"
            R"("stiffness":500000.0})");
  // Below the first rate its coefficient holds; lines may come in any order.
  EXPECT_EQ(friction("*FRICTION\n0.1, 3., 10.\n0.3, 1., 0.\n0.2, 3., 0.\n0.25, 1., 10.\n"),
            R"({"type":"coulomb","coefficient":{"pressures":[0.0,10.0],"slip_rates":[0.0,1.0,3.0],)"
            R"("coefficients":[[0.3,0.3,0.2],[0.25,0.25,0.1]]},"stiffness":500000.0})");
  EXPECT_EQ(friction("*FRICTION\n0.3, 2.\n"), R"({"type":"coulomb","coefficient":0.3,"stiffness":500000.0})");
  const auto fails = [&](const string& text, const char* reason) {
    refused(linear + number + text, Program::abaqus, reason);
  };
  fails("*FRICTION\n0.3, 0., 0.\n0.2, 1., 10.\n", "for every rate at every pressure");
  fails("*FRICTION\n0.3, 1.\n0.2, 1.\n", "for this slip rate and pressure already");
  fails("*FRICTION, EXPONENTIAL DECAY\n0.3, 0.2\n", "the decay (entry 3)");
  fails("*FRICTION, EXPONENTIAL DECAY\n0.3\n", "write it as entry 2");
}

} // namespace
} // namespace ents_deck::deck_bond_test
