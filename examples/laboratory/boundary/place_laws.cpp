// SPDX-License-Identifier: BSD-3-Clause
#include "place_laws.hpp"

#include <algorithm>
#include <cmath>

namespace host {
namespace {

constexpr int most_springs = 6;
// A place in full contact is as stiff as this times E* over the distance of the points; the body itself has
// pi / 2 at the shortest wave that it can follow.
constexpr double stiffest = 30;
constexpr double rounded = 0.25; // half the width in which a spring begins, of the next one's distance

/// [x + 1][y + 1]
Eigen::ArrayXXd summed(const Eigen::ArrayXXd& field) {
  Eigen::ArrayXXd sums = Eigen::ArrayXXd::Zero(field.rows() + 1, field.cols() + 1);
  for (Eigen::Index j = 0; j < field.cols(); ++j)
    for (Eigen::Index i = 0; i < field.rows(); ++i)
      sums(i + 1, j + 1) = field(i, j) + sums(i, j + 1) + sums(i + 1, j) - sums(i, j);
  return sums;
}

/// Slopes that rise from the first contact on: where one falls, its part and the one before become one.
void make_convex(PlaceCurve& curve) {
  struct Part {
    double gap, pressure;
    double slope() const { return pressure / gap; }
  };
  std::vector<Part> parts;
  for (std::size_t k = 1; k < curve.gap.size(); ++k) {
    parts.push_back({curve.gap[k - 1] - curve.gap[k], curve.pressure[k] - curve.pressure[k - 1]});
    while (parts.size() > 1 && parts.back().slope() < parts[parts.size() - 2].slope()) {
      const Part last = parts.back();
      parts.pop_back();
      parts.back().gap += last.gap, parts.back().pressure += last.pressure;
    }
  }
  curve.gap.resize(1), curve.pressure.resize(1);
  for (const Part& part : parts) {
    curve.gap.push_back(curve.gap.back() - part.gap);
    curve.pressure.push_back(curve.pressure.back() + part.pressure);
  }
}

/// Leave out the points that a straight line replaces best, relative to the pressure.
void simplify(PlaceCurve& curve) {
  while (curve.gap.size() > most_springs + 1) {
    std::size_t least = 1;
    double error = -1;
    for (std::size_t k = 1; k + 1 < curve.gap.size(); ++k) {
      const double part = (curve.gap[k] - curve.gap[k - 1]) / (curve.gap[k + 1] - curve.gap[k - 1]);
      const double line = curve.pressure[k - 1] + part * (curve.pressure[k + 1] - curve.pressure[k - 1]);
      const double off = (line - curve.pressure[k]) / curve.pressure[k];
      if (error < 0 || off < error) error = off, least = k;
    }
    curve.gap.erase(curve.gap.begin() + static_cast<std::ptrdiff_t>(least));
    curve.pressure.erase(curve.pressure.begin() + static_cast<std::ptrdiff_t>(least));
  }
}

} // namespace

PlaceLaws::PlaceLaws(WaveLaw law, const ElasticLayer& half_space, std::array<double, 2> low, double modulus,
                     double hx, double hy)
    : law_(std::move(law)), layer_(half_space), low_(low), hx_(hx), hy_(hy),
      stiffest_(stiffest * modulus / std::max(hx, hy)) {
  for (const WaveLevel& level : law_) {
    const Eigen::ArrayXXd pressed = level.pressed.cast<double>();
    pressed_.push_back(summed(pressed));
    closed_.push_back(summed((pressed > 0).cast<double>() * (level.share / level.counted)));
    moved_.push_back(layer_.displacement_of_boxes(pressed / modulus, hx, hy));
  }
}

double PlaceLaws::mean(const Eigen::ArrayXXd& sums, double x, double y) const {
  const double nx = static_cast<double>(sums.rows() - 1), ny = static_cast<double>(sums.cols() - 1);
  const auto line = [](double place, double length, double cells) {
    return std::clamp(place / length * cells, 0., cells);
  };
  const double x0 = line(x - low_[0] - hx_ / 2, layer_.length_x(), nx),
               x1 = line(x - low_[0] + hx_ / 2, layer_.length_x(), nx),
               y0 = line(y - low_[1] - hy_ / 2, layer_.length_y(), ny),
               y1 = line(y - low_[1] + hy_ / 2, layer_.length_y(), ny);
  const auto sum = [&](double u, double v) { // bilinear: exact for a field that is constant in each cell
    const auto i = std::min(static_cast<Eigen::Index>(u), sums.rows() - 2),
               j = std::min(static_cast<Eigen::Index>(v), sums.cols() - 2);
    const double a = u - static_cast<double>(i), b = v - static_cast<double>(j);
    return (1 - a) * ((1 - b) * sums(i, j) + b * sums(i, j + 1)) +
           a * ((1 - b) * sums(i + 1, j) + b * sums(i + 1, j + 1));
  };
  return (sum(x1, y1) - sum(x0, y1) - sum(x1, y0) + sum(x0, y0)) / ((x1 - x0) * (y1 - y0));
}

PlaceCurve PlaceLaws::curve(double x, double y) const {
  struct Point {
    double gap, pressure;
  };
  std::vector<Point> points; // by rising pressure
  double open = 0, rounding = 1e-9 * law_.front().pressure;
  bool opens = false;
  for (std::size_t level = law_.size(); level-- > 0;) {
    const double p = mean(pressed_[level], x, y),
                 g = law_[level].gap + layer_.between(moved_[level], x - low_[0], y - low_[1]);
    if (!(p > rounding))
      open = opens ? std::min(open, g) : g, opens = true;
    else if (points.empty() || (p > points.back().pressure && g < points.back().gap))
      points.push_back({g, p});
  }
  PlaceCurve curve;
  if (points.empty()) return curve;
  // Contact begins half way to the last level without, or where the straight line through the first two ends.
  double begin = points[0].gap;
  if (opens && open > begin)
    begin += (open - begin) / 2;
  else if (points.size() > 1)
    begin += points[0].pressure * (points[0].gap - points[1].gap) / (points[1].pressure - points[0].pressure);
  else
    begin += points[0].pressure / stiffest_;
  begin = std::max(begin, points[0].gap + points[0].pressure / stiffest_);
  curve.gap.push_back(begin), curve.pressure.push_back(0);
  for (const Point& point : points) { // no stiffer than full contact
    const double g =
        std::min(point.gap, curve.gap.back() - (point.pressure - curve.pressure.back()) / stiffest_);
    curve.gap.push_back(g), curve.pressure.push_back(point.pressure);
  }
  make_convex(curve);
  simplify(curve);
  const std::size_t n = curve.gap.size();
  curve.after = (curve.pressure[n - 1] - curve.pressure[n - 2]) / (curve.gap[n - 2] - curve.gap[n - 1]);
  return curve;
}

double PlaceLaws::share(double x, double y, double pressure) const {
  double p = 0, part = 0;
  if (!(pressure > 0)) return 0;
  for (std::size_t level = law_.size(); level-- > 0;) { // between two levels a power of the pressure
    const double next = mean(pressed_[level], x, y), in = mean(closed_[level], x, y);
    if (!(next > p)) continue;
    if (pressure <= next)
      return p > 0 && part > 0 && in > 0
                 ? part * std::pow(in / part, std::log(pressure / p) / std::log(next / p))
                 : in * pressure / next;
    p = next, part = in;
  }
  return part;
}

SlavePoints PlaceLaws::springs(const SlavePoints& points, const Mesh& mesh) const {
  SlavePoints springs;
  springs.nodes_per_point = points.nodes_per_point;
  const auto add = [&](std::size_t place, double share, double offset, double scale) {
    for (std::size_t a = place * points.nodes_per_point; a < (place + 1) * points.nodes_per_point; ++a)
      springs.nodes.push_back(points.nodes[a]), springs.weights.push_back(points.weights[a]);
    springs.areas.push_back(share * points.areas[place]);
    springs.offsets.push_back(offset), springs.scales.push_back(scale);
  };
  const double never = 1e3 * (layer_.length_x() + layer_.length_y());
  for (std::size_t k = 0; k < points.size(); ++k) {
    springs.places.push_back(springs.size());
    const auto place = points.place(k, mesh);
    const PlaceCurve at = curve(place[0], place[1]);
    double stiffness = 0;
    for (std::size_t j = 0; j + 1 < at.gap.size(); ++j) {
      const double length = at.gap[j] - at.gap[j + 1], slope = (at.pressure[j + 1] - at.pressure[j]) / length,
                   before = j == 0 ? length : std::min(length, at.gap[j - 1] - at.gap[j]);
      if (slope > stiffness * (1 + 1e-9))
        add(k, (slope - stiffness) / stiffest_, -at.gap[j], rounded * before);
      stiffness = std::max(stiffness, slope);
    }
    // What is left of the area has no spring.
    const double rest = 1 - stiffness / stiffest_;
    if (rest > 1e-9) add(k, rest, never, 1);
  }
  springs.places.push_back(springs.size());
  return springs;
}

// A straight line from gap -1 on; it begins at gap 1.
Json PlaceLaws::contact() const {
  std::vector<double> gap{-4, -3, -2, -1, 0, 1}, pressure{4, 3, 2, 1, 0.25, 0};
  for (double& p : pressure) p *= stiffest_;
  return {{"normal", {{"type", "table"}, {"gap", gap}, {"pressure", pressure}}}, {"offset", 0}};
}

} // namespace host
