// SPDX-License-Identifier: BSD-3-Clause
// Slave surfaces: tributary areas of nodes, sampling points inside facets, and linear combinations of nodes.
#include <algorithm>
#include <cmath>
#include <vector>

#include "abi/call/combination.hpp"
#include "abi/call/guard.hpp"
#include "core/slave/sampling.hpp"
#include "core/slave/tributary.hpp"

namespace ents {

std::int32_t check_combination(const ents_combination* caller, const char* name, ents_combination& out,
                               ents_report* report) noexcept {
  std::int32_t status = ENTS_OK;
  const ents_combination* known = known_struct(caller, out, name, status, report);
  if (!known) return status;
  if (known != &out) out = *known;
  if ((status = check_reserved(out.reserved, name, report)) != ENTS_OK) return status;
  if (out.points < 0 || out.points > std::int64_t{1} << 40)
    return report_message(report, ENTS_BAD_COUNT, -1, "%s.points = %lld must be 0 .. 2^40", name,
                          static_cast<long long>(out.points));
  if (out.points > 0 && (!out.begin || !out.nodes || !out.weights))
    return report_message(report, ENTS_NULL_ARGUMENT, -1, "%s.%s is null", name,
                          !out.begin ? "begin" : (!out.nodes ? "nodes" : "weights"));
  if (out.points > 0 && out.begin[0] != 0)
    return report_message(report, ENTS_BAD_VALUE, -1, "%s.begin[0] is %lld; it must be 0", name,
                          static_cast<long long>(out.begin[0]));
  if (out.heights && out.reflected)
    return report_message(
        report, ENTS_BAD_VALUE, -1,
        "%s has heights and reflected: points that are raised are combinations of real nodes", name);
  if (out.points > 0 && out.heights && !out.slopes)
    return report_message(report, ENTS_NULL_ARGUMENT, -1,
                          "%s.slopes is null, but heights is not: ents_raise_points makes both", name);
  return ENTS_OK;
}

std::int32_t check_combined_point(const ents_combination& c, const char* name, std::int64_t point,
                                  std::int64_t nodes, ents_report* report) noexcept {
  const long long i = point;
  if (c.begin[point] < 0 || c.begin[point + 1] < c.begin[point])
    return report_message(report, ENTS_BAD_VALUE, point, "%s.begin falls at point %lld: %lld, %lld", name, i,
                          static_cast<long long>(c.begin[point]), static_cast<long long>(c.begin[point + 1]));
  for (std::int64_t j = c.begin[point]; j < c.begin[point + 1]; ++j) {
    if (c.nodes[j] < 0 || c.nodes[j] >= nodes)
      return report_message(report, ENTS_BAD_VALUE, point,
                            "%s.nodes[%lld] (point %lld) is %lld; nodes are 0 .. %lld", name,
                            static_cast<long long>(j), i, static_cast<long long>(c.nodes[j]),
                            static_cast<long long>(nodes - 1));
    if (!std::isfinite(c.weights[j]))
      return report_message(report, ENTS_NON_FINITE, point,
                            "%s.weights[%lld] (point %lld) is NaN or infinite", name,
                            static_cast<long long>(j), i);
    if (c.reflected && (c.reflected[j] < 0 || c.reflected[j] > 7))
      return report_message(report, ENTS_BAD_VALUE, point,
                            "%s.reflected[%lld] (point %lld) is %d; its bits are 1, 2 and 4", name,
                            static_cast<long long>(j), i, c.reflected[j]);
  }
  return ENTS_OK;
}

namespace {

const BasisEntry* facet_named(const char* name) {
  for (const BasisEntry& entry : basis_table)
    if (!entry.smoothed && std::strcmp(entry.name, name) == 0) return &entry;
  return nullptr;
}

// The arguments that tributary areas and sampling points have in common.
struct Facets {
  const BasisEntry* entry;
  std::int64_t count, nodes;
  const std::int64_t* connectivity;
  const double* positions;
  double thickness;
};

std::int32_t check_facets(const char* name, const Facets& f, ents_report* report) {
  if (f.count < 0 || f.nodes < 0 || f.count > INT64_MAX / (64 * 64 * 64) || f.nodes > INT64_MAX / 64)
    return report_message(report, ENTS_BAD_COUNT, -1, "facets = %lld, nodes = %lld: both must be >= 0",
                          static_cast<long long>(f.count), static_cast<long long>(f.nodes));
  if (!f.entry)
    return report_status(report, name ? ENTS_BAD_VALUE : ENTS_NULL_ARGUMENT, -1,
                         name ? "argument 'facet' must be line2, line3, tri3, tri6, quad4, quad8 or quad9"
                              : "argument 'facet' is null");
  if ((f.count > 0 && !f.connectivity) || (f.nodes > 0 && !f.positions))
    return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null",
                          f.count > 0 && !f.connectivity ? "connectivity" : "positions");
  if (f.entry->parameters == 1 && (!std::isfinite(f.thickness) || f.thickness < 0.0))
    return report_status(report, ENTS_BAD_VALUE, -1, "argument 'thickness' must be >= 0");
  const std::int64_t entries = f.count * f.entry->nodes;
  for (std::int64_t i = 0; i < entries; ++i)
    if (f.connectivity[i] < 0 || f.connectivity[i] >= f.nodes)
      return report_message(report, ENTS_BAD_VALUE, i / f.entry->nodes,
                            "connectivity[%lld] = %lld is not a node (0 .. %lld)", static_cast<long long>(i),
                            static_cast<long long>(f.connectivity[i]), static_cast<long long>(f.nodes - 1));
  const std::int64_t at = first_non_finite(f.positions, f.nodes * (f.entry->parameters + 1));
  if (at >= 0)
    return report_message(report, ENTS_NON_FINITE, -1, "positions[%lld] is not finite",
                          static_cast<long long>(at));
  return ENTS_OK;
}

} // namespace

std::int32_t refuse_facet(const BasisEntry& entry, std::int64_t facet, const std::int64_t* connectivity,
                          const double* positions, double thickness, ents_report* report) noexcept {
  const long long index = facet;
  const std::int64_t* nodes = connectivity + facet * entry.nodes;
  for (int i = 0; i < entry.nodes && entry.parameters == 1 && thickness == 0.0; ++i)
    if (const double radius = positions[2 * nodes[i]]; radius < 0.0)
      return report_message(
          report, ENTS_DEGENERATE_SEGMENT, facet,
          "facet %lld has its node %lld at the radius %g: with thickness 0 bodies turn about the "
          "second axis, and the first coordinate is not negative",
          index, static_cast<long long>(nodes[i]), radius);
  return report_message(report, ENTS_DEGENERATE_SEGMENT, facet, "facet %lld has no area", index);
}

} // namespace ents

extern "C" {

int32_t ents_tributary_areas(const char* facet, int64_t facets, const int64_t* connectivity, int64_t nodes,
                             const double* positions, double thickness, double* areas, ents_report* report) {
  using namespace ents;
  return entry_point(report, [&] {
    const FloatingPointGuard guard;
    const Facets f = {
        facet ? facet_named(facet) : nullptr, facets, nodes, connectivity, positions, thickness};
    if (const std::int32_t status = check_facets(facet, f, report); status != ENTS_OK) return status;
    if (nodes > 0 && !areas) return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'areas' is null");
    std::vector<double> sum(static_cast<std::size_t>(nodes), 0.0);
    std::int64_t at = 0;
    if (add_tributary_areas(f.entry->basis, facets, connectivity, positions, thickness, sum.data(), at) !=
        Status::ok)
      return refuse_facet(*f.entry, at, connectivity, positions, thickness, report);
    std::copy(sum.begin(), sum.end(), areas);
    return report_ok(report);
  });
}

int32_t ents_sampling_points(const char* facet, int32_t per_direction, int64_t facets,
                             const int64_t* connectivity, int64_t nodes, const double* positions,
                             double thickness, int64_t* begin, int64_t* point_nodes, double* weights,
                             double* areas, ents_report* report) {
  using namespace ents;
  return entry_point(report, [&] {
    const FloatingPointGuard guard;
    const Facets f = {
        facet ? facet_named(facet) : nullptr, facets, nodes, connectivity, positions, thickness};
    if (const std::int32_t status = check_facets(facet, f, report); status != ENTS_OK) return status;
    if (per_direction < 1 || per_direction > most_sampling_points)
      return report_message(report, ENTS_BAD_VALUE, -1, "argument 'per_direction' is %d; it must be 1 .. %d",
                            per_direction, most_sampling_points);
    const struct {
      const char* name;
      const void* array;
    } out[] = {{"begin", begin}, {"point_nodes", point_nodes}, {"weights", weights}, {"areas", areas}};
    for (const auto& o : out)
      if (!o.array) return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null", o.name);
    std::int64_t at = 0;
    if (sample_facets(f.entry->basis, per_direction, facets, connectivity, positions, thickness, point_nodes,
                      weights, areas, at) != Status::ok)
      return refuse_facet(*f.entry, at, connectivity, positions, thickness, report);
    const std::int64_t points = facets * sampling_points_of(f.entry->parameters, per_direction);
    for (std::int64_t i = 0; i <= points; ++i) begin[i] = i * f.entry->nodes;
    return report_ok(report);
  });
}

int32_t ents_combine(const ents_combination* combination, int32_t dimension, int64_t nodes,
                     const double* positions, double* points, ents_report* report) {
  using namespace ents;
  return entry_point(report, [&] {
    ents_combination c;
    std::int32_t status = check_combination(combination, "combination", c, report);
    if (status != ENTS_OK) return status;
    if (dimension < 1 || dimension > 3)
      return report_message(report, ENTS_BAD_VALUE, -1, "argument 'dimension' is %d; it must be 1, 2 or 3",
                            dimension);
    if (c.heights && dimension == 1)
      return report_status(report, ENTS_BAD_VALUE, -1,
                           "argument 'dimension' is 1, but combination.heights raises positions: 2 or 3");
    if (c.points > 0 && (!positions || !points))
      return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null",
                            positions ? "points" : "positions");
    const FloatingPointGuard guard;
    for (std::int64_t i = 0; i < c.points; ++i) {
      if ((status = check_combined_point(c, "combination", i, nodes, report)) != ENTS_OK) return status;
      double sum[3] = {};
      for (std::int64_t j = c.begin[i]; j < c.begin[i + 1]; ++j)
        for (int k = 0; k < dimension; ++k) {
          const bool reversed = c.reflected && (c.reflected[j] >> k & 1) != 0;
          sum[k] += (reversed ? -c.weights[j] : c.weights[j]) * positions[c.nodes[j] * dimension + k];
        }
      if (c.heights) {
        RaisedPoint raised;
        if ((status = raise_point(c, "combination", i, dimension, positions, raised, report)) != ENTS_OK)
          return status;
        std::copy(raised.place, raised.place + dimension, sum);
      }
      for (int k = 0; c.shifts && k < dimension; ++k) sum[k] += c.shifts[i * dimension + k];
      if (first_non_finite(sum, dimension) >= 0)
        return report_message(report, ENTS_NON_FINITE, i,
                              "a position that point %lld is made of, or its shift, is NaN or infinite",
                              static_cast<long long>(i));
      for (int k = 0; k < dimension; ++k) points[i * dimension + k] = sum[k];
    }
    return report_ok(report);
  });
}

} // extern "C"
