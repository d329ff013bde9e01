// SPDX-License-Identifier: BSD-3-Clause
#include "contact_pair.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace ents_deck {
namespace {

using std::string;

/// Numbers of a data line; missing ones are absent.
std::vector<std::optional<double>> numbers_of(const Source& source, const Line& line) {
  std::vector<std::optional<double>> out;
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

/// The statements that follow *SURFACE INTERACTION, NAME=`name` and belong to it.
std::vector<const Statement*> parts_of_interaction(const Mesh& mesh, const ContactPair& pair) {
  static const std::vector<string> belonging{
      "SURFACE BEHAVIOR",    "FRICTION",          "CONTACT DAMPING",   "GAP CONDUCTANCE",
      "GAP HEAT GENERATION", "COHESIVE BEHAVIOR", "DAMAGE INITIATION", "DAMAGE EVOLUTION"};
  std::vector<const Statement*> out;
  bool inside = false, found = false;
  for (const Statement& s : mesh.source.list) {
    if (s.keyword == "STEP") break;
    if (s.keyword == "SURFACE INTERACTION")
      inside = upper(s.value("NAME")) == upper(pair.interaction), found = found || inside;
    else if (inside && std::find(belonging.begin(), belonging.end(), s.keyword) != belonging.end())
      out.push_back(&s);
    else
      inside = false;
  }
  if (!found && !pair.interaction.empty())
    mesh.source.fail(pair.line, "there is no *SURFACE INTERACTION, NAME=" + pair.interaction);
  return out;
}

struct Normal {
  nlohmann::ordered_json law;
  double stiffness = 0;
};

/// Stiffness where the deck gives none. CalculiX: its own default, so that both ways mean the same.
double proposed_stiffness(const Mesh& mesh, const ContactPair& pair, const Bodies& bodies, Program program,
                          std::vector<string>& remarks) {
  if (program == Program::calculix && bodies.first_young > 0) {
    remarks.push_back("stiffness " + shown(50 * bodies.first_young, 6) +
                      ": ccx's own default, 50 times Young's modulus of the first material");
    return 50 * bodies.first_young;
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

Normal normal_law(const Mesh& mesh, const ContactPair& pair, const Statement* s, const Bodies& bodies,
                  Program program, std::optional<double> stiffness, std::vector<string>& remarks) {
  const auto penalty = [](double value) {
    return Normal{{{"type", "penalty"}, {"stiffness", value}}, value};
  };
  if (stiffness) return penalty(*stiffness);
  string type = s ? upper(s->value("PRESSURE-OVERCLOSURE")) : "HARD";
  if (type.empty()) type = "HARD";
  const Source& source = mesh.source;
  const auto data =
      s && !s->lines.empty() ? numbers_of(source, s->lines[0]) : std::vector<std::optional<double>>{};
  const auto given = [&](std::size_t i) { return i < data.size() && data[i] && *data[i] > 0; };
  if (type == "HARD" || type == "LINEAR") {
    if (type == "LINEAR" && given(0)) return penalty(*data[0]);
    return penalty(proposed_stiffness(mesh, pair, bodies, program, remarks));
  }
  if (type == "EXPONENTIAL") {
    if (!given(0) || !given(1))
      source.fail(s->place, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL needs c0 > 0 and p0 > 0");
    double clearance = *data[0];
    const double pressure = *data[1], e = std::numbers::e;
    const double slope = (2 * e - 1) / (e - 1); // of the law at zero clearance, in p0 over its clearance
    if (program == Program::calculix) {
      // ccx: p0 exp(ln(100) d / c0). Ours is Abaqus's, zero at its clearance.
      clearance *= slope / std::log(100.0);
      remarks.push_back("exponential: ccx's p0 exp(ln(100) d / c0) and Abaqus's law, which this is, agree in "
                        "value and slope at d = 0");
    }
    return {{{"type", "exponential"}, {"pressure", pressure}, {"clearance", clearance}},
            slope * pressure / clearance};
  }
  if (type == "TABULAR") {
    std::vector<std::pair<double, double>> table; // overclosure, pressure
    for (const Line& line : s->lines) {
      const auto row = numbers_of(source, line);
      if (row.size() < 2 || !row[0] || !row[1]) source.fail(line.place, "expected pressure and overclosure");
      table.emplace_back(*row[1], *row[0]);
    }
    if (table.size() < 2) source.fail(s->place, "a table of pressures needs two lines");
    const auto [from, p] = table.front();
    const auto [to, q] = table.back();
    const double slope = (q - p) / (to - from);
    if (from != 0 || p != 0 || !(slope > 0))
      source.fail(s->lines[0].place,
                  "no law fits a table that does not begin with pressure 0 at overclosure 0");
    for (std::size_t i = 1; i < table.size(); ++i)
      if (std::abs(table[i].second - slope * table[i].first) > 1e-3 * q)
        source.fail(s->lines[i].place, "no law fits this table: it is not a straight line within 1e-3 of its "
                                       "largest pressure. Write the law into the model's \"contact\"");
    remarks.push_back("the table is a straight line: stiffness " + shown(slope, 6));
    return penalty(slope);
  }
  source.fail(
      s->place,
      "PRESSURE-OVERCLOSURE=" + type +
          (type == "TIED"
               ? " ties the surfaces, which no contact law does; leave this pair to the program itself"
               : " is not known; LINEAR, EXPONENTIAL, TABULAR and HARD are"));
}

nlohmann::ordered_json friction_law(const Mesh& mesh, const Statement& s, double stiffness, Program program,
                                    const Bodies& bodies, std::vector<string>& remarks) {
  for (const char* known : {"USER", "ANISOTROPIC", "EXPONENTIAL DECAY", "LAGRANGE", "DEPENDENCIES"})
    if (s.has(known))
      mesh.source.fail(s.place, string("*FRICTION, ") + known +
                                    " is not read; write \"contact\": {\"friction\": ...} into the model");
  nlohmann::ordered_json out;
  if (s.has("ROUGH")) return {{"type", "rough"}, {"stiffness", stiffness}};
  if (s.lines.empty()) mesh.source.fail(s.place, "*FRICTION has no data line");
  const auto data = numbers_of(mesh.source, s.lines[0]);
  if (data.empty() || !data[0] || *data[0] == 0) return nullptr; // Abaqus/CAE writes 0 for "frictionless"
  double slope = program == Program::calculix && data.size() > 1 && data[1] ? *data[1] : 0;
  if (!(slope > 0)) {
    slope = program == Program::calculix && bodies.first_young > 0 ? bodies.first_young / 2 : stiffness / 2;
    remarks.push_back("friction: tangential stiffness " + shown(slope, 6) +
                      (program == Program::calculix
                           ? ", ccx's own default (half of Young's modulus of the first material)"
                           : " proposed, half of the normal one"));
  }
  out = {{"type", "coulomb"}, {"coefficient", *data[0]}, {"stiffness", slope}};
  return out;
}

} // namespace

std::vector<ContactPair> contact_pairs(const Mesh& mesh) {
  std::vector<ContactPair> out;
  for (const Statement& s : mesh.source.list) {
    if (s.keyword != "CONTACT PAIR") continue;
    for (const Line& line : s.lines) {
      const auto fields = fields_of(line.text);
      if (fields.size() < 2 || fields[0].empty() || fields[1].empty())
        mesh.source.fail(
            line.place,
            "expected slave surface, master surface (contact of a surface with itself is not read)");
      ContactPair pair{string(fields[0]), string(fields[1]), s.value("INTERACTION"), &s, line.place, {}};
      if (const string adjust = s.value("ADJUST"); !adjust.empty()) {
        double value = 0;
        pair.adjust = parse(adjust, value) ? value : 0;
        if (!parse(adjust, value) && mesh.node_sets.count(upper(adjust)) == 0)
          mesh.source.fail(s.place, "ADJUST=" + adjust + " is neither a number nor a node set");
      }
      out.push_back(std::move(pair));
    }
  }
  return out;
}

Bodies bodies_of(const Mesh& mesh) {
  Bodies out;
  for (const Statement& s : mesh.source.list) {
    if (s.keyword != "ELASTIC" || s.lines.empty()) continue;
    const string type = upper(s.value("TYPE"));
    if (!type.empty() && type.rfind("ISO", 0) != 0) continue;
    const auto data = numbers_of(mesh.source, s.lines[0]);
    if (data.empty() || !data[0]) continue;
    if (out.first_young == 0) out.first_young = *data[0];
    out.largest_young = std::max(out.largest_young, *data[0]);
  }
  return out;
}

Law law_of(const Mesh& mesh, const ContactPair& pair, const Bodies& bodies, Program program,
           std::optional<double> stiffness) {
  Law out;
  const Statement *behaviour = nullptr, *friction = nullptr;
  for (const Statement* s :
       pair.interaction.empty() ? std::vector<const Statement*>{} : parts_of_interaction(mesh, pair)) {
    if (s->keyword == "SURFACE BEHAVIOR")
      behaviour = s;
    else if (s->keyword == "FRICTION")
      friction = s;
    else
      mesh.source.fail(s->place, "*" + s->keyword +
                                     " of this contact cannot be had from contact elements (they carry "
                                     "forces alone, without damping, heat or cohesion)");
  }
  const Normal normal = normal_law(mesh, pair, behaviour, bodies, program, stiffness, out.remarks);
  out.contact["normal"] = normal.law;
  if (friction)
    if (auto law = friction_law(mesh, *friction, normal.stiffness, program, bodies, out.remarks);
        !law.is_null())
      out.contact["friction"] = std::move(law);
  return out;
}

void refuse_what_cannot_be_done(const Mesh& mesh, const ContactPair& pair, Program program) {
  static const std::vector<std::pair<string, string>> never{
      {"HEAT TRANSFER", "contact elements conduct no heat"},
      {"COUPLED TEMPERATURE-DISPLACEMENT", "contact elements conduct no heat"},
      {"UNCOUPLED TEMPERATURE-DISPLACEMENT", "contact elements conduct no heat"},
      {"FREQUENCY", "in a linear step the program keeps no history of contact elements"},
      {"BUCKLE", "in a linear step the program keeps no history of contact elements"},
      {"COMPLEX FREQUENCY", "in a linear step the program keeps no history of contact elements"},
      {"MODAL DYNAMIC", "in a linear step the program keeps no history of contact elements"},
      {"STEADY STATE DYNAMICS", "in a linear step the program keeps no history of contact elements"},
      {"GREEN", "in a linear step the program keeps no history of contact elements"},
      {"SUBSTRUCTURE GENERATE", "contact elements have no place in a substructure"},
      {"CHANGE FRICTION", "the law of a contact element is that of its model for the whole job"},
      {"CHANGE SURFACE BEHAVIOR", "the law of a contact element is that of its model for the whole job"},
      {"CHANGE CONTACT TYPE", "the law of a contact element is that of its model for the whole job"},
      {"CONTACT", "general contact would carry the same surfaces a second time; leave it out of this deck, "
                  "or write *CONTACT PAIR"},
      {"CONTACT INTERFERENCE", "the gap of a contact element is that of the mesh and of its model's height"},
      {"CLEARANCE", "the gap of a contact element is that of the mesh and of its model's height"},
  };
  const Source& source = mesh.source;
  for (const Statement& s : source.list) {
    for (const auto& [keyword, why] : never)
      if (s.keyword == keyword) source.fail(s.place, "*" + keyword + ": " + why);
    if (s.keyword == "STEP" && s.has("PERTURBATION"))
      source.fail(s.place,
                  "*STEP, PERTURBATION: in a linear step the program keeps no history of contact elements");
    if (s.keyword == "DYNAMIC" && (program == Program::calculix || s.has("EXPLICIT")))
      source.fail(s.place, program == Program::calculix
                               ? "*DYNAMIC: U1E has been verified in *STATIC and *VISCO steps alone"
                               : "*DYNAMIC, EXPLICIT: these are elements of Abaqus/Standard");
    if (s.keyword == "STATIC" && s.has("RIKS"))
      source.fail(s.place,
                  "*STATIC, RIKS: contact elements ask for cuts, which an arc length does not follow");
    if (s.keyword == "MODEL CHANGE" && upper(s.value("TYPE")) == "CONTACT PAIR")
      source.fail(s.place, "*MODEL CHANGE, TYPE=CONTACT PAIR: contact elements stay for the whole job");
  }
  if (pair.statement) {
    const Statement& s = *pair.statement;
    if (upper(s.value("TYPE")) == "MASSLESS")
      source.fail(s.place, "TYPE=MASSLESS is explicit dynamics, which U1E has not been verified in");
    for (const char* known : {"TIED", "HCRIT", "EXTENSION ZONE"})
      if (s.has(known)) source.fail(s.place, string("*CONTACT PAIR, ") + known + " is not read");
  }
}

Motion prescribed_motion(const Mesh& mesh) {
  Motion out;
  Point low{}, high{};
  bool in_step = false;
  for (const Statement& s : mesh.source.list) {
    if (s.keyword == "STEP") in_step = true;
    if (s.keyword != "BOUNDARY" || !in_step || s.has("SUBMODEL")) continue;
    for (const Line& line : s.lines) {
      const auto fields = fields_of(line.text);
      std::int64_t first = 0, last = 0;
      double value = 0;
      if (fields.size() < 4 || !parse(fields[1], first)) continue; // ENCASTRE ..., or no motion
      if (!parse(fields[2], last)) last = first;
      if (!parse(fields[3], value)) continue;
      out.rotates = out.rotates || (value != 0 && last >= 4 && first <= 6);
      for (std::int64_t dof = std::max<std::int64_t>(first, 1); dof <= std::min<std::int64_t>(last, 3);
           ++dof) {
        const auto i = static_cast<std::size_t>(dof - 1);
        low[i] = std::min(low[i], value), high[i] = std::max(high[i], value);
      }
    }
  }
  for (std::size_t i = 0; i < 3; ++i) out.range[i] = high[i] - low[i];
  return out;
}

} // namespace ents_deck
