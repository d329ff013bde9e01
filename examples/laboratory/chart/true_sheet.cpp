// SPDX-License-Identifier: BSD-3-Clause
#include "chart/true_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace host::chart {

TrueSheet::Height2 TrueSheet::at(double x, double y) const {
  const double k = 2 * std::numbers::pi * waves_;
  const double sx = std::sin(k * x), cx = std::cos(k * x), sy = std::sin(k * y), cy = std::cos(k * y);
  const double a = amplitude_, h = a * sx * sy;
  return {h, {a * k * cx * sy, a * k * sx * cy}, {-k * k * h, -k * k * h, a * k * k * cx * cy}};
}

Pair TrueSheet::pair(const Vec& slave, double x, double y) const {
  const Height2 f = at(x, y);
  Eigen::Matrix<double, 3, 2> tangents;
  tangents << 1, 0, 0, 1, f.slope[0], f.slope[1];
  const double size = std::sqrt(1 + f.slope[0] * f.slope[0] + f.slope[1] * f.slope[1]);
  const Eigen::Vector3d n = Eigen::Vector3d(-f.slope[0], -f.slope[1], 1) / size;
  Eigen::Matrix2d second;
  second << f.second[0], f.second[2], f.second[2], f.second[1];
  Pair out;
  out.piece = 0, out.v[0] = x, out.v[1] = y;
  if (projection_ == ProjectionKind::shadow) { // g = z - h
    out.gap = slave[2] - f.h;
    out.gradient = n * size;
    out.hessian = Mat::Zero(3, 3);
    out.hessian.topLeftCorner(2, 2) = -second;
    return out;
  }
  out.gap = (slave[0] - x) * n[0] + (slave[1] - y) * n[1] + (slave[2] - f.h) * n[2];
  out.gradient = n;
  // d2g = -rho_e,a [(A - g H)^-1 H A^-1]_ab rho_e,b
  const Eigen::Matrix2d A = tangents.transpose() * tangents, H = second / size;
  const Eigen::Matrix2d rate = (A - out.gap * H).inverse() * H * A.inverse();
  const Eigen::Matrix3d hessian = -tangents * (0.5 * (rate + rate.transpose())) * tangents.transpose();
  out.hessian = hessian;
  if (!out.hessian.allFinite()) out.hessian = Mat::Zero(3, 3);
  return out;
}

/// The local minimum of F = |x_s - rho_e|^2 / 2 downhill from (x, y), in short steps.
Pair TrueSheet::descend(const Vec& slave, double x, double y) const {
  const double longest = 0.02 / waves_;
  const auto value = [&](double u, double v) {
    return 0.5 * (std::pow(slave[0] - u, 2) + std::pow(slave[1] - v, 2) + std::pow(slave[2] - at(u, v).h, 2));
  };
  for (int i = 0; i < 1000; ++i) {
    const Height2 f = at(x, y);
    const double off = f.h - slave[2];
    const Eigen::Vector2d gradient(x - slave[0] + off * f.slope[0], y - slave[1] + off * f.slope[1]);
    Eigen::Matrix2d hessian;
    const double mixed = f.slope[0] * f.slope[1] + off * f.second[2];
    hessian << 1 + f.slope[0] * f.slope[0] + off * f.second[0], mixed, mixed,
        1 + f.slope[1] * f.slope[1] + off * f.second[1];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> spectrum(hessian);
    Eigen::Vector2d step = Eigen::Vector2d::Zero();
    for (Eigen::Index k = 0; k < 2; ++k) {
      const Eigen::Vector2d mode = spectrum.eigenvectors().col(k);
      step -= mode * (mode.dot(gradient) / std::max(std::abs(spectrum.eigenvalues()[k]), 0.05));
    }
    if (step.norm() < 1e-15) break;
    if (step.norm() > longest) step *= longest / step.norm();
    const double before = value(x, y);
    int halving = 0;
    while (value(x + step[0], y + step[1]) > before * (1 + 1e-15) && ++halving < 50) step *= 0.5;
    if (halving == 50) break;
    x += step[0], y += step[1];
  }
  return pair(slave, x, y);
}

Pair TrueSheet::closest(const Vec& slave) const {
  if (projection_ == ProjectionKind::shadow) return pair(slave, slave[0], slave[1]);
  // no point is closer than the one below or above unless it lies within that distance
  const double radius = std::abs(slave[2] - at(slave[0], slave[1]).h), spacing = 1 / (32 * waves_);
  const int count = static_cast<int>(std::ceil(radius / spacing)) + 1;
  const auto square = [&](int i, int j) {
    const double u = slave[0] + i * spacing, v = slave[1] + j * spacing;
    return std::pow(u - slave[0], 2) + std::pow(v - slave[1], 2) + std::pow(slave[2] - at(u, v).h, 2);
  };
  Pair best;
  for (int i = -count; i <= count; ++i)
    for (int j = -count; j <= count; ++j) { // samples that are closer than their neighbours
      const double here = square(i, j);
      if (square(i - 1, j) < here || square(i + 1, j) < here || square(i, j - 1) < here ||
          square(i, j + 1) < here)
        continue;
      const Pair candidate = descend(slave, slave[0] + i * spacing, slave[1] + j * spacing);
      if (best.piece < 0 || std::abs(candidate.gap) < std::abs(best.gap)) best = candidate;
    }
  return best.piece < 0 ? descend(slave, slave[0], slave[1]) : best;
}

Pair TrueSheet::follow(const Vec& slave, const Pair& before) const {
  return projection_ == ProjectionKind::shadow ? closest(slave) : descend(slave, before.v[0], before.v[1]);
}

Press make_press_in_space(double amplitude, double waves, const Method& method) {
  constexpr int along = 4, across = 2;
  const bool smooth = method.surface == SurfaceKind::c2;
  Press press;
  press.dimension = 3;
  press.method = method;
  press.row.segment = smooth ? "bspline16" : "quad4";
  press.row.nodes_per_segment = smooth ? 16 : 4;
  // one ring of nodes more, which only the smoothed segments see
  for (int j = -1; j <= across + 1; ++j)
    for (int i = -1; i <= along + 1; ++i)
      press.row.positions.insert(press.row.positions.end(), {i - 0.5 * along, j - 0.5 * across, 0});
  constexpr int corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < along; ++i)
      for (int a = 0; a < press.row.nodes_per_segment; ++a) {
        const int x = i + (smooth ? a % 4 - 1 : corner[a][0]), y = j + (smooth ? a / 4 - 1 : corner[a][1]);
        press.row.connectivity.push_back((y + 1) * (along + 3) + x + 1);
        press.row.surface_coordinates.insert(press.row.surface_coordinates.end(),
                                             {x - 0.5 * along, y - 0.5 * across});
      }
  const auto sine = [](double size, double kx, double ky) {
    return Json{{"type", "sine"}, {"amplitude", size}, {"wave_vector", {kx, ky}}};
  };
  press.height = {{"type", "product"}, {"of", {sine(amplitude, waves, 0), sine(1, 0, waves)}}};
  press.local = method.surface == SurfaceKind::local;
  press.wavelength = 1 / waves;
  press.from = -0.83, press.to = 1.27;
  press.slant = 0.31;
  press.above = amplitude + 0.02, press.below = -0.05;
  press.truth = std::make_shared<TrueSheet>(amplitude, waves, method.projection);
  return press;
}

} // namespace host::chart
