// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/thickness.hpp"

#include <algorithm>

#include "core/projection/search.hpp"
#include "core/search/segment_tree.hpp"

namespace ents {

namespace {

double along(const double* from, const double* to, const double* direction, int d) {
  double sum = 0.0;
  for (int k = 0; k < d; ++k) sum += (to[k] - from[k]) * direction[k];
  return sum;
}

// The nearest place of a segment that the slave is behind: its projection, or the nearest point of its border.
// Infinite: none within `limit`.
double nearest_behind(const Plan& plan, const SegmentNodes& nodes, const double* slave,
                      const double* slave_normal, double nearest, double limit) {
  double found = infinity;
  SegmentProjection at;
  if (plan.project(plan, slave, nodes.positions, nodes.surface_coordinates, nullptr, limit,
                   portable::search_budget, at) &&
      at.gap < -nearest)
    found = -at.gap;
  BorderPoint border;
  if (!plan.border_point(plan, slave, nodes.positions, nodes.surface_coordinates, std::min(found, limit),
                         border) ||
      !(border.distance > nearest))
    return found;
  double point[3], normal[3];
  const SurfacePoint to = {point, normal, nullptr, nullptr, nullptr, nullptr, nullptr};
  if (plan.surface(plan, nodes.positions, nodes.surface_coordinates, border.xi, to) != Status::ok)
    return found;
  const bool behind = along(point, slave, normal, plan.dimension) < 0.0,
             below = along(slave, point, slave_normal, plan.dimension) < 0.0;
  return behind && below ? border.distance : found;
}

} // namespace

Status thickness_below(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave,
                       const LeftOut& left_out, double nearest, double limit, double& out) {
  out = limit;
  return visit_segments(
      BoxTree(plan, mesh.segments), tree,
      [&](const double* box) { return distance_to_box(plan.dimension, slave, box); }, [&] { return out; },
      [&](std::int64_t segment) {
        SegmentNodes nodes;
        if (const Status gathered = gather(plan, mesh, segment, nodes); gathered != Status::ok)
          return gathered;
        if (!is_left_out(plan, mesh, segment, nodes, left_out))
          out = std::min(out, nearest_behind(plan, nodes, slave, left_out.normal, nearest, out));
        return Status::ok;
      });
}

} // namespace ents
