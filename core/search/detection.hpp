// SPDX-License-Identifier: BSD-3-Clause
// Which segment of a master surface is a slave projected on? A tree of boxes around the enriched segments, in
// the caller's memory: built once, refitted while the bodies move, read by any number of threads.
//
// Balanced, halved at the median centre across its longest side; node i has the children 2 i and 2 i + 1, so
// that neither links nor an order of visits are stored and a refit is one loop from the last node to the
// first. (Eigen's KdBVH can not be refitted.)
#pragma once

#include <limits>

#include "core/model/plan.hpp"

namespace ents {

struct MasterMesh {
  std::int64_t segments;
  const std::int64_t* connectivity; // [segments][m]
  std::int64_t nodes;
  const double* positions;             // [nodes][d]
  const double* surface_coordinates;   // [segments][m][T] or null
  const double* temperature = nullptr; // [nodes] or null
};

// One segment's nodes side by side, as the kernels read them.
struct SegmentNodes {
  double positions[16 * 3];
  const double* surface_coordinates; // or null
};

// ok; bad_value: a node that does not exist; non_finite.
Status gather(const Plan& plan, const MasterMesh& mesh, std::int64_t segment, SegmentNodes& out);

// Segments that are no candidates for a slave: for the search of a projection, for borders, and for the side
// of a border, whose neighbours end there (theory.md, sections 9.4 and 9.6).
struct LeftOut {
  std::int64_t node = -1; // the node of the mesh that the slave is: segments with this node. -1: none
  std::int64_t segment =
      -1; // the segment on which the slave lies, and those that share a node with it. -1: none
  const std::int32_t* sides = nullptr; // [segments] or null: segments of the slave's own side
  std::int32_t side = 0;
  // [d] out of the slave's body, or null or zeros: segments that look the same way or beside it, whose normal has a
  // cosine with it above `facing`.
  const double* normal = nullptr;
  double facing = -0.05; // 93 degrees
};

// Self-contact. A body's own corner may turn within an increment: a segment that becomes a candidate by that
// (120 degrees) has been taken for the body's other side at the begin of the increment (104 degrees).
inline constexpr double faces_itself = -0.5, faces_other_side = -0.25;

// The same of many slaves: null where nothing is left out.
struct LeftOutOfSlaves {
  const std::int64_t *node = nullptr, *segment = nullptr;      // [slaves]
  const std::int32_t *side = nullptr, *segment_side = nullptr; // [slaves], [segments]
  const double* normal = nullptr;                              // [slaves][d]
  double facing = LeftOut().facing;

  LeftOut of(std::int64_t slave, int d) const {
    LeftOut out;
    if (node) out.node = node[slave];
    if (segment) out.segment = segment[slave];
    if (side) out.sides = segment_side, out.side = side[slave];
    if (normal) out.normal = normal + slave * d;
    out.facing = facing;
    return out;
  }
};

// Does the number of a segment say that it is left out, whatever its position?
bool is_own(const Plan& plan, const MasterMesh& mesh, std::int64_t segment, const LeftOut& left_out);
bool is_left_out(const Plan& plan, const MasterMesh& mesh, std::int64_t segment, const SegmentNodes& nodes,
                 const LeftOut& left_out);

// Doubles that the tree of a surface takes; 0 if there are too many segments.
std::int64_t tree_size(const Plan& plan, std::int64_t segments);
bool is_tree(const Plan& plan, const MasterMesh& mesh, const double* tree);
// Do its boxes hold the segments of this model, or those of another height, basis or border?
bool is_tree_of_model(const Plan& plan, const double* tree);

// O(n log n); allocates d doubles per segment while it works. Errors as `gather`, at `segment`.
Status build_tree(const Plan& plan, const MasterMesh& mesh, double* tree, std::int64_t& segment);
// O(n): the boxes for new positions. The shape of the tree stays: it finds the same after any motion, and is
// fast while neighbours stay neighbours.
Status refit_tree(const Plan& plan, const MasterMesh& mesh, double* tree, std::int64_t& segment);

struct Detection {
  LeftOut left_out;                                       // in
  double depth = std::numeric_limits<double>::infinity(); // in: what the slave is behind by more is none
  std::int64_t segment;                                   // -1: nothing within reach
  std::int64_t other; // another segment with an equally good projection elsewhere; -1: none
  SegmentProjection at;
  bool searched;
  bool behind_edge; // no segment: the closest point is on an edge that segments share, and the slave is
                    // behind it
};

// The projection of a slave among all segments.
//   normal: the closest one within reach; shadow: the lit point, if it is within reach along the ray.
// A previous projection (out.segment >= 0, out.at.xi) that is still on its segment and within reach is kept:
// the slave stays on the branch it was on. Without a tree (null) all segments are looked at.
Status detect(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave, double reach,
              Detection& out);
// Only the previous projection; out.segment is -1 where it is not kept.
Status detect_followed(const Plan& plan, const MasterMesh& mesh, const double* slave, double reach,
                       Detection& out);

} // namespace ents
