// SPDX-License-Identifier: BSD-3-Clause
// Maps: scalars over the same rectangle, side by side, each with its colour bar.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gnuplot.hpp"
#include "table.hpp"

namespace host::pictures {
namespace {

using gnuplot::number;

struct Range {
  double min = 0, max = 1;        ///< of the colours
  double lowest = 0, highest = 1; ///< of all values
};

/// @param map its blank values are not counted
Range range_of(const Map& map) {
  std::vector<double> values;
  for (const double value : map.values)
    if (std::isfinite(value) && !(map.blank_zero && value == 0)) values.push_back(value);
  Range out;
  if (values.empty()) return out;
  std::sort(values.begin(), values.end());
  const double cut = std::clamp(1 - map.clip, 0.0, 1.0) * static_cast<double>(values.size());
  // values left out at both ends, or above only
  const auto above =
      std::min(values.size() - 1, static_cast<std::size_t>(std::lround(map.blank_zero ? cut : 0.5 * cut)));
  const auto below = map.blank_zero ? 0 : std::min(above, values.size() - 1 - above);
  out.lowest = values.front(), out.highest = values.back();
  out.min = map.blank_zero ? std::min(0.0, values.front()) : values[below];
  out.max = values[values.size() - 1 - above];
  if (map.palette == Map::Palette::diverging) {
    out.max = std::max(std::abs(out.min), std::abs(out.max));
    out.min = -out.max;
  }
  if (!(out.max > out.min)) out.max = out.min + (out.min != 0 ? std::abs(out.min) : 1); // a constant map
  return out;
}

constexpr double bar_width = 23; ///< colour bar with its distance from the map

/// All lengths in pixels from the lower left corner of the picture.
struct Frame {
  double left = 0, bottom = 0, width = 0, height = 0;
};

struct Page {
  double width = 0, height = 0;
  std::string x(double pixels) const { return "screen " + number(pixels / width); }
  std::string y(double pixels) const { return "screen " + number(pixels / height); }
  std::string size(double w, double h) const { return number(w / width) + "," + number(h / height); }
};

/// The pixels of a map along one axis.
struct Span {
  double min, max, step;
};

Span pixels_along(double min, double max, int count, bool at_nodes) {
  if (!at_nodes || count < 2) return {min, max, (max - min) / count};
  const double step = (max - min) / (count - 1);
  return {min - 0.5 * step, max + 0.5 * step, step};
}

std::string panel(const Maps& maps, std::size_t index, const Frame& frame, const Page& page) {
  const Map& map = maps.maps[index];
  const Range range = range_of(map);
  const int power = gnuplot::common_power(std::max(std::abs(range.min), std::abs(range.max)));
  const double unit = std::pow(10.0, -power);
  const int length_power = gnuplot::common_power(
      std::max({std::abs(maps.x_min), std::abs(maps.x_max), std::abs(maps.y_min), std::abs(maps.y_max)}));
  const double length = std::pow(10.0, -length_power);
  // A pixel is centred on its sample: samples on the border have half of their pixels outside.
  const Span x = pixels_along(maps.x_min * length, maps.x_max * length, map.columns, map.at_nodes);
  const Span y = pixels_along(maps.y_min * length, maps.y_max * length, map.rows, map.at_nodes);

  std::string out =
      "set lmargin at " + page.x(frame.left) + "\nset rmargin at " + page.x(frame.left + frame.width) + "\n";
  out += "set bmargin at " + page.y(frame.bottom) + "\nset tmargin at " +
         page.y(frame.bottom + frame.height) + "\n";
  out += "set xrange [" + number(x.min) + ":" + number(x.max) + "]\n";
  out += "set yrange [" + number(y.min) + ":" + number(y.max) + "]\n";
  out += "set cbrange [" + number(range.min * unit) + ":" + number(range.max * unit) + "]\n" +
         gnuplot::palette(map.palette);
  out += "set xlabel " + gnuplot::text(gnuplot::axis_label(maps.x_label, maps.unit, length_power)) + "\n";
  if (index == 0)
    out += "set ylabel " + gnuplot::text(gnuplot::axis_label(maps.y_label, maps.unit, length_power)) +
           " offset 0.8,0\n";
  else
    out += "unset ylabel\nset format y ''\n";
  out += "set colorbox user origin " + page.x(frame.left + frame.width + 10) + "," + page.y(frame.bottom) +
         " size screen " + page.size(13, frame.height) + " noborder\n";
  out += "unset label\nset label " + gnuplot::text(gnuplot::axis_label(map.title, map.unit, power)) +
         " at graph 0,1 left offset 0,0.8 font ',12.5'\n";
  if (range.highest > range.max || range.lowest < range.min) {
    const auto shown = [&](double value) { return format_number(value * unit, 3); };
    const std::string ends = map.blank_zero
                                 ? "peak " + shown(range.highest)
                                 : "values from " + shown(range.lowest) + " to " + shown(range.highest);
    // Two short lines: one would run into the note of the next map.
    const auto line = [&](const std::string& words, double height) {
      out += "set label " + gnuplot::text(words) + " at " + page.x(frame.left + frame.width + bar_width) +
             ", " + page.y(height) + " right font ',10.5' textcolor rgb '" + gnuplot::faint + "'\n";
    };
    line(format_number(100 * map.clip, 3) + " % lie within the colours;", 28);
    line(ends, 12);
  }
  const std::string column =
      map.blank_zero ? "($3 == 0 ? NaN : $3*" + number(unit) + ")" : "($3*" + number(unit) + ")";
  const auto centre = [](const char* index_column, const Span& span) {
    return std::string("(").append(number(span.min + 0.5 * span.step)) + "+" + index_column + "*" +
           number(span.step) + ")";
  };
  out += "plot data index " + std::to_string(index) + " matrix using " + centre("$1", x) + ":" +
         centre("$2", y) + ":" + column + " with image notitle\n";
  return out;
}

} // namespace

Outcome draw(const Maps& maps, const std::filesystem::path& directory, const std::string& name) {
  gnuplot::Job job;
  job.data = "# " + maps.title + "; " + gnuplot::axis_label(maps.x_label, maps.unit) + " from " +
             number(maps.x_min) + " to " + number(maps.x_max) + ", " +
             gnuplot::axis_label(maps.y_label, maps.unit) + " from " + number(maps.y_min) + " to " +
             number(maps.y_max) + "; rows from below\n";
  for (const Map& map : maps.maps) {
    if (map.columns < 1 || map.rows < 1 ||
        map.values.size() != static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows))
      throw std::invalid_argument("picture '" + name + "': map '" + map.title + "' has " +
                                  std::to_string(map.values.size()) + " values for " +
                                  std::to_string(map.rows) + " rows of " + std::to_string(map.columns));
    job.data +=
        (&map == &maps.maps.front() ? "# " : "\n\n# ") + gnuplot::axis_label(map.title, map.unit) + "\n";
    for (std::size_t i = 0; i < map.values.size(); ++i)
      job.data += number(map.values[i]) + ((i + 1) % static_cast<std::size_t>(map.columns) == 0 ? "\n" : " ");
  }
  if (maps.maps.empty()) return {{}, "picture " + name + ": nothing to draw"};

  const auto count = static_cast<double>(maps.maps.size());
  constexpr double left = 66, bar = 88, gap = 12, top = 96, bottom = 98;
  const double aspect = (maps.y_max - maps.y_min) / (maps.x_max - maps.x_min);
  double side = (960 - left - count * bar - (count - 1) * gap) / count; // width of one map
  side = std::min({side, 560.0, 560.0 / aspect});
  const Page page{left + count * (side + bar) + (count - 1) * gap, top + bottom + side * aspect};
  job.width = static_cast<int>(page.width), job.height = static_cast<int>(page.height);
  job.script = "reset\nset multiplot\nset minussign\nset tics out nomirror scale 0.6\nset border linewidth "
               "0.8 linecolor rgb '" +
               std::string(gnuplot::ink) + "'\n";
  job.script += "set cbtics scale 0.5\n";
  for (std::size_t i = 0; i < maps.maps.size(); ++i) {
    const Frame frame{left + static_cast<double>(i) * (side + bar + gap), bottom, side, side * aspect};
    std::string drawn = panel(maps, i, frame, page);
    if (i == 0) { // over the whole page, so behind "unset label" of the panel
      const std::string at = " at " + page.x(left) + ",";
      std::string head =
          "set label " + gnuplot::bold(maps.title) + at + page.y(page.height - 26) + " left font ',15'\n";
      head += "set label " + gnuplot::text(maps.subtitle) + at + page.y(page.height - 49) +
              " left font ',11.5' textcolor rgb '" + gnuplot::faint + "'\n";
      drawn.insert(drawn.find("unset label\n") + 12, head);
    }
    job.script += drawn;
  }
  job.script += "unset multiplot\n";
  return gnuplot::render(job, directory, name);
}

} // namespace host::pictures
