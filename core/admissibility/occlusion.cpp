// SPDX-License-Identifier: BSD-3-Clause
// Shadow projection: which points of the surface does another part of it keep from the light?
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/admissibility/facets.hpp"

namespace ents {

namespace {

using Eigen::Vector3d;

// The farthest facet on the way from a sample to the light.
struct FarthestHit {
  const Facets& facets;
  Vector3d from, ray;
  double least, most; // of the distance along the ray
  double at = 0.0;    // 0: no hit
  std::int64_t segment = -1;
  double xi[2] = {0.0, 0.0};

  bool intersectVolume(const Facets::Tree::Volume& box) const {
    double first = std::max(least, at), last = most;
    for (int k = 0; k < 3; ++k) {
      const double low = box.min()[k] - from[k], high = box.max()[k] - from[k];
      if (std::fabs(ray[k]) < 1e-300) {
        if (low > 0.0 || high < 0.0) return false;
        continue;
      }
      const double a = low / ray[k], b = high / ray[k];
      first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
    }
    return first <= last * (1.0 + 1e-12);
  }
  bool intersectObject(std::int64_t index) {
    const Facets::Cell cell = facets.cell(index);
    Facets::Piece piece[2];
    const int count = facets.pieces(cell, piece);
    for (int p = 0; p < count; ++p) {
      const auto& c = piece[p].corner;
      const Vector3d a = facets.point(cell, c[0]) - from, u = facets.point(cell, c[1]) - from - a;
      // t ray = a + v u (+ w (third - first)); in 2D the third direction is out of the plane
      const Vector3d third =
          facets.corners() == 3 ? Vector3d(facets.point(cell, c[2]) - from - a) : Vector3d(Vector3d::UnitZ());
      const double volume = ray.dot(u.cross(third));
      if (std::fabs(volume) <= 1e-14 * u.norm() * third.norm()) continue;
      const double t = a.dot(u.cross(third)) / volume;
      const double v = -a.dot(third.cross(ray)) / volume, w = -a.dot(ray.cross(u)) / volume;
      if (!(t > std::max(least, at)) || !(t < most) || v < 0.0 || v > 1.0) continue;
      if (facets.corners() == 3 && (w < 0.0 || v + w > 1.0)) continue;
      at = t, segment = cell.segment;
      double first[2], second[2], last[2];
      facets.xi_of(c[0][0], c[0][1], first), facets.xi_of(c[1][0], c[1][1], second);
      facets.xi_of(c[2][0], c[2][1], last);
      for (int k = 0; k < 2; ++k)
        xi[k] =
            first[k] + v * (second[k] - first[k]) + (facets.corners() == 3 ? w * (last[k] - first[k]) : 0.0);
    }
    return false;
  }
};

} // namespace

void check_occlusion(const SurfaceChecker& c, const Facets& f) {
  const int which = condition::occlusion;
  const bool surface = f.corners() == 3, emitter = c.plan.projection == ProjectionKind::shadow_point;
  const Vector3d light = vector_of(c.plan.ray, c.plan.dimension);
  for (std::int64_t s = 0; s < c.mesh.segments; ++s)
    for (int j = 0; j < (surface ? f.n : 1); ++j)
      for (int i = 0; i < (c.plan.simplex ? f.n - j : f.n); ++i) {
        const auto k = static_cast<std::size_t>(f.sample(s, i, j));
        if (!f.known[k]) continue;
        const Vector3d ray = emitter ? Vector3d(light - f.points[k]) : light;
        const double distance = ray.norm();
        if (!(distance > 0.0)) continue;
        // facets at the sample itself: closer than its neighbours
        double spacing = 0.0;
        for (const int step : {-1, 1}) {
          const bool in_row = i + step >= 0 && i + step < (c.plan.simplex ? f.n - j : f.n);
          const bool in_column = surface && j + step >= 0 && j + step < (c.plan.simplex ? f.n - i : f.n);
          if (in_row)
            spacing = std::max(
                spacing, (f.points[static_cast<std::size_t>(f.sample(s, i + step, j))] - f.points[k]).norm());
          if (in_column)
            spacing = std::max(
                spacing, (f.points[static_cast<std::size_t>(f.sample(s, i, j + step))] - f.points[k]).norm());
        }
        FarthestHit hit{f, f.points[k], ray / distance, 1.5 * spacing,
                        emitter ? distance : std::numeric_limits<double>::infinity()};
        Eigen::BVIntersect(f.tree, hit);
        if (hit.segment < 0) continue;
        c.mark(which, s);
        double xi[2];
        f.xi_of(i, j, xi);
        c.keep(which, hit.at > c.finding(which).value, hit.at, s, xi, hit.segment, hit.xi);
      }
}

} // namespace ents
