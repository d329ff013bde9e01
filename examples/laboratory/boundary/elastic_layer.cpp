// SPDX-License-Identifier: BSD-3-Clause
#include "elastic_layer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "toolbox/error.hpp"

namespace host {
namespace {

using std::numbers::pi;

/// Pairs of neighbouring cells of which one is in contact, times the area of a cell, over that of the layer.
double border_share(const Eigen::ArrayXXd& pressure, bool periodic) {
  Eigen::Index switches = 0;
  const Eigen::Index nx = pressure.rows(), ny = pressure.cols();
  const auto closed = [&](Eigen::Index i, Eigen::Index j) { return pressure(i % nx, j % ny) > 0; };
  for (Eigen::Index j = 0; j < ny; ++j)
    for (Eigen::Index i = 0; i < nx; ++i) {
      if (i + 1 < nx || periodic) switches += closed(i, j) != closed(i + 1, j) ? 1 : 0;
      if (j + 1 < ny || periodic) switches += closed(i, j) != closed(i, j + 1) ? 1 : 0;
    }
  return static_cast<double>(switches) / static_cast<double>(pressure.size());
}

constexpr int most_iterations = 20000;
constexpr double enough_overlap = 1e-8; // of the overlap

[[noreturn]] void no_convergence() {
  throw JobError("boundary elements: no convergence in " + std::to_string(most_iterations) + " iterations");
}

} // namespace

double layer_compliance(double k, double thickness, const Material& material) {
  const double nu = material.poisson, s = k * thickness;
  if (k == 0 && !std::isfinite(thickness)) return 0;
  if (s == 0) return thickness * (1 + nu) * (1 - 2 * nu) / (material.young * (1 - nu)); // no lateral strain
  const double half_space = 2 / (material.contact_modulus() * k);
  if (s > 100) return half_space;
  const double c = 3 - 4 * nu;
  return half_space * (c * std::sinh(2 * s) - 2 * s) /
         (c * std::cosh(2 * s) + 2 * s * s + 5 - 12 * nu + 8 * nu * nu);
}

ElasticLayer::ElasticLayer(Eigen::Index nx, Eigen::Index ny, double lx, double ly, double thickness,
                           const Material& material, Grid grid)
    : lx_(lx), ly_(ly), grid_(grid), periodic_(grid == Grid::periodic), transform_(grid, nx, ny),
      wave_number_(nx, ny), compliance_(nx, ny) {
  for (Eigen::Index j = 0; j < ny; ++j)
    for (Eigen::Index i = 0; i < nx; ++i) {
      wave_number_(i, j) =
          pi * std::hypot(transform_.half_waves(i, nx) / lx, transform_.half_waves(j, ny) / ly);
      compliance_(i, j) = layer_compliance(wave_number_(i, j), thickness, material);
    }
}

Eigen::ArrayXXd ElasticLayer::smoothed(const Eigen::ArrayXXd& field, double deviation) const {
  return transform_.filter(field, (-0.5 * (deviation * wave_number_).square()).exp());
}

Eigen::ArrayXXd ElasticLayer::displacement(const Eigen::ArrayXXd& pressure) const {
  return transform_.filter(pressure, compliance_);
}

Eigen::ArrayXXd ElasticLayer::displacement_of_boxes(const Eigen::ArrayXXd& pressure, double hx,
                                                    double hy) const {
  Eigen::ArrayXXd kept = compliance_;
  const auto mean = [](double k, double h) { return k > 0 ? std::sin(k * h / 2) / (k * h / 2) : 1.; };
  for (Eigen::Index j = 0; j < cells_y(); ++j)
    for (Eigen::Index i = 0; i < cells_x(); ++i) {
      const double kx = pi * transform_.half_waves(i, cells_x()) / lx_,
                   ky = pi * transform_.half_waves(j, cells_y()) / ly_;
      kept(i, j) *= kx * hx < pi && ky * hy < pi ? mean(kx, hx) * mean(ky, hy) : 0;
    }
  return transform_.filter(pressure, kept);
}

double ElasticLayer::between(const Eigen::ArrayXXd& field, double x, double y) const {
  const auto line = [](double place, double length, Eigen::Index cells) {
    const double at =
        std::clamp(place / length * static_cast<double>(cells) - 0.5, 0., static_cast<double>(cells - 1));
    const auto before = std::min(static_cast<Eigen::Index>(at), cells - 2);
    return std::pair(before, at - static_cast<double>(before));
  };
  const auto [i, u] = line(x, lx_, field.rows());
  const auto [j, v] = line(y, ly_, field.cols());
  return (1 - u) * ((1 - v) * field(i, j) + v * field(i, j + 1)) +
         u * ((1 - v) * field(i + 1, j) + v * field(i + 1, j + 1));
}

LayerContact ElasticLayer::describe(Eigen::ArrayXXd pressure, Eigen::ArrayXXd gap, int iterations) const {
  LayerContact contact;
  contact.mean_pressure = pressure.mean();
  contact.peak_pressure = pressure.maxCoeff();
  contact.fraction_counted = (pressure > 0).cast<double>().mean();
  contact.fraction =
      contact.fraction_counted - (pi - 1 + std::numbers::ln2) / 24 * border_share(pressure, periodic_);
  contact.iterations = iterations;
  contact.pressure = std::move(pressure);
  contact.gap = std::move(gap);
  return contact;
}

LayerContact ElasticLayer::press(const Eigen::ArrayXXd& gap, double softness) const {
  const double overlap = -gap.minCoeff();
  if (overlap <= 0) return describe(Eigen::ArrayXXd::Zero(gap.rows(), gap.cols()), gap, 0);
  Eigen::ArrayXXd p = (-gap).max(0.) / (compliance_(0, 0) + softness),
                  t = Eigen::ArrayXXd::Zero(gap.rows(), gap.cols());
  double before = 1, keep = 0;
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    const Eigen::ArrayXXd moved = gap + displacement(p), g = moved + softness * p;
    const Eigen::ArrayXXd in = (p > 0).cast<double>();
    const double largest = (in * g.abs()).maxCoeff(), deepest = -((1 - in) * g).minCoeff();
    if (std::max(largest, deepest) <= enough_overlap * overlap)
      return describe(std::move(p), moved, iteration);
    const double squared = (in * g * g).sum();
    t = in * (g + keep * squared / before * t);
    before = squared;
    const double step = (g * t).sum() / ((displacement(t) + softness * t) * t).sum();
    p = (p - step * t).max(0.);
    const Eigen::ArrayXXd overlapping = ((p <= 0) && (g < 0)).cast<double>();
    keep = overlapping.sum() > 0 ? 0 : 1;
    p -= step * overlapping * g;
  }
  no_convergence();
}

// The same with the approach as a further unknown: gaps are measured from their mean in contact, and the
// pressures are scaled to their sum after every step.
LayerContact ElasticLayer::press_with(double mean_pressure, const Eigen::ArrayXXd& gap, double softness,
                                      const Eigen::ArrayXXd* start, double enough) const {
  const double height = gap.maxCoeff() - gap.minCoeff();
  Eigen::ArrayXXd p = Eigen::ArrayXXd::Constant(gap.rows(), gap.cols(), mean_pressure),
                  t = Eigen::ArrayXXd::Zero(gap.rows(), gap.cols());
  if (start != nullptr) p = *start * (mean_pressure / start->mean());
  double before = 1, keep = 0;
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    const Eigen::ArrayXXd in = (p > 0).cast<double>();
    Eigen::ArrayXXd moved = gap + displacement(p), g = moved + softness * p;
    const double level = (in * g).sum() / in.sum();
    g -= level, moved -= level;
    const double largest = (in * g.abs()).maxCoeff(), deepest = -((1 - in) * g).minCoeff();
    if (std::max(largest, deepest) <= enough * height) return describe(std::move(p), moved, iteration);
    const double squared = (in * g * g).sum();
    t = in * (g + keep * squared / before * t);
    before = squared;
    Eigen::ArrayXXd image = displacement(t) + softness * t;
    image -= (in * image).sum() / in.sum();
    const double step = (g * t).sum() / (image * t).sum();
    p = (p - step * t).max(0.);
    const Eigen::ArrayXXd overlapping = ((p <= 0) && (g < 0)).cast<double>();
    keep = overlapping.sum() > 0 ? 0 : 1;
    p -= step * overlapping * g;
    p *= mean_pressure / p.mean();
  }
  no_convergence();
}

} // namespace host
