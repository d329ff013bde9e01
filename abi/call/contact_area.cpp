// SPDX-License-Identifier: BSD-3-Clause
// The contact area as a call.
#include <cmath>
#include <cstring>
#include <vector>

#include "abi/call/combination.hpp"
#include "abi/call/entry_point.hpp"
#include "abi/call/guard.hpp"
#include "abi/call/handle.hpp"
#include "core/slave/contact_area.hpp"
#include "core/slave/tributary.hpp"

namespace ents {
namespace {

std::int32_t check_fields(const char* facet, const SlaveFields& f, ents_report* report) {
  if (!facet) return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'facet' is null");
  if (!f.facet)
    return report_status(
        report, ENTS_BAD_VALUE, -1,
        "argument 'facet' must be line2, tri3 or quad4; give quadratic facets as their linear parts");
  if (f.facets < 0 || f.nodes < 0 || f.facets > INT64_MAX / 64 || f.nodes > INT64_MAX / 64)
    return report_message(report, ENTS_BAD_COUNT, -1, "facets = %lld, nodes = %lld: both must be >= 0",
                          static_cast<long long>(f.facets), static_cast<long long>(f.nodes));
  const struct {
    const char* name;
    const void* array;
    std::int64_t size;
  } arrays[] = {{"connectivity", f.connectivity, f.facets},
                {"positions", f.positions, f.nodes},
                {"gap", f.gap, f.nodes},
                {"pressure", f.pressure, f.nodes}};
  for (const auto& a : arrays)
    if (a.size > 0 && !a.array)
      return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null", a.name);
  if (f.facet->parameters == 1 && (!std::isfinite(f.thickness) || f.thickness < 0.0))
    return report_status(report, ENTS_BAD_VALUE, -1, "argument 'thickness' must be >= 0");
  if (!std::isfinite(f.modulus) || f.modulus < 0.0)
    return report_status(
        report, ENTS_BAD_VALUE, -1,
        "argument 'modulus' must be > 0: E / (1 - nu^2) of the bodies in contact; 0: not known");
  const std::int64_t entries = f.facets * f.facet->nodes;
  for (std::int64_t i = 0; i < entries; ++i)
    if (f.connectivity[i] < 0 || f.connectivity[i] >= f.nodes)
      return report_message(report, ENTS_BAD_VALUE, i / f.facet->nodes,
                            "connectivity[%lld] = %lld is not a node (0 .. %lld)", static_cast<long long>(i),
                            static_cast<long long>(f.connectivity[i]), static_cast<long long>(f.nodes - 1));
  std::int64_t at = first_non_finite(f.positions, f.nodes * (f.facet->parameters + 1));
  if (at >= 0)
    return report_message(report, ENTS_NON_FINITE, -1, "positions[%lld] is not finite",
                          static_cast<long long>(at));
  at = first_non_finite(f.pressure, f.nodes);
  if (at >= 0)
    return report_message(report, ENTS_NON_FINITE, -1, "pressure[%lld] is not finite",
                          static_cast<long long>(at));
  return ENTS_OK;
}

} // namespace
} // namespace ents

extern "C" int32_t ents_contact_area(const char* facet, int64_t facets, const int64_t* connectivity,
                                     int64_t nodes, const double* positions, double thickness,
                                     const double* gap, const double* pressure, double modulus,
                                     ents_area* area, ents_report* report) {
  using namespace ents;
  return entry_point(report, [&] {
    const FloatingPointGuard guard;
    std::int32_t status = ENTS_OK;
    ents_area copy;
    const ents_area* known = known_struct(area, copy, "area", status, report);
    if (!known) return status;
    ents_area out = *known;
    if ((status = check_reserved(out.reserved, "area", report)) != ENTS_OK) return status;
    const BasisEntry* entry = nullptr;
    for (const char* name : {"line2", "tri3", "quad4"})
      for (const BasisEntry& one : basis_table)
        if (facet && std::strcmp(facet, name) == 0 && std::strcmp(one.name, name) == 0) entry = &one;
    const SlaveFields fields{entry, facets,   nodes,     connectivity, positions,
                             gap,   pressure, thickness, modulus};
    if ((status = check_fields(facet, fields, report)) != ENTS_OK) return status;
    std::vector<double> share(static_cast<std::size_t>(nodes), 0.0);
    std::int64_t at = 0;
    if (add_tributary_areas(entry->basis, facets, connectivity, positions, thickness, share.data(), at) !=
        Status::ok)
      return refuse_facet(*entry, at, connectivity, positions, thickness, report);
    const ContactArea found = estimate_contact_area(fields, share);
    out.surface = found.surface, out.counted = found.counted;
    out.border_corrected = found.border_corrected, out.zero_line = found.zero_line;
    out.estimate = found.estimate, out.error = found.error;
    out.peak_pressure = found.peak_pressure, out.peak_drop = found.peak_drop;
    copy_to_caller(out, area);
    return report_ok(report);
  });
}
