// SPDX-License-Identifier: BSD-3-Clause
// Convex polygons in the plane: intersection, difference, quadrature.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace host {

/// Corners in counter-clockwise order.
using Polygon = std::vector<Eigen::Vector2d>;

/// A point of a quadrature rule and its share of the area.
struct PlanePoint {
  Eigen::Vector2d place;
  double weight = 0; ///< [L^2]
};

/// Signed area: > 0 if the corners are in counter-clockwise order.
double area_of(const Polygon& polygon);

/// Do all corners turn to the left, or straight on?
bool is_convex(const Polygon& polygon);

/// The part of a convex polygon inside a convex window; less than three corners: none (Sutherland and
/// Hodgman 1974).
/// @param tolerance  [L]: corners as close to a line count as on it
Polygon intersection(Polygon polygon, const Polygon& window, double tolerance);

/// Replace a convex polygon by its parts outside of a convex window, which are convex and do not overlap.
void append_difference(Polygon polygon, const Polygon& window, double tolerance, std::vector<Polygon>& parts);

/// Points and weights of Gauss and Legendre on [-1, 1]: exact up to degree 2 n - 1.
std::vector<std::pair<double, double>> gauss_legendre(int n);

/// Quadrature over a convex polygon, added to `points`. n = 1: its centroid, which is exact for polynomials
/// of degree 1. n > 1, exact up to degree 2 n - 2: a quadrilateral has n^2 points, others are divided into
/// triangles, which have three points (n = 2) or n^2, the square collapsed on the triangle.
void append_quadrature(const Polygon& polygon, int n, std::vector<PlanePoint>& points);

} // namespace host
