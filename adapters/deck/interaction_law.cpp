// SPDX-License-Identifier: BSD-3-Clause
// *SURFACE INTERACTION with its *SURFACE BEHAVIOR and *FRICTION: the law of contact elements. Heat:
// interaction_heat.cpp.
#include "interaction_bond.hpp"
#include "interaction_friction.hpp"
#include "interaction_heat.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ents_deck {
namespace {

using std::string;
using Numbers = std::vector<std::optional<double>>;

/// Numbers of a data line; missing ones are absent.
Numbers numbers_of(const Source& source, const Line& line) {
  Numbers out;
  for (const auto field : fields_of(line.text)) {
    double value = 0;
    if (field.empty()) {
      out.emplace_back();
    } else {
      if (!parse(field, value)) source.fail(line.place, "expected a number, found '" + string(field) + "'");
      out.emplace_back(value);
    }
  }
  return out;
}

/// A data line with at most so many entries.
Numbers numbers_of(const Source& source, const Line& line, const std::vector<const char*>& columns) {
  Numbers out = numbers_of(source, line);
  for (std::size_t i = columns.size(); i < out.size(); ++i)
    if (out[i]) {
      string known;
      for (const char* column : columns) known += (known.empty() ? "" : ", ") + string(column);
      source.fail(line.place,
                  "entry " + std::to_string(i + 1) + " (" + shown(*out[i], 6) +
                      ") means nothing to a contact element; " +
                      (columns.empty() ? "this behaviour has no data lines" : "known are " + known) +
                      ": leave it out");
    }
  out.resize(std::max(out.size(), columns.size()));
  return out;
}

struct Interaction {
  const Statement *self = nullptr, *behaviour = nullptr, *friction = nullptr;
  std::vector<const Statement*> heat;
  BondStatements bond;
};

/// *SURFACE INTERACTION of the pair, and what follows it up to the next one. ccx takes the first of several with one
/// name.
Interaction interaction_of(const Mesh& mesh, const ContactPair& pair, Program program,
                           std::vector<string>& remarks) {
  const Source& source = mesh.source;
  Interaction out;
  bool inside = false;
  for (const Statement& s : source.list) {
    if (s.keyword == "STEP") break;
    if (s.keyword == "MATERIAL") inside = false; // what follows is the material's, damage included
    if (s.keyword == "SURFACE INTERACTION") {
      inside = canonical(s.value("NAME")) == canonical(pair.interaction);
      if (!inside) continue;
      if (out.self) {
        const string twice = "*SURFACE INTERACTION, NAME=" + pair.interaction + " is defined at " +
                             source.at(out.self->place) + " and a second time at " + source.at(s.place);
        if (program == Program::abaqus) source.fail(s.place, twice + ": leave one out");
        remarks.push_back(twice + ": the first one counts, as in ccx");
        inside = false;
        continue;
      }
      out.self = &s;
      continue;
    }
    if (!inside) continue;
    const Statement** part = s.keyword == "SURFACE BEHAVIOR" ? &out.behaviour
                             : s.keyword == "FRICTION"       ? &out.friction
                                                             : nullptr;
    if (part) {
      if (*part)
        source.fail(s.place, "the interaction " + pair.interaction + " has *" + s.keyword +
                                 " a second time (first at " + source.at((*part)->place) +
                                 "): leave one out");
      *part = &s;
      continue;
    }
    if (s.keyword == "GAP CONDUCTANCE" || s.keyword == "GAP HEAT GENERATION") {
      out.heat.push_back(&s);
      continue;
    }
    if (const Statement** bond = program != Program::abaqus         ? nullptr
                                 : s.keyword == "COHESIVE BEHAVIOR" ? &out.bond.cohesive
                                 : s.keyword == "DAMAGE INITIATION" ? &out.bond.initiation
                                 : s.keyword == "DAMAGE EVOLUTION"  ? &out.bond.evolution
                                                                    : nullptr) {
      if (*bond)
        source.fail(s.place, "the interaction " + pair.interaction + " has *" + s.keyword +
                                 " a second time (first at " + source.at((*bond)->place) +
                                 "): leave one out");
      *bond = &s;
      continue;
    }
    for (const char* other : keywords_of_interactions())
      if (s.keyword == other)
        source.fail(s.place, "*" + s.keyword +
                                 " of this contact cannot be had from contact elements (they are without "
                                 "damping, radiation or cohesion); leave this pair to the program itself");
  }
  if (!out.self) source.fail(pair.line, "there is no *SURFACE INTERACTION, NAME=" + pair.interaction);
  std::vector<const Statement*> all{out.self, out.behaviour, out.friction};
  all.insert(all.end(), out.heat.begin(), out.heat.end());
  for (const Statement* s : all) {
    if (!s) continue;
    const auto more = check_statement(source, *s, program);
    remarks.insert(remarks.end(), more.begin(), more.end());
  }
  return out;
}

struct Normal {
  nlohmann::ordered_json law;
  double stiffness = 0;
};

Normal penalty(double stiffness) { return {{{"type", "penalty"}, {"stiffness", stiffness}}, stiffness}; }

/// Stiffness where the deck gives none. CalculiX: its own default, so that both ways mean the same.
double proposed_stiffness(const Mesh& mesh, const ContactPair& pair, const Bodies& bodies, Program program,
                          std::vector<string>& remarks) {
  if (program == Program::calculix && bodies.first_constant > 0) {
    const double value = 50 * bodies.first_constant;
    remarks.push_back("stiffness " + shown(value, 6) + ": ccx's own default, 50 times " +
                      (bodies.first_is_young
                           ? "Young's modulus"
                           : "the first constant (" + shown(bodies.first_constant, 6) + ")") +
                      " of the first material");
    return value;
  }
  if (!(bodies.largest_young > 0) || !(bodies.face_size > 0))
    mesh.source.fail(pair.line, "no stiffness of the contact is given, and there is no *ELASTIC to propose "
                                "one from; write --stiffness or a model with \"contact\"");
  const double value = 10 * bodies.largest_young / bodies.face_size;
  remarks.push_back("stiffness " + shown(value, 6) +
                    " proposed: 10 E / h with E = " + shown(bodies.largest_young, 6) +
                    " and faces of size h = " + shown(bodies.face_size, 6) + "; --stiffness for another one");
  return value;
}

/// *SURFACE BEHAVIOR with what its law is made of.
struct Behaviour {
  const Mesh& mesh;
  const ContactPair& pair;
  const Bodies& bodies;
  Program program;
  std::vector<string>& remarks;
  double clearance = 0; ///< result: the gap at which the pressure begins

  const Source& source() const { return mesh.source; }

  double proposed() const { return proposed_stiffness(mesh, pair, bodies, program, remarks); }

  /// One data line at most, with these columns.
  Numbers line(const Statement& s, const std::vector<const char*>& columns) const {
    for (std::size_t i = 1; i < s.lines.size(); ++i)
      for (const auto& number : numbers_of(source(), s.lines[i]))
        if (number) source().fail(s.lines[i].place, "this behaviour has one data line; leave the others out");
    return s.lines.empty() ? Numbers(columns.size()) : numbers_of(source(), s.lines[0], columns);
  }

  /// Abaqus: stiffness, clearance at which the pressure is zero, factor of the default stiffness.
  Normal hard(const Statement* s) {
    const bool by_penalty = s && (s->has("PENALTY") || s->has("AUGMENTED LAGRANGE"));
    if (s && canonical(s->value("PENALTY")) == "NONLINEAR")
      source().fail(s->place,
                    "*SURFACE BEHAVIOR, PENALTY=NONLINEAR: its stiffness grows with the penetration; write "
                    "PENALTY=LINEAR, or a law into a model, \"contact\": {...}, and name it with --model");
    if (!by_penalty) {
      if (s)
        line(*s, program == Program::calculix ? std::vector<const char*>{"stiffness", "tension", "c0"}
                                              : std::vector<const char*>{});
      if (s && program == Program::calculix)
        return linear(*s); // ccx reads HARD as LINEAR, its data line included
      return penalty(proposed());
    }
    const Numbers data = line(*s, {"stiffness", "clearance", "factor of the default stiffness"});
    if (data[1].value_or(0) < 0 || data[0].value_or(0) < 0 || data[2].value_or(1) <= 0)
      source().fail(s->lines[0].place, "expected a stiffness and a clearance from 0, and a factor above 0");
    clearance = data[1].value_or(0);
    if (clearance > 0)
      remarks.push_back("the pressure begins at a gap of " + shown(clearance, 6) +
                        ": the master is raised by it");
    if (!(data[0].value_or(0) > 0)) return penalty(data[2].value_or(1) * proposed());
    if (data[2] && *data[2] != 1)
      source().fail(s->lines[0].place,
                    "a stiffness and a factor of the default one exclude each other; write "
                    "the stiffness alone");
    return penalty(*data[0]);
  }

  /// ccx has two numbers more, for clearances: they make its law smooth there.
  Normal linear(const Statement& s) {
    const bool ccx = program == Program::calculix;
    const Numbers data =
        line(s, ccx ? std::vector<const char*>{"stiffness", "tension at large clearances", "c0"}
                    : std::vector<const char*>{"stiffness"});
    if (ccx && (data[1].value_or(0) > 0 || data[2].value_or(0) > 0))
      remarks.push_back(
          "ccx's tension at large clearances and c0 make its own law smooth; the penalty law has a kink");
    if (!ccx && data[0] && !(*data[0] > 0))
      source().fail(s.lines[0].place, "expected a stiffness above 0, found " + shown(*data[0], 6));
    return penalty(data[0].value_or(0) > 0 ? *data[0] : proposed());
  }

  Normal exponential(const Statement& s) {
    const Numbers data = line(s, {"c0", "p0"});
    if (!(data[0].value_or(0) > 0) || !(data[1].value_or(0) > 0))
      source().fail(s.place, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL needs c0 > 0 and p0 > 0");
    double width = *data[0];
    const double pressure = *data[1], e = std::numbers::e;
    const double slope = (2 * e - 1) / (e - 1); // of the law at zero clearance, in p0 over its clearance
    if (program == Program::calculix) {
      // ccx: p0 exp(ln(100) d / c0). Ours is Abaqus's, zero at its clearance.
      width *= slope / std::log(100.0);
      remarks.push_back("exponential: ccx's p0 exp(ln(100) d / c0) and Abaqus's law, which this is, agree in "
                        "value and slope at d = 0");
    }
    return {{{"type", "exponential"}, {"pressure", pressure}, {"clearance", width}},
            slope * pressure / width};
  }

  Normal tabular(const Statement& s) {
    std::vector<std::pair<double, double>> table; // overclosure, pressure
    for (const Line& data : s.lines) {
      const auto row = numbers_of(source(), data, {"pressure", "overclosure"});
      if (!row[0] || !row[1]) source().fail(data.place, "expected pressure and overclosure");
      table.emplace_back(*row[1], *row[0]);
    }
    if (table.size() < 2) source().fail(s.place, "a table of pressures needs two lines");
    const auto [from, p] = table.front();
    const auto [to, q] = table.back();
    const double slope = (q - p) / (to - from);
    if (from != 0 || p != 0 || !(slope > 0))
      source().fail(s.lines[0].place,
                    "no law fits a table that does not begin with pressure 0 at overclosure 0");
    for (std::size_t i = 1; i < table.size(); ++i)
      if (std::abs(table[i].second - slope * table[i].first) > 1e-3 * q)
        source().fail(s.lines[i].place,
                      "no law fits this table: it is not a straight line within 1e-3 of its "
                      "largest pressure. Write the law into the model's \"contact\"");
    remarks.push_back("the table is a straight line: stiffness " + shown(slope, 6));
    return penalty(slope);
  }

  Normal law(const Statement* s) {
    const string type = s ? canonical(s->value("PRESSURE-OVERCLOSURE")) : "";
    Normal made = of_type(s, type);
    return s && s->has("NO SEPARATION") ? without_separation(*s, made) : made;
  }

  Normal of_type(const Statement* s, const string& type) {
    if (type.empty() || type == "HARD") return hard(s);
    if (type == "TIED" && program == Program::calculix) return tied(*s);
    if (s->has("PENALTY") || s->has("AUGMENTED LAGRANGE"))
      source().fail(s->place,
                    "*SURFACE BEHAVIOR: PENALTY and AUGMENTED LAGRANGE are for PRESSURE-OVERCLOSURE=HARD; "
                    "leave one out");
    if (type == "LINEAR") return linear(*s);
    if (type == "EXPONENTIAL") return exponential(*s);
    if (type == "TABULAR") return tabular(*s);
    source().fail(s->place, "PRESSURE-OVERCLOSURE=" + s->value("PRESSURE-OVERCLOSURE") +
                                " is not known; LINEAR, EXPONENTIAL, TABULAR, HARD and ccx's TIED are");
  }

  /// A gap above the rounding of the mesh: what touches there does not part again.
  double touching() const { return 1e-6 * (bodies.face_size > 0 ? bodies.face_size : 1); }

  /// Once in contact a point stays: pressure and tension have one stiffness.
  Normal without_separation(const Statement& s, Normal of) const {
    if (of.law.at("type") != "penalty")
      source().fail(s.place, "*SURFACE BEHAVIOR, NO SEPARATION is for a law with one stiffness; write "
                             "PRESSURE-OVERCLOSURE=LINEAR or HARD, or leave NO SEPARATION out");
    remarks.push_back("no separation: a point that touches is tied, also in tension");
    return {{{"type", "tied"}, {"stiffness", of.stiffness}, {"range", touching()}}, of.stiffness};
  }

  /// ccx: stiffness, and what *FRICTION has as its stick slope.
  Normal tied(const Statement& s) {
    const Numbers data = line(s, {"stiffness"});
    const double stiffness = data[0].value_or(0) > 0 ? *data[0] : proposed();
    const double range = std::max(pair.adjust.value_or(0), 0.5 * bodies.face_size);
    remarks.push_back("tied: points that are at most " + shown(range, 6) +
                      " away at the begin, half a face of the slave or ADJUST");
    return {{{"type", "tied"}, {"stiffness", stiffness}, {"range", range > 0 ? range : touching()}},
            stiffness};
  }
};

} // namespace

Bodies bodies_of(const Mesh& mesh) {
  static const std::vector<string> with_constants{"ELASTIC", "HYPERELASTIC", "HYPERFOAM", "USER MATERIAL"};
  Bodies out;
  int materials = 0;
  for (const Statement& s : mesh.source.list) {
    if (s.keyword == "MATERIAL") ++materials;
    if (std::find(with_constants.begin(), with_constants.end(), s.keyword) == with_constants.end() ||
        s.lines.empty())
      continue;
    const auto data = numbers_of(mesh.source, s.lines[0]);
    if (data.empty() || !data[0]) continue;
    const string type = canonical(s.value("TYPE"));
    const bool young = s.keyword == "ELASTIC" && (type.empty() || type.rfind("ISO", 0) == 0);
    if (materials <= 1 && out.first_constant == 0) out.first_constant = *data[0], out.first_is_young = young;
    if (young) out.largest_young = std::max(out.largest_young, *data[0]);
  }
  return out;
}

Law law_of(const Mesh& mesh, const ContactPair& pair, const Bodies& bodies, Program program,
           std::optional<double> stiffness) {
  Law out;
  Interaction parts;
  if (!pair.interaction.empty()) parts = interaction_of(mesh, pair, program, out.remarks);
  Behaviour behaviour{mesh, pair, bodies, program, out.remarks};
  std::vector<string> unused; // of numbers that --stiffness takes the place of
  Behaviour replaced{mesh, pair, bodies, program, unused};
  Normal normal;
  if (stiffness) {
    if (parts.behaviour) replaced.law(parts.behaviour); // what is refused stays refused
    normal = penalty(*stiffness);
    out.clearance = replaced.clearance;
  } else {
    normal = behaviour.law(parts.behaviour);
    out.clearance = behaviour.clearance;
  }
  if (parts.bond.cohesive) {
    normal.law = cohesive_law(mesh.source, parts.bond, behaviour.touching(), out.remarks);
    normal.stiffness = normal.law.at("stiffness");
  } else if (parts.bond.initiation || parts.bond.evolution) {
    const Statement& s = parts.bond.initiation ? *parts.bond.initiation : *parts.bond.evolution;
    mesh.source.fail(s.place, "*" + s.keyword +
                                  " of this contact has no *COHESIVE BEHAVIOR; write it, or leave "
                                  "the damage out");
  }
  const bool is_tied = program == Program::calculix && normal.law.at("type") == "tied";
  out.contact["normal"] = normal.law;
  if (parts.friction)
    if (auto law =
            friction_law(mesh, *parts.friction, normal.stiffness, program, bodies, is_tied, out.remarks);
        !law.is_null())
      out.contact["friction"] = std::move(law);
  if (auto heat = heat_law(mesh.source, parts.heat, program, out.contact.contains("friction"), out.remarks);
      !heat.is_null())
    out.contact["heat"] = std::move(heat);
  return out;
}

} // namespace ents_deck
