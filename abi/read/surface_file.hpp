// SPDX-License-Identifier: BSD-3-Clause
// Measured surfaces and profiles as text files.
//
//   - Gwyddion's text export (gwyddion.net): lines that start with '#', among them
//       # Width: 10.00 um     # Height: 10.00 um     # Value units: m
//     and one line per row of the image;
//   - a plain matrix: the same without these lines (others that start with '#' are comments).
//
// Numbers of a row are separated by blanks and tabs, by ';', or by ','. Which of them holds for the whole
// file is seen on its first row: ';' if there is one, else ',' if there is one and no tab, else blanks
// and tabs. Numbers have a decimal point; a decimal comma is an error, because "1,5 2,5" cannot be told from
// a separator. Lines end with LF or CR LF; empty lines are skipped; a UTF-8 byte order mark is allowed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace ents {

inline constexpr std::uintmax_t largest_surface_file = std::uintmax_t{1} << 30; // bytes
inline constexpr std::int64_t most_map_samples = std::int64_t{1} << 26;

struct SurfaceFile {
  std::int64_t rows = 0;
  std::int64_t columns = 0;
  std::vector<double> values; // [rows][columns] as in the file: row 0 is its first row; no flip
  bool states_units = false;  // then, in metres:
  double width = 0.0;         //   columns pixels along s_1
  double height = 0.0;        //   rows pixels along s_2
  double value_unit = 1.0;    //   one unit of `values`
};

// `name` stands for the file in messages. Throws ModelError ENTS_FILE with file, line and column (the
// number's place in its row, from 1).
SurfaceFile parse_surface(std::string_view text, std::string_view name);

SurfaceFile read_surface_file(const std::filesystem::path& path);

} // namespace ents
