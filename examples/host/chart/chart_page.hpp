// SPDX-License-Identifier: BSD-3-Clause
// The page of `ents-lab chart`: one HTML file with everything in it, to be read without a network.
#pragma once

#include <string>
#include <vector>

#include "chart/map.hpp"
#include "chart/wrong_heights.hpp"

namespace host::chart {

/// A chapter of the page.
struct Section {
  std::string id, title, html;
};

/// How a cell is drawn: a colour and up to one letter.
struct Look {
  unsigned rgb;
  char letter; ///< 0: none
};
Look look_of(const Cell& cell);

/// Colour of a number of iterations.
unsigned iterations_color(int iterations);

std::string map_section(const Map& map);
std::string wrong_heights_section(const std::vector<WrongHeight>& rows);
std::string legend();
std::string page(const std::vector<Section>& sections, const std::string& version);

/// Text with the characters that HTML needs escaped.
std::string escaped(const std::string& text);

} // namespace host::chart
