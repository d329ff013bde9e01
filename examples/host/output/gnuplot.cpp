// SPDX-License-Identifier: BSD-3-Clause
#include "gnuplot.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>

namespace host::pictures {
namespace gnuplot {
namespace {

#ifdef _WIN32
constexpr const char* nowhere = "NUL";
std::string shell_quoted(const std::string& word) { return "\"" + word + "\""; }
#else
constexpr const char* nowhere = "/dev/null";
std::string shell_quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}
#endif

std::string escaped(std::string_view utf8) {
  std::string out;
  for (const char c : utf8) {
    if (c == '\n') {
      out += ' ';
      continue;
    }
    if (std::string_view("_^{}@&~\\").find(c) != std::string_view::npos) out += '\\';
    out += c;
    if (c == '\'') out += c; // '' is one quote inside a quoted string
  }
  return out;
}

// Nine equidistant colours of each map; gnuplot interpolates between them.
using Stops = std::array<std::uint32_t, 9>;
constexpr Stops viridis{0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c,
                        0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};
constexpr Stops cividis{0x00224e, 0x1a386f, 0x434e6c, 0x61656f, 0x7d7c78,
                        0x9b9476, 0xbcae6c, 0xdec958, 0xfee838};
constexpr Stops magma{0x000004, 0x1d1147, 0x51127c, 0x832681, 0xb73779,
                      0xe75263, 0xfc8961, 0xfec488, 0xfcfdbf};
constexpr Stops diverging{0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xf7f7f7,
                          0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b};

const Stops& stops(Map::Palette which) {
  switch (which) {
  case Map::Palette::cividis:
    return cividis;
  case Map::Palette::magma:
    return magma;
  case Map::Palette::diverging:
    return diverging;
  case Map::Palette::viridis:
    break;
  }
  return viridis;
}

std::string hex(std::uint32_t rgb) {
  std::array<char, 8> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), rgb, 16).ptr;
  const std::string out(digits.data(), end);
  return std::string("#").append(6 - out.size(), '0') + out;
}

bool write(const std::filesystem::path& file, const std::string& content) {
  std::ofstream stream(file, std::ios::binary);
  stream << content;
  stream.close();
  return static_cast<bool>(stream);
}

std::string first_line_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  while (std::getline(stream, line))
    if (line.find_first_not_of(" \t^") != std::string::npos) return line;
  return "no message";
}

} // namespace

std::string file_name(std::string_view name) {
  std::string out = "'";
  for (const char c : name) out += std::string(c == '\'' ? 2 : 1, c);
  return out + "'";
}

std::string text(std::string_view utf8) { return std::string("'").append(escaped(utf8)) + "'"; }
std::string bold(std::string_view utf8) { return std::string("'{/:Bold ").append(escaped(utf8)) + "}'"; }

std::string number(double value) {
  if (std::isnan(value)) return "NaN";
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

int common_power(double largest) {
  if (!(largest > 0) || !std::isfinite(largest) || (largest >= 1e-2 && largest < 1e5)) return 0;
  return 3 * static_cast<int>(std::floor(std::log10(largest) / 3));
}

std::string axis_label(std::string_view label, std::string_view unit, int power) {
  static constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string scale;
  if (power != 0) {
    scale = power < 0 ? "10⁻" : "10";
    for (const char c : std::to_string(std::abs(power))) scale += digits[static_cast<std::size_t>(c - '0')];
  }
  if (!scale.empty() && !unit.empty()) scale += " ";
  scale += unit;
  return std::string(label) + (scale.empty() ? "" : " [" + scale + "]");
}

std::string curve_color(std::size_t index, std::size_t count) {
  static constexpr std::array okabe_ito{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"};
  if (count <= okabe_ito.size()) return okabe_ito[index % okabe_ito.size()];
  // yellow, the end of viridis, is too light for a line on white
  const double position = 7.0 * static_cast<double>(index) / static_cast<double>(count - 1);
  const auto low = std::min<std::size_t>(6, static_cast<std::size_t>(position));
  const double part = position - static_cast<double>(low);
  std::uint32_t rgb = 0;
  for (const int shift : {16, 8, 0}) {
    const double a = viridis[low] >> shift & 255u, b = viridis[low + 1] >> shift & 255u;
    rgb |= static_cast<std::uint32_t>(std::lround(a + part * (b - a))) << shift;
  }
  return hex(rgb);
}

std::string palette(Map::Palette which) {
  std::string out = "set palette defined (";
  for (std::size_t i = 0; i < stops(which).size(); ++i)
    out += (i > 0 ? ", " : "") + std::to_string(i) + " '" + hex(stops(which)[i]) + "'";
  return out + ")\n";
}

std::string titles(const std::string& title, const std::string& subtitle) {
  std::string out;
  const char* rise = subtitle.empty() ? "1.0" : "2.3";
  if (!title.empty())
    out += "set label 1 " + bold(title) + " at graph 0,1 left offset 0," + rise +
           " font ',15' textcolor rgb '" + ink + "'\n";
  if (!subtitle.empty())
    out += "set label 2 " + text(subtitle) + " at graph 0,1 left offset 0,0.9 font ',11.5' textcolor rgb '" +
           faint + "'\n";
  return out;
}

Outcome render(const Job& job, const std::filesystem::path& directory, const std::string& name) {
  const std::string size = std::to_string(job.width) + "," + std::to_string(job.height);
  const std::string double_size = std::to_string(2 * job.width) + "," + std::to_string(2 * job.height);
  std::string script =
      "# To change the picture: edit and run `gnuplot " + name + ".gp` in this folder.\nset encoding utf8\n";
  script += "data = " + file_name(name + ".dat") + "\n";
  script += "do for [kind in \"png svg\"] {\nif (kind eq \"png\") {\n";
  script += "set terminal pngcairo enhanced size " + double_size +
            " font 'Helvetica,13' fontscale 1.55 linewidth 2 pointscale 2.5\n";
  script +=
      "} else {\nset terminal svg enhanced size " + size + " font 'Helvetica,13' background '#ffffff'\n}\n";
  script += "set output " + file_name(name + ".") + ".kind\n" + job.script + "unset output\n}\n";

  std::error_code ignored;
  const auto path = [&](const char* ending) { return directory / (name + ending); };
  if (!directory.empty()) std::filesystem::create_directories(directory, ignored);
  if (!write(path(".dat"), job.data) || !write(path(".gp"), script))
    return {{}, "picture " + path(".gp").string() + " cannot be written"};
  if (!gnuplot_available())
    return {{},
            "no pictures: gnuplot is missing (Debian package gnuplot-nox); data and scripts are in " +
                directory.string()};
  const std::string command = "cd -- " + shell_quoted(directory.empty() ? "." : directory.string()) +
                              " && gnuplot " + shell_quoted(name + ".gp") + " 2> " +
                              shell_quoted(name + ".log");
  const bool failed = std::system(command.c_str()) != 0;
  Outcome outcome;
  if (failed)
    outcome.problem = "picture " + path(".gp").string() + ": gnuplot says: " + first_line_of(path(".log"));
  else
    outcome.files = {path(".svg"), path(".png")};
  std::filesystem::remove(path(".log"), ignored);
  return outcome;
}

} // namespace gnuplot

bool gnuplot_available() {
  static const bool available =
      std::system((std::string("gnuplot --version > ") + gnuplot::nowhere + " 2>&1").c_str()) == 0;
  return available;
}

} // namespace host::pictures
