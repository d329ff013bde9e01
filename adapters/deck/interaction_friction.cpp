// SPDX-License-Identifier: BSD-3-Clause
// Source: Abaqus Analysis User's Guide, "Frictional behavior"; CalculiX manual, *FRICTION.
#include "interaction_friction.hpp"

#include <map>
#include <set>

namespace ents_deck {
namespace {

using std::string;

double coefficient(const Source& source, const Line& line, std::size_t i) {
  constexpr double missing = -1e300;
  const double value = entry(source, line, i, missing);
  if (value == missing)
    source.fail(line.place, "*FRICTION has no coefficient; write it as entry " + std::to_string(i + 1));
  if (!(value >= 0))
    source.fail(line.place, "the coefficient of friction is " + shown(value, 6) + "; write a number from 0");
  return value;
}

/// The keys "coefficient" and, with EXPONENTIAL DECAY, "kinetic" and "decay".
void read_coefficient(const Source& source, const Statement& friction, nlohmann::ordered_json& to) {
  if (friction.has("EXPONENTIAL DECAY")) {
    const Line& line = friction.lines[0];
    if (friction.lines.size() > 1)
      source.fail(friction.lines[1].place,
                  "*FRICTION, EXPONENTIAL DECAY has one data line; leave this one out");
    to["coefficient"] = coefficient(source, line, 0), to["kinetic"] = coefficient(source, line, 1);
    const double decay = entry(source, line, 2, 0);
    if (!(decay > 0))
      source.fail(line.place, "the decay (entry 3) is " + shown(decay, 6) + "; write a number above 0");
    to["decay"] = decay;
    return;
  }
  std::set<double> rates, pressures;
  std::map<std::pair<double, double>, double> points; // pressure, rate
  for (const Line& line : friction.lines) {
    const double mu = coefficient(source, line, 0), rate = entry(source, line, 1, 0),
                 pressure = entry(source, line, 2, 0);
    if (rate < 0 || pressure < 0)
      source.fail(line.place, "slip rate and pressure of a coefficient are numbers from 0");
    if (!points.insert({{pressure, rate}, mu}).second)
      source.fail(line.place,
                  "there is a coefficient for this slip rate and pressure already; leave one out");
    rates.insert(rate), pressures.insert(pressure);
  }
  nlohmann::ordered_json rows = nlohmann::ordered_json::array(), columns = nlohmann::ordered_json::array();
  const bool from_zero = *rates.begin() == 0; // below the first rate its coefficient holds
  if (!from_zero) columns.push_back(0.0);
  for (const double rate : rates) columns.push_back(rate);
  for (const double pressure : pressures) {
    nlohmann::ordered_json row = nlohmann::ordered_json::array();
    for (const double rate : rates) {
      const auto point = points.find({pressure, rate});
      if (point == points.end())
        source.fail(friction.place, "*FRICTION has no coefficient for the slip rate " + shown(rate, 6) +
                                        " at the pressure " + shown(pressure, 6) +
                                        ": write one for every rate at every pressure");
      if (row.empty() && !from_zero) row.push_back(point->second);
      row.push_back(point->second);
    }
    rows.push_back(std::move(row));
  }
  if (points.size() == 1) {
    to["coefficient"] = points.begin()->second;
    return;
  }
  nlohmann::ordered_json table;
  if (pressures.size() > 1) {
    table["pressures"] = nlohmann::ordered_json::array();
    for (const double pressure : pressures) table["pressures"].push_back(pressure);
  }
  if (rates.size() > 1) table["slip_rates"] = std::move(columns);
  if (rates.size() == 1 && !from_zero) // one rate: it does not matter which
    for (auto& row : rows) row.erase(0);
  table["coefficients"] = std::move(rows);
  to["coefficient"] = std::move(table);
}

} // namespace

nlohmann::ordered_json friction_law(const Mesh& mesh, const Statement& s, double stiffness, Program program,
                                    const Bodies& bodies, bool is_tied, std::vector<string>& remarks) {
  const Source& source = mesh.source;
  double limit = 0;
  if (s.has("TAUMAX") && (!parse(s.value("TAUMAX"), limit) || !(limit > 0)))
    source.fail(s.place, "*FRICTION, TAUMAX=" + s.value("TAUMAX") + ": expected a stress above 0");
  if (s.has("ROUGH")) {
    if (limit > 0)
      source.fail(s.place, "*FRICTION, ROUGH never slips, so TAUMAX means nothing; leave one out");
    for (const Line& line : s.lines)
      for (const auto field : fields_of(line.text))
        if (!field.empty())
          source.fail(line.place,
                      "*FRICTION, ROUGH never slips, so " + string(field) + " means nothing; leave it out");
    return {{"type", "rough"}, {"stiffness", stiffness}};
  }
  if (s.lines.empty()) source.fail(s.place, "*FRICTION has no data line; write the coefficient of friction");
  if (program == Program::abaqus) {
    nlohmann::ordered_json out{{"type", "coulomb"}};
    read_coefficient(source, s, out);
    if (out["coefficient"] == 0 && !out.contains("kinetic"))
      return nullptr; // Abaqus/CAE writes 0 for "frictionless"
    remarks.push_back("friction: tangential stiffness " + shown(stiffness / 2, 6) +
                      " proposed, half of the normal one");
    out["stiffness"] = stiffness / 2;
    if (limit > 0) out["shear_limit"] = limit;
    return out;
  }
  const Line& line = s.lines.back(); // ccx: "last line is decisive"
  if (s.lines.size() > 1)
    remarks.push_back("*FRICTION has several data lines: the last one counts, as in ccx (" +
                      source.at(line.place) + ")");
  const double mu = coefficient(source, line, 0);
  if (mu == 0 && !is_tied) return nullptr;
  double slope = entry(source, line, 1, 0);
  if (!(slope > 0)) {
    slope = bodies.first_constant > 0 ? bodies.first_constant / 2 : stiffness / 2;
    remarks.push_back("friction: tangential stiffness " + shown(slope, 6) +
                      (bodies.first_constant > 0
                           ? string(", ccx's own default (half of ") +
                                 (bodies.first_is_young ? "Young's modulus" : "the first constant") +
                                 " of the first material)"
                           : " proposed, half of the normal one"));
  }
  if (is_tied) return {{"type", "rough"}, {"stiffness", slope}}; // ccx: the coefficient is irrelevant
  nlohmann::ordered_json out{{"type", "coulomb"}, {"coefficient", mu}, {"stiffness", slope}};
  if (limit > 0) out["shear_limit"] = limit;
  return out;
}

} // namespace ents_deck
