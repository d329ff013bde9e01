// SPDX-License-Identifier: BSD-3-Clause
// Surface coordinates of a master's nodes by rule, in the reference configuration.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "toolbox/json_reader.hpp"

namespace host {

struct CoordinateRule {
  enum class Kind {
    none,       ///< the model's own, else natural coordinates
    axes,       ///< reference coordinates
    arc_length, ///< plane: along the line of segments, from its beginning [L]
    cylinder,   ///< space: angle round an axis [radians], place along it [L]
    polar, ///< space: distance from an axis [L], angle round it [radians]; plane: the angle round a point
  };
  Kind kind = Kind::none;
  std::vector<int> axes;
  int axis = 2;                  ///< cylinder, polar: 0, 1, 2 for x, y, z
  std::array<double, 3> point{}; ///< cylinder, polar: on the axis
  std::string where;             ///< file and path, for messages
};

/// The key "surface_coordinates" of a master: ["x"], "arc_length", {"cylinder": {"axis", "point"}}, {"polar":
/// {..}}.
/// @throws InputError naming the key
CoordinateRule read_coordinate_rule(const JsonValue& value, int dimension);

/// Angles of the nodes of a segment differ by less than half a turn from one to the next, whatever they are
/// in other segments.
/// @param points        [n][dimension]
/// @param connectivity  [segments][nodes]
/// @return [segments][nodes][dimension - 1]; empty for Kind::none
/// @throws InputError where there are none: a node on the axis, segments that are no line
std::vector<double> surface_coordinates(const CoordinateRule& rule, int dimension,
                                        const std::vector<double>& points,
                                        const std::vector<std::int64_t>& connectivity, std::size_t nodes);

} // namespace host
