// SPDX-License-Identifier: BSD-3-Clause
// How a mesh moves as a whole within an increment, and how much its nodes move beside that (theory.md, section 9.5).
#pragma once

#include "core/search/detection.hpp"

namespace ents {

// x -> end + Q (x - begin): the mean motion, and, if that explains more, the rotation Q that fits the nodes best.
struct MeshMotion {
  // `begin` [nodes][d]: null, the mesh does not move
  MeshMotion(const MasterMesh& mesh, const double* begin, int dimension);

  void move(const double* x, double (&out)[3]) const;
  // Between `to` and where the motion takes `from`.
  double distance(const double* from, const double* to) const;

  double rest = 0.0; // the largest such distance of a node

private:
  int d;
  double centre[3] = {}, centre_end[3] = {};
  double turn[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

  void fit_rotation(const MasterMesh& mesh, const double* begin);
  double largest_rest(const MasterMesh& mesh, const double* begin) const;
};

} // namespace ents
