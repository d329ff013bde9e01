// SPDX-License-Identifier: BSD-3-Clause
#include "chart/judge.hpp"

#include <algorithm>
#include <cmath>

#include "spectrum.hpp"

namespace host::chart {
namespace {

double energy(const Press& press, const Vec& anchor, const Vec& x, const Pair& pair) {
  const double contact = pair.piece >= 0 && pair.gap < 0 ? press.penalty * pair.gap * pair.gap : 0;
  return 0.5 * ((x - anchor).dot(press.spring().cwiseProduct(x - anchor)) + contact);
}

Mat energy_hessian(const Press& press, const Pair& pair) {
  Mat hessian = press.spring().asDiagonal();
  if (pair.piece >= 0 && pair.gap < 0)
    hessian += press.penalty * (pair.gradient * pair.gradient.transpose() + pair.gap * pair.hessian);
  return hessian;
}

/// Newton's step with the curvatures' absolute values: downhill in every direction.
Vec downhill(const Mat& hessian, const Vec& gradient, double least) {
  const Spectrum spectrum = spectrum_of(hessian);
  Vec step = Vec::Zero(gradient.size());
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    const Vec mode = spectrum.vectors.col(i);
    step -= mode * (mode.dot(gradient) / std::max(std::abs(spectrum.values[i]), least));
  }
  return step;
}

/// An equilibrium in a kink: over its point, where the lateral forces of the two sides have opposite signs.
/// With the shadow projection the gap there is the height over the point.
bool settle_in_kink(const Press& press, const Vec& anchor, double longest, Vec& x, Pair& pair) {
  if (pair.piece < 0 || pair.gap >= 0) return false;
  const Kink kink = press.truth->kink(pair);
  const auto up = press.dimension - 1;
  if (!kink.found || std::abs(kink.point[0] - x[0]) > longest) return false;
  Vec place = kink.point;
  place[up] = (anchor[up] + press.penalty * kink.point[up]) / (1 + press.penalty);
  const double gap = place[up] - kink.point[up], spring = press.lateral * (place[0] - anchor[0]);
  const auto lateral = [&](int side) { return spring + press.penalty * gap * kink.gradient[side][0]; };
  if (!(gap < 0) || lateral(0) * lateral(1) > 0) return false;
  Pair there = pair;
  there.gap = gap, there.v[0] = pair.v[0] < 0.5 ? 0 : 1;
  if (energy(press, anchor, place, there) > energy(press, anchor, x, pair) * (1 + 1e-12)) return false;
  x = place, pair = there;
  return true;
}

/// From x downhill to the next equilibrium.
bool settle(const Press& press, const Vec& anchor, Vec& x, Pair& pair) {
  const double longest = 0.02 * press.wavelength;
  pair = press.truth->next(x, pair);
  const double size = press.lateral + press.penalty; // rounding: 1e-16 of positions of order 1, times this
  for (int iteration = 0; iteration < 2000; ++iteration) {
    const Vec gradient = energy_gradient(press, anchor, x, pair);
    const double residual = gradient.norm();
    if (residual < 1e-13 * size || settle_in_kink(press, anchor, longest, x, pair)) return true;
    Vec step = downhill(energy_hessian(press, pair), gradient, 0.02);
    if (step.norm() > longest) step *= longest / step.norm();
    const double before = energy(press, anchor, x, pair);
    bool accepted = false;
    for (int halving = 0; halving < 40 && !accepted; ++halving, step *= 0.5) {
      const Vec trial = x + step;
      const Pair at = press.truth->next(trial, pair);
      const double after = energy(press, anchor, trial, at);
      const bool lower = after < before + 1e-4 * gradient.dot(step);
      // where the energy no longer changes by more than rounding, its gradient still does
      const bool same = std::abs(after - before) < 1e-13 * before &&
                        energy_gradient(press, anchor, trial, at).norm() < 0.9 * residual;
      if (lower || same) x = trial, pair = at, accepted = true;
    }
    if (!accepted) return residual < 1e-9 * size;
  }
  return false;
}

} // namespace

Vec energy_gradient(const Press& press, const Vec& anchor, const Vec& x, const Pair& pair) {
  Vec gradient = press.spring().cwiseProduct(x - anchor);
  if (pair.piece >= 0 && pair.gap < 0) gradient += press.penalty * pair.gap * pair.gradient;
  return gradient;
}

Truth true_path(const Press& press, int steps) {
  Truth truth;
  Vec x = press.anchor(0);
  Pair pair = press.truth->closest(x);
  truth.position.push_back(x);
  truth.pair.push_back(pair);
  for (int i = 1; i <= steps; ++i) {
    if (!settle(press, press.anchor(static_cast<double>(i) / steps), x, pair)) return truth;
    truth.position.push_back(x);
    truth.pair.push_back(pair);
  }
  truth.complete = true;
  return truth;
}

} // namespace host::chart
