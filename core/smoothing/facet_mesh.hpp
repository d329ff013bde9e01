// SPDX-License-Identifier: BSD-3-Clause
// A surface of triangles or quadrilaterals with one ring of facets laid around its borders, so that every
// node of the surface lies inside: what is said of inner nodes holds for all.
#pragma once

#include "core/smoothing/smoothing.hpp"

namespace ents {

// The facets around a node, counter-clockwise as seen against the normal; `edge[i]` and `edge[i + 1]` are the
// node's neighbours in facet i, `face[i]` is the node opposite to it (quadrilaterals).
struct Ring {
  std::vector<std::int64_t> edge, face;
  std::size_t size() const { return edge.size(); }
};

class FacetMesh {
public:
  explicit FacetMesh(int corners) : m_(corners) {} // of a facet: 3 or 4
  // Triangles have straight ends.
  Refusal build(Ends ends, std::int64_t facets, const std::int64_t* connectivity, std::int64_t nodes);

  std::int64_t facets() const { return facets_; } // of the surface
  std::int64_t nodes() const { return nodes_; }
  // Node at a corner; those from nodes() on are laid around: combinations of the others.
  std::int64_t node(std::int64_t facet, int corner) const { return corners_[index(m_ * facet + corner)]; }
  std::int64_t all_nodes() const { return nodes_ + static_cast<std::int64_t>(laid_around_.size()); }
  const std::vector<Terms>& laid_around() const { return laid_around_; }
  // Control point of a node laid around, for quasi-interpolation: the sum of `nodes` and of the control
  // points of `controls`; either may be laid around.
  struct LaidControl {
    Terms nodes, controls;
  };
  const LaidControl& laid_control(std::int64_t node) const { return laid_controls_[index(node - nodes_)]; }

  // The ring of the node at a corner of a facet, which is the ring's first. Refused: `touching` and `folded`.
  Refusal ring(std::int64_t facet, int corner, Ring& out) const;

private:
  static std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }
  std::int64_t next(std::int64_t half) const { return half / m_ * m_ + (half % m_ + 1) % m_; }
  std::int64_t previous(std::int64_t half) const { return half / m_ * m_ + (half % m_ + m_ - 1) % m_; }
  std::int64_t start(std::int64_t half) const { return corners_[index(half)]; }
  std::int64_t end(std::int64_t half) const { return corners_[index(next(half))]; }
  Refusal pair();
  Refusal find_border();
  void count_incident();
  void extend_quads(Ends ends);
  Terms beyond(Ends ends, const std::vector<std::int64_t>& line) const;
  std::vector<std::int64_t> line_inwards(std::int64_t half, std::size_t most) const;
  std::vector<std::int64_t> line_along_border(std::int64_t node, bool forward, std::size_t most) const;
  void lay_corner(Ends ends, std::int64_t h);
  void control_beyond(std::int64_t laid, std::int64_t node, const std::vector<std::int64_t>& inner,
                      std::int64_t before, std::int64_t after);
  void extrapolate_corner(Ends ends, std::int64_t h);
  void extend_triangles();
  std::int64_t lay(Terms terms);

  std::int64_t m_, facets_ = 0, nodes_ = 0;
  std::vector<std::int64_t> corners_; // [facets][m], those laid around at the end
  std::vector<std::int64_t> twin_;   // of half-edge m facet + corner: the same edge in the other facet, or -1
  std::vector<std::int64_t> border_; // half-edges of the border
  std::vector<std::int64_t> in_, out_; // of each node: the one of the border that ends, starts there, or -1
  std::vector<std::int64_t> incident_; // facets of each node; more than its ring has where surfaces touch
  std::vector<std::int64_t> beyond_in_,
      beyond_out_; // of each node of the border: what is laid beyond it, as seen
                   // from its edge in_, out_; at a corner these are two nodes
  std::vector<Terms> laid_around_;
  std::vector<LaidControl> laid_controls_; // quasi-interpolation only
};

} // namespace ents
