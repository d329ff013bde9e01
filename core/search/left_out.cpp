// SPDX-License-Identifier: BSD-3-Clause
// Which segments are no candidates for a slave (theory.md, sections 9.4 and 9.6).
#include <algorithm>
#include <cmath>

#include "core/search/detection.hpp"

namespace ents {

namespace {

// Does a segment look the way in which the slave's own surface looks, or beside it?
bool looks_away(const Plan& plan, const SegmentNodes& nodes, const double* slave_normal, double facing) {
  if (!slave_normal) return false;
  double size2 = 0.0, along = 0.0, normal[3];
  for (int k = 0; k < plan.dimension; ++k) size2 += slave_normal[k] * slave_normal[k];
  if (!(size2 > 0.0)) return false;
  const double middle[2] = {plan.simplex ? 1.0 / 3.0 : 0.0, plan.simplex ? 1.0 / 3.0 : 0.0};
  const SurfacePoint to = {nullptr, nullptr, nullptr, nullptr, normal, nullptr, nullptr};
  if (plan.surface(plan, nodes.positions, nodes.surface_coordinates, middle, to) != Status::ok) return false;
  for (int k = 0; k < plan.dimension; ++k) along += normal[k] * slave_normal[k];
  return along > facing * std::sqrt(size2);
}

} // namespace

bool is_own(const Plan& plan, const MasterMesh& mesh, std::int64_t segment, const LeftOut& left_out) {
  if (left_out.sides && left_out.sides[segment] == left_out.side) return true;
  const std::int64_t *first = mesh.connectivity + segment * plan.nodes, *last = first + plan.nodes;
  if (left_out.node >= 0 && std::find(first, last, left_out.node) != last) return true;
  if (left_out.segment < 0) return false;
  const std::int64_t* own = mesh.connectivity + left_out.segment * plan.nodes;
  return std::find_first_of(first, last, own, own + plan.nodes) != last;
}

bool is_left_out(const Plan& plan, const MasterMesh& mesh, std::int64_t segment, const SegmentNodes& nodes,
                 const LeftOut& left_out) {
  return is_own(plan, mesh, segment, left_out) || looks_away(plan, nodes, left_out.normal, left_out.facing);
}

} // namespace ents
