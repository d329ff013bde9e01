// SPDX-License-Identifier: BSD-3-Clause
// How pictures speak to gnuplot: text, numbers, colours, and the run itself.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pictures.hpp"

namespace host::pictures::gnuplot {

/// Text as a gnuplot string: quoted, and free of enhanced-text commands, so `rough_afm` stays what it is.
std::string text(std::string_view utf8);

/// A file name as a gnuplot string.
std::string file_name(std::string_view name);

/// Bold and grey text, for titles and subtitles.
std::string bold(std::string_view utf8);

/// Shortest text that reads back to the same bits; NaN as gnuplot knows it.
std::string number(double value);

/// Label with its unit, "gap [10⁻⁶ mm]"; `power` is the power of ten taken out of the numbers.
std::string axis_label(std::string_view label, std::string_view unit, int power = 0);

/// The power of 1000 to take out of numbers up to `largest`, as a power of ten: 0 from 1e-3 to 1e5.
int common_power(double largest);

/// Colours of computed curves: six that readers with any colour vision tell apart (Okabe & Ito 2008), a
/// viridis sequence if there are more curves.
std::string curve_color(std::size_t index, std::size_t count);

/// `set palette` of a perceptually uniform map (matplotlib's viridis, cividis, magma; CC0) or the diverging
/// blue-white-red.
std::string palette(Map::Palette which);

/// Title and subtitle, left above the graph.
std::string titles(const std::string& title, const std::string& subtitle);

struct Job {
  int width = 900, height = 600; ///< pixels of the SVG; the PNG has twice as many
  std::string data;              ///< text of NAME.dat
  std::string script;            ///< settings and one plot (or multiplot), without terminal and output
};

/// Write NAME.dat and NAME.gp, run gnuplot on them.
Outcome render(const Job& job, const std::filesystem::path& directory, const std::string& name);

inline constexpr const char* ink = "#222222";   ///< exact curves, text
inline constexpr const char* faint = "#777777"; ///< guides, second texts
inline constexpr const char* wrong = "#c1121f"; ///< offences

} // namespace host::pictures::gnuplot
