// SPDX-License-Identifier: BSD-3-Clause
// Surface coordinates of the master's nodes: in which the model's height is given.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "patches.hpp"

namespace ents_deck {

/// @param how  "x", "xy", "zx" ...: coordinates of the undeformed mesh; "cylinder x|y|z": angle in radians
///             about that axis, and the coordinate along it (2D: the angle about the origin); "file": from `file`
/// @return [faces] of [m][d-1]; angles go on smoothly within a face
std::vector<std::vector<double>> coordinates_of_faces(const Mesh& mesh, const Side& master,
                                                      const std::string& how,
                                                      const std::filesystem::path& file);

/// Plane coordinates of a patch, from its first segment: with friction the anchor then moves from segment to
/// segment exactly, which it does not between natural coordinates. [nodes of the patch][d-1]
std::vector<double> plane_coordinates(const Mesh& mesh, const Side& master, const Patch& patch);

/// The same for an element: [nodes of the patch][d-1].
std::vector<double> coordinates_of_patch(const Side& master, const Patch& patch,
                                         const std::vector<std::vector<double>>& of_faces,
                                         std::size_t parameters, const std::string& how);

} // namespace ents_deck
