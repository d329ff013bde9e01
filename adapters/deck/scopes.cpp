// SPDX-License-Identifier: BSD-3-Clause
#include "scopes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace ents_deck {
namespace {

const std::vector<std::string_view> mesh_changing{"SYSTEM", "NGEN",  "NFILL",  "NMAP",
                                                  "NCOPY",  "ELGEN", "ELCOPY", "PARTS"};

double number(const Source& source, const Line& line, std::string_view field) {
  double value = 0;
  if (!field.empty() && !parse(field, value))
    source.fail(line.place, "expected a number, found '" + std::string(field) + "'");
  return value;
}

/// Data lines of *INSTANCE: three numbers of a translation, then seven of a rotation.
void read_placement(const Source& source, const Statement& s, Instance& instance) {
  if (s.lines.size() > 2)
    source.fail(s.lines[2].place, "*INSTANCE has at most two data lines, translation and rotation");
  for (std::size_t l = 0; l < s.lines.size(); ++l) {
    const auto fields = fields_of(s.lines[l].text);
    const std::size_t wanted = l == 0 ? 3 : 7;
    if (fields.size() > wanted || (l == 1 && fields.size() != wanted))
      source.fail(s.lines[l].place, l == 0 ? "expected the three numbers of a translation"
                                           : "expected two points of an axis and an angle, seven numbers");
    for (std::size_t i = 0; i < fields.size(); ++i)
      (l == 0 ? instance.translation[i] : instance.rotation[i]) = number(source, s.lines[l], fields[i]);
  }
}

} // namespace

Scopes scopes_of(const Source& source) {
  Scopes out;
  std::map<std::string, std::vector<const Statement*>> parts;
  std::vector<const Statement*>* part = nullptr;
  int instance = no_instance;
  bool assembly = false;
  const Statement* open = nullptr; ///< of the scope that has to be ended
  for (const Statement& s : source.list) {
    const std::string& k = s.keyword;
    if (std::find(mesh_changing.begin(), mesh_changing.end(), k) != mesh_changing.end())
      source.fail(s.place,
                  "*" + k + " changes the mesh and is not read; write the nodes and elements themselves");
    const auto name = [&] {
      const std::string value = s.value("NAME");
      if (value.empty()) source.fail(s.place, "*" + k + " needs NAME=");
      return value;
    };
    if (k == "PART" || k == "ASSEMBLY" || k == "INSTANCE") {
      if (part || instance != no_instance || (k != "INSTANCE" && assembly))
        source.fail(s.place, "*" + k + " inside of what begins at " + source.at(open->place));
      if (k == "INSTANCE" && !assembly) source.fail(s.place, "*INSTANCE outside of *ASSEMBLY");
      open = &s;
    }
    if (k == "PART") {
      const auto [entry, is_new] = parts.emplace(canonical(name()), std::vector<const Statement*>{});
      if (!is_new) source.fail(s.place, "part " + name() + " is defined a second time");
      part = &entry->second;
    } else if (k == "END PART") {
      part = nullptr;
    } else if (k == "ASSEMBLY") {
      assembly = true;
    } else if (k == "END ASSEMBLY") {
      assembly = false;
    } else if (k == "INSTANCE") {
      if (s.has("LIBRARY"))
        source.fail(s.place, "*INSTANCE, LIBRARY= is not read: the mesh is in another job");
      Instance in{name(), s.value("PART"), s.place, {}, {}};
      read_placement(source, s, in);
      instance = static_cast<int>(out.instances.size());
      const auto found = parts.find(canonical(in.part));
      if (found == parts.end())
        source.fail(s.place, "there is no *PART, NAME=" + in.part + " before this line");
      for (const Statement* of_part : found->second) out.list.push_back({of_part, instance, true});
      out.instances.push_back(std::move(in));
    } else if (k == "END INSTANCE") {
      instance = no_instance;
    } else if (part) {
      part->push_back(&s);
    } else {
      out.list.push_back({&s, instance, false});
    }
  }
  if (part || instance != no_instance || assembly)
    source.fail(open->place, "*" + open->keyword + " has no *END " + open->keyword);
  return out;
}

Point placed(const Instance& instance, const Point& x) {
  Point y{};
  for (std::size_t i = 0; i < 3; ++i) y[i] = x[i] + instance.translation[i];
  const auto& r = instance.rotation;
  if (r[6] == 0) return y;
  Point axis{r[3] - r[0], r[4] - r[1], r[5] - r[2]}, from{};
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  if (length == 0) return y;
  for (std::size_t i = 0; i < 3; ++i) axis[i] /= length, from[i] = y[i] - r[i];
  const double angle = r[6] * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const double along = axis[0] * from[0] + axis[1] * from[1] + axis[2] * from[2];
  const Point cross{axis[1] * from[2] - axis[2] * from[1], axis[2] * from[0] - axis[0] * from[2],
                    axis[0] * from[1] - axis[1] * from[0]};
  for (std::size_t i = 0; i < 3; ++i)
    y[i] = r[i] + c * from[i] + s * cross[i] + (1 - c) * along * axis[i]; // Rodrigues
  return y;
}

} // namespace ents_deck
