// SPDX-License-Identifier: BSD-3-Clause
#include "surface_coordinates.hpp"

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

namespace ents_deck {
namespace {

using std::string;

constexpr double turn = 2 * std::numbers::pi;

/// "NODE S1 [S2]" a line, # starts a comment; nodes as the deck calls them.
std::map<string, std::vector<double>> read_table(const std::filesystem::path& file, std::size_t parameters) {
  std::ifstream stream(file);
  if (!stream) throw Error("the surface coordinates " + file.string() + " cannot be read");
  std::map<string, std::vector<double>> out;
  string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    std::istringstream words(text.substr(0, text.find('#')));
    string node, word;
    if (!(words >> node)) continue;
    std::vector<double> s;
    while (words >> word) {
      double value = 0;
      if (!parse(word, value))
        throw Error(file.string() + ":" + std::to_string(line) + ": expected a number, found '" + word + "'");
      s.push_back(value);
    }
    if (s.size() != parameters)
      throw Error(file.string() + ":" + std::to_string(line) + ": expected a node and " +
                  std::to_string(parameters) + " surface coordinates");
    out[canonical(node)] = s;
  }
  return out;
}

int axis_of(char c) { return c == 'x' ? 0 : c == 'y' ? 1 : c == 'z' ? 2 : -1; }

bool is_cylinder(const string& how) { return how.rfind("cylinder", 0) == 0; }

} // namespace

std::vector<std::vector<double>> coordinates_of_faces(const Mesh& mesh, const Side& master, const string& how,
                                                      const std::filesystem::path& file) {
  const std::size_t parameters = corner_count(master.faces.at(0).shape) == 2 ? 1 : 2;
  std::map<string, std::vector<double>> table;
  std::vector<int> axes;
  if (how == "file") {
    table = read_table(file, parameters);
  } else if (is_cylinder(how)) {
    axes.push_back(axis_of(how.back()));
  } else {
    for (const char c : how) axes.push_back(axis_of(c));
    if (axes.size() != parameters)
      throw Error("--coordinates " + how + ": this master has " + std::to_string(parameters) +
                  " surface coordinate" +
                  (parameters == 1 ? ", write x or y" : "s, write two letters such as xy"));
  }
  std::vector<std::vector<double>> all;
  for (const Face& face : master.faces) {
    auto& out = all.emplace_back();
    double first_angle = 0;
    for (std::size_t i = 0; i < face.nodes.size(); ++i) {
      const Point& x = mesh.nodes[static_cast<std::size_t>(face.nodes[i])].x;
      if (how == "file") {
        const auto found = table.find(canonical(mesh.node_label(face.nodes[i])));
        if (found == table.end())
          throw Error(file.string() + " has no line for the master node " + mesh.node_label(face.nodes[i]));
        out.insert(out.end(), found->second.begin(), found->second.end());
      } else if (is_cylinder(how)) {
        const auto along = static_cast<std::size_t>(parameters == 1 ? 2 : axes[0]);
        double angle = std::atan2(x[(along + 2) % 3], x[(along + 1) % 3]);
        if (i == 0) first_angle = angle;
        angle -= turn * std::round((angle - first_angle) / turn);
        out.push_back(angle);
        if (parameters == 2) out.push_back(x[along]);
      } else {
        for (const int axis : axes) out.push_back(x[static_cast<std::size_t>(axis)]);
      }
    }
  }
  return all;
}

std::vector<double> plane_coordinates(const Mesh& mesh, const Side& master, const Patch& patch) {
  const auto x = [&](std::size_t i) { return mesh.nodes[static_cast<std::size_t>(patch.nodes[i])].x; };
  const Face& face = master.faces[static_cast<std::size_t>(patch.face)];
  const Point origin = x(0), n = face_normal(mesh, face);
  std::vector<double> out;
  if (corner_count(face.shape) == 2) { // arc length: nodes of lines come one after the other
    std::vector<double> s(patch.nodes.size());
    for (const auto& segment : patch.topology) {
      const auto a = static_cast<std::size_t>(segment[0]), b = static_cast<std::size_t>(segment[1]);
      s[b] = s[a] + length(minus(x(b), x(a)));
      if (segment.size() > 2) s[static_cast<std::size_t>(segment[2])] = (s[a] + s[b]) / 2;
    }
    return s;
  }
  Point first = minus(mesh.nodes[static_cast<std::size_t>(face.nodes[1])].x,
                      mesh.nodes[static_cast<std::size_t>(face.nodes[0])].x);
  Point second = cross(n, first);
  const double l1 = length(first), l2 = length(second);
  for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
    const Point from = minus(x(i), origin);
    out.push_back(dot(from, first) / l1);
    out.push_back(dot(from, second) / l2);
  }
  return out;
}

std::vector<double> coordinates_of_patch(const Side& master, const Patch& patch,
                                         const std::vector<std::vector<double>>& of_faces,
                                         std::size_t parameters, const string& how) {
  std::vector<double> out(patch.nodes.size() * parameters);
  std::vector<char> known(patch.nodes.size());
  for (std::size_t k = 0; k < patch.faces.size(); ++k) {
    const Face& face = master.faces[static_cast<std::size_t>(patch.faces[k])];
    const std::size_t m = face.nodes.size();
    const std::vector<double>& own = of_faces[static_cast<std::size_t>(patch.faces[k])];
    // Angles of this face go on from those of the faces before: a node that both have tells by how many
    // turns.
    double turns = 0;
    std::vector<std::size_t> local(m);
    for (std::size_t i = 0; i < m; ++i) {
      local[i] = 0;
      while (patch.nodes[local[i]] != face.nodes[i]) ++local[i];
      if (is_cylinder(how) && known[local[i]] != 0)
        turns = std::round((out[local[i] * parameters] - own[i * parameters]) / turn);
    }
    for (std::size_t i = 0; i < m; ++i) {
      if (known[local[i]] != 0) continue;
      known[local[i]] = 1;
      for (std::size_t p = 0; p < parameters; ++p)
        out[local[i] * parameters + p] = own[i * parameters + p] + (p == 0 ? turn * turns : 0);
    }
  }
  return out;
}

} // namespace ents_deck
