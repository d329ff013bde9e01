// SPDX-License-Identifier: BSD-3-Clause
// The enriched surface with the segments and places a check found: a section in 2D, a shaded surface in 3D.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "gnuplot.hpp"

namespace host::pictures {
namespace {

using gnuplot::number;

struct Box {
  std::array<double, 3> min{HUGE_VAL, HUGE_VAL, HUGE_VAL}, max{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  double span(std::size_t axis) const { return max[axis] - min[axis]; }
};

Box box_of(const Surface& surface) {
  Box box;
  const auto d = static_cast<std::size_t>(surface.dimension);
  for (const auto* points : {&surface.enriched, &surface.base})
    for (std::size_t i = 0; i < points->size(); ++i) {
      box.min[i % d] = std::min(box.min[i % d], (*points)[i]);
      box.max[i % d] = std::max(box.max[i % d], (*points)[i]);
    }
  return box;
}

bool is_wrong(const Surface& surface, std::size_t segment) {
  return segment < surface.wrong.size() && surface.wrong[segment] != 0;
}

/// 2D: lines with markers on them.
Outcome draw_section(const Surface& surface, const std::filesystem::path& directory,
                     const std::string& name) {
  // segments end to end, with a gap in the line: they need not meet
  const auto columns = static_cast<std::size_t>(surface.columns);
  const auto line = [&](const char* label, const std::vector<double>& points, Style style, int which) {
    Curve out;
    out.label = label, out.style = style;
    for (std::size_t s = 0; 2 * s * columns < points.size(); ++s) {
      if (which >= 0 && is_wrong(surface, s) != (which != 0)) continue;
      for (std::size_t i = s * columns; i < (s + 1) * columns; ++i)
        out.x.push_back(points[2 * i]), out.y.push_back(points[2 * i + 1]);
      out.x.push_back(automatic), out.y.push_back(automatic);
    }
    return out;
  };
  Chart chart;
  chart.title = surface.title, chart.subtitle = surface.subtitle;
  chart.x.label = 'x', chart.y.label = 'y', chart.x.unit = chart.y.unit = surface.unit;
  const Box box = box_of(surface);
  chart.equal_axes = box.span(1) > 0.2 * box.span(0) && box.span(0) > 0.2 * box.span(1);
  if (!chart.equal_axes)
    chart.subtitle += (chart.subtitle.empty() ? "" : "; ") + std::string("axes not to the same scale");
  if (!surface.base.empty()) chart.curves.push_back(line("segment ρ", surface.base, Style::dashed, -1));
  for (const auto& [label, style, which] : {std::tuple{"enriched surface ρₑ = ρ + h n", Style::exact, 0},
                                            {"segments that fail", Style::wrong_line, 1}})
    if (Curve curve = line(label, surface.enriched, style, which); !curve.x.empty())
      chart.curves.push_back(curve);
  for (const Place& place : surface.places) {
    Curve mark;
    mark.label = place.label, mark.style = place.wrong ? Style::wrong : Style::points;
    mark.x = {place.x}, mark.y = {place.y};
    chart.curves.push_back(mark);
  }
  return draw(chart, directory, name);
}

/// 0, step, 2 step ... and the last one: at most about `most`, so that the SVG stays small.
std::vector<std::size_t> thinned(int count, int most) {
  const int step = std::max(1, (count + most - 2) / most);
  std::vector<std::size_t> out;
  for (int i = 0; i < count - 1; i += step) out.push_back(static_cast<std::size_t>(i));
  out.push_back(static_cast<std::size_t>(count - 1));
  return out;
}

/// Numbered arrows at the places and a list of them at the foot of the picture.
std::string marks(const Surface& surface, double z_scale, double lift, double pixels) {
  std::string out;
  const std::size_t count = surface.places.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Place& place = surface.places[i];
    const std::string color =
        std::string(" textcolor rgb '") + (place.wrong ? gnuplot::wrong : gnuplot::ink) + "'\n";
    const std::string line_color =
        std::string(" linecolor rgb '") + (place.wrong ? gnuplot::wrong : gnuplot::ink) + "'\n";
    const std::string plan = "first " + number(place.x) + "," + number(place.y) + ",";
    const std::string at = plan + number(place.z * z_scale), above = plan + number(place.z * z_scale + lift);
    const std::string sign = std::to_string(i + 1);
    out += "set arrow from " + above + " to " + at + " front filled size screen 0.014,16 linewidth 1.6" +
           line_color;
    out +=
        "set label " + gnuplot::bold(sign) + " at " + above + " center offset 0,0.6 front font ',14'" + color;
    const double foot = (18 + 24 * static_cast<double>(count - 1 - i)) / pixels;
    out += "set label " + gnuplot::text(sign + "   " + place.label) + " at screen 0.05, screen " +
           number(foot) + " left font ',12.5'" + color;
  }
  return out;
}

Outcome draw_shaded(const Surface& surface, const std::filesystem::path& directory, const std::string& name) {
  const Box box = box_of(surface);
  const double plan = std::max(box.span(0), box.span(1)), relief = box.span(2);
  double z_scale = 1; // the heights of a rough surface cannot be seen in true scale
  for (const double factor : {2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0})
    if (relief * factor <= 0.25 * plan) z_scale = factor;
  double highest = 0;
  for (const double height : surface.height) highest = std::max(highest, std::abs(height));
  const int height_power = gnuplot::common_power(highest), power = gnuplot::common_power(plan);
  const double length = std::pow(10.0, -power);

  gnuplot::Job job;
  const double list = 24.0 * static_cast<double>(surface.places.size());
  // gnuplot centres the base plane: a high surface hangs out below by about this many pixels
  const double drop = 250 * std::clamp(relief * z_scale / plan - 0.15, 0.0, 1.0);
  job.height = 600 + static_cast<int>(list + drop);
  job.data = "# x y z h of the enriched surface, one block per segment\n";
  const auto rows = static_cast<std::size_t>(surface.rows),
             columns = static_cast<std::size_t>(surface.columns);
  const std::size_t segments = surface.height.size() / (rows * columns);
  const int most = std::max(3, static_cast<int>(72 / std::sqrt(static_cast<double>(segments))));
  const std::vector<std::size_t> j_drawn = thinned(surface.rows, most),
                                 i_drawn = thinned(surface.columns, most);
  const auto line_of = [&](std::size_t s, std::size_t j, std::size_t i) {
    const std::size_t sample = (s * rows + j) * columns + i;
    std::string out;
    for (std::size_t a = 0; a < 3; ++a) out += number(surface.enriched[3 * sample + a]) + " ";
    return out + number(surface.height[sample]) + "\n";
  };
  // those that fail come last and in the colour of offences; the heights are worth more where all do
  const auto fails = [&](std::size_t s) { return is_wrong(surface, s); };
  std::vector<std::size_t> order(segments);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto right = static_cast<std::size_t>(
      std::stable_partition(order.begin(), order.end(), std::not_fn(fails)) - order.begin());
  const std::size_t plain = right == 0 ? segments : right;
  for (const std::size_t s : order) {
    for (const std::size_t j : j_drawn) {
      for (const std::size_t i : i_drawn) job.data += line_of(s, j, i);
      job.data += "\n";
    }
    job.data += "\n"; // two empty lines: the next surface
  }

  Surface scaled = surface;
  for (Place& place : scaled.places) place.x *= length, place.y *= length, place.z *= length;
  std::string subtitle = surface.subtitle;
  const auto join = [&](const std::string& more) { subtitle += (subtitle.empty() ? "" : "; ") + more; };
  if (right < segments && segments > 1) join(right == 0 ? "all of them fail" : "those in red fail");
  if (z_scale > 1) join("heights drawn " + std::to_string(static_cast<int>(z_scale)) + " times");
  const double pixels = job.height, foot = (list + drop + 30) / pixels;
  job.script = "reset\nset minussign\nunset key\nset border 15 linewidth 0.8 linecolor rgb '#999999'\n"
               "set tics scale 0.5 textcolor rgb '#444444'\nunset ztics\nset view 50,30\nset view equal "
               "xyz\nset xyplane relative 0.02\n"
               "set lmargin at screen 0.02\nset rmargin at screen 0.86\n";
  job.script +=
      "set bmargin at screen " + number(foot) + "\nset tmargin at screen " + number(1 - 60 / pixels) + "\n";
  job.script += "set colorbox user origin screen 0.885, screen " + number(foot + 0.12) +
                " size screen 0.016, screen " + number(0.5 * 600 / pixels) + " noborder\n";
  job.script += "set label " + gnuplot::text(gnuplot::axis_label("height h", surface.unit, height_power)) +
                " at screen 0.97, screen " + number(foot + 0.15 + 300 / pixels) + " right font ',12.5'\n";
  job.script += "set label " + gnuplot::bold(surface.title) + " at screen 0.04, screen " +
                number(1 - 26 / pixels) + " left font ',15'\n";
  job.script += "set label " + gnuplot::text(subtitle) + " at screen 0.04, screen " +
                number(1 - 49 / pixels) + " left font ',11.5' textcolor rgb '" + gnuplot::faint + "'\n";
  job.script += "set xlabel " + gnuplot::text(gnuplot::axis_label("x", surface.unit, power)) +
                " offset 0,-0.5\nset ylabel " + gnuplot::text(gnuplot::axis_label("y", surface.unit, power)) +
                " offset 0.5,-0.5\n";
  const auto [low, high] = std::minmax_element(surface.height.begin(), surface.height.end());
  if (*low < *high) // else gnuplot would take the range of z
    job.script += "set cbrange [" + number(*low * std::pow(10.0, -height_power)) + ":" +
                  number(*high * std::pow(10.0, -height_power)) + "]\n";
  job.script +=
      gnuplot::palette(Map::Palette::viridis) + "set pm3d depthorder lighting primary 0.4 specular 0.05\n";
  for (const std::size_t axis : {0, 1})
    job.script += std::string("set ").append(1, "xy"[axis]) + "range [" +
                  number((box.min[axis] - 0.01 * plan) * length) + ":" +
                  number((box.max[axis] + 0.01 * plan) * length) + "]\n";
  job.script += marks(scaled, z_scale, 0.22 * plan * length, pixels);
  const std::string l = number(length);
  const std::string place = "($1*" + l + "):($2*" + l + "):($3*" + number(length * z_scale) + ")";
  job.script += "splot data index 0:" + std::to_string(plain - 1) + " using " + place + ":($4*" +
                number(std::pow(10.0, -height_power)) + ") with pm3d";
  if (plain < segments)
    job.script += ", data index " + std::to_string(plain) + ":" + std::to_string(segments - 1) + " using " +
                  place + " with pm3d fillcolor rgb '" + gnuplot::wrong + "'";
  job.script += "\n";
  return gnuplot::render(job, directory, name);
}

void check_size(const char* what, std::size_t found, std::size_t expected) {
  if (found != expected)
    throw std::invalid_argument(std::string("surface picture: `") + what + "` has " + std::to_string(found) +
                                " values, " + std::to_string(expected) + " are needed");
}

} // namespace

Outcome draw(const Surface& surface, const std::filesystem::path& directory, const std::string& name) {
  if (surface.dimension != 2 && surface.dimension != 3)
    throw std::invalid_argument("surface picture: dimension must be 2 or 3");
  const auto samples = static_cast<std::size_t>(surface.columns) * static_cast<std::size_t>(surface.rows) *
                       std::max<std::size_t>(1, surface.wrong.size());
  if (samples == 0) return {{}, "picture " + name + ": nothing to draw"};
  check_size("enriched", surface.enriched.size(), samples * static_cast<std::size_t>(surface.dimension));
  if (surface.dimension == 2) return draw_section(surface, directory, name);
  check_size("height", surface.height.size(), samples);
  return draw_shaded(surface, directory, name);
}

} // namespace host::pictures
