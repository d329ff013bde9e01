// SPDX-License-Identifier: BSD-3-Clause
// Flat facets, for references by brute force: how far a point is from one, and whether a ray goes through it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "surface.hpp"

namespace mechanics {

using Point = Vec3;

inline double distance_to_edge(const Point& x, const Point& a, const Point& b) {
  const Point ab = b - a, ax = x - a;
  const double t = std::clamp(dot(ax, ab) / dot(ab, ab), 0.0, 1.0);
  const Point off = {ax[0] - t * ab[0], ax[1] - t * ab[1], ax[2] - t * ab[2]};
  return std::sqrt(dot(off, off));
}

// A flat facet of corners p, convex.
inline double distance_to_facet(const Point& x, const std::vector<Point>& p) {
  double least = 1e300;
  for (std::size_t i = 0; i < p.size(); ++i)
    least = std::min(least, distance_to_edge(x, p[i], p[(i + 1) % p.size()]));
  const Point n = cross(p[1] - p[0], p[2] - p[0]);
  bool over = true;
  for (std::size_t i = 0; i < p.size(); ++i)
    over = over && dot(cross(n, p[(i + 1) % p.size()] - p[i]), x - p[i]) >= 0.0;
  return over ? std::min(least, std::fabs(dot(x - p[0], n)) / std::sqrt(dot(n, n))) : least;
}

// Does the ray from x in direction u go through the triangle?
inline bool goes_through(const Point& x, const Point& u, const Point& a, const Point& b, const Point& c) {
  const Point e = b - a, f = c - a, h = cross(u, f);
  const double det = dot(e, h), v = dot(x - a, h) / det;
  const Point q = cross(x - a, e);
  const double w = dot(u, q) / det;
  return v >= 0.0 && w >= 0.0 && v + w <= 1.0 && dot(f, q) / det > 0.0;
}

} // namespace mechanics
