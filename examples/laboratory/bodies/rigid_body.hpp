// SPDX-License-Identifier: BSD-3-Clause
// A rigid master that moves and turns: its surface of many segments, and what holds and loads it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "keys.hpp"
#include "toolbox/json_reader.hpp"

namespace host {

/// One component of the motion of a rigid body, or of the load on it: 0 .. d-1 along x, y (z), then the
/// turns: round x, y, z in space, round z in the plane.
struct BodyComponent {
  int component = 0;
  double value = 0; ///< [L], turns in radians; loads [F], moments [F L]
  Path path;        ///< factor on the value over the load factor
};

struct RigidBodySpec {
  std::array<double, 3> reference{};       ///< turns and moments are about it
  std::vector<double> positions;           ///< [nodes][d] in the frame of the body, whose origin it is
  std::vector<std::int64_t> connectivity;  ///< [segments][m]
  std::vector<double> surface_coordinates; ///< [segments][m][d-1], or empty: the model's own
  std::vector<BodyComponent> prescribed;
  std::vector<BodyComponent> loads;
  std::vector<BodyComponent> springs; ///< stiffness [F/L], [F L] against the ground; no paths

  static int components(int dimension) { return dimension == 2 ? 3 : 6; }
  /// The dof of the mesh that a component is: the body has two nodes, for displacement and turns.
  static std::size_t dof(int first_node, int dimension, int component) {
    return static_cast<std::size_t>(first_node * dimension + component);
  }
};

/// The key "rigid_body" of a master.
/// @param segment  of the contact's model
/// @throws InputError naming the key
RigidBodySpec read_rigid_body(const JsonValue& value, int dimension, const std::string& segment);

} // namespace host
