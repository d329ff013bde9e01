// SPDX-License-Identifier: BSD-3-Clause
#include "newton.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace host {
namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string shown(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

} // namespace

int Step::iterations() const {
  std::size_t sum = 0;
  for (const Increment& increment : increments) sum += increment.residuals.size();
  return static_cast<int>(sum);
}

Newton::Newton(Equations& equations, Say say) : equations_(&equations), say_(std::move(say)) {
  now_.displacement.assign(equations.dofs(), 0.0);
  Contact* contact = equations.contact();
  if (contact == nullptr) return;
  const Outcome found = equations.search(now_);
  if (!found.ok) throw JobError("before the first step: " + found.reason);
  double smallest = std::nan("");
  for (const double gap : contact->results(now_).gap) smallest = std::fmin(smallest, gap);
  if (contact->rigid() && std::isfinite(smallest)) first_touch_ = smallest;
}

/// With a prescribed force the master begins where a few points touch: the iteration finds the rest.
void Newton::touch(Configuration& at) {
  double smallest = INFINITY, sum = 0;
  int count = 0;
  for (const double gap : equations_->contact()->results(at).gap)
    if (!std::isnan(gap)) smallest = std::min(smallest, gap), sum += gap, ++count;
  if (count == 0)
    throw JobError(
        "no slave point has a projection on the master: is it in the way of the motion, and does its "
        "normal (order of its nodes) point to the slave surface?");
  at.motion += std::max(0., smallest + std::max(0.01 * (sum / count - smallest), 1e-6 * std::abs(smallest)));
}

Outcome Newton::attempt(double value, double duration, Increment& increment) {
  const Scene& scene = equations_->scene();
  const double last = scene.steps.back();
  Contact* contact = equations_->contact();
  Configuration at = now_, next = now_;
  next.load_factor = scene.control == Control::load_factor ? value : last != 0 ? value / last : 1;
  if (scene.control == Control::force) at.force = next.force = value / scene.symmetry_copies;
  if (scene.control == Control::mean_pressure) at.force = next.force = value * equations_->slave_area();
  equations_->prescribe(next);
  if (contact) contact->begin_increment(now_, duration);
  if (const Outcome found = equations_->search(at); !found.ok) return found;
  if (scene.by_force() && now_.force <= 0) {
    touch(at), next.motion = at.motion;
    if (const Outcome found = equations_->search(at); !found.ok) return found;
  }

  // The tangent at the begin takes the jump of loads, supports and the master's motion.
  std::vector<double> jump(next.displacement.size());
  for (std::size_t dof = 0; dof < jump.size(); ++dof)
    jump[dof] = next.displacement[dof] - at.displacement[dof];
  at.load_factor = next.load_factor;
  Equations::State state = equations_->evaluate(at, jump);
  if (!state.outcome.ok) return state.outcome;
  const double motion_step = scene.control == Control::approach ? value - now_.motion : 0;
  if (!equations_->solve(state, motion_step, next)) return {false, "the tangent is singular", 0.5};

  for (int iteration = 1; iteration <= scene.max_iterations; ++iteration) {
    if (const Outcome found = equations_->search(next); !found.ok) return found;
    state = equations_->evaluate(next);
    if (!state.outcome.ok) return state.outcome;
    const double relative = equations_->relative_residual(state, next);
    increment.residuals.push_back(relative);
    if (!std::isfinite(relative)) return {false, "the residual is not finite", 0.5};
    if (relative <= scene.tolerance) {
      now_ = next;
      now_.force = state.coupling.force;
      return {};
    }
    if (!equations_->solve(state, 0, next)) return {false, "the tangent is singular", 0.5};
  }
  return {false, "no convergence in " + std::to_string(scene.max_iterations) + " iterations", 0.5};
}

Step Newton::solve(int number) {
  const Scene& scene = equations_->scene();
  const double begin = seconds();
  const auto index = static_cast<std::size_t>(number - 1);
  const double from = number == 1 ? 0 : scene.steps[index - 1], to = scene.steps[index];
  Step step;
  step.number = number, step.value = to;
  double done = 0, size = 1; // parts of the step
  while (done < 1) {
    const double part = done + size < 1 - 1e-12 ? done + size : 1;
    Increment increment{part == 1 ? to : from + (to - from) * part, {}};
    Outcome outcome = attempt(increment.value, (part - done) * scene.durations[index], increment);
    if (outcome.ok) {
      if (Contact* contact = equations_->contact()) {
        if (part == 1) step.contact = contact->results(now_);
        contact->accept();
      }
      step.increments.push_back(std::move(increment));
      done = part;
      size = std::min(2 * size, 1 - done);
      continue;
    }
    size *= outcome.step_factor; // the library's, or a half
    const std::string name = "step " + std::to_string(number);
    say_(name + ": " + outcome.reason + "; cut to " + shown("%.3g", size) + " of the step");
    step.cuts.push_back(outcome.reason);
    if (size < scene.min_step)
      throw JobError(name + " cannot be solved: " + outcome.reason + "; ents-lab run has a line search");
  }
  step.at = now_;
  step.force = now_.force * scene.symmetry_copies;
  step.approach = now_.motion - first_touch_;
  step.wall_time = seconds() - begin;
  std::string line = "step " + std::to_string(number) + "/" + std::to_string(scene.steps.size());
  if (scene.contact && !scene.contact->rigid.empty())
    line += shown("  approach %.4g", step.approach) + " " + scene.unit_of_length +
            shown("  force %.5g", step.force) + " " + scene.unit_of_force;
  line += "  |r|";
  for (const double residual : step.increments.back().residuals) line += shown(" %.0e", residual);
  say_(line + shown("  %.1f s", step.wall_time));
  return step;
}

} // namespace host
