// SPDX-License-Identifier: BSD-3-Clause
#include "chart/true_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace host::chart {
namespace {

using Eigen::Vector2d;

Vector2d turned(const Vector2d& v) { return {-v[1], v[0]}; }

/// Values, first and second derivatives at v of the four functions of a uniform cubic segment between its
/// second and third point.
using Functions = std::array<std::array<double, 4>, 3>;

Functions b_spline(double v) {
  const double w = 1 - v;
  return {{{w * w * w / 6, (3 * v * v * v - 6 * v * v + 4) / 6, (3 * w * w * w - 6 * w * w + 4) / 6,
            v * v * v / 6},
           {-w * w / 2, (3 * v * v - 4 * v) / 2, (4 * w - 3 * w * w) / 2, v * v / 2},
           {w, 3 * v - 2, 3 * w - 2, v}}};
}

/// Hermite's segment with the slopes (p_{i+1} - p_{i-1}) / 2.
Functions catmull_rom(double v) {
  const double v2 = v * v, v3 = v2 * v;
  const std::array<std::array<double, 4>, 3> hermite{
      {// p1, p2, slope at p1, slope at p2
       {2 * v3 - 3 * v2 + 1, -2 * v3 + 3 * v2, v3 - 2 * v2 + v, v3 - v2},
       {6 * v2 - 6 * v, -6 * v2 + 6 * v, 3 * v2 - 4 * v + 1, 3 * v2 - 2 * v},
       {12 * v - 6, -12 * v + 6, 6 * v - 4, 6 * v - 2}}};
  Functions out{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& f = hermite[k];
    out[k] = {-f[2] / 2, f[0] - f[3] / 2, f[1] + f[2] / 2, f[3] / 2};
  }
  return out;
}

} // namespace

TrueCurve::TrueCurve(const Profile& profile, ProjectionKind projection, double border)
    : surface_(profile.surface), projection_(projection), border_(border), height_(profile.height) {
  if (surface_ == SurfaceKind::plain) {
    const SegmentRow row = make_row(profile);
    for (std::size_t i = 0; i < row.positions.size(); i += 2)
      nodes_.emplace_back(row.positions[i], row.positions[i + 1]);
    pieces_ = static_cast<int>(nodes_.size()) - 1;
  } else {
    for (int i = -1; i <= profile.segments + 1; ++i) {
      const ArcPoint p = on_arc(profile.curvature, i - 0.5 * profile.segments, 0);
      nodes_.emplace_back(p.x, p.y);
    }
    pieces_ = profile.segments;
    samples_ = static_cast<int>(std::ceil(48 / profile.wavelength)); // 48 a wave
    stride_ = 0.02 * profile.wavelength;
  }
  for (int k = 0; k < pieces_; ++k)
    for (int i = 0; i <= samples_; ++i) sampled_.push_back(at(k, static_cast<double>(i) / samples_).point);
  for (std::size_t i = 0; i + 1 < sampled_.size(); ++i)
    spacing_ = std::max(spacing_, (sampled_[i + 1] - sampled_[i]).norm());
}

TrueCurve::Place TrueCurve::at(int piece, double v) const {
  const auto p = nodes_.begin() + piece;
  if (surface_ == SurfaceKind::plain) return {p[0] + v * (p[1] - p[0]), p[1] - p[0]};
  Vector2d rho = Vector2d::Zero(), first = rho, second = rho;
  if (surface_ == SurfaceKind::local) {
    rho = p[1] + v * (p[2] - p[1]);
    first = p[2] - p[1];
  } else {
    const Functions f = surface_ == SurfaceKind::c1 ? catmull_rom(v) : b_spline(v);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector2d& node = p[static_cast<std::ptrdiff_t>(i)];
      rho += f[0][i] * node;
      first += f[1][i] * node;
      second += f[2][i] * node;
    }
  }
  // all bases reproduce s = number of the segment + v
  const double s = piece - 0.5 * pieces_ + v, h = height_.value(s), slope = height_.slope(s);
  const double length = first.norm();
  const Vector2d n = turned(first) / length;
  const Vector2d turning = (turned(second) - n * n.dot(turned(second))) / length;
  return {rho + h * n, first + slope * n + h * turning};
}

bool TrueCurve::descend(const Vector2d& slave, int piece, double& v, double border) const {
  if (surface_ == SurfaceKind::plain) {
    const Place facet = at(piece, 0);
    v = (slave - facet.point).dot(facet.tangent) / facet.tangent.squaredNorm();
    return v >= -border && v <= 1 + border;
  }
  // F = |x - rho_e|^2 / 2, F' = -(x - rho_e) . rho_e'; F'' from a difference: it sets the pace, not the place
  const auto slope = [&](double u) {
    const Place place = at(piece, u);
    return (place.point - slave).dot(place.tangent);
  };
  double f = slope(v);
  for (int i = 0; i < 500; ++i) {
    constexpr double e = 1e-6;
    const double curvature = (slope(v + e) - slope(v - e)) / (2 * e);
    double step = curvature > 0 ? -f / curvature : (f > 0 ? -stride_ : stride_);
    step = std::clamp(step, -stride_, stride_);
    const double before = f;
    v += step;
    f = slope(v);
    if (v < -border - stride_ || v > 1 + border + stride_) return false;
    if (std::abs(step) < 1e-13) break;
    if (f * before < 0) { // the minimum lies between: halve until it is found
      double low = v - step, high = v;
      for (int k = 0; k < 60 && std::abs(high - low) > 1e-14; ++k) {
        const double middle = 0.5 * (low + high), g = slope(middle);
        (g * before > 0 ? low : high) = middle;
      }
      v = 0.5 * (low + high);
      break;
    }
  }
  return v >= -border && v <= 1 + border;
}

bool TrueCurve::cross(const Vector2d& slave, int piece, double& v, double border) const {
  double best = INFINITY, found = v;
  for (int i = border > 0 ? -1 : 0; i < samples_ + (border > 0 ? 1 : 0); ++i) {
    const auto place = [&](int j) {
      return j < 0 ? -border : j > samples_ ? 1 + border : static_cast<double>(j) / samples_;
    };
    const auto off = [&](int j) {
      const bool inside = j >= 0 && j <= samples_;
      return (inside ? sampled_[static_cast<std::size_t>(piece * (samples_ + 1) + j)]
                     : at(piece, place(j)).point)[0] -
             slave[0];
    };
    double low = place(i), high = place(i + 1);
    const double left = off(i);
    if (left * off(i + 1) > 0) continue;
    for (int halving = 0; halving < 60 && high - low > 1e-15; ++halving) {
      const double middle = 0.5 * (low + high);
      ((at(piece, middle).point[0] - slave[0]) * left > 0 ? low : high) = middle;
    }
    const double root = 0.5 * (low + high);
    if (std::abs(root - v) < best) best = std::abs(root - v), found = root;
  }
  v = found;
  return best < INFINITY;
}

Pair TrueCurve::pair(const Vector2d& slave, int piece, double v) const {
  Pair out;
  out.piece = piece, out.v[0] = v;
  const Place place = at(piece, v);
  const double length = place.tangent.norm();
  const Vector2d t = place.tangent / length, n = turned(t);
  const double gap = (slave - place.point).dot(n);
  double curvature = 0; // n . d2 rho_e / ds2
  if (surface_ != SurfaceKind::plain) {
    constexpr double e = 1e-5;
    curvature = n.dot(at(piece, v + e).tangent - at(piece, v - e).tangent) / (2 * e * length * length);
  }
  if (projection_ == ProjectionKind::normal) {
    out.gap = gap;
    out.gradient = n;
    const double rate = 1 - gap * curvature;
    out.hessian = -curvature / (std::abs(rate) > 1e-3 ? rate : 1e-3) * t * t.transpose();
  } else { // y = f(x): g = y - f
    out.gap = slave[1] - place.point[1];
    out.gradient = n / n[1];
    out.hessian = Mat::Zero(2, 2);
    out.hessian(0, 0) = -curvature / (n[1] * n[1] * n[1]);
  }
  return out;
}

Pair TrueCurve::corner(const Vector2d& slave, int piece, double v) const {
  const Place here = at(piece, v);
  Vector2d n = turned(here.tangent).normalized();
  const int beside = v < 0.5 ? piece - 1 : piece + 1;
  if (beside >= 0 && beside < pieces_) n += turned(at(beside, 1 - v).tangent).normalized();
  Pair out;
  out.piece = piece, out.v[0] = v, out.corner = true;
  const Vector2d off = slave - here.point;
  const double distance = std::max(off.norm(), 1e-300);
  out.gap = off.dot(n) < 0 ? -distance : distance;
  const Vector2d gradient = off / out.gap;
  out.gradient = gradient;
  out.hessian = (Eigen::Matrix2d::Identity() - gradient * gradient.transpose()) / out.gap;
  return out;
}

Pair TrueCurve::closest(const Vec& slave) const {
  const Vector2d x = slave.head<2>();
  if (projection_ == ProjectionKind::shadow) {
    Pair lit;
    for (int k = 0; k < pieces_; ++k)
      for (int i = 0; i < samples_; ++i) {
        const auto p = static_cast<std::size_t>(k * (samples_ + 1) + i);
        if ((sampled_[p][0] - x[0]) * (sampled_[p + 1][0] - x[0]) > 0) continue;
        double v = (i + 0.5) / samples_;
        if (!cross(x, k, v, 0)) continue;
        const Pair candidate = pair(x, k, v);
        if (candidate.gradient[1] > 0 && (lit.piece < 0 || candidate.gap < lit.gap)) lit = candidate;
      }
    return lit;
  }
  // every sample that is closer than its neighbours starts a descent
  Pair best;
  double rank = INFINITY; // what lies beyond the end of its piece counts as farther
  const auto better = [&](const Pair& candidate) {
    const double beyond = std::max({0., -candidate.v[0], candidate.v[0] - 1});
    const double own = std::abs(candidate.gap) + beyond * at(candidate.piece, candidate.v[0]).tangent.norm();
    if (own < rank) rank = own, best = candidate;
  };
  const auto count = sampled_.size();
  const auto square = [&](std::size_t i) { return (sampled_[i] - x).squaredNorm(); };
  double least = INFINITY;
  for (std::size_t i = 0; i < count; ++i) least = std::min(least, square(i));
  const double limit = std::pow(std::sqrt(least) + spacing_, 2);
  for (std::size_t i = 0; i < count; ++i) {
    const double here = square(i);
    if (here > limit) continue;
    const int piece = static_cast<int>(i) / (samples_ + 1), k = static_cast<int>(i) % (samples_ + 1);
    if (samples_ > 1 && ((k > 0 && square(i - 1) < here) || (k < samples_ && square(i + 1) < here))) continue;
    double v = static_cast<double>(k) / samples_;
    if (descend(x, piece, v, 0)) better(pair(x, piece, v));
  }
  for (std::size_t i = 0; i < count; ++i) // corners: ends of pieces
    if (const int k = static_cast<int>(i) % (samples_ + 1); k == 0 || k == samples_)
      if (square(i) < limit && (best.piece < 0 || square(i) < best.gap * best.gap * (1 - 1e-9)))
        better(corner(x, static_cast<int>(i) / (samples_ + 1), k == 0 ? 0 : 1));
  return best;
}

bool TrueCurve::valley(int piece, int end) const {
  const int left = end == 0 ? piece - 1 : piece, right = left + 1;
  if (left < 0 || right >= pieces_) return false;
  return turned(at(left, 1).tangent).dot(at(right, 0).tangent) > 0;
}

Pair TrueCurve::follow(const Vec& slave, const Pair& before) const {
  const Vector2d x = slave.head<2>();
  double v = before.v[0];
  const bool found = projection_ == ProjectionKind::shadow
                         ? cross(x, before.piece, v, border_)
                         : !before.corner && descend(x, before.piece, v, border_);
  if (!found || (v < 0 && valley(before.piece, 0)) || (v > 1 && valley(before.piece, 1)))
    return closest(slave);
  return pair(x, before.piece, v);
}

Kink TrueCurve::kink(const Pair& pair_here) const {
  const int end = pair_here.v[0] < 0.5 ? 0 : 1;
  // with the normal projection the distance from the corner makes a valley smooth
  if (border_ == 0 || projection_ == ProjectionKind::normal || !valley(pair_here.piece, end)) return {};
  Kink out;
  out.found = true;
  const Vector2d point = at(pair_here.piece, end).point;
  out.point = point;
  out.gradient[0] = pair(point, pair_here.piece, end).gradient;
  out.gradient[1] = pair(point, pair_here.piece + (end == 0 ? -1 : 1), 1 - end).gradient;
  return out;
}

double TrueCurve::end_zone(const Pair& pair_here) const {
  const double v = pair_here.v[0], inside = std::min(v, 1 - v);
  if (inside > border_ && !pair_here.corner) return 0;
  return border_ * at(pair_here.piece, v < 0.5 ? 0 : 1).tangent.norm();
}

} // namespace host::chart
