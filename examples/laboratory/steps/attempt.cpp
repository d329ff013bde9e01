// SPDX-License-Identifier: BSD-3-Clause
// Simulation: one try at an increment, by Newton's iteration with full steps or with a line search, by
// the residual or by the energy.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "advice.hpp"
#include "output/table.hpp"
#include "simulation.hpp"
#include "stopwatch.hpp"

namespace host {
namespace {

// The line search halves a step until the residual falls enough (Armijo's rule), against the largest of the
// last residuals: where nodes open, close, stick or slip the residual of a good step may rise for a while
// (Grippo, Lampariello, Lucidi, SIAM J. Numer. Anal. 23, 1986).
constexpr int most_halvings = 12;
constexpr double least_decrease = 1e-4;
constexpr std::size_t remembered = 4;
// An energy falls in every step. On the way of a jump there are many: one after the other, nodes leave their place.
constexpr int iterations_of_jump = 40; // times those of /solver/max_iterations

} // namespace

class Simulation::Attempt {
public:
  Attempt(Simulation& simulation, const Target& target, bool extrapolate, Search search)
      : sim_(simulation), target_(target), extrapolate_(extrapolate), search_(search),
        by_force_(simulation.force_controlled()), at_(simulation.now_), next_(simulation.now_),
        begin_(simulation.now_) {}

  NewtonOutcome run(bool keep) {
    const Stopwatch watch;
    if (begin() && predict()) {
      outcome_.line_search_may_help = true; // unless the iteration ends with what it cannot cure
      outcome_.converged = iterate() && small_enough_to_follow();
    }
    if (!outcome_.converged) {
      if (const std::string free = sim_.nothing_holds(begin_); !free.empty()) {
        outcome_.reason = free;
        outcome_.advice = "give it supports or springs, or let the surfaces overlap a little in the scene";
        outcome_.step_factor = 0; // no smaller step is held either
        outcome_.line_search_may_help = false;
      }
    }
    sim_.timings_.total += watch.seconds();
    if (outcome_.converged && keep) accept();
    return std::move(outcome_);
  }

private:
  bool fail(const std::string& reason, double factor) {
    outcome_.reason = reason, outcome_.step_factor = factor;
    return false;
  }
  bool fail_there() {
    outcome_.advice = state_.advice;
    return fail(state_.reason, state_.step_factor);
  }
  double force_error() const { return by_force_ ? state_.coupling.force - next_.force : 0; }
  double size() const { return target_.load_factor - sim_.now_.load_factor; }

  bool begin();
  bool predict();
  bool iterate();
  bool solve_there();
  bool small_enough_to_follow();
  bool look(bool choose, bool only_lost);
  bool downhill() const { return search_ == Search::energy || search_ == Search::work; }
  double merit() const;
  double merit_of_residual() const;
  bool predict_near(const std::vector<double>& jump, double motion_step);
  bool falls(double share) const;
  bool choose_share(bool choose, bool only_lost);
  void record(int iteration, double relative);
  bool small_enough(double relative);
  enum class Multipliers { kept, changed, refused };
  Multipliers augment();
  bool give_up();
  void accept();

  Simulation& sim_;
  const Target& target_;
  bool extrapolate_;
  Search search_;
  bool by_force_;
  Configuration at_, next_, begin_;
  Evaluation state_; ///< at `next_`
  NewtonOutcome outcome_;
  IterationHistory history_; ///< with the present multipliers
  std::string lost_;
  double rounding_ = 0; ///< the bound of the last residual that did not fall, relative as residuals are
  // The line search: `next_` is `from_` and a share of `step_`.
  Configuration from_;
  Increment step_;
  double slope_ = 0; ///< of the energy along it
  double rounding_of_merit_ = 0;
  std::vector<double> merits_; ///< empty: there is no step yet
};

/// Segments, loads and prescribed values of the increment.
bool Simulation::Attempt::begin() {
  const Scene& scene = *sim_.scene_;
  const double share = 1. / scene.symmetry_copies;
  if (!target_.parameters.empty()) at_.parameters = next_.parameters = target_.parameters;
  next_.load_factor = target_.load_factor;
  if (scene.control == Control::force) next_.force = target_.value * share;
  if (scene.control == Control::mean_pressure) next_.force = target_.value * sim_.contact_area();
  if (sim_.contact_ && sim_.contact_->cut_again(sim_.now_)) sim_.build_pattern(), sim_.last_.reset();
  if (sim_.contact_) sim_.contact_->take_time(target_.duration), sim_.contact_->begin_increment(sim_.now_);
  if (!sim_.choose(at_, false, outcome_.reason, outcome_.step_factor)) return false;
  if (sim_.contact_ && sim_.contact_->pulls() && !sim_.last_) {
    Evaluation start = sim_.evaluate(at_, {}, false);
    constexpr double equilibrium =
        1e-6; // surfaces may overlap before the first step: no balance begins there
    if (start.ok && sim_.relative_residual(start) < equilibrium) sim_.last_ = std::move(start);
  }
  if (by_force_ && (sim_.now_.force <= 0 || (sim_.contact_->wears() && !sim_.touches(at_)))) {
    sim_.find_contact(at_);
    begin_ = at_;
    next_.motion = at_.motion;
  }
  for (std::size_t i = 0; extrapolate_ && i < next_.displacement.size(); ++i)
    next_.displacement[i] += size() * sim_.rate_[i];
  sim_.prescribe(next_);
  return true;
}

/// First the tangent at the present configuration takes the whole jump of loads and prescribed values, or the
/// motion of the last increment goes on: a sliding contact whose tangent sticks would drag the surfaces
/// along. For the same reason a line search begins where only what is prescribed has moved ...
bool Simulation::Attempt::predict() {
  const double motion_step = sim_.scene_->control == Control::approach ? target_.value - sim_.now_.motion : 0;
  std::vector<double> jump(at_.displacement.size(), 0.0);
  bool jumps = false;
  for (std::size_t dof = 0; dof < jump.size(); ++dof)
    if (sim_.dofs_->equation(dof) < 0) {
      jump[dof] = next_.displacement[dof] - at_.displacement[dof];
      jumps = jumps || jump[dof] != 0;
    }
  if (!jumps) jump.clear();
  at_.load_factor = next_.load_factor;
  // A guess: the factors left by the last increment serve it as well as new ones.
  const bool factorize = !sim_.factors_fit_;
  sim_.factors_fit_ = false;
  if (downhill()) return predict_near(jump, motion_step);
  if (search_ != Search::none) next_.motion += motion_step;
  if (search_ != Search::none || extrapolate_) return true;
  state_ = sim_.evaluate(at_, jump, factorize);
  if (!state_.ok) return fail_there();
  if (factorize) sim_.note_factors(at_);
  if (!sim_.solve(state_, factorize, motion_step, force_error(), step_)) {
    outcome_.advice = sim_.advice_if_singular(at_);
    return fail("the tangent is singular", 0.5);
  }
  sim_.move(next_, step_, 1);
  return true;
}

/// Surfaces that adhere would be torn off if only one of them moved. The tangent at the begin moves both, and too far
/// where they are about to jump: of these two the one that is nearer to equilibrium.
bool Simulation::Attempt::predict_near(const std::vector<double>& jump, double motion_step) {
  Configuration moved = next_;
  next_.motion += motion_step;
  state_ = sim_.evaluate(at_, jump, true);
  if (!state_.ok || !sim_.solve(state_, true, motion_step, force_error(), step_)) return true;
  sim_.move(moved, step_, 1);
  const auto distance = [&](const Configuration& at) {
    state_ = sim_.evaluate(at, {}, true);
    return state_.ok ? merit_of_residual() : std::numeric_limits<double>::infinity();
  };
  const double held = distance(next_);
  if (distance(moved) < held) next_ = moved;
  return true;
}

/// ... then Newton's iteration; with multipliers in the state again and again, until they stay.
bool Simulation::Attempt::iterate() {
  const SolverSpec& solver = sim_.scene_->solver;
  Contact* contact = sim_.contact_.get();
  constexpr int looked_back = 4;
  const int most = (downhill() ? iterations_of_jump : 1) * solver.max_iterations;
  for (int iteration = 1; iteration <= most; ++iteration) {
    // Segments are chosen anew during the first iterations; then nodes stay that project inside theirs or its
    // margin: beside a kink of a plain mesh they could otherwise change sides for ever.
    const bool choose = outcome_.augmentations.empty(), only_lost = iteration > solver.segment_choices;
    if (!(!merits_.empty() ? choose_share(choose, only_lost) : look(choose, only_lost))) return false;
    double relative = sim_.relative_residual(state_);
    if (by_force_) relative = std::max(relative, std::abs(force_error()) / next_.force);
    record(iteration, relative);
    if (!std::isfinite(relative)) return fail("the residual is not finite", 0.5);
    if (small_enough(relative)) {
      const Multipliers found = augment();
      if (found == Multipliers::refused) return false;
      if (found == Multipliers::changed) {
        iteration = 0;
        history_ = {};
        merits_.clear();
        continue;
      }
      if (contact == nullptr || contact->lost().empty()) return true;
      outcome_.advice = advice_if_lost(sim_.scene_->contact->model, contact->lost_behind_edge());
      outcome_.line_search_may_help = false;
      return fail(std::string(contact->lost()), 0.5);
    }
    if (contact != nullptr && iteration > most - looked_back && lost_.empty()) lost_ = contact->lost();
    if (!solve_there()) return false;
  }
  return give_up();
}

bool Simulation::Attempt::small_enough_to_follow() {
  if (!sim_.contact_ || !sim_.contact_->pulls()) return true;
  outcome_.energy = sim_.balance(state_, next_);
  if (!outcome_.energy || target_.may_jump) return true;
  const EnergyBalance& energy = *outcome_.energy;
  // The forces are mostly gone, and more is stored all the same: a way of larger forces may have been left out.
  const bool torn = energy.gained || (energy.uncertainty > 0.6 * std::abs(energy.work) &&
                                      energy.stored > 0.1 * std::abs(energy.work));
  if (!energy.jumped && !torn) return true;
  outcome_.line_search_may_help = false;
  return fail(energy.jumped ? "surfaces jump" : "surfaces may be torn off", 0.5);
}

/// From `next_` on by a whole step.
bool Simulation::Attempt::solve_there() {
  if (!downhill()) sim_.note_factors(next_);
  bool left_out = false;
  const bool solved = downhill() ? sim_.solve_downhill(state_, force_error(), step_, left_out)
                                 : sim_.solve(state_, true, 0, force_error(), step_);
  outcome_.descents += left_out;
  if (!solved) {
    outcome_.advice = sim_.advice_if_singular(next_);
    return fail("the tangent is singular", 0.5);
  }
  if (search_ != Search::none) {
    from_ = next_;
    if (downhill()) {
      merits_.clear();
      slope_ = sim_.slope(state_, force_error(), step_);
      rounding_of_merit_ = 1e-14 * state_.potential_size;
    }
    merits_.push_back(merit());
    if (merits_.size() > remembered) merits_.erase(merits_.begin());
  }
  sim_.move(next_, step_, 1);
  return true;
}

/// Segments and forces at `next_`.
bool Simulation::Attempt::look(bool choose, bool only_lost) {
  if (choose && !sim_.choose(next_, only_lost, outcome_.reason, outcome_.step_factor)) return false;
  state_ = sim_.evaluate(next_, {}, true);
  return state_.ok || fail_there();
}

/// What the line search makes smaller: the energy, or the norm of the residual with that of the force on the master.
double Simulation::Attempt::merit() const {
  return search_ == Search::energy ? state_.potential : merit_of_residual();
}

double Simulation::Attempt::merit_of_residual() const {
  return std::hypot(sim_.residual_of_equations(state_).norm(), force_error());
}

bool Simulation::Attempt::falls(double share) const {
  const double before = *std::max_element(merits_.begin(), merits_.end());
  if (search_ == Search::energy)
    return merit() <= before + least_decrease * share * slope_ + rounding_of_merit_;
  if (search_ == Search::work) // slopes of a step that is a straight line
    return sim_.slope(state_, force_error(), step_) <= (2 * least_decrease - 1) * slope_;
  return merit() <= (1 - least_decrease * share) * before;
}

/// The largest share 1, 1/2, 1/4 ... of the step where contact can be evaluated and the merit falls.
bool Simulation::Attempt::choose_share(bool choose, bool only_lost) {
  double share = 1;
  for (int halved = 0; halved <= most_halvings; ++halved, share *= 0.5) {
    if (halved > 0) {
      next_ = from_;
      sim_.move(next_, step_, share);
      ++outcome_.halvings;
    }
    if (look(choose, only_lost) && falls(share)) {
      outcome_.advice.clear();
      return true;
    }
  }
  return state_.ok && fail(std::string("the line search found no step that lowers the ") +
                               (downhill() ? "energy" : "residual"),
                           0.5);
}

void Simulation::Attempt::record(int iteration, double relative) {
  const Contact* contact = sim_.contact_.get();
  history_.residuals.push_back(relative);
  history_.switches.push_back(contact != nullptr ? contact->switches() : 0);
  history_.moves.push_back(contact != nullptr ? contact->moves() : 0);
  if (outcome_.augmentations.empty()) {
    outcome_.residuals.push_back(relative);
    outcome_.status_changes.push_back(contact != nullptr ? contact->status_changes() : 0);
  } else {
    outcome_.augmentations.back().iterations = iteration;
  }
}

/// Below the tolerance, or nothing but rounding, and no smaller than at the iteration before.
bool Simulation::Attempt::small_enough(double relative) {
  if (relative <= sim_.scene_->solver.tolerance) return true;
  const std::vector<double>& all = history_.residuals;
  if (all.size() < 2 || relative < 0.5 * all[all.size() - 2]) return false;
  const double norm = sim_.residual_of_equations(state_).norm();
  const Rounding rounding = sim_.rounding_of_residual(state_, next_);
  rounding_ = rounding.residual / std::max(state_.force_scale, rounding.residual);
  if (by_force_) rounding_ = std::max(rounding_, rounding.force / next_.force);
  if (norm > rounding.residual || std::abs(force_error()) > rounding.force) return false;
  outcome_.rounding = rounding_;
  return true;
}

/// Uzawa: equilibrium with the present multipliers is found.
Simulation::Attempt::Multipliers Simulation::Attempt::augment() {
  Contact* contact = sim_.contact_.get();
  if (contact == nullptr || !contact->augmentable()) return Multipliers::kept;
  const SolverSpec& solver = sim_.scene_->solver;
  const double enough = solver.gap_tolerance * contact->size(), error = contact->augment(next_, enough);
  if (error > enough && static_cast<int>(outcome_.augmentations.size()) == solver.max_augmentations) {
    fail("no convergence of the multipliers in " + std::to_string(solver.max_augmentations) +
             " augmentations",
         0.5);
    outcome_.line_search_may_help = false;
    return Multipliers::refused;
  }
  outcome_.augmentations.push_back({error, 0});
  return error > enough ? Multipliers::changed : Multipliers::kept;
}

/// The last residuals tell a flip-flop (they come back) from a divergence (they grow).
bool Simulation::Attempt::give_up() {
  std::string last;
  const std::vector<double>& residuals = history_.residuals;
  for (std::size_t i = residuals.size() - std::min<std::size_t>(residuals.size(), 4); i < residuals.size();
       ++i)
    last += " " + format_number(residuals[i], 2);
  const Json model = sim_.contact_ ? sim_.scene_->contact->model : Json();
  outcome_.advice = advice_if_stuck(history_, model);
  if (!outcome_.advice.empty() && rounding_ > 0)
    outcome_.advice += " (rounding explains " + format_number(rounding_, 2) + " of it)";
  if (!lost_.empty())
    outcome_.advice = lost_ + ": " + advice_if_lost(model, sim_.contact_->lost_behind_edge());
  return fail("no convergence in " + std::to_string(history_.residuals.size()) + " iterations, residuals" +
                  last,
              0.5);
}

/// The increment ends here.
void Simulation::Attempt::accept() {
  if (Contact* contact = sim_.contact_.get(); contact != nullptr) {
    if (contact->pulls()) {
      sim_.last_ = state_;
    }
    contact->frame().keep_rotation(next_);
    contact->accept(next_);
    outcome_.dissipated = contact->accepted().dissipation * sim_.scene_->symmetry_copies;
    if (contact->master().translates()) next_.force = state_.coupling.force;
  }
  if (sim_.scene_->solver.extrapolate && size() != 0) {
    sim_.rate_.resize(next_.displacement.size());
    for (std::size_t i = 0; i < sim_.rate_.size(); ++i)
      sim_.rate_[i] = (next_.displacement[i] - sim_.now_.displacement[i]) / size();
  }
  sim_.now_ = next_;
  sim_.factors_fit_ = sim_.factored_.has_value();
}

NewtonOutcome Simulation::attempt(const Target& target, bool keep, bool extrapolate, Search search) {
  return Attempt(*this, target, extrapolate, search).run(keep);
}

} // namespace host
