// SPDX-License-Identifier: BSD-3-Clause
#include "chart/map.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace host::chart {
namespace {

/// All panels of one point. The independent minimiser runs once per surface and projection, and only if a
/// method has a result.
void fill_point(Map& map, std::size_t point, const EntsLibrary& library) {
  const double x = map.x.values[point % map.x.values.size()], y = map.y.values[point / map.x.values.size()];
  for (const SurfaceKind surface : map.surfaces)
    for (const ProjectionKind projection : projection_kinds) {
      Truth truth;
      for (Panel& panel : map.panels) {
        if (panel.method.surface != surface || panel.method.projection != projection) continue;
        const Press press = map.problem(x, y, panel.method);
        Outcome outcome = solve(library, press, panel.careful ? Rules{} : careless);
        if (truth.position.empty() && !outcome.levels.empty()) truth = true_path(press);
        Cell& cell = panel.cells[point];
        cell = judged(outcome, press, truth);
        outcome.levels.clear();
        cell.outcome = std::move(outcome);
      }
    }
}

} // namespace

const char* word(Fate fate) {
  switch (fate) {
  case Fate::solved:
    return "solved";
  case Fate::flagged:
    return "flagged";
  case Fate::diverged:
    return "diverged";
  case Fate::wrong:
    return "silently wrong";
  case Fate::unjudged:
    break;
  }
  return "unjudged";
}

Cell judged(const Outcome& outcome, const Press& press, const Truth& truth) {
  Cell cell;
  cell.fate = outcome.end == End::solved ? Fate::solved
              : is_flag(outcome.end)     ? Fate::flagged
                                         : Fate::diverged;
  for (const Level& level : outcome.levels) {
    const auto step = static_cast<std::size_t>(level.increment * judge_steps / press.increments);
    if (step >= truth.position.size()) {
      cell.fate = Fate::unjudged;
      return cell;
    }
    const double error = (level.position - truth.position[step]).norm();
    cell.error = std::max(cell.error, error);
    const double zone = press.truth->end_zone(truth.pair[step]);
    if (error > same_position + 2 * zone && cell.wrong_increment == 0) {
      cell.wrong_increment = level.increment;
      cell.fate = Fate::wrong;
    }
  }
  return cell;
}

void fill(Map& map, const EntsLibrary& library, bool with_careless) {
  map.panels.clear();
  const std::size_t points = map.x.values.size() * map.y.values.size();
  for (const SurfaceKind surface : map.surfaces)
    for (const ProjectionKind projection : projection_kinds) {
      for (const TangentKind tangent : tangent_kinds)
        map.panels.push_back({{surface, projection, tangent}, true, std::vector<Cell>(points)});
      if (with_careless)
        map.panels.push_back(
            {{surface, projection, TangentKind::consistent}, false, std::vector<Cell>(points)});
    }
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      for (std::size_t point; (point = next++) < points;) fill_point(map, point, library);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

} // namespace host::chart
