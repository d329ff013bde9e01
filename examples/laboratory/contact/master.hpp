// SPDX-License-Identifier: BSD-3-Clause
// The master side of a contact: its segments, where they are, and what the library is told about them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "control_net.hpp"
#include "ents_library.hpp"
#include "mesh.hpp"
#include "scene.hpp"

namespace host {

struct Master {
  std::unique_ptr<EntsModel> model; ///< the library's model of one segment
  std::unique_ptr<EntsModel> base;  ///< the same without its height, null if it has none
  /// The embedded profile of Paggi and Reinoso (Mech. Adv. Mater. Struct. 27, 2020): `model` has no height;
  /// the gap is that to the segment minus the height of this model under the point in the undeformed bodies.
  /// The normal is the segment's. Null: the enriched geometry.
  std::unique_ptr<EntsModel> profile;
  bool rigid = true;
  /// [segments][m] nodes: of `positions`, of the mesh, or points of `net`
  std::vector<std::int64_t> connectivity;
  std::unique_ptr<ControlNet> net; ///< of a deformable, smoothed master whose points are no nodes; else null
  std::vector<double> positions;   ///< rigid: [nodes][d], before the master moves
  std::vector<double> surface_coordinates; ///< [segments][m][d-1], or empty: the model's own, else s = xi
  std::vector<double> direction;           ///< rigid, moved along a line: unit vector of its motion
  int body_node = -1; ///< rigid, moves and turns: the first of its two nodes in the mesh; -1: no such body
  std::array<double, 3> reference{}; ///< of such a body; its positions are seen from there
  bool triangles = false;            ///< natural coordinates: unit triangle, else [-1, 1] per direction

  std::size_t segments() const {
    return connectivity.size() / static_cast<std::size_t>(model->layout().nodes);
  }
  /// Is it moved along a line?
  bool translates() const { return rigid && body_node < 0; }
  /// Do natural coordinates lie on the segment proper, not on its border?
  bool covers(const double* xi) const;
};

/// The master as the scene describes it: one rigid segment carrying the enrichment, or faces of a body.
Master scene_master(const EntsLibrary& library, const Scene& scene, const Mesh& mesh);

/// The same geometry without enrichment: plain segments through points of rho_e, `divisions` per direction of
/// the rigid segment. Every segment has a border of an eighth of its length: beside a concave kink a
/// penetrating node projects on neither of two segments that end there, and would slip through.
Master explicit_master(const EntsLibrary& library, const Scene& scene, int divisions);

/// Another master for a scene than these two.
using MasterMaker = std::function<Master(const EntsLibrary& library, const Scene& scene)>;

} // namespace host
