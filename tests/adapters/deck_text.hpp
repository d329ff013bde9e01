// SPDX-License-Identifier: BSD-3-Clause
// Decks for the tests of ents-deck: two blocks on each other, and what reading and converting them gives.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>

#include "convert.hpp"

namespace ents_deck {

using std::string;

inline Mesh mesh_of(const string& text) { return read_mesh(read_source_text(text, "deck.inp", ".")); }

inline string error_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing is wrong";
}

inline void write(const std::filesystem::path& file, const string& text) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

inline string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A block of nx ny nz C3D8 between two corners; numbers of nodes and elements start at `first`.
inline string block(int first, const Point& low, const Point& high, int nx, int ny, int nz,
                    const string& set) {
  std::ostringstream out;
  out.precision(17);
  const auto number = [&](int i, int j, int k) { return first + i + (nx + 1) * (j + (ny + 1) * k); };
  out << "*NODE, NSET=N" << set << "\n";
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        out << number(i, j, k) << ", " << low[0] + (high[0] - low[0]) * i / nx << ", "
            << low[1] + (high[1] - low[1]) * j / ny << ", " << low[2] + (high[2] - low[2]) * k / nz << "\n";
  out << "*ELEMENT, TYPE=C3D8, ELSET=" << set << "\n";
  int e = first;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        out << e++ << ", " << number(i, j, k) << ", " << number(i + 1, j, k) << ", "
            << number(i + 1, j + 1, k) << ", " << number(i, j + 1, k) << ", " << number(i, j, k + 1) << ", "
            << number(i + 1, j, k + 1) << ", " << number(i + 1, j + 1, k + 1) << ", "
            << number(i, j + 1, k + 1) << "\n";
  return out.str();
}

inline const string surfaces =
    "*ELSET, ELSET=ETOP, GENERATE\n101, 104\n*SURFACE, NAME=SLAVE\nETOP, S1\n*SURFACE, "
    "NAME=MASTER\nLOW, S2\n";
inline const string law =
    "*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e6\n";
inline const string pair_of_surfaces =
    "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE\nSLAVE, MASTER\n";
inline const string material = "*MATERIAL, NAME=M\n*ELASTIC\n1000., .3\n*SOLID SECTION, ELSET=LOW, "
                               "MATERIAL=M\n*SOLID SECTION, ELSET=HIGH, MATERIAL=M\n";
inline const string step =
    "*STEP, NLGEOM\n*STATIC\n*BOUNDARY\nNHIGH, 1, 1, 0.05\n*NODE PRINT, NSET=NLOW\nU\n*END STEP\n";

/// Two blocks on each other, 4 x 4 faces below, 2 x 2 above.
inline string two_blocks() {
  return block(1, {0, 0, 0}, {3, 3, 1}, 4, 4, 1, "LOW") +
         block(101, {0.5, 0.5, 1}, {2.5, 2.5, 2}, 2, 2, 1, "HIGH") + surfaces;
}

inline string deck(const string& changed = "", const string& by = "") {
  string text = two_blocks() + material + law + pair_of_surfaces + step;
  if (!changed.empty()) {
    EXPECT_NE(text.find(changed), string::npos) << changed;
    text.replace(text.find(changed), changed.size(), by);
  }
  return text;
}

inline Job converted(const string& text, Options options = {}) {
  write("job/deck.inp", text);
  options.deck = "job/deck.inp";
  return convert(options);
}

} // namespace ents_deck
