// SPDX-License-Identifier: BSD-3-Clause
// Where slave points are in their facets, their heights, and the slopes of their facets' shape functions.
#include <cmath>

#include "abi/call/combination.hpp"
#include "abi/call/guard.hpp"
#include "core/height/height_value.hpp"

namespace ents {

std::int32_t slopes_on_facet(const ents_combination& c, const char* name, std::int64_t point, int dimension,
                             const double* coordinates, double* slopes, double (&s)[2],
                             ents_report* report) noexcept {
  const std::int64_t first = c.begin[point], count = c.begin[point + 1] - first;
  const double* weights = c.weights + first;
  const int t = dimension - 1;
  if (facet_slopes(dimension, count, weights, slopes, s) != Status::ok)
    return report_message(
        report, ENTS_BAD_VALUE, point,
        "%s: the %lld weights of point %lld are no shape functions of a facet in %dD: points "
        "that are raised lie inside facets, as ents_sampling_points puts them, and are no nodes",
        name, static_cast<long long>(count), static_cast<long long>(point), dimension);
  for (int k = 0; coordinates && k < t; ++k) {
    s[k] = 0.0;
    for (std::int64_t j = 0; j < count; ++j) s[k] += weights[j] * coordinates[(first + j) * t + k];
  }
  return ENTS_OK;
}

std::int32_t place_on_facet(const ents_combination& c, const char* name, std::int64_t point, int dimension,
                            const double* coordinates, const double* positions, FacetPlace& place,
                            ents_report* report) noexcept {
  double slopes[2 * most_facet_nodes];
  place.s[0] = place.s[1] = 0.0;
  if (const std::int32_t status =
          slopes_on_facet(c, name, point, dimension, coordinates, slopes, place.s, report);
      status != ENTS_OK)
    return status;
  const std::int64_t first = c.begin[point], count = c.begin[point + 1] - first;
  RaisedPoint raised;
  const Status outcome =
      raised.set(dimension, count, c.nodes + first, c.weights + first, slopes, 0.0, positions);
  if (outcome != Status::ok)
    return report_message(report, static_cast<std::int32_t>(outcome), point, "%s: the facet of point %lld %s",
                          name, static_cast<long long>(point),
                          outcome == Status::degenerate_segment ? "has no area"
                                                                : "has a node whose position is not finite");
  double turned = 1.0; // |det ds / dxi|
  if (coordinates) {
    const int t = dimension - 1;
    double gradient[2][2] = {{0.0, 0.0}, {0.0, 1.0}};
    for (int a = 0; a < t; ++a)
      for (int b = 0; b < t; ++b) {
        gradient[a][b] = 0.0;
        for (std::int64_t j = 0; j < count; ++j)
          gradient[a][b] += coordinates[(first + j) * t + a] * slopes[j * t + b];
      }
    turned = std::fabs(gradient[0][0] * gradient[1][1] - gradient[0][1] * gradient[1][0]);
  }
  for (int i = 0; i < dimension; ++i) place.point[i] = raised.place[i];
  place.area_per_s = turned > 0.0 ? raised.area / turned : 0.0;
  return ENTS_OK;
}

} // namespace ents

extern "C" {

int32_t ents_raise_points(const ents_model* surface, const ents_combination* points,
                          const double* coordinates, double* heights, double* slopes, ents_report* report) {
  using namespace ents;
  return entry_point(report, [&] {
    std::int32_t status = check_handle(surface, report);
    if (status != ENTS_OK) return status;
    ents_combination c;
    if ((status = check_combination(points, "points", c, report)) != ENTS_OK) return status;
    if (c.points > 0 && (!heights || !slopes))
      return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null",
                            heights ? "slopes" : "heights");
    const FloatingPointGuard guard;
    const int d = surface->plan.dimension, t = d - 1;
    for (std::int64_t i = 0; i < c.points; ++i) {
      if ((status = check_combined_point(c, "points", i, INT64_MAX, report)) != ENTS_OK) return status;
      double s[2] = {};
      if ((status = slopes_on_facet(c, "points", i, d, coordinates, slopes + c.begin[i] * t, s, report)) !=
          ENTS_OK)
        return status;
      heights[i] = surface->plan.height ? height_at(*surface->plan.height, t, s) : 0.0;
      if (!std::isfinite(heights[i]))
        return report_message(report, ENTS_NON_FINITE, i,
                              "the height of point %lld is not defined at the surface coordinates (%g, %g)",
                              static_cast<long long>(i), s[0], t > 1 ? s[1] : 0.0);
    }
    return report_ok(report);
  });
}

} // extern "C"
