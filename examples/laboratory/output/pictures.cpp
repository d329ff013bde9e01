// SPDX-License-Identifier: BSD-3-Clause
#include "pictures.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace host::pictures {
namespace {

using nlohmann::json;

const char* word(Style style) {
  static constexpr std::array words{"exact",  "exact_dashed", "line",  "points",    "both",
                                    "dashed", "area",         "wrong", "wrong_line"};
  return words[static_cast<std::size_t>(style)];
}

const char* word(Map::Palette palette) {
  static constexpr std::array words{"viridis", "cividis", "magma", "diverging"};
  return words[static_cast<std::size_t>(palette)];
}

json axis_json(const Axis& axis) { // what is not given becomes null
  return {{"label", axis.label}, {"unit", axis.unit}, {"logarithmic", axis.logarithmic},
          {"min", axis.min},     {"max", axis.max},   {"tic_step", axis.tic_step}};
}

void check_size(const std::string& what, std::size_t found, std::size_t expected) {
  if (found != expected)
    throw std::invalid_argument(what + " has " + std::to_string(found) + " values, " +
                                std::to_string(expected) + " are needed");
}

bool write(const std::filesystem::path& file, const std::string& content) {
  std::ofstream stream(file, std::ios::binary);
  stream << content;
  stream.close();
  return static_cast<bool>(stream);
}

std::string quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string last_line_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line, last = "no message";
  while (std::getline(stream, line))
    if (!line.empty()) last = line;
  return last;
}

} // namespace

void Pictures::add(const std::string& name, const Chart& chart) {
  json curves = json::array(), guides = json::array();
  for (const Curve& curve : chart.curves) {
    check_size("chart '" + name + "': y of curve '" + curve.label + "'", curve.y.size(), curve.x.size());
    curves.push_back({{"label", curve.label},
                      {"x", curve.x},
                      {"y", curve.y},
                      {"style", word(curve.style)},
                      {"fit_order", curve.fit_order}});
  }
  for (const Guide& guide : chart.guides)
    guides.push_back({{"label", guide.label}, {"value", guide.value}, {"vertical", guide.vertical}});
  all_.push_back({{"kind", "chart"},
                  {"name", name},
                  {"title", chart.title},
                  {"subtitle", chart.subtitle},
                  {"x", axis_json(chart.x)},
                  {"y", axis_json(chart.y)},
                  {"curves", curves},
                  {"guides", guides},
                  {"slope_triangle", chart.slope_triangle},
                  {"equal_axes", chart.equal_axes}});
}

void Pictures::add(const std::string& name, const Maps& maps) {
  json fields = json::array();
  for (const Map& map : maps.maps) {
    check_size("picture '" + name + "': map '" + map.title + "'", map.values.size(),
               static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
    fields.push_back({{"title", map.title},
                      {"unit", map.unit},
                      {"columns", map.columns},
                      {"rows", map.rows},
                      {"values", map.values},
                      {"at_nodes", map.at_nodes},
                      {"blank_zero", map.blank_zero},
                      {"clip", map.clip},
                      {"palette", word(map.palette)}});
  }
  all_.push_back({{"kind", "maps"},
                  {"name", name},
                  {"title", maps.title},
                  {"subtitle", maps.subtitle},
                  {"x_label", maps.x_label},
                  {"y_label", maps.y_label},
                  {"unit", maps.unit},
                  {"x_min", maps.x_min},
                  {"x_max", maps.x_max},
                  {"y_min", maps.y_min},
                  {"y_max", maps.y_max},
                  {"maps", fields}});
}

void Pictures::add(const std::string& name, const Surface& surface) {
  const auto samples = static_cast<std::size_t>(surface.columns) * static_cast<std::size_t>(surface.rows) *
                       std::max<std::size_t>(1, surface.wrong.size());
  check_size("surface picture: `enriched`", surface.enriched.size(),
             samples * static_cast<std::size_t>(surface.dimension));
  if (surface.dimension == 3) check_size("surface picture: `height`", surface.height.size(), samples);
  json places = json::array(), wrong = json::array();
  for (const Place& place : surface.places)
    places.push_back(
        {{"x", place.x}, {"y", place.y}, {"z", place.z}, {"label", place.label}, {"wrong", place.wrong}});
  for (const char offence : surface.wrong) wrong.push_back(offence != 0);
  all_.push_back({{"kind", "surface"},
                  {"name", name},
                  {"title", surface.title},
                  {"subtitle", surface.subtitle},
                  {"unit", surface.unit},
                  {"dimension", surface.dimension},
                  {"columns", surface.columns},
                  {"rows", surface.rows},
                  {"enriched", surface.enriched},
                  {"base", surface.base},
                  {"height", surface.height},
                  {"wrong", wrong},
                  {"places", places}});
}

std::string Pictures::draw(const std::filesystem::path& folder) const {
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  if (!write(folder / "pictures.json", all_.dump(-1, ' ', false, json::error_handler_t::replace) + "\n") ||
      !write(folder / "pictures.py", pictures_script))
    return "no pictures: " + (folder / "pictures.json").string() + " cannot be written";
  return run_script(folder, "pictures.py");
}

std::string run_script(const std::filesystem::path& folder, const std::string& script,
                       const std::string& option) {
  const char* own = std::getenv("ENTS_PYTHON");
  const std::filesystem::path log = folder / "pictures.log";
  for (const std::string python : {own == nullptr ? "" : own, "python3", "/usr/bin/python3"}) {
    if (python.empty()) continue;
    constexpr int without_matplotlib = 3, without_python = 127; // ends of the script, and of the shell
    const int status = std::system((quoted(python) + " -B " + quoted((folder / script).string()) + " " +
                                    option + " > " + quoted(log.string()) + " 2>&1")
                                       .c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (code == without_matplotlib || code == without_python) continue;
    const std::string why = code == 0 ? "" : last_line_of(log);
    std::error_code ignored;
    std::filesystem::remove(log, ignored);
    return code == 0 ? "" : "pictures: " + (folder / script).string() + ": " + why;
  }
  std::error_code ignored;
  std::filesystem::remove(log, ignored);
  return "no pictures: matplotlib is missing (Debian package python3-matplotlib); with it, python3 " +
         (folder / script).string() + " draws them";
}

Chart residual_history(std::string title, const std::vector<std::vector<double>>& steps,
                       const std::vector<std::string>& labels) {
  Chart chart;
  chart.title = std::move(title);
  chart.subtitle = "near the solution an iteration should square the residual (quadratic convergence)";
  chart.x.label = "Newton iteration";
  chart.y.label = "relative residual norm";
  chart.y.logarithmic = true;
  std::size_t longest = 0;
  for (const auto& step : steps) longest = std::max(longest, step.size());
  chart.x.min = -0.2, chart.x.tic_step = longest <= 16 ? 1 : 0;
  const std::size_t every = steps.size() <= 8 ? 1 : (steps.size() + 4) / 5; // a legend of about five lines
  for (std::size_t s = 0; s < steps.size(); ++s) {
    Curve curve;
    for (std::size_t i = 0; i < steps[s].size(); ++i)
      curve.x.push_back(static_cast<double>(i)), curve.y.push_back(steps[s][i] > 0 ? steps[s][i] : automatic);
    const bool named = s % every == 0 || s + 1 == steps.size();
    if (named) curve.label = s < labels.size() ? labels[s] : "step " + std::to_string(s + 1);
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

} // namespace host::pictures
