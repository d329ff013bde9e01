// SPDX-License-Identifier: BSD-3-Clause
#include "run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "output/table.hpp"
#include "stopwatch.hpp"

namespace host {
namespace {

/// Motion at which the master of the undeformed scene touches: from there approaches are measured.
double first_touch(Simulation& simulation) {
  Contact* contact = simulation.contact();
  if (contact == nullptr || !contact->master().rigid) return 0;
  const ContactFields fields = contact->fields(simulation.now().displacement, 0);
  double smallest = std::numeric_limits<double>::infinity();
  for (const double gap : fields.gap)
    if (gap < smallest) smallest = gap;
  return std::isfinite(smallest) ? smallest : 0;
}

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
  if (!record.cuts.empty()) text += "  (cut " + std::to_string(record.cuts.size()) + " times)";
  const Convergence rate = convergence(record.increments.back().residuals);
  if (std::isfinite(rate.order)) {
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, "  last reductions %.0e %.0e", rate.before, rate.last);
    text += numbers;
  }
  return text;
}

void fill_contact_results(Simulation& simulation, double touch, StepRecord& record) {
  Contact* contact = simulation.contact();
  if (contact == nullptr) return;
  const Scene& scene = simulation.scene();
  const auto d = static_cast<std::size_t>(scene.dimension);
  record.fields = contact->fields(simulation.now().displacement, simulation.now().motion);
  record.force = simulation.now().force * scene.symmetry_copies;
  record.approach = simulation.now().motion - touch;
  record.mean_pressure = simulation.now().force / simulation.contact_area();
  double closed = 0, gap = 0, gap_area = 0;
  for (std::size_t k = 0; k < contact->slaves().size(); ++k) {
    const double area = contact->areas()[k];
    if (record.fields.closed[k]) closed += area;
    if (!std::isnan(record.fields.gap[k])) gap += area * record.fields.gap[k], gap_area += area;
    record.peak_pressure = std::max(record.peak_pressure, record.fields.pressure[k]);
    for (std::size_t i = 0; i < d; ++i) {
      const std::size_t dof = static_cast<std::size_t>(contact->slaves()[k]) * d + i;
      record.positions.push_back(simulation.mesh().coordinates[dof] + simulation.now().displacement[dof]);
    }
  }
  record.contact_fraction = closed / simulation.contact_area();
  record.mean_gap = gap / gap_area;
  record.exact = compare_with_exact(scene, surface_state(simulation, record));
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
  return std::accumulate(increments.begin(), increments.end(), 0, [](int sum, const IncrementRecord& increment) {
    return sum + static_cast<int>(increment.residuals.size());
  });
}

SurfaceState surface_state(Simulation& simulation, const StepRecord& record) {
  const Contact& contact = *simulation.contact();
  SurfaceState state;
  for (const int node : contact.slaves()) {
    const auto position = simulation.mesh().node(node);
    state.distance.push_back(simulation.mesh().dimension == 2 ? std::abs(position[0])
                                                              : std::hypot(position[0], position[1]));
  }
  state.pressure = record.fields.pressure;
  state.area = contact.areas();
  state.closed = record.fields.closed;
  state.approach = record.approach;
  state.force = record.force;
  state.mean_pressure = record.mean_pressure;
  return state;
}

std::vector<StepRecord> solve(Simulation& simulation, const RunObserver& observer) {
  const Scene& scene = simulation.scene();
  const auto say = [&](const std::string& line) {
    if (observer.line) observer.line(line);
  };
  const double touch = first_touch(simulation);
  const double last = scene.steps.back();
  std::vector<StepRecord> records;
  double from = 0;
  for (const double to : scene.steps) {
    const Stopwatch watch;
    StepRecord record;
    record.step = static_cast<int>(records.size()) + 1;
    record.value = to;
    double done = 0, size = 1;
    while (done < 1) {
      // The last part ends on the step's value exactly, whatever rounding did to the sum of the parts.
      const bool complete = done + size >= 1 - 1e-12;
      const double value = complete ? to : from + (to - from) * (done + size);
      const NewtonOutcome outcome = simulation.advance({value, last != 0 ? value / last : 1});
      if (outcome.converged) {
        record.increments.push_back({value, outcome.residuals, outcome.status_changes});
        done = complete ? 1 : done + size;
        size = std::min(2 * size, 1 - done);
        continue;
      }
      record.cuts.push_back(outcome.reason);
      size *= outcome.step_factor;
      say("step " + std::to_string(record.step) + ": " + outcome.reason + "; cut to " + format_number(size, 3) +
          " of the step");
      if (size < scene.solver.min_step)
        throw JobError("step " + std::to_string(record.step) + " cannot be solved: " + outcome.reason +
                       " even in parts of " + format_number(size / outcome.step_factor, 3) +
                       "; take smaller steps, or see /solver/min_step");
    }
    fill_contact_results(simulation, touch, record);
    record.wall_time = watch.seconds();
    say(step_line(scene, record));
    if (observer.step_done) observer.step_done(simulation, record);
    records.push_back(std::move(record));
    from = to;
  }
  return records;
}

} // namespace host
