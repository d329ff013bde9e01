// SPDX-License-Identifier: BSD-3-Clause
// Charts: curves, markers and guides over two axes.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gnuplot.hpp"
#include "table.hpp"

namespace host::pictures {
namespace {

using gnuplot::number;

/// One axis with its final range, and where a value lies on it.
struct Scale {
  double min = 0, max = 1, unit = 1; ///< data times `unit` is what the axis shows
  int power = 0;
  bool logarithmic = false;

  double shown(double value) const { return value * unit; }
  double fraction(double value) const {
    return logarithmic ? std::log(value / min) / std::log(max / min) : (value - min) / (max - min);
  }
};

bool drawable(double value, bool logarithmic) { return std::isfinite(value) && (!logarithmic || value > 0); }

/// Range of the data with a margin, so that no marker sits on a border; a range from 0 stays at 0.
Scale scale_of(const Axis& axis, const std::vector<const std::vector<double>*>& data,
               const std::vector<double>& guides) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  const auto take = [&](double value) {
    if (drawable(value, axis.logarithmic)) low = std::min(low, value), high = std::max(high, value);
  };
  for (const auto* values : data)
    for (const double value : *values) take(value);
  for (const double value : guides) take(value);
  if (low > high) low = axis.logarithmic ? 1 : 0, high = axis.logarithmic ? 10 : 1;

  Scale out;
  out.logarithmic = axis.logarithmic;
  if (axis.logarithmic) {
    const double margin = std::max(std::pow(high / low, 0.06), 1.15);
    out.min = low / margin, out.max = high * margin;
  } else {
    const double span = high > low ? high - low : std::max(1.0, std::abs(low));
    const bool from_zero = low >= 0 && low <= 0.1 * span;
    out.min = from_zero ? 0 : low - 0.05 * span, out.max = high + 0.06 * span;
  }
  if (drawable(axis.min, axis.logarithmic)) out.min = axis.min;
  if (drawable(axis.max, axis.logarithmic)) out.max = axis.max;
  if (!axis.logarithmic) out.power = gnuplot::common_power(std::max(std::abs(out.min), std::abs(out.max)));
  out.unit = std::pow(10.0, -out.power);
  return out;
}

/// Powers of ten; 1-2-5 steps if there are hardly any of them in the range; every third if there are many.
std::string logarithmic_tics(const std::string& x, const Scale& scale) {
  std::string out = "set logscale " + x + "\nset m" + x + "tics 10\nset format " + x + " '10^{%T}'\n";
  const double decades = std::log10(scale.max / scale.min);
  if (decades > 11) {
    const int first = static_cast<int>(std::ceil(std::log10(scale.min) / 3)) * 3;
    out += "set " + x + "tics " + number(std::pow(10, first)) + ",1000\nset m" + x + "tics 1\n";
  } else if (decades < 2) {
    out += "set format " + x + " '%g'\nset " + x + "tics (";
    for (int power = static_cast<int>(std::floor(std::log10(scale.min))); power <= std::log10(scale.max);
         ++power)
      for (const int factor : {1, 2, 5}) out += number(factor * std::pow(10, power)) + ",";
    out.back() = ')';
    out += "\n";
  }
  return out;
}

std::string axis_settings(char which, const Axis& axis, const Scale& scale) {
  const std::string x(1, which);
  std::string out =
      "set " + x + "label " + gnuplot::text(gnuplot::axis_label(axis.label, axis.unit, scale.power)) + "\n";
  if (scale.logarithmic) out += logarithmic_tics(x, scale);
  if (axis.tic_step > 0) out += "set " + x + "tics " + number(scale.shown(axis.tic_step)) + "\n";
  out +=
      "set " + x + "range [" + number(scale.shown(scale.min)) + ":" + number(scale.shown(scale.max)) + "]\n";
  return out;
}

std::vector<const std::vector<double>*> all(const Chart& chart, std::vector<double> Curve::*values) {
  std::vector<const std::vector<double>*> out;
  for (const Curve& curve : chart.curves) out.push_back(&(curve.*values));
  return out;
}

std::vector<double> guide_values(const Chart& chart, bool vertical) {
  std::vector<double> out;
  for (const Guide& guide : chart.guides)
    if (guide.vertical == vertical) out.push_back(guide.value);
  return out;
}

/// Slope of log y over log x by least squares through the last three points; NaN with less than two.
double fitted_order(const Curve& curve) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (curve.x[i] > 0 && curve.y[i] > 0) points.emplace_back(std::log(curve.x[i]), std::log(curve.y[i]));
  if (points.size() > 3) points.erase(points.begin(), points.end() - 3);
  double x = 0, y = 0, xx = 0, xy = 0;
  const double n = static_cast<double>(points.size());
  for (const auto& [a, b] : points) x += a / n, y += b / n;
  for (const auto& [a, b] : points) xx += (a - x) * (a - x), xy += (a - x) * (b - y);
  return xx > 0 ? xy / xx : automatic;
}

/// The corner of the graph with fewest data below a legend of that many lines; "" if none is free.
std::string free_corner(const Chart& chart, const Scale& x, const Scale& y, std::size_t entries,
                        std::size_t letters) {
  const double width = 0.09 + 0.0115 * static_cast<double>(letters),
               height = 0.04 + 0.055 * static_cast<double>(entries);
  if (width > 0.75 || height > 0.7) return "";
  struct Corner {
    const char* name;
    bool right, top;
  };
  for (const Corner corner : {Corner{"top right", true, true},
                              {"top left", false, true},
                              {"bottom right", true, false},
                              {"bottom left", false, false}}) {
    const auto covers = [&](double u, double v) {
      return (corner.right ? u > 1 - width : u < width) && (corner.top ? v > 1 - height : v < height);
    };
    bool free = true;
    for (const Guide& guide : chart.guides) {
      const double at = guide.vertical ? x.fraction(guide.value) : y.fraction(guide.value);
      const bool near = guide.vertical ? (corner.right ? at > 1 - width : at < width)
                                       : (corner.top ? at > 1 - height : at < height);
      if (near) free = false;
    }
    for (const Curve& curve : chart.curves) {
      double last_u = automatic, last_v = automatic;
      for (std::size_t i = 0; i < curve.x.size() && free; ++i) {
        const bool visible = drawable(curve.x[i], x.logarithmic) && drawable(curve.y[i], y.logarithmic);
        const double u = visible ? x.fraction(curve.x[i]) : automatic,
                     v = visible ? y.fraction(curve.y[i]) : automatic;
        constexpr int pieces = 20; // of the straight line from the point before
        for (int k = 0; k < pieces && free; ++k) {
          const double t = k / static_cast<double>(pieces);
          if (covers(u, v) || covers(u + t * (last_u - u), v + t * (last_v - v))) free = false;
        }
        last_u = u, last_v = v;
      }
    }
    if (free) return corner.name;
  }
  return "";
}

bool is_reference(Style style) { return style == Style::exact || style == Style::exact_dashed; }

std::string style_of(const Curve& curve, std::size_t index, std::size_t count) {
  static constexpr const char* markers[] = {"7", "5", "9", "13", "11", "15"}; // filled: circle, square ...
  static constexpr const char* open_markers[] = {"6", "4", "8", "12", "10", "14"};
  const std::string color =
      " linecolor rgb '" +
      (is_reference(curve.style) ? std::string(gnuplot::ink) : gnuplot::curve_color(index, count)) + "'";
  std::string marker = " pointtype ";
  marker += markers[count > std::size(markers) ? 0 : index % std::size(markers)];
  marker += curve.x.size() > 60 && curve.style == Style::points ? " pointsize 0.6" : " pointsize 0.85";
  switch (curve.style) {
  case Style::exact:
    return "with lines linewidth 1.2" + color;
  case Style::exact_dashed:
    return "with lines linewidth 1.2 dashtype (10,5)" + color;
  case Style::line:
    return "with lines linewidth 1.8" + color;
  case Style::points:
    return "with points" + marker + color;
  case Style::dashed:
    return "with lines linewidth 1.3 dashtype (12,7)" + color;
  case Style::area:
    return "with filledcurves x1 fillstyle solid 0.18" + color;
  case Style::wrong:
    return "with points pointtype " + std::string(open_markers[index % std::size(open_markers)]) +
           " pointsize 1.8 linewidth 2.2 linecolor rgb '" + std::string(gnuplot::wrong) + "'";
  case Style::wrong_line:
    return "with lines linewidth 2.4 linecolor rgb '" + std::string(gnuplot::wrong) + "'";
  case Style::both:
    break;
  }
  const std::size_t every = std::max<std::size_t>(1, curve.x.size() / 30);
  return "with linespoints linewidth 1.3 pointinterval " + std::to_string(every) + marker + color;
}

std::string guides(const Chart& chart, const Scale& x, const Scale& y) {
  std::string out;
  for (const Guide& guide : chart.guides) {
    const std::string at = "first " + number(guide.vertical ? x.shown(guide.value) : y.shown(guide.value));
    const std::string from = guide.vertical ? at + ", graph 0" : "graph 0, " + at;
    const std::string to = guide.vertical ? at + ", graph 1" : "graph 1, " + at;
    out += "set arrow from " + from + " to " + to +
           " nohead back dashtype (5,4) linewidth 1.2 linecolor rgb '" + std::string(gnuplot::faint) + "'\n";
    if (guide.label.empty()) continue;
    const bool right_half = x.fraction(guide.value) > 0.7;
    out += "set label " + gnuplot::text(guide.label) + " at ";
    if (guide.vertical)
      out += at + ", graph 0.965 " + (right_half ? "right offset -0.6,0" : "left offset 0.6,0");
    else
      out += "graph 0.985, " + at + " right offset 0,0.55";
    out += " font ',11' textcolor rgb '" + std::string(gnuplot::faint) + "'\n";
  }
  return out;
}

/// A right triangle of the given slope, a little below the middle of the first computed curve.
std::string slope_triangle(const Chart& chart, const Scale& x, const Scale& y) {
  if (chart.slope_triangle == 0 || !x.logarithmic || !y.logarithmic) return "";
  const auto curve = std::find_if(chart.curves.begin(), chart.curves.end(),
                                  [](auto& c) { return c.fit_order && c.x.size() > 1; });
  if (curve == chart.curves.end()) return "";
  const auto [low, high] = std::minmax_element(curve->x.begin(), curve->x.end());
  const double a = *low * std::pow(*high / *low, 0.42), b = *low * std::pow(*high / *low, 0.68);
  const auto on_curve = [&](double at) { // straight in log-log between neighbours
    for (std::size_t i = 0; i + 1 < curve->x.size(); ++i) {
      const double t = std::log(at / curve->x[i]) / std::log(curve->x[i + 1] / curve->x[i]);
      if (t >= 0 && t <= 1) return curve->y[i] * std::pow(curve->y[i + 1] / curve->y[i], t);
    }
    return curve->y.front();
  };
  const bool falling = fitted_order(*curve) < 0; // an error over the number of segments, say
  const double ratio = std::pow(b / a, falling ? -chart.slope_triangle : chart.slope_triangle);
  const double left = std::min(on_curve(a), on_curve(b) / ratio) * std::pow(y.max / y.min, -0.07);
  const double right = left * ratio, upright = falling ? a : b;
  const auto corner = [](double u, double v) { return "first " + number(u) + "," + number(v); };
  std::string out = "set object polygon from " + corner(a, left) + " to " + corner(b, right) + " to " +
                    corner(upright, std::min(left, right)) + " to " + corner(a, left) +
                    " fillstyle solid 0.12 border linecolor rgb '" + std::string(gnuplot::faint) + "'\n";
  out += "set label '1' at " + corner(std::sqrt(a * b), std::min(left, right)) +
         " center offset 0,-0.75 font ',11'\n";
  out += "set label " + gnuplot::text(number(chart.slope_triangle)) + " at " +
         corner(upright, std::sqrt(left * right)) +
         (falling ? " right offset -0.7,0" : " left offset 0.7,0") + " font ',11'\n";
  return out;
}

} // namespace

Outcome draw(const Chart& chart, const std::filesystem::path& directory, const std::string& name) {
  for (const Curve& curve : chart.curves)
    if (curve.x.size() != curve.y.size())
      throw std::invalid_argument("chart '" + name + "': curve '" + curve.label + "' has " +
                                  std::to_string(curve.x.size()) + " x and " +
                                  std::to_string(curve.y.size()) + " y");
  const Scale x = scale_of(chart.x, all(chart, &Curve::x), guide_values(chart, true));
  const Scale y = scale_of(chart.y, all(chart, &Curve::y), guide_values(chart, false));
  gnuplot::Job job;
  job.data = "# " + chart.title + "\n# " + gnuplot::axis_label(chart.x.label, chart.x.unit) + "   " +
             gnuplot::axis_label(chart.y.label, chart.y.unit) + "\n";

  std::string computed, exact; // the exact line lies on top: dense markers do not hide it
  std::size_t block = 0, entries = 0, letters = 0, colored = 0;
  const auto colors =
      static_cast<std::size_t>(std::count_if(chart.curves.begin(), chart.curves.end(), [](auto& c) {
        return !is_reference(c.style) && c.style != Style::wrong_line;
      }));
  for (const Curve& curve : chart.curves) {
    std::string label = curve.label;
    if (curve.fit_order && !std::isnan(fitted_order(curve)))
      label += ", order " + format_number(std::abs(fitted_order(curve)), 3);
    job.data += "\n\n# " + label + "\n";
    for (std::size_t i = 0; i < curve.x.size(); ++i)
      job.data += number(curve.x[i]) + " " + number(curve.y[i]) + "\n";
    const bool on_top = is_reference(curve.style) || curve.style == Style::wrong_line;
    std::string& plot = on_top ? exact : computed;
    plot += ", \\\n data index " + std::to_string(block++);
    plot += " using ($1*" + number(x.unit) + "):($2*" + number(y.unit) + ") ";
    plot += style_of(curve, on_top ? 0 : colored++, colors);
    plot += label.empty() ? " notitle" : " title " + gnuplot::text(label);
    if (!label.empty())
      ++entries, letters = std::max(letters, static_cast<std::size_t>(display_width(label)));
  }
  const std::string curves = computed + exact;
  if (curves.empty()) return {{}, "picture " + name + ": nothing to draw"};

  const std::string corner = free_corner(chart, x, y, entries, letters);
  if (chart.equal_axes) // as high as the data ask for
    job.height = static_cast<int>(std::clamp(150 + 780 * (y.max - y.min) / (x.max - x.min), 300.0, 900.0));
  if (corner.empty()) job.height += 24 * static_cast<int>(entries);
  job.script = "reset\nset border 3 linewidth 1.1 linecolor rgb '" + std::string(gnuplot::ink) +
               "'\n"
               "set tics nomirror out scale 0.7,0.35\nset minussign\nset grid linetype 1 linecolor rgb "
               "'#e4e4e4' linewidth 0.8\n"
               "set tmargin " +
               (chart.subtitle.empty() ? "3" : "4.5") + "\nset rmargin 4\n";
  job.script += corner.empty() ? "set key below left reverse Left maxcols 1 samplen 2.5 spacing 1.25\n"
                               : "set key " + corner + " reverse Left samplen 2.5 spacing 1.25 noautotitle\n";
  if (chart.equal_axes) job.script += "set size ratio -1\n";
  job.script += gnuplot::titles(chart.title, chart.subtitle) + axis_settings('x', chart.x, x) +
                axis_settings('y', chart.y, y);
  job.script += guides(chart, x, y) + slope_triangle(chart, x, y) + "plot" + curves.substr(1) + "\n";
  return gnuplot::render(job, directory, name);
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
