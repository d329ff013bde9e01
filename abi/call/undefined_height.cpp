// SPDX-License-Identifier: BSD-3-Clause
#include "abi/call/undefined_height.hpp"

#include <cmath>
#include <limits>

#include "core/height/height_value.hpp"
#include "core/projection/search.hpp"

namespace ents {

bool height_is_undefined(const Plan& plan, const double* master, const double* surface_coordinates,
                         const double* xi, double (&s)[2]) {
  double area_per_s = 0.0;
  return plan.height &&
         plan.coordinates(plan, master, surface_coordinates, xi, s, area_per_s) == Status::ok &&
         !is_defined_at(*plan.height, plan.parameters, s, plan.law.has_friction_force() ? 3 : 2);
}

bool height_is_undefined(const Plan& plan, const ElementInput& element, double (&s)[2]) {
  const auto at = [&](const double* xi) {
    return xi && height_is_undefined(plan, element.master, element.surface_coordinates, xi, s);
  };
  if (!plan.height || !plan.base) return false;
  if (at(element.start) || (element.state_begin && at(element.state_begin + StateLayout::xi_at))) return true;
  SegmentProjection base;
  return plan.base->project(*plan.base, element.slave, element.master, element.surface_coordinates, nullptr,
                            std::numeric_limits<double>::infinity(), portable::search_budget, base) &&
         at(base.xi);
}

std::int32_t report_undefined_height(const Plan& plan, const char* what, std::int64_t index,
                                     const double (&s)[2], ents_report* report) noexcept {
  char place[64];
  std::snprintf(place, sizeof place, plan.parameters == 1 ? "%.6g" : "%.6g, %.6g", s[0], s[1]);
  return report_message(report, ENTS_NO_PROJECTION, index,
                        "%s %lld: the height has no value, or no finite derivatives, at s = (%s)", what,
                        static_cast<long long>(index), place);
}

} // namespace ents
