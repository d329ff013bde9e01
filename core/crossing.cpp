// SPDX-License-Identifier: BSD-3-Clause
// Enriched segments that intersect each other (neighbours beside a concave edge, parts of a surface that come near each
// other) or themselves (a fold). Facets find the pairs, exact projections confirm them and say how deep they overlap.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/facets.hpp"

namespace ents {

namespace {

using Eigen::Vector3d;

constexpr double touching = 1e-9;    // of the facets' size
constexpr int most_attempts = 64;    // of confirming that two segments intersect
constexpr std::size_t most_measured = 1000; // pairs whose overlap is measured all over

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
  const auto apart = [&](double x, double y) { return (x > tolerance && y > tolerance) || (x < -tolerance && y < -tolerance); };
  if (apart(c_off, d_off) || apart(a_off, b_off)) return {};
  // parallel lines: they touch if they overlap, which the boxes say well enough
  const auto through = [](double x, double y) { return x * y < 0.0 ? std::min(std::fabs(x), std::fabs(y)) : 0.0; };
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
  for (int k = 0; k < 3; ++k) size = std::max({size, (a[k] - a[(k + 1) % 3]).norm(), (b[k] - b[(k + 1) % 3]).norm()});
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
    std::size_t measured = 0;
    for (auto& [segments, pair] : pairs_) {
      const auto [a, b] = segments;
      if (!pair.confirmed) continue;
      if (a != b && measured++ < most_measured) measure(a, b, pair.worst), measure(b, a, pair.worst);
      c_.mark(condition::crossing, a), c_.mark(condition::crossing, b);
      c_.keep(condition::crossing, pair.worst.depth > c_.finding(condition::crossing).value, pair.worst.depth, a,
              pair.worst.xi, b, pair.worst.other_xi);
    }
  }

private:
  struct Pair {
    int attempts = 0;
    bool confirmed = false;
    Deepest worst; // xi on the pair's first segment
  };

  // Touching boxes count: facets may lie in a coordinate plane.
  bool near(const Box& a, const Box& b) const {
    const double margin = touching * c_.size;
    return ((a.min().array() <= b.max().array() + margin) && (b.min().array() <= a.max().array() + margin)).all();
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
  bool meet_on_borders(const Facets::Cell& a, const Facets::Piece& x, const Facets::Cell& b, const Facets::Piece& y) const {
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
    const auto known = pairs_.find({a.segment, b.segment});
    if (!itself && known != pairs_.end() && (known->second.confirmed || known->second.attempts >= most_attempts))
      return;
    Facets::Piece x[2], y[2];
    const int x_count = f_.pieces(a, x), y_count = f_.pieces(b, y);
    for (int p = 0; p < x_count; ++p)
      for (int q = 0; q < y_count; ++q) {
        const Contact contact = meet(a, x[p], b, y[q]);
        if (!contact.touch || (contact.through == 0.0 && (itself || meet_on_borders(a, x[p], b, y[q])))) continue;
        Pair& pair = pairs_[{a.segment, b.segment}];
        if (itself) { // the surface has no side to be behind of: what sticks through of a facet, at least
          if (pair.confirmed && contact.through <= pair.worst.depth) continue;
          pair.confirmed = true;
          pair.worst.depth = contact.through;
          f_.xi_of(x[p].corner[0][0], x[p].corner[0][1], pair.worst.xi);
          f_.xi_of(y[q].corner[0][0], y[q].corner[0][1], pair.worst.other_xi);
          continue;
        }
        ++pair.attempts;
        behind(a, x[p], b.segment, false, pair.worst);
        behind(b, y[q], a.segment, true, pair.worst);
        pair.confirmed = pair.worst.depth > touching * c_.size;
        if (pair.confirmed) return;
      }
  }

  Contact meet(const Facets::Cell& a, const Facets::Piece& x, const Facets::Cell& b, const Facets::Piece& y) const {
    const auto at = [&](const Facets::Cell& cell, const Facets::Piece& piece, int k) -> const Vector3d& {
      return f_.point(cell, piece.corner[k]);
    };
    if (f_.corners() == 2) return lines_meet(at(a, x, 0), at(a, x, 1), at(b, y, 0), at(b, y, 1));
    const Vector3d first[3] = {at(a, x, 0), at(a, x, 1), at(a, x, 2)}, second[3] = {at(b, y, 0), at(b, y, 1), at(b, y, 2)};
    return triangles_meet(first, second);
  }

  // How far a sample is behind another segment on which it has a projection.
  void sample_behind(std::int64_t segment, int i, int j, const SegmentNodes& other, bool swapped, Deepest& worst) const {
    const auto k = static_cast<std::size_t>(f_.sample(segment, i, j));
    if (!f_.known[k]) return;
    const double slave[3] = {f_.points[k].x(), f_.points[k].y(), f_.points[k].z()};
    SegmentProjection at;
    if (!plan_.project(plan_, slave, other.positions, other.surface_coordinates, nullptr, c_.size, at)) return;
    if (!(-at.gap > worst.depth)) return;
    worst.depth = -at.gap;
    double xi[2];
    f_.xi_of(i, j, xi);
    for (int a = 0; a < 2; ++a) {
      (swapped ? worst.other_xi : worst.xi)[a] = xi[a];
      (swapped ? worst.xi : worst.other_xi)[a] = a < plan_.parameters ? at.xi[a] : 0.0;
    }
  }
  void behind(const Facets::Cell& cell, const Facets::Piece& piece, std::int64_t other, bool swapped, Deepest& worst) const {
    SegmentNodes nodes;
    if (gather(plan_, c_.mesh, other, nodes) != Status::ok) return;
    for (int k = 0; k < f_.corners(); ++k)
      sample_behind(cell.segment, piece.corner[k][0], piece.corner[k][1], nodes, swapped, worst);
  }
  // All over the segment, on at most 33 (a line: 129) of its samples per direction.
  void measure(std::int64_t segment, std::int64_t other, Deepest& worst) const {
    SegmentNodes nodes;
    if (gather(plan_, c_.mesh, other, nodes) != Status::ok) return;
    const bool surface = f_.corners() == 3;
    const int step = std::max(1, (f_.n - 1) / (surface ? 32 : 128));
    const auto sampled = [&](int i, int last) { return i % step == 0 || i == last; };
    for (int j = 0; j < (surface ? f_.n : 1); ++j)
      for (int i = 0; i < (c_.simplex() ? f_.n - j : f_.n); ++i)
        if (sampled(i, (c_.simplex() ? f_.n - j : f_.n) - 1) && sampled(j, surface ? f_.n - 1 : 0))
          sample_behind(segment, i, j, nodes, segment > other, worst);
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
