// SPDX-License-Identifier: BSD-3-Clause
#include "core/admissibility/surface_admissibility.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/admissibility/admissibility.hpp"
#include "core/admissibility/facets.hpp"
#include "core/admissibility/surface_checker.hpp"

namespace ents {

namespace {

constexpr double infinity = Height::unbounded;
// Rounding of positions, of sin(pi), of sums of polynomial terms, relative to the size of the surface.
constexpr double rounding = 1e-10;

double size_of(const Plan& plan, const MasterMesh& mesh) {
  double size = 0.0;
  const std::int64_t entries = mesh.segments * plan.nodes;
  for (int k = 0; k < plan.dimension; ++k) {
    double low = infinity, high = -infinity;
    for (std::int64_t i = 0; i < entries; ++i) {
      const double x = mesh.positions[mesh.connectivity[i] * plan.dimension + k];
      low = std::min(low, x), high = std::max(high, x);
    }
    size = std::max(size, high - low);
  }
  return size;
}

// Move xi to the largest value nearby: a compass search, whose steps start at the distance of the samples.
double climb(const SurfaceChecker& c, double step, double (&xi)[2], double value,
             const std::function<double(const double*)>& f) {
  const double low = c.plan.simplex ? 0.0 : -1.0;
  for (int evaluations = 0; step > 1e-8 && evaluations < 1000;) {
    bool better = false;
    for (int a = 0; a < c.plan.parameters; ++a)
      for (const double sign : {-1.0, 1.0}) {
        double next[2] = {xi[0], xi[1]};
        next[a] = std::clamp(next[a] + sign * step, low, 1.0);
        if (c.plan.simplex) next[a] = std::min(next[a], 1.0 - next[1 - a]);
        ++evaluations;
        const double there = f(next);
        if (!(there > value)) continue;
        value = there, xi[0] = next[0], xi[1] = next[1];
        better = true;
      }
    if (!better) step *= 0.5;
  }
  return value;
}

// The worst place of a smooth quantity lies between the samples.
void refine(const SurfaceChecker& c, int which, double step, bool largest,
            const std::function<double(const SegmentNodes&, const double*)>& f) {
  Finding& worst = c.finding(which);
  if (worst.segment < 0 || !std::isfinite(worst.value)) return;
  SegmentNodes nodes;
  if (gather(c.plan, c.mesh, worst.segment, nodes) != Status::ok) return;
  const double sign = largest ? 1.0 : -1.0;
  worst.value = sign * climb(c, step, worst.xi, sign * worst.value,
                             [&](const double* xi) { return sign * f(nodes, xi); });
}

// Conditions that one segment has or has not, with the samples of ents_model_check.
Status check_segments(const SurfaceChecker& c, const SurfaceLimits& limits, std::int64_t& segment) {
  SurfaceAdmissibility& r = c.result;
  int coarsest = most_samples;
  for (segment = 0; segment < c.mesh.segments; ++segment) {
    SegmentNodes nodes;
    if (const Status status = gather(c.plan, c.mesh, segment, nodes); status != Status::ok) return status;
    Admissibility a;
    const Status status =
        check_admissibility(c.model, c.plan, nodes.positions, nodes.surface_coordinates, limits.samples, a);
    if (status != Status::ok) return status;
    r.samples = std::max(r.samples, a.samples), coarsest = std::min(coarsest, a.samples);
    r.height_min = std::min(r.height_min, a.height_min);
    r.height_max = std::max(r.height_max, a.height_max);
    const auto at = [&](int which, const Worst& w, bool largest) {
      const double before = c.finding(which).value;
      c.keep(which, largest ? w.value > before : w.value < before, w.value, segment, w.xi);
    };
    at(condition::fold, a.fold, true);
    at(condition::edge, a.edge_height, true);
    at(condition::projection, a.reach, false);
    at(condition::shadow, a.shadow, false);
    if (!(a.fold.value < c.finding(condition::fold).bound)) c.mark(condition::fold, segment);
    if (!(a.edge_height.value <= c.finding(condition::edge).bound)) c.mark(condition::edge, segment);
    if (!(a.reach.value >= c.finding(condition::projection).bound)) c.mark(condition::projection, segment);
    if (!(a.shadow.value > c.finding(condition::shadow).bound)) c.mark(condition::shadow, segment);
  }
  segment = -1;
  if (c.mesh.segments == 0) return Status::ok;

  const double step = (c.plan.simplex ? 1.0 : 2.0) / (coarsest - 1.0);
  const auto point = [&](const SegmentNodes& nodes, const double* xi, const SurfacePoint& out) {
    return c.plan.surface(c.plan, nodes.positions, nodes.surface_coordinates, xi, out) == Status::ok;
  };
  refine(c, condition::fold, step, true, [&](const SegmentNodes& nodes, const double* xi) {
    double h, curvature;
    return point(nodes, xi, {nullptr, nullptr, &h, nullptr, nullptr, nullptr, &curvature})
               ? std::fabs(h) * curvature
               : infinity;
  });
  refine(c, condition::projection, step, false, [&](const SegmentNodes& nodes, const double* xi) {
    double curvature;
    return point(nodes, xi, {nullptr, nullptr, nullptr, nullptr, nullptr, &curvature, nullptr})
               ? 1.0 / curvature
               : 0.0;
  });
  if (c.plan.projection != ProjectionKind::normal)
    refine(c, condition::shadow, step, false, [&](const SegmentNodes& nodes, const double* xi) {
      double x[3], n[3];
      return point(nodes, xi, {x, n, nullptr, nullptr, nullptr, nullptr, nullptr})
                 ? cosine_of_ray(c.plan, x, n)
                 : infinity;
    });
  // what lies between the samples may be beyond a bound where no sample is
  if (const Finding& f = c.finding(condition::fold); !(f.value < f.bound)) c.mark(condition::fold, f.segment);
  if (const Finding& f = c.finding(condition::projection); !(f.value >= f.bound))
    c.mark(condition::projection, f.segment);
  if (const Finding& f = c.finding(condition::shadow); !(f.value > f.bound))
    c.mark(condition::shadow, f.segment);
  return Status::ok;
}

void set_bounds(const SurfaceChecker& c, const SurfaceLimits& limits) {
  const bool local =
      c.plan.height && !c.mesh.surface_coordinates && !c.plan.surface_coordinates && !c.smoothed();
  const bool normal = c.plan.projection == ProjectionKind::normal;
  const double reach = limits.reach > 0.0 ? limits.reach : c.plan.penetration_limit;
  const auto set = [&](int which, double bound, bool judged) {
    c.finding(which).bound = bound, c.finding(which).judged = judged && c.mesh.segments > 0;
  };
  set(condition::continuity, 2.0, true);
  set(condition::fold, 1.0, true);
  set(condition::edge, local ? rounding * c.size : 0.0, local);
  set(condition::jump, rounding * c.size, true);
  set(condition::kink, limits.kink, limits.kink > 0.0);
  set(condition::wedge, 0.0, true);
  set(condition::projection, reach, normal && reach > 0.0);
  set(condition::shadow, 0.0, !normal);
  set(condition::occlusion, 0.0, !normal);
  set(condition::crossing, 0.0, true);
  c.finding(condition::projection).value = infinity;
  c.finding(condition::shadow).value = infinity;
  c.finding(condition::wedge).value = 3.14159265358979323846;
}

} // namespace

Status check_surface(const ModelSpec& model, const Plan& plan, const MasterMesh& mesh,
                     const SurfaceLimits& limits, SurfaceAdmissibility& result, std::int64_t& segment) {
  result = {};
  result.height_min = infinity, result.height_max = -infinity;
  result.violations.assign(static_cast<std::size_t>(mesh.segments), 0);
  SegmentNodes nodes;
  for (segment = 0; segment < mesh.segments; ++segment)
    if (const Status status = gather(plan, mesh, segment, nodes); status != Status::ok) return status;
  const SurfaceChecker c = {model, plan, mesh, size_of(plan, mesh), result};
  set_bounds(c, limits);

  Finding& continuity = c.finding(condition::continuity);
  continuity.value = model.height.continuity();
  if (continuity.value < continuity.bound)
    for (std::int64_t s = 0; s < mesh.segments; ++s) c.mark(condition::continuity, s);

  if (const Status status = check_segments(c, limits, segment); status != Status::ok) return status;
  std::vector<bool> smooth;
  check_shared_edges(c, result.samples, smooth);

  const Facets facets(c, result.samples);
  Finding& projection = c.finding(condition::projection);
  if (projection.judged) check_two_projections(c, facets, smooth);
  if (c.finding(condition::occlusion).judged) check_occlusion(c, facets);
  check_crossing(c, facets);
  segment = -1;
  return Status::ok;
}

} // namespace ents
