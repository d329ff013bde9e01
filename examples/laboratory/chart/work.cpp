// SPDX-License-Identifier: BSD-3-Clause
// Running a problem of the work-precision diagrams in all its ways.
#include "chart/work.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <optional>

#include "chart/automatic_tangent.hpp"
#include "chart/following.hpp"
#include "output/table.hpp"
#include "stopwatch.hpp"

namespace host::chart {
double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

namespace {

/// Runs that take longer are not repeated; shorter than the second number: two times more than the others
/// [s].
constexpr double short_run = 1.5, very_short_run = 0.3;

/// What a run leaves behind to be compared.
struct Solution {
  Series series;
  std::vector<double> global; ///< approach (force given) or forces (motion given) of every step
  Series estimated,
      counted; ///< shares of the slave surface in contact; weights: errors relative in each step
};

struct NodalTraction {
  double area = 0, pressure = 0;    ///< pressure times area
  std::array<double, 3> traction{}; ///< friction times area
};

/// @param points  of every step: faces that are cut have others in the next one
Solution solution_of(const Problem& problem, const Simulation& simulation,
                     const std::vector<SlavePoints>& points, const std::vector<StepRecord>& records) {
  Solution solution;
  const Scene& scene = simulation.scene();
  const auto d = static_cast<std::size_t>(scene.dimension);
  for (std::size_t step = 0; step < records.size(); ++step) {
    const StepRecord& record = records[step];
    const SlavePoints& slaves = points[step];
    if (record.value <= problem.after) continue;
    if (const double area = problem.area ? problem.area(scene, record) : NAN; area > 0)
      for (const auto& [series, value] : {std::pair(&solution.estimated, record.area.fraction),
                                          {&solution.counted, record.contact_fraction}}) {
        series->value.push_back(value), series->truth.push_back(area);
        series->weight.push_back(1 / (area * area));
      }
    // Forces of sampling points go to the nodes of their faces: pressures are compared where displacements
    // live.
    std::map<int, NodalTraction> nodes;
    for (std::size_t k = 0; k < slaves.size(); ++k)
      for (std::size_t a = 0; a < slaves.nodes_per_point; ++a) {
        const std::size_t at = k * slaves.nodes_per_point + a;
        NodalTraction& node = nodes[slaves.nodes[at]];
        const double share = slaves.weights[at] * slaves.areas[k];
        node.area += share;
        node.pressure += share * record.fields.pressure[k];
        for (std::size_t i = 0; i < d; ++i) node.traction[i] += share * record.fields.traction[k * d + i];
      }
    if (problem.against) {
      SurfaceState state;
      for (const auto& [number, node] : nodes) {
        state.place.push_back(simulation.mesh().node(number)[0]);
        state.place_y.push_back(simulation.mesh().node(number)[1]);
        state.area.push_back(node.area), state.pressure.push_back(node.pressure / node.area);
      }
      problem.against(record, state, solution.series);
      continue;
    }
    for (const auto& [number, node] : nodes) {
      std::array<double, 3> place{};
      std::copy_n(simulation.mesh().node(number).begin(), d, place.begin());
      const double truth = problem.pressure ? problem.pressure(scene, record, place) : 0;
      if (std::isnan(truth)) break; // nobody knows it in this step
      solution.series.value.push_back(node.pressure / node.area);
      solution.series.weight.push_back(node.area);
      if (problem.exact) solution.series.truth.push_back(truth);
      for (std::size_t i = 0; i < d && !problem.exact; ++i) { // friction, where there is some
        solution.series.value.push_back(node.traction[i] / node.area);
        solution.series.weight.push_back(node.area);
      }
    }
    if (scene.control == Control::force || scene.control == Control::mean_pressure)
      solution.global.push_back(record.approach);
    else
      solution.global.insert(solution.global.end(), record.contact_force.begin(), record.contact_force.end());
  }
  return solution;
}

/// Solve once and add the price to the run.
Solution solve_way(const Problem& problem, const EntsLibrary& library, WorkRun& run) {
  const Scene scene = scene_of(problem, run.way);
  std::optional<AutomaticTangent> automatic;
  if (run.way.tangent == automatic_tangent) automatic.emplace(library, scene);
  const Stopwatch wall;
  const CpuStopwatch cpu(CLOCK_PROCESS_CPUTIME_ID);
  Simulation simulation(scene, automatic ? &automatic->library() : &library, 0,
                        scene.contact->rigid.empty() ? MasterMaker{} : master_of(run.way));
  std::vector<SlavePoints> points;
  RunObserver observer;
  observer.step_done = [&points](const Simulation& at, const StepRecord&) {
    points.push_back(at.contact()->slaves());
  };
  const std::vector<StepRecord> records = solve(simulation, observer);
  run.cpu.push_back(cpu.seconds());
  run.wall.push_back(wall.seconds());
  run.contact_cpu.push_back(simulation.timings().contact_cpu);
  const Sizes sizes = simulation.sizes();
  run.slaves = sizes.slaves, run.segments = sizes.master_segments;
  run.block_dofs = sizes.dofs;
  run.master_dofs =
      simulation.contact()->master().rigid ? sizes.master_dofs : 0; // a body has its dofs in the mesh
  run.iterations = run.cuts = 0;
  for (const StepRecord& record : records) {
    run.iterations += record.iterations();
    run.cuts += static_cast<int>(record.cuts.size());
  }
  return solution_of(problem, simulation, points, records);
}

double relative_difference(const std::vector<double>& values, const std::vector<double>& truth) {
  double difference = 0, norm = 0;
  if (values.size() != truth.size()) return std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < values.size(); ++i)
    difference += std::pow(values[i] - truth[i], 2), norm += truth[i] * truth[i];
  return std::sqrt(difference / norm);
}

std::string sentence(const Problem& problem, const WorkRun& run) {
  std::string text = problem.name + ", " + problem.levels[run.way.level].name + ", " + word(run.way.family);
  if (run.way.divisions > 1) text += " " + std::to_string(run.way.divisions);
  if (run.way.tangent != "consistent") text += ", " + run.way.tangent;
  if (!run.failure.empty()) return text + ": " + run.failure;
  return text + ": error " + format_number(run.error, 3) + ", " + format_number(run.cpu.back(), 3) +
         " s, contact " + format_number(run.contact_cpu.back(), 2) + " s, " + std::to_string(run.iterations) +
         " iterations";
}

} // namespace

const char* word(Family family) {
  switch (family) {
  case Family::enriched:
    return "enriched, one segment";
  case Family::layer:
    return "enriched, elastic layer";
  case Family::sampled:
    return "enriched, sampling points";
  case Family::facets:
    return "plain segments";
  case Family::facets_sampled:
    return "plain segments, sampling points";
  case Family::facets_cut:
    return "plain segments, faces cut";
  case Family::smoothed:
    return "smoothed segments";
  case Family::on_facets:
    return "enriched, on plain segments";
  case Family::on_smoothed:
    return "enriched, on smoothed segments";
  }
  return "";
}

double relative_error(const Series& series, const std::vector<double>& truth) {
  double difference = 0, norm = 0;
  if (series.value.size() != truth.size()) return std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    difference += series.weight[i] * std::pow(series.value[i] - truth[i], 2);
    norm += series.weight[i] * truth[i] * truth[i];
  }
  return std::sqrt(difference / norm);
}

double WorkRun::seconds() const { return median(cpu); }
double WorkRun::contact_seconds() const { return median(contact_cpu); }
double WorkRun::noise() const {
  constexpr double unknown = 0.1; // a single run says nothing of it
  if (cpu.size() < 2) return unknown;
  std::vector<double> away;
  for (const double time : cpu) away.push_back(std::abs(time - seconds()));
  return 2 * median(away) / seconds();
}

Scene scene_of(const Problem& problem, const Way& way) {
  Json json = read_variant(problem.scene, problem.variant);
  const auto apply = [&](const std::vector<std::pair<std::string, Json>>& settings) {
    for (const auto& [pointer, value] : settings) json[Json::json_pointer(pointer)] = value;
  };
  apply(problem.settings);
  apply(problem.levels[way.level].settings);
  if (way.family == Family::sampled || way.family == Family::facets_sampled) json["contact"]["sampling"] = 2;
  if (way.family == Family::facets_cut) json["contact"]["sampling"] = "cut";
  if (problem.adapt) problem.adapt(json, way);
  json["contact"]["model"]["tangent"] = way.tangent == automatic_tangent ? "consistent" : way.tangent;
  return read_scene_text(json.dump(), problem.scene);
}

namespace {

/// The work with another quantity, without runs.
Work other_quantity(const Problem& problem, const std::string& name, const std::string& title) {
  Work work{problem, {}, 0};
  work.problem.name += "_" + name, work.problem.title += ": " + title;
  return work;
}

/// Errors of the contact area; each run twice where its nodes allow an estimate between them.
Work area_of(const Work& work, const std::vector<Solution>& solutions) {
  Work area = other_quantity(work.problem, "area", "contact area");
  area.problem.quantity = "area in contact, relative, rms over the loads";
  area.problem.asked = equal_error_of_area;
  for (std::size_t i = 0; i < work.runs.size(); ++i)
    for (const bool counted : {false, true}) {
      WorkRun run = work.runs[i];
      const Series& series = counted ? solutions[i].counted : solutions[i].estimated;
      run.way.counted = counted, run.global = NAN;
      if (run.failure.empty()) run.error = relative_error(series, series.truth);
      if (!std::isnan(run.error)) area.runs.push_back(run); // sampling points have no estimate
    }
  return area;
}

/// Block, slave mesh and master apart.
Work shares_of(const Work& work, const std::vector<Solution>& solutions) {
  Work shares = other_quantity(work.problem, "shares", "what block, slave mesh and master add to the error");
  shares.problem.quantity =
      "force of every slave node, in parts: of a block its difference to the layer on as many nodes, of "
      "plain segments theirs to one enriched segment on the same nodes, of one segment on a layer the whole "
      "error, "
      "which is that of the slave mesh";
  shares.problem.asked = 0; // nothing to choose from
  for (std::size_t i = 0; i < work.runs.size(); ++i) {
    const std::optional<Way> way = work.problem.beside(work.runs[i].way);
    const auto found =
        way ? std::find(work.problem.ways.begin(), work.problem.ways.end(), *way) : work.problem.ways.end();
    if (way && found == work.problem.ways.end()) continue;
    WorkRun run = work.runs[i];
    run.global = NAN;
    const Series& own = solutions[i].series;
    if (way && run.failure.empty()) { // the difference, of the truth
      Series difference = own;
      const Series& other = solutions[static_cast<std::size_t>(found - work.problem.ways.begin())].series;
      if (other.value.size() != own.value.size()) continue;
      for (std::size_t k = 0; k < own.value.size(); ++k) difference.value[k] += own.truth[k] - other.value[k];
      run.error = relative_error(difference, own.truth);
    }
    shares.runs.push_back(run);
  }
  return shares;
}

} // namespace

std::vector<Work> measure(const Problem& problem, const EntsLibrary& library, int repetitions,
                          const std::function<void(const std::string&)>& progress) {
  Work work{problem, {}, 0};
  if (!problem.against)
    work.following = segments_that_follow(library, scene_of(problem, problem.ways.front()), equal_error);
  std::vector<Solution> solutions(problem.ways.size());
  std::vector<double> truth;
  for (std::size_t i = 0; i < problem.ways.size(); ++i)
    work.runs.push_back({problem.ways[i], {}, 0, NAN, 0, 0, 0, 0, 0, 0, {}, {}, {}});
  const auto first_solution = [&](std::size_t i) {
    WorkRun& run = work.runs[i];
    try {
      solutions[i] = solve_way(problem, library, run);
    } catch (const JobError& error) {
      run.failure = error.what();
    }
  };
  WorkRun warm = work.runs.front(); // the first run is slow because memory is cold: it is not counted
  solve_way(problem, library, warm);
  if (!problem.exact) { // the truth comes first
    first_solution(work.runs.size() - 1);
    truth = solutions.back().series.value;
  }
  for (std::size_t i = 0; i < work.runs.size(); ++i) {
    WorkRun& run = work.runs[i];
    if (problem.exact || i + 1 < work.runs.size()) first_solution(i);
    if (run.failure.empty())
      run.error = relative_error(solutions[i].series, problem.exact ? solutions[i].series.truth : truth);
    progress(sentence(problem, run));
  }
  for (WorkRun& run : work.runs) { // the finest facets of the same level
    const WorkRun* finest = nullptr;
    for (const WorkRun& other : work.runs)
      if (other.way.family == Family::facets && other.way.level == run.way.level && other.failure.empty() &&
          (finest == nullptr || other.way.divisions > finest->way.divisions))
        finest = &other;
    if (finest == nullptr || finest == &run || !run.failure.empty()) continue;
    run.global = relative_difference(solutions[static_cast<std::size_t>(&run - work.runs.data())].global,
                                     solutions[static_cast<std::size_t>(finest - work.runs.data())].global);
  }
  for (int repetition = 1; repetitions > 1 && repetition < repetitions + 2; ++repetition)
    for (WorkRun& run : work.runs)
      if (run.failure.empty() && run.cpu.front() < (repetition < repetitions ? short_run : very_short_run))
        solve_way(problem, library, run);
  std::vector<Work> works{work};
  if (problem.area) works.push_back(area_of(work, solutions));
  if (problem.beside) works.push_back(shares_of(work, solutions));
  return works;
}

} // namespace host::chart
