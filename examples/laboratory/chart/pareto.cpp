// SPDX-License-Identifier: BSD-3-Clause
#include "chart/pareto.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "output/table.hpp"

namespace host::chart {
namespace {

double time_of(const WorkRun& run) { return run.seconds(); }
double segments_of(const WorkRun& run) { return static_cast<double>(run.segments); }

/// Times whose ratio is closer to 1 are the same.
double noise(const WorkRun& a, const WorkRun& b) { return std::max({a.noise(), b.noise(), 0.05}); }

std::string count(const WorkRun& run) {
  return std::to_string(run.segments) + (run.segments == 1 ? " segment" : " segments");
}

} // namespace

std::string percent(double value) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "%.3g %%", 100 * value);
  return text.data();
}

bool charted(const WorkRun& run) {
  return run.failure.empty() && run.error > 0 && std::isfinite(run.error) && run.way.tangent == "consistent";
}

std::vector<const WorkRun*> pareto_front(const std::vector<WorkRun>& runs,
                                         const std::function<double(const WorkRun&)>& price) {
  std::vector<const WorkRun*> all, front;
  for (const WorkRun& run : runs)
    if (charted(run)) all.push_back(&run);
  std::stable_sort(all.begin(), all.end(), [&](const WorkRun* a, const WorkRun* b) {
    return price(*a) != price(*b) ? price(*a) < price(*b) : a->error < b->error;
  });
  double least = std::numeric_limits<double>::infinity();
  for (const WorkRun* run : all)
    if (run->error < least) least = run->error, front.push_back(run);
  return front;
}

const WorkRun* cheapest(const std::vector<WorkRun>& runs, double error,
                        const std::function<double(const WorkRun&)>& price,
                        const std::function<bool(const WorkRun&)>& among) {
  const WorkRun* best = nullptr;
  for (const WorkRun& run : runs)
    if (charted(run) && run.error <= error && among(run) && (best == nullptr || price(run) < price(*best)))
      best = &run;
  return best;
}

std::string family_name(const std::vector<const Work*>& works, Family family) {
  std::size_t least = 0, most = 0;
  for (const Work* work : works)
    for (const WorkRun& run : work->runs) {
      if (run.way.family != family || !charted(run)) continue;
      least = most == 0 ? run.segments : std::min(least, run.segments), most = std::max(most, run.segments);
    }
  if (most == 0) return "";
  if (family != Family::enriched || most == 1) return word(family);
  return "enriched, " + (least == most ? "" : std::to_string(least) + "-") + std::to_string(most) +
         " segments";
}

std::string name_of(const Problem& problem, const WorkRun& run) {
  std::string text = word(run.way.family);
  if (run.way.family == Family::enriched && run.segments > 1)
    text = "enriched, " + count(run);
  else if (run.segments > 1)
    text += " (" + std::to_string(run.segments) + ")";
  if (run.way.counted) text += ", area counted";
  return text + ", " + problem.levels[run.way.level].name;
}

namespace {

/// What to take for an error, and the best of the others: enriched segments against segments without height,
/// and the other way round.
struct Choice {
  const WorkRun *best = nullptr, *other = nullptr;
  bool operator==(const Choice&) const = default;
};

bool plain(const WorkRun& run) {
  return run.way.family == Family::facets || run.way.family == Family::smoothed;
}

Choice choose(const Work& work, double error) {
  Choice choice;
  choice.best = cheapest(work.runs, error, time_of, [](const WorkRun&) { return true; });
  if (choice.best != nullptr)
    choice.other = cheapest(work.runs, error, time_of,
                            [&](const WorkRun& run) { return plain(run) != plain(*choice.best); });
  return choice;
}

std::string sentence(const Work& work, const std::string& errors, const Choice& choice) {
  const WorkRun& best = *choice.best;
  std::string text = "For an error of " + errors + " take " + name_of(work.problem, best) + ": " +
                     format_number(best.seconds(), 2) + " s";
  if (choice.other == nullptr)
    return text +
           (plain(best) ? "; no enriched surface here reaches it."
                        : "; no surface without height here reaches it") +
           (plain(best)          ? ""
            : work.problem.exact ? "."
                                 : ", the truth itself aside.");
  const WorkRun& other = *choice.other;
  const double ratio = other.seconds() / best.seconds();
  text += "; " + name_of(work.problem, other);
  if (ratio - 1 <= noise(best, other))
    return text + ", takes the same time within the noise (" + format_number(other.seconds(), 2) + " s).";
  return text + ", takes " + format_number(ratio, 2) + " times as long.";
}

} // namespace

std::vector<std::string> advice(const Work& work, const std::vector<double>& errors) {
  std::vector<std::string> result;
  if (work.problem.asked == 0) return result; // shares of an error: no ways to choose from
  for (std::size_t i = 0; i < errors.size();) {
    const Choice choice = choose(work, errors[i]);
    std::size_t last = i; // of those with the same answer
    while (last + 1 < errors.size() && choose(work, errors[last + 1]) == choice) ++last;
    if (choice.best != nullptr)
      result.push_back(
          sentence(work, last == i ? percent(errors[i]) : percent(errors[i]) + " to " + percent(errors[last]),
                   choice));
    i = last + 1;
  }
  return result;
}

EqualAccuracy equal_accuracy(const Work& work, double error) {
  EqualAccuracy result;
  const auto of = [](Family family) {
    return [family](const WorkRun& run) { return run.way.family == family; };
  };
  result.enriched = cheapest(work.runs, error, time_of, of(Family::enriched));
  result.fewest_facets = cheapest(work.runs, error, segments_of, of(Family::facets));
  result.cheapest_facets = cheapest(work.runs, error, time_of, of(Family::facets));
  result.fewest_smoothed = cheapest(work.runs, error, segments_of, of(Family::smoothed));
  result.cheapest_smoothed = cheapest(work.runs, error, time_of, of(Family::smoothed));
  if (const WorkRun* fastest = result.enriched; fastest != nullptr)
    result.enriched = cheapest(work.runs, error, segments_of, [&](const WorkRun& run) {
      return run.way.family == Family::enriched &&
             run.seconds() <= fastest->seconds() * (1 + noise(run, *fastest));
    });
  for (const WorkRun& run : work.runs) {
    if (result.enriched == nullptr || !run.failure.empty()) continue;
    if (run.way.family == Family::facets && run.way.level == result.enriched->way.level &&
        run.global <= error &&
        (result.global_facets == nullptr || run.segments < result.global_facets->segments))
      result.global_facets = &run;
    if (!charted(run) || run.error > error) continue;
    if (run.way.family != Family::facets && run.way.family != Family::smoothed) continue;
    ++result.reaching;
    result.faster += run.seconds() < result.enriched->seconds() * (1 - noise(run, *result.enriched));
  }
  return result;
}

} // namespace host::chart
