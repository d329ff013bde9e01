// SPDX-License-Identifier: BSD-3-Clause
#include "polygon.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace host {
namespace {

using Point = Eigen::Vector2d;

double cross(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Distance of a point from the line from `a` to `b`, > 0 on its left.
double distance_from_line(const Point& point, const Point& a, const Point& b) {
  return cross(b - a, point - a) / (b - a).norm();
}

/// The parts of a convex polygon on both sides of the line from `a` to `b`.
std::pair<Polygon, Polygon> split(const Polygon& polygon, const Point& a, const Point& b, double tolerance) {
  std::vector<double> distance;
  for (const Point& point : polygon) {
    const double d = distance_from_line(point, a, b);
    distance.push_back(std::abs(d) <= tolerance ? 0 : d);
  }
  Polygon left, right;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    if (distance[i] >= 0) left.push_back(polygon[i]);
    if (distance[i] <= 0) right.push_back(polygon[i]);
    if (distance[i] * distance[next] < 0) {
      const double t = distance[i] / (distance[i] - distance[next]);
      const Point between = (1 - t) * polygon[i] + t * polygon[next];
      left.push_back(between), right.push_back(between);
    }
  }
  if (left.size() < 3) left.clear();
  if (right.size() < 3) right.clear();
  return {std::move(left), std::move(right)};
}

void append_triangle(const Point& a, const Point& b, const Point& c, int n, std::vector<PlanePoint>& points) {
  const double area = 0.5 * cross(b - a, c - a);
  if (n == 2) {
    for (const Point& corner : {a, b, c}) points.push_back({(a + b + c) / 6 + corner / 2, area / 3});
  } else {
    const auto rule = gauss_legendre(n);
    for (const auto& [s, weight_s] : rule)
      for (const auto& [t, weight_t] : rule) {
        const double u = 0.5 * (1 + s), v = 0.5 * (1 + t) * (1 - u);
        points.push_back({a + u * (b - a) + v * (c - a), 0.5 * weight_s * weight_t * (1 - u) * area});
      }
  }
}

} // namespace

double area_of(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * twice;
}

bool is_convex(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i)
    if (cross(polygon[(i + 1) % n] - polygon[i], polygon[(i + 2) % n] - polygon[(i + 1) % n]) < 0)
      return false;
  return true;
}

Polygon intersection(Polygon polygon, const Polygon& window, double tolerance) {
  for (std::size_t i = 0; i < window.size() && !polygon.empty(); ++i)
    polygon = split(polygon, window[i], window[(i + 1) % window.size()], tolerance).first;
  return polygon;
}

void append_difference(Polygon polygon, const Polygon& window, double tolerance,
                       std::vector<Polygon>& parts) {
  if (intersection(polygon, window, tolerance).empty()) {
    parts.push_back(std::move(polygon));
    return;
  }
  for (std::size_t i = 0; i < window.size(); ++i) {
    auto [left, right] = split(polygon, window[i], window[(i + 1) % window.size()], tolerance);
    if (!right.empty()) parts.push_back(std::move(right));
    if (left.empty()) return;
    polygon = std::move(left);
  }
}

std::vector<std::pair<double, double>> gauss_legendre(int n) {
  std::vector<std::pair<double, double>> rule;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 20; ++iteration) { // Newton's, from a guess that is close enough
      double before = 1, value = x;                        // Legendre's polynomials n - 1 and n
      for (int k = 2; k <= n; ++k)
        before = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * before) / k);
      slope = n * (x * value - before) / (x * x - 1);
      const double step = value / slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    rule.emplace_back(x, 2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

void append_quadrature(const Polygon& polygon, int n, std::vector<PlanePoint>& points) {
  if (n == 1) {
    Point moment(0, 0);
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const Point &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
      moment += 0.5 * cross(b - a, c - a) * (a + b + c) / 3;
    }
    points.push_back({moment / area_of(polygon), area_of(polygon)});
    return;
  }
  if (polygon.size() != 4) {
    for (std::size_t i = 2; i < polygon.size(); ++i)
      append_triangle(polygon[0], polygon[i - 1], polygon[i], n, points);
    return;
  }
  const auto rule = gauss_legendre(n);
  for (const auto& [s, weight_s] : rule)
    for (const auto& [t, weight_t] : rule) {
      const Point along = 0.25 * ((1 - t) * (polygon[1] - polygon[0]) + (1 + t) * (polygon[2] - polygon[3]));
      const Point up = 0.25 * ((1 - s) * (polygon[3] - polygon[0]) + (1 + s) * (polygon[2] - polygon[1]));
      const Point place = 0.25 * ((1 - s) * (1 - t) * polygon[0] + (1 + s) * (1 - t) * polygon[1] +
                                  (1 + s) * (1 + t) * polygon[2] + (1 - s) * (1 + t) * polygon[3]);
      points.push_back({place, weight_s * weight_t * cross(along, up)});
    }
}

} // namespace host
