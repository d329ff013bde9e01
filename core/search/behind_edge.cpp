// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/behind_edge.hpp"

#include <algorithm>
#include <cmath>

#include "core/search/segment_tree.hpp"

namespace ents {

namespace {

constexpr int most_segments = 64; // that meet in a point

// A point of a segment's border on the enriched surface and below it.
struct Place {
  double point[3], normal[3], base_point[3];
  double xi[2];
  bool corner;
  std::int64_t segment;
};

double dot(const double* a, const double* b, int d) {
  double sum = 0.0;
  for (int k = 0; k < d; ++k) sum += a[k] * b[k];
  return sum;
}

bool evaluate(const Plan& plan, const SegmentNodes& nodes, const double* xi, Place& out) {
  out.xi[0] = xi[0], out.xi[1] = xi[1];
  const SurfacePoint to = {out.point, out.normal, nullptr, out.base_point, nullptr, nullptr, nullptr};
  return plan.surface(plan, nodes.positions, nodes.surface_coordinates, xi, to) == Status::ok;
}

// How far a segment's nodes are from its first.
double size_of(const Plan& plan, const SegmentNodes& nodes) {
  double most = 0.0;
  for (int i = 1; i < plan.nodes; ++i)
    most = std::max(most, distance(nodes.positions + i * plan.dimension, nodes.positions, plan.dimension));
  return most;
}

// Is a quad4's side from the corner `at` in direction e a point?
bool has_no_length(const Plan& plan, const SegmentNodes& nodes, const double (&at)[2], int e) {
  if (plan.nodes != 4) return false;
  const int corner = at[1] < 0.0 ? (at[0] < 0.0 ? 0 : 1) : (at[0] < 0.0 ? 3 : 2),
            other = e == 0 ? corner ^ 1 : 3 - corner;
  return distance(nodes.positions + 3 * corner, nodes.positions + 3 * other, 3) <=
         1e-12 * size_of(plan, nodes);
}

// The corner of a segment in space: unit tangents of the two edges that meet there, without the height, and
// the angle between them. Where a side has no length, the next edge takes its place.
struct Corner {
  double tangent[2][3], angle;
};

bool corner_of(const Plan& plan, const SegmentNodes& nodes, const Place& near, Corner& out) {
  constexpr double step = 1e-4;
  double at[2] = {near.xi[0] > 0.0 ? 1.0 : -1.0, near.xi[1] > 0.0 ? 1.0 : -1.0};
  if (plan.simplex) at[0] = std::round(near.xi[0]), at[1] = std::round(near.xi[1]);
  Place here;
  if (!evaluate(plan, nodes, at, here)) return false;
  for (int e = 0; e < 2; ++e) {
    double xi[2] = {at[0], at[1]};
    if (!plan.simplex) {
      const int direction = has_no_length(plan, nodes, at, e) ? 1 - e : e;
      if (direction != e) xi[e] = -xi[e];
      xi[direction] -= step * xi[direction];
    } else if (xi[0] + xi[1] == 0.0) {
      xi[e] += step;
    } else { // (1, 0) or (0, 1)
      const int one = xi[0] > xi[1] ? 0 : 1;
      xi[one] -= step;
      if (e == 1) xi[1 - one] += step;
    }
    Place beside;
    if (!evaluate(plan, nodes, xi, beside)) return false;
    double* t = out.tangent[e];
    for (int k = 0; k < 3; ++k) t[k] = beside.base_point[k] - here.base_point[k];
    const double length = std::sqrt(dot(t, t, 3));
    if (!(length > 0.0)) return false;
    for (int k = 0; k < 3; ++k) t[k] /= length;
  }
  out.angle = std::acos(std::clamp(dot(out.tangent[0], out.tangent[1], 3), -1.0, 1.0));
  return true;
}

// The segments whose borders go through a place, heights left aside, which is on the border of one of them;
// -1: more than there is room for.
int meeting_in(const Plan& plan, const MasterMesh& mesh, const double* tree, const Place& place,
               const LeftOut& left_out, Place (&found)[most_segments]) {
  const int d = plan.dimension;
  SegmentNodes nodes;
  if (gather(plan, mesh, place.segment, nodes) != Status::ok) return 0;
  const double near = 1e-6 * size_of(plan, nodes), within = near + plan.height_bound;
  int count = 0;
  bool all = true;
  const Status status = visit_segments(
      BoxTree(plan, mesh.segments), tree,
      [&](const double* box) { return distance_to_box(d, place.base_point, box); }, [&] { return within; },
      [&](std::int64_t segment) {
        if (const Status gathered = gather(plan, mesh, segment, nodes); gathered != Status::ok)
          return gathered;
        if (is_left_out(plan, mesh, segment, nodes, left_out)) return Status::ok;
        BorderPoint border;
        Place here;
        if (!plan.base->border_point(*plan.base, place.base_point, nodes.positions, nodes.surface_coordinates,
                                     near, border) ||
            !evaluate(plan, nodes, border.xi, here))
          return Status::ok;
        here.segment = segment, here.corner = border.corner;
        if (count < most_segments)
          found[count++] = here;
        else
          all = false;
        return Status::ok;
      });
  if (status != Status::ok) return 0;
  return all ? count : -1;
}

// The sum of the normals of the segments that meet in a point, weighted by their angles there; false at a
// free border. On which side of a surface a point lies whose closest point is an edge or a vertex, this
// normal tells and no other (Baerentzen and Aanaes, IEEE TVCG 11, 2005).
bool pseudonormal(const Plan& plan, const MasterMesh& mesh, const Place* found, int count, double (&sum)[3]) {
  bool vertex = false;
  for (int i = 0; i < count; ++i) vertex = vertex || found[i].corner;
  if (count < 2) return false;
  Corner corners[most_segments];
  for (int i = 0; i < count; ++i) {
    double weight = 1.0;
    if (vertex) {
      SegmentNodes nodes;
      if (gather(plan, mesh, found[i].segment, nodes) != Status::ok ||
          !corner_of(plan, nodes, found[i], corners[i]))
        return false;
      weight = corners[i].angle;
    }
    for (int k = 0; k < plan.dimension; ++k) sum[k] += weight * found[i].normal[k];
  }
  // A vertex inside the surface: every edge that ends there is one of two segments.
  constexpr double same = 1.0 - 1e-6;
  for (int i = 0; vertex && i < 2 * count; ++i) {
    bool shared = false;
    for (int j = 0; j < 2 * count; ++j)
      shared = shared || (i / 2 != j / 2 &&
                          dot(corners[i / 2].tangent[i % 2], corners[j / 2].tangent[j % 2], 3) > same);
    if (!shared) return false;
  }
  return true;
}

} // namespace

bool nearest_border(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave,
                    const LeftOut& left_out, double limit, NearestBorder& out) {
  out.at.distance = limit, out.segment = -1;
  const Status status = visit_segments(
      BoxTree(plan, mesh.segments), tree,
      [&](const double* box) { return distance_to_box(plan.dimension, slave, box); },
      [&] { return out.at.distance; },
      [&](std::int64_t segment) {
        SegmentNodes nodes;
        if (const Status gathered = gather(plan, mesh, segment, nodes); gathered != Status::ok)
          return gathered;
        if (is_left_out(plan, mesh, segment, nodes, left_out)) return Status::ok;
        if (plan.border_point(plan, slave, nodes.positions, nodes.surface_coordinates, out.at.distance,
                              out.at))
          out.segment = segment;
        return Status::ok;
      });
  return status == Status::ok && out.segment >= 0;
}

BorderSide side_of_border(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave,
                          const LeftOut& left_out, const NearestBorder& nearest, double& crack) {
  const int d = plan.dimension;
  SegmentNodes nodes;
  Place place, found[most_segments];
  crack = 0.0;
  if (gather(plan, mesh, nearest.segment, nodes) != Status::ok ||
      !evaluate(plan, nodes, nearest.at.xi, place))
    return BorderSide::beside_ahead;
  place.segment = nearest.segment, place.corner = nearest.at.corner;
  const auto side = [&](const double* outward) {
    double sum = 0.0;
    for (int k = 0; k < d; ++k) sum += (slave[k] - place.point[k]) * outward[k];
    return sum;
  };
  const int count = meeting_in(plan, mesh, tree, place, left_out, found);
  if (count < 0) return BorderSide::behind; // better a step cut than a penetration unseen
  double outward[3] = {};
  if (!pseudonormal(plan, mesh, found, count, outward))
    return side(place.normal) < 0.0 ? BorderSide::beside_behind : BorderSide::beside_ahead;
  for (int i = 0; i < count; ++i) crack = std::max(crack, distance(found[i].point, place.point, d));
  return side(outward) < 0.0 ? BorderSide::behind : BorderSide::ahead;
}

} // namespace ents
