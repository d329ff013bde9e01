// SPDX-License-Identifier: BSD-3-Clause
#include "contact_states.hpp"

#include <algorithm>
#include <cmath>

namespace host {

void ContactStates::reset() {
  const std::size_t n = sides_->points.size();
  begun.segment.assign(n, -1);
  begun.xi.assign(n * sides_->parameters, 0.0);
  begin.assign(n * sides_->state_size, 0.0);
  accepted.pressure.assign(n, 0.0);
  accepted.traction.assign(n * sides_->d, 0.0);
}

void ContactStates::begin_increment() {
  pressure_ = accepted.pressure;
  traction_ = accepted.traction;
}

void ContactStates::move(const Projections& found, double time, ents_report& report) {
  const std::size_t size = sides_->state_size, nodes = sides_->m * sides_->d;
  if (size == 0) return;
  const ents::Library& library = sides_->library();
  const ents_model* model = sides_->master.model->get();
  auto one = ents_struct<ents_report>();
  const auto check = [&](std::int32_t status) {
    if (status < 0) throw JobError("contact state: " + describe(library, status, one));
    return status;
  };
  in.resize(sides_->points.size() * size);
  check(library.state_init(model, sides_->count(), in.data(), stride(size), &one));
  out = in;
  std::vector<double> from(nodes), to(nodes);
  std::vector<std::size_t> fresh;
  constexpr double closed = 2; // the least of the states' histories that are in contact
  for (std::size_t k = 0; k < sides_->points.size(); ++k) {
    const std::int64_t before = begun.segment[k], now = found.segment[k];
    const double* first = begin.data() + k * size;
    double* moved = in.data() + k * size;
    const bool was_open = first[1] < closed;
    if (now >= 0 && was_open && (before != now || first[1] == 0)) fresh.push_back(k);
    if (before < 0 || now < 0 || (was_open && before != now)) { // no history but what has been worn off
      if (const std::int32_t worn = sides_->layout().worn; worn >= 0)
        std::copy_n(first + worn, 2, moved + worn);
      continue;
    }
    if (before == now) {
      std::copy_n(first, size, moved);
      continue;
    }
    sides_->gather(before, from), sides_->gather(now, to);
    if (check(library.state_transfer(model, from.data(), sides_->coordinates(before), to.data(),
                                     sides_->coordinates(now), first, moved, &one)) == ENTS_OK)
      continue;
    std::copy_n(out.data() + k * size, size, moved); // a valid one; the step will be cut
    if (report.status == ENTS_OK) report = one;
  }
  if (sides_->has_history()) find_begin(fresh, found, time);
}

void ContactStates::find_begin(const std::vector<std::size_t>& points, const Projections& found,
                               double time) {
  if (points.empty() || sides_->slave_begin.empty()) return;
  const std::size_t n = points.size(), size = sides_->state_size, d = sides_->d, xis = sides_->parameters;
  std::vector<double> slaves, states, xi, none(n * sides_->multipliers), end(n * size);
  std::vector<std::int64_t> segments;
  std::vector<std::int32_t> status(n);
  const auto add = [](const std::vector<double>& from, std::size_t k, std::size_t each,
                      std::vector<double>& to) {
    to.insert(to.end(), from.data() + k * each, from.data() + (k + 1) * each);
  };
  for (const std::size_t k : points) {
    add(sides_->slave_begin, k, d, slaves), add(in, k, size, states), add(found.xi, k, xis, xi);
    segments.push_back(found.segment[k]);
  }
  ents_master_mesh where = sides_->mesh();
  where.positions = sides_->master_begin.data();
  auto input = ents_struct<ents_input>();
  input.slave = slaves.data(), input.slave_stride = stride(d);
  input.mesh = &where;
  input.segment = segments.data(), input.segment_stride = 1;
  input.time_increment = time;
  input.start = xi.data(), input.start_stride = stride(xis);
  input.state_begin = states.data(), input.state_begin_stride = stride(size);
  if (sides_->multipliers > 0)
    input.multiplier = none.data(), input.multiplier_stride = stride(sides_->multipliers);
  auto output = ents_struct<ents_output>();
  output.wanted = ENTS_STATE;
  output.state_end = end.data(), output.state_end_stride = stride(size);
  output.status = status.data(), output.status_stride = 1;
  auto report = ents_struct<ents_report>();
  const ents::Library& library = sides_->library();
  if (const std::int32_t failed =
          library.evaluate(sides_->master.model->get(), 0, stride(n), &input, &output, &report);
      failed < 0)
    throw JobError("contact state: " + describe(library, failed, report));
  const std::int32_t worn = sides_->layout().worn;
  for (std::size_t i = 0; i < n; ++i) {
    if (status[i] != ENTS_OK) continue; // its way is not known
    double *to = in.data() + points[i] * size, *from = end.data() + i * size;
    if (worn >= 0) std::copy_n(to + worn, 2, from + worn); // an evaluation of the begin wears nothing
    std::copy_n(from, size, to);
  }
}

double ContactStates::augment(const ContactFields& now, double normal, double tangential, double enough) {
  double largest = 0;
  for (std::size_t k = 0; k < sides_->points.size(); ++k) {
    largest = std::max(largest, std::abs(now.pressure[k] - pressure_[k]) / normal);
    double squared = 0;
    for (std::size_t i = k * sides_->d; i < (k + 1) * sides_->d; ++i)
      squared += std::pow(now.traction[i] - traction_[i], 2);
    largest = std::max(largest, std::sqrt(squared) / tangential);
  }
  if (largest <= enough) return largest; // the solution belongs to the multipliers it was found with
  auto report = ents_struct<ents_report>();
  const std::int64_t size = stride(sides_->state_size);
  const std::int32_t status = sides_->library().state_augment(sides_->master.model->get(), sides_->count(),
                                                              in.data(), size, out.data(), size, &report);
  if (status != ENTS_OK) throw JobError("contact state: " + describe(sides_->library(), status, report));
  pressure_ = now.pressure;
  traction_ = now.traction;
  return largest;
}

void ContactStates::accept(const Projections& found, ContactFields fields) {
  begun = found;
  begin = out;
  accepted = std::move(fields);
}

} // namespace host
