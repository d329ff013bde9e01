// SPDX-License-Identifier: BSD-3-Clause
// Edges that two segments share: do the enriched surfaces meet there, at which angle, and with room between
// them?
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/admissibility/surface_checker.hpp"

namespace ents {

Corners corners_of(Basis basis) {
  switch (basis) {
  case Basis::line2:
  case Basis::line3:
    return {2, {0, 1}, {{-1, 0}, {1, 0}}};
  case Basis::catmull_rom4:
  case Basis::bspline4:
    return {2, {1, 2}, {{-1, 0}, {1, 0}}};
  case Basis::tri3:
  case Basis::tri6:
  case Basis::bezier15:
    return {3, {0, 1, 2}, {{0, 0}, {1, 0}, {0, 1}}};
  case Basis::catmull_rom16:
  case Basis::bspline16:
    return {4, {5, 6, 10, 9}, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  default:
    return {4, {0, 1, 2, 3}, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  }
}

namespace {

using Eigen::Vector3d;

constexpr double pi = 3.14159265358979323846;
constexpr double smooth_kink = 1e-6; // rad; more than rounding leaves, less than any texture on a kink

struct Edge {
  std::int64_t low, high; // its nodes, the smaller first; 2D: one node
  std::int64_t segment;
  int first, second; // corners at low and high
};

std::vector<Edge> edges_of(const SurfaceChecker& c, const Corners& corners) {
  std::vector<Edge> edges;
  const bool line = corners.count == 2;
  edges.reserve(static_cast<std::size_t>(c.mesh.segments * corners.count));
  for (std::int64_t s = 0; s < c.mesh.segments; ++s) {
    const std::int64_t* nodes = c.mesh.connectivity + s * c.plan.nodes;
    for (int k = 0; k < corners.count; ++k) {
      int first = k, second = line ? k : (k + 1) % corners.count;
      std::int64_t a = nodes[corners.node[first]], b = nodes[corners.node[second]];
      if (!line && a == b) continue; // collapsed
      if (a > b) std::swap(a, b), std::swap(first, second);
      edges.push_back({a, b, s, first, second});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
    return x.low != y.low ? x.low < y.low : x.high != y.high ? x.high < y.high : x.segment < y.segment;
  });
  return edges;
}

// One side of an edge at one of its points.
struct Side {
  double xi[2];
  Place at;
  Vector3d base; // along rho, across the edge, into the segment
  double lift;   // angle by which rho_e rises over rho on its way into the segment
};

bool side_at(const SurfaceChecker& c, const Corners& corners, const SegmentNodes& nodes, const Edge& edge,
             double t, Side& out) {
  const double* from = corners.xi[edge.first];
  const double* to = corners.xi[edge.second];
  const double middle = c.plan.simplex ? 1.0 / 3.0 : 0.0;
  double inner[2];
  for (int a = 0; a < 2; ++a) {
    out.xi[a] = from[a] + t * (to[a] - from[a]);
    inner[a] = out.xi[a] + 1e-4 * (middle - out.xi[a]);
  }
  if (!place_at(c.plan, nodes, out.xi, out.at)) return false;
  // on rho: the tangent along the edge, and a point inside that says which side is in
  const auto rho = [&](const double* xi, Vector3d& x) {
    double point[3];
    const SurfacePoint wanted = {nullptr, nullptr, nullptr, point, nullptr, nullptr, nullptr};
    if (c.plan.surface(c.plan, nodes.positions, nodes.surface_coordinates, xi, wanted) != Status::ok)
      return false;
    x = vector_of(point, c.plan.dimension);
    return true;
  };
  Vector3d here, in, along = Vector3d::UnitZ();
  if (!rho(out.xi, here) || !rho(inner, in)) return false;
  if (c.plan.parameters == 2) {
    double near[2], next[2];
    for (int a = 0; a < 2; ++a) {
      near[a] = out.xi[a] - 1e-4 * (to[a] - from[a]);
      next[a] = out.xi[a] + 1e-4 * (to[a] - from[a]);
    }
    Vector3d before, after;
    if (!rho(near, before) || !rho(next, after)) return false;
    along = (after - before).normalized();
  }
  out.base = out.at.n.cross(along).normalized();
  if (out.base.dot(in - here) < 0.0) out.base = -out.base;
  // the line in which the tangent plane of rho_e meets the plane across the edge
  Vector3d direction = out.at.n_e.cross(along);
  if (direction.dot(out.base) < 0.0) direction = -direction;
  out.lift = std::atan2(direction.dot(out.at.n), direction.dot(out.base));
  return true;
}

// The angle that is free outside, from one segment to the other.
double free_angle(const Side& a, const Side& b) {
  double between = std::atan2(b.base.dot(a.at.n), b.base.dot(a.base));
  if (between < 0.0) between += 2.0 * pi;
  return between - a.lift - b.lift;
}

} // namespace

void check_shared_edges(const SurfaceChecker& c, int samples, std::vector<bool>& smooth) {
  const Corners corners = corners_of(c.model.basis);
  const std::vector<Edge> edges = edges_of(c, corners);
  smooth.assign(static_cast<std::size_t>(c.mesh.nodes), true);
  const int points = c.plan.parameters == 1 ? 1 : samples;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1; // more than two segments at an edge: each against the first
    while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
    for (std::size_t k = i + 1; k < end; ++k) {
      const Edge edge[2] = {edges[i], edges[k]};
      SegmentNodes nodes[2];
      bool rough = false;
      for (int e = 0; e < 2; ++e)
        if (gather(c.plan, c.mesh, edge[e].segment, nodes[e]) != Status::ok) return;
      for (int p = 0; p < points; ++p) {
        Side side[2];
        const double t = points == 1 ? 0.0 : p / (points - 1.0);
        if (!side_at(c, corners, nodes[0], edge[0], t, side[0]) ||
            !side_at(c, corners, nodes[1], edge[1], t, side[1]))
          continue;
        const Vector3d &n = side[0].at.n_e, &m = side[1].at.n_e;
        const double jump = (side[0].at.rho_e - side[1].at.rho_e).norm();
        const double kink = std::atan2(n.cross(m).norm(), n.dot(m));
        const double wedge = free_angle(side[0], side[1]);
        const auto at = [&](int which, bool worse, double value, bool bad) {
          c.keep(which, worse, value, edge[0].segment, side[0].xi, edge[1].segment, side[1].xi);
          if (bad) c.mark(which, edge[0].segment), c.mark(which, edge[1].segment);
        };
        at(condition::jump, jump > c.finding(condition::jump).value, jump,
           jump > c.finding(condition::jump).bound);
        at(condition::kink, kink > c.finding(condition::kink).value, kink,
           kink > c.finding(condition::kink).bound);
        at(condition::wedge, wedge < c.finding(condition::wedge).value, wedge, !(wedge > 0.0));
        rough = rough || kink > smooth_kink || jump > c.finding(condition::jump).bound;
      }
      if (rough)
        smooth[static_cast<std::size_t>(edge[0].low)] = smooth[static_cast<std::size_t>(edge[0].high)] =
            false;
    }
    i = end;
  }
}

} // namespace ents
