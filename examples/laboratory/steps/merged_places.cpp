// SPDX-License-Identifier: BSD-3-Clause
#include "merged_places.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace host {

std::vector<std::size_t> merge_places(const SlavePoints& points, StepRecord& record) {
  std::vector<std::size_t> first(points.places.empty() ? points.size() : points.places.size() - 1);
  if (points.places.empty()) {
    std::iota(first.begin(), first.end(), std::size_t{0});
    return first;
  }
  std::copy(points.places.begin(), points.places.end() - 1, first.begin());
  ContactFields& fields = record.fields;
  const std::vector<double> areas = record.areas;
  const std::size_t d = fields.normal.size() / areas.size();
  for (std::size_t k = 0; k < first.size(); ++k) {
    const std::size_t begin = first[k], end = points.places[k + 1];
    double area = 0, pressure = 0;
    std::array<double, 3> traction{}, force{};
    bool closed = false;
    for (std::size_t i = begin; i < end; ++i) {
      area += areas[i], pressure += areas[i] * fields.pressure[i];
      closed = closed || fields.closed[i];
      for (std::size_t c = 0; c < d; ++c) {
        traction[c] += areas[i] * fields.traction[i * d + c];
        force[c] += fields.node_forces[i * d + c];
      }
    }
    record.areas[k] = area, fields.pressure[k] = pressure / area, fields.closed[k] = closed;
    for (std::size_t c = 0; c < d; ++c) {
      fields.traction[k * d + c] = traction[c] / area, fields.node_forces[k * d + c] = force[c];
      fields.normal[k * d + c] = fields.normal[begin * d + c];
      fields.point[k * d + c] = fields.point[begin * d + c];
    }
    for (auto* values : {&fields.gap, &fields.normal_gap, &fields.slip, &fields.age})
      (*values)[k] = (*values)[begin];
    fields.flags[k] = fields.flags[begin] | (closed ? ENTS_FLAG_CONTACT : 0),
    fields.segment[k] = fields.segment[begin];
  }
  record.areas.resize(first.size());
  for (auto* values : {&fields.gap, &fields.normal_gap, &fields.pressure, &fields.slip, &fields.age})
    values->resize(first.size());
  for (auto* values : {&fields.normal, &fields.point, &fields.traction, &fields.node_forces})
    values->resize(first.size() * d);
  fields.closed.resize(first.size()), fields.flags.resize(first.size());
  fields.segment.resize(first.size());
  return first;
}

} // namespace host
