// SPDX-License-Identifier: BSD-3-Clause
// Simulation: what the increments need around Newton's iteration: segments, first contact,
// factors, another try.
#include <algorithm>
#include <cmath>
#include <limits>

#include "holding.hpp"
#include "simulation.hpp"
#include "stopwatch.hpp"

namespace host {

// Not where history counts: a run must end with the same bits whatever was tried in between, and factors
// depend on what was tried. Points that are cut anew have new equations.
bool Simulation::keeps_factors() const {
  return !contact_ || (!contact_->has_history() && !contact_->cuts_again());
}

void Simulation::note_factors(const Configuration& at) {
  if (keeps_factors()) factored_ = {at, contact_ ? contact_->start() : ElementStart()};
}

bool Simulation::force_controlled() const {
  return scene_->control == Control::force || scene_->control == Control::mean_pressure;
}

bool Simulation::choose(const Configuration& at, bool only_lost, std::string& reason, double& step_factor) {
  if (!contact_) return true;
  // The search refuses positions beyond 1e100; an iteration that diverges comes there.
  if (std::any_of(at.displacement.begin(), at.displacement.end(),
                  [](double u) { return !(std::abs(u) < 1e50); })) {
    reason = "Newton's iteration diverges", step_factor = 0.5;
    return false;
  }
  const Stopwatch watch;
  const CpuStopwatch cpu;
  auto report = ents_struct<ents_report>();
  const bool changed = contact_->choose(at, only_lost, report);
  timings_.contact += watch.seconds();
  timings_.contact_cpu += cpu.seconds();
  if (changed && !contact_->master().rigid) {
    const Stopwatch equations;
    build_pattern();
    timings_.setup += equations.seconds();
  }
  if (report.status == ENTS_OK) return true;
  reason = describe(contact_->master().model->library(), report.status, report);
  step_factor = report.step_factor > 0 && report.step_factor < 1 ? report.step_factor : 0.5;
  return false;
}

void Simulation::find_contact(Configuration& at) {
  const ContactFields fields = contact_->fields(at);
  double smallest = std::numeric_limits<double>::infinity(), sum = 0;
  std::size_t count = 0;
  for (const double gap : fields.gap)
    if (!std::isnan(gap)) smallest = std::min(smallest, gap), sum += gap, ++count;
  if (count == 0)
    throw JobError(
        "no slave node has a projection on the master: is it in the way of the motion, and does its "
        "normal (order of its nodes) point to the slave surface?");
  // Touch with a little more than the first node; the iteration finds the rest.
  const double spread = sum / static_cast<double>(count) - smallest;
  const double overlap = std::max(0.01 * spread, 1e-6 * std::abs(smallest));
  at.motion += std::max(0., smallest + overlap);
  // What wears off in this increment opens a gap that the fields do not have.
  double step = std::max(overlap, 1e-9 * contact_->size());
  for (int doubled = 0; doubled < 100 && contact_->wears() && !touches(at); ++doubled, step *= 2)
    at.motion += step;
}

bool Simulation::touches(const Configuration& at) {
  const std::vector<char> closed = contact_->fields(at).closed;
  return std::find(closed.begin(), closed.end(), 1) != closed.end();
}

std::string Simulation::advice_if_singular(const Configuration& at) {
  if (!contact_ || !contact_->master().translates()) return "";
  const std::vector<char> closed = contact_->fields(at).closed;
  if (std::any_of(closed.begin(), closed.end(), [](char c) { return c != 0; })) return "";
  return "no slave node is in contact with the rigid master: do its normal (order of its nodes) and its "
         "direction point to "
         "the slave surface?";
}

std::string Simulation::nothing_holds(const Configuration& begin) {
  if (!contact_ || layer_) return "";
  const std::string body = what_can_move(mesh_, *dofs_, springs_, *scene_);
  if (body.empty()) return "";
  contact_->begin_increment(now_);
  auto report = ents_struct<ents_report>();
  contact_->choose(begin, false, report);
  const std::vector<char> closed = contact_->fields(begin).closed;
  if (std::any_of(closed.begin(), closed.end(), [](char c) { return c != 0; })) return "";
  return "nothing holds the bodies: " + body + ", and no slave node is in contact yet";
}

NewtonOutcome Simulation::advance(const Target& target, bool keep) {
  const LineSearch search = scene_->solver.line_search;
  if (contact_ && contact_->pulls() && search != LineSearch::never && contact_->conservative(true))
    return attempt(target, keep, false, contact_->conservative(false) ? Search::energy : Search::work);
  const Search always = search == LineSearch::always ? Search::residual : Search::none;
  if (scene_->solver.extrapolate && !rate_.empty()) {
    NewtonOutcome outcome = attempt(target, keep, true, always);
    if (outcome.converged) return outcome;
  }
  NewtonOutcome outcome = attempt(target, keep, false, always);
  if (outcome.converged || search != LineSearch::when_needed || !outcome.line_search_may_help) return outcome;
  NewtonOutcome searched = attempt(target, keep, false, Search::residual);
  if (!searched.converged && contact_ && contact_->pulls() && outcome.advice.empty())
    outcome.advice =
        "surfaces may jump here, and there is no energy to descend with wear, multipliers or a rigid body "
        "that turns";
  return searched.converged ? searched : outcome;
}

} // namespace host
