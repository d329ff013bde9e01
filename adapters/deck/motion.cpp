// SPDX-License-Identifier: BSD-3-Clause
// How far the driven motion of a deck can slide one body over the other.
#include "contact_pair.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <unordered_map>

namespace ents_deck {
namespace {

using std::string;

struct Range {
  double low = 0, high = 0;
  bool absolute = false; ///< VALUE=ABSOLUTE: the values of an amplitude, whatever the line says
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
  double width() const { return high - low; }
};

/// Smallest and largest value of an amplitude, zero among them: where a job begins.
std::map<string, Range> amplitudes(const Source& source, std::vector<string>& remarks) {
  std::map<string, Range> out;
  for (const Statement& s : source.list) {
    if (s.keyword != "AMPLITUDE") continue;
    Range& range = out[canonical(s.value("NAME"))];
    range.absolute = canonical(s.value("VALUE")) == "ABSOLUTE";
    const string definition = canonical(s.value("DEFINITION"));
    double shift = 0;
    if (s.has("SHIFTY")) parse(s.value("SHIFTY"), shift);
    if (s.has("USER") || s.has("INPUT") ||
        (!definition.empty() && definition != "TABULAR" && definition != "SMOOTHSTEP"))
      remarks.push_back(
          "*AMPLITUDE, NAME=" + s.value("NAME") + " (" + source.at(s.place) +
          "): its values are not in the deck, and it is taken for 1 at most; write --slide if it is more");
    range.add(shift), range.add(s.lines.empty() ? 1 : shift);
    for (const Line& line : s.lines) {
      const auto fields = fields_of(line.text);
      for (std::size_t i = 1; i < fields.size(); i += 2) {
        double value = 0;
        if (parse(fields[i], value)) range.add(value + shift);
      }
    }
  }
  return out;
}

/// Nodes by the name of a set or their label.
class NodeNames {
public:
  explicit NodeNames(const Mesh& mesh) : mesh_(mesh) {
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
      labels_.emplace(canonical(mesh.node_label(static_cast<int>(i))), static_cast<int>(i));
  }

  std::vector<int> operator()(std::string_view name) const {
    const string key = canonical(name);
    if (const auto set = mesh_.node_sets.find(key); set != mesh_.node_sets.end()) return set->second;
    const auto node = labels_.find(key);
    return node == labels_.end() ? std::vector<int>{} : std::vector<int>{node->second};
  }

private:
  const Mesh& mesh_;
  std::unordered_map<string, int> labels_;
};

/// A rigid body that turns about its reference node.
struct Turning {
  int reference = -1,
      rotation = -1; ///< nodes; the turns are dofs 4 .. 6 of the first or 1 .. 3 of the second
  double radius = 0; ///< [L] of its farthest node about the reference node
};

std::vector<Turning> rigid_bodies(const Mesh& mesh, const NodeNames& named) {
  std::vector<Turning> out;
  const auto node_of = [&](const string& name) {
    const auto nodes = name.empty() ? std::vector<int>{} : named(name);
    return nodes.empty() ? -1 : nodes[0];
  };
  for (const Statement& s : mesh.source.list) {
    if (s.keyword != "RIGID BODY") continue;
    Turning body{node_of(s.value("REF NODE")), node_of(s.value("ROT NODE")), 0};
    if (body.reference < 0) continue;
    std::vector<int> nodes;
    for (const char* key : {"NSET", "PIN NSET", "TIE NSET"})
      if (s.has(key))
        for (const int node : named(s.value(key))) nodes.push_back(node);
    if (const auto set = mesh.element_sets.find(canonical(s.value("ELSET"))); set != mesh.element_sets.end())
      for (const int e : set->second)
        for (const int node : mesh.elements[static_cast<std::size_t>(e)].nodes) nodes.push_back(node);
    const Point& centre = mesh.nodes[static_cast<std::size_t>(body.reference)].x;
    for (const int node : nodes) {
      const Point& x = mesh.nodes[static_cast<std::size_t>(node)].x;
      body.radius = std::max(body.radius, std::hypot(x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]));
    }
    out.push_back(body);
  }
  return out;
}

std::set<int> transformed_nodes(const Mesh& mesh, const NodeNames& named) {
  std::set<int> out;
  for (const Statement& s : mesh.source.list)
    if (s.keyword == "TRANSFORM")
      for (const int node : named(s.value("NSET"))) out.insert(node);
  return out;
}

/// All *BOUNDARY lines of steps.
class Driven {
public:
  Driven(const Mesh& mesh, Motion& out)
      : mesh_(mesh), out_(out), named_(mesh), amplitudes_(amplitudes(mesh.source, out.remarks)),
        bodies_(rigid_bodies(mesh, named_)), turns_(bodies_.size()),
        transformed_(transformed_nodes(mesh, named_)) {}

  void statement(const Statement& s) {
    for (const char* unknown : {"USER", "SUBMODEL"})
      if (s.has(unknown)) {
        out_.remarks.push_back(string("*BOUNDARY, ") + unknown + " (" + mesh_.source.at(s.place) +
                               "): how far it moves is not in the deck; write --slide");
        return;
      }
    if (const string type = canonical(s.value("TYPE")); type == "VELOCITY" || type == "ACCELERATION")
      out_.remarks.push_back("*BOUNDARY, TYPE=" + type + " (" + mesh_.source.at(s.place) +
                             "): its displacement is not counted; write --slide");
    Range factor;
    factor.high = 1;
    if (s.has("AMPLITUDE")) {
      const auto found = amplitudes_.find(canonical(s.value("AMPLITUDE")));
      if (found == amplitudes_.end())
        mesh_.source.fail(s.place, "there is no *AMPLITUDE, NAME=" + s.value("AMPLITUDE"));
      factor = found->second;
    }
    for (const Line& line : s.lines) {
      const auto fields = fields_of(line.text);
      std::int64_t first = 0, last = 0;
      double value = 0;
      if (fields.size() < 2 || !parse(fields[1], first)) continue; // ENCASTRE ...
      if (fields.size() < 3 || !parse(fields[2], last)) last = first;
      if (!factor.absolute && (fields.size() < 4 || fields[3].empty())) continue; // no motion
      if (factor.absolute)
        value = 1;
      else if (!parse(fields[3], value))
        mesh_.source.fail(line.place, "expected a number, found '" + string(fields[3]) + "'");
      for (std::int64_t dof = std::max<std::int64_t>(first, 1); dof <= std::min<std::int64_t>(last, 6); ++dof)
        for (const double f : {factor.low, factor.high})
          drive(fields[0], static_cast<std::size_t>(dof - 1), f * value);
    }
  }

  void finish() {
    for (std::size_t j = 0; j < 3; ++j) out_.range[j] = straight_[j].width();
    out_.any_direction = std::hypot(turned_[0].width(), turned_[1].width(), turned_[2].width());
    double largest = 0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      double angle = 0;
      for (const Range& range : turns_[b]) angle = std::hypot(angle, range.width());
      largest = std::max(largest, 2 * bodies_[b].radius * std::sin(std::min(angle, std::numbers::pi) / 2));
    }
    out_.any_direction += largest;
  }

private:
  const Mesh& mesh_;
  Motion& out_;
  NodeNames named_;
  std::map<string, Range> amplitudes_;
  std::vector<Turning> bodies_;
  std::vector<std::array<Range, 3>> turns_; ///< [bodies_]
  std::set<int> transformed_;
  std::array<Range, 3> straight_{}, turned_{}; ///< in the directions of the axes, in directions of *TRANSFORM

  void drive(std::string_view name, std::size_t dof, double value) {
    const std::vector<int> nodes = named_(name);
    bool of_body = false;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      for (const int node : nodes) {
        const bool by_rotation_node = node == bodies_[b].rotation && dof < 3;
        if (!by_rotation_node && !(node == bodies_[b].reference && dof >= 3)) continue;
        turns_[b][dof % 3].add(value);
        of_body = true;
      }
    if (of_body) return;
    if (dof >= 3) {
      out_.rotates = out_.rotates || value != 0;
      return;
    }
    const bool is_turned =
        std::any_of(nodes.begin(), nodes.end(), [&](int node) { return transformed_.count(node) != 0; });
    (is_turned ? turned_ : straight_)[dof].add(value);
  }
};

} // namespace

Motion prescribed_motion(const Mesh& mesh) {
  Motion out;
  Driven driven(mesh, out);
  bool in_step = false;
  for (const Statement& s : mesh.source.list) {
    if (s.keyword == "STEP") in_step = true;
    if (s.keyword == "BOUNDARY" && in_step) driven.statement(s);
  }
  driven.finish();
  return out;
}

} // namespace ents_deck
