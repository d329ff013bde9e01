// SPDX-License-Identifier: BSD-3-Clause
// ents-lab chart: solve the maps and the work-precision runs, tell the terminal, leave chart.json,
// chart.html and the pictures.
#include <algorithm>
#include <cstdio>

#include "chart/chart_page.hpp"
#include "chart/map.hpp"
#include "chart/map_picture.hpp"
#include "chart/pareto.hpp"
#include "chart/plot.hpp"
#include "chart/truth_table.hpp"
#include "chart/work.hpp"
#include "chart/work_page.hpp"
#include "chart/wrong_heights.hpp"
#include "commands.hpp"
#include "output/table.hpp"
#include "output/text_file.hpp"
#include "output_folder.hpp"
#include "stopwatch.hpp"

namespace host {
namespace {

using namespace chart;

Json panel_json(const Panel& panel) {
  Json out{{"surface", word(panel.method.surface)},
           {"projection", word(panel.method.projection)},
           {"tangent", word(panel.method.tangent)},
           {"rules", panel.careful}};
  for (const char* key : {"fate", "end", "status", "iterations", "cuts", "error"}) out[key] = Json::array();
  for (const Cell& cell : panel.cells) {
    out["fate"].push_back(word(cell.fate));
    out["end"].push_back(word(cell.outcome.end));
    out["status"].push_back(cell.outcome.status);
    out["iterations"].push_back(cell.outcome.iterations);
    out["cuts"].push_back(cell.outcome.cuts);
    out["error"].push_back(cell.error);
  }
  return out;
}

Json map_json(const Map& map) {
  Json panels = Json::array();
  for (const Panel& panel : map.panels) panels.push_back(panel_json(panel));
  return {{"name", map.name},
          {"title", map.title},
          {"text", map.text},
          {"x", {{"label", map.x.label}, {"values", map.x.values}}},
          {"y", {{"label", map.y.label}, {"values", map.y.values}}},
          {"panels", panels}};
}

/// Number of cells with a fate.
std::int64_t count(const Map& map, bool careful, Fate fate) {
  std::int64_t sum = 0;
  for (const Panel& panel : map.panels)
    if (panel.careful == careful)
      for (const Cell& cell : panel.cells) sum += cell.fate == fate;
  return sum;
}

constexpr const char* maps_introduction =
    "<p>One slave node on a spring is pressed into a wavy rigid master and drawn over two borders of its "
    "segments. Every point of a map is "
    "such a problem, solved once by each method: surface (explicit plain facets; local enrichment, h = 0 at "
    "the segments' ends; C1 and C2 "
    "smoothing) x projection x tangent. The first-variation tangent K = &lambda;' &delta;g "
    "&delta;g<sup>T</sup> is made by the host from "
    "ENTS_GAP_GRADIENT. Increments that fail are halved, up to six times.</p>"
    "<p><b>Solved</b> means solved and right at every increment. The judge has a geometry of its own, "
    "written from the definitions, and walks "
    "512 small steps downhill in energy along the path of equilibria: where continuity puts the node, the "
    "host has to find it, within 1e-5 of a "
    "segment (at the ends of plain segments: within what the host lets them reach beyond). What the host "
    "delivers without a status, a flag or a "
    "failed iteration and lies elsewhere is <b>silently wrong</b>.</p>"
    "<p>The host is a careful one. It asks ents_model_check first; takes its reach as penetration_limit; "
    "believes an increment only if the node has moved by at most a quarter of the shortest wave (as long as "
    "that is "
    "on the enriched surface) and one segment, if the exact tangent is positive definite, and, where contact "
    "takes more than a "
    "quarter of the stiffness away, if two half increments end at the same place; follows a closed node, but "
    "searches an open one anew; takes ENTS_FLAG_BEHIND_EDGE and ENTS_FLAG_AMBIGUOUS for no answer. The lines "
    "&quot;no rules&quot; in the tables are the same host without all this.</p>";

/// Where the scenes are: as the user says, or beside the build tree this program lies in, or here.
std::filesystem::path scenes_folder(const std::filesystem::path& given) {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  std::vector<std::filesystem::path> tried{given};
  if (given.empty()) tried = {program.parent_path() / ".." / ".." / "examples", "examples"};
  for (const std::filesystem::path& folder : tried)
    if (std::filesystem::exists(folder / "westergaard" / "scene.json", error))
      return folder.lexically_normal();
  throw InputError(
      given.empty()
          ? "the scenes (examples/westergaard and others) are not found; say with --scenes DIR where they are"
          : "--scenes: " + given.string() + " has no westergaard/scene.json; the folder examples is meant");
}

std::vector<Work> measure_all(const EntsLibrary& library, const ChartOptions& options) {
  std::vector<Work> works;
  const auto progress = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  std::vector<Problem> problems = work_problems(scenes_folder(options.scenes), options.quick);
  for (Problem& problem : truth_problems(library, scenes_folder(options.scenes), options.quick))
    problems.push_back(std::move(problem));
  for (const std::string& name : options.only)
    if (std::none_of(problems.begin(), problems.end(),
                     [&](const Problem& problem) { return problem.name == name; })) {
      std::string names;
      for (const Problem& problem : problems) names += " " + problem.name;
      throw InputError("--only: no scene is named \"" + name + "\"; these are:" + names);
    }
  std::erase_if(problems, [&](const Problem& problem) {
    return !options.only.empty() &&
           std::find(options.only.begin(), options.only.end(), problem.name) == options.only.end();
  });
  for (const Problem& problem : problems)
    for (Work& work : measure(problem, library, options.quick ? 1 : 3,
                              options.quick ? [](const std::string&) {} : progress))
      works.push_back(std::move(work));
  return works;
}

const Work* named(const std::vector<Work>& works, const std::string& name) {
  for (const Work& work : works)
    if (work.problem.name == name) return &work;
  return nullptr;
}

} // namespace

int chart_command(const CommonOptions& common, const ChartOptions& options) {
  const Stopwatch watch;
  const OutputFolder folder(options.out);
  const EntsLibrary library(common.library);
  const std::vector<Work> works = measure_all(library, options);
  std::vector<Map> maps = options.only.empty() ? stability_maps(options.quick) : std::vector<Map>{};
  const std::vector<WrongHeight> heights = wrong_heights(library);

  Table table;
  table.column("map")
      .column("host")
      .column("solved")
      .column("flagged")
      .column("diverged")
      .column("silently wrong")
      .column("unjudged");
  Json json{
      {"version", library.version()}, {"work_precision", work_json(works)}, {"stability", Json::array()}};
  std::string stability = maps_introduction + legend();
  std::int64_t wrong = 0;
  for (Map& map : maps) {
    fill(map, library, true);
    for (const bool careful : {true, false})
      table.row({careful ? map.title : "", std::string(careful ? "careful" : "no rules"),
                 count(map, careful, Fate::solved), count(map, careful, Fate::flagged),
                 count(map, careful, Fate::diverged), count(map, careful, Fate::wrong),
                 count(map, careful, Fate::unjudged)});
    wrong += count(map, true, Fate::wrong) + count(map, true, Fate::unjudged);
    json["stability"].push_back(map_json(map));
    stability += map_section(map);
  }
  json["silently_wrong"] = wrong;
  bool covered = true;
  json["wrong_heights"] = Json::array();
  for (const WrongHeight& row : heights) {
    covered = covered && row.flagged;
    json["wrong_heights"].push_back({{"panel", row.panel},
                                     {"what", row.what},
                                     {"example", row.example},
                                     {"surface_check", row.check},
                                     {"on_the_way", row.running},
                                     {"flagged", row.flagged}});
  }

  if (!options.out.empty()) {
    write_text(options.out / "chart.json", json.dump() + "\n");
    write_text(options.out / "chart.html",
               page({{"work", "Speed against accuracy", work_section(works)},
                     {"stability", "Stability maps", stability},
                     {"wrong", "Four wrong heights (Fig. 4 of the paper)", wrong_heights_section(heights)}},
                    library.version()));
    std::vector<const Work*> pictured{named(works, "wavy3d"), named(works, "elastic_master")};
    if (!options.only.empty()) {
      pictured.clear();
      for (const Work& work : works) pictured.push_back(&work);
    }
    write_text(options.out / "work_precision.svg", work_picture(pictured, {Price::segments, Price::time}));
    if (options.pictures)
      for (const Map& map : maps)
        if (const pictures::Outcome outcome = draw(map, options.out); !outcome.problem.empty()) {
          std::fprintf(stderr, "%s\n", outcome.problem.c_str());
          break;
        }
  }
  if (common.json) {
    std::printf("%s\n", json.dump().c_str());
  } else {
    for (const Work& work : works) {
      std::printf("%s: %s\n", work.problem.name.c_str(), work.problem.quantity.c_str());
      for (const std::string& line : advice(work, advised_errors)) std::printf("  %s\n", line.c_str());
      for (const std::string& line : comparisons(work)) std::printf("  %s\n", line.c_str());
    }
    if (!maps.empty()) std::printf("\n%s", table.text().c_str());
    Table wrong_table;
    wrong_table.column("Fig. 4").column("wrong because").column("ents_surface_check").column("on the way");
    for (const WrongHeight& row : heights) wrong_table.row({row.panel, row.what, row.check, row.running});
    std::printf("\n%s", wrong_table.text().c_str());
    std::printf("\nchart: %lld silently wrong, %.1f s%s\n", static_cast<long long>(wrong), watch.seconds(),
                options.out.empty() ? "" : (", " + (options.out / "chart.html").string()).c_str());
  }
  if (wrong > 0 || !covered) {
    std::fprintf(stderr, "ents-lab: chart: there are results that are wrong and not flagged; chart.json "
                         "(--out) says where\n");
    return 1;
  }
  return 0;
}

} // namespace host
