// SPDX-License-Identifier: BSD-3-Clause
// Pictures of a folder: their numbers and words go to pictures.json, and pictures.py beside it draws each as
// NAME.svg and NAME.png, with matplotlib. Without matplotlib the two files are there all the same, and one
// line says what to install.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace host::pictures {

/// Not given: the data say where the axis ends.
inline constexpr double automatic = std::numeric_limits<double>::quiet_NaN();

struct Axis {
  std::string label; ///< "gap", "p", "contact half-width a/λ"
  std::string unit;  ///< "MPa"; empty for a ratio
  bool logarithmic = false;
  double min = automatic, max = automatic;
  double tic_step = 0; ///< distance of the numbers; 0: matplotlib decides
};

enum class Style {
  exact,        ///< solid dark line: the reference
  exact_dashed, ///< dashed dark line: another one
  line,         ///< coloured line
  points,       ///< coloured markers: a computed result
  both,         ///< markers joined by a thin line
  dashed,       ///< thin dashed line: a bound or a second reference
  area,         ///< line with a light fill down to the axis
  wrong,        ///< large red marker: an offence
  wrong_line,   ///< thick red line: the same
};

struct Curve {
  std::string label;        ///< legend; empty: no entry
  std::vector<double> x, y; ///< same size; a NaN interrupts the line
  Style style = Style::both;
  bool fit_order =
      false; ///< log-log: adds the size of the slope, "order 1.98", to the label (last three points)
};

/// A thin straight line across the chart, with a word at its end: an exact contact width, a tolerance.
struct Guide {
  std::string label;
  double value = 0;
  bool vertical = true;
};

struct Chart {
  std::string title;    ///< what is shown
  std::string subtitle; ///< what is exact about it, mesh, load
  Axis x, y;
  std::vector<Curve> curves;
  std::vector<Guide> guides;
  double slope_triangle = 0; ///< log-log: draws a triangle of this order below the first computed curve
  bool equal_axes = false;   ///< geometry: one unit is as long in x as in y
};

/// Residual norms per Newton iteration, one curve per load step, semi-logarithmic.
/// @param steps  [steps][iterations] residual norms, relative to the size of the forces; 0 is left out
/// @param labels one per step, or empty
Chart residual_history(std::string title, const std::vector<std::vector<double>>& steps,
                       const std::vector<std::string>& labels = {});

/// A scalar on a regular grid over a rectangle.
struct Map {
  std::string title; ///< "contact pressure"
  std::string unit;
  int columns = 0, rows = 0;
  std::vector<double> values; ///< [rows][columns], first row at y_min; NaN: white
  bool at_nodes = false;   ///< the outer samples lie on the border of the rectangle, else half a pixel inside
  bool blank_zero = false; ///< show 0 as white: no contact
  double clip =
      1; ///< fraction of the non-blank values inside the colours; the extremes are written below the map
  enum class Palette { viridis, cividis, magma, diverging } palette = Palette::viridis;
};

/// Maps side by side over the same rectangle.
struct Maps {
  std::string title, subtitle;
  std::string x_label = "x", y_label = "y", unit; ///< of both coordinates
  double x_min = 0, x_max = 1, y_min = 0, y_max = 1;
  std::vector<Map> maps; ///< 1 to 3
};

/// A place worth a look on a surface.
struct Place {
  double x = 0, y = 0, z = 0;
  std::string label; ///< "folds: |h| κ = 1.3"
  bool wrong = true; ///< drawn as an offence, else as a remark
};

/// The enriched surface of segments for `ents-lab check`: a section in 2D, a shaded surface in 3D.
struct Surface {
  std::string title, subtitle;
  std::string unit;  ///< of length
  int dimension = 2; ///< 2: rows = 1
  int columns = 0, rows = 1;
  std::vector<double> enriched; ///< [segments][rows][columns][dimension] rho_e
  std::vector<double> base;     ///< [segments][rows][columns][dimension] rho
  std::vector<double> height;   ///< [segments][rows][columns] h, colours the surface in 3D
  std::vector<char> wrong;      ///< [segments] drawn as an offence; empty: one segment that is none
  std::vector<Place> places;
};

/// The pictures of a run, drawn by one call of the script.
class Pictures {
public:
  /// @throws std::invalid_argument if the sizes of arrays do not fit together
  void add(const std::string& name, const Chart& chart);
  void add(const std::string& name, const Maps& maps);
  void add(const std::string& name, const Surface& surface);

  /// Write pictures.json and pictures.py into the folder, which is made, and draw.
  /// @return empty, or one line for the terminal: pictures never fail a run
  std::string draw(const std::filesystem::path& folder) const;

private:
  nlohmann::json all_ = nlohmann::json::array();
};

/// Run a script of a folder with the first Python that has matplotlib: $ENTS_PYTHON, python3, /usr/bin/python3.
/// @return empty, or one line for the terminal
std::string run_script(const std::filesystem::path& folder, const std::string& script,
                       const std::string& option = "");

/// Text of pictures.py, of chart.py, and of the page that the latter fills in; and of chart/work_problems.json.
extern const char *const pictures_script, *const chart_script, *const page_text, *const work_problems_text;

} // namespace host::pictures
