// SPDX-License-Identifier: BSD-3-Clause
// ents-lab chart: solve the maps and the work-precision runs, tell the terminal, leave chart.json, of which
// chart.py makes chart.html and the pictures.
#include <algorithm>
#include <cstdio>

#include "chart/map.hpp"
#include "chart/pareto.hpp"
#include "chart/truth_table.hpp"
#include "chart/work.hpp"
#include "chart/work_json.hpp"
#include "chart/wrong_heights.hpp"
#include "commands.hpp"
#include "output/pictures.hpp"
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

Json heights_json(const std::vector<WrongHeight>& heights) {
  Json out = Json::array();
  for (const WrongHeight& row : heights)
    out.push_back({{"panel", row.panel},
                   {"what", row.what},
                   {"example", row.example},
                   {"surface_check", row.check},
                   {"on_the_way", row.running},
                   {"flagged", row.flagged}});
  return out;
}

void write_chart(const ChartOptions& options, const Json& json) {
  write_text(options.out / "chart.json", json.dump() + "\n");
  for (const auto& [name, text] : {std::pair{"chart.py", pictures::chart_script},
                                   {"page.html", pictures::page_text},
                                   {"pictures.py", pictures::pictures_script}})
    write_text(options.out / name, text);
  const std::string problem =
      pictures::run_script(options.out, "chart.py", options.pictures ? "" : "--no-pictures");
  if (!problem.empty()) std::fprintf(stderr, "%s\n", problem.c_str());
}

void print_chart(const std::vector<Work>& works, const std::vector<WrongHeight>& heights, const Table& maps) {
  for (const Work& work : works) {
    std::printf("%s: %s\n", work.problem.name.c_str(), work.problem.quantity.c_str());
    for (const std::string& line : advice(work, advised_errors)) std::printf("  %s\n", line.c_str());
    for (const std::string& line : comparisons(work)) std::printf("  %s\n", line.c_str());
  }
  if (const std::string text = maps.text(); !text.empty()) std::printf("\n%s", text.c_str());
  Table wrong_table;
  wrong_table.column("Fig. 4").column("wrong because").column("ents_surface_check").column("on the way");
  for (const WrongHeight& row : heights) wrong_table.row({row.panel, row.what, row.check, row.running});
  std::printf("\n%s", wrong_table.text().c_str());
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
  Json json{{"version", library.version()},
            {"work_precision", work_json(works)},
            {"stability", Json::array()},
            {"ends", Json::array()},
            {"pictured", Json::array()}};
  for (const End end : {End::fold, End::edge, End::self_shadow, End::crossing, End::ambiguous, End::behind,
                        End::jump, End::unstable})
    json["ends"].push_back(word(end));
  std::vector<const Work*> pictured;
  for (const Work& work : works)
    if (!options.only.empty() || work.problem.name == "wavy3d" || work.problem.name == "elastic_master")
      pictured.push_back(&work), json["pictured"].push_back(work.problem.name);
  json["families"] = families_json(pictured);
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
  }
  json["silently_wrong"] = wrong;
  json["wrong_heights"] = heights_json(heights);
  const bool covered =
      std::all_of(heights.begin(), heights.end(), [](const WrongHeight& row) { return row.flagged; });

  if (!options.out.empty()) write_chart(options, json);
  if (common.json) {
    std::printf("%s\n", json.dump().c_str());
  } else {
    print_chart(works, heights, maps.empty() ? Table() : table);
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
