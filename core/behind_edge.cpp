// SPDX-License-Identifier: BSD-3-Clause
#include "core/behind_edge.hpp"

#include <algorithm>
#include <cmath>

#include "core/segment_tree.hpp"

namespace ents {

namespace {

constexpr int most_segments = 64; // that meet in a point

// A point of a segment's border.
struct BorderPoint {
  double point[3], normal[3], xi[2];
  double distance; // to where it is looked for from
  bool corner;     // of a patch
  std::int64_t segment;
};

double dot(const double* a, const double* b, int d) {
  double sum = 0.0;
  for (int k = 0; k < d; ++k) sum += a[k] * b[k];
  return sum;
}

// The corner of a patch: unit tangents of the two edges that meet there, and the angle between them.
struct Corner {
  double tangent[2][3], angle;
};

// The point of a segment's border that is closest to another one.
class Border {
public:
  Border(const Plan& plan, const SegmentNodes& nodes, const double* from) : plan_(plan), nodes_(nodes), from_(from) {}

  bool closest(BorderPoint& best) const {
    best.distance = infinity;
    const int edges = plan_.parameters == 1 ? 2 : plan_.simplex ? 3 : 4;
    for (int edge = 0; edge < edges; ++edge) closest_on(edge, best);
    return best.distance < infinity;
  }

  // At the corner nearest to a point of the border.
  bool corner(const BorderPoint& near, Corner& out) const {
    constexpr double step = 1e-4;
    double at[2] = {near.xi[0] > 0.0 ? 1.0 : -1.0, near.xi[1] > 0.0 ? 1.0 : -1.0};
    if (plan_.simplex) at[0] = std::round(near.xi[0]), at[1] = std::round(near.xi[1]);
    BorderPoint here;
    if (!evaluate(at, here)) return false;
    for (int e = 0; e < 2; ++e) {
      double xi[2] = {at[0], at[1]};
      if (!plan_.simplex) {
        xi[e] -= step * xi[e];
      } else if (xi[0] + xi[1] == 0.0) {
        xi[e] += step;
      } else { // (1, 0) or (0, 1)
        const int one = xi[0] > xi[1] ? 0 : 1;
        xi[one] -= step;
        if (e == 1) xi[1 - one] += step;
      }
      BorderPoint beside;
      if (!evaluate(xi, beside)) return false;
      double* t = out.tangent[e];
      for (int k = 0; k < 3; ++k) t[k] = beside.point[k] - here.point[k];
      const double length = std::sqrt(dot(t, t, 3));
      if (!(length > 0.0)) return false;
      for (int k = 0; k < 3; ++k) t[k] /= length;
    }
    out.angle = std::acos(std::clamp(dot(out.tangent[0], out.tangent[1], 3), -1.0, 1.0));
    return true;
  }

private:
  // u in [0, 1] along an edge
  bool evaluate(int edge, double u, BorderPoint& out) const {
    double xi[2] = {};
    if (plan_.parameters == 1) {
      xi[0] = 2.0 * edge - 1.0;
    } else if (plan_.simplex) {
      xi[0] = edge == 1 ? 0.0 : u, xi[1] = edge == 0 ? 0.0 : (edge == 1 ? u : 1.0 - u);
    } else {
      const double along = 2.0 * u - 1.0, side = edge < 2 ? -1.0 : 1.0;
      xi[edge % 2] = along, xi[1 - edge % 2] = side;
    }
    out.corner = plan_.parameters == 2 && (u == 0.0 || u == 1.0);
    return evaluate(xi, out);
  }

  bool evaluate(const double (&xi)[2], BorderPoint& out) const {
    out.xi[0] = xi[0], out.xi[1] = xi[1];
    const SurfacePoint to = {out.point, out.normal, nullptr, nullptr, nullptr, nullptr, nullptr};
    if (plan_.surface(plan_, nodes_.positions, nodes_.surface_coordinates, xi, to) != Status::ok) return false;
    double sum = 0.0;
    for (int k = 0; k < plan_.dimension; ++k) sum += (from_[k] - out.point[k]) * (from_[k] - out.point[k]);
    out.distance = std::sqrt(sum);
    return true;
  }

  void closest_on(int edge, BorderPoint& best) const {
    BorderPoint now;
    if (plan_.parameters == 1) {
      if (evaluate(edge, 0.0, now) && now.distance < best.distance) best = now;
      return;
    }
    // samples, then the golden section round the best one
    constexpr int samples = 16;
    int at = -1;
    double least = infinity;
    for (int i = 0; i <= samples; ++i)
      if (evaluate(edge, i / double{samples}, now) && now.distance < least) least = now.distance, at = i;
    if (at < 0) return;
    double low = std::max(0, at - 1) / double{samples}, high = std::min(samples, at + 1) / double{samples};
    constexpr double golden = 0.6180339887498949;
    for (int i = 0; i < 40; ++i) {
      const double left = high - golden * (high - low), right = low + golden * (high - low);
      BorderPoint a, b;
      if (!evaluate(edge, left, a) || !evaluate(edge, right, b)) return;
      (a.distance < b.distance ? high : low) = a.distance < b.distance ? right : left;
    }
    for (const double u : {low, 0.5 * (low + high), high})
      if (evaluate(edge, u < 1e-7 ? 0.0 : (u > 1.0 - 1e-7 ? 1.0 : u), now) && now.distance < best.distance) best = now;
  }

  const Plan& plan_;
  const SegmentNodes& nodes_;
  const double* from_;
};

// How far a segment's nodes are from its first.
double size_of(const Plan& plan, const SegmentNodes& nodes) {
  double most = 0.0;
  for (int i = 1; i < plan.nodes; ++i) {
    double sum = 0.0;
    for (int k = 0; k < plan.dimension; ++k) {
      const double off = nodes.positions[i * plan.dimension + k] - nodes.positions[k];
      sum += off * off;
    }
    most = std::max(most, sum);
  }
  return std::sqrt(most);
}

// The point of all borders that is closest to the slave; false: none within reach.
bool closest_of_all(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave, double reach, BorderPoint& best) {
  best.distance = reach, best.segment = -1;
  const Status status = visit_segments(
      Tree(plan, mesh.segments), tree, [&](const double* box) { return distance_to_box(plan.dimension, slave, box); },
      [&] { return best.distance; },
      [&](std::int64_t segment) {
        SegmentNodes nodes;
        if (const Status gathered = gather(plan, mesh, segment, nodes); gathered != Status::ok) return gathered;
        BorderPoint point;
        if (!Border(plan, nodes, slave).closest(point) || !(point.distance <= best.distance)) return Status::ok;
        if (best.segment >= 0 && point.distance == best.distance) return Status::ok;
        point.segment = segment;
        best = point;
        return Status::ok;
      });
  return status == Status::ok && best.segment >= 0;
}

// The segments whose borders go through a point, which lies on the border of one of them; -1: more than there is room for.
int meeting_in(const Plan& plan, const MasterMesh& mesh, const double* tree, const BorderPoint& place, BorderPoint (&found)[most_segments]) {
  const int d = plan.dimension;
  SegmentNodes nodes;
  if (gather(plan, mesh, place.segment, nodes) != Status::ok) return 0;
  const double near = 1e-6 * size_of(plan, nodes);
  int count = 0;
  bool all = true;
  const Status status = visit_segments(
      Tree(plan, mesh.segments), tree, [&](const double* box) { return distance_to_box(d, place.point, box); }, [&] { return near; },
      [&](std::int64_t segment) {
        if (const Status gathered = gather(plan, mesh, segment, nodes); gathered != Status::ok) return gathered;
        double box[6];
        plan.box(plan, nodes.positions, nodes.surface_coordinates, box, box + d);
        BorderPoint point;
        if (distance_to_box(d, place.point, box) > near || !Border(plan, nodes, place.point).closest(point) || point.distance > near)
          return Status::ok;
        point.segment = segment;
        if (count < most_segments) found[count++] = point;
        else all = false;
        return Status::ok;
      });
  if (status != Status::ok) return 0;
  return all ? count : -1;
}

// The sum of the normals of the segments that meet in a point, weighted by their angles there; false at a free edge. On which side
// of a surface a point lies whose closest point is an edge or a vertex, this normal tells and no other
// (Baerentzen and Aanaes, IEEE TVCG 11, 2005).
bool pseudonormal(const Plan& plan, const MasterMesh& mesh, const BorderPoint* found, int count, double (&sum)[3]) {
  bool vertex = false;
  for (int i = 0; i < count; ++i) vertex = vertex || found[i].corner;
  if (count < 2) return false;
  Corner corners[most_segments];
  for (int i = 0; i < count; ++i) {
    double weight = 1.0;
    if (vertex) {
      SegmentNodes nodes;
      if (gather(plan, mesh, found[i].segment, nodes) != Status::ok ||
          !Border(plan, nodes, found[i].point).corner(found[i], corners[i]))
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
      shared = shared || (i / 2 != j / 2 && dot(corners[i / 2].tangent[i % 2], corners[j / 2].tangent[j % 2], 3) > same);
    if (!shared) return false;
  }
  return true;
}

} // namespace

bool is_behind_edge(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave, double reach) {
  BorderPoint closest, found[most_segments];
  if (!closest_of_all(plan, mesh, tree, slave, reach, closest)) return false;
  const int count = meeting_in(plan, mesh, tree, closest, found);
  if (count < 0) return true; // better a step cut than a penetration unseen
  double outward[3] = {}, side = 0.0;
  if (!pseudonormal(plan, mesh, found, count, outward)) return false;
  for (int k = 0; k < plan.dimension; ++k) side += (slave[k] - closest.point[k]) * outward[k];
  return side < 0.0;
}

} // namespace ents
