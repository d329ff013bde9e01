// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/lost_contact.hpp"

#include <cmath>

#include "core/search/behind_edge.hpp"
#include "core/search/segment_tree.hpp"

namespace ents {

namespace {

// Is the slave farther from the tangent plane of the segments without their height than any height?
bool is_above_texture(const Plan& plan, const MasterMesh& mesh, const double* slave,
                      const NearestBorder& border) {
  SegmentNodes nodes;
  double point[3], normal[3], distance = 0.0;
  if (gather(plan, mesh, border.segment, nodes) != Status::ok ||
      plan.surface(plan, nodes.positions, nodes.surface_coordinates, border.at.xi,
                   {nullptr, nullptr, nullptr, point, normal, nullptr, nullptr}) != Status::ok)
    return false;
  for (int k = 0; k < plan.dimension; ++k) distance += (slave[k] - point[k]) * normal[k];
  return distance > plan.height_bound;
}

} // namespace

Lost judge_lost_contact(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave,
                        std::int64_t before, const double* xi_before, const Detection& found) noexcept {
  if (found.behind_edge) return Lost::behind_edge;
  SegmentNodes nodes;
  if (gather(plan, mesh, before, nodes) != Status::ok) return Lost::no;
  const Plan& base = plan.base ? *plan.base : plan;
  double gap = 0.0;
  ElementInput element{};
  element.slave = slave, element.master = nodes.positions;
  element.surface_coordinates = nodes.surface_coordinates, element.start = xi_before;
  const double multipliers[3] = {}; // read, but without effect on a gap
  element.multiplier = multipliers;
  ElementOutput result{};
  result.wanted = want::gap, result.gap = &gap;
  // Most have simply risen; this costs one projection. Without a law the segment has no border: the
  // projection may lie beyond its edges.
  const Status projected = base.element(base, element, result);
  if (projected == Status::ok && gap > plan.height_bound) return Lost::no;
  if (projected == Status::degenerate_segment) return Lost::beside; // it has collapsed, and shows no side
  // What is closest to the slave, a projection at any distance or a border, says on which side it is. Where
  // the border is known first, the search for a projection looks no farther.
  constexpr double anywhere = 1e100;
  NearestBorder nearest{{}, -1};
  const bool by_border = plan.projection == ProjectionKind::normal &&
                         nearest_border(plan, mesh, tree, slave, found.left_out, anywhere, nearest);
  Detection far = found;
  far.segment = -1;
  far.depth = infinity;
  if (detect(plan, mesh, tree, slave, by_border ? nearest.at.distance : anywhere, far) != Status::ok)
    return Lost::beside;
  if (far.segment >= 0) return far.at.gap > 0.0 ? Lost::no : Lost::too_deep;
  if (!by_border) return Lost::beside;
  double crack = 0.0;
  switch (side_of_border(plan, mesh, tree, slave, found.left_out, nearest, crack)) {
  case BorderSide::ahead:
    return Lost::no;
  case BorderSide::behind:
    return Lost::too_deep;
  case BorderSide::beside_ahead:
    if (plan.height_bound == 0.0) return Lost::no;
    break; // above the tangent plane of the texture, which might go on above it
  case BorderSide::beside_behind:
    break;
  }
  return is_above_texture(plan, mesh, slave, nearest) ? Lost::no : Lost::beside;
}

} // namespace ents
