// SPDX-License-Identifier: BSD-3-Clause
#include "inp.hpp"

#include "inp_statements.hpp"

#include <algorithm>
#include <optional>
#include <unordered_map>

namespace host::inp {
namespace {

using std::string;
using std::string_view;
using Names = std::vector<string_view>;

struct Type {
  string_view name;
  Shape shape;
  Kind kind;
};
constexpr Type types[] = {
    {"CPS3", Shape::tri3, Kind::plane_stress}, {"CPS4", Shape::quad4, Kind::plane_stress},
    {"CPE3", Shape::tri3, Kind::plane_strain}, {"CPE4", Shape::quad4, Kind::plane_strain},
    {"CAX3", Shape::tri3, Kind::axisymmetric}, {"CAX4", Shape::quad4, Kind::axisymmetric},
    {"C3D4", Shape::tet4, Kind::solid},        {"C3D8", Shape::hex8, Kind::solid},
    {"C3D6", Shape::wedge6, Kind::solid},      {"S3", Shape::tri3, Kind::shell},
    {"S4", Shape::quad4, Kind::shell},         {"T2D2", Shape::line2, Kind::truss},
    {"T3D2", Shape::line2, Kind::truss},
};

const Names mesh_changing{"PART",  "ASSEMBLY", "INSTANCE", "SYSTEM", "NGEN",
                          "NFILL", "NMAP",     "NCOPY",    "ELGEN",  "ELCOPY"};

/// Members of all sets together.
constexpr std::size_t largest_set_total = std::size_t{1} << 28;

const Names assembled{"PART", "ASSEMBLY", "INSTANCE"};

template <class T> std::optional<T> parsed(string_view text) {
  T value{};
  return ents_deck::parse(text, value) ? std::optional(value) : std::nullopt;
}

template <class Range> string listed(const Range& names) {
  string out;
  for (const auto& name : names) out += (out.empty() ? "" : ", ") + string(name);
  return out;
}

template <class T> Names keys(const std::map<string, T>& map) {
  Names out;
  for (const auto& [name, value] : map) out.push_back(name);
  return out;
}

using Index = std::unordered_map<std::int64_t, int>;

/// Fills a deck in three passes over the statements: nodes, elements and the sets they name; node and element
/// sets; surfaces. So the order of the keywords in the deck is free.
class Builder {
public:
  explicit Builder(const Source& statements) : statements_(statements) {
    for (const auto& file : statements.files) deck.files.push_back(file.name);
  }

  Deck deck;

  void build() {
    for (const Statement& s : statements_.list) {
      if (s.keyword == "NODE")
        nodes(s);
      else if (s.keyword == "HEADING")
        heading(s);
      else if (contains(mesh_changing, s.keyword))
        error(s.place, "*" + s.keyword +
                           " changes the mesh and is not read; write a flat deck of *NODE and *ELEMENT" +
                           (contains(assembled, s.keyword)
                                ? " (Abaqus/CAE: choose \"Do not use parts and assemblies in input files\")"
                                : ""));
      else if (!contains({"ELEMENT", "NSET", "ELSET", "SURFACE"}, s.keyword))
        deck.ignored.push_back({s.keyword, deck.files[static_cast<std::size_t>(s.place.file)], s.place.line});
    }
    if (deck.node_ids.empty()) no_mesh();
    for (const Statement& s : statements_.list)
      if (s.keyword == "ELEMENT") elements(s);
    for (const Statement& s : statements_.list) {
      if (s.keyword == "NSET") set(s, "NSET", "node", deck.node_sets, node_index_);
      if (s.keyword == "ELSET") set(s, "ELSET", "element", deck.element_sets, element_index_);
    }
    for (const Statement& s : statements_.list)
      if (s.keyword == "SURFACE") surface(s);
    if (deck.elements.empty()) no_mesh();
    for (auto* sets : {&deck.node_sets, &deck.element_sets})
      for (auto& [name, members] : *sets) unique(members);
  }

private:
  const Source& statements_;
  std::size_t set_total_ = 0;
  Index node_index_, element_index_;

  [[noreturn]] void error(Place place, const string& what) const { fail(deck.files, place, what); }

  /// A keyword with a letter wrong is skipped like a material: say where.
  [[noreturn]] void no_mesh() const {
    string text = deck.files[0] + ": no mesh; expected *NODE and *ELEMENT with data lines";
    for (std::size_t i = 0; i < deck.ignored.size() && i < 4; ++i)
      text += (i == 0 ? "; not understood and skipped: *" : ", *") + deck.ignored[i].keyword + " (" +
              deck.ignored[i].file + ":" + std::to_string(deck.ignored[i].line) + ")";
    throw Error(text + (deck.ignored.size() > 4 ? " ..." : ""));
  }

  static bool contains(const Names& names, string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  }

  static void unique(std::vector<int>& members) { // keeps the order
    std::vector<char> seen(
        members.empty() ? 0
                        : 1 + static_cast<std::size_t>(*std::max_element(members.begin(), members.end())));
    std::erase_if(members,
                  [&](int i) { return std::exchange(seen[static_cast<std::size_t>(i)], char{1}) != 0; });
  }

  /// Value of a parameter, "" if absent. A parameter outside `known` is an error, not ignored: it could
  /// change the mesh.
  string parameter(const Statement& s, string_view name, const Names& known) const {
    string out;
    for (const auto& [key, value] : s.parameters) {
      if (!contains(known, key))
        error(s.place, "*" + s.keyword + " has the parameter '" + key + "'; expected " + listed(known));
      if (key == name) out = value;
    }
    return out;
  }

  string required(const Statement& s, string_view name, const Names& known) const {
    string out = parameter(s, name, known);
    if (out.empty()) error(s.place, "*" + s.keyword + " needs " + string(name) + "=");
    return out;
  }

  std::int64_t number(Place place, string_view field, const string& meaning) const {
    const auto value = parsed<std::int64_t>(field);
    if (!value || *value < 1)
      error(place, "expected " + meaning + " (a whole number from 1), found '" + string(field) + "'");
    return *value;
  }

  int find(Place place, const Index& index, std::int64_t id, const string& what) const {
    const auto found = index.find(id);
    if (found == index.end()) error(place, what + " " + std::to_string(id) + " is not defined in this deck");
    return found->second;
  }

  void heading(const Statement& s) {
    for (const Line& line : s.lines) {
      if (!deck.heading.empty()) deck.heading += '\n';
      deck.heading += line.text;
    }
  }

  void nodes(const Statement& s) {
    const string set = canonical(parameter(s, "NSET", {"NSET"}));
    if (!set.empty()) deck.node_sets[set];
    for (const Line& line : s.lines) {
      const auto fields = fields_of(line.text);
      if (fields.size() < 3 || fields.size() > 4)
        error(line.place,
              "expected node number, x, y[, z]; found " + std::to_string(fields.size()) + " entries");
      const std::int64_t id = number(line.place, fields[0], "a node number");
      std::array<double, 3> x{};
      for (std::size_t i = 1; i < fields.size(); ++i) {
        const auto value = parsed<double>(fields[i]);
        if (!value)
          error(line.place, "expected coordinate " + std::to_string(i) + " of node " + std::to_string(id) +
                                " (a finite number), found '" + string(fields[i]) + "'");
        x[i - 1] = *value;
      }
      const int index = static_cast<int>(deck.node_ids.size());
      if (!node_index_.emplace(id, index).second)
        error(line.place, "node " + std::to_string(id) + " is defined a second time");
      deck.node_ids.push_back(id);
      deck.coordinates.push_back(x);
      if (!set.empty()) deck.node_sets[set].push_back(index);
    }
  }

  void elements(const Statement& s) {
    const Names known{"TYPE", "ELSET"};
    const string name = canonical(required(s, "TYPE", known)), set = canonical(parameter(s, "ELSET", known));
    const Type* type =
        std::find_if(std::begin(types), std::end(types), [&](auto& t) { return t.name == name; });
    if (type == std::end(types)) {
      Names names;
      for (const Type& t : types) names.push_back(t.name);
      error(s.place, "element type '" + name + "' is not read; expected " + listed(names) +
                         " (first order, full integration; in Gmsh: Mesh.ElementOrder = 1)");
    }
    if (!set.empty()) deck.element_sets[set];
    const auto count = static_cast<std::size_t>(node_count(type->shape));
    std::vector<string_view> entry; // element number and nodes, perhaps from several lines
    Place place;
    for (const Line& line : s.lines) {
      if (entry.empty()) place = line.place;
      const auto fields = fields_of(line.text);
      entry.insert(entry.end(), fields.begin(), fields.end());
      const bool continued = line.text.ends_with(',') && &line != &s.lines.back();
      if (entry.size() < count + 1 && continued) continue;
      if (entry.size() != count + 1)
        error(line.place, "expected an element number and " + std::to_string(count) + " nodes (" + name +
                              "), found " + std::to_string(entry.size()) + " entries");
      element(entry, *type, place);
      if (!set.empty()) deck.element_sets[set].push_back(static_cast<int>(deck.elements.size()) - 1);
      entry.clear();
    }
  }

  void element(const std::vector<string_view>& entry, const Type& type, Place place) {
    Element e;
    e.id = number(place, entry[0], "an element number");
    e.shape = type.shape, e.kind = type.kind, e.file = place.file, e.line = place.line;
    for (std::size_t i = 1; i < entry.size(); ++i)
      e.nodes[i - 1] = find(place, node_index_, number(place, entry[i], "a node number"), "node");
    if (!element_index_.emplace(e.id, static_cast<int>(deck.elements.size())).second)
      error(place, "element " + std::to_string(e.id) + " is defined a second time");
    deck.elements.push_back(e);
  }

  void set(const Statement& s, string_view key, const string& what, std::map<string, std::vector<int>>& sets,
           const Index& index) {
    const Names known{key, "GENERATE", "UNSORTED", "INTERNAL"};
    const string name = canonical(required(s, key, known));
    const bool generate =
        std::any_of(s.parameters.begin(), s.parameters.end(), [](auto& p) { return p.first == "GENERATE"; });
    std::vector<int> members;
    for (const Line& line : s.lines) {
      const auto fields = fields_of(line.text);
      if (generate) {
        if (fields.size() < 2 || fields.size() > 3)
          error(line.place, "expected first, last[, step] (GENERATE), found " +
                                std::to_string(fields.size()) + " entries");
        const std::int64_t first = number(line.place, fields[0], "the first " + what + " number");
        const std::int64_t last = number(line.place, fields[1], "the last " + what + " number");
        const std::int64_t step = fields.size() > 2 ? number(line.place, fields[2], "the step") : 1;
        if (last < first || (last - first) % step != 0)
          error(line.place, "expected first <= last, a whole number of steps apart (GENERATE)");
        for (std::int64_t id = first; id <= last; id += step)
          members.push_back(find(line.place, index, id, what));
        continue;
      }
      for (const string_view field : fields) {
        const auto other = sets.find(canonical(field));
        if (other != sets.end())
          members.insert(members.end(), other->second.begin(), other->second.end());
        else if (const auto id = parsed<std::int64_t>(field))
          members.push_back(find(line.place, index, *id, what));
        else
          error(line.place, "expected " + what + " numbers or the name of a set defined before, found '" +
                                string(field) + "'");
      }
    }
    // Sets that name each other twice would double from one to the next.
    auto& target = sets[name]; // a set may be given in several pieces
    set_total_ -= target.size();
    target.insert(target.end(), members.begin(), members.end());
    unique(target);
    set_total_ += target.size();
    if (set_total_ > largest_set_total)
      error(s.place,
            "the sets of this deck have more than " + std::to_string(largest_set_total) + " members in all");
  }

  void surface(const Statement& s) {
    const Names known{"NAME", "TYPE"};
    const string name = canonical(required(s, "NAME", known)), type = canonical(parameter(s, "TYPE", known));
    if (!type.empty() && type != "ELEMENT" && type != "NODE")
      error(s.place, "*SURFACE of TYPE=" + type + " is not read; expected TYPE=ELEMENT or TYPE=NODE");
    Surface& target = deck.surfaces[name];
    target.of_nodes = type == "NODE";
    for (const Line& line : s.lines) {
      const auto fields = fields_of(line.text);
      if (fields.size() > 2 || (fields.size() < 2 && !target.of_nodes))
        error(line.place, target.of_nodes ? "expected a node or node set[, area]"
                                          : "expected an element or element set, then S1, S2 ...");
      if (target.of_nodes) {
        const auto members = members_of(line.place, fields[0], "node", deck.node_sets, node_index_);
        target.nodes.insert(target.nodes.end(), members.begin(), members.end());
        continue;
      }
      const string label = canonical(fields[1]);
      const int face = label.starts_with('S')
                           ? static_cast<int>(std::min<std::int64_t>(
                                 parsed<std::int64_t>(string_view(label).substr(1)).value_or(0), 1000))
                           : 0;
      for (const int e : members_of(line.place, fields[0], "element", deck.element_sets, element_index_)) {
        const int faces = face_count(deck.elements[static_cast<std::size_t>(e)].shape);
        const string id = std::to_string(deck.elements[static_cast<std::size_t>(e)].id);
        if (faces == 0) error(line.place, "element " + id + " is a line and has no faces");
        if (face < 1 || face > faces)
          error(line.place, "expected a face S1 .. S" + std::to_string(faces) + " of element " + id +
                                ", found '" + string(fields[1]) + "'");
        target.facets.push_back({e, face - 1});
      }
    }
    unique(target.nodes);
  }

  std::vector<int> members_of(Place place, string_view field, const string& what,
                              const std::map<string, std::vector<int>>& sets, const Index& index) const {
    if (const auto named = sets.find(canonical(field)); named != sets.end()) return named->second;
    if (const auto id = parsed<std::int64_t>(field)) return {find(place, index, *id, what)};
    error(place, "no " + what + " set '" + string(field) + "'; the deck has " + listed(keys(sets)));
  }
};

template <class Read> Deck built(const Read& read_text) {
  try {
    const Source statements = read_text();
    Builder builder(statements);
    builder.build();
    return std::move(builder.deck);
  } catch (const ents_deck::Error& error) {
    throw Error(error.what());
  }
}

} // namespace

Deck read(const std::filesystem::path& file) {
  return built([&] { return ents_deck::read_source(file); });
}

Deck read_text(string_view text, const string& name, const std::filesystem::path& folder) {
  return built([&] { return ents_deck::read_source_text(text, name, folder); });
}

} // namespace host::inp
