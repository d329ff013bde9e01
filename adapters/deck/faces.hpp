// SPDX-License-Identifier: BSD-3-Clause
// Faces of a body that a contact pair names: oriented, with areas and normals of their nodes.
#pragma once

#include <string>
#include <vector>

#include "mesh.hpp"

namespace ents_deck {

/// The normal points out of the body: tangent turned by +90 degrees in 2D, rho_,1 x rho_,2 in 3D.
struct Face {
  int element = 0, face = 0; ///< of the body
  Shape shape = Shape::none;
  std::vector<int> nodes; ///< indices into Mesh::nodes, in the library's order
};

/// One side of a contact pair.
struct Side {
  std::string name;
  std::vector<Face> faces;   ///< empty for nodes that no face belongs to
  std::vector<int> nodes;    ///< of the faces, or of the surface, in the deck's order
  std::vector<double> areas; ///< [nodes] from the deck's data lines of a surface of nodes; 0: not given
  Place place;
};

/// A surface, a set of boundary elements (as Gmsh marks a boundary) or a set of nodes (the boundary faces
/// with all their nodes in it), looked up in this order.
/// @throws Error for an unknown name, a face inside the body, an element whose nodes turn the wrong way
Side side_of(const Mesh& mesh, const std::string& name, Place asked_at);

Point minus(const Point& a, const Point& b);
Point cross(const Point& a, const Point& b);
double dot(const Point& a, const Point& b);
double length(const Point& a);

/// Not normalised; of the flat face through the corners.
Point face_normal(const Mesh& mesh, const Face& face);
Point face_middle(const Mesh& mesh, const Face& face);

/// Free faces of bodies that have at least one of these nodes.
std::vector<Face> free_faces_at(const Mesh& mesh, const std::vector<int>& nodes);

/// Unit normals of nodes, means of those of their faces weighted with areas; zero for nodes without faces.
std::vector<Point> node_normals(const Mesh& mesh, const Side& side);

} // namespace ents_deck
