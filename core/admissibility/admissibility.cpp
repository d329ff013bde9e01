// SPDX-License-Identifier: BSD-3-Clause
#include "core/admissibility/admissibility.hpp"

#include <algorithm>
#include <cmath>

#include "core/element/make_plan.hpp"
#include "core/height/height_value.hpp"

namespace ents {

namespace {

// Four samples per feature length of the height, along the longest way across the segment.
int samples_for(const Plan& plan, const double* coordinates) {
  double wanted = 9.0;
  for (int t = 0; t < plan.parameters; ++t) {
    double low = -1.0, high = 1.0;
    if (coordinates) {
      low = high = coordinates[t];
      for (int i = 1; i < plan.nodes; ++i) {
        low = std::min(low, coordinates[plan.parameters * i + t]);
        high = std::max(high, coordinates[plan.parameters * i + t]);
      }
    }
    wanted = std::max(wanted, 4.0 * (high - low) / plan.feature_length[t] + 1.0);
  }
  return static_cast<int>(std::min(wanted, 1025.0));
}

void keep_larger(Worst& worst, double value, const double* xi) {
  if (value > worst.value) worst = {value, {xi[0], xi[1]}};
}

void keep_smaller(Worst& worst, double value, const double* xi) {
  if (value < worst.value) worst = {value, {xi[0], xi[1]}};
}

// Has rho itself a normal?
bool has_base_normal(Basis basis, const double* master, const double* xi) {
  ModelSpec model;
  model.basis = basis;
  const Plan plan = make_plan(model);
  return plan.surface(plan, master, nullptr, xi, {}) == Status::ok;
}

// Is the height a function that is not defined there? log(s) beyond 0, say, whose derivatives have values.
bool has_no_height(const Plan& plan, const double* master, const double* surface_coordinates,
                   const double* xi) {
  double s[2], area_per_s = 0.0;
  return plan.coordinates(plan, master, surface_coordinates, xi, s, area_per_s) == Status::ok &&
         !is_defined_at(*plan.height, plan.parameters, s, 2);
}

} // namespace

double cosine_of_ray(const Plan& plan, const double* point, const double* normal) {
  if (plan.projection == ProjectionKind::normal) return 1.0;
  double ray[3], length = 0.0, cosine = 0.0;
  for (int c = 0; c < plan.dimension; ++c) {
    ray[c] = plan.projection == ProjectionKind::shadow_point ? plan.ray[c] - point[c] : plan.ray[c];
    length += ray[c] * ray[c];
    cosine += ray[c] * normal[c];
  }
  return length > 0.0 ? cosine / std::sqrt(length) : 0.0;
}

Status check_admissibility(const ModelSpec& model, const Plan& plan, const double* master,
                           const double* surface_coordinates, int samples, Admissibility& result) {
  const double* coordinates = surface_coordinates ? surface_coordinates : plan.surface_coordinates;
  const int n = samples > 0 ? samples : samples_for(plan, coordinates);
  const bool triangle = plan.simplex;
  const bool surface = plan.parameters == 2;
  constexpr double infinity = Height::unbounded;
  result = {
      n,        model.height.continuity(), {-1.0, {}}, {-1.0, {}}, {infinity, {}}, {infinity, {}}, infinity,
      -infinity};
  for (int j = 0; j < (surface ? n : 1); ++j)
    for (int i = 0; i < (triangle ? n - j : n); ++i) {
      const double u = i / (n - 1.0), v = surface ? j / (n - 1.0) : 0.0;
      const double xi[2] = {triangle ? u : 2.0 * u - 1.0, triangle ? v : (surface ? 2.0 * v - 1.0 : 0.0)};
      double point[3], normal[3], height, curvature, base_curvature;
      const SurfacePoint out = {point, normal, &height, nullptr, nullptr, &curvature, &base_curvature};
      const Status status = plan.surface(plan, master, surface_coordinates, xi, out);
      if (plan.height &&
          (status == Status::degenerate_segment ||
           (status == Status::out_of_range && has_no_height(plan, master, surface_coordinates, xi))) &&
          has_base_normal(model.basis, master, xi)) { // a fold of rho_e, or it has no height there
        keep_larger(result.fold, infinity, xi);
        keep_smaller(result.reach, 0.0, xi);
        continue;
      }
      if (status != Status::ok) return status;
      const bool edge = i == 0 || i == (triangle ? n - j : n) - 1 || (surface && (j == 0 || j == n - 1));
      keep_larger(result.fold, std::abs(height) * base_curvature, xi);
      if (edge) keep_larger(result.edge_height, std::abs(height), xi);
      keep_smaller(result.reach, curvature > 0.0 ? 1.0 / curvature : infinity, xi);
      keep_smaller(result.shadow, cosine_of_ray(plan, point, normal), xi);
      result.height_min = std::min(result.height_min, height);
      result.height_max = std::max(result.height_max, height);
    }
  return Status::ok;
}

} // namespace ents
