// SPDX-License-Identifier: BSD-3-Clause
#include "contact_wear.hpp"

namespace host {

void ContactWear::begin_increment(const std::vector<double>& pressure, SlaveValues& values) const {
  for (std::size_t k = 0; k < pressure.size() && !factor_.points.empty(); ++k)
    values.wear_factor(k) = factor_.at(pressure[k]);
}

std::map<std::string, std::vector<double>> ContactWear::slave_fields() const {
  return sides_->cut.surface ? sides_->cut.surface->fields() : std::map<std::string, std::vector<double>>{};
}

void ContactWear::take_slave_fields(const std::map<std::string, std::vector<double>>& fields) {
  if (!sides_->cut.surface) return;
  sides_->cut.surface->take(fields);
  sides_->cut.surface->raise(sides_->points);
}

void ContactWear::collect_slave(ContactStates& states) {
  if (slave_fields().empty()) return;
  given_away = states.accepted.worn; // all that it has lost is in the field then
  sides_->cut.surface->collect(*sides_->master.model, sides_->points, thickness_, states.begin);
  sides_->cut.surface->raise(sides_->points);
}

void ContactWear::collect(ents_input input, ContactStates& states) {
  if (acts()) collect_slave(states);
  std::map<std::string, std::vector<double>>& fields = sides_->master.model->fields();
  if (!acts() || fields.empty()) return;
  auto& [name, block] = *fields.begin();
  input.state_begin = nullptr, input.state_begin_stride = 0;
  auto report = ents_struct<ents_report>();
  double volume = 0;
  const std::int32_t status = sides_->library().wear_collect(
      sides_->master.model->get(), 0, sides_->count(), &input, thickness_, states.begin.data(),
      stride(sides_->state_size), name.c_str(), block.data(), stride(block.size()), &volume, &report);
  if (status != ENTS_OK) throw JobError("wear of the master: " + describe(sides_->library(), status, report));
  of_master += volume;
  sides_->unbind();
}

void ContactWear::read_depths(ContactStates& states) const {
  states.accepted.worn.clear();
  for (std::size_t k = 0; acts() && k < sides_->points.size(); ++k)
    states.accepted.worn.push_back(
        states.begin[k * sides_->state_size + static_cast<std::size_t>(sides_->layout().worn)] +
        (given_away.empty() ? 0 : given_away[k]));
}

void ContactWear::open_gaps(ContactStates& states) const {
  for (std::size_t k = 0; acts() && k < sides_->points.size(); ++k) {
    const double* lost =
        &states.begin[k * sides_->state_size + static_cast<std::size_t>(sides_->layout().worn)];
    states.accepted.gap[k] += lost[0] + lost[1], states.accepted.normal_gap[k] += lost[0] + lost[1];
  }
}

double ContactWear::of_slave(const ContactStates& states) const {
  double sum = 0;
  for (std::size_t k = 0; k < states.accepted.worn.size(); ++k)
    sum += sides_->points.areas[k] * states.accepted.worn[k];
  return sum;
}

} // namespace host
