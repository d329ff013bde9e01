// SPDX-License-Identifier: BSD-3-Clause
// Smoothed segments over the faces of a body: which nodes each of them sees.
#pragma once

#include <string>
#include <vector>

#include "mesh.hpp"

namespace host {

/// Nodes of catmull_rom4 and bspline4 segments on a chain of lines: the node before, the two of the line itself,
/// and the node after. At an open end of the chain its last node stands in for the missing one.
/// @param where  for the message if more than two lines meet in a node
/// @return [faces][4]
std::vector<int> smoothed_lines(const std::vector<Face>& faces, const std::string& where);

} // namespace host
