// SPDX-License-Identifier: BSD-3-Clause
#include "elastic_layer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "error.hpp"

namespace host {
namespace {

constexpr double pi = std::numbers::pi;

/// [cells][modes] cos(pi m (i + 1/2) / n), orthonormal: they have no slope at the sides.
Eigen::MatrixXd cosines(Eigen::Index n) {
  Eigen::MatrixXd modes(n, n);
  for (Eigen::Index m = 0; m < n; ++m)
    for (Eigen::Index i = 0; i < n; ++i)
      modes(i, m) =
          std::sqrt((m == 0 ? 1. : 2.) / static_cast<double>(n)) *
          std::cos(pi * static_cast<double>(m) * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
  return modes;
}

/// Pairs of neighbouring cells of which one is in contact, times the area of a cell, over that of the layer.
double border_share(const Eigen::ArrayXXd& pressure) {
  Eigen::Index switches = 0;
  const auto closed = [&](Eigen::Index i, Eigen::Index j) { return pressure(i, j) > 0; };
  for (Eigen::Index j = 0; j < pressure.cols(); ++j)
    for (Eigen::Index i = 0; i < pressure.rows(); ++i) {
      if (i + 1 < pressure.rows()) switches += closed(i, j) != closed(i + 1, j) ? 1 : 0;
      if (j + 1 < pressure.cols()) switches += closed(i, j) != closed(i, j + 1) ? 1 : 0;
    }
  return static_cast<double>(switches) / static_cast<double>(pressure.size());
}

LayerContact describe(Eigen::ArrayXXd pressure, int iterations) {
  LayerContact contact;
  contact.mean_pressure = pressure.mean();
  contact.peak_pressure = pressure.maxCoeff();
  contact.fraction_counted = (pressure > 0).cast<double>().mean();
  contact.fraction = contact.fraction_counted - (pi - 1 + std::numbers::ln2) / 24 * border_share(pressure);
  contact.iterations = iterations;
  contact.pressure = std::move(pressure);
  return contact;
}

} // namespace

double layer_compliance(double k, double thickness, const Material& material) {
  const double nu = material.poisson, s = k * thickness;
  if (s == 0) return thickness * (1 + nu) * (1 - 2 * nu) / (material.young * (1 - nu)); // no lateral strain
  const double half_space = 2 / (material.contact_modulus() * k);
  if (s > 100) return half_space;
  const double c = 3 - 4 * nu;
  return half_space * (c * std::sinh(2 * s) - 2 * s) /
         (c * std::cosh(2 * s) + 2 * s * s + 5 - 12 * nu + 8 * nu * nu);
}

ElasticLayer::ElasticLayer(Eigen::Index nx, Eigen::Index ny, double lx, double ly, double thickness,
                           const Material& material)
    : lx_(lx), ly_(ly), modes_x_(cosines(nx)), modes_y_(cosines(ny)), compliance_(nx, ny) {
  for (Eigen::Index j = 0; j < ny; ++j)
    for (Eigen::Index i = 0; i < nx; ++i)
      compliance_(i, j) = layer_compliance(
          pi * std::hypot(static_cast<double>(i) / lx, static_cast<double>(j) / ly), thickness, material);
}

Eigen::ArrayXXd ElasticLayer::displacement(const Eigen::ArrayXXd& pressure) const {
  const Eigen::MatrixXd spectrum = modes_x_.transpose() * pressure.matrix() * modes_y_;
  return modes_x_ * (compliance_ * spectrum.array()).matrix() * modes_y_.transpose();
}

LayerContact ElasticLayer::press(const Eigen::ArrayXXd& gap) const {
  const double overlap = -gap.minCoeff();
  if (overlap <= 0) return describe(Eigen::ArrayXXd::Zero(gap.rows(), gap.cols()), 0);
  constexpr int most = 20000;
  constexpr double enough = 1e-8; // of the overlap
  Eigen::ArrayXXd p = (-gap).max(0.) / compliance_(0, 0), t = Eigen::ArrayXXd::Zero(gap.rows(), gap.cols());
  double before = 1, keep = 0;
  for (int iteration = 1; iteration <= most; ++iteration) {
    const Eigen::ArrayXXd g = gap + displacement(p);
    const Eigen::ArrayXXd in = (p > 0).cast<double>();
    const double largest = (in * g.abs()).maxCoeff(), deepest = -((1 - in) * g).minCoeff();
    if (std::max(largest, deepest) <= enough * overlap) return describe(std::move(p), iteration);
    const double squared = (in * g * g).sum();
    t = in * (g + keep * squared / before * t);
    before = squared;
    const double step = (g * t).sum() / (displacement(t) * t).sum();
    p = (p - step * t).max(0.);
    const Eigen::ArrayXXd overlapping = ((p <= 0) && (g < 0)).cast<double>();
    keep = overlapping.sum() > 0 ? 0 : 1;
    p -= step * overlapping * g;
  }
  throw JobError("boundary elements: no convergence in " + std::to_string(most) + " iterations");
}

} // namespace host
