// SPDX-License-Identifier: BSD-3-Clause
// The scenes of the work-precision diagrams, the ways they are solved in, and their exact pressures.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <numbers>

#include "chart/work.hpp"
#include "exact.hpp"

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

/// All levels by enriched segments, sampling points, plain and smoothed meshes; the tangents on one level.
std::vector<Way> all_ways(const std::vector<SlaveMesh>& levels, const std::vector<int>& plain,
                          const std::vector<int>& smooth, bool sampling) {
  std::vector<Way> ways;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    ways.push_back({Family::enriched, 1, level});
    if (sampling) ways.push_back({Family::sampled, 1, level});
    for (const int n : smooth) ways.push_back({Family::smoothed, n, level});
    for (const int n : plain) ways.push_back({Family::facets, n, level});
  }
  const std::size_t middle = (levels.size() - 1) / 2;
  // The finest plain mesh has points enough, and cutting at all its segments takes longest.
  for (std::size_t k = 0; sampling && k + 1 < plain.size(); ++k)
    for (const Family family : {Family::facets_sampled, Family::facets_cut})
      ways.push_back({family, plain[k], middle});
  for (const char* tangent : {"small_gap", "first_variation"})
    ways.push_back({Family::enriched, 1, middle, tangent});
  return ways;
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

const char* const pieces_x = "/parts/0/x/pieces/0/divisions";

// Three orders below the smallest error of the charts, for every way.
const std::pair<std::string, Json> loose_tolerance{"/solver", {{"tolerance", 1e-6}}};

SlaveMesh mesh_level(const std::string& name, std::vector<std::pair<std::string, Json>> settings) {
  return SlaveMesh{name, std::move(settings)};
}

Problem westergaard_problem(const std::filesystem::path& scenes, bool quick) {
  Problem p;
  p.name = "westergaard", p.title = "Westergaard: a sine on a half-plane";
  p.text = "Three loads up to 0.9 p*; a segment of 1.5 waves.";
  p.quantity = "contact pressure, L2 over the surface and the loads";
  p.truth = "Westergaard's exact pressure";
  p.period = "1.5 waves";
  p.scene = scenes / "westergaard" / "scene.json";
  p.settings = {loose_tolerance, {"/steps/values", {0.5178449, 1.0356899, 1.5535348}}};
  for (const auto& [n, ny, growth] : {std::tuple{32, 16, 0.80}, {64, 22, 0.86}, {128, 30, 0.90}})
    p.levels.push_back(mesh_level(
        std::to_string(n) + " slave nodes",
        {{pieces_x, n}, {"/parts/0/y/pieces/0/divisions", ny}, {"/parts/0/y/pieces/0/growth", growth}}));
  if (quick) p.levels.resize(1);
  p.ways = quick ? all_ways(p.levels, {15, 60}, {15}, true)
                 : all_ways(p.levels, {7, 15, 30, 60, 120, 240, 480}, {7, 15, 30, 60}, true);
  p.pressure = pressure_of_wave, p.area = area_of_wave;
  return p;
}

Problem hertz2d_problem(const std::filesystem::path& scenes, bool quick) {
  Problem p;
  p.name = "hertz2d", p.title = "Hertz: a cylinder on a block";
  p.text = "Two forces; the master is 2 long, the contact at most 0.4.";
  p.quantity = "contact pressure, L2 over the surface and the loads";
  p.truth = "Hertz's exact pressure";
  p.period = "2 mm, of which 0.4 touch";
  p.scene = scenes / "hertz2d" / "scene.json";
  p.settings = {loose_tolerance, {"/steps/values", {1.5, 3.5}}};
  for (const auto& [n, ny] : {std::pair{15, 5}, {30, 10}, {60, 20}})
    p.levels.push_back(mesh_level(std::to_string(n + 34) + " slave nodes",
                                  {{pieces_x, n}, {"/parts/0/y/pieces/1/divisions", ny}}));
  if (quick) p.levels.resize(1);
  p.ways = quick ? all_ways(p.levels, {23, 95}, {23}, true)
                 : all_ways(p.levels, {6, 11, 23, 47, 95, 191, 383}, {11, 23, 47}, true);
  p.pressure = pressure_of_cylinder, p.area = area_of_cylinder;
  return p;
}

Problem hertz3d_problem(const std::filesystem::path& scenes, bool quick) {
  Problem p;
  p.name = "hertz3d", p.title = "Hertz: a sphere on a half-space";
  p.text = "Two forces; the master is 4 x 4 large, the contact radius at most 0.2.";
  p.quantity = "contact pressure, L2 over the surface and the loads";
  p.truth = "Hertz's exact pressure";
  p.period = "4 x 4 mm, of which 0.4 x 0.4 touch";
  p.scene = scenes / "hertz3d" / "scene.json";
  p.settings = {loose_tolerance, {"/steps/values", {0.6, 1.2}}};
  for (const auto& [n, nz] : {std::pair{5, 2}, {8, 3}, {12, 5}})
    p.levels.push_back(mesh_level(
        std::to_string((n + 11) * (n + 11)) + " slave nodes",
        {{pieces_x, n}, {"/parts/0/y/pieces/0/divisions", n}, {"/parts/0/z/pieces/1/divisions", nz}}));
  if (quick) p.levels.resize(1);
  p.ways = all_ways(p.levels, {23, 47, 95, 189}, {5, 11}, true);
  if (quick) p.ways = {{Family::enriched, 1, 0}, {Family::facets, 12, 0}, {Family::facets, 47, 0}};
  p.pressure = pressure_of_sphere, p.area = area_of_sphere;
  return p;
}

Problem wavy3d_problem(const std::filesystem::path& scenes, bool quick) {
  Problem p;
  p.name = "wavy3d", p.title = "Double sine on a half-space";
  p.text = "Two loads of partial contact, then full contact, where the exact pressure is known.";
  p.quantity = "contact pressure, L2 over the surface in full contact";
  p.truth = "the exact pressure of Johnson, Greenwood and Higginson";
  p.period = "one wave per direction";
  p.scene = scenes / "wavy3d" / "scene.json";
  p.settings = {loose_tolerance, {"/steps/values", {3.905831, 7.811662, 9.959869}}};
  for (const auto& [n, nz] : {std::pair{6, 5}, {8, 6}, {12, 7}, {16, 9}})
    p.levels.push_back(mesh_level(std::to_string((n + 1) * (n + 1)) + " slave nodes",
                                  {{pieces_x, n},
                                   {"/parts/0/y/pieces/0/divisions", n},
                                   {"/parts/0/z/pieces/0/divisions", nz},
                                   {"/parts/0/z/pieces/0/growth", std::pow(0.75, 8. / nz)}}));
  if (quick) p.levels.resize(1);
  p.ways = quick ? all_ways(p.levels, {7, 29}, {7}, true)
                 : all_ways(p.levels, {5, 9, 15, 19, 23, 29, 59}, {5, 9, 15}, true);
  p.ways.push_back({Family::enriched, 1, (p.levels.size() - 1) / 2, automatic_tangent});
  p.pressure = pressure_of_two_waves;
  return p;
}

Problem elastic_master_problem(const std::filesystem::path& scenes, bool quick) {
  Problem p;
  p.name = "elastic_master", p.title = "Westergaard with an elastic master, a thousand times as stiff";
  p.text = "One wave, three loads up to about 0.9 p*. Plain segments are the surface of a body that is "
           "meshed to follow the wave; the enriched body is flat, with "
           "one to four elements.";
  p.quantity = "contact pressure, L2 over the surface";
  p.truth = "Westergaard's exact pressure with the compliance of both bodies";
  p.period = "one wave";
  p.scene = scenes / "westergaard" / "scene.json";
  p.settings = {loose_tolerance};
  for (const auto& [n, ny, growth] : {std::tuple{32, 16, 0.80}, {64, 22, 0.86}, {128, 30, 0.90}})
    p.levels.push_back(mesh_level(
        std::to_string(n) + " slave nodes",
        {{pieces_x, n}, {"/parts/0/y/pieces/0/divisions", ny}, {"/parts/0/y/pieces/0/growth", growth}}));
  if (quick) p.levels.resize(1);
  p.adapt = elastic_master, p.forces = true;
  for (std::size_t k = 0; k < p.levels.size(); ++k) {
    for (const int n : {1, 4}) p.ways.push_back({Family::enriched, n, k});
    for (const int n : quick ? std::vector<int>{8, 32} : std::vector<int>{8, 16, 32, 64, 128, 256})
      p.ways.push_back({Family::facets, n, k});
  }
  p.pressure = pressure_of_two_bodies;
  return p;
}

Problem texture_problem(const std::filesystem::path& scenes, bool quick) {
  Problem p;
  p.name = "texture", p.title = "Sliding with friction over a textured arch";
  p.text = "Eight waves on an arch, pressed down, then 0.25 mm of sliding in 24 steps.";
  p.quantity = "pressure and friction at the slave nodes, L2 over the surface and the way";
  p.period = "8 waves";
  p.scene = scenes / "texture" / "scene.json";
  p.settings = {{"/solver/tolerance", 1e-6}};
  p.levels = {mesh_level(quick ? "51 slave nodes" : "101 slave nodes", {{pieces_x, quick ? 50 : 100}})};
  if (quick) p.settings.push_back({"/steps/values", {0.5, 1, 1.05, 1.1}});
  p.exact = false, p.forces = true;
  p.after = 1; // while it is pressed down, friction depends on the increments
  p.ways = all_ways(p.levels, {}, quick ? std::vector<int>{64} : std::vector<int>{32, 64, 128, 256}, false);
  for (const int n : quick ? std::vector<int>{8} : std::vector<int>{4, 8, 16, 32}) {
    p.ways.push_back({Family::on_smoothed, n, 0});
    p.ways.push_back({Family::on_facets, n, 0});
  }
  for (const int n : quick ? std::vector<int>{64, 256} : std::vector<int>{32, 64, 128, 256, 512, 1024})
    p.ways.push_back({Family::facets, n, 0});
  return p;
}

Problem rough_afm_problem(const std::filesystem::path& scenes, bool quick) {
  Problem p;
  p.name = "rough_afm", p.title = "A measured rough surface";
  p.text = "256 x 256 heights; four approaches up to 0.045 um.";
  p.quantity = "contact pressure at the slave nodes, L2 over the surface and the loads";
  p.period = "256 x 256 heights";
  p.scene = scenes / "rough_afm" / "scene.json", p.variant = "block";
  const int n = quick ? 8 : 28;
  p.settings = {loose_tolerance, {"/steps/values", quick ? Json{0.045} : Json{0.01, 0.02, 0.03, 0.045}}};
  p.levels = {mesh_level(std::to_string((n + 1) * (n + 1)) + " slave nodes",
                         {{pieces_x, n}, {"/parts/0/y/pieces/0/divisions", n}})};
  p.exact = false, p.forces = true;
  p.ways = all_ways(p.levels, {}, quick ? std::vector<int>{8} : std::vector<int>{128, 256}, false);
  for (const int m : quick ? std::vector<int>{32, 128} : std::vector<int>{64, 128, 256, 512, 1024})
    p.ways.push_back({Family::facets, m, 0});
  return p;
}

} // namespace

std::vector<Problem> work_problems(const std::filesystem::path& scenes, bool quick) {
  std::vector<Problem> problems;
  for (const auto& problem : {westergaard_problem, hertz2d_problem, hertz3d_problem, wavy3d_problem,
                              elastic_master_problem, texture_problem, rough_afm_problem})
    problems.push_back(problem(scenes, quick));
  for (Problem& p : problems)
    if (!p.exact) {
      const Way& last = p.ways.back();
      const std::string n = std::to_string(last.divisions);
      p.truth = "the finest mesh of plain segments, " + (p.name == "rough_afm" ? n + " x " + n : n) +
                ", on the same slave nodes";
    }
  return problems;
}

} // namespace host::chart
