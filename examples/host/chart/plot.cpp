// SPDX-License-Identifier: BSD-3-Clause
#include "chart/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <tuple>

#include "chart/chart_page.hpp"
#include "chart/pareto.hpp"
#include "output/table.hpp"

namespace host::chart {
namespace {

constexpr double left = 58, right = 14, top = 30, bottom = 46;
constexpr double inner_width = panel_width - left - right, inner_height = panel_height - top - bottom;

std::string px(double value) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

/// Logarithmic scale over what is drawn and a little more.
struct Scale {
  double low = 1, high = 10; ///< powers of ten
  Scale(double smallest, double largest) {
    low = std::log10(smallest) - 0.12, high = std::log10(largest) + 0.12;
    if (high - low < 1.1) { // a decade at least, so that two tics are there
      const double middle = 0.5 * (low + high);
      low = middle - 0.55, high = middle + 0.55;
    }
  }
  double operator()(double value) const { return (std::log10(value) - low) / (high - low); }
};

/// digit * 10^decade
std::string tic_text(int decade, int digit, bool percent) {
  if (percent) decade += 2;
  std::array<char, 24> number{};
  if (decade >= -4 && decade <= 4)
    std::snprintf(number.data(), number.size(), "%.*f", std::max(0, -decade), digit * std::pow(10., decade));
  else
    std::snprintf(number.data(), number.size(), "%.0e", digit * std::pow(10., decade));
  std::string text = number.data();
  if (percent) text += " %";
  return text;
}

std::string line(double x1, double y1, double x2, double y2, const char* style) {
  return "<path d=\"M" + px(x1) + " " + px(y1) + "L" + px(x2) + " " + px(y2) + "\" " + style + "/>";
}

std::string text(double x, double y, const char* anchor, const std::string& words,
                 const std::string& more = {}) {
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" style=\"text-anchor:" + anchor + "\"" + more + ">" +
         escaped(words) + "</text>";
}

/// Text under the place `x` of the axis, moved to the left where it would leave the panel.
std::string number_below(double x, double y, const std::string& words) {
  const double half = 3.8 * static_cast<double>(words.size()); // of its width
  return text(std::min(x, panel_width - half), y, "middle", words);
}

std::string grid(const Scale& x, const Scale& y) {
  std::string out;
  const auto decades = [](const Scale& scale, const auto& draw) {
    for (int d = static_cast<int>(std::floor(scale.low)); d <= static_cast<int>(std::ceil(scale.high)); ++d)
      for (int k = 1; k < 10; ++k)
        if (const double at = d + std::log10(k); at >= scale.low && at <= scale.high)
          draw(d, k, (at - scale.low) / (scale.high - scale.low));
  };
  const double base = top + inner_height;
  // Less than two decades: 2 and 5 have numbers, too.
  const auto numbered = [](const Scale& scale, int k) {
    return k == 1 || ((k == 2 || k == 5) && scale.high - scale.low < 2);
  };
  decades(x, [&](int d, int k, double at) {
    const double place = left + at * inner_width;
    out += k == 1 ? line(place, top, place, base, "class=\"g\"")
                  : line(place, base, place, base - 4, "class=\"t\"");
    if (numbered(x, k)) out += number_below(place, base + 17, tic_text(d, k, false));
  });
  decades(y, [&](int d, int k, double at) {
    const double place = base - at * inner_height;
    out += k == 1 ? line(left, place, left + inner_width, place, d == -2 ? "class=\"one\"" : "class=\"g\"")
                  : line(left, place, left + 4, place, "class=\"t\"");
    if (numbered(y, k)) out += text(left - 6, place + 4.5, "end", tic_text(d, k, true));
  });
  return out + "<path d=\"M" + px(left) + " " + px(top) + "V" + px(base) + "H" + px(left + inner_width) +
         "\" class=\"x\"/>";
}

constexpr const char* picture_style =
    "text{font:13px Helvetica,Arial,sans-serif;fill:#222}.h{font-weight:bold}.g{stroke:#e4e4e4;fill:none}"
    ".t{stroke:#999;fill:none}.x{stroke:#444;fill:none}.one{stroke:#888;stroke-dasharray:5 4;fill:none}"
    ".f{stroke:#c9c9c9;stroke-width:7;fill:none;stroke-linejoin:round;stroke-linecap:round}.l{fill:none;"
    "stroke-width:1.4;opacity:.55}";

} // namespace

double price_of(const WorkRun& run, Price price) {
  switch (price) {
  case Price::time:
    return run.seconds();
  case Price::contact_time:
    return run.contact_seconds();
  case Price::segments:
    return static_cast<double>(run.segments);
  case Price::dofs:
    return static_cast<double>(run.dofs());
  }
  return 0;
}

const char* label_of(Price price) {
  switch (price) {
  case Price::time:
    return "CPU time of the whole solve [s]";
  case Price::contact_time:
    return "CPU time of the contact part [s]";
  case Price::segments:
    return "contact segments of the master";
  case Price::dofs:
    return "dofs of block and master";
  }
  return "";
}

const char* color_of(Family family) {
  switch (family) { // Okabe and Ito 2008: told apart with any colour vision
  case Family::enriched:
    return "#0072b2";
  case Family::layer:
    return "#332288";
  case Family::sampled:
    return "#56b4e9";
  case Family::facets:
    return "#d55e00";
  case Family::facets_sampled:
    return "#882255";
  case Family::facets_cut:
    return "#a8760a";
  case Family::smoothed:
    return "#009e73";
  case Family::on_facets:
    return "#e69f00";
  case Family::on_smoothed:
    return "#cc79a7";
  }
  return "#000";
}

std::string marker(Family family, double x, double y, const std::string& title, bool hollow) {
  std::string shape;
  const std::string fill = std::string(" fill=\"") + (hollow ? "#fff" : color_of(family)) + "\" stroke=\"" +
                           (hollow ? color_of(family) : "#fff") + "\" stroke-width=\"" +
                           (hollow ? "1.6" : "1") + "\"";
  const auto polygon = [&](std::initializer_list<std::pair<double, double>> corners) {
    std::string points;
    for (const auto& [dx, dy] : corners) points += px(x + dx) + "," + px(y + dy) + " ";
    return "<polygon points=\"" + points + "\"" + fill + ">";
  };
  switch (family) {
  case Family::enriched:
    shape = "<circle cx=\"" + px(x) + "\" cy=\"" + px(y) + "\" r=\"5.5\"" + fill + ">";
    break;
  case Family::layer:
    shape = polygon({{0, -5.5}, {5.2, -1.7}, {3.2, 4.4}, {-3.2, 4.4}, {-5.2, -1.7}});
    break;
  case Family::sampled:
    shape = polygon({{0, -6}, {6, 0}, {0, 6}, {-6, 0}});
    break;
  case Family::facets:
    shape = polygon({{-4.2, -4.2}, {4.2, -4.2}, {4.2, 4.2}, {-4.2, 4.2}});
    break;
  case Family::facets_sampled:
    shape = polygon({{-2, -5.5},
                     {2, -5.5},
                     {2, -2},
                     {5.5, -2},
                     {5.5, 2},
                     {2, 2},
                     {2, 5.5},
                     {-2, 5.5},
                     {-2, 2},
                     {-5.5, 2},
                     {-5.5, -2},
                     {-2, -2}});
    break;
  case Family::facets_cut:
    shape = polygon({{-5.5, -5.5}, {5.5, 5.5}, {5.5, -5.5}, {-5.5, 5.5}});
    break;
  case Family::smoothed:
    shape = polygon({{0, -5.5}, {5.2, 4}, {-5.2, 4}});
    break;
  case Family::on_facets:
    shape = polygon({{0, 5.5}, {5.2, -4}, {-5.2, -4}});
    break;
  case Family::on_smoothed:
    shape = polygon({{0, -5.6}, {5.3, -1.7}, {3.3, 4.5}, {-3.3, 4.5}, {-5.3, -1.7}});
    break;
  }
  const std::string name = shape.substr(1, shape.find(' ') - 1);
  return shape + (title.empty() ? "" : "<title>" + escaped(title) + "</title>") + "</" + name + ">";
}

std::string work_panel(const Work& work, Price price, const std::string& heading) {
  double x_low = INFINITY, x_high = 0, y_low = INFINITY, y_high = 0;
  for (const WorkRun& run : work.runs) {
    if (!charted(run)) continue;
    const double x = price_of(run, price);
    x_low = std::min(x_low, x), x_high = std::max(x_high, x);
    y_low = std::min(y_low, run.error), y_high = std::max(y_high, run.error);
  }
  std::string svg = text(left, 17, "start", heading, " class=\"h\"") +
                    text(left + inner_width / 2, panel_height - 8, "middle", label_of(price)) +
                    text(13, top + inner_height / 2, "middle", "error",
                         " transform=\"rotate(-90 13 " + px(top + inner_height / 2) + ")\"");
  if (!(x_high > 0)) return svg;
  const Scale x(x_low, x_high), y(y_low, y_high);
  const auto at_x = [&](const WorkRun& run) { return left + x(price_of(run, price)) * inner_width; };
  const auto at_y = [&](const WorkRun& run) { return top + (1 - y(run.error)) * inner_height; };
  svg += grid(x, y);
  const auto polyline = [&](const std::vector<const WorkRun*>& runs, bool stairs, const std::string& style) {
    std::string path;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (stairs && i > 0) path.append("H").append(px(at_x(*runs[i])));
      path.append(i == 0 ? "M" : "L").append(px(at_x(*runs[i]))).append(" ").append(px(at_y(*runs[i])));
    }
    return runs.size() < 2 ? std::string() : "<path d=\"" + path + "\" " + style + "/>";
  };
  if (work.problem.asked > 0) // shares of an error do not compete
    svg += polyline(pareto_front(work.runs, [price](const WorkRun& run) { return price_of(run, price); }),
                    true, "class=\"f\"");
  // A curve: one slave mesh and finer and finer masters; with one enriched segment, finer and finer slave
  // meshes.
  std::map<std::tuple<Family, std::size_t, bool>, std::vector<const WorkRun*>> curves;
  for (const WorkRun& run : work.runs) {
    if (!charted(run)) continue;
    const bool one = run.way.family == Family::enriched || run.way.family == Family::sampled ||
                     run.way.family == Family::layer;
    curves[{run.way.family, one ? static_cast<std::size_t>(run.way.divisions) : run.way.level,
            run.way.counted}]
        .push_back(&run);
  }
  for (const auto& [key, runs] : curves)
    svg += polyline(runs, false,
                    std::string("class=\"l\" stroke=\"") + color_of(std::get<0>(key)) + "\"" +
                        (std::get<2>(key) ? " stroke-dasharray=\"3 3\"" : ""));
  std::vector<Family> order(std::rbegin(families), std::rend(families)); // the first of them on top
  for (const Family family : order)
    for (const WorkRun& run : work.runs)
      if (charted(run) && run.way.family == family)
        svg +=
            marker(family, at_x(run), at_y(run),
                   name_of(work.problem, run) + ": error " + format_number(100 * run.error, 2) + " %, " +
                       format_number(run.seconds(), 2) + " s, contact " +
                       format_number(1e3 * run.contact_seconds(), 2) + " ms, " + std::to_string(run.dofs()) +
                       " dofs, " + std::to_string(run.iterations) + " iterations",
                   run.way.counted);
  return svg;
}

std::string work_svg(const Work& work, Price price) {
  constexpr int heading = 16; // the page says it above
  return "<svg class=\"w\" viewBox=\"0 " + std::to_string(heading) + " " + std::to_string(panel_width) + " " +
         std::to_string(panel_height - heading) + "\" role=\"img\" aria-label=\"" +
         escaped(work.problem.title + ": error over " + label_of(price)) + "\">" +
         work_panel(work, price, "") + "</svg>";
}

std::string work_picture(const std::vector<const Work*>& works, const std::vector<Price>& columns) {
  const int width = panel_width * static_cast<int>(columns.size());
  constexpr int line_height = 20;
  int legend = 34;
  std::string key;
  double x = left;
  const auto place_for = [&](std::size_t letters) { // of the next entry of the legend
    const double needed = 48 + 6.6 * static_cast<double>(letters);
    if (x + needed > width && x > left) x = left, legend += line_height;
    const double at = x;
    x += needed;
    return at;
  };
  for (const Family family : families) {
    const std::string name = family_name(works, family);
    if (name.empty()) continue;
    const double at = place_for(name.size());
    key += marker(family, at + 6, legend - 16, "") + text(at + 17, legend - 11.5, "start", name);
  }
  const auto counted = [](const Work* work) {
    return std::any_of(work->runs.begin(), work->runs.end(),
                       [](const WorkRun& run) { return run.way.counted; });
  };
  if (std::any_of(works.begin(), works.end(), counted)) {
    const std::string name = "hollow: area counted";
    key += text(place_for(name.size() - 2), legend - 11.5, "start", name);
  }
  const std::string front = "Pareto front";
  const double at = place_for(front.size() + 4);
  key += line(at, legend - 16, at + 26, legend - 16, "class=\"f\"") +
         text(at + 36, legend - 11.5, "start", front);
  const int height = panel_height * static_cast<int>(works.size()) + legend;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + std::to_string(width) +
                    "\" height=\"" + std::to_string(height) + "\" viewBox=\"0 0 " + std::to_string(width) +
                    " " + std::to_string(height) + "\"><style>" + picture_style +
                    "</style><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>" + key;
  for (std::size_t j = 0; j < works.size(); ++j)
    for (std::size_t i = 0; i < columns.size(); ++i)
      svg += "<g transform=\"translate(" + std::to_string(panel_width * static_cast<int>(i)) + " " +
             std::to_string(legend + panel_height * static_cast<int>(j)) + ")\">" +
             work_panel(*works[j], columns[i], i == 0 ? works[j]->problem.title : "") + "</g>";
  return svg + "</svg>\n";
}

} // namespace host::chart
