// SPDX-License-Identifier: BSD-3-Clause
// Source: Abaqus Analysis User's Guide, "Surface-based cohesive behavior".
#include "interaction_bond.hpp"

#include <algorithm>
#include <set>

namespace ents_deck {
namespace {

using std::string;

double positive(const Source& source, const Statement& s, const char* what) {
  const double value = s.lines.empty() ? 0 : entry(source, s.lines[0], 0, 0);
  if (!(value > 0)) source.fail(s.place, "*" + s.keyword + " needs " + what + " above 0 as its first entry");
  return value;
}

/// Refuses a parameter that has another value than these.
void expect(const Source& source, const Statement& s, const char* parameter, const std::set<string>& values) {
  if (!s.has(parameter) || values.count(canonical(s.value(parameter))) != 0) return;
  source.fail(s.place, "*" + s.keyword + ", " + parameter + "=" + s.value(parameter) +
                           " is no law of a contact element; write " + *values.begin() +
                           ", or leave this pair to Abaqus");
}

} // namespace

nlohmann::ordered_json cohesive_law(const Source& source, const BondStatements& of, double range,
                                    std::vector<string>& remarks) {
  const Statement& cohesive = *of.cohesive;
  expect(source, cohesive, "TYPE", {"UNCOUPLED"});
  const double stiffness = positive(source, cohesive, "a stiffness K_nn");
  for (const std::size_t shear : {1u, 2u})
    if (entry(source, cohesive.lines[0], shear, 0) != 0)
      source.fail(
          cohesive.lines[0].place,
          "contact elements are bonded against opening alone, and their damage does not weaken shear; "
          "write 0 for K_ss and K_tt, or leave this pair to Abaqus");
  if (!of.initiation) {
    if (of.evolution)
      source.fail(of.evolution->place, "*DAMAGE EVOLUTION has no *DAMAGE INITIATION before it; write it, or "
                                       "leave the evolution out");
    remarks.push_back("*COHESIVE BEHAVIOR without damage: the surfaces are tied against opening");
    return {{"type", "tied"}, {"stiffness", stiffness}, {"range", range}};
  }
  expect(source, *of.initiation, "CRITERION", {"MAXS", "QUADS"});
  const double strength = positive(source, *of.initiation, "a strength t_n");
  if (!of.evolution)
    source.fail(of.initiation->place,
                "*DAMAGE INITIATION has no *DAMAGE EVOLUTION behind it, so that nothing "
                "would be damaged; write it, or leave the initiation out");
  expect(source, *of.evolution, "SOFTENING", {"LINEAR"});
  expect(source, *of.evolution, "TYPE", {"ENERGY", "DISPLACEMENT"});
  double energy = 0;
  if (canonical(of.evolution->value("TYPE")) == "ENERGY")
    energy = positive(source, *of.evolution, "an energy of fracture");
  else // the opening at failure beyond that at initiation
    energy =
        0.5 * strength * (strength / stiffness + positive(source, *of.evolution, "an opening at failure"));
  remarks.push_back("cohesive: pressure has the stiffness K_nn, too");
  return {{"type", "cohesive"},
          {"stiffness", stiffness},
          {"strength", strength},
          {"energy", energy},
          {"range", std::min(range, strength / stiffness)}};
}

} // namespace ents_deck
