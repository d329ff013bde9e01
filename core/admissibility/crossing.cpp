// SPDX-License-Identifier: BSD-3-Clause
// Enriched segments that intersect each other (neighbours beside a concave edge, parts of a surface that come
// near each other) or themselves (a fold). Facets find the pairs, exact projections confirm them and say how
// deep they overlap.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/admissibility/facets.hpp"
#include "core/projection/search.hpp"

namespace ents {

namespace {

using Eigen::Vector3d;

constexpr double touching = 1e-9;   // of the facets' size
constexpr int most_attempts = 64;   // to find a sample behind, for facets of two segments that may only touch
constexpr int most_searches = 16;   // of a sample's projection without a start, per pair of segments
constexpr int search_budget = 1000; // of one of these: what is far from simple is left to other samples

struct Contact {
  bool touch = false;   // or intersect
  double through = 0.0; // how far the shorter end sticks through; 0: a mere touch
};

// Two lines of the plane.
Contact lines_meet(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d u = b - a, v = d - c;
  const double size = std::max(u.norm(), v.norm()), tolerance = touching * size;
  if (!(size > 0.0)) return {};
  const auto off = [](const Vector3d& x, const Vector3d& from, const Vector3d& along) {
    return (along.x() * (x.y() - from.y()) - along.y() * (x.x() - from.x())) / along.norm();
  };
  const double c_off = off(c, a, u), d_off = off(d, a, u), a_off = off(a, c, v), b_off = off(b, c, v);
  const auto apart = [&](double x, double y) {
    return (x > tolerance && y > tolerance) || (x < -tolerance && y < -tolerance);
  };
  if (apart(c_off, d_off) || apart(a_off, b_off)) return {};
  // parallel lines: they touch if they overlap, which the boxes say well enough
  const auto through = [](double x, double y) {
    return x * y < 0.0 ? std::min(std::fabs(x), std::fabs(y)) : 0.0;
  };
  const double depth = std::min(through(c_off, d_off), through(a_off, b_off));
  return {true, depth > tolerance ? depth : 0.0};
}

// An edge p q through a triangle.
Contact edge_meets(const Vector3d& p, const Vector3d& q, const Vector3d (&t)[3], double tolerance) {
  const Vector3d u = t[1] - t[0], v = t[2] - t[0];
  Vector3d n = u.cross(v);
  const double area = n.norm();
  if (!(area > 0.0)) return {};
  n /= area;
  const double above = (p - t[0]).dot(n), below = (q - t[0]).dot(n);
  if ((above > tolerance && below > tolerance) || (above < -tolerance && below < -tolerance)) return {};
  if (std::fabs(above - below) <= tolerance) return {}; // in the plane: its ends, or other edges, tell
  const double part = above / (above - below);
  const Vector3d x = p + part * (q - p) - t[0];
  const double s = n.dot(x.cross(v)) / area, r = n.dot(u.cross(x)) / area; // x = s u + r v
  const double least = std::min({s, r, 1.0 - s - r});
  if (least < -touching) return {};
  const double through = above * below < 0.0 ? std::min(std::fabs(above), std::fabs(below)) : 0.0;
  return {true, least > touching && through > tolerance ? through : 0.0};
}

Contact triangles_meet(const Vector3d (&a)[3], const Vector3d (&b)[3]) {
  double size = 0.0;
  for (int k = 0; k < 3; ++k)
    size = std::max({size, (a[k] - a[(k + 1) % 3]).norm(), (b[k] - b[(k + 1) % 3]).norm()});
  Contact all;
  for (int k = 0; k < 3; ++k)
    for (const Contact& one : {edge_meets(a[k], a[(k + 1) % 3], b, touching * size),
                               edge_meets(b[k], b[(k + 1) % 3], a, touching * size)}) {
      all.touch = all.touch || one.touch;
      all.through = std::max(all.through, one.through);
    }
  return all;
}

struct Deepest {
  double depth = 0.0;
  double xi[2] = {0.0, 0.0}, other_xi[2] = {0.0, 0.0}; // on the segment that is behind, and on the other
};

class Crossing {
public:
  Crossing(const SurfaceChecker& c, const Facets& f) : c_(c), f_(f), plan_(c.plan) {
    plan_.projection = ProjectionKind::normal; // how far behind is measured along the normal
  }

  // For the tree against itself.
  using Box = Facets::Tree::Volume;
  bool intersectVolumeVolume(const Box& a, const Box& b) const { return near(a, b); }
  bool intersectVolumeObject(const Box& a, std::int64_t b) const { return near(a, box_of(b)); }
  bool intersectObjectVolume(std::int64_t a, const Box& b) const { return near(box_of(a), b); }
  bool intersectObjectObject(std::int64_t a, std::int64_t b) {
    if (a < b && near(box_of(a), box_of(b))) cells(a, b);
    return false;
  }

  void tell() {
    for (const auto& [segments, pair] : pairs_) {
      const auto [a, b] = segments;
      if (!(pair.worst.depth > (a == b ? 0.0 : touching * c_.size))) continue;
      c_.mark(condition::crossing, a), c_.mark(condition::crossing, b);
      c_.keep(condition::crossing, pair.worst.depth > c_.finding(condition::crossing).value, pair.worst.depth,
              a, pair.worst.xi, b, pair.worst.other_xi);
    }
  }

private:
  struct Pair {
    int attempts = 0, searches = 0;
    Deepest worst;                         // xi on the pair's first segment
    std::unordered_set<std::int64_t> seen; // samples
  };

  // Touching boxes count: facets may lie in a coordinate plane.
  bool near(const Box& a, const Box& b) const {
    const double margin = touching * c_.size;
    return ((a.min().array() <= b.max().array() + margin) && (b.min().array() <= a.max().array() + margin))
        .all();
  }
  Box box_of(std::int64_t index) const {
    Facets::Piece piece[2];
    const Facets::Cell cell = f_.cell(index);
    const int count = f_.pieces(cell, piece);
    Box box;
    for (int p = 0; p < count; ++p)
      for (int k = 0; k < f_.corners(); ++k) box.extend(f_.point(cell, piece[p].corner[k]));
    return box;
  }

  // Do they meet on the borders of both segments? That is what neighbours do.
  bool meet_on_borders(const Facets::Cell& a, const Facets::Piece& x, const Facets::Cell& b,
                       const Facets::Piece& y) const {
    for (int i = 0; i < f_.corners(); ++i)
      for (int j = 0; j < f_.corners(); ++j)
        if (f_.on_border(x.corner[i][0], x.corner[i][1]) && f_.on_border(y.corner[j][0], y.corner[j][1]) &&
            (f_.point(a, x.corner[i]) - f_.point(b, y.corner[j])).norm() <= touching * c_.size)
          return true;
    return false;
  }

  void cells(std::int64_t first, std::int64_t second) {
    const Facets::Cell a = f_.cell(first), b = f_.cell(second);
    const bool itself = a.segment == b.segment;
    if (itself && std::abs(a.i - b.i) <= 1 && std::abs(a.j - b.j) <= 1) return;
    Facets::Piece x[2], y[2];
    const int x_count = f_.pieces(a, x), y_count = f_.pieces(b, y);
    for (int p = 0; p < x_count; ++p)
      for (int q = 0; q < y_count; ++q) {
        const Contact contact = meet(a, x[p], b, y[q]);
        if (!contact.touch || (contact.through == 0.0 && (itself || meet_on_borders(a, x[p], b, y[q]))))
          continue;
        Pair& pair = pairs_[{a.segment, b.segment}];
        if (itself) { // the surface has no side to be behind of: what sticks through of a facet, at least
          if (contact.through <= pair.worst.depth) continue;
          pair.worst.depth = contact.through;
          f_.xi_of(x[p].corner[0][0], x[p].corner[0][1], pair.worst.xi);
          f_.xi_of(y[q].corner[0][0], y[q].corner[0][1], pair.worst.other_xi);
          continue;
        }
        if (pair.attempts >= most_attempts && !(pair.worst.depth > touching * c_.size)) return;
        const double before = pair.worst.depth;
        behind(a, x[p], b, y[q], false, pair);
        behind(b, y[q], a, x[p], true, pair);
        if (!(pair.worst.depth > std::max(before, touching * c_.size))) ++pair.attempts;
      }
  }

  Contact meet(const Facets::Cell& a, const Facets::Piece& x, const Facets::Cell& b,
               const Facets::Piece& y) const {
    const auto at = [&](const Facets::Cell& cell, const Facets::Piece& piece, int k) -> const Vector3d& {
      return f_.point(cell, piece.corner[k]);
    };
    if (f_.corners() == 2) return lines_meet(at(a, x, 0), at(a, x, 1), at(b, y, 0), at(b, y, 1));
    const Vector3d first[3] = {at(a, x, 0), at(a, x, 1), at(a, x, 2)},
                   second[3] = {at(b, y, 0), at(b, y, 1), at(b, y, 2)};
    return triangles_meet(first, second);
  }

  // From the corners of a facet over all samples of its segment that are behind the other: how deep is the
  // deepest?
  void behind(const Facets::Cell& cell, const Facets::Piece& piece, const Facets::Cell& other,
              const Facets::Piece& there, bool swapped, Pair& pair) {
    SegmentNodes nodes;
    if (gather(plan_, c_.mesh, other.segment, nodes) != Status::ok) return;
    struct Visit {
      int i, j;
      double start[2];
    };
    std::vector<Visit> waiting;
    double within = 0.0; // no corner of a facet is farther from a facet that it touches
    for (int k = 0; k < f_.corners(); ++k)
      for (int l = 0; l < f_.corners(); ++l)
        within = std::max(within,
                          2.0 * (f_.point(cell, piece.corner[k]) - f_.point(other, there.corner[l])).norm());
    for (int k = 0; k < f_.corners(); ++k) {
      Visit visit{piece.corner[k][0], piece.corner[k][1], {}};
      f_.xi_of(there.corner[0][0], there.corner[0][1], visit.start);
      waiting.push_back(visit);
    }
    for (int visits = 0; !waiting.empty(); ++visits) {
      const Visit visit = waiting.back();
      waiting.pop_back();
      const std::int64_t sample = f_.sample(cell.segment, visit.i, visit.j);
      const auto k = static_cast<std::size_t>(sample);
      if (!f_.known[k] || !pair.seen.insert(sample).second) continue;
      const double slave[3] = {f_.points[k].x(), f_.points[k].y(), f_.points[k].z()};
      SegmentProjection at;
      const auto project = [&](const double* start, double limit, int budget = portable::search_budget) {
        return plan_.project(plan_, slave, nodes.positions, nodes.surface_coordinates, start, limit, budget,
                             at);
      };
      if (!project(visit.start, c_.size) && (visits >= f_.corners() || ++pair.searches > most_searches ||
                                             !project(nullptr, within, search_budget)))
        continue;
      if (!(at.gap < 0.0)) continue;
      if (-at.gap > pair.worst.depth) {
        // From a start it may be the far side of a ridge: the closest point tells which side it is on, and
        // none is behind what ends before it.
        project(nullptr, -at.gap * (1.0 + 1e-9));
        BorderPoint end;
        if (!(-at.gap > pair.worst.depth) ||
            plan_.border_point(plan_, slave, nodes.positions, nodes.surface_coordinates,
                               -at.gap * (1.0 - 1e-9), end))
          continue;
        Deepest& worst = pair.worst;
        worst.depth = -at.gap;
        double xi[2];
        f_.xi_of(visit.i, visit.j, xi);
        for (int a = 0; a < 2; ++a) {
          (swapped ? worst.other_xi : worst.xi)[a] = xi[a];
          (swapped ? worst.xi : worst.other_xi)[a] = a < plan_.parameters ? at.xi[a] : 0.0;
        }
      }
      const int rows = f_.corners() == 3 ? f_.n : 1;
      for (const auto& [i, j] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        const int next_i = visit.i + i, next_j = visit.j + j;
        if (next_i < 0 || next_j < 0 || next_j >= rows || next_i >= (c_.plan.simplex ? f_.n - next_j : f_.n))
          continue;
        waiting.push_back({next_i, next_j, {at.xi[0], at.xi[1]}});
      }
    }
  }

  const SurfaceChecker& c_;
  const Facets& f_;
  Plan plan_;
  std::map<std::pair<std::int64_t, std::int64_t>, Pair> pairs_;
};

} // namespace

void check_crossing(const SurfaceChecker& c, const Facets& f) {
  if (f.points.empty()) return;
  Crossing crossing(c, f);
  Eigen::BVIntersect(f.tree, f.tree, crossing);
  crossing.tell();
}

} // namespace ents
