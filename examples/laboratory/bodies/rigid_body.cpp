// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface_coordinates.hpp"

namespace host {
namespace {

const std::vector<std::string>& names(int dimension) {
  static const std::vector<std::string> plane{"x", "y", "turn"},
      space{"x", "y", "z", "turn_x", "turn_y", "turn_z"};
  return dimension == 2 ? plane : space;
}

/// {"x": 1, "turn_z": 2, "path": ...}: one entry per component.
std::vector<BodyComponent> read_components(const JsonValue& list, int dimension, bool paths) {
  std::vector<BodyComponent> components;
  for (const JsonValue& item : list.items()) {
    JsonObject object(item);
    std::vector<BodyComponent> here;
    for (std::size_t i = 0; i < names(dimension).size(); ++i)
      if (object.has(names(dimension)[i]))
        here.push_back({static_cast<int>(i), object.at(names(dimension)[i]).number(), {}});
    if (here.empty()) {
      std::string all;
      for (const std::string& name : names(dimension)) all += (all.empty() ? "" : ", ") + name;
      item.fail("a component is expected: " + all);
    }
    const Path path = paths ? read_path(object) : Path{};
    for (BodyComponent& component : here) component.path = path, components.push_back(component);
    object.finish();
  }
  return components;
}

/// Segments round the z axis: `around` in a turn, `along` from `from` to `to`; surface coordinates are the
/// angle [radians] and z. Plain quad4 have their nodes on the cylinder. Of smoothed segments the control
/// points are moved out until the mean radius is that of the cylinder (Simpson's rule over a segment).
void add_cylinder(const JsonValue& value, const std::string& segment, RigidBodySpec& body) {
  JsonObject object(value);
  const double radius = object.at("radius").positive(), from = object.at("from").number(),
               to = object.at("to").number();
  const int around = object.at("around").integer(3, 100000), along = object.at("along").integer(1, 100000);
  const bool outside = object.string_or("side", "outside") != "inside";
  if (object.has("side")) object.at("side").word({"outside", "inside"});
  object.finish();
  if (!(to > from)) value.fail("\"to\" lies above \"from\"");
  const bool smooth = segment == "bspline16";
  if (!smooth && segment != "quad4")
    value.fail("a cylinder has segments quad4 or bspline16, the model's are " + segment);
  const double step = 2 * std::numbers::pi / around, pitch = (to - from) / along,
               knot = (2 + std::cos(step)) / 3,
               middle = (23 * std::cos(step / 2) + std::cos(1.5 * step)) / 24,
               of_nodes = smooth ? radius * 3 / (knot + 2 * middle) : radius;
  const int before = smooth ? 1 : 0, rows = along + 1 + 2 * before, wide = smooth ? 4 : 2;
  const double turn = outside ? 1 : -1; // seen from the tip of the normal, nodes go round counter-clockwise
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < around; ++k) {
      const double angle = turn * k * step;
      body.positions.insert(body.positions.end(), {of_nodes * std::cos(angle), of_nodes * std::sin(angle),
                                                   from + (row - before) * pitch});
    }
  static constexpr std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const auto add = [&](int column, int row) {
        body.connectivity.push_back(row * around + ((column % around) + around) % around);
        body.surface_coordinates.insert(body.surface_coordinates.end(),
                                        {turn * column * step, from + (row - before) * pitch});
      };
      for (int b = 0; smooth && b < wide; ++b)
        for (int a = 0; a < wide; ++a) add(i + a - 1, j + b);
      for (std::size_t c = 0; !smooth && c < corners.size(); ++c) add(i + corners[c][0], j + corners[c][1]);
    }
}

void add_segments(JsonObject& object, int dimension, RigidBodySpec& body) {
  const auto d = static_cast<std::size_t>(dimension);
  for (const JsonValue& item : object.at("nodes").items()) {
    const std::vector<double> node = item.numbers(d);
    for (std::size_t i = 0; i < d; ++i) body.positions.push_back(node[i] - body.reference[i]);
  }
  const auto count = static_cast<int>(body.positions.size() / d);
  if (count == 0) object.at("nodes").fail("an array of node positions is expected");
  std::vector<std::vector<double>> coordinates;
  const bool by_rule = object.has("surface_coordinates") && (object.at("surface_coordinates").is_object() ||
                                                             object.at("surface_coordinates").is_string());
  if (object.has("surface_coordinates") && !by_rule) {
    for (const JsonValue& item : object.at("surface_coordinates").items())
      coordinates.push_back(item.numbers(d - 1));
    if (coordinates.size() != static_cast<std::size_t>(count))
      object.at("surface_coordinates").fail("one entry for each of the nodes is expected");
  }
  std::size_t nodes = 0;
  for (const JsonValue& item : object.at("segments").items()) {
    const std::vector<JsonValue> segment = item.items();
    if (nodes == 0) nodes = segment.size();
    if (segment.size() != nodes) item.fail("as many nodes as in the first segment are expected");
    for (const JsonValue& node : segment) {
      const int index = node.integer(0, count - 1);
      body.connectivity.push_back(index);
      if (!coordinates.empty())
        for (const double s : coordinates[static_cast<std::size_t>(index)])
          body.surface_coordinates.push_back(s);
    }
  }
  if (body.connectivity.empty()) object.at("segments").fail("the nodes of each segment are expected");
  if (!by_rule) return;
  CoordinateRule rule = read_coordinate_rule(object.at("surface_coordinates"), dimension);
  for (std::size_t i = 0; i < d; ++i) rule.point[i] -= body.reference[i];
  body.surface_coordinates = surface_coordinates(rule, dimension, body.positions, body.connectivity, nodes);
}

} // namespace

RigidBodySpec read_rigid_body(const JsonValue& value, int dimension, const std::string& segment) {
  JsonObject object(value);
  RigidBodySpec body;
  if (object.has("reference")) {
    const std::vector<double> point = object.at("reference").numbers(static_cast<std::size_t>(dimension));
    std::copy(point.begin(), point.end(), body.reference.begin());
  }
  if (object.has("cylinder")) {
    if (dimension != 3) object.at("cylinder").fail("a cylinder is a surface in space");
    add_cylinder(object.at("cylinder"), segment, body);
  } else {
    add_segments(object, dimension, body);
  }
  if (object.has("prescribed")) body.prescribed = read_components(object.at("prescribed"), dimension, true);
  if (object.has("loads")) body.loads = read_components(object.at("loads"), dimension, true);
  if (object.has("springs")) body.springs = read_components(object.at("springs"), dimension, false);
  // What is neither prescribed, loaded nor named free stays where it is.
  std::vector<char> known(names(dimension).size(), 0);
  for (const BodyComponent& c : body.prescribed) {
    char& mark = known[static_cast<std::size_t>(c.component)];
    if (mark)
      object.at("prescribed")
          .fail(names(dimension)[static_cast<std::size_t>(c.component)] + " is prescribed twice");
    mark = 1;
  }
  for (const BodyComponent& c : body.loads) {
    if (known[static_cast<std::size_t>(c.component)] == 1)
      object.at("loads").fail(names(dimension)[static_cast<std::size_t>(c.component)] +
                              " is prescribed, a load on it has no effect");
    known[static_cast<std::size_t>(c.component)] = 2;
  }
  if (object.has("free"))
    for (const JsonValue& item : object.at("free").items()) {
      const std::string name = item.word(names(dimension));
      char& mark = known[static_cast<std::size_t>(
          std::find(names(dimension).begin(), names(dimension).end(), name) - names(dimension).begin())];
      if (mark == 1) item.fail(name + " is prescribed");
      mark = 2;
    }
  for (std::size_t i = 0; i < known.size(); ++i)
    if (!known[i]) body.prescribed.push_back({static_cast<int>(i), 0, {}});
  if (dimension == 2) body.prescribed.push_back({3, 0, {}}); // the second component of the node that turns
  object.finish();
  return body;
}

} // namespace host
