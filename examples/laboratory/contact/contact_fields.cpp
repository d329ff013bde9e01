// SPDX-License-Identifier: BSD-3-Clause
// Contact: what a person wants to know about every slave node.
#include <limits>
#include <numeric>

#include "contact.hpp"

namespace host {

ContactFields Contact::fields(const Configuration& at) {
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  sides_.place(at);
  const std::size_t slaves = sides_.points.size();
  const auto stride = static_cast<std::int64_t>(sides_.d);
  ContactFields fields;
  fields.gap.resize(slaves), fields.normal_gap.resize(slaves), fields.pressure.resize(slaves);
  fields.slip.resize(slaves), fields.age.resize(slaves), fields.flags.resize(slaves);
  fields.normal.resize(slaves * sides_.d), fields.point.resize(slaves * sides_.d),
      fields.traction.resize(slaves * sides_.d);
  auto out = ents_struct<ents_output>();
  out.wanted = ENTS_GAP | ENTS_NORMAL_GAP | ENTS_PRESSURE | ENTS_NORMAL | ENTS_POINT | ENTS_FLAGS |
               ENTS_TRACTION | ENTS_SLIP | ENTS_AGE;
  out.gap = fields.gap.data(), out.gap_stride = 1;
  out.normal_gap = fields.normal_gap.data(), out.normal_gap_stride = 1;
  out.pressure = fields.pressure.data(), out.pressure_stride = 1;
  out.normal = fields.normal.data(), out.normal_stride = stride;
  out.point = fields.point.data(), out.point_stride = stride;
  out.traction = fields.traction.data(), out.traction_stride = stride;
  out.slip = fields.slip.data(), out.slip_stride = 1;
  out.age = fields.age.data(), out.age_stride = 1;
  out.flags = fields.flags.data(), out.flags_stride = 1;
  std::vector<double> dissipation;
  if (sides_.layout().friction != 0) {
    dissipation.resize(slaves), out.wanted |= ENTS_DISSIPATION;
    out.dissipation = dissipation.data(), out.dissipation_stride = 1;
  }
  std::vector<std::int32_t> status(slaves);
  out.status = status.data(), out.status_stride = 1;

  // The forces on the slave points, one equation for each of their dofs, and none for the master.
  fields.node_forces.assign(slaves * sides_.d, 0.0);
  const std::vector<std::int64_t> none(std::max(tangent_.unknowns().of_master.size(), multiplier_count()),
                                       -1);
  std::vector<std::int64_t> equations(slaves * sides_.d);
  for (std::size_t i = 0; i < equations.size(); ++i) equations[i] = static_cast<std::int64_t>(i);
  auto system = ents_struct<ents_system>();
  system.index_size = sizeof(int);
  system.slave_nodes = sides_.count(), system.slave_equations = equations.data();
  auto net = ents_struct<ents_combination>();
  sides_.set_master(system, net, none);
  system.multiplier_equations = none.data();
  system.rows = static_cast<std::int64_t>(equations.size());
  system.residual = fields.node_forces.data();
  auto report = ents_struct<ents_report>();
  add_elements(out, system, report);

  fields.dissipation = std::accumulate(dissipation.begin(), dissipation.end(), 0.0);
  if (sides_.frame.turns()) { // the forces are in space already
    sides_.frame.turn(fields.normal), sides_.frame.turn(fields.traction), sides_.frame.to_space(fields.point);
    fields.moment = sides_.frame.moment(positions(at.displacement), fields.node_forces);
  }
  fields.closed.assign(slaves, 0);
  const std::vector<std::int32_t>& side = search_.left_out().side;
  fields.segment = at_.segment;
  fields.force.assign(sides_.d, 0.0);
  for (std::size_t k = 0; k < slaves; ++k) {
    fields.closed[k] = (fields.flags[k] & ENTS_FLAG_CONTACT) != 0;
    if (sides_.master.profile) fields.gap[k] += values_.offset(k), fields.normal_gap[k] += values_.offset(k);
    // With two passes that on the master's side; of one surface they add up to zero.
    const double sign = !side.empty() && side[k] == 1 ? -1 : 1;
    for (std::size_t i = 0; i < sides_.d; ++i) {
      fields.force[i] += sign * fields.node_forces[k * sides_.d + i];
      if (sides_.master.translates())
        fields.point[k * sides_.d + i] += at.motion * sides_.master.direction[i];
    }
    if (status[k] == ENTS_OK && (fields.flags[k] & ENTS_FLAG_OUTSIDE) == 0) continue;
    if (status[k] != ENTS_OK) fields.flags[k] = ENTS_FLAG_OUTSIDE;
    fields.gap[k] = fields.normal_gap[k] = not_a_number;
    for (std::size_t i = 0; i < sides_.d; ++i)
      fields.normal[k * sides_.d + i] = 0, fields.point[k * sides_.d + i] = not_a_number;
  }
  return fields;
}

} // namespace host
