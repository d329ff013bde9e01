// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/detection.hpp"
#include "core/projection/search.hpp"
#include "core/projection/target.hpp"
#include "core/search/behind_edge.hpp"
#include "core/search/segment_tree.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ents {

namespace {

// A lower bound of the rank of any projection in a box; infinite: there is none.
double least_rank(const Plan& plan, const double* slave, const double (&ray)[3], const double* box) {
  const int d = plan.dimension;
  const double *low = box, *high = box + d;
  if (plan.projection == ProjectionKind::normal) return distance_to_box(d, slave, box);
  // rho = x_s - g e: the range of g in which the line is in the box
  double least = -infinity, most = infinity;
  for (int k = 0; k < d; ++k) {
    const double to_low = slave[k] - low[k], to_high = slave[k] - high[k];
    if (ray[k] == 0.0) {
      if (to_low < 0.0 || to_high > 0.0) return infinity;
      continue;
    }
    const double a = to_low / ray[k], b = to_high / ray[k];
    least = std::max(least, std::min(a, b));
    most = std::min(most, std::max(a, b));
  }
  return least <= most + 1e-12 * (std::fabs(least) + std::fabs(most)) ? least : infinity;
}

// The better of two projections on different segments; equal ones at the same place are one.
void consider(int d, std::int64_t segment, const SegmentProjection& candidate, Detection& best) {
  const double tie = std::max(candidate.tie, best.segment < 0 ? 0.0 : best.at.tie);
  const bool first = best.segment < 0;
  if (!first && candidate.rank > best.at.rank + tie) return;
  if (first || candidate.rank < best.at.rank - tie) {
    best.segment = segment;
    best.other = -1;
    best.at = candidate;
    return;
  }
  const bool same_place =
      distance(candidate.point, best.at.point, d) <= 1e3 * tie + candidate.beyond + best.at.beyond;
  // the one that lies on its segment, then the one with the smaller number: the same whatever the order of
  // visits
  const bool better =
      candidate.beyond < best.at.beyond || (candidate.beyond == best.at.beyond && segment < best.segment);
  // two faces back to back, as of a sheet without thickness: which one counts is for the caller to decide
  const bool opposed =
      (candidate.gap > tie && best.at.gap < -tie) || (candidate.gap < -tie && best.at.gap > tie);
  if (!same_place || opposed) best.other = better ? best.segment : segment;
  if (better) {
    best.segment = segment;
    best.at = candidate;
  }
}

// Segments that were looked at, and how far their boxes are.
struct Candidates {
  static constexpr int most = 32;
  std::int64_t segment[most];
  double at_least[most];
  int count = 0; // may be more than there is room for
  void add(std::int64_t s, double least) {
    if (count < most) segment[count] = s, at_least[count] = least;
    ++count;
  }
};

// Where a point of the segments' borders is closer to the slave than the projection that was found, that
// point decides on which side of the surface the slave is: a projection on a farther face seen from behind is
// no penetration, nor is one ahead of a slave that is behind an edge a gap.
void judge_by_border(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave,
                     double reach, const Candidates& candidates, Detection& out) {
  constexpr double rounding = 1e-12;
  const double found = out.segment < 0 ? reach : std::fabs(out.at.gap) * (1.0 - rounding) - 10.0 * out.at.tie;
  NearestBorder nearest{{}, -1};
  nearest.at.distance = found;
  const bool flat = !plan.height && plan.nodes == plan.dimension; // its projection is its closest point
  if (candidates.count <= Candidates::most) {
    for (int i = 0; i < candidates.count; ++i) {
      if (!(candidates.at_least[i] < nearest.at.distance) || (flat && candidates.segment[i] == out.segment))
        continue;
      SegmentNodes nodes;
      if (gather(plan, mesh, candidates.segment[i], nodes) == Status::ok &&
          plan.border_point(plan, slave, nodes.positions, nodes.surface_coordinates, nearest.at.distance,
                            nearest.at))
        nearest.segment = candidates.segment[i];
    }
  } else {
    nearest_border(plan, mesh, tree, slave, out.left_out, found, nearest);
  }
  if (nearest.segment < 0) return;
  double crack;
  const BorderSide side = side_of_border(plan, mesh, tree, slave, out.left_out, nearest, crack);
  // the far side of the slave's own body
  if (side == BorderSide::behind && nearest.at.distance > out.depth) return;
  if (out.segment < 0) {
    out.behind_edge = side == BorderSide::behind;
    return;
  }
  if (!(nearest.at.distance < found - crack)) return;
  const bool beside = side == BorderSide::beside_ahead || side == BorderSide::beside_behind;
  if (beside && (out.at.gap >= 0.0 || side == BorderSide::beside_behind))
    return; // a free border tells less than a projection
  out.segment = out.other = -1;
  out.behind_edge = side == BorderSide::behind;
}

// Without a tree: a few segments, the closest first.
template <class Rank, class Limit, class Visit>
Status visit_nearest_first(const Plan& plan, const MasterMesh& mesh, Rank&& rank, Limit&& limit,
                           Visit&& visit) {
  constexpr std::int64_t most = 64;
  struct Waiting {
    double rank;
    std::int64_t segment;
  };
  Waiting waiting[most];
  const std::int64_t count = std::min(mesh.segments, most);
  for (std::int64_t s = 0; s < count; ++s) {
    double box[6];
    if (const Status status = box_of_segment(plan, mesh, s, box, box + plan.dimension); status != Status::ok)
      return status;
    waiting[s] = {rank(box), s};
  }
  std::sort(waiting, waiting + count, [](const Waiting& a, const Waiting& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.segment < b.segment;
  });
  for (std::int64_t i = 0; i < count; ++i) {
    if (!(waiting[i].rank <= limit())) break;
    if (const Status status = visit(waiting[i].segment); status != Status::ok) return status;
  }
  return Status::ok;
}

} // namespace

Status gather(const Plan& plan, const MasterMesh& mesh, std::int64_t segment, SegmentNodes& out) {
  const std::int64_t* nodes = mesh.connectivity + segment * plan.nodes;
  double size = 0.0;
  for (int i = 0; i < plan.nodes; ++i) {
    if (nodes[i] < 0 || nodes[i] >= mesh.nodes) return Status::bad_value;
    for (int k = 0; k < plan.dimension; ++k) {
      const double x = mesh.positions[nodes[i] * plan.dimension + k];
      out.positions[i * plan.dimension + k] = x;
      size += std::fabs(x);
    }
  }
  const std::int64_t coordinates = std::int64_t{plan.nodes} * plan.parameters;
  out.surface_coordinates =
      mesh.surface_coordinates ? mesh.surface_coordinates + segment * coordinates : nullptr;
  if (out.surface_coordinates)
    for (std::int64_t i = 0; i < coordinates; ++i) size += std::fabs(out.surface_coordinates[i]);
  return size < infinity ? Status::ok : Status::non_finite;
}

Status detect_followed(const Plan& plan, const MasterMesh& mesh, const double* slave, double reach,
                       Detection& out) {
  out.searched = out.behind_edge = false;
  const std::int64_t segment = out.segment;
  out.segment = -1;
  if (segment < 0 || is_own(plan, mesh, segment, out.left_out)) return Status::ok;
  SegmentNodes nodes;
  if (const Status status = gather(plan, mesh, segment, nodes); status != Status::ok) {
    out.segment = segment; // to be named
    return status;
  }
  const double start[2] = {out.at.xi[0], out.at.xi[1]};
  if (plan.project(plan, slave, nodes.positions, nodes.surface_coordinates, start, infinity,
                   portable::search_budget, out.at) &&
      std::fabs(out.at.gap) <= reach && out.at.gap >= -out.depth)
    out.segment = segment, out.other = -1;
  return Status::ok;
}

namespace {

// The distance of the slave from the surface at xi, or at the point of the segment next to it: no closest
// point is farther. Infinite: not known.
double distance_at(const Plan& plan, const MasterMesh& mesh, const double* slave, std::int64_t segment,
                   const double (&at)[2]) {
  SegmentNodes nodes;
  if (gather(plan, mesh, segment, nodes) != Status::ok) return infinity;
  double xi[2] = {at[0], at[1]}, point[3], squared = 0.0;
  const double low = plan.simplex ? 0.0 : -1.0;
  for (double& x : xi) x = std::clamp(x, low, 1.0);
  if (const double sum = xi[0] + xi[1]; plan.simplex && sum > 1.0)
    for (double& x : xi) x /= sum;
  const SurfacePoint to = {point, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr};
  if (plan.surface(plan, nodes.positions, nodes.surface_coordinates, xi, to) != Status::ok) return infinity;
  for (int k = 0; k < plan.dimension; ++k) squared += (slave[k] - point[k]) * (slave[k] - point[k]);
  return std::sqrt(squared);
}

Status search_all(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave,
                  double reach, Detection& out);

} // namespace

Status detect(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave, double reach,
              Detection& out) {
  const std::int64_t before = out.segment;
  const double xi[2] = {out.at.xi[0], out.at.xi[1]};
  if (const Status status = detect_followed(plan, mesh, slave, reach, out);
      status != Status::ok || out.segment >= 0)
    return status;
  // The farther a search looks, the more it has to exclude: first no farther than the surface was.
  if (before >= 0 && plan.projection == ProjectionKind::normal && !is_own(plan, mesh, before, out.left_out)) {
    const double near = distance_at(plan, mesh, slave, before, xi) * (1.0 + 1e-9);
    if (near > 0.0 && near < 0.5 * reach) {
      const Status status = search_all(plan, mesh, tree, slave, near, out);
      if (status != Status::ok || (out.segment >= 0 && !out.at.ambiguous)) return status;
    }
  }
  return search_all(plan, mesh, tree, slave, reach, out);
}

namespace {

Status search_all(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave,
                  double reach, Detection& out) {
  SegmentNodes nodes;
  out.searched = true, out.behind_edge = false;
  out.segment = out.other = -1;
  // Segments whose search could not be completed; they are searched again when the others are known.
  constexpr int most_doubts = 16, thorough = 10 * portable::search_budget;
  std::int64_t in_doubt[most_doubts];
  int doubts = 0, budget = portable::search_budget;
  portable::Target target;
  const bool has_ray = plan.dimension == 2 ? portable::set_target<2>(plan, slave, target)
                                           : portable::set_target<3>(plan, slave, target);
  if (!has_ray) { // the light stands on the slave
    out.at.ambiguous = false;
    return Status::ok;
  }
  const double(&ray)[3] = target.ray;

  const auto limit = [&] { return out.segment < 0 ? reach : std::min(reach, out.at.rank + out.at.tie); };
  const bool normal = plan.projection == ProjectionKind::normal;
  Candidates candidates;
  const auto visit = [&](std::int64_t segment) {
    if (const Status gathered = gather(plan, mesh, segment, nodes); gathered != Status::ok) {
      out.segment = segment;
      return gathered;
    }
    double box[6];
    plan.box(plan, nodes.positions, nodes.surface_coordinates, box, box + plan.dimension);
    const double least = least_rank(plan, slave, ray, box);
    if (!(least <= limit()) || is_left_out(plan, mesh, segment, nodes, out.left_out)) return Status::ok;
    candidates.add(segment, least);
    // a rank counts what lies beyond the edge, too; the reach does not
    double farthest = reach;
    for (int k = 0; k < plan.dimension; ++k)
      farthest += 2.0 * plan.border * (box[plan.dimension + k] - box[k]);
    if (out.segment >= 0) farthest = std::min(farthest, out.at.rank + out.at.tie);
    SegmentProjection candidate;
    const bool found = plan.project(plan, slave, nodes.positions, nodes.surface_coordinates, nullptr,
                                    farthest, budget, candidate);
    if (candidate.ambiguous) {
      if (doubts < most_doubts) in_doubt[doubts] = segment;
      ++doubts;
    }
    if (found && (!normal || std::fabs(candidate.gap) <= reach) && candidate.gap >= -out.depth) {
      if (segment == out.segment) // searched again
        out.at = candidate;
      else
        consider(plan.dimension, segment, candidate, out);
    }
    return Status::ok;
  };
  const auto rank = [&](const double* box) { return least_rank(plan, slave, ray, box); };
  const BoxTree shape(plan, mesh.segments);
  const Status status = tree ? visit_segments(shape, tree, rank, limit, visit)
                             : visit_nearest_first(plan, mesh, rank, limit, visit);
  if (status != Status::ok) return status;
  if (doubts > 0 && doubts <= most_doubts) {
    const int count = doubts;
    const double far = reach;
    // What is farther than the border does not matter to a slave between two segments, and is looked for
    // last.
    NearestBorder border;
    if (out.segment < 0 && normal && nearest_border(plan, mesh, tree, slave, out.left_out, reach, border))
      reach = border.at.distance;
    doubts = 0;
    budget = thorough;
    for (int i = 0; i < count; ++i)
      if (const Status again = visit(in_doubt[i]); again != Status::ok) return again;
    if (out.segment < 0 && reach < far) doubts = count;
    reach = far;
  }
  const bool doubtful = doubts > 0;
  if (out.segment >= 0 && std::fabs(out.at.gap) > reach + out.at.tie)
    out.segment = -1; // lit far behind the slave
  if (normal) judge_by_border(plan, mesh, tree, slave, reach, candidates, out);
  if (out.segment >= 0)
    out.at.ambiguous = out.at.ambiguous || out.other >= 0 || doubtful;
  else
    out.at.ambiguous = doubtful;
  return Status::ok;
}

} // namespace

} // namespace ents
