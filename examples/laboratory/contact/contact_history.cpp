// SPDX-License-Identifier: BSD-3-Clause
// Contact: what is carried from increment to increment. Every try starts from `state_begin_`, which only
// `accept` writes: a step that is thrown away leaves nothing to undo.
#include <algorithm>
#include <cmath>

#include "contact.hpp"

namespace host {
namespace {

bool fields_fit(const std::map<std::string, std::vector<double>>& theirs,
                const std::map<std::string, std::vector<double>>& ours) {
  return theirs.size() == ours.size() &&
         std::equal(theirs.begin(), theirs.end(), ours.begin(), [](const auto& one, const auto& other) {
           return one.first == other.first && one.second.size() == other.second.size();
         });
}

} // namespace

void Contact::begin_increment(const Configuration& begin) {
  begin_ = begin;
  master_begin_ = master_points(begin.displacement);
  if (has_history() || one_surface_) slave_begin_ = slave_points(begin);
  measure_thickness(begin);
  at_ = begin_at_;
  pressure_ = accepted_.pressure;
  traction_ = accepted_.traction;
  for (std::size_t k = 0; k < points_.size() && !wear_factor_.points.empty(); ++k)
    slave_values_[slave_numbers_ * k + 1] = wear_factor_.at(accepted_.pressure[k]);
  closed_.assign(points_.size(), 0);
  for (std::size_t k = 0; k < points_.size(); ++k) closed_[k] = accepted_.pressure[k] != 0;
  auto report = ents_struct<ents_report>();
  move_history(report); // what could not be moved is reported by the next search
}

void Contact::gather(std::int64_t segment, std::vector<double>& positions) const {
  for (std::size_t a = 0; a < m_; ++a)
    for (std::size_t i = 0; i < d_; ++i) {
      const auto at =
          static_cast<std::size_t>(master_.connectivity[static_cast<std::size_t>(segment) * m_ + a]) * d_ + i;
      positions[a * d_ + i] = master_begin_[at];
    }
}

void Contact::move_history(ents_report& report) {
  if (state_size_ == 0) return;
  const ents::Library& library = master_.model->library();
  const ents_model* model = master_.model->get();
  auto one = ents_struct<ents_report>();
  const auto check = [&](std::int32_t status) {
    if (status < 0) throw JobError("contact state: " + describe(library, status, one));
    return status;
  };
  state_in_.resize(points_.size() * state_size_);
  check(library.state_init(model, count(), state_in_.data(), stride(state_size_), &one));
  state_out_ = state_in_;
  std::vector<double> from(m_ * d_), to(m_ * d_);
  const auto coordinates = [&](std::int64_t segment) {
    return master_.surface_coordinates.empty()
               ? nullptr
               : master_.surface_coordinates.data() + static_cast<std::size_t>(segment) * m_ * parameters_;
  };
  std::vector<std::size_t> fresh;
  constexpr double closed = 2; // the least of the states' histories that are in contact
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const std::int64_t before = begin_at_.segment[k], now = at_.segment[k];
    const double* begin = state_begin_.data() + k * state_size_;
    double* moved = state_in_.data() + k * state_size_;
    const bool was_open = begin[1] < closed;
    if (now >= 0 && was_open && (before != now || begin[1] == 0)) fresh.push_back(k);
    if (before < 0 || now < 0 || (was_open && before != now)) { // no history but what has been worn off
      if (const std::int32_t worn = master_.model->layout().worn; worn >= 0)
        std::copy_n(begin + worn, 2, moved + worn);
      continue;
    }
    if (before == now) {
      std::copy_n(begin, state_size_, moved);
      continue;
    }
    gather(before, from), gather(now, to);
    if (check(library.state_transfer(model, from.data(), coordinates(before), to.data(), coordinates(now),
                                     begin, moved, &one)) == ENTS_OK)
      continue;
    std::copy_n(state_out_.data() + k * state_size_, state_size_, moved); // a valid one; the step will be cut
    if (report.status == ENTS_OK) report = one;
  }
  if (has_history()) find_begin(fresh);
}

void Contact::find_begin(const std::vector<std::size_t>& points) {
  if (points.empty() || slave_begin_.empty()) return;
  const auto n = points.size();
  std::vector<double> slaves, states, xi, none, end(n * state_size_);
  std::vector<std::int64_t> segments;
  std::vector<std::int32_t> status(n);
  for (const std::size_t k : points) {
    slaves.insert(slaves.end(), slave_begin_.data() + k * d_, slave_begin_.data() + (k + 1) * d_);
    states.insert(states.end(), state_in_.data() + k * state_size_, state_in_.data() + (k + 1) * state_size_);
    xi.insert(xi.end(), at_.xi.data() + k * parameters_, at_.xi.data() + (k + 1) * parameters_);
    segments.push_back(at_.segment[k]);
    none.resize(none.size() + multipliers_);
  }
  ents_master_mesh where = mesh();
  where.positions = master_begin_.data();
  auto in = ents_struct<ents_input>();
  in.slave = slaves.data(), in.slave_stride = stride(d_);
  in.mesh = &where;
  in.segment = segments.data(), in.segment_stride = 1;
  in.time_increment = time_increment_;
  in.start = xi.data(), in.start_stride = stride(parameters_);
  in.state_begin = states.data(), in.state_begin_stride = stride(state_size_);
  if (multipliers_ > 0) in.multiplier = none.data(), in.multiplier_stride = stride(multipliers_);
  auto out = ents_struct<ents_output>();
  out.wanted = ENTS_STATE;
  out.state_end = end.data(), out.state_end_stride = stride(state_size_);
  out.status = status.data(), out.status_stride = 1;
  auto report = ents_struct<ents_report>();
  const ents::Library& library = master_.model->library();
  if (const std::int32_t failed = library.evaluate(master_.model->get(), 0, stride(n), &in, &out, &report);
      failed < 0)
    throw JobError("contact state: " + describe(library, failed, report));
  const std::int32_t worn = master_.model->layout().worn;
  for (std::size_t i = 0; i < n; ++i) {
    if (status[i] != ENTS_OK) continue; // its way is not known
    double *to = state_in_.data() + points[i] * state_size_, *from = end.data() + i * state_size_;
    if (worn >= 0) std::copy_n(to + worn, 2, from + worn); // an evaluation of the begin wears nothing
    std::copy_n(from, state_size_, to);
  }
}

double Contact::augment(const Configuration& at, double enough) {
  const ContactFields now = fields(at);
  double largest = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    largest = std::max(largest, std::abs(now.pressure[k] - pressure_[k]) / normal_stiffness_);
    double squared = 0;
    for (std::size_t i = 0; i < d_; ++i)
      squared += std::pow(now.traction[k * d_ + i] - traction_[k * d_ + i], 2);
    largest = std::max(largest, std::sqrt(squared) / tangential_stiffness_);
  }
  if (largest <= enough) return largest; // the solution belongs to the multipliers it was found with
  auto report = ents_struct<ents_report>();
  const ents::Library& library = master_.model->library();
  const std::int32_t status =
      library.state_augment(master_.model->get(), count(), state_in_.data(), stride(state_size_),
                            state_out_.data(), stride(state_size_), &report);
  if (status != ENTS_OK) throw JobError("contact state: " + describe(library, status, report));
  pressure_ = now.pressure;
  traction_ = now.traction;
  return largest;
}

void Contact::accept(const Configuration& at) {
  accepted_ = fields(at);
  state_begin_ = state_out_;
  set_worn();
  collect_wear();
  begin_at_ = at_;
  begin_increment(at);
}

double Contact::worn_slave() const {
  double sum = 0;
  for (std::size_t k = 0; k < accepted_.worn.size(); ++k) sum += points_.areas[k] * accepted_.worn[k];
  return sum;
}

double Contact::slid() const {
  const std::vector<double>& start = master_.model->defaults();
  return sliding_ < start.size() ? begin_.parameters[sliding_] - start[sliding_] : 0;
}

void Contact::set_worn() {
  accepted_.worn.clear();
  for (std::size_t k = 0; wears() && k < points_.size(); ++k)
    accepted_.worn.push_back(
        state_begin_[k * state_size_ + static_cast<std::size_t>(master_.model->layout().worn)] +
        (given_away_.empty() ? 0 : given_away_[k]));
}

std::map<std::string, std::vector<double>> Contact::slave_fields() const {
  return cut_.surface ? cut_.surface->fields() : std::map<std::string, std::vector<double>>{};
}

void Contact::collect_slave_wear() {
  if (!wears() || slave_fields().empty()) return;
  given_away_ = accepted_.worn; // all that it has lost is in the field then
  cut_.surface->collect(*master_.model, points_, thickness_, state_begin_);
  cut_.surface->raise(points_);
}

void Contact::collect_wear() {
  collect_slave_wear();
  if (!wears() || master_.model->fields().empty()) return;
  const ents::Library& library = master_.model->library();
  auto& [name, block] = *master_.model->fields().begin();
  const ents_master_mesh where = mesh();
  ents_input in = input(where);
  in.state_begin = nullptr, in.state_begin_stride = 0;
  auto report = ents_struct<ents_report>();
  double volume = 0;
  const std::int32_t status = library.wear_collect(master_.model->get(), 0, count(), &in, thickness_,
                                                   state_begin_.data(), stride(state_size_), name.c_str(),
                                                   block.data(), stride(block.size()), &volume, &report);
  if (status != ENTS_OK) throw JobError("wear of the master: " + describe(library, status, report));
  worn_master_ += volume;
  bound_.clear();
}

void Contact::restore(const ContactHistory& history, const Configuration& at) {
  if (cuts_again()) {
    if (!history.at.segment.empty() || !history.pressure.empty() ||
        !fields_fit(history.fields, master_.model->fields()) ||
        !fields_fit(history.slave_fields, slave_fields()))
      throw InputError("the contact's history is that of another scene: its sizes differ");
    master_.model->fields() = history.fields;
    if (cut_.surface) cut_.surface->take(history.slave_fields);
    bound_.clear();
    cut_at_ = {};
    cut_again(at);
    return;
  }
  if (history.at.segment.size() != begin_at_.segment.size() || history.state.size() != state_begin_.size() ||
      history.at.xi.size() != begin_at_.xi.size() || history.pressure.size() != pressure_.size() ||
      history.traction.size() != traction_.size() || history.thickness.size() != thickness_below_.size() ||
      !fields_fit(history.fields, master_.model->fields()) ||
      !fields_fit(history.slave_fields, slave_fields()) ||
      (!history.given_away.empty() && history.given_away.size() != points_.size()))
    throw InputError("the contact's history is that of another scene: its sizes differ");
  for (const std::int64_t segment : history.at.segment)
    if (segment < -1 || segment >= stride(master_.segments()))
      throw InputError("the contact's history is that of another scene: no such segment");
  const auto take = [this](const ContactHistory& taken, const Configuration& begin) {
    begin_at_ = taken.at;
    state_begin_ = taken.state;
    accepted_.pressure = taken.pressure;
    accepted_.traction = taken.traction;
    master_.model->fields() = taken.fields;
    worn_master_ = taken.worn_master;
    thickness_below_ = taken.thickness;
    given_away_ = taken.given_away;
    if (!taken.slave_fields.empty()) cut_.surface->take(taken.slave_fields), cut_.surface->raise(points_);
    bound_.clear();
    set_worn();
    begin_increment(begin);
  };
  const ContactHistory kept = this->history();
  const Configuration begin = begin_;
  try {
    take(history, at);
    fields(at); // the library refuses a state block that is not its own
  } catch (...) {
    take(kept, begin);
    throw;
  }
}

} // namespace host
