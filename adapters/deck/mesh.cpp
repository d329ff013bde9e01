// SPDX-License-Identifier: BSD-3-Clause
#include "mesh.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "scopes.hpp"

namespace ents_deck {
namespace {

using std::string;
using std::string_view;
using Names = std::vector<string_view>;
using Index = std::unordered_map<std::int64_t, int>;

template <class T> bool contains(const std::vector<T>& known, string_view name) {
  return std::find(known.begin(), known.end(), name) != known.end();
}

/// Fills a mesh in passes over the statements: nodes; elements and the sets they name; node and element sets;
/// surfaces. So the order of the keywords in the deck is free.
class Builder {
public:
  explicit Builder(Source source) { mesh.source = std::move(source); }

  Mesh mesh;

  void build() {
    const Scopes scopes = scopes_of(mesh.source);
    mesh.instances = scopes.instances;
    node_index_.resize(mesh.instances.size() + 1);
    element_index_.resize(mesh.instances.size() + 1);
    for (const Scoped& s : scopes.list)
      if (s.statement->keyword == "NODE") nodes(s);
    for (const Scoped& s : scopes.list)
      if (s.statement->keyword == "ELEMENT") elements(s);
    for (const Scoped& s : scopes.list) {
      if (s.statement->keyword == "NSET") set(s, "NSET", "node", mesh.node_sets, node_index_);
      if (s.statement->keyword == "ELSET") set(s, "ELSET", "element", mesh.element_sets, element_index_);
    }
    for (const Scoped& s : scopes.list)
      if (s.statement->keyword == "SURFACE") surface(s);
    for (auto& [name, surface] : mesh.surfaces) unique(surface);
    if (mesh.nodes.empty() || mesh.elements.empty())
      throw Error(mesh.source.files[0].name + ": no mesh; expected *NODE and *ELEMENT with data lines");
  }

private:
  std::vector<Index> node_index_, element_index_; ///< [0] without instance, [1 + i] instance i
  std::map<string, int> type_index_;
  std::size_t set_total_ = 0;

  [[noreturn]] void fail(Place place, const string& what) const { mesh.source.fail(place, what); }

  string prefix(int instance) const {
    return instance == no_instance ? ""
                                   : canonical(mesh.instances[static_cast<std::size_t>(instance)].name) + ".";
  }

  static std::size_t slot(int instance) { return static_cast<std::size_t>(instance + 1); }

  std::int64_t number(Place place, string_view field, const string& meaning) const {
    std::int64_t value = 0;
    if (!parse(field, value) || value < 1)
      fail(place, "expected " + meaning + " (a whole number from 1), found '" + string(field) + "'");
    return value;
  }

  static string article(const string& what) { return (what == "element" ? "an " : "a ") + what; }

  string required(const Statement& s, string_view name) const {
    const string out = s.value(name);
    if (out.empty()) fail(s.place, "*" + s.keyword + " needs " + string(name) + "=");
    return out;
  }

  /// The instance of a name such as "Part-1-1.17", which is cut off, else `instance`.
  int instance_of(string_view& field, int instance) const {
    const std::size_t point = field.find('.');
    if (point == string_view::npos) return instance;
    const string name = canonical(field.substr(0, point));
    for (std::size_t i = 0; i < mesh.instances.size(); ++i)
      if (canonical(mesh.instances[i].name) == name) {
        field.remove_prefix(point + 1);
        return static_cast<int>(i);
      }
    return instance;
  }

  int instance_parameter(const Scoped& s) const {
    const string name = s.statement->value("INSTANCE");
    if (name.empty()) return s.instance;
    for (std::size_t i = 0; i < mesh.instances.size(); ++i)
      if (canonical(mesh.instances[i].name) == canonical(name)) return static_cast<int>(i);
    fail(s.statement->place, "there is no *INSTANCE, NAME=" + name);
  }

  /// A deck without nodes has a keyword that is misspelled: it was taken for one of another matter.
  string where_nodes_may_be() const {
    if (!mesh.nodes.empty() || mesh.source.list.empty()) return "";
    const Statement& first = mesh.source.list.front();
    return ", which has no *NODE; it begins with *" + first.keyword + " (" + mesh.source.at(first.place) +
           ")";
  }

  int find(Place place, const std::vector<Index>& index, string_view field, int instance,
           const string& what) const {
    string_view rest = field;
    const int owner = instance_of(rest, instance);
    std::int64_t id = 0;
    if (!parse(rest, id) || id < 1)
      fail(place, "there is no " + what + " set '" + string(field) + "' here, nor is it " + article(what) +
                      " number; name a set, or write a whole number from 1");
    const auto found = index[slot(owner)].find(id);
    if (found == index[slot(owner)].end())
      fail(place, what + " " + string(field) + " is not defined in this deck" + where_nodes_may_be());
    return found->second;
  }

  void nodes(const Scoped& scoped) {
    const Statement& s = *scoped.statement;
    if (s.has("SYSTEM") && canonical(s.value("SYSTEM")) != "R")
      fail(s.place, "*NODE, SYSTEM=" + s.value("SYSTEM") + " is not read; write rectangular coordinates");
    const string set = s.value("NSET").empty() ? "" : prefix(scoped.instance) + canonical(s.value("NSET"));
    if (!set.empty()) mesh.node_sets[set];
    for (const Line& line : s.lines) {
      const auto fields = fields_of(line.text);
      if (fields.size() < 2)
        fail(line.place,
             "expected node number, x, y, z; found " + std::to_string(fields.size()) + " entries");
      Node node;
      node.id = number(line.place, fields[0], "a node number");
      node.instance = scoped.instance;
      node.place = line.place;
      for (std::size_t i = 1; i < fields.size() && i < 4; ++i)
        if (!fields[i].empty() && !parse(fields[i], node.x[i - 1]))
          fail(line.place, "expected coordinate " + std::to_string(i) + " of node " +
                               std::to_string(node.id) + " (a finite number), found '" + string(fields[i]) +
                               "'");
      if (scoped.instance != no_instance && scoped.of_part)
        node.x = placed(mesh.instances[static_cast<std::size_t>(scoped.instance)], node.x);
      const int index = static_cast<int>(mesh.nodes.size());
      if (!node_index_[slot(scoped.instance)].emplace(node.id, index).second)
        fail(line.place, "node " + std::to_string(node.id) + " is defined a second time");
      mesh.nodes.push_back(node);
      if (!set.empty()) mesh.node_sets[set].push_back(index);
    }
  }

  int type_index(const string& name) {
    const auto [entry, is_new] = type_index_.emplace(name, static_cast<int>(mesh.types.size()));
    if (is_new) mesh.types.push_back(type_of(name));
    return entry->second;
  }

  void elements(const Scoped& scoped) {
    const Statement& s = *scoped.statement;
    const int type = type_index(canonical(required(s, "TYPE")));
    const Shape shape = mesh.types[static_cast<std::size_t>(type)].shape;
    const string set = s.value("ELSET").empty() ? "" : prefix(scoped.instance) + canonical(s.value("ELSET"));
    if (!set.empty()) mesh.element_sets[set];
    const auto count = static_cast<std::size_t>(node_count(shape));
    std::vector<string_view> entry; // element number and nodes, perhaps from several lines
    Place place;
    for (const Line& line : s.lines) {
      if (entry.empty()) place = line.place;
      const auto fields = fields_of(line.text);
      entry.insert(entry.end(), fields.begin(), fields.end());
      const bool last = &line == &s.lines.back(), goes_on = line.text.ends_with(',') && !last;
      // CalculiX goes on to the next line without a comma, too; of an unknown type the commas alone tell.
      if (shape == Shape::none ? goes_on : entry.size() < count + 1 && !last) continue;
      if (shape != Shape::none && entry.size() != count + 1)
        fail(line.place, "expected an element number and " + std::to_string(count) + " nodes (" +
                             s.value("TYPE") + "), found " + std::to_string(entry.size()) + " entries");
      Element e;
      e.id = number(place, entry[0], "an element number");
      e.instance = scoped.instance;
      e.type = type;
      e.place = place;
      if (shape != Shape::none)
        for (std::size_t i = 1; i < entry.size(); ++i)
          e.nodes.push_back(find(place, node_index_, entry[i], scoped.instance, "node"));
      const int index = static_cast<int>(mesh.elements.size());
      if (!element_index_[slot(scoped.instance)].emplace(e.id, index).second)
        fail(place, "element " + std::to_string(e.id) + " is defined a second time");
      mesh.elements.push_back(std::move(e));
      if (!set.empty()) mesh.element_sets[set].push_back(index);
      entry.clear();
    }
  }

  /// Members of a range: numbers that do not exist are skipped, as host programs do.
  void generate(const Line& line, const Index& index, const string& what, std::vector<int>& members) const {
    const auto fields = fields_of(line.text);
    if (fields.size() < 2 || fields.size() > 3)
      fail(line.place,
           "expected first, last[, step] (GENERATE), found " + std::to_string(fields.size()) + " entries");
    const std::int64_t first = number(line.place, fields[0], "the first " + what + " number");
    const std::int64_t last = number(line.place, fields[1], "the last " + what + " number");
    const std::int64_t step = fields.size() > 2 ? number(line.place, fields[2], "the step") : 1;
    if (last < first || (last - first) % step != 0)
      fail(line.place, "expected first <= last, a whole number of steps apart (GENERATE)");
    if (static_cast<std::uint64_t>((last - first) / step) <= index.size()) {
      for (std::int64_t id = first; id <= last; id += step)
        if (const auto found = index.find(id); found != index.end()) members.push_back(found->second);
    } else {
      std::map<std::int64_t, int> sorted;
      for (const auto& [id, member] : index)
        if (id >= first && id <= last && (id - first) % step == 0) sorted.emplace(id, member);
      for (const auto& [id, member] : sorted) members.push_back(member);
    }
    if (members.empty())
      fail(line.place,
           "there is no " + what + " from " + std::to_string(first) + " to " + std::to_string(last));
  }

  void set(const Scoped& scoped, string_view key, const string& what,
           std::map<string, std::vector<int>>& sets, const std::vector<Index>& index) {
    const Statement& s = *scoped.statement;
    const int instance = instance_parameter(scoped);
    std::vector<int> members;
    for (const Line& line : s.lines) {
      if (s.has("GENERATE")) {
        std::vector<int> range;
        generate(line, index[slot(instance)], what, range);
        members.insert(members.end(), range.begin(), range.end());
        continue;
      }
      for (const string_view field : fields_of(line.text)) {
        if (field.empty()) continue;
        if (const auto* other = named(sets, field, instance))
          members.insert(members.end(), other->begin(), other->end());
        else
          members.push_back(find(line.place, index, field, instance, what));
        if (members.size() > 2 * mesh.nodes.size() + 2 * mesh.elements.size() + 1000000) unique(members);
      }
    }
    // A set at the level of the assembly has its plain name, one of an instance its instance's before it.
    auto& target = sets[prefix(scoped.instance) + canonical(required(s, key))];
    set_total_ -= target.size();
    target.insert(target.end(), members.begin(), members.end()); // a set may be given in several pieces
    unique(target);
    set_total_ += target.size();
    if (set_total_ > largest_set_total)
      fail(s.place, "the sets of this deck have more than " + std::to_string(largest_set_total) +
                        " members in all; do some contain each other?");
  }

  static void unique(std::vector<int>& members) { // keeps the order
    std::vector<char> seen(
        members.empty() ? 0
                        : 1 + static_cast<std::size_t>(*std::max_element(members.begin(), members.end())));
    std::erase_if(members,
                  [&](int i) { return std::exchange(seen[static_cast<std::size_t>(i)], char{1}) != 0; });
  }

  static void unique(Surface& surface) { // the first of a node's lines tells its area
    std::unordered_map<int, char> seen;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < surface.nodes.size(); ++i)
      if (seen.emplace(surface.nodes[i], 0).second) {
        surface.nodes[kept] = surface.nodes[i];
        surface.areas[kept++] = surface.areas[i];
      }
    surface.nodes.resize(kept);
    surface.areas.resize(kept);
  }

  /// A set by its name where `instance` looks for it: its own, then the assembly's. Null: there is none.
  template <class T> const T* named(const std::map<string, T>& sets, string_view field, int instance) const {
    const string name = canonical(field);
    auto found = sets.find(prefix(instance) + name);
    if (found == sets.end()) found = sets.find(name);
    return found == sets.end() ? nullptr : &found->second;
  }

  void surface(const Scoped& scoped) {
    const Statement& s = *scoped.statement;
    const string type = canonical(s.value("TYPE"));
    const auto [entry, is_new] =
        mesh.surfaces.try_emplace(prefix(scoped.instance) + canonical(required(s, "NAME")));
    Surface& target = entry->second;
    const bool nodes = type == "NODE";
    if (is_new) target.place = s.place;
    target.of_nodes = nodes && (is_new || target.of_nodes);
    if (!type.empty() && type != "ELEMENT" && type != "NODE")
      return;                                      // analytical: it has neither faces nor nodes
    if (s.has("COMBINE") || s.has("CROP")) return; // refused if a contact pair uses it: no faces
    const int instance = instance_parameter(scoped);
    for (const Line& line : s.lines) {
      const auto fields = fields_of(line.text);
      for (std::size_t i = 2; i < fields.size(); ++i)
        if (!fields[i].empty())
          fail(line.place, "*SURFACE has an entry " + std::to_string(i + 1) + ", '" + string(fields[i]) +
                               "', which means nothing here; expected " +
                               (nodes ? "node or node set, area" : "element or element set, face"));
      if (nodes)
        surface_nodes(line, fields, instance, target);
      else
        surface_faces(line, fields, instance, target);
    }
  }

  void surface_nodes(const Line& line, const std::vector<string_view>& fields, int instance,
                     Surface& target) const {
    double area = 0;
    if (fields.size() > 1 && !fields[1].empty() && !parse(fields[1], area))
      fail(line.place, "expected a node or node set and an area, found '" + string(fields[1]) + "'");
    std::vector<int> members;
    if (const auto* set = named(mesh.node_sets, fields[0], instance))
      members = *set;
    else
      members = {find(line.place, node_index_, fields[0], instance, "node")};
    target.nodes.insert(target.nodes.end(), members.begin(), members.end());
    target.areas.insert(target.areas.end(), members.size(), area);
  }

  void surface_faces(const Line& line, const std::vector<string_view>& fields, int instance,
                     Surface& target) const {
    std::vector<int> members;
    if (const auto* set = named(mesh.element_sets, fields[0], instance))
      members = *set;
    else
      members = {find(line.place, element_index_, fields[0], instance, "element")};
    const string label = fields.size() > 1 ? canonical(fields[1]) : "";
    for (const int e : members) {
      const Shape shape = mesh.shape(e);
      if (label.empty()) { // all free faces of the element: sorted out where the surface is used
        const int faces = mesh.kind(e) == Kind::shell ? 1 : face_count(shape);
        for (int f = 0; f < faces; ++f) target.facets.push_back({e, -1 - f});
        continue;
      }
      target.facets.push_back({e, face_number(line, label, e)});
    }
  }

  int face_number(const Line& line, const string& label, int e) const {
    const Shape shape = mesh.shape(e);
    const bool shell = mesh.kind(e) == Kind::shell;
    const string name =
        "element " + mesh.element_label(e) + " (" +
        mesh.types[static_cast<std::size_t>(mesh.elements[static_cast<std::size_t>(e)].type)].name + ")";
    if (shape == Shape::none || face_count(shape) == 0)
      fail(line.place, name + " has no faces that are known here");
    if (shell) {
      if (label == "SPOS" || label == "POS" || label == "S2") return 0;
      if (label == "SNEG" || label == "NEG" || label == "S1") return 1;
      fail(line.place, "expected SPOS or SNEG of the shell " + name + ", found '" + label + "'");
    }
    std::int64_t face = 0;
    if (!label.starts_with('S') || !parse(string_view(label).substr(1), face) || face < 1 ||
        face > face_count(shape))
      fail(line.place, "expected a face S1 .. S" + std::to_string(face_count(shape)) + " of " + name +
                           ", found '" + label + "'");
    return static_cast<int>(face) - 1;
  }
};

} // namespace

Shape Mesh::shape(int element) const {
  return types[static_cast<std::size_t>(elements[static_cast<std::size_t>(element)].type)].shape;
}

Kind Mesh::kind(int element) const {
  return types[static_cast<std::size_t>(elements[static_cast<std::size_t>(element)].type)].kind;
}

std::string Mesh::node_label(int node) const {
  const Node& n = nodes[static_cast<std::size_t>(node)];
  return (n.instance == no_instance ? "" : instances[static_cast<std::size_t>(n.instance)].name + ".") +
         std::to_string(n.id);
}

std::string Mesh::element_label(int element) const {
  const Element& e = elements[static_cast<std::size_t>(element)];
  return (e.instance == no_instance ? "" : instances[static_cast<std::size_t>(e.instance)].name + ".") +
         std::to_string(e.id);
}

Mesh read_mesh(Source source) {
  Builder builder(std::move(source));
  builder.build();
  return std::move(builder.mesh);
}

} // namespace ents_deck
