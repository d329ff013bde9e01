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
#include "merged_places.hpp"
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
  for (const double residual : record.increments.back().residuals) {
    char number[16];
    std::snprintf(number, sizeof number, " %.0e", residual);
    text += number;
  }
  if (const double rounding = record.increments.back().rounding; rounding > 0)
    text += "  (rounding leaves up to " + format_number(rounding, 2) + ")";
  if (!record.cuts.empty()) text += "  (cut " + std::to_string(record.cuts.size()) + " times)";
  const Convergence rate = convergence(record.increments.back().residuals);
  if (std::isfinite(rate.order)) {
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, "  last reductions %.0e %.0e", rate.before, rate.last);
    text += numbers;
  }
  return text;
}

void fill_contact_results(Simulation& simulation, StepRecord& record) {
  Contact* contact = simulation.contact();
  if (contact == nullptr) return;
  const Scene& scene = simulation.scene();
  record.fields = contact->accepted();
  record.contact_force = record.fields.force;
  for (double& component : record.contact_force) component *= scene.symmetry_copies;
  record.moment = record.fields.moment;
  if (const int node = contact->master().body_node; node >= 0) {
    const auto first =
        simulation.now().displacement.begin() + static_cast<std::ptrdiff_t>(node) * scene.dimension;
    record.body_moved.assign(first, first + RigidBodySpec::components(scene.dimension));
    record.body_rotation = simulation.now().rotation;
  }
  record.force = simulation.now().force * scene.symmetry_copies;
  record.approach = simulation.now().motion - simulation.first_touch();
  record.mean_pressure = simulation.now().force / simulation.contact_area();
  if (!contact->master()
           .translates()) { // the load is not ours to prescribe: what the contact carries, in size
    double squared = 0;
    for (const double component : record.contact_force) squared += component * component;
    record.force = std::sqrt(squared);
    record.mean_pressure = record.force / (simulation.contact_area() * scene.symmetry_copies);
  }
  double closed = 0, gap = 0, gap_area = 0;
  record.areas = contact->areas();
  const std::vector<std::size_t> points = merge_places(contact->slaves(), record);
  for (std::size_t k = 0; k < record.areas.size(); ++k) {
    const double area = record.areas[k];
    if (record.fields.closed[k]) {
      closed += area;
      record.penetration = std::max(record.penetration, std::abs(record.fields.gap[k]));
    }
    if (!std::isnan(record.fields.gap[k])) gap += area * record.fields.gap[k], gap_area += area;
    record.peak_pressure = std::max(record.peak_pressure, record.fields.pressure[k]);
    const auto position = contact->position_of(points[k], simulation.now().displacement);
    record.positions.insert(record.positions.end(), position.begin(), position.begin() + scene.dimension);
    const auto place = contact->slaves().place(points[k], simulation.mesh());
    record.places.insert(record.places.end(), place.begin(), place.begin() + scene.dimension);
  }
  record.contact_fraction = closed / simulation.contact_area();
  if (const RemovedWaves* waves =
          simulation.removed_waves()) { // nodes are closed that are in contact in part
    double area = 0;
    const auto d = static_cast<std::size_t>(scene.dimension);
    for (std::size_t k = 0; k < record.areas.size(); ++k)
      area += record.areas[k] *
              waves->share(record.places[k * d], record.places[k * d + 1], record.fields.pressure[k]);
    record.contact_fraction = record.area.fraction = area / simulation.contact_area();
  } else {
    record.area = estimate_area(simulation, record.fields);
  }
  record.mean_gap = gap / gap_area;
  record.mean_cubed_gap = gap_means(record.fields.gap, record.areas).cubed;
  record.worn_slave = contact->worn_slave() * scene.symmetry_copies;
  record.worn_master = contact->worn_master() * scene.symmetry_copies;
  for (const double depth : record.fields.worn) record.worn_depth = std::max(record.worn_depth, depth);
  record.motion = simulation.now().motion;
  const SurfaceState state = surface_state(simulation, record);
  const ExactLayer* layer = simulation.exact_layer();
  if (layer == nullptr) {
    record.exact = compare_with_exact(scene, state);
    return;
  }
  LayerAnswer answer = layer->compare(layer->truth(record.motion), state);
  if (simulation.removed_waves() != nullptr) // nodes are not what counts
    for (Quantity& q : answer.quantities)
      if (q.name == "contact fraction") q = exact_quantity(q.name, q.unit, record.contact_fraction, q.exact);
  record.exact = std::move(answer.quantities), record.exact_pressure = std::move(answer.pressure);
}

/// Of a sine, beside its other exact quantities
void add_exact_conductance(const Scene& scene, StepRecord& record) {
  if (scene.exact.type != ExactSpec::Type::westergaard) return;
  const double wave = scene.exact.wavelength, height = scene.exact.amplitude;
  const double part = record.mean_pressure / westergaard_full_contact(height, wave, contact_modulus(scene));
  if (!(part < 1)) return;
  record.exact.push_back(
      exact_quantity("h_c lambda / k_s", "", record.conductance * wave, westergaard_conductance(part)));
  record.exact.push_back(exact_quantity("<g^3> / amplitude^3", "",
                                        record.mean_cubed_gap / (height * height * height),
                                        westergaard_cubed_gap(part)));
}

/// Of a rigid body that turns: moment, mean radius of its contact, and which way it turns.
void set_turning(const Simulation& simulation, const StepRecord& record, SurfaceState& state) {
  const auto d = static_cast<std::size_t>(simulation.scene().dimension);
  state.moment = record.fields.moment.back();
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k < record.fields.closed.size(); ++k) {
    const double weight = record.fields.node_forces[k * d + d - 1];
    sum += weight * std::hypot(record.positions[k * d], record.positions[k * d + 1]);
    weights += weight;
  }
  state.mean_radius = weights != 0 ? sum / weights : 0;
  const double now = simulation.now().load_factor;
  for (const BodyComponent& c : simulation.scene().contact->body->prescribed) {
    if (c.component != RigidBodySpec::components(static_cast<int>(d)) - 1) continue;
    const double step = c.value * (c.path.at(now) - c.path.at(now - 1e-6 * (1 + std::abs(now))));
    state.turning = step > 0 ? 1 : step < 0 ? -1 : 0;
  }
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

int StepRecord::iterations() const {
  return std::accumulate(increments.begin(), increments.end(), 0,
                         [](int sum, const IncrementRecord& increment) {
                           for (const Augmentation& augmentation : increment.augmentations)
                             sum += augmentation.iterations;
                           return sum + static_cast<int>(increment.residuals.size());
                         });
}

SurfaceState surface_state(Simulation& simulation, const StepRecord& record) {
  const Contact& contact = *simulation.contact();
  const auto d = static_cast<std::size_t>(simulation.mesh().dimension);
  SurfaceState state;
  for (std::size_t k = 0; k < record.areas.size(); ++k) {
    const double* place = record.places.data() + k * d;
    state.distance.push_back(d == 2
                                 ? distance_from(simulation.exact_axis(), simulation.scene().exact, place[0])
                                 : std::hypot(place[0], place[1]));
  }
  state.load.assign(d, 0.0);
  const std::vector<double> loads = simulation.loads(simulation.now().load_factor);
  for (std::size_t dof = 0; dof < loads.size(); ++dof) state.load[dof % d] += loads[dof];
  for (std::size_t k = 0; k < record.areas.size(); ++k) {
    state.place.push_back(record.places[k * d]);
    state.place_y.push_back(record.places[k * d + 1]);
    state.moved.push_back(record.positions[k * d] - record.places[k * d]);
    state.shear.push_back(record.fields.traction[k * d]);
    state.sticks.push_back(record.fields.closed[k] && (record.fields.flags[k] & ENTS_FLAG_SLIP) == 0);
  }
  state.contact_force = record.fields.force;
  if (simulation.scene().contact->body) set_turning(simulation, record, state);
  state.pressure = record.fields.pressure;
  state.gap = record.fields.gap;
  state.area = record.areas;
  state.closed = record.fields.closed;
  state.approach = record.approach;
  state.force = record.force;
  state.mean_pressure = record.mean_pressure;
  state.slid = contact.slid();
  state.worn_volume = record.worn_slave, state.worn_depth = record.worn_depth;
  state.contact_estimate = record.area.fraction;
  return state;
}

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
    const auto target_at = [&](double part) {
      const double value = value_at(part);
      std::vector<double> parameters = parameters_at(simulation, step, part);
      if (scene.control == Control::load_factor) return Target{value, value, std::move(parameters)};
      return Target{value, last != 0 ? value / last : 1, std::move(parameters)};
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
        for (const double other : parts.discarded(done)) simulation.advance(target_at(other), false);
        const double part = done + size;
        if (done == 0 && part < 1 && begin.is_null()) begin = simulation.checkpoint();
        const NewtonOutcome outcome = simulation.advance(target_at(part));
        if (outcome.converged) {
          record.increments.push_back({value_at(part), outcome.residuals, outcome.status_changes,
                                       outcome.augmentations, outcome.halvings, outcome.rounding});
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
    fill_contact_results(simulation, record);
    if (scene.probe > 0) {
      Target higher = target_at(1), lower = higher;
      higher.value *= 1 + scene.probe, lower.value *= 1 - scene.probe;
      record.conductance = incremental_conductance(simulation, higher, lower);
      add_exact_conductance(scene, record);
    }
    record.wall_time = watch.seconds();
    say(step_line(scene, record));
    if (observer.step_done) observer.step_done(simulation, record);
    records.push_back(std::move(record));
  }
  return records;
}

} // namespace host
