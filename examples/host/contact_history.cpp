// SPDX-License-Identifier: BSD-3-Clause
// Contact: what is carried from increment to increment. Every try starts from `state_begin_`, which only `accept`
// writes: a step that is thrown away leaves nothing to undo.
#include <algorithm>
#include <cmath>

#include "contact.hpp"

namespace host {
namespace {

std::int64_t stride(std::size_t value) { return static_cast<std::int64_t>(value); }
std::ptrdiff_t offset(std::size_t value) { return static_cast<std::ptrdiff_t>(value); }

} // namespace

void Contact::begin_increment(const Configuration& begin) {
  begin_ = begin;
  segment_ = segment_begin_;
  last_xi_ = xi_begin_;
  pressure_ = accepted_.pressure;
  traction_ = accepted_.traction;
  list_active();
  auto report = ents_struct<ents_report>();
  move_history(report); // what could not be moved is told when segments are chosen
}

void Contact::move_history(ents_report& report) {
  const EntsLibrary& library = master_.model->library();
  const ents_model* model = master_.model->get();
  state_in_.assign(active_.size() * state_size_, 0.0);
  if (state_size_ > 0) {
    const std::int32_t status =
        library.state_init(model, stride(active_.size()), state_in_.data(), stride(state_size_), &report);
    if (status != ENTS_OK) throw JobError("contact state: " + describe(library, status, report));
  }
  state_out_ = state_in_;
  std::vector<double> from(m_ * d_), to(m_ * d_);
  for (std::size_t e = 0; e < active_.size(); ++e) {
    const std::size_t k = active_[e];
    if (segment_begin_[k] < 0) continue; // no history
    const double* begin = state_begin_.data() + k * state_size_;
    double* moved = state_in_.data() + e * state_size_;
    if (segment_begin_[k] == segment_[k]) {
      std::copy_n(begin, state_size_, moved);
      continue;
    }
    const auto old_segment = static_cast<std::size_t>(segment_begin_[k]), segment = static_cast<std::size_t>(segment_[k]);
    gather_master(old_segment, begin_.displacement, begin_.motion, from.data());
    gather_master(segment, begin_.displacement, begin_.motion, to.data());
    const auto coordinates = [&](std::size_t s) {
      return master_.surface_coordinates.empty() ? nullptr
                                                 : master_.surface_coordinates.data() + s * m_ * parameters_;
    };
    auto one = ents_struct<ents_report>();
    const std::int32_t status = library.state_transfer(model, from.data(), coordinates(old_segment), to.data(),
                                                       coordinates(segment), begin, moved, &one);
    if (status < 0) throw JobError("contact state: " + describe(library, status, one));
    if (status == ENTS_OK) continue;
    std::copy_n(state_out_.data() + e * state_size_, state_size_, moved); // finite; the step will be cut
    if (report.status == ENTS_OK) report = one;
  }
}

double Contact::augment(const Configuration& at, double enough) {
  const ContactFields now = fields(at);
  double largest = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    largest = std::max(largest, std::abs(now.pressure[k] - pressure_[k]) / normal_stiffness_);
    double squared = 0;
    for (std::size_t i = 0; i < d_; ++i) squared += std::pow(now.traction[k * d_ + i] - traction_[k * d_ + i], 2);
    largest = std::max(largest, std::sqrt(squared) / tangential_stiffness_);
  }
  if (largest <= enough) return largest; // the solution belongs to the multipliers it was found with
  auto report = ents_struct<ents_report>();
  const EntsLibrary& library = master_.model->library();
  const std::int32_t status =
      library.state_augment(master_.model->get(), stride(active_.size()), state_in_.data(), stride(state_size_),
                            state_out_.data(), stride(state_size_), &report);
  if (status != ENTS_OK) throw JobError("contact state: " + describe(library, status, report));
  pressure_ = now.pressure;
  traction_ = now.traction;
  return largest;
}

void Contact::accept(const Configuration& at) {
  accepted_ = fields(at);
  std::fill(segment_begin_.begin(), segment_begin_.end(), -1);
  for (std::size_t e = 0; e < active_.size(); ++e) {
    segment_begin_[active_[e]] = segment_[active_[e]];
    std::copy_n(state_out_.begin() + offset(e * state_size_), state_size_,
                state_begin_.begin() + offset(active_[e] * state_size_));
  }
  xi_begin_ = last_xi_;
  begin_increment(at);
}

ContactHistory Contact::history() const {
  return {segment_begin_, state_begin_, xi_begin_, accepted_.pressure, accepted_.traction};
}

void Contact::restore(const ContactHistory& history, const Configuration& at) {
  if (history.segment.size() != segment_begin_.size() || history.state.size() != state_begin_.size() ||
      history.xi.size() != xi_begin_.size() || history.pressure.size() != pressure_.size() ||
      history.traction.size() != traction_.size())
    throw InputError("the contact's history is that of another scene: its sizes differ");
  for (const int segment : history.segment)
    if (segment < -1 || segment >= static_cast<int>(master_.segments))
      throw InputError("the contact's history is that of another scene: no such segment");
  const auto take = [this](const ContactHistory& taken, const Configuration& begin) {
    segment_begin_ = segment_ = taken.segment;
    state_begin_ = taken.state;
    xi_begin_ = taken.xi;
    accepted_.pressure = taken.pressure;
    accepted_.traction = taken.traction;
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
