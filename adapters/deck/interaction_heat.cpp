// SPDX-License-Identifier: BSD-3-Clause
// *GAP CONDUCTANCE and *GAP HEAT GENERATION of an Abaqus deck: "heat" of contact elements. Source: Abaqus Analysis
// User's Guide, "Thermal contact properties".
#include "interaction_heat.hpp"

#include <algorithm>

namespace ents_deck {
namespace {

using std::string;

/// A table of conductances over gaps or pressures.
struct Table {
  const Statement* from = nullptr;
  std::vector<double> places, conductances;
};

void read_table(const Source& source, const Statement& s, const string& place, Table& out) {
  if (out.from)
    source.fail(s.place, "*GAP CONDUCTANCE over the " + place + " is there a second time (first at " +
                             source.at(out.from->place) + "): leave one out");
  out.from = &s;
  for (const Line& line : s.lines) {
    const double conductance = entry(source, line, 0, {}), at = entry(source, line, 1, 0);
    if (!(conductance >= 0))
      source.fail(line.place, "the conductance is " + shown(conductance, 6) + "; write a number from 0");
    if (out.places.empty() ? at != 0 : !(at > out.places.back()))
      source.fail(line.place, "the " + place + " is " + shown(at, 6) + "; a table begins at 0 and rises");
    out.places.push_back(at), out.conductances.push_back(conductance);
  }
  if (out.places.size() < 2)
    source.fail(s.place, "*GAP CONDUCTANCE: a table over the " + place + " needs two lines");
}

} // namespace

nlohmann::ordered_json heat_law(const Source& source, const std::vector<const Statement*>& statements,
                                bool has_friction, std::vector<string>& remarks) {
  Table by_gap, by_pressure;
  const Statement* generation = nullptr;
  for (const Statement* s : statements) {
    if (s->keyword == "GAP CONDUCTANCE") {
      const bool pressure = s->has("PRESSURE");
      read_table(source, *s, pressure ? "pressure" : "clearance", pressure ? by_pressure : by_gap);
      continue;
    }
    if (generation)
      source.fail(s->place, "*GAP HEAT GENERATION is there a second time (first at " +
                                source.at(generation->place) + "): leave one out");
    generation = s;
  }
  nlohmann::ordered_json out;
  if (by_pressure.from)
    out["table"] = {{"pressures", by_pressure.places}, {"conductances", by_pressure.conductances}};
  if (by_gap.from) {
    if (by_gap.conductances.back() != 0)
      source.fail(
          by_gap.from->lines.back().place,
          "behind the last clearance nothing is conducted: write a line more, with a conductance of 0, "
          "where it ends");
    if (!by_pressure.from) out["conductance"] = by_gap.conductances.front(); // the same at all pressures
    out["clearance"] = {{"gaps", by_gap.places}, {"conductances", by_gap.conductances}};
  }
  if (generation && has_friction) {
    const bool empty = generation->lines.empty();
    const double share = empty ? 1 : entry(source, generation->lines[0], 0, 1),
                 slave = empty ? 0.5 : entry(source, generation->lines[0], 1, 0.5);
    if (!(std::min(share, slave) >= 0) || !(std::max(share, slave) <= 1))
      source.fail(
          generation->lines[0].place,
          "expected two numbers from 0 to 1: the part of the dissipated energy that becomes heat, and "
          "the part of this heat that enters the slave");
    out["friction"] = {{"share", share}, {"slave", slave}};
  } else if (generation) {
    remarks.push_back("*GAP HEAT GENERATION (" + source.at(generation->place) +
                      ") has no effect: the contact has no friction");
  } else if (has_friction && !out.is_null()) {
    remarks.push_back("friction of this contact makes no heat: write *GAP HEAT GENERATION if it shall");
  }
  return out;
}

} // namespace ents_deck
