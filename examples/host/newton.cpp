// SPDX-License-Identifier: BSD-3-Clause
// Simulation: Newton's iteration for one increment.
#include <algorithm>
#include <cmath>
#include <limits>

#include "advice.hpp"
#include "holding.hpp"
#include "output/table.hpp"
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
    throw JobError("no slave node has a projection on the master: is it in the way of the motion?");
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
  if (scene_->solver.extrapolate && !rate_.empty()) {
    NewtonOutcome outcome = attempt(target, keep, true);
    if (outcome.converged) return outcome;
  }
  return attempt(target, keep, false);
}

NewtonOutcome Simulation::attempt(const Target& target, bool keep, bool extrapolate) {
  const Stopwatch watch;
  NewtonOutcome outcome;
  Configuration at = now_, next = now_;
  if (!target.parameters.empty()) at.parameters = next.parameters = target.parameters;
  const bool by_force = force_controlled();
  const double share = 1. / scene_->symmetry_copies;
  next.load_factor = target.load_factor;
  if (scene_->control == Control::force) next.force = target.value * share;
  if (scene_->control == Control::mean_pressure) next.force = target.value * contact_area();
  const double motion_step = scene_->control == Control::approach ? target.value - now_.motion : 0;

  Configuration begin = now_;
  const auto fail = [&](const std::string& reason, double factor) {
    outcome.reason = reason, outcome.step_factor = factor;
    if (const std::string free = nothing_holds(begin); !free.empty()) {
      outcome.reason = free;
      outcome.advice = "give it supports or springs, or let the surfaces overlap a little in the scene";
      outcome.step_factor = 0; // no smaller step is held either
    }
    timings_.total += watch.seconds();
    return outcome;
  };
  const auto fail_there = [&](const Evaluation& evaluation) {
    outcome.advice = evaluation.advice;
    return fail(evaluation.reason, evaluation.step_factor);
  };

  if (contact_ && contact_->cut_again(now_)) build_pattern();
  if (contact_) contact_->begin_increment(now_);
  if (!choose(at, false, outcome.reason, outcome.step_factor))
    return fail(outcome.reason, outcome.step_factor);
  if (by_force && (now_.force <= 0 || (contact_->wears() && !touches(at)))) {
    find_contact(at);
    begin = at;
    next.motion = at.motion;
  }
  // First the tangent at the present configuration takes the whole jump of loads and prescribed values, or
  // the motion of the last increment goes on: a sliding contact whose tangent sticks would drag the surfaces
  // along ...
  const double size = target.load_factor - now_.load_factor;
  for (std::size_t i = 0; extrapolate && i < next.displacement.size(); ++i)
    next.displacement[i] += size * rate_[i];
  prescribe(next);
  std::vector<double> jump(at.displacement.size(), 0.0);
  bool jumps = false;
  for (std::size_t dof = 0; dof < jump.size(); ++dof)
    if (dofs_->equation(dof) < 0) {
      jump[dof] = next.displacement[dof] - at.displacement[dof];
      jumps = jumps || jump[dof] != 0;
    }
  if (!jumps) jump.clear();
  at.load_factor = next.load_factor;
  // A guess: the factors left by the last increment serve it as well as new ones.
  const bool factorize = !factors_fit_;
  factors_fit_ = false;
  Evaluation state;
  const auto error_of = [&](const Evaluation& evaluation) {
    return by_force ? evaluation.coupling.force - next.force : 0;
  };
  if (!extrapolate) {
    state = evaluate(at, jump, factorize);
    if (!state.ok) return fail_there(state);
    if (factorize) note_factors(at);
    if (!solve(state, factorize, motion_step, error_of(state), next)) {
      outcome.advice = advice_if_singular(at);
      return fail("the tangent is singular", 0.5);
    }
  }

  // ... then Newton's iteration; with multipliers in the state again and again, until they stay.
  const double enough = contact_ ? scene_->solver.gap_tolerance * contact_->size() : 0;
  IterationHistory history; // with the present multipliers
  constexpr int looked_back = 4;
  std::string lost;
  for (int iteration = 1; iteration <= scene_->solver.max_iterations; ++iteration) {
    // Segments are chosen anew during the first iterations; then nodes stay that project inside theirs or its
    // margin: beside a kink of a plain mesh they could otherwise change sides for ever.
    if (outcome.augmentations.empty() &&
        !choose(next, iteration > scene_->solver.segment_choices, outcome.reason, outcome.step_factor))
      return fail(outcome.reason, outcome.step_factor);
    state = evaluate(next, {}, true);
    if (!state.ok) return fail_there(state);
    double relative = relative_residual(state);
    if (by_force) relative = std::max(relative, std::abs(error_of(state)) / next.force);
    history.residuals.push_back(relative);
    history.switches.push_back(contact_ ? contact_->switches() : 0);
    history.moves.push_back(contact_ ? contact_->moves() : 0);
    if (outcome.augmentations.empty()) {
      outcome.residuals.push_back(relative);
      outcome.status_changes.push_back(contact_ ? contact_->status_changes() : 0);
    } else {
      outcome.augmentations.back().iterations = iteration;
    }
    if (!std::isfinite(relative)) return fail("the residual is not finite", 0.5);
    if (relative <= scene_->solver.tolerance) {
      if (contact_ && contact_->augmentable()) {
        const double error = contact_->augment(next, enough);
        if (error > enough) {
          if (static_cast<int>(outcome.augmentations.size()) == scene_->solver.max_augmentations)
            return fail("no convergence of the multipliers in " +
                            std::to_string(scene_->solver.max_augmentations) + " augmentations",
                        0.5);
          outcome.augmentations.push_back({error, 0});
          iteration = 0;
          history = {};
          continue;
        }
        outcome.augmentations.push_back({error, 0});
      }
      if (contact_ && !contact_->lost().empty()) {
        outcome.advice = advice_if_lost(scene_->contact->model, contact_->lost_behind_edge());
        return fail(std::string(contact_->lost()), 0.5);
      }
      outcome.converged = true;
      timings_.total += watch.seconds();
      if (!keep) return outcome;
      if (contact_) {
        contact_->keep_rotation(next);
        contact_->accept(next);
        if (contact_->master().translates()) next.force = state.coupling.force;
      }
      if (scene_->solver.extrapolate && size != 0) {
        rate_.resize(next.displacement.size());
        for (std::size_t i = 0; i < rate_.size(); ++i)
          rate_[i] = (next.displacement[i] - now_.displacement[i]) / size;
      }
      now_ = next;
      factors_fit_ = factored_.has_value();
      return outcome;
    }
    if (contact_ && iteration > scene_->solver.max_iterations - looked_back && lost.empty())
      lost = contact_->lost();
    note_factors(next);
    if (!solve(state, true, 0, error_of(state), next)) {
      outcome.advice = advice_if_singular(next);
      return fail("the tangent is singular", 0.5);
    }
  }
  // The last residuals tell a flip-flop (they come back) from a divergence (they grow).
  std::string last;
  const std::vector<double>& residuals = history.residuals;
  for (std::size_t i = residuals.size() - std::min<std::size_t>(residuals.size(), 4); i < residuals.size();
       ++i)
    last += " " + format_number(residuals[i], 2);
  const Json model = contact_ ? scene_->contact->model : Json();
  outcome.advice = advice_if_stuck(history, model);
  if (!lost.empty()) outcome.advice = lost + ": " + advice_if_lost(model, contact_->lost_behind_edge());
  return fail("no convergence in " + std::to_string(scene_->solver.max_iterations) +
                  " iterations, residuals" + last,
              0.5);
}

} // namespace host
