// SPDX-License-Identifier: BSD-3-Clause
// A checked model: what an element needs beside the positions of its nodes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/height/height_tree.hpp"
#include "core/law/contact_law.hpp"

namespace ents {

// Segment bases, listed once: their name, their type in surface/basis.hpp, and the rest of a BasisEntry.
#define ENTS_BASES(X)                                                                                        \
  X(line2, Line2, 2, 1, false, false)                                                                        \
  X(line3, Line3, 3, 1, false, false)                                                                        \
  X(catmull_rom4, CatmullRom4, 4, 1, false, true)                                                            \
  X(bspline4, BSpline4, 4, 1, false, true)                                                                   \
  X(tri3, Tri3, 3, 2, true, false)                                                                           \
  X(tri6, Tri6, 6, 2, true, false)                                                                           \
  X(quad4, Quad4, 4, 2, false, false)                                                                        \
  X(quad8, Quad8, 8, 2, false, false)                                                                        \
  X(quad9, Quad9, 9, 2, false, false)                                                                        \
  X(catmull_rom16, CatmullRom16, 16, 2, false, true)                                                         \
  X(bspline16, BSpline16, 16, 2, false, true)                                                                \
  X(bezier15, Bezier15, 15, 2, true, true)

#define ENTS_BASIS(name, ...) name,
enum class Basis : std::int32_t { ENTS_BASES(ENTS_BASIS) };
#undef ENTS_BASIS

struct BasisEntry {
  Basis basis;
  const char* name;
  std::int32_t nodes;      // m
  std::int32_t parameters; // convective coordinates = surface coordinates; dimension of space - 1
  bool simplex;            // xi >= 0, sum xi <= 1; else -1 .. 1 per direction
  bool smoothed;           // over several segments: its nodes are not the corners of the segment
};

#define ENTS_BASIS(name, type, ...) {Basis::name, #name, __VA_ARGS__},
inline constexpr BasisEntry basis_table[] = {ENTS_BASES(ENTS_BASIS)};
#undef ENTS_BASIS

constexpr const BasisEntry& basis_entry(Basis basis) { return basis_table[static_cast<std::int32_t>(basis)]; }

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

// A number that the caller gives by name (height_binding.hpp).
struct NamedParameter {
  std::string name;
  double value; // where the caller gives none
};

// Numbers of a law that a named parameter gives: 1 + its index; 0: the model's own number
struct LawBinding {
  std::uint8_t normal = 0;   // stiffness of the penalty and the augmented laws, coefficient of the power law,
                             // pressure of the exponential
  std::uint8_t friction = 0; // coefficient
  std::uint8_t wear = 0;     // coefficient
  std::uint8_t sliding = 0;  // of wear
  std::uint8_t offset = 0;
};

struct Model {
  Basis basis = Basis::line2;
  Height height;                           // of as many surface coordinates as the basis has parameters
  bool own_surface_coordinates = false;    // else the host's, else s = xi
  std::vector<double> surface_coordinates; // [m][parameters]
  ProjectionKind projection = ProjectionKind::normal;
  double ray[3] = {0.0, 0.0, 0.0}; // emitter, or unit direction; third entry 0 in 2D
  ContactLaw law;                  // normal kind `none`: kinematics only
  std::vector<LawTable> law_table; // of a law that is a table
  LawBinding law_binding;
  std::vector<NamedParameter> parameters; // in the order of their names
  std::vector<std::string> fields;
  TangentKind tangent = TangentKind::consistent;
  bool rigid_master = false;      // dofs of the slave alone
  double penetration_limit = 0.0; // [L]; 0: the size of the segment
  double border = 1e-7;           // natural coordinates by which the segment reaches beyond its edges
};

} // namespace ents
