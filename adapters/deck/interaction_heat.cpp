// SPDX-License-Identifier: BSD-3-Clause
// *GAP CONDUCTANCE and *GAP HEAT GENERATION: "heat" of contact elements. Sources: Abaqus Analysis User's Guide,
// "Thermal contact properties"; ccx 2.20, gapconductances.f, springforc_f2f_th.f, frictionheating.f.
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

void begin_table(const Source& source, const Statement& s, const string& place, Table& out) {
  if (out.from)
    source.fail(s.place, "*GAP CONDUCTANCE over the " + place + " is there a second time (first at " +
                             source.at(out.from->place) + "): leave one out");
  out.from = &s;
}

double conductance_of(const Source& source, const Line& line) {
  const double conductance = entry(source, line, 0, {});
  if (!(conductance >= 0))
    source.fail(line.place, "the conductance is " + shown(conductance, 6) + "; write a number from 0");
  return conductance;
}

void read_table(const Source& source, const Statement& s, const string& place, Table& out) {
  begin_table(source, s, place, out);
  for (const Line& line : s.lines) {
    const double conductance = conductance_of(source, line), at = entry(source, line, 1, 0);
    if (out.places.empty() ? at != 0 : !(at > out.places.back()))
      source.fail(line.place, "the " + place + " is " + shown(at, 6) + "; a table begins at 0 and rises");
    out.places.push_back(at), out.conductances.push_back(conductance);
  }
  if (out.places.size() < 2)
    source.fail(s.place, "*GAP CONDUCTANCE: a table over the " + place + " needs two lines");
}

/// ccx: over the pressure alone, constant beyond both ends; the lines of one temperature are those of all.
void read_ccx_table(const Source& source, const Statement& s, Table& out) {
  begin_table(source, s, "pressure", out);
  for (const Line& line : s.lines) {
    const double conductance = conductance_of(source, line), at = entry(source, line, 1, 0);
    if (entry(source, line, 2, 0) != entry(source, s.lines[0], 2, 0))
      source.fail(line.place,
                  "a second temperature: a conductance that depends on it is no law of a contact element; "
                  "write the lines of one temperature");
    if (out.places.empty() ? !(at >= 0) : !(at > out.places.back()))
      source.fail(line.place, "the pressure is " + shown(at, 6) + "; they rise, from 0 or more");
    if (out.places.empty() && at > 0) out.places.push_back(0), out.conductances.push_back(conductance);
    out.places.push_back(at), out.conductances.push_back(conductance);
  }
  if (out.places.empty())
    source.fail(s.place, "*GAP CONDUCTANCE has no line; write conductance, pressure, temperature");
}

nlohmann::ordered_json friction_heat(const Source& source, const Statement& generation, Program program) {
  const bool empty = generation.lines.empty();
  if (program == Program::calculix) {
    if (empty)
      source.fail(generation.place, "*GAP HEAT GENERATION has no line; write part, part of the slave, -1.");
    const double speed = entry(source, generation.lines[0], 2, 0); // read as 0 where it is missing
    if (!(speed < 0))
      source.fail(
          generation.lines[0].place,
          "the relative velocity (entry 3) is " + shown(speed, 6) +
              ", and contact elements heat by the slip that they have: write -1., or leave the pair to ccx");
  }
  const double share = empty ? 1 : entry(source, generation.lines[0], 0, 1),
               slave =
                   empty ? 0.5 : entry(source, generation.lines[0], 1, program == Program::abaqus ? 0.5 : 0);
  if (!(std::min(share, slave) >= 0) || !(std::max(share, slave) <= 1))
    source.fail(generation.lines[0].place,
                "expected two numbers from 0 to 1: the part of the dissipated energy that becomes heat, and "
                "the part of this heat that enters the slave");
  return {{"share", share}, {"slave", slave}};
}

} // namespace

nlohmann::ordered_json heat_law(const Source& source, const std::vector<const Statement*>& statements,
                                Program program, bool has_friction, std::vector<string>& remarks) {
  Table by_gap, by_pressure;
  const Statement* generation = nullptr;
  for (const Statement* s : statements) {
    if (s->keyword == "GAP CONDUCTANCE" && program == Program::calculix) {
      read_ccx_table(source, *s, by_pressure);
      continue;
    }
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
  if (by_pressure.from && by_pressure.places.size() == 1)
    out["conductance"] = by_pressure.conductances.front();
  else if (by_pressure.from)
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
    out["friction"] = friction_heat(source, *generation, program);
  } else if (generation) {
    remarks.push_back("*GAP HEAT GENERATION (" + source.at(generation->place) +
                      ") has no effect: the contact has no friction");
  } else if (has_friction && !out.is_null()) {
    remarks.push_back("friction of this contact makes no heat: write *GAP HEAT GENERATION if it shall");
  }
  return out;
}

} // namespace ents_deck
