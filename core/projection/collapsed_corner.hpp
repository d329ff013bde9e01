// SPDX-License-Identifier: BSD-3-Clause
// A quad4 with two neighbouring nodes in one place is a triangle, and its natural coordinates lose their
// meaning towards that corner: there is no tangent along the edge without length, and Newton's method leaves
// the segment along it.
#pragma once

#include <type_traits>

#include "core/surface/surface.hpp"

namespace ents::ENTS_ISA {

// How close natural coordinates come to a corner where two nodes of a quad4 are one: rounding of the normal
// there, over that distance, times the height stays small beside the tangents.
template <bool H> inline constexpr double next_to_collapsed_edge = H ? 1e-6 : 1e-9;

// The edge from node e to the next whose ends are one; -1: none, or it has two surface coordinates.
template <class B> ENTS_INLINE int collapsed_edge(const Geometry<B>& g) {
  if constexpr (std::is_same_v<B, Quad4>)
    for (int e = 0; e < 4; ++e) {
      const int next = (e + 1) % 4;
      const Vec<double, 3> gone = g.y[next] - g.y[e], across = g.y[(e + 2) % 4] - g.y[e];
      if (dot(gone, gone) <= 1e-24 * dot(across, across)) return e;
    }
  return -1;
}

// The coordinate across a collapsed edge, and its value there.
struct AcrossEdge {
  int direction;
  double value;
};
ENTS_INLINE AcrossEdge across_edge(int e) { return {e % 2 == 0, e == 1 || e == 2 ? 1.0 : -1.0}; }

// Is xi as close to a corner as coordinates come?
template <class B, bool H>
ENTS_INLINE bool is_in_collapsed_corner(const Geometry<B>& g, const double (&xi)[B::dim - 1]) {
  bool on_edge = false; // of any quad4: most projections are not
  for (const double x : xi)
    on_edge = on_edge || absolute(absolute(x) - 1.0) <= 2.0 * next_to_collapsed_edge<H>;
  const int e = on_edge ? collapsed_edge(g) : -1;
  if (e < 0) return false;
  const AcrossEdge across = across_edge(e);
  return absolute(xi[across.direction] - across.value) <= (1.0 + 1e-6) * next_to_collapsed_edge<H>;
}

} // namespace ents::ENTS_ISA
