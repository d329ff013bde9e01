// SPDX-License-Identifier: BSD-3-Clause
// Reader for the mesh part of Abaqus/CalculiX .inp decks, as Gmsh and other meshers write them:
// *NODE *ELEMENT *NSET *ELSET *SURFACE *HEADING *INCLUDE and ** comments. Keywords and names do not
// depend on case. Anything else (materials, steps ...) is listed in Deck::ignored. What would change the mesh
// and is not understood (*PART, *NGEN, *SYSTEM ...) is an error. Abaqus Keywords Guide; CalculiX CrunchiX
// manual, chapter 7.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace host::inp {

/// "FILE:LINE: what was wrong, what was expected".
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Shape { line2, tri3, quad4, tet4, hex8, wedge6 };

/// What the type name says about the out-of-plane direction.
enum class Kind { plane_stress, plane_strain, axisymmetric, solid, shell, truss };

struct Element {
  std::int64_t id = 0; ///< as in the deck
  Shape shape = Shape::line2;
  Kind kind = Kind::truss;
  std::array<int, 8> nodes{}; ///< indices into Deck::coordinates, the first node_count(shape) are used
  int file = 0, line = 0;     ///< where it was defined; `file` indexes Deck::files
};

/// Face of an element; `face` is 0-based: Abaqus S1 is 0.
struct Facet {
  int element = 0, face = 0;
};

struct Surface {
  bool of_nodes = false; ///< TYPE=NODE
  std::vector<Facet> facets;
  std::vector<int> nodes;
};

struct Ignored {
  std::string keyword, file;
  int line = 0;
};

/// Sets are named in upper case and hold indices (not ids), without repetition, in the deck's order.
struct Deck {
  std::vector<std::string> files; ///< the deck and what it includes
  std::string heading;
  std::vector<std::int64_t> node_ids;
  std::vector<std::array<double, 3>> coordinates; ///< [nodes], length; missing ones are 0
  std::vector<Element> elements;
  std::map<std::string, std::vector<int>> node_sets, element_sets;
  std::map<std::string, Surface> surfaces;
  std::vector<Ignored> ignored; ///< keywords that were skipped, with their data lines
};

/// @throws Error
Deck read(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages, includes start at `folder`.
Deck read_text(std::string_view text, const std::string& name, const std::filesystem::path& folder = {});

int node_count(Shape shape);
int face_count(Shape shape); ///< edges in 2D
int dimension(Shape shape);  ///< 1 line2, 2 tri3 quad4, 3 tet4 hex8 wedge6

/// Dimension of the body: 3 if the deck has solids, else 2. A mesher also writes the
/// boundary, as elements one dimension lower.
int dimension(const Deck& deck);

/// Elements of the body (those of its dimension) in an element set, or in the whole deck if `set` is empty.
/// @throws Error for an unknown set, or an element whose nodes turn the wrong way (zero or negative size)
std::vector<int> body(const Deck& deck, std::string_view set = {});

/// Node indices of a node set, a surface or an element set of that name (looked up in this order).
/// @throws Error listing the names there are
std::vector<int> nodes_of(const Deck& deck, std::string_view name);

/// Faces of the body as node lists, oriented for contact: the normal points out of the body, where
/// normal = tangent turned by +90 degrees in 2D and rho_,1 x rho_,2 in 3D.
struct Face {
  int element = 0;            ///< the body element it belongs to
  int count = 0;              ///< 2, 3 or 4
  std::array<int, 4> nodes{}; ///< indices into Deck::coordinates
};

/// Faces of a surface (TYPE=ELEMENT), of an element set of boundary elements (how Gmsh marks a boundary), or
/// the boundary faces of the body with all nodes in a node set or node surface.
/// @throws Error for an unknown name, a boundary element that is no face of the body, or an empty result
std::vector<Face> faces_of(const Deck& deck, std::string_view name);

} // namespace host::inp
