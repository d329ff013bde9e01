// SPDX-License-Identifier: BSD-3-Clause
// Element types of decks: which shape a name such as C3D20R stands for, and the faces of each shape.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ents_deck {

enum class Shape { none, line2, line3, tri3, tri6, quad4, quad8, tet4, tet10, wedge6, wedge15, hex8, hex20 };

/// What the name says about the space that the element lives in.
enum class Kind { other, plane_stress, plane_strain, axisymmetric, solid, shell, line };

struct Type {
  std::string name;
  Shape shape = Shape::none; ///< none: the type is unknown here; its elements have a number and no nodes
  Kind kind = Kind::other;
};

/// C3D4 C3D6 C3D8 C3D10 C3D15 C3D20, CPS, CPE, CPEG, CAX 3 4 6 8, S, M3D, R3D, SFM3D 3 4 6 8, SC6R SC8R,
/// STRI3 STRI65, T2D2 T3D2 T3D3, B21 .. B33, with any letters behind: R, I, H, M, T ...
Type type_of(std::string_view upper_case_name);

int node_count(Shape shape);
int corner_count(Shape shape);
int dimension(Shape shape);  ///< 1 lines, 2 triangles and quadrilaterals, 3 solids
int face_count(Shape shape); ///< of solids; edges of triangles and quadrilaterals; 0 of lines
int vtk_type(Shape shape);

/// The face `face` (counted from 0; Abaqus S1 is 0) as local nodes, in the library's order: corners, so that
/// the normal points out of the element, then the middles of the sides. Shape: the face's own.
std::span<const int> face_nodes(Shape shape, int face);
Shape face_shape(Shape shape, int face);

/// Name of a face's shape in a model: "line2" ... "quad8".
const char* segment_name(Shape shape);

} // namespace ents_deck
