// SPDX-License-Identifier: BSD-3-Clause
#include "surface_coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace host {
namespace {

using Kind = CoordinateRule::Kind;

/// {"axis": "z", "point": [0, 0, 0]}; in the plane {"point": [0, 0]}.
void read_axis(const JsonValue& value, int dimension, CoordinateRule& rule) {
  JsonObject object(value);
  if (dimension == 3 && object.has("axis")) {
    const std::string axis = object.at("axis").word({"x", "y", "z"});
    rule.axis = axis == "x" ? 0 : axis == "y" ? 1 : 2;
  }
  if (object.has("point")) {
    const std::vector<double> point = object.at("point").numbers(static_cast<std::size_t>(dimension));
    std::copy(point.begin(), point.end(), rule.point.begin());
  }
  object.finish();
}

/// The node of the same segment that is beside node `a`: it has nearly the same angle.
std::size_t beside(std::size_t a, std::size_t nodes) {
  if (nodes == 16) return a % 4 == 0 ? a - 4 : a - 1; // rows of four
  return nodes == 4 ? a - 1 : 0;
}

std::vector<double> angles(const CoordinateRule& rule, std::size_t d, const std::vector<double>& points,
                           const std::vector<std::int64_t>& connectivity, std::size_t nodes) {
  constexpr double turn = 2 * std::numbers::pi;
  const auto axis = static_cast<std::size_t>(rule.axis), u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<double> result;
  std::vector<double> angle(nodes);
  for (std::size_t first = 0; first < connectivity.size(); first += nodes)
    for (std::size_t a = 0; a < nodes; ++a) {
      const double* x = points.data() + static_cast<std::size_t>(connectivity[first + a]) * d;
      const double across = x[u] - rule.point[u], up = x[v] - rule.point[v], radius = std::hypot(across, up);
      if (!(radius > 0)) throw InputError(rule.where + ": a node of the master lies on the axis: no angle");
      angle[a] = std::atan2(up, across);
      if (a > 0) angle[a] -= turn * std::round((angle[a] - angle[beside(a, nodes)]) / turn);
      if (d == 2)
        result.push_back(angle[a]);
      else if (rule.kind == Kind::cylinder)
        result.insert(result.end(), {angle[a], x[axis] - rule.point[axis]});
      else
        result.insert(result.end(), {radius, angle[a]});
    }
  return result;
}

std::vector<double> arc_lengths(const CoordinateRule& rule, const std::vector<double>& points,
                                const std::vector<std::int64_t>& connectivity, std::size_t nodes) {
  if (nodes != 2 && nodes != 4)
    throw InputError(rule.where + ": \"arc_length\" is for segments of two nodes, or smoothed ones of four");
  const std::size_t segments = connectivity.size() / nodes, begin = nodes == 2 ? 0 : 1;
  const auto node = [&](std::size_t s, std::size_t a) { return connectivity[s * nodes + a]; };
  const auto distance = [&](std::size_t s, std::size_t a) { // from node a of a segment to the next one
    const double* x = points.data() + 2 * static_cast<std::size_t>(node(s, a));
    const double* y = points.data() + 2 * static_cast<std::size_t>(node(s, a + 1));
    return std::hypot(y[0] - x[0], y[1] - x[1]);
  };
  std::map<std::int64_t, std::size_t> begins, ends;
  for (std::size_t s = 0; s < segments; ++s)
    begins.emplace(node(s, begin), s), ends.emplace(node(s, begin + 1), s);
  std::size_t at = 0; // the first segment of a closed line
  for (std::size_t s = 0; s < segments; ++s)
    if (ends.count(node(s, begin)) == 0) at = s;
  std::vector<double> result(connectivity.size());
  std::vector<char> seen(segments, 0);
  double length = 0;
  std::size_t count = 0;
  for (auto next = begins.find(node(at, begin)); next != begins.end() && !seen[next->second]; ++count) {
    at = next->second;
    seen[at] = 1;
    double* s = result.data() + at * nodes;
    s[begin] = length;
    if (begin > 0) s[0] = length - distance(at, 0);
    for (std::size_t a = begin; a + 1 < nodes; ++a) s[a + 1] = s[a] + distance(at, a);
    length = s[begin + 1];
    next = begins.find(node(at, begin + 1));
  }
  if (count != segments)
    throw InputError(rule.where +
                     ": \"arc_length\" is for one line of segments that follow one another; here are more");
  return result;
}

} // namespace

CoordinateRule read_coordinate_rule(const JsonValue& value, int dimension) {
  CoordinateRule rule;
  rule.where = value.where();
  if (value.is_string()) {
    value.word({"arc_length"});
    if (dimension == 3)
      value.fail("\"arc_length\" is for lines in the plane; take \"cylinder\" or \"polar\"");
    rule.kind = Kind::arc_length;
  } else if (value.is_object()) {
    JsonObject object(value);
    const bool cylinder = dimension == 3 && object.has("cylinder");
    rule.kind = cylinder ? Kind::cylinder : Kind::polar;
    read_axis(object.at(cylinder ? "cylinder" : "polar"), dimension, rule);
    object.finish();
  } else {
    rule.kind = Kind::axes;
    for (const JsonValue& item : value.items()) {
      const std::string axis = item.word(dimension == 2 ? std::vector<std::string>{"x", "y"}
                                                        : std::vector<std::string>{"x", "y", "z"});
      rule.axes.push_back(axis == "x" ? 0 : axis == "y" ? 1 : 2);
    }
    if (static_cast<int>(rule.axes.size()) != dimension - 1)
      value.fail("one reference coordinate per surface coordinate is expected: " +
                 std::to_string(dimension - 1));
  }
  return rule;
}

std::vector<double> surface_coordinates(const CoordinateRule& rule, int dimension,
                                        const std::vector<double>& points,
                                        const std::vector<std::int64_t>& connectivity, std::size_t nodes) {
  const auto d = static_cast<std::size_t>(dimension);
  if (rule.kind == Kind::arc_length) return arc_lengths(rule, points, connectivity, nodes);
  if (rule.kind == Kind::cylinder || rule.kind == Kind::polar)
    return angles(rule, d, points, connectivity, nodes);
  std::vector<double> result;
  if (rule.kind == Kind::axes)
    for (const std::int64_t point : connectivity)
      for (const int axis : rule.axes)
        result.push_back(points[static_cast<std::size_t>(point) * d + static_cast<std::size_t>(axis)]);
  return result;
}

} // namespace host
