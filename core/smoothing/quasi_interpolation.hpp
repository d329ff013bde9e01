// SPDX-License-Identifier: BSD-3-Clause
// Control points of cubic B-splines that follow the nodes: the quasi-interpolation of C. de Boor and G. Fix,
// Spline approximation by quasiinterpolants, J. Approx. Theory 8, 1973. Along a line c = x - delta^2 x / 6,
// that is (-1, 8, -1) / 6 of three nodes: the spline passes the nodes at a distance of delta^4 x / 36. A node
// x_(-1) beyond a free end is extrapolated; the control point there, c_(-1) = 6 x_0 - 4 c_0 - c_1, lets the
// spline end in x_0.
#pragma once

#include "core/smoothing/facet_mesh.hpp"

namespace ents {

inline bool is_quasi(Ends ends) { return ends == Ends::quasi_cubic || ends == Ends::quasi_parabolic; }

// Nodes that are used to extrapolate beyond x_0: a cubic needs four, a parabola three.
inline std::size_t extrapolation_nodes(Ends ends) { return ends == Ends::quasi_cubic ? 4 : 3; }
// x_(-1) from x_0, x_1 ..., by the polynomial through them: 2 to 4 nodes.
Terms extrapolated(const std::vector<std::int64_t>& nodes);
// factor c of a node between its neighbours along a line.
Terms along_line(std::int64_t before, std::int64_t node, std::int64_t after, double factor = 1.0);

// Control points of the nodes of a surface of quadrilaterals, and of those laid around it. With four facets
// in a node the rule above in both directions; else 2 x - L x, L x the point of the limit surface whose
// control points are the nodes (between four facets this is the same but for fourth differences).
class QuadControls {
public:
  // Refused: `touching` and `folded`. The mesh is looked at until all is built.
  Refusal build(const FacetMesh& mesh);
  // As a combination of the nodes of the surface.
  const Terms& of(std::int64_t node) const { return of_[static_cast<std::size_t>(node)]; }

private:
  Terms inside(std::int64_t node, const Ring& ring) const;
  void find_laid(std::int64_t node);
  void append_node(Terms& terms, double weight, std::int64_t node) const;

  const FacetMesh* mesh_ = nullptr;
  std::vector<Terms> of_;
};

} // namespace ents
