// SPDX-License-Identifier: BSD-3-Clause
// The scenes of the work-precision diagrams and the ways they are solved in (work_problems.json), and their exact
// pressures.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

#include "chart/work.hpp"
#include "exact.hpp"
#include "output/pictures.hpp"

namespace host::chart {
namespace {

using std::numbers::pi;

double pressure_of_cylinder(const Scene& scene, const StepRecord& record,
                            const std::array<double, 3>& place) {
  const HertzLine hertz = hertz_line(record.force, scene.exact.radius, contact_modulus(scene));
  return hertz_pressure(hertz.peak_pressure, hertz.half_width, place[0]);
}

double pressure_of_wave(const Scene& scene, const StepRecord& record, const std::array<double, 3>& place) {
  const double full =
      westergaard_full_contact(scene.exact.amplitude, scene.exact.wavelength, contact_modulus(scene));
  return westergaard_pressure(full, record.mean_pressure, place[0], scene.exact.wavelength);
}

/// Known in full contact only.
double pressure_of_two_waves(const Scene& scene, const StepRecord& record,
                             const std::array<double, 3>& place) {
  const double wave = 2 * pi / scene.exact.wavelength;
  const double full =
      double_sine_full_contact(scene.exact.amplitude, scene.exact.wavelength, contact_modulus(scene));
  if (record.mean_pressure < full) return std::numeric_limits<double>::quiet_NaN();
  return record.mean_pressure + full * std::cos(wave * place[0]) * std::cos(wave * place[1]);
}

double pressure_of_sphere(const Scene& scene, const StepRecord& record, const std::array<double, 3>& place) {
  const HertzPoint hertz = hertz_point_under(record.force, scene.exact.radius, contact_modulus(scene));
  return hertz_pressure(hertz.peak_pressure, hertz.radius, std::hypot(place[0], place[1]));
}

// Shares of the slave surface in contact; force over mean pressure is the whole of it, with all its mirror
// images.

double area_of_cylinder(const Scene& scene, const StepRecord& record) {
  return 2 * hertz_line(record.force, scene.exact.radius, contact_modulus(scene)).half_width *
         record.mean_pressure / record.force;
}

double area_of_sphere(const Scene& scene, const StepRecord& record) {
  const double radius = hertz_point_under(record.force, scene.exact.radius, contact_modulus(scene)).radius;
  return pi * radius * radius * record.mean_pressure / record.force;
}

double area_of_wave(const Scene& scene, const StepRecord& record) {
  const double full =
      westergaard_full_contact(scene.exact.amplitude, scene.exact.wavelength, contact_modulus(scene));
  return 2 * westergaard_half_width(full, record.mean_pressure, scene.exact.wavelength) /
         scene.exact.wavelength;
}

/// A folder of this process alone, gone when it ends.
struct TemporaryFolder {
  std::filesystem::path path;
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "ents_chart_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw JobError("no folder for temporary files: " + name);
    path = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

constexpr double stiffness_ratio = 1000;

/// The rigid sine of the scene becomes a body below, the half-plane is turned over and pressed down.
void elastic_master(Json& scene, const Way& way) {
  constexpr double amplitude = 0.0005, approach = 0.0016; // the scene's own; some 0.9 p*
  scene["materials"]["stiff"] = {
      {"law", "linear_elastic"}, {"young", 1000 * stiffness_ratio}, {"poisson", 0.3}};
  Json upper = scene["parts"][0];
  Json& piece = upper["y"]["pieces"][0];
  piece["growth"] = 1 / piece["growth"].get<double>();
  piece["to"] = 1 + amplitude;
  upper["y"]["from"] = amplitude;
  Json lower{{"name", "lower"}, {"material", "stiff"}};
  const bool meshed = way.family == Family::facets;
  if (meshed) {
    static const TemporaryFolder folder;
    const auto file = folder.path / ("wave_" + std::to_string(way.divisions) + ".inp");
    std::ofstream(file) << wavy_block_deck(way.divisions, amplitude, 1, 1);
    lower["deck"] = file.string();
  } else {
    const auto axis = [](double from, double to, int n) {
      return Json{{"from", from}, {"pieces", Json::array({{{"to", to}, {"divisions", n}}})}};
    };
    lower["element"] = "quad4";
    lower["x"] = axis(-0.5, 0.5, way.divisions);
    lower["y"] = axis(-1, 0, way.divisions);
  }
  scene["parts"] = Json::array({lower, upper});
  scene["periodic"] = Json::array(
      {Json::array({"block.x_min", "block.x_max"}),
       meshed ? Json::array({"lower.LEFT", "lower.RIGHT"}) : Json::array({"lower.x_min", "lower.x_max"})});
  scene["supports"] = Json::array({{{"nodes", meshed ? "lower.BASE" : "lower.y_min"}, {"x", 0}, {"y", 0}},
                                   {{"nodes", "block.y_max"}, {"x", 0}, {"y", -approach}}});
  Json model = scene["contact"]["model"];
  model.erase("surface_coordinates");
  if (meshed) model["height"] = nullptr;
  model["border"] = 0.1;
  Json master{{"faces", meshed ? "lower.TOP" : "lower.y_max"}};
  if (!meshed) master["surface_coordinates"] = Json::array({"x"});
  scene["contact"] = {{"slave", "block.y_min"}, {"master", master}, {"model", model}};
  scene["steps"] = {{"control", "load_factor"}, {"values", {1. / 3, 2. / 3, 1}}};
  scene.erase("exact");
  scene.erase("compare");
}

double pressure_of_two_bodies(const Scene& scene, const StepRecord& record,
                              const std::array<double, 3>& place) {
  (void)scene;
  const double one = 1000 / (1 - 0.3 * 0.3), modulus = one / (1 + 1 / stiffness_ratio);
  return westergaard_pressure(westergaard_full_contact(0.0005, 1, modulus), record.mean_pressure, place[0],
                              1);
}

/// Rows [family or families, divisions ..., tangent]; without a tangent the consistent one.
void add_ways(std::vector<Way>& ways, const Json& rows, std::size_t level) {
  static constexpr std::array names{"enriched",   "layer",    "sampled",   "facets",     "facets_sampled",
                                    "facets_cut", "smoothed", "on_facets", "on_smoothed"}; // as in Family
  for (const Json& row : rows) {
    const Json of = row[0].is_string() ? Json::array({row[0]}) : row[0];
    const bool says = row.back().is_string();
    for (std::size_t i = 1; i + (says ? 1 : 0) < row.size(); ++i)
      for (const Json& family : of)
        ways.push_back({static_cast<Family>(std::find(names.begin(), names.end(), family) - names.begin()),
                        row[i].get<int>(), level, says ? row.back().get<std::string>() : Way().tangent});
  }
}

Problem problem_of(const std::string& name, const Json& data, const std::filesystem::path& scenes) {
  static const std::map<std::string, std::pair<decltype(Problem::pressure), decltype(Problem::area)>> truths{
      {"cylinder", {pressure_of_cylinder, area_of_cylinder}},
      {"sphere", {pressure_of_sphere, area_of_sphere}},
      {"two bodies", {pressure_of_two_bodies, {}}},
      {"two waves", {pressure_of_two_waves, {}}}, // whose area in contact has no closed form
      {"wave", {pressure_of_wave, area_of_wave}}};
  const auto text = [&](const char* key) { return data.value(key, std::string()); };
  Problem p;
  p.name = name, p.title = text("title"), p.text = text("text"), p.quantity = text("quantity");
  p.truth = text("truth"), p.period = text("period");
  p.scene = scenes / text("scene") / "scene.json", p.variant = text("variant");
  p.forces = data.value("forces", false), p.after = data.value("after", p.after);
  p.exact = data.contains("truth_of");
  if (p.exact) std::tie(p.pressure, p.area) = truths.at(text("truth_of"));
  if (name == "elastic_master") p.adapt = elastic_master;
  for (const auto& [place, value] : data.at("settings").items()) p.settings.emplace_back(place, value);
  for (const auto& [level, values] : data.at("levels").items()) {
    p.levels.push_back({level, {}});
    for (std::size_t i = 0; i < values.size(); ++i)
      p.levels.back().settings.emplace_back(data.at("places")[i].get<std::string>(), values[i]);
  }
  for (std::size_t level = 0; level < p.levels.size(); ++level) add_ways(p.ways, data.at("each"), level);
  add_ways(p.ways, data.value("middle", Json::array()), (p.levels.size() - 1) / 2);
  return p;
}

} // namespace

std::vector<Problem> work_problems(const std::filesystem::path& scenes, bool quick) {
  std::vector<Problem> problems;
  const Json all = Json::parse(pictures::work_problems_text);
  for (const auto& [name, data] : all.items()) {
    Json problem = data;
    if (quick) problem.merge_patch(data.at("quick"));
    problems.push_back(problem_of(name, problem, scenes));
  }
  return problems;
}

} // namespace host::chart
