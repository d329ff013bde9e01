// SPDX-License-Identifier: BSD-3-Clause
// Stability maps: the model problem at every point of a grid over two of its parameters, by every method;
// what became of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "chart/careful_host.hpp"
#include "chart/judge.hpp"

namespace host::chart {

struct Axis {
  std::string label;
  std::vector<double> values;
};

enum class Fate {
  solved,   ///< and right, at every increment
  flagged,  ///< the host knows that it has no answer, and why
  diverged, ///< the host knows that it has no answer
  wrong,    ///< silently: an increment was delivered that is not where the judge is
  unjudged, ///< the judge has no answer
};
const char* word(Fate fate);

struct Cell {
  Fate fate = Fate::solved;
  Outcome outcome;         ///< without its levels
  double error = 0;        ///< largest distance of a delivered position from the judge's, segments
  int wrong_increment = 0; ///< first one beyond the tolerance; 0: none
};

struct Panel {
  Method method;
  bool careful = true;     ///< false: the same host without its rules
  std::vector<Cell> cells; ///< [y][x]
};

struct Map {
  std::string name, title, text;
  Axis x, y;
  std::vector<Panel> panels;
  std::vector<double> curvature_radius; ///< empty, or what the text says of a column
  std::function<Press(double x, double y, const Method& method)> problem;
  std::vector<SurfaceKind> surfaces{std::begin(surface_kinds), std::end(surface_kinds)};
};

/// Two solutions are the same if they are no farther apart than this, in segments. Both satisfy their
/// equations to 1e-9 of the spring's forces, over a least curvature of the energy of a hundredth of the
/// spring's: 1e-7 segments. Two branches are a tenth of a wave apart or more, 1e-2 segments and more.
inline constexpr double same_position = 1e-5;

/// All maps of the page. @param quick  a few points each, for the tests
std::vector<Map> stability_maps(bool quick);

/// What became of the press, judged.
Cell judged(const Outcome& outcome, const Press& press, const Truth& truth);

/// Solve and judge every point by every method; `careless` adds panels without the host's rules (consistent
/// tangent).
void fill(Map& map, const EntsLibrary& library, bool careless);

} // namespace host::chart
