// SPDX-License-Identifier: BSD-3-Clause
// Smoothed segments over the faces of a body: which nodes each of them sees.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ents_library.hpp"
#include "mesh.hpp"

namespace host {

/// Is it a basis over several faces: catmull_rom4, bspline4 on lines, catmull_rom16, bspline16 on
/// quadrilaterals?
bool is_smoothed(const std::string& segment);

/// Nodes of smoothed segments, one on each face, by the library. Beyond a free end or border its own node
/// stands in for the missing one (ENTS_ENDS_REPEATED), so that all control points are nodes and the equations
/// of this program serve them as they serve any segment.
/// @param where  for messages: faces that do not fit, or a mesh that is not regular
/// @return [faces][4 or 16]
std::vector<std::int64_t> smoothed_nodes(const EntsLibrary& library, const std::string& segment,
                                         const std::vector<Face>& faces, const std::string& where);

} // namespace host
