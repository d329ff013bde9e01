// SPDX-License-Identifier: BSD-3-Clause
// Contact: what a person wants to know about every slave node.
#include <algorithm>
#include <limits>

#include "contact.hpp"

namespace host {

ContactFields Contact::fields(const Configuration& at) {
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const auto stride = [](std::size_t value) { return static_cast<std::int64_t>(value); };
  gather(at);
  const std::size_t count = active_.size();
  std::vector<double> gap(count), normal_gap(count), pressure(count), normal(count * d_), point(count * d_);
  std::vector<double> traction(count * d_), slip(count), age(count), residual(count * element_dofs_);
  std::vector<std::int32_t> flags(count), status(count);
  const ents_input in = input();
  auto out = ents_struct<ents_output>();
  out.wanted = ENTS_GAP | ENTS_NORMAL_GAP | ENTS_PRESSURE | ENTS_NORMAL | ENTS_POINT | ENTS_FLAGS | ENTS_TRACTION |
               ENTS_SLIP | ENTS_AGE | ENTS_RESIDUAL;
  out.gap = gap.data(), out.gap_stride = 1;
  out.normal_gap = normal_gap.data(), out.normal_gap_stride = 1;
  out.pressure = pressure.data(), out.pressure_stride = 1;
  out.normal = normal.data(), out.normal_stride = stride(d_);
  out.point = point.data(), out.point_stride = stride(d_);
  out.traction = traction.data(), out.traction_stride = stride(d_);
  out.slip = slip.data(), out.slip_stride = 1;
  out.age = age.data(), out.age_stride = 1;
  out.residual = residual.data(), out.residual_stride = stride(element_dofs_);
  out.flags = flags.data(), out.flags_stride = 1;
  out.status = status.data(), out.status_stride = 1;
  auto report = ents_struct<ents_report>();
  const EntsLibrary& library = master_.model->library();
  const std::int32_t result = library.evaluate(master_.model->get(), 0, stride(count), &in, &out, &report);
  if (result < 0) throw JobError("contact: " + describe(library, result, report));

  const std::size_t slaves = points_.size();
  ContactFields fields;
  fields.gap.assign(slaves, not_a_number);
  fields.normal_gap = fields.gap;
  fields.pressure.assign(slaves, 0.0);
  fields.normal.assign(slaves * d_, 0.0);
  fields.point.assign(slaves * d_, not_a_number);
  fields.closed.assign(slaves, 0);
  fields.traction.assign(slaves * d_, 0.0);
  fields.slip.assign(slaves, 0.0);
  fields.age = fields.slip;
  fields.flags.assign(slaves, ENTS_FLAG_OUTSIDE);
  fields.segment = segment_;
  fields.node_forces.assign(slaves * d_, 0.0);
  fields.force.assign(d_, 0.0);
  for (std::size_t e = 0; e < count; ++e) {
    if (status[e] != ENTS_OK) continue;
    const std::size_t k = active_[e];
    const auto spread = [&](const std::vector<double>& from, std::vector<double>& to) {
      std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(e * d_), d_,
                  to.begin() + static_cast<std::ptrdiff_t>(k * d_));
    };
    fields.flags[k] = flags[e];
    fields.slip[k] = slip[e];
    fields.age[k] = age[e];
    if ((flags[e] & ENTS_FLAG_OUTSIDE) != 0) continue;
    fields.gap[k] = gap[e];
    fields.normal_gap[k] = normal_gap[e];
    fields.pressure[k] = pressure[e];
    fields.closed[k] = (flags[e] & ENTS_FLAG_CONTACT) != 0;
    spread(normal, fields.normal);
    spread(point, fields.point);
    spread(traction, fields.traction);
    for (std::size_t i = 0; i < d_; ++i) {
      fields.node_forces[k * d_ + i] = residual[e * element_dofs_ + i];
      fields.force[i] += residual[e * element_dofs_ + i];
    }
  }
  return fields;
}

} // namespace host
