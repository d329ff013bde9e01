// SPDX-License-Identifier: BSD-3-Clause
#include "write.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <set>

namespace ents_deck {
namespace {

using std::string;

/// Keywords of output that name contact, which a deck without pairs must not have.
const std::set<string> contact_output{"CONTACT PRINT", "CONTACT FILE", "CONTACT OUTPUT", "CONTACT CONTROLS"};

int last_line_of(const Source& source, const Statement& s) {
  int last = s.last_line;
  for (const Line& line : s.lines) {
    if (line.place.file != s.place.file)
      source.fail(line.place, "data lines of *" + s.keyword + " begin in another file");
    last = std::max(last, line.place.line);
  }
  return last;
}

/// Pairs that have become elements go; of a *CONTACT PAIR with several, the others stay.
void remove_pairs(const Job& job, Edits& edits, bool& pairs_left) {
  const Source& source = job.mesh.source;
  for (const Statement& s : source.list) {
    if (s.keyword != "CONTACT PAIR") continue;
    std::vector<Place> gone;
    for (const Line& line : s.lines)
      for (const Contact& contact : job.contacts)
        if (contact.pair.statement == &s && contact.pair.line.line == line.place.line &&
            contact.pair.line.file == line.place.file)
          gone.push_back(line.place);
    if (gone.size() < s.lines.size()) pairs_left = true;
    if (gone.empty()) continue;
    string note = "** ents-deck: user elements before *STEP take the place of";
    for (const Contact& contact : job.contacts)
      if (contact.pair.statement == &s) note += " " + contact.pair.slave + ", " + contact.pair.master + ";";
    note.back() = '\n';
    if (gone.size() == s.lines.size()) {
      edits[s.place.file].push_back({s.place.line, last_line_of(source, s), note});
    } else {
      for (const Place& place : gone) edits[place.file].push_back({place.line, place.line, note});
    }
  }
}

void remove_contact_output(const Job& job, Edits& edits) {
  const Source& source = job.mesh.source;
  for (const Statement& s : source.list)
    if (contact_output.count(s.keyword) != 0)
      edits[s.place.file].push_back(
          {s.place.line, last_line_of(source, s),
           "** ents-deck: *" + s.keyword + " is left out, no contact pair is left\n"});
}

void move_nodes(const Job& job, Edits& edits) {
  for (const Move& move : job.moves) {
    const Node& node = job.mesh.nodes[static_cast<std::size_t>(move.node)];
    if (node.instance != no_instance)
      job.mesh.source.fail(node.place,
                           "ADJUST moves node " + job.mesh.node_label(move.node) +
                               ", whose line belongs to a part: leave ADJUST out, or write a flat deck");
    edits[node.place.file].push_back({node.place.line, node.place.line,
                                      std::to_string(node.id) + ", " + exact(move.to[0]) + ", " +
                                          exact(move.to[1]) + ", " + exact(move.to[2]) + "\n"});
  }
}

/// ccx ends an increment after 16 iterations, and gives up after 5 cuts; with its own contact it goes on
/// longer, and lets increments grow after 16 iterations as it does. So do these steps, unless the deck has limits of its own.
constexpr const char* ccx_limits = "*CONTROLS, PARAMETERS=TIME INCREMENTATION\n10, 20, 9, 60, 22, 16, , 10\n";

void allow_iterations(const Job& job, Edits& edits) {
  const Source& source = job.mesh.source;
  const Statement* procedure = nullptr;
  bool own = false;
  for (const Statement& s : source.list) {
    if (s.keyword == "STEP") procedure = nullptr, own = false;
    for (const char* name : {"STATIC", "VISCO", "COUPLED TEMPERATURE-DISPLACEMENT", "HEAT TRANSFER"})
      if (s.keyword == name) procedure = &s;
    if (s.keyword == "CONTROLS")
      own = own || canonical(s.value("PARAMETERS")) == "TIMEINCREMENTATION" || s.has("RESET");
    if (s.keyword != "END STEP" || !procedure || own) continue;
    const int behind = last_line_of(source, *procedure) + 1;
    edits[procedure->place.file].push_back(
        {behind, behind - 1,
         string("** ents-deck: limits of iterations and cuts as with ccx's own contact\n") + ccx_limits});
  }
}

/// Where a file of the deck goes: included files keep their names relative to the deck.
std::filesystem::path target_of(const Source& source, std::size_t file, const std::filesystem::path& out) {
  if (file == 0) return out / source.files[0].path.filename();
  const Statement& include = source.includes[file - 1];
  const std::filesystem::path folder = source.files[0].path.parent_path();
  const auto relative = source.files[file].path.lexically_relative(folder.empty() ? "." : folder);
  if (std::filesystem::path(include.value("INPUT")).is_absolute()) return {};
  if (relative.empty() || *relative.begin() == "..")
    source.fail(include.place, "*INCLUDE, INPUT=" + include.value("INPUT") +
                                   " lies outside of the deck's folder, and the job is written into another "
                                   "one: put the file beside the deck, or write its whole path");
  return out / relative;
}

/// Files of height maps are copied into the job's folder, which then needs nothing else.
void take_maps_along(nlohmann::ordered_json& node, const std::filesystem::path& out,
                     std::map<string, string>& copied, std::vector<JobFile>& files) {
  if (node.is_object() && node.contains("file") && node["file"].is_string()) {
    const string from = node["file"].get<string>();
    auto [entry, is_new] = copied.emplace(from, "");
    if (is_new) {
      entry->second =
          "ents_map_" + std::to_string(copied.size()) + std::filesystem::path(from).extension().string();
      files.push_back({out / entry->second, "", from});
    }
    node["file"] = entry->second;
  }
  if (node.is_structured())
    for (auto& value : node) take_maps_along(value, out, copied, files);
}

string table_text(const Job& job, int model, std::int64_t first) {
  const int slave_nodes = job.models[static_cast<std::size_t>(model)].slave_nodes;
  string out = slave_nodes > 1 ? "slave_nodes " + std::to_string(slave_nodes) +
                                     "\n# element, area of its slave point, weights of the slave's nodes"
                               : "# element, area of its slave node";
  out += job.coordinates_in_elements ? ", surface coordinates of its master nodes\n" : "\n";
  for (std::size_t i = 0; i < job.elements.size(); ++i) {
    const ContactElement& e = job.elements[i];
    if (e.model != model) continue;
    out += std::to_string(first + static_cast<std::int64_t>(i)) + " " + exact(e.slave.area);
    for (const double w : e.slave.weights)
      if (slave_nodes > 1) out += ' ' + exact(w);
    for (const double s : e.surface_coordinates) out += ' ' + exact(s);
    out += '\n';
  }
  return out;
}

} // namespace

string exact(double value) {
  char text[40];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  string out(text, end);
  // Fortran and Abaqus take "1" in a field of real numbers for 1, but "1e-05" is best written with a point.
  if (out.find_first_of(".en") == string::npos) out += ".";
  return out;
}

string edited(std::string_view text, std::vector<Edit> edits) {
  std::stable_sort(edits.begin(), edits.end(),
                   [](const Edit& a, const Edit& b) { return a.first < b.first; });
  const bool windows = text.find("\r\n") != std::string_view::npos;
  string out;
  out.reserve(text.size());
  std::size_t at = 0;
  int line = 1;
  const auto next = [&] { // begin of the next line
    const std::size_t end = text.find('\n', at);
    at = end == std::string_view::npos ? text.size() : end + 1;
    ++line;
  };
  const auto put = [&](std::string_view added) {
    if (!out.empty() && out.back() != '\n') out += windows ? "\r\n" : "\n";
    for (const char c : added) {
      if (c == '\n' && windows) out += '\r';
      out += c;
    }
  };
  for (const Edit& edit : edits) {
    const std::size_t begin = at;
    while (line < edit.first && at < text.size()) next();
    out.append(text.substr(begin, at - begin));
    put(edit.text);
    while (line <= edit.last && at < text.size()) next();
  }
  out.append(text.substr(at));
  return out;
}

std::int64_t first_free_element(const Job& job) {
  std::int64_t largest = 0; // those of an instance have a space of their own
  for (const Element& e : job.mesh.elements)
    if (!job.mesh.has_parts() || e.instance == no_instance) largest = std::max(largest, e.id);
  return largest + 1;
}

bool has_tables(const Job& job) { return !job.mesh.has_parts(); }

std::vector<JobFile> files_of_job(const Job& job, const Options& options, const std::filesystem::path& out) {
  const Source& source = job.mesh.source;
  Edits edits;
  bool pairs_left = false;
  remove_pairs(job, edits, pairs_left);
  if (!pairs_left) remove_contact_output(job, edits);
  move_nodes(job, edits);
  if (options.program == Program::calculix) allow_iterations(job, edits);
  HostText host = options.program == Program::calculix ? calculix_text(job) : abaqus_text(job);
  edits[host.before.file].push_back({host.before.line, host.before.line - 1, host.text});

  std::map<std::filesystem::path, std::size_t> targets; // a file that is included twice is written once
  std::vector<JobFile> files;
  for (std::size_t f = 0; f < source.files.size(); ++f) {
    const auto own = edits.find(static_cast<int>(f));
    const std::filesystem::path target = target_of(source, f, out);
    if (target.empty()) {
      if (own != edits.end())
        source.fail(
            {static_cast<int>(f), own->second.front().first},
            "this file is included by its whole path and would have to be changed: put it beside the deck");
      continue;
    }
    const auto [entry, is_new] = targets.emplace(target, f);
    if (!is_new) {
      if (own != edits.end() || edits.count(static_cast<int>(entry->second)) != 0)
        source.fail({static_cast<int>(f), 1},
                    "this file is included more than once and would have to be changed");
      continue;
    }
    std::error_code error;
    if (std::filesystem::equivalent(target, source.files[f].path, error))
      throw Error(target.string() + " is the deck itself: name another folder with --out");
    files.push_back(
        {target,
         own == edits.end() ? string(source.files[f].text) : edited(source.files[f].text, own->second),
         {}});
  }
  if (has_tables(job)) // element numbers are those of the deck
    files.push_back({out / "ents_patches.json", watched(job).dump() + "\n", {}});
  const std::int64_t first = first_free_element(job);
  std::map<string, string> maps;
  for (std::size_t m = 0; m < job.models.size(); ++m) {
    const string name = "ents_" + std::to_string(job.models[m].number);
    nlohmann::ordered_json text = job.models[m].text;
    take_maps_along(text, out, maps, files);
    files.push_back({out / (name + ".json"), text.dump(1) + "\n", {}});
    if (has_tables(job))
      files.push_back({out / (name + ".txt"), table_text(job, static_cast<int>(m), first), {}});
  }
  return files;
}

} // namespace ents_deck
