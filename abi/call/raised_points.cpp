// SPDX-License-Identifier: BSD-3-Clause
// Heights of slave points and the slopes of their facets' shape functions.
#include <cmath>

#include "abi/call/combination.hpp"
#include "abi/call/guard.hpp"
#include "core/height/height_value.hpp"

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
      const std::int64_t first = c.begin[i], count = c.begin[i + 1] - first;
      const double* weights = c.weights + first;
      double s[2] = {};
      if (facet_slopes(d, count, weights, slopes + first * t, s) != Status::ok)
        return report_message(report, ENTS_BAD_VALUE, i,
                              "points: the %lld weights of point %lld are no shape functions of a facet in "
                              "%dD: points that are "
                              "raised lie inside facets, as ents_sampling_points puts them, and are no nodes",
                              static_cast<long long>(count), static_cast<long long>(i), d);
      for (int k = 0; coordinates && k < t; ++k) {
        s[k] = 0.0;
        for (std::int64_t j = 0; j < count; ++j) s[k] += weights[j] * coordinates[(first + j) * t + k];
      }
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
