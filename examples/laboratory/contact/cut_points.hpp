// SPDX-License-Identifier: BSD-3-Clause
// Slave points of an integral over pieces: the slave faces are cut at the borders of the master's segments,
// and each piece has a quadrature rule. On a piece the shape functions of both surfaces are smooth, so that
// the forces of a pressure are those of the exact integral, to the order of the rule (M. A. Puso and
// T. A. Laursen, Comput. Methods Appl. Mech. Eng. 193, 2004).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "slave_points.hpp"

namespace host {

/// The corners of the master's segments; in the plane their ends.
struct SegmentCorners {
  std::size_t corners = 2;     ///< of a segment
  std::vector<double> points;  ///< [segments][corners][d] rho_e
  std::vector<double> normals; ///< [segments][corners][d] n_e
};

/// Points with weights over the nodes of their face. Their areas are those of the reference configuration.
/// In the plane a face is cut where the mean normal of the segments that meet in a node of the master hits
/// it. In space segments are projected along the face's normal on its mean plane. What no segment covers is a
/// piece, too: the areas of a face's points always add up to its own.
/// @param positions      [mesh nodes][d] of the slave, where the cut is made, in the frame of `master`
/// @param per_direction  points of a piece: lines n, quadrilaterals n^2, triangles see `append_quadrature`
/// @throws JobError if a face is turned inside out
SlavePoints cut_points(const Mesh& mesh, const std::vector<Face>& faces, const std::vector<double>& positions,
                       const SegmentCorners& master, int per_direction, const SlaveGeometry& geometry);

} // namespace host
