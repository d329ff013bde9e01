// SPDX-License-Identifier: BSD-3-Clause
#include "run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include "advice.hpp"
#include "conductance.hpp"
#include "output/table.hpp"
#include "stopwatch.hpp"

namespace host {
namespace {

/// The increments of a step under a plan, as parts of the step.
class StepParts {
public:
  explicit StepParts(const StepPlan& plan) : plan_(plan), random_(plan.seed), discards_(plan.seed + 1) {}

  void next_step() {
    ends_ = {1};
    if (plan_.cut == StepPlan::Cut::halves) ends_ = {0.5, 1};
    if (plan_.cut != StepPlan::Cut::random) return;
    const int count = 1 + static_cast<int>(random_() % 4);
    for (int i = 1; i < count; ++i) ends_.push_back(fraction(random_));
    std::sort(ends_.begin(), ends_.end());
  }
  double size(double done) const {
    for (const double end : ends_)
      if (end > done + 1e-9) return end - done;
    return 1 - done;
  }
  /// What to try before the next increment and to throw away: ends of increments.
  std::vector<double> discarded(double done) {
    if (!plan_.discard) return {};
    if (plan_.cut != StepPlan::Cut::random) return {1};
    std::vector<double> ends;
    if (discards_() % 10 < 3) // 30 % of the increments, one to three tries
      for (auto i = 1 + discards_() % 3; i > 0; --i) ends.push_back(done + (1 - done) * fraction(discards_));
    return ends;
  }

private:
  static double fraction(std::mt19937& random) {
    return 0.05 + 0.9 * static_cast<double>(random()) / 4294967296.;
  }

  StepPlan plan_;
  std::mt19937 random_, discards_;
  std::vector<double> ends_;
};

std::string step_line(const Scene& scene, const StepRecord& record) {
  std::string text = "step " + std::to_string(record.step) + "/" + std::to_string(scene.steps.size());
  const auto add = [&](const char* name, double value, const std::string& unit) {
    text += "  " + std::string(name) + " " + format_number(value) + (unit.empty() ? "" : " " + unit);
  };
  if (scene.contact && !scene.contact->rigid.empty()) {
    add("approach", record.approach, scene.units.length);
    add("force", record.force, scene.units.force);
  } else {
    add("load factor", record.value, "");
  }
  text += "  |r|";
  const std::vector<double>& residuals = record.increments.back().residuals;
  constexpr std::size_t first = 4, last = 8; // of many, as a jump takes
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    char number[16];
    std::snprintf(number, sizeof number, " %.0e", residuals[i]);
    if (residuals.size() <= 24 || i < first || i + last >= residuals.size())
      text += number;
    else if (i == first)
      text += " ... (" + std::to_string(residuals.size() - first - last) + " more) ...";
  }
  if (const double rounding = record.increments.back().rounding; rounding > 0)
    text += "  (rounding leaves up to " + format_number(rounding, 2) + ")";
  if (const auto energy = record.energy(); energy && (energy->jumped || energy->gained))
    text += (energy->jumped ? "  (surfaces jumped: energy lost "
                            : "  (torn off by too large a step: energy gained ") +
            format_number(std::abs(energy->lost()), 3) + " +- " + format_number(energy->uncertainty, 1) + ")";
  if (!record.cuts.empty()) text += "  (cut " + std::to_string(record.cuts.size()) + " times)";
  const Convergence rate = convergence(record.increments.back().residuals);
  if (std::isfinite(rate.order)) {
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, "  last reductions %.0e %.0e", rate.before, rate.last);
    text += numbers;
  }
  return text;
}

/// Value of a parameter before the first step.
double start_of(const Simulation& simulation, const std::string& name) {
  const EntsModel& model = *simulation.contact()->master().model;
  const auto& names = model.parameters();
  return model
      .defaults()[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
}

/// The values of the model's parameters, a part of a step done.
std::vector<double> parameters_at(const Simulation& simulation, int step, double part) {
  if (simulation.contact() == nullptr) return {};
  const EntsModel& model = *simulation.contact()->master().model;
  std::vector<double> values = model.defaults();
  for (const HistorySpec& history : simulation.scene().history)
    for (std::size_t p = 0; p < values.size(); ++p) {
      if (model.parameters()[p] != history.name) continue;
      const auto index = static_cast<std::size_t>(step - 1);
      const double from = index == 0 ? values[p] : history.values[index - 1], to = history.values[index];
      values[p] = part >= 1 - 1e-12 ? to : from + (to - from) * part;
    }
  return values;
}

/// Explicit wear alternates from node to node where a step slides farther than 4 dx / (pi k E*): the mode of
/// the shortest wave has the compliance 2 dx / (pi E*), and is worn by k over it. Empty: it does not, as far
/// as is known before.
std::string warning_of_explicit_wear(const Simulation& simulation, int step) {
  const Scene& scene = simulation.scene();
  if (simulation.contact() == nullptr) return "";
  const Json& model = scene.contact->model;
  const Json coefficient = find_json(model, "/contact/wear/coefficient"),
             sliding = find_json(model, "/contact/wear/sliding");
  if (find_json(model, "/contact/wear/scheme") != "explicit" || !coefficient.is_number()) return "";
  double slid = 0;
  const auto index = static_cast<std::size_t>(step - 1);
  for (const HistorySpec& history : scene.history)
    if (sliding == history.name)
      slid = history.values[index] -
             (index == 0 ? start_of(simulation, history.name) : history.values[index - 1]);
  // A quarter of the nodes have less: those on the border of the surface have half or a quarter of a full
  // area.
  std::vector<double> areas = simulation.contact()->areas();
  std::sort(areas.begin(), areas.end());
  const double area = areas[areas.size() / 4];
  const double dx = scene.dimension == 2 ? area / scene.parts.front().setup.thickness : std::sqrt(area);
  const double limit = 4 * dx / (std::numbers::pi * coefficient.get<double>() * contact_modulus(scene));
  slid *= simulation.contact()->largest_arm();
  if (!(slid > limit)) return "";
  return "step " + std::to_string(step) + " slides " + format_number(slid, 3) +
         " and explicit wear is stable up to " + format_number(limit, 3) +
         " here (4 dx / (pi k E*)); take \"scheme\": \"implicit\", or more steps";
}

/// A little above and below the end of the step.
void probe_conductance(Simulation& simulation, const Target& end, StepRecord& record) {
  const Scene& scene = simulation.scene();
  Target higher = end, lower = end;
  higher.value *= 1 + scene.probe, lower.value *= 1 - scene.probe;
  record.conductance = incremental_conductance(simulation, higher, lower);
  add_exact_conductance(scene, record);
}

} // namespace

Convergence convergence(const std::vector<double>& residuals) {
  const std::size_t n = residuals.size();
  Convergence result;
  result.before = result.last = result.order = std::numeric_limits<double>::quiet_NaN();
  if (n >= 2) result.last = residuals[n - 1] / residuals[n - 2];
  if (n >= 3) {
    result.before = residuals[n - 2] / residuals[n - 3];
    result.order = std::log(result.last) / std::log(result.before);
  }
  return result;
}

bool quadratic(const std::vector<double>& residuals, double constant, double floor) {
  if (residuals.size() < 2) return !residuals.empty() && residuals.back() <= floor;
  const double before = residuals[residuals.size() - 2], last = residuals.back();
  return last <= std::max(constant * before * before, floor);
}

std::optional<EnergyBalance> StepRecord::energy() const {
  EnergyBalance sum;
  for (const IncrementRecord& increment : increments) {
    if (!increment.energy) return {};
    const EnergyBalance& part = *increment.energy;
    sum.work += part.work, sum.stored += part.stored, sum.dissipated += part.dissipated;
    sum.uncertainty += part.uncertainty;
    sum.jumped = sum.jumped || part.jumped, sum.gained = sum.gained || part.gained;
  }
  return sum;
}

int StepRecord::iterations() const {
  return std::accumulate(increments.begin(), increments.end(), 0,
                         [](int sum, const IncrementRecord& increment) {
                           for (const Augmentation& augmentation : increment.augmentations)
                             sum += augmentation.iterations;
                           return sum + static_cast<int>(increment.residuals.size());
                         });
}

/// Part of a step: a jump in it is no mistake of a large step.
constexpr double smallest_followed = 1. / 16;

std::vector<StepRecord> solve(Simulation& simulation, const RunObserver& observer, const StepPlan& plan) {
  const Scene& scene = simulation.scene();
  const auto say = [&](const std::string& line) {
    if (observer.line) observer.line(line);
  };
  const double last = scene.steps.back();
  const int steps = plan.last > 0 ? plan.last : static_cast<int>(scene.steps.size());
  StepParts parts(plan);
  std::vector<StepRecord> records;
  if (scene.contact && scene.contact->cut > 0 && !simulation.contact()->cuts_again())
    say("note: the slave faces stay cut as they were before the first step: their points have a history");
  for (int step = 1; step <= steps; ++step) {
    const auto index = static_cast<std::size_t>(step - 1);
    const double from = step == 1 ? 0 : scene.steps[index - 1], to = scene.steps[index];
    // The last part ends on the step's value exactly, whatever rounding did to the sum of the parts.
    const auto value_at = [&](double part) { return part >= 1 - 1e-12 ? to : from + (to - from) * part; };
    const auto target_at = [&](double part, double share) { // of the step, and of it in this increment
      const double value = value_at(part), factor = last != 0 ? value / last : 1;
      return Target{value, scene.control == Control::load_factor ? value : factor,
                    parameters_at(simulation, step, part), share * scene.durations[index],
                    share <= smallest_followed};
    };
    parts.next_step();
    if (step < plan.first) continue; // drawn all the same: a run continued is the run itself
    if (const std::string warning = warning_of_explicit_wear(simulation, step); !warning.empty())
      say("warning: " + warning);
    const Stopwatch watch;
    StepRecord record;
    record.step = step;
    record.value = to;
    Json begin; // of the step, once a part of it is tried
    const auto take = [&] {
      double done = 0, size = parts.size(done);
      while (done < 1) {
        for (const double other : parts.discarded(done))
          simulation.advance(target_at(other, other - done), false);
        const double part = done + size;
        if (done == 0 && part < 1 && begin.is_null()) begin = simulation.checkpoint();
        const NewtonOutcome outcome = simulation.advance(target_at(part, part - done));
        if (outcome.converged) {
          record.increments.push_back({value_at(part), outcome.residuals, outcome.status_changes,
                                       outcome.augmentations, outcome.halvings, outcome.rounding,
                                       outcome.dissipated, outcome.descents, outcome.energy});
          done = part >= 1 - 1e-12 ? 1 : part;
          size = plan.cut == StepPlan::Cut::none ? std::min(2 * size, 1 - done) : parts.size(done);
          continue;
        }
        if (outcome.step_factor == 0)
          throw JobError("step " + std::to_string(record.step) + " cannot be solved: " + outcome.reason +
                         "; " + outcome.advice);
        record.cuts.push_back(outcome.reason);
        size *= outcome.step_factor;
        say("step " + std::to_string(record.step) + ": " + outcome.reason + "; cut to " +
            format_number(size, 3) + " of the step");
        if (size < scene.solver.min_step)
          throw JobError("step " + std::to_string(record.step) + " cannot be solved: " + outcome.reason +
                         " even in parts of " + format_number(size / outcome.step_factor, 3) + "; " +
                         (outcome.advice.empty() ? smaller_steps : outcome.advice));
      }
    };
    try {
      take();
    } catch (const JobError& error) {
      if (!begin.is_null()) simulation.restore(begin);
      throw StepFailure(step, error.what(), std::move(records));
    }
    for (const IncrementRecord& increment : record.increments) record.dissipated += increment.dissipated;
    if (scene.contact) record.heat = scene.contact->heat_share * record.dissipated / scene.durations[index];
    fill_contact_results(simulation, record);
    if (scene.probe > 0) probe_conductance(simulation, target_at(1, 1), record);
    record.wall_time = watch.seconds();
    say(step_line(scene, record));
    if (observer.step_done) observer.step_done(simulation, record);
    records.push_back(std::move(record));
  }
  return records;
}

} // namespace host
