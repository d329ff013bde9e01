// SPDX-License-Identifier: BSD-3-Clause
// Sources: CalculiX CrunchiX 2.20 (surfaceinteractions.f, surfacebehaviors.f, frictions.f, contactpairs.f,
// surfaces.f and others: what they read); Abaqus Keywords Guide (*SURFACE INTERACTION, *SURFACE BEHAVIOR, *FRICTION,
// *GAP CONDUCTANCE, *GAP HEAT GENERATION, *CONTACT PAIR, *SURFACE, *NSET, *ELSET, *NODE, *ELEMENT).
#include "keywords.hpp"

namespace ents_deck {
namespace {

using P = ParameterRule;
using C = ColumnRule;

const P any{"*", Use::no_effect, "*", ""}; ///< programs pass over others, or they concern other things
const char* const written_by_hand =
    "; write the law into a model, \"contact\": {...}, and name it with --model";
const char* const no_heat =
    "contact elements conduct no heat in such a step; leave the pair to the program itself";
const char* const linear =
    "in a linear step the program keeps no history of contact elements; write *STATIC steps alone";
const char* const whole_job =
    "the law of a contact element is that of its model for the whole job; write a deck for each "
    "law, or leave the pair to the program itself";
const char* const of_the_mesh =
    "the gap of a contact element is that of the mesh; move the nodes, or write a constant "
    "\"height\" into a model (--model)";
const char* const by_itself = "; leave this pair to the program itself, and name the others with --pair";
const char* const explicit_step =
    "these are elements of Abaqus/Standard; write *STATIC, or *DYNAMIC without EXPLICIT";
const char* const no_settings =
    "contact elements have neither stabilization nor other settings of it; a body that contact alone holds "
    "needs springs or a prescribed motion";
const char* const no_output = "it writes nothing of contact elements";
const char* const small = "contact elements follow large sliding, too";
const char* const slip =
    "is not used; the tangential stiffness is the \"stiffness\" of \"friction\" in the law";
const char* const one_file =
    "the lines of another file are not read here; write *INCLUDE, INPUT=file below the keyword";

std::vector<KeywordRule> shared_rules() {
  std::vector<KeywordRule> out;
  const auto never = [&](const char* name, const std::string& why) {
    out.push_back({name, Use::refused, why, {}, {}});
  };
  for (const char* name : {"UNCOUPLED TEMPERATURE-DISPLACEMENT", "COUPLED THERMAL-ELECTRICAL"})
    never(name, no_heat);
  for (const char* name : {"FREQUENCY", "BUCKLE", "COMPLEX FREQUENCY", "MODAL DYNAMIC",
                           "STEADY STATE DYNAMICS", "GREEN", "RANDOM RESPONSE", "RESPONSE SPECTRUM"})
    never(name, linear);
  never("PRESSURE PENETRATION", "contact elements know no pressure of a fluid between the surfaces; leave "
                                "the pair to the program itself");
  for (const char* name : {"DYNAMIC TEMPERATURE-DISPLACEMENT", "ANNEAL"}) never(name, explicit_step);
  for (const char* name : {"DIRECT CYCLIC", "STEADY STATE TRANSPORT"})
    never(name,
          "friction of contact elements needs increments in their order, with the material at its nodes; "
          "write *STATIC steps");
  never("ADAPTIVE MESH",
        "nodes that move through the material slide for contact elements; leave it out, or leave the "
        "pair to the program itself");
  never("DEBOND", "contact elements are not bonded; leave the pair to the program itself");
  never("SUBSTRUCTURE GENERATE",
        "contact elements have no place in a substructure; write *STATIC steps alone");
  for (const char* name : {"CHANGE FRICTION", "CHANGE SURFACE BEHAVIOR", "CHANGE CONTACT TYPE"})
    never(name, whole_job);
  for (const char* name : {"CONTACT INTERFERENCE", "CLEARANCE", "CONTACT CLEARANCE"})
    never(name, of_the_mesh);
  never("CONTACT",
        "general contact would carry the same surfaces a second time; leave it out of this deck, or write "
        "*CONTACT PAIR");
  for (const char* name : {"CONTACT CONTROLS", "CONTACT OUTPUT", "CONTACT PRINT", "CONTACT FILE"})
    out.push_back({name, Use::no_effect, name[8] == 'C' ? no_settings : no_output, {any}, {}});
  out.push_back(
      {"IMPERFECTION", Use::no_effect, "patches and areas are those of the mesh without it", {any}, {}});
  out.push_back(
      {"INITIAL CONDITIONS",
       Use::used,
       "",
       {{"TYPE", Use::used, "!CONTACT",
         "a bonded part of the slave surface is no contact law; leave the pair to the program itself"},
        any},
       {}});
  for (const char* name : keywords_of_interactions())
    out.push_back({name, Use::used, "", {any}, {}}); // refused where an interaction of a pair has them
  return out;
}

/// Sets and surfaces; Abaqus's parameters make no difference where faces alone count.
std::vector<KeywordRule> mesh_rules() {
  const std::vector<P> set{any,
                           {"GENERATE", Use::used, "", ""},
                           {"INSTANCE", Use::used, "*", ""},
                           {"INTERNAL", Use::no_effect, "", ""},
                           {"UNSORTED", Use::no_effect, "", ""}};
  KeywordRule nset{"NSET", Use::used, "", set, {}}, elset{"ELSET", Use::used, "", set, {}};
  nset.parameters.push_back({"NSET", Use::used, "*", ""});
  nset.parameters.push_back(
      {"ELSET", Use::refused, "*", "nodes of elements are not collected; write the nodes"});
  elset.parameters.push_back({"ELSET", Use::used, "*", ""});
  for (KeywordRule* rule : {&nset, &elset})
    rule->parameters.push_back({"INPUT", Use::refused, "*", one_file});
  return {
      {"NODE",
       Use::used,
       "",
       {{"NSET", Use::used, "*", ""},
        {"SYSTEM", Use::used, "R|C|S", ""},
        {"INPUT", Use::refused, "*", one_file}},
       {}},
      {"ELEMENT",
       Use::used,
       "",
       {any,
        {"TYPE", Use::used, "*", ""},
        {"ELSET", Use::used, "*", ""},
        {"INPUT", Use::refused, "*", one_file},
        {"FILE", Use::refused, "*", one_file},
        {"OFFSET", Use::refused, "*", "numbers of nodes are not shifted here; write the numbers themselves"},
        {"SOLID ELEMENT NUMBERING", Use::refused, "*",
         "write the element numbers in the order of the program's manual"}},
       {}},
      nset,
      elset,
      {"SURFACE",
       Use::used,
       "",
       {{"NAME", Use::used, "*", ""},
        {"TYPE", Use::used,
         "|ELEMENT|NODE|CYLINDER|REVOLUTION|SEGMENTS|CUTTING SURFACE|USER|XFEM|EULERIAN MATERIAL", ""},
        {"INSTANCE", Use::used, "*", ""},
        {"INTERNAL", Use::no_effect, "", ""},
        {"COMBINE", Use::used, "*", ""},
        {"CROP", Use::used, "", ""},
        {"DEFINITION", Use::no_effect, "|COORDINATES|NODES", ""},
        {"FILLET RADIUS", Use::no_effect, "*", ""},
        {"MAX RATIO", Use::no_effect, "*", ""},
        {"NO OFFSET", Use::no_effect, "", ""},
        {"NO THICK", Use::no_effect, "", ""},
        {"SCALE THICK", Use::no_effect, "*", ""},
        {"PROPERTY", Use::no_effect, "*", ""},
        {"REGION TYPE", Use::no_effect, "*", ""},
        {"TRIM", Use::no_effect, "|YES|NO", ""}},
       {}}};
}

/// own: a parameter of the program that concerns elements
KeywordRule model_change(const char* own) {
  return {
      "MODEL CHANGE",
      Use::used,
      "",
      {{"TYPE", Use::used, "ELEMENT", "contact elements stay for the whole job; write a deck for each state"},
       {"ADD", Use::no_effect, "*", ""},
       {"REMOVE", Use::no_effect, "", ""},
       {own, Use::no_effect, "", ""}},
      {}};
}

std::vector<KeywordRule> calculix_rules() {
  const std::string thickness =
      "the thickness of plane contact is that of the *SOLID SECTION; write 1 or leave the line out";
  return {
      {"SURFACE INTERACTION",
       Use::used,
       "",
       {{"NAME", Use::used, "*", ""}},
       {{"thickness", Use::refused, "1", thickness}},
       1},
      {"SURFACE BEHAVIOR",
       Use::used,
       "",
       {{"PRESSURE-OVERCLOSURE", Use::used, "HARD|LINEAR|EXPONENTIAL|TABULAR|TIED", ""}},
       {}},
      {"FRICTION", Use::used, "", {}, {{"coefficient of friction"}, {"stick slope"}}},
      {"CONTACT PAIR",
       Use::used,
       "",
       {{"INTERACTION", Use::used, "*", ""},
        {"TYPE", Use::used, "NODE TO SURFACE|SURFACE TO SURFACE|MORTAR|LINMORTAR|PGMORTAR|PGLINMORTAR", ""},
        {"ADJUST", Use::used, "*", ""},
        {"SMALL SLIDING", Use::no_effect, "", small},
        {"LINEAR", Use::refused, "",
         "contact elements iterate: a step with them is not linear; leave LINEAR out, or leave this pair to "
         "ccx"}},
       {{"slave surface"}, {"master surface"}}},
      {"STEP", Use::used, "", {{"PERTURBATION", Use::refused, "", linear}, any}, {}},
      {"DYNAMIC",
       Use::refused,
       "U1E has been verified in *STATIC and *VISCO steps alone; leave the pair to ccx",
       {},
       {}},
      {"HEAT TRANSFER",
       Use::used,
       "",
       {{"FREQUENCY", Use::refused, "", linear}, {"MODAL DYNAMIC", Use::refused, "", linear}, any},
       {}},
      {"COUPLED TEMPERATURE-DISPLACEMENT", Use::used, "", {any}, {}},
      {"GAP CONDUCTANCE",
       Use::used,
       "",
       {{"USER", Use::refused, "",
         std::string("a subroutine of your own gives the conductance") + written_by_hand}},
       {{"conductance"}, {"pressure"}, {"temperature"}}},
      {"GAP HEAT GENERATION",
       Use::used,
       "",
       {{"USER", Use::refused, "", std::string("a subroutine of your own gives the heat") + written_by_hand}},
       {{"part that becomes heat"}, {"part of the slave"}, {"relative velocity"}},
       1},
      model_change("MECHSTRAINTORESIDUAL")};
}

KeywordRule abaqus_pair() {
  return {
      "CONTACT PAIR",
      Use::used,
      "",
      {{"INTERACTION", Use::used, "*", ""},
       {"TYPE", Use::used, "|NODE TO SURFACE|SURFACE TO SURFACE", ""},
       {"ADJUST", Use::used, "*", ""},
       {"SMALL SLIDING", Use::no_effect, "", small},
       {"TRACKING", Use::no_effect, "STATE|PATH", ""},
       {"NO THICKNESS", Use::no_effect, "", ""},
       {"SUPPLEMENTARY CONSTRAINTS", Use::no_effect, "YES|NO|SELECTIVE", ""},
       {"SMOOTH", Use::no_effect, "*",
        "the master keeps its faces as they are; a spline of its nodes is a \"segment\" of a model "
        "(--model)"},
       {"SLIDING TRANSITION", Use::no_effect, "*", ""},
       {"CPSET", Use::no_effect, "*", ""},
       {"MINIMUM DISTANCE", Use::no_effect, "|YES|NO", ""},
       {"EXTENSION ZONE", Use::refused, "*", "write \"border\" into a model and name it with --model"},
       {"HCRIT", Use::refused, "*", "write \"penetration_limit\" into a model and name it with --model"},
       {"TIED", Use::refused, "", "ties the surfaces, which no contact law does; leave this pair to Abaqus"},
       {"GEOMETRIC CORRECTION", Use::refused, "*",
        "write the true shape as a \"height\" into a model and name it with --model, or leave it out"}},
      {{"slave surface"},
       {"master surface"},
       {"direction on the slave", Use::refused, "", "friction is the same in all directions; leave it out"},
       {"direction on the master", Use::refused, "",
        "friction is the same in all directions; leave it out"}}};
}

KeywordRule abaqus_behavior() {
  return {"SURFACE BEHAVIOR",
          Use::used,
          "",
          {{"PRESSURE-OVERCLOSURE", Use::used, "|HARD|LINEAR|EXPONENTIAL|TABULAR|SCALE FACTOR", ""},
           {"PENALTY", Use::used, "|LINEAR|NONLINEAR", ""},
           {"AUGMENTED LAGRANGE", Use::no_effect, "",
            "the penetration of its penalty stiffness stays, nothing is augmented"},
           {"DIRECT", Use::no_effect, "", ""},
           {"NO SEPARATION", Use::used, "", ""}},
          {}};
}

std::vector<KeywordRule> abaqus_rules() {
  const std::string user = std::string("a subroutine of your own gives the tractions") + written_by_hand;
  const std::string states =
      "states and numbers of a subroutine mean nothing to contact elements; leave them out";
  const std::string table =
      std::string("a coefficient that depends on it is no law of a contact element; write one number, or "
                  "use") +
      " --model with another law";
  const std::string conductance =
      std::string("a conductance that depends on it is no law of a contact element; write one table") +
      written_by_hand;
  return {{"COUPLED TEMPERATURE-DISPLACEMENT", Use::used, "", {any}, {}},
          {"HEAT TRANSFER", Use::refused, no_heat, {}, {}},
          {"GAP CONDUCTANCE",
           Use::used,
           "",
           {{"PRESSURE", Use::used, "", ""},
            {"USER", Use::refused, "*",
             std::string("a subroutine of your own gives the conductance") + written_by_hand},
            {"DEPENDENCIES", Use::refused, "*", conductance}},
           {{"conductance"}, {"clearance or pressure"}, {"temperature", Use::refused, "0", conductance}}},
          {"GAP HEAT GENERATION", Use::used, "", {}, {{"part that becomes heat"}, {"part of the slave"}}, 1},
          {"SURFACE INTERACTION",
           Use::used,
           "",
           {{"NAME", Use::used, "*", ""},
            {"INTERNAL", Use::no_effect, "", ""},
            {"USER", Use::refused, "*", user},
            {"DEPVAR", Use::refused, "*", states},
            {"PROPERTIES", Use::refused, "*", states},
            {"UNSYMM", Use::refused, "", states},
            {"TRACKING THICKNESS", Use::refused, "*",
             "it is a distance of general contact, which is not translated"},
            {"PAD THICKNESS", Use::refused, "*",
             "write the layer as a constant \"height\" into a model (--model)"}},
           {{"thickness or area", Use::refused, "1",
             "the thickness of plane contact is that of the *SOLID SECTION, the area of a node that of its "
             "*SURFACE line; "
             "write 1"}},
           1},
          abaqus_behavior(),
          {"FRICTION",
           Use::used,
           "",
           {{"ROUGH", Use::used, "", ""},
            {"TAUMAX", Use::used, "*", ""},
            {"SLIP TOLERANCE", Use::no_effect, "*", slip},
            {"ELASTIC SLIP", Use::no_effect, "*", slip},
            {"LAGRANGE", Use::refused, "",
             "contact elements stick by a penalty; leave LAGRANGE out, or leave this pair to Abaqus"},
            {"ANISOTROPIC", Use::refused, "",
             std::string("friction of contact elements is the same in all directions") + by_itself},
            {"EXPONENTIAL DECAY", Use::used, "", ""},
            {"TEST DATA", Use::refused, "",
             "write the static coefficient, the kinetic one and the decay, without TEST DATA"},
            {"DEPENDENCIES", Use::refused, "*",
             "a coefficient that depends on fields is no law of a contact element; write one coefficient"},
            {"SHEAR TRACTION SLOPE", Use::refused, "*",
             "write the \"stiffness\" of \"friction\" into a model and name it with --model"},
            {"USER", Use::refused, "*", user},
            {"DEPVAR", Use::refused, "*", states},
            {"PROPERTIES", Use::refused, "*", states}},
           {{"coefficient of friction"},
            {"slip rate"},
            {"contact pressure"},
            {"temperature", Use::refused, "0", table}}},
          {"COHESIVE BEHAVIOR", Use::used, "", {any}, {}}, // of a pair's interaction: interaction_bond.cpp
          abaqus_pair(),
          {"STEP", Use::used, "", {{"PERTURBATION", Use::refused, "*", linear}, any}, {}},
          {"DYNAMIC", Use::used, "", {{"EXPLICIT", Use::refused, "", explicit_step}, any}, {}},
          {"STATIC",
           Use::used,
           "",
           {{"RIKS", Use::refused, "",
             "contact elements ask for cuts, which an arc length does not follow; drive the motion"},
            any},
           {}},
          model_change("ACTIVATE")};
}

std::vector<KeywordRule> together(std::vector<KeywordRule> rules) {
  for (KeywordRule& rule : rules)
    for (const char* name : {"SURFACE INTERACTION", "SURFACE BEHAVIOR", "FRICTION", "CONTACT PAIR",
                             "GAP CONDUCTANCE", "GAP HEAT GENERATION", "COHESIVE BEHAVIOR"})
      rule.of_pair = rule.of_pair || rule.name == name;
  for (auto&& more : {shared_rules(), mesh_rules()}) rules.insert(rules.end(), more.begin(), more.end());
  return rules;
}

} // namespace

const std::vector<const char*>& keywords_of_interactions() {
  static const std::vector<const char*> all{"CONTACT DAMPING",
                                            "GAP RADIATION",
                                            "COHESIVE BEHAVIOR",
                                            "DAMAGE INITIATION",
                                            "DAMAGE EVOLUTION",
                                            "DAMAGE STABILIZATION",
                                            "CONTACT PERMEABILITY",
                                            "FRACTURE CRITERION",
                                            "GAP ELECTRICAL CONDUCTANCE",
                                            "BOND",
                                            "NODAL ENERGY RATE"};
  return all;
}

const std::vector<KeywordRule>& keyword_rules(Program program) {
  static const std::vector<KeywordRule> calculix = together(calculix_rules()),
                                        abaqus = together(abaqus_rules());
  return program == Program::calculix ? calculix : abaqus;
}

} // namespace ents_deck
