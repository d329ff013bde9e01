// SPDX-License-Identifier: BSD-3-Clause
// How many points per direction a slave face gets where the deck asks for none.
#pragma once

#include "convert.hpp"

namespace ents_deck {

constexpr int most_points = 16; ///< of --points

/// Points inside of faces carry what a face carries to all its nodes, as contact between surfaces does. Nodes
/// have their shares of areas alone, and where both meshes match they lie on kinks of the master. A face that lies
/// over edges of the master has jumps of the pressure: so many points keep a uniform pressure within 0.5 % (linear
/// faces) and 1 % (quadratic ones) where meshes do not match. `--points` comes first.
/// @param remarks  what the user should know about them
/// @return per slave face; empty: an element per node
/// @throws Error where --points asks a slave of nodes alone for them
std::vector<int> point_counts(const Mesh& mesh, const Contact& contact, const Options& options,
                              std::vector<std::string>& remarks);

} // namespace ents_deck
