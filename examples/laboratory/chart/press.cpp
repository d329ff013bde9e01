// SPDX-License-Identifier: BSD-3-Clause
#include "chart/press.hpp"

#include <algorithm>
#include <cmath>

#include "chart/true_curve.hpp"

namespace host::chart {

Vec Press::anchor(double t) const {
  constexpr double down = 0.125; // share of the way down; all increments of 1/8 and less hit its end
  const double s = from + (to - from) * std::clamp((t - down) / (1 - down), 0., 1.);
  const double level = above + (below - above) * std::clamp(t / down, 0., 1.);
  const ArcPoint p = on_arc(curvature, s, level);
  Vec x(dimension);
  if (dimension == 2)
    x << p.x, p.y;
  else
    x << p.x, slant * p.x, p.y;
  return x;
}

Vec Press::spring() const {
  Vec stiffness = Vec::Constant(dimension, lateral);
  stiffness[dimension - 1] = 1;
  return stiffness;
}

Press make_press(const PressOptions& options) {
  Press press;
  const Profile& profile = options.profile;
  press.method = options.method;
  press.row = make_row(profile);
  press.local = profile.surface == SurfaceKind::local;
  if (profile.surface != SurfaceKind::plain) press.height = profile.height.json();
  // Plain segments meet in kinks. Beside a concave one a node that has penetrated is ahead of neither: they
  // reach beyond their ends by as much as the penetration asks for.
  const bool kinks = profile.surface == SurfaceKind::plain || press.local;
  if (kinks) press.border = press.local ? 0.01 : 0.1;
  press.penalty = options.penalty;
  press.increments = options.increments;
  press.wavelength = profile.wavelength;
  press.curvature = profile.curvature;
  // two ends of segments are crossed, at s = 0 and 1; neither end of the way is a symmetric place
  press.from = -0.83, press.to = 1.27;
  // B-splines run beside their control points, by (1 - cos curvature) / (3 curvature) on an arc
  const bool beside = profile.surface == SurfaceKind::c2 || profile.surface == SurfaceKind::plain;
  const double base =
      beside && profile.curvature != 0 ? (1 - std::cos(profile.curvature)) / (3 * profile.curvature) : 0;
  press.above = base + profile.height.highest() + 0.02;
  press.below = base + profile.height.constant - options.depth;
  press.truth = std::make_shared<TrueCurve>(profile, options.method.projection, 0.5 * press.border);
  return press;
}

} // namespace host::chart
