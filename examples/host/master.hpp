// SPDX-License-Identifier: BSD-3-Clause
// The master side of a contact: its segments, where they are, and what the library is told about them.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "ents_library.hpp"
#include "mesh.hpp"
#include "scene.hpp"

namespace host {

struct Master {
  std::unique_ptr<EntsModel> model; ///< the library's model of one segment
  std::unique_ptr<EntsModel> base;  ///< the same without its height, null if it has none: where a projection starts
  bool rigid = true;
  std::size_t segments = 0;
  std::vector<double> positions; ///< rigid: [segments][m][d], before the master moves
  std::vector<int> nodes;        ///< deformable: [segments][m] nodes of the mesh
  /// deformable: [segments][m][d-1], or empty: the model's own, else s = xi
  std::vector<double> surface_coordinates;
  std::vector<double> direction; ///< rigid: unit vector of its motion
  bool triangles = false;        ///< natural coordinates: unit triangle, else [-1, 1] per direction
  double border = 1;             ///< natural coordinate at which a segment ends and its margin begins

  /// How far natural coordinates lie outside the segment proper; 0 inside.
  double excess(const double* xi) const { return excess(xi, border); }
  /// How far they lie outside the segment and its margin; 0 inside.
  double excess_over_margin(const double* xi) const { return excess(xi, 1); }

private:
  double excess(const double* xi, double end) const;
};

/// The master as the scene describes it: one rigid segment carrying the enrichment, or faces of a body.
Master scene_master(const EntsLibrary& library, const Scene& scene, const Mesh& mesh);

/// The same geometry without enrichment: plain segments through points of rho_e, `divisions` per direction of
/// the rigid segment. Every segment is continued along its own (bi)linear surface by a margin of an eighth
/// of its length: beside a concave kink a penetrating node projects on neither of two segments that end there, and
/// would slip through. A segment is asked for in its margin only by nodes that project inside no segment;
/// each of the two may push such a node over to the other, for ever, so in the end it stays with one
/// (Contact::choose).
Master explicit_master(const EntsLibrary& library, const Scene& scene, int divisions);

/// Another master for a scene than these two.
using MasterMaker = std::function<Master(const EntsLibrary& library, const Scene& scene)>;

} // namespace host
