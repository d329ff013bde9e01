// SPDX-License-Identifier: BSD-3-Clause
#include "chart/profile.hpp"

#include <cmath>
#include <numbers>

#include "chart/true_curve.hpp"

namespace host::chart {

const char* word(SurfaceKind kind) {
  switch (kind) {
  case SurfaceKind::plain:
    return "plain facets";
  case SurfaceKind::local:
    return "local enrichment";
  case SurfaceKind::c1:
    return "C1 (Catmull-Rom)";
  case SurfaceKind::c2:
    break;
  }
  return "C2 (B-spline)";
}

const char* word(ProjectionKind kind) { return kind == ProjectionKind::normal ? "normal" : "shadow"; }

const char* word(TangentKind kind) {
  switch (kind) {
  case TangentKind::consistent:
    return "consistent";
  case TangentKind::small_gap:
    return "small gap";
  case TangentKind::first_variation:
    break;
  }
  return "first variation";
}

double Height::value(double s) const {
  double h = constant;
  for (const Wave& w : sum) h += w.amplitude * std::sin(2 * std::numbers::pi * w.waves * s + w.phase);
  return h;
}

double Height::slope(double s) const {
  double slope = 0;
  for (const Wave& w : sum)
    slope +=
        2 * std::numbers::pi * w.waves * w.amplitude * std::cos(2 * std::numbers::pi * w.waves * s + w.phase);
  return slope;
}

double Height::highest() const {
  double bound = constant;
  for (const Wave& w : sum) bound += std::abs(w.amplitude);
  return bound;
}

Json Height::json() const {
  Json terms = Json::array();
  if (constant != 0) terms.push_back({{"type", "constant"}, {"value", constant}});
  for (const Wave& w : sum)
    terms.push_back(
        {{"type", "sine"}, {"amplitude", w.amplitude}, {"wave_vector", {w.waves}}, {"phase", w.phase}});
  return {{"type", "sum"}, {"of", terms}};
}

ArcPoint on_arc(double curvature, double s, double level) {
  const double angle = curvature * s;
  // sin(a)/a and (1 - cos a)/a without cancellation
  const double along = std::abs(angle) < 1e-6 ? 1 : std::sin(angle) / angle;
  const double rise = std::abs(angle) < 1e-6 ? angle / 2 : 2 * std::pow(std::sin(angle / 2), 2) / angle;
  return {s * along - level * std::sin(angle), s * rise + level * std::cos(angle)};
}

SegmentRow make_row(const Profile& profile) {
  SegmentRow row;
  const int n = profile.segments;
  if (profile.surface == SurfaceKind::plain) { // the explicit mesh of the smooth surface
    Profile smooth = profile;
    smooth.surface = SurfaceKind::c2;
    const TrueCurve curve(smooth, ProjectionKind::normal, 0);
    row.segment = "line2";
    const int each = static_cast<int>(std::lround(profile.facets_per_wave / profile.wavelength));
    for (int i = 0; i <= n * each; ++i) {
      const int piece = std::min(i / each, n - 1);
      const auto point = curve.point(piece, static_cast<double>(i - piece * each) / each);
      row.positions.insert(row.positions.end(), {point[0], point[1]});
      if (i > 0) row.connectivity.insert(row.connectivity.end(), {i - 1, i});
    }
    return row;
  }
  const bool smooth = profile.surface != SurfaceKind::local;
  row.segment = profile.surface == SurfaceKind::local ? "line2"
                : profile.surface == SurfaceKind::c1  ? "catmull_rom4"
                                                      : "bspline4";
  row.nodes_per_segment = smooth ? 4 : 2;
  // one node more at both ends, which only smoothed segments see
  for (int i = -1; i <= n + 1; ++i) {
    const ArcPoint point = on_arc(profile.curvature, i - 0.5 * n, 0);
    row.positions.insert(row.positions.end(), {point.x, point.y});
  }
  for (int k = 0; k < n; ++k)
    for (int a = 0; a < row.nodes_per_segment; ++a) {
      const int node = smooth ? k + a : k + 1 + a;
      row.connectivity.push_back(node);
      row.surface_coordinates.push_back(node - 1 - 0.5 * n);
    }
  return row;
}

} // namespace host::chart
