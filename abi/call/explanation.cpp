// SPDX-License-Identifier: BSD-3-Clause
// Elements that were refused for where they are: what is asked of the library once more to say it.
#include <cmath>

#include "abi/call/element_call.hpp"

namespace ents {

std::int32_t ElementCall::explain_penetration(std::int64_t e, ents_report* report) const {
  SegmentNodes nodes;
  if (in->mesh) gather(*plan, mesh, segment(e), nodes);
  double gap = 0.0;
  ElementOutput result{};
  result.wanted = want::gap;
  result.gap = &gap;
  bool open;
  evaluate_one(element(e, nodes), result, true, open);
  const long long number = e;
  if (plan->penetration_limit > 0.0)
    return report_message(
        report, ENTS_DEEP_PENETRATION, e,
        "element %lld: gap = %g, deeper than \"penetration_limit\" (%g); take a smaller step", number, gap,
        plan->penetration_limit);
  return report_message(report, ENTS_DEEP_PENETRATION, e,
                        "element %lld: gap = %g, deeper than the segment is long; take a smaller step, or "
                        "look on which side of the "
                        "segment the slave should be, or give \"penetration_limit\"",
                        number, gap);
}

// Is the surface behind the ray's end, as where "direction" points into the master?
std::int32_t ElementCall::explain_ray(std::int64_t e, ents_report* report) const {
  SegmentNodes nodes;
  if (in->mesh) gather(*plan, mesh, segment(e), nodes);
  const ElementInput input = element(e, nodes);
  double normal[3] = {}, ray[3] = {}, along = 0.0, length = 0.0;
  ElementOutput result{};
  result.wanted = want::normal;
  result.normal = normal;
  bool open;
  const long long number = e;
  const bool point = plan->projection == ProjectionKind::shadow_point;
  if (evaluate_one(input, result, true, open) == Status::ok) {
    for (int k = 0; k < plan->dimension; ++k) {
      ray[k] = point ? plan->ray[k] - input.slave[k] : plan->ray[k];
      length += ray[k] * ray[k];
      along += ray[k] * normal[k];
    }
    along /= std::sqrt(length);
  }
  if (!(along < 0.0))
    return report_message(report, ENTS_GRAZING_RAY, e, "element %lld: %s", number,
                          ents_status_text(ENTS_GRAZING_RAY));
  return report_message(
      report, ENTS_GRAZING_RAY, e,
      "element %lld: the shadow ray leaves the surface from behind (n_e . e = %.3g). %s", number, along,
      point ? "\"emitter\" lies on the side of the slave nodes, where n_e points"
            : "\"direction\" points from the master to the light, as n_e does: turn its sign");
}

} // namespace ents
