// SPDX-License-Identifier: BSD-3-Clause
// What ents-deck takes, passes over and refuses of the keywords of contact: every entry of its table, and decks changed
// at random.
#include <random>

#include "deck_text.hpp"
#include "keywords.hpp"

namespace ents_deck::deck_keywords_test {
namespace {

/// What the table says of a statement.
string said(Program program, const string& text) {
  return error_of([&] {
    const Source source = read_source_text(text, "deck.inp", ".");
    check_keywords(source, program);
    for (const Statement& s : source.list) check_statement(source, s, program);
  });
}

void expect_refused(Program program, const string& text, const string& name) {
  const string error = said(program, text);
  EXPECT_NE(error.find("deck.inp:1: "), string::npos) << text << " -> " << error;
  EXPECT_NE(error.find(name), string::npos) << text << " -> " << error;
}

void expect_taken(Program program, const string& text) {
  EXPECT_EQ(said(program, text), "nothing is wrong") << text;
}

/// A letter changed, so that it is no name of the table.
string misspelt(string name) {
  name[name.size() / 2] = name[name.size() / 2] == 'Q' ? 'Z' : 'Q';
  return name;
}

string without_blanks(const string& text) { return canonical(text); }

string in_small_letters(string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// A value that the rule takes.
string good_value(const ParameterRule& rule) {
  if (rule.values == "*") return "=X1";
  if (rule.values.starts_with('!')) return "=X1";
  if (rule.values.empty() || rule.values.front() == '|') return "";
  string out(1, '=');
  return out.append(rule.values, 0, rule.values.find('|'));
}

TEST(DeckKeywords, EveryParameterIsTakenOrRefusedHoweverItIsSpelled) {
  int parameters = 0;
  for (const Program program : {Program::calculix, Program::abaqus})
    for (const KeywordRule& rule : keyword_rules(program)) {
      const string head = "*" + rule.name;
      if (rule.use == Use::refused) {
        for (const string& spelling : {head, without_blanks(head), in_small_letters(head)})
          expect_refused(program, spelling + "\n", "*" + rule.name + ": " + rule.why);
        continue;
      }
      expect_taken(program, head + "\n");
      expect_taken(program, without_blanks(in_small_letters(head)) + "\n");
      if (rule.name.size() >= 8) {
        expect_refused(program, misspelt(head) + "\n", "is *" + rule.name + " meant?");
        if (rule.name != "DYNAMIC") expect_refused(program, head + "X\n", "is *" + rule.name + " meant?");
      }
      const bool open = std::any_of(rule.parameters.begin(), rule.parameters.end(),
                                    [](const ParameterRule& p) { return p.name == "*"; });
      for (const ParameterRule& p : rule.parameters) {
        if (p.name == "*") continue;
        ++parameters;
        const string set = head + ", " + p.name + good_value(p);
        if (p.use == Use::refused) {
          expect_refused(program, set + "\n", "*" + rule.name + ", " + p.name + ": " + p.why);
          expect_refused(program, in_small_letters(without_blanks(set)) + "\n", p.why);
          continue;
        }
        for (const string& spelling :
             {set, in_small_letters(set), without_blanks(set), head + " ,  " + p.name + good_value(p)})
          expect_taken(program, spelling + "\n");
        expect_refused(program, set + ", " + p.name + good_value(p) + "\n", "twice");
        if (open && p.name.size() < 5) continue;
        expect_refused(program, head + ", " + misspelt(p.name) + good_value(p) + "\n", "is not known");
        if (p.values == "*")
          expect_refused(program, head + ", " + p.name + "\n", "has no value");
        else if (p.values.starts_with('!'))
          expect_refused(program, head + ", " + p.name + "=" + p.values.substr(1) + "\n", p.why);
        else
          expect_refused(program, head + ", " + p.name + "=NOSUCHVALUE\n", p.name);
      }
      if (rule.columns.empty()) continue;
      string line;
      for (const ColumnRule& c : rule.columns) line += (c.use == Use::refused ? c.only : "1") + ", ";
      expect_taken(program, head + "\n" + line + "\n");
      const string error = said(program, head + "\n" + line + "7\n");
      EXPECT_NE(error.find("deck.inp:2: *" + rule.name + " has an entry " +
                           std::to_string(rule.columns.size() + 1)),
                string::npos)
          << error;
      string before;
      for (const ColumnRule& c : rule.columns) {
        if (c.use == Use::refused) {
          const string refused = said(program, head + "\n" + before + "77\n");
          EXPECT_NE(refused.find("deck.inp:2: *" + rule.name + ", " + c.name), string::npos) << refused;
          EXPECT_NE(refused.find(c.why), string::npos) << refused;
        }
        before += (c.use == Use::refused ? c.only : "1") + ", ";
      }
    }
  EXPECT_GT(parameters, 80);
}

// The four keywords that make a pair: what they need is asked for where it is missing.
TEST(DeckKeywords, WhatAPairNeedsIsAskedFor) {
  const auto refused = [](const string& changed, const string& by, const char* where, const char* what) {
    const string error = error_of([&] { converted(deck(changed, by)); });
    EXPECT_NE(error.find(where), string::npos) << error;
    EXPECT_NE(error.find(what), string::npos) << error;
  };
  refused("INTERACTION=I, TYPE", "TYPE", "deck.inp:", "*CONTACT PAIR has no INTERACTION=");
  refused(", TYPE=SURFACE TO SURFACE", "", "deck.inp:", "*CONTACT PAIR has no TYPE=");
  refused("\nSLAVE, MASTER", "\nSLAVE, slave",
          "deck.inp:", "'SLAVE' is slave and master: contact of a surface with itself is not carried");
  refused("\nSLAVE, MASTER", "\nSLAVE", "deck.inp:", "contact of a surface with itself is not carried");
  refused("*SURFACE INTERACTION, NAME=I", "*SURFACE INTERACTION, NAME=J",
          "deck.inp:", "there is no *SURFACE INTERACTION");
  refused("TYPE=SURFACE TO SURFACE", "TYPE=SURFACE TO MOON", "deck.inp:", "SURFACE TO MOON is not known");
  refused("TYPE=SURFACE TO SURFACE", "TYPE=MASSLESS", "deck.inp:", "explicit dynamics");
  refused("ETOP, S1", "ETPO, S1",
          "deck.inp:", "there is no element set 'ETPO' here, nor is it an element number");
  refused("1e6\n", "1e6, , , 7.\n", "deck.inp:", "entry 4 (7) means nothing");
  refused("1e6\n", "1e6\n*FRICTION\n-0.3\n",
          "deck.inp:", "coefficient of friction is -0.3; write a number from 0");
  refused("1e6\n", "1e6\n*FRICTION, ROUGH\n",
          "deck.inp:", "*FRICTION, ROUGH is not known"); // ccx reads no parameters
  refused("1e6\n", "1e6\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e5\n",
          "deck.inp:", "a second time");
  refused("SLAVE, MASTER", "SLAVE, MASTER, X", "deck.inp:", "entry 3");
  refused("*SURFACE, NAME=SLAVE\nETOP, S1", "*SURFACE, NAME=SLAVE\nETOP, S1, S2", "deck.inp:", "entry 3");
  refused("*STEP, NLGEOM", "*STEP, NLGEOM\n*CHANGEFRICTION, INTERACTION=I",
          "deck.inp:", "*CHANGE FRICTION: ");
  refused("*STEP, NLGEOM", "*STEP, NLGEOM\n*modelchange, type=contactpair, remove",
          "deck.inp:", "*MODEL CHANGE, TYPE");
}

TEST(DeckKeywords, RepeatedFacesAndDefinitionsAreThoseOfCcx) {
  const Job once = converted(deck());
  const auto area = [](const Job& job) {
    double sum = 0;
    for (const ContactElement& e : job.elements) sum += e.slave.area;
    return sum;
  };
  EXPECT_EQ(area(converted(deck("ETOP, S1\n", "ETOP, S1\n101, S1\nETOP, S1\n"))), area(once));
  // The first of two interactions with one name is taken, and said; of several lines of *FRICTION the last.
  const Job first = converted(deck(
      "*CONTACT PAIR",
      "*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n7.\n*CONTACT PAIR"));
  EXPECT_EQ(first.models.at(0).text.at("contact").at("normal").at("stiffness"), 1e6);
  ASSERT_FALSE(first.contacts.at(0).remarks.empty());
  EXPECT_NE(first.contacts.at(0).remarks.at(0).find("the first one counts, as in ccx"), string::npos);
  const Job last = converted(deck("1e6\n", "1e6\n*FRICTION\n0.1, 5.\n0.4, 6.\n"));
  EXPECT_EQ(last.models.at(0).text.at("contact").at("friction").at("coefficient"), 0.4);
  EXPECT_EQ(last.models.at(0).text.at("contact").at("friction").at("stiffness"), 6.0);
}

TEST(DeckKeywords, OfAbaqusAreTranslatedWhereALawHasThem) {
  Options options;
  options.program = Program::abaqus;
  const auto made = [&](const string& behaviour) {
    return converted(deck("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e6\n", behaviour), options);
  };
  const auto contact = [&](const string& behaviour) {
    return made(behaviour).models.at(0).text.at("contact");
  };
  EXPECT_EQ(contact("*FRICTION, TAUMAX=10., SLIP TOLERANCE=0.005\n0.2\n").at("friction").at("shear_limit"),
            10.0);
  const Job job = made("*SURFACE BEHAVIOR, PENALTY\n1000., 0.02\n");
  EXPECT_EQ(job.models.at(0).text.at("contact").at("normal").at("stiffness"), 1000.0);
  EXPECT_EQ(job.contacts.at(0).rise, 0.02); // the gap at which the pressure begins
  EXPECT_EQ(job.models.at(0).text.at("height").at("value"), 0.02);
  const double proposed = contact("*SURFACE BEHAVIOR, PENALTY\n").at("normal").at("stiffness");
  EXPECT_EQ(contact("*SURFACE BEHAVIOR, PENALTY\n, , 0.5\n").at("normal").at("stiffness"), 0.5 * proposed);
  const auto refused = [&](const string& behaviour, const char* what) {
    const string error = error_of([&] { made(behaviour); });
    EXPECT_NE(error.find(what), string::npos) << error;
    EXPECT_NE(error.find("deck.inp:"), string::npos) << error;
  };
  refused("*SURFACE BEHAVIOR, PENALTY=NONLINEAR\n", "grows with the penetration");
  refused("*SURFACE BEHAVIOR, PENALTY\n1000., , 0.02\n", "exclude each other");
  refused("*FRICTION\n0.2, , , 20.\n", "*FRICTION, temperature (entry 4), '20.'");
  refused("*FRICTION, TAUMAX=0\n0.2\n", "TAUMAX=0: expected a stress above 0");
  refused("*FRICTION, USER\n", "a subroutine of your own");
}

/// Abaqus takes what is written short: "*FRIC", "GEN". Nothing may be lost by it.
TEST(DeckKeywords, AbbreviationsOfAbaqusAreRefused) {
  for (const Program program : {Program::calculix, Program::abaqus}) {
    expect_refused(program, "*FRIC\n", "is *FRICTION meant?");
    expect_refused(program, "*surface behav\n", "is *SURFACE BEHAVIOR meant?");
    expect_refused(program, "*NSET, NSET=A, GEN\n", "is GENERATE meant?");
    expect_refused(program, "*STEP, PERT\n", "is PERTURBATION meant?");
    expect_taken(program, "*MASS, ELSET=E\n");
    expect_taken(program, "*GAP, ELSET=E\n");
  }
}

TEST(DeckKeywords, WhatContactElementsDoNotHaveIsRefusedOrReported) {
  Options options;
  options.program = Program::abaqus;
  const auto made = [&](const string& changed, const string& by) {
    return converted(deck(changed, by), options);
  };
  const auto refused = [&](const string& changed, const string& by, const char* what) {
    const string error = error_of([&] { made(changed, by); });
    EXPECT_NE(error.find(what), string::npos) << by << " -> " << error;
    EXPECT_NE(error.find("deck.inp:"), string::npos) << error;
  };
  for (const char* name : {"RANDOM RESPONSE", "DIRECT CYCLIC", "STEADY STATE TRANSPORT", "ANNEAL",
                           "DYNAMIC TEMPERATURE-DISPLACEMENT"})
    refused("*STATIC", string("*") + name, name);
  for (const char* name :
       {"PRESSURE PENETRATION, SLAVE=SLAVE, MASTER=MASTER", "DEBOND, SLAVE=SLAVE, MASTER=MASTER"})
    refused("*STATIC\n", string("*STATIC\n*") + name + "\n", "contact elements");
  refused("*STEP", "*INITIAL CONDITIONS, TYPE=CONTACT\nSLAVE, MASTER, NLOW\n*STEP", "bonded part");
  for (const char* name : {"FRACTURE CRITERION, TYPE=VCCT", "BOND", "GAP ELECTRICAL CONDUCTANCE"})
    refused("1e6\n", string("1e6\n*") + name + "\n", "cannot be had from contact elements");
  // Elements below the surfaces stay; others may go.
  refused("*STATIC\n", "*STATIC\n*MODEL CHANGE, REMOVE\nLOW\n", "whose faces are in contact ('MASTER')");
  refused("*STATIC\n", "*STATIC\n*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n101\n", "('SLAVE')");
  refused("TYPE=C3D8, ELSET=LOW", "TYPE=C3D8RP, ELSET=LOW", "faces of C3D8RP, whose pore pressure");

  // Damage of a material that follows is not that of the interaction.
  const string damage = "*MATERIAL, NAME=Q\n*DAMAGE INITIATION, CRITERION=DUCTILE\n1.\n*CONTACT PAIR";
  EXPECT_GT(made("*CONTACT PAIR", damage).elements.size(), 0U);
  // Without effect: said with file and line.
  for (const char* name :
       {"CONTACT CONTROLS, STABILIZE", "CONTACT OUTPUT", "CONTACT PRINT", "CONTACT FILE"}) {
    const Job job = made("*STATIC\n", string("*STATIC\n*") + name + "\n");
    const string remark = job.contacts.at(0).remarks.back();
    EXPECT_TRUE(remark.starts_with("*" + string(name).substr(0, string(name).find(',')) + " (")) << remark;
    EXPECT_NE(remark.find("deck.inp:"), string::npos) << remark;
    EXPECT_NE(remark.find("contact elements"), string::npos) << remark;
  }
}

TEST(DeckKeywords, MotionsThatTheDeckDoesNotTellAreReported) {
  const auto motion = [](const string& amplitude, const string& line) {
    return prescribed_motion(mesh_of(two_blocks() + amplitude + "*STEP\n*STATIC\n" + line));
  };
  const Motion file =
      motion("*AMPLITUDE, NAME=A, INPUT=a.txt\n", "*BOUNDARY, AMPLITUDE=A\nNHIGH, 1, 1, 0.5\n");
  ASSERT_EQ(file.remarks.size(), 1U);
  EXPECT_NE(file.remarks[0].find("its values are not in the deck"), string::npos);
  const string absolute = "*AMPLITUDE, NAME=A, VALUE=ABSOLUTE\n0., 0., 1., 3.\n";
  for (const char* line : {"NHIGH, 1\n", "NHIGH, 1, 1\n", "NHIGH, 1, 1, 0.5\n"})
    EXPECT_EQ(motion(absolute, string("*BOUNDARY, AMPLITUDE=A\n") + line).range[0], 3.0) << line;
  EXPECT_NE(error_of([&] {
              motion("", "*BOUNDARY\nNHIGH, 1, 1, <slide>\n");
            }).find("expected a number, found '<slide>'"),
            string::npos);
}

TEST(DeckText, Encodings) {
  const string text = deck();
  EXPECT_EQ(converted("\xEF\xBB\xBF" + text).elements.size(), converted(text).elements.size());
  string wide = "\xFF\xFE";
  for (const char c : text) wide += c, wide += '\0';
  EXPECT_NE(error_of([&] { converted(wide); }).find("deck.inp: the file is in UTF-16"), string::npos);
  EXPECT_NE(error_of([&] { converted(wide.substr(2)); }).find("the file is in UTF-16"), string::npos);
  string old = text;
  std::replace(old.begin(), old.end(), '\n', '\r');
  EXPECT_NE(error_of([&] { converted(old); }).find("carriage return (CR) alone"), string::npos);
  old = text;
  old[old.find('\n', 200)] = '\r';
  EXPECT_NE(error_of([&] { converted(old); }).find("stands inside the line"), string::npos);
}

// ---- decks changed at random ----

/// All of a job that a host program is given.
string meaning(const Job& job) {
  std::ostringstream out;
  out.precision(17);
  for (const Model& model : job.models) out << model.text.dump() << '\n';
  for (const ContactElement& e : job.elements) {
    out << e.model << ' ' << e.slave.area;
    for (std::size_t i = 0; i < e.slave.nodes.size(); ++i)
      out << ' ' << e.slave.nodes[i] << ' ' << e.slave.weights[i];
    for (const int node : e.masters) out << ' ' << node;
    for (const double s : e.surface_coordinates) out << ' ' << s;
    out << '\n';
  }
  return out.str();
}

struct Lines {
  std::vector<string> all;
  explicit Lines(const string& text) {
    std::istringstream stream(text);
    for (string line; std::getline(stream, line);) all.push_back(line);
  }
  string text() const {
    string out;
    for (const string& line : all) out += line + '\n';
    return out;
  }
};

/// Lines of the keywords that matter to contact, and their data lines.
std::vector<std::size_t> lines_of_contact(const Lines& lines, bool data) {
  std::vector<std::size_t> out;
  bool inside = false;
  for (std::size_t i = 0; i < lines.all.size(); ++i) {
    const string& line = lines.all[i];
    if (!line.empty() && line[0] == '*')
      inside =
          line.starts_with("*SURFACE") || line.starts_with("*FRICTION") || line.starts_with("*CONTACT PAIR");
    if (inside && (line[0] != '*') == data) out.push_back(i);
  }
  return out;
}

// 200 changes: a parameter more, blanks moved, a name changed in one place, an entry of a data line more. Each gives
// the same elements, or is refused with a line; none is passed over.
TEST(DeckKeywords, ChangedDecksMeanTheSameOrAreRefused) {
  std::mt19937 random(20);
  const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const string before = deck("1e6\n", "1e6\n*FRICTION\n0.2, 5e5\n");
  const string right = meaning(converted(before));
  int same = 0, refused = 0;
  const std::vector<string> more{"SHIFT=1",   "ROUGH",          "TIED",      "USER",          "NO SEPARATION",
                                 "TAUMAX=3.", "HCRIT=0.1",      "TYPE=NODE", "SMALL SLIDING", "LAGRANGE",
                                 "PENALTY",   "ADJUST=SOMESET", "NAME=Q",    "COMBINE=UNION"};
  for (int run = 0; run < 200; ++run) {
    Lines lines(before);
    bool must_be_same = false;
    const std::size_t kind = pick(4);
    if (kind == 0) { // a parameter
      const auto where = lines_of_contact(lines, false);
      lines.all[where[pick(where.size())]] += ", " + more[pick(more.size())];
    } else if (kind == 1) { // blanks
      must_be_same = true;
      const auto where = lines_of_contact(lines, pick(2) == 1);
      string& line = lines.all[where[pick(where.size())]];
      if (pick(2) == 1) {
        std::erase(line, ' ');
      } else {
        const std::size_t comma = line.find(',');
        line.insert(comma == string::npos ? line.size() : comma + pick(2), 1 + pick(3), ' ');
      }
      if (line[0] == '*' && pick(2) == 1) line = in_small_letters(line);
    } else if (kind == 2) { // a name
      const auto where = lines_of_contact(lines, pick(2) == 1);
      string& line = lines.all[where[pick(where.size())]];
      static const std::vector<string> names{"SLAVE", "MASTER", "ETOP", "LOW", "=I"};
      const string& name = names[pick(names.size())];
      if (const std::size_t at = line.find(name); at != string::npos) line.insert(at + name.size(), 1, 'X');
    } else { // an entry
      const auto where = lines_of_contact(lines, true);
      string& line = lines.all[where[pick(where.size())]];
      const std::size_t entries = fields_of(line).size();
      line.append(1 + pick(3), ',');
      line += entries == 1 ? "S9" : "0.25";
    }
    const string text = lines.text();
    string found;
    const string error = error_of([&] { found = meaning(converted(text)); });
    if (error == "nothing is wrong") {
      EXPECT_EQ(found, right) << "the meaning changed without a word:\n"
                              << text.substr(text.find("*SURFACE"));
      ++same;
    } else {
      EXPECT_NE(error.find("deck.inp:"), string::npos) << error;
      EXPECT_FALSE(must_be_same) << error;
      ++refused;
    }
  }
  std::printf("200 changed decks: %d mean the same, %d are refused, none is passed over\n", same, refused);
  EXPECT_GT(same, 30);
  EXPECT_GT(refused, 60);
}

} // namespace
} // namespace ents_deck::deck_keywords_test
