// SPDX-License-Identifier: BSD-3-Clause
// The tree of boxes around the segments of a surface: how it lies in the caller's memory, and the way through
// it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/model/plan.hpp"

namespace ents {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline constexpr std::int64_t leaf_segments = 4;
// tree: [tag, segments, stamp of what it was made for, order[segments], boxes[nodes][low[d], high[d]]], box 0
// is not used
inline constexpr double tree_tag = 1701737592.0; // says that it is a tree, and how it is laid out
inline constexpr std::int64_t tree_header = 3;

struct BoxTree {
  std::int64_t segments;
  int depth = 0;
  int d;
  BoxTree(const Plan& plan, std::int64_t count) : segments(count), d(plan.dimension) {
    while ((leaf_segments << depth) < segments) ++depth;
  }
  std::int64_t leaves() const { return std::int64_t{1} << depth; }
  std::int64_t size() const { return tree_header + segments + 2 * leaves() * 2 * d; }
  template <class Double> Double* order(Double* tree) const { return tree + tree_header; }
  template <class Double> Double* box(Double* tree, std::int64_t node) const {
    return tree + tree_header + segments + node * 2 * d;
  }
  // Node k of a level of 2^l covers order[first(k, l)] .. order[first(k + 1, l) - 1].
  std::int64_t first(std::int64_t k, int level) const { return (k * segments) >> level; }
};

// Calls visit(segment) for the segments whose boxes have a rank of at most `limit()`, the smaller ranks first
// as far as the tree knows. `rank(box)`: a lower bound over what is in the box; `limit` may fall on the way.
// A status that is not ok ends it; bad_state: the tree has been written over. Without a tree all segments are
// visited.
template <class Rank, class Limit, class Visit>
Status visit_segments(const BoxTree& t, const double* tree, Rank&& rank, Limit&& limit, Visit&& visit) {
  if (!tree) { // a few segments
    for (std::int64_t s = 0; s < t.segments; ++s)
      if (const Status status = visit(s); status != Status::ok) return status;
    return Status::ok;
  }
  struct Waiting {
    std::int64_t node;
    double rank;
  };
  Waiting waiting[64];
  int count = 0;
  bool whole = true;
  const auto wait = [&](std::int64_t node) {
    const double* box = t.box(tree, node);
    const double least = rank(box);
    if (least <= limit()) {
      waiting[count++] = {node, least};
      return;
    }
    for (int k = 0; k < t.d; ++k)
      whole = whole && (box[k] <= box[t.d + k] || box[k] > box[t.d + k]); // not so with NaN
  };
  wait(1);
  while (count > 0) {
    const Waiting now = waiting[--count];
    if (!(now.rank <= limit())) continue;
    if (now.node < t.leaves()) {
      const int before = count;
      wait(2 * now.node);
      wait(2 * now.node + 1);
      if (count == before + 2 && waiting[count - 2].rank < waiting[count - 1].rank)
        std::swap(waiting[count - 2], waiting[count - 1]);
      continue;
    }
    const std::int64_t leaf = now.node - t.leaves();
    for (std::int64_t i = t.first(leaf, t.depth); i < t.first(leaf + 1, t.depth); ++i) {
      const double segment = t.order(tree)[i];
      if (!(segment >= 0.0) || !(segment < static_cast<double>(t.segments))) return Status::bad_state;
      if (const Status status = visit(static_cast<std::int64_t>(segment)); status != Status::ok)
        return status;
    }
  }
  return whole ? Status::ok : Status::bad_state;
}

inline double distance(const double* a, const double* b, int d) {
  double sum = 0.0;
  for (int k = 0; k < d; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

// How far a box [low[d], high[d]] is from a point.
inline double distance_to_box(int d, const double* point, const double* box) {
  double sum = 0.0;
  for (int k = 0; k < d; ++k) {
    const double off = std::max({box[k] - point[k], point[k] - box[d + k], 0.0});
    sum += off * off;
  }
  return std::sqrt(sum);
}

struct MasterMesh; // detection.hpp
// low, high: [d] of a box around the enriched segment
Status box_of_segment(const Plan& plan, const MasterMesh& mesh, std::int64_t segment, double* low,
                      double* high);

} // namespace ents
