// SPDX-License-Identifier: BSD-3-Clause
#include "chart/truth_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "chart/pareto.hpp"
#include "output/table.hpp"

namespace host::chart {
namespace {

std::string name_of(const Work& work, const MethodPrice& method) {
  std::string text = family_name({&work}, method.family);
  if (method.counted) text += ", area counted";
  return text;
}

/// Ratios of error and time, `first` over `second`, of runs that differ in nothing else.
struct Ratios {
  std::vector<double> error, time;
  int first_better = 0;
  std::string text() const {
    return format_number(median(error), 2) + " times the error (median of " + std::to_string(error.size()) +
           (error.size() == 1 ? " pair" : " pairs") + ", smaller in " + std::to_string(first_better) + ")";
  }
};

Ratios ratios(const Work& work, const std::function<bool(const WorkRun&)>& is_first,
              const std::function<bool(const WorkRun&, const WorkRun&)>& is_partner) {
  Ratios result;
  for (const WorkRun& first : work.runs)
    for (const WorkRun& second : work.runs)
      if (charted(first) && charted(second) && is_first(first) && first.way.level == second.way.level &&
          first.way.divisions == second.way.divisions && is_partner(first, second)) {
        result.error.push_back(first.error / second.error),
            result.time.push_back(first.seconds() / second.seconds());
        result.first_better += first.error < second.error;
      }
  return result;
}

/// "8.2 % (225), 3.1 % (1089)", in brackets slave nodes: the runs of a family in a work of shares.
std::string list(const Work& work, Family family, bool segments) {
  std::string text;
  for (const WorkRun& run : work.runs) {
    if (run.way.family != family || !charted(run)) continue;
    text += (text.empty() ? "" : ", ") + percent(run.error) + " (";
    if (segments) text += std::to_string(run.segments) + " segments, ";
    text += std::to_string(run.slaves) + ")";
  }
  return text;
}

} // namespace

std::vector<MethodPrice> method_prices(const Work& work) {
  std::vector<MethodPrice> result;
  if (!work.problem.exact || work.problem.asked == 0) return result;
  for (const Family family : families)
    for (const bool counted : {false, true}) {
      MethodPrice method{family, counted};
      for (const WorkRun& run : work.runs) {
        if (run.way.family != family || run.way.counted != counted || !charted(run)) continue;
        if (method.best == nullptr || run.error < method.best->error) method.best = &run;
        if (run.error > work.problem.asked) continue;
        const bool first = !method.reached;
        method.reached = true;
        method.segments = first ? run.segments : std::min(method.segments, run.segments);
        method.dofs = first ? run.dofs() : std::min(method.dofs, run.dofs());
        method.seconds = first ? run.seconds() : std::min(method.seconds, run.seconds());
      }
      if (method.best == nullptr) continue;
      if (!method.reached)
        method.segments = method.best->segments, method.dofs = method.best->dofs(),
        method.seconds = method.best->seconds();
      result.push_back(method);
    }
  return result;
}

std::vector<std::string> comparisons(const Work& work) {
  std::vector<std::string> result;
  const Ratios corrected = ratios(
      work, [](const WorkRun& run) { return !run.way.counted; },
      [](const WorkRun& first, const WorkRun& second) {
        return second.way.counted && second.way.family == first.way.family;
      });
  if (!corrected.error.empty())
    result.push_back("The area corrected between the nodes has " + corrected.text() + " of the counted one.");
  const Ratios cut = ratios(
      work, [](const WorkRun& run) { return run.way.family == Family::facets_cut; },
      [](const WorkRun&, const WorkRun& second) { return second.way.family == Family::facets_sampled; });
  if (!cut.error.empty())
    result.push_back("Plain segments with cut faces have " + cut.text() +
                     " of those with sampling points on the same meshes, and take " +
                     format_number(median(cut.time), 2) + " times as long.");
  if (work.problem.asked == 0) {
    result.push_back("The block's share on so many slave nodes: " + list(work, Family::enriched, false) +
                     ".");
    result.push_back("The slave mesh's share on so many slave nodes: " + list(work, Family::layer, false) +
                     ".");
    result.push_back("The share of a master of plain segments, on so many slave nodes: " +
                     list(work, Family::facets, true) + ".");
  }
  return result;
}

std::string truth_sentence(const Work& work) {
  const std::vector<MethodPrice> methods = method_prices(work);
  const MethodPrice *fastest = nullptr, *closest = nullptr;
  std::string missed;
  for (const MethodPrice& method : methods) {
    if (method.reached && (fastest == nullptr || method.seconds < fastest->seconds)) fastest = &method;
    if (closest == nullptr || method.best->error < closest->best->error) closest = &method;
    if (!method.reached) missed += (missed.empty() ? "" : "; ") + name_of(work, method);
  }
  if (closest == nullptr) return "";
  if (fastest == nullptr)
    return "no run reaches " + percent(work.problem.asked) + ". The closest, " +
           chart::name_of(work.problem, *closest->best) + ", is off by " + percent(closest->best->error) +
           " after " + format_number(closest->best->seconds(), 2) + " s.";
  std::string text = name_of(work, *fastest) + " is the fastest to reach " + percent(work.problem.asked) +
                     ", in " + format_number(fastest->seconds, 2) + " s";
  return text + (missed.empty() ? "; all methods reach it." : ". Not reached here: " + missed + ".");
}

Json truth_json(const Work& work) {
  Json json = Json::array();
  for (const MethodPrice& method : method_prices(work))
    json.push_back({{"method", name_of(work, method)},
                    {"asked", work.problem.asked},
                    {"reached", method.reached},
                    {"segments", method.segments},
                    {"dofs", method.dofs},
                    {"cpu", method.seconds},
                    {"best_error", method.best->error}});
  return json;
}

} // namespace host::chart
