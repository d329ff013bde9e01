// SPDX-License-Identifier: BSD-3-Clause
#include "chart/map_picture.hpp"

#include <set>

#include "chart/chart_page.hpp"
#include "output/gnuplot.hpp"

namespace host::chart {
namespace {

namespace gnuplot = pictures::gnuplot;
using gnuplot::number;

/// Tics at the ends and the middle of an axis; a cell is 1 wide.
std::string tics(const char* axis, const Axis& values, bool labelled) {
  std::string out = std::string("set ") + axis + "tics (";
  const std::size_t last = values.values.size() - 1;
  for (const std::size_t i : std::set{std::size_t{0}, last / 2, last}) { // a short axis has fewer
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g", values.values[i]);
    out += (i > 0 ? ", " : "") + gnuplot::text(labelled ? text.data() : "") + " " +
           number(static_cast<double>(i));
  }
  return out + ")\n";
}

} // namespace

pictures::Outcome draw(const Map& map, const std::filesystem::path& directory) {
  gnuplot::Job job;
  const std::size_t columns = map.x.values.size(), rows = map.y.values.size();
  job.data = "# " + map.title + ": number of the column (" + map.x.label + "), of the row (" + map.y.label +
             "), colour, letter, iterations; a block for each panel\n";
  std::string panels;
  constexpr double left = 62, top = 104, width = 132, height = 132, gap_x = 10, gap_y = 34, bottom = 76;
  const auto count = static_cast<double>(map.surfaces.size());
  job.width = static_cast<int>(left + 6 * (width + gap_x) + 8);
  job.height = static_cast<int>(top + count * (height + gap_y) + bottom);
  int block = 0;
  std::size_t row = 0;
  for (const SurfaceKind surface : map.surfaces) {
    std::size_t column = 0;
    for (const Panel& panel : map.panels) {
      if (panel.method.surface != surface || !panel.careful) continue;
      job.data += std::string(block > 0 ? "\n\n" : "") + "# " + word(surface) + ", " +
                  word(panel.method.projection) + ", " + word(panel.method.tangent) + "\n";
      for (std::size_t k = 0; k < panel.cells.size(); ++k) {
        const Look look = look_of(panel.cells[k]);
        job.data += std::to_string(k % columns) + " " + std::to_string(k / columns) + " " +
                    std::to_string(look.rgb) + " " + (look.letter != 0 ? std::string(1, look.letter) : "-") +
                    " " + std::to_string(panel.cells[k].outcome.iterations) + "\n";
      }
      const double x = left + static_cast<double>(column) * (width + gap_x),
                   y = top + static_cast<double>(row) * (height + gap_y);
      const auto at_x = [&](double pixels) { return number(pixels / job.width); };
      const auto at_y = [&](double pixels) { return number(1 - pixels / job.height); };
      panels += "set lmargin at screen " + at_x(x) + "\nset rmargin at screen " + at_x(x + width) +
                "\nset tmargin at screen " + at_y(y) + "\nset bmargin at screen " + at_y(y + height) +
                "\nunset label\n";
      if (block == 0)
        panels += "set label " + gnuplot::bold(map.title) + " at screen " + at_x(10) + "," + at_y(20) +
                  " left font ',15'\nset label " +
                  gnuplot::text("blue: solved (the darker, the more iterations); yellow: flagged, the letter "
                                "says by what; grey: diverged; red W: silently wrong") +
                  " at screen " + at_x(10) + "," + at_y(42) + " left font ',10.5' textcolor rgb '" +
                  gnuplot::faint + "'\n";
      panels +=
          "set label " +
          gnuplot::text(std::string(word(panel.method.projection)) + ", " + word(panel.method.tangent)) +
          " at graph 0,1 left offset 0,0.55 font ',9'\n";
      if (column == 0)
        panels +=
            "set label " + gnuplot::bold(word(surface)) + " at graph 0,1 left offset 0,1.5 font ',10.5'\n";
      const bool lowest = row + 1 == map.surfaces.size();
      panels += "set ylabel " + gnuplot::text(column == 0 ? map.y.label : "") +
                " font ',9' offset 1.5,0\nset xlabel " + gnuplot::text(lowest ? map.x.label : "") +
                " font ',9' offset 0,0.6\n";
      panels += tics("x", map.x, lowest) + tics("y", map.y, column == 0);
      panels += "set xrange [-0.5:" + number(static_cast<double>(columns) - 0.5) +
                "]\nset yrange [-0.5:" + number(static_cast<double>(rows) - 0.5) + "]\n";
      panels += "plot data index " + std::to_string(block) +
                " using 1:2:(0.5):(0.5):3 with boxxyerror fillstyle solid noborder linecolor rgb variable "
                "notitle, data index " +
                std::to_string(block) +
                " using 1:2:(strcol(4) eq '-' ? '' : strcol(4)) with labels font ',6' notitle\n";
      ++block, ++column;
    }
    ++row;
  }
  job.script = "reset\nset multiplot\nset tics out nomirror scale 0.4 font ',8'\nset border linewidth 0.6 "
               "linecolor rgb '" +
               std::string(gnuplot::ink) + "'\n" + panels + "unset multiplot\n";
  return gnuplot::render(job, directory, "stability_" + map.name);
}

} // namespace host::chart
