// SPDX-License-Identifier: BSD-3-Clause
// At which |gap| has a slave two normal projections? A ball that touches the surface in p has its centre at p
// + r n_e; as long as no other point of the surface lies inside, p is the only closest one. The ball is
// shrunk until that is so (Ma, Bae, Choi, 3D medial axis point approximation using nearest neighbors and the
// normal field, The Visual Computer 28, 2012); where it touches the surface once more, its centre has two
// projections. The smallest radius is the reach of the surface (Federer, Curvature measures, Trans. AMS 93,
// 1959), together with the radius of curvature.
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/admissibility/facets.hpp"

namespace ents {

namespace {

using Eigen::Vector3d;

// Relative to the size of the surface; above what a jump may be that is no jump.
constexpr double same_place = 1e-7;

// At a kink between two segments there are always two projections: what the kink is for, and no fault of the
// height.
class Kinks {
public:
  Kinks(const SurfaceChecker& c, const std::vector<bool>& smooth)
      : c_(c), corners_(corners_of(c.model.basis)), smooth_(smooth) {}
  bool between(std::int64_t a, std::int64_t b) const {
    if (a == b) return false;
    const std::int64_t *x = nodes(a), *y = nodes(b);
    for (int i = 0; i < corners_.count; ++i)
      for (int j = 0; j < corners_.count; ++j)
        if (x[corners_.node[i]] == y[corners_.node[j]] &&
            !smooth_[static_cast<std::size_t>(x[corners_.node[i]])])
          return true;
    return false;
  }

private:
  const std::int64_t* nodes(std::int64_t s) const { return c_.mesh.connectivity + s * c_.plan.nodes; }
  const SurfaceChecker& c_;
  Corners corners_;
  const std::vector<bool>& smooth_;
};

// The sample inside a ball that is closest to its centre.
struct ClosestSample {
  const Facets& facets;
  const Kinks& kinks;
  std::int64_t own; // segment of the sample that the ball touches
  Vector3d touched; // that sample
  double apart2;    // closer samples are the same place, seen from the next segment
  Vector3d centre;
  double distance2; // in: of the ball
  std::int64_t found = -1;
  Facets::Cell cell{};
  int at[2] = {0, 0};

  bool intersectVolume(const Facets::Tree::Volume& box) const {
    return box.squaredExteriorDistance(centre) < distance2;
  }
  bool intersectObject(std::int64_t index) {
    const Facets::Cell where = facets.cell(index);
    Facets::Piece piece[2];
    const int count = facets.pieces(where, piece);
    bool checked = false;
    for (int p = 0; p < count; ++p)
      for (int k = 0; k < facets.corners(); ++k) {
        const double d2 = (facets.point(where, piece[p].corner[k]) - centre).squaredNorm();
        if (!(d2 < distance2)) continue;
        if (where.segment != own &&
            (facets.point(where, piece[p].corner[k]) - touched).squaredNorm() < apart2)
          continue;
        if (!checked && kinks.between(own, where.segment)) return false;
        checked = true;
        distance2 = d2;
        cell = where;
        at[0] = piece[p].corner[k][0], at[1] = piece[p].corner[k][1];
        found = facets.sample(where.segment, at[0], at[1]);
      }
    return false;
  }
};

// Is the ball tangent to the surface at this sample, as far as the distance of the samples lets it be seen?
// On a free border a ball may touch a point that is no projection.
bool tangent(const Facets& f, const ClosestSample& q, double radius) {
  const auto k = static_cast<std::size_t>(q.found);
  const Vector3d ray = (q.centre - f.points[k]) / radius;
  const double sine = (ray - ray.dot(f.normals[k]) * f.normals[k]).norm();
  double spacing = 0.0, turn = 0.0;
  Facets::Piece piece[2];
  const int count = f.pieces(q.cell, piece);
  for (int p = 0; p < count; ++p)
    for (int i = 0; i < f.corners(); ++i) {
      const auto m =
          static_cast<std::size_t>(f.sample(q.cell.segment, piece[p].corner[i][0], piece[p].corner[i][1]));
      spacing = std::max(spacing, (f.points[m] - f.points[k]).norm());
      turn = std::max(turn, (f.normals[m] - f.normals[k]).norm());
    }
  return sine <= 2.0 * (spacing / radius + turn) + 1e-6;
}

} // namespace

void check_two_projections(const SurfaceChecker& c, const Facets& f, const std::vector<bool>& smooth) {
  const Kinks kinks(c, smooth);
  const int which = condition::projection;
  const Finding& worst = c.finding(which);
  const bool surface = f.corners() == 3;
  const double apart = same_place * c.size;
  for (std::int64_t s = 0; s < c.mesh.segments; ++s)
    for (int j = 0; j < (surface ? f.n : 1); ++j)
      for (int i = 0; i < (c.plan.simplex ? f.n - j : f.n); ++i) {
        const auto k = static_cast<std::size_t>(f.sample(s, i, j));
        if (!f.known[k]) continue;
        const Vector3d &p = f.points[k], &n = f.normals[k];
        for (const double side : {-1.0, 1.0}) {
          // a segment that has been marked is looked at again for the worst place only
          const bool marked = (c.result.violations[static_cast<std::size_t>(s)] >> which) & 1;
          double radius = marked ? std::min(worst.value, worst.bound) : worst.bound;
          ClosestSample last{f, kinks, s, p, apart * apart, p, 0.0};
          for (int shrinks = 0; shrinks < 100; ++shrinks) {
            const Vector3d centre = p + side * radius * n;
            const double inside = radius * (1.0 - 1e-9); // more than the rounding of the two distances
            ClosestSample q{f, kinks, s, p, apart * apart, centre, inside * inside};
            Eigen::BVIntersect(f.tree, q);
            if (q.found < 0) break;
            const Vector3d chord = f.points[static_cast<std::size_t>(q.found)] - p;
            const double rise = 2.0 * side * chord.dot(n);
            const double smaller = chord.squaredNorm() / rise;
            if (!(rise > 0.0) || !(smaller < radius)) break;
            radius = smaller;
            q.centre = p + side * radius * n;
            last.found = q.found, last.cell = q.cell, last.centre = q.centre;
            last.at[0] = q.at[0], last.at[1] = q.at[1];
          }
          if (last.found < 0 || !(radius < worst.bound) || !tangent(f, last, radius)) continue;
          c.mark(which, s);
          c.mark(which, last.cell.segment);
          double xi[2], other[2];
          f.xi_of(i, j, xi), f.xi_of(last.at[0], last.at[1], other);
          c.keep(which, radius < worst.value, radius, s, xi, last.cell.segment, other);
        }
      }
}

} // namespace ents
