// SPDX-License-Identifier: BSD-3-Clause
// A checked model: what an element needs beside the positions of its nodes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/height/height_tree.hpp"
#include "core/law/contact_law.hpp"
#include "core/surface/bases.hpp"

namespace ents {

enum class ProjectionKind : std::int32_t {
  normal,          // (x_s - rho_e) . rho_e,a = 0
  shadow_point,    // along the line from the slave to an emitter
  shadow_direction // along a fixed direction
};

enum class TangentKind : std::int32_t {
  consistent,     // d2g/du2 exact
  small_gap,      // terms in g dropped (Konyukhov and Schweizerhof 2005)
  first_variation // d2g/du2 = 0
};

// A number that the caller gives by name (binding.hpp).
struct NamedParameter {
  std::string name;
  double value; // where the caller gives none
};

// Numbers of a law that a named parameter gives: 1 + its index; 0: the model's own number
struct LawBinding {
  std::uint8_t normal = 0;   // ContactLaw::number[0]
  std::uint8_t friction = 0; // coefficient
  std::uint8_t wear = 0;     // coefficient
  std::uint8_t sliding = 0;  // of wear
  std::uint8_t offset = 0;
  std::uint8_t heat_constant = 0, heat_coefficient = 0, heat_conductivity = 0, heat_share = 0;
};

struct ModelSpec {
  Basis basis = Basis::line2;
  Height height;                           // of as many surface coordinates as the basis has parameters
  bool own_surface_coordinates = false;    // else the host's, else s = xi
  std::vector<double> surface_coordinates; // [m][parameters]
  ProjectionKind projection = ProjectionKind::normal;
  double ray[3] = {0.0, 0.0, 0.0}; // emitter, or unit direction; third entry 0 in 2D
  ContactLaw law;                  // normal kind `none`: kinematics only
  std::vector<LawTable> law_table; // of a law that is a table
  // Of a coefficient of friction: rising pressures and slip rates, a row of numbers for each pressure
  std::vector<double> friction_pressures, friction_rates, friction_coefficients;
  std::vector<ConductancePoint> conductance_by_pressure, conductance_by_gap; // of heat
  LawBinding law_binding;
  std::vector<NamedParameter> parameters; // in the order of their names
  std::vector<std::string> fields;
  TangentKind tangent = TangentKind::consistent;
  bool rigid_master = false;      // dofs of the slave alone
  double penetration_limit = 0.0; // [L]; 0: the size of the segment
  double border = 1e-7;           // natural coordinates by which the segment reaches beyond its edges
};

} // namespace ents
