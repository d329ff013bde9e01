// SPDX-License-Identifier: BSD-3-Clause
#include "core/slave/contact_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace ents {
namespace {

using Point = std::array<double, 3>;

// Where the contact of an edge of this length ends, from its closed node: 0 .. 1. At a distance s from the
// border of a contact of smooth bodies, p = k sqrt(s) inside and g = 4 k / (3 E) s^(3/2) outside (of Hertz
// and Westergaard, K. L. Johnson, Contact Mechanics, 1985, chapter 5: the border of every contact without
// adhesion). Pressure and gap at the ends and s_inside + s_outside = length give k and s. With y = k^(-2/3):
// p^2 y^3 + (3 E g / 4)^(2/3) y = length.
double crossing(double pressure, double gap, double modulus, double length) {
  if (!(gap < std::numeric_limits<double>::infinity())) return 0.0; // NaN, too: the open node sees no master
  const double p = pressure / modulus, inside = p * p,
               outside = std::cbrt(std::pow(0.75 * std::max(gap, 0.0), 2));
  if (!(inside > 0.0)) return 0.0;
  double y = std::cbrt(length / inside);
  if (outside * y > length) y = length / outside;
  for (int i = 0; i < 60; ++i) { // from above on a convex function: monotone
    const double cubic = inside * y * y * y,
                 step = (cubic + outside * y - length) / (3.0 * cubic / y + outside);
    y -= step;
    if (!(step > 1e-15 * y)) break;
  }
  return std::clamp(inside * y * y * y / length, 0.0, 1.0);
}

// Area of a polygon, [L^2].
double area_of(const Point* corner, int count) {
  Point sum{};
  for (int i = 1; i + 1 < count; ++i) {
    Point a{}, b{};
    for (int k = 0; k < 3; ++k) a[k] = corner[i][k] - corner[0][k], b[k] = corner[i + 1][k] - corner[0][k];
    for (int k = 0; k < 3; ++k) sum[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
  }
  return 0.5 * std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
}

// Of the angle between two lines; 1 where one of them is a point.
double sine(const Point& a, const Point& b, const Point& c, const Point& d) {
  double first = 0.0, second = 0.0, product = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double u = b[k] - a[k], v = d[k] - c[k];
    first += u * u, second += v * v, product += u * v;
  }
  const double scale = first * second;
  return scale > 0.0 ? std::sqrt(std::max(0.0, 1.0 - product * product / scale)) : 1.0;
}

class AreaSum {
public:
  explicit AreaSum(const SlaveFields& fields) : f_(fields), d_(fields.facet->parameters + 1) {}

  void add(std::int64_t facet) {
    const int n = f_.facet->nodes;
    for (int a = 0; a < n; ++a) {
      node_[a] = f_.connectivity[facet * n + a];
      x_[a] = {};
      for (int k = 0; k < d_; ++k) x_[a][k] = f_.positions[node_[a] * d_ + k];
    }
    if (d_ == 2)
      add_line();
    else
      add_polygon(without_collapsed_side(n));
  }

  double surface = 0.0, zero_line = 0.0, border = 0.0;
  // Of an area that is counted by the points of a square lattice of spacing a which lies anywhere: 0.0724 a^3
  // times its perimeter (G. Matheron 1965), which is pi / 4 of the edges that the points show.
  double lattice_variance = 0.0;

private:
  // A quadrilateral with two nodes in one place is a triangle. Returns the number of corners.
  int without_collapsed_side(int n) {
    for (int a = 0; a < n && n == 4; ++a)
      if (x_[a] == x_[(a + 1) % n]) {
        for (int b = a; b + 1 < n; ++b) node_[b] = node_[b + 1], x_[b] = x_[b + 1];
        return n - 1;
      }
    return n;
  }
  bool closed(int a) const { return f_.pressure[node_[a]] > 0.0; }
  // slant: cosine of the edge's angle to the direction across the border of contact
  double contact_of_edge(int a, int b, double slant) const {
    const int in = closed(a) ? a : b, out = closed(a) ? b : a;
    double squared = 0.0;
    for (int k = 0; k < d_; ++k) squared += (x_[b][k] - x_[a][k]) * (x_[b][k] - x_[a][k]);
    return crossing(f_.pressure[node_[in]], f_.gap[node_[out]] / slant, f_.modulus, std::sqrt(squared));
  }
  double area_of_line(const Point& a, const Point& b) const {
    const double x = b[0] - a[0], y = b[1] - a[1];
    const double length = std::sqrt(x * x + y * y); // std::hypot of the current glibc needs GLIBC_2.35
    return length * (f_.thickness > 0.0 ? f_.thickness : std::numbers::pi * (a[0] + b[0]));
  }
  void add_line() {
    const double area = area_of_line(x_[0], x_[1]);
    surface += area;
    if (closed(0) == closed(1)) {
      if (closed(0)) zero_line += area;
      return;
    }
    border += area;
    if (f_.modulus == 0.0) return;
    const int in = closed(0) ? 0 : 1;
    const double t = contact_of_edge(0, 1, 1.0);
    Point end = x_[in];
    for (int k = 0; k < 2; ++k) end[k] += t * (x_[1 - in][k] - x_[in][k]);
    zero_line += area_of_line(x_[in], end);
  }
  void add_polygon(int n) {
    const double area = area_of(x_, n);
    surface += area;
    int inside = 0, switches = 0;
    for (int a = 0; a < n; ++a) inside += closed(a), switches += closed(a) != closed((a + 1) % n);
    // On squares each pair of neighbours, half of it in each of two facets, is the square of the spacing. A
    // triangulation has more pairs: 0.6 gives it the same border.
    const double pairs = (n == 4 ? 0.5 : 0.6) * switches;
    border += pairs * area;
    lattice_variance += 0.0724 * std::numbers::pi / 4.0 * pairs * area * area;
    if (inside == n) zero_line += area;
    if (switches == 0 || f_.modulus == 0.0) return;
    const auto between = [&](int a, int b, double t) {
      Point point = x_[a];
      for (int k = 0; k < 3; ++k) point[k] += t * (x_[b][k] - x_[a][k]);
      return point;
    };
    Point corner[8], end[4];
    double at[4] = {}, slant[4] = {1.0, 1.0, 1.0, 1.0};
    // Along an edge at an angle to the border p = k' sqrt(s), g = 4 cos(angle) k' s^(3/2) / (3 E). The first
    // border is that of edges across it.
    for (int pass = 0; pass < 3; ++pass) {
      for (int a = 0, found = 0; a < n; ++a) {
        const int b = (a + 1) % n;
        if (closed(a) == closed(b)) continue;
        at[a] = contact_of_edge(a, b, slant[a]);
        end[found++] = closed(a) ? between(a, b, at[a]) : between(b, a, at[a]);
      }
      if (switches == 4) break;
      for (int a = 0; a < n; ++a) slant[a] = std::max(0.2, sine(x_[a], x_[(a + 1) % n], end[0], end[1]));
    }
    if (switches == 4) { // two opposite corners: is the middle in contact?
      if (at[0] + at[1] + at[2] + at[3] < 2.0) {
        for (int a = 0; a < 4; ++a)
          if (closed(a)) {
            corner[0] = x_[a];
            corner[1] = between(a, (a + 1) % 4, at[a]);
            corner[2] = between(a, (a + 3) % 4, at[(a + 3) % 4]);
            zero_line += area_of(corner, 3);
          }
        return;
      }
    }
    int count = 0;
    for (int a = 0; a < n; ++a) {
      const int b = (a + 1) % n;
      if (closed(a)) corner[count++] = x_[a];
      if (closed(a) != closed(b)) corner[count++] = closed(a) ? between(a, b, at[a]) : between(b, a, at[a]);
    }
    zero_line += area_of(corner, count);
  }

  const SlaveFields& f_;
  int d_;
  std::int64_t node_[4] = {};
  Point x_[4] = {};
};

// The largest pressure, and by how much those of the neighbouring nodes are smaller in the mean.
void add_peak(const SlaveFields& f, const std::vector<double>& share, ContactArea& area) {
  std::int64_t peak = -1;
  for (std::int64_t i = 0; i < f.nodes; ++i)
    if (share[static_cast<std::size_t>(i)] > 0.0 && (peak < 0 || f.pressure[i] > f.pressure[peak])) peak = i;
  if (peak < 0 || !(f.pressure[peak] > 0.0)) return;
  area.peak_pressure = f.pressure[peak];
  double sum = 0.0;
  std::int64_t count = 0;
  const std::int64_t n = f.facet->nodes;
  for (std::int64_t i = 0; i < f.facets * n; ++i) {
    if (f.connectivity[i] != peak) continue;
    const std::int64_t first = i / n * n, a = i - first;
    for (std::int64_t k = 1; k < n; k += n == 4 ? 2 : 1) { // the ends of the edges that meet in the node
      const std::int64_t other = f.connectivity[first + (a + k) % n];
      if (other != peak) sum += std::max(0.0, f.pressure[other]), ++count; // of a collapsed side: itself
    }
  }
  area.peak_drop = area.peak_pressure - sum / static_cast<double>(count);
}

} // namespace

ContactArea estimate_contact_area(const SlaveFields& f, const std::vector<double>& share) {
  ContactArea out;
  AreaSum sum(f);
  for (std::int64_t i = 0; i < f.facets; ++i) sum.add(i);

  out.surface = sum.surface;
  for (std::int64_t i = 0; i < f.nodes; ++i)
    if (f.pressure[i] > 0.0) out.counted += share[static_cast<std::size_t>(i)];
  const bool line = f.facet->parameters == 1;
  constexpr double border_share = (std::numbers::pi - 1.0 + std::numbers::ln2) / 24.0;
  out.border_corrected = line ? out.counted : std::max(0.0, out.counted - border_share * sum.border);
  out.zero_line = f.modulus > 0.0 ? sum.zero_line : 0.0;
  if (f.modulus > 0.0) {
    out.estimate = line ? out.zero_line : 0.5 * (out.border_corrected + out.zero_line);
    // What the two differ by, half of what they change, and twice the scatter: the estimate has half of
    // that of the count.
    out.error =
        std::max(std::abs(out.border_corrected - out.zero_line), 0.5 * std::abs(out.counted - out.estimate)) +
        std::sqrt(sum.lattice_variance);
  } else {
    out.estimate = out.border_corrected;
    out.error =
        line ? 0.5 * sum.border : out.counted - out.border_corrected + 2.0 * std::sqrt(sum.lattice_variance);
  }
  add_peak(f, share, out);
  return out;
}

} // namespace ents
