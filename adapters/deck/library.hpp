// SPDX-License-Identifier: BSD-3-Clause
// What the converter asks the library: are models right, what do their elements need, is the surface
// admissible, and where do the slave nodes begin?
#pragma once

#include <string>
#include <vector>

#include "convert.hpp"

namespace ents_deck {

/// Reads the model as the adapters will. @throws Error with the library's message
Model checked_model(nlohmann::ordered_json text, int number, int slave_nodes);

struct Admissibility {
  std::vector<std::string> violations; ///< a sentence each
  double lowest = 0, highest = 0;      ///< height [L]
};
/// The library's check of the whole surface, sampled; nothing without a height.
Admissibility admissibility_of(const Mesh& mesh, const Contact& contact);
bool has_height(const Contact& contact);

struct Findings {
  int near = 0;            ///< slave points with a projection on the enriched surface
  int touching = 0;        ///< |gap| <= `touch`
  int penetrating = 0;     ///< more than that
  double deepest = 0;      ///< [L] > 0, of those that penetrate
  double nearest = 0;      ///< [L] smallest gap of the others; infinite: there are none
  double widest_touch = 0; ///< [L] largest gap of those that touch, >= 0
};
/// @param touch  [L] gaps up to here are none: what rounding leaves of nodes that lie on the master
Findings findings_of(const Mesh& mesh, const Contact& contact, double touch);

/// Points of the enriched master: `per_side` + 1 along each side of each face, triangulated for pictures.
struct SampledSurface {
  std::vector<Point> points;
  std::vector<double> heights;
  std::vector<std::vector<int>> cells; ///< lines, triangles or quadrilaterals
};
SampledSurface sampled(const Mesh& mesh, const Contact& contact, int per_side);

} // namespace ents_deck
