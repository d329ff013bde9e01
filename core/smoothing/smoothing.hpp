// SPDX-License-Identifier: BSD-3-Clause
// Smoothed surfaces over ordinary facets: one segment of a smoothed basis per facet, whose control points are
// linear combinations of the facets' nodes. Found from the connectivity alone, once.
#pragma once

#include <cstdint>
#include <vector>

#include "core/model/model.hpp"

namespace ents {

// What stands beyond a free end or border: x_0 is on it, x_1 is its neighbour inside. The
// quasi-interpolations (quasi_interpolation.hpp) also say what the control points of the nodes are.
enum class Ends : std::int32_t {
  straight,       // 2 x_0 - x_1
  repeated,       // x_0
  quasi_cubic,    // 4 x_0 - 6 x_1 + 4 x_2 - x_3
  quasi_parabolic // 3 x_0 - 3 x_1 + x_2
};

struct Term {
  std::int64_t node;
  double weight;
};
using Terms = std::vector<Term>;

// Nodes ascending, each once, none with weight 0.
void collect(Terms& terms);

struct Smoothed {
  std::vector<std::int64_t> segment_points; // [facets][m]
  std::vector<std::int64_t> begin{0};       // [points + 1]
  std::vector<std::int64_t> nodes;
  std::vector<double> weights;
  // With planes of symmetry only, see ents_combination:
  std::vector<std::int32_t> reflected;
  std::vector<double> shifts; // [points][d]

  // Points 0 .. count - 1 are the nodes themselves.
  void add_nodes(std::int64_t count);
  std::int64_t add_point(const Terms& terms);
  std::int64_t points() const { return static_cast<std::int64_t>(begin.size()) - 1; }
};

// Why a surface cannot be smoothed, and where.
struct Refusal {
  enum Reason {
    none,
    repeated_node, // `facet` has `node` twice
    branch,        // more than two facets meet in `node` (lines), or along the edge node, other_node
    opposed,  // the normals of `facet` and other_facet point to different sides; they meet in `node` (and
              // other_node)
    folded,   // inner `node` of two facets, which share both edges there: it has no tangent plane
    touching, // parts of the surface touch in `node` alone
    irregular // four facets must meet in an inner node, two in one of a border, one in a corner; not so in
              // `node`
  };
  Reason reason = none;
  std::int64_t facet = -1, other_facet = -1, node = -1, other_node = -1;
};

// line2 -> catmull_rom4, bspline4: the node before, the two of the facet, the node after.
Refusal smooth_lines(Ends ends, std::int64_t facets, const std::int64_t* connectivity, std::int64_t nodes,
                     Smoothed& out);

// quad4 -> bspline16, and catmull_rom16 where `regular`: a mesh that is not is refused.
Refusal smooth_quads(Ends ends, bool regular, std::int64_t facets, const std::int64_t* connectivity,
                     std::int64_t nodes, Smoothed& out);

// tri3 -> bezier15, with straight ends.
Refusal smooth_triangles(std::int64_t facets, const std::int64_t* connectivity, std::int64_t nodes,
                         Smoothed& out);

} // namespace ents
