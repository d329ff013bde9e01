// SPDX-License-Identifier: BSD-3-Clause
#include "chart/work_json.hpp"

#include "chart/pareto.hpp"
#include "chart/truth_table.hpp"
#include "output.hpp"

namespace host::chart {
namespace {

Json run_json(const Problem& problem, const WorkRun& run) {
  const bool several = run.way.family == Family::enriched && run.way.divisions > 1;
  Json json{{"name", name_of(problem, run)},
            {"family", static_cast<int>(run.way.family)},
            {"way",
             several ? "enriched, " + std::to_string(run.way.divisions) + " segments" : word(run.way.family)},
            {"divisions", run.way.divisions},
            {"slave_mesh", problem.levels[run.way.level].name},
            {"tangent", run.way.tangent},
            {"counted", run.way.counted}};
  if (!run.failure.empty()) {
    json["failure"] = run.failure;
    return json;
  }
  json.update({{"error", number(run.error)},
               {"global_difference", number(run.global)},
               {"cpu", run.seconds()},
               {"contact_cpu", run.contact_seconds()},
               {"cpu_all", run.cpu},
               {"contact_cpu_all", run.contact_cpu},
               {"wall_all", run.wall},
               {"slaves", run.slaves},
               {"segments", run.segments},
               {"block_dofs", run.block_dofs},
               {"master_dofs", run.master_dofs},
               {"iterations", run.iterations},
               {"cuts", run.cuts}});
  return json;
}

} // namespace

Json families_json(const std::vector<const Work*>& works) {
  Json json = Json::array();
  for (const Family family : families)
    if (const std::string name = family_name(works, family); !name.empty())
      json.push_back({static_cast<int>(family), name});
  return json;
}

Json work_json(const std::vector<Work>& works) {
  Json json = Json::array();
  for (const Work& work : works) {
    const Problem& problem = work.problem;
    Json runs = Json::array(), front = Json::array();
    for (const WorkRun& run : work.runs) runs.push_back(run_json(problem, run));
    for (const WorkRun* run : pareto_front(work.runs, [](const WorkRun& at) { return at.seconds(); }))
      front.push_back(run - work.runs.data());
    const EqualAccuracy at = equal_accuracy(work, equal_error);
    const auto index = [&](const WorkRun* run) {
      return run == nullptr ? Json() : Json(run - work.runs.data());
    };
    json.push_back({{"name", problem.name},
                    {"title", problem.title},
                    {"text", problem.text},
                    {"asked", problem.asked},
                    {"exact", problem.exact},
                    {"forces", problem.forces},
                    {"families", families_json({&work})},
                    {"quantity", problem.quantity},
                    {"truth", problem.truth},
                    {"period", problem.period},
                    {"runs", runs},
                    {"front", front},
                    {"advice", advice(work, advised_errors)},
                    {"methods", truth_json(work)},
                    {"sentence", truth_sentence(work)},
                    {"comparisons", comparisons(work)},
                    {"equal_accuracy",
                     {{"error", equal_error},
                      {"plain_following", work.following > 0 ? Json(work.following) : Json()},
                      {"enriched", index(at.enriched)},
                      {"fewest_plain", index(at.fewest_facets)},
                      {"cheapest_plain", index(at.cheapest_facets)},
                      {"fewest_smoothed", index(at.fewest_smoothed)},
                      {"cheapest_smoothed", index(at.cheapest_smoothed)},
                      {"global_plain", index(at.global_facets)},
                      {"reaching", at.reaching},
                      {"faster", at.faster}}}});
  }
  return json;
}

} // namespace host::chart
