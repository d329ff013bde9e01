// SPDX-License-Identifier: BSD-3-Clause
// Simulation: Newton's iteration for one increment.
#include <algorithm>
#include <cmath>
#include <limits>

#include "advice.hpp"
#include "holding.hpp"
#include "layer_body.hpp"
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

void Simulation::prescribe(Configuration& at) const {
  const double all_copies = at.force * scene_->symmetry_copies;
  // Nodes tied to a prescribed one have no equation either, and no value of their own.
  const auto follow = [&](std::size_t dof) {
    return half_space_.empty() ? 0 : half_space_[dof] * all_copies;
  };
  for (std::size_t dof = 0; dof < half_space_.size(); ++dof)
    if (dofs_->equation(dof) < 0) at.displacement[dof] = follow(dof);
  for (const Prescribed& support : prescribed_)
    at.displacement[support.dof] = support.value * support.path->at(at.load_factor) + follow(support.dof);
}

std::vector<double> Simulation::loads(double load_factor) const {
  std::vector<double> sum(static_cast<std::size_t>(dofs_->dofs()), 0.0);
  for (const Load& load : loads_) {
    const double factor = load.path->at(load_factor);
    for (std::size_t dof = 0; dof < sum.size(); ++dof) sum[dof] += factor * load.force[dof];
  }
  return sum;
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

double Simulation::rounding_of_forces() const {
  double squared = 0;
  const auto d = static_cast<std::size_t>(mesh_.dimension);
  for (std::size_t i = 0; i < d; ++i) {
    double low = INFINITY, high = -low;
    for (std::size_t k = i; k < mesh_.coordinates.size(); k += d) {
      low = std::min(low, mesh_.coordinates[k]);
      high = std::max(high, mesh_.coordinates[k]);
    }
    squared += (high - low) * (high - low);
  }
  constexpr double roundings = 8 * std::numeric_limits<double>::epsilon();
  return roundings * std::sqrt(squared) * system_->matrix().diagonal().norm();
}

double Simulation::relative_residual(const Evaluation& at) const {
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(equations());
  const auto dofs = static_cast<std::size_t>(dofs_->dofs());
  double squared_gaps = 0;
  for (std::size_t i = 0; i < at.residual.size(); ++i) // gaps times area become forces
    if (const int row = equation(i); row >= 0) {
      const double force = at.residual[i] * (i < dofs ? 1 : contact_->multiplier_scale(i - dofs));
      residual[row] += force;
      if (i >= dofs) squared_gaps += force * force;
    }
  const double norm = residual.norm();
  // Bodies that nothing presses or loads: the forces present are rounding, as the residual is.
  if (const double rounding = rounding_of_forces(); std::max(norm, at.force_scale) <= rounding) return 0;
  // Where the surfaces overlap and no multiplier presses yet, these are the only forces. In equilibrium they
  // are zero.
  return norm == 0 ? 0 : norm / std::max(at.force_scale, std::sqrt(squared_gaps));
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

Simulation::Evaluation Simulation::evaluate(const Configuration& at, const std::vector<double>& direction,
                                            bool want_tangent) {
  Evaluation result;
  result.residual.assign(at.displacement.size() + at.multiplier.size(), 0.0);
  double squared_contact = 0;
  {
    const Stopwatch watch;
    // The tangent of a linear bulk is assembled once.
    const bool have = bulk_->linear() && !bulk_values_.empty();
    SparseSystem* system = want_tangent && !have ? system_.get() : nullptr;
    if (system != nullptr) system->set_zero();
    const bool ok = bulk_->assemble(at.displacement, direction, result.residual, system);
    if (want_tangent && have) std::copy(bulk_values_.begin(), bulk_values_.end(), system_->values().begin());
    if (want_tangent && !have && bulk_->linear())
      bulk_values_.assign(system_->values().begin(), system_->values().end());
    timings_.bulk += watch.seconds();
    if (!ok) {
      bulk_values_.clear();
      result.reason = "an element was turned inside out";
      return result;
    }
  }
  if (layer_) {
    const Stopwatch watch;
    Eigen::VectorXd displacement(layer_->nodes());
    for (Eigen::Index node = 0; node < displacement.size(); ++node)
      displacement[node] = at.displacement[static_cast<std::size_t>(3 * node + 2)];
    const Eigen::VectorXd force = layer_->force(displacement);
    for (Eigen::Index node = 0; node < displacement.size(); ++node)
      result.residual[static_cast<std::size_t>(3 * node + 2)] += force[node];
    timings_.bulk += watch.seconds();
  }
  if (!springs_.empty()) {
    for (std::size_t dof = 0; dof < springs_.size(); ++dof) {
      result.residual[dof] +=
          springs_[dof] * (at.displacement[dof] + (direction.empty() ? 0 : direction[dof]));
      if (want_tangent) system_->add(bulk_stencils_.size(), dof, &springs_[dof]);
    }
  }
  if (contact_) {
    const Stopwatch watch;
    const CpuStopwatch cpu;
    auto report = ents_struct<ents_report>();
    RigidCoupling* coupling = contact_->master().translates() ? &result.coupling : nullptr;
    // A body that is moved takes the slave along, or leaves it behind.
    const bool follows = !direction.empty() && contact_->master().body_node >= 0;
    const std::int32_t status =
        contact_->assemble(at, result.residual, want_tangent || follows, coupling, squared_contact, report);
    if (follows && status == ENTS_OK) contact_->add_tangent_times(direction, result.residual);
    if (want_tangent && status == ENTS_OK) system_->add(contact_->tangent());
    timings_.contact += watch.seconds();
    timings_.contact_cpu += cpu.seconds();
    if (status != ENTS_OK) {
      result.reason = describe(contact_->master().model->library(), status, report);
      if (status == ENTS_DEEP_PENETRATION) result.advice = advice_if_deep(scene_->contact->model);
      result.step_factor = report.step_factor > 0 && report.step_factor < 1 ? report.step_factor : 0.5;
      return result;
    }
  }
  double squared_loads = 0, squared_reactions = 0;
  const std::vector<double> load = loads(at.load_factor);
  for (std::size_t dof = 0; dof < load.size(); ++dof) {
    result.residual[dof] -= load[dof];
    squared_loads += load[dof] * load[dof];
    if (dofs_->equation(dof) < 0) squared_reactions += result.residual[dof] * result.residual[dof];
  }
  result.force_scale = std::sqrt(std::max({squared_contact, squared_loads, squared_reactions}));
  result.ok = true;
  return result;
}

bool Simulation::solve(const Evaluation& at, bool factorize, double motion_step, double force_error,
                       Configuration& next) {
  const Stopwatch watch;
  bool ok = !factorize || solver_->factorize(system_->matrix());
  if (ok) {
    // Tied dofs add their residuals in one equation.
    Eigen::MatrixXd sides = Eigen::MatrixXd::Zero(equations(), force_controlled() ? 2 : 1);
    Eigen::VectorXd column = Eigen::VectorXd::Zero(equations()), row = column;
    for (std::size_t i = 0; i < at.residual.size(); ++i) {
      const int at_row = equation(i);
      if (at_row < 0) continue;
      sides(at_row, 0) -= at.residual[i];
      if (at.coupling.column.empty()) continue;
      column[at_row] += at.coupling.column[i];
      row[at_row] += at.coupling.row[i];
    }
    sides.col(0) -= motion_step * column;
    if (force_controlled()) sides.col(1) = -column;
    const Eigen::MatrixXd steps = solver_->solve(sides);
    Eigen::VectorXd step = steps.col(0);
    double motion = motion_step;
    if (force_controlled()) {
      // One more unknown, the motion, and one more equation, the force: eliminated by hand.
      const auto follow = steps.col(1);
      const double stiffness = at.coupling.diagonal + row.dot(follow);
      motion = (-force_error - row.dot(step)) / stiffness;
      step += motion * follow;
    }
    // A pivot may be small without being zero, and the step not finite.
    ok = std::isfinite(motion) && step.allFinite();
    if (ok) next.motion += motion;
    const std::size_t dofs = next.displacement.size();
    for (std::size_t i = 0; ok && i < at.residual.size(); ++i)
      if (const int row_of = equation(i); row_of >= 0)
        (i < dofs ? next.displacement[i] : next.multiplier[i - dofs]) += step[row_of];
  }
  timings_.solver += watch.seconds();
  return ok;
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

std::vector<double> Simulation::reactions() {
  Evaluation state = evaluate(now_, {}, false);
  if (!state.ok) throw JobError(state.reason);
  state.residual.resize(now_.displacement.size()); // multipliers have no reactions
  for (std::size_t dof = 0; dof < state.residual.size(); ++dof)
    if (dofs_->equation(dof) >= 0) state.residual[dof] = 0;
  return state.residual;
}

} // namespace host
