// SPDX-License-Identifier: BSD-3-Clause
#include "contact_pair.hpp"

#include <algorithm>
#include <string_view>

namespace ents_deck {

using std::string;

namespace {

constexpr std::string_view own_surface = "contact of a surface with itself is not carried: the elements that "
                                         "take its place have fixed nodes, and which "
                                         "faces are a node's own body changes as it moves. Divide the "
                                         "surface into two that may touch and have no node in "
                                         "common";

} // namespace

std::vector<ContactPair> contact_pairs(const Mesh& mesh) {
  std::vector<ContactPair> out;
  for (const Statement& s : mesh.source.list) {
    if (s.keyword != "CONTACT PAIR") continue;
    for (const Line& line : s.lines) {
      const auto fields = fields_of(line.text);
      if (fields.size() < 2 || fields[0].empty() || fields[1].empty())
        mesh.source.fail(line.place, "expected slave surface, master surface; " + string(own_surface));
      if (canonical(fields[0]) == canonical(fields[1]))
        mesh.source.fail(line.place,
                         string("'").append(fields[0]) + "' is slave and master: " + string(own_surface));
      ContactPair pair{string(fields[0]), string(fields[1]), s.value("INTERACTION"), &s, line.place, {}};
      if (const string adjust = s.value("ADJUST"); !adjust.empty()) {
        double value = 0;
        pair.adjust = parse(adjust, value) ? value : 0;
        if (!parse(adjust, value) && mesh.node_sets.count(canonical(adjust)) == 0)
          mesh.source.fail(s.place, "ADJUST=" + adjust + " is neither a number nor a node set");
      }
      out.push_back(std::move(pair));
    }
  }
  return out;
}

void check_elements_stay(const Mesh& mesh, const Side& side) {
  for (const Statement& s : mesh.source.list) {
    if (s.keyword != "MODEL CHANGE") continue;
    for (const Line& line : s.lines)
      for (const auto field : fields_of(line.text)) {
        const string name = canonical(field);
        const auto set = mesh.element_sets.find(name);
        const auto is_named = [&](const Face& f) {
          return set == mesh.element_sets.end()
                     ? canonical(mesh.element_label(f.element)) == name
                     : std::find(set->second.begin(), set->second.end(), f.element) != set->second.end();
        };
        if (std::any_of(side.faces.begin(), side.faces.end(), is_named))
          mesh.source.fail(line.place, "*MODEL CHANGE of '" + string(field) +
                                           "', whose faces are in contact ('" + side.name +
                                           "'): contact elements stay for the whole job; write a "
                                           "deck for each state");
      }
  }
}

std::vector<string> check_pair(const Mesh& mesh, const ContactPair& pair, Program program) {
  if (!pair.statement) return {};
  const Statement& s = *pair.statement;
  if (canonical(s.value("TYPE")) == "MASSLESS")
    mesh.source.fail(s.place, "TYPE=MASSLESS is explicit dynamics, which U1E has not been verified in; write "
                              "TYPE=SURFACE TO SURFACE, or leave the pair to ccx");
  const std::vector<string> remarks = check_statement(mesh.source, s, program);
  for (const Statement& other : mesh.source.list) {
    if (&other == &s) break;
    if (other.keyword == "STEP")
      mesh.source.fail(s.place, "*CONTACT PAIR stands behind *STEP (" + mesh.source.at(other.place) +
                                    "); write it before the first step");
  }
  if (pair.interaction.empty())
    mesh.source.fail(s.place,
                     "*CONTACT PAIR has no INTERACTION=; name the *SURFACE INTERACTION that has its law");
  if (program == Program::calculix && !s.has("TYPE"))
    mesh.source.fail(s.place, "*CONTACT PAIR has no TYPE=; write TYPE=SURFACE TO SURFACE or NODE TO SURFACE");
  return remarks;
}

} // namespace ents_deck
