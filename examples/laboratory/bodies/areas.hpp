// SPDX-License-Identifier: BSD-3-Clause
// Areas of nodes before there is a library that could be asked (ents_tributary_areas), and for single nodes of a mesh.
#pragma once

#include "mesh.hpp"

namespace host {

/// Tributary measure of every node of the faces, in the order of `nodes`: integral of its shape function over
/// the faces in the reference configuration.
/// @param thickness     2D: [L]
/// @param axisymmetric  2D: weighs with 2 pi r instead of the thickness
/// @return [nodes.size()], area
std::vector<double> tributary_areas(const Mesh& mesh, const std::vector<Face>& faces,
                                    const std::vector<int>& nodes, double thickness, bool axisymmetric);

} // namespace host
