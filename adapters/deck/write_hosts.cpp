// SPDX-License-Identifier: BSD-3-Clause
// User elements as CalculiX and Abaqus read them.
#include <algorithm>
#include <map>

#include "write.hpp"

namespace ents_deck {
namespace {

using std::string;

/// Numbers or words of a data line, at most `per_line` on one.
string data_lines(const std::vector<string>& words, std::size_t per_line) {
  string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    out += words[i];
    if (i + 1 == words.size())
      out += '\n';
    else
      out += (i + 1) % per_line == 0 ? ",\n" : ", ";
  }
  return out;
}

/// Elements of each model, in order.
std::vector<std::vector<std::size_t>> by_model(const Job& job) {
  std::vector<std::vector<std::size_t>> out(job.models.size());
  for (std::size_t i = 0; i < job.elements.size(); ++i)
    out[static_cast<std::size_t>(job.elements[i].model)].push_back(i);
  return out;
}

string element_lines(const Job& job, const std::vector<std::size_t>& elements) {
  const std::int64_t first = first_free_element(job);
  string out;
  for (const std::size_t i : elements) {
    const ContactElement& e = job.elements[i];
    std::vector<string> words{std::to_string(first + static_cast<std::int64_t>(i)),
                              job.mesh.node_label(e.slave.nodes[0])};
    for (std::size_t k = 1; k < e.slave.nodes.size(); ++k)
      words.push_back(job.mesh.node_label(e.slave.nodes[k]));
    for (const int node : e.masters) words.push_back(job.mesh.node_label(node));
    out += data_lines(words, 10);
  }
  return out;
}

const Statement& first_statement(const Job& job, const string& keyword, const string& why) {
  for (const Statement& s : job.mesh.source.list)
    if (s.keyword == keyword) return s;
  throw Error(job.mesh.source.files[0].name + ": there is no *" + keyword + ": " + why);
}

bool has_heat(const Model& model) {
  const auto contact = model.text.find("contact");
  return contact != model.text.end() && contact->is_object() && contact->contains("heat") &&
         !contact->at("heat").is_null();
}

/// A step that solves for displacements alone has no temperatures for heat of contact elements.
void check_procedures(const Job& job) {
  for (const Statement& s : job.mesh.source.list)
    for (const char* name : {"STATIC", "DYNAMIC", "VISCO"})
      if (s.keyword == name)
        job.mesh.source.fail(s.place,
                             "*" + s.keyword +
                                 " has no temperatures, and the contact has \"heat\": "
                                 "write *COUPLED TEMPERATURE-DISPLACEMENT, or leave *GAP CONDUCTANCE "
                                 "and *GAP HEAT GENERATION (\"heat\" of a model) out");
}

const char* const heading = "** ents-deck: contact elements\n";

} // namespace

HostText calculix_text(const Job& job) {
  string out = heading;
  const auto groups = by_model(job);
  std::map<int, string> types; // nodes of an element -> type; ccx wants a letter, no digit, behind U1E
  int states = 1;
  for (const Model& model : job.models) {
    states = std::max(states, model.state_size);
    const int nodes = model.nodes();
    if (has_heat(model)) check_procedures(job);
    if (types.count(nodes) != 0) continue;
    const string type = types.empty() ? "U1E" : string("U1E") + static_cast<char>('A' + types.size() - 1);
    types[nodes] = type;
    out += "*USER ELEMENT, TYPE=" + type + ", NODES=" + std::to_string(nodes) +
           ", INTEGRATION POINTS=1, MAXDOF=3\n";
  }
  for (std::size_t m = 0; m < job.models.size(); ++m)
    out += "*ELEMENT, TYPE=" + types[job.models[m].nodes()] + ", ELSET=ENTS_" +
           std::to_string(job.models[m].number) + "\n" + element_lines(job, groups[m]);
  out += "*MATERIAL, NAME=ENTS\n*ELASTIC\n1., 0.\n*DEPVAR\n" + std::to_string(states) + "\n";
  for (const Model& model : job.models) {
    const string k = std::to_string(model.number);
    out += "*USER SECTION, ELSET=ENTS_" + k + ", MATERIAL=ENTS, CONSTANTS=3\n" + k + "., 0., 0.\n";
  }
  return {out, first_statement(job, "STEP", "a job has steps").place};
}

HostText abaqus_text(const Job& job) {
  string out = heading;
  const auto groups = by_model(job);
  const bool parts = job.mesh.has_parts();
  for (std::size_t m = 0; m < job.models.size(); ++m) {
    const Model& model = job.models[m];
    const int d = model.parameters + 1;
    const bool coordinates = parts && job.coordinates_in_elements;
    const int weights = parts && model.slave_nodes > 1 ? 1 + model.slave_nodes : 0;
    const int properties = 3 + weights + (coordinates ? model.master_nodes * model.parameters : 0);
    const string type = 'U' + std::to_string(100 + model.number), k = std::to_string(model.number);
    out += "*USER ELEMENT, TYPE=" + type + ", NODES=" + std::to_string(model.nodes()) +
           ", COORDINATES=" + std::to_string(d) + ", PROPERTIES=" + std::to_string(properties) +
           ", VARIABLES=" + std::to_string(std::max(model.state_size, 1)) +
           (model.symmetric ? "" : ", UNSYMM") + "\n" + (d == 2 ? "1, 2" : "1, 2, 3") +
           (has_heat(model) ? ", 11\n" : "\n");
    if (has_heat(model)) check_procedures(job);
    if (!parts) {
      out += "*ELEMENT, TYPE=" + type + ", ELSET=ENTS_" + k + "\n" + element_lines(job, groups[m]);
      out += "*UEL PROPERTY, ELSET=ENTS_" + k + "\n" + k + "., 0., 0.\n";
      continue;
    }
    // Abaqus numbers the elements of an assembly anew: what differs between them goes into properties, a set
    // each.
    std::map<std::vector<double>, std::vector<std::size_t>> sets;
    for (const std::size_t i : groups[m]) {
      std::vector<double> values{static_cast<double>(model.number), job.elements[i].slave.area,
                                 weights ? 8.0 : 0.0};
      if (weights) {
        values.push_back(model.slave_nodes);
        values.insert(values.end(), job.elements[i].slave.weights.begin(),
                      job.elements[i].slave.weights.end());
      }
      values.insert(values.end(), job.elements[i].surface_coordinates.begin(),
                    job.elements[i].surface_coordinates.end());
      sets[values].push_back(i);
    }
    int number = 0;
    for (const auto& [values, elements] : sets) {
      const string set = "ENTS_" + k + "_" + std::to_string(++number);
      out += "*ELEMENT, TYPE=" + type + ", ELSET=" + set + "\n" + element_lines(job, elements);
      std::vector<string> words;
      for (const double value : values) words.push_back(exact(value));
      out += "*UEL PROPERTY, ELSET=" + set + "\n" + data_lines(words, 8);
    }
  }
  if (parts) return {out, first_statement(job, "END ASSEMBLY", "a deck with parts has an assembly").place};
  return {out, first_statement(job, "STEP", "a job has steps").place};
}

} // namespace ents_deck
