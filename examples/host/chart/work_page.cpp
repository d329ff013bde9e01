// SPDX-License-Identifier: BSD-3-Clause
#include "chart/work_page.hpp"

#include <algorithm>
#include <cmath>

#include "chart/chart_page.hpp"
#include "chart/pareto.hpp"
#include "chart/plot.hpp"
#include "chart/truth_table.hpp"
#include "output/table.hpp"

namespace host::chart {
namespace {

constexpr const char* introduction = "<p>What does an error cost? Every mark is one solution of a scene: its "
                                     "error against the price. Each curve of plain or smoothed "
                                     "segments is one slave mesh with finer and finer masters; it falls "
                                     "until the slave mesh's own error is left. An enriched segment has "
                                     "one master only, so its curve runs over the slave meshes. The broad "
                                     "grey line is the Pareto front: no other run is cheaper and "
                                     "better. Point at a mark to see its numbers.</p>"
                                     "<p><b>Price:</b> time of the processor, median of three repetitions in "
                                     "turns (five below 0.3 s, one above 1.5 s); "
                                     "of the whole solve from reading the model to the last load, and of its "
                                     "contact part (search and contact elements). The linear block, its "
                                     "mesh and its solver are the same for all ways of one slave mesh. "
                                     "<b>Newton's tolerance</b> is 1e-6 of the forces, for all: a thousandth "
                                     "of the smallest errors here. On plain segments "
                                     "contact is linear between two kinks, so that Newton's last step is "
                                     "exact; on curved ones it is quadratic, and with a tolerance of 1e-8 "
                                     "or less that costs one more iteration in some steps.</p>";

std::string seconds(const WorkRun* run) { return run == nullptr ? "-" : format_number(run->seconds(), 2); }

std::string milliseconds(const WorkRun* run) {
  return run == nullptr ? "-" : format_number(1e3 * run->contact_seconds(), 2);
}

std::string segments(const WorkRun* run) { return run == nullptr ? "-" : std::to_string(run->segments); }

std::string row(const std::vector<std::string>& cells, const char* tag = "td") {
  std::string html = "<tr>";
  for (const std::string& cell : cells)
    html += std::string("<") + tag + ">" + escaped(cell) + "</" + tag + ">";
  return html + "</tr>";
}

std::string share(const WorkRun& run) {
  return format_number(100 * run.contact_seconds() / run.seconds(), 2) + " %";
}

/// Of the plain meshes over its slave mesh.
bool coarsest(const Work& work, const WorkRun& run) {
  for (const WorkRun& other : work.runs)
    if (other.way.family == Family::facets && other.way.level == run.way.level &&
        other.segments < run.segments)
      return false;
  return true;
}

std::string equal_accuracy_table(const std::vector<Work>& works) {
  std::string html =
      "<h3 id=\"equal\">Equal accuracy: an error of " + std::to_string(std::lround(100 * equal_error)) +
      " %</h3><p>The cheapest enriched segment that is as good, and the plain and smoothed surfaces that "
      "are: "
      "those with the fewest segments, and those that take the least time. Times of the whole solve, then of "
      "the contact "
      "part.</p><div class=\"wide\"><table>" +
      row({"scene", "segments: enriched", "plain", "smoothed", "solve [s]: enriched", "plain", "smoothed",
           "contact [ms]: enriched", "plain", "smoothed", "contact part of the enriched solve"},
          "th");
  std::string notes;
  for (const Work& work : works) {
    const EqualAccuracy at = equal_accuracy(work, equal_error);
    if (at.enriched == nullptr || work.problem.asked != equal_error) continue;
    html += row({work.problem.name, segments(at.enriched), segments(at.fewest_facets),
                 segments(at.fewest_smoothed), seconds(at.enriched), seconds(at.cheapest_facets),
                 seconds(at.cheapest_smoothed), milliseconds(at.enriched), milliseconds(at.cheapest_facets),
                 milliseconds(at.cheapest_smoothed), share(*at.enriched)});
    notes += "<li><b>" + escaped(work.problem.name) + ":</b> ";
    if (at.fewest_facets != nullptr)
      notes += std::to_string(at.fewest_facets->segments / at.enriched->segments) +
               " times fewer segments than plain ones (counted over " + escaped(work.problem.period) + "); ";
    if (at.reaching == 0)
      notes += "no plain or smoothed surface here reaches 1 %" +
               std::string(work.problem.exact ? "." : ", the truth itself aside.");
    else
      notes += "of " + std::to_string(at.reaching) +
               " runs with plain or smoothed segments that reach 1 %, " +
               (at.faster == 0   ? std::string("none takes")
                : at.faster == 1 ? "1 takes"
                                 : std::to_string(at.faster) + " take") +
               " less time than the enriched one by more than the noise.";
    if (at.global_facets != nullptr)
      notes += " For 1 % of the " + std::string(work.problem.forces ? "forces" : "master's motion") +
               " instead, " + std::to_string(at.global_facets->segments) + " plain segments do (" +
               (coarsest(work, *at.global_facets) ? "the fewest here; " : "") + "against the finest ones).";
    if (work.following > 0)
      notes += " To follow the surface itself to 1 % of its amplitude, " + std::to_string(work.following) +
               " plain segments are needed.";
    notes += "</li>";
  }
  return html + "</table></div><ul>" + notes + "</ul>";
}

std::string tangent_table(const std::vector<Work>& works) {
  std::string html =
      "<h3 id=\"tangents\">Tangents</h3><p>The enriched segment with each tangent of the library; the errors "
      "are the same. "
      "Iterations of all loads, failed ones not counted.</p><div class=\"wide\"><table>" +
      row({"scene", "slave mesh", "tangent", "iterations", "cut steps", "solve [s]", "contact [ms]", "error"},
          "th");
  bool any = false;
  for (const Work& work : works) {
    std::size_t level = work.problem.levels.size();
    for (const WorkRun& run : work.runs)
      if (run.way.tangent != "consistent") level = run.way.level;
    for (const WorkRun& run : work.runs) {
      if (run.way.family != Family::enriched || run.way.level != level || !run.failure.empty()) continue;
      any = true;
      html += row({work.problem.name, work.problem.levels[level].name, run.way.tangent,
                   std::to_string(run.iterations), std::to_string(run.cuts), seconds(&run),
                   milliseconds(&run), format_number(100 * run.error, 2) + " %"});
    }
  }
  html += "</table></div><p>Automatic: the consistent tangent by Eigen's AutoDiffScalar instead of the "
          "library's closed form, for one scene. The library still finds the projections and what is in "
          "contact; residual and tangent of each slave node are written in numbers that carry their "
          "derivatives. The steps are the same; what differs is the time. "
          "Of elements with a deformable master: ents-bench --differentiation.</p>";
  return any ? html : std::string();
}

std::string legend_of(const Work& work) {
  std::string html = "<div class=\"key\">";
  const bool areas =
      std::any_of(work.runs.begin(), work.runs.end(), [](const WorkRun& run) { return run.way.counted; });
  for (const Family family : families) {
    const std::string name = family_name({&work}, family);
    if (name.empty()) continue;
    html += "<span><svg class=\"k\" viewBox=\"0 0 14 14\">" + marker(family, 7, 7, "") + "</svg>" + name +
            "</span>";
  }
  if (areas) html += "<span>filled: corrected between the nodes; hollow: counted</span>";
  if (work.problem.asked == 0) return html + "</div>";
  return html + "<span><svg class=\"k\" viewBox=\"0 0 14 14\"><path class=\"f\" d=\"M2 7H12\"/></svg>Pareto "
                "front</span></div>";
}

Json run_json(const Problem& problem, const WorkRun& run) {
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  const bool several = run.way.family == Family::enriched && run.way.divisions > 1;
  Json json{{"way",
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

std::string work_section(const std::vector<Work>& works) {
  std::string html = introduction + truth_table(works) + equal_accuracy_table(works);
  for (const Work& work : works) {
    const Problem& problem = work.problem;
    html += "<h3 id=\"work_" + problem.name + "\">" + escaped(problem.title) + "</h3><p>" +
            escaped(problem.text) + " <b>Error:</b> " + escaped(problem.quantity) + ", against " +
            escaped(problem.truth) + ".</p>" + legend_of(work) + "<div class=\"charts\">";
    for (const Price price : prices) html += "<figure>" + work_svg(work, price) + "</figure>";
    html += "</div><ul>";
    for (const std::string& line : advice(work, advised_errors)) html += "<li>" + escaped(line) + "</li>";
    for (const std::string& line : comparisons(work)) html += "<li>" + escaped(line) + "</li>";
    for (const WorkRun& run : work.runs)
      if (!run.failure.empty())
        html += "<li>Not solved: " + escaped(word(run.way.family)) + " " + std::to_string(run.way.divisions) +
                ", " + escaped(problem.levels[run.way.level].name) + ": " + escaped(run.failure) + "</li>";
    html += "</ul>";
  }
  return html + tangent_table(works);
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
                    {"quantity", problem.quantity},
                    {"truth", problem.truth},
                    {"period", problem.period},
                    {"runs", runs},
                    {"front", front},
                    {"advice", advice(work, advised_errors)},
                    {"methods", truth_json(work)},
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
